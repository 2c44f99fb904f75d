! The rigid striker of this code and its contact with particles: a penalty without friction. It
! knows positions and forces of particles, nothing of where they come from.
module striker
  use mesh, only: dp
  implicit none
  private
  public :: striker_t, kick, drift, begin_contact, push, kinetic_energy

  type :: striker_t
    character(len=8) :: shape = 'none'     ! none, sphere (a disc in the plane) or punch
    real(dp) :: mass = 0                   ! [kg]; plane: per thickness
    real(dp) :: radius = 0                 ! of the sphere [m]
    real(dp) :: normal(3) = 0              ! out of the punch, a unit vector
    real(dp) :: position(3) = 0            ! centre of the sphere, a point of the punch's face [m]
    real(dp) :: velocity(3) = 0
    real(dp) :: force(3) = 0               ! of the particles on the striker [N]
    real(dp) :: stored = 0                 ! energy of the contact [J]
  end type striker_t

contains

  subroutine kick(s, dt)
    type(striker_t), intent(inout) :: s
    real(dp), intent(in) :: dt
    if (s%mass > 0) s%velocity = s%velocity + dt * s%force / s%mass
  end subroutine kick

  subroutine drift(s, dt)
    type(striker_t), intent(inout) :: s
    real(dp), intent(in) :: dt
    s%position = s%position + dt * s%velocity
  end subroutine drift

  subroutine begin_contact(s)
    type(striker_t), intent(inout) :: s
    s%force = 0
    s%stored = 0
  end subroutine begin_contact

  ! f(3,n): force on the particles at x(3,n), set; spring(n): force over penetration [N/m].
  subroutine push(s, x, spring, f)
    type(striker_t), intent(inout) :: s
    real(dp), intent(in) :: x(:,:), spring(:)
    real(dp), intent(out) :: f(:,:)
    real(dp) :: depth, normal(3)
    integer :: i
    do i = 1, size(x, 2)
      call penetration(s, x(:, i), depth, normal)
      f(:, i) = 0
      if (depth <= 0) cycle
      f(:, i) = spring(i) * depth * normal
      s%force = s%force - f(:, i)
      s%stored = s%stored + 0.5_dp * spring(i) * depth**2
    end do
  end subroutine push

  ! How far a point lies inside the striker, and the way out.
  subroutine penetration(s, x, depth, normal)
    type(striker_t), intent(in) :: s
    real(dp), intent(in) :: x(3)
    real(dp), intent(out) :: depth, normal(3)
    real(dp) :: distance
    if (s%shape == 'punch') then
      normal = s%normal
      depth = -dot_product(x - s%position, normal)
    else
      distance = sqrt(sum((x - s%position)**2))
      normal = 0
      if (distance > 0) normal = (x - s%position) / distance
      depth = s%radius - distance
    end if
  end subroutine penetration

  function kinetic_energy(s) result(energy)
    type(striker_t), intent(in) :: s
    real(dp) :: energy
    energy = 0.5_dp * s%mass * sum(s%velocity**2)
  end function kinetic_energy
end module striker
