// Small simplex meshes for tests, seeded: the same numbers on every machine.
#pragma once

#include <cstdint>
#include <vector>

namespace cleave::test {

struct SimplexMesh {
  int dimension = 2;
  std::vector<double> X;                // (3,n)
  std::vector<std::int64_t> simplices;  // (dimension+1,m)
  std::int64_t particles() const { return static_cast<std::int64_t>(X.size()) / 3; }
  std::int64_t simplex_count() const {
    return static_cast<std::int64_t>(simplices.size()) / (dimension + 1);
  }
};

// cells x cells squares of two triangles, or cells^3 cubes of six tetrahedra; spacing h; interior
// and boundary points moved by up to jitter * h. Random orientation of the simplices' corners.
SimplexMesh patch(int dimension, int cells, double h, double jitter, unsigned seed);

// Equilateral triangles of edge h in rows x columns points, odd rows shifted by h/2, the notches at
// the sides closed with obtuse triangles, so that the outline is a rectangle. Only inner points are
// moved, by up to jitter * h.
SimplexMesh triangular_lattice(int columns, int rows, double h, double jitter, unsigned seed);

// Uniform numbers in (-1, 1) that do not depend on the standard library.
class Random {
 public:
  explicit Random(unsigned seed) : state_(seed * 2654435761u + 1) {}
  double operator()();

 private:
  std::uint64_t state_;
};

}  // namespace cleave::test
