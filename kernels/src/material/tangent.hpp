// The consistent tangent of a law at a point: the law's own, or by differences where it has none.
#pragma once

#include <cmath>

#include "core/tangent.hpp"
#include "material/stress.hpp"

namespace cleave {

template <class Law, int D>
concept HasTangent = requires(const Law& law, const Mat<D>& h, const History& history,
                              const Increment& increment, Tangent<D>& a) {
  law.template tangent<D>(h, history, increment, a);
};

// A = dP/dF by central differences of the response from the committed history: good to about eight
// digits, for laws that do not bring their own.
template <int D>
bool difference_tangent(const Material& material, const HistoryArrays& committed, const Mat<D>& h,
                        const Increment& increment, std::int64_t q, Tangent<D>& a) {
  double size = 1;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) size = std::fmax(size, std::fabs(h(i, j)));
  const double step = 6e-6 * size;  // cube root of the rounding unit
  for (int k = 0; k < D; ++k) {
    for (int l = 0; l < D; ++l) {
      Mat<D> above = h, below = h;
      above(k, l) += step;
      below(k, l) -= step;
      const auto up = trial_response<D>(material, committed, above, increment, q);
      const auto down = trial_response<D>(material, committed, below, increment, q);
      if (!up.valid || !down.valid) return false;
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          a(i, j, k, l) = (up.stress(i, j) - down.stress(i, j)) / (above(k, l) - below(k, l));
    }
  }
  return true;
}

// False where the law has no answer. The history is read and left alone.
template <int D>
bool tangent_at(const Material& material, const HistoryArrays& committed, const Mat<D>& h,
                const Increment& increment, std::int64_t q, Tangent<D>& a) {
  return with_law(material, [&](const auto& law) {
    if constexpr (HasTangent<std::decay_t<decltype(law)>, D>) {
      return law.template tangent<D>(h, committed.at(q), increment, a);
    } else {
      return difference_tangent<D>(material, committed, h, increment, q, a);
    }
  });
}

}  // namespace cleave
