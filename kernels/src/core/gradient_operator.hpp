// The gradient operator G and its two sparse products: deformation gradient (gather) and internal
// force (transpose). Every formulation with a stress at points uses these two kernels; what differs
// are the weights.
//
// Row i holds the neighbours p of particle i with weight vectors zeta_ip = Omega_i g_ip; the weight
// of i itself is - sum_p zeta_ip and is not stored. Rows are sorted by neighbour. Every pair
// (i,p) is present as (p,i) too, and `reverse` maps one to the other.
#pragma once

#include <cstdint>

#include "core/tensor.hpp"

namespace cleave {

// A view; Index is std::int32_t in the model, std::int64_t in array calls.
template <class Index, class Offset>
struct GradientOperator {
  const Offset* row_begin;  // (n+1)
  const Index* neighbour;   // (h)
  const Offset* reverse;    // (h)
  const double* zeta;       // (3,h) [m2] reference configuration
  const double* volume;     // (n)   Omega [m3]
};

// sum_p a_ip (x) zeta_ip of row i for a vector array a, a_ip = a_p - a_i.
template <int D, class Index, class Offset>
Mat<D> row_gradient(const GradientOperator<Index, Offset>& g, const double* a, std::int64_t i) {
  Mat<D> sum;
  for (Offset b = g.row_begin[i]; b < g.row_begin[i + 1]; ++b) {
    add_dyad(sum, difference<D>(a, i, g.neighbour[b]), load_vector<D>(g.zeta, b));
  }
  return sum;
}

// H_i = (1/Omega_i) sum_p u_ip (x) zeta_ip for first <= i < last; zero without volume.   [CBM 8]
// [in]  u (3,n) displacement [m]     [out] h (9,n) displacement gradient [1], D x D components
template <int D, class Index, class Offset>
void displacement_gradient(const GradientOperator<Index, Offset>& g, const double* u,
                           std::int64_t first, std::int64_t last, double* h) {
  for (std::int64_t i = first; i < last; ++i) {
    Mat<D> sum;
    if (g.volume[i] > 0) {
      sum = row_gradient<D>(g, u, i);
      const double inverse = 1 / g.volume[i];
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) sum(r, c) *= inverse;
    }
    store_tensor(sum, h, i);
  }
}

// f_i += P_i sum_p zeta_ip - sum_p P_p zeta_pi for first <= i < last.              [CBM 18, 19]
// The force ON particle i: minus the gradient of sum_j Omega_j W(F_j).
// [in]  p (9,n) first Piola-Kirchhoff stress [Pa]     [in,out] f (3,n) force [N]
template <int D, class Index, class Offset>
void internal_force(const GradientOperator<Index, Offset>& g, const double* p, std::int64_t first,
                    std::int64_t last, double* f) {
  for (std::int64_t i = first; i < last; ++i) {
    Vec<D> own, others;
    for (Offset b = g.row_begin[i]; b < g.row_begin[i + 1]; ++b) {
      const Vec<D> zeta = load_vector<D>(g.zeta, b);
      const Vec<D> back =
          multiply(load_tensor<D>(p, g.neighbour[b]), load_vector<D>(g.zeta, g.reverse[b]));
      for (int k = 0; k < D; ++k) {
        own[k] += zeta[k];
        others[k] += back[k];
      }
    }
    const Vec<D> pulled = multiply(load_tensor<D>(p, i), own);
    for (int k = 0; k < D; ++k) f[kVector * i + k] += pulled[k] - others[k];
  }
}

}  // namespace cleave
