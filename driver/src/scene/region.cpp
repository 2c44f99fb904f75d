#include "scene/region.hpp"

#include <algorithm>
#include <cmath>

#include "scene/format.hpp"

namespace cleave::driver {

Region::Region(const Deck& deck, const DeckGroup& zone)
    : shape_(zone.text("shape")),
      lower_(zone.reals("lower")),
      upper_(zone.reals("upper")),
      centre_(zone.reals("centre")),
      normal_(zone.reals("normal")),
      radius_(zone.real("radius")) {
  for (std::size_t k = 0; k < std::min(lower_.size(), upper_.size()); ++k) {
    if (lower_[k] > upper_[k]) {
      deck.fail(zone, "upper",
                "upper lies below lower in direction " + std::string(1, "xyz"[k]) + ": " +
                    number(upper_[k]) + " < " + number(lower_[k]));
    }
  }
  const double length = std::hypot(normal_[0], normal_[1], normal_[2]);
  const bool needs_normal = shape_ == "cylinder" || shape_ == "plane";
  if (needs_normal && !(length > 0)) deck.fail(zone, "normal", "the normal must not be zero");
  if (needs_normal) {
    for (double& n : normal_) n /= length;
  }
}

bool Region::contains(const double* x, double margin) const {
  if (shape_ == "box") return in_box(x, margin);
  const double d[3] = {x[0] - centre_[0], x[1] - centre_[1], x[2] - centre_[2]};
  if (shape_ == "sphere") return std::hypot(d[0], d[1], d[2]) <= radius_ + margin;
  const double along = d[0] * normal_[0] + d[1] * normal_[1] + d[2] * normal_[2];
  if (shape_ == "plane") return std::abs(along) <= margin;
  return std::hypot(d[0] - along * normal_[0], d[1] - along * normal_[1],
                    d[2] - along * normal_[2]) <= radius_ + margin;
}

bool Region::in_box(const double* x, double margin) const {
  for (std::size_t k = 0; k < lower_.size(); ++k) {
    if (x[k] < lower_[k] - margin) return false;
  }
  for (std::size_t k = 0; k < upper_.size(); ++k) {
    if (x[k] > upper_[k] + margin) return false;
  }
  return true;
}

}  // namespace cleave::driver
