#include "io/csv.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace cleave::io {

std::string csv_field(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

void append_csv_number(std::string& text, double value, bool is_integer) {
  std::array<char, 32> digits{};  // the longest double has 24
  char* const end = digits.data() + digits.size();
  if (std::isnan(value)) value = std::fabs(value);  // one spelling, whatever the sign bit
  const auto result = is_integer
                          ? std::to_chars(digits.data(), end, static_cast<std::int64_t>(value))
                          : std::to_chars(digits.data(), end, value);
  text.append(digits.data(), result.ptr);
}

std::string csv_header(std::span<const Column> columns) {
  std::string text;
  for (const Column& column : columns) {
    if (!text.empty()) text += ',';
    text += csv_field(column.name + " [" + column.units + "]");
  }
  return text + '\n';
}

void append_csv_records(std::string& text, std::span<const Column> columns,
                        std::span<const double> records) {
  std::size_t column = 0;
  for (const double value : records) {
    append_csv_number(text, value, columns[column].is_integer);
    column = (column + 1) % columns.size();
    text += column == 0 ? '\n' : ',';
  }
}

}  // namespace cleave::io
