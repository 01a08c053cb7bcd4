!> What a contact remembers from one converged increment to the next: friction and the largest spot.
!>
!> The memory is that of the converged state. An increment that fails leaves no trace in it, because the iteration only
!> reads it; a contact that opens loses it.
module litz_contact_history
   use litz_kinds, only: dp
   use litz_friction_law, only: friction_law_t, friction_slip
   use litz_hertz, only: hertz_ellipse_t
   use litz_law_input, only: earlier_dent_t
   implicit none
   private
   public :: contact_history_t, spot_shape_t, dent_memory_t, left_dents_t, advanced_history, spot_of_history
   public :: force_of_spot

   !> The dent of wires that yield, which a contact that opens keeps.
   type :: dent_memory_t
      !> Largest force, whatever the share of the contact [N]; 0: none. The arc lengths where it acted (2) [m]
      real(dp) :: force = 0, arc(2) = 0
      !> Deepest overlap since then [m]
      real(dp) :: overlap = 0
      !> What the contact still feels of this force, which has slid off a part of the dent [-]
      real(dp) :: left = 1
      !> Force of the dent that is felt at the last angle, and as the contact has slid, [N] or [N/m]
      real(dp) :: felt = 0
      !> What yielding has dissipated [J]
      real(dp) :: dissipation = 0
      !> How far the section of the wires was its far field when it was made [-]
      real(dp) :: section_share = 0
   contains
      procedure :: felt_force, at_any_angle, at_last_angle
      procedure :: share_of_section
   end type dent_memory_t

   !> Dents of contacts that have opened so far that their wires are no longer near each other.
   type :: left_dents_t
      !> Contact pair, barred and unbarred wire (3, n)
      integer, allocatable :: wires(:, :)
      type(dent_memory_t), allocatable :: dents(:)
   end type left_dents_t

   !> The shape of the spot of a crossing: next to an end that of a smaller overlap is another one.
   type :: spot_shape_t
      type(hertz_ellipse_t) :: ellipse
      !> Sine of the angle that its law sees [-], overlap [m], and what ends leave of its conductance [-]
      real(dp) :: sine = 0, overlap = 0, part = 1
      !> Force of the whole contact at this overlap if no wire ended there [N]; of a place of a line per length [N/m]
      real(dp) :: uncut_force = 0
   end type spot_shape_t

   type :: contact_history_t
      !> The contact was closed; all else is zero where it was not
      logical :: closed = .false.
      !> Arc lengths of the closest points along the barred and the unbarred wire (2) [m]
      real(dp) :: arc(2) = 0
      !> Normal force [N]
      real(dp) :: force = 0
      !> Traction in the directions of litz_wire_friction (2) [N], the first of which, except at a point of a line, is
      !> between the two wires, or between the one and the reverse of the other
      real(dp) :: traction(2) = 0
      logical :: reverses = .false.
      !> It has slipped at the end of the last increment
      logical :: slips = .false.
      !> Share of a crossing [-], or length that a point of a line stood for [m]
      real(dp) :: weight = 0
      !> Path of the slip since the contact closed [m], and the heat that friction made of it [J]
      real(dp) :: slip_path = 0, dissipation = 0
      !> That of the last increment alone [J]
      real(dp) :: last_dissipation = 0
      !> What the dent of wires that yield adds to the coefficient of friction [-]
      real(dp) :: ploughing = 0
      !> Energy of the tangential spring [J]
      real(dp) :: elastic_energy = 0
      !> Largest force of the whole contact, whatever its share, since it closed or last left its spot: of a crossing
      !> [N], of a place of a line per length [N/m]; and the arc lengths where it had it (2) [m]
      real(dp) :: largest_force = 0
      real(dp) :: spot_arc(2) = 0
      !> Of a crossing: what shape its spot had then
      type(spot_shape_t) :: spot_shape
      type(dent_memory_t) :: dent
      !> Heat in whose steady state the temperature within both elements would be, slow and fast part, barred and
      !> unbarred (2, 2) [W]
      real(dp) :: settled_heat(2, 2) = 0
   end type contact_history_t

