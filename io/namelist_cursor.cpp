// Walking through namelist text, and the shape of messages that point into it.
#include "io/namelist_cursor.hpp"

#include <algorithm>

#include "io/error.hpp"

namespace cleave::io::namelist {

namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// Number of bytes of the UTF-8 character that begins at text[i]; 0 if it is not valid there.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const std::size_t length = lead < 0x80U              ? 1
                             : (lead & 0xE0U) == 0xC0U ? 2
                             : (lead & 0xF0U) == 0xE0U ? 3
                             : (lead & 0xF8U) == 0xF0U ? 4
                                                       : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if (!is_continuation(text[i + k])) return 0;
  }
  return length;
}

// The characters of `text` from number `begin` up to `end`, counted as Cursor counts columns,
// unprintable ones as "?"; `count` is set to the number of all characters.
std::vector<std::string> characters(std::string_view text, std::size_t begin, std::size_t end,
                                    std::size_t& count) {
  std::vector<std::string> result;
  count = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto c = static_cast<unsigned char>(text[i]);
    if (count >= begin && count < end) {
      const bool printable = length > 0 && (c == '\t' || (c >= 0x20U && c != 0x7FU));
      result.push_back(printable ? std::string(text.substr(i, length)) : "?");
    }
    ++count;
    i += std::max<std::size_t>(length, 1);
    while (i < text.size() && is_continuation(text[i])) ++i;  // wrong ones count as no character
  }
  return result;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::size_t count = 0;
  std::string result;
  for (const std::string& c : characters(text, 0, kLongest, count)) result += c == "\t" ? " " : c;
  return count > kLongest ? result + "..." : result;
}

void Cursor::advance() {
  if (at_end()) return;
  if (peek() == '\n') {
    ++line_;
    column_ = 1;
  } else if (!is_continuation(peek(1))) {
    ++column_;
  }
  ++offset_;
}

void Cursor::skip_comment() {
  while (!at_end() && peek() != '\n') advance();
  advance();
}

void Cursor::skip_white() {
  for (;;) {
    if (peek() == '!') {
      skip_comment();
    } else if (is_blank(peek()) || peek() == '\n') {
      advance();
    } else {
      return;
    }
  }
}

std::string_view Cursor::take_name() {
  const std::size_t begin = offset_;
  while (is_name_char(peek())) advance();
  return since(begin);
}

std::size_t Cursor::after_white(std::size_t offset) const {
  while (is_blank(at(offset)) || at(offset) == '\n') ++offset;
  return offset;
}

void Cursor::fail(Place place, const std::string& message) const {
  throw Error(located(file_, place, message));
}

std::string_view File::source_line(int line) const {
  if (line < 1) return {};
  std::size_t begin = 0;
  for (int n = 1; n < line; ++n) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) return {};
    begin = end + 1;
  }
  std::string_view result = std::string_view(text).substr(begin);
  result = result.substr(0, result.find('\n'));
  if (line == 1 && result.starts_with(kByteOrderMark)) result.remove_prefix(kByteOrderMark.size());
  if (result.ends_with('\r')) result.remove_suffix(1);
  return result;
}

std::string located(const File& file, Place place, const std::string& message) {
  constexpr std::size_t kWidth = 120;  // longer lines are cut
  constexpr std::size_t kBefore = 80;  // characters kept before the caret then
  const std::string_view source = file.source_line(place.line);
  const auto caret = static_cast<std::size_t>(std::max(place.column, 1) - 1);
  std::size_t count = 0;
  characters(source, 0, 0, count);
  const std::size_t begin = count > kWidth && caret > kBefore ? caret - kBefore : 0;
  const std::size_t end = std::min(count, begin + kWidth);
  const std::vector<std::string> line = characters(source, begin, end, count);

  std::string text = begin > 0 ? "..." : "";
  std::string pointer = begin > 0 ? "   " : "";
  for (const std::string& c : line) text += c;
  for (std::size_t i = begin; i < std::min(caret, end); ++i)
    pointer += line[i - begin] == "\t" ? '\t' : ' ';
  pointer.append(caret > end ? caret - end : 0, ' ');
  if (end < count) text += "...";
  return file.path + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " +
         message + "\n   " + text + "\n   " + pointer + "^";
}

}  // namespace cleave::io::namelist
