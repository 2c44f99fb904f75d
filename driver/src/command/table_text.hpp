// A table of words as aligned text or as Markdown.
#pragma once

#include <string>
#include <vector>

namespace cleave::driver {

enum class TextFormat { text, markdown };

struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header
};

std::string to_text(const TextTable& table);
std::string to_markdown(const TextTable& table);
std::string to_text(const TextTable& table, TextFormat format);

// `name` in Markdown; empty stays empty.
std::string code(const std::string& text);
// [units]
std::string in_brackets(const std::string& units);

}  // namespace cleave::driver
