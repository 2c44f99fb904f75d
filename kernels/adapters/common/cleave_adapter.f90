! What the Fortran adapters of host programs share: a law by its name in the host, its counts, and
! the update of a block of points in REAL*8 or REAL*4. An adapter permutes, scales and converts; the
! physics is in the library. Not an interface for programs of your own: use the module `cleave`.
!
!   blocks       a(leading, component), points 1 to n of the first index. A single point is a block
!                with leading dimension 1, a(component).
!   precision    REAL*8 blocks are served where they stand. REAL*4 blocks are converted to REAL*8 in
!                pieces, on the stack, and the results rounded.
!   threads      nothing is kept between calls and nothing allocated here; every procedure is
!                RECURSIVE, so that its arrays are on the stack of the thread with any option.
!   errors       status 0, or a status of the library; adapter_message then has the text. A point
!                without an answer is no error: failed = 1, stress zero, history untouched.
module cleave_adapter
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float, c_int32_t, c_int64_t, c_loc, &
    c_null_char, c_null_ptr
  use cleave_c, only: cleave_material_call, cleave_material_call_init, cleave_material_update, &
    cleave_material_tangent, cleave_material_wave_speed, cleave_material_history_count, &
    cleave_material_damage_place, cleave_parameter_count, cleave_table_find, cleave_last_message, &
    cleave_set_last_message, CLEAVE_3D, CLEAVE_OK, CLEAVE_BAD_ARGUMENT, CLEAVE_BAD_JACOBIAN, &
    CLEAVE_UNSUPPORTED, CLEAVE_TABLE_MATERIAL, CLEAVE_STRESS_CAUCHY, CLEAVE_TANGENT_JAUMANN
  implicit none
  private
  public :: adapter_law, adapter_layout
  public :: adapter_find_law, adapter_find_material, adapter_properties
  public :: adapter_update, adapter_tangent, adapter_moduli, adapter_wave_speed
  public :: adapter_fail, adapter_message

  ! Kinds of the arguments below.
  integer, parameter, public :: adapter_int = c_int32_t, adapter_count = c_int64_t, &
    adapter_real = c_double
  ! Sizes of the local arrays of adapters. Longer blocks are served piece by piece.
  integer, parameter, public :: adapter_chunk = 128
  integer, parameter, public :: adapter_max_properties = 64, adapter_max_history = 32
  integer, parameter, public :: adapter_message_length = 400

  ! Places, from 0, of the components 11 21 31 12 22 32 13 23 33 in a block; -1: not there.
  integer(c_int64_t), parameter, public :: &
    adapter_columns(9) = (/ 0, 1, 2, 3, 4, 5, 6, 7, 8 /), &    ! 11 21 31 12 22 32 13 23 33
    adapter_12_23_31(9) = (/ 0, 3, 5, 3, 1, 4, 5, 4, 2 /), &   ! 11 22 33 12 23 31
    adapter_12_13_23(9) = (/ 0, 3, 4, 3, 1, 5, 4, 5, 2 /), &   ! 11 22 33 12 13 23
    adapter_12(9) = (/ 0, 3, -1, 3, 1, -1, -1, -1, 2 /)        ! 11 22 33 12

  ! A law of the materials table.
  type :: adapter_law
    character(len=32) :: name = ' '
    integer(c_int32_t) :: material = 0
    integer(c_int64_t) :: property_count = 0
    integer(c_int64_t) :: history_count = 0
    integer(c_int64_t) :: damage_place = 0  ! in the history, from 1; 0: the law has no damage
  end type adapter_law

  ! How a block stands in the host.
  type :: adapter_layout
    integer(c_int64_t) :: f_leading = 1, history_leading = 1, stress_leading = 1
    integer(c_int64_t) :: f_order(9) = adapter_columns
    integer(c_int64_t) :: stress_order(9) = adapter_12_23_31
    integer(c_int32_t) :: stress_measure = CLEAVE_STRESS_CAUCHY
  end type adapter_layout

  ! Checks the number of properties against the law and hands them out in REAL*8.
  !   call adapter_properties(law, count, properties, values, status)
  ! [in]  count       integer(adapter_count); properties(*) REAL*8 or REAL*4
  ! [out] values      (adapter_max_properties) REAL*8
  interface adapter_properties
    module procedure properties_real8, properties_real4
  end interface adapter_properties

  ! Stress, energies and history of points first to last, n = last - first + 1.
  !   call adapter_update(law, values, layout, first, last, dt, lengths, f, history, stress, &
  !                       energy, plastic, viscous, failed, status)
  ! [in]     values       from adapter_properties
  ! [in]     first, last  integer(adapter_count), points of the blocks f, history, stress
  ! [in]     dt           REAL*8, size of the step
  ! [in]     lengths      (n) REAL*8, size of the particle or element
  ! [in]     f            (leading,*) deformation gradient, REAL*8 or REAL*4 as history and stress
  ! [in,out] history      (leading,*); not touched if the law has none
  ! [out]    stress       (leading,*), the places of layout%stress_order
  ! [out]    energy       (n) REAL*8, stored, per reference volume
  ! [out]    plastic, viscous (n) REAL*8, dissipated in this step by plastic flow and by the law's
  !                       own viscosity, per reference volume
  ! [out]    failed       (n) integer(adapter_int), 1 where the law has no answer
  interface adapter_update
    module procedure update_real8, update_real4
  end interface adapter_update

