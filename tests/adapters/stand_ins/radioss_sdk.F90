! Stand-in for the modules of OpenRadioss' user library kit: names, order and lengths of what a user
! routine of a solid is handed, in REAL*8, or REAL*4 with MYREAL4.
#ifdef MYREAL4
#define HOST_REAL real
#else
#define HOST_REAL double precision
#endif
module law_user
  implicit none
  type ulawbuf
    integer :: id
    character(len=500) :: name
  end type ulawbuf
end module law_user

module law_userso
  implicit none
  integer, parameter :: mvsiz = 129
  type ulawintbuf
    integer :: ncycle, id, iptr, ipts, iptt
    HOST_REAL, dimension(mvsiz) :: r11, r12, r13, r21, r22, r23, r31, r32, r33
    HOST_REAL, dimension(mvsiz) :: epspxx, epspyy, epspzz, epspxy, epspyz, epspzx
    HOST_REAL, dimension(mvsiz) :: epsxx, epsyy, epszz, epsxy, epsyz, epszx
    HOST_REAL, dimension(mvsiz) :: fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx, fpsyx, fpszy, fpsxz
    HOST_REAL, dimension(mvsiz) :: upsxx, upsyy, upszz, upsxy, upsyz, upsxz
    HOST_REAL, dimension(mvsiz) :: depsxx, depsyy, depszz, depsxy, depsyz, depszx
    HOST_REAL, dimension(mvsiz) :: sigoxx, sigoyy, sigozz, sigoxy, sigoyz, sigozx
    HOST_REAL, dimension(mvsiz) :: rho0, temp, dvol, tb, bfrac
    HOST_REAL, dimension(mvsiz) :: signxx, signyy, signzz, signxy, signyz, signzx
    HOST_REAL, dimension(mvsiz) :: sigvxx, sigvyy, sigvzz, sigvxy, sigvyz, sigvzx
    HOST_REAL, dimension(mvsiz) :: dpla
  end type ulawintbuf
end module law_userso
