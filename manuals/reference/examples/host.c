/* A smallest host: a square of two triangles, its upper edge moved up, ten steps of the library.
 *
 *   cc -I kernels/include -I BUILD/include -c host.c
 *   c++ host.o BUILD/kernels/libcleave.a -o host
 *
 * Prints the force on the upper edge. */
#include <stdio.h>

#include "cleave/cleave.h"

static int failed(int32_t status) {
  char message[400];
  if (status == CLEAVE_OK) return 0;
  cleave_last_message(message, sizeof message, NULL);
  fprintf(stderr, "%s\n", message);
  return 1;
}

int main(void) {
  const double X[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const int64_t simplices[] = {0, 1, 2, 0, 2, 3};
  const int64_t particle[] = {0, 1, 2, 3}; /* y of all four is prescribed */
  const int32_t direction[] = {1, 1, 1, 1};
  const int32_t motion[] = {CLEAVE_MOTION_EXACT, CLEAVE_MOTION_EXACT, CLEAVE_MOTION_EXACT,
                            CLEAVE_MOTION_EXACT};
  double u[] = {0, 0, 0, 0}, dt, time = 0, force[3];
  int64_t body;
  cleave_model* model = NULL;
  cleave_body_spec spec;

  if (failed(cleave_body_spec_init(&spec))) return 1;
  spec.formulation = CLEAVE_FORMULATION_cbm;
  spec.kinematics = CLEAVE_PLANE_STRAIN;
  spec.material = CLEAVE_MATERIAL_svk;
  spec.particles = 4;
  spec.X = X;
  spec.simplex_count = 2;
  spec.simplices = simplices;
  spec.name = "square";

  if (failed(cleave_model_create(CLEAVE_ABI_VERSION, &model)) ||
      failed(cleave_body_add(model, &spec, &body)) ||
      failed(cleave_body_set_real(model, body, "material", "rho", 1000)) ||
      failed(cleave_body_set_real(model, body, "material", "E", 1e9)) ||
      failed(cleave_body_set_real(model, body, "material", "nu", 0.25)) ||
      failed(cleave_body_prescribe(model, body, 4, particle, direction, motion)) ||
      failed(cleave_model_setup(model)) || failed(cleave_model_stable_step(model, &dt)) ||
      failed(cleave_model_initialise(model, time)))
    return 1;
  for (int step = 1; step <= 10; ++step) {
    time = step * dt;
    u[2] = u[3] = 1e-4 * step;
    if (failed(cleave_body_motion(model, body, 4, u, NULL)) ||
        failed(cleave_model_advance(model, dt, time)) || failed(cleave_model_update(model)))
      return 1;
  }
  if (failed(cleave_body_reaction(model, body, 2, &particle[2], force))) return 1;
  printf("force on the upper edge: %.4g\n", force[1]);
  return failed(cleave_model_destroy(model));
}
