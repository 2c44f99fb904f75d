
! The model handle: its life, its steps.
module cleave_models
  use, intrinsic :: iso_c_binding, only: c_int8_t, c_int32_t, c_int64_t, c_double, c_ptr, &
      c_null_ptr, c_associated, c_loc
  use cleave_constants
  use cleave_support, only: refuse
  use cleave_c, only: c_create => cleave_model_create, &
      c_index_base => cleave_model_set_index_base, c_destroy => cleave_model_destroy, &
      c_setup => cleave_model_setup, c_stable_step => cleave_model_stable_step, &
      c_order => cleave_model_set_order, c_is_stable => cleave_model_is_stable, &
      c_initialise => cleave_model_initialise, c_advance => cleave_model_advance, &
      c_update => cleave_model_update, c_solve => cleave_model_solve_static, &
      c_break => cleave_model_break_static, &
      c_options_init => cleave_static_options_init, cleave_static_options, &
      c_report => cleave_static_report, &
      c_relax_init => cleave_relaxation_options_init, c_relax => cleave_model_relax, &
      c_cancel => cleave_model_relax_cancel, cleave_relaxation_options, &
      c_relaxed => cleave_relaxation_report
  implicit none
  private
  public :: cleave_model, handle_of, ready
  public :: cleave_model_create, cleave_model_destroy, cleave_model_set_order, &
      cleave_model_setup, cleave_model_stable_step, cleave_model_is_stable, &
      cleave_model_initialise, cleave_model_advance, cleave_model_update
  public :: cleave_static_options, cleave_static_report, cleave_static_options_init, &
      cleave_model_solve_static, cleave_model_break_static
  public :: cleave_relaxation_options, cleave_relaxation_report, cleave_relaxation_options_init, &
      cleave_model_relax, cleave_model_relax_cancel

  ! A copy of it names the same model; destroy it once.
  type :: cleave_model
    private
    type(c_ptr) :: handle = c_null_ptr
  end type cleave_model

  type :: cleave_static_report
    integer(c_int64_t) :: iterations = 0
    integer(c_int64_t) :: unknowns = 0
    real(c_double) :: residual = 0
    real(c_double) :: fraction = 0
    integer(c_int64_t) :: broken = 0
    integer(c_int64_t) :: critical = 0
  end type cleave_static_report

  type :: cleave_relaxation_report
    integer(c_int64_t) :: iterations = 0
    integer(c_int64_t) :: rounds = 0
    integer(c_int64_t) :: broken = 0
    integer(c_int64_t) :: unknowns = 0
    logical :: finished = .false.
    real(c_double) :: residual = 0
  end type cleave_relaxation_report

  interface cleave_model_create
    module procedure model_create
  end interface cleave_model_create
  interface cleave_model_destroy
    module procedure model_destroy
  end interface cleave_model_destroy
  interface cleave_model_setup
    module procedure model_setup
  end interface cleave_model_setup
  interface cleave_model_stable_step
    module procedure model_stable_step
  end interface cleave_model_stable_step
  interface cleave_model_set_order
    module procedure model_set_order
  end interface cleave_model_set_order
  interface cleave_model_is_stable
    module procedure model_is_stable
  end interface cleave_model_is_stable
  interface cleave_model_initialise
    module procedure model_initialise
  end interface cleave_model_initialise
  interface cleave_model_advance
    module procedure model_advance
  end interface cleave_model_advance
  interface cleave_model_update
    module procedure model_update
  end interface cleave_model_update
  interface cleave_static_options_init
    module procedure static_options_init
  end interface cleave_static_options_init
  interface cleave_model_solve_static
    module procedure model_solve_static
  end interface cleave_model_solve_static
  interface cleave_model_break_static
    module procedure model_break_static
  end interface cleave_model_break_static
  interface cleave_relaxation_options_init
    module procedure relaxation_options_init
  end interface cleave_relaxation_options_init
  interface cleave_model_relax
    module procedure model_relax
  end interface cleave_model_relax
  interface cleave_model_relax_cancel
    module procedure model_relax_cancel
  end interface cleave_model_relax_cancel

