!> The normal force of a place along a line: the law per length times the length for which it stands, and at the end of
!> its wire that of the round end.
!>
!> Source: theory (10.18b).
module litz_place_forces
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_line_law, only: line_force_t
   use litz_round_end, only: end_force_t, force_of_end
   use litz_yielding_place, only: place_force
   implicit none
   private
   public :: place_law_t, law_of_place, force_along_line

   type :: place_law_t
      !> Of the line
      type(line_force_t) :: per_length
      !> Of the round end
      type(end_force_t) :: of_end
      !> Of both: [N], [N/m], [J]
      real(dp) :: force = 0, stiffness = 0, energy = 0
   end type place_law_t

contains

   !> At an overlap.
   pure type(place_law_t) function law_of_place(point, overlap, penalty) result(law)
      !> With its line, its length, and its round end
      type(contact_point_t), intent(in) :: point
      !> [m], and eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: overlap, penalty

      law%per_length = place_force(point%yielding_place, point%line, overlap, penalty)
      law%of_end = force_of_end(point%lap%round_end, overlap)
      law%force = point%weight*law%per_length%force + law%of_end%force
      law%stiffness = point%weight*law%per_length%stiffness + law%of_end%stiffness
      law%energy = point%weight*law%per_length%energy + law%of_end%energy
   end function law_of_place

   !> What the line has of the force of a point; of a crossing all of it [N].
   elemental real(dp) function force_along_line(point) result(force)
      type(contact_point_t), intent(in) :: point

      force = point%force - point%lap%round_end%force
   end function force_along_line

end module litz_place_forces
