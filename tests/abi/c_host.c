/* A host in C99 that owns its memory: array calls on a square of two triangles, then the same square
 * as a model. Expected numbers are worked out by hand beside each check; exit status 1 at the first
 * that is missed. Also proves that the header is C. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cleave/cleave.h"

enum { PARTICLES = 4, SIMPLICES = 2, HALF_BONDS = 10 };
static const double kX[3 * PARTICLES] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const int64_t kSimplices[3 * SIMPLICES] = {0, 1, 2, 0, 2, 3};
static const double kProperties[3] = {1000.0, 2.0e9, 0.25};

/* The line where a check failed is the exit status (below 256). */
#define REQUIRE(condition)                      \
  do {                                          \
    if (!(condition)) exit(__LINE__ % 255 + 1); \
  } while (0)
#define OK(call) REQUIRE((call) == CLEAVE_OK)

static int near(double a, double b, double size) { return fabs(a - b) <= 1e-12 * size; }

/* u = (g X, 0): F11 = 1 + g. Plane strain: E11 = g + g^2/2, S11 = (lambda + 2 mu) E11,
 * P11 = (1 + g) S11; lambda = E nu/((1+nu)(1-2nu)) = 0.8e9, mu = 0.8e9. */
static const double kStretch = 0.1;
static double expected_p11(void) {
  const double e11 = kStretch + 0.5 * kStretch * kStretch;
  return (1 + kStretch) * (0.8e9 + 2 * 0.8e9) * e11;
}
static double expected_energy(void) {
  const double e11 = kStretch + 0.5 * kStretch * kStretch;
  return 0.5 * (0.8e9 + 2 * 0.8e9) * e11 * e11;
}

static void array_calls(double* force) {
  int64_t row_begin[PARTICLES + 1], neighbour[HALF_BONDS], reverse[HALF_BONDS];
  double zeta[3 * HALF_BONDS], volume[PARTICLES];
  double u[3 * PARTICLES] = {0}, H[9 * PARTICLES], P[9 * PARTICLES], energy[PARTICLES];
  double c0 = 0;
  cleave_network net;
  int64_t history = -1;
  int i;
  OK(cleave_abi_check(CLEAVE_ABI_VERSION));
  OK(cleave_network_init(&net));
  net.dimension = 2;
  net.particles = PARTICLES;
  net.row_begin = row_begin;
  net.neighbour = neighbour;
  net.reverse = reverse;
  net.zeta = zeta;
  net.volume = volume;
  OK(cleave_cbm_count_bonds(&net, SIMPLICES, kSimplices));
  REQUIRE(row_begin[PARTICLES] == HALF_BONDS); /* five edges */
  OK(cleave_cbm_bonds(&net, kX, SIMPLICES, kSimplices, NULL));
  REQUIRE(near(volume[0], 1.0 / 3, 1) && near(volume[1], 1.0 / 6, 1));
  for (i = 0; i < PARTICLES; ++i) u[3 * i] = kStretch * kX[3 * i];
  OK(cleave_displacement_gradient(&net, 0, PARTICLES, u, H));
  OK(cleave_material_history_count(CLEAVE_MATERIAL_svk, &history));
  REQUIRE(history == 0);
  OK(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN, 3, kProperties, 0, PARTICLES,
                            H, NULL, P, energy, NULL));
  for (i = 0; i < PARTICLES; ++i) {
    REQUIRE(near(H[9 * i], kStretch, 1));
    REQUIRE(near(P[9 * i], expected_p11(), expected_p11()));
    REQUIRE(near(energy[i], expected_energy(), expected_energy()));
  }
  OK(cleave_material_wave_speed(CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN, 3, kProperties, &c0));
  REQUIRE(near(c0, sqrt(2.4e9 / 1000), c0));
  for (i = 0; i < 3 * PARTICLES; ++i) force[i] = 0;
  OK(cleave_bond_force(&net, 0, PARTICLES, P, force));
}

