#include "deck/key_range.hpp"

#include <charconv>
#include <stdexcept>

#include "deck/nearest_name.hpp"
#include "deck/number_text.hpp"

namespace cleave::driver {
namespace {

[[noreturn]] void bad_range(std::string_view range) {
  throw std::logic_error("keys.def: cannot read the range \"" + std::string(range) + "\"");
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// Takes `prefix` off the front of the text if it is there.
bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text = trimmed(text.substr(prefix.size()));
  return true;
}

template <class Number>
Number number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) bad_range(text);
  return value;
}

void parse_bound(std::string_view bound, Allowed& allowed) {
  std::string_view rest = trimmed(bound);
  if (take(rest, ">=")) {
    allowed.minimum = number<double>(rest);
  } else if (take(rest, ">")) {
    allowed.minimum = number<double>(rest);
    allowed.minimum_excluded = true;
  } else if (take(rest, "<=")) {
    allowed.maximum = number<double>(rest);
  } else if (take(rest, "<")) {
    allowed.maximum = number<double>(rest);
    allowed.maximum_excluded = true;
  } else {
    bad_range(bound);
  }
}

std::string number_range_text(const Allowed& a) {
  const auto plain = [](double v) {
    std::string text = real_text(v);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::string text;
  if (a.minimum > -kInfinity) text = (a.minimum_excluded ? "> " : ">= ") + plain(a.minimum);
  if (a.maximum < kInfinity)
    text += (text.empty() ? "" : " and ") + std::string(a.maximum_excluded ? "< " : "<= ") +
            plain(a.maximum);
  return text;
}

std::string counts_text(const std::vector<std::int64_t>& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == counts.size() ? " or " : ", ") + std::to_string(counts[i]);
  return text + (text == "1" ? " entry" : " entries");
}

}  // namespace

const char* type_text(KeyType type) {
  switch (type) {
    case KeyType::real:
      return "real number";
    case KeyType::integer:
      return "integer";
    case KeyType::logical:
      return "logical";
    case KeyType::text:
      return "text";
    case KeyType::choice:
      return "choice";
    case KeyType::reals:
      return "list of real numbers";
    case KeyType::texts:
      return "list of texts";
  }
  return "";
}

bool is_list(KeyType type) { return type == KeyType::reals || type == KeyType::texts; }

bool Allowed::contains(double value) const {
  return (minimum_excluded ? value > minimum : value >= minimum) &&
         (maximum_excluded ? value < maximum : value <= maximum);
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  if (text.empty()) return parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

Allowed parse_allowed(KeyType type, std::string_view range) {
  Allowed allowed;
  std::string_view rest = trimmed(range);
  if (rest.empty() || rest.front() == '@') return allowed;
  switch (type) {
    case KeyType::real:
    case KeyType::integer:
      for (const std::string& bound : split(rest, ',')) parse_bound(bound, allowed);
      break;
    case KeyType::choice:
      allowed.choices = split(rest, '|');
      break;
    case KeyType::reals:
    case KeyType::texts:
      for (const std::string& count : split(rest, '|'))
        allowed.counts.push_back(number<std::int64_t>(count));
      break;
    case KeyType::text:
      if (take(rest, "names "))
        allowed.names = rest;
      else if (take(rest, "refers "))
        allowed.refers = rest;
      else if (rest == "file")
        allowed.is_file = true;
      else
        bad_range(range);
      break;
    case KeyType::logical:
      bad_range(range);
  }
  return allowed;
}

std::string allowed_text(const Allowed& allowed) {
  if (!allowed.choices.empty()) return listed(allowed.choices, "'", "'");
  if (!allowed.counts.empty()) return counts_text(allowed.counts);
  return number_range_text(allowed);
}

}  // namespace cleave::driver
