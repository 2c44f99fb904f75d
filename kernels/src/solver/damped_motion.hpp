// The fictitious motion of adaptive dynamic relaxation: central differences with a step of 1, masses D
// that make it stable and a damping that follows the lowest frequency in which the body still moves.
// No matrix: it asks for forces only. When to stop, and what breaks, is in relaxation.hpp.     [DR motion]
#pragma once

#include <vector>

#include "core/blocks.hpp"
#include "model/body.hpp"

namespace cleave {

class DampedMotion {
 public:
  // What one look at the forces in the body tells.
  struct Balance {
    double residual = 0;  // norm over the free degrees of freedom [N]
    double internal = 0;  // norms over all of them [N]
    double external = 0;
    double work = 0;           // of the unbalanced forces in the last step [J]
    double external_work = 0;  // of the external forces on free degrees of freedom [J]
    double damping = 0;        // c
    double quotient = 0;  // of Rayleigh, of the last step: eigenvalues of D^-1 K, stable below 4
  };

  explicit DampedMotion(const Body& body);

  // At rest in the present configuration, with masses for its bonds and its deformation.
  void start(Body& body, ThreadTeam& team);
  // from: (3,n) displacements in equilibrium; the motion relative to them tells the frequency.
  Balance look(const Body& body, const std::vector<double>& from, ThreadTeam& team);
  // After look: one step. Where prescribed degrees of freedom go is `part` of the way to their
  // displacement from where they were in `from`.
  void step(Body& body, const std::vector<double>& from, double part, const Balance& balance,
            ThreadTeam& team);
  // Heavier, and at rest: the body has stiffened.
  void slow_down(double factor);

  bool is_free(std::size_t c) const { return free_[c] != 0; }
  std::int64_t unknowns() const { return unknowns_; }
  std::int64_t bytes() const;

 private:
  std::vector<double> mass_;   // (3,n) D [N/m]
  std::vector<double> w_;      // (3,n) last step [m]
  std::vector<double> force_;  // (3,n) total force before it [N]
  std::vector<char> free_;     // (3,n)
  std::int64_t unknowns_ = 0;
  bool at_rest_ = true;
  BlockSums<9> sums_;
};

}  // namespace cleave
