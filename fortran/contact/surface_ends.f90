!> Round ends of wires, and round joints of kinks, on rigid surfaces.
!>
!> Source: theory section 12. Of the sphere at a joint each of the wires that meet there has the same part. What they
!> know of each other, and how wire and surface part, is that of a state in balance.
module litz_surface_ends
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_element_library, only: material_at, material_place_t
   use litz_end_on_surface, only: rigid_end, yielding_end, share_of_end
   use litz_normal_law, only: normal_law_t
   use litz_rigid_line, only: relative_curvature_t
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t, curvature_of_cell, curvature_of_surface
   use litz_surface_forces, only: end_beside
   use litz_surface_poses, only: present_surface, element_axis
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_ends, update_ends, update_joints

contains

   !> Which nodes of a cell are round ends or joints, and of how many of the wires that may touch.
   pure subroutine find_ends(wires, nodes, is_member, cell)
      type(wires_t), intent(in) :: wires
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
               if (.not. is_member(e)) cycle
               if (wires%next(its_side, e) == 0) then
                  ending = ending + 1
               else
                  going_on = going_on + 1
               end if
            end associate
         end do
         ! a wire that goes on there needs no sphere
         cell%ends(side)%part = merge(0.0_dp, 1.0_dp/ending, going_on > 0)
      end do
   end subroutine find_ends

   !> What the round ends of a cell carry.
   subroutine update_ends(domain, tolerance, cell, has_changed)
      type(domain_t), intent(in) :: domain
      !> Relative changes up to this are left alone; 0: none is
      real(dp), intent(in) :: tolerance
      type(surface_cell_t), intent(inout) :: cell
      !> True from here on if something was updated
      logical, intent(inout) :: has_changed
      type(rigid_surface_t) :: surface
      type(wire_axis_t) :: axis
      type(material_place_t) :: there
      type(relative_curvature_t) :: curvature(2)
      real(dp) :: laws(2), place(2), gap(2), way
      integer :: side

      surface = present_surface(domain, cell%pair)
      axis = element_axis(domain, cell%element, cell%pair)
      laws = 0
      curvature = [(curvature_of_cell(surface, axis, 2.0_dp*side - 3, 0.0_dp), side=1, 2)]
      associate (law => domain%model%interactions(domain%model%surface_pairs(cell%pair)%interaction)%normal)
         do side = 1, 2
            if (.not. cell%has_end(side)) cycle
            there = material_at(domain%model, domain%elements, cell%element, 2.0_dp*side - 3)
            laws(side) = rigid_end(axis%radius, there%young, there%poisson, law%line_penalty(), &
               curvature_of_surface(surface))
            if (.not. tolerance > 0) cell%ends(side)%replaces_line = .false.
            call end_beside(surface, axis, side, place, gap, way)
            if (gap(1) < 0 .and. .not. (cell%ends(side)%replaces_line .or. law%yields())) then
               cell%ends(side)%replaces_line = .true.
               has_changed = .true.
            end if
            if (law%yields()) cell%yielding%ends(side) = yielding_end(axis%radius, there%young, there%poisson, &
               curvature_of_surface(surface), law%yield_stress, law%hardness)
         end do
         cell%ends%penalty = law%line_penalty()
      end associate
      cell%ends%radius = axis%radius
      if (tolerance > 0 .and. all(abs(laws - cell%law_of_end) <= tolerance*maxval(laws)) .and. &
         all(abs(curvature%opening - cell%ends%bend)*axis%radius <= tolerance)) return
      cell%law_of_end = laws
      cell%ends%bend = curvature%opening
      cell%ends%sphere = 1/(1/axis%radius + curvature%of_surface)
      cell%ends%cylinder = max(0.0_dp, curvature%along*cell%ends%sphere)
      has_changed = .true.
   end subroutine update_ends

   !> How far the wires that meet at a joint leave it a sphere: nothing where one of them lies along the surface.
   subroutine update_joints(domain, tolerance, cells, has_changed)
      type(domain_t), intent(in) :: domain
      !> Changes up to this are left alone; 0: none is
      real(dp), intent(in) :: tolerance
      type(surface_cell_t), intent(inout) :: cells(:)
      !> True from here on if something was updated
      logical, intent(inout) :: has_changed
      integer, allocatable :: joints(:, :)
      real(dp), allocatable :: share(:)
      real(dp) :: others
      integer :: i, j

      joints = touching_joints(domain, cells)
      allocate (share(size(joints, 2)))
      do i = 1, size(joints, 2)
         share(i) = present_share(domain, cells(joints(1, i)), joints(2, i))
      end do
      do i = 1, size(joints, 2)
         others = 1
         do j = 1, size(joints, 2)
            if (j /= i .and. all(joints(3:4, j) == joints(3:4, i))) others = others*share(j)
         end do
         associate (kept => cells(joints(1, i))%ends(joints(2, i))%others)
            if (tolerance > 0 .and. abs(others - kept) <= tolerance) cycle
            kept = others
         end associate
         has_changed = .true.
      end do
   end subroutine update_joints

   !> Joints at which several wires may touch: cell, its side, node, and surface of each (4, joints).
   pure function touching_joints(domain, cells) result(joints)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      integer, allocatable :: joints(:, :)
      integer :: i, side, n

      allocate (joints(4, 2*size(cells)))
      n = 0
      do i = 1, size(cells)
         do side = 1, 2
            if (.not. (cells(i)%has_end(side) .and. cells(i)%ends(side)%part < 1 .and. cells(i)%overlap%n > 0)) cycle
            n = n + 1
            joints(:, n) = [i, side, domain%model%connectivity(side, cells(i)%element), &
               domain%model%surface_pairs(cells(i)%pair)%surface]
         end do
      end do
      joints = joints(:, :n)
   end function touching_joints

   !> Its share of the sphere as it is now [-].
   pure real(dp) function present_share(domain, cell, end) result(share)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      !> 1 or 2
      integer, intent(in) :: end
      real(dp) :: place(2), gap(2), way

      call end_beside(present_surface(domain, cell%pair), element_axis(domain, cell%element, cell%pair), end, place, &
         gap, way)
      share = 1
      if (gap(1) < 0) share = share_of_end(cell%ends(end), -gap(1), (gap(2) - gap(1))/way - cell%ends(end)%bend*way/2)
   end function present_share

end module litz_surface_ends
