#include "run/sample.hpp"

#include <algorithm>

#include "deck/nearest_name.hpp"
#include "deck/unit_text.hpp"
#include "io/csv.hpp"
#include "run/checkpoint.hpp"
#include "run/checkpoint_files.hpp"
#include "run/components.hpp"
#include "scene/csv_columns.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

std::vector<double> points_of(const std::string& path, int dimension) {
  const CsvColumns csv = read_csv_columns(path);
  std::vector<double> points(3 * csv.rows.size(), 0.0);
  for (int k = 0; k < dimension; ++k) {
    const std::string name(1, "XYZ"[k]);
    const auto column = std::find(csv.names.begin(), csv.names.end(), name);
    if (column == csv.names.end()) {
      throw DeckError(path + ":1: there is no column " + name +
                      "; the reference positions stand in columns X, Y" +
                      (dimension == 3 ? ", Z" : ""));
    }
    const auto place = static_cast<std::size_t>(column - csv.names.begin());
    for (std::size_t row = 0; row < csv.rows.size(); ++row)
      points[3 * row + at(k)] = csv.rows[row][place];
  }
  return points;
}

Index body_index(const Scene& scene, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
    if (scene.bodies()[b].name == name || (name.empty() && scene.bodies().size() == 1))
      return static_cast<Index>(b);
    known.push_back(scene.bodies()[b].name);
  }
  throw DeckError(
      "--body: " +
      (name.empty() ? "there are several bodies" : in_quotes(name) + " is not one of the bodies") +
      "; bodies of this checkpoint: " + list(known));
}

struct Sampled {
  cleave_field field;
  std::vector<double> values;
};

Sampled sampled_field(const Scene& scene, Index body, const std::string& name,
                      const std::vector<Index>& simplex, const std::vector<double>& weight) {
  std::vector<std::string> known;
  for (const cleave_field& field : scene.model().fields(body)) {
    const bool at_points = field.relation == CLEAVE_RELATION_POINT ||
                           field.relation == CLEAVE_RELATION_INTEGRATION_POINT;
    if (!at_points || field.type != CLEAVE_REAL) continue;
    known.push_back(field.name);
    if (name != field.name) continue;
    Sampled sampled{field, std::vector<double>(simplex.size() * at(field.components))};
    check(cleave_field_interpolate(scene.model().handle(), body, field.name,
                                   static_cast<Index>(simplex.size()), simplex.data(),
                                   weight.data(), sampled.values.data()));
    return sampled;
  }
  throw DeckError("--fields: " + in_quotes(name) + " is not a field of particles; known: " +
                  list(known) + did_you_mean(name, known));
}

}  // namespace

void sample_checkpoint(const SampleRequest& request,
                       const std::function<void(std::string_view)>& out) {
  const Loaded loaded = load_checkpoint(request.checkpoint);
  const CheckpointHeader header = header_of(loaded.archive, loaded.path);
  const Deck deck = deck_of(header);
  Scene scene = Scene::from_bodies(deck, bodies_of(loaded.archive, deck, loaded.path), 1);
  restore_fields(loaded.archive, header, scene, loaded.path);
  const Index body = body_index(scene, request.body);
  const bool plane = scene.bodies()[at(body)].dimension == 2;

  const std::vector<double> points = points_of(request.points, plane ? 2 : 3);
  std::vector<Index> simplex(points.size() / 3);
  std::vector<double> weight(4 * simplex.size());
  check(cleave_body_locate(scene.model().handle(), body, static_cast<Index>(simplex.size()),
                           points.data(), simplex.data(), weight.data()));
  std::vector<Sampled> fields;
  for (const std::string& name : request.fields)
    fields.push_back(sampled_field(scene, body, name, simplex, weight));

  const UnitText units(deck.one("run").text("units"));
  std::vector<io::Column> columns;
  for (const char axis : {'X', 'Y', 'Z'}) columns.push_back({{axis}, units("m"), "", false});
  columns.push_back({"inside", "1", "", true});
  for (const Sampled& sampled : fields) {
    for (const Component& component : components_of(sampled.field.components, plane))
      columns.push_back(
          {sampled.field.name + component.suffix, units(sampled.field.units), "", false});
  }
  out(io::csv_header(columns));
  std::string text;
  for (std::size_t p = 0; p < simplex.size(); ++p) {
    std::vector<double> record(points.begin() + static_cast<std::ptrdiff_t>(3 * p),
                               points.begin() + static_cast<std::ptrdiff_t>(3 * p + 3));
    record.push_back(simplex[p] >= 0 ? 1.0 : 0.0);
    for (const Sampled& sampled : fields) {
      for (const Component& component : components_of(sampled.field.components, plane))
        record.push_back(sampled.values[p * at(sampled.field.components) + at(component.index)]);
    }
    text.clear();
    io::append_csv_records(text, columns, record);
    out(text);
  }
}

}  // namespace cleave::driver
