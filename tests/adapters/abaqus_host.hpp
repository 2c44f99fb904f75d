// A stand-in for Abaqus: blocks of points for VUMAT and single points for UMAT as the program hands them
// over, and its utility routines for errors, which here end nothing but keep the text.
#pragma once

#include "adapters/fortran_host.hpp"

extern "C" {
using cleave::test::Int;
using cleave::test::Real;
void vumat_(const Int* nblock, const Int* ndir, const Int* nshr, const Int* nstatev,
            const Int* nfieldv, const Int* nprops, const Int* lanneal, const Real* step_time,
            const Real* total_time, const Real* dt, const char* cmname, const Real* coordinates,
            const Real* length, const Real* props, const Real* density, const Real* strain_inc,
            const Real* spin, const Real* temp_old, const Real* stretch_old, const Real* f_old,
            const Real* field_old, const Real* stress_old, const Real* state_old,
            const Real* intern_old, const Real* inelas_old, const Real* temp_new,
            const Real* stretch_new, const Real* f_new, const Real* field_new, Real* stress_new,
            Real* state_new, Real* intern_new, Real* inelas_new, std::size_t name_length);
}

namespace cleave::test::abaqus {

// What the error routines got, of this thread.
struct Errors {
  std::vector<std::string> texts;
  int exits = 0;
};
inline thread_local Errors errors;

inline std::string padded(const std::string& name) {
  std::string text = name;
  text.resize(80, ' ');
  return text;
}

// Places of ij in 11 22 33 12 23 31.
constexpr std::size_t kFirst[6] = {0, 1, 2, 0, 1, 2}, kSecond[6] = {0, 1, 2, 1, 2, 0};

// The arrays of a block with a number behind each that nobody may touch.
class Block {
 public:
  static constexpr Real kUntouched = -77;

  Block(const Law& law, std::size_t points, std::size_t shears, std::size_t states)
      : n(points), nshr(shears), nstatev(states), material("CLEAVE-" + law.capitals + "-PART 7") {
    props = law.host_properties();
    for (auto* a : {&length, &density}) a->assign(n, 1);
    for (auto* a : {&strain_inc, &stretch_old, &stretch_new, &stress_old, &stress_new})
      a->assign(n * components() + 1, kUntouched);
    for (auto* a : {&state_old, &state_new}) a->assign(n * nstatev + 1, 0);
    state_new.back() = kUntouched;
    for (auto* a : {&intern_old, &intern_new, &inelas_old, &inelas_new}) a->assign(n + 1, 0);
    intern_new.back() = inelas_new.back() = kUntouched;
    for (std::size_t k = 0; k < n; ++k) {
      put(stretch_old, k, kUnit);
      put(stress_old, k, {});
      put(strain_inc, k, {});
    }
  }
  std::size_t components() const { return 3 + nshr; }
  Real& at(std::vector<Real>& a, std::size_t point, std::size_t c) { return a[point + n * c]; }
  void put(std::vector<Real>& a, std::size_t point, const Matrix3& m) {
    for (std::size_t c = 0; c < components(); ++c)
      at(a, point, c) = static_cast<Real>(m[kFirst[c]][kSecond[c]]);
  }
  void call() {
    const Int nblock = static_cast<Int>(n), ndir = directions, shears = static_cast<Int>(nshr),
              states = static_cast<Int>(nstatev), none = 0, count = static_cast<Int>(props.size());
    const Real* nothing = nullptr;  // the adapter has no use for these
    const std::string name = padded(material);
    vumat_(&nblock, &ndir, &shears, &states, &none, &count, &anneal, &step_time, &total_time, &dt,
           name.c_str(), nothing, length.data(), props.data(), density.data(), strain_inc.data(),
           nothing, nothing, stretch_old.data(), nothing, nothing, stress_old.data(),
           state_old.data(), intern_old.data(), inelas_old.data(), nothing, stretch_new.data(),
           nothing, nothing, stress_new.data(), state_new.data(), intern_new.data(),
           inelas_new.data(), name.size());
  }
  // The end of a step is the start of the next.
  void advance() {
    stretch_old = stretch_new;
    stress_old = stress_new;
    state_old = state_new;
    intern_old = intern_new;
    inelas_old = inelas_new;
  }
  bool nothing_written_behind() const {
    return stress_new.back() == kUntouched && state_new.back() == kUntouched &&
           intern_new.back() == kUntouched && inelas_new.back() == kUntouched;
  }

  std::size_t n, nshr, nstatev;
  std::string material;
  Int directions = 3, anneal = 0;
  Real step_time = 1, total_time = 1, dt = static_cast<Real>(1e-6);
  std::vector<Real> props, length, density, strain_inc, stretch_old, stretch_new, stress_old,
      stress_new, state_old, state_new, intern_old, intern_new, inelas_old, inelas_new;
};

}  // namespace cleave::test::abaqus
