#include "run/results_file.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>

#include "deck/unit_text.hpp"
#include "run/components.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

bool in_results(const cleave_field& field) {
  return field.relation == CLEAVE_RELATION_POINT || field.relation == CLEAVE_RELATION_SIMPLEX ||
         field.relation == CLEAVE_RELATION_INTEGRATION_POINT;
}

// Written at nodes; other fields are written for elements.
bool is_nodal(const cleave_field& field) { return field.relation == CLEAVE_RELATION_POINT; }

// Fields of all bodies, each name once for nodes and once for elements.
std::vector<cleave_field> all_fields(const Scene& scene) {
  std::vector<cleave_field> fields;
  std::set<std::pair<std::string, bool>> names;
  for (Index body = 0; body < scene.model().bodies(); ++body) {
    for (const cleave_field& field : scene.model().fields(body)) {
      if (names.insert({field.name, is_nodal(field)}).second) fields.push_back(field);
    }
  }
  return fields;
}

std::vector<cleave_field> chosen_fields(const Scene& scene) {
  const std::vector<cleave_field> all = all_fields(scene);
  const DeckGroup& output = scene.deck().one("output");
  const auto is = [](const std::string& name) {
    return [&name](const cleave_field& field) { return name == field.name; };
  };
  std::vector<cleave_field> chosen;
  // What readers need in any case: the displacement and which simplices are deleted.
  for (const std::string name : {"displacement", "simplex_alive"}) {
    const auto field = std::find_if(all.begin(), all.end(), is(name));
    if (field != all.end()) chosen.push_back(*field);
  }
  if (output.texts("fields").empty()) {
    for (const cleave_field& field : all) {
      if (field.output != 0 && in_results(field)) chosen.push_back(field);
    }
  }
  for (const std::string& name : output.texts("fields")) {
    const auto field = std::find_if(all.begin(), all.end(), is(name));
    if (field == all.end() || !in_results(*field)) {
      std::vector<std::string> known;
      for (const cleave_field& other : all) {
        if (in_results(other)) known.push_back(other.name);
      }
      scene.deck().fail(
          output, "fields",
          in_quotes(name) +
              (field == all.end()
                   ? " is not a field of this run"
                   : " is not a field of particles, simplices or integration points") +
              "; fields that can be written: " + list(known));
    }
    std::copy_if(field, all.end(), std::back_inserter(chosen), is(name));
  }
  std::vector<cleave_field> once;
  for (const cleave_field& field : chosen) {
    if (std::none_of(once.begin(), once.end(), [&](const cleave_field& other) {
          return std::string(other.name) == field.name && is_nodal(other) == is_nodal(field);
        })) {
      once.push_back(field);
    }
  }
  return once;
}

// Two bodies of one mesh, or of two meshes that both count from 1, share numbers.
bool repeats(const std::vector<Index>& ids) {
  const auto descent = std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>{});
  if (descent == ids.end()) return false;
  std::vector<Index> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

void add_meshes(const Scene& scene, io::ResultLayout& layout) {
  Index first = 0;
  for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
    const BodyGeometry& body = scene.bodies()[b];
    layout.points.insert(layout.points.end(), body.X.begin(), body.X.end());
    layout.point_ids.insert(layout.point_ids.end(), body.point_ids.begin(), body.point_ids.end());
    io::ResultBlock block{body.name, static_cast<io::CellKind>(body.simplex_nodes()), {}};
    block.nodes.reserve(body.simplices.size());
    for (const std::int32_t particle : body.simplices) block.nodes.push_back(first + particle);
    layout.blocks.push_back(std::move(block));
    for (const NamedSet& set : scene.sets().of_body(static_cast<Index>(b))) {
      auto group = std::find_if(layout.node_sets.begin(), layout.node_sets.end(),
                                [&](const io::MeshGroup& g) { return g.name == set.name; });
      if (group == layout.node_sets.end()) {
        layout.node_sets.push_back({set.name, 0, {}, {}});
        group = layout.node_sets.end() - 1;
      }
      for (const Index particle : set.particles) group->nodes.push_back(first + particle);
    }
    first += body.particles();
  }
  if (repeats(layout.point_ids)) {
    std::iota(layout.point_ids.begin(), layout.point_ids.end(), 1);
  }
}

struct Global {
  const char* name;
  double cleave_energies::*value;
};
constexpr Global kGlobals[] = {
    {"kinetic", &cleave_energies::kinetic},   {"elastic", &cleave_energies::elastic},
    {"plastic", &cleave_energies::plastic},   {"fracture", &cleave_energies::fracture},
    {"viscous", &cleave_energies::viscous},   {"external", &cleave_energies::external},
    {"reaction", &cleave_energies::reaction}, {"balance", &cleave_energies::balance}};

}  // namespace

