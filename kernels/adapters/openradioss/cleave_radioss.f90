! What starter and engine routines of the OpenRadioss adapter share: how a law and its properties
! stand in UPARAM, where the law's variables are found, and messages.
module cleave_radioss
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use cleave, only: cleave_field, CLEAVE_OK, cleave_parameter, cleave_table_entry, &
    CLEAVE_TABLE_MATERIAL, CLEAVE_BAD_ARGUMENT, cleave_field_table_count, cleave_field_table_get, &
    cleave_parameter_get, cleave_table_count, cleave_table_get
  use cleave_adapter, only: adapter_fail, adapter_find_law, adapter_law, adapter_message, &
    adapter_message_length
  implicit none
  private
  public :: radioss_head, radioss_law, radioss_plastic_strain_place, radioss_stop
  public :: radioss_check_density_place, radioss_length

  ! UPARAM: the law's number in the materials table, which never changes its meaning; the place of
  ! the equivalent plastic strain in its history, 0 if it has none; then the properties.
  integer, parameter :: radioss_head = 2

contains

  ! The law with this number.
  recursive subroutine radioss_law(number, law, status)
    integer, intent(in) :: number
    type(adapter_law), intent(out) :: law
    integer(c_int32_t), intent(out) :: status
    type(cleave_table_entry) :: entry
    integer(c_int64_t) :: count, i
    character(len=12) :: text

    status = cleave_table_count(CLEAVE_TABLE_MATERIAL, count)
    do i = 1, count
      if (status == CLEAVE_OK) status = cleave_table_get(CLEAVE_TABLE_MATERIAL, i, entry)
      if (status /= CLEAVE_OK) return
      if (entry%value == number) then
        call adapter_find_law(entry%name, law, status)
        return
      end if
    end do
    write (text, '(i0)') number
    call adapter_fail(CLEAVE_BAD_ARGUMENT, 'material number ' // trim(text) // &
      ' of the restart file is not in the materials table; run starter and engine with the ' // &
      'same user library', status)
  end subroutine radioss_law

  ! Where the equivalent plastic strain stands in the history, from 1; 0: nowhere.
  recursive subroutine radioss_plastic_strain_place(law, place, status)
    type(adapter_law), intent(in) :: law
    integer, intent(out) :: place
    integer(c_int32_t), intent(out) :: status
    type(cleave_field) :: field
    integer(c_int64_t) :: count, i
    integer :: next

    place = 0
    next = 1
    status = cleave_field_table_count(count)
    do i = 1, count
      if (status == CLEAVE_OK) status = cleave_field_table_get(i, field)
      if (status /= CLEAVE_OK) return
      if (field%owner /= law%name) cycle
      if (field%name == 'equivalent_plastic_strain') place = next
      next = next + field%components
    end do
  end subroutine radioss_plastic_strain_place

  ! The adapter compares the first property with the host's density.
  recursive subroutine radioss_check_density_place(law, status)
    type(adapter_law), intent(in) :: law
    integer(c_int32_t), intent(out) :: status
    type(cleave_parameter) :: parameter
    status = cleave_parameter_get(trim(law%name), 1_c_int64_t, parameter)
    if (status == CLEAVE_OK .and. parameter%name /= 'rho') &
      call adapter_fail(CLEAVE_BAD_ARGUMENT, 'the first property of law ' // trim(law%name) // &
        ' is ' // trim(parameter%name) // ', not rho', status)
  end subroutine radioss_check_density_place

  ! Ends the run in the host's way, after the last message of this thread in its listing.
  ! WRITE_IOUT and ARRET are routines of OpenRadioss.
  recursive subroutine radioss_stop(place)
    character(len=*), intent(in) :: place
    character(len=adapter_message_length) :: text
    character(len=adapter_message_length + 100) :: line
    external :: write_iout, arret
    call adapter_message(text)
    line = ' ** ERROR IN CLEAVE (' // place // '): ' // text
    call write_iout(line, len_trim(line))
    call arret(2)
  end subroutine radioss_stop

  ! Size of an element. In another file than its loop, one element a call: gfortran makes vectors of
  ! a loop over x**y, of another accuracy, and bits would depend on the place in the group.
  recursive subroutine radioss_length(volume, length)
    real(c_double), intent(in) :: volume
    real(c_double), intent(out) :: length
    length = volume**(1.0_c_double / 3)
  end subroutine radioss_length
end module cleave_radioss
