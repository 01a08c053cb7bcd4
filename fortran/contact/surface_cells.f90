!> An element over a rigid surface: where it overlaps, by which laws, and what it remembers.
!>
!> Source: theory section 12.
module litz_surface_cells
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, axis_sagitta, on_axis
   use litz_end_on_surface, only: wire_end_t
   use litz_friction_iteration, only: friction_iteration_t
   use litz_friction_law, only: friction_law_t, friction_start_t
   use litz_line_law, only: line_wires_t, line_force_t
   use litz_normal_law, only: normal_law_t
   use litz_rigid_line, only: relative_curvature_t, rigid_line, growth_of_lens, yielding_on_surface
   use litz_rigid_surface, only: rigid_surface_t, surface_distance
   use litz_rotations, only: cross
   use litz_state, only: surface_contact_t
   use litz_surface_choices, only: surface_plane, surface_bore
   use litz_surface_dents, only: surface_dents_t, yielding_element_t, depth_of_dents, dents_after
   use litz_surface_overlap, only: surface_overlap_t, find_surface_overlap
   implicit none
   private
   public :: surface_cell_t, surface_memory_t, surface_point_t, wire_axis_t, survey_cell, curvature_of_cell, &
      curvature_of_surface, law_of_cell, take_law, contact_of_cell, centre_of_force, advanced_memory, advanced_dents

   !> Overlap up to which a lens is followed, in radii
   real(dp), parameter :: deepest = 0.05_dp

   !> The axis of an element as it is now.
   type :: wire_axis_t
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer :: interpolation = 0
      !> Reference length, radius as it is swollen, and that of the laws, which is the reference one [m]
      real(dp) :: length = 0, radius = 0, law_radius = 0
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
      !> Stiffness of the metal around the spot, which stays elastic [N/m^2]; of an end [N/m]
      real(dp) :: elastic_stiffness = 0
      !> How the force of the cell changes with the overlap here [N/m^2]; of an end [N/m]
      real(dp) :: sum_stiffness = 0
      !> Place of the memory of metal that yields; 0: it has none here
      integer :: place = 0
      !> It is one of an end; what yielding dissipates there in this increment [J]
      logical :: at_end = .false.
      real(dp) :: yielded = 0
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
      !> Energy of its lens over that with the far field of the law [-]
      real(dp) :: growth = 1
      !> Force of either end that nothing is beside, over the overlap to the power of 3/2 (2) [N/m^1.5], and how the
      !> wire goes on from there
      real(dp) :: law_of_end(2) = 0
      type(wire_end_t) :: ends(2)
      !> As last surveyed
      type(surface_overlap_t) :: overlap
      !> Laws of metal that yields, and what it remembers of the last converged state
      type(yielding_element_t) :: yielding
      type(surface_dents_t) :: dents
      !> As last evaluated
      type(surface_point_t), allocatable :: points(:)
      !> Force of all points [N], and length on which the wire presses [m]
      real(dp) :: force = 0, length = 0
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
      !> How the residual changes with the force by the limit of friction (18)
      real(dp) :: friction_by_force(18) = 0
      !> Work of friction in this increment [J], and how it changes with the unknowns (18)
      real(dp) :: friction_work = 0, dfriction_work(18) = 0
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

   !> Relative curvatures at a place of an element, and the lens in which that lies.
   pure type(relative_curvature_t) function curvature_of_cell(surface, axis, xi, dent) result(relative)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> The place; largest overlap that metal that yields remembers [m]
      real(dp), intent(in) :: xi, dent
      real(dp) :: x1(3), x2(3), distance, normal(3), hessian(3, 3), tangent(3), bend, beside, e(2), curvature

      associate (p => axis%p)
         call surface_distance(surface, p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3))), distance, normal, hessian)
         x1 = p(:, 1) + xi*(2*p(:, 2) + xi*3*p(:, 3))
         x2 = 2*p(:, 2) + xi*6*p(:, 3)
      end associate
      bend = dot_product(normal, x2)/dot_product(x1, x1)
      beside = dot_product(x1, matmul(hessian, x1))/dot_product(x1, x1)
      relative%opening = bend + beside                                                     ! D''
      tangent = x1 - normal*dot_product(normal, x1)
      tangent = tangent/max(norm2(tangent), tiny(1.0_dp))
      curvature = curvature_of_surface(surface)
      ! the direction in which the surface is curved, along and across the wire
      e = [dot_product(cross(surface%direction, normal), tangent), dot_product(surface%direction, tangent)]
      relative%across = 1/axis%law_radius + curvature*e(2)**2
      relative%of_surface = curvature*e(1)**2
      relative%mixed = curvature*e(1)*e(2)
      ! seen from surfaces, not from the axis: (12.2a)
      relative%along = relative%mixed**2/relative%across + relative%opening/(max(1 + bend*axis%law_radius, 0.5_dp) &
         *max(1 - beside*distance, 0.5_dp))
      if (.not. relative%opening > 0) return
      relative%deepest = max(dent, axis%radius - distance) &
         + dot_product(normal, x1)**2/(2*relative%opening*dot_product(x1, x1))             ! delta + t^2/(2 k)
      relative%deepest = max(0.0_dp, min(relative%deepest, deepest*axis%law_radius))
   end function curvature_of_cell

   !> Of a cylinder positive, of a bore negative [1/m].
   pure real(dp) function curvature_of_surface(surface) result(curvature)
      type(rigid_surface_t), intent(in) :: surface

      curvature = 0
      if (surface%shape /= surface_plane) curvature = merge(-1, 1, surface%shape == surface_bore)/surface%radius
   end function curvature_of_surface

   !> The elastic law at the place of an element that is nearest to the surface.
   pure type(line_wires_t) function law_of_cell(axis, young, poisson, curvature) result(law)
      type(wire_axis_t), intent(in) :: axis
      !> Of the wire [Pa], [-]
      real(dp), intent(in) :: young, poisson
      type(relative_curvature_t), intent(in) :: curvature

      law = rigid_line(axis%law_radius, young, poisson, curvature)
   end function law_of_cell

   !> Follow a law from now on.
   pure subroutine take_law(normal, law, young, poisson, curvature, cell)
      type(normal_law_t), intent(in) :: normal
      type(line_wires_t), intent(in) :: law
      !> Of the wire [Pa], [-]
      real(dp), intent(in) :: young, poisson
      type(relative_curvature_t), intent(in) :: curvature
      type(surface_cell_t), intent(inout) :: cell

      cell%law = law
      cell%growth = 1
      cell%ends%law = law
      if (.not. normal%line_penalty() > 0) cell%growth = growth_of_lens(law, curvature)
      cell%yielding%yields = normal%yields()
      if (.not. cell%yielding%yields) return
      cell%yielding%strip = yielding_on_surface(law, young, poisson, curvature, normal%yield_stress, normal%hardness)
      if (allocated(cell%yielding%dent)) deallocate (cell%yielding%dent)
   end subroutine take_law

   !> Place in the element of a cell that touches.
   pure real(dp) function centre_of_force(cell) result(xi)
      type(surface_cell_t), intent(in) :: cell

      xi = sum(cell%points%weight*cell%points%normal%force*cell%points%xi)/cell%force
      ! an end and the place beside it may press and pull
      xi = max(-1.0_dp, min(1.0_dp, xi))
   end function centre_of_force

   !> What the next increment has to know of a cell, with what friction has done in this one.
   pure type(surface_memory_t) function advanced_memory(cell, energy) result(memory)
      type(surface_cell_t), intent(in) :: cell
      !> Of the overlap [J]
      real(dp), intent(in) :: energy

      memory%last_dissipation = cell%friction_work
      if (.not. cell%force > 0) return
      associate (before => cell%memory, friction => cell%friction)
         memory%closed = .true.
         memory%start = friction_start_t(friction%traction, cell%force, cell%stick_stiffness, &
            before%start%elastic_energy + friction%elastic_work)
         memory%slip_path = before%slip_path + norm2(friction%plastic_slip)
         memory%dissipation = before%dissipation + friction%dissipation
         memory%energy = energy
      end associate
   end function advanced_memory

   !> What metal that yields has to know in the next increment.
   pure type(surface_dents_t) function advanced_dents(surface, axis, cell, yielded) result(dents)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      type(surface_cell_t), intent(in) :: cell
      !> In this increment [J]
      real(dp), intent(in) :: yielded

      dents = dents_after(cell%dents, surface, axis%p, axis%radius, cell%overlap)
      dents%largest_force = max(dents%largest_force, cell%force)
      dents%dissipation = dents%dissipation + yielded
   end function advanced_dents

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
      contact%length = cell%length
      if (cell%yielding%yields) then
         contact%largest_force = cell%dents%largest_force
         contact%dent = depth_of_dents(cell%dents, cell%yielding, [any(cell%points%at_end .and. cell%points%xi < 0), &
            any(cell%points%at_end .and. cell%points%xi > 0)])
         contact%yield_dissipation = cell%dents%dissipation
      end if
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
