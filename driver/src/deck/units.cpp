#include "deck/units.hpp"

#include <array>

#include "deck/number_text.hpp"

namespace cleave::driver {
namespace {

constexpr std::array kSets = {
#define CLEAVE_UNITS(name, mass, length, time, derived) UnitSet{name, mass, length, time, derived},
#include "deck/units.def"
};

// From soft gels and foams to diamond and osmium; wide on purpose, sets differ by powers of ten.
constexpr double kSlowest = 10, kFastest = 2e4;   // [m s-1]
constexpr double kLightest = 1, kHeaviest = 3e4;  // [kg m-3]

bool is_plausible(const UnitSet& set, double speed, double density) {
  const double c = speed * set.speed(), rho = density * set.density();
  return c >= kSlowest && c <= kFastest && rho >= kLightest && rho <= kHeaviest;
}

}  // namespace

std::span<const UnitSet> unit_sets() { return kSets; }

const UnitSet* find_unit_set(std::string_view name) {
  for (const UnitSet& set : kSets)
    if (name == set.name) return &set;
  return nullptr;
}

std::vector<std::string> unit_set_names() {
  std::vector<std::string> names;
  for (const UnitSet& set : kSets) names.emplace_back(set.name);
  names.emplace_back("other");
  return names;
}

std::string implausible_wave_speed(const std::string& units, double speed, double density) {
  const UnitSet* set = find_unit_set(units);
  if (!set || is_plausible(*set, speed, density)) return {};
  std::string text = "in units '" + units + "' the wave speed is " +
                     short_text(speed * set->speed()) + " m/s and the density " +
                     short_text(density * set->density()) + " kg/m3; solids lie between " +
                     short_text(kSlowest) + " and " + short_text(kFastest) + " m/s, " +
                     short_text(kLightest) + " and " + short_text(kHeaviest) + " kg/m3.";
  std::string better;
  for (const UnitSet& other : kSets) {
    if (!is_plausible(other, speed, density)) continue;
    better +=
        (better.empty() ? " The numbers are plausible in '" : "', '") + std::string(other.name);
  }
  if (!better.empty()) return text + better + "'.";
  return text + " Check the material's stiffness and density, or say units = 'other'.";
}

}  // namespace cleave::driver
