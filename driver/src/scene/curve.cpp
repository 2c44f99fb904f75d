#include "scene/curve.hpp"

#include <algorithm>

#include "scene/format.hpp"
#include "scene/model.hpp"

namespace cleave::driver {
namespace {

void check_table(const Deck& deck, const DeckGroup& load) {
  const auto& times = load.reals("times");
  const auto& factors = load.reals("factors");
  if (times.empty()) deck.fail(load, "times", "curve = 'table' needs times and factors");
  if (times.size() != factors.size()) {
    deck.fail(load, "factors",
              "a table needs as many factors as times; here " + std::to_string(factors.size()) +
                  " and " + std::to_string(times.size()));
  }
  if (times.front() < 0) {
    deck.fail(load, "times", "the first time is " + number(times.front()) + "; it must be >= 0");
  }
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (!(times[k] > times[k - 1])) {
      deck.fail(load, "times",
                "times must increase; entry " + std::to_string(k + 1) + " is " + number(times[k]) +
                    " after " + number(times[k - 1]));
    }
  }
}

// Smooth ramp of an acceleration [CBM 30], integrated twice with s = t/tau: the displacement is
// tau^2 (s^4/4 - s^5/10), and a parabola after the ramp.
MotionValue smooth_acceleration(double value, double tau, double t) {
  MotionValue out;
  check(
      cleave_ramp(CLEAVE_RAMP_VELOCITY, value, tau, t, &out.velocity, &out.acceleration, nullptr));
  const double s = std::min(t / tau, 1.0);
  const double after = std::max(t - tau, 0.0);
  out.displacement = value * tau * tau * (s * s * s * s) * (0.25 - 0.1 * s) +
                     0.5 * value * tau * after + 0.5 * value * after * after;
  return out;
}

}  // namespace

void Curve::Table::integrate() {
  first_integral.assign(times.size(), 0.0);
  second_integral.assign(times.size(), 0.0);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double h = times[k] - times[k - 1];
    first_integral[k] = first_integral[k - 1] + 0.5 * h * (values[k - 1] + values[k]);
    second_integral[k] = second_integral[k - 1] + h * first_integral[k - 1] +
                         h * h * (2 * values[k - 1] + values[k]) / 6;
  }
}

Curve Curve::of_load(const Deck& deck, const DeckGroup& load) {
  Curve curve;
  const std::string& kind = load.text("curve");
  curve.smooth_ = kind == "smooth";
  curve.ramp_ = load.real("ramp");
  curve.begin_ = load.real("begin");
  if ((kind == "smooth" || kind == "linear") && !(curve.ramp_ > 0)) {
    deck.fail(load, "ramp",
              "curve = " + in_quotes(kind) +
                  " needs its duration: ramp > 0. For a jump use "
                  "curve = 'constant'");
  }
  if (kind != "table" && (load.given("times") || load.given("factors"))) {
    deck.fail(load, "curve",
              "times and factors belong to curve = 'table', this curve is " + in_quotes(kind));
  }
  if (kind == "linear") curve.table_ = {{0.0, curve.ramp_}, {0.0, 1.0}, {}, {}};
  if (kind == "constant") curve.table_ = {{0.0}, {1.0}, {}, {}};
  if (kind == "table") {
    check_table(deck, load);
    curve.table_ = {load.reals("times"), load.reals("factors"), {}, {}};
    if (curve.table_.times.front() > 0) {  // constant outside: from the start
      curve.table_.times.insert(curve.table_.times.begin(), 0.0);
      curve.table_.values.insert(curve.table_.values.begin(), curve.table_.values.front());
    }
  }
  curve.table_.integrate();
  return curve;
}

double Curve::factor(double time) const {
  return smooth_ ? motion(MotionKind::velocity, 1.0, time).velocity
                 : motion(MotionKind::displacement, 1.0, time).displacement;
}

MotionValue Curve::motion(MotionKind kind, double value, double time) const {
  const double t = time - begin_;
  if (t < 0) return {};
  MotionValue out;
  if (smooth_) {
    if (kind == MotionKind::acceleration) return smooth_acceleration(value, ramp_, t);
    const auto ramp =
        kind == MotionKind::displacement ? CLEAVE_RAMP_DISPLACEMENT : CLEAVE_RAMP_VELOCITY;
    check(cleave_ramp(ramp, value, ramp_, t, &out.displacement, &out.velocity, &out.acceleration));
    return out;
  }
  const auto next = std::upper_bound(table_.times.begin(), table_.times.end(), t);
  const auto k = static_cast<std::size_t>(next - table_.times.begin()) - 1;
  const double x = t - table_.times[k];
  const double c = table_.values[k];
  const double slope = next == table_.times.end()
                           ? 0.0
                           : (table_.values[k + 1] - c) / (table_.times[k + 1] - table_.times[k]);
  const double level = value * (c + slope * x);
  const double integral = value * (table_.first_integral[k] + x * (c + 0.5 * slope * x));
  switch (kind) {
    case MotionKind::displacement:
      return {level, value * slope, 0.0};
    case MotionKind::velocity:
      return {integral, level, value * slope};
    case MotionKind::acceleration:
      break;
  }
  const double second =
      table_.second_integral[k] + x * table_.first_integral[k] + x * x * (0.5 * c + slope * x / 6);
  return {value * second, integral, level};
}

bool Curve::is_constant() const {
  return std::all_of(table_.values.begin(), table_.values.end(),
                     [&](double v) { return v == table_.values.front(); });
}

bool Curve::is_zero_until(double time) const {
  const double t = time - begin_;
  if (t < 0) return true;
  if (smooth_) return false;
  // The knot after `time` too: at a kink the values are those just after it.
  auto last = std::upper_bound(table_.times.begin(), table_.times.end(), t);
  if (last != table_.times.end()) ++last;
  return std::all_of(table_.values.begin(), table_.values.begin() + (last - table_.times.begin()),
                     [](double v) { return v == 0; });
}

const char* Curve::jump(MotionKind kind) const {
  if (smooth_ || kind == MotionKind::acceleration) return "";
  const bool jumps_at_begin = begin_ > 0 && table_.values.front() != 0.0;
  if (kind == MotionKind::velocity) return jumps_at_begin ? "its velocity jumps at begin" : "";
  if (jumps_at_begin) return "its displacement jumps at begin";
  return is_constant() ? "" : "its velocity jumps at the kinks of the displacement";
}

}  // namespace cleave::driver
