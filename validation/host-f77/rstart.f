C     The restart file: the state after step ISTEP, nothing that the
C     deck gives again.  RREAD reads it in the same order.
      SUBROUTINE RSAVE
      INCLUDE 'impact.inc'
      OPEN (LRES, FILE=NAME(1:LENTXT(NAME))//'.rst',
     &      FORM='UNFORMATTED', STATUS='UNKNOWN', ERR=80)
      WRITE (LRES, ERR=80) NDIM, NP, NS, MAT, NV, ISTEP
      WRITE (LRES, ERR=80) DT, WORK
      WRITE (LRES, ERR=80) ((U(K,I), K = 1, 3), I = 1, NP)
      WRITE (LRES, ERR=80) ((V(K,I), K = 1, 3), I = 1, NP)
      WRITE (LRES, ERR=80) ((A(K,I), K = 1, 3), I = 1, NP)
      WRITE (LRES, ERR=80) ((FI(K,I), K = 1, 3), I = 1, NP)
      WRITE (LRES, ERR=80) ((FV(K,I), K = 1, 3), I = 1, NP)
      WRITE (LRES, ERR=80) ((FE(K,I), K = 1, 3), I = 1, NP)
      WRITE (LRES, ERR=80) ((P(K,I), K = 1, 9), I = 1, NP)
      WRITE (LRES, ERR=80) ((HV(K,I), K = 1, NV), I = 1, NP)
      WRITE (LRES, ERR=80) (E(I), I = 1, NP)
      CLOSE (LRES)
      RETURN
   80 WRITE (LOUT,'(A)') ' IMPACT: the restart file cannot be written'
      STOP 3
      END

      SUBROUTINE RREAD
      INCLUDE 'impact.inc'
      OPEN (LRES, FILE=NAME(1:LENTXT(NAME))//'.rst',
     &      FORM='UNFORMATTED', STATUS='OLD', ERR=80)
      READ (LRES, ERR=80, END=80) ND1, NP1, NS1, MAT1, NV1, ISTEP
      IF (ND1 .NE. NDIM .OR. NP1 .NE. NP .OR. NS1 .NE. NS .OR.
     &    MAT1 .NE. MAT .OR. NV1 .NE. NV)
     &  CALL HALT ('the restart file belongs to another deck')
      READ (LRES, ERR=80, END=80) DT1, WORK
      IF (DT1 .NE. DT) CALL HALT ('the restart file has another DT')
      READ (LRES, ERR=80, END=80) ((U(K,I), K = 1, 3), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((V(K,I), K = 1, 3), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((A(K,I), K = 1, 3), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((FI(K,I), K = 1, 3), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((FV(K,I), K = 1, 3), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((FE(K,I), K = 1, 3), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((P(K,I), K = 1, 9), I = 1, NP)
      READ (LRES, ERR=80, END=80) ((HV(K,I), K = 1, NV), I = 1, NP)
      READ (LRES, ERR=80, END=80) (E(I), I = 1, NP)
      CLOSE (LRES)
      RETURN
   80 CALL HALT ('the restart file cannot be read')
      END

C     A copy of the state before a step: if the step fails, BACK puts it
C     back and the restart file is that of the step before.
      SUBROUTINE KEEP
      INCLUDE 'impact.inc'
      CALL COPY (3*NP, U, UK)
      CALL COPY (3*NP, V, VK)
      CALL COPY (3*NP, A, AK)
      CALL COPY (3*NP, FI, FIK)
      CALL COPY (3*NP, FV, FVK)
      CALL COPY (3*NP, FE, FEK)
      CALL COPY (9*NP, P, PK)
      CALL COPY (MXV*NP, HV, HVK)
      CALL COPY (NP, E, EK)
      CALL COPY (6, WORK, WORKK)
      END

      SUBROUTINE BACK
      INCLUDE 'impact.inc'
      CALL COPY (3*NP, UK, U)
      CALL COPY (3*NP, VK, V)
      CALL COPY (3*NP, AK, A)
      CALL COPY (3*NP, FIK, FI)
      CALL COPY (3*NP, FVK, FV)
      CALL COPY (3*NP, FEK, FE)
      CALL COPY (9*NP, PK, P)
      CALL COPY (MXV*NP, HVK, HV)
      CALL COPY (NP, EK, E)
      CALL COPY (6, WORKK, WORK)
      END

      SUBROUTINE COPY (N, FROM, TO)
      INTEGER N, I
      REAL*8 FROM(N), TO(N)
      DO 10 I = 1, N
        TO(I) = FROM(I)
   10 CONTINUE
      END
