!> The one definition of the deck's dialect: every keyword with its parameters and data lines.
!>
!> Meanings are those of Abaqus, or of CalculiX for *CONTROLS, unless the help text says otherwise.
module litz_keyword_table
   use litz_keywords, only: keyword_table_t
   use litz_contact_keywords, only: add_contact
   use litz_model_keywords, only: add_general, add_mesh, add_constraints, add_initial_values, add_properties
   use litz_step_keywords, only: add_step, add_loads, add_element_loads, add_element_heat, &
      add_given_values, add_output, add_solution
   implicit none
   private
   public :: keyword_table

contains

   !> All keywords, in the order in which a deck usually has them.
   function keyword_table() result(table)
      type(keyword_table_t) :: table

      allocate (table%keywords(64))
      call add_general(table)
      call add_mesh(table)
      call add_constraints(table)
      call add_properties(table)
      call add_contact(table)
      call add_initial_values(table)
      call add_step(table)
      call add_loads(table)
      call add_element_loads(table)
      call add_element_heat(table)
      call add_given_values(table)
      call add_output(table)
      call add_solution(table)
   end function keyword_table

end module litz_keyword_table
