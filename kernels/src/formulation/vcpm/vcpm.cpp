#include "formulation/vcpm/vcpm.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "formulation/cbm/parameters.hpp"
#include "formulation/common/unused_groups.hpp"

namespace cleave::vcpm {

namespace {

constexpr int kBeyond = 7;                // numbers that kernels may read behind the last half-bond
constexpr std::int64_t kReserve = 65536;  // particles whose bonds break in one step
constexpr double kOffLattice = 1e-4;      // of the length of a bond

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// The limit that group fracture gives.
double given_strain(const Body& body) {
  const ParameterSet& options = body.group("fracture");
  if (options.choice("criterion") == static_cast<int>(cbm::Criterion::none)) return kUnbounded;
  const double strain = options.real("critical_strain");
  if (strain > 0 && !(options.real("Gf") > 0)) return strain;
  throw Error(CLEAVE_UNSUPPORTED,
              text("group fracture of ", body.label(),
                   ": vcpm has no relation to Gf; give critical_strain > 0 alone, or strength or "
                   "limit in group vcpm"));
}

}  // namespace

void VolumeCompensatedParticles::setup(Body& body, ThreadTeam& team) {
  refuse_group(body, "peridynamics", "bonds reach as far as the lattice says");
  Peridynamic::setup(body, team);
}

void VolumeCompensatedParticles::rebuild(Body& body, ThreadTeam& team) {
  responded_ = false;
  Peridynamic::rebuild(body, team);
  number_broken();
  respond(body, team);
}

// Every particle owns a whole cell, those at the surface too.
double VolumeCompensatedParticles::lay_out(Body& body) {
  const ParameterSet& options = body.group("vcpm");
  if (options.choice("softening") == static_cast<int>(SofteningLaw::none))
    for (const char* field : {"bond_integrity", "bond_released"}) body.fields.drop(field);
  lattice_ = find_lattice(body, static_cast<LatticeChoice>(options.choice("lattice")),
                          materials_.front().mu);
  body.given_volumes.assign(at(body.particles), lattice_.cell);
  return lattice_.reach;
}

void VolumeCompensatedParticles::check_bonds(const Body& body) const {
  const std::string due = text("lattice ", lattice_name(lattice_.kind),
                               " with nearest neighbours at ", lattice_.spacing, " [m]");
  const std::string remedy = "; vcpm needs all particles on one lattice, as &lattice makes them";
  for (std::int64_t i = 0; i < hood_.points; ++i) {
    std::array<std::int32_t, 2> number{};
    for (auto b = hood_.first(i); b < hood_.last(i); ++b) {
      const std::int32_t p = hood_.neighbour(b);
      const double length = hood_.length(i, p);
      const Shell& s = lattice_.shell(length);
      if (std::fabs(length - s.length) > kOffLattice * s.length) {
        throw Error(
            CLEAVE_BAD_ARGUMENT,
            text(body.label(), ": ", body.particle_label(i), " and particle ", body.number(p),
                 " are ", length, " [m] apart; ", due, " has bonds of ",
                 lattice_.shells.front().length,
                 lattice_.shells.size() > 1 ? text(" and ", lattice_.shells.back().length) : "",
                 " [m]", remedy));
      }
      if (++number[static_cast<std::size_t>(&s - lattice_.shells.data())] > s.number) {
        throw Error(
            CLEAVE_BAD_ARGUMENT,
            text(body.label(), ": ", body.particle_label(i), " has more than ", s.number,
                 " neighbours at ", s.length, " [m], which is all that ", due, " has", remedy));
      }
    }
  }
}

void VolumeCompensatedParticles::prepare(Body& body) {
  check_bonds(body);
  const ParameterSet& options = body.group("vcpm");
  geometry_ = static_cast<Geometry>(options.choice("geometry"));
  modulus_ = materials_.front().lambda - materials_.front().mu;
  if (softening_.active()) {
    integrity_ = body.fields.real("bond_integrity");
    released_ = body.fields.real("bond_released");
    std::fill(integrity_, integrity_ + hood_.bonds(), 1.0);
    weight_.assign(at(hood_.half_bonds() + kBeyond), 1.0);
  }
  const bool extend = options.choice("surface") == static_cast<int>(Surface::extend);
  event_ = body.fields.integer("bond_event");
  body.fields.integer("factored_bonds");
  order_.reserve(at(hood_.bonds()));
  pressure_.assign(at(hood_.points), 0.0);
  force_.assign(at(kVector * hood_.points), 0.0);
  energy_.assign(at(hood_.points), 0.0);
  critical_.assign(at(hood_.points), 0);
  stale_.reserve(at(std::min(hood_.points, kReserve)));
  length_.assign(at(hood_.half_bonds() + kBeyond), 1.0);
  for (std::int64_t i = 0; i < hood_.points; ++i)
    for (auto b = hood_.first(i); b < hood_.last(i); ++b)
      length_[at(b)] = hood_.length(i, hood_.neighbour(b));
  if (geometry_ == Geometry::linear) {
    shift_.assign(4 * at(hood_.points), 0.0);
    shifted_.assign(at(block_count(hood_.points)), 0);
  }
  factor_.assign(at(hood_.points), 1.0);
  for (std::int64_t i = 0; extend && i < hood_.points; ++i)
    if (hood_.count(i) > 0)
      factor_[at(i)] = static_cast<double>(lattice_.neighbours) / hood_.count(i);
}

std::vector<double> VolumeCompensatedParticles::limits(const Body& body) {
  const double limit = bond_limit(body);
  softening_ = read_softening(body, criterion_, limit, lattice_);
  return {limit};
}

// F_c = 2 R sigma/sqrt(3) is exact across a close-packed row; along it the same F_c is 2/3 of the strength.
double VolumeCompensatedParticles::bond_limit(const Body& body) {
  const ParameterSet& options = body.group("vcpm");
  const double strength = options.real("strength"), limit = options.real("limit");
  criterion_ = static_cast<Criterion>(options.choice("criterion"));
  if (body.group("fracture").any_given()) {
    if (strength > 0 || limit > 0) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(body.label(),
                       " has limits of its bonds in group fracture and in group vcpm; "
                       "give one of them"));
    }
    criterion_ = Criterion::strain;
    return given_strain(body);
  }
  if (strength > 0 && limit > 0) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("group vcpm of ", body.label(), " has strength = ",
                                          strength, " and limit = ", limit, "; give one of them"));
  }
  if (limit > 0) return limit;
  if (!(strength > 0)) return kUnbounded;
  if (criterion_ == Criterion::strain) return strength / materials_.front().E;
  if (criterion_ == Criterion::force && dimension_ == 2)
    return lattice_.spacing * strength / std::sqrt(3.0);
  throw Error(CLEAVE_MISSING_PARAMETER,
              text("group vcpm of ", body.label(), ": criterion '",
                   criterion_ == Criterion::force ? "force" : "energy",
                   "' does not follow from strength = ", strength, " [Pa]",
                   dimension_ == 3 ? " in space, where it depends on the direction" : "",
                   "; give limit, or use criterion 'strain'"));
}

