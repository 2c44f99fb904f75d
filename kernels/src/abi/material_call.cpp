// Material calls in the layout, component order and stress measure of the host. Points go through the
// law in blocks that lie in our layout on the stack, unless the host keeps them so; what the law sees, and
// so the bits, do not depend on how the host keeps them.
#include <cmath>

#include "abi/host_layout.hpp"
#include "abi/material_checks.hpp"
#include "material/stress_dispatch.hpp"
#include "material/stress_measure.hpp"
#include "material/tangent.hpp"

using namespace cleave;
using namespace cleave::abi;

namespace {

constexpr std::int64_t kBlock = 64;

const cleave_material_call& checked(const cleave_material_call* call) {
  const cleave_material_call& c = required(call, "call");
  check_size(c, "cleave_material_call");
  check_rows(c.first, c.last);
  if (!(c.dt >= 0 && std::isfinite(c.dt)))
    throw Error(CLEAVE_BAD_ARGUMENT, text("dt is ", c.dt, "; allowed: 0 (statics) and above"));
  if (!(c.length >= 0 && std::isfinite(c.length)))
    throw Error(CLEAVE_BAD_ARGUMENT, text("length is ", c.length, "; allowed: >= 0"));
  if (c.stress_measure < CLEAVE_STRESS_FIRST_PIOLA || c.stress_measure > CLEAVE_STRESS_KIRCHHOFF) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("stress_measure is ", c.stress_measure,
                                          "; see enum cleave_stress_measure (0 to 4)"));
  }
  check_index_base(c.index_base);
  if (c.tangent_measure < CLEAVE_TANGENT_FIRST_PIOLA ||
      c.tangent_measure > CLEAVE_TANGENT_COROTATED) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("tangent_measure is ", c.tangent_measure,
                                          "; see enum cleave_tangent_measure (0 to 3)"));
  }
  return c;
}

// What the host gave, checked and ready.
struct Host {
  explicit Host(const cleave_material_call* given)
      : call(checked(given)),
        entry(find_material(call.material)),
        law(make_checked(call.material, call.kinematics, call.property_count, call.properties)),
        deformation(host_layout("deformation", call.deformation_point, call.deformation_component,
                                call.deformation_order)),
        stress(host_layout("stress", call.stress_point, call.stress_component, call.stress_order)),
        history(history_arrays(entry, call.history,
                               call.history_point == 0 ? history_count(entry) : call.history_point,
                               call.history_component)) {
    required(call.deformation, "deformation");
  }

  Kinematics kinematics() const { return static_cast<Kinematics>(call.kinematics); }
  template <int D>
  Mat<D> displacement_gradient(std::int64_t q) const {
    Mat<D> h = load<D>(call.deformation, deformation, q);
    if (call.deformation_is_F != 0)
      for (int i = 0; i < D; ++i) h(i, i) -= 1.0;
    return h;
  }
  double length_of(std::int64_t q) const {
    return call.lengths == nullptr ? call.length : call.lengths[call.length_point * q];
  }

  const cleave_material_call& call;
  const MaterialEntry& entry;
  Material law;
  HostLayout deformation, stress;
  HistoryArrays history;
};

HistoryArrays from_point(HistoryArrays history, std::int64_t first) {
  for (std::size_t k = 0; k < kMaxHistory; ++k)
    if (history.base[k] != nullptr) history.base[k] += history.stride[k] * first;
  return history;
}

template <class Value>
void put(Value* array, std::int64_t stride, std::int64_t q, Value value) {
  if (array != nullptr) array[stride * q] = value;
}

// F in three dimensions; plane stress: with the thickness that the law found.
template <int D>
Mat<3> full_deformation(const Host& host, const Mat<D>& h, std::int64_t q) {
  Mat<3> f;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) f(i, j) = h(i, j) + (i == j ? 1.0 : 0.0);
  if constexpr (D == 2) {
    f(2, 2) = with_law(host.law, [&](const auto& law) {
      stress_update::LocalHistory<std::decay_t<decltype(law)>> local(host.history, q);
      return law.thickness_stretch(h, local.pointers);
    });
  }
  return f;
}

// A block of points in the layout of the kernels.
struct Block {
  double h[kTensor * kBlock], p[kTensor * kBlock];
  double energy[kBlock], plastic[kBlock], viscous[kBlock];
  std::int32_t failed[kBlock];
};

template <int D>
void update_block(const Host& host, std::int64_t first, std::int64_t last, Block& block) {
  for (std::int64_t q = first; q < last; ++q) {
    store_tensor(host.displacement_gradient<D>(q), block.h, q - first);
    block.p[kTensor * (q - first) + component(2, 2)] = 0;
  }
  StressArrays arrays;
  arrays.h = block.h;
  arrays.dt = host.call.dt;
  arrays.length = host.call.length;
  if (host.call.lengths != nullptr) {
    arrays.lengths = host.call.lengths + host.call.length_point * first;
    arrays.length_stride = host.call.length_point;
  }
  arrays.history = from_point(host.history, first);
  arrays.p = block.p;
  arrays.energy = block.energy;
  arrays.plastic = block.plastic;
  arrays.viscous = block.viscous;
  arrays.failed = block.failed;
  update_stress(host.law, D, arrays, 0, last - first);
}

