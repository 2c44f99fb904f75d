C     Energies.  WORK: 1 total at the start, 2 work of the wall,
C     3 dissipated by viscosity of bonds, 4 by flow, 5 by the law's own
C     viscosity, 6 internal work.
      REAL*8 FUNCTION EKIN ()
      INCLUDE 'impact.inc'
      EKIN = 0D0
      DO 10 I = 1, NP
        DO 10 K = 1, 3
          EKIN = EKIN + 0.5D0*AMASS(I)*V(K,I)*V(K,I)
   10 CONTINUE
      END

      REAL*8 FUNCTION ESTORE ()
      INCLUDE 'impact.inc'
      ESTORE = 0D0
      DO 10 I = 1, NP
        ESTORE = ESTORE + VOL(I)*E(I)
   10 CONTINUE
      END

C     Half of the trapezoid of the works, with the forces and velocities
C     that now stand in the arrays.
      SUBROUTINE WORKS (HALF)
      INCLUDE 'impact.inc'
      DO 10 I = 1, NP
        DO 10 K = 1, NDIM
          WORK(2) = WORK(2) + HALF*(FE(K,I)*V(K,I))
          WORK(3) = WORK(3) - HALF*(FV(K,I)*V(K,I))
          WORK(6) = WORK(6) - HALF*(FI(K,I)*V(K,I))
   10 CONTINUE
      END

      SUBROUTINE FLOWED
      INCLUDE 'impact.inc'
      DO 10 I = 1, NP
        WORK(4) = WORK(4) + VOL(I)*WPL(I)
        WORK(5) = WORK(5) + VOL(I)*WVI(I)
   10 CONTINUE
      END

C     Opens the history file.  After a restart it is read up to the step
C     of the restart and goes on there.
      SUBROUTINE HOPEN
      INCLUDE 'impact.inc'
      N = LENTXT(NAME)
      IF (NREST .EQ. 0) THEN
        OPEN (LHIS, FILE=NAME(1:N)//'.his', STATUS='UNKNOWN')
        WRITE (LHIS,'(A)') '     step            time         kinetic'//
     &    '         elastic         plastic         viscous'//
     &    '        external         balance           force'
        CALL HWRITE
        RETURN
      END IF
      OPEN (LHIS, FILE=NAME(1:N)//'.his', STATUS='OLD', ERR=80)
      READ (LHIS,'(A)', END=80)
   10 READ (LHIS,'(I9)', END=20) K
      IF (K .LE. ISTEP) GO TO 10
   20 BACKSPACE (LHIS)
      RETURN
   80 CALL HALT ('the history file of the restart is not there')
      END

      SUBROUTINE HWRITE
      INCLUDE 'impact.inc'
      EK1 = EKIN()
      ES1 = ESTORE()
      BAL = EK1 + ES1 + WORK(3) + WORK(4) + WORK(5) - WORK(2) - WORK(1)
      WRITE (LHIS,'(I9,1P,8E16.8)') ISTEP, ISTEP*DT, EK1, ES1, WORK(4),
     &      WORK(3) + WORK(5), WORK(2), BAL, PUSH(NDIM)
      END
