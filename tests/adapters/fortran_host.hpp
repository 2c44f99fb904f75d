// What the stand-ins for hosts with Fortran adapters share: laws with random properties, random
// deformations, and the direct call of the library that every adapter is compared with, bit for bit. The
// precision and the default integer of the host come from the build.
#pragma once

#include <fenv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <latch>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/bonds.hpp"
#include "support/meshes.hpp"
#include "support/model.hpp"

namespace cleave::test {

using Real = CLEAVE_HOST_REAL;
using Int = CLEAVE_HOST_INTEGER;

// Hosts run with floating-point traps.
inline const int kTraps = feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);

// A law of the table with the properties that its user gives, as the host hands them on.
struct Law {
  std::string name, capitals;
  std::int32_t material = 0;
  std::vector<double> properties;  // rounded to the host's precision
  std::size_t history = 0;
  std::ptrdiff_t damage = -1;  // place in the history

  std::vector<Real> host_properties() const {
    std::vector<Real> values;
    for (const double x : properties) values.push_back(static_cast<Real>(x));
    return values;
  }
  double& property(const std::string& wanted) {
    for (std::size_t k = 0; k < properties.size(); ++k) {
      cleave_parameter p;
      p.size = sizeof p;
      ok(cleave_parameter_get(name.c_str(), static_cast<std::int64_t>(k), &p));
      if (p.name == wanted) return properties[k];
    }
    throw std::runtime_error(name + " has no property " + wanted);
  }
};

inline std::vector<Law> laws(unsigned seed) {
  Random random(seed);
  std::int64_t count = 0;
  ok(cleave_table_count(CLEAVE_TABLE_MATERIAL, &count));
  std::vector<Law> all;
  for (std::int64_t index = 0; index < count; ++index) {
    cleave_table_entry entry;
    entry.size = sizeof entry;
    ok(cleave_table_get(CLEAVE_TABLE_MATERIAL, index, &entry));
    Law law;
    law.name = law.capitals = entry.name;
    for (char& c : law.capitals) c = static_cast<char>(std::toupper(c));
    law.material = entry.value;
    std::int64_t properties = 0, history = 0, damage = 0;
    ok(cleave_parameter_count(entry.name, &properties));
    ok(cleave_material_history_count(entry.value, &history));
    ok(cleave_material_damage_place(entry.value, &damage));
    law.history = static_cast<std::size_t>(history);
    law.damage = damage;
    for (std::int64_t k = 0; k < properties; ++k) {
      cleave_parameter p;
      p.size = sizeof p;
      ok(cleave_parameter_get(entry.name, k, &p));
      const double x = test_property(p.name, p.default_value) * (1 + 0.08 * random());
      law.properties.push_back(static_cast<double>(static_cast<Real>(x)));
    }
    all.push_back(law);
  }
  return all;
}

inline Law law_called(const std::string& name) {
  for (const Law& law : laws(1))
    if (law.name == name) return law;
  throw std::runtime_error("no law " + name);
}

