!> Contacts that litz does not model, and laws that do not take their data.
module litz_refused_contacts
   use litz_contact_points, only: contact_point_t, law_parallel, law_bad_data, law_too_curved, law_compacts
   use litz_errors, only: error_t, fail, exit_input
   use litz_line_contact, only: line_obstacle
   use litz_model, only: model_t
   use litz_text, only: to_text
   use litz_yielding_spot, only: widest_spot
   implicit none
   private
   public :: refused_contact, refuse_bad_data

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
               '): the law of a contact at a point needs wires that cross'//beside_lines(model, points(i))
            return
         case (law_too_curved)
            reason = 'a wire is curved about another where they touch ('//elements_of(model, points(i))// &
               ') by nearly their distance: such a contact is not modelled'
            return
         case (law_compacts)
            reason = 'the spot of wires that yield ('//elements_of(model, points(i))//') has the area of a circle'// &
               ' of more than '//to_text(widest_spot)//' times the radius of the thinner wire: the metal is'// &
               ' compacted, which YIELD of *SURFACE BEHAVIOR does not describe'//beside_lines(model, points(i))
            return
         end select
      end do
   end function refused_contact

   !> What keeps these wires from touching along a line instead; empty: nothing.
   pure function beside_lines(model, point) result(words)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: point
      character(len=:), allocatable :: words

      words = line_obstacle(model%interactions(model%contact_pairs(point%pair)%interaction))
      if (len(words) > 0) words = '; along a line '//words//' is not possible'
   end function beside_lines

   !> The first contact whose spot law does not take its data; no increment is small enough for that.
   subroutine refuse_bad_data(model, points, error)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: points(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(points)
         if (points(i)%law_status /= law_bad_data) cycle
         associate (law => model%interactions(model%contact_pairs(points(i)%pair)%interaction))
            error = fail(exit_input, 'surface interaction '//law%name//': the data of the spot law '// &
               trim(law%spot%name)//' are not what it needs ('//elements_of(model, points(i))//')')
         end associate
         return
      end do
   end subroutine refuse_bad_data

   !> Both elements of a contact, in words.
   pure function elements_of(model, point) result(words)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: point
      character(len=:), allocatable :: words

      words = 'elements '//to_text(model%element_id(point%element_bar))//' and '// &
         to_text(model%element_id(point%element))
   end function elements_of

end module litz_refused_contacts
