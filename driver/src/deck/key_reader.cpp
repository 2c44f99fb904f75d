#include "deck/key_reader.hpp"

#include <algorithm>
#include <cmath>

#include "deck/nearest_name.hpp"

namespace cleave::driver {
namespace {

using io::namelist::Place;
using io::namelist::Value;

// Lists in decks are written by hand; a larger subscript is a slip that must not cost memory.
constexpr std::int64_t kLargestSubscript = 1'000'000;

const char* written_as(const io::namelist::Scalar& scalar) {
  static constexpr const char* kNames[] = {"a null value",    "an integer", "a real number",
                                           "a logical value", "a text",     "a complex number"};
  return kNames[scalar.index()];
}

bool is_null(const Value& value) {
  return std::holds_alternative<io::namelist::Null>(value.scalar);
}

// Trailing null values say nothing.
std::size_t count_values(const std::vector<Value>& values) {
  std::size_t count = values.size();
  while (count > 0 && is_null(values[count - 1])) --count;
  return count;
}

bool is_printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
}

template <class T, class Variant>
void split_entries(const std::vector<T>& values, std::vector<Variant>& entries) {
  for (const T& value : values) entries.emplace_back(value);
}

}  // namespace

KeyReader::KeyReader(const KeySpec& spec, const std::string& group, Mistakes& mistakes)
    : spec_(spec), group_(group), mistakes_(mistakes) {
  if (!is_list(spec.type)) entries_.resize(1);
  if (spec.required) return;
  std::visit(
      [&]<class T>(const T& value) {
        if constexpr (std::is_constructible_v<Entry, T>)
          entries_.at(0) = Entry(value);
        else
          split_entries(value, entries_);
      },
      spec.default_value);
}

std::string KeyReader::title() const { return "key \"" + spec_.name + "\" of &" + group_; }

bool KeyReader::fail(Place place, const std::string& message) {
  failed_ = true;
  mistakes_.add(place, message);
  return false;
}

void KeyReader::assign(const io::namelist::Assignment& assignment) {
  if (!given_) place_ = assignment.place;
  for (const Value& value : assignment.values) {
    if (!value.hidden) continue;
    fail(value.place, title() +
                          ": Fortran reads an empty value here, because of a comma before a "
                          "comment or at the start of a line; remove that comma.");
    return;
  }
  const std::optional<Section> where = section(assignment);
  if (!where || !fits(*where, assignment.values, assignment.place)) return;
  for (std::size_t i = 0; i < count_values(assignment.values); ++i) {
    const Value& value = assignment.values[i];
    if (is_null(value)) continue;
    const auto at =
        static_cast<std::size_t>(where->first - 1 + static_cast<std::int64_t>(i) * where->stride);
    if (at >= entries_.size()) entries_.resize(at + 1);
    if (std::optional<Entry> entry = convert(value)) entries_[at] = std::move(*entry);
    given_ = true;
  }
}

std::optional<KeyReader::Section> KeyReader::section(const io::namelist::Assignment& assignment) {
  const auto& subscripts = assignment.name.front().subscripts;
  if (!assignment.name.front().substring.empty()) {
    fail(assignment.place, title() + " takes whole texts, not parts of them.");
    return {};
  }
  if (subscripts.empty()) return Section{};
  if (!is_list(spec_.type)) {
    fail(assignment.place, title() + " is a single value and takes no subscript.");
    return {};
  }
  if (subscripts.size() > 1) {
    fail(assignment.place, title() + " is a list and takes one subscript, " +
                               std::to_string(subscripts.size()) + " are given.");
    return {};
  }
  return triplet(subscripts.front(), assignment.place);
}

std::optional<KeyReader::Section> KeyReader::triplet(const io::namelist::Subscript& subscript,
                                                     Place place) {
  const std::int64_t largest = spec_.allowed.largest_count();
  const std::int64_t end = largest > 0 ? largest : kLargestSubscript;
  Section s;
  s.whole = false;
  s.stride = subscript.is_range ? subscript.stride : 1;
  if (s.stride == 0) {
    fail(place, title() + ": the stride of a section cannot be zero.");
    return {};
  }
  const bool up = s.stride > 0;
  s.first = subscript.has_first ? subscript.first : up ? 1 : end;
  const std::int64_t last = subscript.is_range && subscript.has_last ? subscript.last
                            : up                                     ? end
                                                                     : 1;
  const bool bounded = subscript.is_range && (subscript.has_last || !up);
  for (const std::int64_t index : {s.first, bounded ? last : s.first}) {
    if (index >= 1 && index <= end) continue;
    fail(place, title() + ": subscript " + std::to_string(index) + " is outside 1 .. " +
                    std::to_string(end) + ".");
    return {};
  }
  if (bounded) {
    if (up ? last < s.first : last > s.first) {
      fail(place, title() + ": the section " + std::to_string(s.first) + ":" +
                      std::to_string(last) + " is empty.");
      return {};
    }
    s.count = (last - s.first) / s.stride + 1;
  }
  return s;
}

