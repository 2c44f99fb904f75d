// Deck -> namelist text with every key and its value.
#include <filesystem>

#include "cleave/cleave.h"
#include "deck/deck.hpp"
#include "deck/key_table.hpp"

namespace cleave::driver {
namespace {

namespace fs = std::filesystem;

// A path that is relative to the deck's directory, as seen from `directory`.
std::string moved_path(const std::string& path, const std::string& deck_path,
                       const std::string& directory) {
  if (directory.empty() || path.empty() || fs::path(path).is_absolute()) return path;
  const fs::path target = fs::absolute(fs::path(deck_path)).parent_path() / path;
  return target.lexically_normal()
      .lexically_relative(fs::absolute(directory).lexically_normal())
      .string();
}

std::string key_line(const KeySpec& spec, const DeckKey& key, const std::string& text) {
  // A value that is computed, or an empty list, cannot be written in a namelist: its absence says
  // it.
  if (text.empty()) return "  ! " + key.name + ": none given\n";
  std::string line = "  " + key.name + " = " + text;
  if (!spec.units.empty() && spec.units != "1") line += "  ! [" + spec.units + "]";
  return line + '\n';
}

}  // namespace

std::string Deck::resolved(const std::string& directory) const {
  std::string text =
      "! Deck with every key and its value, by Cleave " + std::string(cleave_version()) + "\n";
  for (const DeckGroup& group : groups) {
    const std::vector<const KeySpec*> specs = key_specs(group);
    text += "\n&" + group.name + "\n";
    for (std::size_t i = 0; i < group.keys.size(); ++i) {
      const DeckKey& key = group.keys[i];
      const KeyValue value =
          specs[i]->allowed.is_file
              ? moved_path(std::get<std::string>(key.value), source.path, directory)
              : key.value;
      text += key_line(*specs[i], key, value_text(value));
    }
    text += "/\n";
  }
  return text;
}

}  // namespace cleave::driver
