!> Which candidates the pattern of the matrix couples: those that touch or have touched since candidates were
!> collected, and those that are about to. Most pairs of elements that are near never touch: in a mat the pattern of all
!> of them has twice the entries, and its factor takes twice the time.
module litz_coupled_pairs
   use litz_kinds, only: dp
   use litz_contact_forces, only: enters_system
   use litz_contact_points, only: contact_set_t, contact_point_t
   implicit none
   private
   public :: couple_pairs, nodes_of_coupled

   !> A gap below this part of the mean radius is about to close: it is coupled when another pair must be, so that the
   !> pattern changes seldom
   real(dp), parameter :: about_to_close = 0.05_dp

contains

   !> Couple the pairs of elements that touch.
   pure subroutine couple_pairs(contact, grown)
      !> With the points of this iterate
      type(contact_set_t), intent(inout) :: contact
      !> A pair touches that was not coupled
      logical, intent(out) :: grown

      grown = any(lacks_coupling(contact%points)) .or. any(lacks_coupling(contact%line_points))
      if (.not. grown) return
      call couple(contact%points, contact%coupled)
      call couple(contact%line_points, contact%coupled)

   contains

      elemental logical function lacks_coupling(point)
         type(contact_point_t), intent(in) :: point

         lacks_coupling = enters_system(point)
         if (lacks_coupling) lacks_coupling = .not. contact%coupled(point%candidate)
      end function lacks_coupling

   end subroutine couple_pairs

   !> Couple the pairs of points that touch or are about to.
   pure subroutine couple(points, coupled)
      type(contact_point_t), intent(in) :: points(:)
      !> (n_candidates)
      logical, intent(inout) :: coupled(:)
      integer :: i

      do i = 1, size(points)
         associate (point => points(i))
            coupled(point%candidate) = coupled(point%candidate) .or. enters_system(point) .or. &
               point%gap < about_to_close*sum(point%radius)/2
         end associate
      end do
   end subroutine couple

   !> Nodes of the pairs of elements that are coupled (4, n).
   pure function nodes_of_coupled(contact, connectivity) result(nodes)
      type(contact_set_t), intent(in) :: contact
      !> Nodes of the elements (2, n_elements)
      integer, intent(in) :: connectivity(:, :)
      integer, allocatable :: nodes(:, :)
      integer :: i, n

      allocate (nodes(4, count(contact%coupled)))
      n = 0
      do i = 1, size(contact%coupled)
         if (.not. contact%coupled(i)) cycle
         n = n + 1
         nodes(:, n) = reshape(connectivity(:, contact%candidates(1:2, i)), [4])
      end do
   end function nodes_of_coupled

end module litz_coupled_pairs
