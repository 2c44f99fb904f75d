// Quadratic elements, probes between particles, and restart of every formulation that has no bonds.
#include <cmath>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using Elements = RunDirectory;

TEST(MakeQuadratic, PutsANodeInTheMiddleOfEveryEdge) {
  BodyGeometry body = unit_cells(2, 1);  // 6 points, 4 triangles, 9 edges
  body.groups.push_back({"low", {0, 1, 2}});
  body.groups.push_back({"corner", {0}});
  make_quadratic(body);
  EXPECT_TRUE(body.quadratic);
  EXPECT_EQ(body.particles(), 6 + 9);
  EXPECT_EQ(body.simplex_nodes(), 6);
  EXPECT_EQ(body.simplex_count(), 4);
  const auto x = [&](std::int64_t i, std::size_t k) {
    return body.X[static_cast<std::size_t>(3 * i) + k];
  };
  for (std::size_t s = 0; s < body.simplices.size(); s += 6) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t first = body.simplices[s + a], second = body.simplices[s + (a + 1) % 3];
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(x(body.simplices[s + 3 + a], k), 0.5 * (x(first, k) + x(second, k)));
    }
  }
  std::vector<std::int64_t> ids = body.point_ids;
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
  const auto& low = body.find_group("low")->particles;
  ASSERT_EQ(low.size(), 5u);  // the middles of its two edges joined
  for (const std::int64_t i : low) EXPECT_EQ(x(i, 1), 0.0);
  EXPECT_EQ(body.find_group("corner")->particles.size(), 1u);
  EXPECT_EQ(shortest_edge(body), 1.0);
}

std::string plate(const std::string& body) {
  return "&lattice type='square' spacing=1 size=8,4,0 /\n"
         "&body name='plate' kinematics='plane_strain' material='metal' " +
         body +
         " /\n"
         "&material name='metal' law='j2' E=1 nu=0.3 rho=1 tau_y0=0.01 tau_inf=0.02 alpha=10 /\n";
}

TEST_F(Elements, QuadraticIsRefusedWhereThereIsNone) {
  const auto refused = [&](const std::string& groups) {
    return message_of<DeckError>([&] { run("t_end=1", groups); });
  };
  EXPECT_TRUE(has(refused(plate("elements='quadratic'")), "six-node triangles of formulation"));
  EXPECT_TRUE(has(refused("&lattice type='cubic' spacing=1 size=2,2,2 /\n"
                          "&body kinematics='3d' material='unit' formulation='fem' "
                          "elements='quadratic' /\n" +
                          std::string(kUnitMaterial)),
                  "in a plane"));
  for (const std::string kind : {"traction", "pressure"}) {
    EXPECT_TRUE(has(
        refused(plate("formulation='fem' elements='quadratic'") + "&load kind='" + kind +
                "' set='ymax' value=1 " + (kind == "traction" ? "directions='y'" : "") + " /\n"),
        "cannot act on quadratic elements"));
  }
}

// Between particles a linear field is what it should be; a particle only has its own value.
TEST_F(Elements, ProbesBetweenParticles) {
  run("t_end=0.1 time_step=0.1",
      plate("formulation='fem'") +
          "&initial velocity=0.1,0,0 angular_velocity=0,0,0.01 centre=0,0,0 /\n"
          "&probe name='between' field='velocity' point=3.3,1.7 at='point' /\n"
          "&probe name='nearest' field='velocity' point=3.3,1.7 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("between_x").front(), 0.1 - 0.01 * 1.7, 1e-15);
  EXPECT_NEAR(h.at("between_y").front(), 0.01 * 3.3, 1e-15);
  EXPECT_NEAR(h.at("nearest_x").front(), 0.1 - 0.01 * 2, 1e-15);
}

TEST_F(Elements, ProbesThatCannotBeInterpolatedAreRefused) {
  const auto refused = [&](const std::string& probe) {
    return message_of<DeckError>([&] { run("t_end=1", plate("formulation='fem'") + probe); });
  };
  EXPECT_TRUE(has(refused("&probe name='p' field='velocity' point=9,1 at='point' /\n"),
                  "is not inside the body"));
  EXPECT_TRUE(has(refused("&probe name='p' field='velocity' set='ymax' at='point' /\n"),
                  "only real fields at a point"));
  EXPECT_TRUE(has(refused("&probe name='p' field='cauchy_stress' point=1,1 /\n"),
                  "is not a field of particles"));
}

// The same bytes for finite elements of both kinds and a kernel method, cut in the middle of plastic flow.
TEST_F(Elements, RestartIsBitwise) {
  struct Form {
    const char *directory, *body, *groups;
  };
  const Form forms[] = {
      {"t3", "formulation='fem'", ""},
      {"t6", "formulation='fem' elements='quadratic'",
       "&probe name='p' field='equivalent_plastic_strain' point=3.3,1.7 at='point' /\n"},
      {"sph", "formulation='tlsph'", "&kernel radius=1.5 /\n&hourglass psi=0.1 /\n"}};
  const std::string pull =
      "&load name='low' kind='displacement' set='ymin' directions='xy' /\n"
      "&load name='top' kind='velocity' set='ymax' directions='y' value=0.02 /\n"
      "&output every_steps=5 fields='velocity','equivalent_stress','equivalent_plastic_strain' /\n"
      "&history every_steps=3 /\n&section name='s' point=0,2.2,0 /\n"
      "&checkpoint every_steps=5 keep=50 /\n";
  for (const Form& form : forms) {
    const std::string whole = form.directory, cut = whole + "cut";
    ASSERT_EQ(run("t_end=15", plate(form.body) + form.groups + pull, whole), 0);
    const auto h = read_history(path(whole + "/case.history.csv"));
    EXPECT_GT(h.at("plastic").back(), 1e-4) << whole;
    fs::create_directories(path(cut));
    const char* const files[] = {"case.exo", "case.history.nc", "case.history.csv",
                                 "case.events.nc"};
    for (const char* file : files) fs::copy(path(whole) + "/" + file, path(cut));
    fs::copy(path(whole + "/case.5.checkpoint.nc"), path(cut));
    RunOptions options = quiet;
    options.threads = 2;
    ASSERT_EQ(restart_run(path(cut), "", options), 0) << whole;
    for (const char* file : files) {
      EXPECT_EQ(file_bytes(path(cut) + "/" + file), file_bytes(path(whole) + "/" + file))
          << whole << ' ' << file;
    }
  }
}

}  // namespace
}  // namespace cleave::driver::testing
