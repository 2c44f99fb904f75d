! Starter routine of /MAT/USER01: the cards of a Cleave material. After the title and the line with
! the density, numbers and names are separated by blanks, on as many lines as wanted; lines with #
! are notes:
!
!   /MAT/USER01/1
!   copper
!                 8.93E-6
!   j2
!   8.93E-6 117. 0.35 0.4 0.4 0.1 0.
!
! The law by its name, then all of its properties in the order of `cleave keys material`, in the
! units of the deck. UPARAM is as cleave_radioss.f90 says, NUVAR the number of history variables,
! PARMAT(1) the stiffness rho c^2 of contact and of the first step. Mistakes end the starter with a
! message.
subroutine lecmuser01(iin, iout, uparam, maxuparam, nuparam, nuvar, ifunc, maxfunc, nfunc, parmat, &
    userbuf)
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use law_user, only: ulawbuf
  use law_userso, only: ulawintbuf
  use cleave, only: CLEAVE_BAD_ARGUMENT, CLEAVE_OK
  use cleave_adapter, only: adapter_fail, adapter_find_law, adapter_law, adapter_max_properties, &
    adapter_message, adapter_message_length, adapter_properties, adapter_wave_speed
  use cleave_radioss, only: radioss_check_density_place, radioss_head, radioss_plastic_strain_place
  implicit none
  type(ulawintbuf), pointer :: of_the_engine  ! for its kind of reals
  integer, parameter :: host = kind(of_the_engine%rho0)
  type(ulawbuf), intent(in) :: userbuf
  integer, intent(in) :: iin, iout, maxuparam, maxfunc
  integer, intent(inout) :: nuparam, nuvar, ifunc(maxfunc), nfunc
  real(host), intent(inout) :: uparam(maxuparam), parmat(*)
  real(c_double) :: given(adapter_max_properties), values(adapter_max_properties), speed
  integer(c_int64_t) :: count
  integer(c_int32_t) :: status
  integer :: place
  character(len=adapter_message_length) :: text
  type(adapter_law) :: law
  external :: arret

  nuparam = 0
  nuvar = 0
  nfunc = 0
  call read_cards(status)
  if (status == CLEAVE_OK) call adapter_properties(law, count, given, values, status)
  if (status == CLEAVE_OK) call adapter_wave_speed(law, values, speed, status)
  if (status == CLEAVE_OK) call radioss_check_density_place(law, status)
  if (status == CLEAVE_OK) call radioss_plastic_strain_place(law, place, status)
  if (status == CLEAVE_OK .and. radioss_head + count > maxuparam) &
    call adapter_fail(CLEAVE_BAD_ARGUMENT, 'the starter has no room for the properties of law ' // &
      trim(law%name), status)
  if (status /= CLEAVE_OK) then
    call adapter_message(text)
    write (iout, '(a,i0,a)') ' ** ERROR IN CLEAVE (/MAT/USER01/', userbuf%id, '): ' // trim(text)
    call arret(2)
    return
  end if
  nuparam = radioss_head + int(count)
  nuvar = int(law%history_count)
  uparam(1) = real(law%material, host)
  uparam(2) = real(place, host)
  uparam(radioss_head + 1:nuparam) = real(values(1:count), host)
  parmat(1) = real(values(1) * speed**2, host)
  write (iout, '(5x,a)') 'CLEAVE MATERIAL, LAW ' // trim(law%name)
  write (iout, '(5x,es16.8)') values(1:count)

contains

  ! The law, and the numbers after it.
  subroutine read_cards(answer)
    integer(c_int32_t), intent(out) :: answer
    character(len=500) :: line
    character(len=40) :: word
    integer :: end_of_file, last, problem
    logical :: named

    answer = CLEAVE_OK
    count = 0
    given = 0
    named = .false.
    do
      read (iin, '(a)', iostat=end_of_file) line
      if (end_of_file /= 0) exit
      line = adjustl(line)
      if (line(1:1) == '#') cycle
      do while (line /= ' ')
        last = index(line, ' ') - 1
        if (last < 0) last = len(line)
        word = line(1:min(last, len(word)))
        line = adjustl(line(last + 1:))
        if (.not. named) then
          call adapter_find_law(word, law, answer)
          if (answer /= CLEAVE_OK) return
          named = .true.
        else
          count = count + 1
          problem = 1
          if (last <= len(word) .and. verify(trim(word), '0123456789+-.eEdD') == 0) &
            read (word, '(f40.0)', iostat=problem) given(min(count, int(size(given), c_int64_t)))
          if (problem /= 0) then
            call adapter_fail(CLEAVE_BAD_ARGUMENT, '''' // trim(word) // ''' is not a number; ' // &
              'after the law stand its properties, separated by blanks', answer)
            return
          end if
        end if
      end do
    end do
    if (.not. named) call adapter_fail(CLEAVE_BAD_ARGUMENT, 'no law is named; the line after ' // &
      'the density begins with one, for example j2', answer)
  end subroutine read_cards
end subroutine lecmuser01
