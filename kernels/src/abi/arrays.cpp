// Array calls: no state, the caller's memory, the same kernels as the model.
#include <algorithm>
#include <cmath>

#include "abi/checks.hpp"
#include "abi/host_arrays.hpp"
#include "core/gradient_operator.hpp"
#include "core/ramp.hpp"
#include "formulation/cbm/bonds.hpp"
#include "formulation/common/viscosity.hpp"

using namespace cleave;
using namespace cleave::abi;

namespace {

const cleave_network& checked(const cleave_network* network) {
  const cleave_network& n = required(network, "network");
  check_size(n, "cleave_network");
  check_dimension(n.dimension);
  check_index_base(n.index_base);
  check_rows(0, n.particles);
  required(n.row_begin, "network row_begin");
  return n;
}

// A network that is complete, and a range of its particles.
HostOperator host_operator(const cleave_network* network, int64_t first, int64_t last) {
  const cleave_network& n = checked(network);
  check_range(first, last, n.particles);
  required(n.neighbour, "network neighbour");
  required(n.reverse, "network reverse");
  required(n.zeta, "network zeta");
  required(n.volume, "network volume");
  if (n.row_begin[0] != n.index_base) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("row_begin begins with ", n.row_begin[0], ", index_base is ", n.index_base,
                     "; fill the network by cleave_cbm_count_bonds with the same index_base"));
  }
  return {n.row_begin, n.neighbour, n.reverse, n.zeta, n.volume, n.index_base};
}

template <bool Packed, class Real>
HostVectors<Real, Packed> vectors(const cleave_network& n, Real* base) {
  return {base, n.vector_point, n.vector_component};
}
template <bool Packed, class Real>
HostTensors<Real, Packed> tensors(const cleave_network& n, Real* base) {
  return {base, n.tensor_point, n.tensor_component};
}

// f(dimension, whether the arrays stand in our layout), both known when compiled.
template <class F>
void with_shape(const cleave_network& n, const F& f) {
  const bool packed = n.vector_point == kVector && n.vector_component == 1 &&
                      n.tensor_point == kTensor && n.tensor_component == 1;
  with_dimension(n.dimension, [&](auto d) {
    if (packed) {
      f(d, std::true_type{});
    } else {
      f(d, std::false_type{});
    }
  });
}

// Simplices counted from 0.
std::vector<int64_t> zero_based(const cleave_network& n, int64_t simplex_count,
                                const int64_t* simplices) {
  check_rows(0, simplex_count);
  if (simplex_count > 0) required(simplices, "simplices");
  std::vector<int64_t> out(simplices, simplices + simplex_count * (n.dimension + 1));
  for (int64_t& particle : out) particle -= n.index_base;
  return out;
}

// (3,n) from the caller's layout.
std::vector<double> packed(const cleave_network& n, const double* X) {
  const auto array = vectors<false>(n, X);
  std::vector<double> out(static_cast<std::size_t>(kVector * n.particles), 0.0);
  for (int64_t i = 0; i < n.particles; ++i)
    for (int c = 0; c < n.dimension; ++c)
      out[static_cast<std::size_t>(kVector * i + c)] = array.at(i, c);
  return out;
}

template <int D>
void build_bonds(const cleave_network& n, const double* X, int64_t simplex_count,
                 const int64_t* simplices, const int32_t* alive) {
  const auto incidence =
      make_incidence(n.particles, simplex_count, simplices, D + 1, D + 1, n.index_base);
  for (int64_t s = 0; s < simplex_count; ++s) {
    if (is_degenerate<D>(X, simplices + (D + 1) * s)) {
      throw Error(CLEAVE_BAD_SIMPLEX,
                  text("simplex ", s + n.index_base, " is degenerate; repair the mesh there"));
    }
  }
  std::vector<int64_t> found, row_begin(static_cast<std::size_t>(n.particles) + 1);
  for (int64_t i = 0; i <= n.particles; ++i)
    row_begin[static_cast<std::size_t>(i)] = n.row_begin[i] - n.index_base;
  for (int64_t i = 0; i < n.particles; ++i) {
    cbm::collect_neighbours(incidence, simplices, D + 1, D + 1, i, found);
    if (static_cast<int64_t>(found.size()) != n.row_begin[i + 1] - n.row_begin[i]) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text("row_begin does not fit the simplices at particle ", i + n.index_base,
                       "; take it from cleave_cbm_count_bonds"));
    }
    std::copy(found.begin(), found.end(), n.neighbour + row_begin[static_cast<std::size_t>(i)]);
  }
  cbm::fill_reverse(n.particles, row_begin.data(), n.neighbour, n.reverse);
  for (int64_t i = 0; i < n.particles; ++i) {
    const int64_t first = row_begin[static_cast<std::size_t>(i)],
                  last = row_begin[static_cast<std::size_t>(i) + 1];
    const std::span<const int64_t> row{n.neighbour + first, n.neighbour + last};
    n.volume[i] = cbm::sum_row<D>(X, simplices, D + 1, alive, incidence, row, i,
                                  n.zeta + kVector * first, nullptr);
  }
  for (int64_t b = 0; b < row_begin.back(); ++b) {
    n.neighbour[b] += n.index_base;
    n.reverse[b] += n.index_base;
  }
}

}  // namespace

