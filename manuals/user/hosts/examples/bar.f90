! A smallest impact code: a bar hits a rigid wall. The code owns its arrays, its time loop and its
! boundary conditions; Cleave computes bonds, deformation, stress and force. SI units, plane strain.
program bar
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use, intrinsic :: iso_fortran_env, only: error_unit
  use cleave
  implicit none

  integer, parameter :: nx = 41, ny = 5, n = nx * ny, m = 2 * (nx - 1) * (ny - 1)
  real(c_double), parameter :: spacing = 2.5e-3_c_double
  real(c_double), parameter :: rho = 2700, E = 70e9_c_double, nu = 0.3_c_double

  ! What the code owns. Arrays that a network points to are targets.
  real(c_double) :: X(3,n), u(3,n), v(3,n), f(3,n), H(9,n), P(9,n), energy(n), mass(n)
  integer :: simplices(3,m)
  integer(c_int64_t), target :: row_begin(n+1)
  integer(c_int64_t), allocatable, target :: neighbour(:), reverse(:)
  real(c_double), allocatable, target :: zeta(:,:)
  real(c_double), target :: volume(n)

  type(cleave_network) :: network
  integer(c_int32_t) :: law
  real(c_double) :: properties(3), speed, dt, start
  integer :: step, i
  logical :: wall(n)

  call check(cleave_abi_check())
  call make_mesh()

  ! Bonds: count them, make room, compute them.
  call check(cleave_network_init(network))
  network%dimension = 2
  call check(cleave_network_rows(network, row_begin))
  call check(cleave_cbm_count_bonds(network, simplices))
  allocate (neighbour(row_begin(n+1) - 1), reverse(row_begin(n+1) - 1), zeta(3, row_begin(n+1) - 1))
  call check(cleave_network_bonds(network, neighbour, reverse, zeta, volume))
  call check(cleave_cbm_bonds(network, X, simplices))

  ! A law by its name; its properties all, in the order of `cleave keys material`.
  call check(cleave_table_find(CLEAVE_TABLE_MATERIAL, 'svk', law))
  properties = [rho, E, nu]
  call check(cleave_material_wave_speed(law, CLEAVE_PLANE_STRAIN, properties, speed))
  dt = 0.3_c_double * spacing / speed

  mass = rho * volume
  wall = X(1, :) < 0.5_c_double * spacing
  u = 0
  v = 0
  v(1, :) = -20
  where (wall) v(1, :) = 0
  start = kinetic()

  do step = 1, 200
    u = u + dt * v
    call check(cleave_displacement_gradient(network, 1, n, u, H))
    call check(cleave_material_stress(law, CLEAVE_PLANE_STRAIN, properties, 1, n, H, P=P, &
        energy=energy))
    f = 0
    call check(cleave_bond_force(network, 1, n, P, f))
    do i = 1, n
      v(:, i) = v(:, i) + dt * f(:, i) / mass(i)
    end do
    where (wall) v(1, :) = 0
    if (modulo(step, 50) == 0) write (*, '(a, f6.1, a, f6.3, a, f6.3)') 'time ', 1e6_c_double * &
        step * dt, ' us   kinetic ', kinetic() / start, '   elastic ', sum(energy * volume) / start
  end do

contains

  ! Squares cut into two triangles; particles count from 1.
  subroutine make_mesh()
    integer :: column, row, a, s
    s = 0
    do row = 1, ny
      do column = 1, nx
        a = column + nx * (row - 1)
        X(:, a) = [(column - 1) * spacing, (row - 1) * spacing, 0.0_c_double]
        if (column == nx .or. row == ny) cycle
        simplices(:, s + 1) = [a, a + 1, a + nx + 1]
        simplices(:, s + 2) = [a, a + nx + 1, a + nx]
        s = s + 2
      end do
    end do
  end subroutine make_mesh

  function kinetic() result(sum_of_particles)
    real(c_double) :: sum_of_particles
    sum_of_particles = 0.5_c_double * sum(mass * sum(v * v, dim=1))
  end function kinetic

  ! What to do about an error is the code's decision. This one says why and stops.
  subroutine check(status)
    integer(c_int32_t), intent(in) :: status
    character(len=400) :: message
    if (status == CLEAVE_OK) return
    if (cleave_last_message(message) /= CLEAVE_OK) message = cleave_status_text(status)
    write (error_unit, '(a)') trim(message)
    stop 1
  end subroutine check
end program bar