// (sum_p w dL/2)^2 <= n sum_p w^2 dL^2/4, so springs of that stiffness bound the volume terms.
void VolumeCompensatedParticles::find_rates(const Body& body, std::span<double> rates) const {
  const double T = std::fmax(modulus_, 0.0);
  const auto volume_part = [&](std::int64_t i) {
    return 0.25 * lattice_.cell * T * factor_[at(i)] * factor_[at(i)] * hood_.count(i);
  };
  const auto weight = [&](std::int64_t i, std::int64_t p) {
    const double L = hood_.length(i, p);
    const Shell& s = lattice_.shell(L);
    return L * (0.5 * s.stiffness + s.weight * s.weight * (volume_part(i) + volume_part(p)));
  };
  pair_rates(body, weight, rates);
}

VolumeCompensatedParticles::Bond VolumeCompensatedParticles::bond(const Body& body, std::int64_t i,
                                                                  std::int64_t p) const {
  Bond b;
  const Vec<3> X = difference<3>(hood_.X, i, p);
  const double L = std::sqrt(dot(X, X));
  b.shell = &lattice_.shell(L);
  if (geometry_ == Geometry::linear) {
    for (int k = 0; k < 3; ++k) b.direction[k] = X[k] / L;
    b.elongation = dot(difference<3>(body.point.u, i, p), b.direction);
    return b;
  }
  const Vec<3> x = difference<3>(body.point.x, i, p);
  const double l = std::sqrt(dot(x, x));
  b.elongation = l - L;
  if (l > 0)
    for (int k = 0; k < 3; ++k) b.direction[k] = x[k] / l;
  return b;
}

VolumeCompensatedParticles::Bond VolumeCompensatedParticles::bond(const Body& body, std::int64_t i,
                                                                  std::int64_t p,
                                                                  std::int32_t half) const {
  Bond b = bond(body, i, p);
  b.integrity = integrity(half);
  return b;
}

double VolumeCompensatedParticles::dilatation(const Body& body, std::int64_t i) const {
  double sum = 0;
  for_carrying(i, [&](std::int32_t p, std::int32_t half) {
    const Bond b = bond(body, i, p, half);
    sum += b.integrity * (0.5 * b.shell->weight * b.elongation);
  });
  return factor_[at(i)] * sum;
}

double VolumeCompensatedParticles::pressure(std::int64_t i, double dilatation) const {
  return 0.5 * lattice_.cell * modulus_ * factor_[at(i)] * dilatation;
}

double VolumeCompensatedParticles::force(const Bond& b, std::int64_t i, std::int64_t p) const {
  return b.integrity * (0.5 * b.shell->stiffness * b.elongation +
                        b.shell->weight * (pressure_[at(i)] + pressure_[at(p)]));
}

