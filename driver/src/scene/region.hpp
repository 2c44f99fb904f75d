// A region of the reference configuration as &zone and &notch describe it.
#pragma once

#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace cleave::driver {

class Region {
 public:
  // Throws DeckError where its numbers make no region.
  Region(const Deck& deck, const DeckGroup& group);
  // `margin` is added on every side.
  bool contains(const double* x, double margin) const;

 private:
  bool in_box(const double* x, double margin) const;

  std::string shape_;
  std::vector<double> lower_, upper_, centre_, normal_;
  double radius_;
};

}  // namespace cleave::driver
