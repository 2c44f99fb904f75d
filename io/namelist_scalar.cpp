// The forms of a namelist value: numbers, logicals, texts, complex numbers. What is accepted
// is what gfortran accepts for a variable of that type, less what it accepts by skipping
// characters.
#include "io/namelist_scalar.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

namespace cleave::io::namelist {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The written form of a number, [sign] digits [. digits] [exponent], taken apart.
struct NumberForm {
  bool negative = false;
  bool integer = true;
  std::string_view mantissa;  // without sign
  std::string_view exponent;  // without letter; may begin with a sign
};

std::optional<NumberForm> number_form(std::string_view token) {
  NumberForm form;
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t begin = i;
    while (i < token.size() && is_digit(token[i])) ++i;
    return i - begin;
  };
  const auto sign = [&] { return i < token.size() && (token[i] == '+' || token[i] == '-'); };

  if (sign()) form.negative = token[i++] == '-';
  const std::size_t begin = i;
  std::size_t count = digits();
  if (i < token.size() && token[i] == '.') {
    form.integer = false;
    ++i;
    count += digits();
  }
  if (count == 0) return std::nullopt;
  form.mantissa = token.substr(begin, i - begin);
  if (i == token.size()) return form;

  form.integer = false;
  const bool letter = std::string_view("eEdDqQ").find(token[i]) != std::string_view::npos;
  if (letter) ++i;
  if (!letter && !sign()) return std::nullopt;
  const std::size_t exponent = i;
  if (sign()) ++i;
  if (digits() == 0 || i != token.size()) return std::nullopt;
  form.exponent = token.substr(exponent);
  if (form.exponent.front() == '+') form.exponent.remove_prefix(1);
  return form;
}

// Too large or too small for a double: infinity or zero, as the Fortran and C libraries give.
double beyond_range(const NumberForm& form) {
  const std::size_t first = form.mantissa.find_first_not_of("0.");
  if (first == std::string_view::npos) return 0;
  const std::size_t point = std::min(form.mantissa.find('.'), form.mantissa.size());
  // Sign of the decimal exponent of the first digit; the written one, if it is out of range itself,
  // decides.
  long long exponent = 0;
  const char* const begin = form.exponent.data();
  if (!form.exponent.empty() &&
      std::from_chars(begin, begin + form.exponent.size(), exponent).ec != std::errc()) {
    return form.exponent.front() == '-' ? 0 : kInfinity;
  }
  const bool large = exponent > static_cast<long long>(first) - static_cast<long long>(point);
  return large ? kInfinity : 0;
}

double real_of(const NumberForm& form) {
  std::string text(form.mantissa);
  if (!form.exponent.empty()) text.append("e").append(form.exponent);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range) value = beyond_range(form);
  return form.negative ? -value : value;
}

Scalar scalar_of(const NumberForm& form, std::string_view token) {
  if (form.integer) {
    if (token.front() == '+') token.remove_prefix(1);
    std::int64_t integer = 0;
    const auto result = std::from_chars(token.data(), token.data() + token.size(), integer);
    if (result.ec == std::errc()) return integer;
  }
  return real_of(form);
}

