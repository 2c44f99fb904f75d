#include "model/interpolation.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/tensor.hpp"
#include "model/model.hpp"

namespace cleave {

namespace {

// Fields of particles, in the order of a simplex: corners first.
const Field& simplices_of(Body& body) {
  const Field* field = body.fields.find("simplex_particles");
  if (field == nullptr || field->count == 0) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(), " has no simplices to interpolate in; ask for particles"));
  }
  return *field;
}

const std::int32_t* nodes_of(const Field& simplices, std::int64_t s) {
  return simplices.integer.data() + simplices.spec.components * s;
}

template <int D>
std::array<double, 4> barycentric(const double* X, const std::int32_t* corner,
                                  const double* point) {
  Mat<D> edges;
  Vec<D> to;
  for (int k = 0; k < D; ++k) {
    for (int a = 0; a < D; ++a)
      edges(k, a) = X[kVector * corner[a + 1] + k] - X[kVector * corner[0] + k];
    to[k] = point[k] - X[kVector * corner[0] + k];
  }
  const Mat<D> cof = cofactor(edges);
  const double det = determinant(edges);
  std::array<double, 4> weight{};
  weight[0] = 1;
  for (int a = 0; a < D; ++a) {
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += cof(k, a) * to[k];
    weight[static_cast<std::size_t>(a + 1)] = sum / det;
    weight[0] -= sum / det;
  }
  return weight;
}

// Simplices by the cells of a grid that their boxes touch.
class Grid {
 public:
  Grid(const Body& body, const Field& simplices) : dimension_(body.dimension()) {
    const double* X = body.point.X;
    for (int k = 0; k < dimension_; ++k) {
      low_[k] = high_[k] = X[k];
      for (std::int64_t i = 1; i < body.particles; ++i) {
        low_[k] = std::fmin(low_[k], X[kVector * i + k]);
        high_[k] = std::fmax(high_[k], X[kVector * i + k]);
      }
    }
    double extent = 0;
    for (int k = 0; k < dimension_; ++k) extent = std::fmax(extent, high_[k] - low_[k]);
    const double per_side =
        std::ceil(std::pow(static_cast<double>(simplices.count), 1.0 / dimension_));
    size_ = extent / std::fmin(per_side, 512.0);
    for (int k = 0; k < dimension_; ++k)
      count_[k] = static_cast<std::int64_t>((high_[k] - low_[k]) / size_) + 1;
    cells_.resize(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (std::int64_t s = 0; s < simplices.count; ++s) {
      const std::int32_t* node = nodes_of(simplices, s);
      std::int64_t first[3] = {}, last[3] = {};
      for (int k = 0; k < dimension_; ++k) {
        double least = X[kVector * node[0] + k], most = least;
        for (int a = 1; a <= dimension_; ++a) {
          least = std::fmin(least, X[kVector * node[a] + k]);
          most = std::fmax(most, X[kVector * node[a] + k]);
        }
        const double slack = 1e-6 * (most - least);
        first[k] = cell(least - slack, k);
        last[k] = cell(most + slack, k);
      }
      for (auto z = first[2]; z <= last[2]; ++z)
        for (auto y = first[1]; y <= last[1]; ++y)
          for (auto x = first[0]; x <= last[0]; ++x)
            cells_[index(x, y, z)].push_back(static_cast<std::int32_t>(s));
    }
  }
  const std::vector<std::int32_t>& near(const double* point) const {
    std::int64_t c[3] = {};
    for (int k = 0; k < dimension_; ++k) c[k] = cell(point[k], k);
    return cells_[index(c[0], c[1], c[2])];
  }

 private:
  std::int64_t cell(double x, int k) const {
    const double place = std::floor((x - low_[k]) / size_);
    return static_cast<std::int64_t>(
        std::clamp(place, 0.0, static_cast<double>(count_[k] - 1)));  // far points: in the double
  }
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>(x + count_[0] * (y + count_[1] * z));
  }
  int dimension_;
  double low_[3] = {}, high_[3] = {}, size_ = 1;
  std::int64_t count_[3] = {1, 1, 1};
  std::vector<std::vector<std::int32_t>> cells_;
};

// Weights of the values that a field has in the simplex, and where they stand.
struct Terms {
  int count = 0;
  std::array<std::int64_t, 6> entry{};
  std::array<double, 6> weight{};
  void add(std::int64_t e, double w) {
    entry[static_cast<std::size_t>(count)] = e;
    weight[static_cast<std::size_t>(count++)] = w;
  }
};

Terms terms_of(const Body& body, const Field& field, const Field& simplices,
               const Location& location) {
  Terms terms;
  const std::int64_t s = location.simplex;
  const auto corners = static_cast<std::size_t>(body.dimension() + 1);
  const auto& l = location.weight;
  if (field.spec.relation == CLEAVE_RELATION_SIMPLEX) {
    terms.add(s, 1.0);
  } else if (field.spec.relation == CLEAVE_RELATION_INTEGRATION_POINT) {
    const std::int64_t points = field.count / simplices.count;
    if (points == 1) terms.add(s, 1.0);
    // Linear and 1 at its own point, where the point's coordinate is 2/3 and the others are 1/6.
    for (std::int64_t q = 0; q < points && points == 3; ++q)
      terms.add(points * s + q, 2 * l[static_cast<std::size_t>(q)] - 1.0 / 3);
  } else {
    const std::int32_t* node = nodes_of(simplices, s);
    const bool six = body.simplex_nodes == 6;
    for (std::size_t a = 0; a < corners; ++a) {
      terms.add(node[a], six ? l[a] * (2 * l[a] - 1) : l[a]);
      if (six) terms.add(node[3 + a], 4 * l[a] * l[(a + 1) % 3]);
    }
  }
  return terms;
}

}  // namespace

std::vector<Location> locate(Body& body, std::span<const double> points) {
  constexpr double kSlack = 1e-9;
  const Field& simplices = simplices_of(body);
  const Grid grid(body, simplices);
  std::vector<Location> found(points.size() / 3);
  for (std::size_t p = 0; p < found.size(); ++p) {
    double best = -kSlack;
    for (const std::int32_t s : grid.near(&points[3 * p])) {
      const auto weight =
          body.dimension() == 2
              ? barycentric<2>(body.point.X, nodes_of(simplices, s), &points[3 * p])
              : barycentric<3>(body.point.X, nodes_of(simplices, s), &points[3 * p]);
      const double least = *std::min_element(weight.begin(), weight.begin() + body.dimension() + 1);
      if (!(least > best || (found[p].simplex < 0 && least >= best))) continue;
      found[p] = {s, weight};
      best = least;
    }
  }
  return found;
}

void interpolate(Body& body, const Field& field, const Location& location, double* values) {
  const auto components = static_cast<std::size_t>(field.spec.components);
  std::fill_n(values, components, 0.0);
  if (location.simplex < 0) return;
  const Terms terms = terms_of(body, field, simplices_of(body), location);
  std::vector<double> one(components);
  for (std::size_t t = 0; t < static_cast<std::size_t>(terms.count); ++t) {
    const std::int64_t e = terms.entry[t];
    if (field.spec.lifetime == CLEAVE_LIFETIME_DERIVED) {
      if (!derive_core(body, field.spec.name, e, e + 1, one.data()))
        body.formulation->derive(body, field.spec.name, e, e + 1, one.data());
    } else {
      std::copy_n(field.real.begin() + static_cast<std::ptrdiff_t>(components) * e, components,
                  one.begin());
    }
    for (std::size_t c = 0; c < components; ++c) values[c] += terms.weight[t] * one[c];
  }
}

}  // namespace cleave
