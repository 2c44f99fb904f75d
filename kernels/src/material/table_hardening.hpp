// Yield stress by straight lines between given points of plastic strain and stress, constant beyond
// the last one.
#pragma once

#include "material/hardening.hpp"

namespace cleave {

constexpr ParameterSpec strain_parameter(const char* name) {
  return real_parameter(name, "1", kNotNegative, 0.0,
                        "equivalent plastic strain of a point of the hardening curve");
}
constexpr ParameterSpec stress_parameter(const char* name) {
  return real_parameter(name, "Pa", kNotNegative, 0.0,
                        "yield stress (Kirchhoff) at that strain; 0: there is no such point");
}

class TableHardening : public RateIndependent {
 public:
  static constexpr int kPoints = 12;

  static constexpr std::array kParameters = {
      required_parameter("tau_y0", "Pa", kPositive, "initial yield stress (Kirchhoff)"),
      strain_parameter("strain_1"),
      stress_parameter("stress_1"),
      strain_parameter("strain_2"),
      stress_parameter("stress_2"),
      strain_parameter("strain_3"),
      stress_parameter("stress_3"),
      strain_parameter("strain_4"),
      stress_parameter("stress_4"),
      strain_parameter("strain_5"),
      stress_parameter("stress_5"),
      strain_parameter("strain_6"),
      stress_parameter("stress_6"),
      strain_parameter("strain_7"),
      stress_parameter("stress_7"),
      strain_parameter("strain_8"),
      stress_parameter("stress_8"),
      strain_parameter("strain_9"),
      stress_parameter("stress_9"),
      strain_parameter("strain_10"),
      stress_parameter("stress_10"),
      strain_parameter("strain_11"),
      stress_parameter("stress_11"),
      strain_parameter("strain_12"),
      stress_parameter("stress_12"),
  };

  // Throws BAD_ARGUMENT for a curve that does not go forward or has a gap.
  explicit TableHardening(std::span<const double> p) : initial_(p[0]), least_(p[0]) {
    double strain = 0, stress = initial_;
    for (std::size_t k = 1; k <= kPoints; ++k) {
      const double next_strain = p[2 * k - 1], next_stress = p[2 * k];
      if (!(next_stress > 0)) {
        check_unused(p, k);
        break;
      }
      if (!(next_strain > strain)) {
        throw Error(CLEAVE_BAD_ARGUMENT,
                    text("strain_", k, " is ", next_strain, " after ", strain,
                         "; allowed: larger than the one before (and than 0); sort the points"));
      }
      begin_[count_] = strain;
      end_[count_] = next_strain;
      slope_[count_] = (next_stress - stress) / (next_strain - strain);
      least_slope_ = std::min(least_slope_, slope_[count_]);
      ++count_;
      strain = next_strain;
      stress = next_stress;
      least_ = std::min(least_, stress);
    }
  }

  double least_slope() const { return least_slope_; }
  // A little below the least point: the sum over the lines rounds.
  template <class R, class M>
  R lower_bound(const R&, const M&) const {
    return R(least_ * (1 - 1e-12));
  }

  template <class R>
  struct Start {
    R strain, yield, slope;
  };
  template <class R, class M>
  Start<R> start(const R& e, const M&, const Setting<R>&) const {
    Start<R> s{R(0.0), R(initial_), R(0.0)};
    R rise;
    advance(s, e, rise, s.slope);
    s.strain = e;
    s.yield = initial_ + rise;
    return s;
  }
  template <class R>
  void advance(const Start<R>& s, const R& x, R& rise, R& slope) const {
    rise = R(0.0);
    slope = R(0.0);
    for (std::size_t k = 0; k < count_; ++k) {
      const Part<R> part = part_of(s, x, k);
      rise = rise + slope_[k] * part.length;
      slope = select(part.ends_here, R(slope_[k]), slope);
    }
  }
  template <class R>
  R work(const Start<R>& s, const R& x, const R&) const {
    R sum = s.yield * x;
    for (std::size_t k = 0; k < count_; ++k) {
      const Part<R> part = part_of(s, x, k);
      sum = sum + slope_[k] * (part.length * (0.5 * part.length + part.after));
    }
    return sum;
  }

 private:
  // The part of [e, e+x] on line k, measured from e so that a small x keeps its digits.
  template <class R>
  struct Part {
    R length, after;  // `after`: what follows of x
    MaskOf<R> ends_here;
  };
  template <class R>
  Part<R> part_of(const Start<R>& s, const R& x, std::size_t k) const {
    const R to_begin = begin_[k] - s.strain, to_end = end_[k] - s.strain;
    const R low = larger(to_begin, R(0.0)), high = smaller(to_end, x);
    const MaskOf<R> ends_here = (x >= to_begin) & (x < to_end);
    return {larger(high - low, R(0.0)), x - high, ends_here};
  }

  static void check_unused(std::span<const double> p, std::size_t k) {
    for (std::size_t later = k; later <= kPoints; ++later) {
      if (p[2 * later] > 0 || p[2 * later - 1] > 0) {
        throw Error(CLEAVE_BAD_ARGUMENT, text("stress_", k, " is 0, which ends the curve, but ",
                                              p[2 * later] > 0 ? "stress_" : "strain_", later,
                                              " is given; number the points without a gap"));
      }
    }
  }

  std::size_t count_ = 0;
  double initial_, least_, least_slope_ = 0;
  std::array<double, kPoints> begin_{}, end_{}, slope_{};
};

}  // namespace cleave
