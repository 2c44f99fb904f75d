#include "run/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "deck/unit_text.hpp"
#include "io/archive.hpp"
#include "run/checkpoint_format.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace {

template <class T, class Stored>
io::ReadValues<T> from(const std::vector<Stored>& values) {
  return [&values](std::int64_t first, std::span<T> to) {
    std::copy_n(values.begin() + first, to.size(), to.begin());
  };
}

template <class T>
io::ReadValues<T> from_model(const Scene& scene, Index body, const cleave_field& field) {
  return [&scene, body, field](std::int64_t first, std::span<T> to) {
    const Index row = first / field.components;
    scene.model().get(body, field.name, row, row + std::ssize(to) / field.components, to);
  };
}

io::ArraySource source_of(const Scene& scene, Index body, const cleave_field& field) {
  const UnitText units(scene.deck().one("run").text("units"));
  io::ArraySource source;
  source.name = array_name(scene, body, field);
  source.units = units(field.units);
  source.description = field.description;
  source.components = field.components;
  source.size = field.count * field.components;
  if (field.type == CLEAVE_INTEGER) {
    source.read = from_model<Index>(scene, body, field);
  } else {
    source.read = from_model<double>(scene, body, field);
  }
  return source;
}

template <class Stored>
io::ArraySource integers(std::string name, std::string description,
                         const std::vector<Stored>& values, Index components = 1) {
  return {std::move(name),    "1", std::move(description), components, std::ssize(values),
          from<Index>(values)};
}

// What a model does not give back of a body: simplices, numbers in the mesh, and sets.
void add_geometry(const BodyGeometry& body, io::ArchiveSource& archive) {
  archive.arrays.push_back(
      integers(body.name + "/point_ids", "number of the particle in the mesh", body.point_ids));
  std::string names;
  for (std::size_t i = 0; i < body.groups.size(); ++i) {
    names += body.groups[i].name + "\n";
    archive.arrays.push_back(integers(body.name + "/group/" + std::to_string(i + 1),
                                      "particles of mesh group " + body.groups[i].name,
                                      body.groups[i].particles));
  }
  archive.arrays.push_back(integers(body.name + "/simplices", "particles of every simplex",
                                    body.simplices, body.simplex_nodes()));
  if (!body.volumes.empty()) {
    archive.arrays.push_back({body.name + "/volumes", "m3", "volume of the particle as given", 1,
                              std::ssize(body.volumes), from<double>(body.volumes)});
  }
  archive.attributes.emplace_back(body.name + ".groups", names);
  archive.attributes.emplace_back(body.name + ".dimension", Index{body.dimension});
}

}  // namespace

void Snapshot::take(const Scene& scene, Index step, double time, const Cursors& cursors) {
  if (state_.empty()) {
    for_fields(scene, CLEAVE_LIFETIME_STATE, [&](Index body, const cleave_field& field) {
      state_.push_back({body, field, {}, {}});
    });
  }
  for (StateField& state : state_) {
    const cleave_field& field = state.field;
    const Index size = field.count * field.components;
    if (field.type == CLEAVE_INTEGER) {
      state.integers.assign(size, field.components, from_model<Index>(scene, state.body, field));
    } else {
      state.reals.resize(at(size));
      scene.model().get(state.body, field.name, state.reals);
    }
  }
  step_ = step;
  time_ = time;
  cursors_ = cursors;
}

std::int64_t Snapshot::bytes() const {
  std::int64_t bytes = 0;
  for (const StateField& state : state_)
    bytes +=
        static_cast<std::int64_t>(state.reals.capacity() * sizeof(double)) + state.integers.bytes();
  return bytes;
}

void Snapshot::write(const std::string& path, const Scene& scene, const Clock& clock) const {
  io::ArchiveSource archive;
  const Deck& deck = scene.deck();
  std::string bodies;
  for (const BodyGeometry& body : scene.bodies()) bodies += body.name + "\n";
  archive.attributes = {{"content", "cleave checkpoint"},
                        {"format", kCheckpointFormat},
                        {"cleave_version", cleave_version()},
                        {"fields_fingerprint", fields_fingerprint()},
                        {"title", deck.one("run").text("title")},
                        {"units", deck.one("run").text("units")},
                        {"step", step_},
                        {"steps", clock.steps},
                        {"time", time_},
                        {"time_step", clock.dt},
                        {"frames", cursors_.frames},
                        {"history_records", cursors_.history},
                        {"event_records", cursors_.events},
                        {"bodies", bodies},
                        {"deck_path", deck.source.path},
                        {"deck", deck.source.text},
                        {"resolved_deck", deck.resolved()}};
  for (const BodyGeometry& body : scene.bodies()) add_geometry(body, archive);
  for_fields(scene, CLEAVE_LIFETIME_SETUP, [&](Index body, const cleave_field& field) {
    archive.arrays.push_back(source_of(scene, body, field));
  });
  for (const StateField& state : state_) {
    archive.arrays.push_back(source_of(scene, state.body, state.field));
    if (state.field.type == CLEAVE_INTEGER) {
      archive.arrays.back().read = io::ReadValues<Index>(
          [&state](Index first, std::span<Index> to) { state.integers.copy(first, to); });
    } else {
      archive.arrays.back().read = from<double>(state.reals);
    }
  }
  io::write_archive_in_blocks(path, archive);
}

std::string not_finite(const Scene& scene) {
  std::string found;
  for_fields(scene, CLEAVE_LIFETIME_STATE, [&](Index body, const cleave_field& field) {
    if (!found.empty() || field.type != CLEAVE_REAL) return;
    const auto values = scene.model().reals(body, field.name);
    const auto bad = std::find_if(values.begin(), values.end(),
                                  [](double value) { return !std::isfinite(value); });
    if (bad == values.end()) return;
    const auto entry = (bad - values.begin()) / field.components;
    const BodyGeometry& geometry = scene.bodies()[at(body)];
    found = "field " + in_quotes(field.name) + " of body " + in_quotes(geometry.name);
    if (field.relation == CLEAVE_RELATION_POINT) {
      found += " is not finite at particle " + number(geometry.point_ids[at(entry)]) +
               " (reference position " + point_text(&geometry.X[at(3 * entry)]) + ")";
    } else {
      found += " is not finite in entry " + number(Index{entry});
    }
  });
  return found;
}

}  // namespace cleave::driver
