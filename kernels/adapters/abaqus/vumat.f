C Cleave's laws in Abaqus/Explicit: user subroutine VUMAT. Three-
C dimensional solids (ndir = 3, nshr = 3), plane strain and
C axisymmetric solids (ndir = 3, nshr = 1).
C   Not for shells, membranes and plane stress: there Abaqus knows
C   neither the stretch across nor the transverse shear, and expects
C   the strain increment 33 back, which an answer to a given stretch
C   does not have. Their call looks like plane strain: the deck must
C   see to it.
C
C law         by the material's name, CLEAVE-LAW or CLEAVE-LAW-ANYTHING
C props       all of the law, in the order of `cleave keys material`
C components  11 22 33 12 23 31 (12 only with nshr = 1), tensor shear
C frame       turns with R: stretchNew (U, not F) goes in, the law
C             answers R^T sigma R, and no rotation is ever formed
C stress      Cauchy, tension positive
C precision   REAL*8 and REAL*4 by vaba_param.inc
C blocks      a(nblock,component), any nblock, nothing kept between
C             calls
C state       1 to nh the history of the law, in the order of its lines
C             in the fields table; nh+1 the alive flag; more are left
C             alone. nh alone is allowed, 0 for laws without history:
C             then there is no flag.
C deletion    *DEPVAR, DELETE=nh+1. The flag is 1; 0 in the step where
C             the damage of the law reaches 1, or where the law has no
C             answer. Such a point stays as it was, with zero stress.
C             Before the first step the flag is 0 as well: a point is
C             dead if its flag is 0 and its history or energy is not.
C energies    per mass, cumulative:
C               inelastic = old + (plastic + viscous)/rho0
C               internal  = stored/rho0 + inelastic
C             rho0 = density (J_old + J_new)/2, as Abaqus gives the
C             density of the middle of the step
C data check  stepTime = totalTime = 0: an elastic answer to strainInc
C             by the moduli of the law at rest; the history stays
C annealing   stress and history zero, the flag stays
C errors      unknown law, wrong counts, elements of the wrong kind,
C             properties out of range, and a point without an answer
C             and without a flag: XPLB_ABQERR, then XPLB_EXIT
      recursive subroutine vumat(
     &  nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal,
     &  stepTime, totalTime, dt, cmname, coordMp, charLength,
     &  props, density, strainInc, relSpinInc,
     &  tempOld, stretchOld, defgradOld, fieldOld,
     &  stressOld, stateOld, enerInternOld, enerInelasOld,
     &  tempNew, stretchNew, defgradNew, fieldNew,
     &  stressNew, stateNew, enerInternNew, enerInelasNew)
      use cleave_adapter
      use cleave_c, only: CLEAVE_OK, CLEAVE_BAD_ARGUMENT,
     &  CLEAVE_BAD_JACOBIAN, CLEAVE_UNSUPPORTED
      include 'vaba_param.inc'
      dimension coordMp(nblock,*), charLength(nblock), props(nprops),
     &  density(nblock), strainInc(nblock,ndir+nshr),
     &  relSpinInc(nblock,nshr), tempOld(nblock),
     &  stretchOld(nblock,ndir+nshr),
     &  defgradOld(nblock,ndir+nshr+nshr), fieldOld(nblock,nfieldv),
     &  stressOld(nblock,ndir+nshr), stateOld(nblock,nstatev),
     &  enerInternOld(nblock), enerInelasOld(nblock), tempNew(nblock),
     &  stretchNew(nblock,ndir+nshr),
     &  defgradNew(nblock,ndir+nshr+nshr), fieldNew(nblock,nfieldv),
     &  stressNew(nblock,ndir+nshr), stateNew(nblock,nstatev),
     &  enerInternNew(nblock), enerInelasNew(nblock)
      character*80 cmname
      type(adapter_law) law
      type(adapter_layout) layout
      real(adapter_real) values(adapter_max_properties)
      integer(adapter_int) status
      integer nh, first

      stateNew(:,1:nstatev) = stateOld(:,1:nstatev)
      enerInternNew = enerInternOld
      enerInelasNew = enerInelasOld
      stressNew = 0
      call check
      if (status .eq. CLEAVE_OK) then
        if (lanneal .eq. 1) then
          stateNew(:,1:nh) = 0
        else if (stepTime .eq. 0 .and. totalTime .eq. 0) then
          call elastic
        else
          do first = 1, nblock, adapter_chunk
            call step(first, min(first + adapter_chunk - 1, nblock))
            if (status .ne. CLEAVE_OK) exit
          end do
        end if
      end if
      if (status .ne. CLEAVE_OK) call stop_host

      contains

