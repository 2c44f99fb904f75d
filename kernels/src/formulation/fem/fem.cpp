#include "formulation/fem/fem.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "formulation/common/unused_groups.hpp"
#include "formulation/fem/elements.hpp"
#include "model/stiffness_bound.hpp"

namespace cleave::fem {

namespace {

// dt = kSafety * 2/omega_max of the stiffest element, an upper bound of the body's omega_max
// (Irons and Treharne), at the reference configuration.        [FEM step]
constexpr double kSafety = 0.9;

// f(Element{}) for the elements of the body.
template <class F>
auto with_element(const Body& body, const F& f) {
  if (body.dimension() == 3) return f(Linear<3>{});
  if (body.simplex_nodes == 6) return f(Triangle6{});
  return f(Linear<2>{});
}

}  // namespace

std::int64_t FiniteElements::integration_points(const Body& body) const {
  const auto count = static_cast<std::int64_t>(body.given_simplices.size()) / body.simplex_nodes;
  return with_element(body, [&](auto e) { return count * e.kPoints; });
}

template <class Element>
void FiniteElements::setup_elements(Body& body) {
  constexpr int D = Element::kDimension, N = Element::kNodes, Q = Element::kPoints;
  const auto quadrature = Element::quadrature();
  const std::int64_t* given = body.given_simplices.data();
  const double density = with_law(body.material, [](const auto& law) { return law.density(); });
  std::int32_t* listed = body.fields.integer("simplex_particles");
  for (std::int64_t e = 0; e < elements_; ++e) {
    const std::int64_t* nodes = given + N * e;
    for (int a = 0; a < N; ++a)
      body.check_particle(nodes[a], CLEAVE_BAD_SIMPLEX, text("element ", body.number(e)));
    double volume = 0, longest = 0;
    for (int a = 1; a < N; ++a) {
      const Vec<D> edge = difference<D>(body.point.X, nodes[0], nodes[a]);
      longest = std::fmax(longest, dot(edge, edge));
    }
    for (int q = 0; q < Q; ++q) {
      const auto g = point_geometry(quadrature[static_cast<std::size_t>(q)], body.point.X, nodes);
      if (!(g.volume > 1e-12 * std::pow(longest, 0.5 * D))) {
        throw Error(CLEAVE_BAD_SIMPLEX,
                    text(body.label(), ": element ", body.number(e), " beside particle ",
                         body.number(nodes[0]), " is degenerate; repair the mesh there"));
      }
      const std::int64_t point = Q * e + q;
      body.point.volume[point] = g.volume;
      volume += g.volume;
      origin_[static_cast<std::size_t>(point)] = static_cast<std::int32_t>(nodes[0]);
      for (int a = 0; a < N; ++a) {
        const auto entry = static_cast<std::size_t>(N * point + a);
        node_[entry] = static_cast<std::int32_t>(nodes[a]);
        for (int k = 0; k < D; ++k) {
          zeta_[static_cast<std::size_t>(kVector) * entry + static_cast<std::size_t>(k)] =
              g.volume * g.gradient[static_cast<std::size_t>(a)][k];
        }
      }
    }
    for (int a = 0; a < N; ++a) {
      body.point.mass[nodes[a]] += density * volume * Element::mass_share(a);
      listed[6 * e + a] = static_cast<std::int32_t>(nodes[a]);
    }
    for (int a = N; a < 6; ++a) listed[6 * e + a] = -1;
  }
  for (std::int64_t point = 0; point <= body.points; ++point)
    row_begin_[static_cast<std::size_t>(point)] = static_cast<std::int32_t>(N * point);
}

// The entries of every node, by ascending point.
void FiniteElements::make_columns(const Body& body) {
  column_begin_.assign(static_cast<std::size_t>(body.particles + 1), 0);
  for (const std::int32_t a : node_) ++column_begin_[static_cast<std::size_t>(a) + 1];
  for (std::size_t a = 1; a < column_begin_.size(); ++a) column_begin_[a] += column_begin_[a - 1];
  column_point_.resize(node_.size());
  column_entry_.resize(node_.size());
  std::vector<std::int32_t> next(column_begin_.begin(), column_begin_.end() - 1);
  for (std::int64_t q = 0; q < body.points; ++q) {
    for (std::int32_t b = row_begin_[static_cast<std::size_t>(q)];
         b < row_begin_[static_cast<std::size_t>(q + 1)]; ++b) {
      const auto place = static_cast<std::size_t>(
          next[static_cast<std::size_t>(node_[static_cast<std::size_t>(b)])]++);
      column_point_[place] = static_cast<std::int32_t>(q);
      column_entry_[place] = b;
    }
  }
}

// Largest eigenvalue of M_e^-1 K_e over the elements, with the isotropic stiffness of the
// undeformed law: modulus M = rho c0^2 of plane waves and shear modulus.
template <class Element>
double FiniteElements::highest_frequency_squared(const Body& body) const {
  constexpr int D = Element::kDimension, N = Element::kNodes, Q = Element::kPoints;
  double plane_wave = 0, shear = 0;
  with_law(body.material, [&](const auto& law) {
    plane_wave = law.density() * law.wave_speed() * law.wave_speed();
    shear = law.shear_modulus();
  });
  const double lambda = plane_wave - 2 * shear;
  double highest = 0;
  for (std::int64_t e = 0; e < elements_; ++e) {
    Eigen::Matrix<double, D * N, D* N> k = decltype(k)::Zero();
    double mass[N], volume = 0;
    for (int q = 0; q < Q; ++q) {
      const std::int64_t point = Q * e + q;
      volume += body.point.volume[point];
      for (int a = 0; a < N; ++a)
        for (int b = 0; b < N; ++b) {
          const Vec<D> ga = load_vector<D>(zeta_.data(), N * point + a);
          const Vec<D> gb = load_vector<D>(zeta_.data(), N * point + b);
          for (int i = 0; i < D; ++i)
            for (int j = 0; j < D; ++j) {
              k(D * a + i, D * b + j) += (lambda * ga[i] * gb[j] + shear * ga[j] * gb[i] +
                                          (i == j ? shear * dot(ga, gb) : 0.0)) /
                                         body.point.volume[point];
            }
        }
    }
    const double density = with_law(body.material, [](const auto& law) { return law.density(); });
    for (int a = 0; a < N; ++a) mass[a] = density * volume * Element::mass_share(a);
    for (int a = 0; a < D * N; ++a)
      for (int b = 0; b < D * N; ++b) k(a, b) /= std::sqrt(mass[a / D] * mass[b / D]);
    const Eigen::SelfAdjointEigenSolver<decltype(k)> solver(k, Eigen::EigenvaluesOnly);
    highest = std::fmax(highest, solver.eigenvalues()(D * N - 1));
  }
  return highest;
}

void FiniteElements::setup(Body& body, ThreadTeam&) {
  for (const char* group : {"fracture", "viscosity", "stabilisation", "kernel", "hourglass",
                            "peridynamics", "cpd", "vcpm"})
    refuse_group(body, group, "leave it out, or apply it to other bodies");
  elements_ = static_cast<std::int64_t>(body.given_simplices.size()) / body.simplex_nodes;
  if (elements_ == 0) {
    throw Error(CLEAVE_BAD_ARGUMENT, text(body.label(), ": finite elements need simplices"));
  }
  const auto entries = body.points * body.simplex_nodes;
  if (entries > std::numeric_limits<std::int32_t>::max()) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text(body.label(), " has too many elements; split it into bodies"));
  }
  body.fields.allocate(CLEAVE_RELATION_SIMPLEX, elements_);
  row_begin_.assign(static_cast<std::size_t>(body.points + 1), 0);
  origin_.assign(static_cast<std::size_t>(body.points), 0);
  node_.assign(static_cast<std::size_t>(entries), 0);
  zeta_.assign(static_cast<std::size_t>(kVector * entries), 0.0);
  with_element(body, [&](auto element) { setup_elements<decltype(element)>(body); });
  for (std::int64_t i = 0; i < body.particles; ++i) {
    if (body.point.mass[i] > 0) continue;
    throw Error(CLEAVE_BAD_SIMPLEX, text(body.label(), ": ", body.particle_label(i),
                                         " belongs to no element, so it has no mass; leave it "
                                         "out"));
  }
  make_columns(body);
  operator_ = {row_begin_.data(),    node_.data(),         nullptr,
               zeta_.data(),         body.point.volume,    origin_.data(),
               column_begin_.data(), column_point_.data(), column_entry_.data()};
  points_.setup(body);
  stable_step_ = kSafety * 2 / std::sqrt(with_element(body, [&](auto element) {
                   return highest_frequency_squared<decltype(element)>(body);
                 }));
}

