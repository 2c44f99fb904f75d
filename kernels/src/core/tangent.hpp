// The derivative of a stress with respect to the deformation, as plain numbers.
#pragma once

namespace cleave {

// c[i][j][k][l] = dP_ij / dF_kl.
template <int D>
struct Tangent {
  double c[D][D][D][D] = {};
  double& operator()(int i, int j, int k, int l) { return c[i][j][k][l]; }
  double operator()(int i, int j, int k, int l) const { return c[i][j][k][l]; }
};

}  // namespace cleave
