!> Gap and normal where a wire touches with its round end, or with the round joint of a kink, and how they change with
!> the 24 mechanical unknowns.
!>
!> The place on that wire is held at its node, and only the foot on the other wire moves: the kinematics of a point of a
!> line (litz_line_kinematics), with either wire as the one that is held. Where both are held, end meets end.
module litz_end_kinematics
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_line_kinematics, only: line_kinematics
   implicit none
   private
   public :: end_kinematics

   integer :: i
   !> Nodes and unknowns of a pair of elements, the unbarred element first
   integer, parameter :: mirrored_nodes(4) = [3, 4, 1, 2]
   integer, parameter :: mirrored_motions(24) = [(i, i=13, 24), (i, i=1, 12)]

contains

   !> Everything at given places.
   pure subroutine end_kinematics(x, t, length, axis, radius, xi_bar, xi, held, normal_before, kinematics, info)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> Places: -1 or 1 where the wire is held, its foot from `line_foot` where not
      real(dp), intent(in) :: xi_bar, xi
      !> The place on the barred, on the unbarred wire is a round end or joint (2); at least one is
      logical, intent(in) :: held(2)
      !> Normal of the last converged state, which keeps the sign of the gap when the axes pass each other; 0: none
      real(dp), intent(in) :: normal_before(3)
      type(contact_kinematics_t), intent(out) :: kinematics
      !> `kinematics_ok`, or `kinematics_singular` where the axes meet; `kinematics` is complete only with the former
      integer, intent(out) :: info

      if (held(2)) then
         call line_kinematics(x, t, length, axis, radius, xi_bar, xi, held(1), normal_before, kinematics, info)
      else
         call line_kinematics(x(:, mirrored_nodes), t(:, mirrored_nodes), length([2, 1]), axis, radius([2, 1]), xi, &
            xi_bar, .false., -normal_before, kinematics, info)
         kinematics = mirrored(kinematics)
      end if
   end subroutine end_kinematics

   !> The same contact with the names of the two wires exchanged.
   pure type(contact_kinematics_t) function mirrored(kinematics) result(other)
      type(contact_kinematics_t), intent(in) :: kinematics

      other = kinematics
      other%xi_bar = kinematics%xi
      other%xi = kinematics%xi_bar
      other%point_bar = kinematics%point
      other%point = kinematics%point_bar
      other%normal = -kinematics%normal
      other%dgap = kinematics%dgap(mirrored_motions)
      other%rows%dxi_bar = kinematics%rows%dxi(mirrored_motions)
      other%rows%dxi = kinematics%rows%dxi_bar(mirrored_motions)
      other%rows%dcos_angle = kinematics%rows%dcos_angle(mirrored_motions)
      other%rows%dangle = kinematics%rows%dangle(mirrored_motions)
      other%rows%b = kinematics%rows%b(mirrored_motions, :)
      other%rows%q = kinematics%rows%q(mirrored_motions, :)
      other%squares = kinematics%squares([2, 1])
      other%tangent_weight = -kinematics%tangent_weight(mirrored_nodes)
   end function mirrored

end module litz_end_kinematics
