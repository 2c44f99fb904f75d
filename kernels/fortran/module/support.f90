
! The only place where Fortran's ways become C's and back: indices from 1, blank-padded text,
! integers of two kinds, refusals with a message.
module cleave_support
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_char, c_null_char, c_ptr, &
      c_associated, c_f_pointer
  use cleave_constants, only: CLEAVE_OK, CLEAVE_BAD_RANGE
  use cleave_c_tables, only: cleave_set_last_message
  implicit none
  private
  public :: zero_based, one_based, narrow, c_text, f_text, refuse, decimal, range_fits, &
      index_fits

  ! A 0-based index of a 1-based one; the inclusive range first..last is zero_based(first), last.
  interface zero_based
    module procedure zero_based_int32
    module procedure zero_based_int32_list
    module procedure zero_based_int32_table
    module procedure zero_based_int64
    module procedure zero_based_int64_list
    module procedure zero_based_int64_table
  end interface zero_based

  interface one_based
    module procedure one_based_one
    module procedure one_based_list
  end interface one_based

  ! Into the host's kind of integer; BAD_RANGE where it does not fit.
  interface narrow
    module procedure narrow_int32
    module procedure narrow_int64
  end interface narrow

contains

  recursive function zero_based_int32(index) result(shifted)
    integer(c_int32_t), intent(in) :: index
    integer(c_int64_t) :: shifted
    shifted = int(index, c_int64_t) - 1_c_int64_t
  end function zero_based_int32

  recursive function zero_based_int32_list(index) result(shifted)
    integer(c_int32_t), intent(in) :: index(:)
    integer(c_int64_t) :: shifted(size(index))
    shifted = int(index, c_int64_t) - 1_c_int64_t
  end function zero_based_int32_list

  recursive function zero_based_int32_table(index) result(shifted)
    integer(c_int32_t), intent(in) :: index(:,:)
    integer(c_int64_t) :: shifted(size(index, 1), size(index, 2))
    shifted = int(index, c_int64_t) - 1_c_int64_t
  end function zero_based_int32_table

  recursive function zero_based_int64(index) result(shifted)
    integer(c_int64_t), intent(in) :: index
    integer(c_int64_t) :: shifted
    shifted = int(index, c_int64_t) - 1_c_int64_t
  end function zero_based_int64

  recursive function zero_based_int64_list(index) result(shifted)
    integer(c_int64_t), intent(in) :: index(:)
    integer(c_int64_t) :: shifted(size(index))
    shifted = int(index, c_int64_t) - 1_c_int64_t
  end function zero_based_int64_list

  recursive function zero_based_int64_table(index) result(shifted)
    integer(c_int64_t), intent(in) :: index(:,:)
    integer(c_int64_t) :: shifted(size(index, 1), size(index, 2))
    shifted = int(index, c_int64_t) - 1_c_int64_t
  end function zero_based_int64_table

  recursive function one_based_one(index) result(shifted)
    integer(c_int64_t), intent(in) :: index
    integer(c_int64_t) :: shifted
    shifted = int(index, c_int64_t) + 1_c_int64_t
  end function one_based_one

  recursive function one_based_list(index) result(shifted)
    integer(c_int64_t), intent(in) :: index(:)
    integer(c_int64_t) :: shifted(size(index))
    shifted = int(index, c_int64_t) + 1_c_int64_t
  end function one_based_list

  ! After a call that returned `before`: an earlier error stays, and its value is not handed on.
  recursive function narrow_int32(before, procedure, wide, value) result(status)
    integer(c_int32_t), intent(in) :: before
    character(len=*), intent(in) :: procedure
    integer(c_int64_t), intent(in) :: wide
    integer(c_int32_t), intent(inout) :: value
    integer(c_int32_t) :: status
    status = before
    if (status /= CLEAVE_OK) return
    if (abs(wide) > int(huge(value), c_int64_t)) then
      status = refuse(CLEAVE_BAD_RANGE, procedure, 'the result ' // trim(decimal(wide)) // &
          ' does not fit into 32 bits; give integers of kind c_int64_t')
    else
      value = int(wide, c_int32_t)
    end if
  end function narrow_int32

  recursive function narrow_int64(before, procedure, wide, value) result(status)
    integer(c_int32_t), intent(in) :: before
    character(len=*), intent(in) :: procedure
    integer(c_int64_t), intent(in) :: wide
    integer(c_int64_t), intent(inout) :: value
    integer(c_int32_t) :: status
    status = before
    if (status == CLEAVE_OK .and. len(procedure) > 0) value = wide
  end function narrow_int64

  ! Text for C: blanks around it removed, NUL at its end.
  recursive function c_text(text) result(terminated)
    character(len=*), intent(in) :: text
    character(kind=c_char, len=len_trim(adjustl(text)) + 1) :: terminated
    terminated = trim(adjustl(text)) // c_null_char
  end function c_text

  ! Text of C, padded with blanks or cut to the length of `text`.
  recursive subroutine f_text(address, text)
    type(c_ptr), intent(in) :: address
    character(len=*), intent(out) :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: k
    text = ' '
    if (.not. c_associated(address)) return
    call c_f_pointer(address, letters, [len(text)])
    do k = 1, len(text)
      if (letters(k) == c_null_char) return
      text(k:k) = letters(k)
    end do
  end subroutine f_text

  ! `status`, with "procedure: what" as the last message of this thread.
  recursive function refuse(status, procedure, what) result(same)
    integer(c_int32_t), intent(in) :: status
    character(len=*), intent(in) :: procedure, what
    integer(c_int32_t) :: same
    same = cleave_set_last_message(c_text(procedure // ': ' // what))
    same = status
  end function refuse

  recursive function decimal(number) result(text)
    integer(c_int64_t), intent(in) :: number
    character(len=20) :: text
    write (text, '(i0)') number
  end function decimal

  ! first..last lies inside 1..n; first = last + 1 is an empty range.
  recursive function range_fits(procedure, first, last, n) result(status)
    character(len=*), intent(in) :: procedure
    integer(c_int64_t), intent(in) :: first, last, n
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (first >= 1 .and. last <= n .and. last >= first - 1) return
    status = refuse(CLEAVE_BAD_RANGE, procedure, 'range ' // trim(decimal(first)) // ' to ' // &
        trim(decimal(last)) // ' (inclusive) does not lie inside 1 to ' // trim(decimal(n)))
  end function range_fits

  recursive function index_fits(procedure, index, n) result(status)
    character(len=*), intent(in) :: procedure
    integer(c_int64_t), intent(in) :: index, n
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (index >= 1 .and. index <= n) return
    status = refuse(CLEAVE_BAD_RANGE, procedure, 'index ' // trim(decimal(index)) // &
        ' does not lie inside 1 to ' // trim(decimal(n)))
  end function index_fits
end module cleave_support
