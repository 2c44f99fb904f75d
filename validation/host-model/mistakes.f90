! Wrong calls on purpose, between right ones: each returns a status and a message, changes nothing, and
! the program goes on. Prints a line for each mistake: status, message. Then two models, one with all
! the mistakes and one without, are stepped and compared.
program mistakes
  use cleave
  use mesh, only: dp, mesh_t, make_block
  use status_check, only: check, message_of
  implicit none
  type(mesh_t) :: block
  type(cleave_model) :: model(2), none
  real(dp), allocatable :: u(:,:,:)
  integer :: k, n
  call make_block(block, [0.0_dp, 0.0_dp, 0.0_dp], 1e-3_dp, [3, 2, 2])
  n = size(block%X, 2)
  allocate (u(3, n, 2))
  do k = 1, 2
    call run(model(k), k == 1, u(:, :, k))
  end do
  call wrong('a model that was never created', cleave_model_update(none))
  print '(a, l1)', 'the same displacements with and without the mistakes: ', &
      all(transfer(u(:, :, 1), [0]) == transfer(u(:, :, 2), [0])) .and. maxval(abs(u)) > 0
  do k = 1, 2
    call check(cleave_model_destroy(model(k)))
  end do

contains

  subroutine run(model, careless, u)
    type(cleave_model), intent(inout) :: model
    logical, intent(in) :: careless
    real(dp), intent(out) :: u(:,:)
    type(cleave_body_spec) :: spec
    real(dp) :: dt, v(3, n)
    integer :: body, s
    call check(cleave_model_create(model))
    call check(cleave_body_spec_init(spec))
    spec%name = 'block'
    call check(cleave_table_find(CLEAVE_TABLE_MATERIAL, 'svk', spec%material))
    if (careless) then
      call wrong('an unknown law', cleave_table_find(CLEAVE_TABLE_MATERIAL, 'steel', spec%material))
      call wrong('positions (n,3)', cleave_body_add(model, spec, transpose(block%X), &
          block%simplices, body))
      call wrong('triangles for tetrahedra', cleave_body_add(model, spec, block%X, &
          block%simplices(:3, :), body))
    end if
    call check(cleave_body_add(model, spec, block%X, block%simplices, body))
    call check(cleave_body_set_real(model, body, 'material', 'rho', 2700.0_dp))
    call check(cleave_body_set_real(model, body, 'material', 'E', 70e9_dp))
    if (careless) then
      call wrong('a parameter that is missing', cleave_model_setup(model))
      call wrong('an unknown parameter', cleave_body_set_real(model, body, 'material', 'poisson', &
          0.3_dp))
      call wrong('a parameter out of range', cleave_body_set_real(model, body, 'material', 'nu', &
          0.5_dp))
      call wrong('a body that is not there', cleave_body_set_real(model, 7, 'material', 'nu', &
          0.3_dp))
    end if
    call check(cleave_body_set_real(model, body, 'material', 'nu', 0.3_dp))
    call check(cleave_body_set_choice(model, body, 'fracture', 'criterion', 'none'))
    call check(cleave_body_set_real(model, body, 'viscosity', 'length', 1e-3_dp))
    if (careless) call wrong('a field before set-up', &
        cleave_field_get_real(model, body, 'velocity', 1, n, v))
    call check(cleave_model_setup(model))
    v = 0
    v(1, :) = 1e3_dp * block%X(2, :)
    if (careless) then
      call wrong('too small an array', cleave_field_put_real(model, body, 'velocity', 1, n, &
          v(:, :n - 1)))
      call wrong('too large a range', cleave_field_put_real(model, body, 'velocity', 1, n + 1, v))
      call wrong('an unknown field', cleave_field_put_real(model, body, 'velocities', 1, n, v))
      call wrong('integers of a real field', cleave_field_put_integer(model, body, 'velocity', 1, &
          n, nint(v)))
      call wrong('update before initialise', cleave_model_update(model))
    end if
    call check(cleave_field_put_real(model, body, 'velocity', 1, n, v))
    call check(cleave_model_initialise(model, 0.0_dp))
    call check(cleave_model_stable_step(model, dt))
    do s = 1, 20
      if (careless .and. s == 10) then
        call wrong('a step that is negative', cleave_model_advance(model, -dt, 0.0_dp))
        call wrong('update without advance', cleave_model_update(model))
      end if
      call check(cleave_model_advance(model, 0.5_dp * dt, 0.5_dp * s * dt))
      call check(cleave_model_update(model))
    end do
    call check(cleave_field_get_real(model, body, 'displacement', 1, n, u))
  end subroutine run

  subroutine wrong(what, status)
    character(len=*), intent(in) :: what
    integer, intent(in) :: status
    print '(a, ": ", i0, ": ", a)', what, status, trim(message_of(status))
  end subroutine wrong
end program mistakes
