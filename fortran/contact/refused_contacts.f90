!> Contacts with which an iteration cannot go on.
module litz_refused_contacts
   use litz_contact_points, only: contact_point_t, law_parallel, law_too_curved
   use litz_model, only: model_t
   use litz_text, only: to_text
   implicit none
   private
   public :: refused_contact, elements_of

contains

   !> Why an iteration cannot go on with these contacts; empty where it can. A smaller increment may not come here.
   pure function refused_contact(model, points) result(reason)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: points(:)
      character(len=:), allocatable :: reason
      integer :: i

      reason = ''
      do i = 1, size(points)
         if (.not. points(i)%closed) cycle
         select case (points(i)%law_status)
         case (law_parallel)
            reason = 'wires have become parallel where they touch ('//elements_of(model, points(i))// &
               '): the law of a contact at a point needs wires that cross'
            return
         case (law_too_curved)
            reason = 'a wire is curved about another where they touch ('//elements_of(model, points(i))// &
               ') by nearly their distance: such a contact is not modelled'
            return
         end select
      end do
   end function refused_contact

   !> Both elements of a contact, in words.
   pure function elements_of(model, point) result(words)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: point
      character(len=:), allocatable :: words

      words = 'elements '//to_text(model%element_id(point%element_bar))//' and '// &
         to_text(model%element_id(point%element))
   end function elements_of

end module litz_refused_contacts
