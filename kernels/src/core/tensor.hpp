// Vectors and second-order tensors of dimension D on the stack, and where their components stand in
// the arrays of the interface. Only what the kernels need; not a linear-algebra library.
#pragma once

#include <cmath>
#include <cstdint>

namespace cleave {

// Stride of vectors and tensors in arrays: always three and nine, whatever the dimension. 64 bits, so
// that products with 32-bit indices are.
inline constexpr std::int64_t kVector = 3;
inline constexpr std::int64_t kTensor = 9;

// Place of component (i,j) in an array tensor: 11 21 31 12 22 32 13 23 33, Fortran's t(3,3).
constexpr int component(int i, int j) { return i + 3 * j; }

template <int D>
struct Vec {
  double c[D] = {};
  double& operator[](int i) { return c[i]; }
  double operator[](int i) const { return c[i]; }
};

template <int D>
struct Mat {
  double c[D][D] = {};
  double& operator()(int i, int j) { return c[i][j]; }
  double operator()(int i, int j) const { return c[i][j]; }
};

template <int D>
Vec<D> load_vector(const double* array, std::int64_t q) {
  Vec<D> v;
  for (int i = 0; i < D; ++i) v[i] = array[kVector * q + i];
  return v;
}

// b - a of two entries of a vector array.
template <int D>
Vec<D> difference(const double* array, std::int64_t a, std::int64_t b) {
  Vec<D> v;
  for (int i = 0; i < D; ++i) v[i] = array[kVector * b + i] - array[kVector * a + i];
  return v;
}

template <int D>
Mat<D> load_tensor(const double* array, std::int64_t q) {
  Mat<D> m;
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) m(i, j) = array[kTensor * q + component(i, j)];
  return m;
}

template <int D>
void store_tensor(const Mat<D>& m, double* array, std::int64_t q) {
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) array[kTensor * q + component(i, j)] = m(i, j);
}

template <int D>
void add_vector(const Vec<D>& v, double* array, std::int64_t q) {
  for (int i = 0; i < D; ++i) array[kVector * q + i] += v[i];
}

template <int D>
double dot(const Vec<D>& a, const Vec<D>& b) {
  double s = 0;
  for (int i = 0; i < D; ++i) s += a[i] * b[i];
  return s;
}

template <int D>
double contract(const Mat<D>& a, const Mat<D>& b) {
  double s = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) s += a(i, j) * b(i, j);
  return s;
}

template <int D>
Vec<D> multiply(const Mat<D>& a, const Vec<D>& b) {
  Vec<D> c;
  for (int i = 0; i < D; ++i) {
    double s = 0;
    for (int j = 0; j < D; ++j) s += a(i, j) * b[j];
    c[i] = s;
  }
  return c;
}

template <int D>
Mat<D> multiply(const Mat<D>& a, const Mat<D>& b) {
  Mat<D> c;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      double s = 0;
      for (int k = 0; k < D; ++k) s += a(i, k) * b(k, j);
      c(i, j) = s;
    }
  return c;
}

// m += u (x) w
template <int D>
void add_dyad(Mat<D>& m, const Vec<D>& u, const Vec<D>& w) {
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) m(i, j) += u[i] * w[j];
}

template <int D>
Mat<D> plus_identity(Mat<D> h) {
  for (int i = 0; i < D; ++i) h(i, i) += 1.0;
  return h;
}

inline double determinant(const Mat<2>& f) { return f(0, 0) * f(1, 1) - f(0, 1) * f(1, 0); }
inline double determinant(const Mat<3>& f) {
  return f(0, 0) * (f(1, 1) * f(2, 2) - f(1, 2) * f(2, 1)) -
         f(0, 1) * (f(1, 0) * f(2, 2) - f(1, 2) * f(2, 0)) +
         f(0, 2) * (f(1, 0) * f(2, 1) - f(1, 1) * f(2, 0));
}

// cof F = det(F) F^-T, defined for singular F as well.
inline Mat<2> cofactor(const Mat<2>& f) {
  Mat<2> c;
  c(0, 0) = f(1, 1);
  c(0, 1) = -f(1, 0);
  c(1, 0) = -f(0, 1);
  c(1, 1) = f(0, 0);
  return c;
}
inline Mat<3> cofactor(const Mat<3>& f) {
  Mat<3> c;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = f(i1, j1) * f(i2, j2) - f(i1, j2) * f(i2, j1);
    }
  }
  return c;
}

}  // namespace cleave
