// Points of a law in lanes: what a law that works on several points at once is given and gives.
//
// Such a law has `kLaneHistory`, the number of history components, and
//   template <class R> void update(LanePoint<R, kLaneHistory>&, const Setting<R>&) const
// for R = double and R = Pack, in three dimensions. It changes history and valid, and sets the
// rest; where valid is false at the end nothing of the point may be used.
#pragma once

#include <array>

#include "core/symmetric.hpp"
#include "core/tensor.hpp"
#include "material/kinematics.hpp"

namespace cleave {

// The step as a point sees it.
template <class R>
struct Setting {
  double dt = 0;        // [s]; 0: no rates
  R length{0.0};        // [m]
  R volume_ratio{1.0};  // J at the end of the step
};

template <class R, int kHistoryComponents>
struct LanePoint {
  Full<R> h;                                  // F - I
  std::array<R, kHistoryComponents> history;  // all components in the order of kHistory
  Full<R> p;
  R energy{0.0}, plastic{0.0}, viscous{0.0};  // [J m-3]
  MaskOf<R> valid;
  bool unchanged = false;  // whether the history is as it was in all lanes, and need not be stored
};

// det F - 1 and cof F. Lanes with det F <= 0 lose `valid` and get H = 0, so that nothing traps. H is finite
// and its products are.
template <class R>
CLEAVE_INLINE Cofactor<R> upright_cofactor(Full<R>& h, MaskOf<R>& valid) {
  Cofactor<R> c = cofactor_of(h);
  const MaskOf<R> upright = c.volume_change > -1.0;
  if (!all(upright)) {
    h = select(upright, h, Full<R>{});
    c = select(upright, c, Cofactor<R>{});
    valid = valid & upright;
  }
  return c;
}
template <class R>
CLEAVE_INLINE R sum_of_sizes(const Full<R>& h) {
  return ((absolute(h.xx) + absolute(h.xy)) + (absolute(h.xz) + absolute(h.yx))) +
         ((absolute(h.yy) + absolute(h.yz)) + (absolute(h.zx) + absolute(h.zy))) + absolute(h.zz);
}

inline Full<double> embed(const Mat<3>& h) {
  return {h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1), h(2, 2)};
}
inline Full<double> embed(const Mat<2>& h) {
  return {h(0, 0), h(0, 1), 0.0, h(1, 0), h(1, 1), 0.0, 0.0, 0.0, 0.0};
}
inline Mat<3> components(const Symmetric<double>& s) {
  Mat<3> m;
  m(0, 0) = s.xx;
  m(1, 1) = s.yy;
  m(2, 2) = s.zz;
  m(0, 1) = m(1, 0) = s.xy;
  m(1, 2) = m(2, 1) = s.yz;
  m(0, 2) = m(2, 0) = s.zx;
  return m;
}
template <int D>
Mat<D> extract(const Full<double>& p) {
  Mat<D> m;
  m(0, 0) = p.xx;
  m(0, 1) = p.xy;
  m(1, 0) = p.yx;
  m(1, 1) = p.yy;
  if constexpr (D == 3) {
    m(0, 2) = p.xz;
    m(1, 2) = p.yz;
    m(2, 0) = p.zx;
    m(2, 1) = p.zy;
    m(2, 2) = p.zz;
  }
  return m;
}

// The answer of a law without history, in the plane or in space, from its update in lanes.
template <int D, class Law>
Response<Mat<D>> respond_by_update(const Law& law, const Full<double>& h,
                                   const Setting<double>& setting) {
  LanePoint<double, 0> point{};
  point.h = h;
  law.update(point, setting);
  Response<Mat<D>> r;
  r.valid = point.valid;
  if (!r.valid) return r;
  r.stress = extract<D>(point.p);
  r.stress_33 = D == 2 ? point.p.zz : 0.0;
  r.energy = point.energy;
  return r;
}

}  // namespace cleave
