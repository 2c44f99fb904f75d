#include "formulation/vcpm/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/cell_list.hpp"

namespace cleave::vcpm {

namespace {

// In units of the nearest distance d: cell volume over d^D; of both shells length, number, k_s/(d mu).
struct Plan {
  LatticeChoice kind;
  const char* name;
  double cell, reach;
  std::array<double, 2> length;
  std::array<int, 2> number;
  std::array<double, 2> stiffness;
};

const double kRoot2 = std::sqrt(2.0), kRoot3 = std::sqrt(3.0);

// Springs isotropic: c_ijkl = (1/V) sum k r^2 xi xi xi xi = mu (dd + dd + dd).
const Plan& plan(LatticeChoice kind) {
  static const std::array<Plan, 4> plans = {{
      // k_n = 4 E/(sqrt(3) (1 + nu)) does not depend on d.                             [VCPM lattices]
      {LatticeChoice::triangular, "triangular", kRoot3 / 2, 1.5, {1, 0}, {6, 0}, {8 / kRoot3, 0}},
      {LatticeChoice::sc, "sc", 1, 1.55, {1, kRoot2}, {6, 12}, {2, 2}},
      {LatticeChoice::fcc, "fcc", kRoot2 / 2, 1.57, {1, kRoot2}, {12, 6}, {2 * kRoot2, kRoot2 / 2}},
      {LatticeChoice::bcc,
       "bcc",
       4 / (3 * kRoot3),
       1.4,
       {1, 2 / kRoot3},
       {8, 6},
       {2 * kRoot3, 4 / kRoot3}},
  }};
  return *std::find_if(plans.begin(), plans.end(), [&](const Plan& p) { return p.kind == kind; });
}

// From the first particle to the one nearest to it.
double nearest_distance(const Body& body) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t p = 1; p < body.particles; ++p) {
    const Vec<3> d = difference<3>(body.point.X, 0, p);
    least = std::fmin(least, dot(d, d));
  }
  return std::sqrt(least);
}

LatticeChoice kind_of(const Body& body, double spacing) {
  if (body.dimension() == 2) return LatticeChoice::triangular;
  const NeighbourRows rows =
      neighbours_within(body.point.X, body.particles, 1.05 * spacing, Radius::closed, body.label());
  int most = 0;
  for (std::size_t i = 0; i + 1 < rows.row_begin.size(); ++i)
    most = std::max(most, rows.row_begin[i + 1] - rows.row_begin[i]);
  for (const LatticeChoice kind : {LatticeChoice::sc, LatticeChoice::bcc, LatticeChoice::fcc})
    if (plan(kind).number[0] == most) return kind;
  throw Error(CLEAVE_BAD_ARGUMENT,
              text(body.label(), ": no particle has more than ", most,
                   " nearest neighbours at a distance of ", spacing,
                   " [m], so the lattice cannot be told; inside sc has 6, bcc 8, fcc 12; name it "
                   "with lattice in group vcpm, or use a thicker body"));
}

}  // namespace

const char* lattice_name(LatticeChoice kind) { return plan(kind).name; }

Lattice find_lattice(const Body& body, LatticeChoice wanted, double mu) {
  const int D = body.dimension();
  if (wanted != LatticeChoice::found && (wanted == LatticeChoice::triangular) != (D == 2)) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("group vcpm of ", body.label(), ": lattice '",
                                          lattice_name(wanted), "' is not one of ",
                                          D == 2 ? "the plane; allowed there: triangular"
                                                 : "space; allowed there: sc, fcc, bcc"));
  }
  Lattice lattice;
  lattice.spacing = nearest_distance(body);
  if (!(lattice.spacing > 0) || !std::isfinite(lattice.spacing)) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text(body.label(), ": ", body.particle_label(0), " is ", lattice.spacing,
                     " [m] from its nearest neighbour; vcpm needs particles on a lattice"));
  }
  lattice.kind = wanted == LatticeChoice::found ? kind_of(body, lattice.spacing) : wanted;
  const Plan& p = plan(lattice.kind);
  const double d = lattice.spacing;
  lattice.cell = p.cell * std::pow(d, D);
  lattice.reach = p.reach * d;
  lattice.neighbours = p.number[0] + p.number[1];
  lattice.middle = 0.5 * (p.length[0] + p.length[1]) * d;
  for (std::size_t s = 0; s < 2 && p.number[s] > 0; ++s) {
    const double length = p.length[s] * d, k = p.stiffness[s] * mu * (D == 2 ? 1.0 : d);
    lattice.shells.push_back({length, k, D / (lattice.neighbours * 0.5 * length), p.number[s]});
  }
  return lattice;
}

}  // namespace cleave::vcpm
