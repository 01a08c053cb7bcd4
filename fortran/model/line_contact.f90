!> Whether a surface interaction describes wires that touch along a line, and if not, what of it does not.
module litz_line_contact
   use litz_model, only: model_t, interaction_t, axis_hermite
   use litz_stick_laws, only: stick_laws, stick_stiffness
   implicit none
   private
   public :: serves_lines, line_obstacle

   !> Nothing is in the way; a normal law at points only; straight axes; friction that sticks with the stiffness of a
   !> point; overlap without limit; a law of one spot, of current or of heat; a current or heat that does not follow the
   !> dents of wires that yield
   integer, parameter :: obstacle_none = 0, obstacle_normal_law = 1, obstacle_axis = 2, obstacle_stick = 3, &
      obstacle_penetration = 4, obstacle_spot_law = 5, obstacle_heat_law = 6, obstacle_yielding_spot = 7, &
      obstacle_yielding_heat = 8

contains

   !> Wires of a contact pair can touch along lines.
   pure logical function serves_lines(model, pair)
      type(model_t), intent(in) :: model
      !> Contact pair
      integer, intent(in) :: pair

      serves_lines = obstacle(model%interactions(model%contact_pairs(pair)%interaction)) == obstacle_none
   end function serves_lines

   pure integer function obstacle(law)
      type(interaction_t), intent(in) :: law

      obstacle = obstacle_none
      if (.not. law%normal%serves_lines()) then
         obstacle = obstacle_normal_law
      else if (law%axis /= axis_hermite) then
         obstacle = obstacle_axis
      else if (law%friction > 0 .and. law%stick_law == stick_stiffness) then
         obstacle = obstacle_stick
      else if (law%unlimited_penetration) then
         obstacle = obstacle_penetration
      else if (law%spot%exists() .and. .not. (law%spot%serves_lines .or. law%spot%is_per_length)) then
         obstacle = obstacle_spot_law
      else if (law%heat%is_given() .and. .not. law%heat%is_per_length) then
         obstacle = obstacle_heat_law
      else if (law%normal%yields()) then
         if (law%spot%exists() .and. (law%spot_memory .or. .not. law%spot%is_of_mechanics)) then
            obstacle = obstacle_yielding_spot
         else if (law%heat%is_given()) then
            obstacle = obstacle_yielding_heat
         end if
      end if
   end function obstacle

   !> What of an interaction is for contact at points only; empty: nothing.
   pure function line_obstacle(law) result(words)
      type(interaction_t), intent(in) :: law
      character(len=:), allocatable :: words

      select case (obstacle(law))
      case (obstacle_normal_law)
         words = law%normal%called()
         if (.not. law%normal%yields()) words = words//' without a stiffness per length'
      case (obstacle_axis)
         words = 'AXIS=LINEAR'
      case (obstacle_stick)
         words = trim(stick_laws(law%stick_law)%parameter)//' of *FRICTION, which is that of a contact at a point'
      case (obstacle_penetration)
         words = 'PENETRATION=UNLIMITED'
      case (obstacle_spot_law)
         words = 'LAW='//trim(law%spot%name)//' of *GAP ELECTRICAL CONDUCTANCE, which is that of a spot'
         if (law%spot%can_be_per_length) words = words//' without PER=LENGTH'
      case (obstacle_heat_law)
         words = 'LAW='//trim(law%heat%name)//' of *GAP CONDUCTANCE, which is that of a spot without PER=LENGTH'
      case (obstacle_yielding_spot)
         words = 'LAW='//trim(law%spot%name)//' of *GAP ELECTRICAL CONDUCTANCE'
         if (law%spot_memory) words = 'SPOT=LARGEST FORCE'
         words = words//' with YIELD of *SURFACE BEHAVIOR'
      case (obstacle_yielding_heat)
         words = 'LAW='//trim(law%heat%name)//' of *GAP CONDUCTANCE with YIELD of *SURFACE BEHAVIOR'
      case default
         words = ''
      end select
   end function line_obstacle

end module litz_line_contact
