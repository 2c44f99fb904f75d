// The factor L D L^T of a sparse symmetric matrix, by a library: Eigen (symmetric_factor_eigen.cpp), or CHOLMOD where the
// build asks for it (symmetric_factor_cholmod.cpp), whose factor can follow changes of the matrix. One of the two is linked;
// what a small pivot means is not decided here.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solver/sparse_matrix.hpp"

namespace cleave {

class SymmetricFactor {
 public:
  // In the order of the factor.
  struct Pivots {
    Vector values;                        // of D
    std::vector<std::int64_t> equations;  // of the matrix
    std::vector<std::int64_t> entries;    // of the column of L, with the pivot
  };

  SymmetricFactor();
  ~SymmetricFactor();
  SymmetricFactor(const SymmetricFactor&) = delete;
  SymmetricFactor& operator=(const SymmetricFactor&) = delete;

  // False: a pivot is zero. The entries stand where they stood in the call before.
  bool factor(const SparseMatrix& k);
  Pivots pivots() const;
  // The result depends on nothing else.
  Vector solve(const Vector& b) const;
  // With several sparse right-hand sides; appends to `x`.
  void solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const;
  // From that of K to that of K + C C^T, or of K - C C^T, if the library can do that. False: that is not positive
  // definite, and the factor is lost.
  static bool can_follow();
  bool add(std::span<const SparseColumn> c);
  bool subtract(std::span<const SparseColumn> c);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace cleave
