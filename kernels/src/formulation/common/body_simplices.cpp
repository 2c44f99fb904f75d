#include "formulation/common/body_simplices.hpp"

#include "formulation/common/simplices.hpp"

namespace cleave {

namespace {

constexpr std::int64_t kStride = 4;  // of the field simplex_particles

template <int D>
void add_shares(const double* X, const std::int32_t* corners, std::int64_t simplices,
                double* volume) {
  for (std::int64_t s = 0; s < simplices; ++s) {
    const std::int32_t* c = corners + kStride * s;
    const double share = simplex_volume<D>(X, c) / (D + 1);
    for (int a = 0; a <= D; ++a) volume[c[a]] += share;
  }
}

}  // namespace

std::int64_t take_simplices(Body& body) {
  const int corner_count = body.dimension() + 1;
  if (body.simplex_nodes != corner_count) {
    throw Error(CLEAVE_UNSUPPORTED, text(body.label(), ": ", body.formulation->name(),
                                         " takes simplices of ", corner_count, " particles, not ",
                                         body.simplex_nodes, "; use a mesh of first order"));
  }
  const std::int64_t simplices = std::ssize(body.given_simplices) / corner_count;
  body.fields.allocate(CLEAVE_RELATION_SIMPLEX, simplices);
  std::int32_t* corners = body.fields.integer("simplex_particles");
  for (std::int64_t s = 0; s < simplices; ++s) {
    const std::int64_t* given = body.given_simplices.data() + corner_count * s;
    for (int a = 0; a < kStride; ++a) {
      if (a < corner_count)
        body.check_particle(given[a], CLEAVE_BAD_SIMPLEX, text("simplex ", body.number(s)));
      corners[kStride * s + a] = a < corner_count ? static_cast<std::int32_t>(given[a]) : -1;
    }
  }
  return simplices;
}

void share_volumes(const Body& body, const std::int32_t* corners, std::int64_t simplices) {
  double* volume = body.point.volume;
  std::fill(volume, volume + body.particles, 0.0);
  body.dimension() == 2 ? add_shares<2>(body.point.X, corners, simplices, volume)
                        : add_shares<3>(body.point.X, corners, simplices, volume);
}

}  // namespace cleave
