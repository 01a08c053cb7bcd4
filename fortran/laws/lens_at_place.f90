!> The lens of a crossing as one of the places in it sees it, whose distance goes as `D + t s + k s^2/2` along its wire.
!>
!> Source: theory section 10. The deepest overlap is `delta_m = delta + t^2/(2 k)`, half the length
!> `aW = sqrt(2 delta_m/k)`, and the force `aW int f du` that of litz_lens_law. All change with overlap, slope and
!> curvature at the place.
module litz_lens_at_place
   use litz_kinds, only: dp
   use litz_lens_law, only: gauss_depth, gauss_weight, n_depths
   use litz_line_cell, only: n_of_cell, line_cell_t
   use litz_line_law, only: line_wires_t, line_force_t, line_force
   implicit none
   private
   public :: deepest_overlap_t, deepest_overlap, lens_at_place_t, lens_at_place, integral_at_place

   type :: deepest_overlap_t
      !> delta_m [m], and its derivatives (3)
      real(dp) :: value = 0, derivative(n_of_cell) = 0
   end type deepest_overlap_t

   !> All 0 where there is no lens.
   type :: lens_at_place_t
      !> aW [m] and force [N], and their derivatives (3)
      real(dp) :: half_length = 0, force = 0
      real(dp) :: dhalf_length(n_of_cell) = 0, dforce(n_of_cell) = 0
      type(deepest_overlap_t) :: deepest
      !> Law at the Gauss points of litz_lens_law
      type(line_force_t) :: along(n_depths)
   end type lens_at_place_t

contains

   !> Of the lens in which a cell lies that overlaps more deeply than it does, if so.
   pure type(deepest_overlap_t) function deepest_overlap(cell, deeper) result(deepest)
      !> With a curvature that is positive
      type(line_cell_t), intent(in) :: cell
      !> How much [m]; its sum with the overlap of the cell stays if it is positive
      real(dp), intent(in) :: deeper

      associate (t => cell%slope, k => cell%bend)
         deepest%value = cell%overlap + deeper + t**2/(2*k)
         deepest%derivative = [merge(0.0_dp, 1.0_dp, deeper > 0), t/k, -(t/k)**2/2]
      end associate
   end function deepest_overlap

   pure type(lens_at_place_t) function lens_at_place(line, deepest, bend, penalty) result(lens)
      type(line_wires_t), intent(in) :: line
      type(deepest_overlap_t), intent(in) :: deepest
      !> Curvature of the distance [1/m], and eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: bend, penalty
      real(dp) :: dforce_ddeepest
      integer :: i

      if (.not. (bend > 0 .and. deepest%value > 0)) return
      lens%deepest = deepest
      lens%half_length = sqrt(2*deepest%value/bend)
      lens%dhalf_length = lens%half_length/2*(deepest%derivative/deepest%value - [0.0_dp, 0.0_dp, 1/bend])
      do i = 1, n_depths
         lens%along(i) = line_force(line, deepest%value*gauss_depth(i), penalty)
      end do
      lens%force = lens%half_length*dot_product(gauss_weight, lens%along%force)
      dforce_ddeepest = lens%half_length*dot_product(gauss_weight*gauss_depth, lens%along%stiffness)
      lens%dforce = lens%force/lens%half_length*lens%dhalf_length + dforce_ddeepest*deepest%derivative
   end function lens_at_place

   !> Integral along the lens of what depends on the force per length, and its derivatives.
   pure subroutine integral_at_place(lens, value, slope, integral, derivative)
      type(lens_at_place_t), intent(in) :: lens
      !> At the forces `lens%along`, and its derivative with respect to the force [per N/m]
      real(dp), intent(in) :: value(n_depths), slope(n_depths)
      !> Over the length [m], and its derivatives (3)
      real(dp), intent(out) :: integral, derivative(n_of_cell)
      real(dp) :: mean

      mean = dot_product(gauss_weight, value)
      integral = mean*lens%half_length
      derivative = mean*lens%dhalf_length &
         + lens%half_length*dot_product(gauss_weight*gauss_depth, slope*lens%along%stiffness)*lens%deepest%derivative
   end subroutine integral_at_place

end module litz_lens_at_place
