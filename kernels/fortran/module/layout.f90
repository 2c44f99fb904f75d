
! Extents of the host's arrays against what a call needs. The last extent may be larger than needed,
! the others must be equal; the message names the argument, its shape and the shape needed.
module cleave_layout
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  use cleave_constants, only: CLEAVE_OK, CLEAVE_BAD_ARGUMENT
  use cleave_support, only: refuse, decimal
  implicit none
  private
  public :: layout, shape_fits, layout_fits, length_fits, same_length

  ! Component c of entry i stands at i * point + c * component, both from 0.
  type :: layout
    integer(c_int64_t) :: point = 1
    integer(c_int64_t) :: component = 1
    integer(c_int64_t) :: components = 1
  end type layout

contains

  ! `given`, the shape of an argument, against (needed(1), ..., at least needed(last)).
  recursive function shape_fits(procedure, argument, given, needed) result(status)
    character(len=*), intent(in) :: procedure, argument
    integer, intent(in) :: given(:)
    integer(c_int64_t), intent(in) :: needed(:)
    integer(c_int32_t) :: status
    integer :: r
    status = CLEAVE_OK
    r = size(given)
    if (all(int(given(:r - 1), c_int64_t) == needed(:r - 1)) .and. &
        int(given(r), c_int64_t) >= needed(r)) return
    status = wrong_shape(procedure, argument, given, trim(shape_text(needed)) // ' or more')
  end function shape_fits

  recursive function length_fits(procedure, argument, given, needed) result(status)
    character(len=*), intent(in) :: procedure, argument
    integer, intent(in) :: given
    integer(c_int64_t), intent(in) :: needed
    integer(c_int32_t) :: status
    status = shape_fits(procedure, argument, [given], [needed])
  end function length_fits

  ! Lists that belong together.
  recursive function same_length(procedure, argument, given, other, length) result(status)
    character(len=*), intent(in) :: procedure, argument, other
    integer, intent(in) :: given, length
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (given == length) return
    status = wrong_shape(procedure, argument, [given], &
        trim(shape_text([int(length, c_int64_t)])) // ', as ' // other)
  end function same_length

  ! a(c,n), a(3,3,n) where components follow one another; a(ld,c), a(ld,3,3) where points do; any
  ! other strides: as many entries as they reach.
  recursive function layout_fits(procedure, argument, given, needed, n) result(status)
    character(len=*), intent(in) :: procedure, argument
    integer, intent(in) :: given(:)
    type(layout), intent(in) :: needed
    integer(c_int64_t), intent(in) :: n
    integer(c_int32_t) :: status
    integer(c_int64_t) :: extent(size(given)), reach
    integer :: r
    status = CLEAVE_OK
    extent = int(given, c_int64_t)
    r = size(given)
    if (needed%component == 1 .and. needed%point >= needed%components) then
      if (product(extent(:r - 1)) == needed%point .and. extent(r) >= n) return
      if (r == 3) then
        status = wrong_shape(procedure, argument, given, &
            trim(shape_text([3_c_int64_t, 3_c_int64_t, n])) // ' or more')
      else
        status = wrong_shape(procedure, argument, given, &
            trim(shape_text([needed%point, n])) // ' or more')
      end if
    else if (needed%point == 1 .and. needed%component >= n) then
      if (extent(1) == needed%component .and. product(extent(2:)) >= needed%components) return
      status = wrong_shape(procedure, argument, given, &
          trim(shape_text([needed%component, needed%components])))
    else
      reach = (n - 1) * needed%point + (needed%components - 1) * needed%component + 1
      if (n == 0 .or. product(extent) >= reach) return
      status = wrong_shape(procedure, argument, given, trim(decimal(reach)) // ' entries')
    end if
  end function layout_fits

  recursive function wrong_shape(procedure, argument, given, needed) result(status)
    character(len=*), intent(in) :: procedure, argument, needed
    integer, intent(in) :: given(:)
    integer(c_int32_t) :: status
    status = refuse(CLEAVE_BAD_ARGUMENT, procedure, 'argument ''' // argument // &
        ''' has shape ' // trim(shape_text(int(given, c_int64_t))) // '; needed: ' // needed)
  end function wrong_shape

  ! Of up to three extents.
  recursive function shape_text(extents) result(text)
    integer(c_int64_t), intent(in) :: extents(:)
    character(len=80) :: text
    integer :: k
    text = '(' // trim(decimal(extents(1)))
    do k = 2, size(extents)
      text = trim(text) // ',' // trim(decimal(extents(k)))
    end do
    text = trim(text) // ')'
  end function shape_text
end module cleave_layout
