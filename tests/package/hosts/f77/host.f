C     A host in fixed-form Fortran 77 that knows Cleave only as an
C     installed package: a unit cube of six tetrahedra in common blocks,
C     stretched in x. Says nothing if the force on a face is the one of
C     the closed form, and stops with a status otherwise.
      PROGRAM HOST
      IMPLICIT REAL*8 (A-H, O-Z)
      PARAMETER (NP = 8, NS = 6, MAXH = 38)
      COMMON /PARTS/ X(3,NP), U(3,NP), F(3,NP), H(9,NP), P(9,NP), EN(NP)
      COMMON /BONDS/ ZETA(3,MAXH), VOL(NP)
      INTEGER*8 NROW(NP+1), NEIGH(MAXH), NREV(MAXH)
      COMMON /TOPOL/ NROW, NEIGH, NREV
      DIMENSION NODE(4,NS), IALIVE(NS), IFAIL(NP), PROP(3), HIST(1)
C     Particle 1 + i + 2 j + 4 k is at (i, j, k); every tetrahedron has
C     the diagonal from 1 to 8. Properties: rho, E, nu.
      DATA NODE /1,2,4,8, 1,2,6,8, 1,3,4,8, 1,3,7,8, 1,5,6,8, 1,5,7,8/
      DATA IALIVE /NS*1/, PROP /1000.D0, 2.D9, 0.25D0/, G /0.1D0/
      DO 10 I = 1, NP
        X(1,I) = MOD(I-1, 2)
        X(2,I) = MOD((I-1)/2, 2)
        X(3,I) = (I-1)/4
        U(1,I) = G*X(1,I)
        U(2,I) = 0.D0
        U(3,I) = 0.D0
        F(1,I) = 0.D0
        F(2,I) = 0.D0
        F(3,I) = 0.D0
   10 CONTINUE
      CALL CLABI(IERR)
      IF (IERR .NE. 0) CALL FAILED
      CALL CLBCNT(3, NP, NS, NODE, NROW, IERR)
      IF (IERR .NE. 0) CALL FAILED
C     Edges and diagonals, seen from both ends.
      IF (NROW(NP+1) - NROW(1) .NE. MAXH) STOP 2
      CALL CLBOND(3, NP, 0, X, NS, NODE, IALIVE, NROW, NEIGH, NREV,
     +            ZETA, VOL, IERR)
      IF (IERR .NE. 0) CALL FAILED
      CALL CLGRAD(3, NP, 0, 1, NP, NROW, NEIGH, NREV, ZETA, VOL,
     +            U, H, IERR)
      IF (IERR .NE. 0) CALL FAILED
      CALL CLLAW('svk', MAT, IERR)
      IF (IERR .NE. 0) CALL FAILED
      CALL CLSTRS(MAT, 1, 3, PROP, 1, NP, H, HIST, P, EN, IFAIL, IERR)
      IF (IERR .NE. 0) CALL FAILED
      CALL CLFORC(3, NP, 0, 1, NP, NROW, NEIGH, NREV, ZETA, VOL,
     +            P, F, IERR)
      IF (IERR .NE. 0) CALL FAILED
C     F11 = 1 + g: E11 = g + g**2/2, S11 = (lambda + 2 mu) E11,
C     P11 = F11 S11; lambda = mu = 0.8E9.
      P11 = (1.D0 + G)*2.4D9*(G + 0.5D0*G**2)
      PULL = 0.D0
      DO 20 I = 1, NP
        PULL = PULL + X(1,I)*F(1,I)
   20 CONTINUE
      IF (ABS(PULL + P11) .GT. 1.D-13*P11) STOP 3
      END

      SUBROUTINE FAILED
      CHARACTER*300 TEXT
      CALL CLMSG(TEXT, LENGTH)
      WRITE (*, '(A)') TEXT
      STOP 1
      END
