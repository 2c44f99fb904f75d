! What the programs of this folder share: expectations, and the results of reference.cpp by name. A
! missed expectation is told on standard error, and the program ends with status 1.
module checks
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_char, c_null_char
  use, intrinsic :: iso_fortran_env, only: error_unit
  use cleave, only: cleave_last_message, CLEAVE_OK
  implicit none
  private
  public :: require, ok, refused, finish, open_reference, reals, integers, same_reals, same_integers

  integer :: missed = 0

  interface
    function reference_open(dimension) bind(C) result(status)
      import :: c_int32_t
      implicit none
      integer(c_int32_t), value :: dimension
      integer(c_int32_t) :: status
    end function reference_open

    function reference_count(name, real) bind(C) result(n)
      import :: c_char, c_int32_t, c_int64_t
      implicit none
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), value :: real
      integer(c_int64_t) :: n
    end function reference_count

    subroutine reference_reals(name, values) bind(C)
      import :: c_char, c_double
      implicit none
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(out) :: values(*)
    end subroutine reference_reals

    subroutine reference_integers(name, values) bind(C)
      import :: c_char, c_int64_t
      implicit none
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), intent(out) :: values(*)
    end subroutine reference_integers
  end interface

contains

  subroutine require(condition, what)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    if (condition) return
    write (error_unit, '(2a)') 'missed: ', what
    missed = missed + 1
  end subroutine require

  subroutine ok(status)
    integer(c_int32_t), intent(in) :: status
    character(len=2000) :: text
    integer(c_int32_t) :: same
    if (status == CLEAVE_OK) return
    same = cleave_last_message(text)
    call require(.false., trim(text))
  end subroutine ok

  ! The status, and every part of a message, separated by bars: 'u|(3,n)'.
  subroutine refused(status, expected, parts)
    integer(c_int32_t), intent(in) :: status, expected
    character(len=*), intent(in) :: parts
    character(len=2000) :: text
    integer(c_int32_t) :: same
    integer :: from, to
    same = cleave_last_message(text)
    if (status /= expected) then
      call require(.false., 'a refusal for ' // parts // ', last message: ' // trim(text))
      return
    end if
    from = 1
    do while (from <= len(parts))
      to = index(parts(from:), '|')
      to = merge(len(parts), from + to - 2, to == 0)
      call require(index(text, parts(from:to)) > 0, parts(from:to) // ' in: ' // trim(text))
      from = to + 2
    end do
  end subroutine refused

  subroutine finish()
    if (missed > 0) stop 1
  end subroutine finish

  subroutine open_reference(dimension)
    integer, intent(in) :: dimension
    call ok(reference_open(int(dimension, c_int32_t)))
    call finish()
  end subroutine open_reference

  function reals(name) result(values)
    character(len=*), intent(in) :: name
    real(c_double), allocatable :: values(:)
    integer(c_int64_t) :: n
    n = reference_count(name // c_null_char, 1_c_int32_t)
    call require(n >= 0, 'there is no reference ' // name)
    allocate (values(max(n, 0_c_int64_t)))
    call reference_reals(name // c_null_char, values)
  end function reals

  function integers(name) result(values)
    character(len=*), intent(in) :: name
    integer(c_int64_t), allocatable :: values(:)
    integer(c_int64_t) :: n
    n = reference_count(name // c_null_char, 0_c_int32_t)
    call require(n >= 0, 'there is no reference ' // name)
    allocate (values(max(n, 0_c_int64_t)))
    call reference_integers(name // c_null_char, values)
  end function integers

  ! Bit by bit.
  subroutine same_reals(name, values)
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:)
    real(c_double), allocatable :: expected(:)
    expected = reals(name)
    call require(size(expected) > 0 .and. size(expected) == size(values), 'size of ' // name)
    if (size(expected) /= size(values)) return
    call require(all(transfer(expected, [0_c_int64_t]) == transfer(values, [0_c_int64_t])), &
        'the bits of ' // name)
  end subroutine same_reals

  subroutine same_integers(name, values)
    character(len=*), intent(in) :: name
    integer(c_int64_t), intent(in) :: values(:)
    integer(c_int64_t), allocatable :: expected(:)
    expected = integers(name)
    call require(size(expected) > 0 .and. size(expected) == size(values), 'size of ' // name)
    if (size(expected) /= size(values)) return
    call require(all(expected == values), name)
  end subroutine same_integers
end module checks
