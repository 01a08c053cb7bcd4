!> What wires cannot have whose spots are given a mean free path of the electrons.
module litz_check_free_path
   use litz_deck, only: token_t
   use litz_model, only: model_t
   use litz_reader, only: reader_t, fail_at
   use litz_text, only: to_text
   implicit none
   private
   public :: check_free_path

contains

   !> As a metal gets warmer, its mean free path falls as its conductivity does: one that is given belongs to one
   !> conductivity.
   subroutine check_free_path(self, model, interaction, element, token, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index into the interactions, 0 after an error; and number of the element in the model
      integer, intent(in) :: interaction, element
      !> The set that it is in
      type(token_t), intent(in) :: token
      !> The element may touch others here
      logical, intent(out) :: ok

      ok = .true.
      if (interaction == 0 .or. model%sections(model%element_section(element))%material == 0) return
      associate (law => model%interactions(interaction), &
         material => model%materials(model%sections(model%element_section(element))%material))
         if (law%spot%free_path_number == 0 .or. .not. allocated(material%resistivity)) return
         ok = .not. law%spot%data(law%spot%free_path_number) > 0 .or. size(material%resistivity, 2) == 1
         if (.not. ok) call fail_at(self, token, 'element '//to_text(model%element_id(element))//' can touch others'// &
            ' here, and its material '//material%name//' has a conductivity over temperature, with which the MEAN'// &
            ' FREE PATH of surface interaction '//law%name//' would change: give rho_l, which does not')
      end associate
   end subroutine check_free_path

end module litz_check_free_path
