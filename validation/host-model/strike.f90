! strike INPUT [INPUT ...]: computes the impacts that the input files describe, all at the same time,
! a step of each in turn. Each writes NAME.csv (balances), NAME.fields (the final state) and its
! meshes; NAME.state if it is asked to save.
program strike
  use impact, only: impact_t, begin, step, done, finish
  implicit none
  type(impact_t), allocatable :: impacts(:)
  character(len=256) :: file
  integer :: n, k
  n = command_argument_count()
  allocate (impacts(n))
  do k = 1, n
    call get_command_argument(k, file)
    call begin(impacts(k), trim(file), k)
  end do
  do while (.not. all([(done(impacts(k)), k = 1, n)]))
    do k = 1, n
      if (.not. done(impacts(k))) call step(impacts(k))
    end do
  end do
  do k = 1, n
    call finish(impacts(k))
  end do
end program strike
