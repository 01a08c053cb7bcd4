!> An element over a rigid surface: where it overlaps, with which forces, and their tangent.
!>
!> Source: theory section 12. The law per length is integrated over the parts of the element that overlap, whose ends
!> move with the unknowns: a short lens is seen as well as a long contact, and as the force vanishes at the ends, the
!> integral of the tangent is the tangent of the integral.
module litz_surface_cells
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, axis_sagitta, on_axis
   use litz_friction_iteration, only: friction_iteration_t
   use litz_friction_law, only: friction_law_t, friction_start_t
   use litz_jets, only: jet_t, variable, constant, operator(-), operator(*)
   use litz_line_law, only: line_wires_t, line_force_t, line_force
   use litz_rigid_line, only: rigid_line, rigid_end, end_energy
   use litz_rigid_surface, only: rigid_surface_t, surface_distance, distance_row, distance_hessian
   use litz_rotations, only: cross
   use litz_state, only: surface_contact_t
   use litz_surface_choices, only: surface_plane, surface_bore
   use litz_surface_overlap, only: surface_overlap_t, find_surface_overlap, gap_at
   implicit none
   private
   public :: surface_cell_t, surface_memory_t, surface_point_t, wire_axis_t, survey_cell, law_of_cell, &
      laws_of_ends, bends_at_ends, press_cell, cell_forces, predicted_force, contact_of_cell, centre_of_force, &
         advanced_memory

   !> Gauss's rule of six points
   real(dp), parameter :: gauss_place(6) = [-0.93246951420315202781_dp, -0.66120938646626451366_dp, &
      -0.23861918608319690863_dp, 0.23861918608319690863_dp, 0.66120938646626451366_dp, 0.93246951420315202781_dp]
   real(dp), parameter :: gauss_weight(6) = [0.17132449237917034504_dp, 0.36076157304813860757_dp, &
      0.46791393457269104739_dp, 0.46791393457269104739_dp, 0.36076157304813860757_dp, 0.17132449237917034504_dp]

   !> Unit of length, in radii, of an overlap from the end of a wire on: up to two of them the end carries it, from six
   !> on the wire beside it
   real(dp), parameter :: resolution = 0.26_dp
   !> Distance over which the slope at an end is taken, in radii
   real(dp), parameter :: beside_end = 0.1_dp

   !> The axis of an element as it is now.
   type :: wire_axis_t
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer :: interpolation = 0
      !> Reference length and radius [m]
      real(dp) :: length = 0, radius = 0
      !> Positions [m] and unit tangents of the nodes (3, 2), and the axis in powers of xi (3, 0:3) [m]
      real(dp) :: x(3, 2) = 0, t(3, 2) = 0, p(3, 0:3) = 0
   end type wire_axis_t

   !> A place at which the wire overlaps the surface.
   type :: surface_point_t
      !> Place in the element, and the length for which it stands [m]
      real(dp) :: xi = 0, weight = 0
      !> Gap [m], negative
      real(dp) :: gap = 0
      !> Per length; of an end its force, with the weight 1
      type(line_force_t) :: normal
      !> How the gap changes with the unknowns
      real(dp) :: row(18) = 0
      !> How its force changes with the overlap of the point before it, and that one's with this [N/m]
      real(dp) :: coupling = 0
   end type surface_point_t

   !> What a cell remembers of the last converged state; all 0: it did not touch.
   type :: surface_memory_t
      logical :: closed = .false.
      !> Traction along and across the wire, force, stiffness and energy of the tangential spring
      type(friction_start_t) :: start
      !> Path of the slip [m] and heat of friction [J] since the contact closed
      real(dp) :: slip_path = 0, dissipation = 0
      !> Of the overlap [J]
      real(dp) :: energy = 0
      !> Work of friction in the last increment [J]; also of a cell that has opened in it
      real(dp) :: last_dissipation = 0
   end type surface_memory_t

   type :: surface_cell_t
      !> Element, and pair of the model that it belongs to
      integer :: element = 0, pair = 0
      !> The element has the round end of its wire, or the round joint of a kink, at its first, at its second node (2)
      logical :: has_end(2) = .false.
      !> The law at the smallest gap: that of a state in balance, held fixed while the iteration goes there
      type(line_wires_t) :: law
      !> Force of either end over the overlap to the power of 3/2 (2) [N/m^1.5], and curvature of the distance there
      !> [1/m]
      real(dp) :: law_of_end(2) = 0, bend_of_end(2) = 0
      !> As last surveyed
      type(surface_overlap_t) :: overlap
      !> As last evaluated
      type(surface_point_t), allocatable :: points(:)
      !> Force [N] and energy [J] of all points
      real(dp) :: force = 0, energy = 0
      !> Force that the last step has predicted [N]; negative: there was none
      real(dp) :: predicted = -1
      type(surface_memory_t) :: memory
      !> Friction acts at the place `xi` in this increment, where that is known; part of its slip that counts, since the
      !> contact has closed
      logical :: has_place = .false.
      real(dp) :: xi = 0, part = 1
      !> Friction, with the stiffness of its spring [N/m], which is held fixed as the law is, and the force on the wire
      !> (3) [N]
      type(friction_law_t) :: friction
      type(friction_iteration_t) :: iteration
      real(dp) :: stick_stiffness = 0, traction(3) = 0
      !> Work of friction in this increment [J]
      real(dp) :: friction_work = 0
      !> Forces and moments on the surface about its centre, with friction (6) [N, N m]
      real(dp) :: on_surface(6) = 0
   end type surface_cell_t

