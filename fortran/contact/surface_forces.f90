!> The forces of an element on a rigid surface, and their tangent.
!>
!> Source: theory section 12. The law per length is integrated over the parts of the element that overlap, whose ends
!> move with the unknowns: a short lens is seen as well as a long contact, and as the force vanishes at the ends, the
!> integral of the tangent is the tangent of the integral. Where metal that yields has a memory the integral is the sum
!> over its places, which stay where they are: what the wire presses in its dents changes by much as it moves by little.
module litz_surface_forces
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis
   use litz_end_on_surface, only: end_energy
   use litz_gauss, only: six_places, six_weights
   use litz_jets, only: jet_t, variable, constant, composed, operator(-), operator(*)
   use litz_line_law, only: line_force_t, line_force
   use litz_rigid_surface, only: rigid_surface_t, surface_distance, distance_row, distance_hessian
   use litz_surface_cells, only: surface_cell_t, surface_point_t, wire_axis_t
   use litz_surface_dents, only: n_places, has_places, place_of, find_dents, dent_of_end
   use litz_surface_overlap, only: gap_at
   use litz_yielding_place, only: yielding_place_t, place_state_t, state_of_place, force_of_place
   use litz_yielding_spot, only: dent_t, yielding_state_t, state_at_overlap
   implicit none
   private
   public :: press_cell, energies_of_cell, cell_forces, predicted_force

   !> Distance over which the slope at an end is taken, in radii
   real(dp), parameter :: beside_end = 0.1_dp

   !> A round end that nothing is beside.
   type :: end_state_t
      !> Work of the overlap in this increment from no force on, and what yielding dissipates of it [J]
      real(dp) :: work = 0, yielded = 0
      !> F [N], dF/ddelta [N/m], and stiffness of the elastic metal over that
      real(dp) :: force = 0, stiffness = 0, elastic_part = 1
   end type end_state_t

