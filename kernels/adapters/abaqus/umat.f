C Cleave's laws in Abaqus/Standard: user subroutine UMAT. Three-
C dimensional solids (NDI = 3, NSHR = 3), plane strain and
C axisymmetric solids (NDI = 3, NSHR = 1), with NLGEOM=YES. Not for
C plane stress, shells, trusses, and not with *ORIENTATION, where the
C deformation gradient that Standard hands over is neither the global
C nor the local one.
C
C law         by the material's name, CLEAVE-LAW or CLEAVE-LAW-ANYTHING
C PROPS       all of the law, in the order of `cleave keys material`
C components  11 22 33 12 13 23 (12 only with NSHR = 1); shear strain
C             doubled in DDSDDE
C frame       global: DFGRD1 goes in. STRESS and STATEV are functions of
C             it and of the history, which stands in the reference
C             configuration: neither is turned by DROT.
C STRESS      Cauchy, tension positive
C DDSDDE      of the Jaumann rate of the Kirchhoff stress to the
C             stretching, over J; consistent with the step. Not
C             symmetric where the yield stress depends on the volume or
C             the pressure: *USER MATERIAL, UNSYMM
C precision   REAL*8
C state       1 to nh the history of the law, in the order of its lines
C             in the fields table; nh+1, if there is one, is 1, and 0
C             from the step where the damage of the law reaches 1; as in
C             the VUMAT, so that results can be imported
C energies    per current volume, as in the output SENER and PENER:
C             SSE = stored/J, SPD = (J_0 SPD + plastic + viscous)/J
C no answer   PNEWDT = 0.25, nothing changed, DDSDDE of Hooke's law
C errors      unknown law, wrong counts, elements of the wrong kind,
C             properties out of range, NLGEOM=NO: STDB_ABQERR, then XIT
      recursive subroutine umat(stress, statev, ddsdde, sse, spd, scd,
     &  rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp,
     &  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props,
     &  nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt,
     &  layer, kspt, kstep, kinc)
      use cleave_adapter
      use cleave_c, only: CLEAVE_OK, CLEAVE_BAD_ARGUMENT,
     &  CLEAVE_UNSUPPORTED, CLEAVE_TANGENT_JAUMANN
      include 'aba_param.inc'
C A point is a block with leading dimension 1.
      dimension stress(1,ntens), statev(1,nstatv), ddsdde(ntens,ntens),
     &  ddsddt(ntens), drplde(ntens), stran(ntens), dstran(ntens),
     &  time(2), predef(1), dpred(1), props(nprops), coords(3),
     &  drot(3,3), dfgrd0(3,3), dfgrd1(3,3)
      character*80 cmname
      type(adapter_law) law
      type(adapter_layout) layout
      real(adapter_real) values(adapter_max_properties)
      integer(adapter_int) status
      integer nh

      ddsdde = 0
      call check
      if (status .eq. CLEAVE_OK) call answer
      if (status .ne. CLEAVE_OK) call stop_host

      contains

      recursive subroutine check
      implicit none
      character*20 text
      call adapter_find_material(cmname, law, status)
      if (status .ne. CLEAVE_OK) return
      call adapter_properties(law, int(nprops, adapter_count), props,
     &  values, status)
      if (status .ne. CLEAVE_OK) return
      nh = int(law%history_count)
      if (ndi .eq. 3 .and. nshr .eq. 3) then
        layout%stress_order = adapter_12_13_23
      else if (ndi .eq. 3 .and. nshr .eq. 1) then
        layout%stress_order = adapter_12
      else
        call adapter_fail(CLEAVE_UNSUPPORTED, 'solid elements '//
     &    'only: NDI = 3 and NSHR = 3 or 1', status)
        return
      end if
      if (nstatv .lt. nh) then
        write (text, '(i0)') nh + 1
        call adapter_fail(CLEAVE_BAD_ARGUMENT, 'too few state '//
     &    'variables; give *DEPVAR '//trim(text), status)
        return
      end if
      if (unmoved(dfgrd0) .and. unmoved(dfgrd1) .and.
     &    any(dstran .ne. 0)) then
        call adapter_fail(CLEAVE_UNSUPPORTED, 'there is strain, but '//
     &    'no deformation gradient; give *STEP, NLGEOM=YES', status)
      end if
      end subroutine

      recursive subroutine answer
      implicit none
      real(adapter_real) length(1), energy(1), plastic(1), viscous(1)
      integer(adapter_int) failed(1)
      length = celent
      call adapter_tangent(law, values, layout, CLEAVE_TANGENT_JAUMANN,
     &  dtime, length(1), dfgrd1, statev, ddsdde, failed(1), status)
      if (status .eq. CLEAVE_OK .and. failed(1) .eq. 0) then
        call adapter_update(law, values, layout, 1_adapter_count,
     &    1_adapter_count, dtime, length, dfgrd1, statev, stress,
     &    energy, plastic, viscous, failed, status)
      end if
      if (status .ne. CLEAVE_OK) return
      if (failed(1) .ne. 0) then
        call refuse
        return
      end if
      sse = energy(1) / ratio(dfgrd1)
      spd = (spd * ratio(dfgrd0) + plastic(1) + viscous(1)) /
     &  ratio(dfgrd1)
      if (nstatv .eq. nh) return
      statev(1,nh+1) = 1
      if (law%damage_place .gt. 0) then
        if (statev(1,law%damage_place) .ge. 1) statev(1,nh+1) = 0
      end if
      end subroutine

C Asks for a smaller increment.
      recursive subroutine refuse
      implicit none
      real(adapter_real) lambda, mu
      integer i
      pnewdt = 0.25_adapter_real
      call adapter_moduli(law, values, lambda, mu, status)
      ddsdde = 0
      ddsdde(1:3,1:3) = lambda
      do i = 1, 3
        ddsdde(i,i) = lambda + 2 * mu
      end do
      do i = 4, ntens
        ddsdde(i,i) = mu
      end do
      end subroutine

      recursive logical function unmoved(f)
      implicit none
      real(adapter_real), intent(in) :: f(9)
      real(adapter_real), parameter :: unit(9) =
     &  (/ 1, 0, 0, 0, 1, 0, 0, 0, 1 /)
      unmoved = all(f .eq. unit)
      end function

C det F
      recursive real(adapter_real) function ratio(f)
      implicit none
      real(adapter_real), intent(in) :: f(3,3)
      ratio = f(1,1) * (f(2,2) * f(3,3) - f(2,3) * f(3,2)) -
     &  f(1,2) * (f(2,1) * f(3,3) - f(2,3) * f(3,1)) +
     &  f(1,3) * (f(2,1) * f(3,2) - f(2,2) * f(3,1))
      end function

      recursive subroutine stop_host
      character(len=adapter_message_length) message
      character*500 text
      character*8 charv(1)
      dimension intv(2), realv(1)
      call adapter_message(message)
      text = trim(cmname)//', element %I, point %I: '//message
      intv(1) = noel
      intv(2) = npt
      realv = 0
      charv = ' '
      call stdb_abqerr(-2, text, intv, realv, charv)
      call xit
      end subroutine
      end subroutine umat
