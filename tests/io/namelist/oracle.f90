! Reads namelist files with the compiler's own namelist READ and prints what the variables hold.
! reader.cpp declares the same variables, reads the same files with cleave::io and prints the same
! way; compare_with_fortran.py compares the two.
!
! Standard input: one file name a line. Every group /g/ of a file is read in turn, then every group
! /h/, each time into fresh variables. Output for each: "group g" and one line for each variable, or
! "refused" and the reason, which ends that file.
program oracle
  use, intrinsic :: iso_fortran_env, only: int64, real64, output_unit
  implicit none

  type inner
    integer :: n = -7
    real(real64) :: w = -7
  end type
  type outer
    integer :: a = -7
    real(real64) :: b(2) = -7
    type(inner) :: c(3)
    character(8) :: nm = 'initial'
  end type

  integer :: i, j, iv(6), m(2, 3), neg(-2:2)
  integer(int64) :: i8
  real(real64) :: r, rv(6), rm(2, 2, 2)
  logical :: l, t, f, lv(4)
  character(12) :: s, sv(3)
  complex(real64) :: z, zv(3)
  type(outer) :: d, dv(2)
  namelist /g/ i, j, iv, m, neg, i8, r, rv, rm, l, t, f, lv, s, sv, z, zv, d, dv

  integer :: n
  real(real64) :: x(3)
  namelist /h/ n, x

  character(1024) :: path
  integer :: status

  do
    read (*, '(a)', iostat=status) path
    if (status /= 0) exit
    write (*, '(2a)') 'file ', trim(path)
    open (10, file=trim(path), action='read', status='old')
    call read_all_g()
    rewind (10)
    call read_all_h()
    close (10)
  end do

contains

  subroutine read_all_g()
    integer :: stat, k
    character(200) :: reason
    do
      i = -7; j = -7; iv = -7; m = -7; neg = -7; i8 = -7
      r = -7; rv = -7; rm = -7
      l = .false.; t = .false.; f = .true.; lv = [.false., .true., .false., .true.]
      s = 'initial'; sv = 'initial'
      z = (-7, -7); zv = (-7, -7)
      d = outer(c=inner()); dv = outer(c=inner())
      reason = ''
      read (10, nml=g, iostat=stat, iomsg=reason)
      if (stat < 0) exit
      if (stat > 0) then
        write (*, '(2a)') 'refused ', trim(reason)
        exit
      end if
      write (*, '(a)') 'group g'
      call put_integers('i', [int(i, int64)])
      call put_integers('j', [int(j, int64)])
      call put_integers('iv', int(iv, int64))
      call put_integers('m', int(reshape(m, [6]), int64))
      call put_integers('neg', int(neg, int64))
      call put_integers('i8', [i8])
      call put_reals('r', [r])
      call put_reals('rv', rv)
      call put_reals('rm', reshape(rm, [8]))
      call put_logicals('l', [l])
      call put_logicals('t', [t])
      call put_logicals('f', [f])
      call put_logicals('lv', lv)
      call put_texts('s', [s])
      call put_texts('sv', sv)
      call put_reals('z', [real(z), aimag(z)])
      call put_reals('zv', [(real(zv(k)), aimag(zv(k)), k=1, 3)])
      call put_outer('d', d)
      call put_outer('dv(1)', dv(1))
      call put_outer('dv(2)', dv(2))
    end do
  end subroutine

  subroutine read_all_h()
    integer :: stat
    character(200) :: reason
    do
      n = -7; x = -7
      reason = ''
      read (10, nml=h, iostat=stat, iomsg=reason)
      if (stat < 0) exit
      if (stat > 0) then
        write (*, '(2a)') 'refused ', trim(reason)
        exit
      end if
      write (*, '(a)') 'group h'
      call put_integers('n', [int(n, int64)])
      call put_reals('x', x)
    end do
  end subroutine

  subroutine put_outer(name, value)
    character(*), intent(in) :: name
    type(outer), intent(in) :: value
    call put_integers(name//'%a', [int(value%a, int64)])
    call put_reals(name//'%b', value%b)
    call put_integers(name//'%c%n', int(value%c%n, int64))
    call put_reals(name//'%c%w', value%c%w)
    call put_texts(name//'%nm', [value%nm])
  end subroutine

  subroutine put_integers(name, values)
    character(*), intent(in) :: name
    integer(int64), intent(in) :: values(:)
    write (*, '(a, *(1x, i0))') name, values
  end subroutine

  ! The bits; NaNs have one form.
  subroutine put_reals(name, values)
    character(*), intent(in) :: name
    real(real64), intent(in) :: values(:)
    integer(int64) :: bits(size(values))
    integer :: k
    do k = 1, size(values)
      bits(k) = transfer(values(k), bits(k))
      if (values(k) /= values(k)) bits(k) = int(z'7FF8000000000000', int64)
    end do
    write (*, '(a, *(1x, z16.16))') name, bits
  end subroutine

  subroutine put_logicals(name, values)
    character(*), intent(in) :: name
    logical, intent(in) :: values(:)
    write (*, '(a, *(1x, l1))') name, values
  end subroutine

  subroutine put_texts(name, values)
    character(*), intent(in) :: name
    character(*), intent(in) :: values(:)
    integer :: k
    write (*, '(a, *(a))') name, (' [', values(k), ']', k=1, size(values))
  end subroutine
end program
