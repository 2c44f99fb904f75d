// The CalculiX adapter without CalculiX: every law of the table by its name in capitals, through both
// interfaces, against the direct call bit for bit; tangents against differences; wrong decks.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <latch>
#include <thread>

#include "adapters/calculix_host.hpp"

namespace cleave::test::calculix {
namespace {

constexpr double kStep = 1e-6;       // [s]
constexpr double kUntouched = -7.5;  // no result

class Calculix : public testing::TestWithParam<int> {
 protected:
  Law law_ = law(GetParam());
};

std::string name_of(const testing::TestParamInfo<int>& info) { return law(info.param).name; }
int law_count() { return static_cast<int>(laws().size()); }
INSTANTIATE_TEST_SUITE_P(Laws, Calculix, testing::Range(0, law_count()), name_of);

NativeCall native(const Law& law, const Matrix& F) {
  NativeCall call;
  call.constants = law.constants;
  call.state = static_cast<int>(law.history);
  call.old_state.assign(law.history, 0);
  call.new_state.assign(law.history, kUntouched);
  call.F1 = F;
  call.strain = green_strain(F);
  return call;
}

UmatCall umat(const Law& law, const Matrix& F, std::vector<double> state) {
  UmatCall call;
  call.constants = law.constants;
  call.F1 = F;
  call.state = std::move(state);
  return call;
}

// The history after one step that has left the elastic range.
std::vector<double> loaded(const Law& law, Random& random) {
  return DirectCall(law, random_gradient(random, 0.1), std::vector<double>(law.history, 0), kStep,
                    CLEAVE_STRESS_SECOND_PIOLA, CLEAVE_TANGENT_SECOND_PIOLA)
      .history;
}

// dS/dE by central differences of the direct call: F -> F + F^-T dE changes E by dE and a term that is
// even in dE.
Moduli differences(const Law& law, const Matrix& F, const std::vector<double>& history) {
  const double h = 1e-6;
  const Matrix3 f = as_rows(F), push = transposed(inverse(f));
  Moduli made{};
  for (std::size_t b = 0; b < 6; ++b) {
    Six side[2];
    for (int k = 0; k < 2; ++k) {
      Six strain{};
      strain[b] = (k == 0 ? h : -h) * (b < 3 ? 1 : 0.5);  // engineering shear
      Matrix3 moved = product(push, symmetric(strain));
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) moved[i][j] += f[i][j];
      side[k] = DirectCall(law, as_columns(moved), history, kStep, CLEAVE_STRESS_SECOND_PIOLA,
                           CLEAVE_TANGENT_SECOND_PIOLA)
                    .components();
    }
    for (std::size_t a = 0; a < 6; ++a) made[a + 6 * b] = (side[0][a] - side[1][a]) / (2 * h);
  }
  for (std::size_t b = 0; b < 6; ++b)  // CalculiX keeps one half
    for (std::size_t a = 0; a < b; ++a)
      made[a + 6 * b] = made[b + 6 * a] = 0.5 * (made[a + 6 * b] + made[b + 6 * a]);
  return made;
}

double largest(const Moduli& m) {
  double found = 0;
  for (const double x : m) found = std::max(found, std::fabs(x));
  return found;
}

TEST_P(Calculix, NativeGivesTheBitsOfTheDirectCallAtAnyPlaceOfTheModel) {
  Random random(11);
  const int points = 8, elements = 5, extra = 2;  // state variables of another law
  NativeCall call = native(law_, {});
  call.points = points;
  call.state = static_cast<int>(law_.history) + extra;
  const std::size_t width = static_cast<std::size_t>(call.state), columns = points * elements;
  call.old_state.assign(width * columns, 0);
  for (std::size_t q = 0; q < columns; ++q) {
    const std::vector<double> history = loaded(law_, random);
    std::copy(history.begin(), history.end(),
              call.old_state.begin() + static_cast<long>(q * width));
    call.old_state[q * width + law_.history] = random();
    call.old_state[q * width + law_.history + 1] = random();
  }
  for (const std::size_t q : {std::size_t{0}, std::size_t{7}, std::size_t{8}, columns - 1}) {
    call.new_state.assign(width * columns, kUntouched);
    call.point = static_cast<int>(q % points) + 1;
    call.element = static_cast<int>(q / points) + 1;
    call.F1 = random_gradient(random, 0.1);
    call.F0 = random_gradient(random, 0.1);
    call.strain = green_strain(call.F1);
    call.run(law_.name);
    const auto column = call.old_state.begin() + static_cast<long>(q * width);
    const DirectCall direct(law_, call.F1,
                            std::vector<double>(column, column + static_cast<long>(law_.history)),
                            kStep, CLEAVE_STRESS_SECOND_PIOLA, CLEAVE_TANGENT_SECOND_PIOLA);
    ASSERT_EQ(direct.status, CLEAVE_OK);
    EXPECT_EQ(call.stress, direct.components());
    EXPECT_EQ(call.pnewdt, -1);
    const double size = *std::max_element(direct.tangent.begin(), direct.tangent.end());
    for (std::size_t b = 0, k = 0; b < 6; ++b)  // 12 and 21 differ in the last bit
      for (std::size_t a = 0; a <= b; ++a, ++k)
        EXPECT_NEAR(call.stiffness[k], 0.5 * (direct.modulus(a, b) + direct.modulus(b, a)),
                    1e-15 * size);
    for (std::size_t other = 0; other < columns; ++other)
      for (std::size_t k = 0; k < width; ++k) {
        const double value = call.new_state[other * width + k];
        if (other != q) {
          EXPECT_EQ(value, kUntouched);
        } else if (k < law_.history) {
          EXPECT_EQ(value, direct.history[k]);
        } else {
          EXPECT_EQ(value, call.old_state[q * width + k]);
        }
      }
  }
}

TEST_P(Calculix, AbaqusnlGivesTheBitsOfTheDirectCall) {
  Random random(12);
  for (int trial = 0; trial < 4; ++trial) {
    const std::vector<double> before = loaded(law_, random);
    UmatCall call = umat(law_, random_gradient(random, 0.1), before);
    call.F0 = random_gradient(random, 0.1);
    call.run(law_.name);
    const DirectCall direct(law_, call.F1, before, kStep, CLEAVE_STRESS_COROTATED,
                            CLEAVE_TANGENT_COROTATED);
    EXPECT_EQ(call.stress, direct.components());
    EXPECT_EQ(call.state, direct.history);
    EXPECT_EQ(call.pnewdt, -1);
  }
}

TEST_P(Calculix, BothInterfacesGiveCalculixTheSameStressAndTheTangentOfDifferences) {
  Random random(13);
  const double nonlinear = law_.name == "linear_elastic" ? 0 : 0.1;  // not objective: F = U only
  for (int trial = 0; trial < 3; ++trial) {
    const std::vector<double> before =
        nonlinear == 0 ? std::vector<double>{} : loaded(law_, random);
    Matrix F = random_gradient(random, 0.1);
    if (nonlinear == 0) F = as_columns(stretch(F));
    NativeCall direct = native(law_, F);
    direct.old_state = before;
    direct.run(law_.name);
    UmatCall through = umat(law_, F, before);
    through.run(law_.name);
    const Six stress = through.second_piola();
    double scale = 0;
    for (const double s : direct.stress) scale = std::max(scale, std::fabs(s));
    for (std::size_t a = 0; a < 6; ++a)
      EXPECT_NEAR(stress[a], direct.stress[a], 1e-13 * scale);  // measured 2e-15
    if (nonlinear == 0) continue;
    const Moduli wanted = differences(law_, F, before), made = through.stiffness();
    const double size = largest(wanted);
    for (std::size_t b = 0, k = 0; b < 6; ++b)
      for (std::size_t a = 0; a <= b; ++a, ++k) {
        const double limit = 2e-7 * size;
        EXPECT_NEAR(direct.stiffness[k], wanted[a + 6 * b], limit) << a << b;
        EXPECT_NEAR(0.5 * (made[a + 6 * b] + made[b + 6 * a]), wanted[a + 6 * b], limit) << a << b;
      }
  }
}

TEST_P(Calculix, TheStiffnessAtRestGivesTheWaveSpeedOfTheLaw) {
  NativeCall call = native(law_, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  call.dtime = 1.235711130e-20;  // CalculiX's mark of the initial acceleration
  call.run(law_.name);
  double speed = 0;
  ok(cleave_material_wave_speed(law_.material, CLEAVE_3D,
                                static_cast<std::int64_t>(law_.properties.size()),
                                law_.properties.data(), &speed));
  const double modulus = law_.properties[0] * speed * speed;
  // Measured: 1e-15; 8e-6 with an equation of state, whose tangent is one of differences.
  const double limit =
      law_.name == "mie_gruneisen" || law_.name == "johnson_cook_eos" ? 2e-5 : 1e-14;
  for (const std::size_t k : {0u, 2u, 5u}) EXPECT_NEAR(call.stiffness[k], modulus, limit * modulus);
  EXPECT_EQ(call.stress, Six{});
}

TEST_P(Calculix, StressOnlyLeavesTheStiffnessAlone) {
  Random random(14);
  NativeCall with = native(law_, random_gradient(random, 0.1)), without = with;
  with.run(law_.name);
  without.icmd = 3;
  without.stiffness.fill(kUntouched);
  without.run(law_.name);
  EXPECT_EQ(without.stress, with.stress);
  EXPECT_EQ(without.new_state, with.new_state);
  for (const double k : without.stiffness) EXPECT_EQ(k, kUntouched);
}

TEST_P(Calculix, TheInitialAccelerationHasNoRates) {
  Random random(15);
  NativeCall marked = native(law_, random_gradient(random, 0.1));
  marked.dtime = 1.235711130e-20;
  marked.run(law_.name);
  const DirectCall still(law_, marked.F1, std::vector<double>(law_.history, 0), 0,
                         CLEAVE_STRESS_SECOND_PIOLA, CLEAVE_TANGENT_SECOND_PIOLA);
  EXPECT_EQ(marked.stress, still.components());
}

TEST_P(Calculix, PrescribedDisplacementsAreSpreadFromTheStartOfTheIncrement) {
  Random random(16);
  NativeCall plain = native(law_, random_gradient(random, 0.1)), spread = plain;
  plain.run(law_.name);
  spread.F0 = plain.F1;                      // the strain belongs to the start ...
  spread.F1 = random_gradient(random, 0.9);  // ... and the end is not a solution
  spread.run(law_.name);
  EXPECT_EQ(spread.stress, plain.stress);
  EXPECT_EQ(spread.stiffness, plain.stiffness);

  UmatCall there = umat(law_, plain.F1, plain.old_state), same = there;
  there.run(law_.name);
  same.strain_increment = {1e-16, 0, 0, 0, 0, -1e-16};
  std::swap(same.F0, same.F1);
  same.run(law_.name);
  EXPECT_EQ(same.stress, there.stress);
  EXPECT_EQ(same.tangent, there.tangent);
}

TEST_P(Calculix, APointWithoutAnAnswerAsksForASmallerIncrement) {
  if (law_.name == "linear_elastic") return;  // answers always
  const Matrix inverted{-0.5, 0, 0, 0, 1, 0, 0, 0, 1};
  Random random(17);
  NativeCall call = native(law_, inverted);
  call.old_state = loaded(law_, random);
  call.run(law_.name);
  EXPECT_EQ(call.pnewdt, 0.25);
  EXPECT_EQ(call.new_state, call.old_state);
  UmatCall through = umat(law_, inverted, call.old_state);
  through.run(law_.name);
  EXPECT_EQ(through.pnewdt, 0.25);
  EXPECT_EQ(through.state, call.old_state);
}

TEST_P(Calculix, ThreadsOfTheHostGetTheBitsOfOne) {
  Random random(18);
  const int threads = 4, repeats = 40;  // long enough to meet
  std::vector<NativeCall> alone;
  for (int q = 0; q < 100; ++q) alone.push_back(native(law_, random_gradient(random, 0.1)));
  for (NativeCall& call : alone) call.run(law_.name);
  std::latch start(threads);
  std::atomic<int> different = 0;
  const auto worked = [&] {
    start.arrive_and_wait();
    for (int k = 0; k < repeats; ++k)
      for (const NativeCall& wanted : alone) {
        NativeCall call = wanted;
        call.stress.fill(kUntouched);
        call.stiffness.fill(kUntouched);
        call.run(law_.name);
        if (call.stress != wanted.stress || call.new_state != wanted.new_state ||
            call.stiffness != wanted.stiffness)
          ++different;
      }
  };
  std::vector<std::thread> team;
  for (int t = 0; t < threads; ++t) team.emplace_back(worked);
  for (std::thread& member : team) member.join();
  EXPECT_EQ(different, 0);
}

// The adapter ends the program as CalculiX's own materials do: a line on standard output, exit code 201.
template <class Call>
void ends(Call call, const std::string& law, const std::string& message) {
  EXPECT_EXIT(
      {
        dup2(STDERR_FILENO, STDOUT_FILENO);
        call.run(law);
      },
      testing::ExitedWithCode(201), "\\*ERROR in the Cleave material " + law + ": .*" + message);
}

using CalculixDeathTest = Calculix;
INSTANTIATE_TEST_SUITE_P(Laws, CalculixDeathTest, testing::Range(0, law_count()), name_of);

TEST_P(CalculixDeathTest, WrongCountsEndTheProgramInOrder) {
  const Matrix rest{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::string wanted = "takes " + std::to_string(law_.constants.size());
  for (const int change : {-1, 1}) {
    NativeCall call = native(law_, rest);
    call.constants.resize(
        static_cast<std::size_t>(static_cast<int>(call.constants.size()) + change));
    ends(call, law_.name,
         "CONSTANTS=" + std::to_string(call.constants.size()) + " was given; it " + wanted);
    UmatCall through = umat(law_, rest, call.old_state);
    through.constants = call.constants;
    ends(through, law_.name, wanted);
  }
  if (law_.history == 0) return;
  NativeCall call = native(law_, rest);
  call.state -= 1;
  ends(call, law_.name, "\\*DEPVAR with at least " + std::to_string(law_.history));
}

TEST_P(CalculixDeathTest, WhatTheLawDoesNotKnowEndsTheProgramInOrder) {
  Random random(19);
  NativeCall call = native(law_, random_gradient(random, 0.1));
  NativeCall stressed = call;
  stressed.initial_stress[4] = 1;
  ends(stressed, law_.name, "element 1 has an initial stress");
  NativeCall linear = call;  // no NLGEOM: the strain of small displacements
  const Matrix& F = call.F1;
  linear.strain = {F[0] - 1,           F[4] - 1, F[8] - 1, 0.5 * (F[1] + F[3]), 0.5 * (F[2] + F[6]),
                   0.5 * (F[5] + F[7])};
  ends(linear, law_.name, "write \\*STEP, NLGEOM");
  if (law_.name != "linear_elastic") {
    NativeCall inverted = native(law_, {-0.5, 0, 0, 0, 1, 0, 0, 0, 1});
    inverted.icmd = 3;
    inverted.element = 1;
    ends(inverted, law_.name, "element 1, point 1: .*outside the range of the law");
    UmatCall dynamic = umat(law_, inverted.F1, inverted.old_state);
    dynamic.procedure = 4;
    ends(dynamic, law_.name, "element 1, point 1: .*outside the range of the law");
  }
  UmatCall plane = umat(law_, call.F1, call.old_state);
  plane.components = 4;
  ends(plane, law_.name, "4 stress components");
  NativeCall bad = call;
  bad.constants[0] = -1;
  ends(bad, law_.name, "rho");
}

TEST(CalculixLaws, EveryRequiredPropertyHasRoom) {
  for (const Law& one : laws())
    for (std::size_t k = kRoom; k < one.properties.size(); ++k) {
      cleave_parameter p;
      p.size = sizeof p;
      ok(cleave_parameter_get(one.name.c_str(), static_cast<std::int64_t>(k), &p));
      EXPECT_EQ(p.required, 0) << one.name << " " << p.name;
    }
}

}  // namespace
}  // namespace cleave::test::calculix
