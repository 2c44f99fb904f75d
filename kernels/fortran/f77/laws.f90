
! What the subroutines about material laws share.
module cleave77_laws
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double
  use cleave77_support, only: rows_fit, real_address, clear_flags, tidy_flags
  use cleave77_choice, only: choice
  use cleave_support, only: zero_based
  use cleave_c, only: cleave_material_call, cleave_material_call_init, cleave_material_update, &
      cleave_material_tangent, CLEAVE_OK
  implicit none
  private
  public :: call_of, laid_out, update, tangent

contains

  recursive subroutine call_of(name, mat, kin, nprop, nfirst, nlast, c, status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: mat, kin, nprop, nfirst, nlast
    type(cleave_material_call), intent(out) :: c
    integer(c_int32_t), intent(out) :: status
    status = cleave_material_call_init(c)
    if (status == CLEAVE_OK) status = rows_fit(name, nfirst, nlast, huge(nlast))
    c%material = choice(mat)
    c%kinematics = choice(kin)
    c%property_count = int(nprop, c_int64_t)
    c%first = zero_based(nfirst)
    c%last = int(nlast, c_int64_t)
    c%index_base = 1_c_int32_t
  end subroutine call_of

  recursive subroutine laid_out(dt, alen, isf, layd, layh, lays, c)
    real(c_double), intent(in) :: dt, alen
    integer, intent(in) :: isf, layd(11), layh(2), lays(11)
    type(cleave_material_call), intent(inout) :: c
    c%dt = dt
    c%length = alen
    c%deformation_is_F = choice(isf)
    c%deformation_point = int(layd(1), c_int64_t)
    c%deformation_component = int(layd(2), c_int64_t)
    c%deformation_order = zero_based(layd(3:))
    c%history_point = int(layh(1), c_int64_t)
    c%history_component = int(layh(2), c_int64_t)
    c%stress_point = int(lays(1), c_int64_t)
    c%stress_component = int(lays(2), c_int64_t)
    c%stress_order = zero_based(lays(3:))
  end subroutine laid_out

  recursive function update(c, nfirst, nlast, prop, d, hist, s, ifail, energy, plast, visc) &
      result(status)
    type(cleave_material_call), intent(inout) :: c
    integer, intent(in) :: nfirst, nlast
    real(c_double), intent(in) :: prop(*), d(*)
    real(c_double), intent(inout) :: hist(*), s(*)
    integer, intent(inout) :: ifail(*)
    real(c_double), intent(inout) :: energy(*)
    real(c_double), intent(inout), optional :: plast(*), visc(*)
    integer(c_int32_t) :: status
    c%properties = real_address(prop)
    c%deformation = real_address(d)
    c%history = real_address(hist)
    c%stress = real_address(s)
    c%energy = real_address(energy)
    if (present(plast)) c%plastic = real_address(plast)
    if (present(visc)) c%viscous = real_address(visc)
    call clear_flags(nfirst, nlast, ifail, c%failed, c%failed_point)
    status = cleave_material_update(c)
    call tidy_flags(nfirst, nlast, ifail)
  end function update

  recursive function tangent(c, nfirst, nlast, prop, d, hist, t, ifail) result(status)
    type(cleave_material_call), intent(inout) :: c
    integer, intent(in) :: nfirst, nlast
    real(c_double), intent(in) :: prop(*), d(*), hist(*)
    real(c_double), intent(inout) :: t(*)
    integer, intent(inout) :: ifail(*)
    integer(c_int32_t) :: status
    c%properties = real_address(prop)
    c%deformation = real_address(d)
    c%history = real_address(hist)
    c%tangent = real_address(t)
    call clear_flags(nfirst, nlast, ifail, c%failed, c%failed_point)
    status = cleave_material_tangent(c)
    call tidy_flags(nfirst, nlast, ifail)
  end function tangent
end module cleave77_laws
