/* The laws of the materials table as CalculiX needs them, looked up once, and the call for one point. */
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "adapter.h"

static calculix_law laws[CLEAVE_CALCULIX_LAWS] = {
#define CLEAVE_CALCULIX_LAW(upper, name) {#name, 0, 0, 0, 0, {0}},
#include "laws.def"
};
static pthread_once_t looked_up = PTHREAD_ONCE_INIT;

void calculix_stop(const char* law, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  printf("\n *ERROR in the Cleave material %s: ", law);
  vprintf(format, arguments);
  printf("\n");
  va_end(arguments);
  fflush(stdout);
  exit(201); /* as CalculiX itself */
}

void calculix_stop_without_answer(const calculix_law* law, int element, int point) {
  calculix_stop(
      law->name,
      "element %d, point %d: the deformation is outside the range of the law; take smaller "
      "increments or a finer mesh there",
      element, point);
}

static void stop_with_last_message(const char* law) {
  char text[1024] = "";
  cleave_last_message(text, (int64_t)sizeof text, NULL);
  calculix_stop(law, "%s", text);
}

static void look_up_law(calculix_law* law) {
  if (cleave_table_find(CLEAVE_TABLE_MATERIAL, law->name, &law->material) != CLEAVE_OK ||
      cleave_parameter_count(law->name, &law->properties) != CLEAVE_OK ||
      cleave_material_history_count(law->material, &law->history) != CLEAVE_OK)
    stop_with_last_message(law->name);
  if (law->properties > CALCULIX_PROPERTIES)
    calculix_stop(law->name, "the law has %lld properties, the adapter room for %d; enlarge it",
                  (long long)law->properties, CALCULIX_PROPERTIES);
  law->constants = law->properties < CALCULIX_CONSTANTS ? law->properties : CALCULIX_CONSTANTS;
  for (int64_t k = 0; k < law->properties; ++k) {
    cleave_parameter parameter;
    parameter.size = (int64_t)sizeof parameter;
    if (cleave_parameter_get(law->name, k, &parameter) != CLEAVE_OK)
      stop_with_last_message(law->name);
    law->defaults[k] = parameter.required ? 0.0 : parameter.default_value;
  }
}

static void look_up(void) {
  for (int k = 0; k < CLEAVE_CALCULIX_LAWS; ++k) look_up_law(&laws[k]);
}

const calculix_law* calculix_find(enum cleave_calculix_place place, int constants,
                                  const double* given, int state_variables, double* properties) {
  pthread_once(&looked_up, look_up);
  const calculix_law* law = &laws[place];
  if (constants != law->constants)
    calculix_stop(
        law->name,
        "*USER MATERIAL, CONSTANTS=%d was given; it takes %lld, in the order of `cleave keys "
        "material`%s",
        constants, (long long)law->constants,
        law->constants < law->properties
            ? "; CalculiX has no room for more, the others keep their defaults"
            : "");
  if (state_variables < law->history)
    calculix_stop(law->name, "*DEPVAR gives %d state variables; write *DEPVAR with at least %lld",
                  state_variables, (long long)law->history);
  for (int64_t k = 0; k < law->properties; ++k)
    properties[k] = k < constants ? given[k] : law->defaults[k];
  return law;
}

void calculix_call(cleave_material_call* call, const calculix_law* law, const double* properties,
                   const double* F, double dt, double* history) {
  static const int64_t symmetric[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2}; /* 11 22 33 12 13 23 */
  cleave_material_call_init(call);
  call->material = law->material;
  call->kinematics = CLEAVE_3D;
  call->property_count = law->properties;
  call->properties = properties;
  call->last = 1;
  call->dt = dt;
  call->deformation = F;
  call->deformation_is_F = 1;
  call->history = law->history > 0 ? history : NULL;
  for (int c = 0; c < 9; ++c) call->stress_order[c] = symmetric[c];
}

int calculix_answered(const calculix_law* law, int32_t status) {
  if (status != CLEAVE_OK && status != CLEAVE_BAD_JACOBIAN) stop_with_last_message(law->name);
  return status == CLEAVE_OK;
}

double calculix_time_step(double dtime) { return dtime == 1.235711130e-20 ? 0.0 : dtime; }

double calculix_strain_difference(const double* F, const double* strain) {
  static const int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
  double largest = 0, scale = 0;
  for (int c = 0; c < 6; ++c) {
    const double *a = F + 3 * first[c], *b = F + 3 * second[c];
    const double metric = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const double of_F = 0.5 * (metric - (first[c] == second[c] ? 1.0 : 0.0));
    largest = fmax(largest, fabs(of_F - strain[c]));
    scale = fmax(scale, fabs(metric));
  }
  return largest / fmax(scale, 1.0);
}
