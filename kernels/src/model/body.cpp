#include "model/body.hpp"

#include <cmath>

#include "tables/tables.hpp"

namespace cleave {

namespace {

Kinematics checked_kinematics(std::int32_t given, const std::string& label) {
  if (given < CLEAVE_3D || given > CLEAVE_PLANE_STRESS) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text(label, ": kinematics is ", given,
                     "; allowed: CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS"));
  }
  return static_cast<Kinematics>(given);
}

}  // namespace

Body::Body(const cleave_body_spec& spec, int body_index, int base)
    : name(spec.name == nullptr ? "" : spec.name),
      index(body_index),
      index_base(base),
      kinematics(checked_kinematics(spec.kinematics, label())),
      particles(spec.particles),
      simplex_nodes(spec.simplex_nodes == 0 ? dimension() + 1 : spec.simplex_nodes),
      law(&find_material(spec.material)),
      material_parameters(text("material law ", law->name, " of ", label()), law->parameters),
      formulation(make_formulation(spec.formulation)) {
  if (particles <= 0 || particles >= INT32_MAX) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text(label(), " has ", particles, " particles; allowed: 1 to ", INT32_MAX - 1));
  }
  if (spec.simplex_count < 0 || spec.simplex_count >= INT32_MAX) {
    throw Error(CLEAVE_BAD_ARGUMENT, text(label(), " has ", spec.simplex_count,
                                          " simplices; allowed: 0 to ", INT32_MAX - 1));
  }
  if (simplex_nodes != dimension() + 1 && !(simplex_nodes == 6 && dimension() == 2)) {
    throw Error(
        CLEAVE_BAD_ARGUMENT,
        text(label(), ": a simplex has ", simplex_nodes, " particles; allowed: ",
             dimension() == 2 ? "3, or 6 (corners, then the middles of edges 12 23 31)" : "4"));
  }
  for (std::int64_t k = 0; k < kVector * particles; ++k) {
    if (!std::isfinite(spec.X[k]) && k % kVector < dimension()) {
      throw Error(CLEAVE_NOT_FINITE, text(label(), ": the position of particle ",
                                          number(k / kVector), " is not finite"));
    }
  }
  given_positions.assign(spec.X, spec.X + kVector * particles);
  given_simplices.assign(spec.simplices, spec.simplices + simplex_nodes * spec.simplex_count);
  for (const auto& g : parameter_groups()) {
    groups.emplace_back(g.name, ParameterSet(text("group ", g.name, " of ", label()), g.specs));
  }
}

std::string Body::particle_label(std::int64_t i) const {
  const double* X = point.X + kVector * i;
  return text("particle ", number(i), " (at X = ", X[0], ", ", X[1], ", ", X[2], ")");
}

void Body::check_particle(std::int64_t i, cleave_status status, std::string_view where) const {
  if (i >= 0 && i < particles) return;
  throw Error(status,
              text(label(), ": particle ", number(i), " of ", where,
                   " does not exist; particles are ", number(0), " to ", number(particles - 1)));
}

double Body::wave_speed() const {
  const auto speed = [](const auto& l) { return l.wave_speed(); };
  double highest = with_law(material, speed);
  for (const MaterialRegion& r : regions) highest = std::fmax(highest, with_law(r.material, speed));
  return highest;
}

ParameterSet& Body::group(std::string_view group_name) {
  if (group_name == "material") return material_parameters;
  std::string known = "material";
  for (auto& [n, set] : groups) {
    if (group_name == n) return set;
    known += text(", ", n);
  }
  throw Error(CLEAVE_UNKNOWN_NAME,
              text("parameter group '", group_name, "' is unknown; known groups: ", known));
}

const ParameterSet& Body::group(std::string_view group_name) const {
  return const_cast<Body*>(this)->group(group_name);
}

void Body::make_fields() {
  points = formulation->integration_points(*this);
  points_are_particles_ = points == kPointsAreParticles;
  if (points_are_particles_) points = particles;
  fields = {};
  fields.declare("core", fields_of("core"));
  fields.declare(formulation->name(), fields_of(formulation->name()));
  fields.declare(law->name, law->history);
  if (points_are_particles_) {
    fields.merge(CLEAVE_RELATION_INTEGRATION_POINT, CLEAVE_RELATION_POINT);
  }
  fields.allocate(CLEAVE_RELATION_POINT, particles);
  fields.allocate(CLEAVE_RELATION_INTEGRATION_POINT, points);
  fields.allocate(CLEAVE_RELATION_BODY, 1);
  point_into_fields();
  for (std::int64_t i = 0; i < particles; ++i) {
    for (int k = 0; k < dimension(); ++k) {
      point.X[kVector * i + k] = given_positions[static_cast<std::size_t>(kVector * i + k)];
      point.x[kVector * i + k] = point.X[kVector * i + k];
    }
  }
  work.resize(particles);
  point_work.resize(points);
}

void Body::point_into_fields() {
  point = {fields.real("reference_position"),
           fields.real("position"),
           fields.real("displacement"),
           fields.real("velocity"),
           fields.real("acceleration"),
           fields.real("mass"),
           fields.real("internal_force"),
           fields.real("viscous_force"),
           fields.real("external_force"),
           fields.real("displacement_gradient"),
           fields.real("first_piola_kirchhoff_stress"),
           fields.real("strain_energy_density"),
           fields.real("volume_ratio"),
           fields.real("volume"),
           fields.real("ledger")};
  for (std::size_t k = 0; k < law->history.size(); ++k) {
    history.base[k] = fields.real(law->history[k].name);
    history.stride[k] = law->history[k].components;
  }
}

}  // namespace cleave