contains

  ! The law called `name`, in any case, blank-padded. Looked up on every call, nothing is kept, so
  ! that there is nothing to initialise or to lock; the tables are short.
  recursive subroutine adapter_find_law(name, law, status)
    character(len=*), intent(in) :: name
    type(adapter_law), intent(out) :: law
    integer(c_int32_t), intent(out) :: status
    character(len=len(law%name) + 1, kind=c_char) :: text
    integer :: i, letter

    law%name = name
    do i = 1, len_trim(law%name)
      letter = iachar(law%name(i:i))
      if (letter >= iachar('A') .and. letter <= iachar('Z')) law%name(i:i) = achar(letter + 32)
    end do
    text = law%name
    i = len_trim(text) + 1
    text(i:i) = c_null_char
    status = cleave_table_find(CLEAVE_TABLE_MATERIAL, text, law%material)
    if (status == CLEAVE_OK) status = cleave_parameter_count(text, law%property_count)
    if (status == CLEAVE_OK) &
      status = cleave_material_history_count(law%material, law%history_count)
    if (status == CLEAVE_OK) &
      status = cleave_material_damage_place(law%material, law%damage_place)
    if (status /= CLEAVE_OK) return
    law%damage_place = law%damage_place + 1
    if (law%property_count > adapter_max_properties .or. &
        law%history_count > adapter_max_history) then
      call adapter_fail(CLEAVE_UNSUPPORTED, 'law ' // trim(law%name) // &
        ' is larger than the arrays of the adapter; raise adapter_max_properties and ' // &
        'adapter_max_history in cleave_adapter.f90 and compile the adapters again', status)
    end if
  end subroutine adapter_find_law

  ! The law in a material's name CLEAVE-LAW or CLEAVE-LAW-ANYTHING.
  recursive subroutine adapter_find_material(material_name, law, status)
    character(len=*), intent(in) :: material_name
    type(adapter_law), intent(out) :: law
    integer(c_int32_t), intent(out) :: status
    integer :: first, last

    first = index(material_name, '-') + 1
    last = len_trim(material_name)
    if (first == 1 .or. first > last) then
      call adapter_fail(CLEAVE_BAD_ARGUMENT, 'material ''' // trim(material_name) // &
        ''' does not name a law; call it CLEAVE-LAW or CLEAVE-LAW-ANYTHING, for example ' // &
        'CLEAVE-J2_POWER-STEEL', status)
      return
    end if
    if (index(material_name(first:last), '-') > 0) &
      last = first + index(material_name(first:last), '-') - 2
    call adapter_find_law(material_name(first:last), law, status)
  end subroutine adapter_find_material

  recursive subroutine properties_real8(law, count, properties, values, status)
    type(adapter_law), intent(in) :: law
    integer(c_int64_t), intent(in) :: count
    real(c_double), intent(in) :: properties(*)
    real(c_double), intent(out) :: values(adapter_max_properties)
    integer(c_int32_t), intent(out) :: status
    values = 0
    call check_count(law, count, status)
    if (status == CLEAVE_OK) values(1:count) = properties(1:count)
  end subroutine properties_real8

  recursive subroutine properties_real4(law, count, properties, values, status)
    type(adapter_law), intent(in) :: law
    integer(c_int64_t), intent(in) :: count
    real(c_float), intent(in) :: properties(*)
    real(c_double), intent(out) :: values(adapter_max_properties)
    integer(c_int32_t), intent(out) :: status
    values = 0
    call check_count(law, count, status)
    if (status == CLEAVE_OK) values(1:count) = real(properties(1:count), c_double)
  end subroutine properties_real4

  recursive subroutine check_count(law, count, status)
    type(adapter_law), intent(in) :: law
    integer(c_int64_t), intent(in) :: count
    integer(c_int32_t), intent(out) :: status
    character(len=20) :: given, wanted
    status = CLEAVE_OK
    if (count == law%property_count) return
    write (given, '(i0)') count
    write (wanted, '(i0)') law%property_count
    call adapter_fail(CLEAVE_BAD_ARGUMENT, 'law ' // trim(law%name) // ' takes ' // &
      trim(wanted) // ' properties, not ' // trim(given) // &
      '; all of them, in the order of ''cleave keys material''', status)
  end subroutine check_count

  recursive subroutine update_real8(law, values, layout, first, last, dt, lengths, f, history, &
      stress, energy, plastic, viscous, failed, status)
    type(adapter_law), intent(in) :: law
    real(c_double), intent(in), target :: values(adapter_max_properties)
    type(adapter_layout), intent(in) :: layout
    integer(c_int64_t), intent(in) :: first, last
    real(c_double), intent(in) :: dt
    real(c_double), intent(in), target :: lengths(*)
    real(c_double), intent(in), target :: f(layout%f_leading, *)
    real(c_double), intent(inout), target :: history(layout%history_leading, *)
    real(c_double), intent(inout), target :: stress(layout%stress_leading, *)
    real(c_double), intent(inout), target :: energy(*), plastic(*), viscous(*)
    integer(c_int32_t), intent(inout), target :: failed(*)
    integer(c_int32_t), intent(out) :: status
    type(cleave_material_call) :: call

    status = cleave_material_call_init(call)
    if (status /= CLEAVE_OK .or. last < first) return
    call%material = law%material
    call%kinematics = CLEAVE_3D
    call%property_count = law%property_count
    call%properties = c_loc(values(1))
    call%last = last - first + 1
    call%dt = dt
    call%lengths = c_loc(lengths(1))
    call%deformation = c_loc(f(first, 1))
    call%deformation_is_F = 1
    call%deformation_point = 1
    call%deformation_component = layout%f_leading
    call%deformation_order = layout%f_order
    if (law%history_count > 0) call%history = c_loc(history(first, 1))
    call%history_point = 1
    call%history_component = layout%history_leading
    call%stress = c_loc(stress(first, 1))
    call%stress_measure = layout%stress_measure
    call%stress_point = 1
    call%stress_component = layout%stress_leading
    call%stress_order = layout%stress_order
    call%energy = c_loc(energy(1))
    call%plastic = c_loc(plastic(1))
    call%viscous = c_loc(viscous(1))
    call%failed = c_loc(failed(1))
    status = cleave_material_update(call)
    if (status == CLEAVE_BAD_JACOBIAN) status = CLEAVE_OK
  end subroutine update_real8

  recursive subroutine update_real4(law, values, layout, first, last, dt, lengths, f, history, &
      stress, energy, plastic, viscous, failed, status)
    type(adapter_law), intent(in) :: law
    real(c_double), intent(in) :: values(adapter_max_properties)
    type(adapter_layout), intent(in) :: layout
    integer(c_int64_t), intent(in) :: first, last
    real(c_double), intent(in) :: dt, lengths(*)
    real(c_float), intent(in) :: f(layout%f_leading, *)
    real(c_float), intent(inout) :: history(layout%history_leading, *)
    real(c_float), intent(inout) :: stress(layout%stress_leading, *)
    real(c_double), intent(inout) :: energy(*), plastic(*), viscous(*)
    integer(c_int32_t), intent(inout) :: failed(*)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t), parameter :: piece = 64
    real(c_double) :: wide_f(piece, 9), wide_history(piece, adapter_max_history)
    real(c_double) :: wide_stress(piece, 9)
    type(adapter_layout) :: wide
    integer(c_int64_t) :: from, to, at, m, c, k

    wide = layout
    wide%f_leading = piece
    wide%history_leading = piece
    wide%stress_leading = piece
    status = CLEAVE_OK
    do from = first, last, piece
      to = min(from + piece - 1, last)
      m = to - from + 1
      at = from - first + 1
      do c = 1, maxval(layout%f_order) + 1
        wide_f(1:m, c) = real(f(from:to, c), c_double)
      end do
      do c = 1, law%history_count
        wide_history(1:m, c) = real(history(from:to, c), c_double)
      end do
      call update_real8(law, values, wide, 1_c_int64_t, m, dt, lengths(at), wide_f, wide_history, &
        wide_stress, energy(at), plastic(at), viscous(at), failed(at), status)
      if (status /= CLEAVE_OK) return
      do k = 1, 9
        c = layout%stress_order(k) + 1
        if (c > 0) stress(from:to, c) = real(wide_stress(1:m, c), c_float)
      end do
      do c = 1, law%history_count
        history(from:to, c) = real(wide_history(1:m, c), c_float)
      end do
    end do
  end subroutine update_real4

  ! Consistent tangent of the step of one REAL*8 point, from the history before it, which is left
  ! alone: call it before adapter_update. `measure`: CLEAVE_TANGENT_...; entry ab at
  ! tangent(a + (b - 1) m), a and b counted in layout%stress_order, m its number of components.
  recursive subroutine adapter_tangent(law, values, layout, measure, dt, length, f, history, &
      tangent, failed, status)
    type(adapter_law), intent(in) :: law
    real(c_double), intent(in), target :: values(adapter_max_properties)
    type(adapter_layout), intent(in) :: layout
    integer(c_int32_t), intent(in) :: measure
    real(c_double), intent(in) :: dt, length
    real(c_double), intent(in), target :: f(*), history(*)
    real(c_double), intent(inout), target :: tangent(*)
    integer(c_int32_t), intent(out), target :: failed
    integer(c_int32_t), intent(out) :: status
    real(c_double), target :: stress(9)
    type(cleave_material_call) :: call

    failed = 0
    stress = 0
    status = cleave_material_call_init(call)
    if (status /= CLEAVE_OK) return
    call%material = law%material
    call%kinematics = CLEAVE_3D
    call%property_count = law%property_count
    call%properties = c_loc(values(1))
    call%last = 1
    call%dt = dt
    call%length = length
    call%deformation = c_loc(f(1))
    call%deformation_is_F = 1
    call%deformation_order = layout%f_order
    if (law%history_count > 0) call%history = c_loc(history(1))
    call%stress = c_loc(stress(1))
    call%stress_measure = layout%stress_measure
    call%stress_order = layout%stress_order
    call%failed = c_loc(failed)
    call%tangent = c_loc(tangent(1))
    call%tangent_measure = measure
    status = cleave_material_tangent(call)
    if (status == CLEAVE_BAD_JACOBIAN) status = CLEAVE_OK
  end subroutine adapter_tangent

  ! Lame's moduli of the undeformed material [Pa].
  recursive subroutine adapter_moduli(law, values, lambda, mu, status)
    type(adapter_law), intent(in) :: law
    real(c_double), intent(in) :: values(adapter_max_properties)
    real(c_double), intent(out) :: lambda, mu
    integer(c_int32_t), intent(out) :: status
    real(c_double), parameter :: still(9) = (/ 1, 0, 0, 0, 1, 0, 0, 0, 1 /)
    real(c_double) :: virgin(adapter_max_history), tangent(36)
    integer(c_int32_t) :: failed

    virgin = 0
    tangent = 0
    call adapter_tangent(law, values, adapter_layout(), CLEAVE_TANGENT_JAUMANN, 0.0_c_double, &
      0.0_c_double, still, virgin, tangent, failed, status)
    lambda = tangent(2)
    mu = tangent(22)
  end subroutine adapter_moduli

  ! Longitudinal wave speed of the undeformed material.
  recursive subroutine adapter_wave_speed(law, values, speed, status)
    type(adapter_law), intent(in) :: law
    real(c_double), intent(in) :: values(adapter_max_properties)
    real(c_double), intent(out) :: speed
    integer(c_int32_t), intent(out) :: status
    speed = 0
    status = cleave_material_wave_speed(law%material, CLEAVE_3D, law%property_count, values, speed)
  end subroutine adapter_wave_speed

  ! Sets the message of this thread and the status.
  recursive subroutine adapter_fail(code, message, status)
    integer(c_int32_t), intent(in) :: code
    character(len=*), intent(in) :: message
    integer(c_int32_t), intent(out) :: status
    character(len=adapter_message_length, kind=c_char) :: text
    text = message
    text(min(len_trim(text) + 1, adapter_message_length):) = c_null_char
    status = cleave_set_last_message(text)
    status = code
  end subroutine adapter_fail

  ! The message of this thread, blank-padded, cut to the length of `text`.
  recursive subroutine adapter_message(text)
    character(len=*), intent(out) :: text
    character(len=adapter_message_length + 1, kind=c_char) :: buffer
    integer(c_int64_t) :: length
    integer(c_int32_t) :: status
    status = cleave_last_message(buffer, int(adapter_message_length + 1, c_int64_t), length)
    text = ' '
    if (status == CLEAVE_OK) &
      text = buffer(1:min(length, int(adapter_message_length, c_int64_t)))
  end subroutine adapter_message
end module cleave_adapter