contains

  recursive function handle_of(model) result(handle)
    type(cleave_model), intent(in) :: model
    type(c_ptr) :: handle
    handle = model%handle
  end function handle_of

  recursive function ready(procedure, model) result(status)
    character(len=*), intent(in) :: procedure
    type(cleave_model), intent(in) :: model
    integer(c_int32_t) :: status
    status = CLEAVE_OK
    if (c_associated(model%handle)) return
    status = refuse(CLEAVE_NULL_ARGUMENT, procedure, 'the model does not exist: it was never ' // &
        'created or is destroyed; call cleave_model_create first')
  end function ready

  ! Fails with ABI_MISMATCH if this module was compiled for another interface than the library's.
  recursive function model_create(model) result(status)
    type(cleave_model), intent(inout) :: model
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    if (c_associated(model%handle)) then
      status = refuse(CLEAVE_WRONG_ORDER, 'cleave_model_create', &
          'this variable holds a model already; call cleave_model_destroy first')
      return
    end if
    handle = c_null_ptr
    status = c_create(CLEAVE_ABI_VERSION, handle)
    if (status == CLEAVE_OK) status = c_index_base(handle, 1_c_int32_t)
    if (status == CLEAVE_OK) model%handle = handle
  end function model_create

  ! A model that does not exist is left alone.
  recursive function model_destroy(model) result(status)
    type(cleave_model), intent(inout) :: model
    integer(c_int32_t) :: status
    status = c_destroy(model%handle)
    model%handle = c_null_ptr
  end function model_destroy

  recursive function model_setup(model) result(status)
    type(cleave_model), intent(in) :: model
    integer(c_int32_t) :: status
    status = ready('cleave_model_setup', model)
    if (status == CLEAVE_OK) status = c_setup(model%handle)
  end function model_setup

  recursive function model_stable_step(model, step) result(status)
    type(cleave_model), intent(in) :: model
    real(c_double), intent(inout) :: step
    integer(c_int32_t) :: status
    status = ready('cleave_model_stable_step', model)
    if (status == CLEAVE_OK) status = c_stable_step(model%handle, step)
  end function model_stable_step

  ! order: CLEAVE_ORDER_BLOCKS or CLEAVE_ORDER_ROWS
  recursive function model_set_order(model, order) result(status)
    type(cleave_model), intent(in) :: model
    integer(c_int32_t), intent(in) :: order
    integer(c_int32_t) :: status
    status = ready('cleave_model_set_order', model)
    if (status == CLEAVE_OK) status = c_order(model%handle, order)
  end function model_set_order

  ! stable: 1 or 0
  recursive function model_is_stable(model, dt, stable) result(status)
    type(cleave_model), intent(in) :: model
    real(c_double), intent(in) :: dt
    integer(c_int32_t), intent(inout) :: stable
    integer(c_int32_t) :: status
    status = ready('cleave_model_is_stable', model)
    if (status == CLEAVE_OK) status = c_is_stable(model%handle, dt, stable)
  end function model_is_stable

  recursive function model_initialise(model, time) result(status)
    type(cleave_model), intent(in) :: model
    real(c_double), intent(in) :: time
    integer(c_int32_t) :: status
    status = ready('cleave_model_initialise', model)
    if (status == CLEAVE_OK) status = c_initialise(model%handle, time)
  end function model_initialise

  recursive function model_advance(model, dt, time_new) result(status)
    type(cleave_model), intent(in) :: model
    real(c_double), intent(in) :: dt, time_new
    integer(c_int32_t) :: status
    status = ready('cleave_model_advance', model)
    if (status == CLEAVE_OK) status = c_advance(model%handle, dt, time_new)
  end function model_advance

  recursive function model_update(model) result(status)
    type(cleave_model), intent(in) :: model
    integer(c_int32_t) :: status
    status = ready('cleave_model_update', model)
    if (status == CLEAVE_OK) status = c_update(model%handle)
  end function model_update

  recursive function static_options_init(options) result(status)
    type(cleave_static_options), intent(out) :: options
    integer(c_int32_t) :: status
    status = c_options_init(options)
  end function static_options_init

  recursive function model_solve_static(model, time_new, options, report) result(status)
    type(cleave_model), intent(in) :: model
    real(c_double), intent(in) :: time_new
    type(cleave_static_options), intent(in), target, optional :: options
    type(cleave_static_report), intent(inout), optional :: report
    integer(c_int32_t) :: status
    type(c_report), target :: answer
    type(c_ptr) :: chosen
    status = ready('cleave_model_solve_static', model)
    if (status /= CLEAVE_OK) return
    chosen = c_null_ptr
    if (present(options)) chosen = c_loc(options)
    answer%size = size(transfer(answer, [0_c_int8_t]), kind=c_int64_t)
    status = c_solve(model%handle, time_new, chosen, c_loc(answer))
    if (status == CLEAVE_OK .and. present(report)) report = static_report(answer)
  end function model_solve_static

  recursive function model_break_static(model, options, report) result(status)
    type(cleave_model), intent(in) :: model
    type(cleave_static_options), intent(in), target, optional :: options
    type(cleave_static_report), intent(inout), optional :: report
    integer(c_int32_t) :: status
    type(c_report), target :: answer
    type(c_ptr) :: chosen
    status = ready('cleave_model_break_static', model)
    if (status /= CLEAVE_OK) return
    chosen = c_null_ptr
    if (present(options)) chosen = c_loc(options)
    answer%size = size(transfer(answer, [0_c_int8_t]), kind=c_int64_t)
    status = c_break(model%handle, chosen, c_loc(answer))
    if (status == CLEAVE_OK .and. present(report)) report = static_report(answer)
  end function model_break_static

  pure recursive function static_report(answer) result(report)
    type(c_report), intent(in) :: answer
    type(cleave_static_report) :: report
    report%iterations = answer%iterations
    report%unknowns = answer%unknowns
    report%residual = answer%residual
    report%fraction = answer%fraction
    report%broken = answer%broken
    report%critical = answer%critical
  end function static_report

  recursive function relaxation_options_init(options) result(status)
    type(cleave_relaxation_options), intent(out) :: options
    integer(c_int32_t) :: status
    status = c_relax_init(options)
  end function relaxation_options_init

  recursive function model_relax(model, time_new, options, report) result(status)
    type(cleave_model), intent(in) :: model
    real(c_double), intent(in) :: time_new
    type(cleave_relaxation_options), intent(in), target, optional :: options
    type(cleave_relaxation_report), intent(inout), optional :: report
    integer(c_int32_t) :: status
    type(c_relaxed), target :: answer
    type(c_ptr) :: chosen
    status = ready('cleave_model_relax', model)
    if (status /= CLEAVE_OK) return
    chosen = c_null_ptr
    if (present(options)) chosen = c_loc(options)
    answer%size = size(transfer(answer, [0_c_int8_t]), kind=c_int64_t)
    status = c_relax(model%handle, time_new, chosen, c_loc(answer))
    if (status /= CLEAVE_OK .or. .not. present(report)) return
    report%iterations = answer%iterations
    report%rounds = answer%rounds
    report%broken = answer%broken
    report%unknowns = answer%unknowns
    report%finished = answer%finished /= 0
    report%residual = answer%residual
  end function model_relax

  recursive function model_relax_cancel(model) result(status)
    type(cleave_model), intent(in) :: model
    integer(c_int32_t) :: status
    status = ready('cleave_model_relax_cancel', model)
    if (status == CLEAVE_OK) status = c_cancel(model%handle)
  end function model_relax_cancel
end module cleave_models
