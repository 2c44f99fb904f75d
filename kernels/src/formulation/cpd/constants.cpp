// The constants of the interactions of cpd, and the volumes that weigh them.     [PD constants, calibration]
#include <cmath>

#include "formulation/cpd/cpd.hpp"

namespace cleave::cpd {

using peridynamics::HoodVolume;
using peridynamics::kPi;
using peridynamics::Negative;

namespace {

// A constant below this times C1 over the right power of the horizon is zero.
constexpr double kZero = 1e-12;

double ball_volume(int dimension, double horizon, double section) {
  if (dimension == 3) return 4 * kPi / 3 * horizon * horizon * horizon;
  return dimension == 2 ? kPi * horizon * horizon : 2 * horizon * section;
}

}  // namespace

void ContinuumKinematicsPeridynamics::find_constants(const Body& body) {
  const double d = hood_.horizon, difference = elastic_.lambda - elastic_.mu;
  if (dimension_ == 1) {
    constants_ = {2 * elastic_.E / (hood_.section * d * d), 0, 0};
  } else if (dimension_ == 2) {
    constants_ = {24 * elastic_.mu / (kPi * std::pow(d, 3)),
                  27 * difference / (8 * kPi * std::pow(d, 6)), 0};
  } else {
    constants_ = {30 * elastic_.mu / (kPi * std::pow(d, 4)), 0,
                  32 * difference / (std::pow(kPi, 4) * std::pow(d, 12))};
  }
  // What rounding of nu = 1/4 leaves.
  if (std::fabs(constants_.two) < kZero * constants_.one / std::pow(d, 3)) constants_.two = 0;
  if (std::fabs(constants_.three) < kZero * constants_.one / std::pow(d, 8)) constants_.three = 0;
  const ParameterSet& options = body.group("cpd");
  const auto given = [&options](const char* name, double& constant) {
    if (!std::isnan(options.real(name))) constant = options.real(name);
  };
  given("C1", constants_.one);
  given("C2", constants_.two);
  given("C3", constants_.three);
}

void ContinuumKinematicsPeridynamics::check_constants(const Body& body) const {
  if (!(constants_.one > 0)) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("group cpd of ", body.label(), ": C1 is ", constants_.one,
                                          "; allowed: > 0, or leave it out"));
  }
  if ((dimension_ < 3 && constants_.three != 0) || (dimension_ < 2 && constants_.two != 0)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group cpd of ", body.label(), ": C2 = ", constants_.two, ", C3 = ",
                     constants_.three, ", but in ", dimension_, " dimensions there are only ",
                     dimension_ == 1 ? "one-neighbour" : "one- and two-neighbour",
                     " interactions; leave it out"));
  }
  const double least = std::fmin(constants_.two, constants_.three);
  if (least >= 0 ||
      static_cast<Negative>(body.group("cpd").choice("negative_constants")) == Negative::allow)
    return;
  const bool two = constants_.two < 0;
  throw Error(CLEAVE_UNSUPPORTED,
              text(body.label(), ": nu = ", elastic_.nu, " makes ", two ? "C2 = " : "C3 = ", least,
                   " negative (lambda = ", elastic_.lambda, ", mu = ", elastic_.mu, "), so that ",
                   two ? "two" : "three",
                   "-neighbour interactions take energy away and may destabilise; use nu >= ",
                   body.kinematics == CLEAVE_PLANE_STRESS ? "1/3" : "1/4",
                   ", formulation lps, or negative_constants = 'allow' in group cpd"));
}

double ContinuumKinematicsPeridynamics::hood_volume(std::int64_t i) const {
  if (hood_form_ == HoodVolume::sphere) {
    return ball_volume(dimension_, hood_.horizon, hood_.section) * hood_.count(i) / full_count_;
  }
  double sum = hood_.volume[i];
  for (auto b = hood_.first(i); b < hood_.last(i); ++b) sum += hood_.volume[hood_.neighbour(b)];
  return sum;
}

// One factor on C2 or C3 for all points, from a point with a full neighbourhood.   [PD calibration]
double ContinuumKinematicsPeridynamics::calibration(std::int64_t full) const {
  const HoodNumbers& n = numbers_[static_cast<std::size_t>(full)];
  const double ball = ball_volume(dimension_, hood_.horizon, hood_.section),
               volume = hood_volume(full) / ball;
  if (dimension_ == 2 && n.area > 0) {
    const double mean = 8 * kPi * std::pow(hood_.horizon, 6) / 9 / (ball * ball);
    return mean / n.area / (volume * volume);
  }
  if (dimension_ == 3 && n.volume > 0) {
    const double mean = std::pow(kPi, 4) * std::pow(hood_.horizon, 12) / 8 / std::pow(ball, 3);
    return mean / n.volume / std::pow(volume, 3);
  }
  return 1;
}

}  // namespace cleave::cpd
