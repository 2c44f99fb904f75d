#include "support/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace cleave::test {

namespace {

void check(std::int32_t status) {
  if (status == CLEAVE_OK) return;
  char message[4096];
  cleave_last_message(message, sizeof message, nullptr);
  throw std::runtime_error(message);
}

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

Bonds::Bonds(const SimplexMesh& m, std::vector<std::int32_t> alive_in)
    : mesh(m), alive(std::move(alive_in)) {
  alive.resize(at(mesh.simplex_count()), 1);
  const std::int64_t n = mesh.particles();
  row_begin.resize(at(n + 1));
  const cleave_network counted = network();
  check(cleave_cbm_count_bonds(&counted, mesh.simplex_count(), mesh.simplices.data()));
  neighbour.resize(at(half_bonds()));
  reverse.resize(at(half_bonds()));
  zeta.resize(at(3 * half_bonds()));
  volume.resize(at(n));
  const cleave_network whole = network();
  check(cleave_cbm_bonds(&whole, mesh.X.data(), mesh.simplex_count(), mesh.simplices.data(),
                         alive.data()));
}

cleave_network Bonds::network() const {
  cleave_network n;
  check(cleave_network_init(&n));
  n.dimension = mesh.dimension;
  n.particles = mesh.particles();
  // The interface fills and reads networks by the same struct.
  n.row_begin = const_cast<std::int64_t*>(row_begin.data());
  n.neighbour = const_cast<std::int64_t*>(neighbour.data());
  n.reverse = const_cast<std::int64_t*>(reverse.data());
  n.zeta = const_cast<double*>(zeta.data());
  n.volume = const_cast<double*>(volume.data());
  return n;
}

std::vector<double> Bonds::weights() const {
  std::vector<double> w(at(half_bonds()), 0.0);
  for (std::int64_t i = 0; i < mesh.particles(); ++i)
    for (std::int64_t b = row_begin[at(i)]; b < row_begin[at(i + 1)]; ++b)
      for (std::int64_t k = 0; k < mesh.dimension; ++k)
        w[at(b)] +=
            zeta[at(3 * b + k)] * (mesh.X[at(3 * neighbour[at(b)] + k)] - mesh.X[at(3 * i + k)]);
  return w;
}

std::vector<double> Bonds::gradient(const std::vector<double>& u) const {
  std::vector<double> h(9 * volume.size());
  const cleave_network n = network();
  check(cleave_displacement_gradient(&n, 0, n.particles, u.data(), h.data()));
  return h;
}

std::vector<double> Bonds::force(const std::vector<double>& P) const {
  std::vector<double> f(3 * volume.size(), 0.0);
  const cleave_network n = network();
  check(cleave_bond_force(&n, 0, n.particles, P.data(), f.data()));
  return f;
}

Stress stress(std::int32_t material, std::int32_t kinematics, const std::vector<double>& properties,
              const std::vector<double>& H) {
  const std::size_t n = H.size() / 9;
  Stress s{std::vector<double>(9 * n), std::vector<double>(n)};
  check(cleave_material_stress(material, kinematics, static_cast<std::int64_t>(properties.size()),
                               properties.data(), 0, static_cast<std::int64_t>(n), H.data(),
                               nullptr, s.P.data(), s.energy.data(), nullptr));
  return s;
}

Boundary::Boundary(const SimplexMesh& mesh, const std::vector<std::int32_t>& alive)
    : particle_(at(mesh.particles()), 0) {
  const int corners = mesh.dimension + 1;
  std::map<std::vector<std::int64_t>, int> facets;
  for (std::int64_t s = 0; s < mesh.simplex_count(); ++s) {
    if (alive[at(s)] == 0) continue;
    for (int without = 0; without < corners; ++without) {
      std::vector<std::int64_t> facet;
      for (int a = 0; a < corners; ++a) {
        if (a != without) facet.push_back(mesh.simplices[at(s * corners + a)]);
      }
      std::sort(facet.begin(), facet.end());
      ++facets[facet];
    }
  }
  for (const auto& [facet, count] : facets) {
    if (count != 1) continue;
    for (std::size_t a = 0; a < facet.size(); ++a) {
      particle_[at(facet[a])] = 1;
      for (std::size_t b = a + 1; b < facet.size(); ++b) edges_.push_back({facet[a], facet[b]});
    }
  }
  std::sort(edges_.begin(), edges_.end());
}

bool Boundary::bond(std::int64_t i, std::int64_t p) const {
  return std::binary_search(edges_.begin(), edges_.end(),
                            std::array{std::min(i, p), std::max(i, p)});
}

std::vector<std::int32_t> random_deletions(const SimplexMesh& mesh, double probability,
                                           unsigned seed) {
  Random random(seed);
  std::vector<std::int32_t> alive(at(mesh.simplex_count()));
  for (auto& a : alive) a = 0.5 * (1 + random()) < probability ? 0 : 1;
  return alive;
}

std::vector<double> random_vectors(const SimplexMesh& mesh, double size, unsigned seed) {
  Random random(seed);
  std::vector<double> v(mesh.X.size(), 0.0);
  for (std::size_t i = 0; i < v.size() / 3; ++i)
    for (std::size_t k = 0; k < at(mesh.dimension); ++k) v[3 * i + k] = size * random();
  return v;
}

Matrix3 inverse(Matrix3 a) {
  Matrix3 b{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < 3; ++r) {
      if (std::fabs(a[r][c]) > std::fabs(a[pivot][c])) pivot = r;
    }
    if (a[pivot][c] == 0) throw std::runtime_error("singular matrix");
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < 3; ++r) {
      if (r == c) continue;
      const double factor = a[r][c] / a[c][c];
      for (std::size_t k = 0; k < 3; ++k) {
        a[r][k] -= factor * a[c][k];
        b[r][k] -= factor * b[c][k];
      }
    }
  }
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t k = 0; k < 3; ++k) b[r][k] /= a[r][r];
  return b;
}

double determinant(const Matrix3& a) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
    sum += a[0][c] * (a[1][d] * a[2][e] - a[1][e] * a[2][d]);
  }
  return sum;
}

ReferenceSimplex reference_simplex(const SimplexMesh& mesh, std::int64_t simplex) {
  const int d = mesh.dimension;
  const std::int64_t* corner = &mesh.simplices[at(simplex * (d + 1))];
  Matrix3 edges{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // rows X_b - X_0; 2D: third is e3
  for (int b = 0; b < d; ++b)
    for (int k = 0; k < d; ++k) {
      edges[at(b)][at(k)] = mesh.X[at(3 * corner[b + 1] + k)] - mesh.X[at(3 * corner[0] + k)];
    }
  const Matrix3 columns = inverse(edges);  // column a: gradient of corner a+1
  ReferenceSimplex out{std::fabs(determinant(edges)) / (d == 2 ? 2 : 6), {}};
  for (int a = 0; a < d; ++a)
    for (int k = 0; k < d; ++k) {
      out.gradient[at(a + 1)][at(k)] = columns[at(k)][at(a)];
      out.gradient[0][at(k)] -= columns[at(k)][at(a)];
    }
  return out;
}

}  // namespace cleave::test
