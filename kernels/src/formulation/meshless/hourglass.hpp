// Penalty on motion that the gradients of a kernel method do not see: a pair pays for the difference
// between its own and the affine motion of its ends.                         [SPH 28, conservative]
//
//   err_ip = u_ip - H_i X_ip          from displacements: full digits at small strain
//   projected     force on i: sum_p c_ip (err_ip - err_pi) . n n,  n = x_ip/|x_ip|,
//                 c_ip = psi (E/2) Omega_i Omega_p w_ip/|X_ip|^2. Published; central, so both momenta
//                 are kept; has no energy, so its work is booked.
//   conservative  force on i: sum_p c_ip (err_ip - err_pi),  c_ip = psi (E/2) Omega_i Omega_p omega_ip:
//                 minus the gradient of V = 1/2 sum c_ip |err_ip|^2 over ordered pairs, if the gradient
//                 is corrected and has the same omega.
#pragma once

#include <cstdint>
#include <vector>

#include "formulation/meshless/kernel_gradient.hpp"

namespace cleave::meshless {

// What the penalty sees of the motion.
struct PairMotion {
  const double *X, *x;  // (3,n) reference and current position [m]
  const double* u;      // (3,n) displacement [m]
  const double* h;      // (9,n) displacement gradient [1]
};

class Hourglass {
 public:
  void setup(Body& body, const KernelGradient& gradient, const Kernel& kernel);
  bool active() const { return form_ != HourglassForm::none; }
  // The projected force is not the gradient of one; its work is booked along the motion.
  bool has_energy() const { return form_ != HourglassForm::projected; }

  // Force on particle i [N].
  template <int D>
  Vec<D> force_on(const PairMotion& motion, const GradientOperator& g, std::int64_t i) const;
  // Adds the penalty to the internal force of first <= i < last and keeps it in hourglass_force.
  // Returns the sum of (force before + force now) . v over the particles [W].
  template <int D>
  double add_force(const Body& body, const GradientOperator& g, std::int64_t first,
                   std::int64_t last) const;
  // Books the work of the step against a penalty without energy. [in] power: sum of what add_force
  // returned; dt: size of the step, 0 before the first
  void book(double power, double dt) const;
  // Energy of the conservative penalty, booked work of the projected one [J].
  double energy(const Body& body, const GradientOperator& g) const;
  // Diagnostic: V with psi = 1, whatever the form [J].
  double diagnostic(const Body& body, const GradientOperator& g) const;
  std::int64_t bytes() const {
    return static_cast<std::int64_t>(stiffness_.capacity() * sizeof(double));
  }

 private:
  HourglassForm form_ = HourglassForm::none;
  double half_modulus_ = 0;  // E/2 [Pa]
  Kernel kernel_;
  std::vector<double> stiffness_;              // (h) c_ip [N/m]; empty if not active
  double *force_ = nullptr, *work_ = nullptr;  // fields
};

}  // namespace cleave::meshless
