!> Where rigid surfaces and the axes of elements are in the present iterate.
module litz_surface_poses
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial
   use litz_domain, only: domain_t
   use litz_fields, only: field_rotation, first_slot, last_slot
   use litz_model, only: model_t
   use litz_rigid_surface, only: rigid_surface_t, moved_surface, radial_motion
   use litz_surface_cells, only: surface_cell_t, wire_axis_t
   implicit none
   private
   public :: present_surface, surface_at_start, surface_moved_by, element_axis, axis_moved_by, surface_node, &
      surface_turn, work_of_radii

contains

   !> The surface of a pair as it is now.
   pure type(rigid_surface_t) function present_surface(domain, pair) result(surface)
      type(domain_t), intent(in) :: domain
      !> Index of the pair
      integer, intent(in) :: pair

      surface = surface_moved_by(domain%model, pair, domain%iterate%x, domain%iterate%rotation, &
         domain%loading%surface_radius)
   end function present_surface

   !> The surface of a pair as it was when the increment began.
   pure type(rigid_surface_t) function surface_at_start(domain, pair) result(surface)
      type(domain_t), intent(in) :: domain
      !> Index of the pair
      integer, intent(in) :: pair

      surface = surface_moved_by(domain%model, pair, domain%iterate%x_start, domain%state%rotation, &
         domain%state%surface_radius)
   end function surface_at_start

   !> The surface of a pair at given positions and rotations of the nodes, and radii of the surfaces.
   pure type(rigid_surface_t) function surface_moved_by(model, pair, x, rotation, radius) result(surface)
      type(model_t), intent(in) :: model
      !> Index of the pair
      integer, intent(in) :: pair
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> (n_surfaces) [m]
      real(dp), intent(in) :: radius(:)

      associate (this => model%surfaces(model%surface_pairs(pair)%surface))
         surface = rigid_surface_t(this%shape, this%point, this%direction, radius(model%surface_pairs(pair)%surface))
         if (this%node == 0) return
         surface%centre = model%x(:, this%node)
         surface = moved_surface(surface, rotation(:, :, this%node), x(:, this%node))
      end associate
   end function surface_moved_by

   !> The axis of an element as it is now, as it touches the surface of a pair.
   pure type(wire_axis_t) function element_axis(domain, element, pair) result(axis)
      type(domain_t), intent(in) :: domain
      !> Element, and index of the pair
      integer, intent(in) :: element, pair

      axis = axis_moved_by(domain, element, pair, domain%iterate%x, domain%iterate%rotation)
   end function element_axis

   !> The same at given positions and rotations of the nodes.
   pure type(wire_axis_t) function axis_moved_by(domain, element, pair, x, rotation) result(axis)
      type(domain_t), intent(in) :: domain
      !> Element, and index of the pair
      integer, intent(in) :: element, pair
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      integer :: side

      associate (model => domain%model, node => domain%model%connectivity(:, element))
         axis%interpolation = model%interactions(model%surface_pairs(pair)%interaction)%axis
         axis%length = domain%elements%length(element)
         axis%radius = domain%elements%radius(element)
         axis%law_radius = model%sections(model%element_section(element))%contact_radius
         axis%x = x(:, node)
         do side = 1, 2
            axis%t(:, side) = matmul(rotation(:, :, node(side)), domain%wires%contact_tangents0(:, side, element))
         end do
         axis%p = axis_polynomial(axis%interpolation, axis%length, axis%x, axis%t)
      end associate
   end function axis_moved_by

   !> What surfaces do as their radii change, with the mean of the forces when the increment began and now [J].
   pure real(dp) function work_of_radii(domain, cells) result(work)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      integer :: i

      work = 0
      do i = 1, size(cells)
         associate (cell => cells(i))
            work = work + radial_motion(surface_at_start(domain, cell%pair), present_surface(domain, cell%pair)) &
               *(cell%force + merge(cell%memory%start%force, 0.0_dp, cell%memory%closed))/2
         end associate
      end do
   end function work_of_radii

   !> How far a surface turns in this increment [rad].
   pure real(dp) function surface_turn(domain, surface) result(turn)
      type(domain_t), intent(in) :: domain
      !> Index of the surface
      integer, intent(in) :: surface

      turn = 0
      associate (node => domain%model%surfaces(surface)%node)
         if (node > 0) turn = norm2(domain%iterate%change(first_slot(field_rotation):last_slot(field_rotation), node))
      end associate
   end function surface_turn

   !> Node of the surface of a cell; 0: it is fixed in space.
   pure integer function surface_node(domain, cell)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell

      surface_node = domain%model%surfaces(domain%model%surface_pairs(cell%pair)%surface)%node
   end function surface_node

end module litz_surface_poses
