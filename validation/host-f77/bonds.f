C     Cleave turns the simplices into bonds.  First it counts them, so
C     that we can see whether the arrays are long enough; then it fills
C     NBR, NREV, ZETA and VOL.
      SUBROUTINE BONDS
      INCLUDE 'impact.inc'
      CALL CLBCNT (NDIM, NP, NS, NODES, NROW, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLBCNT')
      IF (NROW(NP+1) - 1 .GT. MXB)
     &  CALL HALT ('there are more half-bonds than MXB in impact.inc')
      CALL CLBOND (NDIM, NP, 0, X0, NS, NODES, LIVE,
     &             NROW, NBR, NREV, ZETA, VOL, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLBOND')

C     Masses; the density is the first property of every law.  Weights
C     of the bonds for the viscosity.
      DO 10 I = 1, NP
        AMASS(I) = PROP(1)*VOL(I)
        DO 10 IB = NROW(I), NROW(I+1) - 1
          IP = NBR(IB)
          WGT(IB) = ZETA(1,IB)*(X0(1,IP) - X0(1,I))
     &            + ZETA(2,IB)*(X0(2,IP) - X0(2,I))
          IF (NDIM .EQ. 3)
     &      WGT(IB) = WGT(IB) + ZETA(3,IB)*(X0(3,IP) - X0(3,I))
   10 CONTINUE
      CALL CLWAVE (MAT, KIN, NPROP, PROP, C0, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLWAVE')
      COEFF = BETA*PROP(1)*C0
      END
