#include "formulation/tlsph/tlsph.hpp"

#include "formulation/tlsph/kernel.hpp"

namespace cleave::tlsph {

meshless::Kernel TotalLagrangianSph::make_kernel(const Body& body) const {
  const ParameterSet& options = body.group("kernel");
  if (options.choice("influence") != 0) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group kernel of ", body.label(),
                     ": influence belongs to formulation nosb; tlsph weighs by the slope of its "
                     "kernel, leave the key out"));
  }
  const CubicSpline spline(body.dimension(), kernel_radius(body));
  meshless::Kernel kernel;
  // grad w = omega X with omega = -w'(q)/(r |X|).
  kernel.omega = [spline](double distance) { return -spline.slope(distance) / distance; };
  kernel.spline = [spline](double distance) { return spline.value(distance); };
  kernel.support = CubicSpline::kSupport * spline.radius();
  kernel.rule = Radius::open;
  kernel.gradient = static_cast<meshless::GradientForm>(options.choice("gradient"));
  return kernel;
}

}  // namespace cleave::tlsph
