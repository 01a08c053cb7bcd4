!> How far to go along a Newton step so that the energy of wires side by side falls.
!>
!> Along wires that just touch, points close and open in numbers in each iteration, and the set of closed ones may
!> cycle. The energy is convex in their gaps: with a step that ends where it is least along its direction, Newton's
!> method comes to the solution from anywhere. All but these points is linear along a step `d`, so that with the
!> residual `R` of the iteration and `S = R.d = d.K.d` the slope of the energy at the fraction `eta` of the step is
!> `-(1 - eta) S + sum (F(g) - F(g + eta dg) - eta k dg) dg`, with the gap `g` and the stiffness `k` about which the
!> iteration has linearised a point. Source: theory (10.22).
module litz_contact_descent
   use litz_communicator, only: communicator_t
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t
   use litz_fields, only: motion_slots
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_place_forces, only: place_law_t, law_of_place
   implicit none
   private
   public :: descent_fraction

   !> Slope at the end of the step over that at its start that is left alone
   real(dp), parameter :: small_slope = 0.5_dp
   !> The fraction is known to this, or the slope vanishes to this part of that at the start of the step
   real(dp), parameter :: accurate = 1.0e-6_dp
   integer, parameter :: max_chords = 60
   !> Of a step, at least
   real(dp), parameter :: least_fraction = 1.0e-3_dp

contains

   !> The fraction of a step, at most 1, at which the energy is least.
   real(dp) function descent_fraction(processes, model, points, residual, step) result(eta)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      !> Of line contacts
      type(contact_point_t), intent(in) :: points(:)
      !> External minus internal forces of the iteration, and its linear step (n_slots, n_nodes)
      real(dp), intent(in) :: residual(:, :), step(:, :)
      !> Gaps that the iteration has started from, their change in the whole step [m], and S [J]
      real(dp) :: gap(size(points)), dgap(size(points)), work
      logical :: acts(size(points))
      integer :: i

      eta = 1
      if (.not. processes%any(size(points) > 0)) return
      ! S
      work = processes%sum(sum(processes%own_part(residual(motion_slots(1):motion_slots(2), :) &
         *step(motion_slots(1):motion_slots(2), :))))
      if (.not. work > 0) return
      acts = .false.
      !$omp parallel do schedule(static) if (size(points) >= worth_threads)
      do i = 1, size(points)
         associate (point => points(i))
            if (.not. point%weight > 0) cycle
            gap(i) = merge(point%predicted_gap, point%gap, point%predicted)
            dgap(i) = point%gap - gap(i) + dot_product(point%kinematics%dgap, &
               reshape(step(motion_slots(1):motion_slots(2), [model%connectivity(:, point%element_bar), &
               model%connectivity(:, point%element)]), [n_motions]))
            ! what stays open all the way has no part in it
            acts(i) = min(gap(i), gap(i) + dgap(i)) < 0 .or. abs(point%mixed_force) > 0 .or. abs(point%stiffness) > 0
         end associate
      end do
      !$omp end parallel do
      if (slope(1.0_dp) <= small_slope*work) return
      eta = max(zero_of_slope(), least_fraction)

   contains

      !> By chords; an end that stays twice counts half (the Illinois rule). The slope grows with the fraction.
      real(dp) function zero_of_slope() result(zero)
         real(dp) :: lower, upper, of_lower, of_upper, here
         integer :: n, moved

         moved = 0
         lower = 0
         upper = 1
         of_lower = slope(lower)
         of_upper = slope(upper)
         zero = 0
         do n = 1, max_chords
            if (.not. (of_lower < 0 .and. upper - lower > accurate)) exit
            zero = upper - of_upper*(upper - lower)/(of_upper - of_lower)
            here = slope(zero)
            if (abs(here) <= accurate*work) exit
            if (here > 0) then
               upper = zero
               of_upper = here
               if (moved == 1) of_lower = of_lower/2
               moved = 1
            else
               lower = zero
               of_lower = here
               if (moved == -1) of_upper = of_upper/2
               moved = -1
            end if
         end do
      end function zero_of_slope

      !> Of the energy, at a fraction of the step [J].
      real(dp) function slope(fraction)
         !> [-]
         real(dp), intent(in) :: fraction
         type(place_law_t) :: law
         !> Of each point: added in their order, so that the sum is the same with any number of threads
         real(dp) :: part(size(points))
         integer :: k

         part = 0
         !$omp parallel do schedule(static) private(law) if (size(points) >= worth_threads)
         do k = 1, size(points)
            if (.not. acts(k)) cycle
            associate (point => points(k))
               law = law_of_place(point, -(gap(k) + fraction*dgap(k)), model%interactions( &
                  model%contact_pairs(point%pair)%interaction)%normal%line_penalty())
               part(k) = (point%mixed_force - law%force - fraction*point%stiffness*dgap(k))*dgap(k)
            end associate
         end do
         !$omp end parallel do
         slope = sum(part)
         if (processes%process == 1) slope = slope - (1 - fraction)*work
         slope = processes%sum(slope)
      end function slope

   end function descent_fraction

end module litz_contact_descent
