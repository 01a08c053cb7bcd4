!> What is wrong with the contacts of wires and rigid surfaces in a converged state: overlaps that are too deep, and
!> wires that would have passed through a cylinder.
!>
!> A plane and a bore have one side only, on which a wire is held wherever it goes. Round a cylinder there are two ways:
!> a wire that would come near its axis on its way through it, in legs that are straight as seen from the cylinder, has
!> to go in smaller steps. Surfaces go as rigid bodies do (litz_contact_path). None may turn so far in an increment that
!> the side on which a wire is cannot be told from its start and its end.
module litz_surface_findings
   use litz_kinds, only: dp, pi
   use litz_axis, only: axis_shape, on_axis
   use litz_contact_findings, only: finding_t, worse_of, finding_surface_deep, finding_surface_passed, &
      finding_surface_turned
   use litz_contact_net, only: allowed_penetration
   use litz_contact_path, only: contact_path_t, legs_of_arc
   use litz_domain, only: domain_t
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t, survey_cell
   use litz_surface_choices, only: surface_cylinder
   use litz_surface_poses, only: present_surface, surface_moved_by, element_axis, axis_moved_by, surface_turn
   implicit none
   private
   public :: inspect_surfaces, overlaps_of_surfaces, most_turn

   !> A straight way through a cylinder may come as near to its axis as this part of the distance of a wire that
   !> touches: wires that slide round it by less than a right angle stay outside
   real(dp), parameter :: nearest_way = 0.7_dp
   !> Places at which the way of an element is looked at, over its length in radii of the cylinder
   integer, parameter :: places_per_radius = 8
   integer, parameter :: most_places = 1000
   !> Of a surface in an increment [rad]
   real(dp), parameter :: most_turn = pi/2

