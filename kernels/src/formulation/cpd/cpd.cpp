#include "formulation/cpd/cpd.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "core/instruction_set.hpp"
#include "formulation/peridynamics/lattice.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::CliqueKernels, kCliqueKernels)

namespace cleave::cpd {

using peridynamics::bond_motion;
using peridynamics::BondMotion;
using peridynamics::Calibration;
using peridynamics::HoodVolume;
using peridynamics::Lattice;
using peridynamics::PairForm;
using peridynamics::PointEnergy;
using peridynamics::ThreeNeighbour;

namespace {

template <class Choice>
Choice chosen(const Body& body, const char* name) {
  return static_cast<Choice>(body.group("cpd").choice(name));
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  Vec<3> c;
  for (int k = 0; k < 3; ++k)
    c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  return c;
}
double norm(const Vec<3>& a) { return std::sqrt(dot(a, a)); }

// A triangle at corner i: p = x_ij, q = x_ik, area vector p x q.
struct Triangle {
  std::int32_t j, k;
  Vec<3> p, q, area;
  double A, a;  // reference and present
  double change() const { return a / A - 1; }
};

}  // namespace

void ContinuumKinematicsPeridynamics::prepare(Body& body) {
  hood_form_ = chosen<HoodVolume>(body, "hood_volume");
  conservative_ =
      chosen<peridynamics::Weights>(body, "weights") == peridynamics::Weights::conservative;
  signed_volume_ = chosen<ThreeNeighbour>(body, "three_nbr") == ThreeNeighbour::signed_volume;
  find_constants(body);
  for (std::size_t k = 0; k < constants_.size(); ++k) check_constants(body, k);
  if (hood_form_ == HoodVolume::sphere) {
    const Lattice lattice = find_lattice(hood_);
    if (!lattice.found()) {
      throw Error(
          CLEAVE_UNSUPPORTED,
          text("group cpd of ", body.label(),
               ": hood_volume 'sphere' compares with a full lattice, but the particles are not "
               "on one; use 'sum'"));
    }
    full_count_ = static_cast<double>(full_neighbours(hood_, lattice.spacing));
  }
  if (any(&Constants::two) || any(&Constants::three)) numbers_ = hood_numbers(hood_);
  weigh(body);
  weigh_pairs(conservative_ ? PairForm::sum : PairForm::product);
  scratch_.clear();
  expect_workers(1);
  if (any(&Constants::three)) {
    sums_.assign(static_cast<std::size_t>(4 * hood_.points), 0.0);
    const Lattice lattice = use_lattice_ ? find_lattice(hood_) : Lattice{};
    if (!lattice.found() || !lattice_.setup(hood_, lattice, signed_volume_)) cloud_.setup(hood_);
  }
}

bool ContinuumKinematicsPeridynamics::any(double Constants::*constant) const {
  return std::any_of(constants_.begin(), constants_.end(),
                     [&](const Constants& c) { return c.*constant != 0; });
}

void ContinuumKinematicsPeridynamics::weigh(const Body& body) {
  const bool sets = !numbers_.empty();
  std::int64_t full = 0;
  for (std::int64_t i = 1; i < hood_.points; ++i)
    if (hood_.count(i) > hood_.count(full)) full = i;
  const double factor = sets && chosen<Calibration>(body, "c3_calibration") == Calibration::energy
                            ? calibration(full)
                            : 1.0;
  two_.assign(any(&Constants::two) ? left_.size() : 0, 0.0);
  three_.assign(any(&Constants::three) ? left_.size() : 0, 0.0);
  interactions_[1] = interactions_[2] = 0;
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const auto point = static_cast<std::int64_t>(i);
    const double volume = hood_volume(point), v = hood_.volume[i];
    const int bonds = hood_.count(point);
    const double one = bonds > 0 ? constants(i).one * v * volume / bonds : 0.0;
    left_[i] = conservative_ ? 0.5 * one : one;
    now_[4 * i + 3] = conservative_ ? left_[i] : 1.0;
    if (!two_.empty() && numbers_[i].pairs > 0) {
      two_[i] = factor * constants(i).two * v * volume * volume / numbers_[i].pairs;
      interactions_[1] += 2 * numbers_[i].pairs;
    }
    if (!three_.empty() && numbers_[i].triples > 0) {
      three_[i] = factor * constants(i).three * v * std::pow(volume, 3) / numbers_[i].triples;
      interactions_[2] += 6 * numbers_[i].triples;
    }
  }
}