contains

   !> Largest force of the dent as an increment feels it at any angle [N], of a place per length [N/m].
   elemental real(dp) function felt_force(self)
      class(dent_memory_t), intent(in) :: self

      felt_force = self%left*self%force
   end function felt_force

   !> What a crossing remembers of its dent.
   elemental type(earlier_dent_t) function at_any_angle(self) result(dent)
      class(dent_memory_t), intent(in) :: self

      dent = earlier_dent_t(self%force, self%overlap, self%left)
   end function at_any_angle

   !> The dent as the crossing has felt it last.
   elemental type(earlier_dent_t) function at_last_angle(self) result(dent)
      class(dent_memory_t), intent(in) :: self

      dent = earlier_dent_t(force=self%felt)
   end function at_last_angle

   !> How far the section of the wires counts at least where it counts this far at the present overlap: metal that has
   !> yielded keeps the far field with which it did [-]
   elemental real(dp) function share_of_section(self, present) result(share)
      class(dent_memory_t), intent(in) :: self
      !> [-]
      real(dp), intent(in) :: present

      share = present
      if (self%force > 0) share = present + self%left*max(self%section_share - present, 0.0_dp)
   end function share_of_section

   !> The memory of a contact that is closed when an increment has converged.
   pure function advanced_history(start, arc, force, weight, spot_force, shape, friction, new_spot) result(history)
      type(contact_history_t), intent(in) :: start
      !> Arc lengths (2) [m], normal force [N], share [-] or length [m]
      real(dp), intent(in) :: arc(2), force, weight
      !> Force of the whole contact [N] or per length [N/m]
      real(dp), intent(in) :: spot_force
      !> Of a crossing
      type(spot_shape_t), intent(in) :: shape
      type(friction_law_t), intent(in) :: friction
      !> The contact has left the spot of its largest force
      logical, intent(in) :: new_spot
      type(contact_history_t) :: history

      history%closed = .true.
      history%arc = arc
      history%force = force
      history%weight = weight
      history%traction = friction%traction
      history%slips = friction%status == friction_slip
      history%slip_path = start%slip_path + norm2(friction%plastic_slip)
      history%dissipation = start%dissipation + friction%dissipation
      history%last_dissipation = friction%dissipation
      history%elastic_energy = start%elastic_energy + friction%elastic_work
      call remember_spot(start, arc, spot_force, shape, new_spot, history)
   end function advanced_history

   !> What is left of the memory where the wires still overlap, but other points carry the contact: their spot, which
   !> goes on to be that of the whole contact.
   pure type(contact_history_t) function spot_of_history(start, arc, spot_force, shape, new_spot) result(history)
      type(contact_history_t), intent(in) :: start
      !> Arc lengths (2) [m], and force of the whole contact [N] or per length [N/m]; 0: unknown
      real(dp), intent(in) :: arc(2), spot_force
      !> Of a crossing
      type(spot_shape_t), intent(in) :: shape
      !> The contact has left the spot of its largest force
      logical, intent(in) :: new_spot

      call remember_spot(start, arc, spot_force, shape, new_spot, history)
   end function spot_of_history

   !> The largest force, where it was, and the shape of the spot.
   pure subroutine remember_spot(start, arc, spot_force, shape, new_spot, history)
      type(contact_history_t), intent(in) :: start
      !> Arc lengths (2) [m], force [N] or force per length [N/m]
      real(dp), intent(in) :: arc(2), spot_force
      !> Of a crossing
      type(spot_shape_t), intent(in) :: shape
      !> The contact has left the spot of its largest force
      logical, intent(in) :: new_spot
      type(contact_history_t), intent(inout) :: history

      history%largest_force = start%largest_force
      history%spot_arc = start%spot_arc
      history%spot_shape = start%spot_shape
      if (.not. (new_spot .or. shape%uncut_force >= start%spot_shape%uncut_force)) return
      history%largest_force = spot_force
      history%spot_arc = arc
      history%spot_shape = shape
   end subroutine remember_spot

   !> Force that has made the spot of a contact, and its derivative with respect to the present force.
   !>
   !> A spot that is kept stays as large as it has been; where a contact slips, the present force makes a new one. Ends
   !> may take force from a contact that is pressed on: what would be there without them tells whether it was larger.
   pure subroutine force_of_spot(keeps_spot, history, force, uncut_force, new_spot, spot_force, dspot_force)
      !> The spot stays as large as the largest force has made it
      logical, intent(in) :: keeps_spot
      type(contact_history_t), intent(in) :: history
      !> Present normal force: of a crossing [N], of a place of a line per length [N/m]
      real(dp), intent(in) :: force
      !> The same if no wire ended there [N, N/m]
      real(dp), intent(in) :: uncut_force
      !> The contact has slipped or moved off the spot of the largest force
      logical, intent(in) :: new_spot
      !> Force that makes the spot [N, N/m], and its derivative with respect to the present one [-]
      real(dp), intent(out) :: spot_force, dspot_force

      spot_force = force
      dspot_force = 1
      if (.not. keeps_spot .or. new_spot .or. history%spot_shape%uncut_force <= uncut_force) return
      spot_force = history%largest_force
      dspot_force = 0
   end subroutine force_of_spot

end module litz_contact_history
