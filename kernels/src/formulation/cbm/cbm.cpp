#include "formulation/cbm/cbm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gradient_operator.hpp"
#include "formulation/common/unused_groups.hpp"
#include "model/stiffness_bound.hpp"

namespace cleave::cbm {

namespace {

// dt <= kSafety (l/c0) / (1 + 2.5 beta): below every measured limit 2/omega_max of regular and
// jittered patches, with the viscosity lagged by half a step. c0 is the plane-wave (plate) speed, l
// the shortest edge or, where flat simplices at the surface make a particle light, less.
constexpr double kSafety = 0.9;
// omega_max^2 = k c0^2 max_i (stiffness of i / mass of i): k is measured 1.0 to 1.14 at flat simplices
// of the surface, and up to 1.9 in regular meshes, where the shortest edge is the smaller length.
constexpr double kCoupling = 1.2;
constexpr double kViscousReduction = 2.5;
// The viscous pressure grows with its length: from kLongLength shortest edges on, beta counts in
// proportion. Measured limit over this rule: 1.07 and more for beta up to 2 and any length; without
// it, lengths from 5 edges on are unstable.
constexpr double kLongLength = 1.75;

double wave_speed(const Body& body) {
  return with_law(body.material, [](const auto& law) { return law.wave_speed(); });
}

// Of the intact body: D_i = (1/Omega_i) sum_j |zeta_ji|^2/Omega_j, zeta_ii = - sum_p zeta_ip: the diagonal
// of M^-1 K over c0^2 for an isotropic stiffness; and the shortest bond.
struct Extremes {
  double stiffness = 0, length = std::numeric_limits<double>::infinity();
};

template <int D>
Extremes extremes(const Network& network, std::int64_t particles, ThreadTeam& team) {
  std::vector<Extremes> partial(static_cast<std::size_t>(block_count(particles)));
  const auto row_size = static_cast<std::size_t>(kVector * network.longest_row());
  for_blocks(team, particles, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    std::vector<double> zeta(row_size), back(row_size);
    Extremes& e = partial[static_cast<std::size_t>(block)];
    for (std::int64_t i = first; i < last; ++i) {
      const double volume = network.form_row<D>(i, zeta.data(), back.data());
      Vec<D> own;
      double sum = 0;
      std::int64_t b = 0;
      for (const std::int32_t p : network.neighbours(i)) {
        const Vec<D> other = load_vector<D>(back.data(), b);
        sum += dot(other, other) / network.volume[p];
        for (int k = 0; k < D; ++k) own[k] += load_vector<D>(zeta.data(), b)[k];
        if (p > i) e.length = std::fmin(e.length, network.length(i, p));
        ++b;
      }
      e.stiffness = std::fmax(e.stiffness, (sum + dot(own, own) / volume) / volume);
    }
  });
  Extremes all;
  for (const Extremes& e : partial) {
    all.stiffness = std::fmax(all.stiffness, e.stiffness);
    all.length = std::fmin(all.length, e.length);
  }
  return all;
}

}  // namespace

void ContinuumBondMethod::setup(Body& body, ThreadTeam& team) {
  refuse_group(body, "kernel", "it belongs to formulations tlsph and nosb");
  refuse_group(body, "hourglass", "it belongs to tlsph and nosb; here it is group stabilisation");
  refuse_group(body, "peridynamics", "it belongs to formulations bond_pd, cpd and lps");
  refuse_group(body, "cpd", "it belongs to formulation cpd");
  refuse_group(body, "vcpm", "it belongs to formulation vcpm");
  if (body.simplex_nodes != body.dimension() + 1) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(), ": cbm takes simplices of ", body.dimension() + 1,
                     " particles, not of ", body.simplex_nodes, "; use a mesh of first order"));
  }
  network_.build(body, team);
  const double density = with_law(body.material, [](const auto& law) { return law.density(); });
  for (std::int64_t i = 0; i < body.particles; ++i)
    body.point.mass[i] = density * network_.volume[i];
  const Extremes intact = body.dimension() == 2 ? extremes<2>(network_, body.particles, team)
                                                : extremes<3>(network_, body.particles, team);
  shortest_ = intact.length;
  stable_length_ = std::fmin(shortest_, 2 / std::sqrt(kCoupling * intact.stiffness));
  setup_viscosity(body);
  stabilisation_.setup(body, network_);
  fracture_.setup(body, network_);
  points_.setup(body);
  setup_blocks(body, team);
}

