
! What the subroutines about bonds share.
module cleave77_bonds
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_loc
  use cleave77_support, only: network_of, rows_fit, address, real_address
  use cleave_c, only: cleave_network, cleave_cbm_bonds, CLEAVE_OK
  implicit none
  private
  public :: bonds, rows

contains

  recursive subroutine rows(name, ndim, n, ld, nfirst, nlast, nrow, neigh, nrev, zeta, vol, &
      network, status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: ndim, n, ld, nfirst, nlast
    integer(c_int64_t), intent(in) :: nrow(*), neigh(*), nrev(*)
    real(c_double), intent(in) :: zeta(*), vol(*)
    type(cleave_network), intent(out) :: network
    integer(c_int32_t), intent(out) :: status
    call network_of(name, ndim, n, ld, network, status)
    if (status == CLEAVE_OK) status = rows_fit(name, nfirst, nlast, n)
    if (status /= CLEAVE_OK) return
    network%row_begin = address(nrow)
    network%neighbour = address(neigh)
    network%reverse = address(nrev)
    network%zeta = real_address(zeta)
    network%volume = real_address(vol)
  end subroutine rows

  recursive function bonds(network, x, m, ns, ialive) result(status)
    type(cleave_network), intent(in) :: network
    real(c_double), intent(in) :: x(*)
    integer, intent(in) :: m, ns(*), ialive(*)
    integer(c_int32_t) :: status
    integer(c_int32_t), allocatable, target :: alive(:)
    integer(c_int64_t) :: entries
    integer :: s
    allocate (alive(max(m, 1)))
    do s = 1, m
      alive(s) = merge(0_c_int32_t, 1_c_int32_t, ialive(s) == 0)
    end do
    entries = (int(network%dimension, c_int64_t) + 1_c_int64_t) * int(m, c_int64_t)
    status = cleave_cbm_bonds(network, x, int(m, c_int64_t), int(ns(:entries), c_int64_t), &
        c_loc(alive))
  end function bonds
end module cleave77_bonds
