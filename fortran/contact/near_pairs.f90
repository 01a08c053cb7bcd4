!> Which candidates are near enough to have points of line contacts.
!>
!> Neighbours in a strand are candidates all along, and most of them touch nowhere. How far apart the places of two
!> elements are from the other one at least is measured once, and from then on each motion takes from it by how much it
!> can have brought them together. So pairs that stay apart cost a few additions, and have no points.
!>
!> An axis `x(xi) = h1 x1 + h2 x2 + l (h3 t1 + h4 t2)`, with `h1 + h2 = 1` and `|h3| + |h4| <= 1/4`, moves by no more
!> than its nodes and a quarter of its length times its tangents do.
module litz_near_pairs
   use litz_kinds, only: dp
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: near_pairs_t

   !> Bound of |h3| + |h4|
   real(dp), parameter :: bow_of_tangents = 0.25_dp

   type :: near_pairs_t
      !> What the places of each candidate are apart from the other surface at least (n_candidates) [m]
      real(dp), allocatable :: clear(:)
      !> It has points (n_candidates)
      logical, allocatable :: has_points(:)
      !> Where that holds: positions of the nodes (3, n_nodes) [m] and unit tangents of the axes (3, 2, n_elements)
      real(dp), allocatable :: x(:, :), tangents(:, :, :)
   contains
      procedure :: forget
      procedure :: follow
      procedure :: come_near
   end type near_pairs_t

contains

   !> Nothing is known of any pair.
   pure subroutine forget(self, n)
      class(near_pairs_t), intent(inout) :: self
      !> Candidates
      integer, intent(in) :: n

      if (allocated(self%clear)) deallocate (self%clear, self%has_points)
      allocate (self%clear(n), source=-huge(1.0_dp))
      allocate (self%has_points(n), source=.false.)
   end subroutine forget

   !> What the pairs are apart at least in another configuration.
   pure subroutine follow(self, model, wires, elements, candidates, x, rotation)
      class(near_pairs_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> First two rows: elements (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp), allocatable :: tangents(:, :, :), moved(:, :), bow(:)
      integer :: e, side, i

      ! a run that goes on from a restart file has its candidates from there
      if (size(self%clear) /= size(candidates, 2)) call self%forget(size(candidates, 2))
      allocate (tangents(3, 2, model%n_elements))
      do e = 1, model%n_elements
         do side = 1, 2
            tangents(:, side, e) = matmul(rotation(:, :, model%connectivity(side, e)), &
               wires%contact_tangents0(:, side, e))
         end do
      end do
      if (allocated(self%x)) then
         moved = x - self%x
         bow = bow_of_tangents*elements%length*maxval(norm2(tangents - self%tangents, 1), 1)
         do i = 1, size(candidates, 2)
            self%clear(i) = self%clear(i) - approach(model, bow, candidates(1:2, i), moved)
         end do
      end if
      self%x = x
      call move_alloc(tangents, self%tangents)
   end subroutine follow

   !> Which pairs without points a linear step may bring into contact (n_candidates).
   pure function come_near(self, model, elements, candidates, displacement, spin) result(near)
      class(near_pairs_t), intent(in) :: self
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> First two rows: elements (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> Of the nodes (3, n_nodes) [m], [rad]
      real(dp), intent(in) :: displacement(:, :), spin(:, :)
      logical :: near(size(candidates, 2))
      real(dp) :: bow(model%n_elements), turned(size(spin, 2))
      integer :: i

      turned = norm2(spin, 1)
      bow = bow_of_tangents*elements%length*max(turned(model%connectivity(1, :)), turned(model%connectivity(2, :)))
      do i = 1, size(candidates, 2)
         near(i) = .not. self%has_points(i)
         if (near(i)) near(i) = self%clear(i) < approach(model, bow, candidates(1:2, i), displacement)
      end do
   end function come_near

   !> By how much the axes of two elements can have come nearer to each other [m]: the farthest of the nodes of either
   !> from where all four of them have moved on the mean.
   pure real(dp) function approach(model, bow, pair, moved)
      type(model_t), intent(in) :: model
      !> By how much the tangents of each element can have moved its axis (n_elements) [m]
      real(dp), intent(in) :: bow(:)
      !> Elements (2)
      integer, intent(in) :: pair(2)
      !> Displacements of the nodes (3, n_nodes) [m]
      real(dp), intent(in) :: moved(:, :)
      real(dp) :: mean(3)
      integer :: side

      mean = 0
      do side = 1, 2
         mean = mean + moved(:, model%connectivity(1, pair(side))) + moved(:, model%connectivity(2, pair(side)))
      end do
      mean = mean/4
      approach = sum(bow(pair))
      do side = 1, 2
         approach = approach + sqrt(max(sum((moved(:, model%connectivity(1, pair(side))) - mean)**2), &
            sum((moved(:, model%connectivity(2, pair(side))) - mean)**2)))
      end do
   end function approach

end module litz_near_pairs
