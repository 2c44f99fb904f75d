/* The functions that CalculiX finds in libCLEAVE.so: for law j2 of the materials table J2, reached by
 * *MATERIAL, NAME=@CLEAVE_J2@ANYTHING, and UMAT_J2, reached by NAME=@ABAQUSNL_CLEAVE_UMAT_J2@ANYTHING. CalculiX
 * turns names into capitals, so these are capitals; laws.def is written by CMake from the table. */
#include "native.h"
#include "umat.h"

#define CLEAVE_CALCULIX_LAW(upper, name)                                                         \
  CLEAVE_API void upper(CALCULIX_NATIVE_PARAMETERS);                                             \
  CLEAVE_API void upper(CALCULIX_NATIVE_PARAMETERS) {                                            \
    (void)amat, (void)emec0, (void)voj, (void)vj, (void)ithermal, (void)t1l, (void)time;         \
    (void)ttime, (void)ielas, (void)iorien, (void)pgauss, (void)orab, (void)ipkon;               \
    (void)amat_length;                                                                           \
    calculix_native(CLEAVE_CALCULIX_##upper, iel, iint, kode, elconloc, emec, beta, xokl, xkl,   \
                    dtime, icmd, mi, nstate, xstateini, xstate, stre, stiff, pnewdt);            \
  }                                                                                              \
  CLEAVE_API void UMAT_##upper(CALCULIX_UMAT_PARAMETERS);                                        \
  CLEAVE_API void UMAT_##upper(CALCULIX_UMAT_PARAMETERS) {                                       \
    (void)sse, (void)spd, (void)scd, (void)rpl, (void)ddsddt, (void)drplde, (void)drpldt;        \
    (void)stran, (void)time, (void)temp, (void)dtemp, (void)predef, (void)dpred, (void)cmname;   \
    (void)ndi, (void)nshr, (void)coords, (void)drot, (void)celent, (void)layer, (void)kspt;      \
    (void)kinc, (void)cmname_length;                                                             \
    calculix_umat(CLEAVE_CALCULIX_##upper, stress, statev, ddsdde, dstran, dtime, ntens, nstatv, \
                  props, nprops, pnewdt, dfgrd0, dfgrd1, noel, npt, kstep);                      \
  }
#include "laws.def"
