!> What is wrong with the contacts of wires and rigid surfaces in a converged state: overlaps that are too deep, and
!> wires that would have passed through a cylinder.
!>
!> A plane and a bore have one side only, on which a wire is held wherever it goes. Round a cylinder there are two ways:
!> a wire that would come near its axis on a straight way through it, as seen from the cylinder, has to go in smaller
!> steps.
module litz_surface_findings
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis
   use litz_contact_findings, only: finding_t, worse_of, finding_surface_deep, finding_surface_passed
   use litz_contact_net, only: allowed_penetration
   use litz_domain, only: domain_t
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t, survey_cell
   use litz_surface_choices, only: surface_cylinder
   use litz_surface_poses, only: present_surface, surface_at_start, element_axis, axis_moved_by
   implicit none
   private
   public :: inspect_surfaces, overlaps_of_surfaces

   !> A straight way through a cylinder may come as near to its axis as this part of the distance of a wire that
   !> touches: wires that slide round it by less than a right angle stay outside
   real(dp), parameter :: nearest_way = 0.7_dp
   !> Places at which the way of an element is looked at, over its length in radii of the cylinder
   integer, parameter :: places_per_radius = 8
   integer, parameter :: most_places = 1000

contains

   !> The worst of all pairs of a wire and a surface in the present iterate.
   type(finding_t) function inspect_surfaces(domain) result(worst)
      type(domain_t), intent(in) :: domain
      integer :: pair, i

      worst = overlaps_of_surfaces(domain, allowed_penetration)
      do pair = 1, size(domain%model%surface_pairs)
         associate (this => domain%model%surface_pairs(pair))
            if (domain%model%surfaces(this%surface)%shape /= surface_cylinder) cycle
            do i = 1, size(domain%model%element_sets(this%set)%members)
               worst = worse_of(worst, passed(domain, domain%model%element_sets(this%set)%members(i), pair))
            end do
         end associate
      end do
   end function inspect_surfaces

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
   type(finding_t) function passed(domain, element, pair) result(finding)
      type(domain_t), intent(in) :: domain
      !> Element, and index of the pair
      integer, intent(in) :: element, pair
      type(rigid_surface_t) :: before, now
      type(wire_axis_t) :: axis_before, axis_now
      integer :: i, n
      real(dp) :: xi

      before = surface_at_start(domain, pair)
      now = present_surface(domain, pair)
      axis_before = axis_moved_by(domain, element, pair, domain%iterate%x_start, domain%state%rotation)
      axis_now = element_axis(domain, element, pair)
      n = max(2, min(most_places, ceiling(places_per_radius*axis_now%length/now%radius)))
      do i = 0, n
         xi = -1 + 2*real(i, dp)/n
         if (.not. nearest_distance(across(before, axis_before, xi), across(now, axis_now, xi)) &
            < nearest_way*(now%radius + axis_now%radius)) cycle
         finding = finding_on(domain, element, pair, finding_surface_passed)
         return
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
