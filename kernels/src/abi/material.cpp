// Array calls of the material laws: no state, the caller's memory in the caller's layout.
#include <algorithm>
#include <cmath>

#include "abi/checks.hpp"
#include "material/stress.hpp"
#include "material/tangent.hpp"

using namespace cleave;
using namespace cleave::abi;

namespace {

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

std::int64_t history_count(const MaterialEntry& entry) {
  std::int64_t total = 0;
  for (const auto& h : entry.history) total += h.components;
  return total;
}

// All variables of a point one after another; point and component strides in doubles.
HistoryArrays history_arrays(const MaterialEntry& entry, double* history, std::int64_t point,
                             std::int64_t component) {
  HistoryArrays arrays;
  arrays.component_stride = component;
  std::int64_t offset = 0;
  for (std::size_t k = 0; k < entry.history.size(); ++k) {
    arrays.base[k] = &required(history, "history") + component * offset;
    arrays.stride[k] = point;
    offset += entry.history[k].components;
  }
  return arrays;
}

// Runs the update over a range; throws BAD_JACOBIAN at the end if a point failed.
void run(const MaterialEntry& entry, const Material& made, Kinematics kinematics,
         const StressArrays& arrays, std::int64_t first, std::int64_t last) {
  std::int64_t bad = -1;
  with_dimension(dimension_of(kinematics), [&](auto d) {
    bad = with_law(made, [&](const auto& law) {
      return update_stress<d>(law, arrays, first, last).first_failed;
    });
  });
  if (bad >= 0) {
    throw Error(CLEAVE_BAD_JACOBIAN,
                text("law ", entry.name, " has no answer at point ", bad,
                     "; its stress is zero and its history untouched; see `failed` for others"));
  }
}

// ---- the call in the host's layout

const cleave_material_call& checked(const cleave_material_call* call) {
  if (required(call, "call").size != static_cast<std::int64_t>(sizeof(cleave_material_call))) {
    throw Error(CLEAVE_ABI_MISMATCH,
                text("cleave_material_call has size ", call->size, ", this library expects ",
                     sizeof(cleave_material_call), "; call cleave_material_call_init first"));
  }
  check_rows(call->first, call->last);
  if (!(call->dt >= 0 && std::isfinite(call->dt)))
    throw Error(CLEAVE_BAD_ARGUMENT, text("dt is ", call->dt, "; allowed: 0 (statics) and above"));
  if (!(call->length >= 0 && std::isfinite(call->length)))
    throw Error(CLEAVE_BAD_ARGUMENT, text("length is ", call->length, "; allowed: >= 0"));
  return *call;
}

TensorLayout layout(const char* name, std::int64_t point, std::int64_t component,
                    const std::int64_t (&order)[9]) {
  TensorLayout l;
  l.point = point;
  bool taken[9] = {};
  for (std::size_t k = 0; k < 9; ++k) {
    const std::int64_t place = order[k];
    if (place < 0 || place > 8 || taken[place]) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(name, "_order[", k, "] is ", place,
                       "; the nine entries are the numbers 0 to 8, each once: the places of 11 21 "
                       "31 12 22 32 13 23 33"));
    }
    taken[place] = true;
    l.component[k] = component * place;
  }
  return l;
}

StressArrays host_arrays(const cleave_material_call& call, const MaterialEntry& entry) {
  StressArrays a;
  a.h = &required(call.deformation, "deformation");
  a.h_layout = layout("deformation", call.deformation_point, call.deformation_component,
                      call.deformation_order);
  a.h_is_f = call.deformation_is_F != 0;
  a.dt = call.dt;
  a.length = call.length;
  a.history = history_arrays(entry, call.history,
                             call.history_point == 0 ? history_count(entry) : call.history_point,
                             call.history_component);
  a.p = call.stress;
  a.p_layout = layout("stress", call.stress_point, call.stress_component, call.stress_order);
  a.energy = call.energy;
  a.energy_stride = call.energy_point;
  a.plastic = call.plastic;
  a.plastic_stride = call.plastic_point;
  a.failed = call.failed;
  a.failed_stride = call.failed_point;
  return a;
}

// One point: F - I in, A out, the history read only.
template <int D>
bool tangent_of_point(const Material& made, const StressArrays& a, std::int64_t q, Tangent<D>& t) {
  return with_law(made, [&](const auto& law) {
    Mat<D> h;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        h(i, j) = a.h[a.h_layout.place(q, i, j)] - (a.h_is_f && i == j ? 1.0 : 0.0);
    stress_update::LocalHistory<std::decay_t<decltype(law)>> local(a.history, q);
    HistoryArrays one;
    for (std::size_t k = 0; k < law.kHistory.size(); ++k) one.base[k] = local.value[k];
    return tangent_at<D>(made, one, h, a.template increment<D>(q), 0, t);
  });
}

}  // namespace

