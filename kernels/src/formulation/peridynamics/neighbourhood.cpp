#include "formulation/peridynamics/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "formulation/common/body_simplices.hpp"

namespace cleave::peridynamics {

namespace {

constexpr double kLeastReach = 1.5;   // spacings
constexpr double kCoincident = 1e-6;  // of the spacing: below, two points are one

double extent_of(const double* X, std::int64_t n) {
  double extent = 0;
  for (int k = 0; k < 3; ++k) {
    double low = X[k], high = X[k];
    for (std::int64_t i = 1; i < n; ++i) {
      low = std::fmin(low, X[kVector * i + k]);
      high = std::fmax(high, X[kVector * i + k]);
    }
    extent = std::fmax(extent, high - low);
  }
  return extent;
}

}  // namespace

void Neighbourhood::build(Body& body, int wanted_dimension, double wanted_horizon,
                          double wanted_section) {
  dimension = wanted_dimension;
  horizon = wanted_horizon;
  section = dimension == 1 ? wanted_section : 1.0;
  points = body.particles;
  X = body.point.X;
  volume = body.point.volume;
  square_limit = square_reach(horizon, Radius::closed);
  simplices = take_simplices(body);
  take_volumes(body);
  check_horizon(body);
  rows = neighbours_within(X, points, horizon, Radius::closed, body.label(), kMostHalfBonds,
                           ReverseHalves::left_out);
  bond_begin.assign(static_cast<std::size_t>(points) + 1, 0);
  for (std::int64_t i = 0; i < points; ++i) {
    const auto row = rows.neighbour.begin();
    const auto above = row + last(i) - std::upper_bound(row + first(i), row + last(i), i);
    bond_begin[static_cast<std::size_t>(i) + 1] =
        bond_begin[static_cast<std::size_t>(i)] + static_cast<std::int32_t>(above);
  }
  check_distances(body);
  body.fields.allocate(CLEAVE_RELATION_BOND, bonds());
}

void Neighbourhood::take_volumes(Body& body) {
  if (body.given_volumes.empty() && simplices == 0) {
    throw Error(
        CLEAVE_MISSING_PARAMETER,
        text(body.label(), " has neither simplices nor volumes: ", body.formulation->name(),
             " needs the volume of each particle; give them with cleave_body_volumes, or give "
             "a mesh"));
  }
  double* v = body.point.volume;
  if (body.given_volumes.empty()) {
    share_volumes(body, body.fields.integer("simplex_particles"), simplices);
  } else {
    std::copy(body.given_volumes.begin(), body.given_volumes.end(), v);
  }
  double sum = 0;
  for (std::int64_t i = 0; i < points; ++i) {
    if (!(v[i] > 0)) {
      throw Error(
          body.given_volumes.empty() ? CLEAVE_BAD_SIMPLEX : CLEAVE_BAD_ARGUMENT,
          text(body.label(), ": the volume of ", body.particle_label(i), " is ", v[i],
               body.given_volumes.empty() ? ": it belongs to no simplex, or to flat ones only" : "",
               "; allowed: > 0; leave the particle out"));
    }
    sum += v[i];
  }
  spacing = std::pow(sum / static_cast<double>(points) / section, 1.0 / dimension);
}

void Neighbourhood::check_horizon(const Body& body) const {
  if (!(horizon > 0)) {
    throw Error(CLEAVE_MISSING_PARAMETER,
                text("group peridynamics of ", body.label(), " needs horizon > 0 for formulation ",
                     body.formulation->name(), "; 3.015 times the spacing, here ", 3.015 * spacing,
                     " [m], is usual"));
  }
  if (horizon < kLeastReach * spacing) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("group peridynamics of ", body.label(), ": horizon ", horizon, " [m] is ",
                     horizon / spacing, " spacings of the particles (", spacing,
                     " [m]); allowed: at least ", kLeastReach, ", that is ", kLeastReach * spacing,
                     " [m]; use a larger horizon or more particles"));
  }
  const double extent = extent_of(X, points);
  if (horizon > extent) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("group peridynamics of ", body.label(), ": horizon ", horizon,
                     " [m] is larger than the body, whose longest side is ", extent,
                     " [m]; check the units, or use a smaller horizon"));
  }
}

void Neighbourhood::check_distances(const Body& body) const {
  const double least = kCoincident * spacing * kCoincident * spacing;
  for (std::int64_t i = 0; i < points; ++i) {
    for (auto b = upper(i); b < last(i); ++b) {
      const Vec<3> d = difference<3>(X, i, neighbour(b));
      if (dot(d, d) > least) continue;
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(body.label(), ": ", body.particle_label(i), " and particle ",
                       body.number(neighbour(b)), " are at the same place (", std::sqrt(dot(d, d)),
                       " [m] apart, spacing ", spacing, "); leave one out"));
    }
  }
}

std::int32_t Neighbourhood::find_half(std::int64_t i, std::int64_t p) const {
  const auto begin = rows.neighbour.begin();
  const auto found = std::lower_bound(begin + first(i), begin + last(i), p);
  return found != begin + last(i) && *found == p ? static_cast<std::int32_t>(found - begin) : -1;
}

std::int32_t Neighbourhood::first_end(std::int32_t bond) const {
  return static_cast<std::int32_t>(std::upper_bound(bond_begin.begin(), bond_begin.end(), bond) -
                                   bond_begin.begin() - 1);
}

std::int32_t Neighbourhood::most_neighbours() const {
  std::int32_t most = 0;
  for (std::int64_t i = 0; i < points; ++i) most = std::max(most, count(i));
  return most;
}

std::int64_t Neighbourhood::bytes() const {
  return static_cast<std::int64_t>(
      (rows.row_begin.capacity() + rows.neighbour.capacity() + bond_begin.capacity()) *
      sizeof(std::int32_t));
}

}  // namespace cleave::peridynamics
