#include "scene/precrack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/piece_grid.hpp"

namespace cleave::driver {
namespace {

using Vector = std::array<double, 3>;

constexpr double kOnCrack = 1e-6;  // of the shortest bond; far above rounding, far below a bond

Vector minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

Vector normal_of(const CrackPiece& piece) {
  if (piece.kind == CrackPiece::Kind::disc) return {piece.p[1][0], piece.p[1][1], piece.p[1][2]};
  const Vector a = minus(piece.p[1], piece.p[0]);
  Vector n = piece.kind == CrackPiece::Kind::segment ? Vector{-a[1], a[0], 0}
                                                     : cross(a, minus(piece.p[2], piece.p[0]));
  const double l = length(n);
  for (double& c : n) c /= l;
  return n;
}

// Whether x, a point of the plane (line) of the piece, lies in the piece grown by `margin`.
bool holds(const CrackPiece& piece, const double* x, double margin) {
  if (piece.kind == CrackPiece::Kind::disc) {
    return length(minus(x, piece.p[0])) <= piece.radius + margin;
  }
  if (piece.kind == CrackPiece::Kind::segment) {
    const Vector a = minus(piece.p[1], piece.p[0]);
    const double along = dot(minus(x, piece.p[0]), a) / length(a);
    return along >= -margin && along <= length(a) + margin;
  }
  const Vector n = normal_of(piece);
  for (int k = 0; k < 3; ++k) {  // inside of each edge
    const Vector edge = minus(piece.p[(k + 1) % 3], piece.p[k]);
    if (dot(cross(n, edge), minus(x, piece.p[k])) < -margin * length(edge)) return false;
  }
  return true;
}

struct Surveyed {  // a piece with what every test needs
  CrackPiece piece;
  Vector normal;
  double distance(const double* x) const { return dot(minus(x, piece.p[0]), normal); }
};

Box box_of(const std::vector<CrackPiece>& pieces, double margin) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const CrackPiece& piece : pieces) {
    const int points = piece.kind == CrackPiece::Kind::disc
                           ? 1
                           : (piece.kind == CrackPiece::Kind::segment ? 2 : 3);
    for (int a = 0; a < points; ++a) {
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::min(box.lower[k], piece.p[a][k] - piece.radius - margin);
        box.upper[k] = std::max(box.upper[k], piece.p[a][k] + piece.radius + margin);
      }
    }
  }
  return box;
}

bool misses(const Box& box, const double* p, const double* q) {
  for (int k = 0; k < 3; ++k) {
    if (std::max(p[k], q[k]) < box.lower[k] || std::min(p[k], q[k]) > box.upper[k]) return true;
  }
  return false;
}

// A box around each piece, grown by its own size, which is far more than what counts as near even at
// the tips of thin facets.
std::vector<Box> grown_boxes(const std::vector<CrackPiece>& pieces, double margin) {
  std::vector<Box> boxes;
  for (const CrackPiece& piece : pieces) {
    Box box = box_of({piece}, margin);
    double size = 0;
    for (int k = 0; k < 3; ++k) size = std::max(size, box.upper[k] - box.lower[k]);
    for (int k = 0; k < 3; ++k) {
      box.lower[k] -= size;
      box.upper[k] += size;
    }
    boxes.push_back(box);
  }
  return boxes;
}

Box box_between(const double* p, const double* q) {
  Box box{};
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::min(p[k], q[k]);
    box.upper[k] = std::max(p[k], q[k]);
  }
  return box;
}

// The particle's position, moved to the side of the normals if it lies on one of the pieces `near`.
Vector beside_crack(const double* x, const std::vector<Surveyed>& pieces,
                    const std::vector<std::int32_t>& near, const Box& box, double margin) {
  Vector moved{x[0], x[1], x[2]};
  if (misses(box, x, x)) return moved;
  Vector sum{0, 0, 0};
  for (const std::int32_t number : near) {
    const Surveyed& s = pieces[at(number)];
    const double d = s.distance(x);
    if (std::abs(d) > margin) continue;
    const Vector foot{x[0] - d * s.normal[0], x[1] - d * s.normal[1], x[2] - d * s.normal[2]};
    if (!holds(s.piece, foot.data(), margin)) continue;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += s.normal[k];
  }
  const double size = length(sum);
  if (size > 0) {
    for (std::size_t k = 0; k < 3; ++k) moved[k] += 4 * margin * sum[k] / size;
  }
  return moved;
}

bool crosses(const Surveyed& s, const Vector& p, const Vector& q, double margin) {
  const double dp = s.distance(p.data());
  const double dq = s.distance(q.data());
  if ((dp >= 0) == (dq >= 0)) return false;
  const double t = dp / (dp - dq);
  const double x[3] = {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]),
                       p[2] + t * (q[2] - p[2])};
  return holds(s.piece, x, margin);
}

void require_dimension(const Deck& deck, const DeckGroup& precrack, int dimension, int needed) {
  if (dimension == needed) return;
  deck.fail(precrack, "shape",
            "shape = " + in_quotes(precrack.text("shape")) + " is for bodies in " +
                (needed == 2 ? "the plane; in space use plane, disc or group"
                             : "space; in the plane use segment, polyline or group"));
}

