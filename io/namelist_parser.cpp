// The grammar: groups and the text between them, names with subscripts and components, and lists of
// values with their separators. The values themselves are read in namelist_scalar.cpp.
#include "io/namelist_parser.hpp"

#include <algorithm>
#include <charconv>

#include "io/namelist_scalar.hpp"

namespace cleave::io::namelist {

namespace {

// Repeat counts may not fill the memory: all values they make in one file fit in this.
constexpr std::size_t kRepeatedBytes = std::size_t{128} << 20U;

std::string written(const std::vector<Subscript>& subscripts) {
  std::string text;
  for (const Subscript& s : subscripts) {
    text += text.empty() ? "(" : ",";
    if (s.has_first) text += std::to_string(s.first);
    if (!s.is_range) continue;
    text += ":";
    if (s.has_last) text += std::to_string(s.last);
    if (s.stride != 1) text.append(":").append(std::to_string(s.stride));
  }
  return text.empty() ? text : text + ")";
}

}  // namespace

std::string Assignment::full_name() const {
  std::string text;
  for (const NamePart& part : name) {
    if (!text.empty()) text += "%";
    text += part.name + written(part.subscripts) + written(part.substring);
  }
  return text;
}

std::vector<Group> Parser::groups() {
  std::vector<Group> groups;
  for (Group group; find_group(group); group = Group()) {
    read_group(group);
    groups.push_back(std::move(group));
  }
  return groups;
}

// Between groups anything may stand; '!' comments are skipped, as a compiler's reader does.
bool Parser::find_group(Group& group) {
  bool first_in_line = at_.column() == 1;
  while (!at_.at_end()) {
    const char c = at_.peek();
    if (c == '!') {
      at_.skip_comment();
      first_in_line = true;
      continue;
    }
    if ((c == '&' || c == '$') && begin_group(group, first_in_line)) return true;
    if (c == '/' && first_in_line) check_lone_slash();
    first_in_line = c == '\n' || (first_in_line && is_blank(c));
    at_.advance();
  }
  return false;
}

// At '&' or '$': true and past the name if a group begins here.
bool Parser::begin_group(Group& group, bool first_in_line) {
  const Place place = at_.place();
  std::size_t end = at_.offset() + 1;
  while (is_name_char(at_.at(end))) ++end;
  const std::string name =
      lower_case(std::string_view(at_.text()).substr(at_.offset() + 1, end - at_.offset() - 1));
  const bool is_name = !name.empty() && is_name_start(name.front()) && is_separator(at_.at(end));
  if (is_name && name == "end") {
    at_.fail(place, "this ends no group: " +
                        (closed_line_ == 0
                             ? std::string("none has begun before it")
                             : "the one before was ended in line " + std::to_string(closed_line_) +
                                   ", and what follows there is not read") +
                        "; text with '/' in it needs quotes");
  }
  if (is_name) {
    group.name = name;
    group.place = place;
    at_.advance_to(end);
    return true;
  }
  if (first_in_line && at_.peek() == '&') {
    at_.fail(place,
             "no group begins here: write the name directly after '&' and a blank or a line end "
             "after the name, or put '!' before text that is not to be read");
  }
  return false;
}

// A line with nothing but '/' outside all groups: the group it was meant for has ended before.
void Parser::check_lone_slash() {
  std::size_t next = at_.offset() + 1;
  while (is_blank(at_.at(next))) ++next;
  const char follows = at_.at(next);
  if (closed_line_ == 0 || (follows != '\n' && follows != '\0' && follows != '!')) return;
  at_.fail(at_.place(),
           "this '/' ends no group: the one before was ended in line " +
               std::to_string(closed_line_) +
               ", and what follows there is not read; text with '/' in it needs quotes");
}

void Parser::read_group(Group& group) {
  for (;;) {
    at_.skip_white();
    const char c = at_.peek();
    if (c == ',' || c == ';') {
      at_.advance();
    } else if (end_group(group)) {
      return;
    } else {
      group.assignments.push_back(read_assignment());
    }
  }
}

// True and past it at '/', &end or $end; fails where the group cannot go on.
bool Parser::end_group(const Group& group) {
  if (at_.at_end()) {
    at_.fail(group.place, "group " + group.name + " has no end: put '/' after its last value");
  }
  const char c = at_.peek();
  if (c != '/' && c != '&' && c != '$') return false;
  const Place place = at_.place();
  closed_line_ = static_cast<std::size_t>(place.line);
  at_.advance();
  if (c == '/') return true;
  const std::string name = lower_case(at_.take_name());
  if (name == "end") return true;
  at_.fail(place, std::string("'") + c + shown(name) + "' inside group " + group.name +
                      " (begun in line " + std::to_string(group.place.line) +
                      "): put '/' at the end of that group, and quotes around text");
}

Assignment Parser::read_assignment() {
  Assignment assignment;
  assignment.place = at_.place();
  if (!is_name_start(at_.peek())) {
    at_.fail(at_.place(), "a key must stand here, as in key = 1.5, not \"" +
                              shown(std::string_view(at_.text()).substr(at_.offset(), 1)) +
                              "\"; keys begin with a letter");
  }
  for (;;) {
    assignment.name.push_back(read_name_part());
    at_.advance_to(at_.after_white(at_.offset()));
    if (at_.peek() != '%') break;
    at_.advance();
    at_.advance_to(at_.after_white(at_.offset()));
  }
  if (at_.peek() != '=') {
    at_.fail(assignment.place, "'=' is missing after \"" + shown(assignment.full_name()) +
                                   "\": write " + shown(assignment.full_name()) +
                                   " = value, and quotes around text");
  }
  at_.advance();
  read_values(assignment.values);
  return assignment;
}

NamePart Parser::read_name_part() {
  NamePart part;
  if (!is_name_start(at_.peek())) at_.fail(at_.place(), "the name of a component must follow '%'");
  part.name = lower_case(at_.take_name());
  if (at_.at(at_.after_white(at_.offset())) != '(') return part;
  at_.advance_to(at_.after_white(at_.offset()));
  part.subscripts = read_parentheses();
  if (at_.at(at_.after_white(at_.offset())) != '(') return part;
  at_.advance_to(at_.after_white(at_.offset()));
  const Place place = at_.place();
  part.substring = read_parentheses();
  if (part.substring.size() != 1 || !part.substring.front().is_range) {
    at_.fail(place, "second parentheses take one range of characters, as in (2:5)");
  }
  return part;
}

std::vector<Subscript> Parser::read_parentheses() {
  std::vector<Subscript> subscripts;
  do {
    at_.advance();  // '(' or ','
    subscripts.push_back(read_subscript());
  } while (at_.peek() == ',');
  if (at_.peek() != ')') {
    at_.fail(
        at_.place(),
        "subscripts are whole numbers or ranges, as in (2), (1,3) or (2:5), with ')' at the end");
  }
  at_.advance();
  return subscripts;
}

Subscript Parser::read_subscript() {
  Subscript s;
  at_.skip_white();
  const Place place = at_.place();
  s.has_first = read_subscript_number(s.first);
  if (at_.peek() == ':') {
    s.is_range = true;
    at_.advance();
    s.has_last = read_subscript_number(s.last);
    if (at_.peek() == ':') {
      at_.advance();
      const Place stride = at_.place();
      if (!read_subscript_number(s.stride) || s.stride == 0) {
        at_.fail(stride, "a stride is a whole number other than 0, as in (1:9:2)");
      }
    }
  } else {
    if (!s.has_first)
      at_.fail(place, "a subscript is missing: write a whole number or a range such as 2:5");
    s.has_last = true;
    s.last = s.first;
  }
  return s;
}

bool Parser::read_subscript_number(std::int64_t& number) {
  at_.skip_white();
  const Place place = at_.place();
  if (at_.peek() == '+') at_.advance();
  const std::size_t begin = at_.offset();
  if (at_.peek() == '-') at_.advance();
  while (is_digit(at_.peek())) at_.advance();
  const std::string_view digits = at_.since(begin);
  if (digits.empty()) return false;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (result.ec != std::errc()) {
    at_.fail(place, "\"" + shown(digits) +
                        "\" is no subscript: write a whole number of at most 18 digits");
  }
  at_.skip_white();
  return true;
}

// gfortran's rules for separators, which the tests compare with gfortran itself:
// - after a value: blanks, then one comma or semicolon, or line ends, or a comment
// - then, if a line has ended there, further blanks, line ends and comments, and one comma unless
//   one was read before
// - a comma, a semicolon or a comment that stands where a value should is an empty value
void Parser::read_values(std::vector<Value>& values) {
  Between between = Between::nothing;
  for (;;) {
    if (between != Between::comment) at_.skip_blanks();
    if (between == Between::comment || at_.peek() == '\n') between = absorb_lines(between, values);
    const char c = at_.peek();
    if (c == '!' && is_text_after_comment()) {
      at_.skip_white();
    } else if (c == ',' || c == ';' || c == '!') {
      push_empty(values, c == '!' || between == Between::line_end);
      between = read_separator();
    } else if (at_.at_end() || c == '/' || c == '&' || c == '$' || is_name_next(at_)) {
      break;
    } else {
      read_item(values);
      between = read_separator_after_word(values);
    }
  }
  while (!values.empty() && values.back().hidden) values.pop_back();
}

void Parser::push_empty(std::vector<Value>& values, bool hidden) const {
  Value& null = values.emplace_back();
  null.place = at_.place();
  null.hidden = hidden;
}

// Two kinds of words change gfortran's rules: inf and nan take the line ends that follow with them;
// after a logical of two letters or more without a point, a comment leaves what follows to be the
// next value, be it only a blank.
Parser::Between Parser::read_separator_after_word(std::vector<Value>& values) {
  const Value& last = values.back();
  const bool real = std::holds_alternative<double>(last.scalar);
  if (real && !is_digit(last.text.back()) && last.text.back() != '.') {
    at_.advance_to(at_.after_white(at_.offset()));
  }
  const Between between = read_separator();
  const bool logical = std::holds_alternative<bool>(last.scalar);
  if (between != Between::comment || !logical || last.text.size() == 1 || last.text[0] == '.') {
    return between;
  }
  const char c = at_.peek();
  if (!is_blank(c) && c != ',' && c != ';' && c != '!') return Between::nothing;
  push_empty(values, true);
  return read_separator();
}

Parser::Between Parser::read_separator() {
  at_.skip_blanks();
  switch (at_.peek()) {
    case ',':
    case ';':
      at_.advance();
      at_.skip_blanks();
      return Between::comma;
    case '\n':
      at_.skip_white();
      return Between::line_end;
    case '!':
      at_.skip_comment();
      return Between::comment;
    default:
      return Between::nothing;
  }
}

Parser::Between Parser::absorb_lines(Between between, std::vector<Value>& values) {
  at_.skip_white();
  while (at_.peek() == ',' && between != Between::comma) {
    // The comma after the comment makes the empty value before the comment one that is seen.
    if (between == Between::comment && !values.empty()) values.back().hidden = false;
    at_.advance();
    at_.skip_blanks();
    if (at_.peek() != '\n') return Between::comma;
    at_.skip_white();
  }
  return between == Between::comment ? Between::line_end : between;
}

bool Parser::is_text_after_comment() const {
  Cursor ahead = at_;
  ahead.skip_white();
  while (is_digit(ahead.peek())) ahead.advance();
  if (ahead.peek() == '*') ahead.advance();
  return is_quote(ahead.peek());
}

void Parser::read_item(std::vector<Value>& values) {
  const Place place = at_.place();
  std::size_t digits = 0;
  while (is_digit(at_.peek(digits))) ++digits;
  if (digits == 0 || at_.peek(digits) != '*') {
    values.push_back(read_value(at_));
    return;
  }
  const std::size_t count = read_repeat(digits);
  Value value;
  value.place = at_.place();
  const char c = at_.peek();
  if (!is_separator(c) && c != '&' && c != '$') value = read_value(at_);
  repeat(value, count, place, values);
}

std::size_t Parser::read_repeat(std::size_t digits) {
  const Place place = at_.place();
  const std::size_t begin = at_.offset();
  at_.advance_to(begin + digits);
  const std::string_view text = at_.since(begin);
  std::size_t count = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), count);
  if (result.ec == std::errc() && count == 0) {
    at_.fail(
        place,
        "repeat count 0: a count is at least 1; leave the value out, or write the count wanted");
  }
  at_.advance();
  return result.ec == std::errc() ? count : kRepeatedBytes;
}

void Parser::repeat(const Value& value, std::size_t count, Place place,
                    std::vector<Value>& values) {
  const std::size_t bytes = sizeof(Value) + 2 * value.text.size();
  if (count > (kRepeatedBytes - repeated_bytes_) / bytes) {
    at_.fail(place, "repeat count too large: the repeat counts of a file may make about " +
                        std::to_string(kRepeatedBytes / sizeof(Value)) +
                        " values in all; is this count meant?");
  }
  repeated_bytes_ += count * bytes;
  values.insert(values.end(), count, value);
}

}  // namespace cleave::io::namelist
