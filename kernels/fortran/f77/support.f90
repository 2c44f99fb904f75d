
! Models by number, flags in the host's integers, arrays with a leading dimension.
module cleave77_support
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_ptr, c_loc
  use cleave, only: cleave_model, cleave_model_create, cleave_model_destroy, &
      cleave_set_last_message, cleave_network_init, CLEAVE_OK, CLEAVE_BAD_ARGUMENT, &
      CLEAVE_BAD_RANGE, CLEAVE_OUT_OF_MEMORY
  use cleave_c, only: cleave_network
  implicit none
  private
  public :: create, destroy, model_of, refuse77, network_of, rows_fit, address, at_least, decimal77
  public :: real_address, clear_flags, tidy_flags

  integer, parameter, public :: capacity = 1000

  ! A handle is slot + capacity * uses: that of a destroyed model is never given again.
  type(cleave_model), pointer :: models(:) => null()
  logical :: taken(capacity) = .false.
  integer :: uses(capacity) = 0
  integer, parameter :: most_uses = 2000000

contains

  recursive subroutine create(handle, status)
    integer, intent(inout) :: handle
    integer(c_int32_t), intent(out) :: status
    integer :: slot
    if (.not. associated(models)) allocate (models(capacity))
    do slot = 1, capacity
      if (taken(slot)) cycle
      status = cleave_model_create(models(slot))
      if (status /= CLEAVE_OK) return
      taken(slot) = .true.
      handle = slot + capacity * uses(slot)
      return
    end do
    status = refuse77(CLEAVE_OUT_OF_MEMORY, 'CLMNEW', trim(decimal77(capacity)) // &
        ' models exist; destroy one with CLMDEL')
  end subroutine create

  recursive subroutine destroy(handle, status)
    integer, intent(in) :: handle
    integer(c_int32_t), intent(out) :: status
    integer :: slot
    status = known('CLMDEL', handle)
    if (status /= CLEAVE_OK) return
    slot = 1 + modulo(handle - 1, capacity)
    status = cleave_model_destroy(models(slot))
    taken(slot) = .false.
    uses(slot) = modulo(uses(slot) + 1, most_uses)
  end subroutine destroy

  recursive function known(name, handle) result(status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: handle
    integer(c_int32_t) :: status
    integer :: slot
    status = CLEAVE_OK
    slot = 1 + modulo(handle - 1, capacity)
    if (handle > 0) then
      if (taken(slot) .and. handle == slot + capacity * uses(slot)) return
    end if
    status = refuse77(CLEAVE_BAD_ARGUMENT, name, 'model ' // trim(decimal77(handle)) // &
        ' does not exist: it was never created or is destroyed; CLMNEW gives a model')
  end function known

  ! The model of a handle. Where it does not exist the calls say so: no model is created here.
  recursive subroutine model_of(name, handle, model, status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: handle
    type(cleave_model), intent(out) :: model
    integer(c_int32_t), intent(out) :: status
    status = known(name, handle)
    if (status == CLEAVE_OK) model = models(1 + modulo(handle - 1, capacity))
  end subroutine model_of

  recursive function refuse77(status, name, what) result(same)
    integer(c_int32_t), intent(in) :: status
    character(len=*), intent(in) :: name, what
    integer(c_int32_t) :: same
    same = cleave_set_last_message(name // ': ' // what)
    same = status
  end function refuse77

  recursive function decimal77(number) result(text)
    integer, intent(in) :: number
    character(len=20) :: text
    write (text, '(i0)') number
  end function decimal77

  ! Counts that size arrays must not be negative before the arrays are looked at.
  recursive function at_least(name, argument, value, least) result(status)
    character(len=*), intent(in) :: name, argument
    integer, intent(in) :: value, least
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (value < least) status = refuse77(CLEAVE_BAD_ARGUMENT, name, argument // ' is ' // &
        trim(decimal77(value)) // '; needed: ' // trim(decimal77(least)) // ' or more')
  end function at_least

  recursive function rows_fit(name, first, last, n) result(status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: first, last, n
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (first >= 1 .and. last <= n .and. last >= first - 1) return
    status = refuse77(CLEAVE_BAD_RANGE, name, 'range NFIRST = ' // trim(decimal77(first)) // &
        ' to NLAST = ' // trim(decimal77(last)) // ' does not lie inside 1 to ' // &
        trim(decimal77(n)))
  end function rows_fit

  ! ld = 0: arrays a(3,n), a(9,n); ld >= n: a(ld,3), a(ld,9).
  recursive subroutine network_of(name, ndim, n, ld, network, status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: ndim, n, ld
    type(cleave_network), intent(out) :: network
    integer(c_int32_t), intent(out) :: status
    status = cleave_network_init(network)
    if (status == CLEAVE_OK .and. ndim /= 2 .and. ndim /= 3) status = refuse77( &
        CLEAVE_BAD_ARGUMENT, name, 'NDIM is ' // trim(decimal77(ndim)) // '; allowed: 2, 3')
    if (status == CLEAVE_OK) status = at_least(name, 'N', n, 0)
    if (status == CLEAVE_OK .and. ld /= 0) status = at_least(name, 'LD (0 or a leading ' // &
        'dimension of at least N)', ld, max(n, 1))
    network%dimension = merge(2_c_int32_t, 3_c_int32_t, ndim == 2)
    network%particles = int(n, c_int64_t)
    if (ld == 0) return
    network%vector_point = 1
    network%vector_component = int(ld, c_int64_t)
    network%tensor_point = 1
    network%tensor_component = int(ld, c_int64_t)
  end subroutine network_of

  ! Addresses for the duration of one call; the host's arrays stay where they are.
  recursive function address(array) result(place)
    integer(c_int64_t), intent(in), target :: array(*)
    type(c_ptr) :: place
    place = c_loc(array)
  end function address

  recursive function real_address(array) result(place)
    real(c_double), intent(in), target :: array(*)
    type(c_ptr) :: place
    place = c_loc(array)
  end function real_address

  ! Flags that C writes as 32-bit integers, `stride` apart, into the host's integers: cleared
  ! before, 0 or 1 afterwards whatever the kind and byte order.
  recursive subroutine clear_flags(first, last, flags, place, stride)
    integer, intent(in) :: first, last
    integer, intent(inout), target :: flags(*)
    type(c_ptr), intent(out) :: place
    integer(c_int64_t), intent(out) :: stride
    integer :: i
    do i = first, last
      flags(i) = 0
    end do
    place = c_loc(flags)
    stride = int(bit_size(first) / 32, c_int64_t)
  end subroutine clear_flags

  recursive subroutine tidy_flags(first, last, flags)
    integer, intent(in) :: first, last
    integer, intent(inout) :: flags(*)
    integer :: i
    do i = first, last
      if (flags(i) /= 0) flags(i) = 1
    end do
  end subroutine tidy_flags
end module cleave77_support

! Choices of the host as C's; what does not fit into 32 bits stays unknown.
module cleave77_choice
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  implicit none
  private
  public :: choice

contains

  recursive function choice(value) result(same)
    integer, intent(in) :: value
    integer(c_int32_t) :: same
    integer(c_int64_t), parameter :: unknown = 999999
    same = int(max(-unknown, min(int(value, c_int64_t), unknown)), c_int32_t)
  end function choice
end module cleave77_choice