ResultsFile::ResultsFile(const Scene& scene) {
  const DeckGroup& run = scene.deck().one("run");
  layout_.title = run.text("title").empty() ? "Cleave" : run.text("title");
  layout_.dimension = 3;  // also for plane bodies: readers then see displacements as vectors
  for (const cleave_field& field : chosen_fields(scene)) add_field(scene, field);
  const UnitText units(run.text("units"));
  for (const Global& global : kGlobals) {
    layout_.global.push_back({global.name, units("J"), std::string("energy: ") + global.name});
  }
  layout_.information = {{"cleave_version", cleave_version()},
                         {"units", run.text("units")},
                         {"deck", scene.deck().source.path}};
}

void ResultsFile::add_field(const Scene& scene, const cleave_field& field) {
  const bool plane = std::all_of(scene.bodies().begin(), scene.bodies().end(),
                                 [](const BodyGeometry& body) { return body.dimension == 2; });
  const bool nodal = is_nodal(field);
  const UnitText units(scene.deck().one("run").text("units"));
  std::vector<io::ResultVariable>& variables = nodal ? layout_.nodal : layout_.element;
  Source source{field.name, field.type == CLEAVE_INTEGER, nodal, field.components, variables.size(),
                {}};
  for (const Component& component : components_of(field.components, plane)) {
    std::string name = field.name + component.suffix;
    if (source.field == "displacement") name = std::string("DISPL") + "XYZ"[component.index];
    if (source.field == "simplex_alive") name = "status";
    source.written.push_back(component.index);
    variables.push_back({name, units(field.units), field.description});
  }
  sources_.push_back(std::move(source));
}

io::ResultLayout ResultsFile::layout_with_mesh(const Scene& scene) const {
  io::ResultLayout layout = layout_;
  add_meshes(scene, layout);
  return layout;
}

void ResultsFile::create(const std::string& path, const Scene& scene) {
  writer_ = io::ResultsWriter::create(path, layout_with_mesh(scene));
}

void ResultsFile::reopen(const std::string& path, const Scene& scene, Index frames) {
  writer_ = io::ResultsWriter::reopen(path, layout_with_mesh(scene), frames);
}

// Entries first..last of the field, as reals.
void ResultsFile::read(const Scene& scene, const Source& source, Index body, Index first,
                       Index last) {
  const std::size_t size = at((last - first) * source.components);
  real_.resize(size);
  if (!source.integer) {
    scene.model().get(body, source.field.c_str(), first, last, real_);
    return;
  }
  integer_.resize(size);
  scene.model().get(body, source.field.c_str(), first, last, integer_);
  std::copy(integer_.begin(), integer_.end(), real_.begin());
}

void ResultsFile::put(const Scene& scene, const Source& source, io::ResultsWriter::Frame& frame) {
  constexpr Index kBlock = Index{1} << 14;  // stays in the processor's cache
  Index begin = 0;                          // of the body among all particles or simplices
  for (Index body = 0; body < scene.model().bodies(); ++body) {
    const BodyGeometry& geometry = scene.bodies()[at(body)];
    const Index count = source.nodal ? geometry.particles() : geometry.simplex_count();
    const auto field = scene.model().find_field(body, source.field);
    const bool present = field.has_value() && is_nodal(*field) == source.nodal;
    // Integration points of an element; the element shows their mean.
    const Index points = present && count > 0 ? field->count / count : 1;
    for (Index first = 0; first < count; first += kBlock) {
      const Index last = std::min(first + kBlock, count);
      variable_.assign(at(last - first), 0.0);  // a body without this field shows zero
      if (present) read(scene, source, body, points * first, points * last);
      for (std::size_t k = 0; k < source.written.size(); ++k) {
        for (std::size_t i = 0; present && i < variable_.size(); ++i) {
          double sum = 0;
          for (std::size_t q = at(points) * i; q < at(points) * (i + 1); ++q)
            sum += real_[q * at(source.components) + at(source.written[k])];
          variable_[i] = sum / static_cast<double>(points);
        }
        if (source.nodal) {
          frame.put_nodal(source.variable + k, begin + first, variable_);
        } else {
          frame.put_element(source.variable + k, begin + first, variable_);
        }
      }
    }
    begin += count;
  }
}

void ResultsFile::write_frame(const Scene& scene, double time, const cleave_energies& energies) {
  std::vector<double> globals;
  for (const Global& global : kGlobals) globals.push_back(energies.*global.value);
  io::ResultsWriter::Frame frame = writer_->begin_frame(time, globals);
  for (const Source& source : sources_) put(scene, source, frame);
  frame.finish();
}

}  // namespace cleave::driver
