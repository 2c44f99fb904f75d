// The grammar of namelist files: groups, names, lists of values. Used by parse() only.
#pragma once

#include <cstddef>

#include "io/namelist_cursor.hpp"

namespace cleave::io::namelist {

class Parser {
 public:
  explicit Parser(const File& file) : at_(file) {}
  std::vector<Group> groups();

 private:
  // What stood between the last value and here; it decides where gfortran reads an empty value.
  enum class Between { nothing, comma, line_end, comment };

  bool find_group(Group& group);
  bool begin_group(Group& group, bool first_in_line);
  void check_lone_slash();
  void read_group(Group& group);
  bool end_group(const Group& group);

  Assignment read_assignment();
  NamePart read_name_part();
  std::vector<Subscript> read_parentheses();
  Subscript read_subscript();
  bool read_subscript_number(std::int64_t& number);

  void read_values(std::vector<Value>& values);
  void push_empty(std::vector<Value>& values, bool hidden) const;
  Between read_separator();
  Between read_separator_after_word(std::vector<Value>& values);
  Between absorb_lines(Between between, std::vector<Value>& values);
  bool is_text_after_comment() const;
  void read_item(std::vector<Value>& values);
  std::size_t read_repeat(std::size_t digits);
  void repeat(const Value& value, std::size_t count, Place place, std::vector<Value>& values);

  Cursor at_;
  std::size_t closed_line_ = 0;     // where the last group ended
  std::size_t repeated_bytes_ = 0;  // memory taken by repeat counts so far
};

}  // namespace cleave::io::namelist