constexpr Matrix3 kUnit{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

inline Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
inline Matrix3 transposed(const Matrix3& a) {
  Matrix3 t{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = a[j][i];
  return t;
}

// Every entry as the host's precision has it.
inline Matrix3 rounded(Matrix3 m) {
  for (auto& row : m)
    for (double& x : row) x = static_cast<double>(static_cast<Real>(x));
  return m;
}
inline Matrix3 random_gradient(Random& random, double size) {
  Matrix3 F = kUnit;
  for (auto& row : F)
    for (double& x : row) x += size * random();
  return rounded(F);
}
// plane: 13 and 23 are zero.
inline Matrix3 random_stretch(Random& random, double size, bool plane) {
  const Matrix3 F = random_gradient(random, size);
  Matrix3 U{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      U[i][j] = plane && i != j && i + j > 1 ? 0 : 0.5 * (F[i][j] + F[j][i]);
  return rounded(U);
}
inline Matrix3 rotation(Random& random) {
  const double a = 3 * random(), b = 3 * random(), c = 3 * random();
  const Matrix3 x{{{1, 0, 0}, {0, std::cos(a), -std::sin(a)}, {0, std::sin(a), std::cos(a)}}};
  const Matrix3 y{{{std::cos(b), 0, std::sin(b)}, {0, 1, 0}, {-std::sin(b), 0, std::cos(b)}}};
  const Matrix3 z{{{std::cos(c), -std::sin(c), 0}, {std::sin(c), std::cos(c), 0}, {0, 0, 1}}};
  return product(x, product(y, z));
}

// Points one by one through the library, in its default layout; histories rounded after every step.
class Direct {
 public:
  Direct(Law law, std::size_t points)
      : history(points, std::vector<double>(law.history, 0.0)), law_(std::move(law)) {}

  struct Answer {
    Matrix3 stress{};  // Cauchy
    double energy = 0, plastic = 0, viscous = 0;
    bool failed = false;
  };
  Answer step(std::size_t point, const Matrix3& F, double dt, double length) {
    Answer answer;
    cleave_material_call call = described(point, F, dt, length);
    double stress[9] = {};
    std::int32_t failed = 0;
    call.stress = stress;
    call.energy = &answer.energy;
    call.plastic = &answer.plastic;
    call.viscous = &answer.viscous;
    call.failed = &failed;
    const std::int32_t status = cleave_material_update(&call);
    if (status != CLEAVE_BAD_JACOBIAN) ok(status);
    answer.failed = failed != 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) answer.stress[i][j] = stress[i + 3 * j];
    for (double& x : history[point]) x = static_cast<double>(static_cast<Real>(x));
    return answer;
  }
  // C_ijkl at [i + 3 j + 9 (k + 3 l)].
  std::array<double, 81> tangent(std::size_t point, const Matrix3& F, double dt, double length) {
    std::array<double, 81> moduli{};
    cleave_material_call call = described(point, F, dt, length);
    call.tangent = moduli.data();
    call.tangent_measure = CLEAVE_TANGENT_JAUMANN;
    ok(cleave_material_tangent(&call));
    return moduli;
  }

  std::vector<std::vector<double>> history;

 private:
  cleave_material_call described(std::size_t point, const Matrix3& F, double dt, double length) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) deformation_[i + 3 * j] = F[i][j];
    cleave_material_call call;
    ok(cleave_material_call_init(&call));
    call.material = law_.material;
    call.kinematics = CLEAVE_3D;
    call.property_count = static_cast<std::int64_t>(law_.properties.size());
    call.properties = law_.properties.data();
    call.last = 1;
    call.dt = dt;
    call.length = length;
    call.deformation = deformation_;
    call.deformation_is_F = 1;
    call.history = law_.history == 0 ? nullptr : history[point].data();
    call.stress_measure = CLEAVE_STRESS_CAUCHY;
    return call;
  }

  Law law_;
  double deformation_[9] = {};
};

// run(seed) for every seed below `count`, each by a thread of its own, all at once.
template <class Run>
auto at_once(unsigned count, const Run& run) {
  std::vector<decltype(run(0u))> results(count);
  std::latch all_there(count);
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < count; ++seed)
    threads.emplace_back([&, seed] {
      all_there.arrive_and_wait();
      results[seed] = run(seed);
    });
  for (auto& t : threads) t.join();
  return results;
}

// Lame's moduli of a law at rest, by its properties.
struct Lame {
  double lambda, mu;
};
inline Lame lame(Law law) {
  if (law.name == "mie_gruneisen" || law.name == "johnson_cook_eos") {
    const double bulk = law.property("rho") * law.property("c0") * law.property("c0");
    const double mu = law.name == "mie_gruneisen" ? 0 : law.property("G");
    return {bulk - 2 * mu / 3, mu};
  }
  const double E = law.property("E"), nu = law.property("nu");
  return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
}

}  // namespace cleave::test
