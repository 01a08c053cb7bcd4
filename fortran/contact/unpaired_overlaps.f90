!> Wires that overlap although no contact pair covers them: allowed, but rarely intended.
module litz_unpaired_overlaps
   use litz_kinds, only: dp
   use litz_contact_candidates, only: find_contact_pair
   use litz_contact_joints, only: are_joined
   use litz_contact_points, only: contact_set_t
   use litz_contact_search, only: near_segments
   use litz_departed_contacts, only: surely_overlap
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_text, only: to_text
   use litz_wire_turning, only: wire_turning_t, measure_turning
   use litz_wires, only: wires_t
   implicit none
   private
   public :: describe_unpaired_overlaps

   !> Overlap over the smaller radius that is reported
   real(dp), parameter :: reported_overlap = 0.05_dp
   !> Pairs of elements that are looked at: beyond them nothing is said
   integer, parameter :: max_pairs = 2**27

contains

   !> How many pairs of elements overlap so, with an example; empty: none.
   function describe_unpaired_overlaps(model, wires, elements, contact, x, rotation) result(text)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      character(len=:), allocatable :: text
      type(wire_turning_t) :: turning
      integer, allocatable :: pairs(:, :)
      integer :: i, n, example(2)
      logical :: too_many

      text = ''
      if (all_named(contact)) return
      call near_segments(x(:, model%connectivity(1, :)), x(:, model%connectivity(2, :)), elements%radius, max_pairs, &
         pairs, too_many)
      if (too_many) return
      call measure_turning(model, wires, elements, x, rotation, turning)
      n = 0
      example = 0
      do i = 1, size(pairs, 2)
         if (.not. overlap_unpaired(pairs(1, i), pairs(2, i))) cycle
         n = n + 1
         if (n == 1) example = pairs(:, i)
      end do
      if (n > 0) text = to_text(n)//' pairs of elements overlap that no *CONTACT PAIR names, such as '// &
         to_text(model%element_id(example(1)))//' and '//to_text(model%element_id(example(2)))// &
         ': no contact force acts between them'

   contains

      logical function overlap_unpaired(a, b)
         !> Two elements
         integer, intent(in) :: a, b
         integer :: roles(2), pair

         ! from cheap to dear: this is asked in every increment
         overlap_unpaired = .false.
         if (contact%present) then
            call find_contact_pair(model, wires, contact, a, b, roles, pair)
            if (pair > 0) return
         end if
         if (.not. surely_overlap(model, wires, elements, a, b, x, rotation) > reported_overlap) return
         overlap_unpaired = .not. are_joined(model, wires, elements, turning, a, b)
      end function overlap_unpaired

   end function describe_unpaired_overlaps

   !> A contact pair names every element on both sides.
   pure logical function all_named(contact)
      type(contact_set_t), intent(in) :: contact
      integer :: pair

      all_named = .false.
      if (.not. contact%present) return
      do pair = 1, size(contact%in_bar, 2)
         all_named = all(contact%in_bar(:, pair) .and. contact%in_set(:, pair))
         if (all_named) return
      end do
   end function all_named

end module litz_unpaired_overlaps
