/* A host in C99 that knows Cleave only as an installed package: a unit cube of six tetrahedra in its
 * own arrays, stretched in x, by array calls and as a model. Says nothing and returns 0 if the force on
 * a face is the one of the closed form, and the line of the check that failed otherwise. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cleave/cleave.h"

#define REQUIRE(condition)                      \
  do {                                          \
    if (!(condition)) exit(__LINE__ % 255 + 1); \
  } while (0)
#define OK(call) REQUIRE((call) == CLEAVE_OK)

enum { PARTICLES = 8, SIMPLICES = 6, HALF_BONDS = 2 * (12 + 6 + 1) }; /* edges and diagonals */

/* Particle 4 k + 2 j + i is at (i, j, k); every tetrahedron has the diagonal from 0 to 7. */
static const int64_t kSimplices[4 * SIMPLICES] = {0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7,
                                                  0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7};
static const double kProperties[3] = {1000.0, 2.0e9, 0.25}; /* rho, E, nu */
static const double kStretch = 0.1;

static void by_model(const double* X, const double* u, double* f) {
  cleave_model* model = NULL;
  cleave_body_spec spec;
  int64_t body = -1;
  OK(cleave_body_spec_init(&spec));
  spec.formulation = CLEAVE_FORMULATION_cbm;
  spec.kinematics = CLEAVE_3D;
  spec.material = CLEAVE_MATERIAL_svk;
  spec.particles = PARTICLES;
  spec.X = X;
  spec.simplex_count = SIMPLICES;
  spec.simplices = kSimplices;
  OK(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  OK(cleave_model_set_order(model, CLEAVE_ORDER_ROWS));
  OK(cleave_body_add(model, &spec, &body));
  OK(cleave_body_set_real(model, body, "material", "rho", kProperties[0]));
  OK(cleave_body_set_real(model, body, "material", "E", kProperties[1]));
  OK(cleave_body_set_real(model, body, "material", "nu", kProperties[2]));
  OK(cleave_model_setup(model));
  OK(cleave_field_put_real(model, body, "displacement", 0, PARTICLES, u));
  OK(cleave_model_initialise(model, 0.0));
  OK(cleave_field_get_real(model, body, "internal_force", 0, PARTICLES, f));
  OK(cleave_model_destroy(model));
}

int main(void) {
  int64_t row_begin[PARTICLES + 1], neighbour[HALF_BONDS], reverse[HALF_BONDS];
  double zeta[3 * HALF_BONDS], volume[PARTICLES];
  double X[3 * PARTICLES], u[3 * PARTICLES] = {0}, f[3 * PARTICLES] = {0}, g[3 * PARTICLES];
  double H[9 * PARTICLES], P[9 * PARTICLES], pull = 0;
  /* F11 = 1 + g: E11 = g + g^2/2, S11 = (lambda + 2 mu) E11, P11 = F11 S11; lambda = mu = 0.8e9. */
  const double P11 = (1 + kStretch) * 2.4e9 * (kStretch + 0.5 * kStretch * kStretch);
  cleave_network network;
  int32_t svk = 0;
  int i;

  for (i = 0; i < PARTICLES; ++i) {
    X[3 * i] = i & 1;
    X[3 * i + 1] = (i >> 1) & 1;
    X[3 * i + 2] = (i >> 2) & 1;
    u[3 * i] = kStretch * X[3 * i];
  }
  OK(cleave_abi_check(CLEAVE_ABI_VERSION));
  OK(cleave_network_init(&network));
  network.particles = PARTICLES;
  network.row_begin = row_begin;
  OK(cleave_cbm_count_bonds(&network, SIMPLICES, kSimplices));
  REQUIRE(row_begin[PARTICLES] == HALF_BONDS);
  network.neighbour = neighbour;
  network.reverse = reverse;
  network.zeta = zeta;
  network.volume = volume;
  OK(cleave_cbm_bonds(&network, X, SIMPLICES, kSimplices, NULL));
  OK(cleave_displacement_gradient(&network, 0, PARTICLES, u, H));
  OK(cleave_table_find(CLEAVE_TABLE_MATERIAL, "svk", &svk));
  OK(cleave_material_stress(svk, CLEAVE_3D, 3, kProperties, 0, PARTICLES, H, NULL, P, NULL, NULL));
  OK(cleave_bond_force(&network, 0, PARTICLES, P, f));
  for (i = 0; i < PARTICLES; ++i) pull += X[3 * i] * f[3 * i];
  REQUIRE(fabs(pull + P11) < 1e-13 * P11);
  by_model(X, u, g);
  REQUIRE(memcmp(f, g, sizeof f) == 0);
  return 0;
}
