#include "scene/sections.hpp"

#include <algorithm>
#include <cmath>

#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {

namespace {

// The particles on the other side of the plane than its normal.
std::vector<Index> behind(const Deck& deck, const DeckGroup& group, const BodyGeometry& body) {
  const auto& point = group.reals("point");
  const auto& normal = group.reals("normal");
  if (!(std::hypot(normal[0], normal[1], body.dimension == 2 ? 0.0 : normal[2]) > 0)) {
    deck.fail(group, "normal", "the normal has no length in the body's dimensions");
  }
  std::vector<Index> particles;
  for (Index i = 0; i < body.particles(); ++i) {
    double height = 0;
    for (std::size_t k = 0; k < 3; ++k) height += (body.X[at(3 * i) + k] - point[k]) * normal[k];
    if (height < 0) particles.push_back(i);
  }
  if (particles.empty() || std::ssize(particles) == body.particles()) {
    const Box box = bounding_box(body);
    deck.fail(group, "point",
              "the plane does not cut body " + in_quotes(body.name) + ", which reaches from " +
                  point_text(box.lower) + " to " + point_text(box.upper));
  }
  return particles;
}

}  // namespace

Sections::Sections(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets)
    : bodies_(&bodies) {
  for (const DeckGroup* group : deck.all("section")) {
    const bool of_set = !group->text("set").empty();
    std::vector<Selection> chosen;
    if (of_set) {
      chosen = sets.select(*group);
    } else {
      for (const Index body : sets.bodies(*group)) chosen.push_back({body, {}});
    }
    if (chosen.size() > 1) {
      deck.fail(*group, "body",
                "there are several bodies" + std::string(of_set ? " with this set" : "") +
                    "; name the one that is cut");
    }
    const Index body = chosen.front().body;
    Section section{group->text("name"), body, bodies[at(body)].dimension == 2, {}, {}, {}, {}};
    if (!is_column_name(section.name)) {
      deck.fail(*group, "name",
                in_quotes(section.name) + " names columns; use letters, digits, _, - and .");
    }
    std::copy_n(group->reals("point").begin(), 3, section.point);
    section.particle = of_set ? chosen.front().particles : behind(deck, *group, bodies[at(body)]);
    if (of_set && std::ssize(section.particle) == bodies[at(body)].particles()) {
      deck.fail(*group, "set",
                "it is all of body " + in_quotes(bodies[at(body)].name) +
                    ", which leaves nothing to act on it; name a part");
    }
    sections_.push_back(std::move(section));
  }
}

const std::vector<Sections::Section>& Sections::resultants(const Model& model) {
  for (Section& section : sections_) {
    const BodyGeometry& body = (*bodies_)[at(section.body)];
    for (auto* values : {&internal_, &viscous_, &displacement_}) values->resize(body.X.size());
    model.get(section.body, "internal_force", internal_);
    model.get(section.body, "viscous_force", viscous_);
    model.get(section.body, "displacement", displacement_);
    std::fill_n(section.force, 3, 0.0);
    std::fill_n(section.moment, 3, 0.0);
    for (const Index i : section.particle) {
      double f[3], r[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t entry = at(3 * i) + k;
        f[k] = internal_[entry] + viscous_[entry];
        r[k] = body.X[entry] + displacement_[entry] - section.point[k];
        section.force[k] += f[k];
      }
      section.moment[0] += r[1] * f[2] - r[2] * f[1];
      section.moment[1] += r[2] * f[0] - r[0] * f[2];
      section.moment[2] += r[0] * f[1] - r[1] * f[0];
    }
  }
  return sections_;
}

}  // namespace cleave::driver
