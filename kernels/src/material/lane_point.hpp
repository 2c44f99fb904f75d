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

namespace cleave {

template <class R, int kHistoryComponents>
struct LanePoint {
  Full<R> h;                                  // F - I
  std::array<R, kHistoryComponents> history;  // all components in the order of kHistory
  Full<R> p;
  R energy{0.0}, plastic{0.0}, viscous{0.0};  // [J m-3]
  MaskOf<R> valid;
};

inline Full<double> embed(const Mat<3>& h) {
  return {h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1), h(2, 2)};
}
inline Full<double> embed(const Mat<2>& h) {
  return {h(0, 0), h(0, 1), 0.0, h(1, 0), h(1, 1), 0.0, 0.0, 0.0, 0.0};
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

}  // namespace cleave
