// Wrong arguments: ranges outside the array, wrong types, unknown names, numbers outside their range,
// structs without a size. The answer names the function and what was wrong; nothing is changed.
#include "abi/arguments.hpp"

#include <cmath>
#include <limits>

namespace cleave::test {
namespace {

TEST_F(Arguments, RangesOutsideTheArrayAreRefused) {
  const cleave_network negative = with(&cleave_network::particles, -1);
  expect_refused(
      {{"cleave_displacement_gradient", "range -1 <= i < 3",
        [&] { return cleave_displacement_gradient(&net, -1, 3, three.data(), nine.data()); }},
       {"cleave_displacement_gradient", "27 entries",
        [&] { return cleave_displacement_gradient(&net, 0, n + 1, three.data(), nine.data()); }},
       {"cleave_bond_force", "range 5 <= i < 4",
        [&] { return cleave_bond_force(&net, 5, 4, nine.data(), three.data()); }},
       {"cleave_bond_viscosity", "range",
        [&] {
          return cleave_bond_viscosity(&net, 5, 4, w.data(), three.data(), three.data(), one.data(),
                                       1, 1, three.data());
        }},
       {"cleave_material_stress", "range",
        [&] {
          return cleave_material_stress(1, CLEAVE_3D, 3, properties, 2, 1, nine.data(), nullptr,
                                        nine.data(), nullptr, nullptr);
        }},
       {"cleave_cbm_count_bonds", "range",
        [&] { return cleave_cbm_count_bonds(&negative, m, mesh.simplices.data()); }},
       {"cleave_field_get_real", "27 entries",
        [&] { return cleave_field_get_real(ready, 0, "mass", 0, n + 1, one.data()); }},
       {"cleave_field_get_real", "range -1",
        [&] { return cleave_field_get_real(ready, 0, "mass", -1, 1, one.data()); }},
       {"cleave_field_get_real", "range",
        [&] { return cleave_field_get_real(ready, 0, "damage", 3, n + 1, one.data()); }},
       {"cleave_field_put_real", "range",
        [&] { return cleave_field_put_real(ready, 0, "velocity", 4, 3, one.data()); }},
       {"cleave_field_get_integer", "range",
        [&] { return cleave_field_get_integer(ready, 0, "simplex_alive", 0, m + 1, &count); }},
       {"cleave_field_put_integer", "range",
        [&] {
          return cleave_field_put_integer(ready, 0, "simplex_alive",
                                          std::numeric_limits<int64_t>::max() - 1,
                                          std::numeric_limits<int64_t>::max(), &count);
        }},
       {"cleave_body_event_get", "0 entries",
        [&] {
          cleave_event event{};
          event.size = sizeof event;
          return cleave_body_event_get(ready, 0, 0, &event);
        }},
       {"cleave_body_reaction", "particle 27",
        [&] { return cleave_body_reaction(ready, 0, 1, &n, vec); }},
       {"cleave_body_exempt", "particle 27", [&] { return cleave_body_exempt(fresh, 0, 1, &n); }},
       {"cleave_body_prescribe", "particle 27",
        [&] {
          const int32_t zero = 0, motion = 1;
          return cleave_body_prescribe(fresh, 0, 1, &n, &zero, &motion);
        }}},
      CLEAVE_BAD_RANGE);
}

TEST_F(Arguments, EmptyRangesNeedNoArrays) {
  ok(cleave_field_get_real(ready, 0, "mass", 3, 3, nullptr));
  ok(cleave_field_put_real(ready, 0, "velocity", n, n, nullptr));
  ok(cleave_field_get_integer(ready, 0, "simplex_alive", 0, 0, nullptr));
  ok(cleave_body_precrack(ready, 0, 0, nullptr));
  ok(cleave_body_exempt(fresh, 0, 0, nullptr));
  EXPECT_EQ(cleave_body_volumes(fresh, 0, 0, nullptr),
            CLEAVE_BAD_ARGUMENT);  // each particle needs one
  ok(cleave_body_prescribe(fresh, 0, 0, nullptr, nullptr, nullptr));
  ok(cleave_body_reaction(ready, 0, 0, nullptr, vec));
}

TEST_F(Arguments, NumbersOutsideTheirRangeAreRefused) {
  const cleave_network line = with(&cleave_network::dimension, 1),
                       hyper = with(&cleave_network::dimension, 4),
                       base = with(&cleave_network::index_base, 2),
                       other_base = with(&cleave_network::index_base, 1);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const double bad_nu[3] = {1190, 3.24e9, 0.5}, bad_rho[3] = {0, 3.24e9, 0.3},
               not_finite[3] = {1190, nan, 0.3};
  expect_refused(
      {{"cleave_cbm_count_bonds", "dimension is 1",
        [&] { return cleave_cbm_count_bonds(&line, m, mesh.simplices.data()); }},
       {"cleave_displacement_gradient", "dimension is 4",
        [&] { return cleave_displacement_gradient(&hyper, 0, n, three.data(), nine.data()); }},
       {"cleave_bond_force", "index_base is 2",
        [&] { return cleave_bond_force(&base, 0, n, nine.data(), three.data()); }},
       {"cleave_bond_force", "row_begin begins with 0, index_base is 1",
        [&] { return cleave_bond_force(&other_base, 0, n, nine.data(), three.data()); }},
       {"cleave_bond_viscosity", "length is 0",
        [&] {
          return cleave_bond_viscosity(&net, 0, n, w.data(), three.data(), three.data(), one.data(),
                                       1, 0, three.data());
        }},
       {"cleave_material_stress", "kinematics is 9",
        [&] {
          return cleave_material_stress(1, 9, 3, properties, 0, 1, nine.data(), nullptr,
                                        nine.data(), nullptr, nullptr);
        }},
       {"cleave_material_stress", "takes 3 properties, not 2",
        [&] {
          return cleave_material_stress(1, 1, 2, properties, 0, 1, nine.data(), nullptr,
                                        nine.data(), nullptr, nullptr);
        }},
       {"cleave_material_wave_speed", "nu",
        [&] { return cleave_material_wave_speed(1, 1, 3, bad_nu, &real); }},
       {"cleave_material_wave_speed", "rho",
        [&] { return cleave_material_wave_speed(1, 1, 3, bad_rho, &real); }},
       {"cleave_material_wave_speed", "'E'",
        [&] { return cleave_material_wave_speed(1, 1, 3, not_finite, &real); }},
       {"cleave_ramp", "kind is 3",
        [&] { return cleave_ramp(3, 1, 1, 0, &real, nullptr, nullptr); }},
       {"cleave_ramp", "tau is -1",
        [&] { return cleave_ramp(1, 1, -1, 0, &real, nullptr, nullptr); }},
       {"cleave_ramp", "tau is nan",
        [&] { return cleave_ramp(1, 1, nan, 0, &real, nullptr, nullptr); }},
       {"cleave_model_set_threads", "threads is 0",
        [&] { return cleave_model_set_threads(fresh, 0); }},
       {"cleave_model_set_order", "order is 3", [&] { return cleave_model_set_order(fresh, 3); }},
       {"cleave_body_set_real", "allowed: > 0",
        [&] { return cleave_body_set_real(fresh, 0, "material", "E", 0); }},
       {"cleave_body_set_real", "> -1 and < 0.5",
        [&] { return cleave_body_set_real(fresh, 0, "material", "nu", 0.5); }},
       {"cleave_body_set_real", "inf",
        [&] { return cleave_body_set_real(fresh, 0, "material", "rho", inf); }},
       {"cleave_body_set_real", "body 1 does not exist",
        [&] { return cleave_body_set_real(fresh, 1, "material", "E", 1); }},
       {"cleave_body_prescribe", "direction 3",
        [&] {
          const int64_t zero = 0;
          const int32_t three_directions = 3, motion = 1;
          return cleave_body_prescribe(fresh, 0, 1, &zero, &three_directions, &motion);
        }},
       {"cleave_body_prescribe", "motion 7",
        [&] {
          const int64_t zero = 0;
          const int32_t x = 0, motion = 7;
          return cleave_body_prescribe(fresh, 0, 1, &zero, &x, &motion);
        }},
       {"cleave_body_prescribe", "count is -1",
        [&] { return cleave_body_prescribe(fresh, 0, -1, nullptr, nullptr, nullptr); }},
       {"cleave_body_motion", "1 degrees of freedom",
        [&] { return cleave_body_motion(ready, 0, 2, three.data(), nullptr); }},
       {"cleave_body_precrack", "0 and 26 are not bonded",
        [&] {
          const int64_t pair[2] = {0, 26};
          return cleave_body_precrack(ready, 0, 1, pair);
        }},
       {"cleave_body_precrack", "not bonded",
        [&] {
          const int64_t pair[2] = {-1, std::numeric_limits<int64_t>::max()};
          return cleave_body_precrack(ready, 0, 1, pair);
        }},
       {"cleave_field_put_real", "cannot be set",
        [&] { return cleave_field_put_real(ready, 0, "damage", 0, n, one.data()); }},
       {"cleave_model_restore", "step is -1", [&] { return cleave_model_restore(ready, -1, 0); }},
       {"cleave_energies_get", "body -2 does not exist",
        [&] {
          cleave_energies e{};
          e.size = sizeof e;
          return cleave_energies_get(ready, -2, &e);
        }}},
      CLEAVE_BAD_ARGUMENT);
}

TEST_F(Arguments, WrongDimensionLeavesTheOutputAlone) {
  std::vector<double> H(nine.size(), 7.0);
  const cleave_network wrong = with(&cleave_network::dimension, 5);
  EXPECT_EQ(cleave_displacement_gradient(&wrong, 0, n, three.data(), H.data()),
            CLEAVE_BAD_ARGUMENT);
  EXPECT_EQ(H, std::vector<double>(nine.size(), 7.0));
}

TEST_F(Arguments, UnknownNamesListTheKnownOnes) {
  cleave_field field{};
  field.size = sizeof field;
  expect_refused({{"cleave_body_set_real", "material, fracture, viscosity, stabilisation",
                   [&] { return cleave_body_set_real(fresh, 0, "fractures", "Gf", 1); }},
                  {"cleave_body_set_real", "rho, E, nu",
                   [&] { return cleave_body_set_real(fresh, 0, "material", "poisson", 1); }},
                  {"cleave_body_set_choice", "none|frozen|central|paper",
                   [&] { return cleave_body_set_choice(fresh, 0, "viscosity", "form", "Frozen"); }},
                  {"cleave_body_get_real", "critical_strain",
                   [&] { return cleave_body_get_real(fresh, 0, "fracture", "strain", &real); }},
                  {"cleave_field_find", "displacement_gradient",
                   [&] { return cleave_field_find(ready, 0, "F", &field); }},
                  {"cleave_field_get_real", "velocity",
                   [&] { return cleave_field_get_real(ready, 0, "speed", 0, 1, &real); }},
                  {"cleave_material_history_count", "svk = 1",
                   [&] { return cleave_material_history_count(42, &count); }},
                  {"cleave_material_wave_speed", "svk = 1",
                   [&] { return cleave_material_wave_speed(0, 1, 3, properties, &real); }}},
                 CLEAVE_UNKNOWN_NAME);
}

TEST_F(Arguments, WrongTypesAreRefused) {
  expect_refused({{"cleave_body_set_real", "none|frozen|central|paper",
                   [&] { return cleave_body_set_real(fresh, 0, "viscosity", "form", 1); }},
                  {"cleave_body_set_choice", "'beta'",
                   [&] { return cleave_body_set_choice(fresh, 0, "viscosity", "beta", "big"); }},
                  {"cleave_field_get_real", "integers",
                   [&] { return cleave_field_get_real(ready, 0, "bond_status", 0, 1, &real); }},
                  {"cleave_field_put_real", "integers",
                   [&] { return cleave_field_put_real(ready, 0, "bond_status", 0, 1, &real); }},
                  {"cleave_field_get_integer", "reals",
                   [&] { return cleave_field_get_integer(ready, 0, "mass", 0, 1, &count); }},
                  {"cleave_field_put_integer", "reals",
                   [&] { return cleave_field_put_integer(ready, 0, "mass", 0, 1, &count); }}},
                 CLEAVE_WRONG_TYPE);
}

TEST_F(Arguments, StructsWithoutOrWithTooLargeASizeAreRefused) {
  for (const int64_t size : {int64_t{0}, int64_t{4096}}) {
    cleave_energies energies{};
    cleave_counts counts{};
    cleave_field field{};
    cleave_parameter parameter{};
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    energies.size = counts.size = field.size = parameter.size = spec.size = size;
    spec.particles = n;
    spec.X = mesh.X.data();
    expect_refused(
        {{"cleave_energies_get", "'energies'",
          [&] { return cleave_energies_get(ready, 0, &energies); }},
         {"cleave_counts_get", "'counts'", [&] { return cleave_counts_get(ready, 0, &counts); }},
         {"cleave_field_get", "'field'", [&] { return cleave_field_get(ready, 0, 0, &field); }},
         {"cleave_field_find", "'field'",
          [&] { return cleave_field_find(ready, 0, "mass", &field); }},
         {"cleave_field_table_get", "'field'", [&] { return cleave_field_table_get(0, &field); }},
         {"cleave_parameter_get", "'parameter'",
          [&] { return cleave_parameter_get("svk", 0, &parameter); }},
         {"cleave_body_add", "cleave_body_spec_init",
          [&] { return cleave_body_add(fresh, &spec, &count); }}},
        CLEAVE_ABI_MISMATCH);
  }
}

}  // namespace
}  // namespace cleave::test
