// Known sets of units, for plausibility checks only: the program computes in the units of the deck
// and never converts.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cleave::driver {

struct UnitSet {
  const char* name;
  double mass, length, time;                                            // its units in kg, m, s
  const char* derived;                                                  // force, stress, energy
  double speed() const { return length / time; }                        // its unit of speed in m/s
  double density() const { return mass / (length * length * length); }  // in kg/m3
};

std::span<const UnitSet> unit_sets();
// nullptr for "other", which says that the set has no name here.
const UnitSet* find_unit_set(std::string_view name);
// Names a deck may use: the sets and "other".
std::vector<std::string> unit_set_names();

// What is wrong with a wave speed and density given in the units called `units`, and in which set
// they would be those of a solid; empty if they are plausible or the set is not known.
std::string implausible_wave_speed(const std::string& units, double speed, double density);

}  // namespace cleave::driver
