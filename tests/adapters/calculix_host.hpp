// A stand-in for CalculiX: libCLEAVE.so loaded as CalculiX loads it, calls with its arguments, and what
// it makes of the answers of its two interfaces.
#pragma once

#include <dlfcn.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/bonds.hpp"
#include "support/meshes.hpp"
#include "support/model.hpp"

namespace cleave::test::calculix {

using Matrix = std::array<double, 9>;   // columns: 11 21 31 12 22 32 13 23 33
using Six = std::array<double, 6>;      // 11 22 33 12 13 23
using Moduli = std::array<double, 36>;  // (6,6), columns
inline constexpr int kFirst[6] = {0, 1, 2, 0, 0, 1}, kSecond[6] = {0, 1, 2, 1, 2, 2};
inline constexpr std::size_t kRoom = 21;  // constants

using Native = void (*)(const char*, const int*, const int*, const int*, const double*,
                        const double*, const double*, const double*, const double*, const double*,
                        const double*, const double*, const int*, const double*, const double*,
                        const double*, const double*, const int*, const int*, const int*,
                        const int*, const double*, double*, double*, double*, const int*,
                        const double*, const double*, double*, const int*, int);
using Umat = void (*)(double*, double*, double*, double*, double*, double*, double*, double*,
                      double*, double*, const double*, const double*, const double*, const double*,
                      const double*, const double*, const double*, const double*, const char*,
                      const int*, const int*, const int*, const int*, const double*, const int*,
                      const double*, const double*, double*, const double*, const double*,
                      const double*, const int*, const int*, const int*, const int*, const int*,
                      const int*, int);

inline void* function(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  static void* library = dlopen(CLEAVE_CALCULIX_LIBRARY, RTLD_NOW);
  if (library == nullptr) throw std::runtime_error(dlerror());
  void* found = dlsym(library, name.c_str());
  if (found == nullptr) throw std::runtime_error("no function " + name);
  return found;
}

// A law of the table, as its user writes it down.
struct Law {
  std::string name;
  std::int32_t material = 0;
  std::vector<double> properties;  // all
  std::vector<double> constants;   // as many as CalculiX has room for
  std::size_t history = 0;
};

inline Law law(std::int64_t index) {
  cleave_table_entry entry;
  entry.size = sizeof entry;
  ok(cleave_table_get(CLEAVE_TABLE_MATERIAL, index, &entry));
  Law made{entry.name, entry.value, {}, {}, 0};
  std::int64_t count = 0, history = 0;
  ok(cleave_parameter_count(entry.name, &count));
  ok(cleave_material_history_count(entry.value, &history));
  made.history = static_cast<std::size_t>(history);
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_parameter p;
    p.size = sizeof p;
    ok(cleave_parameter_get(entry.name, k, &p));
    const bool fits = k < static_cast<std::int64_t>(kRoom);
    made.properties.push_back(fits ? test_property(p.name, p.default_value) : p.default_value);
    if (fits) made.constants.push_back(made.properties.back());
  }
  return made;
}

inline std::vector<Law> laws() {
  std::int64_t count = 0;
  ok(cleave_table_count(CLEAVE_TABLE_MATERIAL, &count));
  std::vector<Law> all;
  for (std::int64_t k = 0; k < count; ++k) all.push_back(law(k));
  return all;
}

inline Matrix3 as_rows(const Matrix& a) {
  Matrix3 m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = a[i + 3 * j];
  return m;
}
inline Matrix as_columns(const Matrix3& m) {
  Matrix a{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) a[i + 3 * j] = m[i][j];
  return a;
}
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
inline Matrix3 symmetric(const Six& s) {
  return {{{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}}};
}
inline Six six(const Matrix3& m) { return {m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]}; }

inline Six green_strain(const Matrix& F) {
  const Matrix3 f = as_rows(F);
  Matrix3 c = product(transposed(f), f);
  for (std::size_t i = 0; i < 3; ++i) c[i][i] -= 1;
  for (auto& row : c)
    for (double& x : row) x *= 0.5;
  return six(c);
}

// The stretch U with U U = F^T F, by Newton's iteration.
inline Matrix3 stretch(const Matrix& F) {
  const Matrix3 f = as_rows(F), c = product(transposed(f), f);
  Matrix3 u{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int k = 0; k < 60; ++k) {
    const Matrix3 other = product(inverse(u), c);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) u[i][j] = 0.5 * (u[i][j] + other[i][j]);
  }
  return u;
}

// A native call. Whole-model state arrays (state, points, elements).
struct NativeCall {
  std::vector<double> constants;
  Matrix F0{1, 0, 0, 0, 1, 0, 0, 0, 1}, F1 = F0;
  Six strain{}, initial_stress{};
  double dtime = 1e-6;
  int element = 1, point = 1, icmd = 0, points = 1, state = 0;
  std::vector<double> old_state, new_state;
  Six stress{};
  std::array<double, 21> stiffness{};
  double pnewdt = -1;

