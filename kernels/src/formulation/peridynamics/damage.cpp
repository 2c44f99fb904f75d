#include "formulation/peridynamics/damage.hpp"

#include <algorithm>
#include <cmath>

namespace cleave::peridynamics {

namespace {

// 1 in a zone without failure, 2 prescribed in every direction.
std::vector<char> shields(const Body& body) {
  std::vector<char> directions(static_cast<std::size_t>(body.particles), 0);
  for (const auto& dof : body.prescribed) {
    if (dof.direction < body.dimension())
      directions[static_cast<std::size_t>(dof.particle)] |= static_cast<char>(1 << dof.direction);
  }
  std::vector<char> out(directions.size(), 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool driven = directions[i] == (1 << body.dimension()) - 1;
    const bool exempt = !body.exempt.empty() && body.exempt[i] != 0;
    out[i] = static_cast<char>((exempt ? 1 : 0) | (driven ? 2 : 0));
  }
  return out;
}

}  // namespace

double stretch(const Neighbourhood& hood, const double* x, std::int64_t i, std::int64_t p) {
  const Vec<3> d = difference<3>(x, i, p);
  const double L = hood.length(i, p);
  return (std::sqrt(dot(d, d)) - L) / L;
}

BondMotion bond_motion(const Neighbourhood& hood, const Body& body, std::int64_t i,
                       std::int64_t p) {
  BondMotion m;
  const Vec<3> d = difference<3>(body.point.x, i, p), v = difference<3>(body.point.v, i, p);
  m.L = hood.length(i, p);
  m.l = std::sqrt(dot(d, d));
  m.stretch = (m.l - m.L) / m.L;
  if (!(m.l > 0)) return m;
  for (int k = 0; k < 3; ++k) m.direction[k] = d[k] / m.l;
  m.rate = dot(v, m.direction);
  return m;
}

void Damage::setup(Body& body, const Neighbourhood& hood, std::vector<double> limits,
                   double between) {
  hood_ = &hood;
  region_ = body.region.empty() ? nullptr : body.region.data();
  limits_ = std::move(limits);
  between_ = between;
  least_.assign(static_cast<std::size_t>(hood.points), kUnbounded);
  for (std::int64_t i = 0; i < hood.points; ++i)
    for (auto b = hood.first(i); b < hood.last(i); ++b)
      least_[static_cast<std::size_t>(i)] =
          std::fmin(least_[static_cast<std::size_t>(i)], limit(i, hood.neighbour(b)));
  active_ = std::any_of(least_.begin(), least_.end(), [](double l) { return std::isfinite(l); });
  status_ = body.fields.integer("bond_status");
  shield_ = shields(body);
  bits_.assign(static_cast<std::size_t>(hood.half_bonds() / 64 + 2), 0);
  intact_.resize(static_cast<std::size_t>(hood.points));
  rebuild();
}

double Damage::limit(std::int64_t i, std::int64_t p) const {
  if (region_ == nullptr) return limits_[0];
  const std::int32_t a = region_[i], b = region_[p];
  if (a != b && between_ > 0) return between_;
  return std::fmin(limits_[static_cast<std::size_t>(a)], limits_[static_cast<std::size_t>(b)]);
}

void Damage::rebuild() {
  std::fill(bits_.begin(), bits_.end(), ~std::uint64_t{0});
  for (std::int64_t i = 0; i < hood_->points; ++i)
    intact_[static_cast<std::size_t>(i)] = hood_->count(i);
  counts_ = {hood_->bonds(), 0, 0};
  hood_->for_bonds(0, hood_->bonds(),
                   [&](std::int32_t bond, std::int64_t i, std::int32_t p, std::int32_t half) {
                     if (status_[bond] == kIntact) return;
                     --counts_[kIntact];
                     ++counts_[status_[bond] == kBroken ? kBroken : kCut];
                     clear(i, half);
                     clear(p, hood_->find_half(p, i));
                   });
}

void Damage::clear(std::int64_t i, std::int32_t half) {
  if (!bit(half)) return;
  bits_[static_cast<std::size_t>(half) >> 6] &= ~(std::uint64_t{1} << (half & 63));
  --intact_[static_cast<std::size_t>(i)];
}

bool Damage::may_break(std::int64_t i, std::int64_t p) const {
  const char a = shield_[static_cast<std::size_t>(i)], b = shield_[static_cast<std::size_t>(p)];
  return ((a | b) & 1) == 0 && ((a & b) & 2) == 0;
}

void Damage::mark(std::int32_t bond, Status status) {
  --counts_[static_cast<std::size_t>(status_[bond])];
  ++counts_[static_cast<std::size_t>(status)];
  status_[bond] = status;
  const std::int64_t i = hood_->first_end(bond);
  const auto half = static_cast<std::int32_t>(hood_->upper(i) + bond -
                                              hood_->bond_begin[static_cast<std::size_t>(i)]);
  const std::int32_t p = hood_->neighbour(half);
  clear(i, half);
  clear(p, hood_->find_half(p, i));
}

std::int64_t Damage::bytes() const {
  return static_cast<std::int64_t>(bits_.capacity() * sizeof(std::uint64_t) +
                                   intact_.capacity() * sizeof(std::int32_t) + shield_.capacity() +
                                   least_.capacity() * sizeof(double));
}

}  // namespace cleave::peridynamics
