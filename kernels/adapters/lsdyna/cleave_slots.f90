! What the owner of an LS-DYNA executable decides: which law stands behind which user material, and
! what happens on an error. LS-DYNA's cards hold numbers only, so the law is chosen here: the number
! after umat, MT on the card. This is the only file of the adapter that is meant to be changed.
module cleave_slots
  implicit none
  private
  public :: cleave_slot, cleave_slot_count, cleave_slots_table, cleave_stop_host

  ! `plastic_strain`: the place, from 1, of the equivalent plastic strain in the history of the law,
  ! for LS-DYNA's effective plastic strain; 0: the law has none. The manual lists the history.
  type :: cleave_slot
    integer :: number
    character(len=32) :: law
    integer :: plastic_strain
  end type cleave_slot

  integer, parameter :: cleave_slot_count = 9
  type(cleave_slot), parameter :: cleave_slots_table(cleave_slot_count) = (/ &
    cleave_slot(41, 'svk             ', 0), &
    cleave_slot(42, 'j2              ', 7), &
    cleave_slot(43, 'j2_power        ', 7), &
    cleave_slot(44, 'j2_table        ', 7), &
    cleave_slot(45, 'johnson_cook    ', 7), &
    cleave_slot(46, 'johnson_cook_eos', 7), &
    cleave_slot(47, 'mie_gruneisen   ', 0), &
    cleave_slot(48, 'neo_hooke       ', 0), &
    cleave_slot(49, 'linear_elastic  ', 0) /)

contains

  ! Called with the text of an error. adios(2) is LS-DYNA's own orderly end with an error; messages
  ! of user materials go to the standard output.
  recursive subroutine cleave_stop_host(message)
    character(len=*), intent(in) :: message
    external :: adios
    write (*, '(2a)') ' *** Error: Cleave: ', trim(message)
    call adios(2)
  end subroutine cleave_stop_host
end module cleave_slots
