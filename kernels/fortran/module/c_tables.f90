
! cleave.h: messages and tables.
module cleave_c_tables
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_char, c_ptr
  use cleave_types, only: cleave_table_entry, cleave_parameter, cleave_field
  implicit none
  private
  public :: cleave_version
  public :: cleave_abi_check
  public :: cleave_last_message
  public :: cleave_set_last_message
  public :: cleave_status_text
  public :: cleave_table_count
  public :: cleave_table_get
  public :: cleave_table_find
  public :: cleave_parameter_count
  public :: cleave_parameter_get
  public :: cleave_field_table_count
  public :: cleave_field_table_get
  public :: cleave_field_table_fingerprint

  interface
    function cleave_version() bind(C) result(text)
      import :: c_ptr
      implicit none
      type(c_ptr) :: text
    end function cleave_version

    function cleave_abi_check(abi) bind(C) result(status)
      import :: c_int32_t
      implicit none
      integer(c_int32_t), value :: abi
      integer(c_int32_t) :: status
    end function cleave_abi_check

    function cleave_last_message(text, capacity, length) bind(C) result(status)
      import :: c_char, c_int64_t, c_int32_t
      implicit none
      character(kind=c_char), intent(out) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: length
      integer(c_int32_t) :: status
    end function cleave_last_message

    function cleave_set_last_message(text) bind(C) result(status)
      import :: c_char, c_int32_t
      implicit none
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int32_t) :: status
    end function cleave_set_last_message

    function cleave_status_text(code) bind(C) result(text)
      import :: c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: code
      type(c_ptr) :: text
    end function cleave_status_text

    function cleave_table_count(table, count) bind(C) result(status)
      import :: c_int32_t, c_int64_t
      implicit none
      integer(c_int32_t), value :: table
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t) :: status
    end function cleave_table_count

    function cleave_table_get(table, index, entry) bind(C) result(status)
      import :: c_int32_t, c_int64_t, cleave_table_entry
      implicit none
      integer(c_int32_t), value :: table
      integer(c_int64_t), value :: index
      type(cleave_table_entry), intent(inout) :: entry
      integer(c_int32_t) :: status
    end function cleave_table_get

    function cleave_table_find(table, name, value) bind(C) result(status)
      import :: c_int32_t, c_char
      implicit none
      integer(c_int32_t), value :: table
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), intent(out) :: value
      integer(c_int32_t) :: status
    end function cleave_table_find

    function cleave_parameter_count(owner, count) bind(C) result(status)
      import :: c_char, c_int64_t, c_int32_t
      implicit none
      character(kind=c_char), intent(in) :: owner(*)
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t) :: status
    end function cleave_parameter_count

    function cleave_parameter_get(owner, index, parameter) bind(C) result(status)
      import :: c_char, c_int64_t, cleave_parameter, c_int32_t
      implicit none
      character(kind=c_char), intent(in) :: owner(*)
      integer(c_int64_t), value :: index
      type(cleave_parameter), intent(inout) :: parameter
      integer(c_int32_t) :: status
    end function cleave_parameter_get

    function cleave_field_table_count(count) bind(C) result(status)
      import :: c_int64_t, c_int32_t
      implicit none
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t) :: status
    end function cleave_field_table_count

    function cleave_field_table_get(index, field) bind(C) result(status)
      import :: c_int64_t, cleave_field, c_int32_t
      implicit none
      integer(c_int64_t), value :: index
      type(cleave_field), intent(inout) :: field
      integer(c_int32_t) :: status
    end function cleave_field_table_get

    function cleave_field_table_fingerprint(fingerprint) bind(C) result(status)
      import :: c_int64_t, c_int32_t
      implicit none
      integer(c_int64_t), intent(out) :: fingerprint
      integer(c_int32_t) :: status
    end function cleave_field_table_fingerprint
  end interface
end module cleave_c_tables
