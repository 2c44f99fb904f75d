#include "run/stop_file.hpp"

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;

class StopFiles : public RunDirectory {
 protected:
  Deck named(const std::string& name) const {
    return deck("t_end=1", std::string(kUnitPlate) + kUnitMaterial + "&checkpoint stop_file='" +
                               name + "' /\n");
  }
  StopFile of(const std::string& name) const {
    const Deck made = named(name);
    return {made, FileNames::of_deck(made)};
  }
  std::string refusal(const std::string& name) const {
    return message_of<DeckError>([&] { of(name); });
  }
};

TEST_F(StopFiles, LookedForOnceASecond) {
  StopFile file = of("case.stop");
  EXPECT_FALSE(file.appeared(5.0));
  std::ofstream(path("case.stop")) << "";
  EXPECT_FALSE(file.appeared(5.9));
  EXPECT_TRUE(file.appeared(6.0));
  file.remove();
  EXPECT_FALSE(fs::exists(path("case.stop")));
}

TEST_F(StopFiles, NoNameIsNoFile) {
  StopFile file = of("");
  EXPECT_FALSE(file.appeared(5.0));  // the directory itself is there
  file.remove();
  EXPECT_TRUE(fs::exists(directory));
}

TEST_F(StopFiles, LeftoverIsRefused) {
  std::ofstream(path("case.stop")) << "";
  const Deck made = named("case.stop");
  const std::string said = message_of<DeckError>(
      [&] { StopFile(made, FileNames::of_deck(made)).refuse_leftover(made); });
  EXPECT_TRUE(has(said, "is there already"));
  EXPECT_TRUE(has(said, path("case.stop")));
  EXPECT_TRUE(fs::exists(path("case.stop")));
}

// Whatever is removed as a stop file must not be worth anything.
TEST_F(StopFiles, NamesOfOtherFilesAreRefused) {
  for (const char* name :
       {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc", "case.resolved.nml",
        "case.10.checkpoint.nc", "case.lastgood.checkpoint.nc"}) {
    EXPECT_TRUE(
        has(refusal(name), "is a file of the run itself; give another name, as 'case.stop'"));
  }
  for (const char* name : {"../case.stop", "/case.stop", ".", ".."}) {
    EXPECT_TRUE(has(refusal(name), "is a path; give a name"));
  }
}

}  // namespace
}  // namespace cleave::driver::testing