contains

   !> The worst of all pairs of a wire and a surface in the present iterate.
   type(finding_t) function inspect_surfaces(domain, path) result(worst)
      type(domain_t), intent(in) :: domain
      !> From the start of the increment
      type(contact_path_t), intent(in) :: path
      real(dp), allocatable :: x(:, :), x_before(:, :), rotation(:, :, :), rotation_before(:, :, :)
      integer :: leg, n_legs

      worst = overlaps_of_surfaces(domain, allowed_penetration)
      if (size(domain%model%surface_pairs) == 0) return
      worst = worse_of(worst, turned_surface(domain))
      if (worst%kind == finding_surface_turned) return
      if (.not. any(domain%model%surfaces%shape == surface_cylinder)) return
      n_legs = max(path%n_legs, legs_about_surfaces(domain, path))
      x = path%positions(domain%model, domain%wires, 0.0_dp)
      rotation = path%rotations(0.0_dp)
      do leg = 1, n_legs
         x_before = x
         rotation_before = rotation
         x = path%positions(domain%model, domain%wires, real(leg, dp)/n_legs)
         rotation = path%rotations(real(leg, dp)/n_legs)
         worst = worse_of(worst, passed_in_leg(domain, real([leg - 1, leg], dp)/n_legs, x_before, rotation_before, x, &
            rotation))
         if (worst%kind == finding_surface_passed) return
      end do
   end function inspect_surfaces

   !> A surface that turns too far.
   pure type(finding_t) function turned_surface(domain) result(finding)
      type(domain_t), intent(in) :: domain
      integer :: pair

      do pair = 1, size(domain%model%surface_pairs)
         associate (this => domain%model%surface_pairs(pair))
            if (surface_turn(domain, this%surface) > most_turn) finding = finding_on(domain, &
               domain%model%element_sets(this%set)%members(1), pair, finding_surface_turned)
         end associate
      end do
   end function turned_surface

   !> Straight legs for surfaces that go round their nodes.
   pure integer function legs_about_surfaces(domain, path) result(n_legs)
      type(domain_t), intent(in) :: domain
      type(contact_path_t), intent(in) :: path
      integer :: pair, i

      n_legs = 1
      do pair = 1, size(domain%model%surface_pairs)
         associate (this => domain%model%surface_pairs(pair))
            associate (node => domain%model%surfaces(this%surface)%node, &
               members => domain%model%element_sets(this%set)%members)
               if (node == 0) cycle
               do i = 1, size(members)
                  n_legs = max(n_legs, legs_of_arc(surface_turn(domain, this%surface), norm2(path%x_start(:, &
                     domain%model%connectivity(1, members(i))) - path%x_start(:, node)), &
                     domain%elements%radius(members(i))))
               end do
            end associate
         end associate
      end do
   end function legs_about_surfaces

   !> Whether wires pass through cylinders in a leg.
   type(finding_t) function passed_in_leg(domain, times, x_before, rotation_before, x, rotation) result(worst)
      type(domain_t), intent(in) :: domain
      !> At which it begins and ends, from 0 to 1 in the increment
      real(dp), intent(in) :: times(2)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) at its start and at its end
      real(dp), intent(in) :: x_before(:, :), rotation_before(:, :, :), x(:, :), rotation(:, :, :)
      type(rigid_surface_t) :: before, now
      real(dp) :: radii(size(domain%model%surfaces), 2)
      integer :: pair, i

      associate (start => domain%state%surface_radius, last => domain%loading%surface_radius)
         radii = spread(start, 2, 2) + spread(last - start, 2, 2)*spread(times, 1, size(start))
      end associate
      do pair = 1, size(domain%model%surface_pairs)
         associate (this => domain%model%surface_pairs(pair))
            if (domain%model%surfaces(this%surface)%shape /= surface_cylinder) cycle
            before = surface_moved_by(domain%model, pair, x_before, rotation_before, radii(:, 1))
            now = surface_moved_by(domain%model, pair, x, rotation, radii(:, 2))
            do i = 1, size(domain%model%element_sets(this%set)%members)
               associate (element => domain%model%element_sets(this%set)%members(i))
                  if (.not. passed(before, axis_moved_by(domain, element, pair, x_before, rotation_before), now, &
                     axis_moved_by(domain, element, pair, x, rotation))) cycle
                  worst = worse_of(worst, finding_on(domain, element, pair, finding_surface_passed))
               end associate
            end do
         end associate
      end do
   end function passed_in_leg

   !> The deepest overlap that is deeper than allowed.
   type(finding_t) function overlaps_of_surfaces(domain, allowed) result(worst)
      type(domain_t), intent(in) :: domain
      !> Over the radius of the wire
      real(dp), intent(in) :: allowed
      type(surface_cell_t) :: cell
      type(finding_t) :: finding
      integer :: pair, i

      do pair = 1, size(domain%model%surface_pairs)
         associate (this => domain%model%surface_pairs(pair))
            if (domain%model%interactions(this%interaction)%unlimited_penetration) cycle
            do i = 1, size(domain%model%element_sets(this%set)%members)
               associate (element => domain%model%element_sets(this%set)%members(i))
                  call survey_cell(present_surface(domain, pair), element_axis(domain, element, pair), 0.0_dp, cell)
                  finding = finding_on(domain, element, pair, finding_surface_deep)
                  finding%overlap = -cell%overlap%gap/domain%elements%radius(element)
                  if (finding%overlap > allowed) worst = worse_of(worst, finding)
               end associate
            end do
         end associate
      end do
   end function overlaps_of_surfaces

   !> Whether some place of an element comes too near to the axis of a cylinder on its straight way.
   pure logical function passed(before, axis_before, now, axis_now)
      !> At the start and at the end of the way
      type(rigid_surface_t), intent(in) :: before, now
      type(wire_axis_t), intent(in) :: axis_before, axis_now
      integer :: i, n
      real(dp) :: xi

      passed = .false.
      n = max(2, min(most_places, ceiling(places_per_radius*axis_now%length/now%radius)))
      do i = 0, n
         xi = -1 + 2*real(i, dp)/n
         passed = nearest_distance(across(before, axis_before, xi), across(now, axis_now, xi)) &
            < nearest_way*(now%radius + axis_now%radius)
         if (passed) return
      end do
   end function passed

   !> From the axis of a cylinder to a place of the wire, in directions that turn with the cylinder (3) [m].
   pure function across(surface, axis, xi)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> In the element
      real(dp), intent(in) :: xi
      real(dp) :: across(3), weight(4), w1(4), w2(4)

      call axis_shape(axis%interpolation, axis%length, xi, weight, w1, w2)
      across = matmul(on_axis(weight, axis%x, axis%t) - surface%point, surface%rotation)
      associate (d => matmul(surface%direction, surface%rotation))
         across = across - d*dot_product(d, across)
      end associate
   end function across

   !> Of a straight way from the origin [m].
   pure real(dp) function nearest_distance(from, to)
      !> Where the way begins and ends (3) [m]
      real(dp), intent(in) :: from(3), to(3)
      real(dp) :: part

      part = -dot_product(from, to - from)/max(dot_product(to - from, to - from), tiny(1.0_dp))
      nearest_distance = norm2(from + max(0.0_dp, min(1.0_dp, part))*(to - from))
   end function nearest_distance

   pure type(finding_t) function finding_on(domain, element, pair, kind) result(finding)
      type(domain_t), intent(in) :: domain
      !> Element, index of the pair, and one of the kinds of litz_contact_findings
      integer, intent(in) :: element, pair, kind

      finding%kind = kind
      finding%elements = element
      finding%surface = domain%model%surface_pairs(pair)%surface
   end function finding_on

end module litz_surface_findings
