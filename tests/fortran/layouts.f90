! The bind(C) types are the structs of C: size and offset of every member. Members that are missing,
! swapped or of another kind are found.
program layouts
  use, intrinsic :: iso_c_binding, only: c_int64_t, c_intptr_t, c_ptr, c_loc
  use cleave_c
  use checks, only: require, finish
  implicit none

  interface
    function c_layout(index) bind(C) result(number)
      import :: c_int64_t
      implicit none
      integer(c_int64_t), value :: index
      integer(c_int64_t) :: number
    end function c_layout
  end interface

  integer(c_int64_t) :: place = 0

  call table_entry_layout()
  call parameter_layout()
  call field_layout()
  call network_layout()
  call material_call_layout()
  call body_spec_layout()
  call static_options_layout()
  call static_report_layout()
  call relaxation_options_layout()
  call relaxation_report_layout()
  call event_layout()
  call energies_layout()
  call counts_layout()
  call require(c_layout(place) == -2, 'every struct of C is compared')
  call finish()

contains

  subroutine same(what, first, second)
    character(len=*), intent(in) :: what
    type(c_ptr), intent(in) :: first, second
    integer(c_intptr_t) :: distance
    distance = transfer(second, distance) - transfer(first, distance)
    call require(c_layout(place) == distance, what)
    place = place + 1
  end subroutine same

  subroutine last_member(what)
    character(len=*), intent(in) :: what
    call require(c_layout(place) == -1, what // ' has another member')
    place = place + 1
  end subroutine last_member

  subroutine table_entry_layout()
    type(cleave_table_entry), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_table_entry', b, c_loc(s(2)))
    call same('size of cleave_table_entry', b, c_loc(s(1)%size))
    call same('value of cleave_table_entry', b, c_loc(s(1)%value))
    call same('name of cleave_table_entry', b, c_loc(s(1)%name))
    call same('title of cleave_table_entry', b, c_loc(s(1)%title))
    call same('source of cleave_table_entry', b, c_loc(s(1)%source))
    call last_member('cleave_table_entry')
  end subroutine table_entry_layout

  subroutine parameter_layout()
    type(cleave_parameter), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_parameter', b, c_loc(s(2)))
    call same('size of cleave_parameter', b, c_loc(s(1)%size))
    call same('name of cleave_parameter', b, c_loc(s(1)%name))
    call same('units of cleave_parameter', b, c_loc(s(1)%units))
    call same('description of cleave_parameter', b, c_loc(s(1)%description))
    call same('choices of cleave_parameter', b, c_loc(s(1)%choices))
    call same('default_choice of cleave_parameter', b, c_loc(s(1)%default_choice))
    call same('source of cleave_parameter', b, c_loc(s(1)%source))
    call same('minimum of cleave_parameter', b, c_loc(s(1)%minimum))
    call same('maximum of cleave_parameter', b, c_loc(s(1)%maximum))
    call same('default_value of cleave_parameter', b, c_loc(s(1)%default_value))
    call same('type of cleave_parameter', b, c_loc(s(1)%type))
    call same('minimum_excluded of cleave_parameter', b, c_loc(s(1)%minimum_excluded))
    call same('maximum_excluded of cleave_parameter', b, c_loc(s(1)%maximum_excluded))
    call same('required of cleave_parameter', b, c_loc(s(1)%required))
    call last_member('cleave_parameter')
  end subroutine parameter_layout

  subroutine field_layout()
    type(cleave_field), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_field', b, c_loc(s(2)))
    call same('size of cleave_field', b, c_loc(s(1)%size))
    call same('name of cleave_field', b, c_loc(s(1)%name))
    call same('units of cleave_field', b, c_loc(s(1)%units))
    call same('description of cleave_field', b, c_loc(s(1)%description))
    call same('owner of cleave_field', b, c_loc(s(1)%owner))
    call same('rebuild of cleave_field', b, c_loc(s(1)%rebuild))
    call same('count of cleave_field', b, c_loc(s(1)%count))
    call same('components of cleave_field', b, c_loc(s(1)%components))
    call same('type of cleave_field', b, c_loc(s(1)%type))
    call same('relation of cleave_field', b, c_loc(s(1)%relation))
    call same('lifetime of cleave_field', b, c_loc(s(1)%lifetime))
    call same('output of cleave_field', b, c_loc(s(1)%output))
    call last_member('cleave_field')
  end subroutine field_layout

  subroutine network_layout()
    type(cleave_network), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_network', b, c_loc(s(2)))
    call same('size of cleave_network', b, c_loc(s(1)%size))
    call same('dimension of cleave_network', b, c_loc(s(1)%dimension))
    call same('index_base of cleave_network', b, c_loc(s(1)%index_base))
    call same('particles of cleave_network', b, c_loc(s(1)%particles))
    call same('row_begin of cleave_network', b, c_loc(s(1)%row_begin))
    call same('neighbour of cleave_network', b, c_loc(s(1)%neighbour))
    call same('reverse of cleave_network', b, c_loc(s(1)%reverse))
    call same('zeta of cleave_network', b, c_loc(s(1)%zeta))
    call same('volume of cleave_network', b, c_loc(s(1)%volume))
    call same('vector_point of cleave_network', b, c_loc(s(1)%vector_point))
    call same('vector_component of cleave_network', b, c_loc(s(1)%vector_component))
    call same('tensor_point of cleave_network', b, c_loc(s(1)%tensor_point))
    call same('tensor_component of cleave_network', b, c_loc(s(1)%tensor_component))
    call last_member('cleave_network')
  end subroutine network_layout

  subroutine material_call_layout()
    type(cleave_material_call), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_material_call', b, c_loc(s(2)))
    call same('size of cleave_material_call', b, c_loc(s(1)%size))
    call same('material of cleave_material_call', b, c_loc(s(1)%material))
    call same('kinematics of cleave_material_call', b, c_loc(s(1)%kinematics))
    call same('property_count of cleave_material_call', b, c_loc(s(1)%property_count))
    call same('properties of cleave_material_call', b, c_loc(s(1)%properties))
    call same('first of cleave_material_call', b, c_loc(s(1)%first))
    call same('last of cleave_material_call', b, c_loc(s(1)%last))
    call same('dt of cleave_material_call', b, c_loc(s(1)%dt))
    call same('length of cleave_material_call', b, c_loc(s(1)%length))
    call same('lengths of cleave_material_call', b, c_loc(s(1)%lengths))
    call same('length_point of cleave_material_call', b, c_loc(s(1)%length_point))
    call same('deformation of cleave_material_call', b, c_loc(s(1)%deformation))
    call same('deformation_is_F of cleave_material_call', b, c_loc(s(1)%deformation_is_F))
    call same('stress_measure of cleave_material_call', b, c_loc(s(1)%stress_measure))
    call same('deformation_point of cleave_material_call', b, c_loc(s(1)%deformation_point))
    call same('deformation_component of cleave_material_call', b, c_loc(s(1)%deformation_component))
    call same('deformation_order of cleave_material_call', b, c_loc(s(1)%deformation_order(1)))
    call same('history of cleave_material_call', b, c_loc(s(1)%history))
    call same('history_point of cleave_material_call', b, c_loc(s(1)%history_point))
    call same('history_component of cleave_material_call', b, c_loc(s(1)%history_component))
    call same('stress of cleave_material_call', b, c_loc(s(1)%stress))
    call same('stress_point of cleave_material_call', b, c_loc(s(1)%stress_point))
    call same('stress_component of cleave_material_call', b, c_loc(s(1)%stress_component))
    call same('stress_order of cleave_material_call', b, c_loc(s(1)%stress_order(1)))
    call same('energy of cleave_material_call', b, c_loc(s(1)%energy))
    call same('energy_point of cleave_material_call', b, c_loc(s(1)%energy_point))
    call same('plastic of cleave_material_call', b, c_loc(s(1)%plastic))
    call same('plastic_point of cleave_material_call', b, c_loc(s(1)%plastic_point))
    call same('viscous of cleave_material_call', b, c_loc(s(1)%viscous))
    call same('viscous_point of cleave_material_call', b, c_loc(s(1)%viscous_point))
    call same('failed of cleave_material_call', b, c_loc(s(1)%failed))
    call same('failed_point of cleave_material_call', b, c_loc(s(1)%failed_point))
    call same('tangent of cleave_material_call', b, c_loc(s(1)%tangent))
    call same('tangent_point of cleave_material_call', b, c_loc(s(1)%tangent_point))
    call same('tangent_component of cleave_material_call', b, c_loc(s(1)%tangent_component))
    call same('tangent_measure of cleave_material_call', b, c_loc(s(1)%tangent_measure))
    call same('index_base of cleave_material_call', b, c_loc(s(1)%index_base))
    call last_member('cleave_material_call')
  end subroutine material_call_layout

  subroutine body_spec_layout()
    type(cleave_body_spec), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_body_spec', b, c_loc(s(2)))
    call same('size of cleave_body_spec', b, c_loc(s(1)%size))
    call same('formulation of cleave_body_spec', b, c_loc(s(1)%formulation))
    call same('kinematics of cleave_body_spec', b, c_loc(s(1)%kinematics))
    call same('material of cleave_body_spec', b, c_loc(s(1)%material))
    call same('simplex_nodes of cleave_body_spec', b, c_loc(s(1)%simplex_nodes))
    call same('particles of cleave_body_spec', b, c_loc(s(1)%particles))
    call same('X of cleave_body_spec', b, c_loc(s(1)%X))
    call same('simplex_count of cleave_body_spec', b, c_loc(s(1)%simplex_count))
    call same('simplices of cleave_body_spec', b, c_loc(s(1)%simplices))
    call same('name of cleave_body_spec', b, c_loc(s(1)%name))
    call last_member('cleave_body_spec')
  end subroutine body_spec_layout

  subroutine static_options_layout()
    type(cleave_static_options), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_static_options', b, c_loc(s(2)))
    call same('size of cleave_static_options', b, c_loc(s(1)%size))
    call same('tolerance of cleave_static_options', b, c_loc(s(1)%tolerance))
    call same('max_iterations of cleave_static_options', b, c_loc(s(1)%max_iterations))
    call same('stop_at_limit of cleave_static_options', b, c_loc(s(1)%stop_at_limit))
    call same('solver of cleave_static_options', b, c_loc(s(1)%solver))
    call same('breaking of cleave_static_options', b, c_loc(s(1)%breaking))
    call same('corrections of cleave_static_options', b, c_loc(s(1)%corrections))
    call same('reserved of cleave_static_options', b, c_loc(s(1)%reserved))
    call last_member('cleave_static_options')
  end subroutine static_options_layout

  subroutine static_report_layout()
    type(cleave_static_report), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_static_report', b, c_loc(s(2)))
    call same('size of cleave_static_report', b, c_loc(s(1)%size))
    call same('iterations of cleave_static_report', b, c_loc(s(1)%iterations))
    call same('unknowns of cleave_static_report', b, c_loc(s(1)%unknowns))
    call same('residual of cleave_static_report', b, c_loc(s(1)%residual))
    call same('fraction of cleave_static_report', b, c_loc(s(1)%fraction))
    call same('broken of cleave_static_report', b, c_loc(s(1)%broken))
    call same('critical of cleave_static_report', b, c_loc(s(1)%critical))
    call last_member('cleave_static_report')
  end subroutine static_report_layout

  subroutine relaxation_options_layout()
    type(cleave_relaxation_options), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_relaxation_options', b, c_loc(s(2)))
    call same('size of cleave_relaxation_options', b, c_loc(s(1)%size))
    call same('tolerance of cleave_relaxation_options', b, c_loc(s(1)%tolerance))
    call same('max_iterations of cleave_relaxation_options', b, c_loc(s(1)%max_iterations))
    call same('slice of cleave_relaxation_options', b, c_loc(s(1)%slice))
    call same('breaking of cleave_relaxation_options', b, c_loc(s(1)%breaking))
    call same('reserved of cleave_relaxation_options', b, c_loc(s(1)%reserved))
    call last_member('cleave_relaxation_options')
  end subroutine relaxation_options_layout

  subroutine relaxation_report_layout()
    type(cleave_relaxation_report), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_relaxation_report', b, c_loc(s(2)))
    call same('size of cleave_relaxation_report', b, c_loc(s(1)%size))
    call same('iterations of cleave_relaxation_report', b, c_loc(s(1)%iterations))
    call same('rounds of cleave_relaxation_report', b, c_loc(s(1)%rounds))
    call same('broken of cleave_relaxation_report', b, c_loc(s(1)%broken))
    call same('unknowns of cleave_relaxation_report', b, c_loc(s(1)%unknowns))
    call same('finished of cleave_relaxation_report', b, c_loc(s(1)%finished))
    call same('residual of cleave_relaxation_report', b, c_loc(s(1)%residual))
    call last_member('cleave_relaxation_report')
  end subroutine relaxation_report_layout

  subroutine event_layout()
    type(cleave_event), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_event', b, c_loc(s(2)))
    call same('size of cleave_event', b, c_loc(s(1)%size))
    call same('step of cleave_event', b, c_loc(s(1)%step))
    call same('first of cleave_event', b, c_loc(s(1)%first))
    call same('second of cleave_event', b, c_loc(s(1)%second))
    call same('time of cleave_event', b, c_loc(s(1)%time))
    call same('midpoint of cleave_event', b, c_loc(s(1)%midpoint(1)))
    call same('criterion of cleave_event', b, c_loc(s(1)%criterion))
    call same('limit of cleave_event', b, c_loc(s(1)%limit))
    call same('released of cleave_event', b, c_loc(s(1)%released))
    call last_member('cleave_event')
  end subroutine event_layout

  subroutine energies_layout()
    type(cleave_energies), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_energies', b, c_loc(s(2)))
    call same('size of cleave_energies', b, c_loc(s(1)%size))
    call same('kinetic of cleave_energies', b, c_loc(s(1)%kinetic))
    call same('kinetic_staggered of cleave_energies', b, c_loc(s(1)%kinetic_staggered))
    call same('elastic of cleave_energies', b, c_loc(s(1)%elastic))
    call same('plastic of cleave_energies', b, c_loc(s(1)%plastic))
    call same('stabilisation of cleave_energies', b, c_loc(s(1)%stabilisation))
    call same('fracture of cleave_energies', b, c_loc(s(1)%fracture))
    call same('viscous of cleave_energies', b, c_loc(s(1)%viscous))
    call same('external of cleave_energies', b, c_loc(s(1)%external))
    call same('reaction of cleave_energies', b, c_loc(s(1)%reaction))
    call same('internal of cleave_energies', b, c_loc(s(1)%internal))
    call same('balance of cleave_energies', b, c_loc(s(1)%balance))
    call same('identity of cleave_energies', b, c_loc(s(1)%identity))
    call same('hourglass of cleave_energies', b, c_loc(s(1)%hourglass))
    call last_member('cleave_energies')
  end subroutine energies_layout

  subroutine counts_layout()
    type(cleave_counts), target :: s(2)
    type(c_ptr) :: b
    b = c_loc(s(1))
    call same('size of cleave_counts', b, c_loc(s(2)))
    call same('size of cleave_counts', b, c_loc(s(1)%size))
    call same('particles of cleave_counts', b, c_loc(s(1)%particles))
    call same('bonds of cleave_counts', b, c_loc(s(1)%bonds))
    call same('simplices of cleave_counts', b, c_loc(s(1)%simplices))
    call same('broken of cleave_counts', b, c_loc(s(1)%broken))
    call same('inert of cleave_counts', b, c_loc(s(1)%inert))
    call same('isolated of cleave_counts', b, c_loc(s(1)%isolated))
    call same('inverted of cleave_counts', b, c_loc(s(1)%inverted))
    call last_member('cleave_counts')
  end subroutine counts_layout
end program layouts
