// The step of the driver: no allocation, whatever is prescribed.
#include "run/simulation.hpp"
#include "support.hpp"
#include "support/allocations.hpp"

namespace cleave::driver::testing {
namespace {

using Step = RunDirectory;

TEST_F(Step, DoesNotAllocate) {
  const Deck loaded =
      deck("t_end=50", std::string(kUnitPlate) + kUnitMaterial +
                           "&fracture critical_strain=1 /\n&viscosity beta=0.5 length=1 /\n"
                           "&load kind='displacement' set='ymin' directions='xy' /\n"
                           "&load kind='velocity' set='ymax' directions='y' value=1e-3 "
                           "curve='smooth' ramp=10 /\n"
                           "&load kind='pressure' set='xmax' value=1e-4 curve='linear' ramp=10 /\n"
                           "&load kind='force' set='xmin' directions='x' value=1e-4 curve='table' "
                           "times=0,10 factors=0,1 /\n");
  Scene scene = Scene::from_deck(loaded, 1);
  const TimeStep step = choose_time_step(scene);
  const Stepping stepping(loaded);
  stepping.start(scene, step.clock.dt);
  for (std::int64_t n = 0; n < 3; ++n) stepping.step(scene, step.clock, n);
  const long before = cleave::test::allocations();
  for (std::int64_t n = 3; n < 10; ++n) stepping.step(scene, step.clock, n);
  EXPECT_EQ(cleave::test::allocations() - before, 0);
}

}  // namespace
}  // namespace cleave::driver::testing
