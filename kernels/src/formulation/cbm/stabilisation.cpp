#include "formulation/cbm/stabilisation.hpp"

namespace cleave::cbm {

namespace {

template <int D>
Mat<D> deviation_of(const Mat<D>& simplex_h, const Mat<D>& mean_h) {
  Mat<D> d;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) d(i, j) = simplex_h(i, j) - mean_h(i, j);
  return d;
}

// f(s, corners, geometry) over the live simplices, in order.
template <int D, class F>
void for_live(const Network& network, std::int64_t first, std::int64_t last, const F& f) {
  for (std::int64_t s = first; s < last; ++s) {
    if (network.alive[s] == 0) continue;
    const std::int32_t* corners = network.corners + Network::kStride * s;
    f(s, corners, simplex_geometry<D>(network.X, corners));
  }
}

}  // namespace

void Stabilisation::setup(const Body& body, const Network& network) {
  const ParameterSet& options = body.group("stabilisation");
  form_ = options.any_given() ? static_cast<StabilisationForm>(options.choice("form"))
                              : StabilisationForm::none;
  alpha_ = options.real("alpha");
  if (alpha_ == 0) form_ = StabilisationForm::none;
  shear_modulus_ = with_law(body.material, [](const auto& law) { return law.shear_modulus(); });
  if (form_ == StabilisationForm::blend && !body.law->history.empty()) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(), ": stabilisation form 'blend' needs a law without history, not ",
                     body.law->name, "; use 'deviation'"));
  }
  if (form_ == StabilisationForm::deviation && !(shear_modulus_ > 0)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(),
                     ": stabilisation form 'deviation' is scaled by the shear modulus, "
                     "which is 0 for law ",
                     body.law->name, "; leave the group stabilisation out"));
  }
  if (active()) {
    simplex_stress_.assign(static_cast<std::size_t>(kTensor * network.simplices), 0.0);
    bond_stress_.assign(static_cast<std::size_t>(kTensor * body.particles), 0.0);
  }
}

template <int D>
double Stabilisation::simplex_energy(const Body& body, double volume, const Mat<D>& simplex_h,
                                     const Mat<D>& mean_h, Mat<D>* stress) const {
  Mat<D> s;
  double energy = 0, scale = 0;
  if (form_ == StabilisationForm::deviation) {
    s = deviation_of(simplex_h, mean_h);
    scale = 2 * alpha_ * shear_modulus_ * volume;
    energy = 0.5 * scale * contract(s, s);
  } else {
    const auto r = with_law(body.material, [&](const auto& law) {
      return law.respond(simplex_h, History{}, Increment{});
    });
    s = r.stress;
    scale = alpha_ * volume;
    energy = scale * r.energy;
  }
  if (stress != nullptr) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) (*stress)(i, j) = scale * s(i, j);
  }
  return energy;
}

template <int D>
const double* Stabilisation::bond_stress(const Body& body, const Network& network,
                                         ThreadTeam& team) {
  for_blocks(team, network.simplices, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for_live<D>(network, first, last,
                [&](std::int64_t s, const std::int32_t* corners, const auto& geometry) {
                  Mat<D> stress;
                  simplex_energy<D>(body, geometry.volume,
                                    simplex_gradient(geometry, corners, body.point.u),
                                    corner_mean<D>(corners, body.point.h), &stress);
                  store_tensor(stress, simplex_stress_.data(), s);
                });
  });
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      Mat<D> sum = load_tensor<D>(body.point.p, i);
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) sum(r, c) *= particle_share();
      if (form_ == StabilisationForm::deviation && network.volume[i] > 0) {
        const double scale = 1 / ((D + 1) * network.volume[i]);
        for (auto k = network.incidence.begin[static_cast<std::size_t>(i)];
             k < network.incidence.begin[static_cast<std::size_t>(i + 1)]; ++k) {
          const std::int32_t s = network.incidence.simplex[static_cast<std::size_t>(k)];
          if (network.alive[s] == 0) continue;
          const Mat<D> stress = load_tensor<D>(simplex_stress_.data(), s);
          for (int r = 0; r < D; ++r)
            for (int c = 0; c < D; ++c) sum(r, c) -= scale * stress(r, c);
        }
      }
      store_tensor(sum, bond_stress_.data(), i);
    }
  });
  return bond_stress_.data();
}

template <int D>
void Stabilisation::add_force(const Network& network, std::int64_t first, std::int64_t last,
                              double* f) const {
  for (std::int64_t i = first; i < last; ++i) {
    Vec<D> sum;
    for (auto k = network.incidence.begin[static_cast<std::size_t>(i)];
         k < network.incidence.begin[static_cast<std::size_t>(i + 1)]; ++k) {
      const std::int64_t simplex = network.incidence.simplex[static_cast<std::size_t>(k)];
      for_live<D>(network, simplex, simplex + 1,
                  [&](std::int64_t s, const std::int32_t* corners, const auto& geometry) {
                    for (int a = 0; a <= D; ++a) {
                      if (corners[a] != i) continue;
                      const Vec<D> pull =
                          multiply(load_tensor<D>(simplex_stress_.data(), s), geometry.gradient[a]);
                      for (int c = 0; c < D; ++c) sum[c] -= pull[c];
                    }
                  });
    }
    for (int c = 0; c < D; ++c) f[kVector * i + c] += sum[c];
  }
}

template <int D>
double Stabilisation::energy(const Body& body, const Network& network) const {
  double sum = 0;
  if (!active()) return sum;
  for_live<D>(network, 0, network.simplices,
              [&](std::int64_t, const std::int32_t* corners, const auto& geometry) {
                sum += simplex_energy<D>(body, geometry.volume,
                                         simplex_gradient(geometry, corners, body.point.u),
                                         corner_mean<D>(corners, body.point.h), nullptr);
              });
  return sum;
}

template <int D>
double hourglass_energy(const Body& body, const Network& network, double shear_modulus) {
  double sum = 0;
  for_live<D>(network, 0, network.simplices,
              [&](std::int64_t, const std::int32_t* corners, const auto& geometry) {
                const Mat<D> d = deviation_of(simplex_gradient(geometry, corners, body.point.u),
                                              corner_mean<D>(corners, body.point.h));
                sum += geometry.volume * shear_modulus * contract(d, d);
              });
  return sum;
}

#define CLEAVE_INSTANTIATE(D)                                                                     \
  template const double* Stabilisation::bond_stress<D>(const Body&, const Network&, ThreadTeam&); \
  template void Stabilisation::add_force<D>(const Network&, std::int64_t, std::int64_t, double*)  \
      const;                                                                                      \
  template double Stabilisation::simplex_energy<D>(const Body&, double, const Mat<D>&,            \
                                                   const Mat<D>&, Mat<D>*) const;                 \
  template double Stabilisation::energy<D>(const Body&, const Network&) const;                    \
  template double hourglass_energy<D>(const Body&, const Network&, double);
CLEAVE_INSTANTIATE(2)
CLEAVE_INSTANTIATE(3)
#undef CLEAVE_INSTANTIATE

}  // namespace cleave::cbm
