
! A material update in the layout, component order and stress measure of the host. What is a struct
! in C is a type with the choices and numbers here; the arrays are arguments, their shape says the
! strides.
module cleave_materials
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_ptr, c_loc, c_null_ptr
  use cleave_constants
  use cleave_support, only: zero_based, range_fits, refuse
  use cleave_layout, only: layout, layout_fits, length_fits
  use cleave_c, only: c_material_call => cleave_material_call, &
      c_call_init => cleave_material_call_init, c_update => cleave_material_update, &
      c_tangent => cleave_material_tangent, c_wave_speed => cleave_material_wave_speed, &
      c_history_count => cleave_material_history_count, c_ramp => cleave_ramp
  implicit none
  private
  public :: cleave_material_call, cleave_material_call_init, cleave_material_update, &
      cleave_material_tangent, cleave_material_wave_speed, cleave_ramp

  ! Orders: the places, 1 to 9, of 11 21 31 12 22 32 13 23 33 in this order; 0: the array lacks it.
  type :: cleave_material_call
    integer(c_int32_t) :: material = 0
    integer(c_int32_t) :: kinematics = CLEAVE_3D
    integer(c_int64_t) :: first = 1
    integer(c_int64_t) :: last = 0
    real(c_double) :: dt = 0
    real(c_double) :: length = 0
    integer(c_int32_t) :: deformation_is_F = 0
    integer(c_int32_t) :: stress_measure = CLEAVE_STRESS_FIRST_PIOLA
    integer(c_int32_t) :: tangent_measure = CLEAVE_TANGENT_FIRST_PIOLA
    integer(c_int64_t) :: deformation_order(9) = 0
    integer(c_int64_t) :: stress_order(9) = 0
    logical :: points_first = .false.  ! .true.: arrays are a(n,components), a(n,3,3)
  end type cleave_material_call

  interface cleave_material_update
    module procedure update_22
    module procedure update_32
    module procedure update_33
  end interface cleave_material_update

  interface cleave_material_tangent
    module procedure tangent_22
    module procedure tangent_23
    module procedure tangent_32
    module procedure tangent_33
  end interface cleave_material_tangent

  character(len=*), parameter :: updating = 'cleave_material_update'
  character(len=*), parameter :: deriving = 'cleave_material_tangent'

  interface cleave_material_call_init
    module procedure material_call_init
  end interface cleave_material_call_init
  interface cleave_material_wave_speed
    module procedure material_wave_speed
  end interface cleave_material_wave_speed
  interface cleave_ramp
    module procedure ramp
  end interface cleave_ramp

