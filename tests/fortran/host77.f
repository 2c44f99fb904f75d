C     A HOST IN FORTRAN 77: COMMON BLOCKS, NO INTERFACE, NO MODULE. ARRAY CALLS AND A MODEL, COMPARED
C     BIT BY BIT WITH WHAT A C++ CALLER GETS; THEN WRONG INPUT. COMPILED WITH DEFAULT INTEGERS AND
C     WITH -FDEFAULT-INTEGER-8.
      PROGRAM HOST77
      INTEGER NDIM
      CALL CHOPEN(2)
      CALL ARRAYS(2)
      CALL MODEL(2)
      CALL CHOPEN(3)
      CALL ARRAYS(3)
      CALL MODEL(3)
      CALL UPDATE
      CALL WRONG
      CALL CHDONE
      END

C     ARRAYS OF THE HOST, LARGER THAN THIS PROBLEM; A 4-BYTE INTEGER BEFORE THEM, AS IT HAPPENS
      SUBROUTINE ARRAYS(NDIM)
      INTEGER NDIM
      INTEGER MAXN, MAXM, MAXH
      PARAMETER (MAXN = 500, MAXM = 2000, MAXH = 9000)
      INTEGER NCYCLE
      REAL*8 X(3,MAXN), U(3,MAXN), V(3,MAXN), F(3,MAXN)
      REAL*8 H(9,MAXN), P(9,MAXN), HIST(8,MAXN), E(MAXN)
      REAL*8 ZETA(3,MAXH), VOL(MAXN), W(MAXH), AJ(MAXN)
      INTEGER*8 NROW(MAXN+1), NEIGH(MAXH), NREV(MAXH)
      INTEGER NS(4*MAXM), IALIVE(MAXM), IFAIL(MAXN)
      COMMON /HEAD/ NCYCLE
      COMMON /NODES/ X, U, V, F
      COMMON /POINTS/ H, P, HIST, E
      COMMON /BONDS/ ZETA, VOL, W, AJ, NROW, NEIGH, NREV
      COMMON /MESH/ NS, IALIVE, IFAIL
      REAL*8 PROP(20), C(1), XT(MAXN,3), HT(MAXN,9), FT(MAXN,3)
      INTEGER I, J, N, M, MH, NFIRST, NLAST, MAT, KIN, NPROP, NHIST
      INTEGER IERR

      CALL CHGETR('X', X, N)
      N = N/3
      CALL CHGETR('u', U, I)
      CALL CHGETR('v', V, I)
      CALL CHGETI('simplices', NS, M)
      M = M/(NDIM + 1)
      DO 10 I = 1, (NDIM + 1)*M
   10 NS(I) = NS(I) + 1
      CALL CHGETI('alive', IALIVE, I)
      CALL CHRNGE(NFIRST, NLAST)

      CALL CLABI(IERR)
      CALL CHECK(IERR)
      CALL CLBCNT(NDIM, N, M, NS, NROW, IERR)
      CALL CHECK(IERR)
      MH = NROW(N+1) - 1
      IF (MH .GT. MAXH) CALL CHMISS('MORE BONDS THAN THE HOST HAS ROOM')
      CALL CLBOND(NDIM, N, 0, X, M, NS, IALIVE, NROW, NEIGH, NREV,
     1            ZETA, VOL, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('zeta', ZETA, 3*MH)
      CALL CHSAMR('volume', VOL, N)
      CALL CHSAM8('neighbour', NEIGH, MH)
      CALL CHSAM8('reverse', NREV, MH)

      DO 20 J = 1, N
      E(J) = 7
      AJ(J) = 0
      IFAIL(J) = 7
      DO 15 I = 1, 9
      H(I,J) = 7
   15 P(I,J) = 7
      DO 20 I = 1, 3
   20 F(I,J) = 0.5D0
      CALL CLGRAD(NDIM, N, 0, NFIRST, NLAST, NROW, NEIGH, NREV, ZETA,
     1            VOL, U, H, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('H', H, 9*N)

      CALL CLLAW('j2', MAT, IERR)
      CALL CHECK(IERR)
      CALL CLHCNT(MAT, NHIST, IERR)
      CALL CHECK(IERR)
      CALL CLPCNT('j2', NPROP, IERR)
      CALL CHECK(IERR)
      CALL CHGETR('properties', PROP, I)
      IF (I .NE. NPROP) CALL CHMISS('NUMBER OF PROPERTIES')
      DO 30 J = 1, N
      DO 30 I = 1, NHIST
   30 HIST(I,J) = 0
      KIN = 1
      IF (NDIM .EQ. 2) KIN = 2
      CALL CLSTRS(MAT, KIN, NPROP, PROP, NFIRST, NLAST, H, HIST, P, E,
     1            IFAIL, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('P', P, 9*N)
      CALL CHSAMR('energy', E, N)
      CALL CHSAMR('history', HIST, NHIST*N)
      DO 40 I = 1, N
      IF (I .GE. NFIRST .AND. I .LE. NLAST .AND. IFAIL(I) .NE. 0)
     1  CALL CHMISS('NO POINT FAILS')
      IF ((I .LT. NFIRST .OR. I .GT. NLAST) .AND. IFAIL(I) .NE. 7)
     1  CALL CHMISS('FLAGS OUTSIDE OF THE RANGE')
   40 CONTINUE
      CALL CLFORC(NDIM, N, 0, NFIRST, NLAST, NROW, NEIGH, NREV, ZETA,
     1            VOL, P, F, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('f', F, 3*N)
      CALL CHGETR('w', W, I)
      CALL CHGETR('J', AJ, I)
      DO 50 J = 1, N
      DO 50 I = 1, 3
      XT(J,I) = X(I,J)
      X(I,J) = X(I,J) + U(I,J)
   50 F(I,J) = 0.25D0
      CALL CLVISC(NDIM, N, 0, NFIRST, NLAST, NROW, NEIGH, NREV, ZETA,
     1            VOL, W, X, V, AJ, 5.0D0, 0.01D0, F, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('viscous', F, 3*N)
      CALL CLWAVE(MAT, KIN, NPROP, PROP, C, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('speed', C, 1)
      CALL CLRAMP(2, 3.0D0, 2.0D0, 0.7D0, PROP(1), PROP(2), PROP(3),
     1            IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('ramp', PROP, 3)

C     THE SAME WITH ARRAYS A(MAXN,3), A(MAXN,9)
      CALL CLBOND(NDIM, N, MAXN, XT, M, NS, IALIVE, NROW, NEIGH, NREV,
     1            ZETA, VOL, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('zeta', ZETA, 3*MH)
      DO 60 J = 1, N
      DO 55 I = 1, 9
      HT(J,I) = 7
   55 CONTINUE
      DO 60 I = 1, 3
   60 FT(J,I) = U(I,J)
      CALL CLGRAD(NDIM, N, MAXN, NFIRST, NLAST, NROW, NEIGH, NREV,
     1            ZETA, VOL, FT, HT, IERR)
      CALL CHECK(IERR)
      DO 70 J = 1, N
      DO 70 I = 1, 9
   70 H(I,J) = HT(J,I)
      CALL CHSAMR('H', H, 9*N)
      END

C     FULL UPDATE: F IN ABAQUS' ORDER, CAUCHY STRESS 11 22 33 12 23 31; AS A(6,N) AND AS A(13,6)
      SUBROUTINE UPDATE
      INTEGER N
      PARAMETER (N = 13)
      REAL*8 F(9,N), S(6,N), ST(N,6), HIST(8,N), T(81,N), PROP(20)
      REAL*8 E(N), PL(N), VI(N), FT(N,9), HT(N,8)
      INTEGER LAYD(11), LAYS(11), LAYP(11), LAYH(2), LAYT(2), IFAIL(N)
      INTEGER IORDER(9), MAT, NPROP, NHIST, I, J, IERR
      DATA IORDER /1, 7, 6, 4, 2, 8, 9, 5, 3/, LAYT /81, 1/
      CALL CLLAW('j2      ', MAT, IERR)
      CALL CHECK(IERR)
      CALL CLHCNT(MAT, NHIST, IERR)
      CALL CHGETR('properties', PROP, NPROP)
      CALL CHGETR('update_F', F, I)
      DO 10 J = 1, N
      E(J) = 7
      PL(J) = 7
      VI(J) = 7
      IFAIL(J) = 7
      DO 4 I = 1, 8
      HT(J,I) = 0
    4 HIST(I,J) = 0
      DO 5 I = 1, 6
      ST(J,I) = 7
    5 S(I,J) = 7
      DO 6 I = 1, 9
    6 FT(J,I) = F(I,J)
      DO 10 I = 1, 81
   10 T(I,J) = 7
      CALL CLLAY(0, 9, LAYD, IERR)
      CALL CHECK(IERR)
      CALL CLLAY(0, 9, LAYP, IERR)
      CALL CHECK(IERR)
      DO 20 I = 1, 9
   20 LAYD(I+2) = IORDER(I)
      CALL CLLAY(0, 6, LAYS, IERR)
      CALL CHECK(IERR)
      LAYH(1) = NHIST
      LAYH(2) = 1
      CALL CLTAN(MAT, 1, NPROP, PROP, 3, N-1, 1.0D-6, 0.01D0, 1, F,
     1           LAYD, HIST, LAYH, 0, 0, LAYP, T, LAYT, IFAIL, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('update_tangent', T, 81*N)
      CALL CLUPD(MAT, 1, NPROP, PROP, 3, N-1, 1.0D-6, 0.01D0, 1, F,
     1           LAYD, HIST, LAYH, 2, S, LAYS, E, PL, VI, IFAIL, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('update_stress', S, 6*N)
      CALL CHSAMR('update_energy', E, N)
      CALL CHSAMR('update_plastic', PL, N)
      CALL CHSAMR('update_viscous', VI, N)
      CALL CHSAMR('update_history', HIST, NHIST*N)
      IF (IFAIL(2) .NE. 7 .OR. IFAIL(3) .NE. 0 .OR. IFAIL(N) .NE. 7)
     1  CALL CHMISS('FLAGS')
      CALL CLLAY(N, 9, LAYD, IERR)
      CALL CHECK(IERR)
      DO 30 I = 1, 9
   30 LAYD(I+2) = IORDER(I)
      CALL CLLAY(N, 6, LAYS, IERR)
      CALL CHECK(IERR)
      LAYH(1) = 1
      LAYH(2) = N
      CALL CLUPD(MAT, 1, NPROP, PROP, 3, N-1, 1.0D-6, 0.01D0, 1, FT,
     1           LAYD, HT, LAYH, 2, ST, LAYS, E, PL, VI, IFAIL, IERR)
      CALL CHECK(IERR)
      DO 40 J = 1, N
      DO 40 I = 1, 6
   40 S(I,J) = ST(J,I)
      CALL CHSAMR('update_stress', S, 6*N)
      END

C     A MODEL BY ITS HANDLE, AND ANOTHER BESIDE IT
      SUBROUTINE MODEL(NDIM)
      INTEGER NDIM
      INTEGER MAXN, MAXM, MAXH
      PARAMETER (MAXN = 500, MAXM = 2000, MAXH = 9000)
      REAL*8 X(3,MAXN), U(3,MAXN), V(3,MAXN), P(9,MAXN), PT(3,3)
      REAL*8 DT, T, E(13), R(3), D(7), STEP, WAVE, BETA, WGT(4,3)
      REAL*8 SMP(3,3), BYTES
      INTEGER NS(4*MAXM), NEND(2,MAXH), IALIVE(MAXM), NC(7), NSIM(3)
      INTEGER MOD, MOD2, IBODY, IBODY2, N, M, NB, K, I, IERR, IFORM, KIN
      INTEGER NCOMP, ITYPE, ILIFE, NEV, ISTEP, NPAIR(2), MAT
      CALL CHGETR('X', X, N)
      N = N/3
      CALL CHGETR('run_v', V, I)
      CALL CHGETI('simplices', NS, M)
      M = M/(NDIM + 1)
      DO 10 I = 1, (NDIM + 1)*M
   10 NS(I) = NS(I) + 1
      KIN = 1
      IF (NDIM .EQ. 2) KIN = 2
      CALL CLFIND(3, 'cbm', IFORM, IERR)
      CALL CHECK(IERR)
      CALL CLLAW('svk', MAT, IERR)
      CALL CHECK(IERR)
      CALL BUILD(MOD, IBODY, IFORM, KIN, MAT, N, X, M, NS)
      CALL BUILD(MOD2, IBODY2, IFORM, KIN, MAT, N, X, M, NS)
      IF (MOD .EQ. MOD2) CALL CHMISS('TWO MODELS, TWO HANDLES')
      CALL CLFFND(MOD, IBODY, 'bond_ends', NCOMP, NB, ITYPE, ILIFE,
     1            IERR)
      CALL CHECK(IERR)
      IF (NCOMP .NE. 2 .OR. ITYPE .NE. 2) CALL CHMISS('BOND_ENDS')
      CALL CLFGTI(MOD, IBODY, 'bond_ends', 1, NB, 2, NEND, IERR)
      CALL CHECK(IERR)
      CALL CLBCRK(MOD, IBODY, 1, NEND(1,NB), IERR)
      CALL CHECK(IERR)
      CALL CLFPTR(MOD, IBODY, 'velocity', 1, N, 3, V, IERR)
      CALL CHECK(IERR)
      CALL CLMINI(MOD, 0.0D0, IERR)
      CALL CHECK(IERR)
      CALL CLMINI(MOD2, 0.0D0, IERR)
      CALL CHECK(IERR)
      CALL CLMSTP(MOD, STEP, IERR)
      CALL CHECK(IERR)
      CALL CLBWAV(MOD, IBODY, WAVE, IERR)
      CALL CHECK(IERR)
      CALL CLBGET(MOD, IBODY, 'viscosity', 'beta', BETA, IERR)
      CALL CHECK(IERR)
      DT = 0.4D0*STEP
      DO 20 K = 1, 120
      T = K*DT
      U(1,1) = 1D-3*T
      U(2,1) = 0
      CALL CLBDIS(MOD, IBODY, 2, U, IERR)
      CALL CHECK(IERR)
      CALL CLMADV(MOD, DT, T, IERR)
      CALL CHECK(IERR)
      U(1,1) = 0
      U(2,1) = 10
      CALL CLBACC(MOD, IBODY, 2, U, IERR)
      CALL CHECK(IERR)
      CALL CLMUPD(MOD, IERR)
      CALL CHECK(IERR)
      CALL CLMADV(MOD2, 0.5D0*DT, 0.5D0*T, IERR)
      CALL CHECK(IERR)
      CALL CLMUPD(MOD2, IERR)
   20 CALL CHECK(IERR)
      CALL CLMDEL(MOD2, IERR)
      CALL CHECK(IERR)
      CALL CLFGTR(MOD, IBODY, 'displacement', 1, N, 3, U, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('run_displacement', U, 3*N)
      CALL CLFGTR(MOD, IBODY, 'first_piola_kirchhoff_stress', 1, N, 9,
     1            P, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('run_stress', P, 9*N)
      CALL CLENER(MOD, 0, E, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('run_energies', E, 13)
      CALL CLCNTS(MOD, IBODY, NC, IERR)
      CALL CHECK(IERR)
      CALL CHSAMI('run_counts', NC, 7)
      CALL CLEVCT(MOD, IBODY, NEV, IERR)
      CALL CHECK(IERR)
      CALL CLEVGT(MOD, IBODY, NEV, ISTEP, NPAIR, D, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('run_event', D, 7)
      NC(1) = NEV
      NC(2) = ISTEP
      NC(3) = NPAIR(1) - 1
      NC(4) = NPAIR(2) - 1
      CALL CLCLK(MOD, NC(5), T, IERR)
      CALL CHECK(IERR)
      CALL CHSAMI('run_event', NC, 5)
      NPAIR(1) = 1
      NPAIR(2) = 5
      CALL CLREAC(MOD, IBODY, 2, NPAIR, R, IERR)
      CALL CHECK(IERR)
      D(1) = STEP
      D(2) = WAVE
      D(3) = BETA
      D(4) = T
      D(5) = R(1)
      D(6) = R(2)
      D(7) = R(3)
      CALL CHSAMR('run_numbers', D, 7)
      CALL CLFGTI(MOD, IBODY, 'simplex_alive', 1, M, 1, IALIVE, IERR)
      CALL CHECK(IERR)
      CALL CHSAMI('run_alive', IALIVE, M)
      CALL CHGETR('run_points', PT, I)
      CALL CLLOC(MOD, IBODY, 3, PT, NSIM, WGT, IERR)
      CALL CHECK(IERR)
      IF (NSIM(1) .LT. 1 .OR. NSIM(2) .NE. 0) CALL CHMISS('WHERE')
      CALL CHSAMR('run_weight', WGT, 12)
      CALL CLINTP(MOD, IBODY, 'displacement', 3, NSIM, WGT, 3, SMP,
     1            IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('run_sample', SMP, 9)
      CALL CLMMEM(MOD, BYTES, IERR)
      CALL CHECK(IERR)
      IF (BYTES .LT. 1000) CALL CHMISS('BYTES OF A MODEL')
C     Bonds of this body may not break in Newton's method.
      NC(1) = -1
      CALL CLSOLL(MOD, T, 0D0, 0, NC(1), D, D, NC(2), IERR)
      IF (IERR .EQ. 0 .OR. NC(1) .NE. -1) CALL CHMISS('CLSOLL')
      CALL CLBRKS(MOD, 0D0, 0, 2, NC(1), NC(2), NC(3), IERR)
      IF (IERR .EQ. 0 .OR. NC(1) .NE. -1) CALL CHMISS('CLBRKS')
      NC(1) = 0
      NC(3) = 1
      CALL CLRELX(MOD, T, 1D-9, 0, 1, 5, NC(1), NC(2), D, NC(3), IERR)
      CALL CHECK(IERR)
      IF (NC(1) .LT. 5 .OR. NC(3) .NE. 0) CALL CHMISS('A SLICE')
      CALL CLRLXC(MOD, IERR)
      CALL CHECK(IERR)
      CALL CLFGTR(MOD, IBODY, 'displacement', 1, N, 3, U, IERR)
      CALL CHECK(IERR)
      CALL CHSAMR('run_displacement', U, 3*N)
      CALL CLMDEL(MOD, IERR)
      CALL CHECK(IERR)
      END

      SUBROUTINE BUILD(MOD, IBODY, IFORM, KIN, MAT, N, X, M, NS)
      INTEGER MOD, IBODY, IFORM, KIN, MAT, N, M, NS(*)
      REAL*8 X(3,*)
      INTEGER IERR, NPART(3), NDIR(2), NMOT(2)
      CALL CLMNEW(MOD, IERR)
      CALL CHECK(IERR)
      CALL CLBADD(MOD, 'patch', IFORM, KIN, MAT, 0, N, X, M, NS, IBODY,
     1            IERR)
      CALL CHECK(IERR)
      CALL CLBSET(MOD, IBODY, 'material', 'rho', 1190D0, IERR)
      CALL CHECK(IERR)
      CALL CLBSET(MOD, IBODY, 'material', 'E', 3.24D9, IERR)
      CALL CHECK(IERR)
      CALL CLBSET(MOD, IBODY, 'material', 'nu', 0.35D0, IERR)
      CALL CHECK(IERR)
      CALL CLBSET(MOD, IBODY, 'fracture', 'critical_strain', 0.01D0,
     1            IERR)
      CALL CHECK(IERR)
      CALL CLBSET(MOD, IBODY, 'viscosity', 'length', 0.01D0, IERR)
      CALL CHECK(IERR)
      CALL CLBCHO(MOD, IBODY, 'viscosity', 'form', 'central', IERR)
      CALL CHECK(IERR)
      NPART(1) = 1
      NPART(2) = 5
      NDIR(1) = 2
      NDIR(2) = 1
      NMOT(1) = 2
      NMOT(2) = 1
      CALL CLBPRE(MOD, IBODY, 2, NPART, NDIR, NMOT, IERR)
      CALL CHECK(IERR)
      NPART(1) = 2
      NPART(2) = 3
      NPART(3) = 4
      CALL CLBEXE(MOD, IBODY, 3, NPART, IERR)
      CALL CHECK(IERR)
      CALL CLMTHR(MOD, 2, IERR)
      CALL CHECK(IERR)
      CALL CLMSET(MOD, IERR)
      CALL CHECK(IERR)
      END

C     WHAT IS WRONG IS TOLD; THE STATUS IS THAT OF THE TABLE
      SUBROUTINE WRONG
      REAL*8 X(12), H(36), PROP(3), P(36), HIST(1), E(4)
      INTEGER NS(6), IFAIL(4), LAY(11), MOD, MOD2, IBODY, IERR, I, N
      INTEGER*8 NROW(5), NEIGH(10), NREV(10)
      REAL*8 ZETA(30), VOL(4)
      CHARACTER*12 SHORT
      DATA X /0,0,0, 1,0,0, 1,1,0, 0,1,0/, NS /1,2,3, 1,3,4/
      DATA PROP /1190D0, 3.24D9, 0.35D0/
      CALL CLBCNT(4, 4, 2, NS, NROW, IERR)
      CALL CHREFU(IERR, 2, 'CLBCNT: NDIM is 4')
      CALL CLBCNT(2, -1, 2, NS, NROW, IERR)
      CALL CHREFU(IERR, 2, 'CLBCNT: N is -1')
      CALL CLBCNT(2, 4, -2, NS, NROW, IERR)
      CALL CHREFU(IERR, 2, 'CLBCNT: M is -2')
      CALL CLBCNT(2, 4, 2, NS, NROW, IERR)
      CALL CHECK(IERR)
      DO 10 I = 1, 4
   10 IFAIL(I) = 1
      CALL CLBOND(2, 4, 3, X, 2, NS, IFAIL, NROW, NEIGH, NREV, ZETA,
     1            VOL, IERR)
      CALL CHREFU(IERR, 2, 'CLBOND: LD')
      CALL CLBOND(2, 4, 0, X, 2, NS, IFAIL, NROW, NEIGH, NREV, ZETA,
     1            VOL, IERR)
      CALL CHECK(IERR)
      CALL CLGRAD(2, 4, 0, 1, 5, NROW, NEIGH, NREV, ZETA, VOL, X, H,
     1            IERR)
      CALL CHREFU(IERR, 3, 'CLGRAD: range NFIRST = 1 to NLAST = 5')
      CALL CLGRAD(2, 4, -1, 1, 4, NROW, NEIGH, NREV, ZETA, VOL, X, H,
     1            IERR)
      CALL CHREFU(IERR, 2, 'LD')
      CALL CLGRAD(2, 4, 0, 1, 4, NROW, NEIGH, NREV, ZETA, VOL, X, H,
     1            IERR)
      CALL CHECK(IERR)
      CALL CLLAW('steel', N, IERR)
      CALL CHREFU(IERR, 5, '''steel''')
      CALL CLSTRS(1, 1, 2, PROP, 1, 4, H, HIST, P, E, IFAIL, IERR)
      CALL CHREFU(IERR, 2, '3')
      CALL CLSTRS(77, 1, 3, PROP, 1, 4, H, HIST, P, E, IFAIL, IERR)
      CALL CHREFU(IERR, 5, '77')
      CALL CLSTRS(1, 1, 3, PROP, 3, 1, H, HIST, P, E, IFAIL, IERR)
      CALL CHREFU(IERR, 3, 'CLSTRS: range')
      DO 20 I = 1, 36
   20 H(I) = 0
      H(10) = -3
      CALL CLSTRS(8, 1, 3, PROP, 1, 4, H, HIST, P, E, IFAIL, IERR)
      CALL CHREFU(IERR, 10, 'neo_hooke')
      IF (IFAIL(1) .NE. 0 .OR. IFAIL(2) .NE. 1 .OR. IFAIL(3) .NE. 0)
     1  CALL CHMISS('THE POINT WITHOUT AN ANSWER')
      CALL CLLAY(0, 7, LAY, IERR)
      CALL CHREFU(IERR, 2, 'CLLAY: NCOMP is 7')
      MOD = 0
      CALL CLMSET(MOD, IERR)
      CALL CHREFU(IERR, 2, 'CLMSET: model 0')
      CALL CLMNEW(MOD, IERR)
      CALL CHECK(IERR)
      MOD2 = MOD
      CALL CLMDEL(MOD, IERR)
      CALL CHECK(IERR)
      CALL CLMDEL(MOD, IERR)
      CALL CHREFU(IERR, 2, 'CLMNEW gives a model')
      CALL CLMNEW(MOD, IERR)
      CALL CHECK(IERR)
      IF (MOD .EQ. MOD2) CALL CHMISS('THE HANDLE OF A DESTROYED MODEL')
      CALL CLMUPD(MOD2, IERR)
      CALL CHREFU(IERR, 2, 'is destroyed')
      CALL CLMSET(-5, IERR)
      CALL CHREFU(IERR, 2, 'model -5')
      CALL CLBADD(MOD, 'a', 1, 2, 1, 0, -4, X, 2, NS, IBODY, IERR)
      CALL CHREFU(IERR, 2, 'CLBADD: N is -4')
      CALL CLBADD(MOD, 'a', 1, 2, 1, 0, 4, X, -2, NS, IBODY, IERR)
      CALL CHREFU(IERR, 2, 'CLBADD: M is -2')
      CALL CLBADD(MOD, 'a', 99, 2, 1, 0, 4, X, 2, NS, IBODY, IERR)
      CALL CHREFU(IERR, 5, '99')
      CALL CLBADD(MOD, 'a', 1, 2, 1, 0, 4, X, 2, NS, IBODY, IERR)
      CALL CHECK(IERR)
      CALL CLBSET(MOD, IBODY, 'material', 'Young', 1D0, IERR)
      CALL CHREFU(IERR, 5, 'Young')
      CALL CLBPRE(MOD, IBODY, -1, NS, NS, NS, IERR)
      CALL CHREFU(IERR, 2, 'CLBPRE: N is -1')
      CALL CLFGTR(MOD, IBODY, 'mass', 1, 4, 0, E, IERR)
      CALL CHREFU(IERR, 2, 'CLFGTR: NCOMP is 0')
      CALL CLSMSG('a message of the host')
      CALL CLMSG(SHORT, N)
      IF (SHORT .NE. 'a message of' .OR. N .NE. 21)
     1  CALL CHMISS('THE LAST MESSAGE')
      CALL CLSTAT(3, SHORT)
      IF (SHORT .NE. 'an index ran') CALL CHMISS('STATUS IN WORDS')
      CALL CLVERS(SHORT)
      IF (INDEX(SHORT, '.') .EQ. 0) CALL CHMISS('VERSION')
      CALL CLMDEL(MOD, IERR)
      CALL CHECK(IERR)
      END

      SUBROUTINE CHECK(IERR)
      INTEGER IERR
      CHARACTER*200 TEXT
      INTEGER N
      IF (IERR .EQ. 0) RETURN
      CALL CLMSG(TEXT, N)
      CALL CHMISS(TEXT)
      END

      SUBROUTINE CHREFU(IERR, NEEDED, PART)
      INTEGER IERR, NEEDED
      CHARACTER*(*) PART
      CHARACTER*400 TEXT
      INTEGER N
      CALL CLMSG(TEXT, N)
      IF (IERR .NE. NEEDED .OR. INDEX(TEXT, PART) .EQ. 0)
     1  CALL CHMISS(PART // ' IN: ' // TEXT)
      END
