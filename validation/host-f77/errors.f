C     Stops in order: what went wrong on the listing, the state after
C     the last complete step in the restart file, files closed.
      SUBROUTINE HALT (TEXT)
      INCLUDE 'impact.inc'
      CHARACTER*(*) TEXT
      WRITE (LOUT,'(2A)') ' IMPACT: ', TEXT(1:LENTXT(TEXT))
      IF (INSTEP .EQ. 1) THEN
        CALL BACK
        CALL RSAVE
        CLOSE (LHIS)
        WRITE (LOUT,'(A,I9)') ' IMPACT: restart file saved after step',
     &                        ISTEP
      END IF
      STOP 2
      END

C     A call of Cleave has failed: the message of this thread.
      SUBROUTINE KFAIL (WHO)
      CHARACTER*(*) WHO
      CHARACTER*400 TEXT
      INTEGER LENG
      CALL CLMSG (TEXT, LENG)
      CALL HALT (WHO//': '//TEXT)
      END

C     Inside of a parallel loop: the thread that saw the error notes it,
C     for the message is that of the thread.  KCHECK, after the loop,
C     stops at the first block that has one.
      SUBROUTINE KNOTE (IB, IERR)
      INCLUDE 'impact.inc'
      IERB(IB) = IERR
      IF (IERR .NE. 0) CALL CLMSG (TERR(IB), LENG)
      END

C     Where a law had no answer IFAIL says so too.
      SUBROUTINE KCHECK (NBLK)
      INCLUDE 'impact.inc'
      DO 20 IB = 1, NBLK
        IF (IERB(IB) .EQ. 0) GO TO 20
        DO 10 I = (IB - 1)*LBLK + 1, MIN(IB*LBLK, NP)
          IF (IFAIL(I) .NE. 0) WRITE (LOUT,'(A,I9,A,1P,3E12.4)')
     &      ' IMPACT: no stress of particle', I, ' at', (X(K,I), K=1,3)
   10   CONTINUE
        CALL HALT (TERR(IB))
   20 CONTINUE
      END

C     Length of a text without its blanks at the end.
      INTEGER FUNCTION LENTXT (TEXT)
      CHARACTER*(*) TEXT
      DO 10 LENTXT = LEN(TEXT), 2, -1
        IF (TEXT(LENTXT:LENTXT) .NE. ' ') RETURN
   10 CONTINUE
      LENTXT = 1
      END
