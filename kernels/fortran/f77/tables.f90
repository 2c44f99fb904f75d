
! ---- messages and tables

! Version of the library, "major.minor.patch".
recursive subroutine clvers(text)
  use cleave, only: cleave_version
  implicit none
  character(len=*), intent(out) :: text
  text = cleave_version()
end subroutine clvers

! Is the library the one this layer was compiled for?
recursive subroutine clabi(ierr)
  use cleave, only: cleave_abi_check
  implicit none
  integer, intent(out) :: ierr
  ierr = cleave_abi_check()
end subroutine clabi

! Last message of this thread; length: of the whole message, which is cut to fit text.
recursive subroutine clmsg(text, length)
  use cleave, only: cleave_last_message, CLEAVE_OK
  implicit none
  character(len=*), intent(out) :: text
  integer, intent(out) :: length
  if (cleave_last_message(text, length) /= CLEAVE_OK) text = ' '
end subroutine clmsg

! Sets the last message of this thread.
recursive subroutine clsmsg(text)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave, only: cleave_set_last_message
  implicit none
  character(len=*), intent(in) :: text
  integer(c_int32_t) :: status
  status = cleave_set_last_message(text)
end subroutine clsmsg

! What a value of IERR means.
recursive subroutine clstat(istat, text)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave, only: cleave_status_text
  implicit none
  integer, intent(in) :: istat
  character(len=*), intent(out) :: text
  integer :: known
  known = max(-1, min(istat, 9999))  ! none beyond
  text = cleave_status_text(int(known, c_int32_t))
end subroutine clstat

! Number of lines of table 1 status, 2 materials, 3 formulations, 4 parameter groups.
recursive subroutine cltcnt(itable, ncount, ierr)
  use cleave, only: cleave_table_count
  use cleave77_choice, only: choice
  implicit none
  integer, intent(in) :: itable
  integer, intent(inout) :: ncount
  integer, intent(out) :: ierr
  ierr = cleave_table_count(choice(itable), ncount)
end subroutine cltcnt

recursive subroutine cltget(itable, index, ivalue, name, title, ierr)
  use cleave, only: cleave_table_get, cleave_table_entry
  use cleave77_choice, only: choice
  implicit none
  integer, intent(in) :: itable, index
  integer, intent(out) :: ivalue
  character(len=*), intent(out) :: name, title
  integer, intent(out) :: ierr
  type(cleave_table_entry) :: entry
  ierr = cleave_table_get(choice(itable), index, entry)
  ivalue = entry%value
  name = entry%name
  title = entry%title
end subroutine cltget

! Value of the entry called name.
recursive subroutine clfind(itable, name, ivalue, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave, only: cleave_table_find, CLEAVE_OK
  use cleave77_choice, only: choice
  implicit none
  integer, intent(in) :: itable
  character(len=*), intent(in) :: name
  integer, intent(inout) :: ivalue
  integer, intent(out) :: ierr
  integer(c_int32_t) :: value, status
  value = 0
  status = cleave_table_find(choice(itable), name, value)
  if (status == CLEAVE_OK) ivalue = value
  ierr = status
end subroutine clfind

! A material law by its name, for the argument MAT.
recursive subroutine cllaw(name, mat, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave, only: cleave_table_find, CLEAVE_TABLE_MATERIAL, CLEAVE_OK
  implicit none
  character(len=*), intent(in) :: name
  integer, intent(inout) :: mat
  integer, intent(out) :: ierr
  integer(c_int32_t) :: value, status
  value = 0
  status = cleave_table_find(CLEAVE_TABLE_MATERIAL, name, value)
  if (status == CLEAVE_OK) mat = value
  ierr = status
end subroutine cllaw

! Number of parameters of a law or group; the properties of a law are all of them, in order.
recursive subroutine clpcnt(owner, ncount, ierr)
  use cleave, only: cleave_parameter_count
  implicit none
  character(len=*), intent(in) :: owner
  integer, intent(inout) :: ncount
  integer, intent(out) :: ierr
  ierr = cleave_parameter_count(owner, ncount)
end subroutine clpcnt

! ireq 1: has no default; chosen: the default of a choice.
recursive subroutine clpget(owner, index, name, units, ireq, default, chosen, ierr)
  use, intrinsic :: iso_c_binding, only: c_double
  use cleave, only: cleave_parameter_get, cleave_parameter
  implicit none
  character(len=*), intent(in) :: owner
  integer, intent(in) :: index
  character(len=*), intent(out) :: name, units, chosen
  integer, intent(out) :: ireq, ierr
  real(c_double), intent(out) :: default
  type(cleave_parameter) :: parameter
  ierr = cleave_parameter_get(owner, index, parameter)
  name = parameter%name
  units = parameter%units
  chosen = parameter%default_choice
  default = parameter%default_value
  ireq = parameter%required
end subroutine clpget
