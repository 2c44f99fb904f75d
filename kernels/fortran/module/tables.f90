
! Lines of the tables with text in place of addresses, messages, and what has no counts or indices.
module cleave_described
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_int8_t, c_double, c_char
  use cleave_constants, only: CLEAVE_ABI_VERSION
  use cleave_support, only: c_text, f_text
  use cleave_c, only: c_table_entry => cleave_table_entry, c_parameter => cleave_parameter, &
      c_field => cleave_field, c_version => cleave_version, c_abi_check => cleave_abi_check, &
      c_last_message => cleave_last_message, c_set_last_message => cleave_set_last_message, &
      c_status_text => cleave_status_text, c_table_find => cleave_table_find, &
      c_fingerprint => cleave_field_table_fingerprint
  implicit none
  private
  public :: cleave_table_entry, cleave_parameter, cleave_field
  public :: from_c, sized_entry, sized_parameter, sized_field, message
  public :: cleave_version, cleave_abi_check, cleave_last_message, cleave_set_last_message, &
      cleave_status_text, cleave_table_find, cleave_field_table_fingerprint

  type :: cleave_table_entry
    integer(c_int32_t) :: value = 0
    character(len=64) :: name = ' '
    character(len=128) :: title = ' '
    character(len=256) :: source = ' '
  end type cleave_table_entry

  type :: cleave_parameter
    character(len=64) :: name = ' '
    character(len=32) :: units = ' '
    character(len=512) :: description = ' '
    character(len=256) :: choices = ' '
    character(len=64) :: default_choice = ' '
    character(len=256) :: source = ' '
    real(c_double) :: minimum = 0
    real(c_double) :: maximum = 0
    real(c_double) :: default_value = 0
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: minimum_excluded = 0
    integer(c_int32_t) :: maximum_excluded = 0
    integer(c_int32_t) :: required = 0
  end type cleave_parameter

  type :: cleave_field
    character(len=64) :: name = ' '
    character(len=32) :: units = ' '
    character(len=512) :: description = ' '
    character(len=64) :: owner = ' '
    character(len=256) :: rebuild = ' '
    integer(c_int64_t) :: count = 0
    integer(c_int32_t) :: components = 0
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: relation = 0
    integer(c_int32_t) :: lifetime = 0
    integer(c_int32_t) :: output = 0
  end type cleave_field

  interface from_c
    module procedure entry_from_c
    module procedure parameter_from_c
    module procedure field_from_c
  end interface from_c

  interface cleave_last_message
    module procedure last_message
  end interface cleave_last_message
  interface cleave_version
    module procedure version
  end interface cleave_version
  interface cleave_abi_check
    module procedure abi_check
  end interface cleave_abi_check
  interface cleave_set_last_message
    module procedure set_last_message
  end interface cleave_set_last_message
  interface cleave_status_text
    module procedure status_text
  end interface cleave_status_text
  interface cleave_table_find
    module procedure table_find
  end interface cleave_table_find
  interface cleave_field_table_fingerprint
    module procedure field_table_fingerprint
  end interface cleave_field_table_fingerprint

contains

  recursive function entry_from_c(line) result(entry)
    type(c_table_entry), intent(in) :: line
    type(cleave_table_entry) :: entry
    entry%value = line%value
    call f_text(line%name, entry%name)
    call f_text(line%title, entry%title)
    call f_text(line%source, entry%source)
  end function entry_from_c

  recursive function parameter_from_c(line) result(parameter)
    type(c_parameter), intent(in) :: line
    type(cleave_parameter) :: parameter
    call f_text(line%name, parameter%name)
    call f_text(line%units, parameter%units)
    call f_text(line%description, parameter%description)
    call f_text(line%choices, parameter%choices)
    call f_text(line%default_choice, parameter%default_choice)
    call f_text(line%source, parameter%source)
    parameter%minimum = line%minimum
    parameter%maximum = line%maximum
    parameter%default_value = line%default_value
    parameter%type = line%type
    parameter%minimum_excluded = line%minimum_excluded
    parameter%maximum_excluded = line%maximum_excluded
    parameter%required = line%required
  end function parameter_from_c

  recursive function field_from_c(line) result(field)
    type(c_field), intent(in) :: line
    type(cleave_field) :: field
    call f_text(line%name, field%name)
    call f_text(line%units, field%units)
    call f_text(line%description, field%description)
    call f_text(line%owner, field%owner)
    call f_text(line%rebuild, field%rebuild)
    field%count = line%count
    field%components = line%components
    field%type = line%type
    field%relation = line%relation
    field%lifetime = line%lifetime
    field%output = line%output
  end function field_from_c

  ! Structs as C wants to receive them: with their size.
  recursive function sized_entry() result(line)
    type(c_table_entry) :: line
    line%size = size(transfer(line, [0_c_int8_t]), kind=c_int64_t)
  end function sized_entry

  recursive function sized_parameter() result(line)
    type(c_parameter) :: line
    line%size = size(transfer(line, [0_c_int8_t]), kind=c_int64_t)
  end function sized_parameter

  recursive function sized_field() result(line)
    type(c_field) :: line
    line%size = size(transfer(line, [0_c_int8_t]), kind=c_int64_t)
  end function sized_field

  ! The last message of this thread, and its full length.
  recursive subroutine message(text, length, status)
    character(len=*), intent(out) :: text
    integer(c_int64_t), intent(out) :: length
    integer(c_int32_t), intent(out) :: status
    character(kind=c_char) :: letters(len(text) + 1)
    integer :: k
    text = ' '
    status = c_last_message(letters, size(letters, kind=c_int64_t), length)
    do k = 1, int(min(length, int(len(text), c_int64_t)))
      text(k:k) = letters(k)
    end do
  end subroutine message

  recursive function last_message(text) result(status)
    character(len=*), intent(out) :: text
    integer(c_int32_t) :: status
    integer(c_int64_t) :: length
    call message(text, length, status)
  end function last_message

  recursive function version() result(text)
    character(len=16) :: text
    call f_text(c_version(), text)
  end function version

  ! Without `abi`: is the library the one this module was compiled for?
  recursive function abi_check(abi) result(status)
    integer(c_int32_t), intent(in), optional :: abi
    integer(c_int32_t) :: status
    if (present(abi)) then
      status = c_abi_check(abi)
    else
      status = c_abi_check(CLEAVE_ABI_VERSION)
    end if
  end function abi_check

  recursive function set_last_message(text) result(status)
    character(len=*), intent(in) :: text
    integer(c_int32_t) :: status
    status = c_set_last_message(c_text(text))
  end function set_last_message

  recursive function status_text(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(len=96) :: text
    call f_text(c_status_text(status), text)
  end function status_text

  recursive function table_find(table, name, value) result(status)
    integer(c_int32_t), intent(in) :: table
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(inout) :: value
    integer(c_int32_t) :: status
    integer(c_int32_t) :: found
    found = value
    status = c_table_find(table, c_text(name), found)
    value = found
  end function table_find

  recursive function field_table_fingerprint(fingerprint) result(status)
    integer(c_int64_t), intent(out) :: fingerprint
    integer(c_int32_t) :: status
    status = c_fingerprint(fingerprint)
  end function field_table_fingerprint
end module cleave_described
