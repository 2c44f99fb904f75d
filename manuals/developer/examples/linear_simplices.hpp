// Linear triangles and tetrahedra: the stress is evaluated once per simplex. The smallest complete
// formulation; without bonds and fracture, and for laws without history. Not part of the library.
#pragma once

#include <algorithm>
#include <vector>

#include "core/blocks.hpp"
#include "core/error.hpp"
#include "formulation/common/simplices.hpp"
#include "model/body.hpp"
#include "model/formulation.hpp"

namespace cleave {

class LinearSimplices final : public Formulation {
 public:
  const char* name() const override { return "linear_simplices"; }

  // Masses, and everything that never changes.
  void setup(Body& body, ThreadTeam&) override {
    if (!body.law->history.empty()) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(body.label(), ": linear_simplices takes laws without history, not ",
                       body.law->name));
    }
    corners_.assign(body.given_simplices.begin(), body.given_simplices.end());
    const int corners = body.dimension() + 1;
    const auto count = static_cast<std::int64_t>(corners_.size()) / corners;
    incidence_ = make_incidence(body.particles, count, corners_.data(), corners, corners);
    stress_.assign(static_cast<std::size_t>(kTensor * count), 0.0);
    energy_.assign(static_cast<std::size_t>(count), 0.0);
    const double density = with_law(body.material, [](const auto& law) { return law.density(); });
    for (std::int64_t s = 0; s < count; ++s) {
      const double volume =
          body.dimension() == 2 ? geometry<2>(body, s).volume : geometry<3>(body, s).volume;
      for (int a = 0; a < corners; ++a)
        body.point.mass[corner(s, a, corners)] += density * volume / corners;
    }
  }

  void rebuild(Body& body, ThreadTeam& team) override { deform(body, {}, team); }

  void deform(Body& body, const Clock&, ThreadTeam& team) override {
    body.dimension() == 2 ? stresses<2>(body, team) : stresses<3>(body, team);
  }
  void forces(Body& body, ThreadTeam& team) override {
    body.dimension() == 2 ? gather<2>(body, team) : gather<3>(body, team);
  }

  // The shortest height of a simplex over the wave speed is safe for linear elements.
  double stable_step(const Body& body) const override {
    const double speed = with_law(body.material, [](const auto& law) { return law.wave_speed(); });
    double steepest = 0;
    for (std::int64_t s = 0; s < count(); ++s) {
      steepest = std::max(steepest, body.dimension() == 2 ? steepest_gradient<2>(body, s)
                                                          : steepest_gradient<3>(body, s));
    }
    return 0.9 / (steepest * speed);
  }

  StoredEnergy stored_energy(const Body& body) const override {
    StoredEnergy sum;
    for (std::int64_t s = 0; s < count(); ++s) {
      sum.elastic +=
          energy_[static_cast<std::size_t>(s)] *
          (body.dimension() == 2 ? geometry<2>(body, s).volume : geometry<3>(body, s).volume);
    }
    return sum;
  }

  void count(const Body&, cleave_counts& counts) const override { counts.simplices += count(); }

  // What this formulation does not have.
  bool break_bonds(Body&, const Clock&, ThreadTeam&) override { return false; }
  void precrack(Body& body, std::span<const std::int64_t>) override {
    throw Error(CLEAVE_UNSUPPORTED, text(body.label(), ": linear_simplices has no bonds to break"));
  }
  double hourglass_energy(const Body&) const override { return 0; }
  bool derive(const Body&, std::string_view, std::int64_t, std::int64_t, double*) const override {
    return false;
  }
  std::int64_t bytes() const override {
    return static_cast<std::int64_t>(8 * (stress_.size() + energy_.size()));
  }

 private:
  std::int64_t count() const { return static_cast<std::int64_t>(energy_.size()); }
  std::int64_t corner(std::int64_t s, int a, int corners) const {
    return corners_[static_cast<std::size_t>(corners * s + a)];
  }
  template <int D>
  SimplexGeometry<D> geometry(const Body& body, std::int64_t s) const {
    return simplex_geometry<D>(body.point.X, corners_.data() + (D + 1) * s);
  }
  template <int D>
  double steepest_gradient(const Body& body, std::int64_t s) const {
    double steepest = 0;
    for (const Vec<D>& g : geometry<D>(body, s).gradient)
      steepest = std::max(steepest, std::sqrt(dot(g, g)));
    return steepest;
  }

  // F_L and P(F_L) of every simplex.
  template <int D>
  void stresses(Body& body, ThreadTeam& team) {
    with_law(body.material, [&](const auto& law) {
      for_blocks(team, count(), [&](std::int64_t, std::int64_t first, std::int64_t last) {
        for (std::int64_t s = first; s < last; ++s) {
          const auto shape = geometry<D>(body, s);
          Mat<D> h;
          for (int a = 1; a <= D; ++a) {
            add_dyad(h, difference<D>(body.point.u, corner(s, 0, D + 1), corner(s, a, D + 1)),
                     shape.gradient[a]);
          }
          const Response<Mat<D>> r = law.respond(h, History{}, Increment{});
          store_tensor(r.stress, stress_.data(), s);
          energy_[static_cast<std::size_t>(s)] = r.energy;
        }
      });
    });
  }

  // f_i = - sum over simplices of Omega_L P_L g_i, gathered so that a particle's sum has one order.
  template <int D>
  void gather(Body& body, ThreadTeam& team) {
    for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i) {
        Vec<D> force;
        for (auto k = incidence_.begin[static_cast<std::size_t>(i)];
             k < incidence_.begin[static_cast<std::size_t>(i) + 1]; ++k) {
          const std::int64_t s = incidence_.simplex[static_cast<std::size_t>(k)];
          const auto shape = geometry<D>(body, s);
          for (int a = 0; a <= D; ++a) {
            if (corner(s, a, D + 1) != i) continue;
            const Vec<D> pull = multiply(load_tensor<D>(stress_.data(), s), shape.gradient[a]);
            for (int c = 0; c < D; ++c) force[c] -= shape.volume * pull[c];
          }
        }
        for (int c = 0; c < D; ++c) body.point.internal[kVector * i + c] = force[c];
      }
    });
  }

  std::vector<std::int64_t> corners_;
  Incidence incidence_;
  std::vector<double> stress_, energy_;  // (9,m) [Pa], (m) [J m-3]
};

}  // namespace cleave
