// A model driven through the C interface, with errors turned into test failures.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cleave/cleave.h"
#include "support/meshes.hpp"

namespace cleave::test {

inline std::string last_message() {
  char text[4096];
  cleave_last_message(text, sizeof text, nullptr);
  return text;
}

inline void ok(int32_t status) { ASSERT_EQ(status, CLEAVE_OK) << last_message(); }

struct Setting {
  std::string group, name;
  double value = 0;
  std::string choice = "";
};

// What a property test loops over.
struct Case {
  int32_t formulation = CLEAVE_FORMULATION_cbm;
  int32_t material = CLEAVE_MATERIAL_svk;
  int32_t kinematics = CLEAVE_3D;
};

inline int dimension_of(const Case& c) { return c.kinematics == CLEAVE_3D ? 3 : 2; }

// Properties of a law for tests: PMMA-like numbers for the names that are known, else the default.
inline double test_property(const std::string& name, double fallback) {
  if (name == "rho") return 1190;
  if (name == "E") return 3.24e9;
  if (name == "nu") return 0.35;
  if (name == "tau_y0") return 60e6;
  if (name == "tau_inf") return 90e6;
  if (name == "h0") return 100e6;
  if (name == "alpha") return 20;
  if (name == "eps_0") return 0.01;
  if (name == "n") return 0.2;
  if (name == "strain_1") return 0.1;
  if (name == "stress_1") return 80e6;
  // Johnson-Cook
  if (name == "A") return 60e6;
  if (name == "B") return 100e6;
  if (name == "C") return 0.02;
  if (name == "eps_dot_0") return 1;
  if (name == "T_melt") return 450;
  if (name == "c_p") return 1500;
  if (name == "D1") return 0.5;
  // Mie-Grueneisen, with the bulk and shear modulus of the above
  if (name == "c0") return 1739;
  if (name == "s") return 1.5;
  if (name == "Gamma0") return 1;
  if (name == "G") return 1.2e9;
  return fallback;
}

inline bool peridynamic(int32_t formulation) {
  return formulation == CLEAVE_FORMULATION_bond_pd || formulation == CLEAVE_FORMULATION_cpd ||
         formulation == CLEAVE_FORMULATION_lps;
}

// A patch, moved by up to jitter * h if the formulation takes any points, else a lattice that it takes.
inline SimplexMesh solid(const Case& c, int cells, double h, double jitter, unsigned seed) {
  const int d = dimension_of(c);
  if (c.formulation != CLEAVE_FORMULATION_vcpm) return patch(d, cells, h, jitter, seed);
  return d == 2 ? triangular_lattice(cells + 1, cells + 1, h, 0.0, seed)
                : patch(3, cells, h, 0.0, seed);
}

// Bonds that pull, without a stress at points.
inline bool interacts(int32_t formulation) {
  return peridynamic(formulation) || formulation == CLEAVE_FORMULATION_vcpm;
}

// Critical strain of tests that break bonds. The stable step of interactions is shorter, so that less
// happens in as many steps.
inline double breaking_strain(const Case& c) { return interacts(c.formulation) ? 0.012 : 0.02; }

// What a formulation needs and cannot guess: kernel methods their radius, peridynamics its horizon, here
// 1.75 times the mean spacing of the mesh. cpd keeps momentum and energy with conservative weights only.
inline std::vector<Setting> needed_settings(int32_t formulation, const SimplexMesh& mesh) {
  if (formulation != CLEAVE_FORMULATION_tlsph && formulation != CLEAVE_FORMULATION_nosb &&
      !peridynamic(formulation))
    return {};
  double box = 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
    double low = mesh.X[k], high = mesh.X[k];
    for (std::size_t i = k; i < mesh.X.size(); i += 3) {
      low = std::fmin(low, mesh.X[i]);
      high = std::fmax(high, mesh.X[i]);
    }
    box *= high - low;
  }
  const double spacing =
      std::pow(box / static_cast<double>(mesh.particles()), 1.0 / mesh.dimension);
  if (!peridynamic(formulation)) return {{"kernel", "radius", 1.75 * spacing}};
  std::vector<Setting> settings = {{"peridynamics", "horizon", 1.75 * spacing}};
  if (formulation == CLEAVE_FORMULATION_bond_pd)
    settings.push_back({"peridynamics", "modulus", 0, "shear"});
  if (formulation == CLEAVE_FORMULATION_cpd)
    settings.push_back({"cpd", "weights", 0, "conservative"});
  return settings;
}

// Factor on a number with these units ("kg m-3") in a set whose units of length, time and mass are
// 1/length m, 1/time s, 1/mass kg.
inline double unit_factor(const std::string& units, double length, double time, double mass) {
  double factor = 1;
  std::istringstream words(units);
  for (std::string word; words >> word;) {
    const std::size_t end = word.find_first_of("-0123456789");
    const std::string symbol = word.substr(0, end);
    const int power = end == std::string::npos ? 1 : std::stoi(word.substr(end));
    double unit = 1;
    if (symbol == "m") unit = length;
    if (symbol == "s") unit = time;
    if (symbol == "kg") unit = mass;
    if (symbol == "Pa") unit = mass / (length * time * time);
    if (symbol == "J") unit = mass * length * length / (time * time);
    factor *= std::pow(unit, power);
  }
  return factor;
}

