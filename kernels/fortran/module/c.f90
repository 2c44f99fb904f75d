
! cleave.h, one to one: 0-based half-open ranges, NUL-terminated text, addresses.
module cleave_c
  use cleave_constants
  use cleave_types
  use cleave_c_tables
  use cleave_c_arrays
  use cleave_c_model
  implicit none
  public
end module cleave_c
