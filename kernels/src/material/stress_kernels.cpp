// The stress update of every law in lanes; compiled once for each instruction set, see
// core/instruction_set.hpp.
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "material/stress.hpp"

namespace cleave {

namespace {

// The law is copied from its bytes: the object belongs to another instruction set's namespace.
template <int D, class Law>
StressResult update(const void* law, const StressArrays& arrays, std::int64_t first,
                    std::int64_t last) {
  static_assert(std::is_trivially_copyable_v<Law>);
  alignas(Law) std::byte bytes[sizeof(Law)];
  std::memcpy(bytes, law, sizeof bytes);
  return update_stress_in_lanes<D>(*reinterpret_cast<const Law*>(bytes), arrays, first, last);
}

template <int D, class Law>
constexpr cleave_call::StressKernel kernel() {
  if constexpr (LaneLaw<Law>) return &update<D, Law>;
  return nullptr;
}

}  // namespace

extern const cleave_call::StressKernels kStressKernels;
constinit const cleave_call::StressKernels kStressKernels = {{
#define CLEAVE_MATERIAL(name, value, type, title, source) {kernel<2, type>(), kernel<3, type>()},
#include "cleave/tables/materials.def"
}};

}  // namespace cleave
