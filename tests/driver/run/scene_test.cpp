// What a scene refuses, and what it says.
#include "scene/scene.hpp"

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Refused = RunDirectory;

const std::string kPlate = std::string(kUnitPlate) + kUnitMaterial;

TEST_F(Refused, OverlappingPrescriptionsNameBothLoadsAndTheParticle) {
  const std::string said = message_of<DeckError>([&] {
    run("t_end=1", kPlate +
                       "&load name='left' kind='displacement' set='xmin' directions='xy' /\n"
                       "&load name='low' kind='velocity' set='ymin' directions='y' value=1 /\n");
  });
  EXPECT_TRUE(has(said, "loads 'left' and 'low' both prescribe direction y of particle 1"));
  EXPECT_TRUE(has(said, "at (0, 0, 0)"));
  EXPECT_TRUE(has(said, "case.nml:6:"));
}

TEST_F(Refused, SetsThatDoNotExistNameTheKnownOnes) {
  const std::string said = message_of<DeckError>(
      [&] { run("t_end=1", kPlate + "&load kind='displacement' set='ymaxx' directions='y' /\n"); });
  EXPECT_TRUE(has(said, "no particle is in a set 'ymaxx'"));
  EXPECT_TRUE(has(said, "did you mean 'ymax'?"));
  EXPECT_TRUE(has(said, "xmin"));
}

TEST_F(Refused, EmptyZoneSaysWhereTheBodyIs) {
  const std::string said =
      message_of<DeckError>([&] { run("t_end=1", kPlate + "&zone name='far' lower=10,10 /\n"); });
  EXPECT_TRUE(has(said, "zone 'far' is empty"));
  EXPECT_TRUE(has(said, "body 'plate' extends from (0, 0, 0) to (4, 3, 0)"));
}

TEST_F(Refused, ZoneMustNotTakeTheNameOfAMeshGroup) {
  const std::string said =
      message_of<DeckError>([&] { run("t_end=1", kPlate + "&zone name='ymax' /\n"); });
  EXPECT_TRUE(has(said, "already has a set 'ymax'"));
}

TEST_F(Refused, StepAboveTheStableOne) {
  const std::string said = message_of<DeckError>([&] { run("t_end=10 time_step=5", kPlate); });
  EXPECT_TRUE(has(said, "time_step = 5 is above the stable step"));
  EXPECT_TRUE(has(said, "body 'plate': shortest bond 1, wave speed 1.0328"));
  EXPECT_FALSE(std::filesystem::exists(path("case.exo")));
}

TEST_F(Refused, CrackOutsideTheBody) {
  const std::string said =
      message_of<DeckError>([&] { run("t_end=1", kPlate + "&precrack points=0,9,4,9 /\n"); });
  EXPECT_TRUE(has(said, "this crack crosses no bond; body 'plate' extends from"));
}

TEST_F(Refused, SplitWithoutAMeshedCrack) {
  const std::string said = message_of<DeckError>(
      [&] { run("t_end=1", kPlate + "&precrack mode='split' points=0,1,2,1 /\n"); });
  EXPECT_TRUE(has(said, "mode = 'split' needs a crack that the mesh follows"));
}

TEST_F(Refused, DirectionsOfLoads) {
  const auto said = [&](const std::string& keys) {
    return message_of<DeckError>([&] { run("t_end=1", kPlate + "&load " + keys + " /\n"); });
  };
  EXPECT_TRUE(has(said("kind='velocity' set='ymax'"), "needs directions"));
  EXPECT_TRUE(has(said("kind='velocity' set='ymax' directions='yy'"), "names a direction twice"));
  EXPECT_TRUE(has(said("kind='velocity' set='ymax' directions='w'"), "letters x, y, z"));
  EXPECT_TRUE(has(said("kind='velocity' set='ymax' directions='z'"), "only x and y can be loaded"));
  EXPECT_TRUE(has(said("kind='velocity' directions='y'"), "needs the set of particles it moves"));
  EXPECT_TRUE(has(said("kind='pressure' set='ymax' directions='y'"), "remove directions"));
  EXPECT_TRUE(has(said("kind='force' directions='y'"), "needs the set it acts on"));
  EXPECT_TRUE(has(said("name='a b' kind='gravity' directions='y'"), "letters, digits"));
}

TEST_F(Refused, TractionOnASetWithoutFacets) {
  const std::string said = message_of<DeckError>([&] {
    run("t_end=1", kPlate +
                       "&zone name='inside' lower=1,1 upper=2,1 /\n"
                       "&load kind='traction' set='inside' directions='y' value=1 /\n");
  });
  EXPECT_TRUE(has(said, "holds no whole facet of the surface"));
}

