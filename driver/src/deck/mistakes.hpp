// Collects what is wrong with a deck, so that one reading reports it all.
#pragma once

#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace cleave::driver {

class Mistakes {
 public:
  explicit Mistakes(const Deck& deck) : deck_(deck) {}

  void add(io::namelist::Place place, std::string message);
  // About something that is not in the file.
  void add_missing(std::string message);
  bool any() const { return !list_.empty(); }
  // Throws DeckError with the first ten in the order of the file, and how many there are.
  void throw_if_any() const;

 private:
  struct Mistake {
    io::namelist::Place place;  // line 0: not in the file
    std::string message;
  };
  const Deck& deck_;  // the part of it that is read
  std::vector<Mistake> list_;
};

// "deck.nml:14:3: message" with the line shown; without a line if the place is not in the file.
std::string message_at(const io::namelist::File& file, io::namelist::Place place,
                       const std::string& message);

}  // namespace cleave::driver
