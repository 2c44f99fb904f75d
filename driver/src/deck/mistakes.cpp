#include "deck/mistakes.hpp"

#include <algorithm>
#include <tuple>

namespace cleave::driver {

std::string message_at(const io::namelist::File& file, io::namelist::Place place,
                       const std::string& message) {
  if (place.line < 1) return file.path + ": " + message;
  return io::namelist::located(file, place, message);
}

void Mistakes::add(io::namelist::Place place, std::string message) {
  list_.push_back({place, std::move(message)});
}

void Mistakes::add_missing(std::string message) { list_.push_back({{}, std::move(message)}); }

void Mistakes::throw_if_any() const {
  if (list_.empty()) return;
  constexpr std::size_t kMostShown = 10;
  std::vector<Mistake> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Mistake& a, const Mistake& b) {
    const auto order = [](const Mistake& m) {
      return std::make_tuple(m.place.line < 1, m.place.line, m.place.column);
    };
    return order(a) < order(b);
  });
  const std::size_t shown = std::min(kMostShown, sorted.size());
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += '\n';
    text += message_at(deck_.source, sorted[i].place, deck_.in_units(sorted[i].message));
  }
  if (sorted.size() > 1) {
    text += '\n' + deck_.source.path + ": " + std::to_string(sorted.size()) + " mistakes";
    if (shown < sorted.size()) text += "; the first " + std::to_string(shown) + " are shown";
  }
  throw DeckError(text);
}

}  // namespace cleave::driver