TEST_F(Refused, FieldsThatThereAreNot) {
  EXPECT_TRUE(
      has(message_of<DeckError>([&] { run("t_end=1", kPlate + "&output fields='stress' /\n"); }),
          "'stress' is not a field of this run; fields that can be written: "));
  EXPECT_TRUE(has(
      message_of<DeckError>([&] { run("t_end=1", kPlate + "&output fields='bond_status' /\n"); }),
      "is not a field of particles, simplices"));
  EXPECT_TRUE(has(message_of<DeckError>([&] {
                    run("t_end=1", kPlate + "&probe name='p' field='damege' point=0,0 /\n");
                  }),
                  "'damege' is not a field of particles"));
  EXPECT_TRUE(has(message_of<DeckError>([&] {
                    run("t_end=1", kPlate + "&probe name='kinetic' field='damage' point=0,0 /\n");
                  }),
                  "already has a column 'kinetic'"));
}

TEST_F(Refused, PlaneBodyFromTetrahedra) {
  const std::string said = message_of<DeckError>([&] {
    run("t_end=1",
        "&lattice type='cubic' spacing=1 size=1,1,1 /\n"
        "&body kinematics='plane_stress' material='unit' /\n" +
            std::string(kUnitMaterial));
  });
  EXPECT_TRUE(has(said, "the mesh has no triangles for a body with kinematics 'plane_stress'"));
}

using Accepted = RunDirectory;

// A triangle to which a lattice of rows at 30 degrees is cut.
TEST_F(Refused, LatticesThatCannotBeCut) {
  std::ofstream(path("three.msh")) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n"
                                      "2 8 0 0\n3 0 8 0\n$EndNodes\n$Elements\n1\n"
                                      "1 2 2 1 1 1 2 3\n$EndElements\n";
  const std::string groups =
      "&mesh name='three' file='" + path("three.msh") +
      "' /\n"
      "&body name='plate' mesh='plate' kinematics='plane_stress' material='unit' /\n" +
      std::string(kUnitMaterial);
  const auto lattice = [](const std::string& keys) {
    return "&lattice name='plate' type='hexagonal' spacing=0.5 " + keys + " /\n";
  };
  run("t_end=1", groups + lattice("inside='three' x_axis=3,1.7320508"));
  const auto refused = [&](const std::string& keys) {
    return message_of<DeckError>([&] { run("t_end=1", groups + lattice(keys)); });
  };
  EXPECT_TRUE(has(refused("inside='plate'"), "'plate' is a &lattice; allowed: a &mesh"));
  EXPECT_TRUE(has(refused("inside='tree'"), "did you mean 'three'?"));
  EXPECT_TRUE(has(refused("inside='three' size=1,1 origin=9,9,0"), "not one of its cells"));
  EXPECT_TRUE(has(refused("size=4,4 x_axis=0,0,1"), "in the plane, with z = 0"));
}

TEST_F(Accepted, ExemptZoneAndUnstableStepWithAWarning) {
  EXPECT_EQ(run("t_end=1.2 time_step=1.2 step_check='warn'",
                kPlate + "&fracture critical_strain=0.1 /\n&exempt set='ymax' /\n"),
            0);
}

TEST_F(Accepted, SameSetInTwoDirectionsByTwoLoads) {
  EXPECT_EQ(run("t_end=0.5", kPlate + "&load kind='displacement' set='ymin' directions='y' /\n"
                                      "&load kind='displacement' set='ymin' directions='x' /\n"),
            0);
}

// Inside of 4 x 3 unit cells: the box takes exactly the particles it holds.
TEST_F(Accepted, ZonesSelectByShape) {
  const Deck zones =
      deck("t_end=1", kPlate +
                          "&zone name='box' lower=1,1 upper=2,2 /\n"
                          "&zone name='disc' shape='sphere' centre=0,0,0 radius=1 /\n"
                          "&zone name='row' shape='plane' centre=0,2,0 normal=0,3,0 /\n"
                          "&zone name='post' shape='cylinder' centre=4,3,9 radius=1 /\n");
  const Scene scene = Scene::from_deck(zones, 1);
  std::map<std::string, std::vector<std::int64_t>> sets;
  for (const NamedSet& set : scene.sets().of_body(0)) sets[set.name] = set.particles;
  EXPECT_EQ(sets["box"].size(), 4u);
  EXPECT_EQ(sets["disc"].size(), 3u);
  EXPECT_EQ(sets["row"].size(), 5u);
  EXPECT_EQ(sets["post"].size(), 3u);
}

}  // namespace
}  // namespace cleave::driver::testing
