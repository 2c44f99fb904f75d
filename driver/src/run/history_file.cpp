#include "run/history_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "deck/unit_text.hpp"
#include "run/components.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

struct EnergyColumn {
  const char* name;
  double cleave_energies::*value;
  const char* description;
};
constexpr EnergyColumn kEnergies[] = {
    {"kinetic", &cleave_energies::kinetic, "kinetic energy"},
    {"elastic", &cleave_energies::elastic, "stored elastic energy"},
    {"plastic", &cleave_energies::plastic, "plastic work"},
    {"stabilisation", &cleave_energies::stabilisation, "energy stored by the stabilisation"},
    {"fracture", &cleave_energies::fracture, "energy released by breaking bonds"},
    {"viscous", &cleave_energies::viscous,
     "energy dissipated by artificial viscosity, or by the damping of relaxation"},
    {"external", &cleave_energies::external, "work of external forces"},
    {"reaction", &cleave_energies::reaction, "work of the forces that keep prescribed motion"},
    {"internal", &cleave_energies::internal, "work done against internal forces"},
    {"balance", &cleave_energies::balance, "error of the energy balance"},
    {"identity", &cleave_energies::identity, "error of the integrator's discrete identity"},
    {"hourglass", &cleave_energies::hourglass, "hourglass diagnostic, not part of the balance"}};

struct CountColumn {
  const char* name;
  std::int64_t cleave_counts::*value;
  const char* description;
};
constexpr CountColumn kCounts[] = {
    {"broken", &cleave_counts::broken, "bonds that met the fracture criterion"},
    {"inert", &cleave_counts::inert, "bonds that lost all their simplices otherwise"},
    {"isolated", &cleave_counts::isolated, "particles without a live simplex"},
    {"inverted", &cleave_counts::inverted, "particles with det F <= 0"}};

