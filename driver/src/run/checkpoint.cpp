#include "run/checkpoint.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/unit_text.hpp"

namespace cleave::driver {
namespace {

constexpr std::int64_t kFormat = 2;

std::string fingerprint() {
  std::uint64_t value = 0;
  check(cleave_field_table_fingerprint(&value));
  char text[17] = {};
  std::to_chars(text, text + 16, value, 16);
  return text;
}

io::NamedArray array_of(const Scene& scene, Index body, const cleave_field& field) {
  const UnitText units(scene.deck().one("run").text("units"));
  io::NamedArray array;
  array.name = scene.bodies()[at(body)].name + "/" + field.name;
  array.units = units(field.units);
  array.description = field.description;
  array.components = field.components;
  const std::size_t size = at(field.count * field.components);
  if (field.type == CLEAVE_INTEGER) {
    array.data = std::vector<std::int64_t>(size);
  } else {
    array.data = std::vector<double>(size);
  }
  return array;
}

void read_field(const Scene& scene, Index body, const cleave_field& field, io::NamedArray& array) {
  std::visit([&](auto& values) { scene.model().get(body, field.name, values); }, array.data);
}

// Calls visit(body, field) for every field of the given lifetime, in a fixed order.
template <class Visit>
void for_fields(const Scene& scene, std::int32_t lifetime, Visit visit) {
  for (Index body = 0; body < scene.model().bodies(); ++body) {
    for (const cleave_field& field : scene.model().fields(body)) {
      if (field.lifetime == lifetime) visit(body, field);
    }
  }
}

io::NamedArray integers(std::string name, std::string description, std::vector<Index> values) {
  return {std::move(name), "1", std::move(description), 1, std::move(values)};
}

// What a model does not give back of a body: simplices, numbers in the mesh, and sets.
void add_geometry(const BodyGeometry& body, io::Archive& archive) {
  archive.arrays.push_back(
      integers(body.name + "/point_ids", "number of the particle in the mesh", body.point_ids));
  std::string names;
  for (std::size_t i = 0; i < body.groups.size(); ++i) {
    names += body.groups[i].name + "\n";
    archive.arrays.push_back(integers(body.name + "/group/" + std::to_string(i + 1),
                                      "particles of mesh group " + body.groups[i].name,
                                      body.groups[i].particles));
  }
  archive.arrays.push_back({body.name + "/simplices", "1", "particles of every simplex",
                            body.simplex_nodes(), body.simplices});
  archive.attributes.emplace_back(body.name + ".groups", names);
  archive.attributes.emplace_back(body.name + ".dimension", Index{body.dimension});
}

[[noreturn]] void damaged(const std::string& path, const std::string& what) {
  throw DeckError(path + ": " + what +
                  "; the file is not a checkpoint that this version can continue");
}

template <class T>
const T& attribute(const io::Archive& archive, const std::string& name, const std::string& path) {
  const io::AttributeValue* value = archive.find_attribute(name);
  const T* typed = value == nullptr ? nullptr : std::get_if<T>(value);
  if (typed == nullptr) damaged(path, "it has no attribute " + in_quotes(name));
  return *typed;
}

template <class T>
const std::vector<T>& array(const io::Archive& archive, const std::string& name,
                            const std::string& path) {
  const io::NamedArray* found = archive.find_array(name);
  const auto* typed = found == nullptr ? nullptr : std::get_if<std::vector<T>>(&found->data);
  if (typed == nullptr) damaged(path, "it has no array " + in_quotes(name));
  return *typed;
}

BodyGeometry body_from(const io::Archive& archive, const std::string& name,
                       const std::string& path) {
  BodyGeometry body;
  body.name = name;
  body.dimension = static_cast<int>(attribute<Index>(archive, name + ".dimension", path));
  body.X = array<double>(archive, name + "/reference_position", path);
  body.point_ids = array<Index>(archive, name + "/point_ids", path);
  body.simplices = array<Index>(archive, name + "/simplices", path);
  body.quadratic = archive.find_array(name + "/simplices")->components != body.dimension + 1;
  std::istringstream names(attribute<std::string>(archive, name + ".groups", path));
  Index group = 0;
  for (std::string line; std::getline(names, line);) {
    const std::string key = name + "/group/" + std::to_string(++group);
    body.groups.push_back({line, array<Index>(archive, key, path)});
  }
  return body;
}

}  // namespace

void Snapshot::take(const Scene& scene, Index step, const Cursors& cursors) {
  if (arrays_.empty()) {
    for_fields(scene, CLEAVE_LIFETIME_STATE, [&](Index body, const cleave_field& field) {
      arrays_.push_back(array_of(scene, body, field));
    });
  }
  std::size_t next = 0;
  for_fields(scene, CLEAVE_LIFETIME_STATE, [&](Index body, const cleave_field& field) {
    read_field(scene, body, field, arrays_[next++]);
  });
  step_ = step;
  cursors_ = cursors;
}

void Snapshot::write(const std::string& path, const Scene& scene, const Clock& clock) const {
  io::Archive archive;
  const Deck& deck = scene.deck();
  std::string bodies;
  for (const BodyGeometry& body : scene.bodies()) bodies += body.name + "\n";
  archive.attributes = {{"content", "cleave checkpoint"},
                        {"format", kFormat},
                        {"cleave_version", cleave_version()},
                        {"fields_fingerprint", fingerprint()},
                        {"title", deck.one("run").text("title")},
                        {"units", deck.one("run").text("units")},
                        {"step", step_},
                        {"steps", clock.steps},
                        {"time", clock.time(step_)},
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
    archive.arrays.push_back(array_of(scene, body, field));
    read_field(scene, body, field, archive.arrays.back());
  });
  archive.arrays.insert(archive.arrays.end(), arrays_.begin(), arrays_.end());
  io::write_archive(path, archive);
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

std::string why_not_continued(const std::vector<io::Attribute>& attributes) {
  const auto value = [&](const char* name) {
    const auto at = std::find_if(attributes.begin(), attributes.end(),
                                 [&](const io::Attribute& a) { return a.first == name; });
    return at == attributes.end() ? io::AttributeValue{} : at->second;
  };
  const auto text = [&](const char* name) {
    const io::AttributeValue found = value(name);
    const auto* typed = std::get_if<std::string>(&found);
    return typed == nullptr ? std::string() : *typed;
  };
  if (text("content") != "cleave checkpoint")
    return "it is an archive, but not a checkpoint of a run; name a NAME.STEP.checkpoint.nc";
  const std::string writer = "cleave " + text("cleave_version");
  const std::string self = std::string("cleave ") + cleave_version();
  const std::string what_to_do = ". Continue it with " + writer +
                                 ", or start the run again with this version; the deck is in the "
                                 "file: cleave info --deck FILE";
  const io::AttributeValue format = value("format");
  const auto* number_of = std::get_if<Index>(&format);
  if (number_of == nullptr || *number_of != kFormat) {
    return "it has checkpoint format " + (number_of == nullptr ? "unknown" : number(*number_of)) +
           ", written by " + writer + "; " + self + " reads format " + number(kFormat) + what_to_do;
  }
  if (text("fields_fingerprint") != fingerprint()) {
    return "its fields are those of " + writer + " (fingerprint " + text("fields_fingerprint") +
           "), which differ from those of " + self + " (" + fingerprint() + ")" + what_to_do;
  }
  return {};
}

CheckpointHeader header_of(const io::Archive& archive, const std::string& path) {
  const std::string why_not = why_not_continued(archive.attributes);
  if (!why_not.empty()) throw DeckError(path + ": " + why_not);
  CheckpointHeader header;
  header.deck_text = attribute<std::string>(archive, "deck", path);
  header.deck_path = attribute<std::string>(archive, "deck_path", path);
  header.resolved_deck = attribute<std::string>(archive, "resolved_deck", path);
  header.step = attribute<Index>(archive, "step", path);
  header.steps = attribute<Index>(archive, "steps", path);
  header.dt = attribute<double>(archive, "time_step", path);
  header.cursors = {attribute<Index>(archive, "frames", path),
                    attribute<Index>(archive, "history_records", path),
                    attribute<Index>(archive, "event_records", path)};
  return header;
}

// Values that were filled in, not given, may have other defaults in another version.
Deck deck_of(const CheckpointHeader& header) {
  Deck deck = parse_deck(header.deck_text, header.deck_path);
  const Deck resolved = parse_deck(header.resolved_deck, header.deck_path);
  for (const DeckGroup& group : resolved.groups) {
    const auto place = static_cast<std::size_t>(&group - resolved.groups.data());
    if (place >= deck.groups.size() || deck.groups[place].name != group.name) break;
    for (DeckKey& key : deck.groups[place].keys) {
      const auto stored = std::find_if(group.keys.begin(), group.keys.end(),
                                       [&](const DeckKey& k) { return k.name == key.name; });
      if (stored != group.keys.end()) key.value = stored->value;
    }
  }
  return deck;
}

std::vector<BodyGeometry> bodies_of(const io::Archive& archive, const Deck& deck,
                                    const std::string& path) {
  std::vector<std::string> stored;
  std::istringstream lines(attribute<std::string>(archive, "bodies", path));
  for (std::string name; std::getline(lines, name);) stored.push_back(name);
  const auto groups = deck.all("body");
  std::vector<BodyGeometry> bodies;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string& name = groups[i]->text("name");
    if (i >= stored.size() || stored[i] != name) {
      deck.fail(*groups[i], "name",
                "the checkpoint " + path + " holds other bodies: " + list(stored) +
                    ". A restart keeps bodies, their order and their material laws");
    }
    bodies.push_back(body_from(archive, name, path));
    if (bodies.back().dimension != dimension_of(groups[i]->text("kinematics"))) {
      deck.fail(*groups[i], "kinematics", "the checkpoint holds this body with another dimension");
    }
  }
  if (groups.size() != stored.size()) {
    throw DeckError(deck.source.path + ": the checkpoint " + path + " holds the bodies " +
                    list(stored) + ", the deck has " + std::to_string(groups.size()));
  }
  return bodies;
}

void restore_fields(const io::Archive& archive, const CheckpointHeader& header, Scene& scene,
                    const std::string& path) {
  const auto put = [&](Index body, const cleave_field& field) {
    const std::string name = scene.bodies()[at(body)].name + "/" + field.name;
    const auto expected = at(field.count * field.components);
    const auto put_array = [&](const auto& values) {
      if (values.size() != expected) {
        damaged(path, "array " + in_quotes(name) + " has " + std::to_string(values.size()) +
                          " values, this deck needs " + std::to_string(expected));
      }
      using Values = std::decay_t<decltype(values)>;
      scene.model().put(body, field.name, std::span<const typename Values::value_type>(values));
    };
    if (field.type == CLEAVE_INTEGER) {
      put_array(array<Index>(archive, name, path));
    } else {
      put_array(array<double>(archive, name, path));
    }
  };
  for_fields(scene, CLEAVE_LIFETIME_SETUP, put);
  for_fields(scene, CLEAVE_LIFETIME_STATE, put);
  const double time = static_cast<double>(header.step) * header.dt;
  check(cleave_model_restore(scene.model().handle(), header.step, time));
}

}  // namespace cleave::driver
