! Cleave's laws in OpenRadioss: engine routine of /MAT/USER01 for solids; lecmuser01.f90 reads its
! cards. One user number serves every law and any number of materials; for another number rename
! both routines.
!
!   group        NEL elements, 1 to 128, one integration point a call, from several threads
!   precision    that of the SDK's module LAW_USERSO: REAL*8, or REAL*4 in the _sp build
!   parameters   UPARAM as cleave_radioss.f90 says; written by LECMUSER01
!   deformation  FPSXX ... of USERBUF, the gradient F itself; the engine fills it for Ismstr = 10
!                only, else it is zero and the run ends with a message
!   frame        global. Isolid = 1 or 2 with Iframe = 1 hands F and stress over in it. Solids with
!                a frame of their own (Isolid 14, 17, 18, 24, Iframe = 2) hand over G^T F G with
!                the frame G of the moment: the reference configuration turns with the element,
!                and what the law remembers in it does not. Laws without history (svk, neo_hooke)
!                and mie_gruneisen are right there; plasticity is not once the element turns.
!   history      UVAR (NEL, NUVAR), in the order of the law's lines in the fields table
!   stress       SIGNXX ... Cauchy, xx yy zz xy yz zx; SIGV zero: the viscosity of a law is in its
!                stress
!   sound speed  longitudinal waves in the undeformed material
!   viscosity    VISCMAX zero
!   length       cube root of VOLUME, for laws with shock viscosity. Set q_a and q_b of the property
!                to 1e-20 then, or Q1 and Q2 of the law to 0: else shocks are damped twice.
!   plastic      PLA the equivalent plastic strain, DPLA its increment, for laws that have it
!   energy       EINT is the engine's, from stress and strain rate
!   density      RHO0 must be that of the law
!   deletion     OFF = 0 at once where the damage of the law reaches 1 or the law has no answer,
!                with a line in the listing for the latter; an element with OFF < 1 is not called
!                again and has no stress
recursive subroutine luser01(nel, nuparam, nuvar, nfunc, ifunc, npf, tf, time, timestep, uparam, &
    rho, volume, eint, ngl, soundsp, viscmax, uvar, off, sigy, pla, userbuf)
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use law_userso, only: ulawintbuf
  use cleave, only: CLEAVE_BAD_ARGUMENT, CLEAVE_OK
  use cleave_adapter, only: adapter_fail, adapter_law, adapter_layout, adapter_max_properties, &
    adapter_properties, adapter_update, adapter_wave_speed
  use cleave_radioss, only: radioss_head, radioss_law, radioss_length, radioss_stop
  implicit none
  type(ulawintbuf), intent(inout) :: userbuf
  integer, parameter :: host = kind(userbuf%rho0)
  integer, intent(in) :: nel, nuparam, nuvar, nfunc, ifunc(*), npf(*), ngl(nel)
  real(host), intent(in) :: tf(*), time, timestep, uparam(nuparam), rho(nel), volume(nel), eint(nel)
  real(host), intent(inout) :: soundsp(nel), viscmax(nel), uvar(nel, nuvar), off(nel), sigy(nel)
  real(host), intent(inout) :: pla(nel)
  real(host) :: f(nel, 9), stress(nel, 6), old_pla(nel)
  real(c_double) :: values(adapter_max_properties), lengths(nel), speed
  real(c_double) :: energy(nel), plastic(nel), viscous(nel)
  integer(c_int32_t) :: failed(nel), status
  integer :: i, first, last, place
  type(adapter_law) :: law
  type(adapter_layout) :: layout

  call radioss_law(nint(uparam(1)), law, status)
  if (status == CLEAVE_OK) call adapter_properties(law, int(nuparam - radioss_head, c_int64_t), &
    uparam(radioss_head + 1:nuparam), values, status)
  if (status == CLEAVE_OK) call check_host(status)
  if (status == CLEAVE_OK) call adapter_wave_speed(law, values, speed, status)
  if (status /= CLEAVE_OK) then
    call radioss_stop('/MAT/USER01')
    return
  end if
  call gather
  place = nint(uparam(2))
  old_pla = 0
  if (place > 0) old_pla = uvar(:, place)
  stress = 0
  failed = 0

  last = 0
  do
    first = last + 1
    do while (first <= nel)  ! a run of elements that are there
      if (off(first) >= 1) exit
      first = first + 1
    end do
    if (first > nel) exit
    last = first
    do while (last < nel)
      if (off(last + 1) < 1) exit
      last = last + 1
    end do
    call adapter_update(law, values, layout, int(first, c_int64_t), int(last, c_int64_t), &
      real(timestep, c_double), lengths(first:last), f, uvar, stress, energy(first:last), &
      plastic(first:last), viscous(first:last), failed(first:last), status)
    if (status /= CLEAVE_OK) then
      call radioss_stop('/MAT/USER01')
      return
    end if
  end do
  call scatter

