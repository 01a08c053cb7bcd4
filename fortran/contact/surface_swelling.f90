!> What temperatures do to the forces of wires on rigid surfaces, where motions and temperatures are in one Newton step.
!>
!> Wires swell. What that does to the arms of friction, and softer metal, are left out: the laws of places stay within
!> an iteration. Source: theory sections 13 and 14.
module litz_surface_swelling
   use litz_domain, only: domain_t
   use litz_element_library, only: radius_by_temperature
   use litz_fields, only: motion_slots, temperature_slots
   use litz_kinds, only: dp
   use litz_surface_cells, only: surface_cell_t
   implicit none
   private
   public :: swelling_of, force_by_radius, add_swelling

contains

   !> How the radius that touches surfaces, the mean of an element, changes with the temperatures of its nodes; none
   !> where these are not in the same step as motions (2) [m/K].
   pure function swelling_of(domain, element) result(slope)
      type(domain_t), intent(in) :: domain
      !> Index of the element
      integer, intent(in) :: element
      real(dp) :: slope(2)

      slope = 0
      if (domain%coupled_step) slope = radius_by_temperature(domain%model, domain%elements, element, 0.0_dp)
   end function swelling_of

   !> The tangent of forces and friction over the temperatures, after that over the motions.
   subroutine add_swelling(domain, cells, nodes)
      type(domain_t), intent(inout) :: domain
      !> That touch (n)
      type(surface_cell_t), intent(in) :: cells(:)
      !> Of the element, and of the surface if it moves (2 or 3, n)
      integer, intent(in) :: nodes(:, :)
      real(dp) :: k(18, size(nodes, 1), size(cells))
      integer :: i

      if (.not. domain%coupled_step) return
      k = 0
      do i = 1, size(cells)
         k(:, :2, i) = spread(forces_by_radius(cells(i)), 2, 2)*spread(swelling_of(domain, cells(i)%element), 1, 18)
      end do
      call domain%add_cells(nodes, motion_slots, temperature_slots, k(:6*size(nodes, 1), :, :))
   end subroutine add_swelling

   !> What a larger radius does, where nothing moves (18) [N/m, N].
   pure function forces_by_radius(cell) result(slope)
      type(surface_cell_t), intent(in) :: cell
      real(dp) :: slope(18)
      integer :: i

      slope = force_by_radius(cell)*cell%friction_by_force
      do i = 1, size(cell%points)
         associate (point => cell%points(i))
            slope = slope - point%weight*point%normal%stiffness*point%row
            if (abs(point%coupling) > 0) slope = slope - point%coupling*(point%row + cell%points(i - 1)%row)
         end associate
      end do
   end function forces_by_radius

   !> The same of the force of a cell [N/m].
   pure real(dp) function force_by_radius(cell) result(slope)
      type(surface_cell_t), intent(in) :: cell

      slope = sum(cell%points%weight*cell%points%normal%stiffness) + 2*sum(cell%points%coupling)
   end function force_by_radius

end module litz_surface_swelling
