
! Fields with extents as Fortran 77 gives them, a(ncomp,*).
module cleave77_values
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave, only: cleave_model, cleave_field_get_real, cleave_field_put_real, &
      cleave_field_get_integer, cleave_field_put_integer, cleave_field_interpolate
  implicit none
  private
  public :: get_real, put_real, get_integer, put_integer, interpolate

contains

  recursive function get_real(model, ibody, name, nfirst, nlast, ncomp, n, a) result(status)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: ibody, nfirst, nlast, ncomp, n
    character(len=*), intent(in) :: name
    real(c_double), intent(inout) :: a(ncomp, n)
    integer(c_int32_t) :: status
    status = cleave_field_get_real(model, ibody, name, nfirst, nlast, a)
  end function get_real

  recursive function put_real(model, ibody, name, nfirst, nlast, ncomp, n, a) result(status)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: ibody, nfirst, nlast, ncomp, n
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: a(ncomp, n)
    integer(c_int32_t) :: status
    status = cleave_field_put_real(model, ibody, name, nfirst, nlast, a)
  end function put_real

  recursive function get_integer(model, ibody, name, nfirst, nlast, ncomp, n, a) result(status)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: ibody, nfirst, nlast, ncomp, n
    character(len=*), intent(in) :: name
    integer, intent(inout) :: a(ncomp, n)
    integer(c_int32_t) :: status
    status = cleave_field_get_integer(model, ibody, name, nfirst, nlast, a)
  end function get_integer

  recursive function put_integer(model, ibody, name, nfirst, nlast, ncomp, n, a) result(status)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: ibody, nfirst, nlast, ncomp, n
    character(len=*), intent(in) :: name
    integer, intent(in) :: a(ncomp, n)
    integer(c_int32_t) :: status
    status = cleave_field_put_integer(model, ibody, name, nfirst, nlast, a)
  end function put_integer

  recursive function interpolate(model, ibody, name, n, nsim, wgt, ncomp, a) result(status)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: ibody, n, nsim(n), ncomp
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: wgt(4, n)
    real(c_double), intent(inout) :: a(ncomp, n)
    integer(c_int32_t) :: status
    status = cleave_field_interpolate(model, ibody, name, nsim, wgt, a)
  end function interpolate
end module cleave77_values