// inf, infinity, nan, nan(...) in any case, with or without a sign.
std::optional<double> special_real(std::string_view token) {
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  const std::string word = lower_case(token);
  if (word == "inf" || word == "infinity") return negative ? -kInfinity : kInfinity;
  if (word == "nan" || (word.starts_with("nan(") && word.ends_with(')'))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::nullopt;
}

bool is_logical(std::string_view word) {
  if (word.starts_with('.')) word.remove_prefix(1);
  if (word.empty() || std::string_view("tTfF").find(word.front()) == std::string_view::npos) {
    return false;
  }
  for (const char c : word) {
    if (!is_name_char(c) && c != '.') return false;
  }
  return true;
}

bool logical_of(std::string_view word) {
  const char c = word[word.front() == '.' ? 1 : 0];
  return c == 't' || c == 'T';
}

bool is_in_subscript(char c) {
  return is_name_char(c) || is_blank(c) || c == '\n' || c == '+' || c == '-' || c == ':' ||
         c == ',';
}

// End of the token at `offset`: the next separator or `stop`; parentheses directly after nan belong
// to it.
std::size_t token_end(const Cursor& at, std::size_t offset, char stop) {
  const std::size_t begin = offset;
  while (!is_separator(at.at(offset)) && at.at(offset) != stop) {
    if (at.at(offset) == '(' && offset >= begin + 3) {
      std::size_t close = offset + 1;
      while (is_name_char(at.at(close))) ++close;
      if (at.at(close) == ')') offset = close;
    }
    ++offset;
  }
  return offset;
}

std::string hint_for(std::string_view token) {
  if (token.find('=') != std::string_view::npos) {
    return "put a blank or a comma before the name of the next key";
  }
  if (token.find('&') != std::string_view::npos || token.find('$') != std::string_view::npos) {
    return "put a blank before the end of the group; text needs quotes";
  }
  if (token.find('_') != std::string_view::npos) {
    return "leave out a kind such as _8; text needs quotes";
  }
  if (token.find('*') != std::string_view::npos) {
    return "a repeated value is written 3*1.5, the count without sign and no blanks inside";
  }
  return "numbers are written 12, 1.5, 1.5e3 or 1.5d-3; text needs quotes";
}

Scalar read_number(Cursor& at, char stop = '\0') {
  const Place place = at.place();
  const std::size_t begin = at.offset();
  at.advance_to(token_end(at, begin, stop));
  const std::string_view token = at.since(begin);
  if (const auto form = number_form(token)) return scalar_of(*form, token);
  if (const auto special = special_real(token)) return *special;
  at.fail(place, "\"" + shown(token) + "\" is not a number: " + hint_for(token));
}

double read_complex_part(Cursor& at, Place place) {
  at.skip_white();
  if (std::string_view(",);/&$").find(at.peek()) != std::string_view::npos || at.at_end()) {
    at.fail(place, "this complex number has an empty part: write both, as in (1.5, -2.0)");
  }
  const std::size_t begin = at.offset();
  Value part;
  part.scalar = read_number(at, ')');
  part.text = std::string(at.since(begin));
  at.skip_white();
  double real = 0;
  as_real(part, real);
  return real;
}

Scalar read_complex(Cursor& at) {
  const Place place = at.place();
  at.advance();
  Complex value;
  value.re = read_complex_part(at, place);
  if (at.peek() != ',')
    at.fail(at.place(), "a complex number is written (1.5, -2.0): ',' is missing");
  at.advance();
  value.im = read_complex_part(at, place);
  if (at.peek() != ')')
    at.fail(at.place(), "a complex number is written (1.5, -2.0): ')' is missing");
  at.advance();
  return value;
}

// Line ends inside a text are no part of it: the text goes on in the first column of the next line.
Scalar read_text(Cursor& at) {
  const Place place = at.place();
  const char quote = at.peek();
  at.advance();
  std::string text;
  for (;; at.advance()) {
    if (at.at_end()) {
      at.fail(place, std::string("this text has no closing ") + quote +
                         ": put one at its end (inside a text, write the quote twice)");
    }
    const char c = at.peek();
    if (c == '\n' || c == '\r') continue;
    if (c == quote) {
      at.advance();
      if (at.peek() != quote) break;
    }
    text += c;
  }
  if (is_separator(at.peek())) return text;
  const std::string twice =
      std::string("; a quote inside a text is written twice, ") + quote + quote;
  if (at.place().line > place.line) {
    at.fail(place, "this text goes on to line " + std::to_string(at.place().line) +
                       " and is followed by more text there: is its closing quote missing?" +
                       twice);
  }
  at.fail(at.place(), "a blank or a comma is missing after this text" + twice);
}

Scalar read_word(Cursor& at) {
  const Place place = at.place();
  const std::size_t begin = at.offset();
  std::size_t end = token_end(at, begin, '\0');
  const std::string_view word = std::string_view(at.text()).substr(begin, end - begin);
  const auto special = special_real(word);
  if (special || is_logical(word)) {
    at.advance_to(end);
    return special ? Scalar(*special) : Scalar(logical_of(word));
  }
  while (at.at(end) == '/' || !is_separator(at.at(end))) ++end;  // mesh/plate.msh is one word
  const std::string all = shown(std::string_view(at.text()).substr(begin, end - begin));
  at.fail(place, "\"" + all + "\" is neither a number nor a logical: put quotes around text, '" +
                     all + "', or '=' after the name of a key");
}

[[noreturn]] void fail_no_value(const Cursor& at) {
  const std::string_view rest = std::string_view(at.text()).substr(at.offset());
  std::size_t length = 1;
  while (length < rest.size() && (static_cast<unsigned char>(rest[length]) & 0xC0U) == 0x80U)
    ++length;
  const bool curly = rest.starts_with("\xE2\x80\x98") || rest.starts_with("\xE2\x80\x99") ||
                     rest.starts_with("\xE2\x80\x9C") || rest.starts_with("\xE2\x80\x9D");
  at.fail(at.place(), "no value can begin with \"" + shown(rest.substr(0, length)) + "\": " +
                          (curly ? "use the straight quotes ' or \""
                                 : "write a number, .true. or .false., or text in quotes"));
}

Scalar read_scalar(Cursor& at) {
  const char c = at.peek();
  const char next = at.peek(1);
  if (is_quote(c)) return read_text(at);
  if (c == '(') return read_complex(at);
  if (is_digit(c) || c == '+' || c == '-' || (c == '.' && !is_letter(next))) return read_number(at);
  if (is_name_start(c) || c == '.') return read_word(at);
  fail_no_value(at);
}

}  // namespace

bool as_real(const Value& value, double& real) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.scalar)) {
    // -0 has a sign as a real and none as an integer.
    real = *integer == 0 && value.text.starts_with('-') ? -0.0 : static_cast<double>(*integer);
    return true;
  }
  if (const auto* number = std::get_if<double>(&value.scalar)) {
    real = *number;
    return true;
  }
  return false;
}

bool is_name_next(const Cursor& at) {
  if (!is_name_start(at.peek())) return false;
  std::size_t end = at.offset();
  while (is_name_char(at.at(end))) ++end;
  const std::string_view word = std::string_view(at.text()).substr(at.offset(), end - at.offset());
  std::size_t next = at.after_white(end);
  if (at.at(next) == '(' && !is_logical(word) && !special_real(word)) return true;
  // `nan(1)` and `t (1,2)` may be values; subscripts have '=' or '%' behind them.
  while (at.at(next) == '(') {
    do ++next;
    while (is_in_subscript(at.at(next)));
    if (at.at(next) != ')') return false;
    next = at.after_white(next + 1);
  }
  return at.at(next) == '=' || at.at(next) == '%';
}

Value read_value(Cursor& at) {
  Value value;
  value.place = at.place();
  const std::size_t begin = at.offset();
  value.scalar = read_scalar(at);
  value.text = std::string(at.since(begin));
  return value;
}

}  // namespace cleave::io::namelist