contains

  ! H in, P out, arrays a(9,n) or a(3,3,n), all nine components in order.
  recursive function material_call_init(call) result(status)
    type(cleave_material_call), intent(out) :: call
    integer(c_int32_t) :: status
    integer :: k
    call%deformation_order = [(int(k, c_int64_t), k = 1, 9)]
    call%stress_order = call%deformation_order
    status = CLEAVE_OK
  end function material_call_init

  recursive function update_22(call, properties, deformation, stress, history, energy, &
      plastic, viscous, failed, lengths) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:)
    real(c_double), intent(inout) :: stress(:,:)
    real(c_double), intent(inout), optional :: history(:,:)
    real(c_double), intent(inout), optional :: energy(:), plastic(:), viscous(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    real(c_double), intent(in), optional :: lengths(:)
    integer(c_int32_t) :: status
    status = update_checked(call, properties, deformation, shape(deformation), stress, &
        shape(stress), history, energy, plastic, viscous, failed, lengths)
  end function update_22

  recursive function update_32(call, properties, deformation, stress, history, energy, &
      plastic, viscous, failed, lengths) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:,:)
    real(c_double), intent(inout) :: stress(:,:)
    real(c_double), intent(inout), optional :: history(:,:)
    real(c_double), intent(inout), optional :: energy(:), plastic(:), viscous(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    real(c_double), intent(in), optional :: lengths(:)
    integer(c_int32_t) :: status
    status = update_checked(call, properties, deformation, shape(deformation), stress, &
        shape(stress), history, energy, plastic, viscous, failed, lengths)
  end function update_32

  recursive function update_33(call, properties, deformation, stress, history, energy, &
      plastic, viscous, failed, lengths) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:,:)
    real(c_double), intent(inout) :: stress(:,:,:)
    real(c_double), intent(inout), optional :: history(:,:)
    real(c_double), intent(inout), optional :: energy(:), plastic(:), viscous(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    real(c_double), intent(in), optional :: lengths(:)
    integer(c_int32_t) :: status
    status = update_checked(call, properties, deformation, shape(deformation), stress, &
        shape(stress), history, energy, plastic, viscous, failed, lengths)
  end function update_33

  recursive function update_checked(call, properties, deformation, deformation_shape, stress, &
      stress_shape, history, energy, plastic, viscous, failed, lengths) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(*)
    integer, intent(in) :: deformation_shape(:), stress_shape(:)
    real(c_double), intent(inout) :: stress(*)
    real(c_double), intent(inout), optional :: history(:,:)
    real(c_double), intent(inout), optional :: energy(:), plastic(:), viscous(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    real(c_double), intent(in), optional :: lengths(:)
    integer(c_int32_t) :: status
    type(c_material_call) :: c
    status = prepared(updating, call, size(properties), deformation_shape, history, lengths, c)
    if (status == CLEAVE_OK) status = strided(updating, 'stress', call, stress_shape, &
        maxval(call%stress_order), c%stress_point, c%stress_component)
    if (status == CLEAVE_OK .and. present(energy)) &
        status = length_fits(updating, 'energy', size(energy), call%last)
    if (status == CLEAVE_OK .and. present(plastic)) &
        status = length_fits(updating, 'plastic', size(plastic), call%last)
    if (status == CLEAVE_OK .and. present(viscous)) &
        status = length_fits(updating, 'viscous', size(viscous), call%last)
    if (status == CLEAVE_OK .and. present(failed)) &
        status = length_fits(updating, 'failed', size(failed), call%last)
    if (status == CLEAVE_OK) status = update_flat(c, properties, deformation, stress, history, &
        energy, plastic, viscous, failed, lengths)
  end function update_checked

  ! Addresses are taken here, where copies of strided arrays live until C has returned.
  recursive function update_flat(c, properties, deformation, stress, history, energy, &
      plastic, viscous, failed, lengths) result(status)
    type(c_material_call), intent(inout) :: c
    real(c_double), intent(in), target :: properties(*), deformation(*)
    real(c_double), intent(inout), target :: stress(*)
    real(c_double), intent(inout), target, optional :: history(*), energy(*), plastic(*), viscous(*)
    integer(c_int32_t), intent(inout), target, optional :: failed(*)
    real(c_double), intent(in), target, optional :: lengths(*)
    integer(c_int32_t) :: status
    c%properties = c_loc(properties)
    c%deformation = c_loc(deformation)
    c%stress = c_loc(stress)
    if (present(history)) c%history = c_loc(history)
    if (present(energy)) c%energy = c_loc(energy)
    if (present(plastic)) c%plastic = c_loc(plastic)
    if (present(viscous)) c%viscous = c_loc(viscous)
    if (present(failed)) c%failed = c_loc(failed)
    if (present(lengths)) c%lengths = c_loc(lengths)
    status = c_update(c)
  end function update_flat

  recursive function tangent_22(call, properties, deformation, tangent, history, lengths, &
      failed) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:)
    real(c_double), intent(inout) :: tangent(:,:)
    real(c_double), intent(in), optional :: history(:,:), lengths(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    integer(c_int32_t) :: status
    status = tangent_checked(call, properties, deformation, shape(deformation), tangent, &
        shape(tangent), history, lengths, failed)
  end function tangent_22

  recursive function tangent_23(call, properties, deformation, tangent, history, lengths, &
      failed) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:)
    real(c_double), intent(inout) :: tangent(:,:,:)
    real(c_double), intent(in), optional :: history(:,:), lengths(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    integer(c_int32_t) :: status
    status = tangent_checked(call, properties, deformation, shape(deformation), tangent, &
        shape(tangent), history, lengths, failed)
  end function tangent_23

  recursive function tangent_32(call, properties, deformation, tangent, history, lengths, &
      failed) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:,:)
    real(c_double), intent(inout) :: tangent(:,:)
    real(c_double), intent(in), optional :: history(:,:), lengths(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    integer(c_int32_t) :: status
    status = tangent_checked(call, properties, deformation, shape(deformation), tangent, &
        shape(tangent), history, lengths, failed)
  end function tangent_32

  recursive function tangent_33(call, properties, deformation, tangent, history, lengths, &
      failed) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(:,:,:)
    real(c_double), intent(inout) :: tangent(:,:,:)
    real(c_double), intent(in), optional :: history(:,:), lengths(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    integer(c_int32_t) :: status
    status = tangent_checked(call, properties, deformation, shape(deformation), tangent, &
        shape(tangent), history, lengths, failed)
  end function tangent_33

  recursive function tangent_checked(call, properties, deformation, deformation_shape, &
      tangent, tangent_shape, history, lengths, failed) result(status)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), deformation(*)
    integer, intent(in) :: deformation_shape(:), tangent_shape(:)
    real(c_double), intent(inout) :: tangent(*)
    real(c_double), intent(in), optional :: history(:,:), lengths(:)
    integer(c_int32_t), intent(inout), optional :: failed(:)
    integer(c_int32_t) :: status
    type(c_material_call) :: c
    integer(c_int64_t) :: rows, columns
    status = prepared(deriving, call, size(properties), deformation_shape, history, lengths, c)
    rows = maxval(call%stress_order)
    columns = rows
    if (call%tangent_measure == CLEAVE_TANGENT_FIRST_PIOLA) columns = maxval(call%deformation_order)
    if (status == CLEAVE_OK) status = strided(deriving, 'tangent', call, tangent_shape, &
        rows * columns, c%tangent_point, c%tangent_component)
    if (status == CLEAVE_OK .and. present(failed)) &
        status = length_fits(deriving, 'failed', size(failed), call%last)
    if (status == CLEAVE_OK) &
        status = tangent_flat(c, properties, deformation, tangent, history, lengths, failed)
  end function tangent_checked

  recursive function tangent_flat(c, properties, deformation, tangent, history, lengths, &
      failed) result(status)
    type(c_material_call), intent(inout) :: c
    real(c_double), intent(in), target :: properties(*), deformation(*)
    real(c_double), intent(inout), target :: tangent(*)
    real(c_double), intent(in), target, optional :: history(*), lengths(*)
    integer(c_int32_t), intent(inout), target, optional :: failed(*)
    integer(c_int32_t) :: status
    c%properties = c_loc(properties)
    c%deformation = c_loc(deformation)
    c%tangent = c_loc(tangent)
    if (present(history)) c%history = c_loc(history)
    if (present(lengths)) c%lengths = c_loc(lengths)
    if (present(failed)) c%failed = c_loc(failed)
    status = c_tangent(c)
  end function tangent_flat

  ! What update and tangent share: the struct without addresses, range and extents checked.
  recursive function prepared(procedure, call, properties, deformation_shape, history, &
      lengths, c) result(status)
    character(len=*), intent(in) :: procedure
    type(cleave_material_call), intent(in) :: call
    integer, intent(in) :: properties, deformation_shape(:)
    real(c_double), intent(in), optional :: history(:,:), lengths(:)
    type(c_material_call), intent(inout) :: c
    integer(c_int32_t) :: status
    integer(c_int64_t) :: variables
    status = c_call_init(c)
    c%material = call%material
    c%kinematics = call%kinematics
    c%property_count = int(properties, c_int64_t)
    c%first = zero_based(call%first)
    c%last = call%last
    c%dt = call%dt
    c%length = call%length
    c%deformation_is_F = call%deformation_is_F
    c%stress_measure = call%stress_measure
    c%tangent_measure = call%tangent_measure
    c%index_base = 1_c_int32_t
    c%deformation_order = zero_based(call%deformation_order)
    c%stress_order = zero_based(call%stress_order)
    status = range_fits(procedure, call%first, call%last, huge(1_c_int64_t))
    if (status == CLEAVE_OK .and. maxval(abs(call%deformation_order)) == 0) &
        status = refuse(CLEAVE_WRONG_ORDER, procedure, &
        'the call has not been initialised; cleave_material_call_init sets its defaults')
    if (status == CLEAVE_OK) status = strided(procedure, 'deformation', call, deformation_shape, &
        maxval(call%deformation_order), c%deformation_point, c%deformation_component)
    if (status == CLEAVE_OK .and. present(history)) then
      status = c_history_count(call%material, variables)
      if (status == CLEAVE_OK) status = strided(procedure, 'history', call, shape(history), &
          variables, c%history_point, c%history_component)
    end if
    if (status == CLEAVE_OK .and. present(lengths)) &
        status = length_fits(procedure, 'lengths', size(lengths), call%last)
  end function prepared

  ! Strides of an array of at least `components` by call%last, from its shape.
  recursive function strided(procedure, argument, call, given, components, point, component) &
      result(status)
    character(len=*), intent(in) :: procedure, argument
    type(cleave_material_call), intent(in) :: call
    integer, intent(in) :: given(:)
    integer(c_int64_t), intent(in) :: components
    integer(c_int64_t), intent(inout) :: point, component
    integer(c_int32_t) :: status
    if (call%points_first) then
      point = 1
      component = max(int(given(1), c_int64_t), call%last, 1_c_int64_t)
    else
      point = max(int(product(given(:size(given) - 1)), c_int64_t), components, 1_c_int64_t)
      component = 1
    end if
    status = layout_fits(procedure, argument, given, layout(point, component, &
        components), call%last)
  end function strided

  recursive function material_wave_speed(material, kinematics, properties, speed) result(status)
    integer(c_int32_t), intent(in) :: material, kinematics
    real(c_double), intent(in) :: properties(:)
    real(c_double), intent(inout) :: speed
    integer(c_int32_t) :: status
    status = c_wave_speed(material, kinematics, size(properties, kind=c_int64_t), properties, speed)
  end function material_wave_speed

  recursive function ramp(kind, value, tau, t, displacement, velocity, acceleration) &
      result(status)
    integer(c_int32_t), intent(in) :: kind
    real(c_double), intent(in) :: value, tau, t
    real(c_double), intent(inout), target, optional :: displacement, velocity, acceleration
    integer(c_int32_t) :: status
    type(c_ptr) :: u, v, a
    u = c_null_ptr
    v = c_null_ptr
    a = c_null_ptr
    if (present(displacement)) u = c_loc(displacement)
    if (present(velocity)) v = c_loc(velocity)
    if (present(acceleration)) a = c_loc(acceleration)
    status = c_ramp(kind, value, tau, t, u, v, a)
  end function ramp
end module cleave_materials
