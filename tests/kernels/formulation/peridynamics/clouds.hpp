// Clouds of points with volumes, and peridynamic bodies made of them through the C interface.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/model.hpp"

namespace cleave::test {

using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point& a) { return std::sqrt(dot(a, a)); }

struct Cloud {
  int dimension = 3;
  std::vector<Point> X;
  std::vector<double> volume;
  std::size_t size() const { return X.size(); }
};

// Points of a lattice at the middle of the cells of a block with one corner at the origin.
inline Cloud lattice_cloud(int nx, int ny, int nz, double spacing) {
  Cloud cloud{nz == 0 ? 2 : 3, {}, {}};
  for (int z = 0; z < std::max(nz, 1); ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        cloud.X.push_back(
            {(x + 0.5) * spacing, (y + 0.5) * spacing, nz == 0 ? 0 : (z + 0.5) * spacing});
  cloud.volume.assign(cloud.size(), std::pow(spacing, cloud.dimension));
  return cloud;
}

// About one point in each cell of a unit box of n^d cells, moved by up to 0.35 cells; volumes differ.
inline Cloud random_cloud(int dimension, int n, unsigned seed) {
  Random random(seed);
  Cloud cloud = lattice_cloud(n, n, dimension == 3 ? n : 0, 1.0 / n);
  for (auto& X : cloud.X)
    for (int k = 0; k < dimension; ++k) X[static_cast<std::size_t>(k)] += 0.35 / n * random();
  for (double& v : cloud.volume) v *= 1 + 0.3 * random();
  return cloud;
}

// (3,n) numbers up to `size`, third component zero in the plane.
inline std::vector<double> random_field(const Cloud& cloud, double size, unsigned seed) {
  Random random(seed);
  std::vector<double> u(3 * cloud.size(), 0.0);
  for (std::size_t c = 0; c < u.size(); ++c) {
    const double r = random();
    if (static_cast<int>(c % 3) < cloud.dimension) u[c] = size * r;
  }
  return u;
}

// A body of these points with a linear elastic material; set up, not yet initialised.
class CloudBody {
 public:
  CloudBody(int32_t formulation, int32_t kinematics, const Cloud& cloud,
            const std::vector<Setting>& settings, double E = 2.1e5, double nu = 0.3,
            double rho = 7.8e-9) {
    add(formulation, kinematics, cloud, settings, E, nu, rho);
    model.setup();
  }
  // before_setup(model): what else is said of the body; a refusal of the set-up is kept.
  template <class F>
  CloudBody(int32_t formulation, int32_t kinematics, const Cloud& cloud,
            const std::vector<Setting>& settings, const std::array<double, 3>& material,
            const F& before_setup) {
    add(formulation, kinematics, cloud, settings, material[0], material[1], material[2]);
    before_setup(model);
    if (cleave_model_setup(model) != CLEAVE_OK) refusal = last_message();
  }
  CloudBody(int32_t formulation, int32_t kinematics, const Cloud& cloud,
            const std::vector<Setting>& settings, double nu, std::string& said) {
    add(formulation, kinematics, cloud, settings, 2.1e5, nu, 7.8e-9);
    if (cleave_model_setup(model) != CLEAVE_OK) said = last_message();
  }

  // Cuts about one bond in `every`.
  void damage(int every, unsigned seed) {
    Random random(seed);
    const auto ends = model.integer("bond_ends");
    std::vector<int64_t> pairs;
    for (std::size_t b = 0; b < ends.size() / 2; ++b) {
      if (random() > 2.0 / every - 1) continue;
      pairs.push_back(ends[2 * b]);
      pairs.push_back(ends[2 * b + 1]);
    }
    ok(cleave_body_precrack(model, 0, static_cast<int64_t>(pairs.size()) / 2, pairs.data()));
  }
  std::vector<double> forces(const std::vector<double>& u) {
    model.put("displacement", u);
    model.initialise();
    return model.real("internal_force");
  }

  Model model;
  std::string refusal;

 private:
  void add(int32_t formulation, int32_t kinematics, const Cloud& cloud,
           const std::vector<Setting>& settings, double E, double nu, double rho) {
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    spec.formulation = formulation;
    spec.kinematics = kinematics;
    spec.material = CLEAVE_MATERIAL_linear_elastic;
    spec.particles = static_cast<int64_t>(cloud.size());
    spec.X = cloud.X.data()->data();
    spec.name = "cloud";
    int64_t body = 0;
    ok(cleave_body_add(model, &spec, &body));
    ok(cleave_body_volumes(model, body, spec.particles, cloud.volume.data()));
    model.set(body, {{"material", "E", E}, {"material", "nu", nu}, {"material", "rho", rho}});
    model.set(body, settings);
  }
};

inline double largest(const std::vector<double>& v) {
  double size = 0;
  for (const double x : v) size = std::fmax(size, std::fabs(x));
  return size;
}
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) size = std::fmax(size, std::fabs(a[k] - b[k]));
  return size / largest(b);
}

}  // namespace cleave::test
