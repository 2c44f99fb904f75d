// The order of calls, several models, what a model refuses at its making, and set-up after repair.
#include <cmath>
#include <functional>
#include <thread>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr Case kPlate{CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRESS};

SimplexMesh plate() { return patch(2, 4, 0.01, 0.15, 81); }

TEST(Life, AnotherInterfaceVersionIsRefused) {
  cleave_model* model = nullptr;
  for (const int32_t abi : {0, CLEAVE_ABI_VERSION + 1}) {
    EXPECT_EQ(cleave_model_create(abi, &model), CLEAVE_ABI_MISMATCH);
    EXPECT_EQ(model, nullptr);
    EXPECT_NE(last_message().find("interface " + std::to_string(abi)), std::string::npos);
  }
}

TEST(Life, CallsOutOfOrderAreRefusedAndNameTheRemedy) {
  Model model;
  model.add(kPlate, plate());
  const int64_t zero = 0;
  const int32_t x = 0, exact = CLEAVE_MOTION_EXACT;
  double real = 0;
  std::vector<double> values(3 * 25, 0.0);
  std::vector<int64_t> integers(64, 1);
  cleave_body_spec spec;
  cleave_field field{};
  cleave_energies energies{};
  cleave_counts counts{};
  field.size = sizeof field;
  energies.size = sizeof energies;
  counts.size = sizeof counts;
  int64_t body = 0;
  struct Call {
    const char* function;
    std::function<int32_t()> run;
  };
  const std::vector<Call> building = {
      {"cleave_body_add", [&] { return cleave_body_add(model, &spec, &body); }},
      {"cleave_body_set_real",
       [&] { return cleave_body_set_real(model, 0, "material", "E", 1e9); }},
      {"cleave_body_set_choice",
       [&] { return cleave_body_set_choice(model, 0, "viscosity", "form", "none"); }},
      {"cleave_body_prescribe",
       [&] { return cleave_body_prescribe(model, 0, 1, &zero, &x, &exact); }},
      {"cleave_body_exempt", [&] { return cleave_body_exempt(model, 0, 1, &zero); }},
      {"cleave_body_region",
       [&] { return cleave_body_region(model, 0, 1, &zero, 1, 1, &real, 0, 0); }},
      {"cleave_body_volumes", [&] { return cleave_body_volumes(model, 0, 1, &real); }},
      {"cleave_model_setup", [&] { return cleave_model_setup(model); }}};
  const std::vector<Call> set_up = {
      {"cleave_model_stable_step", [&] { return cleave_model_stable_step(model, &real); }},
      {"cleave_body_wave_speed", [&] { return cleave_body_wave_speed(model, 0, &real); }},
      {"cleave_body_motion", [&] { return cleave_body_motion(model, 0, 0, nullptr, nullptr); }},
      {"cleave_energies_get", [&] { return cleave_energies_get(model, 0, &energies); }},
      {"cleave_counts_get", [&] { return cleave_counts_get(model, 0, &counts); }},
      {"cleave_body_reaction",
       [&] { return cleave_body_reaction(model, 0, 1, &zero, values.data()); }},
      {"cleave_field_count", [&] { return cleave_field_count(model, 0, &body); }},
      {"cleave_field_get", [&] { return cleave_field_get(model, 0, 0, &field); }},
      {"cleave_field_find", [&] { return cleave_field_find(model, 0, "mass", &field); }},
      {"cleave_field_get_real",
       [&] { return cleave_field_get_real(model, 0, "mass", 0, 1, &real); }},
      {"cleave_field_put_real",
       [&] { return cleave_field_put_real(model, 0, "velocity", 0, 25, values.data()); }},
      {"cleave_field_get_integer",
       [&] { return cleave_field_get_integer(model, 0, "simplex_alive", 0, 1, &body); }},
      {"cleave_field_put_integer", [&] {
         return cleave_field_put_integer(model, 0, "simplex_alive", 0, 32, integers.data());
       }}};
  const std::vector<Call> before_first = {
      {"cleave_body_precrack", [&] { return cleave_body_precrack(model, 0, 0, nullptr); }},
      {"cleave_model_restore", [&] { return cleave_model_restore(model, 0, 0); }},
      {"cleave_model_initialise", [&] { return cleave_model_initialise(model, 0); }}};
  const std::vector<Call> advance = {
      {"cleave_model_advance", [&] { return cleave_model_advance(model, 1e-9, 1e-9); }}};
  const std::vector<Call> update = {
      {"cleave_model_update", [&] { return cleave_model_update(model); }}};
  const auto refuse = [&](const std::vector<Call>& calls, const char* when) {
    for (const Call& call : calls) {
      EXPECT_EQ(call.run(), CLEAVE_WRONG_ORDER) << call.function << ' ' << when;
      EXPECT_EQ(last_message().rfind(call.function, 0), 0u) << last_message();
      EXPECT_NE(
          last_message().find(call.function == std::string("cleave_model_setup") ? "make a new one"
                                                                                 : "cleave_model_"),
          std::string::npos)
          << last_message();
    }
  };
  for (const auto* calls : {&set_up, &before_first, &advance, &update})
    refuse(*calls, "before set-up");
  model.setup();
  for (const auto* calls : {&building, &advance, &update}) refuse(*calls, "after set-up");
  for (const Call& call : set_up) {
    EXPECT_EQ(call.run(), CLEAVE_OK) << call.function << last_message();
  }
  model.initialise();
  for (const auto* calls : {&building, &before_first, &update}) refuse(*calls, "after initialise");
  ok(cleave_model_advance(model, 1e-9, 1e-9));
  for (const auto* calls : {&building, &before_first, &advance}) refuse(*calls, "between");
  ok(cleave_model_update(model));
  for (const auto* calls : {&building, &before_first, &update}) refuse(*calls, "after a step");
  for (const Call& call : set_up) {
    EXPECT_EQ(call.run(), CLEAVE_OK) << call.function << last_message();
  }
}

