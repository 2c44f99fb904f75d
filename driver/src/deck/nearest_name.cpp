#include "deck/nearest_name.hpp"

#include <algorithm>

namespace cleave::driver {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool begins_with(std::string_view word, std::string_view start) {
  return start.size() >= 3 && word.size() >= start.size() &&
         edit_distance(word.substr(0, start.size()), start) == 0;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    // A single letter is not a misspelling of another single letter.
    if (distance < least && distance < std::max(name.size(), candidate.size())) {
      least = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty()) return nearest;
  for (const std::string& candidate : known)
    if (begins_with(candidate, name) || begins_with(name, candidate)) return candidate;
  return {};
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known,
                         std::string_view before, std::string_view after) {
  const std::string nearest = nearest_name(name, known);
  if (nearest.empty()) return ".";
  return "; did you mean " + std::string(before) + nearest + std::string(after) + "?";
}

std::string listed(const std::vector<std::string>& names, std::string_view before,
                   std::string_view after) {
  std::string text;
  for (const std::string& name : names) {
    if (!text.empty()) text += ", ";
    text += std::string(before) + name + std::string(after);
  }
  return text;
}

}  // namespace cleave::driver