extern "C" {

int32_t cleave_material_stress(int32_t material, int32_t kinematics, int64_t property_count,
                               const double* properties, int64_t first, int64_t last,
                               const double* H, double* history, double* P, double* energy,
                               int32_t* failed) {
  return guarded("cleave_material_stress", [&] {
    check_rows(first, last);
    required(H, "H");
    const Material made = make_checked(material, kinematics, property_count, properties);
    const MaterialEntry& entry = find_material(material);
    StressArrays arrays;
    arrays.h = H;
    arrays.history = history_arrays(entry, history, history_count(entry), 1);
    arrays.p = P;
    arrays.energy = energy;
    arrays.failed = failed;
    std::fill(&required(P, "P") + kTensor * first, P + kTensor * last, 0.0);
    run(entry, made, static_cast<Kinematics>(kinematics), arrays, first, last);
  });
}

int32_t cleave_material_call_init(cleave_material_call* call) {
  return guarded("cleave_material_call_init", [&] {
    cleave_material_call& c = required(call, "call");
    c = cleave_material_call{};
    c.size = sizeof(cleave_material_call);
    c.deformation_point = c.stress_point = kTensor;
    c.deformation_component = c.stress_component = c.history_component = c.tangent_component = 1;
    c.energy_point = c.plastic_point = c.failed_point = 1;
    c.tangent_point = 81;
    for (std::int64_t k = 0; k < 9; ++k) c.deformation_order[k] = c.stress_order[k] = k;
  });
}

int32_t cleave_material_update(const cleave_material_call* call) {
  return guarded("cleave_material_update", [&] {
    const cleave_material_call& c = checked(call);
    const Material made = make_checked(c.material, c.kinematics, c.property_count, c.properties);
    const MaterialEntry& entry = find_material(c.material);
    const StressArrays arrays = host_arrays(c, entry);
    required(arrays.p, "stress");
    if (c.kinematics != CLEAVE_3D) {
      for (std::int64_t q = c.first; q < c.last; ++q)
        for (const std::int64_t place : arrays.p_layout.component)
          arrays.p[arrays.p_layout.point * q + place] = 0;
    }
    run(entry, made, static_cast<Kinematics>(c.kinematics), arrays, c.first, c.last);
  });
}

int32_t cleave_material_tangent(const cleave_material_call* call) {
  return guarded("cleave_material_tangent", [&] {
    const cleave_material_call& c = checked(call);
    const Material made = make_checked(c.material, c.kinematics, c.property_count, c.properties);
    const MaterialEntry& entry = find_material(c.material);
    const StressArrays arrays = host_arrays(c, entry);
    required(c.tangent, "tangent");
    std::int64_t bad = -1;
    with_dimension(dimension_of(static_cast<Kinematics>(c.kinematics)), [&](auto d) {
      constexpr int D = d;
      for (std::int64_t q = c.first; q < c.last; ++q) {
        Tangent<D> t;
        const bool valid = tangent_of_point<D>(made, arrays, q, t);
        if (!valid && bad < 0) bad = q;
        if (c.failed != nullptr) c.failed[c.failed_point * q] = valid ? 0 : 1;
        double* out = c.tangent + c.tangent_point * q;
        for (std::int64_t k = 0; k < 81; ++k) out[c.tangent_component * k] = 0;
        if (!valid) continue;
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j)
            for (int k = 0; k < D; ++k)
              for (int l = 0; l < D; ++l)
                out[c.tangent_component *
                    (c.stress_order[component(i, j)] + 9 * c.deformation_order[component(k, l)])] =
                    t(i, j, k, l);
      }
    });
    if (bad >= 0) {
      throw Error(CLEAVE_BAD_JACOBIAN, text("law ", entry.name, " has no tangent at point ", bad,
                                            "; zeros stand there; see `failed` for others"));
    }
  });
}

int32_t cleave_material_history_count(int32_t material, int64_t* count) {
  return guarded("cleave_material_history_count",
                 [&] { required(count, "count") = history_count(find_material(material)); });
}

int32_t cleave_material_wave_speed(int32_t material, int32_t kinematics, int64_t property_count,
                                   const double* properties, double* speed) {
  return guarded("cleave_material_wave_speed", [&] {
    const Material made = make_checked(material, kinematics, property_count, properties);
    required(speed, "speed") = with_law(made, [](const auto& law) { return law.wave_speed(); });
  });
}

}  // extern "C"
