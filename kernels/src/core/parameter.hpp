// Named parameters with type, units, range and default: material properties and the options of
// formulations. Declared once, as constexpr lists beside the code that uses them.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cleave/cleave.h"

namespace cleave {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Range {
  double minimum = -kUnbounded, maximum = kUnbounded;
  bool minimum_excluded = false, maximum_excluded = false;
};
inline constexpr Range kPositive{0.0, kUnbounded, true, false};
inline constexpr Range kNotNegative{0.0, kUnbounded, false, false};

struct ParameterSpec {
  const char* name;
  const char* units;
  const char* description;
  const char* source;
  cleave_type type = CLEAVE_REAL;
  Range range{};
  bool required = false;
  double default_value = 0;
  const char* choices = "";         // "a|b|c"
  const char* default_choice = "";  // one of them
};

constexpr ParameterSpec real_parameter(const char* name, const char* units, Range range,
                                       double default_value, const char* description,
                                       const char* source = "") {
  return {name, units, description, source, CLEAVE_REAL, range, false, default_value, "", ""};
}
constexpr ParameterSpec required_parameter(const char* name, const char* units, Range range,
                                           const char* description, const char* source = "") {
  return {name, units, description, source, CLEAVE_REAL, range, true, 0.0, "", ""};
}
constexpr ParameterSpec choice_parameter(const char* name, const char* choices,
                                         const char* default_choice, const char* description,
                                         const char* source = "") {
  return {name, "1", description, source, CLEAVE_CHOICE, {}, false, 0.0, choices, default_choice};
}

// Finite and within the range.
bool allowed(const ParameterSpec& spec, double value);
// Throws BAD_ARGUMENT: whose parameter it is, the value, what is allowed.
[[noreturn]] void refuse_value(std::string_view owner, const ParameterSpec& spec, double value);

// A list of parameters with a name: a parameter group, or the properties of a law.
struct ParameterGroup {
  const char* name;
  const char* title;
  const char* source;
  std::span<const ParameterSpec> specs;
};

// Position of `choice` in "a|b|c", or -1.
int choice_index(std::string_view choices, std::string_view choice);

// Values of a group for one body. Messages name the owner.
class ParameterSet {
 public:
  ParameterSet() = default;
  ParameterSet(std::string owner, std::span<const ParameterSpec> specs);

  void set_real(std::string_view name, double value);
  void set_choice(std::string_view name, std::string_view choice);
  double real(std::string_view name) const;
  int choice(std::string_view name) const;  // its position among the choices
  bool given(std::string_view name) const;
  bool any_given() const;
  void require_all() const;  // throws MISSING_PARAMETER naming all that are missing
  std::span<const double> values() const { return values_; }

 private:
  std::size_t index(std::string_view name) const;
  std::string owner_;
  std::span<const ParameterSpec> specs_;
  std::vector<double> values_;  // a choice is stored as its position
  std::vector<char> given_;
};

}  // namespace cleave
