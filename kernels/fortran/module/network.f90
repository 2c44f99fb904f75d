
! The bonds of a body as a view of the host's arrays. The network keeps addresses: the arrays must
! have the target attribute, stay where they are while it is used, and be contiguous.
module cleave_networks
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_intptr_t, c_double, c_ptr, c_loc, &
      c_null_ptr, c_associated, c_f_pointer
  use cleave_constants, only: CLEAVE_OK, CLEAVE_NULL_ARGUMENT, CLEAVE_BAD_ARGUMENT, &
      CLEAVE_WRONG_ORDER
  use cleave_support, only: refuse
  use cleave_layout, only: layout, shape_fits, length_fits
  use cleave_c, only: cleave_network, c_network_init => cleave_network_init
  implicit none
  private
  public :: cleave_network, cleave_network_init, cleave_network_rows, cleave_network_bonds
  public :: vectors_of, tensors_of, half_bonds

  ! An address for arrays without entries, which have none of their own.
  real(c_double), target :: nothing(1) = 0

  interface cleave_network_init
    module procedure network_init
  end interface cleave_network_init
  interface cleave_network_rows
    module procedure network_rows
  end interface cleave_network_rows
  interface cleave_network_bonds
    module procedure network_bonds
  end interface cleave_network_bonds

contains

  ! Three dimensions, index base 1, arrays a(3,n) and a(9,n), nothing bound.
  recursive function network_init(network) result(status)
    type(cleave_network), intent(out) :: network
    integer(c_int32_t) :: status
    status = c_network_init(network)
    network%index_base = 1_c_int32_t
  end function network_init

  ! row_begin(n+1): binds the rows of n particles, before cleave_cbm_count_bonds fills them.
  recursive function network_rows(network, row_begin) result(status)
    type(cleave_network), intent(inout) :: network
    integer(c_int64_t), intent(in), target, optional :: row_begin(:)
    integer(c_int32_t) :: status
    character(len=*), parameter :: me = 'cleave_network_rows'
    status = CLEAVE_OK
    if (.not. present(row_begin)) then
      status = missing(me, 'row_begin')
    else
      status = length_fits(me, 'row_begin', size(row_begin), 1_c_int64_t)
      if (status == CLEAVE_OK) status = contiguous_int64(me, 'row_begin', row_begin)
      if (status /= CLEAVE_OK) return
      network%particles = size(row_begin, kind=c_int64_t) - 1_c_int64_t
      network%row_begin = c_loc(row_begin(1))
    end if
  end function network_rows

  ! Binds neighbour(h), reverse(h), zeta(3,h), volume(n), with h = row_begin(n+1) - row_begin(1).
  recursive function network_bonds(network, neighbour, reverse, zeta, volume) result(status)
    type(cleave_network), intent(inout) :: network
    integer(c_int64_t), intent(in), target, optional :: neighbour(:), reverse(:)
    real(c_double), intent(in), target, optional :: zeta(:,:), volume(:)
    integer(c_int32_t) :: status
    character(len=*), parameter :: me = 'cleave_network_bonds'
    integer(c_int64_t) :: h
    status = CLEAVE_OK
    if (.not. c_associated(network%row_begin)) then
      status = refuse(CLEAVE_WRONG_ORDER, me, 'the network has no rows; call ' // &
          'cleave_network_rows and cleave_cbm_count_bonds first')
    else if (.not. present(neighbour)) then
      status = missing(me, 'neighbour')
    else if (.not. present(reverse)) then
      status = missing(me, 'reverse')
    else if (.not. present(zeta)) then
      status = missing(me, 'zeta')
    else if (.not. present(volume)) then
      status = missing(me, 'volume')
    end if
    if (status /= CLEAVE_OK) return
    h = half_bonds(network)
    status = length_fits(me, 'neighbour', size(neighbour), h)
    if (status == CLEAVE_OK) status = contiguous_int64(me, 'neighbour', neighbour)
    if (status == CLEAVE_OK) status = length_fits(me, 'reverse', size(reverse), h)
    if (status == CLEAVE_OK) status = contiguous_int64(me, 'reverse', reverse)
    if (status == CLEAVE_OK) status = shape_fits(me, 'zeta', shape(zeta), [3_c_int64_t, h])
    if (status == CLEAVE_OK) status = contiguous_columns(me, 'zeta', zeta)
    if (status == CLEAVE_OK) status = length_fits(me, 'volume', size(volume), network%particles)
    if (status == CLEAVE_OK) status = contiguous_real(me, 'volume', volume)
    if (status /= CLEAVE_OK) return
    network%neighbour = c_loc(nothing)
    network%reverse = c_loc(nothing)
    network%zeta = c_loc(nothing)
    network%volume = c_loc(nothing)
    if (size(neighbour) > 0) network%neighbour = c_loc(neighbour(1))
    if (size(reverse) > 0) network%reverse = c_loc(reverse(1))
    if (size(zeta) > 0) network%zeta = c_loc(zeta(1, 1))
    if (size(volume) > 0) network%volume = c_loc(volume(1))
  end function network_bonds

  recursive function half_bonds(network) result(h)
    type(cleave_network), intent(in) :: network
    integer(c_int64_t) :: h
    integer(c_int64_t), pointer :: row_begin(:)
    h = 0
    if (.not. c_associated(network%row_begin)) return
    call c_f_pointer(network%row_begin, row_begin, [network%particles + 1])
    h = row_begin(size(row_begin)) - row_begin(1)
  end function half_bonds

  recursive function vectors_of(network) result(vectors)
    type(cleave_network), intent(in) :: network
    type(layout) :: vectors
    vectors = layout(network%vector_point, network%vector_component, 3_c_int64_t)
  end function vectors_of

  recursive function tensors_of(network) result(tensors)
    type(cleave_network), intent(in) :: network
    type(layout) :: tensors
    tensors = layout(network%tensor_point, network%tensor_component, 9_c_int64_t)
  end function tensors_of

  recursive function missing(procedure, argument) result(status)
    character(len=*), intent(in) :: procedure, argument
    integer(c_int32_t) :: status
    status = refuse(CLEAVE_NULL_ARGUMENT, procedure, 'argument ''' // argument // &
        ''' is missing or not allocated; give an array with the target attribute')
  end function missing

  recursive function strided(procedure, argument, bytes) result(status)
    character(len=*), intent(in) :: procedure, argument
    integer(c_intptr_t), intent(in) :: bytes
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (bytes == 8) return
    status = refuse(CLEAVE_BAD_ARGUMENT, procedure, 'argument ''' // argument // &
        ''' is not contiguous; the network keeps its address, so give a whole array')
  end function strided

  recursive function distance(first, second) result(bytes)
    type(c_ptr), intent(in) :: first, second
    integer(c_intptr_t) :: bytes
    bytes = transfer(second, bytes) - transfer(first, bytes)
  end function distance

  recursive function contiguous_int64(procedure, argument, array) result(status)
    character(len=*), intent(in) :: procedure, argument
    integer(c_int64_t), intent(in), target :: array(:)
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (size(array) > 1) &
        status = strided(procedure, argument, distance(c_loc(array(1)), c_loc(array(2))))
  end function contiguous_int64

  recursive function contiguous_real(procedure, argument, array) result(status)
    character(len=*), intent(in) :: procedure, argument
    real(c_double), intent(in), target :: array(:)
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (size(array) > 1) &
        status = strided(procedure, argument, distance(c_loc(array(1)), c_loc(array(2))))
  end function contiguous_real

  ! (3,h): down a column, and from the end of one to the next.
  recursive function contiguous_columns(procedure, argument, array) result(status)
    character(len=*), intent(in) :: procedure, argument
    real(c_double), intent(in), target :: array(:,:)
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (size(array) < 1) return
    status = strided(procedure, argument, distance(c_loc(array(1, 1)), c_loc(array(2, 1))))
    if (status == CLEAVE_OK .and. size(array, 2) > 1) &
        status = strided(procedure, argument, distance(c_loc(array(3, 1)), c_loc(array(1, 2))))
  end function contiguous_columns
end module cleave_networks
