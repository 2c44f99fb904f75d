
! ---- the model handle. MOD: the number CLMNEW gives; models live side by side.

! A new model.
recursive subroutine clmnew(mod, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: create
  implicit none
  integer, intent(inout) :: mod
  integer, intent(out) :: ierr
  integer(c_int32_t) :: status
  call create(mod, status)
  ierr = status
end subroutine clmnew

! Ends a model; its number is not used again.
recursive subroutine clmdel(mod, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: destroy
  implicit none
  integer, intent(in) :: mod
  integer, intent(out) :: ierr
  integer(c_int32_t) :: status
  call destroy(mod, status)
  ierr = status
end subroutine clmdel

! Threads the kernels may use; 1 without this call. Results do not depend on it.
recursive subroutine clmthr(mod, nthr, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_set_threads, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, nthr
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMTHR', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_set_threads(model, nthr)
  ierr = status
end subroutine clmthr

! Order of operations of a step: 1 blocks, without this call; 2 that of the array calls.
recursive subroutine clmord(mod, iord, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_set_order, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, iord
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMORD', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_set_order(model, int(iord, c_int32_t))
  ierr = status
end subroutine clmord

! Checks everything and builds bonds, masses and fields.
recursive subroutine clmset(mod, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_setup, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMSET', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_setup(model)
  ierr = status
end subroutine clmset

! Largest stable step.
recursive subroutine clmstp(mod, step, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_stable_step, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(inout) :: step
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMSTP', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_stable_step(model, step)
  ierr = status
end subroutine clmstp

! Whether dt is not above it: 1 or 0.
recursive subroutine clmsta(mod, dt, istab, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_is_stable, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: dt
  integer, intent(inout) :: istab
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status, stable
  stable = 0
  call model_of('CLMSTA', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_is_stable(model, dt, stable)
  if (status == CLEAVE_OK) istab = stable
  ierr = status
end subroutine clmsta

! Forces and accelerations at the start.
recursive subroutine clmini(mod, time, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_initialise, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: time
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMINI', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_initialise(model, time)
  ierr = status
end subroutine clmini

! First half of a step, to time tnew: velocities and displacements.
recursive subroutine clmadv(mod, dt, tnew, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_advance, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: dt, tnew
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMADV', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_advance(model, dt, tnew)
  ierr = status
end subroutine clmadv

! Second half of a step: cracks, stresses, forces, velocities.
recursive subroutine clmupd(mod, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_update, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLMUPD', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_update(model)
  ierr = status
end subroutine clmupd

! The next static equilibrium. tol, maxit: 0 for the defaults; niter, resid: what it took.
recursive subroutine clsolv(mod, tnew, tol, maxit, niter, resid, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_model_solve_static, cleave_static_options, &
      cleave_static_options_init, cleave_static_report, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: tnew, tol
  integer, intent(in) :: maxit
  integer, intent(inout) :: niter
  real(c_double), intent(inout) :: resid
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_static_options) :: options
  type(cleave_static_report) :: report
  call model_of('CLSOLV', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_static_options_init(options)
  if (tol > 0) options%tolerance = tol
  if (maxit > 0) options%max_iterations = choice(maxit)
  if (status == CLEAVE_OK) status = cleave_model_solve_static(model, tnew, options, report)
  if (status == CLEAVE_OK) then
    niter = int(report%iterations, kind(niter))
    resid = report%residual
  end if
  ierr = status
end subroutine clsolv

! The same, but no further than to where a first bond reaches its limit: frac is 1, or with the state as before
! the part of the way to there. ncrit: bonds beyond their limits now.
recursive subroutine clsoll(mod, tnew, tol, maxit, niter, resid, frac, ncrit, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_model_solve_static, cleave_static_options, &
      cleave_static_options_init, cleave_static_report, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: tnew, tol
  integer, intent(in) :: maxit
  integer, intent(inout) :: niter, ncrit
  real(c_double), intent(inout) :: resid, frac
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_static_options) :: options
  type(cleave_static_report) :: report
  call model_of('CLSOLL', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_static_options_init(options)
  if (tol > 0) options%tolerance = tol
  if (maxit > 0) options%max_iterations = choice(maxit)
  options%stop_at_limit = 1
  if (status == CLEAVE_OK) status = cleave_model_solve_static(model, tnew, options, report)
  if (status == CLEAVE_OK) then
    niter = int(report%iterations, kind(niter))
    resid = report%residual
    frac = report%fraction
    ncrit = int(report%critical, kind(ncrit))
  end if
  ierr = status
end subroutine clsoll

! Breaks bonds that are beyond their limits and finds the equilibrium under the same loads. ibreak: a value of enum
! cleave_breaking, 0 for all; nbroke: bonds that broke, 0: none was beyond; ncrit: bonds beyond their limits now.
recursive subroutine clbrks(mod, tol, maxit, ibreak, niter, nbroke, ncrit, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_model_break_static, cleave_static_options, &
      cleave_static_options_init, cleave_static_report, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: tol
  integer, intent(in) :: maxit, ibreak
  integer, intent(inout) :: niter, nbroke, ncrit
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_static_options) :: options
  type(cleave_static_report) :: report
  call model_of('CLBRKS', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_static_options_init(options)
  if (tol > 0) options%tolerance = tol
  if (maxit > 0) options%max_iterations = choice(maxit)
  if (ibreak /= 0) options%breaking = choice(ibreak)
  if (status == CLEAVE_OK) status = cleave_model_break_static(model, options, report)
  if (status == CLEAVE_OK) then
    niter = int(report%iterations, kind(niter))
    nbroke = int(report%broken, kind(nbroke))
    ncrit = int(report%critical, kind(ncrit))
  end if
  ierr = status
end subroutine clbrks

! The next equilibrium by relaxation, with bonds that break. tol, maxit: 0 for the defaults; ione: 1 to break
! one bond at a time; nslice: iterations of this call, 0 until it is done. niter, nbroke, resid: what the
! increment took so far; idone: 0 if the slice is used up and the same call goes on.
recursive subroutine clrelx(mod, tnew, tol, maxit, ione, nslice, niter, nbroke, resid, idone, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_relax, cleave_relaxation_options, &
      cleave_relaxation_options_init, cleave_relaxation_report, CLEAVE_BREAKING_ONE, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(in) :: tnew, tol
  integer, intent(in) :: maxit, ione, nslice
  integer, intent(inout) :: niter, nbroke
  real(c_double), intent(inout) :: resid
  integer, intent(inout) :: idone
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_relaxation_options) :: options
  type(cleave_relaxation_report) :: report
  call model_of('CLRELX', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_relaxation_options_init(options)
  if (tol > 0) options%tolerance = tol
  if (maxit > 0) options%max_iterations = maxit
  if (ione == 1) options%breaking = CLEAVE_BREAKING_ONE
  options%slice = int(nslice, c_int64_t)
  if (status == CLEAVE_OK) status = cleave_model_relax(model, tnew, options, report)
  if (status == CLEAVE_OK) then
    niter = int(report%iterations, kind(niter))
    nbroke = int(report%broken, kind(nbroke))
    resid = report%residual
    idone = merge(1, 0, report%finished)
  end if
  ierr = status
end subroutine clrelx

! Back to the equilibrium before the increment that is being relaxed.
recursive subroutine clrlxc(mod, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_relax_cancel, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLRLXC', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_relax_cancel(model)
  ierr = status
end subroutine clrlxc

! After all fields were put: rebuilds what follows from them, sets the clock.
recursive subroutine clrest(mod, istep, time, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_restore, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, istep
  real(c_double), intent(in) :: time
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLREST', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_restore(model, istep, time)
  ierr = status
end subroutine clrest

! Number of steps done, and the time.
recursive subroutine clclk(mod, istep, time, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_clock, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  integer, intent(inout) :: istep
  real(c_double), intent(inout) :: time
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLCLK', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_clock(model, istep, time)
  ierr = status
end subroutine clclk

! Bytes held by the model; a real number, because they may not fit an INTEGER.
recursive subroutine clmmem(mod, bytes, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double, c_int64_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_model_memory, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  real(c_double), intent(inout) :: bytes
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  integer(c_int64_t) :: held
  call model_of('CLMMEM', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_model_memory(model, held)
  if (status == CLEAVE_OK) bytes = real(held, c_double)
  ierr = status
end subroutine clmmem
