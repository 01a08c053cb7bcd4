!> The lens of a crossing as one of the places in it sees it, whose distance goes as `D + t s + k s^2/2` along its wire.
!>
!> Source: theory section 10. The deepest overlap is `delta_m = delta + t^2/(2 k)`, half the length
!> `aW = sqrt(2 delta_m/k)`, and the force `aW int f du` that of litz_lens_law.
module litz_lens_at_place
   use litz_kinds, only: dp
   use litz_lens_law, only: gauss_depth, gauss_weight, n_depths
   use litz_line_cell, only: n_of_cell
   use litz_line_law, only: line_wires_t, line_force_t, line_force
   implicit none
   private
   public :: lens_at_place_t, lens_at_place

   !> All 0 where there is no lens.
   type :: lens_at_place_t
      !> aW [m] and force [N], and how both change with overlap, slope and curvature at the place (3)
      real(dp) :: half_length = 0, force = 0
      real(dp) :: dhalf_length(n_of_cell) = 0, dforce(n_of_cell) = 0
   end type lens_at_place_t

contains

   pure type(lens_at_place_t) function lens_at_place(line, overlap, slope, bend, penalty) result(lens)
      type(line_wires_t), intent(in) :: line
      !> delta [m] at the place, slope t [-] and curvature k [1/m] of the distance
      real(dp), intent(in) :: overlap, slope, bend
      !> eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: penalty
      type(line_force_t) :: along(n_depths)
      real(dp) :: deepest, ddeepest(n_of_cell), f
      integer :: i

      if (.not. bend > 0) return
      deepest = overlap + slope**2/(2*bend)
      if (.not. deepest > 0) return
      ddeepest = [1.0_dp, slope/bend, -(slope/bend)**2/2]
      lens%half_length = sqrt(2*deepest/bend)
      lens%dhalf_length = lens%half_length/2*(ddeepest/deepest - [0.0_dp, 0.0_dp, 1/bend])
      do i = 1, n_depths
         along(i) = line_force(line, deepest*gauss_depth(i), penalty)
      end do
      f = dot_product(gauss_weight, along%force)
      lens%force = f*lens%half_length
      lens%dforce = f*lens%dhalf_length &
         + lens%half_length*dot_product(gauss_weight*gauss_depth, along%stiffness)*ddeepest
   end function lens_at_place

end module litz_lens_at_place
