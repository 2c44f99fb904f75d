/* The native user material of CalculiX (umat_user.f, @LIB_FUNC), for one law of the table.
 *
 *   point          one call each, from several threads of CalculiX
 *   constants      -kode - 100 of them in elconloc: the law's properties in the order of `cleave keys
 *                  material`; laws with more than 21 keep the defaults of the rest. The density of the
 *                  law heats and shocks; the masses come from *DENSITY, which has to repeat it.
 *   deformation    xkl (3,3) at the end of the increment, as Fortran keeps it; xokl at its start
 *   strain         emec, Green-Lagrange, tensor shear: not used by the laws. It says which of the two
 *                  gradients is meant: in the iteration that spreads prescribed displacements it
 *                  belongs to xokl. If it belongs to neither, the step has no NLGEOM, or there are
 *                  thermal or initial strains: the program ends.
 *   state          xstateini, xstate (nstate, mi(1), elements) of the whole model, column (iint, iel); the
 *                  laws keep theirs in the reference configuration, so no frame has to be turned
 *   stress         stre, second Piola-Kirchhoff, 11 22 33 12 13 23. Residual stresses (beta) are not
 *                  known to the laws: the program ends if there are any.
 *   stiffness      stiff (21), dS/dE, upper triangle column by column, symmetrised; not for icmd = 3.
 *                  Explicit steps take the wave speed from that of the first call.
 *   local axes     iorien: nothing to do, the laws are isotropic
 *   ielas          not used: the increment is always evaluated as it is
 *   energy         CalculiX integrates S dE itself
 *   length         none is handed over: laws with shock viscosity run without it
 *   no answer      pnewdt = 0.25, a smaller increment is tried; with icmd = 3 (explicit steps) there is
 *                  none to try and the program ends
 *   deletion       CalculiX has none
 */
#ifndef CLEAVE_CALCULIX_NATIVE_H
#define CLEAVE_CALCULIX_NATIVE_H

#include "adapter.h"

#define CALCULIX_NATIVE_PARAMETERS                                                             \
  const char *amat, const int *iel, const int *iint, const int *kode, const double *elconloc,  \
      const double *emec, const double *emec0, const double *beta, const double *xokl,         \
      const double *voj, const double *xkl, const double *vj, const int *ithermal,             \
      const double *t1l, const double *dtime, const double *time, const double *ttime,         \
      const int *icmd, const int *ielas, const int *mi, const int *nstate,                     \
      const double *xstateini, double *xstate, double *stre, double *stiff, const int *iorien, \
      const double *pgauss, const double *orab, double *pnewdt, const int *ipkon, int amat_length

void calculix_native(enum cleave_calculix_place place, const int* iel, const int* iint,
                     const int* kode, const double* elconloc, const double* emec,
                     const double* beta, const double* xokl, const double* xkl, const double* dtime,
                     const int* icmd, const int* mi, const int* nstate, const double* xstateini,
                     double* xstate, double* stre, double* stiff, double* pnewdt);

#endif
