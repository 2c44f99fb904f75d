// A position in namelist text that knows its line and column. Used by the parser only.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/namelist.hpp"

namespace cleave::io::namelist {

// Some editors put it before the first character; it is no part of the text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
inline bool is_name_char(char c) { return is_letter(c) || is_digit(c) || c == '_'; }
inline bool is_name_start(char c) { return is_letter(c) || c == '_'; }
inline bool is_quote(char c) { return c == '\'' || c == '"'; }
// What may follow a value directly; '\0' is the end of the text.
inline bool is_separator(char c) {
  return is_blank(c) || c == '\n' || c == ',' || c == ';' || c == '/' || c == '!' || c == '\0';
}
std::string lower_case(std::string_view text);

class Cursor {
 public:
  explicit Cursor(const File& file)
      : file_(file), offset_(file.text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0) {}

  bool at_end() const { return offset_ >= file_.text.size(); }
  // The character `ahead` of here; '\0' beyond the end (the parser refuses NUL characters
  // beforehand).
  char peek(std::size_t ahead = 0) const { return at(offset_ + ahead); }
  char at(std::size_t offset) const {
    return offset < file_.text.size() ? file_.text[offset] : '\0';
  }
  std::size_t offset() const { return offset_; }
  const std::string& text() const { return file_.text; }
  Place place() const { return {line_, column_}; }
  int column() const { return column_; }
  std::string_view since(std::size_t offset) const {
    return std::string_view(file_.text).substr(offset, offset_ - offset);
  }

  void advance();
  void advance_to(std::size_t offset) {
    while (offset_ < offset) advance();
  }
  void skip_blanks() {
    while (is_blank(peek())) advance();
  }
  // A comment with the end of its line.
  void skip_comment();
  // Blanks, line ends and comments.
  void skip_white();
  std::string_view take_name();

  // Offset of the first character at or after `offset` that is no blank and no line end.
  std::size_t after_white(std::size_t offset) const;

  // Throws io::Error.
  [[noreturn]] void fail(Place place, const std::string& message) const;

 private:
  const File& file_;
  std::size_t offset_;
  int line_ = 1, column_ = 1;
};

// Text as shown in a message: at most 60 characters, unprintable ones as '?'.
std::string shown(std::string_view text);

}  // namespace cleave::io::namelist
