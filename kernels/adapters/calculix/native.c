/* The native user material of CalculiX; native.h has the contract. */
#include "native.h"

#include <string.h>

/* Rounding of a strain formed in another way; measured in CalculiX: below 1e-15. Without NLGEOM a
 * displacement gradient of 1e-5 is found out. */
static const double kSameStrain = 1e-11;

static const double* meant_gradient(const calculix_law* law, int element, const double* emec,
                                    const double* xokl, const double* xkl) {
  if (calculix_strain_difference(xkl, emec) <= kSameStrain) return xkl;
  if (calculix_strain_difference(xokl, emec) <= kSameStrain) return xokl;
  calculix_stop(
      law->name,
      "in element %d the strain is not that of the deformation gradient; write *STEP, NLGEOM, "
      "and leave out *EXPANSION and initial strains, which the law does not know",
      element);
}

static void store_stiffness(const double* tangent, double* stiff) {
  for (int b = 0, k = 0; b < 6; ++b)
    for (int a = 0; a <= b; ++a, ++k) stiff[k] = 0.5 * (tangent[a + 6 * b] + tangent[b + 6 * a]);
}

void calculix_native(enum cleave_calculix_place place, const int* iel, const int* iint,
                     const int* kode, const double* elconloc, const double* emec,
                     const double* beta, const double* xokl, const double* xkl, const double* dtime,
                     const int* icmd, const int* mi, const int* nstate, const double* xstateini,
                     double* xstate, double* stre, double* stiff, double* pnewdt) {
  double properties[CALCULIX_PROPERTIES], tangent[36];
  const calculix_law* law = calculix_find(place, -*kode - 100, elconloc, *nstate, properties);
  for (int c = 0; c < 6; ++c)
    if (beta[c] != 0)
      calculix_stop(law->name, "element %d has an initial stress, which the law does not know",
                    *iel);

  const size_t column =
      (size_t)*nstate * ((size_t)(*iint - 1) + (size_t)mi[0] * (size_t)(*iel - 1));
  double* history = xstate + column;
  if (*nstate > 0) memcpy(history, xstateini + column, (size_t)*nstate * sizeof(double));

  cleave_material_call call;
  calculix_call(&call, law, properties, meant_gradient(law, *iel, emec, xokl, xkl),
                calculix_time_step(*dtime), history);
  call.stress = stre;
  call.stress_measure = CLEAVE_STRESS_SECOND_PIOLA;
  call.tangent = tangent;
  call.tangent_measure = CLEAVE_TANGENT_SECOND_PIOLA;

  int answered = 1;
  if (*icmd != 3) answered = calculix_answered(law, cleave_material_tangent(&call));
  if (answered && *icmd != 3) store_stiffness(tangent, stiff);
  answered = calculix_answered(law, cleave_material_update(&call)) && answered;
  if (answered) return;
  if (*icmd == 3) calculix_stop_without_answer(law, *iel, *iint);
  *pnewdt = 0.25;
}
