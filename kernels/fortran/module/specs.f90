
! What a body is made of; its particles and simplices are arguments of cleave_body_add.
module cleave_specs
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave_constants
  implicit none
  private
  public :: cleave_body_spec, cleave_body_spec_init

  type :: cleave_body_spec
    integer(c_int32_t) :: formulation = CLEAVE_FORMULATION_CBM
    integer(c_int32_t) :: kinematics = CLEAVE_3D
    integer(c_int32_t) :: material = CLEAVE_MATERIAL_SVK
    integer(c_int32_t) :: simplex_nodes = 0
    character(len=64) :: name = ' '
  end type cleave_body_spec

  interface cleave_body_spec_init
    module procedure body_spec_init
  end interface cleave_body_spec_init

contains

  recursive function body_spec_init(spec) result(status)
    type(cleave_body_spec), intent(out) :: spec
    integer(c_int32_t) :: status
    spec%name = ' '
    status = CLEAVE_OK
  end function body_spec_init
end module cleave_specs
