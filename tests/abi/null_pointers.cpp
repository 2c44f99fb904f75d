// NULL for every pointer of every function that is required: refused by the name of function and
// argument.
#include "abi/arguments.hpp"

namespace cleave::test {
namespace {

TEST_F(Arguments, NullIsRefusedForEveryPointerOfArrayCalls) {
  const int64_t* S = mesh.simplices.data();
  const double *X = mesh.X.data(), *T = three.data(), *P = nine.data(), *J = one.data(),
               *W = w.data();
  double *F = three.data(), *H = nine.data();
  const double* Q = properties;
  int64_t* const no_integers = nullptr;
  double* const no_reals = nullptr;
  const cleave_network no_rows = with(&cleave_network::row_begin, no_integers),
                       no_neighbours = with(&cleave_network::neighbour, no_integers),
                       no_reverse = with(&cleave_network::reverse, no_integers),
                       no_zeta = with(&cleave_network::zeta, no_reals),
                       no_volume = with(&cleave_network::volume, no_reals);
  const auto viscosity = [&](const cleave_network* g, const double* ww, const double* x,
                             const double* v, const double* j, double* f) {
    return cleave_bond_viscosity(g, 0, n, ww, x, v, j, 1, 1, f);
  };
  const auto stress_of = [&](const double* q, const double* h, double* p) {
    return cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, 3, q, 0, n, h, nullptr, p,
                                  nullptr, nullptr);
  };
  expect_refused(
      {{"cleave_network_init", "'network'", [&] { return cleave_network_init(nullptr); }},
       {"cleave_cbm_count_bonds", "'network'",
        [&] { return cleave_cbm_count_bonds(nullptr, m, S); }},
       {"cleave_cbm_count_bonds", "'simplices'",
        [&] { return cleave_cbm_count_bonds(&net, m, nullptr); }},
       {"cleave_cbm_count_bonds", "row_begin'",
        [&] { return cleave_cbm_count_bonds(&no_rows, m, S); }},
       {"cleave_cbm_bonds", "'network'",
        [&] { return cleave_cbm_bonds(nullptr, X, m, S, nullptr); }},
       {"cleave_cbm_bonds", "'X'", [&] { return cleave_cbm_bonds(&net, nullptr, m, S, nullptr); }},
       {"cleave_cbm_bonds", "'simplices'",
        [&] { return cleave_cbm_bonds(&net, X, m, nullptr, nullptr); }},
       {"cleave_cbm_bonds", "row_begin'",
        [&] { return cleave_cbm_bonds(&no_rows, X, m, S, nullptr); }},
       {"cleave_cbm_bonds", "neighbour'",
        [&] { return cleave_cbm_bonds(&no_neighbours, X, m, S, nullptr); }},
       {"cleave_cbm_bonds", "reverse'",
        [&] { return cleave_cbm_bonds(&no_reverse, X, m, S, nullptr); }},
       {"cleave_cbm_bonds", "zeta'", [&] { return cleave_cbm_bonds(&no_zeta, X, m, S, nullptr); }},
       {"cleave_cbm_bonds", "volume'",
        [&] { return cleave_cbm_bonds(&no_volume, X, m, S, nullptr); }},
       {"cleave_displacement_gradient", "'network'",
        [&] { return cleave_displacement_gradient(nullptr, 0, n, T, H); }},
       {"cleave_displacement_gradient", "zeta'",
        [&] { return cleave_displacement_gradient(&no_zeta, 0, n, T, H); }},
       {"cleave_displacement_gradient", "'u'",
        [&] { return cleave_displacement_gradient(&net, 0, n, nullptr, H); }},
       {"cleave_displacement_gradient", "'H'",
        [&] { return cleave_displacement_gradient(&net, 0, n, T, nullptr); }},
       {"cleave_bond_force", "'network'", [&] { return cleave_bond_force(nullptr, 0, n, P, F); }},
       {"cleave_bond_force", "reverse'",
        [&] { return cleave_bond_force(&no_reverse, 0, n, P, F); }},
       {"cleave_bond_force", "'P'", [&] { return cleave_bond_force(&net, 0, n, nullptr, F); }},
       {"cleave_bond_force", "'f'", [&] { return cleave_bond_force(&net, 0, n, P, nullptr); }},
       {"cleave_bond_viscosity", "'network'", [&] { return viscosity(nullptr, W, T, T, J, F); }},
       {"cleave_bond_viscosity", "neighbour'",
        [&] { return viscosity(&no_neighbours, W, T, T, J, F); }},
       {"cleave_bond_viscosity", "'w'", [&] { return viscosity(&net, nullptr, T, T, J, F); }},
       {"cleave_bond_viscosity", "'x'", [&] { return viscosity(&net, W, nullptr, T, J, F); }},
       {"cleave_bond_viscosity", "'v'", [&] { return viscosity(&net, W, T, nullptr, J, F); }},
       {"cleave_bond_viscosity", "'J'", [&] { return viscosity(&net, W, T, T, nullptr, F); }},
       {"cleave_bond_viscosity", "'f'", [&] { return viscosity(&net, W, T, T, J, nullptr); }},
       {"cleave_material_stress", "'properties'", [&] { return stress_of(nullptr, P, H); }},
       {"cleave_material_stress", "'H'", [&] { return stress_of(Q, nullptr, H); }},
       {"cleave_material_stress", "'P'", [&] { return stress_of(Q, P, nullptr); }},
       {"cleave_material_history_count", "'count'",
        [&] { return cleave_material_history_count(CLEAVE_MATERIAL_svk, nullptr); }},
       {"cleave_material_damage_place", "'place'",
        [&] { return cleave_material_damage_place(CLEAVE_MATERIAL_svk, nullptr); }},
       {"cleave_set_last_message", "'text'", [] { return cleave_set_last_message(nullptr); }},
       {"cleave_material_wave_speed", "'properties'",
        [&] { return cleave_material_wave_speed(1, CLEAVE_3D, 3, nullptr, &real); }},
       {"cleave_material_wave_speed", "'speed'",
        [&] { return cleave_material_wave_speed(1, CLEAVE_3D, 3, Q, nullptr); }}},
      CLEAVE_NULL_ARGUMENT);
}

TEST_F(Arguments, NullIsRefusedForEveryPointerOfTables) {
  cleave_parameter parameter{};
  parameter.size = sizeof parameter;
  expect_refused(
      {{"cleave_table_count", "'count'",
        [] { return cleave_table_count(CLEAVE_TABLE_STATUS, nullptr); }},
       {"cleave_table_get", "'entry'",
        [] { return cleave_table_get(CLEAVE_TABLE_STATUS, 0, nullptr); }},
       {"cleave_table_find", "'name'",
        [&] { return cleave_table_find(CLEAVE_TABLE_STATUS, nullptr, &value); }},
       {"cleave_table_find", "'value'",
        [] { return cleave_table_find(CLEAVE_TABLE_STATUS, "OK", nullptr); }},
       {"cleave_parameter_count", "'owner'",
        [&] { return cleave_parameter_count(nullptr, &count); }},
       {"cleave_parameter_count", "'count'", [] { return cleave_parameter_count("svk", nullptr); }},
       {"cleave_parameter_get", "'owner'",
        [&] { return cleave_parameter_get(nullptr, 0, &parameter); }},
       {"cleave_parameter_get", "'parameter'",
        [] { return cleave_parameter_get("svk", 0, nullptr); }},
       {"cleave_field_table_count", "'count'", [] { return cleave_field_table_count(nullptr); }},
       {"cleave_field_table_get", "'field'", [] { return cleave_field_table_get(0, nullptr); }},
       {"cleave_field_table_fingerprint", "'fingerprint'",
        [] { return cleave_field_table_fingerprint(nullptr); }}},
      CLEAVE_NULL_ARGUMENT);
}

TEST_F(Arguments, NullModelIsRefusedEverywhere) {
  int64_t i64 = 0;
  int32_t i32 = 0;
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  cleave_event event{};
  cleave_energies energies{};
  cleave_counts counts{};
  cleave_field field{};
  cleave_model* none = nullptr;
  std::vector<Call> calls = {
      {"cleave_model_set_threads", "", [&] { return cleave_model_set_threads(none, 1); }},
      {"cleave_model_set_order", "", [&] { return cleave_model_set_order(none, 1); }},
      {"cleave_body_add", "", [&] { return cleave_body_add(none, &spec, &i64); }},
      {"cleave_body_set_real", "",
       [&] { return cleave_body_set_real(none, 0, "material", "E", 1); }},
      {"cleave_body_set_choice", "",
       [&] { return cleave_body_set_choice(none, 0, "viscosity", "form", "none"); }},
      {"cleave_body_get_real", "",
       [&] { return cleave_body_get_real(none, 0, "material", "E", &real); }},
      {"cleave_body_prescribe", "",
       [&] { return cleave_body_prescribe(none, 0, 1, &i64, &i32, &i32); }},
      {"cleave_body_exempt", "", [&] { return cleave_body_exempt(none, 0, 1, &i64); }},
      {"cleave_body_region", "",
       [&] { return cleave_body_region(none, 0, 1, &i64, 1, 1, &real, 0, 0); }},
      {"cleave_body_volumes", "", [&] { return cleave_body_volumes(none, 0, 1, &real); }},
      {"cleave_model_setup", "", [&] { return cleave_model_setup(none); }},
      {"cleave_body_precrack", "", [&] { return cleave_body_precrack(none, 0, 0, &i64); }},
      {"cleave_model_stable_step", "", [&] { return cleave_model_stable_step(none, &real); }},
      {"cleave_model_is_stable", "", [&] { return cleave_model_is_stable(none, 1, &i32); }},
      {"cleave_body_wave_speed", "", [&] { return cleave_body_wave_speed(none, 0, &real); }},
      {"cleave_body_motion", "", [&] { return cleave_body_motion(none, 0, 0, nullptr, nullptr); }},
      {"cleave_model_initialise", "", [&] { return cleave_model_initialise(none, 0); }},
      {"cleave_model_advance", "", [&] { return cleave_model_advance(none, 1, 1); }},
      {"cleave_model_update", "", [&] { return cleave_model_update(none); }},
      {"cleave_body_event_count", "", [&] { return cleave_body_event_count(none, 0, &i64); }},
      {"cleave_body_event_get", "", [&] { return cleave_body_event_get(none, 0, 0, &event); }},
      {"cleave_body_clear_events", "", [&] { return cleave_body_clear_events(none, 0); }},
      {"cleave_energies_get", "", [&] { return cleave_energies_get(none, 0, &energies); }},
      {"cleave_counts_get", "", [&] { return cleave_counts_get(none, 0, &counts); }},
      {"cleave_model_memory", "", [&] { return cleave_model_memory(none, &i64); }},
      {"cleave_body_reaction", "", [&] { return cleave_body_reaction(none, 0, 1, &i64, vec); }},
      {"cleave_field_count", "", [&] { return cleave_field_count(none, 0, &i64); }},
      {"cleave_field_get", "", [&] { return cleave_field_get(none, 0, 0, &field); }},
      {"cleave_field_find", "", [&] { return cleave_field_find(none, 0, "mass", &field); }},
      {"cleave_field_get_real", "",
       [&] { return cleave_field_get_real(none, 0, "mass", 0, 1, &real); }},
      {"cleave_field_put_real", "",
       [&] { return cleave_field_put_real(none, 0, "mass", 0, 1, &real); }},
      {"cleave_field_get_integer", "",
       [&] { return cleave_field_get_integer(none, 0, "bond_status", 0, 1, &i64); }},
      {"cleave_field_put_integer", "",
       [&] { return cleave_field_put_integer(none, 0, "bond_status", 0, 1, &i64); }},
      {"cleave_model_restore", "", [&] { return cleave_model_restore(none, 0, 0); }},
      {"cleave_model_clock", "", [&] { return cleave_model_clock(none, &i64, &real); }}};
  for (Call& call : calls) call.part = "'model'";
  expect_refused(calls, CLEAVE_NULL_ARGUMENT);
  EXPECT_EQ(cleave_model_destroy(nullptr), CLEAVE_OK);
}

TEST_F(Arguments, NullIsRefusedForEveryOtherPointerOfTheModel) {
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  spec.particles = n;
  spec.simplex_count = m;
  spec.simplices = mesh.simplices.data();
  cleave_body_spec no_simplices = spec;
  no_simplices.X = mesh.X.data();
  no_simplices.simplices = nullptr;
  const int64_t particle = 0;
  const int32_t zero = 0, motion = CLEAVE_MOTION_EXACT;
  expect_refused(
      {{"cleave_model_create", "'model'",
        [] { return cleave_model_create(CLEAVE_ABI_VERSION, nullptr); }},
       {"cleave_body_spec_init", "'spec'", [] { return cleave_body_spec_init(nullptr); }},
       {"cleave_body_add", "'spec'", [&] { return cleave_body_add(fresh, nullptr, &count); }},
       {"cleave_body_add", "'body'", [&] { return cleave_body_add(fresh, &spec, nullptr); }},
       {"cleave_body_add", "'spec->X'", [&] { return cleave_body_add(fresh, &spec, &count); }},
       {"cleave_body_add", "'spec->simplices'",
        [&] { return cleave_body_add(fresh, &no_simplices, &count); }},
       {"cleave_body_set_real", "'group'",
        [&] { return cleave_body_set_real(fresh, 0, nullptr, "E", 1); }},
       {"cleave_body_set_real", "'name'",
        [&] { return cleave_body_set_real(fresh, 0, "material", nullptr, 1); }},
       {"cleave_body_set_choice", "'group'",
        [&] { return cleave_body_set_choice(fresh, 0, nullptr, "form", "none"); }},
       {"cleave_body_set_choice", "'name'",
        [&] { return cleave_body_set_choice(fresh, 0, "viscosity", nullptr, "none"); }},
       {"cleave_body_set_choice", "'choice'",
        [&] { return cleave_body_set_choice(fresh, 0, "viscosity", "form", nullptr); }},
       {"cleave_body_get_real", "'group'",
        [&] { return cleave_body_get_real(fresh, 0, nullptr, "E", &real); }},
       {"cleave_body_get_real", "'name'",
        [&] { return cleave_body_get_real(fresh, 0, "material", nullptr, &real); }},
       {"cleave_body_get_real", "'value'",
        [&] { return cleave_body_get_real(fresh, 0, "material", "E", nullptr); }},
       {"cleave_body_prescribe", "'particle'",
        [&] { return cleave_body_prescribe(fresh, 0, 1, nullptr, &zero, &motion); }},
       {"cleave_body_prescribe", "'direction'",
        [&] { return cleave_body_prescribe(fresh, 0, 1, &particle, nullptr, &motion); }},
       {"cleave_body_prescribe", "'motion'",
        [&] { return cleave_body_prescribe(fresh, 0, 1, &particle, &zero, nullptr); }},
       {"cleave_body_exempt", "'particle'",
        [&] { return cleave_body_exempt(fresh, 0, 1, nullptr); }},
       {"cleave_body_region", "'particle'",
        [&] { return cleave_body_region(fresh, 0, 1, nullptr, 1, 0, nullptr, 0, 0); }},
       {"cleave_body_volumes", "'volume'",
        [&] { return cleave_body_volumes(fresh, 0, 1, nullptr); }},
       {"cleave_body_precrack", "'pairs'",
        [&] { return cleave_body_precrack(ready, 0, 1, nullptr); }},
       {"cleave_model_is_stable", "'stable'",
        [&] { return cleave_model_is_stable(ready, 1, nullptr); }},
       {"cleave_model_stable_step", "'step'",
        [&] { return cleave_model_stable_step(ready, nullptr); }},
       {"cleave_body_wave_speed", "'speed'",
        [&] { return cleave_body_wave_speed(ready, 0, nullptr); }},
       {"cleave_body_event_count", "'count'",
        [&] { return cleave_body_event_count(ready, 0, nullptr); }},
       {"cleave_energies_get", "'energies'",
        [&] { return cleave_energies_get(ready, 0, nullptr); }},
       {"cleave_counts_get", "'counts'", [&] { return cleave_counts_get(ready, 0, nullptr); }},
       {"cleave_model_memory", "'bytes'", [&] { return cleave_model_memory(ready, nullptr); }},
       {"cleave_body_reaction", "'particle'",
        [&] { return cleave_body_reaction(ready, 0, 1, nullptr, vec); }},
       {"cleave_body_reaction", "'force'",
        [&] { return cleave_body_reaction(ready, 0, 1, &particle, nullptr); }},
       {"cleave_field_count", "'count'", [&] { return cleave_field_count(ready, 0, nullptr); }},
       {"cleave_field_get", "'field'", [&] { return cleave_field_get(ready, 0, 0, nullptr); }},
       {"cleave_field_find", "'name'",
        [&] { return cleave_field_find(ready, 0, nullptr, nullptr); }},
       {"cleave_field_find", "'field'",
        [&] { return cleave_field_find(ready, 0, "mass", nullptr); }},
       {"cleave_field_get_real", "'name'",
        [&] { return cleave_field_get_real(ready, 0, nullptr, 0, 1, &real); }},
       {"cleave_field_get_real", "'values'",
        [&] { return cleave_field_get_real(ready, 0, "mass", 0, 1, nullptr); }},
       {"cleave_field_get_real", "'values'",
        [&] { return cleave_field_get_real(ready, 0, "cauchy_stress", 0, 1, nullptr); }},
       {"cleave_field_put_real", "'name'",
        [&] { return cleave_field_put_real(ready, 0, nullptr, 0, 1, &real); }},
       {"cleave_field_put_real", "'values'",
        [&] { return cleave_field_put_real(ready, 0, "mass", 0, 1, nullptr); }},
       {"cleave_field_get_integer", "'name'",
        [&] { return cleave_field_get_integer(ready, 0, nullptr, 0, 1, &count); }},
       {"cleave_field_get_integer", "'values'",
        [&] { return cleave_field_get_integer(ready, 0, "bond_status", 0, 1, nullptr); }},
       {"cleave_field_put_integer", "'name'",
        [&] { return cleave_field_put_integer(ready, 0, nullptr, 0, 1, &count); }},
       {"cleave_field_put_integer", "'values'",
        [&] { return cleave_field_put_integer(ready, 0, "bond_status", 0, 1, nullptr); }},
       {"cleave_model_clock", "'step'", [&] { return cleave_model_clock(ready, nullptr, &real); }},
       {"cleave_model_clock", "'time'",
        [&] { return cleave_model_clock(ready, &count, nullptr); }}},
      CLEAVE_NULL_ARGUMENT);
}

}  // namespace
}  // namespace cleave::test
