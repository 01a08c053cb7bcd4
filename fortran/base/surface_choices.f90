!> The shapes of rigid surfaces that wires can touch.
module litz_surface_choices
   implicit none
   private
   public :: surface_plane, surface_cylinder, surface_bore

   !> A plane; a cylinder, touched from outside; a bore, touched from inside
   integer, parameter :: surface_plane = 1, surface_cylinder = 2, surface_bore = 3

end module litz_surface_choices
