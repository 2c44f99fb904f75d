// The loops over the bonds of points, as functions of plain arrays; compiled for every instruction set.
// Each point sums its whole row in the order of its neighbours, so that a bond is looked at from both
// ends and nothing is scattered.
#pragma once

#include <cstdint>

namespace cleave_call {

// Weight w_ij of the force on i: left_i right_j, or left_i + right_j                       [PD bond, one]
// and left_i right_j/(alpha_i + alpha_j), or times that.                                  [PD interface]
enum class PairForm { product, sum, series, mean };
inline constexpr int kPairForms = 4;

// Rows of four numbers a point, so that a neighbour is one load.
struct PairArrays {
  const std::int32_t* row_begin;   // (n+1)
  const std::int32_t* bond_begin;  // (n+1) bonds to a higher neighbour, which end each row
  const std::int32_t* neighbour;   // (h)
  const std::uint64_t* intact;     // (h) bits, and a word more
  const double* now;               // (4,n) x y z [m] and `right`
  const double* reference;         // (4,n) X Y Z [m] and `volume` [m3]
  const double* left;              // (n)
  double* force;                   // (3,n) [N], set
  double* energy;                  // (n) of the point's half of its bonds, per volume [J m-3], set
  // State-based: influence (0: horizon/L, 1: 1, 2: 1 - L/horizon), horizon [m]; per point: alpha and T of
  // the force state [PD lps].
  std::int32_t influence;
  double horizon;
  const double* alpha;   // (n) [N m-5]; for bonds between materials see `series` and `mean`
  const double* spread;  // (n) T
  double* extension;     // (n) sum omega L e v, set by `extension`
  double* square;        // (n) sum omega e^2 v, set by `extension`
};

struct PairKernels {
  // f_i = sum_j w_ij (l - L)/L n, by form
  void (*force[kPairForms])(const PairArrays&, std::int64_t first, std::int64_t last);
  // sum_j omega L e v_j and sum_j omega e^2 v_j over intact bonds                  [PD lps]
  void (*extension)(const PairArrays&, std::int64_t first, std::int64_t last);
  // Force only: f_i = v_i sum_j v_j omega ((alpha_i + alpha_j) e + (T_i + T_j) L) n
  void (*state)(const PairArrays&, std::int64_t first, std::int64_t last);
  // Whether a point has a neighbour of a higher number at l - L > limit_i L or a little less, broken bonds too:
  // 1 or 0 each.
  void (*stretched)(const PairArrays&, std::int64_t first, std::int64_t last, const double* limit,
                    char* flag);
};

}  // namespace cleave_call

namespace cleave::peridynamics {
using cleave_call::PairArrays;
using cleave_call::PairForm;
using cleave_call::PairKernels;
}  // namespace cleave::peridynamics
