!> Positions and displacements of nodes, each with all the digits that it can have.
module litz_positions
   use litz_kinds, only: dp
   implicit none
   private
   public :: agree

   !> A displacement that is a smaller part of its coordinate loses digits that count in the position
   real(dp), parameter :: small_part = 1.0e-8_dp

contains

   !> A small displacement decides on the position; otherwise the position does on the displacement, whose digits may be
   !> coarser, as those of wires that are rolled up far from where they were.
   elemental subroutine agree(reference, x, displacement)
      !> Coordinate in the reference configuration [m]
      real(dp), intent(in) :: reference
      !> Position and displacement, each found by itself [m]
      real(dp), intent(inout) :: x, displacement

      if (abs(displacement) < small_part*abs(reference)) then
         x = reference + displacement
      else
         displacement = x - reference
      end if
   end subroutine agree

end module litz_positions
