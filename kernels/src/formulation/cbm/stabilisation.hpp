// Hourglass stabilisation: the averaged gradients of the Continuum Bond Method do not see some
// zone-boundary motions; the gradients of the simplices do. Off by default, as published.
//
//   deviation  V = sum_L alpha G Omega_L |F_L - Fbar_L|^2,  Fbar_L = mean of F_i over the corners.
//              Force on corner a: - S_L g_a with S_L = 2 alpha G Omega_L (F_L - Fbar_L), and for
//              every corner i the stress gains Q_i/Omega_i, Q_i = - sum_L S_L / n. Without history:
//              for any law.
//   blend      (1-alpha) sum_i Omega_i W(F_i) + alpha sum_L Omega_L W(F_L). For hyperelastic laws.
#pragma once

#include <cstdint>
#include <vector>

#include "core/thread_team.hpp"
#include "formulation/cbm/network.hpp"
#include "formulation/cbm/parameters.hpp"

namespace cleave::cbm {

class Stabilisation {
 public:
  void setup(const Body& body, const Network& network);
  bool active() const { return form_ != StabilisationForm::none; }
  StabilisationForm form() const { return form_; }
  double alpha() const { return alpha_; }
  // Factor on the stored energy and stress of the particles.
  double particle_share() const { return form_ == StabilisationForm::blend ? 1 - alpha_ : 1.0; }

  // The stress that enters the bond force; valid until the next call. Fills S_L of live simplices.
  template <int D>
  const double* bond_stress(const Body& body, const Network& network, ThreadTeam& team);
  // f_a -= S_L g_a over the live simplices of first <= a < last.
  template <int D>
  void add_force(const Network& network, std::int64_t first, std::int64_t last, double* f) const;

  // Energy of one simplex [J] for its own H and the mean of its corners', and S_L [J] if asked for.
  template <int D>
  double simplex_energy(const Body& body, double volume, const Mat<D>& simplex_h,
                        const Mat<D>& mean_h, Mat<D>* stress) const;
  template <int D>
  double energy(const Body& body, const Network& network) const;

 private:
  StabilisationForm form_ = StabilisationForm::none;
  double alpha_ = 0, shear_modulus_ = 0;
  std::vector<double> simplex_stress_;  // (9,m) S_L [J m-3 * m3]
  std::vector<double> bond_stress_;     // (9,n) [Pa]
};

// H of a simplex from a vector array.
template <int D>
Mat<D> simplex_gradient(const SimplexGeometry<D>& geometry, const std::int32_t* corners,
                        const double* a) {
  Mat<D> h;
  for (int c = 1; c <= D; ++c)
    add_dyad(h, difference<D>(a, corners[0], corners[c]), geometry.gradient[c]);
  return h;
}
// Mean of a tensor field over the corners.
template <int D>
Mat<D> corner_mean(const std::int32_t* corners, const double* h) {
  Mat<D> mean;
  for (int c = 0; c <= D; ++c) {
    const Mat<D> hc = load_tensor<D>(h, corners[c]);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) mean(i, j) += hc(i, j) / (D + 1);
  }
  return mean;
}

// Diagnostic  E_hg = sum_L Omega_L mu |F_L - mean_{i in L} F_i|^2  over live simplices [J].
template <int D>
double hourglass_energy(const Body& body, const Network& network, double shear_modulus);

}  // namespace cleave::cbm
