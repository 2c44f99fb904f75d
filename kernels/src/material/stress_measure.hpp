// From the first Piola-Kirchhoff stress and its derivative to what host codes keep: Cauchy stress in
// fixed or corotated axes, Kirchhoff, second Piola-Kirchhoff, and the tangents that go with them.
// Conversion only; the laws know none of this. All in three dimensions, for det F > 0.
#pragma once

#include <cmath>

#include "cleave/cleave.h"
#include "core/tangent.hpp"
#include "core/tensor.hpp"

namespace cleave {

// R of F = R U by Newton's iteration R <- (R + R^-T)/2, which converges quadratically for det F > 0.
inline Mat<3> rotation_of(const Mat<3>& f) {
  Mat<3> r = f;
  double change = 1;
  // Halves every principal stretch far from one, so a hundred do for any F; the step after a change of
  // 1e-8 has the last bits.
  for (int k = 0; k < 100 && change > 0; ++k) {
    const bool last = change < 1e-8;
    const Mat<3> cof = cofactor(r);
    const double inverse = 1 / determinant(r);
    change = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double mean = 0.5 * (r(i, j) + cof(i, j) * inverse);
        change = std::fmax(change, std::fabs(mean - r(i, j)));
        r(i, j) = mean;
      }
    if (last) break;
  }
  return r;
}

inline Mat<3> transpose(const Mat<3>& a) {
  Mat<3> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = a(j, i);
  return t;
}

// Rounding, and laws that are not objective, leave a skew part: the mean of both sides is handed out.
inline Mat<3> symmetric_part(const Mat<3>& a) {
  Mat<3> s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s(i, j) = 0.5 * (a(i, j) + a(j, i));
  return s;
}

// tau = P F^T, sigma = tau / J, R^T sigma R, S = F^-1 P.
inline Mat<3> convert_stress(cleave_stress_measure measure, const Mat<3>& p, const Mat<3>& f) {
  if (measure == CLEAVE_STRESS_FIRST_PIOLA) return p;
  const double inverse = 1 / determinant(f);
  Mat<3> s;
  if (measure == CLEAVE_STRESS_SECOND_PIOLA) {
    s = multiply(transpose(cofactor(f)), p);
  } else {
    s = multiply(p, transpose(f));
  }
  if (measure == CLEAVE_STRESS_COROTATED) {
    const Mat<3> r = rotation_of(f);
    s = multiply(transpose(r), multiply(symmetric_part(s), r));
  }
  if (measure != CLEAVE_STRESS_KIRCHHOFF)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) s(i, j) *= inverse;
  return symmetric_part(s);
}

// Both pairs of indices made symmetric, to the last bit: each sum has the same terms in pairs.
inline Tangent<3> minor_symmetric(const Tangent<3>& a) {
  Tangent<3> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          t(i, j, k, l) =
              0.25 * ((a(i, j, k, l) + a(j, i, k, l)) + (a(i, j, l, k) + a(j, i, l, k)));
  return t;
}

// C_ijkl = sum_ab M_ai M_bk A_ajbl
inline Tangent<3> transform_first_and_third(const Tangent<3>& a, const Mat<3>& m) {
  Tangent<3> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          for (int r = 0; r < 3; ++r)
            for (int s = 0; s < 3; ++s) t(i, j, k, l) += m(r, i) * m(s, k) * a(r, j, s, l);
  return t;
}
// C_ijkl = sum_ab M_aj M_bl A_iakb
inline Tangent<3> transform_second_and_fourth(const Tangent<3>& a, const Mat<3>& m) {
  Tangent<3> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          for (int r = 0; r < 3; ++r)
            for (int s = 0; s < 3; ++s) t(i, j, k, l) += m(r, j) * m(s, l) * a(i, r, k, s);
  return t;
}

// From A = dP/dF, with P and F of the same point. With g_ijkl = A pushed forward on its second and
// fourth index over J, the rate of tau over J is
//   Truesdell  c_ijkl = g_ijkl - delta_ik sigma_jl
//   Jaumann    c_ijkl + (delta_ik sigma_jl + delta_jk sigma_il + delta_il sigma_jk + delta_jl sigma_ik)/2
// and dS/dE is (A_ijkl - delta_ik S_jl) pulled back by F^-1 on its first and third.
inline Tangent<3> convert_tangent(cleave_tangent_measure measure, const Tangent<3>& a,
                                  const Mat<3>& p, const Mat<3>& f) {
  if (measure == CLEAVE_TANGENT_FIRST_PIOLA) return a;
  const double inverse = 1 / determinant(f);
  if (measure == CLEAVE_TANGENT_SECOND_PIOLA) {
    const Mat<3> s = convert_stress(CLEAVE_STRESS_SECOND_PIOLA, p, f);
    Mat<3> f_inverse = transpose(cofactor(f));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) f_inverse(i, j) *= inverse;
    Tangent<3> material = a;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) material(i, j, i, l) -= s(j, l);
    return minor_symmetric(transform_first_and_third(material, transpose(f_inverse)));
  }
  const Mat<3> sigma = convert_stress(CLEAVE_STRESS_CAUCHY, p, f);
  Tangent<3> c = transform_second_and_fourth(a, transpose(f));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          c(i, j, k, l) *= inverse;
          if (i == k) c(i, j, k, l) += -sigma(j, l) + 0.5 * sigma(j, l);
          if (j == k) c(i, j, k, l) += 0.5 * sigma(i, l);
          if (i == l) c(i, j, k, l) += 0.5 * sigma(j, k);
          if (j == l) c(i, j, k, l) += 0.5 * sigma(i, k);
        }
  c = minor_symmetric(c);
  if (measure == CLEAVE_TANGENT_JAUMANN) return c;
  const Mat<3> r = rotation_of(f);
  return minor_symmetric(transform_second_and_fourth(transform_first_and_third(c, r), r));
}

}  // namespace cleave
