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
  const ParameterSet& options = body.group("cpd");
  const double d = hood_.horizon;
  constants_.clear();
  for (const peridynamics::Elastic& e : materials_) {
    const double difference = e.lambda - e.mu;
    Constants c;
    if (dimension_ == 1) {
      c = {2 * e.E / (hood_.section * d * d), 0, 0};
    } else if (dimension_ == 2) {
      c = {24 * e.mu / (kPi * std::pow(d, 3)), 27 * difference / (8 * kPi * std::pow(d, 6)), 0};
    } else {
      c = {30 * e.mu / (kPi * std::pow(d, 4)), 0,
           32 * difference / (std::pow(kPi, 4) * std::pow(d, 12))};
    }
    // What rounding of nu = 1/4 leaves.
    if (std::fabs(c.two) < kZero * c.one / std::pow(d, 3)) c.two = 0;
    if (std::fabs(c.three) < kZero * c.one / std::pow(d, 8)) c.three = 0;
    const auto given = [&](const char* name, double& constant) {
      if (std::isnan(options.real(name))) return;
      if (materials_.size() > 1) {
        throw Error(CLEAVE_UNSUPPORTED,
                    text("group cpd of ", body.label(), " gives ", name,
                         ", but there are several materials; leave it out, so that each has its "
                         "own constants"));
      }
      constant = options.real(name);
    };
    given("C1", c.one);
    given("C2", c.two);
    given("C3", c.three);
    constants_.push_back(c);
  }
  if (materials_.size() > 1 && !conservative_) {
    throw Error(
        CLEAVE_UNSUPPORTED,
        text(body.label(),
             " has several materials: the weights of the paper do not keep momentum where "
             "they meet; set weights = 'conservative' in group cpd, or use bond_pd or lps"));
  }
}

void ContinuumKinematicsPeridynamics::check_constants(const Body& body, std::size_t region) const {
  const Constants& constants = constants_[region];
  const peridynamics::Elastic& elastic = materials_[region];
  if (!(constants.one > 0)) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("group cpd of ", body.label(), ": C1 is ", constants.one,
                                          "; allowed: > 0, or leave it out"));
  }
  if ((dimension_ < 3 && constants.three != 0) || (dimension_ < 2 && constants.two != 0)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group cpd of ", body.label(), ": C2 = ", constants.two, ", C3 = ",
                     constants.three, ", but in ", dimension_, " dimensions there are only ",
                     dimension_ == 1 ? "one-neighbour" : "one- and two-neighbour",
                     " interactions; leave it out"));
  }
  const double least = std::fmin(constants.two, constants.three);
  if (least >= 0 ||
      static_cast<Negative>(body.group("cpd").choice("negative_constants")) == Negative::allow)
    return;
  const bool two = constants.two < 0;
  throw Error(CLEAVE_UNSUPPORTED,
              text(peridynamics::material_label(body, region), ": nu = ", elastic.nu, " makes ",
                   two ? "C2 = " : "C3 = ", least, " negative (lambda = ", elastic.lambda,
                   ", mu = ", elastic.mu, "), so that ", two ? "two" : "three",
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