C The law, its counts, and where things stand in the blocks.
      recursive subroutine check
      implicit none
      character*20 text
      nh = 0
      call adapter_find_material(cmname, law, status)
      if (status .ne. CLEAVE_OK) return
      call adapter_properties(law, int(nprops, adapter_count), props,
     &  values, status)
      if (status .ne. CLEAVE_OK) return
      nh = int(law%history_count)
      layout%f_leading = nblock
      layout%stress_leading = nblock
      layout%history_leading = nblock
      if (ndir .eq. 3 .and. nshr .eq. 3) then
        layout%f_order = adapter_12_23_31
      else if (ndir .eq. 3 .and. nshr .eq. 1) then
        layout%f_order = adapter_12
      else
        call adapter_fail(CLEAVE_UNSUPPORTED, 'solid elements '//
     &    'only: ndir = 3 and nshr = 3 or 1', status)
        return
      end if
      layout%stress_order = layout%f_order
      if (nstatev .lt. nh) then
        write (text, '(i0)') nh + 1
        call adapter_fail(CLEAVE_BAD_ARGUMENT, 'too few state '//
     &    'variables; give *DEPVAR, DELETE='//trim(text)//' and '//
     &    trim(text)//' variables', status)
      end if
      end subroutine

C Data check: Hooke's law on the strain increment.
      recursive subroutine elastic
      implicit none
      real(adapter_real) lambda, mu, volume, strain(3)
      integer i
      call adapter_moduli(law, values, lambda, mu, status)
      if (status .ne. CLEAVE_OK) return
      do i = 1, nblock
        strain = strainInc(i,1:3)
        volume = lambda * sum(strain)
        stressNew(i,1:3) = stressOld(i,1:3) + volume + 2 * mu * strain
        stressNew(i,4:3+nshr) = stressOld(i,4:3+nshr) +
     &    2 * mu * strainInc(i,4:3+nshr)
        if (nstatev .gt. nh) stateNew(i,nh+1) = 1
      end do
      end subroutine

C Points from to to of the block, adapter_chunk at most.
      recursive subroutine step(from, to)
      implicit none
      integer, intent(in) :: from, to
      real(adapter_real) lengths(adapter_chunk), energy(adapter_chunk),
     &  plastic(adapter_chunk), viscous(adapter_chunk), rho0, lost
      integer(adapter_int) failed(adapter_chunk)
      integer i, k
      lengths(1:to-from+1) = charLength(from:to)
      call adapter_update(law, values, layout,
     &  int(from, adapter_count), int(to, adapter_count),
     &  real(dt, adapter_real), lengths, stretchNew, stateNew,
     &  stressNew, energy, plastic, viscous, failed, status)
      if (status .ne. CLEAVE_OK) return
      do k = from, to
        i = k - from + 1
        if (dead(k)) then
          stressNew(k,:) = 0
          stateNew(k,1:nh) = stateOld(k,1:nh)
        else if (failed(i) .ne. 0) then
          if (nstatev .eq. nh) then
            call adapter_fail(CLEAVE_BAD_JACOBIAN, 'the law has no '//
     &        'answer to the deformation of a point; give *DEPVAR '//
     &        'one more variable, the DELETE flag, to have such '//
     &        'points deleted', status)
            return
          end if
          stateNew(k,nh+1) = 0
        else
          rho0 = density(k) * (ratio(stretchOld, k) +
     &      ratio(stretchNew, k)) / 2
          lost = enerInelasOld(k) + (plastic(i) + viscous(i)) / rho0
          enerInelasNew(k) = lost
          enerInternNew(k) = energy(i) / rho0 + lost
          if (nstatev .gt. nh) stateNew(k,nh+1) = alive(k)
        end if
      end do
      end subroutine

      recursive logical function dead(k)
      implicit none
      integer, intent(in) :: k
      dead = .false.
      if (nstatev .eq. nh) return
      if (stateOld(k,nh+1) .ne. 0) return
      dead = enerInternOld(k) .ne. 0 .or. any(stateOld(k,1:nh) .ne. 0)
      end function

      recursive integer function alive(k)
      implicit none
      integer, intent(in) :: k
      alive = 1
      if (law%damage_place .eq. 0) return
      if (stateNew(k,law%damage_place) .ge. 1) alive = 0
      end function

C det U
      recursive real(adapter_real) function ratio(stretch, k)
      dimension stretch(nblock,ndir+nshr)
      integer k
      real(adapter_real) u(6)
      u = 0
      u(1:3+nshr) = stretch(k,1:3+nshr)
      ratio = u(1) * (u(2) * u(3) - u(5)**2) -
     &  u(4) * (u(4) * u(3) - u(5) * u(6)) +
     &  u(6) * (u(4) * u(5) - u(2) * u(6))
      end function

      recursive subroutine stop_host
      character(len=adapter_message_length) message
      character*500 text
      character*8 charv(1)
      dimension intv(1), realv(1)
      call adapter_message(message)
      text = trim(cmname)//': '//message
      intv = 0
      realv = 0
      charv = ' '
      call xplb_abqerr(-2, text, intv, realv, charv)
      call xplb_exit
      end subroutine
      end subroutine vumat
