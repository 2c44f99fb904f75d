
! ---- fields of a body, by name.

! Number of fields.
recursive subroutine clfcnt(mod, ibody, ncount, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_field_count, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  integer, intent(inout) :: ncount
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLFCNT', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_field_count(model, ibody, ncount)
  ierr = status
end subroutine clfcnt

! The index-th field: its name, units, components, entries, type (1 real, 2 integer), lifetime (1
! set-up, 2 state, 3 cache, 4 scratch, 5 derived). A restart file needs 1 and 2.
recursive subroutine clfget(mod, ibody, index, name, units, ncomp, ncount, itype, ilife, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_field_get, cleave_field, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, index
  character(len=*), intent(out) :: name, units
  integer, intent(inout) :: ncomp, ncount, itype, ilife
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_field) :: field
  call model_of('CLFGET', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_field_get(model, ibody, index, field)
  name = field%name
  units = field%units
  if (status == CLEAVE_OK) then
    ncomp = int(field%components, kind(ncomp))
    ncount = int(field%count, kind(ncount))
    itype = int(field%type, kind(itype))
    ilife = int(field%lifetime, kind(ilife))
  end if
  ierr = status
end subroutine clfget

! The same of the field called name.
recursive subroutine clffnd(mod, ibody, name, ncomp, ncount, itype, ilife, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_field_find, cleave_field, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: name
  integer, intent(inout) :: ncomp, ncount, itype, ilife
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_field) :: field
  call model_of('CLFFND', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_field_find(model, ibody, name, field)
  if (status == CLEAVE_OK) then
    ncomp = int(field%components, kind(ncomp))
    ncount = int(field%count, kind(ncount))
    itype = int(field%type, kind(itype))
    ilife = int(field%lifetime, kind(ilife))
  end if
  ierr = status
end subroutine clffnd

! Values a(ncomp,*) of a real field, entries nfirst..nlast.
recursive subroutine clfgtr(mod, ibody, name, nfirst, nlast, ncomp, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, CLEAVE_OK
  use cleave77_values, only: get_real
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: name
  integer, intent(in) :: nfirst, nlast, ncomp
  real(c_double), intent(inout) :: a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLFGTR', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLFGTR', 'NFIRST', nfirst, 1)
  if (status == CLEAVE_OK) status = at_least('CLFGTR', 'NLAST', nlast, nfirst - 1)
  if (status == CLEAVE_OK) status = at_least('CLFGTR', 'NCOMP', ncomp, 1)
  if (status == CLEAVE_OK) status = get_real(model, ibody, name, nfirst, nlast, ncomp, &
      nlast - nfirst + 1, a)
  ierr = status
end subroutine clfgtr

! Sets values of a real field.
recursive subroutine clfptr(mod, ibody, name, nfirst, nlast, ncomp, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, CLEAVE_OK
  use cleave77_values, only: put_real
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: name
  integer, intent(in) :: nfirst, nlast, ncomp
  real(c_double), intent(in) :: a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLFPTR', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLFPTR', 'NFIRST', nfirst, 1)
  if (status == CLEAVE_OK) status = at_least('CLFPTR', 'NLAST', nlast, nfirst - 1)
  if (status == CLEAVE_OK) status = at_least('CLFPTR', 'NCOMP', ncomp, 1)
  if (status == CLEAVE_OK) status = put_real(model, ibody, name, nfirst, nlast, ncomp, &
      nlast - nfirst + 1, a)
  ierr = status
end subroutine clfptr

! Values of an integer field; particles count from 1, 0: none.
recursive subroutine clfgti(mod, ibody, name, nfirst, nlast, ncomp, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, CLEAVE_OK
  use cleave77_values, only: get_integer
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: name
  integer, intent(in) :: nfirst, nlast, ncomp
  integer, intent(inout) :: a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLFGTI', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLFGTI', 'NFIRST', nfirst, 1)
  if (status == CLEAVE_OK) status = at_least('CLFGTI', 'NLAST', nlast, nfirst - 1)
  if (status == CLEAVE_OK) status = at_least('CLFGTI', 'NCOMP', ncomp, 1)
  if (status == CLEAVE_OK) status = get_integer(model, ibody, name, nfirst, nlast, ncomp, &
      nlast - nfirst + 1, a)
  ierr = status
end subroutine clfgti

! Sets values of an integer field.
recursive subroutine clfpti(mod, ibody, name, nfirst, nlast, ncomp, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, CLEAVE_OK
  use cleave77_values, only: put_integer
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: name
  integer, intent(in) :: nfirst, nlast, ncomp, a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLFPTI', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLFPTI', 'NFIRST', nfirst, 1)
  if (status == CLEAVE_OK) status = at_least('CLFPTI', 'NLAST', nlast, nfirst - 1)
  if (status == CLEAVE_OK) status = at_least('CLFPTI', 'NCOMP', ncomp, 1)
  if (status == CLEAVE_OK) status = put_integer(model, ibody, name, nfirst, nlast, ncomp, &
      nlast - nfirst + 1, a)
  ierr = status
end subroutine clfpti

! Where the points x(3,n) of the reference configuration are: simplex nsim(n), 0 outside; wgt(4,n).
recursive subroutine clloc(mod, ibody, n, x, nsim, wgt, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_locate, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n
  real(c_double), intent(in) :: x(3, *)
  integer, intent(inout) :: nsim(*)
  real(c_double), intent(inout) :: wgt(4, *)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLLOC', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLLOC', 'N', n, 0)
  if (status == CLEAVE_OK) &
      status = cleave_body_locate(model, ibody, x(:, :n), nsim(:n), wgt(:, :n))
  ierr = status
end subroutine clloc

! A field at the n points of CLLOC: a(ncomp,n).
recursive subroutine clintp(mod, ibody, name, n, nsim, wgt, ncomp, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, CLEAVE_OK
  use cleave77_values, only: interpolate
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: name
  integer, intent(in) :: n, nsim(*)
  real(c_double), intent(in) :: wgt(4, *)
  integer, intent(in) :: ncomp
  real(c_double), intent(inout) :: a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLINTP', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLINTP', 'N', n, 0)
  if (status == CLEAVE_OK) status = at_least('CLINTP', 'NCOMP', ncomp, 1)
  if (status == CLEAVE_OK) &
      status = interpolate(model, ibody, name, n, nsim, wgt, ncomp, a)
  ierr = status
end subroutine clintp