contains

  subroutine check_host(answer)
    integer(c_int32_t), intent(out) :: answer
    character(len=12) :: given, wanted
    answer = CLEAVE_OK
    if (nuvar < law%history_count) then
      write (given, '(i0)') nuvar
      write (wanted, '(i0)') law%history_count
      call adapter_fail(CLEAVE_BAD_ARGUMENT, 'law ' // trim(law%name) // ' has ' // &
        trim(wanted) // ' variables, the restart file ' // trim(given) // &
        '; run starter and engine with the same user library', answer)
    else if (abs(userbuf%rho0(1) - values(1)) > 1.0e-5_c_double * values(1)) then
      call adapter_fail(CLEAVE_BAD_ARGUMENT, 'the density on the first card of the material ' // &
        'is not the property rho of law ' // trim(law%name) // '; give the same value at ' // &
        'both places', answer)
    else if (any(off >= 1 .and. userbuf%fpsxx(1:nel) <= 0 .and. userbuf%fpsxx(1:nel) >= 0 .and. &
        userbuf%fpsyy(1:nel) <= 0 .and. userbuf%fpsyy(1:nel) >= 0 .and. &
        userbuf%fpszz(1:nel) <= 0 .and. userbuf%fpszz(1:nel) >= 0)) then
      call adapter_fail(CLEAVE_BAD_ARGUMENT, 'the engine hands over no deformation gradient; ' // &
        'write Ismstr = 10 in the property (/PROP/SOLID) of the part', answer)
    end if
  end subroutine check_host

  subroutine gather
    f(:, 1) = userbuf%fpsxx(1:nel)
    f(:, 2) = userbuf%fpsyx(1:nel)
    f(:, 3) = userbuf%fpszx(1:nel)
    f(:, 4) = userbuf%fpsxy(1:nel)
    f(:, 5) = userbuf%fpsyy(1:nel)
    f(:, 6) = userbuf%fpszy(1:nel)
    f(:, 7) = userbuf%fpsxz(1:nel)
    f(:, 8) = userbuf%fpsyz(1:nel)
    f(:, 9) = userbuf%fpszz(1:nel)
    do i = 1, nel
      call radioss_length(real(volume(i), c_double), lengths(i))
    end do
    layout%f_leading = nel
    layout%history_leading = nel
    layout%stress_leading = nel
  end subroutine gather

  subroutine scatter
    character(len=120) :: line
    external :: write_iout
    do i = 1, nel
      if (off(i) < 1) off(i) = 0
      if (failed(i) /= 0) then
        write (line, '(a,i0,a)') ' -- CLEAVE: ELEMENT ', ngl(i), &
          ' DELETED, ITS DEFORMATION IS OUTSIDE THE RANGE OF THE LAW'
        call write_iout(line, len_trim(line))
        off(i) = 0
      end if
      if (law%damage_place > 0) then
        if (uvar(i, law%damage_place) >= 1) off(i) = 0
      end if
      if (off(i) < 1) stress(i, :) = 0
    end do
    userbuf%signxx(1:nel) = stress(:, 1)
    userbuf%signyy(1:nel) = stress(:, 2)
    userbuf%signzz(1:nel) = stress(:, 3)
    userbuf%signxy(1:nel) = stress(:, 4)
    userbuf%signyz(1:nel) = stress(:, 5)
    userbuf%signzx(1:nel) = stress(:, 6)
    userbuf%sigvxx(1:nel) = 0
    userbuf%sigvyy(1:nel) = 0
    userbuf%sigvzz(1:nel) = 0
    userbuf%sigvxy(1:nel) = 0
    userbuf%sigvyz(1:nel) = 0
    userbuf%sigvzx(1:nel) = 0
    soundsp = real(speed, host)
    viscmax = 0
    if (place > 0) then
      pla = uvar(:, place)
      userbuf%dpla(1:nel) = pla - old_pla
    end if
  end subroutine scatter
end subroutine luser01
