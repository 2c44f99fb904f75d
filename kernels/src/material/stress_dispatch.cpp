#include "material/stress_dispatch.hpp"

#include "core/instruction_set.hpp"
#include "material/stress.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::StressKernels, kStressKernels)

namespace cleave {

StressResult update_stress(const Material& material, int dimension, const StressArrays& arrays,
                           std::int64_t first, std::int64_t last) {
  return with_law(material, [&](const auto& law) {
    if constexpr (LaneLaw<std::decay_t<decltype(law)>>) {
      if (law.in_lanes()) {
        const auto& kernels = CLEAVE_KERNELS(kStressKernels).chosen();
        return kernels.update[material.index() - 1][dimension - 2](&law, arrays, first, last);
      }
    }
    return dimension == 2 ? update_stress_pointwise<2>(law, arrays, first, last)
                          : update_stress_pointwise<3>(law, arrays, first, last);
  });
}

}  // namespace cleave
