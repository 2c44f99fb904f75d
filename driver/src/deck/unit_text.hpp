// Units as tables and messages of the kernels give them, in SI, rewritten in the units of the deck: "Pa"
// is "MPa" in a deck with units = 'mm-ms-g-MPa'. Labels only: no number is ever converted.
#pragma once

#include <string>

namespace cleave::driver {

class UnitText {
 public:
  // units: the deck's choice; for a set without a name here the labels stay those of SI.
  explicit UnitText(const std::string& units);
  // "kg m-3" -> "g mm-3"
  std::string operator()(const std::string& si) const;
  // "horizon 0.03 [m] is ..." -> "horizon 0.03 [mm] is ...": everything in brackets that is a unit.
  std::string in_message(const std::string& message) const;

 private:
  std::string translate(const std::string& symbol) const;
  std::string length_, time_, mass_, stress_, force_, energy_;
};

}  // namespace cleave::driver
