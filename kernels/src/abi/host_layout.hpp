// Tensors of material points in the layout of a host: strides, component orders, symmetric storage,
// components that are not there.
#pragma once

#include <algorithm>

#include "abi/guard.hpp"
#include "core/tensor.hpp"

namespace cleave::abi {

inline constexpr std::int64_t kAbsent = -1;

struct HostLayout {
  std::int64_t point;
  std::int64_t component;
  std::int64_t place[9];  // of 11 21 31 12 22 32 13 23 33; kAbsent: not there
  bool repeats;           // a place is named twice: symmetric storage
  bool complete;          // none is absent

  std::int64_t of(int i, int j) const { return place[cleave::component(i, j)]; }
  // Entries from one place to the next in a matrix of components by components.
  std::int64_t components() const { return *std::max_element(place, place + 9) + 1; }
};

// Throws BAD_ARGUMENT for places outside -1 to 8, and for a place shared by other than a component and
// its transpose.
inline HostLayout host_layout(const char* name, std::int64_t point, std::int64_t component,
                              const std::int64_t (&order)[9]) {
  HostLayout l{point, component, {}, false, true};
  for (int k = 0; k < 9; ++k) {
    const std::int64_t place = order[k];
    if (place < kAbsent || place > 8) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(name, "_order[", k, "] is ", place,
                       "; allowed: 0 to 8, the places of 11 21 31 12 22 32 13 23 33, and -1 where "
                       "there is none"));
    }
    for (int other = 0; other < k; ++other) {
      if (place == kAbsent || order[other] != place) continue;
      if (other / 3 != k % 3 || other % 3 != k / 3) {
        throw Error(CLEAVE_BAD_ARGUMENT,
                    text(name, "_order[", other, "] and [", k, "] are both ", place,
                         "; only a component and its transpose may share a place"));
      }
      l.repeats = true;
    }
    l.place[k] = place;
    l.complete = l.complete && place != kAbsent;
  }
  return l;
}

// Components outside of D x D, and absent ones, are zero.
template <int D>
Mat<D> load(const double* base, const HostLayout& l, std::int64_t q) {
  const double* from = base + l.point * q;
  Mat<D> m;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      if (l.complete || l.of(i, j) != kAbsent) m(i, j) = from[l.component * l.of(i, j)];
  return m;
}

inline void store(const Mat<3>& m, double* base, const HostLayout& l, std::int64_t q) {
  double* to = base + l.point * q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (l.complete || l.of(i, j) != kAbsent) to[l.component * l.of(i, j)] = m(i, j);
}

}  // namespace cleave::abi
