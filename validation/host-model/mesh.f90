! The meshes of this code: rectangles of triangles and blocks of tetrahedra, and a file of them for
! programs that read Gmsh's format.
module mesh
  implicit none
  private
  public :: mesh_t, make_block, write_gmsh

  integer, parameter, public :: dp = kind(1d0)

  type :: mesh_t
    real(dp), allocatable :: X(:,:)          ! (3,particles)
    integer, allocatable :: simplices(:,:)   ! (dimension + 1, simplices), particles count from 1
  end type mesh_t

contains

  ! cells: numbers of cells along the axes; none along z is a plane mesh. Every order in which the
  ! axes can be taken is a way along the edges of a cell from its lowest to its highest corner; the
  ! nodes on the way are a simplex.
  subroutine make_block(m, origin, spacing, cells)
    type(mesh_t), intent(out) :: m
    real(dp), intent(in) :: origin(3), spacing
    integer, intent(in) :: cells(3)
    integer, parameter :: orders(3,6) = &
        reshape([1, 2, 3,  2, 1, 3,  1, 3, 2,  2, 3, 1,  3, 1, 2,  3, 2, 1], [3, 6])
    integer :: d, ways, nodes(3), stride(3), i, j, k, way, edge, node, s
    d = merge(2, 3, cells(3) == 0)
    ways = merge(2, 6, d == 2)
    nodes = cells + 1
    stride = [1, nodes(1), nodes(1) * nodes(2)]
    allocate (m%X(3, product(nodes)), m%simplices(d + 1, ways * product(cells(:d))))
    node = 0
    s = 0
    do k = 0, cells(3)
      do j = 0, cells(2)
        do i = 0, cells(1)
          node = node + 1
          m%X(:, node) = origin + spacing * real([i, j, k], dp)
          if (any([i, j, k] == cells .and. [.true., .true., d == 3])) cycle
          do way = 1, ways
            s = s + 1
            m%simplices(1, s) = node
            do edge = 1, d
              m%simplices(edge + 1, s) = m%simplices(edge, s) + stride(orders(edge, way))
            end do
          end do
        end do
      end do
    end do
  end subroutine make_block

  ! Format 2.2, with all digits of the coordinates.
  subroutine write_gmsh(m, file)
    type(mesh_t), intent(in) :: m
    character(len=*), intent(in) :: file
    integer, parameter :: type_of(3:4) = [2, 4]
    integer :: unit, k
    unit = 20
    open (unit, file=file, status='replace', action='write')
    write (unit, '(a)') '$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes'
    write (unit, '(i0)') size(m%X, 2)
    do k = 1, size(m%X, 2)
      write (unit, '(i0, 3(1x, es24.16e3))') k, m%X(:, k)
    end do
    write (unit, '(a)') '$EndNodes', '$Elements'
    write (unit, '(i0)') size(m%simplices, 2)
    do k = 1, size(m%simplices, 2)
      write (unit, '(i0, 6(1x, i0))') k, type_of(size(m%simplices, 1)), 0, m%simplices(:, k)
    end do
    write (unit, '(a)') '$EndElements'
    close (unit)
  end subroutine write_gmsh
end module mesh
