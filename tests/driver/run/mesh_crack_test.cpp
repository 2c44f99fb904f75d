// Bodies from a mesh file: named groups, meshed cracks, several bodies of one mesh.
#include "run/checkpoint_files.hpp"
#include "scene/scene.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Index = std::int64_t;
using MeshFile = RunDirectory;

// Gmsh MSH 2.2 of 4 x 2 unit cells: groups "lower" and "upper" of triangles, "notch" of the lines from
// the left edge to the middle, "left" and "right" of the lines of the sides; node 99 is used by no cell.
std::string plate_mesh() {
  const BodyGeometry cells = unit_cells(4, 2);
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n2 1 \"lower\"\n2 2 \"upper\"\n"
       << "1 3 \"notch\"\n1 4 \"left\"\n1 5 \"right\"\n$EndPhysicalNames\n$Nodes\n16\n99 7 7 0\n";
  for (Index i = 0; i < 15; ++i) {
    text << i + 1 << ' ' << cells.X[static_cast<std::size_t>(3 * i)] << ' '
         << cells.X[static_cast<std::size_t>(3 * i + 1)] << " 0\n";
  }
  text << "$EndNodes\n$Elements\n22\n";
  const Index lines[6][3] = {{3, 6, 7}, {3, 8, 7}, {4, 1, 6}, {4, 6, 11}, {5, 5, 10}, {5, 10, 15}};
  Index number = 0;
  for (const auto& line : lines) {
    text << ++number << " 1 2 " << line[0] << " 1 " << line[1] << ' ' << line[2] << '\n';
  }
  for (std::size_t s = 0; s < cells.simplices.size(); s += 3) {
    text << ++number << " 2 2 " << (s < cells.simplices.size() / 2 ? 1 : 2) << " 1";
    for (std::size_t a = 0; a < 3; ++a) text << ' ' << cells.simplices[s + a] + 1;
    text << '\n';
  }
  text << "$EndElements\n";
  return text.str();
}

class Meshed : public MeshFile {
 protected:
  void SetUp() override {
    MeshFile::SetUp();
    std::ofstream(path("plate.msh")) << plate_mesh();
  }
  Deck meshed(const std::string& groups) const {
    return deck("t_end=2", "&mesh file='" + path("plate.msh") + "' /\n" + kUnitMaterial + groups);
  }
};

const std::string kWhole = "&body name='plate' kinematics='plane_stress' material='unit' /\n";

std::vector<double> field(const Scene& scene, const char* name) {
  return scene.model().reals(0, name);
}

TEST_F(Meshed, UnusedNodesAreLeftOutAndNumbersKept) {
  const Deck whole = meshed(kWhole);
  const Scene scene = Scene::from_deck(whole, 1);
  EXPECT_EQ(scene.bodies()[0].particles(), 15);
  EXPECT_EQ(scene.bodies()[0].point_ids.front(), 1);
  EXPECT_EQ(scene.bodies()[0].find_group("right")->particles, (std::vector<Index>{4, 9, 14}));
}

TEST_F(Meshed, SplitCrackOpensWithoutLosingVolume) {
  const Deck split = meshed(kWhole + "&precrack mode='split' shape='group' set='notch' /\n");
  const Scene scene = Scene::from_deck(split, 1);
  EXPECT_EQ(scene.bodies()[0].particles(), 17);
  EXPECT_EQ(scene.model().counts(0).inert, 0);
  double volume = 0;
  for (const double v : field(scene, "volume")) volume += v;
  EXPECT_DOUBLE_EQ(volume, 8.0);
}

TEST_F(Meshed, DeletedCrackTakesTheTrianglesOnOneSide) {
  const Deck cut = meshed(kWhole + "&precrack shape='group' set='notch' /\n");
  const Scene scene = Scene::from_deck(cut, 1);
  EXPECT_EQ(scene.bodies()[0].particles(), 15);
  double volume = 0;
  for (const double v : field(scene, "volume")) volume += v;
  EXPECT_LT(volume, 8.0 - 1.5);
  EXPECT_GT(volume, 8.0 - 3.5);
}

TEST_F(Meshed, GroupsBecomeBodiesOfTheirOwn) {
  const Deck two = meshed(
      "&body name='a' set='lower' kinematics='plane_stress' material='unit' /\n"
      "&body name='b' set='upper' kinematics='plane_stress' material='unit' translate=0,1,0 /\n"
      "&load kind='displacement' set='left' directions='x' /\n");
  EXPECT_EQ(run_deck(two, quiet), 0);
  const Scene scene = Scene::from_deck(two, 1);
  EXPECT_EQ(scene.bodies()[0].particles(), 10);
  EXPECT_EQ(scene.bodies()[1].X[1], 2.0);
  EXPECT_EQ(scene.bodies()[1].point_ids.front(), 6);
}

// The mesh file is gone and the particles of the split crack come from the checkpoint.
TEST_F(Meshed, RestartDoesNotNeedTheMesh) {
  const std::string groups = kWhole +
                             "&precrack mode='split' shape='group' set='notch' /\n"
                             "&load kind='velocity' set='right' directions='x' value=0.01 /\n"
                             "&load kind='pressure' set='notch' value=1e-3 /\n"
                             "&checkpoint every_steps=1 keep=10 /\n&history every_steps=1 /\n";
  ASSERT_EQ(run_deck(meshed(groups), quiet), 0);
  const std::string history = file_bytes(path("case.history.csv"));
  const std::string results = file_bytes(path("case.exo"));
  std::filesystem::remove(path("plate.msh"));
  EXPECT_EQ(restart_run(path("case.1.checkpoint.nc"), "", quiet), 0);
  EXPECT_EQ(file_bytes(path("case.history.csv")), history);
  EXPECT_EQ(file_bytes(path("case.exo")), results);
}

TEST_F(Meshed, MistakesNameWhatTheMeshHas) {
  const auto said = [&](const std::string& groups) {
    return message_of<DeckError>([&] { Scene::from_deck(meshed(groups), 1); });
  };
  EXPECT_TRUE(has(said("&body set='left' kinematics='plane_stress' material='unit' /\n"),
                  "'left' is not a group of triangles of the mesh; known groups of triangles: "
                  "lower, upper"));
  EXPECT_TRUE(has(said(kWhole + "&precrack mode='split' shape='group' set='lower' /\n"),
                  "'lower' is not a mesh group of lines; known: left, notch, right"));
  EXPECT_TRUE(has(said(kWhole + "&precrack mode='split' shape='group' set='left' /\n"),
                  "separates nothing in body 'plate'"));
  EXPECT_TRUE(has(said("&body kinematics='3d' material='unit' /\n"), "the mesh has no tetrahedra"));
}

TEST_F(Meshed, MissingMeshFileSaysWhichOne) {
  std::filesystem::remove(path("plate.msh"));
  std::string said;
  try {
    Scene::from_deck(meshed(kWhole), 1);
  } catch (const DeckError& error) {
    said = error.what();
  }
  EXPECT_TRUE(has(said, path("plate.msh")));
  EXPECT_TRUE(has(said, "case.nml:2:"));
}

}  // namespace
}  // namespace cleave::driver::testing