TEST(Life, ModelWithoutBodyIsRefused) {
  Model model;
  EXPECT_EQ(cleave_model_setup(model), CLEAVE_WRONG_ORDER);
  EXPECT_NE(last_message().find("cleave_body_add"), std::string::npos);
}

TEST(Life, StepMustBePositiveAndFinite) {
  Model model;
  model.add(kPlate, plate());
  model.setup();
  model.initialise();
  for (const double dt : {0.0, -1e-9, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(cleave_model_advance(model, dt, 1.0), CLEAVE_BAD_ARGUMENT) << dt;
  }
  ok(cleave_model_advance(model, 1e-9, 1e-9));
}

TEST(Life, MissingParametersAreNamedWithUnitsAndSetUpWorksAfterRepair) {
  const SimplexMesh mesh = plate();
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  spec.kinematics = CLEAVE_PLANE_STRESS;
  spec.particles = mesh.particles();
  spec.X = mesh.X.data();
  spec.simplex_count = mesh.simplex_count();
  spec.simplices = mesh.simplices.data();
  spec.name = "target";
  Model model, reference;
  int64_t body = -1;
  // Two bodies, so that the first is complete when the second is refused.
  model.add(kPlate, mesh);
  ok(cleave_body_add(model, &spec, &body));
  EXPECT_EQ(body, 1);
  ok(cleave_body_set_real(model, 1, "material", "E", 3.24e9));
  EXPECT_EQ(cleave_model_setup(model), CLEAVE_MISSING_PARAMETER);
  for (const char* part : {"svk", "body 1 'target'", "rho [kg m-3]", "nu [1]"})
    EXPECT_NE(last_message().find(part), std::string::npos) << last_message();
  EXPECT_EQ(last_message().find("E [Pa]"), std::string::npos) << last_message();
  ok(cleave_body_set_real(model, 1, "material", "rho", 1190));
  ok(cleave_body_set_real(model, 1, "material", "nu", 0.35));
  ok(cleave_body_set_choice(model, 1, "viscosity", "form", "frozen"));
  EXPECT_EQ(cleave_model_setup(model), CLEAVE_MISSING_PARAMETER);
  EXPECT_NE(last_message().find("length > 0"), std::string::npos) << last_message();
  ok(cleave_body_set_real(model, 1, "viscosity", "length", 0.01));
  model.setup();
  reference.add(kPlate, mesh);
  reference.setup();
  const auto v = random_vectors(mesh, 1.0, 3);
  const double dt = 0.3 * model.stable_step();
  for (Model* m : {&model, &reference}) {
    m->put("velocity", v);
    m->initialise();
    for (int k = 0; k < 10; ++k) m->step(dt);
  }
  EXPECT_EQ(model.real("displacement"), reference.real("displacement"));
  EXPECT_EQ(model.real("mass"), reference.real("mass"));
  int64_t twice = 0, once = 0;
  ok(cleave_field_count(model, 0, &twice));
  ok(cleave_field_count(reference, 0, &once));
  EXPECT_EQ(twice, once);
}

TEST(Life, BodiesThatMakeNoSenseAreRefused) {
  const SimplexMesh mesh = plate();
  const auto add = [&](const std::function<void(cleave_body_spec&)>& spoil) {
    Model model;
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    spec.kinematics = CLEAVE_PLANE_STRESS;
    spec.particles = mesh.particles();
    spec.X = mesh.X.data();
    spec.simplex_count = mesh.simplex_count();
    spec.simplices = mesh.simplices.data();
    spec.name = "target";
    spoil(spec);
    int64_t body = -7;
    const int32_t status = cleave_body_add(model, &spec, &body);
    EXPECT_EQ(body, status == CLEAVE_OK ? 0 : -7);
    return status;
  };
  EXPECT_EQ(add([](auto& s) { s.formulation = 77; }), CLEAVE_UNKNOWN_NAME);
  EXPECT_NE(last_message().find("cbm = 1"), std::string::npos) << last_message();
  EXPECT_EQ(add([](auto& s) { s.material = 77; }), CLEAVE_UNKNOWN_NAME);
  EXPECT_NE(last_message().find("svk = 1"), std::string::npos) << last_message();
  for (const int32_t kinematics : {0, 4})
    EXPECT_EQ(add([=](auto& s) { s.kinematics = kinematics; }), CLEAVE_BAD_ARGUMENT);
  for (const int64_t n : {int64_t{0}, int64_t{-3}, int64_t{1} << 31})
    EXPECT_EQ(add([=](auto& s) { s.particles = n; }), CLEAVE_BAD_ARGUMENT) << n;
  for (const int64_t n : {int64_t{-3}, int64_t{1} << 31})
    EXPECT_EQ(add([=](auto& s) { s.simplex_count = n; }), CLEAVE_BAD_ARGUMENT) << n;
  EXPECT_EQ(add([](auto& s) { s.name = nullptr; }), CLEAVE_OK);
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    auto X = mesh.X;
    X[3 * 7 + 1] = bad;
    EXPECT_EQ(add([&](auto& s) { s.X = X.data(); }), CLEAVE_NOT_FINITE);
    EXPECT_NE(last_message().find("body 0 'target': the position of particle 7"), std::string::npos)
        << last_message();
  }
  auto X = mesh.X;  // the third component does not exist in two dimensions
  X[3 * 7 + 2] = std::nan("");
  EXPECT_EQ(add([&](auto& s) { s.X = X.data(); }), CLEAVE_OK);
}

