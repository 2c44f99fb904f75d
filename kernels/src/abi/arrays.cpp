// Array calls: no state, the caller's memory, the same kernels as the model.
#include <algorithm>
#include <cmath>

#include "abi/checks.hpp"
#include "core/gradient_operator.hpp"
#include "core/ramp.hpp"
#include "formulation/cbm/bonds.hpp"
#include "formulation/common/viscosity.hpp"

using namespace cleave;
using namespace cleave::abi;

namespace {

using HostOperator = GradientOperator<std::int64_t, std::int64_t>;

}  // namespace

extern "C" {

int32_t cleave_cbm_count_bonds(int32_t dimension, int64_t particles, int64_t simplex_count,
                               const int64_t* simplices, int64_t* row_begin) {
  return guarded("cleave_cbm_count_bonds", [&] {
    check_dimension(dimension);
    check_rows(0, particles);
    check_rows(0, simplex_count);
    if (simplex_count > 0) required(simplices, "simplices");
    required(row_begin, "row_begin");
    const auto incidence =
        make_incidence(particles, simplex_count, simplices, dimension + 1, dimension + 1);
    std::vector<int64_t> found;
    row_begin[0] = 0;
    for (int64_t i = 0; i < particles; ++i) {
      cbm::collect_neighbours(incidence, simplices, dimension + 1, dimension + 1, i, found);
      row_begin[i + 1] = row_begin[i] + static_cast<int64_t>(found.size());
    }
  });
}

int32_t cleave_cbm_bonds(int32_t dimension, int64_t particles, const double* X,
                         int64_t simplex_count, const int64_t* simplices, const int32_t* alive,
                         const int64_t* row_begin, int64_t* neighbour, int64_t* reverse,
                         double* zeta, double* volume) {
  return guarded("cleave_cbm_bonds", [&] {
    check_rows(0, particles);
    check_rows(0, simplex_count);
    required(X, "X");
    required(row_begin, "row_begin");
    required(neighbour, "neighbour");
    required(reverse, "reverse");
    required(zeta, "zeta");
    required(volume, "volume");
    if (simplex_count > 0) required(simplices, "simplices");
    with_dimension(dimension, [&](auto d) {
      constexpr int D = d;
      const auto incidence = make_incidence(particles, simplex_count, simplices, D + 1, D + 1);
      for (int64_t s = 0; s < simplex_count; ++s) {
        if (is_degenerate<D>(X, simplices + (D + 1) * s)) {
          throw Error(CLEAVE_BAD_SIMPLEX,
                      text("simplex ", s, " is degenerate; repair the mesh there"));
        }
      }
      std::vector<int64_t> found;
      for (int64_t i = 0; i < particles; ++i) {
        cbm::collect_neighbours(incidence, simplices, D + 1, D + 1, i, found);
        if (static_cast<int64_t>(found.size()) != row_begin[i + 1] - row_begin[i]) {
          throw Error(CLEAVE_BAD_ARGUMENT, text("row_begin does not fit the simplices at particle ",
                                                i, "; take it from cleave_cbm_count_bonds"));
        }
        std::copy(found.begin(), found.end(), neighbour + row_begin[i]);
      }
      cbm::fill_reverse(particles, row_begin, neighbour, reverse);
      for (int64_t i = 0; i < particles; ++i) {
        cbm::rebuild_row<D>(X, simplices, D + 1, alive, incidence, row_begin, neighbour, i, zeta,
                            volume);
      }
    });
  });
}

int32_t cleave_displacement_gradient(int32_t dimension, int64_t first, int64_t last,
                                     const int64_t* row_begin, const int64_t* neighbour,
                                     const double* zeta, const double* volume, const double* u,
                                     double* H) {
  return guarded("cleave_displacement_gradient", [&] {
    check_rows(first, last);
    const HostOperator g{&required(row_begin, "row_begin"), &required(neighbour, "neighbour"),
                         nullptr, &required(zeta, "zeta"), &required(volume, "volume")};
    required(u, "u");
    check_dimension(dimension);
    std::fill(&required(H, "H") + kTensor * first, H + kTensor * last, 0.0);
    with_dimension(dimension, [&](auto d) { displacement_gradient<d>(g, u, first, last, H); });
  });
}

int32_t cleave_bond_force(int32_t dimension, int64_t first, int64_t last, const int64_t* row_begin,
                          const int64_t* neighbour, const int64_t* reverse, const double* zeta,
                          const double* P, double* f) {
  return guarded("cleave_bond_force", [&] {
    check_rows(first, last);
    const HostOperator g{&required(row_begin, "row_begin"), &required(neighbour, "neighbour"),
                         &required(reverse, "reverse"), &required(zeta, "zeta"), nullptr};
    required(P, "P");
    required(f, "f");
    with_dimension(dimension, [&](auto d) { internal_force<d>(g, P, first, last, f); });
  });
}

int32_t cleave_bond_viscosity(int32_t dimension, int64_t first, int64_t last,
                              const int64_t* row_begin, const int64_t* neighbour,
                              const int64_t* reverse, const double* w, const double* x,
                              const double* v, const double* J, double coefficient, double length,
                              double* f) {
  return guarded("cleave_bond_viscosity", [&] {
    check_rows(first, last);
    if (!(length > 0))
      throw Error(CLEAVE_BAD_ARGUMENT, text("length is ", length, "; allowed: > 0"));
    const HostOperator g{&required(row_begin, "row_begin"), &required(neighbour, "neighbour"),
                         &required(reverse, "reverse"), nullptr, nullptr};
    required(w, "w");
    required(x, "x");
    required(v, "v");
    required(J, "J");
    required(f, "f");
    const BondRate<int64_t> rate{coefficient / length, length, nullptr, nullptr};
    with_dimension(dimension,
                   [&](auto d) { viscous_force_frozen<d>(g, rate, w, x, v, J, first, last, f); });
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
