#include "deck/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cleave::driver {
namespace {

// The name says what the factors must give: "...-MPa" has a stress unit of 1e6 Pa.
double stress_named(const std::string& name) {
  const std::string last = name.substr(name.rfind('-') + 1);
  if (last == "Mbar") return 1e11;
  if (last == "GPa") return 1e9;
  if (last == "MPa") return 1e6;
  return 1;
}

TEST(Units, FactorsAgreeWithNames) {
  for (const UnitSet& set : unit_sets()) {
    const double stress = set.mass / (set.length * set.time * set.time);
    EXPECT_NEAR(stress / stress_named(set.name), 1, 1e-14) << set.name;  // measured 2e-16
  }
}

TEST(Units, AcceptSolidsInTheirOwnSet) {
  EXPECT_EQ(implausible_wave_speed("SI", std::sqrt(3.24e9 / 1190), 1190), "");
  EXPECT_EQ(implausible_wave_speed("mm-ms-g-MPa", std::sqrt(3240 / 1.19e-3), 1.19e-3), "");
  EXPECT_EQ(implausible_wave_speed("mm-s-t-MPa", std::sqrt(3240 / 1.19e-9), 1.19e-9), "");
  EXPECT_EQ(implausible_wave_speed("SI", 5190, 7850), "");
}

TEST(Units, NameTheSetThatWouldFit) {
  const std::string text = implausible_wave_speed("SI", std::sqrt(3240 / 1.19e-9), 1.19e-9);
  EXPECT_NE(text.find("1.65e+06 m/s"), std::string::npos) << text;
  EXPECT_NE(text.find("plausible in 'mm-s-t-MPa'."), std::string::npos) << text;
  // The speed alone does not tell, the density does.
  EXPECT_NE(implausible_wave_speed("SI", std::sqrt(3240 / 1.19e-3), 1.19e-3), "");
}

TEST(Units, SayWhenNoSetFits) {
  const std::string text = implausible_wave_speed("SI", 1e-9, 1e20);
  EXPECT_NE(text.find("say units = 'other'"), std::string::npos) << text;
}

TEST(Units, OtherIsNeverChecked) {
  EXPECT_EQ(implausible_wave_speed("other", 1e-9, 1e20), "");
  EXPECT_EQ(find_unit_set("other"), nullptr);
  EXPECT_EQ(unit_set_names().back(), "other");
}

}  // namespace
}  // namespace cleave::driver
