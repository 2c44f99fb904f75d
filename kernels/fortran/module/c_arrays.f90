
! cleave.h: array calls. What may be NULL in C is an address here.
module cleave_c_arrays
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_char, c_ptr
  use cleave_types, only: cleave_network, cleave_material_call
  implicit none
  private
  public :: cleave_network_init
  public :: cleave_cbm_count_bonds
  public :: cleave_cbm_bonds
  public :: cleave_displacement_gradient
  public :: cleave_bond_force
  public :: cleave_bond_viscosity
  public :: cleave_material_stress
  public :: cleave_material_history_count
  public :: cleave_material_damage_place
  public :: cleave_material_call_init
  public :: cleave_material_update
  public :: cleave_material_tangent
  public :: cleave_material_wave_speed
  public :: cleave_ramp

  interface
    function cleave_network_init(network) bind(C) result(status)
      import :: cleave_network, c_int32_t
      implicit none
      type(cleave_network), intent(out) :: network
      integer(c_int32_t) :: status
    end function cleave_network_init

    function cleave_cbm_count_bonds(network, simplex_count, simplices) bind(C) result(status)
      import :: cleave_network, c_int64_t, c_int32_t
      implicit none
      type(cleave_network), intent(in) :: network
      integer(c_int64_t), value :: simplex_count
      integer(c_int64_t), intent(in) :: simplices(*)
      integer(c_int32_t) :: status
    end function cleave_cbm_count_bonds

    function cleave_cbm_bonds(network, X, simplex_count, simplices, alive) &
        bind(C) result(status)
      import :: cleave_network, c_double, c_int64_t, c_ptr, c_int32_t
      implicit none
      type(cleave_network), intent(in) :: network
      real(c_double), intent(in) :: X(*)
      integer(c_int64_t), value :: simplex_count
      integer(c_int64_t), intent(in) :: simplices(*)
      type(c_ptr), value :: alive
      integer(c_int32_t) :: status
    end function cleave_cbm_bonds

    function cleave_displacement_gradient(network, first, last, u, H) bind(C) result(status)
      import :: cleave_network, c_int64_t, c_double, c_int32_t
      implicit none
      type(cleave_network), intent(in) :: network
      integer(c_int64_t), value :: first, last
      real(c_double), intent(in) :: u(*)
      real(c_double), intent(inout) :: H(*)
      integer(c_int32_t) :: status
    end function cleave_displacement_gradient

    function cleave_bond_force(network, first, last, P, f) bind(C) result(status)
      import :: cleave_network, c_int64_t, c_double, c_int32_t
      implicit none
      type(cleave_network), intent(in) :: network
      integer(c_int64_t), value :: first, last
      real(c_double), intent(in) :: P(*)
      real(c_double), intent(inout) :: f(*)
      integer(c_int32_t) :: status
    end function cleave_bond_force

    function cleave_bond_viscosity(network, first, last, w, x, v, J, coefficient, &
        length, f) bind(C) result(status)
      import :: cleave_network, c_int64_t, c_double, c_int32_t
      implicit none
      type(cleave_network), intent(in) :: network
      integer(c_int64_t), value :: first, last
      real(c_double), intent(in) :: w(*), x(*), v(*), J(*)
      real(c_double), value :: coefficient, length
      real(c_double), intent(inout) :: f(*)
      integer(c_int32_t) :: status
    end function cleave_bond_viscosity

    function cleave_material_stress(material, kinematics, property_count, &
        properties, first, last, H, history, P, energy, failed) bind(C) result(status)
      import :: c_int32_t, c_int64_t, c_double, c_ptr
      implicit none
      integer(c_int32_t), value :: material, kinematics
      integer(c_int64_t), value :: property_count
      real(c_double), intent(in) :: properties(*)
      integer(c_int64_t), value :: first, last
      real(c_double), intent(in) :: H(*)
      type(c_ptr), value :: history
      real(c_double), intent(inout) :: P(*)
      type(c_ptr), value :: energy, failed
      integer(c_int32_t) :: status
    end function cleave_material_stress

    function cleave_material_history_count(material, count) bind(C) result(status)
      import :: c_int32_t, c_int64_t
      implicit none
      integer(c_int32_t), value :: material
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t) :: status
    end function cleave_material_history_count

    function cleave_material_damage_place(material, place) bind(C) result(status)
      import :: c_int32_t, c_int64_t
      implicit none
      integer(c_int32_t), value :: material
      integer(c_int64_t), intent(out) :: place
      integer(c_int32_t) :: status
    end function cleave_material_damage_place

    function cleave_material_call_init(call) bind(C) result(status)
      import :: cleave_material_call, c_int32_t
      implicit none
      type(cleave_material_call), intent(out) :: call
      integer(c_int32_t) :: status
    end function cleave_material_call_init

    function cleave_material_update(call) bind(C) result(status)
      import :: cleave_material_call, c_int32_t
      implicit none
      type(cleave_material_call), intent(in) :: call
      integer(c_int32_t) :: status
    end function cleave_material_update

    function cleave_material_tangent(call) bind(C) result(status)
      import :: cleave_material_call, c_int32_t
      implicit none
      type(cleave_material_call), intent(in) :: call
      integer(c_int32_t) :: status
    end function cleave_material_tangent

    function cleave_material_wave_speed(material, kinematics, property_count, &
        properties, speed) bind(C) result(status)
      import :: c_int32_t, c_int64_t, c_double
      implicit none
      integer(c_int32_t), value :: material, kinematics
      integer(c_int64_t), value :: property_count
      real(c_double), intent(in) :: properties(*)
      real(c_double), intent(out) :: speed
      integer(c_int32_t) :: status
    end function cleave_material_wave_speed

    function cleave_ramp(kind, value, tau, t, displacement, velocity, acceleration) &
        bind(C) result(status)
      import :: c_int32_t, c_double, c_ptr
      implicit none
      integer(c_int32_t), value :: kind
      real(c_double), value :: value, tau, t
      type(c_ptr), value :: displacement, velocity, acceleration
      integer(c_int32_t) :: status
    end function cleave_ramp
  end interface
end module cleave_c_arrays
