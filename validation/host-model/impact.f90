! An impact: bodies of one Cleave model and a rigid striker, stepped together with this code's own
! step size, with its own balance of momentum and energy and its own files.
module impact
  use, intrinsic :: iso_fortran_env, only: error_unit
  use cleave
  use mesh, only: dp, write_gmsh
  use specimen, only: specimen_t, description_t, add_specimen, launch
  use state_file, only: write_fields, read_fields, write_fingerprint, same_fingerprint
  use status_check, only: check
  use striker, only: striker_t, kick, drift, begin_contact, push, kinetic_energy
  implicit none
  private
  public :: impact_t, begin, step, done, finish

  integer, parameter :: most = 8       ! bodies

  type :: control_t
    character(len=64) :: name = 'impact'
    real(dp) :: t_end = 0
    integer :: steps = huge(1)         ! at most
    real(dp) :: fixed_step = 0         ! 0: by the rule of choose_step
    real(dp) :: fraction = 0.8_dp      ! of the stable step, that is aimed at
    real(dp) :: first = 0.1_dp         ! of it, at the start
    real(dp) :: growth = 1.02_dp       ! of the step, at most
    real(dp) :: stiffness = 1          ! of the contact over that of the material
    integer :: every = 10              ! steps between records, and between looks at the stable step
    integer :: save_at = -1            ! step after which the state is saved
    integer :: threads = 1
    character(len=64) :: resume = ' '  ! file of a saved state to go on from
  end type control_t

  type :: impact_t
    type(control_t) :: says
    type(cleave_model) :: model
    type(specimen_t), allocatable :: specimens(:)
    type(striker_t) :: striker
    integer :: steps = 0
    real(dp) :: time = 0, dt = 0, limit = 0
    integer :: log = 0                 ! unit of the record
  end type impact_t

