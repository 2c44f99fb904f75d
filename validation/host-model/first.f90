! The smallest host: a strip of two rows of triangles in this program's own arrays, whose ends fly apart,
! stepped until it swings back. Prints time and energies; their sum stays.
program first
  use cleave
  implicit none
  integer, parameter :: dp = kind(1d0), columns = 21, n = 2 * columns
  type(cleave_model) :: model
  type(cleave_body_spec) :: spec
  type(cleave_energies) :: energies
  real(dp) :: X(3, n), v(3, n), dt, time
  integer :: triangles(3, 2 * columns - 2), body, i, step

  do i = 1, columns                                    ! particles 2i - 1 below, 2i above
    X(:, 2 * i - 1) = [1e-3_dp * i, 0.0_dp, 0.0_dp]
    X(:, 2 * i) = [1e-3_dp * i, 1e-3_dp, 0.0_dp]
  end do
  do i = 1, columns - 1
    triangles(:, 2 * i - 1) = [2 * i - 1, 2 * i + 1, 2 * i + 2]
    triangles(:, 2 * i) = [2 * i - 1, 2 * i + 2, 2 * i]
  end do

  call ok(cleave_model_create(model))
  call ok(cleave_body_spec_init(spec))
  spec%name = 'strip'
  spec%kinematics = CLEAVE_PLANE_STRESS
  spec%material = CLEAVE_MATERIAL_SVK
  call ok(cleave_body_add(model, spec, X, triangles, body))
  call ok(cleave_body_set_real(model, body, 'material', 'rho', 2700.0_dp))
  call ok(cleave_body_set_real(model, body, 'material', 'E', 70e9_dp))
  call ok(cleave_body_set_real(model, body, 'material', 'nu', 0.3_dp))
  call ok(cleave_body_set_choice(model, body, 'fracture', 'criterion', 'none'))
  call ok(cleave_body_set_choice(model, body, 'viscosity', 'form', 'none'))
  call ok(cleave_model_setup(model))

  v = 0
  v(1, :) = 1e3_dp * (X(1, :) - 11e-3_dp)
  call ok(cleave_field_put_real(model, body, 'velocity', 1, n, v))
  call ok(cleave_model_initialise(model, 0.0_dp))
  call ok(cleave_model_stable_step(model, dt))
  time = 0
  print '(a)', '  time [s]  kinetic [J/m]  elastic [J/m]      sum'
  do step = 0, 100
    if (mod(step, 20) == 0) then
      call ok(cleave_energies_get(model, body, energies))
      print '(es10.3, 3f14.6)', time, energies%kinetic, energies%elastic + energies%stabilisation, &
          energies%kinetic + energies%elastic + energies%stabilisation
    end if
    time = time + 0.5_dp * dt
    call ok(cleave_model_advance(model, 0.5_dp * dt, time))
    call ok(cleave_model_update(model))
  end do
  call ok(cleave_model_destroy(model))

contains

  subroutine ok(status)
    integer, intent(in) :: status
    character(len=400) :: message
    integer :: length
    if (status == CLEAVE_OK) return
    if (cleave_last_message(message, length) == CLEAVE_OK) print '(a)', trim(message)
    stop 1
  end subroutine ok
end program first