TEST(Life, MeshesThatMakeNoSenseAreRefusedAtSetUp) {
  const auto set_up = [](const SimplexMesh& mesh, int32_t kinematics) {
    Model model;
    model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, kinematics}, mesh);
    return cleave_model_setup(model);
  };
  SimplexMesh flat = plate();
  for (std::size_t k = 0; k < 3; ++k)  // particle 1 onto the line from 0 to 2
    flat.X[3 + k] = 0.5 * (flat.X[k] + flat.X[6 + k]);
  flat.simplices = {0, 1, 2};
  EXPECT_EQ(set_up(flat, CLEAVE_PLANE_STRESS), CLEAVE_BAD_SIMPLEX);
  EXPECT_NE(last_message().find("simplex 0 of particles 0 1 2"), std::string::npos)
      << last_message();
  EXPECT_NE(last_message().find("degenerate"), std::string::npos) << last_message();
  SimplexMesh repeated = plate();
  repeated.simplices[4] = repeated.simplices[3];
  EXPECT_EQ(set_up(repeated, CLEAVE_PLANE_STRESS), CLEAVE_BAD_SIMPLEX);
  for (const int64_t corner : {int64_t{-1}, int64_t{25}, int64_t{1} << 40}) {
    SimplexMesh outside = plate();
    outside.simplices[4] = corner;
    EXPECT_EQ(set_up(outside, CLEAVE_PLANE_STRESS), CLEAVE_BAD_SIMPLEX);
    EXPECT_NE(last_message().find("simplex 1 refers to particle " + std::to_string(corner)),
              std::string::npos)
        << last_message();
  }
  SimplexMesh lonely = plate();
  lonely.X.insert(lonely.X.end(), {1, 1, 0});
  EXPECT_EQ(set_up(lonely, CLEAVE_PLANE_STRESS), CLEAVE_BAD_SIMPLEX);
  for (const char* part : {"particle 25", "belongs to no simplex"})
    EXPECT_NE(last_message().find(part), std::string::npos) << last_message();
  SimplexMesh none = plate();
  none.simplices.clear();
  EXPECT_EQ(set_up(none, CLEAVE_PLANE_STRESS), CLEAVE_BAD_SIMPLEX);
  SimplexMesh solid = patch(3, 1, 1.0, 0.0, 1);
  for (std::size_t i = 0; i < 8; ++i) solid.X[3 * i + 2] = 0;  // a cube pressed flat
  EXPECT_EQ(set_up(solid, CLEAVE_3D), CLEAVE_BAD_SIMPLEX);
}

