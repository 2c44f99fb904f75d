
! ---- bodies of a model. IBODY: the number CLBADD gives.

! Adds a body of particles x(3,n) and simplices ns(nnode,m); nnode 0: ndim + 1. iform: a
! formulation (CLFIND with table 3); kin: 1 three dimensions, 2 plane strain, 3 plane stress; mat: a
! law (CLLAW).
recursive subroutine clbadd(mod, name, iform, kin, mat, nnode, n, x, m, ns, ibody, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_body_add, cleave_body_spec, &
      cleave_body_spec_init, CLEAVE_3D, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod
  character(len=*), intent(in) :: name
  integer, intent(in) :: iform, kin, mat, nnode, n
  real(c_double), intent(in) :: x(3, *)
  integer, intent(in) :: m, ns(*)
  integer, intent(inout) :: ibody
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_body_spec) :: spec
  integer :: nodes
  call model_of('CLBADD', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_spec_init(spec)
  if (status == CLEAVE_OK) status = at_least('CLBADD', 'N', n, 1)
  if (status == CLEAVE_OK) status = at_least('CLBADD', 'M', m, 0)
  if (status == CLEAVE_OK) status = at_least('CLBADD', 'NNODE', nnode, 0)
  spec%name = name
  spec%formulation = choice(iform)
  spec%kinematics = choice(kin)
  spec%material = choice(mat)
  spec%simplex_nodes = choice(nnode)
  nodes = nnode
  if (nodes == 0) nodes = merge(4, 3, spec%kinematics == CLEAVE_3D)
  if (status == CLEAVE_OK) status = cleave_body_add(model, spec, x(:, :n), &
      reshape(ns(:nodes * m), [nodes, m]), ibody)
  ierr = status
end subroutine clbadd

! Sets a parameter, before CLMSET. group: material, or of table 4.
recursive subroutine clbset(mod, ibody, group, name, value, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_body_set_real, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: group, name
  real(c_double), intent(in) :: value
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBSET', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_set_real(model, ibody, group, name, value)
  ierr = status
end subroutine clbset

! Sets a parameter that is a choice.
recursive subroutine clbcho(mod, ibody, group, name, chosen, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_body_set_choice, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: group, name, chosen
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBCHO', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_set_choice(model, ibody, group, name, chosen)
  ierr = status
end subroutine clbcho

! The value of a parameter in force.
recursive subroutine clbget(mod, ibody, group, name, value, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_body_get_real, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  character(len=*), intent(in) :: group, name
  real(c_double), intent(inout) :: value
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBGET', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_get_real(model, ibody, group, name, value)
  ierr = status
end subroutine clbget

! Prescribed degrees of freedom, before CLMSET: particle, direction 1 2 3, motion 1 acceleration
! given 2 position given.
recursive subroutine clbpre(mod, ibody, n, npart, ndir, nmot, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of, at_least
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_body_prescribe, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n, npart(*), ndir(*), nmot(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  integer :: k
  call model_of('CLBPRE', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBPRE', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_prescribe(model, ibody, npart(:n), ndir(:n), &
      [(choice(nmot(k)), k = 1, n)])
  ierr = status
end subroutine clbpre

! Particles of a zone without fracture.
recursive subroutine clbexe(mod, ibody, n, npart, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_exempt, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n, npart(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBEXE', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBEXE', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_exempt(model, ibody, npart(:n))
  ierr = status
end subroutine clbexe

! Volumes of the particles instead of shares of simplices.
recursive subroutine clbvol(mod, ibody, n, volume, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_volumes, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n
  real(c_double), intent(in) :: volume(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBVOL', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBVOL', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_volumes(model, ibody, volume(:n))
  ierr = status
end subroutine clbvol

! Another material for particles; STRAIN, GF: 0 for what group fracture says.
recursive subroutine clbreg(mod, ibody, n, npart, mat, nprop, prop, strain, gf, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave77_choice, only: choice
  use cleave, only: cleave_model, cleave_body_region, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n, npart(*), mat, nprop
  real(c_double), intent(in) :: prop(*), strain, gf
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBREG', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBREG', 'N', n, 0)
  if (status == CLEAVE_OK) status = at_least('CLBREG', 'NPROP', nprop, 0)
  if (status == CLEAVE_OK) status = cleave_body_region(model, ibody, npart(:n), choice(mat), &
      prop(:nprop), strain, gf)
  ierr = status
end subroutine clbreg

! Breaks bonds npair(2,n) before the first step: pre-cracks.
recursive subroutine clbcrk(mod, ibody, n, npair, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_precrack, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n, npair(2, *)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBCRK', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBCRK', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_precrack(model, ibody, npair(:, :n))
  ierr = status
end subroutine clbcrk

! Wave speed of the body.
recursive subroutine clbwav(mod, ibody, speed, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_body_wave_speed, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  real(c_double), intent(inout) :: speed
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBWAV', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_wave_speed(model, ibody, speed)
  ierr = status
end subroutine clbwav

! Displacements u(n) and accelerations a(n) in the order of CLBPRE.
recursive subroutine clbmot(mod, ibody, n, u, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_motion, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n
  real(c_double), intent(in) :: u(*), a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBMOT', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBMOT', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_motion(model, ibody, u(:n), a(:n))
  ierr = status
end subroutine clbmot

! Displacements only.
recursive subroutine clbdis(mod, ibody, n, u, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_motion, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n
  real(c_double), intent(in) :: u(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBDIS', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBDIS', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_motion(model, ibody, displacement=u(:n))
  ierr = status
end subroutine clbdis

! Accelerations only.
recursive subroutine clbacc(mod, ibody, n, a, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_motion, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n
  real(c_double), intent(in) :: a(*)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLBACC', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLBACC', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_motion(model, ibody, acceleration=a(:n))
  ierr = status
end subroutine clbacc

! Sum of the reactions of n particles.
recursive subroutine clreac(mod, ibody, n, npart, force, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of, at_least
  use cleave, only: cleave_model, cleave_body_reaction, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, n, npart(*)
  real(c_double), intent(inout) :: force(3)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLREAC', mod, model, status)
  if (status == CLEAVE_OK) status = at_least('CLREAC', 'N', n, 0)
  if (status == CLEAVE_OK) status = cleave_body_reaction(model, ibody, npart(:n), force)
  ierr = status
end subroutine clreac

! Number of bonds broken since CLEVCL.
recursive subroutine clevct(mod, ibody, ncount, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_body_event_count, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  integer, intent(inout) :: ncount
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLEVCT', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_event_count(model, ibody, ncount)
  ierr = status
end subroutine clevct

! A broken bond: step, ends nend(2), and data(7): time, midpoint (3), criterion, limit, released
! energy.
recursive subroutine clevgt(mod, ibody, index, istep, nend, data, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_body_event_get, cleave_event, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody, index
  integer, intent(inout) :: istep, nend(2)
  real(c_double), intent(inout) :: data(7)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_event) :: event
  call model_of('CLEVGT', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_event_get(model, ibody, index, event)
  if (status == CLEAVE_OK) then
    istep = int(event%step, kind(istep))
    nend = [int(event%first, kind(istep)), int(event%second, kind(istep))]
    data(1) = event%time
    data(2:4) = event%midpoint
    data(5) = event%criterion
    data(6) = event%limit
    data(7) = event%released
  end if
  ierr = status
end subroutine clevgt

! Forgets the events.
recursive subroutine clevcl(mod, ibody, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_body_clear_events, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  call model_of('CLEVCL', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_body_clear_events(model, ibody)
  ierr = status
end subroutine clevcl

! Energies: e(1) kinetic, 2 kinetic staggered, 3 elastic, 4 plastic, 5 stabilisation, 6 fracture,
! 7 viscous, 8 external, 9 reaction, 10 internal, 11 balance, 12 identity, 13 hourglass. ibody 0:
! all.
recursive subroutine clener(mod, ibody, e, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_double
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_energies_get, cleave_energies, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  real(c_double), intent(inout) :: e(13)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_energies) :: c
  call model_of('CLENER', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_energies_get(model, ibody, c)
  if (status == CLEAVE_OK) e = [c%kinetic, c%kinetic_staggered, c%elastic, c%plastic, &
      c%stabilisation, c%fracture, c%viscous, c%external, c%reaction, c%internal, c%balance, &
      c%identity, c%hourglass]
  ierr = status
end subroutine clener

! Counts: nc(1) particles, 2 bonds, 3 simplices, 4 broken, 5 inert, 6 isolated, 7 inverted. ibody 0:
! all.
recursive subroutine clcnts(mod, ibody, nc, ierr)
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave77_support, only: model_of
  use cleave, only: cleave_model, cleave_counts_get, cleave_counts, CLEAVE_OK
  implicit none
  integer, intent(in) :: mod, ibody
  integer, intent(inout) :: nc(7)
  integer, intent(out) :: ierr
  type(cleave_model) :: model
  integer(c_int32_t) :: status
  type(cleave_counts) :: c
  call model_of('CLCNTS', mod, model, status)
  if (status == CLEAVE_OK) status = cleave_counts_get(model, ibody, c)
  if (status == CLEAVE_OK) nc = int([c%particles, c%bonds, c%simplices, c%broken, c%inert, &
      c%isolated, c%inverted], kind(nc))
  ierr = status
end subroutine clcnts
