! A model driven from Fortran gives the bits of one driven from C, also with another model beside
! it, and after its state went through named fields into a new one.
program model_calls
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave
  use checks
  implicit none
  integer, parameter :: led(2) = [1, 5]
  integer :: dimension

  do dimension = 2, 3
    call open_reference(dimension)
    call dynamics(dimension)
    call statics(dimension)
  end do
  call finish()

contains

  subroutine patch(model, dimension, body)
    type(cleave_model), intent(inout) :: model
    integer, intent(in) :: dimension
    integer, intent(out) :: body
    type(cleave_body_spec) :: spec
    call ok(cleave_model_create(model))
    call ok(cleave_body_spec_init(spec))
    spec%formulation = CLEAVE_FORMULATION_cbm
    spec%kinematics = merge(CLEAVE_PLANE_STRAIN, CLEAVE_3D, dimension == 2)
    spec%material = CLEAVE_MATERIAL_svk
    spec%name = 'patch'
    body = -7
    call ok(cleave_body_add(model, spec, reshape(reals('X'), [3, size(reals('X')) / 3]), &
        reshape(int(integers('simplices'), kind(body)) + 1, &
        [dimension + 1, size(integers('alive'))]), body))
    call ok(cleave_body_set_real(model, body, 'material', 'rho', 1190.0_c_double))
    call ok(cleave_body_set_real(model, body, 'material', 'E', 3.24e9_c_double))
    call ok(cleave_body_set_real(model, body, 'material', 'nu', 0.35_c_double))
  end subroutine patch

  subroutine torn(model, dimension, body, n)
    type(cleave_model), intent(inout) :: model
    integer, intent(in) :: dimension
    integer, intent(out) :: body, n
    type(cleave_field) :: field
    integer, allocatable :: ends(:,:)
    call patch(model, dimension, body)
    call ok(cleave_body_set_real(model, body, 'fracture', 'critical_strain', 0.01_c_double))
    call ok(cleave_body_set_real(model, body, 'viscosity', 'length', 0.01_c_double))
    call ok(cleave_body_set_choice(model, body, 'viscosity', 'form', 'central'))
    call ok(cleave_body_prescribe(model, body, led, [2, 1], &
        [CLEAVE_MOTION_EXACT, CLEAVE_MOTION_ACCELERATION]))
    call ok(cleave_body_exempt(model, body, [2, 3, 4]))
    call ok(cleave_model_set_threads(model, 2))
    call ok(cleave_model_set_order(model, CLEAVE_ORDER_BLOCKS))
    call ok(cleave_model_setup(model))
    call ok(cleave_field_find(model, body, 'bond_ends', field))
    allocate (ends(2, field%count))
    call ok(cleave_field_get_integer(model, body, 'bond_ends', 1, size(ends, 2), ends))
    call same_integers('run_ends', int(reshape(ends, [size(ends)]), c_int64_t) - 1)
    call ok(cleave_body_precrack(model, body, ends(:, size(ends, 2):)))
    call ok(cleave_field_find(model, body, 'velocity', field))
    n = int(field%count, kind(n))
    call ok(cleave_field_put_real(model, body, 'velocity', 1, n, reals('run_v')))
  end subroutine torn

  subroutine step(model, body, k, dt)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: body, k
    real(c_double), intent(in) :: dt
    real(c_double) :: t
    t = k * dt
    call ok(cleave_body_motion(model, body, [1e-3_c_double * t, 0.0_c_double]))
    call ok(cleave_model_advance(model, dt, t))
    call ok(cleave_body_motion(model, body, acceleration=[0.0_c_double, 10.0_c_double]))
    call ok(cleave_model_update(model))
  end subroutine step

  subroutine dynamics(dimension)
    integer, intent(in) :: dimension
    type(cleave_model) :: model, other
    integer :: body, other_body, n, k
    real(c_double) :: stable, wave, beta, dt
    integer(c_int32_t) :: answer
    call torn(model, dimension, body, n)
    call torn(other, dimension, other_body, n)
    call require(body == 1, 'bodies count from 1')
    call ok(cleave_model_initialise(model, 0.0_c_double))
    call ok(cleave_model_initialise(other, 0.0_c_double))
    call ok(cleave_model_stable_step(model, stable))
    call ok(cleave_model_is_stable(model, stable, answer))
    call require(answer == 1, 'the stable step is stable')
    call ok(cleave_model_is_stable(model, 2 * stable, answer))
    call require(answer == 0, 'twice the stable step is not')
    call ok(cleave_body_wave_speed(model, body, wave))
    call ok(cleave_body_get_real(model, body, 'viscosity', 'beta', beta))
    dt = 0.4_c_double * stable
    do k = 1, 120
      call step(model, body, k, dt)
      if (k <= 50) call step(other, other_body, k, 0.5_c_double * dt)
    end do
    call compare(model, body, n, stable, wave, beta)
    call ok(cleave_model_destroy(other))
    call carried_on(dimension, dt)
    call ok(cleave_model_destroy(model))
  end subroutine dynamics

  subroutine compare(model, body, n, stable, wave, beta)
    type(cleave_model), intent(in) :: model
    integer, intent(in) :: body, n
    real(c_double), intent(in) :: stable, wave, beta
    type(cleave_energies) :: e
    type(cleave_counts) :: c
    type(cleave_event) :: event
    real(c_double) :: time, force(3), u(3, n), P(3, 3, n), weight(4, 3), sample(3, 3)
    integer :: events, steps, simplex(3), bytes
    integer, allocatable :: alive(:), corners(:,:)
    integer(c_int64_t), allocatable :: alive8(:)

    call ok(cleave_model_clock(model, steps, time))
    call ok(cleave_body_reaction(model, body, led, force))
    call same_reals('run_numbers', [stable, wave, beta, time, force])
    call ok(cleave_field_get_real(model, body, 'displacement', 1, n, u))
    call same_reals('run_displacement', reshape(u, [3 * n]))
    call ok(cleave_field_get_real(model, body, 'first_piola_kirchhoff_stress', 1, n, P))
    call same_reals('run_stress', reshape(P, [9 * n]))
    call ok(cleave_energies_get(model, 0, e))
    call same_reals('run_energies', [e%kinetic, e%kinetic_staggered, e%elastic, e%plastic, &
        e%stabilisation, e%fracture, e%viscous, e%external, e%reaction, e%internal, e%balance, &
        e%identity, e%hourglass])
    call ok(cleave_counts_get(model, body, c))
    call same_integers('run_counts', [c%particles, c%bonds, c%simplices, c%broken, c%inert, &
        c%isolated, c%inverted])
    call require(c%broken > 5, 'the run breaks bonds')
    call ok(cleave_body_event_count(model, body, events))
    call ok(cleave_body_event_get(model, body, events, event))
    call same_integers('run_event', [int(events, c_int64_t), event%step, event%first - 1, &
        event%second - 1, int(steps, c_int64_t)])
    call same_reals('run_event', [event%time, event%midpoint, event%criterion, event%limit, &
        event%released])
    call ok(cleave_body_clear_events(model, body))
    call ok(cleave_body_event_count(model, body, events))
    call require(events == 0, 'events are forgotten')
    call ok(cleave_model_memory(model, bytes))
    call require(bytes > 0, 'a model has a size')

    allocate (alive(c%simplices), alive8(c%simplices))
    call ok(cleave_field_get_integer(model, body, 'simplex_alive', 1, size(alive), alive))
    call same_integers('run_alive', int(alive, c_int64_t))
    call ok(cleave_field_get_integer(model, 1_c_int64_t, 'simplex_alive', 1_c_int64_t, &
        size(alive8, kind=c_int64_t), alive8))
    call same_integers('run_alive', alive8)

    allocate (corners(4, c%simplices))
    call ok(cleave_field_get_integer(model, body, 'simplex_particles', 1, size(alive), corners))
    call require(minval(corners(:3, :)) == 1 .and. maxval(corners) == n .and. &
        (all(corners(4, :) == 0) .eqv. dimension == 2), 'particles of simplices count from 1')

    simplex = -7
    call ok(cleave_body_locate(model, body, reshape(reals('run_points'), [3, 3]), simplex, weight))
    call same_integers('run_simplex', int(simplex, c_int64_t) - 1)
    call require(simplex(2) == 0, 'outside is simplex 0')
    call same_reals('run_weight', reshape(weight, [12]))
    call ok(cleave_field_interpolate(model, body, 'displacement', simplex, weight, sample))
    call same_reals('run_sample', reshape(sample, [9]))
  end subroutine compare

  ! 50 steps, all set-up and state fields into a new model, 70 more steps: the bits of 120 steps.
  subroutine carried_on(dimension, dt)
    integer, intent(in) :: dimension
    real(c_double), intent(in) :: dt
    type(cleave_model) :: before, after
    type(cleave_field) :: field
    real(c_double), allocatable :: values(:,:), u(:,:)
    integer, allocatable :: whole(:,:)
    real(c_double) :: time
    integer :: body, n, k, fields, steps, entries
    call torn(before, dimension, body, n)
    call ok(cleave_model_initialise(before, 0.0_c_double))
    do k = 1, 50
      call step(before, body, k, dt)
    end do
    call torn(after, dimension, body, n)
    call ok(cleave_field_count(before, body, fields))
    do k = 1, fields
      call ok(cleave_field_get(before, body, k, field))
      if (field%lifetime /= CLEAVE_LIFETIME_SETUP .and. &
          field%lifetime /= CLEAVE_LIFETIME_STATE) cycle
      entries = int(field%count, kind(entries))
      if (field%type == CLEAVE_REAL) then
        allocate (values(field%components, entries))
        call ok(cleave_field_get_real(before, body, field%name, 1, entries, values))
        call ok(cleave_field_put_real(after, body, field%name, 1, entries, values))
        deallocate (values)
      else
        allocate (whole(field%components, entries))
        call ok(cleave_field_get_integer(before, body, field%name, 1, entries, whole))
        call ok(cleave_field_put_integer(after, body, field%name, 1, entries, whole))
        deallocate (whole)
      end if
    end do
    call ok(cleave_model_clock(before, steps, time))
    call ok(cleave_model_destroy(before))
    call ok(cleave_model_restore(after, steps, time))
    do k = 51, 120
      call step(after, body, k, dt)
    end do
    allocate (u(3, n))
    call ok(cleave_field_get_real(after, body, 'displacement', 1, n, u))
    call same_reals('run_displacement', reshape(u, [3 * n]))
    call ok(cleave_model_destroy(after))
  end subroutine carried_on

  subroutine statics(dimension)
    integer, intent(in) :: dimension
    type(cleave_model) :: model
    type(cleave_static_options) :: options
    type(cleave_static_report) :: report
    type(cleave_relaxation_options) :: relaxation
    type(cleave_relaxation_report) :: relaxed
    integer, allocatable :: particle(:), direction(:)
    integer(c_int32_t), allocatable :: motion(:)
    real(c_double), allocatable :: led_to(:), u(:)
    integer :: body, n, i, d, count
    call patch(model, dimension, body)
    n = size(reals('volume'))
    allocate (particle(3 * n), direction(3 * n))
    count = 0
    do i = 1, n, 3
      do d = 1, dimension
        count = count + 1
        particle(count) = i
        direction(count) = d
      end do
    end do
    allocate (motion(count), led_to(count), u(3 * n))
    motion = CLEAVE_MOTION_EXACT
    led_to = 0
    led_to(1) = 1e-4_c_double
    call ok(cleave_body_prescribe(model, body, particle(:count), direction(:count), motion))
    call ok(cleave_model_setup(model))
    call ok(cleave_model_initialise(model, 0.0_c_double))
    call ok(cleave_body_motion(model, body, led_to))
    call ok(cleave_static_options_init(options))
    options%tolerance = 1e-7_c_double
    call ok(cleave_model_solve_static(model, 1.0_c_double, options, report))
    call ok(cleave_field_get_real(model, body, 'displacement', 1, n, u))
    call same_reals('static_displacement', u)
    call same_reals('static_residual', [report%residual])
    call same_integers('static_report', [report%iterations, report%unknowns, report%broken, &
        report%critical])
    call same_reals('static_fraction', [report%fraction])
    options%breaking = CLEAVE_BREAKING_ONE
    call ok(cleave_model_break_static(model, options, report))
    call same_integers('static_broken', [report%iterations, report%broken, report%critical])
    led_to(1) = 2e-4_c_double
    call ok(cleave_body_motion(model, body, led_to))
    call ok(cleave_relaxation_options_init(relaxation))
    relaxation%slice = 10
    call ok(cleave_model_relax(model, 2.0_c_double, relaxation, relaxed))
    call require(.not. relaxed%finished, 'a slice is not enough')
    call ok(cleave_model_relax_cancel(model))
    do
      call ok(cleave_model_relax(model, 2.0_c_double, relaxation, relaxed))
      if (relaxed%finished) exit
    end do
    call ok(cleave_field_get_real(model, body, 'displacement', 1, n, u))
    call same_reals('relaxed_displacement', u)
    call same_reals('relaxed_residual', [relaxed%residual])
    call same_integers('relaxed_report', [relaxed%iterations, relaxed%rounds, relaxed%broken, &
        relaxed%unknowns])
    call ok(cleave_model_destroy(model))
  end subroutine statics
end program model_calls
