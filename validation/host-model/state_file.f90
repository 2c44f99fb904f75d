! Fields of a body in an unformatted file, each with its name, by way of the fields table: no list of
! fields is written here, so none can be forgotten when Cleave gets a new one.
module state_file
  use, intrinsic :: iso_c_binding, only: c_int64_t
  use cleave
  use mesh, only: dp
  use status_check, only: check
  implicit none
  private
  public :: write_fields, read_fields, write_fingerprint, same_fingerprint

contains

  ! What a restart needs: fields that are fixed after set-up and fields that evolve. With
  ! `everything` also those that are computed from them.
  function wanted(field, everything) result(is)
    type(cleave_field), intent(in) :: field
    logical, intent(in) :: everything
    logical :: is
    is = field%lifetime == CLEAVE_LIFETIME_SETUP .or. field%lifetime == CLEAVE_LIFETIME_STATE .or. &
        (everything .and. field%lifetime /= CLEAVE_LIFETIME_SCRATCH)
  end function wanted

  subroutine write_fields(unit, model, body, everything)
    integer, intent(in) :: unit, body
    type(cleave_model), intent(in) :: model
    logical, intent(in) :: everything
    type(cleave_field) :: field
    real(dp), allocatable :: reals(:,:)
    integer, allocatable :: integers(:,:)
    integer :: fields, k, n
    call check(cleave_field_count(model, body, fields))
    do k = 1, fields
      call check(cleave_field_get(model, body, k, field))
      if (.not. wanted(field, everything)) cycle
      n = int(field%count)
      write (unit) field%name, field%type, field%components, n
      if (field%type == CLEAVE_REAL) then
        allocate (reals(field%components, n))
        call check(cleave_field_get_real(model, body, field%name, 1, n, reals))
        write (unit) reals
        deallocate (reals)
      else
        allocate (integers(field%components, n))
        call check(cleave_field_get_integer(model, body, field%name, 1, n, integers))
        write (unit) integers
        deallocate (integers)
      end if
    end do
    field%name = 'end'
    write (unit) field%name, 0, 0, 0
  end subroutine write_fields

  ! Into a body that was made as the one the fields were taken from.
  subroutine read_fields(unit, model, body)
    integer, intent(in) :: unit, body
    type(cleave_model), intent(in) :: model
    type(cleave_field) :: field
    real(dp), allocatable :: reals(:,:)
    integer, allocatable :: integers(:,:)
    integer :: n
    do
      read (unit) field%name, field%type, field%components, n
      if (field%type == 0) exit
      if (field%type == CLEAVE_REAL) then
        allocate (reals(field%components, n))
        read (unit) reals
        call check(cleave_field_put_real(model, body, field%name, 1, n, reals))
        deallocate (reals)
      else
        allocate (integers(field%components, n))
        read (unit) integers
        call check(cleave_field_put_integer(model, body, field%name, 1, n, integers))
        deallocate (integers)
      end if
    end do
  end subroutine read_fields

  ! A number that changes with the fields table: a file of another version is refused.
  subroutine write_fingerprint(unit)
    integer, intent(in) :: unit
    integer(c_int64_t) :: fingerprint
    call check(cleave_field_table_fingerprint(fingerprint))
    write (unit) fingerprint
  end subroutine write_fingerprint

  function same_fingerprint(unit) result(same)
    integer, intent(in) :: unit
    logical :: same
    integer(c_int64_t) :: fingerprint, read_one
    read (unit) read_one
    call check(cleave_field_table_fingerprint(fingerprint))
    same = read_one == fingerprint
  end function same_fingerprint
end module state_file