contains

   !> Find out where the element overlaps.
   pure subroutine survey_cell(surface, axis, reach, cell)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> Gap beyond which nothing is asked [m]
      real(dp), intent(in) :: reach
      type(surface_cell_t), intent(inout) :: cell
      real(dp) :: distance, normal(3), extent

      call surface_distance(surface, (axis%x(:, 1) + axis%x(:, 2))/2, distance, normal)
      extent = norm2(axis%x(:, 2) - axis%x(:, 1))/2 + axis_sagitta(axis%p)
      cell%overlap = surface_overlap_t()
      if (distance - axis%radius - extent > reach) return
      call find_surface_overlap(surface, axis%p, axis%radius, cell%overlap)
   end subroutine survey_cell

   !> The law at the place of an element that is nearest to the surface, by the relative curvatures there.
   pure type(line_wires_t) function law_of_cell(surface, axis, young, poisson, xi) result(law)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> Of the wire [Pa], [-], and the place
      real(dp), intent(in) :: young, poisson, xi
      real(dp) :: x1(3), x2(3), distance, normal(3), hessian(3, 3), tangent(3), bend, opening, e(2), curvature

      associate (p => axis%p)
         call surface_distance(surface, p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3))), distance, normal, hessian)
         x1 = p(:, 1) + xi*(2*p(:, 2) + xi*3*p(:, 3))
         x2 = 2*p(:, 2) + xi*6*p(:, 3)
      end associate
      bend = dot_product(normal, x2)/dot_product(x1, x1)
      opening = bend + dot_product(x1, matmul(hessian, x1))/dot_product(x1, x1)            ! D''
      tangent = x1 - normal*dot_product(normal, x1)
      tangent = tangent/max(norm2(tangent), tiny(1.0_dp))
      curvature = 0
      if (surface%shape /= surface_plane) curvature = merge(-1, 1, surface%shape == surface_bore)/surface%radius
      ! the direction in which the surface is curved, along and across the wire
      e = [dot_product(cross(surface%direction, normal), tangent), dot_product(surface%direction, tangent)]
      law = rigid_line(axis%radius, young, poisson, across=1/axis%radius + curvature*e(2)**2, &
         along=bend/max(1 + bend*axis%radius, 0.5_dp) + curvature*e(1)**2, mixed=curvature*e(1)*e(2), opening=opening)
   end function law_of_cell

   !> Force of the ends over their overlap to the power of 3/2 (2) [N/m^1.5].
   pure function laws_of_ends(surface, axis, young, poisson, penalty, has_end) result(laws)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> Of both ends of the wire (2) [Pa], [-], and eps_l [N/m^2] or 0
      real(dp), intent(in) :: young(2), poisson(2), penalty
      !> (2)
      logical, intent(in) :: has_end(2)
      real(dp) :: laws(2), curvature
      integer :: side

      curvature = 0
      if (surface%shape /= surface_plane) curvature = merge(-1, 1, surface%shape == surface_bore)/surface%radius
      laws = 0
      do side = 1, 2
         if (has_end(side)) laws(side) = rigid_end(axis%radius, young(side), poisson(side), penalty, curvature)
      end do
   end function laws_of_ends

   !> Curvature of the distance along the wire at its ends (2) [1/m].
   pure function bends_at_ends(surface, axis) result(bend)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      real(dp) :: bend(2), x1(3), x2(3), distance, normal(3), hessian(3, 3), xi
      integer :: side

      do side = 1, 2
         xi = 2.0_dp*side - 3
         associate (p => axis%p)
            call surface_distance(surface, p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3))), distance, normal, &
               hessian)
            x1 = p(:, 1) + xi*(2*p(:, 2) + xi*3*p(:, 3))
            x2 = 2*p(:, 2) + xi*6*p(:, 3)
         end associate
         bend(side) = (dot_product(normal, x2) + dot_product(x1, matmul(hessian, x1)))/dot_product(x1, x1)     ! k
      end do
   end function bends_at_ends

   !> Places at which the wire overlaps, and the forces there.
   subroutine press_cell(surface, axis, penalty, cell)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> eps_l [N/m^2] of `f = eps_l delta`; 0: the elastic law
      real(dp), intent(in) :: penalty
      type(surface_cell_t), intent(inout) :: cell
      type(surface_point_t) :: points(size(gauss_place)*cell%overlap%n + 4)
      real(dp) :: middle, half
      integer :: n, part, i, side

      n = 0
      do part = 1, cell%overlap%n
         middle = (cell%overlap%first(part) + cell%overlap%last(part))/2
         half = (cell%overlap%last(part) - cell%overlap%first(part))/2
         do i = 1, size(gauss_place)
            call add(middle + half*gauss_place(i), gauss_weight(i)*half*axis%length/2)
         end do
      end do
      do side = 1, 2
         if (cell%has_end(side)) call add_end(2.0_dp*side - 3)
      end do
      cell%points = points(:n)
      cell%force = sum(cell%points%weight*cell%points%normal%force)
      cell%energy = sum(cell%points%weight*cell%points%normal%energy)

   contains

      subroutine add(xi, weight)
         !> Place, and the length for which it stands [m]
         real(dp), intent(in) :: xi, weight
         real(dp) :: gap, slope

         call gap_at(surface, axis%p, axis%radius, xi, gap, slope)
         if (gap >= 0) return
         n = n + 1
         points(n)%xi = xi
         points(n)%weight = weight
         points(n)%gap = gap
         points(n)%normal = line_force(cell%law, -gap, penalty)
      end subroutine add

      !> A round end is a sphere on the surface, with a part of the force that goes with the slope from there on: with
      !> the difference of the gaps here and beside.
      subroutine add_end(xi)
         !> -1 or 1
         real(dp), intent(in) :: xi
         type(jet_t) :: energy, overlap, slope
         real(dp) :: gap(2), beside, way, unused

         way = min(beside_end*axis%radius, axis%length/4)
         beside = xi*(1 - 2*way/axis%length)
         call gap_at(surface, axis%p, axis%radius, xi, gap(1), unused)
         if (gap(1) >= 0) return
         call gap_at(surface, axis%p, axis%radius, beside, gap(2), unused)
         associate (end => merge(1, 2, xi < 0))
            overlap = variable(-gap(1), 1)
            slope = (1/way)*(overlap - variable(-gap(2), 2)) - constant(cell%bend_of_end(end)*way/2)
            energy = end_energy(cell%law_of_end(end), cell%bend_of_end(end), resolution*axis%radius, overlap, slope)
         end associate
         if (.not. energy%value > 0) return
         points(n + 1:n + 2)%xi = [xi, beside]
         points(n + 1:n + 2)%weight = 1
         points(n + 1:n + 2)%gap = gap
         points(n + 1)%normal = line_force_t(force=energy%first(1), stiffness=energy%second(1, 1), energy=energy%value)
         points(n + 2)%normal = line_force_t(force=energy%first(2), stiffness=energy%second(2, 2))
         points(n + 2)%coupling = energy%second(1, 2)
         n = n + 2
      end subroutine add_end

   end subroutine press_cell

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
            k = k + point%weight*point%normal%stiffness*spread(point%row, 2, 18)*spread(point%row, 1, 18) &
               - part*point%weight*point%normal%force &
               *distance_hessian(weight, axis%t, x - surface%centre, normal, hessian)
            if (abs(point%coupling) > 0) k = k + point%coupling*(spread(point%row, 2, 18)*spread(before, 1, 18) &
               + spread(before, 2, 18)*spread(point%row, 1, 18))
            before = point%row
         end associate
      end do
   end subroutine cell_forces

   !> Force after a linear step [N].
   pure real(dp) function predicted_force(cell, step) result(force)
      type(surface_cell_t), intent(in) :: cell
      !> Of the unknowns (18)
      real(dp), intent(in) :: step(:)
      integer :: i

      force = 0
      do i = 1, size(cell%points)
         associate (point => cell%points(i))
            force = force + point%weight*max(0.0_dp, point%normal%force &
               - point%normal%stiffness*dot_product(point%row, step))
         end associate
      end do
   end function predicted_force

   !> Place in the element of a cell that touches.
   pure real(dp) function centre_of_force(cell) result(xi)
      type(surface_cell_t), intent(in) :: cell

      xi = sum(cell%points%weight*cell%points%normal%force*cell%points%xi)/cell%force
   end function centre_of_force

   !> What the next increment has to know of a cell, with what friction has done in this one.
   pure type(surface_memory_t) function advanced_memory(cell) result(memory)
      type(surface_cell_t), intent(in) :: cell

      memory%last_dissipation = cell%friction_work
      if (.not. cell%force > 0) return
      associate (before => cell%memory, friction => cell%friction)
         memory%closed = .true.
         memory%start = friction_start_t(friction%traction, cell%force, cell%stick_stiffness, &
            before%start%elastic_energy + friction%elastic_work)
         memory%slip_path = before%slip_path + norm2(friction%plastic_slip)
         memory%dissipation = before%dissipation + friction%dissipation
         memory%energy = cell%energy
      end associate
   end function advanced_memory

   !> What results show of a cell that touches.
   pure type(surface_contact_t) function contact_of_cell(surface, axis, cell) result(contact)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      type(surface_cell_t), intent(in) :: cell
      real(dp) :: weight(4), w1(4), w2(4), distance, normal(3)

      contact%pair = cell%pair
      contact%element = cell%element
      contact%force = cell%force
      contact%gap = cell%overlap%gap
      associate (overlap => cell%overlap)
         contact%length = sum(overlap%last(:overlap%n) - overlap%first(:overlap%n))*axis%length/2
      end associate
      contact%xi = centre_of_force(cell)
      contact%traction = cell%traction
      contact%surface_force = cell%on_surface(1:3)
      contact%surface_moment = cell%on_surface(4:6)
      contact%friction_status = cell%friction%status
      contact%slip_path = cell%memory%slip_path
      contact%dissipation = cell%memory%dissipation
      call axis_shape(axis%interpolation, axis%length, contact%xi, weight, w1, w2)
      contact%point = on_axis(weight, axis%x, axis%t)
      call surface_distance(surface, contact%point, distance, normal)
      contact%normal = normal
   end function contact_of_cell

end module litz_surface_cells