void ContinuumBondMethod::setup_blocks(const Body& body, ThreadTeam& team) {
  blocks_.reset();
  const bool in_block = !stabilisation_.active() &&
                        (viscosity_ == ViscosityForm::none || viscosity_ == ViscosityForm::frozen);
  if (!body.by_rows && in_block) {
    blocks_ = std::make_unique<BlockStep>(BlockStep::Parts{
        network_, stabilisation_, fracture_, points_,
        viscosity_ == ViscosityForm::none ? nullptr : &bond_rate_, local_lengths_});
    if (!blocks_->setup(body, team)) blocks_.reset();
  }
  if (blocks_ == nullptr) keep_rows(team);
}

void ContinuumBondMethod::keep_rows(ThreadTeam& team) {
  network_.keep_rows(team);
  operator_ = network_.gradient();
  if (!local_lengths_) return;
  bond_rate_.lengths = network_.lengths();
  bond_rate_.bond_of_half = network_.bond_of_half();
}

const GradientOperator* ContinuumBondMethod::gradient_operator(ThreadTeam& team) {
  keep_rows(team);
  return &operator_;
}

void ContinuumBondMethod::setup_viscosity(const Body& body) {
  const ParameterSet& options = body.group("viscosity");
  bond_rate_ = {};
  local_lengths_ = false;
  viscosity_ = options.any_given() ? static_cast<ViscosityForm>(options.choice("form"))
                                   : ViscosityForm::none;
  beta_ = options.real("beta");
  if (beta_ == 0) viscosity_ = ViscosityForm::none;
  if (viscosity_ == ViscosityForm::none) {
    beta_ = 0;
    return;
  }
  const double density = with_law(body.material, [](const auto& law) { return law.density(); });
  bond_rate_.beta_rho_c = beta_ * density * wave_speed(body);
  local_lengths_ = options.choice("length_mode") == static_cast<int>(LengthMode::local);
  if (!local_lengths_) {
    bond_rate_.length = options.real("length");
    if (bond_rate_.length == 0) {
      throw Error(
          CLEAVE_MISSING_PARAMETER,
          text("group viscosity of ", body.label(),
               " needs length > 0 (the spacing of the refined region), or length_mode 'local'"));
    }
  }
}

void ContinuumBondMethod::rebuild(Body& body, ThreadTeam& team) {
  network_.rebuild(team);
  if (network_.keeps_rows()) points_.gradients(body, operator_, team);
}

double ContinuumBondMethod::stable_step(const Body& body) const {
  const double longer = std::fmax(1.0, bond_rate_.length / (kLongLength * shortest_));
  return kSafety * stable_length_ / wave_speed(body) / (1 + kViscousReduction * beta_ * longer);
}

std::string ContinuumBondMethod::static_obstacle(const Body&) const {
  if (stabilisation_.active())
    return "it has no tangent of the stabilisation; leave it off, or use relaxation";
  if (fracture_.active())
    return "bonds may not break in it; leave &fracture out, or use relaxation";
  return "";
}

bool ContinuumBondMethod::break_bonds(Body& body, const Clock& clock, ThreadTeam& team) {
  const std::size_t before = body.events.size();
  fracture_.step(body, network_, stabilisation_, clock, team);
  return body.events.size() > before;
}

bool ContinuumBondMethod::break_most_critical(Body& body, const Clock& clock, ThreadTeam& team,
                                              Breaking which) {
  fracture_.step_some(body, network_, stabilisation_, clock, team, which);
  return true;
}

void ContinuumBondMethod::precrack(Body& body, std::span<const std::int64_t> pairs) {
  if (blocks_ != nullptr) {
    blocks_->fetch(body, {});
    blocks_->changed({});
  }
  fracture_.precrack(body, network_, pairs);
}