Index nearest_particle(const BodyGeometry& body, const std::vector<double>& point) {
  Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < body.particles(); ++i) {
    double square = 0;
    for (std::size_t k = 0; k < point.size(); ++k) {
      square += std::pow(body.X[at(3 * i) + k] - point[k], 2);
    }
    if (square < least) {
      least = square;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

HistoryFile::HistoryFile(const Scene& scene)
    : units_(scene.deck().one("run").text("units")), relaxes_(Stepping(scene.deck()).relaxes()) {
  const UnitText units(units_);
  add_column("step", "1", "number of steps done", true);
  add_column("time", units("s"), "time");
  for (const EnergyColumn& energy : kEnergies) {
    add_column(energy.name, units("J"), energy.description);
  }
  for (const CountColumn& count : kCounts) add_column(count.name, "1", count.description, true);
  for (const char axis : {'x', 'y', 'z'}) {
    add_column(std::string("momentum_") + axis, units("kg m s-1"), "momentum of all particles");
  }
  add_loads(scene);
  add_sections(scene);
  if (relaxes_) {
    add_column("iterations", "1", "evaluations of the forces in this increment", true);
    add_column("breaking_rounds", "1", "equilibria of this increment in which bonds broke", true);
    add_column("residual", "1", "norm of the unbalanced forces over that of all forces");
  }
  for (const DeckGroup* probe : scene.deck().all("probe")) add_probe(scene, *probe);
  for (Index body = 0; body < scene.model().bodies(); ++body) {
    mass_.push_back(scene.model().reals(body, "mass"));
  }
}

void HistoryFile::add_column(const std::string& name, const std::string& units,
                             const std::string& text, bool is_integer) {
  columns_.push_back({name, units, text, is_integer});
}

void HistoryFile::add_loads(const Scene& scene) {
  const UnitText units(units_);
  for (const Motions::Reaction& reaction : scene.motions().reaction_columns()) {
    for (const int direction : reaction.directions) {
      add_column("reaction_" + reaction.load + "_" + "xyz"[direction], units("N"),
                 "force that keeps the prescribed motion of load " + reaction.load);
    }
  }
  for (const Forces::Resultant& resultant : scene.forces().resultants()) {
    for (const int direction : resultant.directions) {
      add_column("force_" + resultant.load + "_" + "xyz"[direction], units("N"),
                 "sum of the forces of load " + resultant.load);
    }
  }
}

void HistoryFile::add_sections(const Scene& scene) {
  const UnitText units(units_);
  for (const Sections::Section& section : scene.sections().all()) {
    for (int k = 0; k < (section.plane ? 2 : 3); ++k) {
      add_column("section_" + section.name + "_force_" + "xyz"[k], units("N"),
                 "force through section " + section.name);
    }
    for (int k = section.plane ? 2 : 0; k < 3; ++k) {
      add_column("section_" + section.name + "_moment_" + "xyz"[k], units("N m"),
                 "moment through section " + section.name + " about its point");
    }
  }
}

// Finds the simplex that holds the point of an interpolated probe.
void HistoryFile::place_probe(const Scene& scene, const DeckGroup& group, Probe& probe) const {
  std::vector<double> point = group.reals("point");
  point.resize(3, 0.0);
  probe.place.resize(4);
  check(cleave_body_locate(scene.model().handle(), probe.body, 1, point.data(), &probe.simplex,
                           probe.place.data()));
  if (probe.simplex >= 0) return;
  const Box box = bounding_box(scene.bodies()[at(probe.body)]);
  scene.deck().fail(group, "point",
                    point_text(point.data()) + " is not inside the body, which reaches from " +
                        point_text(box.lower) + " to " + point_text(box.upper));
}

void HistoryFile::add_probe(const Scene& scene, const DeckGroup& group) {
  const Deck& deck = scene.deck();
  const std::string& name = group.text("name");
  if (!is_column_name(name)) {
    deck.fail(group, "name", in_quotes(name) + " names a column; use letters, digits, _, - and .");
  }
  const auto& point = group.reals("point");
  if (point.empty() == group.text("set").empty()) {
    deck.fail(group, "a probe needs either point or set");
  }
  const std::vector<Index> bodies = scene.sets().bodies(group);
  if (bodies.size() > 1) {
    deck.fail(group, "body", "there are several bodies; name the one to probe");
  }
  const Index body = bodies.front();
  const auto field = scene.model().find_field(body, group.text("field"));
  const bool interpolated = group.text("at") == "point";
  const auto fits = [&](const cleave_field& f) {
    return f.relation == CLEAVE_RELATION_POINT ||
           (interpolated && f.relation == CLEAVE_RELATION_INTEGRATION_POINT);
  };
  if (!field || !fits(*field)) {
    std::vector<std::string> known;
    for (const cleave_field& other : scene.model().fields(body)) {
      if (fits(other)) known.push_back(other.name);
    }
    deck.fail(group, "field",
              in_quotes(group.text("field")) + " is not a field of " +
                  (interpolated ? "points" : "particles") + "; known: " + list(known));
  }
  if (interpolated && (point.empty() || field->type != CLEAVE_REAL)) {
    deck.fail(group, "at", "only real fields at a point are interpolated; use at = 'particle'");
  }
  const BodyGeometry& geometry = scene.bodies()[at(body)];
  Probe probe;
  probe.body = body;
  probe.field = field->name;
  probe.integer = field->type == CLEAVE_INTEGER;
  probe.components = field->components;
  if (interpolated) {
    place_probe(scene, group, probe);
  } else if (!point.empty()) {
    probe.particles = {nearest_particle(geometry, point)};
    probe.weights = {1.0};
  } else {
    probe.particles = scene.sets().select(group).front().particles;
    const auto mass = scene.model().reals(body, "mass");
    double total = 0;
    for (const Index particle : probe.particles) total += mass[at(particle)];
    for (const Index particle : probe.particles)
      probe.weights.push_back(mass[at(particle)] / total);
  }
  const UnitText units(units_);
  for (const Component& component : components_of(field->components, geometry.dimension == 2)) {
    const std::string column = name + component.suffix;
    for (const io::Column& other : columns_) {
      if (other.name == column) {
        deck.fail(
            group, "name",
            "the history already has a column " + in_quotes(column) + "; choose another name");
      }
    }
    probe.written.push_back(component.index);
    add_column(column, units(field->units),
               std::string(field->description) +
                   (interpolated    ? " at a point"
                    : point.empty() ? ", mean over set " + group.text("set")
                                    : " at particle " +
                                          number(geometry.point_ids[at(probe.particles.front())])));
  }
  probes_.push_back(std::move(probe));
}

std::string HistoryFile::csv_path(const FileNames& names, const Scene& scene) const {
  return scene.deck().one("history").logical("csv") ? names.history_csv() : "";
}

void HistoryFile::create(const FileNames& names, const Scene& scene, const Clock& clock) {
  table_ = io::RecordTable::create(names.history(), csv_path(names, scene), columns_,
                                   {{"title", scene.deck().one("run").text("title")},
                                    {"cleave_version", cleave_version()},
                                    {"units", units_},
                                    {"time_step", number(clock.dt, 17)}});
}

void HistoryFile::reopen(const FileNames& names, const Scene& scene, Index records) {
  table_ = io::RecordTable::reopen(names.history(), csv_path(names, scene), columns_, records);
}

void HistoryFile::write(Scene& scene, Index step, double time, const cleave_energies& energies,
                        const StepReport& report) {
  Model& model = scene.model();
  record_.clear();
  record_.push_back(static_cast<double>(step));
  record_.push_back(time);
  for (const EnergyColumn& energy : kEnergies) record_.push_back(energies.*energy.value);
  const cleave_counts counts = model.total_counts();
  for (const CountColumn& count : kCounts) {
    record_.push_back(static_cast<double>(counts.*count.value));
  }
  add_momentum(model);
  for (const Motions::Reaction& reaction : scene.motions().reactions(model)) {
    for (const int direction : reaction.directions) record_.push_back(reaction.force[direction]);
  }
  for (const Forces::Resultant& resultant : scene.forces().resultants()) {
    for (const int direction : resultant.directions) record_.push_back(resultant.force[direction]);
  }
  for (const Sections::Section& section : scene.sections().resultants(model)) {
    for (int k = 0; k < (section.plane ? 2 : 3); ++k) record_.push_back(section.force[k]);
    for (int k = section.plane ? 2 : 0; k < 3; ++k) record_.push_back(section.moment[k]);
  }
  if (relaxes_) {
    record_.insert(record_.end(), {static_cast<double>(report.iterations),
                                   static_cast<double>(report.rounds), report.residual});
  }
  for (const Probe& probe : probes_) add_probe_values(model, probe);
  table_->append(record_);
}

void HistoryFile::add_momentum(const Model& model) {
  constexpr Index kBlock = Index{1} << 14;  // stays in the processor's cache
  double sum[3] = {0, 0, 0};
  for (Index body = 0; body < model.bodies(); ++body) {
    const std::vector<double>& mass = mass_[at(body)];
    for (Index first = 0; first < std::ssize(mass); first += kBlock) {
      const Index last = std::min<Index>(first + kBlock, std::ssize(mass));
      real_.resize(at(3 * (last - first)));
      model.get(body, "velocity", first, last, real_);
      for (std::size_t i = 0; i < at(last - first); ++i) {
        for (std::size_t k = 0; k < 3; ++k) sum[k] += mass[at(first) + i] * real_[3 * i + k];
      }
    }
  }
  record_.insert(record_.end(), sum, sum + 3);
}

void HistoryFile::add_probe_values(const Model& model, const Probe& probe) {
  if (probe.simplex >= 0) {
    real_.resize(at(probe.components));
    check(cleave_field_interpolate(model.handle(), probe.body, probe.field.c_str(), 1,
                                   &probe.simplex, probe.place.data(), real_.data()));
    for (const Index component : probe.written) record_.push_back(real_[at(component)]);
    return;
  }
  const bool single = probe.particles.size() == 1;
  const Index first = single ? probe.particles.front() : 0;
  const Index last = single ? first + 1 : static_cast<Index>(mass_[at(probe.body)].size());
  const std::size_t size = at((last - first) * probe.components);
  real_.resize(size);
  if (probe.integer) {
    integer_.resize(size);
    check(cleave_field_get_integer(model.handle(), probe.body, probe.field.c_str(), first, last,
                                   integer_.data()));
    std::copy(integer_.begin(), integer_.end(), real_.begin());
  } else {
    check(cleave_field_get_real(model.handle(), probe.body, probe.field.c_str(), first, last,
                                real_.data()));
  }
  for (const Index component : probe.written) {
    double mean = 0;
    for (std::size_t k = 0; k < probe.particles.size(); ++k) {
      const std::size_t entry = at((probe.particles[k] - first) * probe.components + component);
      mean += probe.weights[k] * real_[entry];
    }
    record_.push_back(mean);
  }
}

}  // namespace cleave::driver
