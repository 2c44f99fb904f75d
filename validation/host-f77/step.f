C     One step of velocity Verlet: half a kick, drift, forces at the new
C     positions, half a kick.  WORKS is the trapezoid of the energies.
      SUBROUTINE STEP
      INCLUDE 'impact.inc'
      CALL KEEP
      INSTEP = 1
      HALF = 0.5D0*DT
      CALL KICK (HALF)
      CALL WORKS (HALF)
      DO 10 I = 1, NP
        DO 10 K = 1, 3
          U(K,I) = U(K,I) + DT*V(K,I)
          X(K,I) = X0(K,I) + U(K,I)
   10 CONTINUE
      CALL WALL
      CALL FORCES (DT)
      CALL ACCEL
      CALL WORKS (HALF)
      CALL FLOWED
      CALL KICK (HALF)
      ISTEP = ISTEP + 1
      INSTEP = 0
      END

      SUBROUTINE KICK (HALF)
      INCLUDE 'impact.inc'
      DO 10 I = 1, NP
        DO 10 K = 1, 3
          V(K,I) = V(K,I) + HALF*A(K,I)
   10 CONTINUE
      END

      SUBROUTINE ACCEL
      INCLUDE 'impact.inc'
      DO 10 I = 1, NP
        REC = 1D0/AMASS(I)
        DO 10 K = 1, NDIM
          A(K,I) = (FI(K,I) + FV(K,I) + FE(K,I))*REC
   10 CONTINUE
      END

C     Stresses of all particles, then forces on all particles: a force
C     needs the stress of its neighbours.  Each block of particles is a
C     call of its own, so threads may share the blocks; whoever does a
C     block, its bits are the same.
      SUBROUTINE FORCES (DTS)
      INCLUDE 'impact.inc'
      NBLK = (NP + LBLK - 1)/LBLK
C$OMP PARALLEL DO
      DO 10 IB = 1, NBLK
        CALL STRESS (IB, DTS)
   10 CONTINUE
      CALL KCHECK (NBLK)
C$OMP PARALLEL DO
      DO 20 IB = 1, NBLK
        CALL PULL (IB)
   20 CONTINUE
      CALL KCHECK (NBLK)
      END

C     Displacement gradient H = F - I, stress P and history of a block.
C     In step NBAD one property is withheld, to see an error arrive.
      SUBROUTINE STRESS (IB, DTS)
      INCLUDE 'impact.inc'
      I1 = (IB - 1)*LBLK + 1
      I2 = MIN(IB*LBLK, NP)
      CALL CLGRAD (NDIM, NP, 0, I1, I2, NROW, NBR, NREV, ZETA, VOL,
     &             U, H, IERR)
      IF (IERR .EQ. 0) THEN
        NGIVE = NPROP
        IF (INSTEP .EQ. 1 .AND. ISTEP + 1 .EQ. NBAD) NGIVE = NPROP - 1
        CALL CLUPD (MAT, KIN, NGIVE, PROP, I1, I2, DTS, ALC,
     &              0, H, LAY9, HV, LAYV, 0, P, LAY9,
     &              E, WPL, WVI, IFAIL, IERR)
      END IF
      DO 10 I = I1, I2
        AJ(I) = VRATIO(H(1,I))
   10 CONTINUE
      CALL KNOTE (IB, IERR)
      END

C     Force of the bonds and their viscosity on a block.  Both calls add
C     to the array.
      SUBROUTINE PULL (IB)
      INCLUDE 'impact.inc'
      I1 = (IB - 1)*LBLK + 1
      I2 = MIN(IB*LBLK, NP)
      DO 10 I = I1, I2
        DO 10 K = 1, 3
          FI(K,I) = 0D0
          FV(K,I) = 0D0
   10 CONTINUE
      CALL CLFORC (NDIM, NP, 0, I1, I2, NROW, NBR, NREV, ZETA, VOL,
     &             P, FI, IERR)
      IF (IERR .EQ. 0 .AND. COEFF .GT. 0D0)
     &  CALL CLVISC (NDIM, NP, 0, I1, I2, NROW, NBR, NREV, ZETA, VOL,
     &               WGT, X, V, AJ, COEFF, ALC, FV, IERR)
      CALL KNOTE (IB, IERR)
      END

C     det(I + H); in the plane that of the in-plane part.
      REAL*8 FUNCTION VRATIO (G)
      INCLUDE 'impact.inc'
      DIMENSION G(3,3)
      F11 = G(1,1) + 1D0
      F22 = G(2,2) + 1D0
      IF (NDIM .EQ. 2) THEN
        VRATIO = F11*F22 - G(1,2)*G(2,1)
      ELSE
        F33 = G(3,3) + 1D0
        VRATIO = F11*(F22*F33 - G(2,3)*G(3,2))
     &         - G(1,2)*(G(2,1)*F33 - G(2,3)*G(3,1))
     &         + G(1,3)*(G(2,1)*G(3,2) - F22*G(3,1))
      END IF
      END
