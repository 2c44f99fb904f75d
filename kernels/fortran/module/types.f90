
! The structs of cleave.h, member by member. Pointers are addresses; sizes are set by the calls.
module cleave_types
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_ptr, c_null_ptr
  implicit none
  private

  type, bind(C), public :: cleave_table_entry
    integer(c_int64_t) :: size = 0
    integer(c_int32_t) :: value = 0
    type(c_ptr) :: name = c_null_ptr
    type(c_ptr) :: title = c_null_ptr
    type(c_ptr) :: source = c_null_ptr
  end type cleave_table_entry

  type, bind(C), public :: cleave_parameter
    integer(c_int64_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    type(c_ptr) :: units = c_null_ptr
    type(c_ptr) :: description = c_null_ptr
    type(c_ptr) :: choices = c_null_ptr
    type(c_ptr) :: default_choice = c_null_ptr
    type(c_ptr) :: source = c_null_ptr
    real(c_double) :: minimum = 0
    real(c_double) :: maximum = 0
    real(c_double) :: default_value = 0
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: minimum_excluded = 0
    integer(c_int32_t) :: maximum_excluded = 0
    integer(c_int32_t) :: required = 0
  end type cleave_parameter

  type, bind(C), public :: cleave_field
    integer(c_int64_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    type(c_ptr) :: units = c_null_ptr
    type(c_ptr) :: description = c_null_ptr
    type(c_ptr) :: owner = c_null_ptr
    type(c_ptr) :: rebuild = c_null_ptr
    integer(c_int64_t) :: count = 0
    integer(c_int32_t) :: components = 0
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: relation = 0
    integer(c_int32_t) :: lifetime = 0
    integer(c_int32_t) :: output = 0
  end type cleave_field

  type, bind(C), public :: cleave_network
    integer(c_int64_t) :: size = 0
    integer(c_int32_t) :: dimension = 3
    integer(c_int32_t) :: index_base = 1
    integer(c_int64_t) :: particles = 0
    type(c_ptr) :: row_begin = c_null_ptr
    type(c_ptr) :: neighbour = c_null_ptr
    type(c_ptr) :: reverse = c_null_ptr
    type(c_ptr) :: zeta = c_null_ptr
    type(c_ptr) :: volume = c_null_ptr
    integer(c_int64_t) :: vector_point = 3
    integer(c_int64_t) :: vector_component = 1
    integer(c_int64_t) :: tensor_point = 9
    integer(c_int64_t) :: tensor_component = 1
  end type cleave_network

  type, bind(C), public :: cleave_material_call
    integer(c_int64_t) :: size = 0
    integer(c_int32_t) :: material = 0
    integer(c_int32_t) :: kinematics = 0
    integer(c_int64_t) :: property_count = 0
    type(c_ptr) :: properties = c_null_ptr
    integer(c_int64_t) :: first = 0
    integer(c_int64_t) :: last = 0
    real(c_double) :: dt = 0
    real(c_double) :: length = 0
    type(c_ptr) :: lengths = c_null_ptr
    integer(c_int64_t) :: length_point = 0
    type(c_ptr) :: deformation = c_null_ptr
    integer(c_int32_t) :: deformation_is_F = 0
    integer(c_int32_t) :: stress_measure = 0
    integer(c_int64_t) :: deformation_point = 0
    integer(c_int64_t) :: deformation_component = 0
    integer(c_int64_t) :: deformation_order(9) = 0
    type(c_ptr) :: history = c_null_ptr
    integer(c_int64_t) :: history_point = 0
    integer(c_int64_t) :: history_component = 0
    type(c_ptr) :: stress = c_null_ptr
    integer(c_int64_t) :: stress_point = 0
    integer(c_int64_t) :: stress_component = 0
    integer(c_int64_t) :: stress_order(9) = 0
    type(c_ptr) :: energy = c_null_ptr
    integer(c_int64_t) :: energy_point = 0
    type(c_ptr) :: plastic = c_null_ptr
    integer(c_int64_t) :: plastic_point = 0
    type(c_ptr) :: viscous = c_null_ptr
    integer(c_int64_t) :: viscous_point = 0
    type(c_ptr) :: failed = c_null_ptr
    integer(c_int64_t) :: failed_point = 0
    type(c_ptr) :: tangent = c_null_ptr
    integer(c_int64_t) :: tangent_point = 0
    integer(c_int64_t) :: tangent_component = 0
    integer(c_int32_t) :: tangent_measure = 0
    integer(c_int32_t) :: index_base = 0
  end type cleave_material_call

  type, bind(C), public :: cleave_body_spec
    integer(c_int64_t) :: size = 0
    integer(c_int32_t) :: formulation = 0
    integer(c_int32_t) :: kinematics = 0
    integer(c_int32_t) :: material = 0
    integer(c_int32_t) :: simplex_nodes = 0
    integer(c_int64_t) :: particles = 0
    type(c_ptr) :: X = c_null_ptr
    integer(c_int64_t) :: simplex_count = 0
    type(c_ptr) :: simplices = c_null_ptr
    type(c_ptr) :: name = c_null_ptr
  end type cleave_body_spec

  type, bind(C), public :: cleave_static_options
    integer(c_int64_t) :: size = 0
    real(c_double) :: tolerance = 0
    integer(c_int32_t) :: max_iterations = 0
    integer(c_int32_t) :: stop_at_limit = 0
    integer(c_int32_t) :: solver = 0
    integer(c_int32_t) :: breaking = 0
    integer(c_int32_t) :: corrections = 0
    integer(c_int32_t) :: reserved = 0
  end type cleave_static_options

  type, bind(C), public :: cleave_static_report
    integer(c_int64_t) :: size = 0
    integer(c_int64_t) :: iterations = 0
    integer(c_int64_t) :: unknowns = 0
    real(c_double) :: residual = 0
    real(c_double) :: fraction = 0
    integer(c_int64_t) :: broken = 0
    integer(c_int64_t) :: critical = 0
  end type cleave_static_report

  type, bind(C), public :: cleave_relaxation_options
    integer(c_int64_t) :: size = 0
    real(c_double) :: tolerance = 0
    integer(c_int64_t) :: max_iterations = 0
    integer(c_int64_t) :: slice = 0
    integer(c_int32_t) :: breaking = 0
    integer(c_int32_t) :: reserved = 0
  end type cleave_relaxation_options

  type, bind(C), public :: cleave_relaxation_report
    integer(c_int64_t) :: size = 0
    integer(c_int64_t) :: iterations = 0
    integer(c_int64_t) :: rounds = 0
    integer(c_int64_t) :: broken = 0
    integer(c_int64_t) :: unknowns = 0
    integer(c_int64_t) :: finished = 0
    real(c_double) :: residual = 0
  end type cleave_relaxation_report

  type, bind(C), public :: cleave_event
    integer(c_int64_t) :: size = 0
    integer(c_int64_t) :: step = 0
    integer(c_int64_t) :: first = 0
    integer(c_int64_t) :: second = 0
    real(c_double) :: time = 0
    real(c_double) :: midpoint(3) = 0
    real(c_double) :: criterion = 0
    real(c_double) :: limit = 0
    real(c_double) :: released = 0
  end type cleave_event

  type, bind(C), public :: cleave_energies
    integer(c_int64_t) :: size = 0
    real(c_double) :: kinetic = 0
    real(c_double) :: kinetic_staggered = 0
    real(c_double) :: elastic = 0
    real(c_double) :: plastic = 0
    real(c_double) :: stabilisation = 0
    real(c_double) :: fracture = 0
    real(c_double) :: viscous = 0
    real(c_double) :: external = 0
    real(c_double) :: reaction = 0
    real(c_double) :: internal = 0
    real(c_double) :: balance = 0
    real(c_double) :: identity = 0
    real(c_double) :: hourglass = 0
  end type cleave_energies

  type, bind(C), public :: cleave_counts
    integer(c_int64_t) :: size = 0
    integer(c_int64_t) :: particles = 0
    integer(c_int64_t) :: bonds = 0
    integer(c_int64_t) :: simplices = 0
    integer(c_int64_t) :: broken = 0
    integer(c_int64_t) :: inert = 0
    integer(c_int64_t) :: isolated = 0
    integer(c_int64_t) :: inverted = 0
  end type cleave_counts
end module cleave_types