// The stable step knows the stabilisation, the rows do not.
void ContinuumBondMethod::stiffness_bound(const Body& body, ThreadTeam& team,
                                          std::span<double> bound) {
  if (stabilisation_.active()) return Formulation::stiffness_bound(body, team, bound);
  add_row_sums(body, *gradient_operator(team), bound);
}

void ContinuumBondMethod::deform(Body& body, const Clock& clock, ThreadTeam& team) {
  points_.deform(body, operator_, clock, team);
}

template <int D>
void ContinuumBondMethod::forces_in(Body& body, ThreadTeam& team) {
  const PointArrays& pt = body.point;
  const ViscousArrays viscous{network_.weights(), pt.x, pt.v, pt.h, pt.ratio, pt.viscous};
  const double* stress =
      stabilisation_.active() ? stabilisation_.bond_stress<D>(body, network_, team) : body.point.p;
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    std::fill(body.point.internal + kVector * first, body.point.internal + kVector * last, 0.0);
    std::fill(body.point.viscous + kVector * first, body.point.viscous + kVector * last, 0.0);
    internal_force<D>(operator_, stress, first, last, body.point.internal);
    if (stabilisation_.active())
      stabilisation_.add_force<D>(network_, first, last, body.point.internal);
    viscous_force<D>(viscosity_, operator_, bond_rate_, viscous, first, last);
  });
}

void ContinuumBondMethod::forces(Body& body, ThreadTeam& team) {
  body.dimension() == 2 ? forces_in<2>(body, team) : forces_in<3>(body, team);
}

StoredEnergy ContinuumBondMethod::stored_energy(const Body& body) const {
  StoredEnergy e;
  e.elastic = points_.stored_energy(body) * stabilisation_.particle_share();
  e.stabilisation = body.dimension() == 2 ? stabilisation_.energy<2>(body, network_)
                                          : stabilisation_.energy<3>(body, network_);
  return e;
}

double ContinuumBondMethod::hourglass_energy(const Body& body) const {
  const double mu = with_law(body.material, [](const auto& law) { return law.shear_modulus(); });
  return body.dimension() == 2 ? cbm::hourglass_energy<2>(body, network_, mu)
                               : cbm::hourglass_energy<3>(body, network_, mu);
}

void ContinuumBondMethod::count(const Body& body, cleave_counts& counts) const {
  counts.bonds += network_.bonds;
  counts.simplices += network_.simplices;
  counts.broken += std::count(network_.status, network_.status + network_.bonds, kBroken);
  counts.inert += std::count(network_.status, network_.status + network_.bonds, kInert);
  counts.isolated += std::count_if(network_.volume, network_.volume + body.particles,
                                   [](double volume) { return !(volume > 0); });
  counts.inverted += points_.inverted(body);
}

bool ContinuumBondMethod::derive(const Body& body, std::string_view field, std::int64_t first,
                                 std::int64_t last, double* values) const {
  if (field == "bond_length") {
    network_.copy_lengths(first, last, values);
  } else if (field == "bond_vector") {
    network_.copy_vectors(first, last, values);
  } else if (field == "bond_weight") {
    network_.copy_weights(first, last, values);
  } else if (field == "damage") {
    const double density = with_law(body.material, [](const auto& law) { return law.density(); });
    for (std::int64_t i = first; i < last; ++i) {
      // Rounding of mass = rho Omega(0) must not show as damage of an intact particle.
      const double intact = body.point.mass[i] / density;
      const double damage = 1 - network_.volume[i] / intact;
      values[i - first] = std::fabs(damage) < 1e-14 ? 0.0 : damage;
    }
  } else {
    return false;
  }
  return true;
}

bool ContinuumBondMethod::derive_integers(const Body&, std::string_view field, std::int64_t first,
                                          std::int64_t last, std::int64_t* values) const {
  if (field != "bond_ends") return false;
  network_.copy_ends(first, last, values);
  return true;
}

std::int64_t ContinuumBondMethod::bytes() const {
  return network_.bytes() + (blocks_ == nullptr ? 0 : blocks_->bytes());
}

}  // namespace cleave::cbm
