#include "run/checkpoint.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "run/checkpoint_format.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

[[noreturn]] void damaged(const std::string& path, const std::string& what) {
  throw DeckError(path + ": " + what +
                  "; the file is not a checkpoint that this version can continue");
}

template <class T>
const T& attribute(const io::ArchiveHeader& archive, const std::string& name,
                   const std::string& path) {
  const io::AttributeValue* value = archive.find_attribute(name);
  const T* typed = value == nullptr ? nullptr : std::get_if<T>(value);
  if (typed == nullptr) damaged(path, "it has no attribute " + in_quotes(name));
  return *typed;
}

template <class T>
std::vector<T> array(const io::ArchiveHeader& archive, const std::string& name,
                     const std::string& path) {
  if (archive.find_array(name) == nullptr) damaged(path, "it has no array " + in_quotes(name));
  io::NamedArray found = io::read_archive_array(path, name);
  auto* typed = std::get_if<std::vector<T>>(&found.data);
  if (typed == nullptr) damaged(path, "array " + in_quotes(name) + " is of another type");
  return std::move(*typed);
}

BodyGeometry body_from(const io::ArchiveHeader& archive, const std::string& name,
                       const std::string& path) {
  BodyGeometry body;
  body.name = name;
  body.dimension = static_cast<int>(attribute<Index>(archive, name + ".dimension", path));
  body.X = array<double>(archive, name + "/reference_position", path);
  body.point_ids = array<Index>(archive, name + "/point_ids", path);
  for (const Index particle : array<Index>(archive, name + "/simplices", path)) {
    if (particle < 0 || particle >= body.particles()) {
      damaged(path, "array " + in_quotes(name + "/simplices") + " names particle " +
                        number(particle) + " of " + number(body.particles()));
    }
    body.simplices.push_back(static_cast<std::int32_t>(particle));
  }
  const Index nodes = archive.find_array(name + "/simplices")->components;
  body.cloud = nodes == 1;
  body.quadratic = !body.cloud && nodes != body.dimension + 1;
  if (archive.find_array(name + "/volumes") != nullptr)
    body.volumes = array<double>(archive, name + "/volumes", path);
  std::istringstream names(attribute<std::string>(archive, name + ".groups", path));
  Index group = 0;
  for (std::string line; std::getline(names, line);) {
    const std::string key = name + "/group/" + std::to_string(++group);
    body.groups.push_back({line, array<Index>(archive, key, path)});
  }
  return body;
}

}  // namespace

std::string fields_fingerprint() {
  std::uint64_t value = 0;
  check(cleave_field_table_fingerprint(&value));
  char text[17] = {};
  std::to_chars(text, text + 16, value, 16);
  return text;
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
  if (number_of == nullptr || *number_of != kCheckpointFormat) {
    return "it has checkpoint format " + (number_of == nullptr ? "unknown" : number(*number_of)) +
           ", written by " + writer + "; " + self + " reads format " + number(kCheckpointFormat) +
           what_to_do;
  }
  if (text("fields_fingerprint") != fields_fingerprint()) {
    return "its fields are those of " + writer + " (fingerprint " + text("fields_fingerprint") +
           "), which differ from those of " + self + " (" + fields_fingerprint() + ")" + what_to_do;
  }
  return {};
}

CheckpointHeader header_of(const io::ArchiveHeader& archive, const std::string& path) {
  const std::string why_not = why_not_continued(archive.attributes);
  if (!why_not.empty()) throw DeckError(path + ": " + why_not);
  CheckpointHeader header;
  header.deck_text = attribute<std::string>(archive, "deck", path);
  header.deck_path = attribute<std::string>(archive, "deck_path", path);
  header.resolved_deck = attribute<std::string>(archive, "resolved_deck", path);
  header.step = attribute<Index>(archive, "step", path);
  header.steps = attribute<Index>(archive, "steps", path);
  header.dt = attribute<double>(archive, "time_step", path);
  header.time = attribute<double>(archive, "time", path);
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

std::vector<BodyGeometry> bodies_of(const io::ArchiveHeader& archive, const Deck& deck,
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

void restore_fields(const io::ArchiveHeader& archive, const CheckpointHeader& header, Scene& scene,
                    const std::string& path) {
  const auto put = [&](Index body, const cleave_field& field) {
    const std::string name = array_name(scene, body, field);
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
  check(cleave_model_restore(scene.model().handle(), header.step, header.time));
}

}  // namespace cleave::driver