void FiniteElements::rebuild(Body& body, ThreadTeam& team) {
  points_.gradients(body, operator_, team);
}

double FiniteElements::stable_step(const Body&) const { return stable_step_; }

void FiniteElements::stiffness_bound(const Body& body, ThreadTeam&, std::span<double> bound) {
  add_row_sums(body, operator_, bound);
}

void FiniteElements::deform(Body& body, const Clock& clock, ThreadTeam& team) {
  points_.deform(body, operator_, clock, team);
}

void FiniteElements::forces(Body& body, ThreadTeam& team) {
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    std::fill(body.point.internal + kVector * first, body.point.internal + kVector * last, 0.0);
    body.dimension() == 2
        ? internal_force<2>(operator_, body.point.p, first, last, body.point.internal)
        : internal_force<3>(operator_, body.point.p, first, last, body.point.internal);
  });
}

void FiniteElements::precrack(Body& body, std::span<const std::int64_t>) {
  throw Error(CLEAVE_UNSUPPORTED, text(body.label(),
                                       ": formulation fem has no bonds to break; "
                                       "mesh the crack, or use cbm"));
}

StoredEnergy FiniteElements::stored_energy(const Body& body) const {
  return {points_.stored_energy(body), 0};
}

void FiniteElements::count(const Body& body, cleave_counts& counts) const {
  counts.simplices += elements_;
  counts.inverted += points_.inverted(body);
}

std::int64_t FiniteElements::bytes() const {
  return static_cast<std::int64_t>((row_begin_.size() + node_.size() + origin_.size() +
                                    column_begin_.size() + column_point_.size() +
                                    column_entry_.size()) *
                                       sizeof(std::int32_t) +
                                   zeta_.size() * sizeof(double));
}

}  // namespace cleave::fem
