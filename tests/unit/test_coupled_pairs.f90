!> Which candidates the pattern of the matrix couples.
program test_coupled_pairs
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_set_t, contact_point_t
   use litz_coupled_pairs, only: couple_pairs, nodes_of_coupled
   implicit none

   !> Elements of the candidates, and nodes of the elements: a row of elements that have no node in common
   integer, parameter :: n_candidates = 4
   integer, parameter :: connectivity(2, n_candidates + 1) = reshape([1, 2, 3, 4, 5, 6, 7, 8, 9, 10], [2, 5])
   integer :: failures = 0

   call nothing_is_coupled_while_nothing_touches()
   call what_touches_is_coupled_with_what_is_about_to()
   call what_is_coupled_stays_coupled()
   call a_place_of_a_line_couples_its_pair()
   if (failures > 0) error stop 1

contains

   subroutine nothing_is_coupled_while_nothing_touches()
      type(contact_set_t) :: contact
      logical :: grown

      contact = points_with_gaps([1.0e-9_dp, 0.1_dp, 0.2_dp, 0.3_dp])
      call couple_pairs(contact, grown)
      call check(.not. grown .and. .not. any(contact%coupled), 'nothing touches')
   end subroutine nothing_is_coupled_while_nothing_touches

   subroutine what_touches_is_coupled_with_what_is_about_to()
      type(contact_set_t) :: contact
      logical :: grown

      contact = points_with_gaps([0.3_dp, -0.01_dp, 0.01_dp, 0.2_dp])
      call couple_pairs(contact, grown)
      call check(grown .and. all(contact%coupled .eqv. [.false., .true., .true., .false.]), 'touching and near')
      call check(all(nodes_of_coupled(contact, connectivity) == reshape([3, 4, 5, 6, 5, 6, 7, 8], [4, 2])), &
         'nodes of both elements')
   end subroutine what_touches_is_coupled_with_what_is_about_to

   subroutine what_is_coupled_stays_coupled()
      type(contact_set_t) :: contact
      logical :: grown

      contact = points_with_gaps([0.3_dp, 0.3_dp, -0.01_dp, 0.3_dp])
      contact%coupled(1:3) = .true.
      call couple_pairs(contact, grown)
      call check(.not. grown .and. count(contact%coupled) == 3, 'it may touch again')
   end subroutine what_is_coupled_stays_coupled

   !> Also one that only conducts, next to the end of a zone.
   subroutine a_place_of_a_line_couples_its_pair()
      type(contact_set_t) :: contact
      logical :: grown

      contact = points_with_gaps([0.3_dp, 0.3_dp, 0.3_dp, 0.3_dp])
      contact%line_points = contact%points
      contact%points = contact%points(:0)
      contact%line_points(4)%cell_touches = .true.
      call couple_pairs(contact, grown)
      call check(grown .and. contact%coupled(4) .and. count(contact%coupled) == 1, 'it conducts')
   end subroutine a_place_of_a_line_couples_its_pair

   !> A point of each candidate, closed where its gap is negative, of wires with the radius 1.
   function points_with_gaps(gaps) result(contact)
      real(dp), intent(in) :: gaps(n_candidates)
      type(contact_set_t) :: contact
      integer :: i

      allocate (contact%candidates(3, n_candidates), contact%points(n_candidates), contact%line_points(0))
      allocate (contact%coupled(n_candidates), source=.false.)
      contact%candidates = reshape([(i, i + 1, 1, i=1, n_candidates)], [3, n_candidates])
      do i = 1, n_candidates
         contact%points(i)%candidate = i
         contact%points(i)%radius = 1
         contact%points(i)%gap = gaps(i)
         contact%points(i)%closed = gaps(i) < 0
      end do
   end function points_with_gaps

   subroutine check(condition, message)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: message

      if (condition) return
      print '(a)', 'FAILED: '//message
      failures = failures + 1
   end subroutine check

end program test_coupled_pairs
