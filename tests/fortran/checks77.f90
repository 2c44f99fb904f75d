! The results of reference.cpp for host77.f, as plain subroutines with the integers of the host.
subroutine chopen(ndim)
  use checks, only: open_reference
  implicit none
  integer, intent(in) :: ndim
  call open_reference(ndim)
end subroutine chopen

subroutine chdone()
  use checks, only: finish
  implicit none
  call finish()
end subroutine chdone

subroutine chmiss(text)
  use checks, only: require
  implicit none
  character(len=*), intent(in) :: text
  call require(.false., trim(text))
end subroutine chmiss

subroutine chgetr(name, values, n)
  use, intrinsic :: iso_c_binding, only: c_double
  use checks, only: reals
  implicit none
  character(len=*), intent(in) :: name
  real(c_double), intent(inout) :: values(*)
  integer, intent(out) :: n
  n = size(reals(name))
  values(:n) = reals(name)
end subroutine chgetr

subroutine chgeti(name, values, n)
  use checks, only: integers
  implicit none
  character(len=*), intent(in) :: name
  integer, intent(inout) :: values(*)
  integer, intent(out) :: n
  n = size(integers(name))
  values(:n) = int(integers(name), kind(n))
end subroutine chgeti

subroutine chrnge(nfirst, nlast)
  use checks, only: integers
  implicit none
  integer, intent(out) :: nfirst, nlast
  integer :: bounds(2)
  bounds = int(integers('range'), kind(bounds))
  nfirst = bounds(1) + 1
  nlast = bounds(2)
end subroutine chrnge

subroutine chsamr(name, values, n)
  use, intrinsic :: iso_c_binding, only: c_double
  use checks, only: same_reals
  implicit none
  character(len=*), intent(in) :: name
  integer, intent(in) :: n
  real(c_double), intent(in) :: values(n)
  call same_reals(name, values)
end subroutine chsamr

subroutine chsami(name, values, n)
  use, intrinsic :: iso_c_binding, only: c_int64_t
  use checks, only: same_integers
  implicit none
  character(len=*), intent(in) :: name
  integer, intent(in) :: n, values(n)
  call same_integers(name, int(values, c_int64_t))
end subroutine chsami

! Particles and half-bonds of a network.
subroutine chsam8(name, values, n)
  use, intrinsic :: iso_c_binding, only: c_int64_t
  use checks, only: same_integers
  implicit none
  character(len=*), intent(in) :: name
  integer, intent(in) :: n
  integer(c_int64_t), intent(in) :: values(n)
  call same_integers(name, values - 1_c_int64_t)
end subroutine chsam8
