!> The shapes of rigid surfaces that wires can touch.
module litz_surface_choices
   implicit none
   private
   public :: surface_plane, surface_cylinder, surface_bore, surface_shapes

   !> A plane; a cylinder, touched from outside; a bore, touched from inside
   integer, parameter :: surface_plane = 1, surface_cylinder = 2, surface_bore = 3

   !> Their names in decks and results
   character(len=8), parameter :: surface_shapes(3) = [character(len=8) :: 'PLANE', 'CYLINDER', 'BORE']

end module litz_surface_choices
