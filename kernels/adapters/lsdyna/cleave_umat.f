C Cleave's laws in LS-DYNA: what umat41 ... umat50 and their vector
C forms umat41v ... call. Solid elements in the global frame
C (IORTHO = 0).
C
C law         by the number of the routine: cleave_slots.f90
C cm          1 to np the properties of the law, all of them, in the
C             order of `cleave keys material`; np+1 the bulk modulus
C             (IBULK = np+1), np+2 the shear modulus (IG = np+2), with
C             LMC = np+2: LS-DYNA takes time step, contact and hourglass
C             control from them. They must not be below those of the law
C             at rest, checked in the first step (tt = 0). This is also
C             how a wrong number of properties is found: LS-DYNA does
C             not say how many there are.
C components  xx yy zz xy yz zx
C frame       global; the deformation gradient (IHYPER = 1) goes in, and
C             neither strain increments nor old stresses are used
C sig         Cauchy, tension positive
C precision   REAL*8 and REAL*4, by the flags of the host's build
C blocks      hsv(nlq,*), points lft to llt, any number; nothing kept
C             between calls. The scalar form is a block of one point.
C hsv         1 to nh the history of the law, in the order of its lines
C             in the fields table; nh+1 is 0, and 1 for a dead point.
C             NHV = nh+1. LS-DYNA puts F behind it, by columns:
C             nh+2 ... nh+10 = 11 21 31 12 22 32 13 23 33
C epsps       equivalent plastic strain, where the law has one
C energies    LS-DYNA integrates them from the stress
C deletion    failel = .true. from the step on where the damage of the
C             law reaches 1 or the law has no answer; the stress of a
C             dead point is zero and its history stays. The point is
C             deleted if FAIL on the card allows it.
C errors      a number without a law, elements other than solids, moduli
C             too small, no deformation gradient, properties out of
C             range: cleave_stop_host of cleave_slots.f90
      recursive subroutine cleave_umatv(slot, cm, sig1, sig2, sig3,
     &  sig4, sig5, sig6, epsps, hsv, nlq, lft, llt, dt1siz, etype, tt,
     &  failels, elsizv)
      use cleave_adapter
      use cleave_slots
      use cleave_c, only: CLEAVE_OK, CLEAVE_BAD_ARGUMENT,
     &  CLEAVE_UNSUPPORTED
      implicit none
      integer slot, nlq, lft, llt
      real cm(*), sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*),
     &  epsps(*), hsv(nlq,*), dt1siz(*), tt, elsizv(*)
      character*5 etype
      logical failels(*)
      type(adapter_law) law
      type(adapter_layout) layout
      real(adapter_real) values(adapter_max_properties)
      integer(adapter_int) status
      integer nh, place, first, last
      character(len=adapter_message_length) message

      call check
      if (status .eq. CLEAVE_OK .and. tt .eq. 0) call check_moduli
      first = lft
      do while (first .le. llt .and. status .eq. CLEAVE_OK)
        last = end_of_piece()
        if (hsv(first,nh+1) .ne. 0) then
          call bury(first)
        else
          call piece(last - first + 1, hsv(first,1), hsv(first,nh+2))
        end if
        first = last + 1
      end do
      if (status .ne. CLEAVE_OK) then
        call adapter_message(message)
        call cleave_stop_host(message)
      end if

      contains

      recursive subroutine check
      integer k
      character*12 text
      do k = 1, cleave_slot_count
        if (cleave_slots_table(k)%number .eq. slot) exit
      end do
      if (k .gt. cleave_slot_count) then
        write (text, '(i0)') slot
        call adapter_fail(CLEAVE_BAD_ARGUMENT, 'no law stands behind '//
     &    'umat'//trim(text)//'; see cleave_slots.f90', status)
        return
      end if
      place = cleave_slots_table(k)%plastic_strain
      call adapter_find_law(cleave_slots_table(k)%law, law, status)
      if (status .ne. CLEAVE_OK) return
      call adapter_properties(law, law%property_count, cm, values,
     &  status)
      if (status .ne. CLEAVE_OK) return
      nh = int(law%history_count)
      layout%f_leading = nlq
      layout%history_leading = nlq
      layout%stress_leading = adapter_chunk
      if (etype .ne. 'solid') then
        call adapter_fail(CLEAVE_UNSUPPORTED, 'solid elements only, '//
     &    'not '//etype, status)
      end if
      end subroutine

      recursive subroutine check_moduli
      real(adapter_real) lambda, mu, bulk, shear
      real(adapter_real), parameter :: nearly = 0.999_adapter_real
      character*12 np
      call adapter_moduli(law, values, lambda, mu, status)
      if (status .ne. CLEAVE_OK) return
      bulk = cm(law%property_count + 1)
      shear = cm(law%property_count + 2)
      if (bulk .ge. nearly * (lambda + 2 * mu / 3) .and.
     &  shear .ge. nearly * mu) return
      write (np, '(i0)') law%property_count
      write (message, '(6a,2(es12.5,a))') 'law ', trim(law%name),
     &  ' has ', trim(np), ' properties; behind them stand the bulk ',
     &  'and the shear modulus, not below those of the law,',
     &  lambda + 2 * mu / 3, ' and', mu, '; the card has others there'
      call adapter_fail(CLEAVE_BAD_ARGUMENT, message, status)
      end subroutine

C Points in one call: alive, and of one size of the step.
      recursive integer function end_of_piece()
      end_of_piece = first
      if (hsv(first,nh+1) .ne. 0) return
      do while (end_of_piece .lt. min(llt, first + adapter_chunk - 1))
        if (dt1siz(end_of_piece+1) .ne. dt1siz(first) .or.
     &    hsv(end_of_piece+1,nh+1) .ne. 0) return
        end_of_piece = end_of_piece + 1
      end do
      end function

C n points from the one numbered first on.
      recursive subroutine piece(n, history, f)
      integer, intent(in) :: n
      real, intent(inout) :: history(nlq,*)
      real, intent(in) :: f(nlq,*)
      real stress(adapter_chunk,6)
      real(adapter_real) lengths(adapter_chunk), energy(adapter_chunk),
     &  plastic(adapter_chunk), viscous(adapter_chunk)
      integer(adapter_int) failed(adapter_chunk)
      integer i, k
      lengths(1:n) = elsizv(first:last)
      call adapter_update(law, values, layout, 1_adapter_count,
     &  int(n, adapter_count), real(dt1siz(first), adapter_real),
     &  lengths, f, history, stress, energy, plastic, viscous, failed,
     &  status)
      if (status .ne. CLEAVE_OK) return
      do i = 1, n
        k = first + i - 1
        sig1(k) = stress(i,1)
        sig2(k) = stress(i,2)
        sig3(k) = stress(i,3)
        sig4(k) = stress(i,4)
        sig5(k) = stress(i,5)
        sig6(k) = stress(i,6)
        if (place .gt. 0) epsps(k) = history(i,place)
        if (failed(i) .ne. 0) then
          if (no_column(f(i,1), f(i,2), f(i,3)) .or.
     &      no_column(f(i,4), f(i,5), f(i,6)) .or.
     &      no_column(f(i,7), f(i,8), f(i,9))) then
            call no_deformation
            return
          end if
          history(i,nh+1) = 1
          failels(k) = .true.
        else if (law%damage_place .gt. 0) then
          if (history(i,law%damage_place) .ge. 1) then
            history(i,nh+1) = 1
            failels(k) = .true.
          end if
        end if
      end do
      end subroutine

C A point that is dead already.
      recursive subroutine bury(k)
      integer, intent(in) :: k
      sig1(k) = 0
      sig2(k) = 0
      sig3(k) = 0
      sig4(k) = 0
      sig5(k) = 0
      sig6(k) = 0
      failels(k) = .true.
      end subroutine

      recursive logical function no_column(x, y, z)
      real, intent(in) :: x, y, z
      no_column = x .eq. 0 .and. y .eq. 0 .and. z .eq. 0
      end function

      recursive subroutine no_deformation
      character*12 text
      write (text, '(i0)') nh + 1
      call adapter_fail(CLEAVE_BAD_ARGUMENT, 'no deformation '//
     &  'gradient in the history; give IHYPER = 1 and NHV = '//
     &  trim(text)//' on the card of the material', status)
      end subroutine
      end subroutine cleave_umatv

C One point, for the scalar forms.
      recursive subroutine cleave_umats(slot, cm, sig, epsp, hsv, dt1,
     &  etype, tt, failel, elsiz)
      implicit none
      integer slot
      real cm(*), sig(*), epsp, hsv(*), dt1, tt, elsiz
      character*5 etype
      logical failel
      real plastic(1), step(1), size(1)
      logical fails(1)
      external cleave_umatv
      plastic = epsp
      step = dt1
      size = elsiz
      fails = failel
      call cleave_umatv(slot, cm, sig(1), sig(2), sig(3), sig(4),
     &  sig(5), sig(6), plastic, hsv, 1, 1, 1, step, etype, tt, fails,
     &  size)
      epsp = plastic(1)
      failel = fails(1)
      end subroutine cleave_umats
