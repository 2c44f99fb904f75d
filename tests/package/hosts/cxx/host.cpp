// A host in C++ that knows Cleave only as an installed package: a unit cube of six tetrahedra, stretched
// in x, once by array calls and once as a model. Says nothing and returns 0 if the force on a face is the
// one of the closed form, 1 otherwise.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "cleave/cleave.h"

namespace {

void ok(std::int32_t status) {
  if (status == CLEAVE_OK) return;
  std::string text(400, '\0');
  cleave_last_message(text.data(), static_cast<std::int64_t>(text.size()), nullptr);
  throw std::runtime_error(text);
}

// Particle 4 k + 2 j + i is at (i, j, k); every tetrahedron has the diagonal from 0 to 7.
const std::vector<std::int64_t> kSimplices = {0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7,
                                              0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7};
const std::vector<double> kProperties = {1000.0, 2.0e9, 0.25};  // rho, E, nu
constexpr double kStretch = 0.1;
constexpr std::int64_t kParticles = 8;

std::vector<double> positions() {
  std::vector<double> X;
  for (int i = 0; i < kParticles; ++i)
    for (int c = 0; c < 3; ++c) X.push_back((i >> c) & 1);
  return X;
}

std::vector<double> displacements(const std::vector<double>& X) {
  std::vector<double> u(X.size(), 0.0);
  for (std::size_t i = 0; i < X.size(); i += 3) u[i] = kStretch * X[i];
  return u;
}

std::vector<double> by_arrays(const std::vector<double>& X) {
  const auto simplices = static_cast<std::int64_t>(kSimplices.size() / 4);
  std::vector<std::int64_t> row_begin(kParticles + 1);
  cleave_network network;
  ok(cleave_network_init(&network));
  network.particles = kParticles;
  network.row_begin = row_begin.data();
  ok(cleave_cbm_count_bonds(&network, simplices, kSimplices.data()));
  const auto half_bonds = static_cast<std::size_t>(row_begin.back());
  std::vector<std::int64_t> neighbour(half_bonds), reverse(half_bonds);
  std::vector<double> zeta(3 * half_bonds), volume(kParticles);
  network.neighbour = neighbour.data();
  network.reverse = reverse.data();
  network.zeta = zeta.data();
  network.volume = volume.data();
  ok(cleave_cbm_bonds(&network, X.data(), simplices, kSimplices.data(), nullptr));
  std::vector<double> H(9 * kParticles), P(9 * kParticles), f(3 * kParticles);
  ok(cleave_displacement_gradient(&network, 0, kParticles, displacements(X).data(), H.data()));
  ok(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, 3, kProperties.data(), 0, kParticles,
                            H.data(), nullptr, P.data(), nullptr, nullptr));
  ok(cleave_bond_force(&network, 0, kParticles, P.data(), f.data()));
  return f;
}

std::vector<double> by_model(const std::vector<double>& X) {
  cleave_model* model = nullptr;
  std::int64_t body = 0;
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  spec.formulation = CLEAVE_FORMULATION_cbm;
  spec.kinematics = CLEAVE_3D;
  spec.material = CLEAVE_MATERIAL_svk;
  spec.particles = kParticles;
  spec.X = X.data();
  spec.simplex_count = static_cast<std::int64_t>(kSimplices.size() / 4);
  spec.simplices = kSimplices.data();
  ok(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  ok(cleave_model_set_order(model, CLEAVE_ORDER_ROWS));
  ok(cleave_body_add(model, &spec, &body));
  ok(cleave_body_set_real(model, body, "material", "rho", kProperties[0]));
  ok(cleave_body_set_real(model, body, "material", "E", kProperties[1]));
  ok(cleave_body_set_real(model, body, "material", "nu", kProperties[2]));
  ok(cleave_model_setup(model));
  ok(cleave_field_put_real(model, body, "displacement", 0, kParticles, displacements(X).data()));
  ok(cleave_model_initialise(model, 0.0));
  std::vector<double> f(3 * kParticles);
  ok(cleave_field_get_real(model, body, "internal_force", 0, kParticles, f.data()));
  ok(cleave_model_destroy(model));
  return f;
}

double pull(const std::vector<double>& X, const std::vector<double>& f) {
  double sum = 0;
  for (std::size_t i = 0; i < X.size(); i += 3) sum += X[i] * f[i];
  return sum;
}

}  // namespace

int main() try {
  // F11 = 1 + g: E11 = g + g^2/2, S11 = (lambda + 2 mu) E11, P11 = F11 S11; lambda = mu = 0.8e9.
  const double P11 = (1 + kStretch) * 2.4e9 * (kStretch + 0.5 * kStretch * kStretch);
  const std::vector<double> X = positions(), f = by_arrays(X);
  const bool right = std::abs(pull(X, f) + P11) < 1e-13 * P11 && by_model(X) == f;
  return right ? 0 : 1;
} catch (const std::exception&) {
  return 1;
}
