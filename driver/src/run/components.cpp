#include "run/components.hpp"

namespace cleave::driver {

std::vector<Component> components_of(std::int64_t components, bool plane) {
  if (components == 1) return {{0, ""}};
  std::vector<Component> list;
  for (std::int64_t k = 0; k < components; ++k) {
    if (components == 3) {
      list.push_back({k, std::string("_") + "xyz"[k]});
    } else if (components == 9) {
      const std::int64_t i = k % 3, j = k / 3;
      const bool out_of_plane = (i == 2) != (j == 2);
      if (!(plane && out_of_plane)) list.push_back({k, std::string("_") + "xyz"[i] + "xyz"[j]});
    } else {
      list.push_back({k, "_" + std::to_string(k + 1)});
    }
  }
  return list;
}

}  // namespace cleave::driver
