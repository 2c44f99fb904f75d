// A patch held at x = 0 and pulled at the other end in x, for the tests of relaxation.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "support/model.hpp"

namespace cleave::test {

// Takes over setup and state fields, and the clock, as a restart does.
inline void copy_state(const Model& from, Model& to) {
  std::int64_t count = 0;
  ok(cleave_field_count(from, 0, &count));
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_get(from, 0, k, &f));
    if (f.lifetime != CLEAVE_LIFETIME_SETUP && f.lifetime != CLEAVE_LIFETIME_STATE) continue;
    if (f.type == CLEAVE_REAL) {
      ok(cleave_field_put_real(to, 0, f.name, 0, f.count, from.real(f.name).data()));
    } else {
      ok(cleave_field_put_integer(to, 0, f.name, 0, f.count, from.integer(f.name).data()));
    }
  }
  std::int64_t step = 0;
  double time = 0;
  ok(cleave_model_clock(from, &step, &time));
  ok(cleave_model_restore(to, step, time));
}

class LoadedPatch {
 public:
  static constexpr double kSpacing = 0.01;

  // begin: initialised, or waiting for a state to be put.
  LoadedPatch(const Case& c, int cells, const std::vector<Setting>& settings = {},
              bool begin = true)
      : LoadedPatch(c, patch(dimension_of(c), cells, kSpacing, 0.1, 3), settings, begin) {}
  LoadedPatch(const Case& c, const SimplexMesh& mesh, const std::vector<Setting>& settings = {},
              bool begin = true)
      : mesh_(mesh) {
    for (std::size_t k = 0; k < mesh.X.size(); k += 3) width_ = std::fmax(width_, mesh.X[k]);
    model.add(c, mesh, settings);
    for (std::int64_t i = 0; i < mesh.particles(); ++i) {
      const double x = mesh.X[static_cast<std::size_t>(3 * i)];
      if (x > 0.3 * kSpacing && x < width_ - 0.3 * kSpacing) continue;
      if (x > 0.3 * kSpacing) head_.push_back(i);
      for (int k = 0; k < dimension_of(c); ++k) {
        particles_.push_back(i);
        directions_.push_back(k);
        pulled_.push_back(k == 0 && x > 0.3 * kSpacing ? 1.0 : 0.0);
      }
    }
    const std::vector<std::int32_t> motion(particles_.size(), CLEAVE_MOTION_EXACT);
    ok(cleave_body_prescribe(model, 0, std::ssize(particles_), particles_.data(),
                             directions_.data(), motion.data()));
    model.setup();
    if (begin) {
      cut(settings);
      model.initialise();
    }
    ok(cleave_relaxation_options_init(&options));
  }

  // The next increment: the mean strain at its end.
  void pull(double strain) {
    std::vector<double> u = pulled_;
    for (double& value : u) value *= strain * width_;
    ok(cleave_body_motion(model, 0, std::ssize(u), u.data(), nullptr));
  }
  cleave_relaxation_report relax() {
    cleave_relaxation_report report{};
    report.size = sizeof report;
    ok(cleave_model_relax(model, 1.0, &options, &report));
    return report;
  }
  std::int32_t status() { return cleave_model_relax(model, 1.0, &options, nullptr); }
  cleave_relaxation_report relaxed(double strain) {
    pull(strain);
    return relax();
  }
  double force() {
    double f[3] = {};
    ok(cleave_body_reaction(model, 0, std::ssize(head_), head_.data(), f));
    return f[0];
  }
  // Every field by name, integers as reals.
  std::map<std::string, std::vector<double>> state() {
    std::map<std::string, std::vector<double>> out;
    std::int64_t count = 0;
    ok(cleave_field_count(model, 0, &count));
    for (std::int64_t k = 0; k < count; ++k) {
      cleave_field f{};
      f.size = sizeof f;
      ok(cleave_field_get(model, 0, k, &f));
      if (f.type == CLEAVE_REAL) {
        out[f.name] = model.real(f.name);
      } else {
        const auto values = model.integer(f.name);
        out[f.name].assign(values.begin(), values.end());
      }
    }
    return out;
  }
  double width() const { return width_; }

  Model model;
  cleave_relaxation_options options{};

 private:
  // With fracture: a notch of 0.4 widths across the pull, in the middle.
  void cut(const std::vector<Setting>& settings) {
    if (settings.empty() || settings.front().group != "fracture") return;
    const auto ends = model.integer("bond_ends");
    std::vector<std::int64_t> pairs;
    const double middle = 0.5 * width_ + 0.5 * kSpacing;
    const auto X = [&](std::int64_t i, int k) {
      return mesh_.X[static_cast<std::size_t>(3 * i + k)];
    };
    for (std::size_t b = 0; b < ends.size(); b += 2) {
      const std::int64_t i = ends[b], p = ends[b + 1];
      if ((X(i, 0) - middle) * (X(p, 0) - middle) < 0 && X(i, 1) + X(p, 1) < 0.8 * width_)
        pairs.insert(pairs.end(), {i, p});
    }
    ok(cleave_body_precrack(model, 0, std::ssize(pairs) / 2, pairs.data()));
  }

  SimplexMesh mesh_;
  double width_ = 0;
  std::vector<std::int64_t> particles_, head_;
  std::vector<std::int32_t> directions_;
  std::vector<double> pulled_;
};

}  // namespace cleave::test
