! What this code does when a call of Cleave fails: says why and where, and stops in order.
module status_check
  use, intrinsic :: iso_fortran_env, only: error_unit
  use cleave, only: CLEAVE_OK, cleave_status_text, cleave_last_message
  implicit none
  private
  public :: check, message_of

contains

  subroutine check(status)
    integer, intent(in) :: status
    if (status == CLEAVE_OK) return
    write (error_unit, '(a)') trim(message_of(status))
    stop 1
  end subroutine check

  ! The meaning of the status, and what the failed call has to say.
  function message_of(status) result(text)
    integer, intent(in) :: status
    character(len=1024) :: text
    character(len=900) :: message
    integer :: length, failed
    failed = cleave_last_message(message, length)
    text = trim(cleave_status_text(status)) // ': ' // message
    if (failed /= CLEAVE_OK) text = cleave_status_text(status)
  end function message_of
end module status_check