static void check_force(const double* force) {
  /* Uniform stress on a unit square: each corner gets half of a side's P11 in x, pulling inwards;
   * in y half of P22 = S22 = lambda E11. */
  const double p11 = expected_p11(), p22 = 0.8e9 * (kStretch + 0.5 * kStretch * kStretch);
  int i;
  for (i = 0; i < PARTICLES; ++i) {
    REQUIRE(near(force[3 * i], (kX[3 * i] > 0 ? -0.5 : 0.5) * p11, p11));
    REQUIRE(near(force[3 * i + 1], (kX[3 * i + 1] > 0 ? -0.5 : 0.5) * p22, p11));
    REQUIRE(force[3 * i + 2] == 0);
  }
}

static void model_run(const double* expected_force) {
  cleave_model* model = NULL;
  cleave_body_spec spec;
  cleave_energies energies;
  cleave_counts counts;
  int64_t body = -1, step = -1;
  double u[3 * PARTICLES] = {0}, force[3 * PARTICLES], dt = 0, time = -1, total;
  int i;
  OK(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  OK(cleave_body_spec_init(&spec));
  spec.kinematics = CLEAVE_PLANE_STRAIN;
  spec.particles = PARTICLES;
  spec.X = kX;
  spec.simplex_count = SIMPLICES;
  spec.simplices = kSimplices;
  spec.name = "square";
  OK(cleave_body_add(model, &spec, &body));
  OK(cleave_body_set_real(model, body, "material", "rho", kProperties[0]));
  OK(cleave_body_set_real(model, body, "material", "E", kProperties[1]));
  OK(cleave_body_set_real(model, body, "material", "nu", kProperties[2]));
  OK(cleave_model_setup(model));
  for (i = 0; i < PARTICLES; ++i) u[3 * i] = kStretch * kX[3 * i];
  OK(cleave_field_put_real(model, body, "displacement", 0, PARTICLES, u));
  OK(cleave_model_initialise(model, 0.0));
  OK(cleave_field_get_real(model, body, "internal_force", 0, PARTICLES, force));
  REQUIRE(memcmp(force, expected_force, sizeof force) == 0); /* the array calls, to the bit */
  memset(&energies, 0, sizeof energies);
  energies.size = sizeof energies;
  OK(cleave_energies_get(model, body, &energies));
  total = expected_energy(); /* of a unit square */
  REQUIRE(near(energies.elastic, total, total));
  OK(cleave_model_stable_step(model, &dt));
  /* Corner 1 has a sixth of the mass; stiffness over mass (1/3 + 1/6 + 1/6) / (1/6) = 4 c0^2, so the
   * length is 2/sqrt(1.2 * 4), below the shortest edge; c0 = sqrt(2.4e6). */
  REQUIRE(near(dt, 0.9 * 2 / sqrt(1.2 * 4) / sqrt(2.4e6), dt));
  dt *= 0.01;
  for (i = 1; i <= 100; ++i) {
    OK(cleave_model_advance(model, dt, i * dt));
    OK(cleave_model_update(model));
  }
  OK(cleave_model_clock(model, &step, &time));
  REQUIRE(step == 100 && time == 100 * dt);
  OK(cleave_energies_get(model, -1, &energies));
  REQUIRE(energies.kinetic > 0.01 * total);
  REQUIRE(fabs(energies.balance) < 1e-4 * total); /* measured 1e-6 */
  memset(&counts, 0, sizeof counts);
  counts.size = sizeof counts;
  OK(cleave_counts_get(model, -1, &counts));
  REQUIRE(counts.particles == 4 && counts.bonds == 5 && counts.simplices == 2);
  OK(cleave_model_destroy(model));
}

static void mistakes(void) {
  char text[16];
  int64_t length = 0;
  REQUIRE(cleave_cbm_count_bonds(NULL, 0, NULL) == CLEAVE_NULL_ARGUMENT);
  REQUIRE(cleave_abi_check(CLEAVE_ABI_VERSION - 1) == CLEAVE_ABI_MISMATCH);
  OK(cleave_last_message(text, (int64_t)sizeof text, &length));
  REQUIRE(strlen(text) == sizeof text - 1 && length > (int64_t)sizeof text);
  REQUIRE(strcmp(cleave_status_text(CLEAVE_OK), "no error") == 0);
}

int main(void) {
  double force[3 * PARTICLES];
  REQUIRE(strcmp(cleave_version(), CLEAVE_VERSION) == 0);
  array_calls(force);
  check_force(force);
  model_run(force);
  mistakes();
  return 0;
}
