// Linear systems of the static solver by conjugate gradients, preconditioned by multigrid.hpp: memory and time in proportion
// to the number of unknowns, where factors need more and more; only for a symmetric positive definite K. [FEM multigrid]
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "solver/multigrid.hpp"

namespace cleave {

inline constexpr const char* kIndefinite =
    "the stiffness is not positive definite, as in a body that buckles or softens, and conjugate "
    "gradients need that; use solver = 'direct'";

class IterativeSolver {
 public:
  static constexpr std::int64_t kMost = 1000;  // iterations

  explicit IterativeSolver(ThreadTeam& team) : team_(team), preconditioner_(team) {}
  // Takes k away, whose columns are read as rows. nodes: of its unknowns.
  Multigrid::Kind set_up(SparseMatrix& k, Nodes nodes);
  const SparseMatrix& matrix() const { return k_; }
  std::int64_t weakest() const { return preconditioner_.weakest(); }

  enum class End { converged, indefinite, slow };
  // What K is more than the matrix of set_up: adds this times p to q.
  using Change = std::function<void(const Vector& p, Vector& q)>;
  // K x = b until |b - K x| <= tolerance |b|.
  End solve(const Vector& b, double tolerance, const Change& change, Vector& x);
  // What the last call ended with that did not converge, as part of a sentence.
  std::string why(End end, double tolerance) const;
  std::int64_t iterations() const { return iterations_; }  // of the last call
  double residual() const { return residual_; }            // |b - K x| over |b|
  std::int64_t bytes() const;

 private:
  ThreadTeam& team_;
  SparseMatrix k_;
  Multigrid preconditioner_;
  std::int64_t iterations_ = 0;
  double residual_ = 0;
};

}  // namespace cleave
