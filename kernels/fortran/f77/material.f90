
! ---- material laws. MAT: CLLAW; KIN: 1 three dimensions, 2 plane strain, 3 plane stress.
! PROP(NPROP): all parameters of the law in the order of CLPGET.

! Stress p(9,*) and energy of points nfirst..nlast from h(9,*), F - I; hist(nhist,*) is updated.
! ifail(*): 1 where the law has no answer; then IERR tells, after all points have been done.
recursive subroutine clstrs(mat, kin, nprop, prop, nfirst, nlast, h, hist, p, energy, ifail, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_laws, only: call_of, update
  use cleave_c, only: cleave_material_call, CLEAVE_OK
  implicit none
  integer, intent(in) :: mat, kin, nprop, nfirst, nlast
  real(c_double), intent(in) :: prop(*), h(*)
  real(c_double), intent(inout) :: hist(*), p(*), energy(*)
  integer, intent(inout) :: ifail(*)
  integer, intent(out) :: ierr
  type(cleave_material_call) :: c
  integer(c_int32_t) :: status
  call call_of('CLSTRS', mat, kin, nprop, nfirst, nlast, c, status)
  if (status == CLEAVE_OK) &
      status = update(c, nfirst, nlast, prop, h, hist, p, ifail, energy)
  ierr = status
end subroutine clstrs

! The same in the layout, component order and stress measure of the host. lay: as CLLAY sets it;
! layh: strides of hist from point to point and from variable to variable. isf: 0 if d is F - I, 1
! if it is F. meas: 0 first Piola-Kirchhoff, 1 second, 2 Cauchy, 3 Cauchy turned back by R, 4
! Kirchhoff. plast, visc: dissipated in this update.
recursive subroutine clupd(mat, kin, nprop, prop, nfirst, nlast, dt, alen, isf, d, layd, hist, &
    layh, meas, s, lays, energy, plast, visc, ifail, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_laws, only: call_of, laid_out, update
  use cleave77_choice, only: choice
  use cleave_c, only: cleave_material_call, CLEAVE_OK
  implicit none
  integer, intent(in) :: mat, kin, nprop, nfirst, nlast, isf, layd(11), layh(2), meas, lays(11)
  real(c_double), intent(in) :: prop(*), dt, alen, d(*)
  real(c_double), intent(inout) :: hist(*), s(*), energy(*), plast(*), visc(*)
  integer, intent(inout) :: ifail(*)
  integer, intent(out) :: ierr
  type(cleave_material_call) :: c
  integer(c_int32_t) :: status
  call call_of('CLUPD', mat, kin, nprop, nfirst, nlast, c, status)
  call laid_out(dt, alen, isf, layd, layh, lays, c)
  c%stress_measure = choice(meas)
  if (status == CLEAVE_OK) &
      status = update(c, nfirst, nlast, prop, d, hist, s, ifail, energy, plast, visc)
  ierr = status
end subroutine clupd

! Consistent tangent t, before CLUPD. itan: 0 dP/dF, 1 dS/dE, 2 Jaumann, 3 the same turned back by
! R. layt: strides of t from point to point and from entry to entry; meas and lays as for CLUPD.
recursive subroutine cltan(mat, kin, nprop, prop, nfirst, nlast, dt, alen, isf, d, layd, hist, &
    layh, itan, meas, lays, t, layt, ifail, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_laws, only: call_of, laid_out, tangent
  use cleave77_choice, only: choice
  use cleave_c, only: cleave_material_call, CLEAVE_OK
  implicit none
  integer, intent(in) :: mat, kin, nprop, nfirst, nlast, isf, layd(11), layh(2), itan, meas
  integer, intent(in) :: lays(11), layt(2)
  real(c_double), intent(in) :: prop(*), dt, alen, d(*), hist(*)
  real(c_double), intent(inout) :: t(*)
  integer, intent(inout) :: ifail(*)
  integer, intent(out) :: ierr
  type(cleave_material_call) :: c
  integer(c_int32_t) :: status
  call call_of('CLTAN', mat, kin, nprop, nfirst, nlast, c, status)
  call laid_out(dt, alen, isf, layd, layh, lays, c)
  c%stress_measure = choice(meas)
  c%tangent_measure = choice(itan)
  c%tangent_point = int(layt(1), c_int64_t)
  c%tangent_component = int(layt(2), c_int64_t)
  if (status == CLEAVE_OK) status = tangent(c, nfirst, nlast, prop, d, hist, t, ifail)
  ierr = status
end subroutine cltan

! lay(11) of a tensor array: strides from point to point and from component to component, then the
! places, from 1, of 11 21 31 12 22 32 13 23 33; 0: the array lacks it. ncomp 9: all, in this order;
! 6: symmetric, 11 22 33 12 23 31. ld = 0: a(ncomp,n); else a(ld,ncomp).
recursive subroutine cllay(ld, ncomp, lay, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave, only: CLEAVE_OK, CLEAVE_BAD_ARGUMENT
  use cleave77_support, only: refuse77, decimal77, at_least
  implicit none
  integer, intent(in) :: ld, ncomp
  integer, intent(inout) :: lay(11)
  integer, intent(out) :: ierr
  integer(c_int32_t) :: status
  integer :: k
  status = at_least('CLLAY', 'LD', ld, 0)
  if (status == CLEAVE_OK .and. ncomp /= 9 .and. ncomp /= 6) status = refuse77( &
      CLEAVE_BAD_ARGUMENT, 'CLLAY', 'NCOMP is ' // trim(decimal77(ncomp)) // '; allowed: 6, 9')
  ierr = status
  if (status /= CLEAVE_OK) return
  lay(1) = merge(ncomp, 1, ld == 0)
  lay(2) = merge(1, ld, ld == 0)
  lay(3:) = [(k, k = 1, 9)]
  if (ncomp == 6) lay(3:) = [1, 4, 6, 4, 2, 5, 6, 5, 3]
end subroutine cllay

! Number of history variables of a law.
recursive subroutine clhcnt(mat, nhist, ierr)
  use cleave, only: cleave_material_history_count
  use cleave77_choice, only: choice
  implicit none
  integer, intent(in) :: mat
  integer, intent(inout) :: nhist
  integer, intent(out) :: ierr
  ierr = cleave_material_history_count(choice(mat), nhist)
end subroutine clhcnt

! Place in the history, from 1, of the variable that is 1 where the material has failed; 0: none.
recursive subroutine cldmgp(mat, iplace, ierr)
  use cleave, only: cleave_material_damage_place
  use cleave77_choice, only: choice
  implicit none
  integer, intent(in) :: mat
  integer, intent(inout) :: iplace
  integer, intent(out) :: ierr
  ierr = cleave_material_damage_place(choice(mat), iplace)
end subroutine cldmgp

! Longitudinal wave speed of the undeformed material.
recursive subroutine clwave(mat, kin, nprop, prop, speed, ierr)
  use, intrinsic :: iso_c_binding, only: c_int64_t, c_double
  use cleave77_choice, only: choice
  use cleave_c, only: cleave_material_wave_speed
  implicit none
  integer, intent(in) :: mat, kin, nprop
  real(c_double), intent(in) :: prop(*)
  real(c_double), intent(inout) :: speed
  integer, intent(out) :: ierr
  real(c_double) :: answer
  answer = speed
  ierr = cleave_material_wave_speed(choice(mat), choice(kin), int(nprop, c_int64_t), prop, answer)
  if (ierr == 0) speed = answer
end subroutine clwave

! Smooth ramp at time t: displacement, velocity, acceleration. kind 1: of a displacement, 2: of a
! velocity.
recursive subroutine clramp(kind, value, tau, t, u, v, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_double
  use cleave, only: cleave_ramp
  use cleave77_choice, only: choice
  implicit none
  integer, intent(in) :: kind
  real(c_double), intent(in) :: value, tau, t
  real(c_double), intent(inout) :: u, v, a
  integer, intent(out) :: ierr
  ierr = cleave_ramp(choice(kind), value, tau, t, u, v, a)
end subroutine clramp
