// What the static methods share: the state before a load increment, kept to come back to, the forces
// that a residual is compared with, and the works that an increment books. How equilibrium is found is
// the methods' own business (static_solver.hpp, relaxation.hpp).
#pragma once

#include <string_view>
#include <vector>

#include "model/body.hpp"

namespace cleave {

class Committed {
 public:
  explicit Committed(Body& body);
  Committed(const Committed&) = delete;
  Committed& operator=(const Committed&) = delete;

  // The real state fields: all that a trial with the same bonds changes.
  void restore() const;
  // Everything, bonds, events and what follows from them included.
  void restore_all(ThreadTeam& team) const;
  const HistoryArrays& history() const { return history_; }
  const std::vector<double>& values(std::string_view name) const;
  std::int64_t bytes() const;

 private:
  template <class T>
  struct Kept {
    Field* field;
    std::vector<T> values;
  };
  Body& body_;
  std::vector<Kept<double>> reals_;
  std::vector<Kept<std::int32_t>> integers_;
  std::size_t events_;
  HistoryArrays history_;
};

// The first increment fixes what the balance is measured from.
void start_ledger(Body& body);

// The largest norm of: internal forces now and before the increment, external forces. Those before count
// too: the increment may take them all away.
double force_scale(const Body& body, const Committed& before);

// Works of an increment, by the trapezoid between the two equilibria. is_free(c): degree of freedom c is
// in equilibrium without a reaction.
template <class IsFree>
void book_works(Body& body, const Committed& before, const IsFree& is_free) {
  const auto& u_old = before.values("displacement");
  const auto& f_old = before.values("internal_force");
  const PointArrays& pt = body.point;
  double internal = 0, external = 0, reaction = 0;
  for (std::size_t c = 0; c < u_old.size(); ++c) {
    const double change = pt.u[c] - u_old[c];
    internal += 0.5 * (f_old[c] + pt.internal[c]) * change;
    if (is_free(c)) {
      external += 0.5 * (pt.external[c] - f_old[c]) * change;  // in equilibrium f_ext = - f_int
    } else {  // held degrees of freedom feel what balances the other forces
      external += pt.external[c] * change;
      reaction -= (0.5 * (f_old[c] + pt.internal[c]) + pt.external[c]) * change;
    }
  }
  pt.ledger[ledger::kInternal] -= internal;
  pt.ledger[ledger::kExternal] += external;
  pt.ledger[ledger::kReaction] += reaction;
}

}  // namespace cleave
