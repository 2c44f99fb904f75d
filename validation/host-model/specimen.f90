! A deformable body: what the input says of it, and how it becomes a body of a Cleave model.
module specimen
  use cleave
  use mesh, only: dp, mesh_t, make_block
  use status_check, only: check
  implicit none
  private
  public :: specimen_t, add_specimen, launch

  type :: setting_t          ! a number by its name, such as 'material', 'rho', 2700
    character(len=16) :: group = ' '
    character(len=24) :: name = ' '
    real(dp) :: value = 0
  end type setting_t
  type :: choice_t           ! a choice by its name, such as 'viscosity', 'form', 'frozen'
    character(len=16) :: group = ' '
    character(len=24) :: name = ' ', choice = ' '
  end type choice_t
  type, public :: description_t
    character(len=32) :: name = 'body', law = 'svk', formulation = 'cbm', kinematics = '3d'
    integer :: cells(3) = 0
    real(dp) :: spacing = 0, origin(3) = 0
    real(dp) :: velocity(3) = 0, spin(3) = 0   ! at the start; about the origin [rad/s]
    type(setting_t) :: set(32)
    type(choice_t) :: choose(16)
  end type description_t

  type :: specimen_t
    type(description_t) :: says
    type(mesh_t) :: mesh
    integer :: body = 0                        ! its number in the model
    real(dp), allocatable :: mass(:), spring(:), x(:,:), v(:,:), force(:,:)
  end type specimen_t

contains

  ! Makes the mesh, and a body of it; before cleave_model_setup.
  subroutine add_specimen(model, it)
    type(cleave_model), intent(in) :: model
    type(specimen_t), intent(inout) :: it
    type(cleave_body_spec) :: spec
    integer :: k
    call make_block(it%mesh, it%says%origin, it%says%spacing, it%says%cells)
    call check(cleave_body_spec_init(spec))
    spec%name = it%says%name
    call check(cleave_table_find(CLEAVE_TABLE_FORMULATION, it%says%formulation, spec%formulation))
    call check(cleave_table_find(CLEAVE_TABLE_MATERIAL, it%says%law, spec%material))
    select case (it%says%kinematics)
    case ('plane_strain')
      spec%kinematics = CLEAVE_PLANE_STRAIN
    case ('plane_stress')
      spec%kinematics = CLEAVE_PLANE_STRESS
    case default
      spec%kinematics = CLEAVE_3D
    end select
    call check(cleave_body_add(model, spec, it%mesh%X, it%mesh%simplices, it%body))
    do k = 1, size(it%says%set)
      if (it%says%set(k)%group == ' ') exit
      call check(cleave_body_set_real(model, it%body, it%says%set(k)%group, it%says%set(k)%name, &
          it%says%set(k)%value))
    end do
    do k = 1, size(it%says%choose)
      if (it%says%choose(k)%group == ' ') exit
      call check(cleave_body_set_choice(model, it%body, it%says%choose(k)%group, &
          it%says%choose(k)%name, it%says%choose(k)%choice))
    end do
  end subroutine add_specimen

  ! Springs of contact, `stiffness` times that of the material, and initial velocities; after
  ! cleave_model_setup.
  subroutine launch(model, it, stiffness)
    type(cleave_model), intent(in) :: model
    type(specimen_t), intent(inout) :: it
    real(dp), intent(in) :: stiffness
    real(dp) :: speed, r(3), w(3)
    integer :: n, i
    n = size(it%mesh%X, 2)
    allocate (it%mass(n), it%spring(n), it%x(3, n), it%v(3, n), it%force(3, n))
    call check(cleave_field_get_real(model, it%body, 'mass', 1, n, it%mass))
    call check(cleave_body_wave_speed(model, it%body, speed))
    it%spring = stiffness * it%mass * (speed / it%says%spacing)**2
    w = it%says%spin
    do i = 1, n
      r = it%mesh%X(:, i) - it%says%origin
      it%v(:, i) = it%says%velocity + [w(2) * r(3), w(3) * r(1), w(1) * r(2)] &
          - [w(3) * r(2), w(1) * r(3), w(2) * r(1)]
    end do
    call check(cleave_field_put_real(model, it%body, 'velocity', 1, n, it%v))
  end subroutine launch
end module specimen