TEST(Life, PrescriptionsAreCheckedAndReplaced) {
  Model model;
  model.add(kPlate, plate());
  const std::vector<int64_t> particle = {3, 4, 3};
  const std::vector<int32_t> motion(3, CLEAVE_MOTION_EXACT);
  std::vector<int32_t> direction = {0, 0, 0};
  EXPECT_EQ(cleave_body_prescribe(model, 0, 3, particle.data(), direction.data(), motion.data()),
            CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("particle 3 is prescribed twice in direction 0"), std::string::npos)
      << last_message();
  direction = {0, 2, 1};
  EXPECT_EQ(cleave_body_prescribe(model, 0, 3, particle.data(), direction.data(), motion.data()),
            CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("direction 2; allowed: 0 to 1"), std::string::npos)
      << last_message();
  direction = {0, 0, 1};
  ok(cleave_body_prescribe(model, 0, 3, particle.data(), direction.data(), motion.data()));
  ok(cleave_body_prescribe(model, 0, 2, particle.data(), direction.data(), motion.data()));
  model.setup();
  const double u[2] = {0, 0};
  ok(cleave_body_motion(model, 0, 2, u, nullptr));
}

// Two models of different kind, stepped in turns and from two threads, do what each does alone.
TEST(Life, TwoModelsDoNotKnowOfEachOther) {
  const SimplexMesh flat = plate(), solid = patch(3, 3, 0.01, 0.15, 82);
  const auto build = [](Model& model, const Case& c, const SimplexMesh& mesh) {
    model.add(c, mesh, {{"fracture", "critical_strain", 0.02}});
    model.setup();
    auto v = random_vectors(mesh, 8.0, 5);
    for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] += 3000 * mesh.X[3 * i];
    model.put("velocity", v);
    model.initialise();
  };
  const auto run = [](Model& model, double dt, int steps) {
    for (int n = 0; n < steps; ++n) model.step(dt);
  };
  const Case cube{};
  Model alone2, alone3, a, b, c, d;
  for (Model* m : {&alone2, &a, &c}) build(*m, kPlate, flat);
  for (Model* m : {&alone3, &b, &d}) build(*m, cube, solid);
  const double dt2 = 0.3 * alone2.stable_step(), dt3 = 0.3 * alone3.stable_step();
  run(alone2, dt2, 100);
  run(alone3, dt3, 100);
  for (int n = 0; n < 100; ++n) {
    run(a, dt2, 1);
    run(b, dt3, 1);
  }
  std::thread other([&] { run(c, dt2, 100); });
  run(d, dt3, 100);
  other.join();
  ASSERT_GT(alone2.counts().broken, 0);
  ASSERT_GT(alone3.counts().broken, 0);
  EXPECT_EQ(a.real("displacement"), alone2.real("displacement"));
  EXPECT_EQ(c.real("displacement"), alone2.real("displacement"));
  EXPECT_EQ(b.real("displacement"), alone3.real("displacement"));
  EXPECT_EQ(d.real("displacement"), alone3.real("displacement"));
}