double VolumeCompensatedParticles::severity(const Body& body, std::int64_t i,
                                            std::int64_t p) const {
  const Bond b = bond(body, i, p);
  if (criterion_ == Criterion::strain) return b.elongation / hood_.length(i, p);
  const double F = force(b, i, p);
  if (criterion_ == Criterion::force) return F;
  return F > 0 && b.elongation > 0 ? 0.5 * F * b.elongation : 0.0;
}

// Half of force times elongation grows with the square of the loads.
double VolumeCompensatedParticles::ratio(double severity, double limit) const {
  const double r = severity / limit;
  return criterion_ == Criterion::energy ? std::sqrt(r) : r;
}

std::string VolumeCompensatedParticles::one_bond_obstacle(const Body&) const {
  return softening_.active()
             ? "bonds that soften are not taken one at a time; use breaking 'all', or "
               "softening 'none' in group vcpm"
             : "";
}

void VolumeCompensatedParticles::reconnect(std::int64_t i) {
  if (responded_) stale_.push_back(static_cast<std::int32_t>(i));
  if (!softening_.active()) return;
  for (auto half = hood_.first(i); half < hood_.last(i); ++half) {
    const std::int32_t p = hood_.neighbour(half);
    const std::int32_t bond =
        p > i ? hood_.bond_of_upper(i, half) : hood_.bond_of_upper(p, hood_.find_half(p, i));
    if (!damage_.intact(half)) integrity_[bond] = 0;
    weight_[at(half)] = integrity_[bond];
  }
}

double VolumeCompensatedParticles::integrity(std::int32_t half) const {
  return weight_.empty() ? 1.0 : weight_[at(half)];
}

double VolumeCompensatedParticles::kept_integrity(double strain) const {
  return softening_.active() ? softening_.integrity(strain) : 0.0;
}

void VolumeCompensatedParticles::weaken(std::int32_t bond, double kept) {
  if (softening_.active()) integrity_[bond] = kept;
}

double VolumeCompensatedParticles::breaking_limit(std::int64_t i, std::int64_t p) const {
  return softening_.active() ? softening_.end() : Peridynamic::breaking_limit(i, p);
}

double VolumeCompensatedParticles::add_released(std::int32_t bond, double energy) {
  return softening_.active() ? released_[bond] += energy : energy;
}

// The energy of the cell; its bonds take dU/d(dL) = g (k dL/4 + w pressure) from it.
peridynamics::PointEnergy VolumeCompensatedParticles::point_energy(const Body& body, std::int64_t i,
                                                                   int) const {
  const double theta = dilatation(body, i), q = pressure(i, theta);
  peridynamics::PointEnergy sum;
  sum.energy = 0.5 * lattice_.cell * modulus_ * theta * theta;
  for_carrying(i, [&](std::int32_t p, std::int32_t half) {
    const Bond b = bond(body, i, p, half);
    const double k = b.shell->stiffness, rate = dot(difference<3>(body.point.v, i, p), b.direction);
    sum.energy += b.integrity * (0.125 * k * b.elongation * b.elongation);
    sum.rate += b.integrity * (0.25 * k * b.elongation + b.shell->weight * q) * rate;
  });
  return sum;
}

// P = dU_cell/dF / V
Mat<3> VolumeCompensatedParticles::point_stress(const Body& body, std::int64_t i, int) const {
  Mat<3> stress;
  const double q = pressure(i, dilatation(body, i));
  for_carrying(i, [&](std::int32_t p, std::int32_t half) {
    const Bond b = bond(body, i, p, half);
    Vec<3> pull = b.direction;
    const double F = b.integrity * (0.25 * b.shell->stiffness * b.elongation + b.shell->weight * q);
    for (int k = 0; k < 3; ++k) pull[k] *= F / lattice_.cell;
    add_dyad(stress, pull, difference<3>(hood_.X, i, p));
  });
  return stress;
}

bool VolumeCompensatedParticles::derive(const Body& body, std::string_view field,
                                        std::int64_t first, std::int64_t last,
                                        double* values) const {
  if (field == "damage" && softening_.active()) {
    for (std::int64_t i = first; i < last; ++i) {
      const std::int32_t all = hood_.count(i);
      double sum = 0;
      for_carrying(i, [&](std::int32_t, std::int32_t half) { sum += integrity(half); });
      values[i - first] = all == 0 ? 0.0 : 1 - sum / all;
    }
    return true;
  }
  if (field != "bond_force") return Peridynamic::derive(body, field, first, last, values);
  hood_.for_bonds(
      first, last, [&](std::int32_t number, std::int64_t i, std::int32_t p, std::int32_t half) {
        values[number - first] = damage_.intact(half) ? force(bond(body, i, p, half), i, p) : 0.0;
      });
  return true;
}

std::int64_t VolumeCompensatedParticles::bytes() const {
  std::size_t reals = shift_.capacity();
  for (const auto* list : {&factor_, &pressure_, &force_, &energy_, &weight_, &length_})
    reals += list->capacity();
  return Peridynamic::bytes() + static_cast<std::int64_t>(reals * sizeof(double));
}

}  // namespace cleave::vcpm
