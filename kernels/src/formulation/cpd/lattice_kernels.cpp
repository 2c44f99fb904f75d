// The loop that lattice_kernels.hpp declares.
#include "formulation/cpd/lattice_kernels.hpp"

#include <cmath>

#include "formulation/peridynamics/bits.hpp"

namespace cleave {

namespace cpd {
namespace {

using peridynamics::kWide;
using peridynamics::Lanes;
using peridynamics::lanes_of;
using peridynamics::load_lanes8;
using peridynamics::store_lanes8;
using peridynamics::with_sign_of;

// Rows of a member on the bench.
enum Row { kPlace = 0, kThere = 3, kForce = 4, kEnergy = 7, kRows = 8 };
constexpr std::int64_t kMember = kRows * kWide;

CLEAVE_INLINE void add(const Lanes& a, double* to) { store_lanes8(load_lanes8(to) + a, to); }
CLEAVE_INLINE void subtract(const Lanes& a, double* to) { store_lanes8(load_lanes8(to) - a, to); }

struct Place {
  Lanes x, y, z;
  CLEAVE_INLINE explicit Place(const double* row)
      : x(load_lanes8(row)), y(load_lanes8(row + kWide)), z(load_lanes8(row + 2 * kWide)) {}
};

struct Cross {
  Lanes x, y, z;
  template <class A, class B>
  CLEAVE_INLINE Cross(const A& a, const B& b)
      : x(a.y * b.z - a.z * b.y), y(a.z * b.x - a.x * b.z), z(a.x * b.y - a.y * b.x) {}
};

// sum of g c
struct Moment {
  Lanes x{0.0}, y{0.0}, z{0.0};
  CLEAVE_INLINE void add(const Lanes& g, const Place& c) {
    x = x + g * c.x;
    y = y + g * c.y;
    z = z + g * c.z;
  }
};

void lay_out(const Shapes& s, const LatticeTile& tile, std::int64_t at, double* bench) {
  const Lanes x[3] = {load_lanes8(tile.x[0] + at), load_lanes8(tile.x[1] + at),
                      load_lanes8(tile.x[2] + at)};
  const Lanes here = load_lanes8(tile.there + at), zero(0.0);
  for (std::int32_t m = 0; m < s.members; ++m) {
    const std::int64_t member = at + s.distance[m];
    double* to = bench + kMember * m;
    const Lanes there = here * load_lanes8(tile.there + member);
    for (int k = 0; k < 3; ++k) {
      const Lanes place = load_lanes8(tile.x[k] + member) - x[k];
      store_lanes8(select(there > 0.0, place, zero), to + (kPlace + k) * kWide);
      store_lanes8(zero, to + (kForce + k) * kWide);
    }
    store_lanes8(there, to + kThere * kWide);
    store_lanes8(zero, to + kEnergy * kWide);
  }
}

// What the first point gets.
struct Apex {
  Lanes force[3] = {Lanes(0.0), Lanes(0.0), Lanes(0.0)}, energy = Lanes(0.0);
};

// The opposite of the forces on all members that are there.
Apex balanced(const Shapes& s, const double* bench, const Lanes& energy) {
  Apex apex;
  apex.energy = energy;
  for (std::int32_t m = 0; m < s.members; ++m) {
    const double* from = bench + kMember * m;
    const Lanes there = load_lanes8(from + kThere * kWide);
    for (int k = 0; k < 3; ++k)
      apex.force[k] = apex.force[k] - there * load_lanes8(from + (kForce + k) * kWide);
  }
  return apex;
}

// Sums of members that are there, and of the first point, to the tile.
void collect(const Shapes& s, const LatticeTile& tile, std::int64_t at, const double* bench,
             const Apex& apex) {
  for (std::int32_t m = 0; m < s.members; ++m) {
    const std::int64_t member = at + s.distance[m];
    const double* from = bench + kMember * m;
    const Lanes there = load_lanes8(from + kThere * kWide);
    for (int k = 0; k < 3; ++k)
      add(there * load_lanes8(from + (kForce + k) * kWide), tile.f[k] + member);
    add(load_lanes8(from + kEnergy * kWide), tile.e + member);
  }
  for (int k = 0; k < 3; ++k) add(apex.force[k], tile.f[k] + at);
  add(apex.energy, tile.e + at);
}

// weighed: by one weight for all members of a tetrahedron; damaged: the same with broken bonds. Whatever the weight,
// the forces of a tetrahedron balance.
enum class Sum { plain, weighed, damaged };

// Of the eight points: the weights of the first and, behind the bench, of the members.
struct Weights {
  Lanes own;
  const double* member;
  const std::uint8_t *to_member, *between;
  CLEAVE_INLINE Lanes of(std::int32_t m) const { return load_lanes8(member + kWide * m); }
  CLEAVE_INLINE Lanes bond_to(std::int32_t m) const { return lanes_of(to_member[m]); }
  CLEAVE_INLINE Lanes bond(std::int32_t k) const { return lanes_of(between[k]); }
};

template <bool kSigned, bool kFull, Sum kSum>
Lanes sum_shapes(const Shapes& shapes, double* bench, const Weights& weights) {
  const double* volumes = shapes.volume + shapes.offset;
  const double* inverses = shapes.inverse + shapes.offset;
  const ShapeThird* thirds = shapes.thirds;
  Lanes energy(0.0);
  for (const ShapePair* pair = shapes.pairs; pair != shapes.pairs + shapes.pair_count; ++pair) {
    double *on_a = bench + kMember * pair->a, *on_b = bench + kMember * pair->b;
    const Place a(on_a), b(on_b);
    const Lanes px = a.y * b.z - a.z * b.y, py = a.z * b.x - a.x * b.z, pz = a.x * b.y - a.y * b.x;
    Lanes hx(0.0), hy(0.0), hz(0.0), stored(0.0), there(1.0);
    if constexpr (!kFull)
      there = load_lanes8(on_a + kThere * kWide) * load_lanes8(on_b + kThere * kWide);
    // Weights of the tetrahedra of this pair; damaged: parts that carry if a c, b c or the bond to c do.
    Lanes both(0.0), on_own(0.0), of_a(0.0), of_b(0.0);
    if constexpr (kSum == Sum::weighed)
      both = weights.own + weights.of(pair->a) + weights.of(pair->b);
    if constexpr (kSum == Sum::damaged) {
      const Lanes to_a = weights.bond_to(pair->a), to_b = weights.bond_to(pair->b),
                  ab = weights.bond(shapes.pair_bond[pair - shapes.pairs]);
      on_own = weights.own * to_a * to_b;
      of_a = weights.of(pair->a) * to_a * ab;
      of_b = weights.of(pair->b) * to_b * ab;
    }
    for (const ShapeThird* third = thirds + pair->first; third != thirds + pair->last; ++third) {
      double* on_c = bench + kMember * third->member;
      const Place c(on_c);
      const Lanes v = px * c.x + py * c.y + pz * c.z;
      const double V = volumes[third->volume];
      // At v = 0 the published bracket has no value; here it takes the one of the zero's sign.
      const Lanes change = kSigned ? v - V : v - with_sign_of(Lanes(std::fabs(V)), v);
      Lanes g = inverses[third->volume] * change;
      if constexpr (kSum == Sum::weighed) g = g * (both + weights.of(third->member));
      if constexpr (kSum == Sum::damaged) {
        const std::int32_t* bonds = shapes.third_bonds + 2 * (third - thirds);
        const Lanes to_c = weights.bond_to(third->member), ac = weights.bond(bonds[0]),
                    bc = weights.bond(bonds[1]);
        g = g *
            (on_own * to_c + of_a * ac + of_b * bc + weights.of(third->member) * to_c * ac * bc);
      }
      hx = hx + g * c.x;
      hy = hy + g * c.y;
      hz = hz + g * c.z;
      subtract(g * px, on_c + kForce * kWide);
      subtract(g * py, on_c + (kForce + 1) * kWide);
      subtract(g * pz, on_c + (kForce + 2) * kWide);
      Lanes density = g * change;
      if constexpr (!kFull) density = density * (there * load_lanes8(on_c + kThere * kWide));
      stored = stored + density;
      add(density, on_c + kEnergy * kWide);
    }
    subtract(b.y * hz - b.z * hy, on_a + kForce * kWide);
    subtract(b.z * hx - b.x * hz, on_a + (kForce + 1) * kWide);
    subtract(b.x * hy - b.y * hx, on_a + (kForce + 2) * kWide);
    add(stored, on_a + kEnergy * kWide);
    subtract(hy * a.z - hz * a.y, on_b + kForce * kWide);
    subtract(hz * a.x - hx * a.z, on_b + (kForce + 1) * kWide);
    subtract(hx * a.y - hy * a.x, on_b + (kForce + 2) * kWide);
    add(stored, on_b + kEnergy * kWide);
    energy = energy + stored;
  }
  return energy;
}

// Each member has its own sum, of the tetrahedra whose three bonds at it carry.                    [PD 12, 13]
template <bool kSigned>
Apex sum_apart(const Shapes& shapes, double* bench, const Weights& bonds) {
  const double* volumes = shapes.volume + shapes.offset;
  const double* inverses = shapes.inverse + shapes.offset;
  const ShapeThird* thirds = shapes.thirds;
  Apex apex;
  for (const ShapePair* pair = shapes.pairs; pair != shapes.pairs + shapes.pair_count; ++pair) {
    double *on_a = bench + kMember * pair->a, *on_b = bench + kMember * pair->b;
    const Place a(on_a), b(on_b);
    const Cross p(a, b);
    const Lanes there = load_lanes8(on_a + kThere * kWide) * load_lanes8(on_b + kThere * kWide);
    const Lanes to_a = bonds.bond_to(pair->a), to_b = bonds.bond_to(pair->b),
                ab = bonds.bond(shapes.pair_bond[pair - shapes.pairs]);
    const Lanes here = there * to_a * to_b, at_a = to_a * ab, at_b = to_b * ab;
    Moment h, h_a, h_b;
    Lanes total(0.0), stored(0.0), stored_a(0.0), stored_b(0.0);
    for (const ShapeThird* third = thirds + pair->first; third != thirds + pair->last; ++third) {
      double* on_c = bench + kMember * third->member;
      const std::int32_t* between = shapes.third_bonds + 2 * (third - thirds);
      const Lanes to_c = bonds.bond_to(third->member), ac = bonds.bond(between[0]),
                  bc = bonds.bond(between[1]), there_c = load_lanes8(on_c + kThere * kWide);
      const Place c(on_c);
      const Lanes v = p.x * c.x + p.y * c.y + p.z * c.z;
      const double V = volumes[third->volume];
      const Lanes change = kSigned ? v - V : v - with_sign_of(Lanes(std::fabs(V)), v);
      const Lanes g = inverses[third->volume] * change, own = g * (here * to_c * there_c),
                  g_a = g * (at_a * ac), g_b = g * (at_b * bc), g_c = g * (to_c * ac * bc);
      h.add(own, c);
      h_a.add(g_a, c);
      h_b.add(g_b, c);
      total = total + own;
      subtract(g_c * p.x, on_c + kForce * kWide);
      subtract(g_c * p.y, on_c + (kForce + 1) * kWide);
      subtract(g_c * p.z, on_c + (kForce + 2) * kWide);
      const Lanes density = there * there_c * change;
      stored = stored + own * change;
      stored_a = stored_a + g_a * density;
      stored_b = stored_b + g_b * density;
      add(g_c * density, on_c + kEnergy * kWide);
    }
    const Cross of_a(b, h_a), of_b(h_b, a), one(b, h), two(h, a);
    subtract(of_a.x, on_a + kForce * kWide);
    subtract(of_a.y, on_a + (kForce + 1) * kWide);
    subtract(of_a.z, on_a + (kForce + 2) * kWide);
    add(stored_a, on_a + kEnergy * kWide);
    subtract(of_b.x, on_b + kForce * kWide);
    subtract(of_b.y, on_b + (kForce + 1) * kWide);
    subtract(of_b.z, on_b + (kForce + 2) * kWide);
    add(stored_b, on_b + kEnergy * kWide);
    apex.force[0] = apex.force[0] + (one.x + two.x + total * p.x);
    apex.force[1] = apex.force[1] + (one.y + two.y + total * p.y);
    apex.force[2] = apex.force[2] + (one.z + two.z + total * p.z);
    apex.energy = apex.energy + stored;
  }
  return apex;
}

template <bool kSigned, bool kFull>
Lanes sum_eight(const Shapes& shapes, const LatticeTile& tile, std::int64_t at, double* bench,
                const std::uint8_t* carries) {
  if (tile.weight == nullptr) return sum_shapes<kSigned, kFull, Sum::plain>(shapes, bench, {});
  double* member = bench + kMember * shapes.members;
  for (std::int32_t m = 0; m < shapes.members; ++m)
    store_lanes8(load_lanes8(tile.weight + at + shapes.distance[m]), member + kWide * m);
  const Weights weights{load_lanes8(tile.weight + at), member, carries,
                        carries == nullptr ? nullptr : carries + shapes.members};
  return carries == nullptr ? sum_shapes<kSigned, kFull, Sum::weighed>(shapes, bench, weights)
                            : sum_shapes<kSigned, kFull, Sum::damaged>(shapes, bench, weights);
}

void eight(const Shapes& given, const LatticeTile& tile, std::int64_t at, bool full, double* bench,
           const std::uint8_t* carries) {
  const Shapes shapes = given;
  lay_out(shapes, tile, at, bench);
  if (tile.weight == nullptr && carries != nullptr) {
    const Weights bonds{Lanes(0.0), nullptr, carries, carries + shapes.members};
    collect(shapes, tile, at, bench,
            shapes.signed_volume ? sum_apart<true>(shapes, bench, bonds)
                                 : sum_apart<false>(shapes, bench, bonds));
    return;
  }
  Lanes energy;
  if (shapes.signed_volume) {
    energy = full ? sum_eight<true, true>(shapes, tile, at, bench, carries)
                  : sum_eight<true, false>(shapes, tile, at, bench, carries);
  } else {
    energy = full ? sum_eight<false, true>(shapes, tile, at, bench, carries)
                  : sum_eight<false, false>(shapes, tile, at, bench, carries);
  }
  collect(shapes, tile, at, bench, balanced(shapes, bench, energy));
}

template <bool kSigned>
void sum_stress(const Shapes& given, const double* cells, const double* bench, double* sums) {
  constexpr std::int64_t kBond = 4 * kWide;
  const Shapes shapes = given;
  const double* volumes = shapes.volume + shapes.offset;
  const double* inverses = shapes.inverse + shapes.offset;
  Lanes sum[9];
  for (auto& component : sum) component = Lanes(0.0);
  for (const ShapePair* pair = shapes.pairs; pair != shapes.pairs + shapes.pair_count; ++pair) {
    const double *at_a = bench + kBond * pair->a, *at_b = bench + kBond * pair->b;
    const double *A = cells + 3 * pair->a, *B = cells + 3 * pair->b;
    const Place a(at_a), b(at_b);
    const Lanes carry = load_lanes8(at_a + 3 * kWide) * load_lanes8(at_b + 3 * kWide);
    const Lanes px = a.y * b.z - a.z * b.y, py = a.z * b.x - a.x * b.z, pz = a.x * b.y - a.y * b.x;
    Lanes hx(0.0), hy(0.0), hz(0.0), before[3] = {Lanes(0.0), Lanes(0.0), Lanes(0.0)};
    for (const ShapeThird* third = shapes.thirds + pair->first; third != shapes.thirds + pair->last;
         ++third) {
      const double* at_c = bench + kBond * third->member;
      const double* C = cells + 3 * third->member;
      const Place c(at_c);
      const Lanes v = px * c.x + py * c.y + pz * c.z;
      const double V = volumes[third->volume];
      const Lanes change = kSigned ? v - V : v - with_sign_of(Lanes(std::fabs(V)), v);
      const Lanes g = load_lanes8(at_c + 3 * kWide) * (inverses[third->volume] * change);
      hx = hx + g * c.x;
      hy = hy + g * c.y;
      hz = hz + g * c.z;
      for (int m = 0; m < 3; ++m) before[m] = before[m] + g * C[m];
    }
    const Lanes on_a[3] = {b.y * hz - b.z * hy, b.z * hx - b.x * hz, b.x * hy - b.y * hx};
    const Lanes on_b[3] = {hy * a.z - hz * a.y, hz * a.x - hx * a.z, hx * a.y - hy * a.x};
    const Lanes on_c[3] = {px, py, pz};
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 3; ++m)
        sum[3 * d + m] =
            sum[3 * d + m] + carry * (on_a[d] * A[m] + on_b[d] * B[m] + on_c[d] * before[m]);
  }
  for (int k = 0; k < 9; ++k) store_lanes8(sum[k], sums + kWide * k);
}

void stress(const Shapes& shapes, const double* cells, const double* bench, double* sums) {
  shapes.signed_volume ? sum_stress<true>(shapes, cells, bench, sums)
                       : sum_stress<false>(shapes, cells, bench, sums);
}

}  // namespace
}  // namespace cpd

extern const cleave_call::LatticeKernels kLatticeKernels;
constinit const cleave_call::LatticeKernels kLatticeKernels = {&cpd::eight, &cpd::stress};

}  // namespace cleave