// The row sums of [PD step]. Conservative weights are means of those of the points of a set, which all are
// neighbours of each: the largest of them bounds it.
void ContinuumKinematicsPeridynamics::find_rates(const Body& body, std::span<double> rates) const {
  const auto most = [&](const std::vector<double>& weights, std::int64_t i) {
    double w = std::fabs(weights[static_cast<std::size_t>(i)]);
    if (!conservative_) return w;
    for (auto b = hood_.first(i); b < hood_.last(i); ++b)
      w = std::fmax(w, std::fabs(weights[static_cast<std::size_t>(hood_.neighbour(b))]));
    return w;
  };
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const auto point = static_cast<std::int64_t>(i);
    double sum = 0;
    for (auto b = hood_.first(point); b < hood_.last(point); ++b) {
      const std::int32_t p = hood_.neighbour(b);
      const double weight =
          conservative_ ? left_[i] + left_[static_cast<std::size_t>(p)] : left_[i];
      sum += 2 * weight / hood_.length(point, p);
    }
    if (!two_.empty()) sum += most(two_, point) * numbers_[i].pair_rate;
    if (!three_.empty()) sum += most(three_, point) * numbers_[i].triple_rate;
    rates[i] = sum / body.point.mass[i];
  }
}

void ContinuumKinematicsPeridynamics::expect_workers(int workers) {
  lattice_.expect_workers(workers);
  if (three_.empty() || scratch_.size() >= static_cast<std::size_t>(workers)) return;
  scratch_.resize(static_cast<std::size_t>(workers));
  const std::int32_t most = hood_.most_neighbours();
  for (auto& scratch : scratch_) scratch.expect(most);
}

void ContinuumKinematicsPeridynamics::act(Body& body, ThreadTeam& team) {
  act_by_pairs(body, team);
  if (!two_.empty()) add_triangles(body, team);
  if (!three_.empty()) add_tetrahedra(body, team);
}

template <class F>
void ContinuumKinematicsPeridynamics::for_triangles(const double* x, std::int64_t i,
                                                    const F& f) const {
  const double flat = kFlat * hood_.horizon * hood_.horizon;
  const bool whole = damage_.whole(i);
  for (auto b = hood_.first(i); b < hood_.last(i); ++b) {
    const bool carries_j = whole || damage_.intact(b);
    if (!carries_j && !conservative_) continue;
    const std::int32_t j = hood_.neighbour(b);
    const Vec<3> P = difference<3>(hood_.X, i, j);
    for (auto c = b + 1; c < hood_.last(i); ++c) {
      const bool carries_k = whole || damage_.intact(c);
      const std::int32_t k = hood_.neighbour(c);
      if ((!carries_k && !conservative_) || !hood_.adjacent(j, k)) continue;
      Triangle t{j, k, difference<3>(x, i, j), difference<3>(x, i, k), {}, 0, 0};
      t.A = norm(cross(P, difference<3>(hood_.X, i, k)));
      if (!(t.A > flat)) continue;
      t.area = cross(t.p, t.q);
      t.a = norm(t.area);
      const double own = carries_j && carries_k ? two_[static_cast<std::size_t>(i)] : 0.0;
      if (!conservative_) {
        f(t, own, own);
        continue;
      }
      const bool carries_jk = carries(j, k);
      const double mean =
          (own + (carries_j && carries_jk ? two_[static_cast<std::size_t>(j)] : 0.0) +
           (carries_k && carries_jk ? two_[static_cast<std::size_t>(k)] : 0.0)) /
          3;
      if (mean != 0) f(t, mean, own);
    }
  }
}

