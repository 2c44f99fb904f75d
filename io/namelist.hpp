// Fortran namelist text -> groups of assignments, with the place of every item.
//
// Accepts what gfortran's namelist READ accepts: repeat counts, null values, d exponents,
// .true./T, doubled quotes, subscripts and sections `v(2:3)=`, derived-type components `a%b(2)=`,
// `$grp ... $end`, `&grp ... /`, `!` comments, text between groups. It does not know any key: types are
// "as written", and matching names, ranges and defaults are the reader's business (driver/src/deck).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cleave::io::namelist {

struct Place {
  int line = 0;    // 1-based
  int column = 0;  // 1-based
};

struct Null {
  bool operator==(const Null&) const = default;
};

// A complex constant (re, im).
struct Complex {
  double re = 0, im = 0;
  bool operator==(const Complex&) const = default;
};

// One value as written: 12 -> int64, 1.5 / 1d3 -> double, 'text' -> string, .true. / T -> bool,
// nothing between two commas -> Null. An unquoted word that is not a number or logical is a syntax
// error.
using Scalar = std::variant<Null, std::int64_t, double, bool, std::string, Complex>;

struct Value {
  Scalar scalar;
  std::string text;  // the characters as they stand in the file, without a repeat count
  Place place;
};

// One subscript triplet; `v(3)` has first == last and is_range false; omitted parts are absent.
struct Subscript {
  bool is_range = false;
  bool has_first = false, has_last = false;
  std::int64_t first = 0, last = 0, stride = 1;
};

// One part of a name: a%b(2) is {a, {}}, {b, {2}}.
struct NamePart {
  std::string name;  // lower case
  std::vector<Subscript> subscripts;
};

struct Assignment {
  std::vector<NamePart> name;
  Place place;
  std::vector<Value> values;  // repeat counts expanded
  std::string full_name() const;  // "a%b(2)" as a user would write it, lower case
};

struct Group {
  std::string name;  // lower case
  Place place;
  std::vector<Assignment> assignments;
};

struct File {
  std::string path;   // as given; used in messages
  std::string text;   // whole file
  std::vector<Group> groups;

  // The source line `line` (1-based) without its end, for messages.
  std::string_view source_line(int line) const;
};

// Throws io::Error "path:line:column: ..." with the line shown. `path` is used in messages only.
File parse(std::string text, std::string path);
// Throws io::Error if the file cannot be read.
File read(const std::string& path);

// Pretty JSON: {"file":..., "groups":[{"name","line","assignments":[{"name","line","column","parts":[...],
// "values":[...]}]}]}, nulls as null, complex as {"re","im"}.
std::string to_json(const File& file);

// "path:line:column: message\n   the source line\n        ^" : the shape of every deck error.
std::string located(const File& file, Place place, const std::string& message);

}  // namespace cleave::io::namelist
