// Fortran namelist text -> groups of assignments, with the place of every item.
//
// Accepts what gfortran's namelist READ accepts and gives the same values: repeat counts, null
// values, d and q exponents, .true./T, doubled quotes, subscripts and sections `v(2:3)=`,
// substrings, derived-type components `a%b(2)=`, `$grp ... $end`, `&grp ... /`, `!` comments, text
// between groups. It does not know any key: types are "as written", and matching names, ranges and
// defaults are the reader's business (driver/src/deck). Where the values go in an array:
// namelist_section.hpp.
//
// Choices where the text alone is not clear, or where gfortran (12) is surprising:
// - A word at a value's place is a name if '=', '%' or subscripts follow (`t = 1` assigns to t).
//   Otherwise T..., F..., .t..., .f... are logicals, inf, infinity and nan are reals, anything else
//   is an error that asks for quotes.
// - `3* 1.5` is three nulls and 1.5. An integer too large for 64 bits becomes a real.
// - gfortran reads an empty value where a comma stands before a comment (`1, ! x` and `2` on the
// next
//   line), or where a line begins with a comma. Other compilers do not. Such nulls are
//   given too, and marked `hidden`, so that a reader can refuse them; they are dropped at the end
//   of a list, where they have no effect, and before a text, where gfortran refuses them.
// - Refused although gfortran accepts them, because it does so by skipping what was written: a
// number
//   or logical with something attached (`1j=2`, `1.5&end`), a key without '=', a sign without
//   digits, a complex number without ')' or with an empty part, unquoted text that begins with a
//   digit, '/' alone or &end where no group is open, a line that begins with a stray '&', NUL
//   characters.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cleave::io::namelist {

struct Place {
  int line = 0;    // 1-based
  int column = 0;  // 1-based, in characters; a tab is one character
};

struct Null {
  bool operator==(const Null&) const = default;
};

// A complex constant (re, im).
struct Complex {
  double re = 0, im = 0;
  bool operator==(const Complex&) const = default;
};

// One value as written: 12 -> int64, 1.5 / 1d3 / inf -> double, 'text' -> string, .true. / T ->
// bool, nothing between two commas -> Null.
using Scalar = std::variant<Null, std::int64_t, double, bool, std::string, Complex>;

struct Value {
  Scalar scalar;
  std::string text;  // the characters as they stand in the file, without a repeat count
  Place place;
  bool hidden = false;  // a Null that gfortran reads where the eye sees none, see above
};

// The number in `value` (integer or real) as gfortran reads it into a double precision variable.
// Returns false and leaves `real` alone if it is not a number.
bool as_real(const Value& value, double& real);

// One subscript triplet; `v(3)` has first == last and is_range false; omitted parts are absent.
struct Subscript {
  bool is_range = false;
  bool has_first = false, has_last = false;
  std::int64_t first = 0, last = 0, stride = 1;  // stride is not 0
};

// One part of a name: a%b(2) is {a, {}}, {b, {2}}.
struct NamePart {
  std::string name;  // lower case
  std::vector<Subscript> subscripts;
  std::vector<Subscript> substring;  // second parentheses, one range or none: a(2)(3:5)
};

struct Assignment {
  std::vector<NamePart> name;
  Place place;
  std::vector<Value> values;      // repeat counts expanded
  std::string full_name() const;  // "a%b(2)" as a user would write it, lower case
};

struct Group {
  std::string name;  // lower case
  Place place;
  std::vector<Assignment> assignments;
};

struct File {
  std::string path;  // as given; used in messages
  std::string text;  // whole file
  std::vector<Group> groups;

  // The source line `line` (1-based) without its end, for messages.
  std::string_view source_line(int line) const;
};

// Throws io::Error "path:line:column: ..." with the line shown. `path` is used in messages only.
// Text without any group is no error: `groups` is empty then.
File parse(std::string text, std::string path);
// Throws io::Error if the file cannot be read.
File read(const std::string& path);

// Pretty JSON, in the order of the file:
//   {"file": path,
//    "groups": [{"name", "line", "column",
//      "assignments": [{"name", "line", "column",
//        "parts": [{"name", "subscripts": [3, {"first", "last", "stride"}, ...], "substring":
//        {...}}], "values": [...], "types": ["integer", "real", "logical", "text", "complex",
//        "null", ...]}]}]}
// "name" of an assignment is full_name(). Integers and logicals are JSON's own, reals too and read
// back to the same double, except "inf", "-inf", "nan", which are strings; a complex number is
// {"re", "im"}; nulls are null; repeat counts are expanded. Absent parts of a range are null;
// "subscripts" and "substring" are there only if written. Text that is not UTF-8 is given with
// U+FFFD in place of the wrong bytes.
std::string to_json(const File& file);

// The shape of every deck error:
//   path:line:column: message
//      the source line
//           ^
// Tabs are kept so that the caret stands under its character; a long line is cut around it;
// unprintable characters are shown as '?'.
std::string located(const File& file, Place place, const std::string& message);

}  // namespace cleave::io::namelist
