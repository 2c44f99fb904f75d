C     IMPACT: a bar hits a rigid wall.  An explicit code as they were
C     written before modules: common blocks, fixed form, its own loop,
C     mesh, contact, history and restart file.  Bonds, deformation
C     gradient, return mapping, force and viscosity are Cleave's.
C
C        impact < plate.dat
C
      PROGRAM IMPACT
      INCLUDE 'impact.inc'
      CALL CLABI (IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLABI')
      CALL INPUT
      CALL MESH
      CALL BONDS
      CALL WALLIN
      IF (NREST .EQ. 0) THEN
        CALL START
      ELSE
        CALL RREAD
      END IF
      CALL HOPEN
   10 IF (ISTEP .LT. NSTEP) THEN
        CALL STEP
        IF (MOD(ISTEP, NHIS) .EQ. 0) CALL HWRITE
        IF (MOD(ISTEP, NSAVE) .EQ. 0) CALL RSAVE
        GO TO 10
      END IF
      CALL RSAVE
      CLOSE (LHIS)
      WRITE (LOUT,'(A,I9,A)') ' IMPACT: ended after step', ISTEP,
     &                        ', restart file saved'
      END

C     The state at time zero: the whole bar flies at VEL.
      SUBROUTINE START
      INCLUDE 'impact.inc'
      ISTEP = 0
      DO 20 I = 1, NP
        DO 10 K = 1, 3
          U(K,I) = 0D0
          A(K,I) = 0D0
          X(K,I) = X0(K,I)
          V(K,I) = VEL(K)
   10   CONTINUE
        DO 20 K = 1, MXV
          HV(K,I) = 0D0
   20 CONTINUE
      CALL WALL
      CALL FORCES (0D0)
      CALL ACCEL
      DO 30 K = 1, 6
        WORK(K) = 0D0
   30 CONTINUE
      WORK(1) = EKIN() + ESTORE()
      END
