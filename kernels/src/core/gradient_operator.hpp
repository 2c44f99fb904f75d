// The gradient operator G and its two sparse products: deformation gradient (gather) and internal
// force (transpose). Every formulation with a stress at points uses these two kernels; what differs
// are the weights.
//
// Row q holds the particles a that the gradient at integration point q depends on, with weight
// vectors zeta_qa = Omega_q g_qa. Two kinds:
//   particle methods  point i is particle i; the row holds its neighbours, sorted; the weight of i
//                     itself is - sum_p zeta_ip and is not stored; every pair (i,p) is present as
//                     (p,i) too, and `reverse` maps one to the other
//   finite elements   points lie in elements; the row holds all nodes of the element, `origin` is the
//                     one that differences refer to, and column_* list the entries of every node
#pragma once

#include <cstdint>

#include "core/tensor.hpp"

namespace cleave {

// A view. The kernels below use its member functions only, so that the operator of a host with other
// integers serves them too (abi/host_arrays.hpp).
struct GradientOperator {
  const std::int32_t* row_begin = nullptr;  // (q+1)
  const std::int32_t* neighbour = nullptr;  // (h) particle
  const std::int32_t* reverse = nullptr;    // (h) particle methods
  const double* zeta = nullptr;             // (3,h) [m2] reference configuration
  const double* volume = nullptr;           // (q)   Omega [m3]
  // Finite elements only; NULL otherwise.
  const std::int32_t* origin = nullptr;        // (q)
  const std::int32_t* column_begin = nullptr;  // (n+1)
  const std::int32_t* column_point = nullptr;  // (h) point of an entry, ascending
  const std::int32_t* column_entry = nullptr;  // (h) its place in zeta

  bool of_particles() const { return origin == nullptr; }
  std::int64_t origin_of(std::int64_t q) const { return of_particles() ? q : origin[q]; }
  // Entries of row q; the particle of an entry; the same pair seen from its other end.
  std::int32_t begin(std::int64_t q) const { return row_begin[q]; }
  std::int32_t end(std::int64_t q) const { return row_begin[q + 1]; }
  std::int32_t particle(std::int32_t entry) const { return neighbour[entry]; }
  std::int32_t back(std::int32_t entry) const { return reverse[entry]; }
};

// sum_a (w_a - w_origin) (x) zeta_qa of row q for a vector array w.
template <int D, class Operator, class Vectors>
Mat<D> row_gradient(const Operator& g, const Vectors& w, std::int64_t q) {
  const std::int64_t origin = g.origin_of(q);
  Mat<D> sum;
  for (auto b = g.begin(q); b < g.end(q); ++b) {
    add_dyad(sum, difference<D>(w, origin, g.particle(b)), load_vector<D>(g.zeta, b));
  }
  return sum;
}

// H_q = (1/Omega_q) sum_a u_qa (x) zeta_qa for first <= q < last; zero without volume.   [CBM 8]
// [in]  u (3,n) displacement [m]     [out] h (9,q) displacement gradient [1], D x D components
template <int D, class Operator, class Vectors, class Tensors>
void displacement_gradient(const Operator& g, const Vectors& u, std::int64_t first,
                           std::int64_t last, const Tensors& h) {
  for (std::int64_t q = first; q < last; ++q) {
    Mat<D> sum;
    if (g.volume[q] > 0) {
      sum = row_gradient<D>(g, u, q);
      const double inverse = 1 / g.volume[q];
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) sum(r, c) *= inverse;
    }
    store_tensor(sum, h, q);
  }
}

// Particle methods: f_i += P_i sum_p zeta_ip - sum_p P_p zeta_pi.                    [CBM 18, 19]
template <int D, class Operator, class Tensors, class Vectors>
void pair_force(const Operator& g, const Tensors& p, std::int64_t first, std::int64_t last,
                const Vectors& f) {
  for (std::int64_t i = first; i < last; ++i) {
    Vec<D> own, others;
    for (auto b = g.begin(i); b < g.end(i); ++b) {
      const Vec<D> zeta = load_vector<D>(g.zeta, b);
      const Vec<D> back =
          multiply(load_tensor<D>(p, g.particle(b)), load_vector<D>(g.zeta, g.back(b)));
      for (int k = 0; k < D; ++k) {
        own[k] += zeta[k];
        others[k] += back[k];
      }
    }
    const Vec<D> pulled = multiply(load_tensor<D>(p, i), own);
    Vec<D> force;
    for (int k = 0; k < D; ++k) force[k] = pulled[k] - others[k];
    add_vector(force, f, i);
  }
}

// Finite elements: f_a -= sum_q P_q zeta_qa.
template <int D>
void column_force(const GradientOperator& g, const double* p, std::int64_t first, std::int64_t last,
                  double* f) {
  for (std::int64_t a = first; a < last; ++a) {
    Vec<D> sum;
    for (auto c = g.column_begin[a]; c < g.column_begin[a + 1]; ++c) {
      const Vec<D> part =
          multiply(load_tensor<D>(p, g.column_point[c]), load_vector<D>(g.zeta, g.column_entry[c]));
      for (int k = 0; k < D; ++k) sum[k] += part[k];
    }
    for (int k = 0; k < D; ++k) f[kVector * a + k] -= sum[k];
  }
}

// The force ON particles first <= a < last, added: minus the gradient of sum_q Omega_q W(F_q).
// [in]  p (9,q) first Piola-Kirchhoff stress [Pa]     [in,out] f (3,n) force [N]
template <int D>
void internal_force(const GradientOperator& g, const double* p, std::int64_t first,
                    std::int64_t last, double* f) {
  g.of_particles() ? pair_force<D>(g, p, first, last, f) : column_force<D>(g, p, first, last, f);
}

}  // namespace cleave
