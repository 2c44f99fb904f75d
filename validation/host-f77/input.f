C     Reads the deck: four namelist groups from unit LIN.
      SUBROUTINE INPUT
      INCLUDE 'impact.inc'
      NAMELIST /RUN/  NAME, NSTEP, DT, NHIS, NSAVE, NREST, NBAD
      NAMELIST /BAR/  NDIM, NX, NL, WIDTH, HEIGHT, VEL
      NAMELIST /MAT1/ LAW, NPROP, PROP, BETA, ALC
      NAMELIST /WALL1/ PNT, DIR, STIFF
      NREST = 0
      NBAD = 0
      NHIS = 10
      NSAVE = 1000000
      NPROP = 0
      BETA = 0D0
      STIFF = 1D0
      DO 10 K = 1, 3
        VEL(K) = 0D0
        PNT(K) = 0D0
        DIR(K) = 0D0
   10 CONTINUE
      READ (LIN, RUN, ERR=80, END=80)
      READ (LIN, BAR, ERR=80, END=80)
      READ (LIN, MAT1, ERR=80, END=80)
      READ (LIN, WALL1, ERR=80, END=80)
      IF (NDIM .NE. 2 .AND. NDIM .NE. 3) CALL HALT ('NDIM is not 2, 3')
      IF (NPROP .GT. MXPROP) CALL HALT ('NPROP is above MXPROP')
      IF (MIN(NHIS, NSAVE) .LT. 1) CALL HALT ('NHIS or NSAVE is < 1')

C     The law by its name, its variables at a point, and how our arrays
C     stand: H and P are A(9,N), the history is HV(MXV,N).
      KIN = 4 - NDIM
      CALL CLLAW (LAW, MAT, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLLAW')
      CALL CLHCNT (MAT, NV, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLHCNT')
      IF (NV .GT. MXV) CALL HALT ('the law has more variables than MXV')
      CALL CLLAY (0, 9, LAY9, IERR)
      IF (IERR .NE. 0) CALL KFAIL ('CLLAY')
      LAYV(1) = MXV
      LAYV(2) = 1
      RETURN
   80 CALL HALT ('the deck cannot be read: groups RUN BAR MAT1 WALL1')
      END
