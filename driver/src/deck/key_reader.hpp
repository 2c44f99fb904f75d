// One key of a group: its assignments, with subscripts and null values, on top of its default.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "deck/deck.hpp"
#include "deck/key_table.hpp"
#include "deck/mistakes.hpp"

namespace cleave::driver {

class KeyReader {
 public:
  KeyReader(const KeySpec& spec, const std::string& group, Mistakes& mistakes);

  // Applies `key(subscripts) = values` as Fortran does: values fill the list from the first
  // subscript on, null values leave what was there.
  void assign(const io::namelist::Assignment& assignment);

  // The value after all assignments. `group_place` is where a missing required key is reported.
  DeckKey finish(io::namelist::Place group_place);

 private:
  using Entry = std::variant<double, std::int64_t, bool, std::string>;

  struct Section {
    std::int64_t first = 1, stride = 1, count = 0;  // count 0: without end
    bool whole = true;                              // no subscript was given
  };

  std::string title() const;  // key "t_end" of &run
  bool fail(io::namelist::Place place, const std::string& message);
  std::optional<Section> section(const io::namelist::Assignment& assignment);
  std::optional<Section> triplet(const io::namelist::Subscript& subscript,
                                 io::namelist::Place place);
  bool fits(const Section& section, const std::vector<io::namelist::Value>& values,
            io::namelist::Place place);
  std::optional<Entry> convert(const io::namelist::Value& value);
  std::optional<Entry> convert_number(const io::namelist::Value& value);
  std::optional<Entry> convert_text(const io::namelist::Value& value);
  bool check_entries(io::namelist::Place group_place);
  KeyValue assembled() const;

  const KeySpec& spec_;
  const std::string& group_;
  Mistakes& mistakes_;
  std::vector<std::optional<Entry>> entries_;  // one if the key is no list
  bool given_ = false, failed_ = false;
  io::namelist::Place place_{};  // of the first assignment
};

}  // namespace cleave::driver
