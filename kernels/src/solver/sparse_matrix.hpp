// The types of sparse linear algebra that the solvers share.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <utility>
#include <vector>

namespace cleave {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;
// Entries of a vector of few: equation, value.
using SparseColumn = std::vector<std::pair<std::int64_t, double>>;

// No equation of a singular system is known to be at fault.
inline constexpr std::int64_t kNoEquation = -1;

}  // namespace cleave
