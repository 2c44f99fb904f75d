
! ---- the bonds of a body: NROW(N+1); NEIGH, NREV, ZETA(3,*) have an entry for every half-bond,
! NROW(N+1) - NROW(1) of them. Vectors and tensors: LD = 0 for A(3,N), A(9,N); else the leading
! dimension of A(LD,3), A(LD,9).

! Counts the bonds of a simplex mesh ns(ndim+1,m) into nrow.
recursive subroutine clbcnt(ndim, n, m, ns, nrow, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  use cleave77_support, only: network_of, address, at_least
  use cleave_c, only: cleave_network, cleave_cbm_count_bonds, CLEAVE_OK
  implicit none
  integer, intent(in) :: ndim, n, m, ns(*)
  integer(c_int64_t), intent(inout) :: nrow(*)
  integer, intent(out) :: ierr
  type(cleave_network) :: network
  integer(c_int32_t) :: status
  integer(c_int64_t) :: entries
  call network_of('CLBCNT', ndim, n, 0, network, status)
  if (status == CLEAVE_OK) status = at_least('CLBCNT', 'M', m, 0)
  if (status == CLEAVE_OK) then
    entries = (int(network%dimension, c_int64_t) + 1_c_int64_t) * int(m, c_int64_t)
    network%row_begin = address(nrow)
    status = cleave_cbm_count_bonds(network, int(m, c_int64_t), int(ns(:entries), c_int64_t))
  end if
  ierr = status
end subroutine clbcnt

! Bond vectors and volumes from the live simplices. ialive(m): 0 deleted, else live.
recursive subroutine clbond(ndim, n, ld, x, m, ns, ialive, nrow, neigh, nrev, zeta, vol, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_support, only: network_of, address, real_address, at_least
  use cleave77_bonds, only: bonds
  use cleave_c, only: cleave_network, CLEAVE_OK
  implicit none
  integer, intent(in) :: ndim, n, ld, m, ns(*), ialive(*)
  real(c_double), intent(in) :: x(*)
  integer(c_int64_t), intent(inout) :: nrow(*), neigh(*), nrev(*)
  real(c_double), intent(inout) :: zeta(*), vol(*)
  integer, intent(out) :: ierr
  type(cleave_network) :: network
  integer(c_int32_t) :: status
  call network_of('CLBOND', ndim, n, ld, network, status)
  if (status == CLEAVE_OK) status = at_least('CLBOND', 'M', m, 0)
  if (status == CLEAVE_OK) then
    network%row_begin = address(nrow)
    network%neighbour = address(neigh)
    network%reverse = address(nrev)
    network%zeta = real_address(zeta)
    network%volume = real_address(vol)
    status = bonds(network, x, m, ns, ialive)
  end if
  ierr = status
end subroutine clbond

! Displacement gradient h of particles nfirst..nlast from the displacement u.
recursive subroutine clgrad(ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, u, h, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_bonds, only: rows
  use cleave_support, only: zero_based
  use cleave_c, only: cleave_network, cleave_displacement_gradient, CLEAVE_OK
  implicit none
  integer, intent(in) :: ndim, n, ld, nfirst, nlast
  integer(c_int64_t), intent(in) :: nrow(*), neigh(*), nrev(*)
  real(c_double), intent(in) :: zeta(*), vol(*), u(*)
  real(c_double), intent(inout) :: h(*)
  integer, intent(out) :: ierr
  type(cleave_network) :: network
  integer(c_int32_t) :: status
  call rows('CLGRAD', ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, network, status)
  if (status == CLEAVE_OK) status = cleave_displacement_gradient(network, zero_based(nfirst), &
      int(nlast, c_int64_t), u, h)
  ierr = status
end subroutine clgrad

! Adds the force of the bonds on particles nfirst..nlast to f; p: first Piola-Kirchhoff stress.
recursive subroutine clforc(ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, p, f, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_bonds, only: rows
  use cleave_support, only: zero_based
  use cleave_c, only: cleave_network, cleave_bond_force, CLEAVE_OK
  implicit none
  integer, intent(in) :: ndim, n, ld, nfirst, nlast
  integer(c_int64_t), intent(in) :: nrow(*), neigh(*), nrev(*)
  real(c_double), intent(in) :: zeta(*), vol(*), p(*)
  real(c_double), intent(inout) :: f(*)
  integer, intent(out) :: ierr
  type(cleave_network) :: network
  integer(c_int32_t) :: status
  call rows('CLFORC', ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, network, status)
  if (status == CLEAVE_OK) status = cleave_bond_force(network, zero_based(nfirst), &
      int(nlast, c_int64_t), p, f)
  ierr = status
end subroutine clforc

! Adds the artificial viscosity on particles nfirst..nlast to f. w: bond weights; aj: volume ratio;
! coeff: beta rho0 c0 [Pa s m-1]; alen: l_c of the regularisation [m].
recursive subroutine clvisc(ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, w, x, v, aj, &
    coeff, alen, f, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_bonds, only: rows
  use cleave_support, only: zero_based
  use cleave_c, only: cleave_network, cleave_bond_viscosity, CLEAVE_OK
  implicit none
  integer, intent(in) :: ndim, n, ld, nfirst, nlast
  integer(c_int64_t), intent(in) :: nrow(*), neigh(*), nrev(*)
  real(c_double), intent(in) :: zeta(*), vol(*), w(*), x(*), v(*), aj(*), coeff, alen
  real(c_double), intent(inout) :: f(*)
  integer, intent(out) :: ierr
  type(cleave_network) :: network
  integer(c_int32_t) :: status
  call rows('CLVISC', ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, network, status)
  if (status == CLEAVE_OK) status = cleave_bond_viscosity(network, zero_based(nfirst), &
      int(nlast, c_int64_t), w, x, v, aj, coeff, alen, f)
  ierr = status
end subroutine clvisc
