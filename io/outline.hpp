// Which points lie within the simplices of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/mesh.hpp"

namespace cleave::io {

class Outline {
 public:
  // Of the triangles (dimension 2, z is not looked at) or tetrahedra (3) of the mesh, `margin` wider on
  // every side. Throws io::Error if it has none. The mesh has to live as long.
  Outline(const Mesh& mesh, int dimension, double margin);
  bool contains(const double* x) const;
  // Of its corners.
  const std::array<double, 3>& lower() const { return lower_; }
  const std::array<double, 3>& upper() const { return upper_; }

 private:
  using Box = std::array<std::array<std::int64_t, 3>, 2>;
  const double* corner(std::int64_t simplex, int a) const;
  Box bins_of(std::int64_t simplex) const;
  std::int64_t bin_along(std::size_t axis, double x) const;
  bool is_in(const double* x, std::int64_t simplex) const;
  template <class Visit>
  void for_each_bin(const Box& box, const Visit& visit) const;

  const Mesh& mesh_;
  const CellBlock& cells_;
  int dimension_;
  double margin_;
  std::array<double, 3> lower_{}, upper_{};
  std::array<std::int64_t, 3> bins_{1, 1, 1};
  std::vector<std::int64_t> first_, simplices_;  // of every bin, in its order
};

}  // namespace cleave::io
