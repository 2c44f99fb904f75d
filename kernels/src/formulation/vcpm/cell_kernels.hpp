// The loops over the bonds of cells, as functions of plain arrays; compiled for every instruction set. Each
// particle sums its whole row in the order of its neighbours, so that a bond is looked at from both ends and
// nothing is scattered.                                                          [VCPM bond, 13, softening]
#pragma once

#include <cstdint>

namespace cleave_call {

struct CellArrays {
  const std::int32_t* row_begin;   // (n+1)
  const std::int32_t* bond_begin;  // (n+1) bonds to a higher neighbour, which end each row
  const std::int32_t* neighbour;   // (h)
  const std::uint64_t* intact;     // (h) bits, and a word more
  const double* length;            // (h+7) [m]
  const double* integrity;         // (h+7), or NULL: 1
  const double* now;               // (4,n) x y z [m]; of geometry 'linear' displacements
  const double* reference;         // (4,n) X Y Z [m]
  const double* factor;            // (n) of the surface
  double* pressure;                // (n), set by `pressures`, read by the others
  double* force;                   // (3,n) [N]
  double* energy;                  // (n) per volume [J m-3]
  double middle;                   // length between the shells [m]
  double stiffness[2], weight[2];  // k_s [N m-1], w_s [m-1] of the shells
  double cell, modulus;            // V [m3], T [Pa]
  std::int32_t linear;             // 1: geometry 'linear'
  std::int32_t criterion;          // CellCriterion
  double limit;                    // of the criterion
  char* flag;                      // (n), or NULL: bonds do not break
};

// What a bond is judged by, as in kVcpmParameters.
enum CellCriterion : std::int32_t { kCellForce = 0, kCellStrain = 1, kCellEnergy = 2 };

struct CellKernels {
  // pressure_i = V T/2 factor_i theta_i
  void (*pressures)(const CellArrays&, std::int64_t first, std::int64_t last);
  // Forces and energies. flag: whether an intact bond to a higher neighbour is at its limit or a little below,
  // 1 or 0; integrities count for the strain only.
  void (*forces)(const CellArrays&, std::int64_t first, std::int64_t last);
};

}  // namespace cleave_call

namespace cleave::vcpm {
using cleave_call::CellArrays;
using cleave_call::CellKernels;
}  // namespace cleave::vcpm
