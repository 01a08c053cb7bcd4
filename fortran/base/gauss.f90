!> Gauss's rule of six points.
module litz_gauss
   use litz_kinds, only: dp
   implicit none
   private

   !> Places between -1 and 1, and their weights, whose sum is 2
   real(dp), parameter, public :: six_places(6) = [-0.93246951420315202781_dp, -0.66120938646626451366_dp, &
      -0.23861918608319690863_dp, 0.23861918608319690863_dp, 0.66120938646626451366_dp, 0.93246951420315202781_dp]
   real(dp), parameter, public :: six_weights(6) = [0.17132449237917034504_dp, 0.36076157304813860757_dp, &
      0.46791393457269104739_dp, 0.46791393457269104739_dp, 0.36076157304813860757_dp, 0.17132449237917034504_dp]
end module litz_gauss
