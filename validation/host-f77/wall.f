C     The rigid wall: a plane through PNT with normal DIR, and a penalty
C     k g on particles g deep, k = STIFF (c0/d)**2 m, d mean spacing.
      SUBROUTINE WALLIN
      INCLUDE 'impact.inc'
      ALONG = SQRT(DIR(1)**2 + DIR(2)**2 + DIR(3)**2)
      IF (.NOT. ALONG .GT. 0D0) CALL HALT ('DIR has no length')
      DO 10 K = 1, 3
        DIR(K) = DIR(K)/ALONG
   10 CONTINUE
      TOTAL = 0D0
      DO 20 I = 1, NP
        TOTAL = TOTAL + AMASS(I)
   20 CONTINUE
      D = (TOTAL/PROP(1)/DBLE(NP))**(1D0/DBLE(NDIM))
      CALL CLWAVE (MAT, KIN, NPROP, PROP, C0, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLWAVE')
      OMEGA = C0/D
      DO 30 I = 1, NP
        AKW(I) = STIFF*OMEGA*OMEGA*AMASS(I)
   30 CONTINUE
      END

C     Force of the wall on the particles FE, and their sum PUSH.
      SUBROUTINE WALL
      INCLUDE 'impact.inc'
      DO 10 K = 1, 3
        PUSH(K) = 0D0
   10 CONTINUE
      DO 30 I = 1, NP
        GAP = 0D0
        DO 20 K = 1, 3
          FE(K,I) = 0D0
          GAP = GAP - (X(K,I) - PNT(K))*DIR(K)
   20   CONTINUE
        IF (GAP .GT. 0D0) THEN
          DO 25 K = 1, 3
            F = AKW(I)*GAP*DIR(K)
            FE(K,I) = FE(K,I) + F
            PUSH(K) = PUSH(K) + F
   25     CONTINUE
        END IF
   30 CONTINUE
      END
