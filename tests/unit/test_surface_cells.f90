!> How wire and surface part from each other, and the law per length by that.
program test_surface_cells
   use litz_kinds, only: dp
   use litz_line_law, only: line_force_t, line_force
   use litz_rigid_line, only: relative_curvature_t, rigid_line
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_cells, only: wire_axis_t, curvature_of_cell
   use litz_surface_choices, only: surface_bore
   implicit none

   real(dp), parameter :: radius = 1.0e-3_dp, bore = 6.9e-3_dp, half_length = 0.25e-3_dp, overlap = 1.0e-5_dp
   integer :: failures = 0

   call a_wire_that_comes_to_conform_to_a_bore_has_a_law_without_a_jump()
   if (failures > 0) error stop 1

contains

   !> A wire that is askew in a bore, leans, and is bent as the bore is there: less and less, and then more.
   subroutine a_wire_that_comes_to_conform_to_a_bore_has_a_law_without_a_jump()
      real(dp), parameter :: askew = 0.2_dp, conforming = sin(askew)**2/(bore - radius)
      type(relative_curvature_t) :: relative
      type(line_force_t) :: law
      real(dp) :: force(-60:60)
      integer :: i

      do i = -60, 60
         ! D'' from 1e-2/r through zero to -1e-2/r, most of them near it
         relative = curvature_of_cell(bore_askew(askew), bent(conforming + sign(1.0e-2_dp/radius*10.0_dp**( &
            -abs(i)/10.0_dp), real(i, dp)), 3.0e-3_dp), 0.3_dp, 0.0_dp)
         law = line_force(rigid_line(radius, 2.0e11_dp, 0.3_dp, relative), overlap, 0.0_dp)
         force(i) = law%force
      end do
      if (maxval(abs(force(20:60)/force(60) - 1)) < 0.02_dp .and. maxval(abs(force(-60:-20)/force(60) - 1)) < 0.02_dp &
         .and. force(0) > 0) return
      failures = failures + 1
      write (*, '(a,2f10.5)') 'failed: a wire that comes to conform to a bore, force over that of one that does: ', &
         minval(force([(i, i=20, 60)])/force(60)), maxval(force([(i, i=20, 60)])/force(60))
   end subroutine a_wire_that_comes_to_conform_to_a_bore_has_a_law_without_a_jump

   !> A bore that touches the plane z = 0, with its axis turned away from the x axis.
   pure type(rigid_surface_t) function bore_askew(angle) result(surface)
      !> [rad]
      real(dp), intent(in) :: angle

      surface%shape = surface_bore
      surface%point = [0.0_dp, 0.0_dp, bore]
      surface%direction = [cos(angle), sin(angle), 0.0_dp]
      surface%radius = bore
      surface%centre = surface%point
   end function bore_askew

   !> An axis along x, bent and inclined in the plane of x and z, over the deepest place of the bore.
   pure type(wire_axis_t) function bent(curvature, slope) result(axis)
      !> [1/m] and [-]
      real(dp), intent(in) :: curvature, slope

      axis%length = 2*half_length
      axis%radius = radius
      axis%p(1, 1) = half_length
      axis%p(3, 0:2) = [radius - overlap, slope*half_length, curvature*half_length**2/2]
   end function bent

end program test_surface_cells
