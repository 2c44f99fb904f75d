#include "formulation/nosb/nosb.hpp"

#include "formulation/nosb/influence.hpp"

namespace cleave::nosb {

meshless::Kernel CorrespondencePeridynamics::make_kernel(const Body& body) const {
  const ParameterSet& options = body.group("kernel");
  if (options.choice("gradient") == static_cast<int>(meshless::GradientForm::plain)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group kernel of ", body.label(),
                     ": gradient 'plain' belongs to formulation tlsph; nosb is always corrected"));
  }
  const tlsph::CubicSpline spline(body.dimension(), kernel_radius(body));
  const double horizon = tlsph::CubicSpline::kSupport * spline.radius();
  const int choice = options.choice("influence");
  const auto form = choice == 0 ? Influence::spline : static_cast<Influence>(choice - 1);
  meshless::Kernel kernel;
  kernel.omega = InfluenceFunction(form, body.dimension(), horizon);
  kernel.spline = [spline](double distance) { return spline.value(distance); };
  kernel.support = horizon;
  kernel.rule = vanishes_at_horizon(form) ? Radius::open : Radius::closed;
  kernel.gradient = meshless::GradientForm::corrected;
  return kernel;
}

}  // namespace cleave::nosb
