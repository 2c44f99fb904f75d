#include "scene/csv_columns.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "deck/deck.hpp"

namespace cleave::driver {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == ',') {
      parts.emplace_back();
    } else if (c != '\r' && c != '"') {
      parts.back() += c;
    }
  }
  return parts;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t+");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

double finite_number(const std::string& word, const std::string& place) {
  const std::string text = trimmed(word);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size() ||
      !std::isfinite(value)) {
    throw DeckError(place + ": \"" + word + "\" is not a finite number");
  }
  return value;
}

}  // namespace

CsvColumns read_csv_columns(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw DeckError(path + ": the file cannot be opened; give a CSV file with a header");
  CsvColumns csv;
  csv.path = path;
  std::string line;
  std::getline(file, line);
  for (const std::string& name : split(line)) {
    csv.names.push_back(trimmed(name.substr(0, name.find('['))));
  }
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = path + ":" + std::to_string(number);
    const auto words = split(line);
    if (words.size() != csv.names.size()) {
      throw DeckError(place + ": " + std::to_string(words.size()) + " numbers for the " +
                      std::to_string(csv.names.size()) + " columns of the header");
    }
    csv.rows.emplace_back();
    for (const std::string& word : words) csv.rows.back().push_back(finite_number(word, place));
    csv.line.push_back(number);
  }
  if (csv.rows.empty()) throw DeckError(path + ": no rows after the header");
  return csv;
}

}  // namespace cleave::driver
