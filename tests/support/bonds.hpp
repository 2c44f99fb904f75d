// Bonds and forces of a mesh through the array calls, without a model. Needs no test framework, so
// that benchmarks use it too; an error of a call is thrown.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cleave/cleave.h"
#include "support/meshes.hpp"

namespace cleave::test {

struct Bonds {
  // alive (m): empty means all simplices live.
  explicit Bonds(const SimplexMesh& m, std::vector<std::int32_t> alive = {});

  std::int64_t half_bonds() const { return row_begin.back(); }
  std::vector<double> weights() const;  // (h) zeta_ip . X_ip
  // (9,n) H of a displacement (3,n)
  std::vector<double> gradient(const std::vector<double>& u) const;
  // (3,n) force of a stress (9,n)
  std::vector<double> force(const std::vector<double>& P) const;

  // View of the arrays below.
  cleave_network network() const;

  SimplexMesh mesh;
  std::vector<std::int32_t> alive;  // (m)
  std::vector<std::int64_t> row_begin, neighbour, reverse;
  std::vector<double> zeta, volume;  // (3,h), (n)
};

struct Stress {
  std::vector<double> P, energy;  // (9,n), (n)
};
// Properties in the order of the law; throws where the law has no answer.
Stress stress(std::int32_t material, std::int32_t kinematics, const std::vector<double>& properties,
              const std::vector<double>& H);

// Which facets, edges and particles are exposed: facets of exactly one live simplex.
class Boundary {
 public:
  Boundary(const SimplexMesh& mesh, const std::vector<std::int32_t>& alive);
  bool particle(std::int64_t i) const { return particle_[static_cast<std::size_t>(i)] != 0; }
  bool bond(std::int64_t i, std::int64_t p) const;

 private:
  std::vector<char> particle_;
  std::vector<std::array<std::int64_t, 2>> edges_;  // sorted
};

// Every simplex deleted with the given probability, seeded.
std::vector<std::int32_t> random_deletions(const SimplexMesh& mesh, double probability,
                                           unsigned seed);
// (3,n) numbers in (-size, size); third component zero in two dimensions.
std::vector<double> random_vectors(const SimplexMesh& mesh, double size, unsigned seed);

// Volume and shape-function gradients of a simplex by solving (X_b - X_0) . g_a = delta_ab with
// Gaussian elimination: independent of the kernels, which use cofactors.
struct ReferenceSimplex {
  double volume;
  std::array<std::array<double, 3>, 4> gradient;
};
ReferenceSimplex reference_simplex(const SimplexMesh& mesh, std::int64_t simplex);

// Inverse of a 3x3 matrix by elimination with pivoting; throws if singular.
using Matrix3 = std::array<std::array<double, 3>, 3>;
Matrix3 inverse(Matrix3 a);
double determinant(const Matrix3& a);

}  // namespace cleave::test