// On i: W (1/A - 1/a) (x_k - x_j) x a_vec                                                [PD two]
void ContinuumKinematicsPeridynamics::add_triangles(Body& body, ThreadTeam& team) const {
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      Vec<3> force;
      double energy = 0;
      for_triangles(body.point.x, i, [&](const Triangle& t, double weight, double own) {
        energy += own / 6 * t.A * t.change() * t.change();
        if (!(t.a > 0)) return;
        Vec<3> edge;
        for (int c = 0; c < 3; ++c) edge[c] = t.q[c] - t.p[c];
        const Vec<3> direction = cross(edge, t.area);
        for (int c = 0; c < 3; ++c) force[c] += weight * (t.change() / t.a) * direction[c];
      });
      add_vector(force, body.point.internal, i);
      body.point.energy[i] += energy / hood_.volume[i];
    }
  });
}

// In a cloud with the paper's weights all as if every bond carried, then points with a broken bond by themselves;
// elsewhere the sums know of broken bonds.                                                                        [PD three, 13]
void ContinuumKinematicsPeridynamics::add_tetrahedra(Body& body, ThreadTeam& team) {
  const double* weight = conservative_ ? three_.data() : nullptr;
  if (lattice_.active()) {
    lattice_.sum(body.point.u, weight, team, sums_.data());
  } else {
    cloud_.sum(hood_, damage_, {body.point.x, signed_volume_, weight}, team, scratch_,
               sums_.data());
  }
  constexpr std::int64_t kSmall = 64;  // points: those at cracks are dear
  team.for_blocks((hood_.points + kSmall - 1) / kSmall, [&](std::int64_t block, int worker) {
    for (std::int64_t i = block * kSmall; i < std::min(hood_.points, (block + 1) * kSmall); ++i) {
      const double* s = sums_.data() + 4 * i;
      const double w = conservative_ ? 1.0 : three_[static_cast<std::size_t>(i)];
      Vec<3> force;
      double energy = conservative_ ? s[3] : 0.25 * w * s[3];
      for (int k = 0; k < 3; ++k) force[k] = w * s[k];
      if (!conservative_ && !lattice_.active() && !damage_.whole(i)) {
        const ApexSums own = tetrahedra_at(body, i, worker);
        for (int k = 0; k < 3; ++k) force[k] = w * own.force[k];
        energy = 0.25 * w * own.energy;
      }
      add_vector(force, body.point.internal, i);
      body.point.energy[i] += energy / hood_.volume[i];
    }
  });
}

const Star* ContinuumKinematicsPeridynamics::carrying_star(const Body& body, std::int64_t i,
                                                           int worker) const {
  StarScratch& scratch = scratch_[static_cast<std::size_t>(worker)];
  scratch.list.clear();
  for_carrying(i, [&](std::int32_t p, std::int32_t) { scratch.list.push_back(p); });
  if (scratch.list.size() < 3) return nullptr;
  return &scratch.lay(hood_, i, scratch.list, body.point.x, body.point.v, signed_volume_);
}

ApexSums ContinuumKinematicsPeridynamics::tetrahedra_at(const Body& body, std::int64_t i,
                                                        int worker) const {
  ApexSums sums{};
  if (const Star* star = carrying_star(body, i, worker))
    CLEAVE_KERNELS(kCliqueKernels).chosen().apex(*star, sums);
  return sums;
}

