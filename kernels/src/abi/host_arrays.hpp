// The caller's bonds, vectors and tensors as the kernels see them: his integers, his index base, his
// strides. Nothing is copied; a point gets the bits it would get from arrays in our own layout.
#pragma once

#include "abi/guard.hpp"
#include "core/tensor.hpp"

namespace cleave::abi {

// Component c of entry q stands at base[q * point + c * component]; Packed: in our own layout, known when
// compiled. Real: double or const double.
template <class Real, bool Packed>
struct HostVectors {
  Real* base;
  std::int64_t point, component;
  Real& at(std::int64_t q, int c) const {
    return Packed ? base[kVector * q + c] : base[q * point + c * component];
  }
};
template <class Real, bool Packed>
struct HostTensors {
  Real* base;
  std::int64_t point, component;
  Real& at(std::int64_t q, int i, int j) const {
    const std::int64_t c = cleave::component(i, j);
    return Packed ? base[kTensor * q + c] : base[q * point + c * component];
  }
};

template <int D, class Real, bool Packed>
Vec<D> difference(const HostVectors<Real, Packed>& array, std::int64_t a, std::int64_t b) {
  Vec<D> v;
  for (int i = 0; i < D; ++i) v[i] = array.at(b, i) - array.at(a, i);
  return v;
}
template <int D, bool Packed>
void add_vector(const Vec<D>& v, const HostVectors<double, Packed>& array, std::int64_t q) {
  for (int i = 0; i < D; ++i) array.at(q, i) += v[i];
}
template <int D, bool Packed>
Mat<D> load_tensor(const HostTensors<const double, Packed>& array, std::int64_t q) {
  Mat<D> m;
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) m(i, j) = array.at(q, i, j);
  return m;
}
// All nine components; those outside of D x D are zero.
template <int D, bool Packed>
void store_tensor(const Mat<D>& m, const HostTensors<double, Packed>& array, std::int64_t q) {
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) array.at(q, i, j) = i < D && j < D ? m(i, j) : 0.0;
}

// What the kernels ask of an operator (core/gradient_operator.hpp), of bonds between particles.
struct HostOperator {
  const std::int64_t *row_begin, *neighbour, *reverse;
  const double *zeta, *volume;
  std::int64_t base;

  std::int64_t origin_of(std::int64_t q) const { return q; }
  std::int64_t begin(std::int64_t q) const { return row_begin[q] - base; }
  std::int64_t end(std::int64_t q) const { return row_begin[q + 1] - base; }
  std::int64_t particle(std::int64_t entry) const { return neighbour[entry] - base; }
  std::int64_t back(std::int64_t entry) const { return reverse[entry] - base; }
};

}  // namespace cleave::abi
