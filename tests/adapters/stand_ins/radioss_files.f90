! Files on Fortran units, for stand-ins of hosts that hand unit numbers over.
subroutine cleave_test_open(unit, name)
  implicit none
  integer, intent(in) :: unit
  character(len=*), intent(in) :: name
  open (unit=unit, file=name, form='formatted')
end subroutine cleave_test_open

subroutine cleave_test_close(unit)
  implicit none
  integer, intent(in) :: unit
  close (unit)
end subroutine cleave_test_close