  void run(const std::string& law) {
    const auto call = reinterpret_cast<Native>(function(law));
    std::string name = "@CLEAVE_" + law;
    name.resize(80, ' ');
    const int kode = -100 - static_cast<int>(constants.size()), no_axes = 0, no_heat = 0,
              elastic = 0;
    const int mi[3] = {points, 3, 1}, elements[1] = {0};
    const double zero[9] = {}, one = 1;
    call(name.c_str(), &element, &point, &kode, constants.data(), strain.data(), zero,
         initial_stress.data(), F0.data(), &one, F1.data(), &one, &no_heat, zero, &dtime, zero,
         zero, &icmd, &elastic, mi, &state, old_state.data(), new_state.data(), stress.data(),
         stiffness.data(), &no_axes, zero, zero, &pnewdt, elements, 80);
  }
};

// A call through the ABAQUSNL interface.
struct UmatCall {
  std::vector<double> constants;
  Matrix F0{1, 0, 0, 0, 1, 0, 0, 0, 1}, F1 = F0;
  Six strain_increment{1, 0, 0, 0, 0, 0};
  double dtime = 1e-6;
  std::vector<double> state;
  int components = 6, procedure = 1;
  Six stress{};
  Moduli tangent{};
  double pnewdt = -1;

  void run(const std::string& law) {
    const auto call = reinterpret_cast<Umat>(function("UMAT_" + law));
    std::string name = "@ABAQUSNL_CLEAVE_UMAT_" + law;
    name.resize(80, ' ');
    const int three = 3, one = 1, steps[4] = {1, procedure, 1, 0},
              states = static_cast<int>(state.size()), count = static_cast<int>(constants.size());
    double unused[9] = {};
    call(stress.data(), state.data(), tangent.data(), unused, unused, unused, unused, unused,
         unused, unused, unused, strain_increment.data(), unused, &dtime, unused, unused, unused,
         unused, name.c_str(), &three, &three, &components, &states, constants.data(), &count,
         unused, unused, &pnewdt, unused, F0.data(), F1.data(), &one, &one, &one, &one, steps, &one,
         80);
  }

  // What CalculiX makes of it: second Piola-Kirchhoff stress, and stiffness by U^-1 on all indices.
  Six second_piola() const {
    const Matrix3 inverse_u = inverse(stretch(F1));
    Six s = six(product(inverse_u, product(symmetric(stress), inverse_u)));
    for (double& x : s) x *= determinant(as_rows(F1));
    return s;
  }
  Moduli stiffness() const {
    static constexpr std::size_t place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    const Matrix3 m = inverse(stretch(F1));
    Moduli made{};
    for (std::size_t b = 0; b < 6; ++b)
      for (std::size_t a = 0; a < 6; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k)
              for (std::size_t l = 0; l < 3; ++l)
                made[a + 6 * b] += m[static_cast<std::size_t>(kFirst[a])][i] *
                                   m[static_cast<std::size_t>(kSecond[a])][j] *
                                   m[static_cast<std::size_t>(kFirst[b])][k] *
                                   m[static_cast<std::size_t>(kSecond[b])][l] *
                                   tangent[place[i][j] + 6 * place[k][l]];
    return made;
  }
};

// The same point directly: default layouts, nine components.
struct DirectCall {
  Matrix stress{};
  std::array<double, 81> tangent{};
  std::vector<double> history;
  std::int32_t status = 0;

  DirectCall(const Law& law, const Matrix& F, std::vector<double> before, double dt,
             std::int32_t stress_measure, std::int32_t tangent_measure)
      : history(std::move(before)) {
    cleave_material_call call;
    ok(cleave_material_call_init(&call));
    call.material = law.material;
    call.kinematics = CLEAVE_3D;
    call.property_count = static_cast<std::int64_t>(law.properties.size());
    call.properties = law.properties.data();
    call.last = 1;
    call.dt = dt;
    call.deformation = F.data();
    call.deformation_is_F = 1;
    call.history = history.empty() ? nullptr : history.data();
    call.stress = stress.data();
    call.stress_measure = stress_measure;
    call.tangent = tangent.data();
    call.tangent_measure = tangent_measure;
    status = cleave_material_tangent(&call);
    status = std::max(status, cleave_material_update(&call));
  }

  Six components() const {
    return {stress[0], stress[4], stress[8], stress[3], stress[6], stress[7]};
  }
  double modulus(std::size_t a, std::size_t b) const {
    const auto place = [](std::size_t c) {
      return static_cast<std::size_t>(kFirst[c] + 3 * kSecond[c]);
    };
    return tangent[place(a) + 9 * place(b)];
  }
};

// Non-symmetric, seeded: the unit matrix and up to `size` in every entry.
inline Matrix random_gradient(Random& random, double size) {
  Matrix F{1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (double& x : F) x += size * random();
  return F;
}

}  // namespace cleave::test::calculix