TEST(Life, SumOverBodiesIsTheSum) {
  Model model;
  model.add(kPlate, plate());
  model.add(kPlate, patch(2, 3, 0.01, 0.1, 83));
  model.setup();
  cleave_counts first{}, second{};
  first.size = second.size = sizeof first;
  ok(cleave_counts_get(model, 0, &first));
  ok(cleave_counts_get(model, 1, &second));
  const cleave_counts sum = model.counts();
  EXPECT_EQ(sum.particles, 25 + 16);
  EXPECT_EQ(sum.bonds, first.bonds + second.bonds);
  EXPECT_EQ(sum.simplices, 32 + 18);
  int64_t bytes = 0;
  ok(cleave_model_memory(model, &bytes));
  EXPECT_GT(bytes, 41 * 8 * 30);
}

TEST(Life, ReactionIsTheForceThatHoldsTheBody) {
  // Weight hung on a held edge: at rest at the start, so reaction and load cancel in the sum of
  // forces needed to keep the held row still.
  const SimplexMesh mesh = plate();
  Model model;
  model.add(kPlate, mesh);
  std::vector<int64_t> particle;
  std::vector<int32_t> direction, motion;
  for (int64_t i = 0; i < 5; ++i)
    for (int32_t k = 0; k < 2; ++k) {
      particle.push_back(i);
      direction.push_back(k);
      motion.push_back(CLEAVE_MOTION_EXACT);
    }
  ok(cleave_body_prescribe(model, 0, 10, particle.data(), direction.data(), motion.data()));
  model.setup();
  const std::vector<double> rest(10, 0.0);
  ok(cleave_body_motion(model, 0, 10, rest.data(), rest.data()));
  std::vector<double> load(mesh.X.size(), 0.0);
  for (std::size_t i = 0; i < 5; ++i) load[3 * i + 1] = 10.0 + static_cast<double>(i);
  model.put("external_force", load);
  model.initialise();
  const std::vector<int64_t> row = {0, 1, 2, 3, 4};
  double force[3] = {1, 1, 1};
  ok(cleave_body_reaction(model, 0, 5, row.data(), force));
  EXPECT_EQ(force[0], 0);
  EXPECT_DOUBLE_EQ(force[1], -60);
  EXPECT_EQ(force[2], 0);
  ok(cleave_body_get_real(model, 0, "material", "E", force));
  EXPECT_EQ(force[0], 3.24e9);
}

// A host that counts from one reads its own numbers in messages.
TEST(Life, MessagesCountAsTheHostDoes) {
  for (const std::int32_t base : {0, 1}) {
    Model model;
    ok(cleave_model_set_index_base(model, base));
    const SimplexMesh mesh = patch(3, 2, 1.0, 0.1, 6);
    model.add({}, mesh);
    const auto says = [](const std::string& part) {
      EXPECT_NE(last_message().find(part), std::string::npos) << part << ": " << last_message();
    };
    const std::string first = std::to_string(base), none = std::to_string(base + 27);
    const std::int64_t wrong = 27;
    EXPECT_EQ(cleave_body_exempt(model, 0, 1, &wrong), CLEAVE_BAD_RANGE);
    says("body " + first + " ");
    says("particle " + none + " of the zone without fracture does not exist; particles are " +
         first + " to " + std::to_string(base + 26));
    EXPECT_EQ(cleave_body_exempt(model, 3, 1, &wrong), CLEAVE_BAD_ARGUMENT);
    says("body " + std::to_string(base + 3) + " does not exist");
    says("counted from " + first);
    EXPECT_EQ(cleave_model_set_index_base(model, 1), CLEAVE_WRONG_ORDER);
    model.setup();
    const std::int64_t pair[2] = {0, 26};
    EXPECT_EQ(cleave_body_precrack(model, 0, 1, pair), CLEAVE_BAD_ARGUMENT);
    says("particles " + first + " and " + std::to_string(base + 26) + " are not bonded");
  }
  Model model;
  EXPECT_EQ(cleave_model_set_index_base(model, 2), CLEAVE_BAD_ARGUMENT);
}

}  // namespace
}  // namespace cleave::test