contains

  ! [in] number: of this impact in the program, for its unit
  subroutine begin(it, file, number)
    type(impact_t), intent(inout) :: it
    character(len=*), intent(in) :: file
    integer, intent(in) :: number
    integer :: k
    it%log = 30 + number
    call read_input(it, file)
    call check(cleave_model_create(it%model))
    call check(cleave_model_set_threads(it%model, it%says%threads))
    do k = 1, size(it%specimens)
      call add_specimen(it%model, it%specimens(k))
      call write_gmsh(it%specimens(k)%mesh, trim(it%specimens(k)%says%name) // '.msh')
    end do
    call check(cleave_model_setup(it%model))
    do k = 1, size(it%specimens)
      call launch(it%model, it%specimens(k), it%says%stiffness)
    end do
    open (it%log, file=trim(it%says%name) // '.csv', status='replace', action='write')
    if (it%says%resume /= ' ') then
      call resume(it)
    else
      call contact(it)
      call check(cleave_model_initialise(it%model, it%time))
    end if
    call write_header(it)
    call record(it)
  end subroutine begin

  subroutine read_input(it, file)
    type(impact_t), intent(inout) :: it
    character(len=*), intent(in) :: file
    type(control_t) :: run
    type(striker_t) :: ram
    type(description_t) :: body, nothing, bodies(most + 1)
    integer :: status, n, k
    namelist /control/ run
    namelist /rigid/ ram
    namelist /deformable/ body
    open (10, file=file, status='old', action='read')
    read (10, control)
    read (10, rigid)
    it%says = run
    it%striker = ram
    do n = 0, most
      body = nothing
      read (10, deformable, iostat=status)
      if (status /= 0) exit
      bodies(n + 1) = body
    end do
    close (10)
    if (status >= 0) then
      write (error_unit, '(2a, i0, a)') file, ': cannot take group &deformable number ', &
          min(n, most) + 1, '; it is wrong, or one too many'
      stop 2
    end if
    allocate (it%specimens(n))
    do k = 1, n
      it%specimens(k)%says = bodies(k)
    end do
  end subroutine read_input

  ! One step of velocity Verlet for bodies and striker together.
  subroutine step(it)
    type(impact_t), intent(inout) :: it
    call choose_step(it)
    it%time = it%time + it%dt
    it%steps = it%steps + 1
    call kick(it%striker, 0.5_dp * it%dt)
    call drift(it%striker, it%dt)
    call check(cleave_model_advance(it%model, it%dt, it%time))
    call contact(it)
    call check(cleave_model_update(it%model))
    call kick(it%striker, 0.5_dp * it%dt)
    if (mod(it%steps, it%says%every) == 0) call record(it)
    if (it%steps == it%says%save_at) call save(it, '.state', .false.)
  end subroutine step

  ! Aims at a fraction of the stable step, which deformation shortens, and lets the step grow slowly.
  ! The springs of the contact stiffen the body: omega^2 = 4 / stable^2 + k / m.
  subroutine choose_step(it)
    type(impact_t), intent(inout) :: it
    real(dp) :: stable, square
    integer :: k
    if (mod(it%steps, it%says%every) == 0) then
      call check(cleave_model_stable_step(it%model, stable))
      square = 0
      if (it%striker%shape /= 'none') square = maxval( &
          [(maxval(it%specimens(k)%spring / it%specimens(k)%mass), k = 1, size(it%specimens))])
      it%limit = it%says%fraction * stable / sqrt(1 + 0.25_dp * stable**2 * square)
      if (it%steps == 0) it%dt = it%says%first * it%limit
    end if
    it%dt = min(it%says%growth * it%dt, it%limit)
    if (it%says%fixed_step > 0) it%dt = it%says%fixed_step
  end subroutine choose_step

  ! Forces of the striker on the particles where they are now, and of the particles on the striker.
  subroutine contact(it)
    type(impact_t), intent(inout) :: it
    integer :: k, n
    if (it%striker%shape == 'none') return
    call begin_contact(it%striker)
    do k = 1, size(it%specimens)
      n = size(it%specimens(k)%mass)
      call check(cleave_field_get_real(it%model, it%specimens(k)%body, 'position', 1, n, &
          it%specimens(k)%x))
      call push(it%striker, it%specimens(k)%x, it%specimens(k)%spring, it%specimens(k)%force)
      call check(cleave_field_put_real(it%model, it%specimens(k)%body, 'external_force', 1, n, &
          it%specimens(k)%force))
    end do
  end subroutine contact

  function done(it) result(is)
    type(impact_t), intent(in) :: it
    logical :: is
    is = it%time >= it%says%t_end .or. it%steps >= it%says%steps
  end function done

  ! The final state with all that is computed from it, and the end of the model.
  subroutine finish(it)
    type(impact_t), intent(inout) :: it
    call save(it, '.fields', .true.)
    close (it%log)
    call check(cleave_model_destroy(it%model))
  end subroutine finish

  subroutine save(it, ending, everything)
    type(impact_t), intent(in) :: it
    character(len=*), intent(in) :: ending
    logical, intent(in) :: everything
    integer :: k
    open (11, file=trim(it%says%name) // ending, access='stream', form='unformatted', &
        status='replace', action='write')
    call write_fingerprint(11)
    write (11) it%steps, it%time, it%dt, it%limit
    write (11) it%striker%position, it%striker%velocity, it%striker%force, it%striker%stored
    do k = 1, size(it%specimens)
      call write_fields(11, it%model, it%specimens(k)%body, everything)
    end do
    close (11)
  end subroutine save

  ! In place of cleave_model_initialise, with the same input as the run that saved.
  subroutine resume(it)
    type(impact_t), intent(inout) :: it
    integer :: k
    open (11, file=it%says%resume, access='stream', form='unformatted', status='old', action='read')
    if (.not. same_fingerprint(11)) then
      write (error_unit, '(2a)') trim(it%says%resume), ': saved with another version of Cleave'
      stop 2
    end if
    read (11) it%steps, it%time, it%dt, it%limit
    read (11) it%striker%position, it%striker%velocity, it%striker%force, it%striker%stored
    do k = 1, size(it%specimens)
      call read_fields(11, it%model, it%specimens(k)%body)
    end do
    close (11)
    call check(cleave_model_restore(it%model, it%steps, it%time))
  end subroutine resume

  subroutine write_header(it)
    type(impact_t), intent(in) :: it
    write (it%log, '(a)') 'step,time,dt,striker_x,striker_y,striker_z,force_x,force_y,force_z,' // &
        'momentum_x,momentum_y,momentum_z,striker_energy,contact_energy,body_kinetic,kinetic,' // &
        'elastic,plastic,stabilisation,fracture,viscous,external,broken'
  end subroutine write_header

  ! A line of the record: momentum of striker and bodies, and every kind of energy.
  subroutine record(it)
    type(impact_t), intent(inout) :: it
    type(cleave_energies) :: e
    type(cleave_counts) :: counts
    real(dp) :: momentum(3), body_kinetic
    integer :: k, i, n
    momentum = it%striker%mass * it%striker%velocity
    body_kinetic = 0
    do k = 1, size(it%specimens)
      n = size(it%specimens(k)%mass)
      call check(cleave_field_get_real(it%model, it%specimens(k)%body, 'velocity', 1, n, &
          it%specimens(k)%v))
      do i = 1, n
        momentum = momentum + it%specimens(k)%mass(i) * it%specimens(k)%v(:, i)
        body_kinetic = body_kinetic + &
            0.5_dp * it%specimens(k)%mass(i) * sum(it%specimens(k)%v(:, i)**2)
      end do
    end do
    call check(cleave_energies_get(it%model, 0, e))
    call check(cleave_counts_get(it%model, 0, counts))
    write (it%log, '(i0, 21(",", es24.16e3), ",", i0)') it%steps, it%time, it%dt, &
        it%striker%position, it%striker%force, momentum, kinetic_energy(it%striker), &
        it%striker%stored, body_kinetic, e%kinetic, e%elastic, e%plastic, e%stabilisation, &
        e%fracture, e%viscous, e%external, counts%broken
  end subroutine record
end module impact
