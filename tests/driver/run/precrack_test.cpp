#include "scene/precrack.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Index = std::int64_t;
using Bonds = std::set<std::array<Index, 2>>;

std::vector<Index> bonds_of(const BodyGeometry& body) {
  Bonds bonds;
  const auto corners = static_cast<std::size_t>(body.dimension + 1);
  for (std::size_t s = 0; s < body.simplices.size(); s += corners) {
    for (std::size_t a = 0; a < corners; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const Index p = body.simplices[s + a], q = body.simplices[s + b];
        bonds.insert({std::min(p, q), std::max(p, q)});
      }
    }
  }
  std::vector<Index> flat;
  for (const auto& bond : bonds) flat.insert(flat.end(), bond.begin(), bond.end());
  return flat;
}

Bonds crossing(const std::vector<CrackPiece>& pieces, const BodyGeometry& body) {
  const auto pairs = crossing_bonds(pieces, body, bonds_of(body));
  Bonds found;
  for (std::size_t k = 0; k < pairs.size(); k += 2) found.insert({pairs[k], pairs[k + 1]});
  return found;
}

std::vector<CrackPiece> pieces_of(const std::string& keys, int dimension) {
  const Deck deck = parse_deck(std::string("&run units='other' t_end=1 /\n") + kUnitPlate +
                                   kUnitMaterial + "&precrack " + keys + " /\n",
                               "case.nml");
  return crack_pieces(deck, *deck.all("precrack").front(), dimension);
}

Bonds crossing(const std::string& keys, const BodyGeometry& body) {
  return crossing(pieces_of(keys, body.dimension), body);
}

// 3 x 2 cells; particles 0..3 on y = 0, 4..7 on y = 1, 8..11 on y = 2.
TEST(Precrack, SegmentBetweenTheRowsCutsWhatItCrosses) {
  const BodyGeometry body = unit_cells(3, 2);
  // uprights at x = 0 and 1, the diagonal from 0 to 5, and the diagonal 1-6 at x = 1.4
  EXPECT_EQ(crossing("points = 0, 0.4, 1.5, 0.4", body), (Bonds{{0, 4}, {0, 5}, {1, 5}, {1, 6}}));
  // ends before x = 1.4
  EXPECT_EQ(crossing("points = 0, 0.4, 1.3, 0.4", body), (Bonds{{0, 4}, {0, 5}, {1, 5}}));
}

// A crack along a row of particles: they count as left of it, above for a crack to the right.
TEST(Precrack, ParticlesOnTheCrackStandOnItsLeft) {
  const BodyGeometry body = unit_cells(3, 2);
  const Bonds below{{0, 4}, {0, 5}, {1, 5}, {1, 6}, {2, 6}, {2, 7}, {3, 7}};
  const Bonds above{{4, 8}, {4, 9}, {5, 9}, {5, 10}, {6, 10}, {6, 11}, {7, 11}};
  EXPECT_EQ(crossing("points = -1, 1, 4, 1", body), below);
  EXPECT_EQ(crossing("points = 4, 1, -1, 1", body), above);
  // rounding of the deck or mesh does not matter
  EXPECT_EQ(crossing("points = -1, 0.99999999, 4, 1.00000001", body), below);
}

TEST(Precrack, PolylineThroughParticlesIsOneCrack) {
  const BodyGeometry body = unit_cells(4, 4);
  // along y = 2 from the left to the particle in the middle (12), then down: a turn to the right.
  // Left of it are the upper rows and the right half. Bond 12-16 leads to the upper left corner's
  // side and is not cut.
  const Bonds cut = crossing("shape='polyline' points = -1, 2, 2, 2, 2, -1", body);
  EXPECT_EQ(cut.count({12, 17}), 0u);
  EXPECT_EQ(cut.count({11, 12}), 0u);  // both on the crack, on one side
  EXPECT_EQ(cut.count({7, 12}), 0u);
  EXPECT_EQ(cut.count({6, 12}), 1u);  // from the lower left quarter to the corner
  EXPECT_EQ(cut.count({6, 7}), 1u);
  EXPECT_EQ(cut.count({6, 11}), 1u);
  // all bonds from the lower left block {0, 1, 5, 6} to the others
  std::size_t expected = 0;
  const auto bonds = bonds_of(body);
  const std::set<Index> inside{0, 1, 5, 6};
  for (std::size_t b = 0; b < bonds.size(); b += 2) {
    expected += inside.count(bonds[b]) != inside.count(bonds[b + 1]) ? 1 : 0;
  }
  EXPECT_EQ(cut.size(), expected);
}

