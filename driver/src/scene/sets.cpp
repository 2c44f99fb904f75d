#include "scene/sets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "deck/nearest_name.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/region.hpp"

namespace cleave::driver {
Sets::Sets(const Deck& deck, const std::vector<BodyGeometry>& bodies)
    : deck_(deck), geometry_(bodies) {
  for (const BodyGeometry& body : bodies) sets_.push_back(body.groups);
  for (const DeckGroup* zone : deck.all("zone")) add_zone(*zone);
}

void Sets::add_zone(const DeckGroup& zone) {
  const std::string& name = zone.text("name");
  const Region region(deck_, zone);
  bool found = false;
  for (const Index body : bodies(zone)) {
    for (const NamedSet& other : sets_[at(body)]) {
      if (other.name == name) {
        deck_.fail(zone, "name",
                   "body " + in_quotes(geometry_[at(body)].name) + " already has a set " +
                       in_quotes(name) + "; give the zone another name");
      }
    }
    const BodyGeometry& geometry = geometry_[at(body)];
    const double margin = zone.real("tolerance") * shortest_edge(geometry);
    NamedSet set{name, {}};
    for (Index i = 0; i < geometry.particles(); ++i) {
      if (region.contains(&geometry.X[at(3 * i)], margin)) set.particles.push_back(i);
    }
    found = found || !set.particles.empty();
    if (!set.particles.empty()) sets_[at(body)].push_back(std::move(set));
  }
  if (!found) {
    std::string extents;
    for (const Index body : bodies(zone)) {
      const Box box = bounding_box(geometry_[at(body)]);
      extents += "; body " + in_quotes(geometry_[at(body)].name) + " extends from " +
                 point_text(box.lower) + " to " + point_text(box.upper);
    }
    deck_.fail(zone, "zone " + in_quotes(name) + " is empty: it holds no particle" + extents);
  }
}

const std::vector<NamedSet>& Sets::of_body(Index body) const { return sets_[at(body)]; }

std::vector<Index> Sets::bodies(const DeckGroup& group) const {
  const std::string& name = group.text("body");
  std::vector<Index> all(geometry_.size());
  std::iota(all.begin(), all.end(), 0);
  if (!name.empty()) {
    std::erase_if(all, [&](Index body) { return geometry_[at(body)].name != name; });
  }
  return all;
}

std::vector<Selection> Sets::select(const DeckGroup& group) const {
  const std::string& name = group.text("set");
  std::vector<Selection> selections;
  std::vector<std::string> known;  // with the sets of all bodies asked for
  for (const Index body : bodies(group)) {
    if (name.empty()) {
      Selection all{body, std::vector<Index>(at(geometry_[at(body)].particles()))};
      std::iota(all.particles.begin(), all.particles.end(), 0);
      selections.push_back(std::move(all));
      continue;
    }
    for (const NamedSet& set : sets_[at(body)]) {
      if (set.name == name) selections.push_back({body, set.particles});
      if (std::find(known.begin(), known.end(), set.name) == known.end()) known.push_back(set.name);
    }
  }
  if (selections.empty()) {
    deck_.fail(
        group, "set",
        "no particle is in a set " + in_quotes(name) + did_you_mean(name, known, "'", "'") +
            " Known sets (mesh groups with particles of the body, and zones): " + list(known));
  }
  return selections;
}

}  // namespace cleave::driver
