// The loop that lattice_kernels.hpp declares.
#include "formulation/cpd/lattice_kernels.hpp"

#include <cmath>

#include "formulation/peridynamics/bits.hpp"

namespace cleave {

namespace cpd {
namespace {

using peridynamics::kWide;
using peridynamics::Lanes;
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

// Sums of members that are there to the tile; the first point gets the opposite of all forces.
void collect(const Shapes& s, const LatticeTile& tile, std::int64_t at, const Lanes& energy,
             const double* bench) {
  Lanes own[3] = {Lanes(0.0), Lanes(0.0), Lanes(0.0)};
  for (std::int32_t m = 0; m < s.members; ++m) {
    const std::int64_t member = at + s.distance[m];
    const double* from = bench + kMember * m;
    const Lanes there = load_lanes8(from + kThere * kWide);
    for (int k = 0; k < 3; ++k) {
      const Lanes force = there * load_lanes8(from + (kForce + k) * kWide);
      own[k] = own[k] - force;
      add(force, tile.f[k] + member);
    }
    add(load_lanes8(from + kEnergy * kWide), tile.e + member);
  }
  for (int k = 0; k < 3; ++k) add(own[k], tile.f[k] + at);
  add(energy, tile.e + at);
}

template <bool kSigned, bool kFull>
Lanes sum_shapes(const Shapes& shapes, double* bench) {
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
    for (const ShapeThird* third = thirds + pair->first; third != thirds + pair->last; ++third) {
      double* on_c = bench + kMember * third->member;
      const Place c(on_c);
      const Lanes v = px * c.x + py * c.y + pz * c.z;
      const double V = volumes[third->volume];
      // At v = 0 the published bracket has no value; here it takes the one of the zero's sign.
      const Lanes change = kSigned ? v - V : v - with_sign_of(Lanes(std::fabs(V)), v);
      const Lanes g = inverses[third->volume] * change;
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

void eight(const Shapes& given, const LatticeTile& tile, std::int64_t at, bool full,
           double* bench) {
  const Shapes shapes = given;
  lay_out(shapes, tile, at, bench);
  Lanes energy;
  if (shapes.signed_volume) {
    energy = full ? sum_shapes<true, true>(shapes, bench) : sum_shapes<true, false>(shapes, bench);
  } else {
    energy =
        full ? sum_shapes<false, true>(shapes, bench) : sum_shapes<false, false>(shapes, bench);
  }
  collect(shapes, tile, at, energy, bench);
}

template <bool kSigned>
void sum_around(const Shapes& given, const double* bench, double* sums) {
  constexpr std::int64_t kBond = 4 * kWide;  // of a member on this bench
  const Shapes shapes = given;
  const double* volumes = shapes.volume + shapes.offset;
  const double* inverses = shapes.inverse + shapes.offset;
  Lanes fx(0.0), fy(0.0), fz(0.0), energy(0.0);
  for (const ShapePair* pair = shapes.pairs; pair != shapes.pairs + shapes.pair_count; ++pair) {
    const double *at_a = bench + kBond * pair->a, *at_b = bench + kBond * pair->b;
    const Place a(at_a), b(at_b);
    const Lanes carry = load_lanes8(at_a + 3 * kWide) * load_lanes8(at_b + 3 * kWide);
    const Lanes px = a.y * b.z - a.z * b.y, py = a.z * b.x - a.x * b.z, pz = a.x * b.y - a.y * b.x;
    Lanes hx(0.0), hy(0.0), hz(0.0), total(0.0), stored(0.0);
    for (const ShapeThird* third = shapes.thirds + pair->first; third != shapes.thirds + pair->last;
         ++third) {
      const double* at_c = bench + kBond * third->member;
      const Place c(at_c);
      const Lanes v = px * c.x + py * c.y + pz * c.z;
      const double V = volumes[third->volume];
      const Lanes change = kSigned ? v - V : v - with_sign_of(Lanes(std::fabs(V)), v);
      const Lanes g = load_lanes8(at_c + 3 * kWide) * (inverses[third->volume] * change);
      hx = hx + g * c.x;
      hy = hy + g * c.y;
      hz = hz + g * c.z;
      total = total + g;
      stored = stored + g * change;
    }
    fx = fx + carry * ((b.y * hz - b.z * hy) + (hy * a.z - hz * a.y) + total * px);
    fy = fy + carry * ((b.z * hx - b.x * hz) + (hz * a.x - hx * a.z) + total * py);
    fz = fz + carry * ((b.x * hy - b.y * hx) + (hx * a.y - hy * a.x) + total * pz);
    energy = energy + carry * stored;
  }
  store_lanes8(fx, sums);
  store_lanes8(fy, sums + kWide);
  store_lanes8(fz, sums + 2 * kWide);
  store_lanes8(energy, sums + 3 * kWide);
}

void around(const Shapes& shapes, const double* bench, double* sums) {
  shapes.signed_volume ? sum_around<true>(shapes, bench, sums)
                       : sum_around<false>(shapes, bench, sums);
}

}  // namespace
}  // namespace cpd

extern const cleave_call::LatticeKernels kLatticeKernels;
constinit const cleave_call::LatticeKernels kLatticeKernels = {&cpd::eight, &cpd::around};

}  // namespace cleave
