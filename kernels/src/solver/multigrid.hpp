// A preconditioner for the stiffness of a solid, by smoothed aggregation: groups of particles that move as rigid bodies, smoothed
// by the stiffness, are the unknowns of a smaller problem, and so on down to one that is factorised; Chebyshev polynomials take care
// of what a level shows and the next does not. P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179.
// Symmetric and positive definite if the stiffness is.                                      [FEM multigrid]
#pragma once

#include <Eigen/SparseCholesky>
#include <cstdint>
#include <memory>
#include <vector>

#include "solver/aggregation.hpp"

namespace cleave {

class Multigrid {
 public:
  explicit Multigrid(ThreadTeam& team) : team_(team) {}
  // As far as set-up can see: a matrix that it calls definite may yet not be.
  enum class Kind { definite, singular, indefinite };
  // k is kept by reference. Nothing is applied unless it is definite.
  Kind set_up(const SparseMatrix& k, Nodes nodes);
  // Of a singular one, an unknown that nothing resists.
  std::int64_t weakest() const { return weakest_; }
  void apply(const Vector& r, Vector& z);

  std::int64_t levels() const { return std::ssize(levels_) + 1; }
  std::int64_t bytes() const;

 private:
  struct Level {
    const SparseMatrix* k = nullptr;
    SparseMatrix own;     // *k, but on the first level
    Vector inverse;       // of the diagonal
    double highest = 0;   // bound of the eigenvalues of inverse * k
    SparseRows up, down;  // from the next level; to it
    Vector r, step, product;
  };
  Kind add_level(const SparseMatrix& k, Nodes& nodes);
  // What a pivot, or an entry on the diagonal, says about the next level.
  Kind judge(const Vector& values, std::int64_t& place) const;
  void name_weakest(std::int64_t unknown);
  Kind factorise_last();
  void smooth(Level& level, const Vector& b, Vector& x, bool from_zero);
  void cycle(std::size_t depth, const Vector& b, Vector& x);

  ThreadTeam& team_;
  std::vector<std::unique_ptr<Level>> levels_;
  SparseMatrix last_;
  Eigen::SimplicialLDLT<SparseMatrix> bottom_;
  std::int64_t weakest_ = kNoEquation;
};

}  // namespace cleave
