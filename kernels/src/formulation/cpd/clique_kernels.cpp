// The loops that clique_kernels.hpp declares.
#include "formulation/cpd/clique_kernels.hpp"

#include "formulation/peridynamics/bits.hpp"

namespace cleave {

namespace cpd {
namespace {

using peridynamics::bit_of;
using peridynamics::kWide;
using peridynamics::Lanes;
using peridynamics::lanes_of;
using peridynamics::load_lanes8;
using peridynamics::store_lanes8;
using peridynamics::sum_of;

struct Vector {
  double c[3];
};
CLEAVE_INLINE Vector cross(const double (&a)[3], const double (&b)[3]) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

void relate(const Star& star) {
  const Star s = star;
  for (std::int32_t k = 0; k < s.count + kWide; ++k)
    for (int d = 0; d < 3; ++d) {
      s.C[d][k] = k < s.count ? s.X[d][k] - s.apex_X[d] : 0.0;
      s.c[d][k] = k < s.count ? s.x[d][k] - s.apex_x[d] : 0.0;
    }
  for (std::int32_t j = 0; j < s.count; ++j) {
    std::uint64_t* row = s.adjacent + static_cast<std::int64_t>(s.words) * j;
    for (std::int32_t w = 0; w < s.words; ++w) row[w] = 0;
    for (std::int32_t k = (j + 1) / kWide * kWide; k < s.count; k += kWide) {
      Lanes square(0.0);
      for (int d = 0; d < 3; ++d) {
        const Lanes D = load_lanes8(s.X[d] + k) - s.X[d][j];
        square = square + D * D;
      }
      const auto near = square < s.square_limit;
      std::uint64_t byte = 0;
      for (int l = 0; l < kWide; ++l) {
        if (lane(near, l) && k + l > j && k + l < s.count) byte |= std::uint64_t{1} << l;
      }
      row[k >> 6] |= byte << (k & 63);
    }
  }
}

// f(j, k, row j, row k) for adjacent pairs j < k.
template <class F>
CLEAVE_INLINE void for_pairs(const Star& s, const F& f) {
  for (std::int32_t j = 0; j < s.count; ++j) {
    const std::uint64_t* row = s.adjacent + static_cast<std::int64_t>(s.words) * j;
    for (std::int32_t w = 0; w < s.words; ++w)
      for (std::uint64_t left = row[w]; left != 0; left &= left - 1) {
        const std::int32_t k = 64 * w + __builtin_ctzll(left);
        f(j, k, row, s.adjacent + static_cast<std::int64_t>(s.words) * k);
      }
  }
}
// f(l, byte) for the groups of eight l that hold one adjacent to both; row k holds l > k only.
template <class F>
CLEAVE_INLINE void for_common(const Star& s, std::int32_t k, const std::uint64_t* row_j,
                              const std::uint64_t* row_k, const F& f) {
  for (std::int32_t w = k >> 6; w < s.words; ++w) {
    const std::uint64_t both = row_j[w] & row_k[w];
    for (std::uint64_t left = both; left != 0;) {
      const int group = __builtin_ctzll(left) & ~7;
      f(64 * w + group, static_cast<unsigned>((both >> group) & 0xffu));
      left &= ~(std::uint64_t{0xff} << group);
    }
  }
}

struct Pair {
  double a[3], b[3], A[3], B[3];
  Vector p, P;
  CLEAVE_INLINE Pair(const Star& s, std::int32_t j, std::int32_t k) {
    for (int d = 0; d < 3; ++d) {
      a[d] = s.c[d][j];
      b[d] = s.c[d][k];
      A[d] = s.C[d][j];
      B[d] = s.C[d][k];
    }
    p = cross(a, b);
    P = cross(A, B);
  }
};

// Eight tetrahedra: g, zero where there is none, and |V|.
struct Tetrahedra {
  Lanes c[3], C[3], size, g, there;
  template <bool kSigned>
  CLEAVE_INLINE void find(const Star& s, const Pair& pair, std::int32_t l, unsigned byte) {
    Lanes v(0.0), V(0.0);
    for (int d = 0; d < 3; ++d) {
      c[d] = load_lanes8(s.c[d] + l);
      C[d] = load_lanes8(s.C[d] + l);
    }
    v = pair.p.c[0] * c[0] + pair.p.c[1] * c[1] + pair.p.c[2] * c[2];
    V = pair.P.c[0] * C[0] + pair.P.c[1] * C[1] + pair.P.c[2] * C[2];
    size = absolute(V);
    const auto solid = size > s.flat;
    const Lanes zero(0.0), divisor = select(solid, size, Lanes(1.0));
    const Lanes up = v - size, down = v + size;
    const Lanes change =
        kSigned ? select(V > 0.0, up, down) : select(v > 0.0, up, select(v < 0.0, down, zero));
    there = select(solid, lanes_of(byte), zero);
    g = there * (change / divisor);
  }
};

CLEAVE_INLINE void cross(const double (&a)[3], const Lanes (&b)[3], Lanes (&r)[3]) {
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    r[d] = a[e] * b[f] - a[f] * b[e];
  }
}

template <bool kSigned, bool kWeighted>
void sum_cliques(const Star& star, double apex[4]) {
  const Star s = star;
  const Lanes zero(0.0);
  for (std::int32_t k = 0; k < s.count + kWide; ++k) {
    for (int d = 0; d < 3; ++d) s.f[d][k] = 0;
    s.e[k] = 0;
  }
  for (std::int32_t r = 0; r < 4 * s.count; ++r) store_lanes8(zero, s.rows + kWide * r);
  Lanes apex_energy = zero;
  for_pairs(s, [&](std::int32_t j, std::int32_t k, const std::uint64_t* row_j,
                   const std::uint64_t* row_k) {
    const Pair pair(s, j, k);
    Lanes h[3] = {zero, zero, zero}, energy = zero;
    double own = 0, weight_j = 0, weight_k = 0, both = 0;
    if constexpr (kWeighted) {
      const double dj = s.carries[j], dk = s.carries[k];
      const double djk = bit_of(s.carrying + static_cast<std::int64_t>(s.words) * j, k) ? 1.0 : 0.0;
      own = 0.25 * s.apex_weight * dj * dk;
      weight_j = 0.25 * s.weight[j] * dj * djk;
      weight_k = 0.25 * s.weight[k] * dk * djk;
      both = 0.25;
    }
    for_common(s, k, row_j, row_k, [&](std::int32_t l, unsigned byte) {
      Tetrahedra t;
      t.template find<kSigned>(s, pair, l, byte);
      Lanes stored = 0.5 * (t.size * t.g * t.g);
      if constexpr (kWeighted) {
        const std::int64_t words = s.words;
        const auto bits = [&](std::int32_t m) {
          return lanes_of(
              static_cast<unsigned>((s.carrying[words * m + (l >> 6)] >> (l & 63)) & 0xffu));
        };
        const Lanes dl = load_lanes8(s.carries + l), djl = bits(j), dkl = bits(k);
        const Lanes w = own * dl + weight_j * djl + weight_k * dkl +
                        both * load_lanes8(s.weight + l) * dl * djl * dkl;
        t.g = t.g * w;
        stored = 0.25 * (stored * w);
      }
      energy = energy + stored;
      store_lanes8(load_lanes8(s.e + l) + stored, s.e + l);
      for (int d = 0; d < 3; ++d) {
        h[d] = h[d] + t.g * t.c[d];
        store_lanes8(load_lanes8(s.f[d] + l) - t.g * pair.p.c[d], s.f[d] + l);
      }
    });
    Lanes on_j[3], from_k[3];  // G_j, and minus G_k
    cross(pair.b, h, on_j);
    cross(pair.a, h, from_k);
    double *rows_j = s.rows + 4 * kWide * j, *rows_k = s.rows + 4 * kWide * k;
    for (int d = 0; d < 3; ++d) {
      store_lanes8(load_lanes8(rows_j + kWide * d) - on_j[d], rows_j + kWide * d);
      store_lanes8(load_lanes8(rows_k + kWide * d) + from_k[d], rows_k + kWide * d);
    }
    store_lanes8(load_lanes8(rows_j + kWide * 3) + energy, rows_j + kWide * 3);
    store_lanes8(load_lanes8(rows_k + kWide * 3) + energy, rows_k + kWide * 3);
    apex_energy = apex_energy + energy;
  });
  for (std::int32_t k = 0; k < s.count; ++k) {
    for (int d = 0; d < 3; ++d) s.f[d][k] += sum_of(load_lanes8(s.rows + kWide * (4 * k + d)));
    s.e[k] += sum_of(load_lanes8(s.rows + kWide * (4 * k + 3)));
  }
  apex[0] = apex[1] = apex[2] = 0;
  for (std::int32_t k = 0; k < s.count; ++k)
    for (int d = 0; d < 3; ++d) apex[d] -= s.f[d][k];
  apex[3] = sum_of(apex_energy);
}

void cliques(const Star& s, double apex[4]) {
  if (s.weight != nullptr) {
    s.signed_volume ? sum_cliques<true, true>(s, apex) : sum_cliques<false, true>(s, apex);
  } else {
    s.signed_volume ? sum_cliques<true, false>(s, apex) : sum_cliques<false, false>(s, apex);
  }
}

// Lanes are added at the end, not for each pair.
template <bool kSigned>
void sum_apex(const Star& star, ApexSums& sums) {
  const Star s = star;
  const Lanes zero(0.0);
  Lanes force[3] = {zero, zero, zero}, energy = zero, rate = zero;
  for_pairs(s, [&](std::int32_t j, std::int32_t k, const std::uint64_t* row_j,
                   const std::uint64_t* row_k) {
    const Pair pair(s, j, k);
    Lanes h[3] = {zero, zero, zero}, hv[3] = {zero, zero, zero}, total = zero;
    for_common(s, k, row_j, row_k, [&](std::int32_t l, unsigned byte) {
      Tetrahedra t;
      t.template find<kSigned>(s, pair, l, byte);
      total = total + t.g;
      energy = energy + t.size * t.g * t.g;
      for (int d = 0; d < 3; ++d) {
        h[d] = h[d] + t.g * t.c[d];
        hv[d] = hv[d] + t.g * load_lanes8(s.velocity[d] + l);
      }
    });
    Lanes on_j[3], from_k[3];  // G_j, and minus G_k
    cross(pair.b, h, on_j);
    cross(pair.a, h, from_k);
    for (int d = 0; d < 3; ++d) {
      force[d] = force[d] + (on_j[d] - from_k[d] + total * pair.p.c[d]);
      rate =
          rate + (s.velocity[d][j] * on_j[d] - s.velocity[d][k] * from_k[d] + pair.p.c[d] * hv[d]);
    }
  });
  for (int d = 0; d < 3; ++d) sums.force[d] = sum_of(force[d]);
  sums.energy = 0.5 * sum_of(energy);
  sums.rate = sum_of(rate);
}

template <bool kSigned>
void sum_stress(const Star& star, double stress[9]) {
  const Star s = star;
  const Lanes zero(0.0);
  Lanes sum[9];
  for (auto& component : sum) component = zero;
  for_pairs(s, [&](std::int32_t j, std::int32_t k, const std::uint64_t* row_j,
                   const std::uint64_t* row_k) {
    const Pair pair(s, j, k);
    Lanes h[3] = {zero, zero, zero}, h0[3] = {zero, zero, zero};
    for_common(s, k, row_j, row_k, [&](std::int32_t l, unsigned byte) {
      Tetrahedra t;
      t.template find<kSigned>(s, pair, l, byte);
      for (int d = 0; d < 3; ++d) {
        h[d] = h[d] + t.g * t.c[d];
        h0[d] = h0[d] + t.g * t.C[d];
      }
    });
    Lanes on_j[3], from_k[3];
    cross(pair.b, h, on_j);
    cross(pair.a, h, from_k);
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 3; ++m)
        sum[3 * d + m] =
            sum[3 * d + m] + (on_j[d] * pair.A[m] - from_k[d] * pair.B[m] + pair.p.c[d] * h0[m]);
  });
  for (int k = 0; k < 9; ++k) stress[k] = sum_of(sum[k]);
}

void stress_sums(const Star& s, double stress[9]) {
  s.signed_volume ? sum_stress<true>(s, stress) : sum_stress<false>(s, stress);
}

CLEAVE_INLINE Lanes norm(const Lanes (&a)[3]) {
  return square_root(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}
void numbers(const Star& star, StarNumbers& numbers) {
  const Star s = star;
  StarNumbers r{};
  for_pairs(s, [&](std::int32_t j, std::int32_t k, const std::uint64_t* row_j,
                   const std::uint64_t* row_k) {
    const Pair pair(s, j, k);
    Lanes count(0.0), volume(0.0), rate(0.0);
    for_common(s, k, row_j, row_k, [&](std::int32_t l, unsigned byte) {
      Tetrahedra t;
      t.template find<true>(s, pair, l, byte);
      Lanes gj[3], gk[3], gl[3], gi[3];
      cross(pair.B, t.C, gj);
      cross(pair.A, t.C, gk);
      for (int d = 0; d < 3; ++d) {
        gk[d] = -gk[d];
        gl[d] = Lanes(pair.P.c[d]);
        gi[d] = gj[d] + gk[d] + gl[d];
      }
      const Lanes own = norm(gi), all = own + norm(gj) + norm(gk) + norm(gl);
      count = count + t.there;
      volume = volume + t.there * t.size;
      rate = rate + t.there * (own * all / select(t.size > s.flat, t.size, Lanes(1.0)));
    });
    r.count += sum_of(count);
    r.volume += sum_of(volume);
    r.rate += sum_of(rate);
  });
  numbers = r;
}

void apex_sums(const Star& s, ApexSums& sums) {
  s.signed_volume ? sum_apex<true>(s, sums) : sum_apex<false>(s, sums);
}

}  // namespace
}  // namespace cpd

extern const cleave_call::CliqueKernels kCliqueKernels;
constinit const cleave_call::CliqueKernels kCliqueKernels = {
    &cpd::relate, &cpd::cliques, &cpd::apex_sums, &cpd::stress_sums, &cpd::numbers};

}  // namespace cleave
