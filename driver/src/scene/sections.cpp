#include "scene/sections.hpp"

#include <algorithm>
#include <cmath>

#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {

Sections::Sections(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets)
    : bodies_(&bodies) {
  for (const DeckGroup* group : deck.all("section")) {
    const std::vector<Index> chosen = sets.bodies(*group);
    if (chosen.size() > 1) {
      deck.fail(*group, "body", "there are several bodies; name the one that is cut");
    }
    Section section{group->text("name"), chosen.front(), false, {}, {}, {}, {}};
    if (!is_column_name(section.name)) {
      deck.fail(*group, "name",
                in_quotes(section.name) + " names columns; use letters, digits, _, - and .");
    }
    const BodyGeometry& body = bodies[at(section.body)];
    section.plane = body.dimension == 2;
    const auto& point = group->reals("point");
    const auto& normal = group->reals("normal");
    if (!(std::hypot(normal[0], normal[1], section.plane ? 0.0 : normal[2]) > 0)) {
      deck.fail(*group, "normal", "the normal has no length in the body's dimensions");
    }
    std::copy_n(point.begin(), 3, section.point);
    for (Index i = 0; i < body.particles(); ++i) {
      double height = 0;
      for (std::size_t k = 0; k < 3; ++k) height += (body.X[at(3 * i) + k] - point[k]) * normal[k];
      if (height < 0) section.particle.push_back(i);
    }
    if (section.particle.empty() ||
        static_cast<Index>(section.particle.size()) == body.particles()) {
      const Box box = bounding_box(body);
      deck.fail(*group, "point",
                "the plane does not cut body " + in_quotes(body.name) + ", which reaches from " +
                    point_text(box.lower) + " to " + point_text(box.upper));
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
