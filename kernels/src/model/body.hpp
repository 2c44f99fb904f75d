// A body: particles with one formulation and one material law, its fields and its prescribed
// motion.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/blocks.hpp"
#include "core/error.hpp"
#include "core/field_store.hpp"
#include "core/parameter.hpp"
#include "material/material.hpp"
#include "material/stress.hpp"
#include "model/formulation.hpp"
#include "model/ledger.hpp"

namespace cleave {

struct PrescribedDof {
  std::int32_t particle;
  std::int32_t direction;
  cleave_motion motion;
  double displacement = 0;  // at the end of the step, motion EXACT only
  double acceleration = 0;
};

// Raw pointers into the core fields, NULL while a field has no memory. h to volume are at integration
// points, the others at particles.
struct PointArrays {
  double *X, *x, *u, *v, *a, *mass, *internal, *viscous, *external;
  double *h, *p, *energy, *ratio, *volume;
  double* ledger;
};

// Particles of a body that have another material than it.
struct MaterialRegion {
  const MaterialEntry* law;
  Material material;
  double critical_strain, Gf;  // of its bonds; both 0: as group fracture says
};

struct Body {
  // index_base: what messages count from.
  Body(const cleave_body_spec& spec, int index, int index_base = 0);

  // For messages: the body, and an index as the host counts.
  std::string label() const { return text("body ", index + index_base, " '", name, "'"); }
  std::int64_t number(std::int64_t i) const { return i + index_base; }
  // Throws `status` unless there is such a particle; `where`: what refers to it.
  void check_particle(std::int64_t i, cleave_status status, std::string_view where) const;
  // A particle for messages: its index and where it was in the reference configuration.
  std::string particle_label(std::int64_t i) const;
  int dimension() const { return dimension_of(kinematics); }
  bool points_are_particles() const { return points_are_particles_; }
  // The body's material, or that of the region the particle is in.
  const Material& material_of(std::int64_t particle) const {
    const std::int32_t k = region_of(particle);
    return k == 0 ? material : regions[static_cast<std::size_t>(k) - 1].material;
  }
  // 0: the body's own material, k: regions[k-1].
  std::int32_t region_of(std::int64_t particle) const {
    return region.empty() ? 0 : region[static_cast<std::size_t>(particle)];
  }
  double wave_speed() const;  // the highest of its materials
  ParameterSet& group(std::string_view group_name);
  const ParameterSet& group(std::string_view group_name) const;

  std::string name;
  int index, index_base;
  Kinematics kinematics;
  std::int64_t particles;
  std::int64_t points = 0;                    // integration points
  int simplex_nodes;                          // particles of a simplex
  std::vector<double> given_positions;        // until set-up
  std::vector<std::int64_t> given_simplices;  // (simplex_nodes,m) until set-up
  std::vector<double> given_volumes;          // (n) until set-up; empty: from the simplices
  std::vector<char> exempt;                   // (n) 1: in a zone without fracture; empty: none
  std::vector<MaterialRegion> regions;
  std::vector<std::int32_t> region;  // (n), see region_of; empty: no regions
  bool by_rows = false;              // step in the order of operations of the array calls

  const MaterialEntry* law;
  ParameterSet material_parameters;
  std::vector<std::pair<const char*, ParameterSet>> groups;
  Material material;
  HistoryArrays history;

  FieldStore fields;
  PointArrays point{};
  std::vector<PrescribedDof> prescribed;
  std::vector<cleave_event> events;
  std::unique_ptr<Formulation> formulation;
  BlockSums<3> work;        // per block of particles: internal, viscous, external
  BlockSums<1> point_work;  // per block of points

  // Declares the fields, allocates those of particles and the body, copies positions.
  void make_fields();
  // `point` and `history` anew, after memory of core fields or of history was given back or taken.
  void point_into_fields();

 private:
  bool points_are_particles_ = true;
};

}  // namespace cleave
