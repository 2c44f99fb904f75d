// A point of a law with history through the array calls, in SI units, for the laws of impact.
#pragma once

#include <algorithm>

#include "j2_support.hpp"
#include "material/stress.hpp"

namespace cleave::test {

// OFHC copper; strength, failure and equation of state of the published sets.
inline constexpr double kRho = 8960, kC0 = 3940, kS = 1.49, kGamma = 1.96, kShear = 46e9;
inline constexpr double kYoungs = 124e9, kPoisson = 0.34;
inline constexpr double kA = 90e6, kB = 292e6, kN = 0.31, kRate = 0.025, kThermal = 1.09;
inline constexpr double kRoom = 293, kMelt = 1356, kHeat = 383;
inline constexpr double kD[] = {0.54, 4.89, -3.03, 0.014, 1.12};

struct Strength {
  double rate = kRate, melt = kMelt, heat = kHeat, chi = 0.9;
  bool fails = false;
  void append(std::vector<double>& p) const {
    p.insert(p.end(), {kA, kB, kN, rate, 1.0, kThermal, kRoom, melt, heat, chi});
    for (const double d : kD) p.push_back(fails ? d : 0.0);
  }
};
inline std::vector<double> copper(const Strength& strength = {}) {
  std::vector<double> p = {kRho, kYoungs, kPoisson};
  strength.append(p);
  return p;
}
struct Shock {
  double gamma = kGamma, p_min = -1e30, q1 = 1.5, q2 = 0.06;
  std::vector<double> fluid() const { return {kRho, kC0, kS, gamma, p_min, q1, q2}; }
};
inline std::vector<double> copper_eos(const Strength& strength = {}, const Shock& shock = {}) {
  std::vector<double> p = shock.fluid();
  p.push_back(kShear);
  strength.append(p);
  return p;
}

// Follows a path; the history by the names of the law.
class Sample {
 public:
  template <class Law>
  static Sample of(const std::vector<double>& properties, Kinematics kinematics = CLEAVE_3D) {
    Sample s;
    s.material_ = Law(properties, kinematics);
    for (const auto& field : Law::kHistory) {
      s.names_.push_back(field.name);
      s.begin_.push_back(s.value_.size());
      s.value_.resize(s.value_.size() + static_cast<std::size_t>(field.components), 0.0);
    }
    s.dimension_ = kinematics == CLEAVE_3D ? 3 : 2;
    return s;
  }
  double& operator[](const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    EXPECT_NE(found, names_.end()) << name;
    return value_[begin_[static_cast<std::size_t>(found - names_.begin())]];
  }
  std::vector<double>& history() { return value_; }
  const Material& material() const { return material_; }

  // False where the law has no answer.
  bool step(const Matrix3& h, double dt = 0, double length = 0) {
    std::int32_t failed = 0;
    double components[9], stress[9];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        components[component(i, j)] = h[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    StressArrays a = arrays();
    a.h = components;
    a.p = stress;
    a.energy = &energy;
    a.failed = &failed;
    a.dt = dt;
    a.length = length;
    const StressResult r = with_law(material_, [&](const auto& law) {
      return dimension_ == 3 ? update_stress<3>(law, a, 0, 1) : update_stress<2>(law, a, 0, 1);
    });
    plastic = r.plastic;
    viscous = r.viscous;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        P[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = stress[component(i, j)];
    return failed == 0;
  }
  StressArrays arrays() {
    StressArrays a;
    for (std::size_t k = 0; k < begin_.size(); ++k) {
      a.history.base[k] = value_.data() + begin_[k];
      a.history.stride[k] = static_cast<std::int64_t>(value_.size());
    }
    return a;
  }
  // Of the Cauchy stress.
  double mean_stress(const Matrix3& h) const {
    const Matrix3 s = cauchy(h);
    return (s[0][0] + s[1][1] + s[2][2]) / 3;
  }
  double equivalent_stress(const Matrix3& h) const {
    const Matrix3 s = cauchy(h);
    const double mean = (s[0][0] + s[1][1] + s[2][2]) / 3;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double d = s[i][j] - (i == j ? mean : 0);
        sum += d * d;
      }
    return std::sqrt(1.5 * sum);
  }
  Matrix3 cauchy(const Matrix3& h) const {
    Matrix3 f = h, t{};
    for (std::size_t k = 0; k < 3; ++k) f[k][k] += 1;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) t[i][j] += P[i][k] * f[j][k] / determinant(f);
    return t;
  }

  Matrix3 P{};
  double energy = 0, plastic = 0, viscous = 0;

 private:
  Material material_;
  std::vector<std::string> names_;
  std::vector<std::size_t> begin_;
  std::vector<double> value_;
  int dimension_ = 3;
};

inline Matrix3 shear(double gamma) { return {{{0, gamma, 0}, {0, 0, 0}, {0, 0, 0}}}; }
inline Matrix3 uniaxial(double strain) { return {{{strain, 0, 0}, {0, 0, 0}, {0, 0, 0}}}; }
inline Matrix3 isotropic(double strain) {
  return {{{strain, 0, 0}, {0, strain, 0}, {0, 0, strain}}};
}

}  // namespace cleave::test
