#include "command/export_fields.hpp"

#include <gtest/gtest.h>

#include "deck/deck.hpp"

namespace cleave::driver {
namespace {

std::vector<io::ResultVariable> variables(std::initializer_list<const char*> names) {
  std::vector<io::ResultVariable> list;
  for (const char* name : names) list.push_back({name, "mm", ""});
  return list;
}

// "displacement(x,y,z) damage"
std::string text(const std::vector<ExportField>& fields) {
  std::string all;
  for (const ExportField& field : fields) {
    all += (all.empty() ? "" : " ") + field.name;
    for (std::size_t c = 0; c < field.components.size(); ++c) {
      all += (c == 0 ? "(" : ",") + field.components[c];
    }
    if (!field.components.empty()) all += ')';
  }
  return all;
}

TEST(ExportFields, ComponentsAreJoined) {
  const auto joined = [](std::initializer_list<const char*> names) {
    return text(joined_fields(variables(names)));
  };
  EXPECT_EQ(joined({"DISPLX", "DISPLY", "DISPLZ", "damage"}), "displacement(x,y,z) damage");
  EXPECT_EQ(joined({"DISPLX", "DISPLY", "velocity_x", "velocity_y"}),
            "displacement(x,y) velocity(x,y)");
  EXPECT_EQ(joined({"a_xx", "a_yx", "a_xy", "b_xx", "a_yy"}), "a(xx,yx,xy) b_xx a_yy");
  EXPECT_EQ(joined({"h_1", "h_2", "h_10", "u_x", "u_xx"}), "h(1,2,10) u_x u_xx");
  EXPECT_EQ(joined({"h_3", "DISPL", "DISPLXY", "_x", "x", "v_", "v_xyz", "plastic_strain"}),
            "h_3 DISPL DISPLXY _x x v_ v_xyz plastic_strain");
  EXPECT_EQ(joined({}), "");
}

TEST(ExportFields, ChosenByNameOfFieldOrComponent) {
  io::StoredResults results;
  results.path = "a.exo";
  results.nodal = variables({"DISPLX", "DISPLY", "DISPLZ", "stress_xx", "stress_xy", "damage"});
  results.element = variables({"status", "damage"});
  const auto chosen = [&](const std::vector<std::string>& names) {
    const ExportFields fields = chosen_fields(results, names);
    return text(fields.nodal) + " | " + text(fields.element);
  };
  EXPECT_EQ(chosen({}), "displacement(x,y,z) stress(xx,xy) damage | status damage");
  EXPECT_EQ(chosen({"damage"}), "damage | damage");
  EXPECT_EQ(chosen({"status", "displacement", "status"}), "displacement(x,y,z) | status");
  EXPECT_EQ(chosen({"stress_xy", "DISPLZ", "displacement_z"}), "stress_xy displacement_z | ");
  EXPECT_EQ(chosen_fields(results, {"stress_xy"}).nodal[0].variables, std::vector<std::size_t>{4});
  try {
    chosen({"stres"});
    FAIL() << "an unknown field was chosen";
  } catch (const DeckError& error) {
    EXPECT_STREQ(error.what(),
                 "a.exo: there is no field \"stres\"; did you mean \"stress\"? Fields of "
                 "particles: displacement, stress, damage. Fields of elements: status, damage. "
                 "The key `fields` of &output says what a run writes.");
  }
}

}  // namespace
}  // namespace cleave::driver