extern "C" {

int32_t cleave_network_init(cleave_network* network) {
  return guarded("cleave_network_init", [&] {
    cleave_network& n = required(network, "network");
    n = cleave_network{};
    n.size = sizeof(cleave_network);
    n.dimension = 3;
    n.vector_point = kVector;
    n.tensor_point = kTensor;
    n.vector_component = n.tensor_component = 1;
  });
}

int32_t cleave_cbm_count_bonds(const cleave_network* network, int64_t simplex_count,
                               const int64_t* simplices) {
  return guarded("cleave_cbm_count_bonds", [&] {
    const cleave_network& n = checked(network);
    const std::vector<int64_t> corners = zero_based(n, simplex_count, simplices);
    const int count = n.dimension + 1;
    const auto incidence =
        make_incidence(n.particles, simplex_count, corners.data(), count, count, n.index_base);
    std::vector<int64_t> found;
    n.row_begin[0] = n.index_base;
    for (int64_t i = 0; i < n.particles; ++i) {
      cbm::collect_neighbours(incidence, corners.data(), count, count, i, found);
      n.row_begin[i + 1] = n.row_begin[i] + static_cast<int64_t>(found.size());
    }
  });
}

int32_t cleave_cbm_bonds(const cleave_network* network, const double* X, int64_t simplex_count,
                         const int64_t* simplices, const int32_t* alive) {
  return guarded("cleave_cbm_bonds", [&] {
    const cleave_network& n = checked(network);
    host_operator(network, 0, n.particles);
    const std::vector<double> position = packed(n, &required(X, "X"));
    const std::vector<int64_t> corners = zero_based(n, simplex_count, simplices);
    with_dimension(n.dimension, [&](auto d) {
      build_bonds<d>(n, position.data(), simplex_count, corners.data(), alive);
    });
  });
}

int32_t cleave_displacement_gradient(const cleave_network* network, int64_t first, int64_t last,
                                     const double* u, double* H) {
  return guarded("cleave_displacement_gradient", [&] {
    const HostOperator g = host_operator(network, first, last);
    required(u, "u");
    required(H, "H");
    with_shape(*network, [&](auto d, auto packed) {
      displacement_gradient<d>(g, vectors<packed>(*network, u), first, last,
                               tensors<packed>(*network, H));
    });
  });
}

int32_t cleave_bond_force(const cleave_network* network, int64_t first, int64_t last,
                          const double* P, double* f) {
  return guarded("cleave_bond_force", [&] {
    const HostOperator g = host_operator(network, first, last);
    required(P, "P");
    required(f, "f");
    with_shape(*network, [&](auto d, auto packed) {
      pair_force<d>(g, tensors<packed>(*network, P), first, last, vectors<packed>(*network, f));
    });
  });
}

int32_t cleave_bond_viscosity(const cleave_network* network, int64_t first, int64_t last,
                              const double* w, const double* x, const double* v, const double* J,
                              double coefficient, double length, double* f) {
  return guarded("cleave_bond_viscosity", [&] {
    const HostOperator g = host_operator(network, first, last);
    if (!(length > 0))
      throw Error(CLEAVE_BAD_ARGUMENT, text("length is ", length, "; allowed: > 0"));
    required(w, "w");
    required(J, "J");
    required(x, "x");
    required(v, "v");
    required(f, "f");
    const BondRate<int64_t> rate{coefficient, length, nullptr, nullptr};
    with_shape(*network, [&](auto d, auto packed) {
      viscous_force_frozen<d>(g, rate, w, vectors<packed>(*network, x),
                              vectors<packed>(*network, v), J, first, last,
                              vectors<packed>(*network, f));
    });
  });
}

int32_t cleave_ramp(int32_t kind, double value, double tau, double t, double* displacement,
                    double* velocity, double* acceleration) {
  return guarded("cleave_ramp", [&] {
    if (kind != CLEAVE_RAMP_DISPLACEMENT && kind != CLEAVE_RAMP_VELOCITY) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text("ramp kind is ", kind, "; see enum cleave_ramp_kind (1, 2)"));
    }
    if (!(tau >= 0)) throw Error(CLEAVE_BAD_ARGUMENT, text("tau is ", tau, "; allowed: >= 0"));
    const Motion m = kind == CLEAVE_RAMP_DISPLACEMENT ? displacement_ramp(value, tau, t)
                                                      : velocity_ramp(value, tau, t);
    if (displacement != nullptr) *displacement = m.displacement;
    if (velocity != nullptr) *velocity = m.velocity;
    if (acceleration != nullptr) *acceleration = m.acceleration;
  });
}

}  // extern "C"
