// Factors of sparse matrices, by the library that is linked, against dense ones; and how they follow changes.
#include "solver/symmetric_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "solver/linear_solver.hpp"

namespace {

using namespace cleave;
using Dense = Eigen::MatrixXd;

constexpr Eigen::Index kSize = 120;

// A chain of springs to the next three, held a little everywhere, with random stiffnesses.
Dense chain(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> stiffness(0.5, 2.0);
  Dense k = Dense::Identity(kSize, kSize) * 0.1;
  for (Eigen::Index i = 0; i < kSize; ++i)
    for (Eigen::Index j = i + 1; j < std::min(kSize, i + 4); ++j) {
      const double c = stiffness(random);
      k(i, i) += c;
      k(j, j) += c;
      k(i, j) -= c;
      k(j, i) -= c;
    }
  return k;
}

Vector random_vector(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  return Vector::NullaryExpr(kSize, [&] { return value(random); });
}

double difference(const Vector& x, const Vector& y) { return (x - y).norm() / y.norm(); }

// Of three columns with entries that share equations, not in their order.
std::vector<SparseColumn> columns() {
  return {{{40, 1.0}, {7, -0.5}, {41, 0.25}}, {{7, 1.5}, {100, -1.0}}, {{100, 0.3}, {40, 0.7}}};
}
Dense dense(const std::vector<SparseColumn>& columns) {
  Dense v = Dense::Zero(kSize, std::ssize(columns));
  for (Eigen::Index c = 0; c < v.cols(); ++c)
    for (const auto& [equation, entry] : columns[static_cast<std::size_t>(c)])
      v(equation, c) += entry;
  return v;
}

TEST(SymmetricFactor, SolvesAsADenseFactor) {
  SymmetricFactor factor;
  for (const unsigned seed : {1u, 2u}) {  // the second time with the order of the first
    const Dense k = chain(seed);
    ASSERT_TRUE(factor.factor(k.sparseView()));
    const Vector b = random_vector(seed);
    EXPECT_LT(difference(factor.solve(b), k.ldlt().solve(b)), 1e-12);  // measured 2e-15
  }
}

TEST(SymmetricFactor, SolvesForSeveralColumns) {
  const Dense k = chain(3);
  SymmetricFactor factor;
  ASSERT_TRUE(factor.factor(k.sparseView()));
  std::vector<SparseColumn> b = columns();
  b.push_back({{0, 1.0}});
  b.push_back({{kSize - 1, 1.0}, {0, 2.0}, {0, 1.0}});
  b.push_back({});
  std::vector<Vector> x(1, Vector::Zero(kSize));
  factor.solve(b, x);
  ASSERT_EQ(x.size(), 7u);
  const Dense expected = k.ldlt().solve(dense(b));
  for (std::size_t c = 0; c < 5; ++c)
    EXPECT_LT(difference(x[c + 1], expected.col(static_cast<Eigen::Index>(c))), 1e-12) << c;
  EXPECT_EQ(x[6].norm(), 0);
}

TEST(SymmetricFactor, PivotsAreThoseOfTheMatrix) {
  const Dense k = chain(4);
  SymmetricFactor factor;
  ASSERT_TRUE(factor.factor(k.sparseView()));
  SymmetricFactor::Pivots pivots = factor.pivots();
  // measured 2e-15
  const double logarithm = k.ldlt().vectorD().array().log().sum();
  EXPECT_NEAR(pivots.values.array().log().sum(), logarithm, 1e-12 * std::fabs(logarithm));
  std::sort(pivots.equations.begin(), pivots.equations.end());
  ASSERT_EQ(pivots.equations.size(), static_cast<std::size_t>(kSize));
  for (Eigen::Index e = 0; e < kSize; ++e)
    EXPECT_EQ(pivots.equations[static_cast<std::size_t>(e)], e);
  for (const std::int64_t count : pivots.entries) EXPECT_GE(count, 1);
}

TEST(DirectSolver, NamesAnEquationThatNothingResists) {
  DirectSolver solver;
  EXPECT_TRUE(solver.factor(chain(5).sparseView(), true));
  Dense floating = chain(5) - 0.1 * Dense::Identity(kSize, kSize);  // no support
  EXPECT_FALSE(solver.factor(floating.sparseView(), true));
  EXPECT_GE(solver.weakest(), 0);
}

// A spring is taken out, with two others that grow stiffer: W has eigenvalues of both signs.
TEST(DirectSolver, FollowsChangesWhereTheLibraryCan) {
  Dense k = chain(6);
  DirectSolver solver;
  ASSERT_TRUE(solver.factor(k.sparseView(), true));
  if (!solver.can_follow()) GTEST_SKIP() << "this factor cannot";
  const std::vector<SparseColumn> v = columns();
  const std::vector<double> w = {0.3, 0.1, 0, 0.1, -0.02, 0.05, 0, 0.05, 0.2};
  const Vector b = random_vector(6);
  for (int k_th = 0; k_th < 3; ++k_th) {
    k += dense(v) * Eigen::Map<const Dense>(w.data(), 3, 3) * dense(v).transpose();
    ASSERT_GT(k.ldlt().vectorD().minCoeff(), 0);
    ASSERT_TRUE(solver.follow(v, w));
    EXPECT_LT(difference(solver.solve(b), k.ldlt().solve(b)), 1e-11) << k_th;  // measured 3e-15
  }
}

TEST(DirectSolver, SaysThatAChangeLeavesNothingThatResists) {
  const Dense k = chain(7);
  DirectSolver solver;
  ASSERT_TRUE(solver.factor(k.sparseView(), true));
  if (!solver.can_follow()) GTEST_SKIP() << "this factor cannot";
  const SparseColumn last = {{kSize - 1, 1.0}};
  const Vector at = Vector::Unit(kSize, kSize - 1);
  const double compliance =
      at.dot(k.ldlt().solve(at));  // taking 1/compliance away makes it singular
  const std::vector<double> much = {-1 / compliance};
  EXPECT_FALSE(solver.follow({&last, 1}, much));
  EXPECT_GE(solver.weakest(), 0);
}

}  // namespace
