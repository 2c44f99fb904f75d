! Input that is wrong is answered with a status and a message that says what was given and what is
! needed; nothing crashes, and the next correct call works.
program refusals
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_ptr, c_associated
  use cleave
  use checks
  implicit none

  call networks()
  call laws()
  call names_and_text()
  call models()
  call bodies()
  call finish()

contains

  ! Square of two triangles.
  subroutine square(X, simplices)
    real(c_double), intent(out) :: X(3,4)
    integer, intent(out) :: simplices(3,2)
    X = reshape([0.0_c_double, 0.0_c_double, 0.0_c_double, 1.0_c_double, 0.0_c_double, &
        0.0_c_double, 1.0_c_double, 1.0_c_double, 0.0_c_double, 0.0_c_double, 1.0_c_double, &
        0.0_c_double], [3, 4])
    simplices = reshape([1, 2, 3, 1, 3, 4], [3, 2])
  end subroutine square

  subroutine networks()
    type(cleave_network) :: network
    integer(c_int64_t), allocatable, target :: row_begin(:), unallocated(:)
    integer(c_int64_t), target :: neighbour(10), reverse(20)
    real(c_double), target :: zeta(3,10), wide(6,10), volume(4)
    real(c_double) :: X(3,4), u(3,4), H(9,4), f(3,4), P(3,3,4), w(10), J(4)
    integer :: simplices(3,2), bad(3,2)
    integer(c_int64_t), parameter :: one = 1, four = 4

    call square(X, simplices)
    u = 0
    P = 0
    w = 0
    J = 1
    f = 0
    call ok(cleave_network_init(network))
    network%dimension = 2
    call refused(cleave_displacement_gradient(network, 1, 0, u(:, :0), H(:, :0)), &
        CLEAVE_NULL_ARGUMENT, 'row_begin')
    call refused(cleave_cbm_count_bonds(network, simplices), CLEAVE_NULL_ARGUMENT, 'row_begin')
    call refused(cleave_network_bonds(network, neighbour, reverse, zeta, volume), &
        CLEAVE_WRONG_ORDER, 'no rows|cleave_network_rows')
    call refused(cleave_network_rows(network, unallocated), CLEAVE_NULL_ARGUMENT, &
        '''row_begin''|not allocated')
    allocate (row_begin(9))
    call refused(cleave_network_rows(network, row_begin(:0)), CLEAVE_BAD_ARGUMENT, &
        '''row_begin''|(0)|(1) or more')
    call refused(cleave_network_rows(network, row_begin(::2)), CLEAVE_BAD_ARGUMENT, &
        '''row_begin''|contiguous')
    call ok(cleave_network_rows(network, row_begin(:5)))
    call refused(cleave_cbm_count_bonds(network, simplices(:2, :)), CLEAVE_BAD_ARGUMENT, &
        '''simplices''|(2,2)|(3,0) or more')
    bad = simplices
    bad(2, 2) = 5
    call refused(cleave_cbm_count_bonds(network, bad), CLEAVE_BAD_SIMPLEX, '2')
    bad(2, 2) = 0
    call refused(cleave_cbm_count_bonds(network, bad), CLEAVE_BAD_SIMPLEX, '2')
    call ok(cleave_cbm_count_bonds(network, simplices))
    call refused(cleave_cbm_bonds(network, X, simplices), CLEAVE_NULL_ARGUMENT, 'neighbour')
    call refused(cleave_network_bonds(network, neighbour(:9), reverse, zeta, volume), &
        CLEAVE_BAD_ARGUMENT, '''neighbour''|(9)|(10) or more')
    call refused(cleave_network_bonds(network, neighbour, reverse(::2), zeta, volume), &
        CLEAVE_BAD_ARGUMENT, '''reverse''|contiguous')
    call refused(cleave_network_bonds(network, neighbour, reverse, zeta(:2, :), volume), &
        CLEAVE_BAD_ARGUMENT, '''zeta''|(2,10)|(3,10) or more')
    call refused(cleave_network_bonds(network, neighbour, reverse, wide(::2, :), volume), &
        CLEAVE_BAD_ARGUMENT, '''zeta''|contiguous')
    call refused(cleave_network_bonds(network, neighbour, reverse, wide(:3, :), volume), &
        CLEAVE_BAD_ARGUMENT, '''zeta''|contiguous')
    call refused(cleave_network_bonds(network, neighbour, reverse, zeta, volume(:3)), &
        CLEAVE_BAD_ARGUMENT, '''volume''|(3)|(4) or more')
    call ok(cleave_network_bonds(network, neighbour, reverse, zeta, volume))
    call refused(cleave_cbm_bonds(network, X(:, :3), simplices), CLEAVE_BAD_ARGUMENT, &
        '''X''|(3,3)|(3,4) or more')
    call refused(cleave_cbm_bonds(network, X, simplices, [1_c_int32_t]), CLEAVE_BAD_ARGUMENT, &
        '''alive''|(1)|(2) or more')
    call ok(cleave_cbm_bonds(network, X, simplices))

    call refused(cleave_displacement_gradient(network, 1, 4, u(:2, :), H), CLEAVE_BAD_ARGUMENT, &
        'cleave_displacement_gradient|''u''|(2,4)|(3,4) or more')
    call refused(cleave_displacement_gradient(network, 1, 4, u, H(:, :3)), CLEAVE_BAD_ARGUMENT, &
        '''H''|(9,3)|(9,4) or more')
    call refused(cleave_displacement_gradient(network, 1, 4, u, P(:, :, :2)), &
        CLEAVE_BAD_ARGUMENT, '''H''|(3,3,2)|(3,3,4) or more')
    call refused(cleave_displacement_gradient(network, 0, 4, u, H), CLEAVE_BAD_RANGE, &
        'range 0 to 4|1 to 4')
    call refused(cleave_displacement_gradient(network, one, four + 1, u, H), CLEAVE_BAD_RANGE, &
        'range 1 to 5|1 to 4')
    call refused(cleave_displacement_gradient(network, 4, 2, u, H), CLEAVE_BAD_RANGE, '4 to 2')
    call refused(cleave_displacement_gradient(network, -huge(1), huge(1), u, H), CLEAVE_BAD_RANGE, &
        'range')
    call refused(cleave_bond_force(network, 1, 4, P(:, :2, :), f), CLEAVE_BAD_ARGUMENT, &
        '''P''|(3,2,4)')
    call refused(cleave_bond_force(network, 1, 4, P, f(:, :1)), CLEAVE_BAD_ARGUMENT, '''f''|(3,1)')
    call refused(cleave_bond_viscosity(network, 1, 4, w(:9), X, u, J, 1.0_c_double, 1.0_c_double, &
        f), CLEAVE_BAD_ARGUMENT, '''w''|(9)|(10) or more')
    call refused(cleave_bond_viscosity(network, 1, 4, w, X, u, J(:3), 1.0_c_double, 1.0_c_double, &
        f), CLEAVE_BAD_ARGUMENT, '''J''|(3)|(4) or more')
    network%dimension = 4
    call refused(cleave_displacement_gradient(network, 1, 4, u, H), CLEAVE_BAD_ARGUMENT, &
        'dimension is 4')
    network%dimension = 2
    network%vector_point = 1
    network%vector_component = 4
    call refused(cleave_displacement_gradient(network, 1, 4, u, H), CLEAVE_BAD_ARGUMENT, &
        '''u''|(3,4)|(4,3)')
    network%vector_point = 5
    network%vector_component = 2
    call refused(cleave_displacement_gradient(network, 1, 4, u, H), CLEAVE_BAD_ARGUMENT, &
        '''u''|(3,4)|20 entries')
    call ok(cleave_network_init(network))
    network%dimension = 2
    call ok(cleave_network_rows(network, row_begin(:5)))
    call ok(cleave_network_bonds(network, neighbour, reverse, zeta, volume))
    call ok(cleave_displacement_gradient(network, 1, 4, X, H))
    call require(abs(H(1, 2) - 1) < 1e-14_c_double, 'u = X has the gradient 1')
  end subroutine networks

  subroutine laws()
    type(cleave_material_call) :: call, untouched
    real(c_double) :: H(9,5), P(9,5), F(3,3,5), energy(5), history(20,5), speed, properties(3)
    real(c_double) :: stress(6,5), tangent(9,9,5)
    integer(c_int32_t) :: failed(5)
    integer :: variables

    properties = [1190.0_c_double, 3.24e9_c_double, 0.35_c_double]
    H = 0
    F = 0
    history = 0
    call refused(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, properties(:2), 1, 5, H, &
        P=P), CLEAVE_BAD_ARGUMENT, '2|3')
    call refused(cleave_material_stress(77_c_int32_t, CLEAVE_3D, properties, 1, 5, H, P=P), &
        CLEAVE_UNKNOWN_NAME, '77|svk = 1')
    call refused(cleave_material_stress(CLEAVE_MATERIAL_svk, 9_c_int32_t, properties, 1, 5, H, &
        P=P), CLEAVE_BAD_ARGUMENT, '9')
    call refused(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, properties, 1, 6, H, P=P), &
        CLEAVE_BAD_ARGUMENT, '''H''|(9,5)|(9,6) or more')
    call refused(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, properties, 0, 5, H, P=P), &
        CLEAVE_BAD_RANGE, '0 to 5')
    call refused(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, properties, 1, 5, H, P=P, &
        failed=failed(:4)), CLEAVE_BAD_ARGUMENT, '''failed''|(4)|(5) or more')
    call refused(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_3D, properties, 1, 5, H, P=P, &
        energy=energy(:1)), CLEAVE_BAD_ARGUMENT, '''energy''|(1)|(5) or more')
    call ok(cleave_material_history_count(CLEAVE_MATERIAL_j2, variables))
    call refused(cleave_material_stress(CLEAVE_MATERIAL_j2, CLEAVE_3D, reals_of_j2(), 1, 5, H, &
        P=P), CLEAVE_NULL_ARGUMENT, 'history')
    call refused(cleave_material_stress(CLEAVE_MATERIAL_j2, CLEAVE_3D, reals_of_j2(), 1, 5, H, &
        history(:variables + 1, :), P), CLEAVE_BAD_ARGUMENT, '''history''')
    H(1, 4) = -3
    failed = 7
    call refused(cleave_material_stress(CLEAVE_MATERIAL_neo_hooke, CLEAVE_3D, properties, 1, 5, H, &
        P=P, failed=failed), CLEAVE_BAD_JACOBIAN, 'point 4')
    call require(all(failed == [0, 0, 0, 1, 0]), 'the point without an answer is marked')
    call refused(cleave_material_wave_speed(CLEAVE_MATERIAL_svk, CLEAVE_3D, properties(:1), &
        speed), CLEAVE_BAD_ARGUMENT, '1|3')
    call refused(cleave_material_history_count(77_c_int32_t, variables), CLEAVE_UNKNOWN_NAME, '77')
    call refused(cleave_material_damage_place(77_c_int32_t, variables), CLEAVE_UNKNOWN_NAME, '77')
    call refused(cleave_ramp(9_c_int32_t, 1.0_c_double, 1.0_c_double, 1.0_c_double), &
        CLEAVE_BAD_ARGUMENT, '9')

    call refused(cleave_material_update(untouched, properties, F, stress), CLEAVE_WRONG_ORDER, &
        'cleave_material_call_init')
    call ok(cleave_material_call_init(call))
    call%material = CLEAVE_MATERIAL_svk
    call%last = 5
    call refused(cleave_material_update(call, properties, F(:, :, :4), F), CLEAVE_BAD_ARGUMENT, &
        '''deformation''|(3,3,4)')
    call refused(cleave_material_update(call, properties, F, stress), CLEAVE_BAD_ARGUMENT, &
        '''stress''|(6,5)|(9,5) or more')
    call refused(cleave_material_update(call, properties, H, P(:, :2)), CLEAVE_BAD_ARGUMENT, &
        '''stress''|(9,2)|(9,5) or more')
    call refused(cleave_material_update(call, properties, H, P, plastic=energy(:2)), &
        CLEAVE_BAD_ARGUMENT, '''plastic''|(2)')
    call refused(cleave_material_update(call, properties, H, P, lengths=energy(:2)), &
        CLEAVE_BAD_ARGUMENT, '''lengths''|(2)')
    call refused(cleave_material_tangent(call, properties, F, tangent(:, :8, :)), &
        CLEAVE_BAD_ARGUMENT, '''tangent''')
    call%first = 0
    call refused(cleave_material_update(call, properties, F, F), CLEAVE_BAD_RANGE, '0 to 5')
    call%first = 1
    call%stress_order(3) = 4
    call refused(cleave_material_update(call, properties, F, P), CLEAVE_BAD_ARGUMENT, '')
    call%stress_order(3) = -5
    call refused(cleave_material_update(call, properties, F, P), CLEAVE_BAD_ARGUMENT, '')
    call%stress_order(3) = 3
    call%points_first = .true.
    call refused(cleave_material_update(call, properties, H, P), CLEAVE_BAD_ARGUMENT, &
        '''deformation''|(9,5)|(9,9)')
    call%points_first = .false.
    F = 0
    call ok(cleave_material_update(call, properties, F, P))
  end subroutine laws

  function reals_of_j2() result(values)
    real(c_double), allocatable :: values(:)
    type(cleave_parameter) :: parameter
    integer :: n, k
    call ok(cleave_parameter_count('j2', n))
    allocate (values(n))
    do k = 1, n
      call ok(cleave_parameter_get('j2', k, parameter))
      values(k) = parameter%default_value
      if (parameter%required == 1 .or. parameter%minimum_excluded == 1) values(k) = 1e6_c_double
      if (parameter%name == 'nu') values(k) = 0.3_c_double
    end do
  end function reals_of_j2

  subroutine names_and_text()
    integer(c_int32_t) :: value
    type(cleave_parameter) :: parameter
    type(cleave_table_entry) :: entry
    type(cleave_field) :: field
    character(len=5) :: short
    character(len=80) :: long
    character(len=300) :: padded
    integer :: n, length
    integer(c_int64_t) :: n8, fingerprint

    call ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, 'svk', value))
    call require(value == CLEAVE_MATERIAL_svk, 'svk')
    value = 0
    padded = 'svk'
    call ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, padded, value))
    call require(value == CLEAVE_MATERIAL_svk, 'svk and 297 blanks')
    value = 0
    call ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, '   svk ', value))
    call require(value == CLEAVE_MATERIAL_svk, 'blanks before svk')
    value = -7
    call refused(cleave_table_find(CLEAVE_TABLE_MATERIAL, 'svkk', value), CLEAVE_UNKNOWN_NAME, &
        '''svkk''|svk, j2')
    call require(value == -7, 'the answer of an error is left alone')
    call refused(cleave_table_find(CLEAVE_TABLE_MATERIAL, ' ', value), CLEAVE_UNKNOWN_NAME, '''''')
    call refused(cleave_table_find(CLEAVE_TABLE_MATERIAL, '', value), CLEAVE_UNKNOWN_NAME, '''''')
    call refused(cleave_table_find(CLEAVE_TABLE_MATERIAL, 's vk', value), CLEAVE_UNKNOWN_NAME, &
        '''s vk''')
    call refused(cleave_table_find(99_c_int32_t, 'svk', value), CLEAVE_BAD_ARGUMENT, '99')
    call refused(cleave_parameter_count('none', n), CLEAVE_UNKNOWN_NAME, '''none''')
    call refused(cleave_parameter_get('svk', 0, parameter), CLEAVE_BAD_RANGE, &
        'index 0|1 to 3')
    call refused(cleave_table_get(CLEAVE_TABLE_MATERIAL, 0, entry), CLEAVE_BAD_RANGE, &
        'index 0')
    call ok(cleave_table_count(CLEAVE_TABLE_MATERIAL, n))
    call refused(cleave_table_get(CLEAVE_TABLE_MATERIAL, n + 1, entry), CLEAVE_BAD_RANGE, &
        'cleave_table_get: index')
    call ok(cleave_table_get(CLEAVE_TABLE_MATERIAL, 1, entry))
    call require(entry%name == 'svk' .and. entry%value == CLEAVE_MATERIAL_svk .and. &
        entry%title == 'St Venant-Kirchhoff', 'the first line of the materials')
    call ok(cleave_table_count(CLEAVE_TABLE_MATERIAL, n8))
    call require(n == n8, 'counts of both kinds')

    call ok(cleave_set_last_message('one two three   '))
    call ok(cleave_last_message(short))
    call require(short == 'one t', 'a message is cut to a short text')
    call ok(cleave_last_message(long, length))
    call require(long == 'one two three' .and. length == 13, 'a message is padded')
    call ok(cleave_last_message(long(:0), length))
    call require(length == 13, 'a text of no length is told the length')
    call require(cleave_status_text(CLEAVE_BAD_RANGE) == &
        'an index range does not lie inside the array', 'status in words')
    call require(cleave_status_text(-1_c_int32_t) == 'unknown status', 'unknown status')
    call require(index(cleave_version(), '.') > 0, 'the version')
    call ok(cleave_abi_check())
    call refused(cleave_abi_check(CLEAVE_ABI_VERSION - 1_c_int32_t), CLEAVE_ABI_MISMATCH, '')
    call ok(cleave_field_table_fingerprint(fingerprint))
    call require(fingerprint /= 0, 'the fields table has a fingerprint')
    call ok(cleave_field_table_count(n))
    call ok(cleave_field_table_get(1, field))
    call require(field%name == 'reference_position' .and. field%components == 3, 'the first field')
    call refused(cleave_field_table_get(n + 1, field), CLEAVE_BAD_RANGE, &
        'cleave_field_table_get: index')
  end subroutine names_and_text

  subroutine models()
    type(cleave_model) :: model, never, other
    type(cleave_counts) :: counts
    real(c_double) :: step
    integer :: bytes
    call refused(cleave_model_setup(never), CLEAVE_NULL_ARGUMENT, &
        'cleave_model_setup|cleave_model_create')
    call refused(cleave_model_stable_step(never, step), CLEAVE_NULL_ARGUMENT, 'never created')
    call refused(cleave_model_memory(never, bytes), CLEAVE_NULL_ARGUMENT, 'never created')
    call refused(cleave_counts_get(never, 1, counts), CLEAVE_NULL_ARGUMENT, 'never created')
    call refused(cleave_body_set_real(never, 1, 'material', 'E', 1.0_c_double), &
        CLEAVE_NULL_ARGUMENT, 'never created')
    call ok(cleave_model_destroy(never))
    call ok(cleave_model_create(model))
    call refused(cleave_model_create(model), CLEAVE_WRONG_ORDER, 'holds a model already')
    call ok(cleave_model_create(other))
    call refused(cleave_model_update(model), CLEAVE_WRONG_ORDER, '')
    call refused(cleave_model_set_threads(model, 0), CLEAVE_BAD_ARGUMENT, '0')
    call refused(cleave_model_set_threads(model, -3000000000_c_int64_t), CLEAVE_BAD_ARGUMENT, '')
    call ok(cleave_model_destroy(model))
    call ok(cleave_model_destroy(model))
    call refused(cleave_model_advance(model, 1.0_c_double, 1.0_c_double), CLEAVE_NULL_ARGUMENT, &
        'destroyed')
    call ok(cleave_model_set_threads(other, 1))
    call ok(cleave_model_destroy(other))
  end subroutine models

  subroutine bodies()
    type(cleave_model) :: model
    type(cleave_body_spec) :: spec
    type(cleave_field) :: field
    type(cleave_event) :: event
    real(c_double) :: X(3,4), values(4), force(3), value, weight(4,2), sample(2)
    integer :: simplices(3,2), body, whole(4), simplex(2)
    call square(X, simplices)
    call ok(cleave_model_create(model))
    call ok(cleave_body_spec_init(spec))
    spec%kinematics = CLEAVE_PLANE_STRAIN
    spec%name = 'plate'
    call refused(cleave_body_add(model, spec, X(:2, :), simplices, body), CLEAVE_BAD_ARGUMENT, &
        '''X''|(2,4)|(3,1) or more')
    call refused(cleave_body_add(model, spec, X(:, :0), simplices, body), CLEAVE_BAD_ARGUMENT, &
        '''X''|(3,0)')
    call refused(cleave_body_add(model, spec, X, simplices(:2, :), body), CLEAVE_BAD_ARGUMENT, &
        '''simplices''|(2,2)|(3,0)')
    spec%material = 99
    call refused(cleave_body_add(model, spec, X, simplices, body), CLEAVE_UNKNOWN_NAME, '99')
    spec%material = CLEAVE_MATERIAL_svk
    spec%formulation = 99
    call refused(cleave_body_add(model, spec, X, simplices, body), CLEAVE_UNKNOWN_NAME, '99')
    spec%formulation = CLEAVE_FORMULATION_cbm
    call ok(cleave_body_add(model, spec, X, simplices, body))
    call refused(cleave_body_set_real(model, body, 'material', 'Youngs', 1.0_c_double), &
        CLEAVE_UNKNOWN_NAME, 'Youngs|plate')
    call refused(cleave_body_set_real(model, body, 'nothing', 'E', 1.0_c_double), &
        CLEAVE_UNKNOWN_NAME, 'nothing')
    call refused(cleave_body_set_real(model, 0, 'material', 'E', 1.0_c_double), &
        CLEAVE_BAD_ARGUMENT, 'body 0|counted from 1')
    call refused(cleave_body_set_real(model, 2, 'material', 'E', 1.0_c_double), &
        CLEAVE_BAD_ARGUMENT, 'body 2')
    call refused(cleave_body_set_choice(model, body, 'viscosity', 'form', 'thick'), &
        CLEAVE_UNKNOWN_NAME, 'thick')
    call refused(cleave_body_prescribe(model, body, [1, 2], [1], &
        [CLEAVE_MOTION_EXACT, CLEAVE_MOTION_EXACT]), CLEAVE_BAD_ARGUMENT, &
        '''direction''|(1)|(2), as particle')
    call refused(cleave_body_prescribe(model, body, [1, 2], [1, 1], [CLEAVE_MOTION_EXACT]), &
        CLEAVE_BAD_ARGUMENT, '''motion''|(1)|(2), as particle')
    call refused(cleave_body_prescribe(model, body, [5], [1], [CLEAVE_MOTION_EXACT]), &
        CLEAVE_BAD_RANGE, '')
    call refused(cleave_body_prescribe(model, body, [0], [1], [CLEAVE_MOTION_EXACT]), &
        CLEAVE_BAD_RANGE, '')
    call refused(cleave_body_prescribe(model, body, [1], [4], [CLEAVE_MOTION_EXACT]), &
        CLEAVE_BAD_ARGUMENT, '')
    call refused(cleave_body_prescribe(model, body, [1], [-huge(1)], [CLEAVE_MOTION_EXACT]), &
        CLEAVE_BAD_ARGUMENT, '')
    call refused(cleave_body_exempt(model, body, [9]), CLEAVE_BAD_RANGE, '')
    call refused(cleave_body_region(model, body, [9], CLEAVE_MATERIAL_svk, [1.0_c_double]), &
        CLEAVE_BAD_RANGE, 'the region')
    call refused(cleave_body_region(model, body, [1], CLEAVE_MATERIAL_svk, [1.0_c_double], Gf=1.0_c_double), &
        CLEAVE_UNSUPPORTED, 'one material in a body')
    call refused(cleave_body_volumes(model, body, [1.0_c_double]), CLEAVE_BAD_ARGUMENT, 'count is 1')
    call refused(cleave_model_setup(model), CLEAVE_MISSING_PARAMETER, 'plate')
    call ok(cleave_body_set_real(model, body, 'material', 'rho', 1190.0_c_double))
    call ok(cleave_body_set_real(model, body, '  material  ', ' E  ', 3.24e9_c_double))
    call ok(cleave_body_set_real(model, body, 'material', 'nu', 0.35_c_double))
    call ok(cleave_body_get_real(model, body, 'material', 'E', value))
    call require(value == 3.24e9_c_double, 'blanks around names do not count')
    call ok(cleave_body_prescribe(model, body, [1], [1], [CLEAVE_MOTION_EXACT]))
    call ok(cleave_model_setup(model))
    call refused(cleave_body_precrack(model, body, reshape([2, 4], [2, 1])), &
        CLEAVE_BAD_ARGUMENT, '')
    call refused(cleave_body_precrack(model, body, reshape([2, 4], [1, 2])), CLEAVE_BAD_ARGUMENT, &
        '''pairs''|(1,2)|(2,0)')
    call refused(cleave_body_motion(model, body, [1.0_c_double, 2.0_c_double]), &
        CLEAVE_BAD_ARGUMENT, '2')
    call refused(cleave_body_motion(model, body, [1.0_c_double], [1.0_c_double, 2.0_c_double]), &
        CLEAVE_BAD_ARGUMENT, '''acceleration''|(2)|(1), as displacement')
    call refused(cleave_field_find(model, body, 'mas', field), CLEAVE_UNKNOWN_NAME, 'mas')
    call refused(cleave_field_get_real(model, body, 'mas', 1, 4, values), &
        CLEAVE_UNKNOWN_NAME, 'mas')
    call refused(cleave_field_get_real(model, body, 'mass', 1, 5, values), CLEAVE_BAD_RANGE, &
        '1 to 5|1 to 4')
    call refused(cleave_field_get_real(model, body, 'mass', 1, 4, values(:3)), &
        CLEAVE_BAD_ARGUMENT, '''values''|(3)|(4) or more')
    call refused(cleave_field_get_real(model, body, 'velocity', 1, 4, X(:2, :)), &
        CLEAVE_BAD_ARGUMENT, '''values''|(2,4)|(3,4) or more')
    call refused(cleave_field_put_real(model, body, 'velocity', 1, 4, values), &
        CLEAVE_BAD_ARGUMENT, '''values''|(4)|(12) or more')
    call refused(cleave_field_put_real(model, body, 'velocity', 1, 1, &
        reshape(values, [1, 1, 4])), CLEAVE_BAD_ARGUMENT, '''values''|(1,1,4)')
    call refused(cleave_field_get_integer(model, body, 'mass', 1, 4, whole), CLEAVE_WRONG_TYPE, &
        'mass')
    call refused(cleave_field_get_real(model, body, 'bond_status', 1, 4, values), &
        CLEAVE_WRONG_TYPE, 'bond_status')
    call refused(cleave_body_reaction(model, body, [5], force), CLEAVE_BAD_RANGE, '')
    call refused(cleave_body_reaction(model, body, [1], force(:2)), CLEAVE_BAD_ARGUMENT, &
        '''force''|(2)|(3) or more')
    call refused(cleave_body_locate(model, body, X(:, :2), simplex(:1), weight), &
        CLEAVE_BAD_ARGUMENT, '''simplex''|(1)|(2) or more')
    call refused(cleave_field_interpolate(model, body, 'mass', [1, 3], weight, sample), &
        CLEAVE_BAD_RANGE, '')
    call refused(cleave_field_get(model, body, 99, field), CLEAVE_BAD_RANGE, 'index 99')
    call refused(cleave_body_event_get(model, body, 1, event), CLEAVE_BAD_RANGE, 'index 1|1 to 0')
    call refused(cleave_body_add(model, spec, X, body), CLEAVE_WRONG_ORDER, '')
    call ok(cleave_field_get_integer(model, body, 'bond_status', 1, 4, whole))
    call ok(cleave_model_destroy(model))
  end subroutine bodies
end program refusals