contains

   !> Places at which the wire overlaps, and the forces there.
   subroutine press_cell(surface, axis, penalty, cell)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> eps_l [N/m^2] of `f = eps_l delta`; 0: the elastic law
      real(dp), intent(in) :: penalty
      type(surface_cell_t), intent(inout) :: cell
      type(surface_point_t) :: points(2*size(six_places)*cell%overlap%n + n_places + 4)
      logical :: remembers
      integer :: n, part, i, side

      n = 0
      remembers = cell%yielding%yields .and. has_places(cell%dents)
      do part = 1, cell%overlap%n
         associate (first => cell%overlap%first(part), last => cell%overlap%last(part))
            if (remembers) then
               ! on either side of the memory, where there is none
               call add_part(first, min(last, cell%dents%first))
               call add_part(max(first, cell%dents%last), last)
            else
               call add_part(first, last)
            end if
         end associate
      end do
      if (remembers .and. cell%overlap%n > 0) then
         call find_dents(cell%dents, cell%yielding)
         do i = 1, n_places
            call add(place_of(cell%dents, i), (cell%dents%last - cell%dents%first)/n_places*axis%length/2, i)
         end do
      end if
      cell%length = sum(points(:n)%weight)
      do side = 1, 2
         if (cell%has_end(side)) call add_end(side)
      end do
      cell%points = points(:n)
      cell%force = sum(cell%points%weight*cell%points%normal%force)

   contains

      !> Places of a part that is to overlap, with Gauss's rule.
      subroutine add_part(first, last)
         !> Where it begins and ends; nothing where it ends before
         real(dp), intent(in) :: first, last
         integer :: k

         if (.not. last > first) return
         associate (middle => (first + last)/2, half => (last - first)/2)
            do k = 1, size(six_places)
               call add(middle + half*six_places(k), six_weights(k)*half*axis%length/2, 0)
            end do
         end associate
      end subroutine add_part

      subroutine add(xi, weight, place)
         !> Place, and the length for which it stands [m]
         real(dp), intent(in) :: xi, weight
         !> Of the memory; 0: none
         integer, intent(in) :: place
         type(surface_point_t) :: point
         real(dp) :: slope

         point%xi = xi
         point%weight = weight
         point%place = place
         call gap_at(surface, axis%p, axis%radius, xi, point%gap, slope)
         if (point%gap >= 0) return
         if (cell%yielding%yields) then
            call press_metal_that_yields(cell, point)
            if (.not. point%normal%force > 0) return
         else
            point%normal = line_force(cell%law, -point%gap, penalty)
            point%elastic_stiffness = point%normal%stiffness
         end if
         point%sum_stiffness = point%normal%stiffness
         n = n + 1
         points(n) = point
      end subroutine add

      !> A round end is a sphere on the surface, with a part of the force that goes with the slope from there on: with
      !> the difference of the gaps here and beside.
      subroutine add_end(end)
         !> 1 or 2
         integer, intent(in) :: end
         type(end_state_t) :: whole
         type(jet_t) :: energy, overlap, slope
         real(dp) :: place(2), gap(2), way, of_line

         call end_beside(surface, axis, end, place, gap, way)
         if (gap(1) >= 0) return
         whole = state_of_end(cell, end, -gap(1))
         if (.not. whole%work > 0) return
         overlap = variable(-gap(1), 1)
         slope = (1/way)*(overlap - variable(-gap(2), 2)) - constant(cell%ends(end)%bend*way/2)
         call end_energy(cell%ends(end), composed(overlap, whole%work, whole%force, whole%stiffness), overlap, slope, &
            energy, of_line)
         if (.not. abs(energy%value) > 0) return
         points(n + 1:n + 2)%xi = place
         points(n + 1:n + 2)%gap = gap
         call fill_end(whole, energy, points(n + 1:n + 2))
         ! that has grown with the lens
         points(n + 1)%normal%energy = points(n + 1)%normal%energy - (cell%growth - 1)*of_line
         n = n + 2
      end subroutine add_end

   end subroutine press_cell

   !> An end, and the place beside it with which its slope is taken.
   pure subroutine end_beside(surface, axis, end, place, gap, way)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> 1 or 2
      integer, intent(in) :: end
      !> Places in the element, gaps there [m] (2), and how far they are from each other [m]
      real(dp), intent(out) :: place(2), gap(2), way
      real(dp) :: unused
      integer :: i

      way = min(beside_end*axis%law_radius, axis%length/4)
      place = (2.0_dp*end - 3)*[1.0_dp, 1 - 2*way/axis%length]
      do i = 1, 2
         call gap_at(surface, axis%p, axis%radius, place(i), gap(i), unused)
      end do
   end subroutine end_beside

   !> Forces of an end, at its two places.
   pure subroutine fill_end(whole, energy, points)
      type(end_state_t), intent(in) :: whole
      !> By the overlaps of both
      type(jet_t), intent(in) :: energy
      type(surface_point_t), intent(inout) :: points(2)

      points%weight = 1
      points%at_end = .true.
      points(1)%yielded = energy%value*whole%yielded/whole%work
      points(1)%normal = line_force_t(force=energy%first(1), stiffness=energy%second(1, 1), &
         energy=energy%value - points(1)%yielded)
      points(2)%normal = line_force_t(force=energy%first(2), stiffness=energy%second(2, 2))
      points(2)%coupling = energy%second(1, 2)
      points%sum_stiffness = points%normal%stiffness + points(2)%coupling
      points%elastic_stiffness = points%sum_stiffness*whole%elastic_part
   end subroutine fill_end

   !> Force of metal that yields at a place, without its energy: that takes longer.
   pure subroutine press_metal_that_yields(cell, point)
      type(surface_cell_t), intent(in) :: cell
      !> With its place and gap
      type(surface_point_t), intent(inout) :: point
      type(place_state_t) :: state

      state = force_of_place(place_of_point(cell, point), -point%gap)
      point%normal = line_force_t(force=state%force, stiffness=state%stiffness)
      point%elastic_stiffness = state%elastic_stiffness
   end subroutine press_metal_that_yields

   !> The law of metal that yields at a place, with its dent.
   pure type(yielding_place_t) function place_of_point(cell, point) result(place)
      type(surface_cell_t), intent(in) :: cell
      type(surface_point_t), intent(in) :: point

      place%strip = cell%yielding%strip
      if (point%place > 0) place%dent = cell%yielding%dent(point%place)
   end function place_of_point

   !> Energy of a cell, and what yielding dissipates in this increment (2) [J].
   pure function energies_of_cell(cell) result(energies)
      type(surface_cell_t), intent(in) :: cell
      real(dp) :: energies(2)
      type(place_state_t) :: state
      integer :: i

      energies = 0
      if (.not. allocated(cell%points)) return
      do i = 1, size(cell%points)
         associate (point => cell%points(i))
            if (point%at_end) then
               energies = energies + point%weight*[point%normal%energy, point%yielded]
            else if (.not. cell%yielding%yields) then
               energies(1) = energies(1) + point%weight*point%normal%energy*cell%growth
            else
               state = state_of_place(place_of_point(cell, point), -point%gap)
               energies = energies + point%weight*[state%energy, state%dissipated]
            end if
         end associate
      end do
   end function energies_of_cell

   !> A round end that nothing is beside.
   pure type(end_state_t) function state_of_end(cell, end, overlap) result(state)
      type(surface_cell_t), intent(in) :: cell
      !> 1 or 2
      integer, intent(in) :: end
      !> [m]
      real(dp), intent(in) :: overlap
      type(dent_t) :: dent
      type(yielding_state_t) :: spot

      state%elastic_part = 1
      if (cell%yielding%yields) then
         dent = dent_of_end(cell%dents, cell%yielding, end)
         associate (law => cell%yielding%ends(end))
            spot = state_at_overlap(law, dent, overlap)
            if (.not. spot%force > 0) return
            if (spot%loads) state%yielded = max(spot%dissipation - (dent%work - dent%energy), 0.0_dp)
            state%elastic_part = 2*law%modulus*spot%disc/spot%stiffness
         end associate
         state%work = spot%energy + state%yielded
         state%force = spot%force
         state%stiffness = spot%stiffness
      else
         associate (coefficient => cell%law_of_end(end))
            state%work = 0.4_dp*coefficient*overlap**2.5_dp
            state%force = coefficient*overlap**1.5_dp
            state%stiffness = 1.5_dp*coefficient*sqrt(overlap)
         end associate
      end if
   end function state_of_end

   !> Forces of a cell and their tangent: `R = -W f dg`, `K = W (f' dg dg^T - f d2g)`.
   !>
   !> In the second part of the tangent stands the force that the last step has predicted, where that is smaller: a
   !> deep overlap of an iterate far from balance would bend the tangent without reason.
   pure subroutine cell_forces(surface, axis, cell, k, r)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      type(surface_cell_t), intent(inout) :: cell
      !> Tangent (18, 18), Hessian form, and residual (18)
      real(dp), intent(out) :: k(:, :), r(:)
      real(dp) :: weight(4), w1(4), w2(4), x(3), distance, normal(3), hessian(3, 3), part, before(18)
      integer :: i

      before = 0
      k = 0
      r = 0
      part = 1
      if (cell%predicted >= 0) part = min(1.0_dp, cell%predicted/max(cell%force, tiny(part)))
      do i = 1, size(cell%points)
         associate (point => cell%points(i))
            call axis_shape(axis%interpolation, axis%length, point%xi, weight, w1, w2)
            x = on_axis(weight, axis%x, axis%t)
            call surface_distance(surface, x, distance, normal, hessian)
            point%row = distance_row(weight, axis%t, x - surface%centre, normal)
            r = r - point%weight*point%normal%force*point%row
            k = k + point%weight*stiffness_of(cell, point)*spread(point%row, 2, 18)*spread(point%row, 1, 18) &
               - part*point%weight*point%normal%force &
               *distance_hessian(weight, axis%t, x - surface%centre, normal, hessian)
            if (abs(point%coupling) > 0) k = k + point%coupling*(spread(point%row, 2, 18)*spread(before, 1, 18) &
               + spread(before, 2, 18)*spread(point%row, 1, 18))
            before = point%row
         end associate
      end do
   end subroutine cell_forces

   !> Stiffness in the tangent, per length [N/m^2]. Where a wire has touched against what the last step predicted, that
   !> step knew nothing of the surface and led far too deep into it: the secant leads from there to the overlap that
   !> carries the load. The tangent would lead only a part of the way, as elastic metal is the stiffer the deeper it is
   !> pressed, or off the surface again, as metal that yields is the softer.
   pure real(dp) function stiffness_of(cell, point) result(stiffness)
      type(surface_cell_t), intent(in) :: cell
      type(surface_point_t), intent(in) :: point
      real(dp) :: depth

      stiffness = point%normal%stiffness
      if (point%at_end .or. abs(cell%predicted) > 0) return
      depth = 0
      if (cell%yielding%yields .and. point%place > 0) depth = cell%yielding%dent(point%place)%depth
      stiffness = point%normal%force/(-point%gap - depth)
   end function stiffness_of

   !> Force after a linear step [N].
   pure real(dp) function predicted_force(cell, step) result(force)
      type(surface_cell_t), intent(in) :: cell
      !> Of the unknowns (18)
      real(dp), intent(in) :: step(:)
      real(dp) :: here
      integer :: i

      force = 0
      do i = 1, size(cell%points)
         associate (point => cell%points(i))
            here = point%normal%force - point%sum_stiffness*dot_product(point%row, step)
            if (.not. point%at_end) here = max(0.0_dp, here)
            force = force + point%weight*here
         end associate
      end do
      force = max(0.0_dp, force)
   end function predicted_force

end module litz_surface_forces
