/* The ABAQUSNL interface of CalculiX; umat.h has the contract. */
#include "umat.h"

#include <math.h>

/* Log strains are formed anew at both ends of the increment, so a zero is zero to rounding. */
static const double kNoStrain = 1e-12;

static const int kDynamic = 4; /* procedures of CalculiX in KSTEP(2) */

static int is_at_rest(const double* dstran) {
  double largest = 0;
  for (int c = 0; c < 6; ++c) largest = fmax(largest, fabs(dstran[c]));
  return largest <= kNoStrain;
}

static double determinant(const double* F) {
  return F[0] * (F[4] * F[8] - F[7] * F[5]) - F[3] * (F[1] * F[8] - F[7] * F[2]) +
         F[6] * (F[1] * F[5] - F[4] * F[2]);
}

/* Jaumann to Truesdell: c_ijkl - (d_ik s_jl + d_il s_jk + d_jk s_il + d_jl s_ik)/2, times J. */
static void to_truesdell(const double* s, double J, double* c) {
  static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  static const int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
  for (int b = 0; b < 6; ++b)
    for (int a = 0; a < 6; ++a) {
      const int i = first[a], j = second[a], k = first[b], l = second[b];
      const double terms = (i == k ? s[place[j][l]] : 0) + (i == l ? s[place[j][k]] : 0) +
                           (j == k ? s[place[i][l]] : 0) + (j == l ? s[place[i][k]] : 0);
      c[a + 6 * b] = J * (c[a + 6 * b] - 0.5 * terms);
    }
}

void calculix_umat(enum cleave_calculix_place place, double* stress, double* statev, double* ddsdde,
                   const double* dstran, const double* dtime, const int* ntens, const int* nstatv,
                   const double* props, const int* nprops, double* pnewdt, const double* dfgrd0,
                   const double* dfgrd1, const int* noel, const int* npt, const int* kstep) {
  double properties[CALCULIX_PROPERTIES];
  const calculix_law* law = calculix_find(place, *nprops, props, *nstatv, properties);
  if (*ntens != 6)
    calculix_stop(law->name, "%d stress components are asked for; it has 6, for solid elements",
                  *ntens);

  const double* F = is_at_rest(dstran) ? dfgrd0 : dfgrd1;
  cleave_material_call call;
  calculix_call(&call, law, properties, F, calculix_time_step(*dtime), statev);
  call.stress = stress;
  call.stress_measure = CLEAVE_STRESS_COROTATED;
  call.tangent = ddsdde;
  call.tangent_measure = CLEAVE_TANGENT_COROTATED;
  const int has_tangent = calculix_answered(law, cleave_material_tangent(&call));
  const int has_stress = calculix_answered(law, cleave_material_update(&call));
  if (has_tangent && has_stress) {
    to_truesdell(stress, determinant(F), ddsdde);
    return;
  }
  if (kstep[1] == kDynamic) calculix_stop_without_answer(law, *noel, *npt);
  *pnewdt = 0.25;
}
