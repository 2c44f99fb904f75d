/* The ABAQUSNL interface of CalculiX (umat_abaqusnl.f, @ABAQUSNL_LIB_FUNC), for one law of the table. It
 * has the arguments of an Abaqus UMAT and means other things by some of them; see adapters/abaqus for
 * Abaqus itself. CalculiX 2.20 prints a line at every call here: the native interface is the one to use.
 *
 *   constants      as in the native interface (native.h), no more than 21
 *   deformation    DFGRD1 (3,3) in global axes. In the iteration that spreads prescribed displacements
 *                  it is not the one meant; there DSTRAN is zero and DFGRD0 is used, whose response is
 *                  the same whenever DSTRAN is zero.
 *   stress         STRESS = R^T sigma R, 11 22 33 12 13 23; CalculiX makes the second Piola-Kirchhoff
 *                  stress of it by the stretch U
 *   tangent        DDSDDE (6,6). CalculiX transforms it by U^-1 on all four indices and takes the result
 *                  for dS/dE, without J and without stress terms. So it has to be J c, c the tangent of
 *                  the Truesdell rate of sigma in axes turned back by R, and not the Jaumann tangent
 *                  over J that Abaqus takes.
 *   state          STATEV is already a copy of the state at the start
 *   local axes     with *ORIENTATION the stress would be in local and DFGRD1 in global axes, and nothing
 *                  tells: do not use it, the laws are isotropic
 *   no answer      PNEWDT = 0.25; in dynamic steps, KSTEP(2) = 4, explicit ones cannot be told from others
 *                  and would go on without a stress: the program ends
 *   not touched    SSE SPD SCD RPL and the thermal derivatives
 */
#ifndef CLEAVE_CALCULIX_UMAT_H
#define CLEAVE_CALCULIX_UMAT_H

#include "adapter.h"

#define CALCULIX_UMAT_PARAMETERS                                                                 \
  double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd,         \
      double *rpl, double *ddsddt, double *drplde, double *drpldt, const double *stran,          \
      const double *dstran, const double *time, const double *dtime, const double *temp,         \
      const double *dtemp, const double *predef, const double *dpred, const char *cmname,        \
      const int *ndi, const int *nshr, const int *ntens, const int *nstatv, const double *props, \
      const int *nprops, const double *coords, const double *drot, double *pnewdt,               \
      const double *celent, const double *dfgrd0, const double *dfgrd1, const int *noel,         \
      const int *npt, const int *layer, const int *kspt, const int *kstep, const int *kinc,      \
      int cmname_length

void calculix_umat(enum cleave_calculix_place place, double* stress, double* statev, double* ddsdde,
                   const double* dstran, const double* dtime, const int* ntens, const int* nstatv,
                   const double* props, const int* nprops, double* pnewdt, const double* dfgrd0,
                   const double* dfgrd1, const int* noel, const int* npt, const int* kstep);

#endif
