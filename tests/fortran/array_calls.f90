! Array calls from Fortran give the bits of C: the same kernels behind other shapes, layouts, kinds.
program array_calls
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave
  use checks
  implicit none
  integer :: dimension

  do dimension = 2, 3
    call open_reference(dimension)
    call bonds_and_forces(dimension)
    call other_layout(dimension)
    call laws()
  end do
  call finish()

contains

  subroutine bonds_and_forces(dimension)
    integer, intent(in) :: dimension
    type(cleave_network) :: network
    integer(c_int64_t), allocatable, target :: row_begin(:), neighbour(:), reverse(:)
    real(c_double), allocatable, target :: zeta(:,:), volume(:)
    real(c_double), allocatable :: X(:,:), u(:,:), v(:,:), H(:,:,:), P(:,:,:), history(:,:)
    real(c_double), allocatable :: energy(:), f(:,:)
    integer, allocatable :: simplices(:,:)
    integer(c_int32_t), allocatable :: failed(:), alive(:)
    integer :: n, m, halves, first, last, variables
    integer(c_int32_t) :: kinematics

    kinematics = merge(CLEAVE_PLANE_STRAIN, CLEAVE_3D, dimension == 2)
    n = size(reals('volume'))
    m = size(integers('alive'))
    X = reshape(reals('X'), [3, n])
    u = reshape(reals('u'), [3, n])
    v = reshape(reals('v'), [3, n])
    simplices = reshape(int(integers('simplices'), kind(n)) + 1, [dimension + 1, m])
    alive = int(integers('alive'), c_int32_t)

    call ok(cleave_network_init(network))
    network%dimension = int(dimension, c_int32_t)
    allocate (row_begin(n + 1))
    call ok(cleave_network_rows(network, row_begin))
    call ok(cleave_cbm_count_bonds(network, simplices))
    halves = int(row_begin(n + 1) - row_begin(1), kind(halves))
    allocate (neighbour(halves), reverse(halves), zeta(3, halves), volume(n))
    call ok(cleave_network_bonds(network, neighbour, reverse, zeta, volume))
    call ok(cleave_cbm_bonds(network, X, simplices, alive))
    call same_integers('row_begin', row_begin - 1)
    call same_integers('neighbour', neighbour - 1)
    call same_integers('reverse', reverse - 1)
    call same_reals('zeta', reshape(zeta, [size(zeta)]))
    call same_reals('volume', volume)

    allocate (H(3, 3, n), P(3, 3, n), energy(n), f(3, n), failed(n))
    H = 7
    P = 7
    energy = 7
    failed = 7
    f = 0.5_c_double
    first = int(sum(integers('range') * [1_c_int64_t, 0_c_int64_t]), kind(first)) + 1
    last = int(sum(integers('range') * [0_c_int64_t, 1_c_int64_t]), kind(last))
    call ok(cleave_displacement_gradient(network, first, last, u, H))
    call same_reals('H', reshape(H, [9 * n]))
    call ok(cleave_material_history_count(CLEAVE_MATERIAL_j2, variables))
    allocate (history(variables, n))
    history = 0
    call ok(cleave_material_stress(CLEAVE_MATERIAL_j2, kinematics, reals('properties'), first, &
        last, H, history, P, energy, failed))
    call same_reals('P', reshape(P, [9 * n]))
    call same_reals('history', reshape(history, [size(history)]))
    call same_reals('energy', energy)
    call same_integers('failed', int(failed, c_int64_t))
    call ok(cleave_bond_force(network, first, last, P, f))
    call same_reals('f', reshape(f, [3 * n]))
    f = 0.25_c_double
    call ok(cleave_bond_viscosity(network, first, last, reals('w'), X + u, v, reals('J'), &
        5.0_c_double, 0.01_c_double, f))
    call same_reals('viscous', reshape(f, [3 * n]))
  end subroutine bonds_and_forces

  ! a(n,3), a(n,9), bonds of all simplices with integers of eight bytes, strided actual arguments.
  subroutine other_layout(dimension)
    integer, intent(in) :: dimension
    type(cleave_network) :: network
    integer(c_int64_t), allocatable, target :: row_begin(:), neighbour(:), reverse(:)
    real(c_double), allocatable, target :: zeta(:,:), volume(:)
    real(c_double), allocatable :: X(:,:), H(:,:), f(:,:), every_other(:,:), P(:,:)
    integer(c_int64_t), allocatable :: simplices(:,:)
    integer(c_int32_t), allocatable :: alive(:)
    integer(c_int64_t) :: n, first, last
    integer(c_int64_t), allocatable :: bounds(:)

    n = size(reals('volume'), kind=c_int64_t)
    X = transpose(reshape(reals('X'), [3, int(n)]))
    simplices = reshape(integers('simplices') + 1_c_int64_t, &
        [dimension + 1, size(integers('alive'))])
    alive = int(integers('alive'), c_int32_t)
    call ok(cleave_network_init(network))
    network%dimension = int(dimension, c_int32_t)
    network%vector_point = 1
    network%vector_component = n
    network%tensor_point = 1
    network%tensor_component = n
    allocate (row_begin(n + 1))
    call ok(cleave_network_rows(network, row_begin))
    call ok(cleave_cbm_count_bonds(network, simplices))
    allocate (neighbour(row_begin(n + 1) - 1), reverse(row_begin(n + 1) - 1))
    allocate (zeta(3, row_begin(n + 1) - 1), volume(n))
    call ok(cleave_network_bonds(network, neighbour, reverse, zeta, volume))
    call ok(cleave_cbm_bonds(network, X, simplices, alive))
    call same_reals('zeta', reshape(zeta, [size(zeta)]))

    bounds = integers('range')
    first = bounds(1) + 1
    last = bounds(2)
    allocate (H(n, 9), every_other(2 * n, 3), f(n, 3), P(n, 9))
    H = 7
    every_other = 0.5_c_double
    every_other(1::2, :) = transpose(reshape(reals('u'), [3, int(n)]))
    call ok(cleave_displacement_gradient(network, first, last, every_other(1::2, :), H))
    call same_reals('H', reshape(transpose(H), [9 * int(n)]))
    P = transpose(reshape(reals('P'), [9, int(n)]))
    every_other = 0.5_c_double
    call ok(cleave_bond_force(network, first, last, P, every_other(2::2, :)))
    call same_reals('f', reshape(transpose(every_other(2::2, :)), [3 * int(n)]))
    call require(all(every_other(1::2, :) == 0.5_c_double), 'entries between stay as they were')
    f = 0.5_c_double
    call ok(cleave_bond_force(network, first, first - 1, P, f))
    call require(all(f == 0.5_c_double), 'an empty range changes nothing')
  end subroutine other_layout

  subroutine laws()
    type(cleave_material_call) :: call
    real(c_double), allocatable :: F(:,:), stress(:,:), energy(:), plastic(:), viscous(:)
    real(c_double), allocatable :: history(:,:), tangent(:,:,:), lengths(:), properties(:)
    real(c_double) :: speed, ramp(3)
    integer(c_int32_t), allocatable :: failed(:)
    integer :: n, variables, place
    integer(c_int32_t) :: material

    properties = reals('properties')
    lengths = reals('update_lengths')
    n = size(lengths)
    F = reshape(reals('update_F'), [9, n])
    call ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, 'j2', material))
    call require(material == CLEAVE_MATERIAL_j2, 'j2 by its name')
    call ok(cleave_material_history_count(material, variables))
    allocate (stress(6, n), energy(n), plastic(n), viscous(n), failed(n), tangent(9, 9, n))
    allocate (history(variables, n))
    stress = 7
    energy = 7
    plastic = 7
    viscous = 7
    failed = 7
    tangent = 7
    history = 0
    call ok(cleave_material_call_init(call))
    call%material = material
    call%first = 3
    call%last = n - 1
    call%dt = 1e-6_c_double
    call%deformation_is_F = 1
    call%deformation_order = [1, 7, 6, 4, 2, 8, 9, 5, 3]
    call ok(cleave_material_tangent(call, properties, F, tangent, history, lengths))
    call same_reals('update_tangent', reshape(tangent, [81 * n]))
    call%stress_measure = CLEAVE_STRESS_CAUCHY
    call%stress_order = [1, 4, 6, 4, 2, 5, 6, 5, 3]
    call ok(cleave_material_update(call, properties, F, stress, history, energy, plastic, viscous, &
        failed, lengths))
    call same_reals('update_stress', reshape(stress, [6 * n]))
    call same_reals('update_energy', energy)
    call same_reals('update_plastic', plastic)
    call same_reals('update_viscous', viscous)
    call same_reals('update_history', reshape(history, [size(history)]))
    call same_integers('update_failed', int(failed, c_int64_t))

    ! Points first, as Abaqus has them, without the arrays that may be left out.
    history = 0
    call points_first(call, properties, transpose(F), variables, lengths)
    call ok(cleave_material_wave_speed(material, merge(CLEAVE_3D, CLEAVE_PLANE_STRAIN, &
        dimension == 3), properties, speed))
    call same_reals('speed', [speed])
    call ok(cleave_ramp(CLEAVE_RAMP_VELOCITY, 3.0_c_double, 2.0_c_double, 0.7_c_double, ramp(1), &
        acceleration=ramp(3)))
    call ok(cleave_ramp(CLEAVE_RAMP_VELOCITY, 3.0_c_double, 2.0_c_double, 0.7_c_double, &
        velocity=ramp(2)))
    call same_reals('ramp', ramp)

    call ok(cleave_material_damage_place(CLEAVE_MATERIAL_svk, place))
    call require(place == 0, 'svk has no damage')
    call ok(cleave_material_damage_place(CLEAVE_MATERIAL_johnson_cook, place))
    call ok(cleave_material_history_count(CLEAVE_MATERIAL_johnson_cook, variables))
    call require(place >= 1 .and. place <= variables, 'the damage of johnson_cook has a place')
  end subroutine laws

  subroutine points_first(call, properties, F, variables, lengths)
    type(cleave_material_call), intent(in) :: call
    real(c_double), intent(in) :: properties(:), F(:,:), lengths(:)
    integer, intent(in) :: variables
    type(cleave_material_call) :: turned
    real(c_double) :: stress(size(F, 1), 6), history(size(F, 1), variables)
    turned = call
    turned%points_first = .true.
    stress = 7
    history = 0
    call ok(cleave_material_update(turned, properties, F, stress, history, lengths=lengths))
    call same_reals('update_stress', reshape(transpose(stress), [size(stress)]))
    call same_reals('update_history', reshape(transpose(history), [size(history)]))
  end subroutine points_first
end program array_calls
