#include "solver/increment.hpp"

#include <cmath>

#include "model/model.hpp"

namespace cleave {

Committed::Committed(Body& body) : body_(body), events_(body.events.size()) {
  for (auto& field : body.fields.all()) {
    if (field.spec.lifetime != CLEAVE_LIFETIME_STATE) continue;
    if (field.spec.type == CLEAVE_REAL) {
      reals_.push_back({&field, field.real});
    } else {
      integers_.push_back({&field, field.integer});
    }
  }
  history_ = body.history;
  for (std::size_t k = 0; k < kMaxHistory; ++k) {
    for (auto& [field, values] : reals_) {
      if (history_.base[k] != nullptr && history_.base[k] == field->real.data())
        history_.base[k] = values.data();
    }
  }
}

void Committed::restore() const {
  for (const auto& [field, values] : reals_) field->real = values;
}

void Committed::restore_all(ThreadTeam& team) const {
  restore();
  for (const auto& [field, values] : integers_) field->integer = values;
  body_.events.resize(events_);
  for (std::int64_t c = 0; c < kVector * body_.particles; ++c)
    body_.point.x[c] = body_.point.X[c] + body_.point.u[c];
  body_.formulation->rebuild(body_, team);
}

const std::vector<double>& Committed::values(std::string_view name) const {
  for (const auto& [field, values] : reals_) {
    if (name == field->spec.name) return values;
  }
  throw Error(CLEAVE_INTERNAL, text("no state field ", name));
}

std::int64_t Committed::bytes() const {
  std::size_t sum = 0;
  for (const auto& kept : reals_) sum += kept.values.size() * sizeof(double);
  for (const auto& kept : integers_) sum += kept.values.size() * sizeof(std::int32_t);
  return static_cast<std::int64_t>(sum);
}

void start_ledger(Body& body) {
  const PointArrays& pt = body.point;
  if (pt.ledger[ledger::kStarted] > 0) return;
  const cleave_energies e = energies(body);
  pt.ledger[ledger::kStartTotal] = e.elastic + e.plastic + e.stabilisation;
  pt.ledger[ledger::kStarted] = 1;
}

double force_scale(const Body& body, const Committed& before) {
  const auto& f_old = before.values("internal_force");
  double internal = 0, external = 0, old = 0;
  for (std::size_t c = 0; c < f_old.size(); ++c) {
    internal += body.point.internal[c] * body.point.internal[c];
    external += body.point.external[c] * body.point.external[c];
    old += f_old[c] * f_old[c];
  }
  return std::sqrt(std::fmax(old, std::fmax(internal, external)));
}

}  // namespace cleave
