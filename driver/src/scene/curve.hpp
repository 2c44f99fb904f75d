// How a load grows over time: the factor on its value, and, for prescribed motions, what
// displacement, velocity and acceleration follow from it. Curves have no memory: everything is a
// function of time.
#pragma once

#include <vector>

#include "deck/deck.hpp"

namespace cleave::driver {

enum class MotionKind { displacement, velocity, acceleration };

struct MotionValue {
  double displacement = 0, velocity = 0, acceleration = 0;
};

class Curve {
 public:
  // From the keys curve, ramp, begin, times, factors of a &load. Throws DeckError.
  static Curve of_load(const Deck& deck, const DeckGroup& load);

  // Factor on the value of a force; zero before `begin`. A smooth ramp is 3s^2 - 2s^3 [CBM 30].
  double factor(double time) const;
  // Motion at `time` of a displacement, velocity or acceleration value * factor; integrals are
  // exact and start from zero at `begin`. A smooth displacement is [CBM 26], the others are [CBM
  // 30]. At a kink the values are those just after it.
  MotionValue motion(MotionKind kind, double value, double time) const;
  // Zero with its derivatives at every time up to this one.
  bool is_zero_until(double time) const;
  // Why the accelerations of this curve alone cannot reproduce it (a jump of displacement or
  // velocity during the run); empty if they can.
  const char* jump(MotionKind kind) const;

 private:
  // A piecewise linear function that is constant after its last knot, with its two integrals.
  struct Table {
    std::vector<double> times, values, first_integral, second_integral;
    void integrate();
  };
  bool is_constant() const;

  bool smooth_ = false;
  double ramp_ = 0, begin_ = 0;
  Table table_;  // when not smooth; its first knot is at 0
};

}  // namespace cleave::driver
