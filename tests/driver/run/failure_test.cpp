// A run that fails: what is said, and the last good state.
#include <cmath>

#include "io/archive.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Failure = RunDirectory;

// Far above the stable step a free plate with a velocity field explodes.
const std::string kExplodes = std::string(kUnitPlate) + kUnitMaterial +
                              "&load kind='velocity' set='ymax' directions='y' value=0.1 /\n"
                              "&load kind='displacement' set='ymin' directions='y' /\n";

TEST_F(Failure, SaysWhenAndWritesTheLastGoodState) {
  const std::string said =
      message_of<RunError>([&] { run("t_end=4000 time_step=4 step_check='warn'", kExplodes); });
  EXPECT_TRUE(has(said, "the run failed in step "));
  EXPECT_TRUE(has(said, "time "));
  EXPECT_TRUE(has(said, "The last good state, after step "));
  EXPECT_TRUE(has(said, path("case.lastgood.checkpoint.nc")));
  const io::Archive archive = io::read_archive(path("case.lastgood.checkpoint.nc"));
  const auto* velocity = archive.find_array("plate/velocity");
  ASSERT_NE(velocity, nullptr);
  for (const double v : std::get<std::vector<double>>(velocity->data)) {
    ASSERT_TRUE(std::isfinite(v));
  }
}

TEST_F(Failure, LastGoodStateCanBeContinued) {
  message_of<RunError>([&] { run("t_end=4000 time_step=4 step_check='warn'", kExplodes); });
  // the same deck fails in the same way again: the state was complete
  const std::string again =
      message_of<RunError>([&] { restart_run(path("case.lastgood.checkpoint.nc"), "", quiet); });
  EXPECT_TRUE(has(again, "the run failed in step "));
}

}  // namespace
}  // namespace cleave::driver::testing
