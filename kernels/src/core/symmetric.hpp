// Full and symmetric 3x3 tensors of R = double or Pack, and what the laws form with them. Components
// are written out: loops over them would keep them in memory.
#pragma once

#include "core/lanes.hpp"

namespace cleave {

template <class R>
struct Full {
  R xx{0.0}, xy{0.0}, xz{0.0}, yx{0.0}, yy{0.0}, yz{0.0}, zx{0.0}, zy{0.0}, zz{0.0};
};

// Order in arrays: 11 22 33 12 23 31.
template <class R>
struct Symmetric {
  R xx{0.0}, yy{0.0}, zz{0.0}, xy{0.0}, yz{0.0}, zx{0.0};
};

template <class R>
CLEAVE_INLINE R trace(const Symmetric<R>& s) {
  return (s.xx + s.yy) + s.zz;
}

// s : s
template <class R>
CLEAVE_INLINE R squared_norm(const Symmetric<R>& s) {
  return ((s.xx * s.xx + s.yy * s.yy) + s.zz * s.zz) +
         2.0 * ((s.xy * s.xy + s.yz * s.yz) + s.zx * s.zx);
}

template <class R>
CLEAVE_INLINE R determinant(const Symmetric<R>& s) {
  return (s.xx * (s.yy * s.zz - s.yz * s.yz) + s.xy * (s.yz * s.zx - s.xy * s.zz)) +
         s.zx * (s.xy * s.yz - s.yy * s.zx);
}

// Plus a multiple of the identity.
template <class R>
CLEAVE_INLINE Symmetric<R> plus_spherical(Symmetric<R> s, const R& p) {
  s.xx = s.xx + p;
  s.yy = s.yy + p;
  s.zz = s.zz + p;
  return s;
}

template <class R>
CLEAVE_INLINE Symmetric<R> scaled(const R& a, const Symmetric<R>& s) {
  return {a * s.xx, a * s.yy, a * s.zz, a * s.xy, a * s.yz, a * s.zx};
}

template <class R>
CLEAVE_INLINE Symmetric<R> operator+(const Symmetric<R>& a, const Symmetric<R>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
}

template <class R>
CLEAVE_INLINE Symmetric<R> select(const MaskOf<R>& m, const Symmetric<R>& a,
                                  const Symmetric<R>& b) {
  return {select(m, a.xx, b.xx), select(m, a.yy, b.yy), select(m, a.zz, b.zz),
          select(m, a.xy, b.xy), select(m, a.yz, b.yz), select(m, a.zx, b.zx)};
}
template <class R>
CLEAVE_INLINE Full<R> select(const MaskOf<R>& m, const Full<R>& a, const Full<R>& b) {
  return {select(m, a.xx, b.xx), select(m, a.xy, b.xy), select(m, a.xz, b.xz),
          select(m, a.yx, b.yx), select(m, a.yy, b.yy), select(m, a.yz, b.yz),
          select(m, a.zx, b.zx), select(m, a.zy, b.zy), select(m, a.zz, b.zz)};
}

template <class R>
CLEAVE_INLINE Symmetric<double> lane(const Symmetric<R>& s, int l) {
  return {lane(s.xx, l), lane(s.yy, l), lane(s.zz, l), lane(s.xy, l), lane(s.yz, l), lane(s.zx, l)};
}
template <class R>
CLEAVE_INLINE void set_lane(Symmetric<R>& s, int l, const Symmetric<double>& v) {
  set_lane(s.xx, l, v.xx);
  set_lane(s.yy, l, v.yy);
  set_lane(s.zz, l, v.zz);
  set_lane(s.xy, l, v.xy);
  set_lane(s.yz, l, v.yz);
  set_lane(s.zx, l, v.zx);
}

// A B of symmetric A and B that commute: symmetric.
template <class R>
CLEAVE_INLINE Symmetric<R> commuting_product(const Symmetric<R>& a, const Symmetric<R>& b) {
  return {(a.xx * b.xx + a.xy * b.xy) + a.zx * b.zx, (a.xy * b.xy + a.yy * b.yy) + a.yz * b.yz,
          (a.zx * b.zx + a.yz * b.yz) + a.zz * b.zz, (a.xx * b.xy + a.xy * b.yy) + a.zx * b.yz,
          (a.xy * b.zx + a.yy * b.yz) + a.yz * b.zz, (a.zx * b.xx + a.yz * b.xy) + a.zz * b.zx};
}

// H + Z + H Z, that is F (I+Z) - I with F = I + H.
template <class R>
CLEAVE_INLINE Full<R> compose(const Full<R>& h, const Symmetric<R>& z) {
  return {h.xx + (z.xx + ((h.xx * z.xx + h.xy * z.xy) + h.xz * z.zx)),
          h.xy + (z.xy + ((h.xx * z.xy + h.xy * z.yy) + h.xz * z.yz)),
          h.xz + (z.zx + ((h.xx * z.zx + h.xy * z.yz) + h.xz * z.zz)),
          h.yx + (z.xy + ((h.yx * z.xx + h.yy * z.xy) + h.yz * z.zx)),
          h.yy + (z.yy + ((h.yx * z.xy + h.yy * z.yy) + h.yz * z.yz)),
          h.yz + (z.yz + ((h.yx * z.zx + h.yy * z.yz) + h.yz * z.zz)),
          h.zx + (z.zx + ((h.zx * z.xx + h.zy * z.xy) + h.zz * z.zx)),
          h.zy + (z.yz + ((h.zx * z.xy + h.zy * z.yy) + h.zz * z.yz)),
          h.zz + (z.zz + ((h.zx * z.zx + h.zy * z.yz) + h.zz * z.zz))};
}

template <class R>
CLEAVE_INLINE R join_bits(const Symmetric<R>& s) {
  return join_bits(join_bits(join_bits(s.xx, s.yy), join_bits(s.zz, s.xy)), join_bits(s.yz, s.zx));
}
template <class R>
CLEAVE_INLINE R join_bits(const Full<R>& t) {
  return join_bits(join_bits(join_bits(join_bits(t.xx, t.xy), join_bits(t.xz, t.yx)),
                             join_bits(join_bits(t.yy, t.yz), join_bits(t.zx, t.zy))),
                   t.zz);
}

// F (I+Z) F^T - I, without forming anything near I: [K + H^T + K H^T] with K = compose(H, Z).
template <class R>
CLEAVE_INLINE Symmetric<R> push_forward_minus_identity(const Full<R>& h, const Symmetric<R>& z) {
  Full<R> k;
  if (any_not_zero(join_bits(z))) {
    k = compose(h, z);
  } else {  // the same bits: the sum turns -0 to +0
    k = {h.xx + 0.0, h.xy + 0.0, h.xz + 0.0, h.yx + 0.0, h.yy + 0.0,
         h.yz + 0.0, h.zx + 0.0, h.zy + 0.0, h.zz + 0.0};
  }
  return {k.xx + (h.xx + ((k.xx * h.xx + k.xy * h.xy) + k.xz * h.xz)),
          k.yy + (h.yy + ((k.yx * h.yx + k.yy * h.yy) + k.yz * h.yz)),
          k.zz + (h.zz + ((k.zx * h.zx + k.zy * h.zy) + k.zz * h.zz)),
          k.xy + (h.yx + ((k.xx * h.yx + k.xy * h.yy) + k.xz * h.yz)),
          k.yz + (h.zy + ((k.yx * h.zx + k.yy * h.zy) + k.yz * h.zz)),
          k.zx + (h.xz + ((k.zx * h.xx + k.zy * h.xy) + k.zz * h.xz))};
}

// (F^T F - I)/2 of F = I + H, with all digits for small H.
template <class R>
CLEAVE_INLINE Symmetric<R> green_lagrange(const Full<R>& h) {
  return {h.xx + 0.5 * ((h.xx * h.xx + h.yx * h.yx) + h.zx * h.zx),
          h.yy + 0.5 * ((h.xy * h.xy + h.yy * h.yy) + h.zy * h.zy),
          h.zz + 0.5 * ((h.xz * h.xz + h.yz * h.yz) + h.zz * h.zz),
          0.5 * ((h.xy + h.yx) + ((h.xx * h.xy + h.yx * h.yy) + h.zx * h.zy)),
          0.5 * ((h.yz + h.zy) + ((h.xy * h.xz + h.yy * h.yz) + h.zy * h.zz)),
          0.5 * ((h.zx + h.xz) + ((h.xz * h.xx + h.yz * h.yx) + h.zz * h.zx))};
}

// A S
template <class R>
CLEAVE_INLINE Full<R> multiply(const Full<R>& a, const Symmetric<R>& s) {
  return {(a.xx * s.xx + a.xy * s.xy) + a.xz * s.zx, (a.xx * s.xy + a.xy * s.yy) + a.xz * s.yz,
          (a.xx * s.zx + a.xy * s.yz) + a.xz * s.zz, (a.yx * s.xx + a.yy * s.xy) + a.yz * s.zx,
          (a.yx * s.xy + a.yy * s.yy) + a.yz * s.yz, (a.yx * s.zx + a.yy * s.yz) + a.yz * s.zz,
          (a.zx * s.xx + a.zy * s.xy) + a.zz * s.zx, (a.zx * s.xy + a.zy * s.yy) + a.zz * s.yz,
          (a.zx * s.zx + a.zy * s.yz) + a.zz * s.zz};
}
// S A
template <class R>
CLEAVE_INLINE Full<R> multiply(const Symmetric<R>& s, const Full<R>& a) {
  return {(s.xx * a.xx + s.xy * a.yx) + s.zx * a.zx, (s.xx * a.xy + s.xy * a.yy) + s.zx * a.zy,
          (s.xx * a.xz + s.xy * a.yz) + s.zx * a.zz, (s.xy * a.xx + s.yy * a.yx) + s.yz * a.zx,
          (s.xy * a.xy + s.yy * a.yy) + s.yz * a.zy, (s.xy * a.xz + s.yy * a.yz) + s.yz * a.zz,
          (s.zx * a.xx + s.yz * a.yx) + s.zz * a.zx, (s.zx * a.xy + s.yz * a.yy) + s.zz * a.zy,
          (s.zx * a.xz + s.yz * a.yz) + s.zz * a.zz};
}

// A^T S A
template <class R>
CLEAVE_INLINE Symmetric<R> pull_back(const Full<R>& a, const Symmetric<R>& s) {
  const Full<R> b = multiply(s, a);
  return {(a.xx * b.xx + a.yx * b.yx) + a.zx * b.zx, (a.xy * b.xy + a.yy * b.yy) + a.zy * b.zy,
          (a.xz * b.xz + a.yz * b.yz) + a.zz * b.zz, (a.xx * b.xy + a.yx * b.yy) + a.zx * b.zy,
          (a.xy * b.xz + a.yy * b.yz) + a.zy * b.zz, (a.xz * b.xx + a.yz * b.yx) + a.zz * b.zx};
}

// cof F and det F - 1 of F = I + H; the latter without the cancellation of det F - 1.
template <class R>
struct Cofactor {
  Full<R> cofactor{R(1.0), R(0.0), R(0.0), R(0.0), R(1.0), R(0.0), R(0.0), R(0.0), R(1.0)};
  R volume_change{0.0};
};
template <class R>
CLEAVE_INLINE Cofactor<R> select(const MaskOf<R>& m, const Cofactor<R>& a, const Cofactor<R>& b) {
  return {select(m, a.cofactor, b.cofactor), select(m, a.volume_change, b.volume_change)};
}
template <class R>
CLEAVE_INLINE Cofactor<R> cofactor_of(const Full<R>& h) {
  const R fx = 1.0 + h.xx, fy = 1.0 + h.yy, fz = 1.0 + h.zz;
  const R change = (h.yy + h.zz) + (h.yy * h.zz - h.yz * h.zy);  // cof_xx - 1
  Cofactor<R> c;
  c.cofactor.xx = 1.0 + change;
  c.cofactor.xy = h.yz * h.zx - h.yx * fz;
  c.cofactor.xz = h.yx * h.zy - fy * h.zx;
  c.cofactor.yx = h.xz * h.zy - h.xy * fz;
  c.cofactor.yy = fx * fz - h.xz * h.zx;
  c.cofactor.yz = h.xy * h.zx - fx * h.zy;
  c.cofactor.zx = h.xy * h.yz - h.xz * fy;
  c.cofactor.zy = h.xz * h.yx - fx * h.yz;
  c.cofactor.zz = fx * fy - h.xy * h.yx;
  c.volume_change =
      (change + h.xx) + (h.xx * change + (h.xy * c.cofactor.xy + h.xz * c.cofactor.xz));
  return c;
}

}  // namespace cleave