PointEnergy ContinuumKinematicsPeridynamics::point_energy(const Body& body, std::int64_t i,
                                                          int worker) const {
  const double bond = (conservative_ ? 2 : 1) * left_[static_cast<std::size_t>(i)];
  PointEnergy sum;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const BondMotion m = bond_motion(hood_, body, i, p);
    sum.energy += 0.25 * bond * m.stretch * m.stretch * m.L;
    sum.rate += 0.5 * bond * m.stretch * m.rate;
  });
  if (!two_.empty()) {
    for_triangles(body.point.x, i, [&](const Triangle& t, double, double own) {
      sum.energy += own / 6 * t.A * t.change() * t.change();
      if (!(t.a > 0)) return;
      const double rate = dot(t.area, cross(difference<3>(body.point.v, i, t.j), t.q)) +
                          dot(t.area, cross(t.p, difference<3>(body.point.v, i, t.k)));
      sum.rate += own / 3 * t.change() * rate / t.a;
    });
  }
  if (!three_.empty()) {
    const ApexSums s = tetrahedra_at(body, i, worker);
    const double w = 0.25 * three_[static_cast<std::size_t>(i)];
    sum.energy += w * s.energy;
    sum.rate += w * s.rate;
  }
  return sum;
}

Mat<3> ContinuumKinematicsPeridynamics::pairs_stress(const Body& body, std::int64_t i) const {
  const double bond = (conservative_ ? 2 : 1) * left_[static_cast<std::size_t>(i)];
  Mat<3> stress;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const BondMotion m = bond_motion(hood_, body, i, p);
    Vec<3> pull = m.direction;
    for (int k = 0; k < 3; ++k) pull[k] *= 0.5 * bond * m.stretch;
    add_dyad(stress, pull, difference<3>(hood_.X, i, p));
  });
  if (!two_.empty()) {
    for_triangles(body.point.x, i, [&](const Triangle& t, double, double own) {
      if (!(t.a > 0)) return;
      Vec<3> on_j = cross(t.q, t.area), on_k = cross(t.area, t.p);
      for (int k = 0; k < 3; ++k) {
        on_j[k] *= own / 3 * t.change() / t.a;
        on_k[k] *= own / 3 * t.change() / t.a;
      }
      add_dyad(stress, on_j, difference<3>(hood_.X, i, t.j));
      add_dyad(stress, on_k, difference<3>(hood_.X, i, t.k));
    });
  }
  return stress;
}

Mat<3> ContinuumKinematicsPeridynamics::point_stress(const Body& body, std::int64_t i,
                                                     int worker) const {
  Mat<3> stress = pairs_stress(body, i);
  if (!three_.empty()) {
    double sums[9] = {};
    if (const Star* star = carrying_star(body, i, worker))
      CLEAVE_KERNELS(kCliqueKernels).chosen().stress(*star, sums);
    const double w = 0.25 * three_[static_cast<std::size_t>(i)];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) stress(r, c) += w * sums[3 * r + c];
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) stress(r, c) /= hood_.volume[i];
  return stress;
}

void ContinuumKinematicsPeridynamics::point_stresses(const Body& body, std::int64_t first,
                                                     std::int64_t last, int worker,
                                                     Mat<3>* stress) const {
  if (!lattice_.active()) {
    Peridynamic::point_stresses(body, first, last, worker, stress);
    return;
  }
  for (std::int64_t begin = first; begin < last; begin += 8) {
    std::array<std::int32_t, 8> points{};
    const auto count = static_cast<std::size_t>(std::min<std::int64_t>(8, last - begin));
    std::iota(points.begin(), points.end(), static_cast<std::int32_t>(begin));
    std::array<Mat<3>, 8> sums;
    lattice_.stress_sums(hood_, damage_, std::span(points.data(), count), body.point.u, worker,
                         sums.data());
    for (std::size_t l = 0; l < count; ++l) {
      const std::int64_t i = begin + static_cast<std::int64_t>(l);
      const Mat<3> pairs = pairs_stress(body, i);
      const double w = 0.25 * three_[static_cast<std::size_t>(i)];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          stress[i - first](r, c) = (pairs(r, c) + w * sums[l](r, c)) / hood_.volume[i];
    }
  }
}

std::int64_t ContinuumKinematicsPeridynamics::bytes() const {
  return Peridynamic::bytes() + cloud_.bytes() + lattice_.bytes() +
         static_cast<std::int64_t>((two_.capacity() + three_.capacity() + sums_.capacity()) *
                                   sizeof(double));
}

}  // namespace cleave::cpd