bool KeyReader::fits(const Section& section, const std::vector<Value>& values, Place place) {
  const auto given = static_cast<std::int64_t>(count_values(values));
  if (given == 0) return true;
  const auto there_are = [&] {
    return given == 1 ? std::string("1 is given.") : std::to_string(given) + " are given.";
  };
  if (!is_list(spec_.type))
    return given == 1 || fail(values[1].place, title() + " takes one value, " + there_are());
  if (section.count > 0 && given > section.count)
    return fail(values[static_cast<std::size_t>(section.count)].place,
                title() + ": this section takes at most " + std::to_string(section.count) +
                    " values, " + there_are());
  const std::int64_t largest = spec_.allowed.largest_count();
  const std::int64_t last = section.first + (given - 1) * section.stride;
  if (largest > 0 && last > largest)
    return fail(
        values[static_cast<std::size_t>((largest - section.first) / section.stride + 1)].place,
        title() + " takes " + allowed_text(spec_.allowed) + ", " +
            (section.whole ? there_are() : "here entry " + std::to_string(last) + " is set."));
  if (last < 1 || last > kLargestSubscript)
    return fail(place, title() + ": subscript " + std::to_string(last) + " is outside 1 .. " +
                           std::to_string(kLargestSubscript) + ".");
  return true;
}

std::optional<KeyReader::Entry> KeyReader::convert(const Value& value) {
  switch (spec_.type) {
    case KeyType::real:
    case KeyType::reals:
    case KeyType::integer:
      return convert_number(value);
    case KeyType::text:
    case KeyType::texts:
    case KeyType::choice:
      return convert_text(value);
    case KeyType::logical:
      break;
  }
  if (const auto* logical = std::get_if<bool>(&value.scalar)) return *logical;
  fail(value.place, title() + ": " + value.text + " is " + written_as(value.scalar) +
                        "; wanted is .true. or .false.");
  return {};
}

std::optional<KeyReader::Entry> KeyReader::convert_number(const Value& value) {
  const bool wants_integer = spec_.type == KeyType::integer;
  const auto* integer = std::get_if<std::int64_t>(&value.scalar);
  const auto* real = std::get_if<double>(&value.scalar);
  const auto refuse = [&](const std::string& why) {
    fail(value.place,
         title() + ": " + value.text + why + "; wanted is " + wanted_text(spec_) + ".");
    return std::optional<Entry>{};
  };
  if (!integer && (wants_integer || !real))
    return refuse(" is " + std::string(written_as(value.scalar)));
  const double number = integer ? static_cast<double>(*integer) : *real;
  if (!std::isfinite(number)) return refuse(" is not a finite number");
  if (!spec_.allowed.contains(number)) return refuse(" is out of range");
  return wants_integer ? Entry(*integer) : Entry(number);
}

std::optional<KeyReader::Entry> KeyReader::convert_text(const Value& value) {
  const auto* text = std::get_if<std::string>(&value.scalar);
  if (!text) {
    fail(value.place, title() + ": " + value.text + " is " + written_as(value.scalar) +
                          "; wanted is " + wanted_text(spec_) + ". Write '" + value.text + "'.");
    return {};
  }
  std::string trimmed = *text;  // Fortran pads texts with blanks: trailing ones mean nothing
  while (!trimmed.empty() && trimmed.back() == ' ') trimmed.pop_back();
  const auto& choices = spec_.allowed.choices;
  if (spec_.type == KeyType::choice &&
      std::find(choices.begin(), choices.end(), trimmed) == choices.end()) {
    fail(value.place, title() + ": '" + trimmed + "' is not a known choice" +
                          did_you_mean(trimmed, choices, "'", "'") +
                          " Allowed: " + allowed_text(spec_.allowed) + ".");
    return {};
  }
  if (!is_printable(trimmed)) {
    fail(value.place, title() + ": the text holds a control character (a tab or line end?).");
    return {};
  }
  if (spec_.required && trimmed.empty()) {
    fail(value.place, title() + " must not be empty: " + spec_.description + ".");
    return {};
  }
  return Entry(trimmed);
}

bool KeyReader::check_entries(Place group_place) {
  if (failed_) return false;
  if (spec_.required && !given_) {
    const bool empty_value = place_.line > 0;  // `key =` with nothing after it
    return fail(empty_value ? place_ : group_place, "&" + group_ + " lacks the required key \"" +
                                                        spec_.name + "\": " + spec_.description +
                                                        ". Wanted is " + wanted_text(spec_) + ".");
  }
  for (std::size_t i = 0; i < entries_.size() && is_list(spec_.type); ++i)
    if (!entries_[i])
      return fail(place_, title() + ": entry " + std::to_string(i + 1) +
                              " has no value, but entry " + std::to_string(entries_.size()) +
                              " has.");
  const auto& counts = spec_.allowed.counts;
  const auto count = static_cast<std::int64_t>(entries_.size());
  if (!counts.empty() && std::find(counts.begin(), counts.end(), count) == counts.end())
    return fail(place_, title() + " takes " + allowed_text(spec_.allowed) + ", " +
                            std::to_string(count) + (count == 1 ? " is given." : " are given."));
  return true;
}

DeckKey KeyReader::finish(Place group_place) {
  DeckKey key;
  key.name = spec_.name;
  key.parameter = spec_.parameter;
  if (check_entries(group_place))
    key.value = assembled();
  else
    key.value = spec_.default_value;  // never used: the deck is refused
  key.given = given_;
  key.place = given_ ? place_ : group_place;
  return key;
}

KeyValue KeyReader::assembled() const {
  const auto list = [&]<class T>(T) {
    std::vector<T> values;
    for (const auto& entry : entries_) values.push_back(std::get<T>(*entry));
    return values;
  };
  if (spec_.type == KeyType::reals) return list(double{});
  if (spec_.type == KeyType::texts) return list(std::string{});
  return std::visit([](const auto& value) { return KeyValue(value); }, *entries_.front());
}

}  // namespace cleave::driver
