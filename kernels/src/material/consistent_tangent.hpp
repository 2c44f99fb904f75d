// The consistent tangent dP/dF of the return mapping, in the eigenframe of the trial metric: exact for
// repeated eigenvalues too, and independent of the eigenvectors chosen there. One point at a time.
#pragma once

#include "core/tangent.hpp"
#include "material/log_strain_plasticity.hpp"

namespace cleave {

// ln(1+x)/x, also at x = 0.
inline double log_quotient(double x) {
  if (std::fabs(x) < 1e-4) return 1 - x * (0.5 - x * (1.0 / 3 - x * 0.25));  // next term: 2e-17
  return log_one_plus(x) / x;
}

// d tau_ij / d l_kl with l = dF F^-1, and what turns it into dP/dF.
class SpectralModuli {
 public:
  // `committed` carries H and the history before the step. False where the law has no answer.
  template <class Hardening, class Bulk, int N>
  bool evaluate(const ReturnMapping<Hardening, Bulk>& law, const LanePoint<double, N>& committed,
                const Setting<double>& setting);

  double kirchhoff(int i, int j, int k, int l) const {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double ab = v(i, a) * v(j, b);
        sum += diagonal_[a][b] * v(i, a) * v(j, a) * v(k, b) * v(l, b);
        if (a != b) {
          sum +=
              shear_[a][b] * ab * (metric_[b] * v(k, a) * v(l, b) + metric_[a] * v(k, b) * v(l, a));
        }
      }
    return sum;
  }

  // A_ijkl = sum_mn ( M_imkn - tau_in delta_mk ) Finv_jm Finv_ln
  void nominal(Tangent<3>& a) const {
    double m[3][3][3][3], half[3][3][3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            m[i][j][k][l] = kirchhoff(i, j, k, l) - (j == k ? tau_[i][l] : 0.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int n = 0; n < 3; ++n)
            half[i][j][k][n] = inverse_[j][0] * m[i][0][k][n] + inverse_[j][1] * m[i][1][k][n] +
                               inverse_[j][2] * m[i][2][k][n];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            a(i, j, k, l) = inverse_[l][0] * half[i][j][k][0] + inverse_[l][1] * half[i][j][k][1] +
                            inverse_[l][2] * half[i][j][k][2];
  }

  double stress_33() const { return stress_33_; }
  // A_3333 of a plane deformation.
  double through_thickness() const {
    return (kirchhoff(2, 2, 2, 2) - tau_[2][2]) * inverse_[2][2] * inverse_[2][2];
  }

 private:
  double v(int i, int a) const { return frame_.vector[i][a]; }

  Spectral frame_;
  double diagonal_[3][3];  // d tau_a / d e_b
  double shear_[3][3];     // (tau_a - tau_b) / (b_a - b_b)
  double metric_[3];       // b_a
  double tau_[3][3], inverse_[3][3];
  double stress_33_;  // of P
};

template <class Hardening, class Bulk, int N>
bool SpectralModuli::evaluate(const ReturnMapping<Hardening, Bulk>& law,
                              const LanePoint<double, N>& committed,
                              const Setting<double>& setting) {
  LanePoint<double, N> updated = committed;
  law.update(updated, setting);
  if (!updated.valid) return false;
  stress_33_ = updated.p.zz;
  const auto c = cofactor_of(committed.h);
  const double ratio = 1 + c.volume_change;
  const Full<double>& cof = c.cofactor;
  const double cofactor[3][3] = {
      {cof.xx, cof.xy, cof.xz}, {cof.yx, cof.yy, cof.yz}, {cof.zx, cof.zy, cof.zz}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse_[i][j] = cofactor[j][i] / ratio;

  frame_ = spectral(push_forward_minus_identity(committed.h, law.metric(committed.history)));
  double d[3], sum = 0, dd = 0;
  for (int a = 0; a < 3; ++a) {
    metric_[a] = 1 + frame_.value[a];
    d[a] = log_one_plus(frame_.value[a]);
    sum += d[a];
  }
  for (double& one : d) {
    one -= sum / 3;
    dd += one * one;
  }
  const double g = law.shear_modulus();
  std::array<double, ReturnMapping<Hardening, Bulk>::kHardeningMemory> memory{};
  for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = committed.history[7 + k];
  Setting<double> here = setting;
  here.volume_ratio = ratio;
  const auto flow =
      law.template flow_of<double>(committed.history[6], memory, here, g * std::sqrt(1.5 * dd));

  std::array<double, ReturnMapping<Hardening, Bulk>::kBulkMemory> bulk_memory{};
  for (std::size_t k = 0; k < bulk_memory.size(); ++k)
    bulk_memory[k] = committed.history[7 + memory.size() + k];
  Volume<double> volume{0.5 * sum, c.volume_change, ratio, 0.25 * g * flow.theta * flow.theta * dd,
                        flow.work};
  if constexpr (Hardening::kFails) volume.failed = law.hardening().failed(memory);
  const double modulus = law.bulk().modulus(volume, bulk_memory, here);
  const double mean = law.bulk().respond(volume, bulk_memory, here).stress;

  const double turn =
      flow.active && dd > 0 ? 2 * g * (1 / (1 + flow.slope / (3 * g)) - flow.removed) / dd : 0.0;
  // Of the deviator with ln J, by the factor J of the yield stress.
  const double swell =
      Hardening::kCauchy && flow.active ? flow.theta * g / (1 + flow.slope / (3 * g)) : 0.0;
  double principal[3];
  for (int a = 0; a < 3; ++a) {
    principal[a] = mean + flow.theta * g * d[a];
    for (int b = 0; b < 3; ++b) {
      diagonal_[a][b] = modulus + 2 * g * flow.theta * ((a == b ? 1.0 : 0.0) - 1.0 / 3) -
                        turn * d[a] * d[b] + swell * d[a];
      const double x = (frame_.value[a] - frame_.value[b]) / metric_[b];
      shear_[a][b] = g * flow.theta * log_quotient(x) / metric_[b];
    }
  }
  const Symmetric<double> tau = assemble(frame_, principal);
  const double components[3][3] = {
      {tau.xx, tau.xy, tau.zx}, {tau.xy, tau.yy, tau.yz}, {tau.zx, tau.yz, tau.zz}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) tau_[i][j] = components[i][j];
  return true;
}

}  // namespace cleave
