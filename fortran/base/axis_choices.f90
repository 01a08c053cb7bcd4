!> Interpolations of the wire axes that touch, theory section 3.
!>
!> They stand below both the kernels, which act on them, and the model, which stores them.
module litz_axis_choices
   implicit none
   private
   public :: axis_linear, axis_hermite

   !> Chords between the nodes; cubic curves through the nodes along the nodal tangents
   integer, parameter :: axis_linear = 1, axis_hermite = 2

end module litz_axis_choices
