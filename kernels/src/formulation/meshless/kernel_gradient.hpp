// The weights of the gradient operator from a kernel: neighbours within its support, particle
// volumes, moment matrices and bond vectors.                                  [SPH moment, zeta]
//
//   K_i     = sum_p Omega_p omega_ip X_ip (x) X_ip
//   zeta_ip = Omega_i Omega_p omega_ip K_i^-1 X_ip
//
// It knows geometry only. Total-Lagrangian SPH and correspondence peridynamics differ in omega.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/cell_list.hpp"
#include "core/gradient_operator.hpp"
#include "core/thread_team.hpp"
#include "formulation/meshless/parameters.hpp"
#include "model/body.hpp"

namespace cleave::meshless {

// A function of the distance of two particles [m].
using PairFunction = std::function<double(double)>;

struct Kernel {
  PairFunction omega;   // weight of a pair [m-(d+2)], scaled so that K is the unit matrix inside
  PairFunction spline;  // w of the penalty [m-d]
  double support = 0;   // [m]
  Radius rule = Radius::open;
  GradientForm gradient = GradientForm::corrected;
};

class KernelGradient {
 public:
  // Volumes from the body's simplices, neighbours, fields of simplices and half-bonds, weights.
  // Throws for simplices and particles that cannot be used.
  void build(Body& body, const Kernel& kernel);
  // Volumes and weights again, from the fields.
  void rebuild(const Body& body, ThreadTeam& team);

  GradientOperator gradient() const {
    return {.row_begin = rows.row_begin.data(),
            .neighbour = rows.neighbour.data(),
            .reverse = rows.reverse.data(),
            .zeta = zeta,
            .volume = volume};
  }
  // zeta_ip . X_ip of every half-bond [m3]: positive, adds up to d Omega_i when corrected.
  std::vector<double> bond_weights() const;
  // f(Omega_i Omega_p, |X_ip|) of every half-bond; the same bits for both of a pair.
  std::vector<double> pair_values(const std::function<double(double, double)>& f) const;
  std::int64_t half_bonds() const { return static_cast<std::int64_t>(rows.neighbour.size()); }
  std::int64_t bytes() const;

  std::int64_t simplices = 0;
  NeighbourRows rows;
  const double* X = nullptr;
  double* zeta = nullptr;    // (3,h) [m2]
  double* volume = nullptr;  // (n) [m3]

 private:
  static void require_simplices(const Body& body);
  void check_volumes(const Body& body) const;
  void check_distances(const Body& body) const;
  [[noreturn]] void refuse(const Body& body, std::int64_t i) const;
  template <int D>
  bool weigh(std::int64_t i);

  Kernel kernel_;
  const std::int32_t* corners_ = nullptr;  // (4,simplices), the field
  std::vector<std::int64_t> singular_;     // per block: first particle without a gradient, or -1
};

}  // namespace cleave::meshless
