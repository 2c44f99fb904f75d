#include "support/meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cleave::test {

double Random::operator()() {
  state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
  return static_cast<double>(static_cast<std::int64_t>(state_ >> 11) - (std::int64_t{1} << 52)) *
         0x1p-52;
}

SimplexMesh patch(int dimension, int cells, double h, double jitter, unsigned seed) {
  Random random(seed);
  SimplexMesh mesh;
  mesh.dimension = dimension;
  const int n = cells + 1, layers = dimension == 3 ? n : 1;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const std::array<int, 3> at{x, y, z};
        for (int k = 0; k < 3; ++k) {
          mesh.X.push_back(k < dimension ? h * (at[static_cast<std::size_t>(k)] + jitter * random())
                                         : 0.0);
        }
      }
  const auto node = [n](int x, int y, int z) {
    return (static_cast<std::int64_t>(z) * n + y) * n + x;
  };
  const auto add = [&](std::vector<std::int64_t> corners) {
    if (random() > 0) std::swap(corners[0], corners[1]);
    mesh.simplices.insert(mesh.simplices.end(), corners.begin(), corners.end());
  };
  if (dimension == 2) {
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        add({node(x, y, 0), node(x + 1, y, 0), node(x + 1, y + 1, 0)});
        add({node(x, y, 0), node(x + 1, y + 1, 0), node(x, y + 1, 0)});
      }
    return mesh;
  }
  // Kuhn split: one tetrahedron for every order in which the three coordinates are raised.
  std::array<int, 3> order{0, 1, 2};
  std::vector<std::array<int, 3>> orders;
  do {
    orders.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        for (const auto& o : orders) {
          std::array<int, 3> at{x, y, z};
          std::vector<std::int64_t> corners{node(at[0], at[1], at[2])};
          for (const int axis : o) {
            ++at[static_cast<std::size_t>(axis)];
            corners.push_back(node(at[0], at[1], at[2]));
          }
          add(corners);
        }
  return mesh;
}

SimplexMesh triangular_lattice(int columns, int rows, double h, double jitter, unsigned seed) {
  Random random(seed);
  SimplexMesh mesh;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const bool inner = c > 0 && c < columns - 1 && r > 0 && r < rows - 1;
      const double shift = inner ? jitter : 0.0;
      mesh.X.push_back(h * (c + 0.5 * (r % 2) + shift * random()));
      mesh.X.push_back(h * (0.5 * std::sqrt(3.0) * r + shift * random()));
      mesh.X.push_back(0);
    }
  const auto node = [columns](int c, int r) { return static_cast<std::int64_t>(r) * columns + c; };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      const std::int64_t a = node(c, r), b = node(c + 1, r), d = node(c, r + 1),
                         e = node(c + 1, r + 1);
      if (r % 2 == 0) {
        mesh.simplices.insert(mesh.simplices.end(), {a, b, d, b, e, d});
      } else {
        mesh.simplices.insert(mesh.simplices.end(), {a, b, e, a, e, d});
      }
    }
  for (int r = 1; r + 1 < rows; ++r) {
    const int c = r % 2 == 0 ? columns - 1 : 0;
    mesh.simplices.insert(mesh.simplices.end(), {node(c, r - 1), node(c, r), node(c, r + 1)});
  }
  return mesh;
}

}  // namespace cleave::test
