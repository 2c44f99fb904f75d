
! What people use. Every function of cleave.h has its name here and returns the status.
module cleave
  use cleave_constants
  use cleave_described, only: cleave_table_entry, cleave_parameter, cleave_field, cleave_version, &
      cleave_abi_check, cleave_last_message, cleave_set_last_message, cleave_status_text, &
      cleave_table_find, cleave_field_table_fingerprint
  use cleave_listings_int32
  use cleave_listings_int64
  use cleave_networks, only: cleave_network, cleave_network_init, cleave_network_rows, &
      cleave_network_bonds
  use cleave_arrays_int32
  use cleave_arrays_int64
  use cleave_materials
  use cleave_models, only: cleave_model, cleave_model_create, cleave_model_destroy, &
      cleave_model_set_order, cleave_model_setup, cleave_model_stable_step, &
      cleave_model_is_stable, cleave_model_initialise, &
      cleave_model_advance, cleave_model_update, cleave_static_options, cleave_static_report, &
      cleave_static_options_init, cleave_model_solve_static, cleave_model_break_static, &
      cleave_relaxation_options, &
      cleave_relaxation_report, cleave_relaxation_options_init, cleave_model_relax, &
      cleave_model_relax_cancel
  use cleave_specs
  use cleave_bodies_int32
  use cleave_bodies_int64
  use cleave_state_int32
  use cleave_state_int64
  use cleave_fields_int32
  use cleave_fields_int64
  implicit none
  public
end module cleave
