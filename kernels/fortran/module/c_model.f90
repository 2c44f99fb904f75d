
! cleave.h: the model handle. What may be NULL in C is an address here.
module cleave_c_model
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_double, c_char, c_ptr
  use cleave_types, only: cleave_body_spec, cleave_static_options, cleave_relaxation_options, &
      cleave_event, &
      cleave_energies, cleave_counts, cleave_field
  implicit none
  private
  public :: cleave_model_create
  public :: cleave_model_destroy
  public :: cleave_model_set_index_base
  public :: cleave_model_set_threads
  public :: cleave_model_set_order
  public :: cleave_body_spec_init
  public :: cleave_body_add
  public :: cleave_body_set_real
  public :: cleave_body_set_choice
  public :: cleave_body_get_real
  public :: cleave_body_prescribe
  public :: cleave_body_exempt
  public :: cleave_body_volumes
  public :: cleave_body_region
  public :: cleave_model_setup
  public :: cleave_body_precrack
  public :: cleave_model_stable_step
  public :: cleave_model_is_stable
  public :: cleave_body_wave_speed
  public :: cleave_body_motion
  public :: cleave_model_initialise
  public :: cleave_model_advance
  public :: cleave_model_update
  public :: cleave_static_options_init
  public :: cleave_model_solve_static
  public :: cleave_model_break_static
  public :: cleave_relaxation_options_init
  public :: cleave_model_relax
  public :: cleave_model_relax_cancel
  public :: cleave_model_restore
  public :: cleave_model_clock
  public :: cleave_model_memory
  public :: cleave_body_event_count
  public :: cleave_body_event_get
  public :: cleave_body_clear_events
  public :: cleave_energies_get
  public :: cleave_counts_get
  public :: cleave_body_reaction
  public :: cleave_field_count
  public :: cleave_field_get
  public :: cleave_field_find
  public :: cleave_field_get_real
  public :: cleave_field_put_real
  public :: cleave_field_get_integer
  public :: cleave_field_put_integer
  public :: cleave_body_locate
  public :: cleave_field_interpolate

  interface
    function cleave_model_create(abi, model) bind(C) result(status)
      import :: c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: abi
      type(c_ptr), intent(out) :: model
      integer(c_int32_t) :: status
    end function cleave_model_create

    function cleave_model_destroy(model) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t) :: status
    end function cleave_model_destroy

    function cleave_model_set_index_base(model, base) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), value :: base
      integer(c_int32_t) :: status
    end function cleave_model_set_index_base

    function cleave_model_set_threads(model, threads) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function cleave_model_set_threads

    function cleave_model_set_order(model, order) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), value :: order
      integer(c_int32_t) :: status
    end function cleave_model_set_order

    function cleave_body_spec_init(spec) bind(C) result(status)
      import :: cleave_body_spec, c_int32_t
      implicit none
      type(cleave_body_spec), intent(out) :: spec
      integer(c_int32_t) :: status
    end function cleave_body_spec_init

    function cleave_body_add(model, spec, body) bind(C) result(status)
      import :: c_ptr, cleave_body_spec, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      type(cleave_body_spec), intent(in) :: spec
      integer(c_int64_t), intent(out) :: body
      integer(c_int32_t) :: status
    end function cleave_body_add

    function cleave_body_set_real(model, body, group, name, value) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: group(*), name(*)
      real(c_double), value :: value
      integer(c_int32_t) :: status
    end function cleave_body_set_real

    function cleave_body_set_choice(model, body, group, name, choice) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: group(*), name(*), choice(*)
      integer(c_int32_t) :: status
    end function cleave_body_set_choice

    function cleave_body_get_real(model, body, group, name, value) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: group(*), name(*)
      real(c_double), intent(out) :: value
      integer(c_int32_t) :: status
    end function cleave_body_get_real

    function cleave_body_prescribe(model, body, count, particle, direction, motion) &
        bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      integer(c_int64_t), intent(in) :: particle(*)
      integer(c_int32_t), intent(in) :: direction(*), motion(*)
      integer(c_int32_t) :: status
    end function cleave_body_prescribe

    function cleave_body_exempt(model, body, count, particle) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      integer(c_int64_t), intent(in) :: particle(*)
      integer(c_int32_t) :: status
    end function cleave_body_exempt

    function cleave_body_volumes(model, body, count, volume) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t, c_double
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      real(c_double), intent(in) :: volume(*)
      integer(c_int32_t) :: status
    end function cleave_body_volumes

    function cleave_body_region(model, body, count, particle, material, property_count, properties, &
        critical_strain, Gf) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t, c_double
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count, property_count
      integer(c_int64_t), intent(in) :: particle(*)
      integer(c_int32_t), value :: material
      real(c_double), intent(in) :: properties(*)
      real(c_double), value :: critical_strain, Gf
      integer(c_int32_t) :: status
    end function cleave_body_region

    function cleave_model_setup(model) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t) :: status
    end function cleave_model_setup

    function cleave_body_precrack(model, body, count, pairs) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      integer(c_int64_t), intent(in) :: pairs(*)
      integer(c_int32_t) :: status
    end function cleave_body_precrack

    function cleave_model_stable_step(model, step) bind(C) result(status)
      import :: c_ptr, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      real(c_double), intent(out) :: step
      integer(c_int32_t) :: status
    end function cleave_model_stable_step

    function cleave_model_is_stable(model, dt, stable) bind(C) result(status)
      import :: c_ptr, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      real(c_double), value :: dt
      integer(c_int32_t), intent(out) :: stable
      integer(c_int32_t) :: status
    end function cleave_model_is_stable

    function cleave_body_wave_speed(model, body, speed) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      real(c_double), intent(out) :: speed
      integer(c_int32_t) :: status
    end function cleave_body_wave_speed

    function cleave_body_motion(model, body, count, displacement, acceleration) &
        bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      type(c_ptr), value :: displacement, acceleration
      integer(c_int32_t) :: status
    end function cleave_body_motion

    function cleave_model_initialise(model, time) bind(C) result(status)
      import :: c_ptr, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      real(c_double), value :: time
      integer(c_int32_t) :: status
    end function cleave_model_initialise

    function cleave_model_advance(model, dt, time_new) bind(C) result(status)
      import :: c_ptr, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      real(c_double), value :: dt, time_new
      integer(c_int32_t) :: status
    end function cleave_model_advance

    function cleave_model_update(model) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t) :: status
    end function cleave_model_update

    function cleave_static_options_init(options) bind(C) result(status)
      import :: cleave_static_options, c_int32_t
      implicit none
      type(cleave_static_options), intent(out) :: options
      integer(c_int32_t) :: status
    end function cleave_static_options_init

    function cleave_model_solve_static(model, time_new, options, report) bind(C) result(status)
      import :: c_ptr, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      real(c_double), value :: time_new
      type(c_ptr), value :: options, report
      integer(c_int32_t) :: status
    end function cleave_model_solve_static

    function cleave_model_break_static(model, options, report) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      type(c_ptr), value :: options, report
      integer(c_int32_t) :: status
    end function cleave_model_break_static

    function cleave_relaxation_options_init(options) bind(C) result(status)
      import :: cleave_relaxation_options, c_int32_t
      implicit none
      type(cleave_relaxation_options), intent(out) :: options
      integer(c_int32_t) :: status
    end function cleave_relaxation_options_init

    function cleave_model_relax(model, time_new, options, report) bind(C) result(status)
      import :: c_ptr, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      real(c_double), value :: time_new
      type(c_ptr), value :: options, report
      integer(c_int32_t) :: status
    end function cleave_model_relax

    function cleave_model_relax_cancel(model) bind(C) result(status)
      import :: c_ptr, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t) :: status
    end function cleave_model_relax_cancel

    function cleave_model_restore(model, step, time) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: step
      real(c_double), value :: time
      integer(c_int32_t) :: status
    end function cleave_model_restore

    function cleave_model_clock(model, step, time) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), intent(out) :: step
      real(c_double), intent(out) :: time
      integer(c_int32_t) :: status
    end function cleave_model_clock

    function cleave_model_memory(model, bytes) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), intent(out) :: bytes
      integer(c_int32_t) :: status
    end function cleave_model_memory

    function cleave_body_event_count(model, body, count) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t) :: status
    end function cleave_body_event_count

    function cleave_body_event_get(model, body, index, event) bind(C) result(status)
      import :: c_ptr, c_int64_t, cleave_event, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, index
      type(cleave_event), intent(inout) :: event
      integer(c_int32_t) :: status
    end function cleave_body_event_get

    function cleave_body_clear_events(model, body) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      integer(c_int32_t) :: status
    end function cleave_body_clear_events

    function cleave_energies_get(model, body, energies) bind(C) result(status)
      import :: c_ptr, c_int64_t, cleave_energies, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      type(cleave_energies), intent(inout) :: energies
      integer(c_int32_t) :: status
    end function cleave_energies_get

    function cleave_counts_get(model, body, counts) bind(C) result(status)
      import :: c_ptr, c_int64_t, cleave_counts, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      type(cleave_counts), intent(inout) :: counts
      integer(c_int32_t) :: status
    end function cleave_counts_get

    function cleave_body_reaction(model, body, count, particle, force) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      integer(c_int64_t), intent(in) :: particle(*)
      real(c_double), intent(out) :: force(*)
      integer(c_int32_t) :: status
    end function cleave_body_reaction

    function cleave_field_count(model, body, count) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t) :: status
    end function cleave_field_count

    function cleave_field_get(model, body, index, field) bind(C) result(status)
      import :: c_ptr, c_int64_t, cleave_field, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, index
      type(cleave_field), intent(inout) :: field
      integer(c_int32_t) :: status
    end function cleave_field_get

    function cleave_field_find(model, body, name, field) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, cleave_field, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: name(*)
      type(cleave_field), intent(inout) :: field
      integer(c_int32_t) :: status
    end function cleave_field_find

    function cleave_field_get_real(model, body, name, first, last, values) &
        bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: first, last
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function cleave_field_get_real

    function cleave_field_put_real(model, body, name, first, last, values) &
        bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: first, last
      real(c_double), intent(in) :: values(*)
      integer(c_int32_t) :: status
    end function cleave_field_put_real

    function cleave_field_get_integer(model, body, name, first, last, values) &
        bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: first, last
      integer(c_int64_t), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function cleave_field_get_integer

    function cleave_field_put_integer(model, body, name, first, last, values) &
        bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: first, last
      integer(c_int64_t), intent(in) :: values(*)
      integer(c_int32_t) :: status
    end function cleave_field_put_integer

    function cleave_body_locate(model, body, count, X, simplex, weight) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body, count
      real(c_double), intent(in) :: X(*)
      integer(c_int64_t), intent(inout) :: simplex(*)
      real(c_double), intent(inout) :: weight(*)
      integer(c_int32_t) :: status
    end function cleave_body_locate

    function cleave_field_interpolate(model, body, name, count, simplex, weight, &
        values) bind(C) result(status)
      import :: c_ptr, c_int64_t, c_char, c_double, c_int32_t
      implicit none
      type(c_ptr), value :: model
      integer(c_int64_t), value :: body
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in) :: simplex(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function cleave_field_interpolate
  end interface
end module cleave_c_model
