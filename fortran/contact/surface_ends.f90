!> Round ends of wires, and round joints of kinks, on rigid surfaces.
!>
!> Source: theory section 12. Of the sphere at a joint each of the wires that meet there has the same part. How wire and
!> surface part is that of a state in balance.
module litz_surface_ends
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_element_library, only: material_at, material_place_t
   use litz_end_on_surface, only: rigid_end, yielding_end
   use litz_normal_law, only: normal_law_t
   use litz_rigid_line, only: relative_curvature_t
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t, curvature_of_cell, curvature_of_surface
   use litz_surface_overlap, only: gap_at
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_ends, update_ends

   !> Radii that differ by less of themselves are the same
   real(dp), parameter :: same = 1.0e-9_dp

contains

   !> Which nodes of a cell are round ends or joints, and of how many of the wires that may touch.
   pure subroutine find_ends(wires, radii, nodes, is_member, cell)
      type(wires_t), intent(in) :: wires
      !> Of the elements (n_elements) [m]
      real(dp), intent(in) :: radii(:)
      !> Nodes of the element (2)
      integer, intent(in) :: nodes(:)
      !> Elements that may touch (n_elements)
      logical, intent(in) :: is_member(:)
      type(surface_cell_t), intent(inout) :: cell
      integer :: side, i, ending, going_on

      do side = 1, 2
         cell%has_end(side) = wires%next(side, cell%element) == 0
         if (.not. cell%has_end(side)) cycle
         ending = 0
         going_on = 0
         do i = wires%first_at_node(nodes(side)), wires%first_at_node(nodes(side) + 1) - 1
            associate (e => abs(wires%at_node(i)), its_side => merge(1, 2, wires%at_node(i) < 0))
               ! a thinner wire is inside the sphere
               if (.not. is_member(e) .or. radii(e) < (1 - same)*radii(cell%element)) cycle
               if (radii(e) > (1 + same)*radii(cell%element)) going_on = going_on + 1
               if (wires%next(its_side, e) == 0) then
                  ending = ending + 1
               else
                  going_on = going_on + 1
               end if
            end associate
         end do
         ! a wire that goes on there needs no sphere, nor does one beside a thicker one
         cell%ends(side)%part = merge(0.0_dp, 1.0_dp/ending, going_on > 0)
      end do
   end subroutine find_ends

   !> What the round ends of a cell carry.
   subroutine update_ends(domain, surface, axis, tolerance, cell, has_changed)
      type(domain_t), intent(in) :: domain
      !> As they are now
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> Relative changes up to this are left alone; 0: none is
      real(dp), intent(in) :: tolerance
      type(surface_cell_t), intent(inout) :: cell
      !> True from here on if something was updated
      logical, intent(inout) :: has_changed
      type(material_place_t) :: there
      type(relative_curvature_t) :: curvature(2)
      real(dp) :: laws(2), gap, unused_slope
      integer :: side

      laws = 0
      curvature = [(curvature_of_cell(surface, axis, 2.0_dp*side - 3, 0.0_dp), side=1, 2)]
      associate (law => domain%model%interactions(domain%model%surface_pairs(cell%pair)%interaction)%normal)
         do side = 1, 2
            if (.not. cell%has_end(side)) cycle
            there = material_at(domain%model, domain%elements, cell%element, 2.0_dp*side - 3)
            laws(side) = rigid_end(axis%law_radius, there%young, there%poisson, law%line_penalty(), &
               curvature_of_surface(surface))
            if (.not. tolerance > 0) cell%ends(side)%replaces_line = .false.
            call gap_at(surface, axis%p, axis%radius, 2.0_dp*side - 3, gap, unused_slope)
            if (gap < 0 .and. .not. (cell%ends(side)%replaces_line .or. law%yields())) then
               cell%ends(side)%replaces_line = .true.
               has_changed = .true.
            end if
            if (law%yields()) cell%yielding%ends(side) = yielding_end(axis%law_radius, there%young, there%poisson, &
               curvature_of_surface(surface), law%yield_stress, law%hardness)
         end do
         cell%ends%penalty = law%line_penalty()
      end associate
      cell%ends%radius = axis%law_radius
      cell%ends%length = axis%length
      if (tolerance > 0 .and. all(abs(laws - cell%law_of_end) <= tolerance*maxval(laws)) .and. &
         all(abs(curvature%opening - cell%ends%bend)*axis%law_radius <= tolerance)) return
      cell%law_of_end = laws
      cell%ends%bend = curvature%opening
      cell%ends%sphere = 1/(1/axis%law_radius + curvature%of_surface)
      cell%ends%cylinder = max(0.0_dp, curvature%along*cell%ends%sphere)
      has_changed = .true.
   end subroutine update_ends

end module litz_surface_ends
