// The loops over the bonds and particles of one block, as functions of plain arrays. What is done between
// them - the stress, the sums over the faces of blocks - is not known here.
//
// Order of sums: particle i gets the contributions of the rows before its own, in their order, then those
// of its own twins, then of its own halves.
#pragma once

#include <cstdint>

namespace cleave_call {

// Rows of own particles; the other end of a bond is an own particle, or the foreign one end - own.
struct BlockRows {
  const std::int32_t* begin;
  const std::uint16_t* count;
  const std::uint16_t* end;
  const double* zeta;    // (D,k) [m2]
  const double* weight;  // (k) [m3], viscosity only
};

// Vectors stand at a distance of D, or of kStride: 4 doubles in space, 2 in the plane; the fourth is never
// read for a result. P is (9,own) as everywhere. One more tensor's worth of memory follows P, so that its
// columns may be loaded four at a time. locals: own, then foreign particles.
struct BlockArrays {
  std::int32_t own;
  BlockRows twins, halves;  // twins have own ends only
  const double* u;          // (D, locals) displacement [m]
  double* rows;          // (D kStride, own) sums of u_ip (x) zeta_ip, row by row; zero at the start
  const double* volume;  // (own) Omega [m3]
  const double* P;       // (9, own) [Pa]
  double* f;             // (kStride, locals) force [N]; zero at the start
  // Viscosity only.
  const double *x, *v;  // (kStride, locals) position [m], velocity [m s-1]
  const double* X;      // (kStride, locals) reference position; NULL: constant length
  const double* J;      // (own) det F, not below zero
  double* fv;           // (kStride, locals) force [N]; zero at the start
  double coefficient;   // beta rho0 c0 [Pa s m-1]
  double length;        // l [m]
};

// What is looked at for bonds near to breaking. slack: by how much bonds of a row may at least still grow; rows
// above zero are left alone. X, u are of all particles by place, at a distance of D, and one number more is
// read. foreign: places of the local particles from own on.
struct LookArrays {
  std::int32_t first, own, locals;
  const std::int32_t* foreign;
  BlockRows twins, halves;
  const float *twin_limits, *half_limits;  // of the square of the length [m2]
  double scale;                            // 1 / (2 largest length that a limit allows) [m-1]
  const double *X, *u;                     // [m]
  double* x;                               // (kStride, locals) becomes X + u [m]
  float* slack;                            // (own) [m]
};

// Particles first <= p < last of the whole body; vectors stand at a distance of D. Pointers that may be NULL
// say so.
struct MotionArrays {
  double *u, *v;               // [m], [m s-1]
  const double* f;             // force of the bonds [N]
  const double* fv;            // of the viscosity; NULL: none
  const double* fe;            // from outside; NULL: none
  const double* inverse_mass;  // [kg-1]
  const char* driven;          // 1: prescribed, left alone
};
// Sums over the particles of force times velocity [W].
struct PowerSums {
  double internal, viscous, external;
};
struct VelocityBox {
  double low[3], high[3];
};

// For D = 2 and D = 3.
struct BlockKernels {
  // v += half a, u += dt v; the powers with the new v, and the range of all v.
  PowerSums (*advance[2])(const MotionArrays&, std::int64_t first, std::int64_t last, double half,
                          double dt, VelocityBox& box);
  // The powers with the old v, then v += half a.
  PowerSums (*kick[2])(const MotionArrays&, std::int64_t first, std::int64_t last, double half);
  // H of own particles first <= i < last, in ascending ranges from 0: h (9, last-first) in the order of
  // the interface; zero without volume.                                                  [CBM 8]
  void (*gradient[2])(const BlockArrays&, std::int32_t first, std::int32_t last, double* h);
  // Largest |2 E|^2 of `count` tensors H, with 2 E = H + H^T + H^T H and the Frobenius norm.
  double (*square_strain[2])(const double* h, std::int32_t count);
  // f of all local particles: P_i zeta_ip - P_p zeta_pi on i and the opposite on p; of a half the part
  // of its own end.                                                                  [CBM 18, 19]
  void (*force[2])(const BlockArrays&);
  // fv of all local particles, form "frozen".                                        [CBM 21, 22]
  void (*viscous_force[2])(const BlockArrays&);
  // slack of rows that have none: (limit - |x_ip|^2) scale, the least of the row, which is not more than
  // (sqrt(limit) - |x_ip|) where that is above zero.
  void (*look[2])(const LookArrays&);
};

}  // namespace cleave_call

namespace cleave {
using cleave_call::BlockArrays;
using cleave_call::BlockKernels;
using cleave_call::BlockRows;
using cleave_call::LookArrays;
using cleave_call::MotionArrays;
using cleave_call::PowerSums;
using cleave_call::VelocityBox;

template <int D>
inline constexpr int kStride = D == 3 ? 4 : 2;
}  // namespace cleave