// Stress of a point in the measure of the host; false where that measure does not exist.
template <int D>
bool host_stress(const Host& host, const Block& block, std::int64_t q, std::int64_t k, Mat<3>& s) {
  s = Mat<3>{};
  const Mat<D> p = load_tensor<D>(block.p, k);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) s(i, j) = p(i, j);
  if constexpr (D == 2) s(2, 2) = block.p[kTensor * k + component(2, 2)];
  const auto measure = static_cast<cleave_stress_measure>(host.call.stress_measure);
  if (measure == CLEAVE_STRESS_FIRST_PIOLA || block.failed[k] != 0) return true;
  const Mat<3> f = full_deformation<D>(host, load_tensor<D>(block.h, k), q);
  if (!(determinant(f) > 0)) {
    s = Mat<3>{};
    return false;
  }
  s = convert_stress(measure, s, f);
  return true;
}

// Nothing to convert or to move.
bool in_our_layout(const Host& host) {
  const cleave_material_call& c = host.call;
  const auto ours = [](const HostLayout& l) {
    bool same = l.point == kTensor && l.component == 1;
    for (int k = 0; k < 9; ++k) same = same && l.place[k] == k;
    return same;
  };
  return ours(host.deformation) && ours(host.stress) && c.deformation_is_F == 0 &&
         c.stress_measure == CLEAVE_STRESS_FIRST_PIOLA && c.energy_point == 1 &&
         c.plastic_point == 1 && c.viscous_point == 1 && c.failed_point == 1;
}

template <int D>
std::int64_t update_in_place(const Host& host) {
  const cleave_material_call& c = host.call;
  if constexpr (D == 2) std::fill(c.stress + kTensor * c.first, c.stress + kTensor * c.last, 0.0);
  StressArrays arrays;
  arrays.h = c.deformation;
  arrays.dt = c.dt;
  arrays.length = c.length;
  arrays.lengths = c.lengths;
  arrays.length_stride = c.length_point;
  arrays.history = host.history;
  arrays.p = c.stress;
  arrays.energy = c.energy;
  arrays.plastic = c.plastic;
  arrays.viscous = c.viscous;
  arrays.failed = c.failed;
  return update_stress(host.law, D, arrays, c.first, c.last).first_failed;
}

// The first point of the range without an answer, or -1.
template <int D>
std::int64_t update_points(const Host& host) {
  const cleave_material_call& c = host.call;
  if (in_our_layout(host)) return update_in_place<D>(host);
  std::int64_t bad = -1;
  Block block;
  for (std::int64_t first = c.first; first < c.last; first += kBlock) {
    const std::int64_t last = std::min(first + kBlock, c.last);
    update_block<D>(host, first, last, block);
    for (std::int64_t q = first; q < last; ++q) {
      const std::int64_t k = q - first;
      Mat<3> s;
      const bool answered = host_stress<D>(host, block, q, k, s) && block.failed[k] == 0;
      if (!answered && bad < 0) bad = q;
      store(s, c.stress, host.stress, q);
      put(c.energy, c.energy_point, q, answered ? block.energy[k] : 0.0);
      put(c.plastic, c.plastic_point, q, answered ? block.plastic[k] : 0.0);
      put(c.viscous, c.viscous_point, q, answered ? block.viscous[k] : 0.0);
      put(c.failed, c.failed_point, q, answered ? 0 : 1);
    }
  }
  return bad;
}

// A = dP/dF and P at a point; the history is read only.
template <int D>
bool tangent_of_point(const Host& host, std::int64_t q, Tangent<D>& a, Mat<D>& p) {
  const Increment increment{host.call.dt, host.length_of(q)};
  const Mat<D> h = host.displacement_gradient<D>(q);
  return with_law(host.law, [&](const auto& law) {
    stress_update::LocalHistory<std::decay_t<decltype(law)>> local(host.history, q);
    HistoryArrays one;
    for (std::size_t k = 0; k < law.kHistory.size(); ++k) one.base[k] = local.value[k];
    if (!tangent_at<D>(host.law, one, h, increment, 0, a)) return false;
    const auto response = law.respond(h, local.pointers, increment);
    p = response.stress;
    return response.valid;
  });
}

template <int D>
bool host_tangent(const Host& host, std::int64_t q, Tangent<D>& a) {
  Mat<D> p;
  if (!tangent_of_point<D>(host, q, a, p)) return false;
  if constexpr (D == 3) {
    const Mat<3> f = plus_identity(host.displacement_gradient<3>(q));
    const auto measure = static_cast<cleave_tangent_measure>(host.call.tangent_measure);
    if (measure != CLEAVE_TANGENT_FIRST_PIOLA && !(determinant(f) > 0)) return false;
    a = convert_tangent(measure, a, p, f);
  }
  return true;
}

