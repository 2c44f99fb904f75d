// Forces on bonds between points of a lattice, eight points of a row side by side; compiled for every
// instruction set. Each bond is evaluated once, at the end from which the other one is ahead. Lengths are in
// lattice spacings: neighbours of a kind have the same reference vector D of whole numbers, and displacements
// say the rest, u = u_j - u_i:
//
//   l^2/L^2 = 1 + e,  e = (2 D + u) . u / L^2,  1 - L/l = e/(1 + e + sqrt(1 + e)) = g
//   force on i: w g/L (D + u), its energy w L (l/L - 1)^2/4 = w L g^2 (1 + e)/4            [PD bond, one]
//
// No difference of nearly equal lengths: the reference has exactly no force.
#pragma once

#include <cstdint>

#include "formulation/peridynamics/pair_kernels.hpp"

namespace cleave_call {

// To the neighbours of a kind.
struct PairStep {
  double D[3];
  double inverse_square, inverse, square;  // of L
  std::int64_t distance;                   // in memory
};

// Rows of places, with as many as bonds reach before and behind; places without a point have u = 0.
struct PairRows {
  const PairStep* steps;
  std::int32_t step_count;
  const std::uint8_t*
      carries;         // (steps, eights) a bit for each of the eight; 0 also for what is not there
  const char* whole;   // (eights) all bits are set of the steps that stay in the body
  const double* u[3];  // [spacings]
  const double* right;
  const double* alpha;  // forms series and mean only; > 0, without a point too
  const double* reach;  // `stretched` only: largest e of a bond that is not looked for
  double *f[3],
      *e;  // added to: on the point, of its bonds: sum g/L (D + u), sum L g^2 (1 + e), weighed:
           // alike: not at all; product: by right of the other end; sum: by right_i + right_j;
           // series, mean: as product, and over or times alpha_i + alpha_j
};

// The eights of one row that begin `at`, and their steps.
struct PairRow {
  const std::int32_t* list;
  std::int32_t steps, eights;
  std::int64_t at, eight;
};

// The forms of pair_kernels.hpp, and product with the same `right` everywhere.
inline constexpr int kLatticeForms = kPairForms + 1, kAlikeForm = kPairForms;

struct LatticePairKernels {
  // By form, in the plane and in space.
  void (*force[kLatticeForms][2])(const PairRows&, const PairRow&);
  // Adds to e, at both ends, the number of bonds that carry and are beyond `reach` of the first end.
  void (*stretched[2])(const PairRows&, const PairRow&);
};

}  // namespace cleave_call

namespace cleave::peridynamics {
using cleave_call::LatticePairKernels;
using cleave_call::PairRow;
using cleave_call::PairRows;
using cleave_call::PairStep;
}  // namespace cleave::peridynamics
