!> What a place along a line has of the lap of its wires: the length that it stands for and the bound of its far field,
!> and how both change as the ends of the lap move.
!>
!> Source: theory section 10.
module litz_lap_of_place
   use litz_kinds, only: dp
   use litz_line_law, only: line_wires_t, line_force_t, line_change_t, change_by_section
   use litz_round_end, only: round_end_t, end_force_t
   implicit none
   private
   public :: lap_of_place_t, lap_force_t, force_along_lap

   type :: lap_of_place_t
      !> How the length for which the place stands changes with the distance of its foot from the end of the other wire
      !> [-], and how that does [1/m]
      real(dp) :: dweight = 0, d2weight = 0
      !> `exp(-2 Lambda)/b^2` of a strip as long as a short lap [1/m^2], and how it changes with that distance [1/m^3]
      real(dp) :: strip_bound = 0, dstrip_bound = 0
      !> Force along the other wire by the curvature of the energy per length, which the linear course up to the end of
      !> the lap does not have [N], and how it changes with that distance [N/m]
      real(dp) :: of_course = 0, dof_course = 0
      !> Force [N/m] and stiffness [N/m^2] per length at the present overlap
      real(dp) :: force = 0, stiffness = 0
      !> At the end of the wire of the place: that beside the line
      type(round_end_t) :: round_end
   end type lap_of_place_t

   !> Force along the other wire [N], how it changes with the overlap [N/m] and with the place [N/m].
   type :: lap_force_t
      real(dp) :: force = 0, by_overlap = 0, stiffness = 0
   end type lap_force_t

contains

   !> What the energy of a place, `W Pi_l` and that of the round end, does along the other wire as the lap changes.
   pure type(lap_force_t) function force_along_lap(lap, line, weight, law, of_end) result(along)
      type(lap_of_place_t), intent(in) :: lap
      !> As the place sees it
      type(line_wires_t), intent(in) :: line
      !> W [m]
      real(dp), intent(in) :: weight
      !> At the overlap
      type(line_force_t), intent(in) :: law
      type(end_force_t), intent(in) :: of_end
      type(line_change_t) :: change
      real(dp) :: slope, curvature

      associate (dbeyond => lap%round_end%dbeyond)
         along%force = lap%dweight*law%energy + lap%of_course + dbeyond*of_end%along
         along%by_overlap = lap%dweight*law%force + dbeyond*of_end%along_by_overlap
         along%stiffness = lap%d2weight*law%energy + lap%dof_course + dbeyond**2*of_end%along_stiffness
      end associate
      if (.not. abs(lap%dstrip_bound) > 0) return
      if (.not. line%section > 0 .or. law%too_wide) return
      ! of ln(section), the sum of that of the wires and that of the strip
      slope = lap%dstrip_bound/line%section
      curvature = -slope**2
      change = change_by_section(line, law%force)
      along%force = along%force + weight*slope*change%energy
      along%by_overlap = along%by_overlap + weight*slope*change%force
      along%stiffness = along%stiffness + (2*lap%dweight*slope + weight*curvature)*change%energy &
         + weight*slope**2*change%d2energy
   end function force_along_lap

end module litz_lap_of_place
