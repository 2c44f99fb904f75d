#include "command/table_text.hpp"

#include <algorithm>

namespace cleave::driver {
namespace {

// The last column is not padded.
std::string aligned_row(const std::vector<std::string>& row,
                        const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    line += row[i];
    if (i + 1 < row.size()) line.append(widths[i] - row[i].size() + 2, ' ');
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line + '\n';
}

std::string markdown_row(const std::vector<std::string>& row) {
  std::string line = "|";
  for (const std::string& cell : row) {
    line += ' ';
    for (const char c : cell) line += c == '|' ? std::string("\\|") : std::string(1, c);
    line += " |";
  }
  return line + '\n';
}

}  // namespace

std::string to_text(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& title : table.header) widths.push_back(title.size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text = aligned_row(table.header, widths);
  for (const auto& row : table.rows) text += aligned_row(row, widths);
  return text;
}

std::string to_markdown(const TextTable& table) {
  std::string text = markdown_row(table.header);
  text += markdown_row(std::vector<std::string>(table.header.size(), "---"));
  for (const auto& row : table.rows) text += markdown_row(row);
  return text;
}

std::string to_text(const TextTable& table, TextFormat format) {
  return format == TextFormat::markdown ? to_markdown(table) : to_text(table);
}

std::string code(const std::string& text) {
  std::string quoted = text;
  if (!text.empty()) quoted.insert(0, 1, '`').push_back('`');
  return quoted;
}

std::string in_brackets(const std::string& units) {
  std::string text = units;
  text.insert(0, 1, '[').push_back(']');
  return text;
}

}  // namespace cleave::driver
