#include "deck/unit_text.hpp"

#include <cctype>
#include <regex>
#include <sstream>
#include <vector>

#include "deck/units.hpp"

namespace cleave::driver {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) {
    while (!part.empty() && part.front() == ' ') part.erase(0, 1);
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

UnitText::UnitText(const std::string& units) {
  const UnitSet* set = find_unit_set(units);
  const auto base = split(units, '-');  // length-time-mass-stress
  if (set == nullptr || base.size() != 4) return;
  const auto derived = split(set->derived, ',');  // force, stress, energy
  if (derived.size() != 3) return;
  length_ = base[0];
  time_ = base[1];
  mass_ = base[2];
  stress_ = base[3];
  force_ = derived[0];
  energy_ = derived[2];
}

std::string UnitText::translate(const std::string& symbol) const {
  if (symbol == "m") return length_;
  if (symbol == "s") return time_;
  if (symbol == "kg") return mass_;
  if (symbol == "Pa") return stress_;
  if (symbol == "N") return force_;
  if (symbol == "J") return energy_;
  return symbol;
}

std::string UnitText::in_message(const std::string& message) const {
  static const std::regex units(R"(\[((kg|m|s|Pa|N|J|K|1)(-?\d)?( (kg|m|s|Pa|N|J|K)(-?\d)?)*)\])");
  std::string text;
  auto rest = message.cbegin();
  for (std::smatch found; std::regex_search(rest, message.cend(), found, units);) {
    text.append(rest, found[0].first);
    text += '[' + (*this)(found[1].str()) + ']';
    rest = found[0].second;
  }
  return text.append(rest, message.cend());
}

std::string UnitText::operator()(const std::string& si) const {
  if (length_.empty()) return si;
  std::string text;
  for (const std::string& part : split(si, ' ')) {
    std::size_t letters = 0;
    while (letters < part.size() && std::isalpha(static_cast<unsigned char>(part[letters])) != 0) {
      ++letters;
    }
    if (!text.empty()) text += ' ';
    text += translate(part.substr(0, letters));
    // m2 and m-3 keep their exponent: "mm-3"
    text += part.substr(letters);
  }
  return text;
}

}  // namespace cleave::driver