class Model {
 public:
  Model() { ok(cleave_model_create(CLEAVE_ABI_VERSION, &handle_)); }
  ~Model() { cleave_model_destroy(handle_); }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  operator cleave_model*() const { return handle_; }

  void add(const Case& c, const SimplexMesh& mesh, const std::vector<Setting>& settings = {}) {
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    spec.formulation = c.formulation;
    spec.kinematics = c.kinematics;
    spec.material = c.material;
    spec.particles = mesh.particles();
    spec.X = mesh.X.data();
    spec.simplex_count = mesh.simplex_count();
    spec.simplices = mesh.simplices.data();
    spec.name = "patch";
    int64_t body = 0;
    ok(cleave_body_add(handle_, &spec, &body));
    set_material(body, c.material);
    set(body, needed_settings(c.formulation, mesh));
    set(body, settings);
  }
  void set(int64_t body, const std::vector<Setting>& settings) {
    for (const auto& s : settings) {
      ok(s.choice.empty()
             ? cleave_body_set_real(handle_, body, s.group.c_str(), s.name.c_str(), s.value)
             : cleave_body_set_choice(handle_, body, s.group.c_str(), s.name.c_str(),
                                      s.choice.c_str()));
    }
  }

  // Gives the properties of the law in another set of units.
  void rescale_material(const char* law, double length, double time, double mass) {
    int64_t count = 0;
    ok(cleave_parameter_count(law, &count));
    for (int64_t k = 0; k < count; ++k) {
      cleave_parameter q{};
      q.size = sizeof q;
      ok(cleave_parameter_get(law, k, &q));
      if (q.type != CLEAVE_REAL) continue;
      double value = 0;
      ok(cleave_body_get_real(handle_, 0, "material", q.name, &value));
      value *= unit_factor(q.units, length, time, mass);
      ok(cleave_body_set_real(handle_, 0, "material", q.name, value));
    }
  }

  void setup() { ok(cleave_model_setup(handle_)); }
  void initialise() { ok(cleave_model_initialise(handle_, 0.0)); }
  double stable_step() const {
    double dt = 0;
    ok(cleave_model_stable_step(handle_, &dt));
    return dt;
  }
  void step(double dt) {
    int64_t n = 0;
    double t = 0;
    ok(cleave_model_clock(handle_, &n, &t));
    ok(cleave_model_advance(handle_, dt, static_cast<double>(n + 1) * dt));
    ok(cleave_model_update(handle_));
  }

  cleave_field field(const std::string& name) const {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_find(handle_, 0, name.c_str(), &f));
    return f;
  }
  std::vector<double> real(const std::string& name) const {
    const cleave_field f = field(name);
    std::vector<double> v(static_cast<std::size_t>(f.count * f.components));
    ok(cleave_field_get_real(handle_, 0, name.c_str(), 0, f.count, v.data()));
    return v;
  }
  std::vector<int64_t> integer(const std::string& name) const {
    const cleave_field f = field(name);
    std::vector<int64_t> v(static_cast<std::size_t>(f.count * f.components));
    ok(cleave_field_get_integer(handle_, 0, name.c_str(), 0, f.count, v.data()));
    return v;
  }
  void put(const std::string& name, const std::vector<double>& v) {
    ok(cleave_field_put_real(handle_, 0, name.c_str(), 0, field(name).count, v.data()));
  }
  cleave_energies energies() const {
    cleave_energies e{};
    e.size = sizeof e;
    ok(cleave_energies_get(handle_, -1, &e));
    return e;
  }
  cleave_counts counts() const {
    cleave_counts c{};
    c.size = sizeof c;
    ok(cleave_counts_get(handle_, -1, &c));
    return c;
  }

 private:
  void set_material(int64_t body, int32_t material) {
    int64_t entries = 0;
    ok(cleave_table_count(CLEAVE_TABLE_MATERIAL, &entries));
    for (int64_t k = 0; k < entries; ++k) {
      cleave_table_entry e{};
      e.size = sizeof e;
      ok(cleave_table_get(CLEAVE_TABLE_MATERIAL, k, &e));
      if (e.value != material) continue;
      int64_t count = 0;
      ok(cleave_parameter_count(e.name, &count));
      for (int64_t p = 0; p < count; ++p) {
        cleave_parameter q{};
        q.size = sizeof q;
        ok(cleave_parameter_get(e.name, p, &q));
        ok(cleave_body_set_real(handle_, body, "material", q.name,
                                test_property(q.name, q.default_value)));
      }
    }
  }
  cleave_model* handle_ = nullptr;
};

inline std::string law_name(int32_t material) {
  cleave_table_entry e{};
  e.size = sizeof e;
  for (int64_t k = 0; cleave_table_get(CLEAVE_TABLE_MATERIAL, k, &e) == CLEAVE_OK; ++k) {
    if (e.value == material) return e.name;
  }
  return "";
}
// Laws that remember: their response depends on the path.
inline bool remembers(const Case& c) {
  int64_t count = 0;
  ok(cleave_material_history_count(c.material, &count));
  return count > 0;
}

