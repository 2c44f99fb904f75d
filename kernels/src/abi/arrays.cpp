// Array calls: no state, the caller's memory, the same kernels as the model.
#include <algorithm>
#include <cmath>

#include "abi/guard.hpp"
#include "core/gradient_operator.hpp"
#include "core/ramp.hpp"
#include "formulation/cbm/bonds.hpp"
#include "formulation/cbm/viscosity.hpp"
#include "material/stress.hpp"

using namespace cleave;
using namespace cleave::abi;
using cleave::cbm::BondRate;

namespace {

using HostOperator = GradientOperator<std::int64_t, std::int64_t>;

void check_dimension(std::int32_t dimension) {
  if (dimension != 2 && dimension != 3) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("dimension is ", dimension, "; allowed: 2, 3"));
  }
}

void check_rows(std::int64_t first, std::int64_t last) {
  if (first < 0 || last < first) {
    throw Error(CLEAVE_BAD_RANGE,
                text("range ", first, " <= i < ", last, " is not a range of particles"));
  }
}

// F applied with D as a compile-time number.
template <class F>
void with_dimension(std::int32_t dimension, const F& f) {
  check_dimension(dimension);
  if (dimension == 2) {
    f(std::integral_constant<int, 2>{});
  } else {
    f(std::integral_constant<int, 3>{});
  }
}

void check_kinematics(std::int32_t kinematics) {
  if (kinematics < CLEAVE_3D || kinematics > CLEAVE_PLANE_STRESS) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("kinematics is ", kinematics, "; see enum cleave_kinematics (1 to 3)"));
  }
}

Material make_checked(std::int32_t material, std::int32_t kinematics, std::int64_t count,
                      const double* properties) {
  check_kinematics(kinematics);
  const MaterialEntry& entry = find_material(material);
  if (count != static_cast<std::int64_t>(entry.parameters.size())) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("law ", entry.name, " takes ", entry.parameters.size(), " properties, not ",
                     count, "; see cleave_parameter_get"));
  }
  required(properties, "properties");
  ParameterSet checked(text("material law ", entry.name), entry.parameters);
  for (std::size_t k = 0; k < entry.parameters.size(); ++k)
    checked.set_real(entry.parameters[k].name, properties[k]);
  return entry.make(checked.values(), static_cast<Kinematics>(kinematics));
}

// History packed as (nh,n): all variables of a point one after another.
HistoryArrays packed_history(const MaterialEntry& entry, double* history) {
  HistoryArrays arrays;
  int total = 0;
  for (const auto& h : entry.history) total += h.components;
  int offset = 0;
  for (std::size_t k = 0; k < entry.history.size(); ++k) {
    arrays.base[k] = &required(history, "history") + offset;
    arrays.stride[k] = total;
    offset += entry.history[k].components;
  }
  return arrays;
}

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
        cbm::make_incidence(particles, simplex_count, simplices, dimension + 1, dimension + 1);
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
      const auto incidence = cbm::make_incidence(particles, simplex_count, simplices, D + 1, D + 1);
      for (int64_t s = 0; s < simplex_count; ++s) {
        if (cbm::is_degenerate<D>(X, simplices + (D + 1) * s)) {
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
    with_dimension(dimension, [&](auto d) {
      cbm::viscous_force_frozen<d>(g, rate, w, x, v, J, first, last, f);
    });
  });
}

int32_t cleave_material_stress(int32_t material, int32_t kinematics, int64_t property_count,
                               const double* properties, int64_t first, int64_t last,
                               const double* H, double* history, double* P, double* energy,
                               int32_t* failed) {
  int64_t bad = -1;
  const int32_t status = guarded("cleave_material_stress", [&] {
    check_rows(first, last);
    required(H, "H");
    const Material made = make_checked(material, kinematics, property_count, properties);
    StressArrays arrays;
    arrays.h = H;
    arrays.history = packed_history(find_material(material), history);
    arrays.p = P;
    arrays.energy = energy;
    arrays.failed = failed;
    std::fill(&required(P, "P") + kTensor * first, P + kTensor * last, 0.0);
    with_dimension(dimension_of(static_cast<Kinematics>(kinematics)), [&](auto d) {
      bad = with_law(made, [&](const auto& law) {
        return update_stress<d>(law, arrays, first, last).first_failed;
      });
    });
    if (bad >= 0) {
      throw Error(CLEAVE_BAD_JACOBIAN,
                  text("law ", find_material(material).name, " has no answer at point ", bad,
                       "; its stress is zero and its history untouched; see `failed` for others"));
    }
  });
  return status;
}

int32_t cleave_material_history_count(int32_t material, int64_t* count) {
  return guarded("cleave_material_history_count", [&] {
    int64_t n = 0;
    for (const auto& h : find_material(material).history) n += h.components;
    required(count, "count") = n;
  });
}

int32_t cleave_material_wave_speed(int32_t material, int32_t kinematics, int64_t property_count,
                                   const double* properties, double* speed) {
  return guarded("cleave_material_wave_speed", [&] {
    const Material made = make_checked(material, kinematics, property_count, properties);
    required(speed, "speed") = with_law(made, [](const auto& law) { return law.wave_speed(); });
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
