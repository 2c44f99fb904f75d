// Named sets of particles: mesh groups and geometric &zone groups of the deck, per body.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/geometry.hpp"

namespace cleave::driver {

// Particles of one body.
struct Selection {
  std::int64_t body = 0;
  std::vector<std::int64_t> particles;  // sorted, unique, not empty
};

class Sets {
 public:
  // Evaluates every &zone. Throws DeckError: a zone that is empty, or has the name of a mesh group.
  Sets(const Deck& deck, const std::vector<BodyGeometry>& bodies);

  // All sets of a body, mesh groups first.
  const std::vector<NamedSet>& of_body(std::int64_t body) const;
  // Bodies that the key "body" of a group means: the named one, or all.
  std::vector<std::int64_t> bodies(const DeckGroup& group) const;
  // The particles that the keys "body" and "set" of a group mean: of the named body or of all that
  // have the set; all particles if `set` is empty. Throws DeckError naming the known sets.
  std::vector<Selection> select(const DeckGroup& group) const;

 private:
  void add_zone(const DeckGroup& zone);

  const Deck& deck_;
  const std::vector<BodyGeometry>& geometry_;
  std::vector<std::vector<NamedSet>> sets_;
};

}  // namespace cleave::driver