template <int D>
void store_tangent(const Host& host, const HostLayout& column, std::int64_t q,
                   const Tangent<D>& a) {
  const std::int64_t rows = host.stress.components(), columns = column.components();
  double* out = host.call.tangent + host.call.tangent_point * q;
  for (std::int64_t k = 0; k < rows * columns; ++k) out[host.call.tangent_component * k] = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      for (int k = 0; k < D; ++k)
        for (int l = 0; l < D; ++l) {
          if (host.stress.of(i, j) == kAbsent || column.of(k, l) == kAbsent) continue;
          out[host.call.tangent_component * (host.stress.of(i, j) + rows * column.of(k, l))] =
              a(i, j, k, l);
        }
}

void check_stress_order(const Host& host, bool first_piola) {
  if (first_piola && host.stress.repeats) {
    throw Error(
        CLEAVE_BAD_ARGUMENT,
        "stress_order names a place twice; the first Piola-Kirchhoff stress and dP/dF are not "
        "symmetric: choose another stress_measure or tangent_measure, or nine places");
  }
}

void update(const cleave_material_call* call) {
  const Host host(call);
  required(host.call.stress, "stress");
  check_stress_order(host, host.call.stress_measure == CLEAVE_STRESS_FIRST_PIOLA);
  std::int64_t bad = -1;
  with_dimension(dimension_of(host.kinematics()), [&](auto d) { bad = update_points<d>(host); });
  if (bad >= 0) {
    throw Error(
        CLEAVE_BAD_JACOBIAN,
        text("law ", host.entry.name, " has no answer at point ", bad + host.call.index_base,
             "; its stress is zero and its history untouched; see `failed` for others"));
  }
}

}  // namespace

extern "C" {

int32_t cleave_material_call_init(cleave_material_call* call) {
  return guarded("cleave_material_call_init", [&] {
    cleave_material_call& c = required(call, "call");
    c = cleave_material_call{};
    c.size = sizeof(cleave_material_call);
    c.deformation_point = c.stress_point = kTensor;
    c.deformation_component = c.stress_component = c.history_component = c.tangent_component = 1;
    c.energy_point = c.plastic_point = c.viscous_point = c.failed_point = c.length_point = 1;
    c.tangent_point = 81;
    for (std::int64_t k = 0; k < 9; ++k) c.deformation_order[k] = c.stress_order[k] = k;
  });
}

int32_t cleave_material_update(const cleave_material_call* call) {
  return guarded("cleave_material_update", [&] { update(call); });
}

int32_t cleave_material_stress(int32_t material, int32_t kinematics, int64_t property_count,
                               const double* properties, int64_t first, int64_t last,
                               const double* H, double* history, double* P, double* energy,
                               int32_t* failed) {
  return guarded("cleave_material_stress", [&] {
    required(H, "H");
    required(P, "P");
    cleave_material_call call;
    cleave_material_call_init(&call);
    call.material = material;
    call.kinematics = kinematics;
    call.property_count = property_count;
    call.properties = properties;
    call.first = first;
    call.last = last;
    call.deformation = H;
    call.history = history;
    call.stress = P;
    call.energy = energy;
    call.failed = failed;
    update(&call);
  });
}

int32_t cleave_material_tangent(const cleave_material_call* call) {
  return guarded("cleave_material_tangent", [&] {
    const Host host(call);
    const cleave_material_call& c = host.call;
    required(c.tangent, "tangent");
    const bool first_piola = c.tangent_measure == CLEAVE_TANGENT_FIRST_PIOLA;
    check_stress_order(host, first_piola);
    if (!first_piola && host.kinematics() != CLEAVE_3D) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text("tangent_measure ", c.tangent_measure,
                       " needs kinematics CLEAVE_3D; plane strain is F33 = 1 there"));
    }
    const HostLayout& column = first_piola ? host.deformation : host.stress;
    if (first_piola && column.repeats) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  "deformation_order names a place twice; dP/dF needs nine places");
    }
    std::int64_t bad = -1;
    with_dimension(dimension_of(host.kinematics()), [&](auto d) {
      constexpr int D = d;
      for (std::int64_t q = c.first; q < c.last; ++q) {
        Tangent<D> a;
        const bool answered = host_tangent<D>(host, q, a);
        if (!answered) a = Tangent<D>{};
        if (!answered && bad < 0) bad = q;
        put(c.failed, c.failed_point, q, answered ? 0 : 1);
        store_tangent<D>(host, column, q, a);
      }
    });
    if (bad >= 0) {
      throw Error(CLEAVE_BAD_JACOBIAN,
                  text("law ", host.entry.name, " has no tangent at point ", bad + c.index_base,
                       "; zeros stand there; see `failed` for others"));
    }
  });
}

}  // extern "C"
