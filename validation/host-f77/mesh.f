C     A bar of NX cells across and NL cells along its axis, y in the
C     plane and z in space, with its foot at 0.
      SUBROUTINE MESH
      INCLUDE 'impact.inc'
      NZ = 1
      IF (NDIM .EQ. 3) NZ = NX + 1
      NP = (NX + 1)*NZ*(NL + 1)
      NS = 2*NX*NL
      IF (NDIM .EQ. 3) NS = 5*NX*NX*NL
      IF (NP .GT. MXP .OR. NS .GT. MXS)
     &  CALL HALT ('the mesh needs larger MXP or MXS in impact.inc')
      I = 0
      DO 10 L = 0, NL
      DO 10 M = 0, NZ - 1
      DO 10 K = 0, NX
        I = I + 1
        X0(1,I) = WIDTH*(DBLE(K)/DBLE(NX) - 0.5D0)
        X0(2,I) = WIDTH*(DBLE(M)/DBLE(NX) - 0.5D0)
        X0(3,I) = 0D0
        X0(NDIM,I) = HEIGHT*DBLE(L)/DBLE(NL)
   10 CONTINUE
      IF (NDIM .EQ. 2) CALL TRIANG
      IF (NDIM .EQ. 3) CALL TETRAS
      DO 20 IS = 1, NS
        LIVE(IS) = 1
   20 CONTINUE
      CALL GMSH
      END

C     Two triangles a cell; the diagonals alternate.
      SUBROUTINE TRIANG
      INCLUDE 'impact.inc'
      IS = 0
      DO 10 L = 0, NL - 1
      DO 10 K = 1, NX
        I1 = K + (NX + 1)*L
        I2 = I1 + 1
        I3 = I2 + NX + 1
        I4 = I1 + NX + 1
        IF (MOD(K + L, 2) .EQ. 0) THEN
          CALL CORNER (IS, I1, I2, I3, 0)
          CALL CORNER (IS, I1, I3, I4, 0)
        ELSE
          CALL CORNER (IS, I1, I2, I4, 0)
          CALL CORNER (IS, I2, I3, I4, 0)
        END IF
   10 CONTINUE
      END

C     Five tetrahedra a cell; every other cell is the mirror image.
C     Corner 1 + i + 2j + 4k of a cell lies at (i,j,k).
      SUBROUTINE TETRAS
      INCLUDE 'impact.inc'
      DIMENSION ITET(4,5), NC(8), IC(4)
      DATA ITET /1,4,6,7, 2,1,4,6, 3,1,4,7, 5,1,6,7, 8,4,6,7/
      IS = 0
      N1 = NX + 1
      DO 40 L = 0, NL - 1
      DO 40 M = 0, NX - 1
      DO 40 K = 0, NX - 1
        DO 10 J = 0, 7
          I = K + MOD(J, 2) + N1*(M + MOD(J/2, 2)) + N1*N1*(L + J/4)
          NC(J+1) = I + 1
   10   CONTINUE
        DO 30 J = 1, 5
          DO 20 I = 1, 4
            N = ITET(I,J)
            IF (MOD(K + M + L, 2) .EQ. 1) N = N - 1 + 2*MOD(N, 2)
            IC(I) = NC(N)
   20     CONTINUE
          CALL CORNER (IS, IC(1), IC(2), IC(3), IC(4))
   30   CONTINUE
   40 CONTINUE
      END

C     Appends a simplex.  NODES is read as NODES(NDIM+1,NS).
      SUBROUTINE CORNER (IS, I1, I2, I3, I4)
      INCLUDE 'impact.inc'
      N = (NDIM + 1)*IS
      NODES(N+1) = I1
      NODES(N+2) = I2
      NODES(N+3) = I3
      IF (NDIM .EQ. 3) NODES(N+4) = I4
      IS = IS + 1
      END

C     The mesh as a Gmsh file (MSH 2.2): 18 digits give back the bits.
      SUBROUTINE GMSH
      INCLUDE 'impact.inc'
      N = NDIM + 1
      OPEN (LMSH, FILE=NAME(1:LENTXT(NAME))//'.msh', STATUS='UNKNOWN')
      WRITE (LMSH,'(A)') '$MeshFormat', '2.2 0 8', '$EndMeshFormat'
      WRITE (LMSH,'(A/I8)') '$Nodes', NP
      DO 10 I = 1, NP
        WRITE (LMSH,'(I8,1P,3E26.17)') I, (X0(K,I), K = 1, 3)
   10 CONTINUE
      WRITE (LMSH,'(A)') '$EndNodes', '$Elements'
      WRITE (LMSH,'(I8)') NS
      DO 20 IS = 1, NS
        WRITE (LMSH,'(5I8,4I8)') IS, 2*NDIM - 2, 2, 1, 1,
     &        (NODES(N*(IS-1)+K), K = 1, N)
   20 CONTINUE
      WRITE (LMSH,'(A)') '$EndElements'
      CLOSE (LMSH)
      END
