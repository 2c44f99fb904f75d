/* What the two interfaces of the CalculiX adapter share: the laws with what has to be known of them at
 * every point, and how a wrong deck stops the program. Internal; hosts see the functions of entries.c.
 *
 * CalculiX has no way to hand an error back, and a state without stress would run on with exit code 0.
 * So a wrong deck ends the program in the host's own style: a line "*ERROR" on standard output and exit
 * code 201, as its built-in user materials do. This is the adapter's part, on the host's side of the
 * interface; the library below prints and exits nowhere. */
#ifndef CLEAVE_CALCULIX_ADAPTER_H
#define CLEAVE_CALCULIX_ADAPTER_H

#include <stdint.h>

#include "cleave/cleave.h"

enum {
  /* CalculiX copies the constants of a user material to a local array of this size (resultsmech.f) and
   * does not check: more would write past it. */
  CALCULIX_CONSTANTS = 21,
  CALCULIX_PROPERTIES = 64 /* room for those of a law here; checked at the first call */
};

enum cleave_calculix_place {
#define CLEAVE_CALCULIX_LAW(upper, name) CLEAVE_CALCULIX_##upper,
#include "laws.def"
  CLEAVE_CALCULIX_LAWS
};

typedef struct calculix_law {
  const char* name;
  int32_t material;
  int64_t properties; /* of the law */
  int64_t constants;  /* to be given in a deck: all properties, at most CALCULIX_CONSTANTS */
  int64_t history;
  double defaults[CALCULIX_PROPERTIES];
} calculix_law;

/* Ends the program with a message; `law` is its name in the table. */
void calculix_stop(const char* law, const char* format, ...)
    __attribute__((noreturn, format(printf, 2, 3)));

/* The same where the law has no answer and no smaller increment can be asked for. */
void calculix_stop_without_answer(const calculix_law* law, int element, int point)
    __attribute__((noreturn));

/* The law, after its number of constants and of state variables has been compared with the deck's.
 * [out] properties (CALCULIX_PROPERTIES): the constants given, then the defaults of the others */
const calculix_law* calculix_find(enum cleave_calculix_place place, int constants,
                                  const double* given, int state_variables, double* properties);

/* A call for one point in the orders of CalculiX: 11 22 33 12 13 23, F(3,3) as Fortran keeps it. */
void calculix_call(cleave_material_call* call, const calculix_law* law, const double* properties,
                   const double* F, double dt, double* history);

/* 1 if status says that the law has an answer, 0 if it has none; any other error ends the program. */
int calculix_answered(const calculix_law* law, int32_t status);

/* dtime of the call for the initial acceleration of a dynamic step, where CalculiX writes the first
 * primes in place of a time (nonlingeo.c): no time passes, so there are no rates. */
double calculix_time_step(double dtime);

/* Largest difference of the strain to that of F, over the largest entry of F^T F.
 * [in] strain: Green-Lagrange, 11 22 33 12 13 23 */
double calculix_strain_difference(const double* F, const double* strain);

#endif
