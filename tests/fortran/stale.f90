! A host whose module was compiled for another interface number: refused with a message, before
! anything is done. The build gives this program a copy of the module with another number.
program stale
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use cleave
  use checks, only: refused, finish
  implicit none
  type(cleave_model) :: model
  call refused(cleave_abi_check(), CLEAVE_ABI_MISMATCH, '999')
  call refused(cleave_model_create(model), CLEAVE_ABI_MISMATCH, '999')
  call refused(cleave_model_setup(model), CLEAVE_NULL_ARGUMENT, 'never created')
  call finish()
end program stale
