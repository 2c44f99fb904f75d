// `cleave point`: one material point along a given deformation, to see what a law answers.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cleave::driver {

struct PointRequest {
  std::string law;
  std::vector<std::string> properties;  // "NAME=VALUE"
  std::string kinematics = "3d";        // 3d, plane_strain, plane_stress
  std::string path;                     // CSV: time, F_xx ... F_zz or H_xx ... H_zz
  std::int64_t steps = 1;               // equal steps between two rows of the path
  double length = 0;                    // size of the particle, for laws with shock viscosity
};

// Writes one CSV line a step to `out`: time, F, P, equivalent Kirchhoff stress, energies, history.
// Throws DeckError.
void follow_path(const PointRequest& request, const std::function<void(std::string_view)>& out);

}  // namespace cleave::driver