TEST(Precrack, SmallAndLargeBodiesAreCutAlike) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    BodyGeometry body = unit_cells(3, 2);
    for (double& x : body.X) x *= scale;
    std::vector<CrackPiece> pieces = pieces_of("points = -1, 1, 1.5, 1", 2);
    for (auto& point : pieces[0].p) {
      for (double& x : point) x *= scale;
    }
    EXPECT_EQ(crossing(pieces, body), (Bonds{{0, 4}, {0, 5}, {1, 5}})) << scale;
  }
}

// One tetrahedron with a vertical edge 0-3 over a base in z = 0.
BodyGeometry tetrahedron() {
  BodyGeometry body;
  body.dimension = 3;
  body.X = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  body.simplices = {0, 1, 2, 3};
  return body;
}

TEST(Precrack, PlaneAndDiscInSpace) {
  const BodyGeometry body = tetrahedron();
  const Bonds upward{{0, 3}, {1, 3}, {2, 3}};
  EXPECT_EQ(crossing("shape='plane' points=-1,-1,0.5, 2,-1,0.5, -1,2,0.5", body), upward);
  // the parallelogram ends at x + y = 0.2 before the other two bonds (at 0.5)
  EXPECT_EQ(crossing("shape='plane' points=-.1,-.1,0.5, .1,-.1,0.5, -.1,.1,0.5", body),
            (Bonds{{0, 3}}));
  EXPECT_EQ(crossing("shape='disc' centre=0,0,0.5 normal=0,0,2 radius=0.3", body), (Bonds{{0, 3}}));
  EXPECT_EQ(crossing("shape='disc' centre=0,0,0.5 radius=0.6", body), upward);
  // particles of the base on the disc stand above it: nothing is cut
  EXPECT_EQ(crossing("shape='disc' centre=0,0,0 radius=3", body), Bonds{});
  EXPECT_EQ(crossing("shape='disc' centre=0,0,0 radius=3 normal=0,0,-1", body), upward);
}

// Facets of a mesh are turned to one side whatever way round the mesh has them.
TEST(Precrack, MeshedCrackDoesNotDependOnTheSenseOfItsFacets) {
  const BodyGeometry body = unit_cells(3, 2);
  const Bonds one = crossing(crack_pieces({4, 5, 5, 6, 6, 7}, body), body);
  const Bonds other = crossing(crack_pieces({4, 5, 6, 5, 7, 6}, body), body);
  EXPECT_EQ(one.size(), 7u);
  EXPECT_EQ(one, other);
}

TEST(Precrack, ImpossibleCracksAreRefused) {
  const auto said = [](const std::string& keys, int dimension) {
    return message_of<DeckError>([&] { pieces_of(keys, dimension); });
  };
  EXPECT_TRUE(has(said("points=0,0,1", 2), "a segment has 4 numbers x1, y1, x2, y2; here 3"));
  EXPECT_TRUE(has(said("points=0,0,0,0", 2), "points 1 and 2 are the same"));
  EXPECT_TRUE(has(said("shape='disc' radius=1", 2), "is for bodies in space"));
  EXPECT_TRUE(has(said("points=0,0,1,1", 3), "is for bodies in the plane"));
  EXPECT_TRUE(has(said("shape='disc'", 3), "a disc needs radius > 0"));
  EXPECT_TRUE(has(said("shape='plane' points=0,0,0,1,0,0,2,0,0", 3), "lie on one line"));
}

}  // namespace
}  // namespace cleave::driver::testing
