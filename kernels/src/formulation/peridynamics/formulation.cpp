#include "formulation/peridynamics/formulation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "formulation/common/unused_groups.hpp"
#include "tables/tables.hpp"

namespace cleave::peridynamics {

namespace {

// Of the bound below 2/omega_max, which itself is safe by 1.4 and more.                 [PD step]
constexpr double kSafety = 0.9;
// First size of the lists of one step; they grow beyond it only in a step that breaks more.
constexpr std::size_t kReserve = 65536;

}  // namespace

void Peridynamic::refuse_groups(const Body& body) const {
  refuse_group(body, "viscosity", "leave it out, or apply it to other bodies");
  refuse_group(body, "stabilisation", "bonds have no hourglass modes; leave it out");
  refuse_group(body, "kernel", "its radius is horizon in group peridynamics");
  refuse_group(body, "hourglass", "bonds have no hourglass modes; leave it out");
  if (std::string_view(name()) != "cpd") refuse_group(body, "cpd", "it belongs to formulation cpd");
  if (std::string_view(name()) != "vcpm")
    refuse_group(body, "vcpm", "it belongs to formulation vcpm");
}

void Peridynamic::setup(Body& body, ThreadTeam&) {
  refuse_groups(body);
  const ParameterSet& options = body.group("peridynamics");
  const double section = options.real("section");
  if (section > 0 && body.kinematics != CLEAVE_PLANE_STRESS) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group peridynamics of ", body.label(), ": section ", section,
                     " [m2] makes it a bar, which needs kinematics plane_stress"));
  }
  dimension_ = section > 0 ? 1 : body.dimension();
  use_lattice_ = options.choice("stencil") == static_cast<int>(Stencil::lattice);
  materials_ = elastic_constants(body);
  hood_.build(body, dimension_, lay_out(body), section);
  const auto n = static_cast<std::size_t>(hood_.points);
  reference_.assign(4 * n, 0.0);
  now_.assign(4 * n, 0.0);
  left_.assign(n, 0.0);
  moved_.assign(static_cast<std::size_t>(block_count(hood_.points)), 1);
  material_of_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    material_of_[i] = body.region_of(static_cast<std::int64_t>(i));
    body.point.mass[i] = elastic(static_cast<std::int64_t>(i)).density * hood_.volume[i];
    for (std::size_t k = 0; k < 3; ++k) reference_[4 * i + k] = body.point.X[3 * i + k];
    reference_[4 * i + 3] = hood_.volume[i];
  }
  damage_.setup(body, hood_, limits(body), options.real("interface_strain"));
  interactions_ = body.fields.real("interactions");
  interactions_[0] = static_cast<double>(hood_.half_bonds());
  pair_form_.reset();
  prepare(body);
  share_stencil(body);
  for (std::int64_t i = 0; i < hood_.points; ++i) rewire(i);
  rates_.assign(n, 0.0);
  find_rates(body, rates_);
  const double largest = *std::max_element(rates_.begin(), rates_.end());
  if (materials_.size() == 1) rates_.assign(1, largest);
  stable_step_ = kSafety * 2 / std::sqrt(largest);
  flag_.assign(n, 0);
  place_.assign(n, -1);
  const std::size_t reserve = std::min(static_cast<std::size_t>(hood_.bonds()), kReserve);
  weaker_.reserve(reserve);
  touched_.reserve(reserve);
  for (auto* list : {&share_, &release_}) list->reserve(reserve);
}

void Peridynamic::rebuild(Body& body, ThreadTeam& team) {
  damage_.rebuild();
  stress_observed_ = true;  // what a checkpoint brought is as old as its step
  for (std::int64_t i = 0; i < hood_.points; ++i) rewire(i);
  take_positions(body, team);
}

std::string Peridynamic::static_obstacle(const Body&) const {
  return "it needs a gradient operator, which interactions do not have; use relaxation";
}

bool take_rows(const double* from, std::int64_t count, double* to) {
  std::uint64_t changed = 0;
  for (std::int64_t i = 0; i < count; ++i)
    for (std::int64_t k = 0; k < 3; ++k) {
      const double x = from[kVector * i + k];
      changed |= std::bit_cast<std::uint64_t>(x) ^ std::bit_cast<std::uint64_t>(to[4 * i + k]);
      to[4 * i + k] = x;
    }
  return changed != 0;
}

void Peridynamic::take_positions(const Body& body, ThreadTeam& team) {
  team_ = &team;
  expect_workers(team.size());
  if (stress_observed_) std::fill(body.point.p, body.point.p + kTensor * hood_.points, 0.0);
  gradient_observed_ = stress_observed_ = false;
  for_blocks(team, hood_.points, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    if (lattice_pairs_.active()) {
      lattice_pairs_.take(body.point.u, first, last);
      return;
    }
    const bool moved =
        take_rows(body.point.x + kVector * first, last - first, now_.data() + 4 * first);
    if (moved) moved_[static_cast<std::size_t>(block)] = 1;
  });
}

bool Peridynamic::take_moved() {
  const bool moved = std::find(moved_.begin(), moved_.end(), 1) != moved_.end();
  std::fill(moved_.begin(), moved_.end(), 0);
  return moved;
}

void Peridynamic::deform(Body& body, const Clock&, ThreadTeam& team) { take_positions(body, team); }

void Peridynamic::forces(Body& body, ThreadTeam& team) {
  std::fill(body.point.viscous, body.point.viscous + kVector * hood_.points, 0.0);
  act(body, team);
}

void Peridynamic::stiffness_bound(const Body& body, ThreadTeam&, std::span<double> bound) {
  for (std::int64_t i = 0; i < hood_.points; ++i) {
    const bool carried = damage_.intact_count(i) > 0;
    const double rate = rates_.size() == 1 ? rates_[0] : rates_[static_cast<std::size_t>(i)];
    for (int k = 0; k < dimension_; ++k)
      bound[static_cast<std::size_t>(kVector * i + k)] = carried ? rate * body.point.mass[i] : 0.0;
  }
}

double Peridynamic::severity(const Body& body, std::int64_t i, std::int64_t p) const {
  return stretch(hood_, body.point.x, i, p);
}

double Peridynamic::lay_out(Body& body) { return body.group("peridynamics").real("horizon"); }

std::vector<double> Peridynamic::limits(const Body& body) {
  return critical_stretches(body, materials_, reach());
}

StoredEnergy Peridynamic::stored_energy(const Body& body) const {
  StoredEnergy e;
  for (std::int64_t i = 0; i < hood_.points; ++i)
    e.elastic += hood_.volume[i] * body.point.energy[i];
  return e;
}

void Peridynamic::count(const Body&, cleave_counts& counts) const {
  counts.bonds += hood_.bonds();
  counts.simplices += hood_.simplices;
  counts.broken += damage_.count(kBroken);
  counts.inert += damage_.count(kCut);
  for (std::int64_t i = 0; i < hood_.points; ++i) counts.isolated += damage_.intact_count(i) == 0;
}

std::int64_t Peridynamic::bytes() const {
  return hood_.bytes() + damage_.bytes() + lattice_pairs_.bytes() +
         static_cast<std::int64_t>((now_.capacity() + reference_.capacity() + left_.capacity()) *
                                   sizeof(double)) +
         static_cast<std::int64_t>(flag_.capacity() +
                                   (place_.capacity() + material_of_.capacity()) *
                                       sizeof(std::int32_t));
}

}  // namespace cleave::peridynamics
