! The text components of the module's types are long enough for every line of the tables, the
! particles in integer fields are those that the table says, constants are the values of a table.
program texts
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_int8_t, c_char, c_ptr, &
      c_null_char, c_f_pointer, c_associated
  use cleave_c, only: c_entry => cleave_table_entry, c_parameter => cleave_parameter, &
      c_field => cleave_field, c_table_get => cleave_table_get, &
      c_parameter_get => cleave_parameter_get, c_field_table_get => cleave_field_table_get
  use cleave
  use checks
  implicit none
  type(cleave_table_entry) :: entry
  type(cleave_parameter) :: parameter
  type(cleave_field) :: field
  integer(c_int32_t) :: table, value
  integer :: k, n
  character(len=64) :: owner

  do table = CLEAVE_TABLE_STATUS, CLEAVE_TABLE_GROUP
    call ok(cleave_table_count(table, n))
    call require(n > 3, 'lines of a table')
    do k = 1, n
      call ok(cleave_table_get(table, k, entry))
      call entry_is_whole(table, k, entry)
      call ok(cleave_table_find(table, entry%name, value))
      call require(value == entry%value, 'value of ' // entry%name)
      owner = entry%name
      if (table == CLEAVE_TABLE_MATERIAL .or. table == CLEAVE_TABLE_GROUP) call parameters(owner)
    end do
  end do
  call ok(cleave_field_table_count(n))
  do k = 1, n
    call ok(cleave_field_table_get(k, field))
    call field_is_whole(k, field)
    if (field%type == CLEAVE_INTEGER) call require( &
        (index(field%description, 'particles') == 1 .or. &
        index(field%description, 'nodes') == 1) .eqv. (field%name == 'bond_ends' .or. &
        field%name == 'simplex_particles'), 'particles in ' // field%name)
  end do
  call finish()

contains

  subroutine whole(address, text)
    type(c_ptr), intent(in) :: address
    character(len=*), intent(in) :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: length
    if (.not. c_associated(address)) then
      call require(text == ' ', 'no text')
      return
    end if
    call c_f_pointer(address, letters, [4096])
    length = 0
    do while (letters(length + 1) /= c_null_char)
      length = length + 1
    end do
    call require(length <= len(text) .and. length == len_trim(text), 'whole: ' // text)
  end subroutine whole

  subroutine entry_is_whole(table, k, entry)
    integer(c_int32_t), intent(in) :: table
    integer, intent(in) :: k
    type(cleave_table_entry), intent(in) :: entry
    type(c_entry) :: line
    line%size = size(transfer(line, [0_c_int8_t]), kind=c_int64_t)
    call ok(c_table_get(table, int(k, c_int64_t) - 1_c_int64_t, line))
    call whole(line%name, entry%name)
    call whole(line%title, entry%title)
    call whole(line%source, entry%source)
  end subroutine entry_is_whole

  subroutine parameters(owner)
    character(len=*), intent(in) :: owner
    type(c_parameter) :: line
    integer :: j, count
    call ok(cleave_parameter_count(owner, count))
    do j = 1, count
      call ok(cleave_parameter_get(owner, j, parameter))
      line%size = size(transfer(line, [0_c_int8_t]), kind=c_int64_t)
      call ok(c_parameter_get(trim(owner) // c_null_char, int(j, c_int64_t) - 1_c_int64_t, line))
      call whole(line%name, parameter%name)
      call whole(line%units, parameter%units)
      call whole(line%description, parameter%description)
      call whole(line%choices, parameter%choices)
      call whole(line%default_choice, parameter%default_choice)
      call whole(line%source, parameter%source)
    end do
  end subroutine parameters

  subroutine field_is_whole(k, field)
    integer, intent(in) :: k
    type(cleave_field), intent(in) :: field
    type(c_field) :: line
    line%size = size(transfer(line, [0_c_int8_t]), kind=c_int64_t)
    call ok(c_field_table_get(int(k, c_int64_t) - 1_c_int64_t, line))
    call whole(line%name, field%name)
    call whole(line%units, field%units)
    call whole(line%description, field%description)
    call whole(line%owner, field%owner)
    call whole(line%rebuild, field%rebuild)
  end subroutine field_is_whole
end program texts