std::vector<CrackPiece> polyline_pieces(const Deck& deck, const DeckGroup& precrack) {
  const auto& points = precrack.reals("points");
  const bool segment = precrack.text("shape") == "segment";
  if (segment ? points.size() != 4 : (points.size() < 4 || points.size() % 2 != 0)) {
    deck.fail(precrack, "points",
              (segment ? std::string("a segment has 4 numbers x1, y1, x2, y2")
                       : std::string("a polyline has x, y of two or more points")) +
                  "; here " + std::to_string(points.size()));
  }
  std::vector<CrackPiece> pieces;
  for (std::size_t i = 0; i + 3 < points.size(); i += 2) {
    if (points[i] == points[i + 2] && points[i + 1] == points[i + 3]) {
      deck.fail(precrack, "points",
                "points " + std::to_string(i / 2 + 1) + " and " + std::to_string(i / 2 + 2) +
                    " are the same");
    }
    pieces.push_back({CrackPiece::Kind::segment,
                      {{points[i], points[i + 1], 0}, {points[i + 2], points[i + 3], 0}, {}}});
  }
  return pieces;
}

std::vector<CrackPiece> plane_pieces(const Deck& deck, const DeckGroup& precrack) {
  const auto& p = precrack.reals("points");
  if (p.size() != 9) {
    deck.fail(precrack, "points",
              "a plane has 9 numbers: a corner, the end of its first edge, the end of its second "
              "edge; here " +
                  std::to_string(p.size()));
  }
  CrackPiece first{CrackPiece::Kind::triangle, {}}, second = first;
  for (std::size_t k = 0; k < 3; ++k) {
    first.p[0][k] = p[k];
    first.p[1][k] = second.p[0][k] = p[3 + k];
    first.p[2][k] = second.p[2][k] = p[6 + k];
    second.p[1][k] = p[3 + k] + p[6 + k] - p[k];
  }
  const Vector a = minus(first.p[1], first.p[0]), b = minus(first.p[2], first.p[0]);
  if (!(length(cross(a, b)) > 1e-12 * length(a) * length(b))) {
    deck.fail(precrack, "points", "the three points of the plane lie on one line");
  }
  return {first, second};
}

CrackPiece disc_piece(const Deck& deck, const DeckGroup& precrack) {
  const auto& centre = precrack.reals("centre");
  const auto& normal = precrack.reals("normal");
  CrackPiece disc{CrackPiece::Kind::disc, {}, precrack.real("radius")};
  const double size = std::hypot(normal[0], normal[1], normal[2]);
  if (!(disc.radius > 0)) deck.fail(precrack, "radius", "a disc needs radius > 0");
  if (!(size > 0)) deck.fail(precrack, "normal", "the normal must not be zero");
  for (std::size_t k = 0; k < 3; ++k) {
    disc.p[0][k] = centre[k];
    disc.p[1][k] = normal[k] / size;
  }
  return disc;
}

// What a facet shares with a neighbour: 2D a particle, 3D an edge, and the sense in which it is
// passed. Two facets look to one side if they pass it in opposite senses.
struct Joint {
  std::pair<Index, Index> key;
  int sense;
};

std::vector<Joint> joints(const Index* facet, int dimension) {
  if (dimension == 2) return {{{facet[0], -1}, -1}, {{facet[1], -1}, 1}};
  std::vector<Joint> edges;
  for (int k = 0; k < 3; ++k) {
    const Index a = facet[k], b = facet[(k + 1) % 3];
    edges.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1});
  }
  return edges;
}

// Which facets to turn so that neighbours look to one side; the first of each patch stays.
std::vector<char> facets_to_turn(const std::vector<Index>& facets, int dimension) {
  const std::size_t count = facets.size() / static_cast<std::size_t>(dimension);
  const auto facet = [&](std::size_t f) {
    return &facets[f * static_cast<std::size_t>(dimension)];
  };
  std::map<std::pair<Index, Index>, std::vector<std::pair<std::size_t, int>>> sharing;
  for (std::size_t f = 0; f < count; ++f) {
    for (const Joint& joint : joints(facet(f), dimension)) {
      sharing[joint.key].push_back({f, joint.sense});
    }
  }
  std::vector<char> turn(count, 0), seen(count, 0);
  for (std::size_t start = 0; start < count; ++start) {
    if (seen[start] != 0) continue;
    std::vector<std::size_t> todo{start};
    seen[start] = 1;
    while (!todo.empty()) {
      const std::size_t f = todo.back();
      todo.pop_back();
      for (const Joint& joint : joints(facet(f), dimension)) {
        for (const auto& [other, sense] : sharing[joint.key]) {
          if (seen[other] != 0) continue;
          seen[other] = 1;
          turn[other] = static_cast<char>((sense == joint.sense) != (turn[f] != 0));
          todo.push_back(other);
        }
      }
    }
  }
  return turn;
}

}  // namespace