// Not objective: a rotation is a strain to it, so that rigid rotations have forces and forces a torque.
inline bool objective(const Case& c) { return c.material != CLEAVE_MATERIAL_linear_elastic; }
// A step from the virgin state has no potential: the yield stress of Johnson-Cook is J times a function,
// and the pressure of the equation of state follows from the energy by a trapezoid over the step.
inline bool has_potential(const Case& c) {
  return c.material != CLEAVE_MATERIAL_johnson_cook &&
         c.material != CLEAVE_MATERIAL_johnson_cook_eos &&
         c.material != CLEAVE_MATERIAL_mie_gruneisen;
}
// A law may refuse a plane condition.
inline bool offered(int32_t material, int32_t kinematics) {
  const std::string law = law_name(material);
  int64_t count = 0;
  ok(cleave_parameter_count(law.c_str(), &count));
  std::vector<double> properties;
  for (int64_t p = 0; p < count; ++p) {
    cleave_parameter q{};
    q.size = sizeof q;
    ok(cleave_parameter_get(law.c_str(), p, &q));
    properties.push_back(test_property(q.name, q.default_value));
  }
  double speed = 0;
  return cleave_material_wave_speed(material, kinematics, count, properties.data(), &speed) !=
         CLEAVE_UNSUPPORTED;
}

// Whether the formulation can be set up with the law: some take elastic laws only.
inline bool combines(const Case& c) {
  Model model;
  model.add(c, solid(c, 3, 1.0, 0.1, 1));
  return cleave_model_setup(model) == CLEAVE_OK;
}

// Every law of the table with the first formulation, and every formulation with an elastic law and, if it
// takes it, one that remembers, in every plane condition. Laws and formulations meet in one place only
// (formulation/common/stress_points.cpp), so the full product would tell nothing more.
inline std::vector<Case> all_cases() {
  std::vector<Case> out;
  int64_t formulations = 0, materials = 0;
  cleave_table_count(CLEAVE_TABLE_FORMULATION, &formulations);
  cleave_table_count(CLEAVE_TABLE_MATERIAL, &materials);
  for (int64_t f = 0; f < formulations; ++f) {
    for (int64_t m = 0; m < materials; ++m) {
      cleave_table_entry fe{}, me{};
      fe.size = me.size = sizeof fe;
      cleave_table_get(CLEAVE_TABLE_FORMULATION, f, &fe);
      cleave_table_get(CLEAVE_TABLE_MATERIAL, m, &me);
      for (const int32_t k : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS})
        if ((f == 0 || me.value == CLEAVE_MATERIAL_svk || me.value == CLEAVE_MATERIAL_j2) &&
            offered(me.value, k) && (f == 0 || combines({fe.value, me.value, k})))
          out.push_back({fe.value, me.value, k});
    }
  }
  return out;
}

// Whether the formulation has a use for a group of parameters, by asking it.
inline bool takes(const Case& c, const std::string& group) {
  static const std::vector<Setting> examples = {{"fracture", "critical_strain", 0.02},
                                                {"viscosity", "length", 1.0},
                                                {"stabilisation", "alpha", 0.05},
                                                {"hourglass", "psi", 0.05}};
  Model model;
  std::vector<Setting> settings;
  for (const auto& s : examples) {
    if (s.group == group) settings.push_back(s);
  }
  model.add(c, solid(c, 3, 1.0, 0.1, 1), settings);
  return cleave_model_setup(model) == CLEAVE_OK;
}

// The settings of those groups that the formulation has a use for.
inline std::vector<Setting> accepted(const Case& c, const std::vector<Setting>& settings) {
  std::vector<Setting> out;
  for (const auto& s : settings) {
    if (takes(c, s.group)) out.push_back(s);
  }
  return out;
}

// The cases of the tables whose formulation takes the group.
inline std::vector<Case> cases_that_take(const std::string& group) {
  std::vector<Case> out;
  for (const auto& c : all_cases()) {
    if (takes(c, group)) out.push_back(c);
  }
  return out;
}

inline std::string case_name(const testing::TestParamInfo<Case>& info) {
  static const char* kinematics[] = {"", "3d", "plane_strain", "plane_stress"};
  cleave_table_entry fe{}, me{};
  fe.size = me.size = sizeof fe;
  std::string name;
  for (int64_t k = 0; cleave_table_get(CLEAVE_TABLE_FORMULATION, k, &fe) == CLEAVE_OK; ++k) {
    if (fe.value == info.param.formulation) name += fe.name;
  }
  for (int64_t k = 0; cleave_table_get(CLEAVE_TABLE_MATERIAL, k, &me) == CLEAVE_OK; ++k) {
    if (me.value == info.param.material) name += std::string("_") + me.name;
  }
  return name + "_" + kinematics[info.param.kinematics];
}

}  // namespace cleave::test
