#include "core/parameter.hpp"

#include <cmath>

#include "core/error.hpp"

namespace cleave {

int choice_index(std::string_view choices, std::string_view choice) {
  for (int k = 0; !choices.empty(); ++k) {
    const auto bar = choices.find('|');
    if (choices.substr(0, bar) == choice) return k;
    if (bar == std::string_view::npos) break;
    choices.remove_prefix(bar + 1);
  }
  return -1;
}

namespace {

std::string range_text(const Range& r) {
  std::string out;
  if (r.minimum > -kUnbounded) out += text(r.minimum_excluded ? "> " : ">= ", r.minimum);
  if (r.maximum < kUnbounded) {
    out += text(out.empty() ? "" : " and ", r.maximum_excluded ? "< " : "<= ", r.maximum);
  }
  return out.empty() ? "any finite number" : out;
}

}  // namespace

bool allowed(const ParameterSpec& spec, double value) {
  const Range& r = spec.range;
  return std::isfinite(value) && (r.minimum_excluded ? value > r.minimum : value >= r.minimum) &&
         (r.maximum_excluded ? value < r.maximum : value <= r.maximum);
}

void refuse_value(std::string_view owner, const ParameterSpec& spec, double value) {
  throw Error(CLEAVE_BAD_ARGUMENT, text("parameter '", spec.name, "' of ", owner, " is ", value,
                                        " [", spec.units, "]; allowed: ", range_text(spec.range)));
}

ParameterSet::ParameterSet(std::string owner, std::span<const ParameterSpec> specs)
    : owner_(std::move(owner)), specs_(specs), values_(specs.size()), given_(specs.size(), 0) {
  for (std::size_t k = 0; k < specs.size(); ++k) {
    values_[k] = specs[k].type == CLEAVE_CHOICE
                     ? choice_index(specs[k].choices, specs[k].default_choice)
                     : specs[k].default_value;
  }
}

std::size_t ParameterSet::index(std::string_view name) const {
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    if (specs_[k].name == name) return k;
  }
  std::string known;
  for (const auto& s : specs_) known += text(known.empty() ? "" : ", ", s.name);
  throw Error(CLEAVE_UNKNOWN_NAME,
              text("parameter '", name, "' of ", owner_, " is unknown; known parameters: ", known));
}

void ParameterSet::set_real(std::string_view name, double value) {
  const std::size_t k = index(name);
  const ParameterSpec& s = specs_[k];
  if (s.type == CLEAVE_CHOICE) {
    throw Error(CLEAVE_WRONG_TYPE, text("parameter '", name, "' of ", owner_, " is one of ",
                                        s.choices, "; set it by name, not by the number ", value));
  }
  if (!allowed(s, value)) refuse_value(owner_, s, value);
  values_[k] = value;
  given_[k] = 1;
}

void ParameterSet::set_choice(std::string_view name, std::string_view choice) {
  const std::size_t k = index(name);
  const ParameterSpec& s = specs_[k];
  if (s.type != CLEAVE_CHOICE) {
    throw Error(CLEAVE_WRONG_TYPE, text("parameter '", name, "' of ", owner_,
                                        " is a number, not the word '", choice, "'"));
  }
  const int position = choice_index(s.choices, choice);
  if (position < 0) {
    throw Error(CLEAVE_UNKNOWN_NAME, text("parameter '", name, "' of ", owner_, " is '", choice,
                                          "'; allowed: ", s.choices));
  }
  values_[k] = position;
  given_[k] = 1;
}

double ParameterSet::real(std::string_view name) const { return values_[index(name)]; }
int ParameterSet::choice(std::string_view name) const {
  return static_cast<int>(values_[index(name)]);
}
bool ParameterSet::given(std::string_view name) const { return given_[index(name)] != 0; }

bool ParameterSet::any_given() const {
  for (const char g : given_) {
    if (g) return true;
  }
  return false;
}

void ParameterSet::require_all() const {
  std::string missing;
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    if (specs_[k].required && !given_[k]) {
      missing += text(missing.empty() ? "" : ", ", specs_[k].name, " [", specs_[k].units, "]");
    }
  }
  if (!missing.empty()) {
    throw Error(CLEAVE_MISSING_PARAMETER, text(owner_, " needs ", missing));
  }
}

}  // namespace cleave
