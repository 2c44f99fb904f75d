// Bonds, gradients and forces for hosts that count from one and keep a(n,3): the same bits as in the
// layout of the interface, and nothing written between.
#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kUntouched = -77.0;
std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Layout {
  const char* name;
  std::int64_t base;
  std::int64_t vector_point, vector_component;  // 0: the number of particles
  std::int64_t tensor_point, tensor_component;
};
constexpr Layout kLayouts[] = {{"fortran_3_n", 1, 3, 1, 9, 1},
                               {"fortran_n_3", 1, 1, 0, 1, 0},
                               {"c_n_3", 0, 1, 0, 1, 0},
                               {"padded", 1, 5, 1, 12, 1}};

class HostLayouts : public testing::TestWithParam<std::tuple<int, Layout>> {
 protected:
  void SetUp() override {
    const auto& [dimension, layout] = GetParam();
    mesh = patch(dimension, dimension == 2 ? 9 : 4, 1.0, 0.2, 33);
    plain = std::make_unique<Bonds>(mesh, random_deletions(mesh, 0.1, 3));
    n = mesh.particles();
    ok(cleave_network_init(&net));
    net.dimension = dimension;
    net.index_base = static_cast<std::int32_t>(layout.base);
    net.particles = n;
    const auto stride = [&](std::int64_t s) { return s == 0 ? n : s; };
    net.vector_point = stride(layout.vector_point);
    net.vector_component = stride(layout.vector_component);
    net.tensor_point = stride(layout.tensor_point);
    net.tensor_component = stride(layout.tensor_component);
  }
  std::vector<double> spread(const std::vector<double>& packed, std::int64_t components,
                             std::int64_t point, std::int64_t component) const {
    std::vector<double> out(at(point * n + component * components), kUntouched);
    for (std::int64_t q = 0; q < n; ++q)
      for (std::int64_t c = 0; c < components; ++c)
        out[at(point * q + component * c)] = packed[at(components * q + c)];
    return out;
  }
  std::vector<double> vectors(const std::vector<double>& packed) const {
    return spread(packed, 3, net.vector_point, net.vector_component);
  }
  std::vector<double> tensors(const std::vector<double>& packed) const {
    return spread(packed, 9, net.tensor_point, net.tensor_component);
  }
  SimplexMesh mesh;
  std::unique_ptr<Bonds> plain;
  std::int64_t n = 0;
  cleave_network net{};
};

TEST_P(HostLayouts, GiveTheSameBits) {
  const std::int64_t base = net.index_base;
  auto simplices = mesh.simplices;
  for (auto& s : simplices) s += base;
  std::vector<std::int64_t> row_begin(at(n + 1));
  net.row_begin = row_begin.data();
  ok(cleave_cbm_count_bonds(&net, mesh.simplex_count(), simplices.data()));
  const std::size_t bonds = at(row_begin[at(n)] - base);
  std::vector<std::int64_t> neighbour(bonds), reverse(bonds);
  std::vector<double> zeta(3 * bonds), volume(at(n));
  net.neighbour = neighbour.data();
  net.reverse = reverse.data();
  net.zeta = zeta.data();
  net.volume = volume.data();
  const auto X = vectors(mesh.X);
  ok(cleave_cbm_bonds(&net, X.data(), mesh.simplex_count(), simplices.data(), plain->alive.data()));
  const auto shifted = [&](std::vector<std::int64_t> v) {
    for (auto& i : v) i += base;
    return v;
  };
  EXPECT_EQ(row_begin, shifted(plain->row_begin));
  EXPECT_EQ(neighbour, shifted(plain->neighbour));
  EXPECT_EQ(reverse, shifted(plain->reverse));
  EXPECT_EQ(zeta, plain->zeta);
  EXPECT_EQ(volume, plain->volume);

  const auto u = random_vectors(mesh, 0.1, 5), v = random_vectors(mesh, 1.0, 6);
  const auto H = plain->gradient(u);
  auto H_host = tensors(std::vector<double>(H.size(), 3.0));
  const auto u_host = vectors(u);
  ok(cleave_displacement_gradient(&net, 0, n, u_host.data(), H_host.data()));
  EXPECT_EQ(H_host, tensors(H));

  const auto f = plain->force(H);
  auto f_host = vectors(std::vector<double>(f.size(), 0.0));
  ok(cleave_bond_force(&net, 0, n, H_host.data(), f_host.data()));
  EXPECT_EQ(f_host, vectors(f));

  std::vector<double> J(at(n), 0.9), viscous(f.size(), 0.0);
  auto viscous_host = vectors(viscous);
  const auto v_host = vectors(v);
  const auto w = plain->weights();
  const cleave_network packed = plain->network();
  ok(cleave_bond_viscosity(&packed, 0, n, w.data(), mesh.X.data(), v.data(), J.data(), 2.0, 0.1,
                           viscous.data()));
  ok(cleave_bond_viscosity(&net, 0, n, w.data(), X.data(), v_host.data(), J.data(), 2.0, 0.1,
                           viscous_host.data()));
  EXPECT_EQ(viscous_host, vectors(viscous));
  EXPECT_NE(viscous, std::vector<double>(viscous.size(), 0.0));
}

TEST_P(HostLayouts, MessagesCountAsTheHostDoes) {
  const std::int64_t base = net.index_base;
  auto simplices = mesh.simplices;
  for (auto& s : simplices) s += base;
  simplices[0] = n + base;
  std::vector<std::int64_t> row_begin(at(n + 1));
  net.row_begin = row_begin.data();
  EXPECT_EQ(cleave_cbm_count_bonds(&net, mesh.simplex_count(), simplices.data()),
            CLEAVE_BAD_SIMPLEX);
  const std::string expected = "simplex " + std::to_string(base) + " refers to particle " +
                               std::to_string(n + base) + "; particles are " +
                               std::to_string(base) + " to " + std::to_string(n - 1 + base);
  EXPECT_NE(last_message().find(expected), std::string::npos) << last_message();
}

INSTANTIATE_TEST_SUITE_P(Hosts, HostLayouts,
                         testing::Combine(testing::Values(2, 3), testing::ValuesIn(kLayouts)),
                         [](const auto& which) {
                           return std::to_string(std::get<0>(which.param)) + "d_" +
                                  std::get<1>(which.param).name;
                         });

}  // namespace
}  // namespace cleave::test
