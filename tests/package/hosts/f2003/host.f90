! A host in Fortran 2003 that knows Cleave only as an installed package: a unit cube of six tetrahedra in
! its own arrays, stretched in x. Says nothing and ends with status 0 if the force on a face is the one of
! the closed form. Its integers are default ones, of whatever size the compiler is told.
program host
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use cleave
  implicit none
  integer, parameter :: particles = 8, tetrahedra = 6
  real(c_double), parameter :: properties(3) = [1000.0_c_double, 2.0e9_c_double, 0.25_c_double]
  real(c_double), parameter :: stretch = 0.1_c_double
  ! Particle 1 + i + 2 j + 4 k is at (i, j, k); every tetrahedron has the diagonal from 1 to 8.
  integer, parameter :: simplices(4, tetrahedra) = reshape([1, 2, 4, 8, 1, 2, 6, 8, 1, 3, 4, 8, &
      1, 3, 7, 8, 1, 5, 6, 8, 1, 5, 7, 8], [4, tetrahedra])
  type(cleave_network) :: network
  integer(c_int64_t), target :: row_begin(particles + 1)
  integer(c_int64_t), allocatable, target :: neighbour(:), reverse(:)
  real(c_double), allocatable, target :: zeta(:, :), volume(:)
  real(c_double) :: X(3, particles), u(3, particles), f(3, particles)
  real(c_double) :: H(3, 3, particles), P(3, 3, particles), P11, pull
  integer(c_int32_t) :: svk
  integer :: i, half_bonds

  do i = 1, particles
    X(:, i) = real([mod(i - 1, 2), mod((i - 1) / 2, 2), (i - 1) / 4], c_double)
  end do
  u = 0
  u(1, :) = stretch * X(1, :)
  f = 0

  call ok(cleave_network_init(network))
  call ok(cleave_network_rows(network, row_begin))
  call ok(cleave_cbm_count_bonds(network, simplices))
  half_bonds = int(row_begin(particles + 1) - row_begin(1))
  if (half_bonds /= 2 * (12 + 6 + 1)) stop 2 ! edges and diagonals
  allocate (neighbour(half_bonds), reverse(half_bonds), zeta(3, half_bonds), volume(particles))
  call ok(cleave_network_bonds(network, neighbour, reverse, zeta, volume))
  call ok(cleave_cbm_bonds(network, X, simplices))
  call ok(cleave_displacement_gradient(network, 1, particles, u, H))
  call ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, 'svk', svk))
  call ok(cleave_material_stress(svk, CLEAVE_3D, properties, 1, particles, H, P=P))
  call ok(cleave_bond_force(network, 1, particles, P, f))

  ! F11 = 1 + g: E11 = g + g^2/2, S11 = (lambda + 2 mu) E11, P11 = F11 S11; lambda = mu = 0.8e9.
  P11 = (1 + stretch) * 2.4e9_c_double * (stretch + 0.5_c_double * stretch**2)
  pull = sum(X(1, :) * f(1, :))
  if (abs(pull + P11) > 1e-13_c_double * P11) stop 3

contains

  subroutine ok(status)
    integer(c_int32_t), intent(in) :: status
    character(len=300) :: message
    integer :: length
    if (status == CLEAVE_OK) return
    if (cleave_last_message(message, length) == CLEAVE_OK) print '(a)', trim(message)
    stop 1
  end subroutine ok
end program host