std::vector<CrackPiece> crack_pieces(const Deck& deck, const DeckGroup& precrack, int dimension) {
  const std::string& shape = precrack.text("shape");
  require_dimension(deck, precrack, dimension, shape == "segment" || shape == "polyline" ? 2 : 3);
  if (shape == "plane") return plane_pieces(deck, precrack);
  if (shape == "disc") return {disc_piece(deck, precrack)};
  return polyline_pieces(deck, precrack);
}

std::vector<CrackPiece> crack_pieces(const std::vector<Index>& facets, const BodyGeometry& body) {
  const auto corners = at(body.dimension);
  const std::vector<char> turn = facets_to_turn(facets, body.dimension);
  std::vector<CrackPiece> pieces;
  for (std::size_t f = 0; f < turn.size(); ++f) {
    CrackPiece piece{corners == 2 ? CrackPiece::Kind::segment : CrackPiece::Kind::triangle, {}};
    for (std::size_t a = 0; a < corners; ++a) {
      std::copy_n(&body.X[at(3 * facets[f * corners + a])], 3, piece.p[a]);
    }
    if (turn[f] != 0) std::swap(piece.p[0], piece.p[1]);
    pieces.push_back(piece);
  }
  return pieces;
}

std::vector<Index> crossing_bonds(const std::vector<CrackPiece>& pieces, const BodyGeometry& body,
                                  const std::vector<Index>& bonds) {
  const double margin = kOnCrack * shortest_edge(body);
  const Box box = box_of(pieces, 8 * margin);
  std::vector<Surveyed> surveyed;
  for (const CrackPiece& piece : pieces) surveyed.push_back({piece, normal_of(piece)});
  PieceGrid grid(grown_boxes(pieces, 8 * margin));
  std::vector<Index> found;
  for (std::size_t b = 0; b + 1 < bonds.size(); b += 2) {
    const double* p = &body.X[at(3 * bonds[b])];
    const double* q = &body.X[at(3 * bonds[b + 1])];
    if (misses(box, p, q)) continue;
    const std::vector<std::int32_t>& near = grid.near(box_between(p, q));
    const Vector from = beside_crack(p, surveyed, near, box, margin);
    const Vector to = beside_crack(q, surveyed, near, box, margin);
    if (std::any_of(near.begin(), near.end(), [&](std::int32_t number) {
          return crosses(surveyed[at(number)], from, to, margin);
        })) {
      found.push_back(bonds[b]);
      found.push_back(bonds[b + 1]);
    }
  }
  return found;
}

namespace {

// The bonds of a body that cross the pieces; looked at in parts, for they may be many. False: none.
bool add_crossing(const std::vector<CrackPiece>& pieces, const BodyGeometry& geometry, Index body,
                  const Model& model, std::vector<std::pair<Index, Index>>& found) {
  constexpr Index kPart = 1 << 20;
  const auto field = model.find_field(body, "bond_ends");
  const std::size_t before = found.size();
  std::vector<Index> ends;
  for (Index first = 0; field && first < field->count; first += kPart) {
    const Index last = std::min(first + kPart, field->count);
    ends.resize(at(2 * (last - first)));
    model.get(body, "bond_ends", first, last, ends);
    const auto pairs = crossing_bonds(pieces, geometry, ends);
    for (std::size_t k = 0; k < pairs.size(); k += 2) found.push_back({pairs[k], pairs[k + 1]});
  }
  return found.size() > before;
}

}  // namespace

void delete_cracks(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                   Model& model) {
  std::vector<std::vector<std::pair<Index, Index>>> broken(bodies.size());
  std::vector<std::size_t> next_facets(bodies.size(), 0);
  for (const DeckGroup* precrack : deck.all("precrack")) {
    if (precrack->text("mode") != "delete") continue;
    const bool by_group = precrack->text("shape") == "group";
    bool any = false;
    for (const Index body : sets.bodies(*precrack)) {
      const BodyGeometry& geometry = bodies[at(body)];
      const auto pieces =
          by_group ? crack_pieces(geometry.crack_facets[next_facets[at(body)]++], geometry)
                   : crack_pieces(deck, *precrack, geometry.dimension);
      any = add_crossing(pieces, geometry, body, model, broken[at(body)]) || any;
    }
    if (!any) {
      std::string extents;
      for (const Index body : sets.bodies(*precrack)) {
        const Box box = bounding_box(bodies[at(body)]);
        extents += "; body " + in_quotes(bodies[at(body)].name) + " extends from " +
                   point_text(box.lower) + " to " + point_text(box.upper);
      }
      deck.fail(*precrack, "this crack crosses no bond" + extents);
    }
  }
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    auto& pairs = broken[body];
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    if (pairs.empty()) continue;
    std::vector<Index> flat;
    for (const auto& [a, b] : pairs) {
      flat.push_back(a);
      flat.push_back(b);
    }
    check(cleave_body_precrack(model.handle(), static_cast<Index>(body),
                               static_cast<Index>(pairs.size()), flat.data()));
  }
}

}  // namespace cleave::driver
