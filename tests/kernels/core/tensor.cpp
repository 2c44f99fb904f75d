// Small tensors against textbook values.
#include "core/tensor.hpp"

#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace cleave {
namespace {

TEST(Tensor, ComponentsStandInFortranOrder) {
  double array[18] = {};
  Mat<3> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = 10 * (i + 1) + (j + 1);
  store_tensor(m, array, 1);
  const double expected[9] = {11, 21, 31, 12, 22, 32, 13, 23, 33};
  for (int k = 0; k < 9; ++k) {
    EXPECT_EQ(array[k], 0);
    EXPECT_EQ(array[9 + k], expected[k]);
  }
  const Mat<2> plane = load_tensor<2>(array, 1);
  EXPECT_EQ(plane(0, 1), 12);
  EXPECT_EQ(plane(1, 0), 21);
}

template <int D>
void cofactor_is_determinant_times_inverse_transposed() {
  test::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Mat<D> f;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) f(i, j) = random();
    // cof(F)^T F = det(F) I, column by column of the sum over the first index.
    const Mat<D> c = cofactor(f);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        double sum = 0;
        for (int k = 0; k < D; ++k) sum += c(k, i) * f(k, j);
        EXPECT_NEAR(sum, i == j ? determinant(f) : 0.0, 1e-15);  // measured 2e-16
      }
  }
}

TEST(Tensor, CofactorInTwoAndThreeDimensions) {
  cofactor_is_determinant_times_inverse_transposed<2>();
  cofactor_is_determinant_times_inverse_transposed<3>();
  Mat<3> upper;  // det = product of the diagonal
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) upper(i, j) = 1 + i + 2 * j;
  EXPECT_EQ(determinant(upper), 1.0 * 4 * 7);
  Mat<2> swap;
  swap(0, 1) = swap(1, 0) = 1;
  EXPECT_EQ(determinant(swap), -1);
}

}  // namespace
}  // namespace cleave
