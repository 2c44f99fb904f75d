#include "formulation/meshless/formulation.hpp"

#include <algorithm>
#include <cmath>

#include "formulation/common/unused_groups.hpp"
#include "formulation/meshless/stable_step.hpp"
#include "formulation/tlsph/kernel.hpp"
#include "model/stiffness_bound.hpp"

namespace cleave::meshless {

double KernelMethod::kernel_radius(const Body& body) {
  const ParameterSet& options = body.group("kernel");
  const double radius = options.real("radius");
  if (!(radius > 0)) {
    throw Error(CLEAVE_MISSING_PARAMETER,
                text("group kernel of ", body.label(), " needs radius > 0 for formulation ",
                     body.formulation->name(), ": usually 3 times the particle spacing"));
  }
  const bool kernel = options.choice("radius_meaning") == static_cast<int>(RadiusMeaning::kernel);
  return kernel ? radius : radius / tlsph::CubicSpline::kSupport;
}

void KernelMethod::setup(Body& body, ThreadTeam&) {
  if (body.group("fracture").choice("criterion") != static_cast<int>(cbm::Criterion::none)) {
    refuse_group(body, "fracture", "bonds break in formulation cbm only");
  }
  refuse_group(body, "stabilisation", "the penalty of this method is group hourglass");
  refuse_group(body, "peridynamics", "it belongs to formulations bond_pd, cpd and lps");
  refuse_group(body, "cpd", "it belongs to formulation cpd");
  refuse_group(body, "vcpm", "it belongs to formulation vcpm");
  const Kernel kernel = make_kernel(body);
  gradient_.build(body, kernel);
  operator_ = gradient_.gradient();
  const double density = with_law(body.material, [](const auto& law) { return law.density(); });
  for (std::int64_t i = 0; i < body.particles; ++i)
    body.point.mass[i] = density * gradient_.volume[i];
  hourglass_.setup(body, gradient_, kernel);
  const std::vector<double> weight = setup_viscosity(body);
  points_.setup(body);
  power_.resize(body.particles);
  stable_step_ = stable_step_of(largest_rates(body, operator_, hourglass_, bond_rate_, weight));
  if (viscosity_ == ViscosityForm::frozen) bond_weight_ = weight;
}

// Returns the weights of the bonds, none without viscosity.
std::vector<double> KernelMethod::setup_viscosity(const Body& body) {
  const ParameterSet& options = body.group("viscosity");
  const double beta = options.real("beta");
  viscosity_ = options.any_given() && beta > 0 ? static_cast<ViscosityForm>(options.choice("form"))
                                               : ViscosityForm::none;
  bond_rate_ = {};
  bond_weight_.clear();
  if (viscosity_ == ViscosityForm::none) return {};
  if (options.choice("length_mode") == static_cast<int>(LengthMode::local)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group viscosity of ", body.label(),
                     ": length_mode 'local' takes the length "
                     "of each bond, which for formulation ",
                     body.formulation->name(),
                     " is that of the kernel; use 'constant' and the particle spacing as length"));
  }
  bond_rate_.length = options.real("length");
  if (bond_rate_.length == 0) {
    throw Error(CLEAVE_MISSING_PARAMETER, text("group viscosity of ", body.label(),
                                               " needs length > 0: the particle spacing"));
  }
  const double density = with_law(body.material, [](const auto& law) { return law.density(); });
  const double speed = with_law(body.material, [](const auto& law) { return law.wave_speed(); });
  bond_rate_.beta_rho_c = beta * density * speed;
  return gradient_.bond_weights();
}

void KernelMethod::rebuild(Body& body, ThreadTeam& team) {
  gradient_.rebuild(body, team);
  points_.gradients(body, operator_, team);
}

std::string KernelMethod::static_obstacle(const Body&) const {
  return hourglass_.active()
             ? "it has no tangent of the hourglass penalty; leave &hourglass out, or use "
               "relaxation"
             : "";
}

std::string KernelMethod::relaxation_obstacle(const Body&) const {
  return hourglass_.has_energy() ? ""
                                 : "the projected hourglass penalty stores no energy, only works "
                                   "along a motion; use form 'conservative' in &hourglass";
}

// The stable step knows the penalty, the rows do not.
void KernelMethod::stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound) {
  if (hourglass_.active()) return Formulation::stiffness_bound(body, team, bound);
  add_row_sums(body, operator_, bound);
}

void KernelMethod::deform(Body& body, const Clock& clock, ThreadTeam& team) {
  dt_ = clock.dt;
  points_.deform(body, operator_, clock, team);
}

template <int D>
void KernelMethod::forces_in(Body& body, ThreadTeam& team) {
  const PointArrays& pt = body.point;
  const ViscousArrays viscous{bond_weight_.data(), pt.x, pt.v, pt.h, pt.ratio, pt.viscous};
  for_blocks(team, body.particles, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    double* internal = body.point.internal;
    std::fill(internal + kVector * first, internal + kVector * last, 0.0);
    std::fill(body.point.viscous + kVector * first, body.point.viscous + kVector * last, 0.0);
    internal_force<D>(operator_, body.point.p, first, last, internal);
    power_[block] = {hourglass_.active() ? hourglass_.add_force<D>(body, operator_, first, last)
                                         : 0.0};
    viscous_force<D>(viscosity_, operator_, bond_rate_, viscous, first, last);
  });
  hourglass_.book(power_.total()[0], dt_);
}

void KernelMethod::forces(Body& body, ThreadTeam& team) {
  body.dimension() == 2 ? forces_in<2>(body, team) : forces_in<3>(body, team);
}

void KernelMethod::precrack(Body& body, std::span<const std::int64_t>) {
  throw Error(CLEAVE_UNSUPPORTED,
              text(body.label(), ": formulation ", name(),
                   " has no bonds that can be cut; use cbm, or leave the crack out of the mesh"));
}

StoredEnergy KernelMethod::stored_energy(const Body& body) const {
  return {points_.stored_energy(body), hourglass_.energy(body, operator_)};
}

double KernelMethod::hourglass_energy(const Body& body) const {
  return hourglass_.diagnostic(body, operator_);
}

void KernelMethod::count(const Body& body, cleave_counts& counts) const {
  counts.bonds += gradient_.half_bonds() / 2;
  counts.simplices += gradient_.simplices;
  counts.inverted += points_.inverted(body);
}

std::int64_t KernelMethod::bytes() const {
  return gradient_.bytes() + hourglass_.bytes() +
         static_cast<std::int64_t>(bond_weight_.capacity() * sizeof(double));
}

}  // namespace cleave::meshless
