!> Current, heat and temperatures of a contact spot whose constrictions are warmed, and resist more, by the current.
!>
!> The constrictions have the shapes `c_i` [1/m], in series with a film. Of the voltage V the constriction in wire i has
!> the part `w_i`, the film `w_f`; G is the conductance of all, and `mu G` the heat that flows through the film towards
!> wire 1. Over the part x of its voltage, from the bulk, with `Theta` of litz_spot_metal,
!>
!>     Theta(T(x)) = w_i (a_i x - V^2 w_i x^2/2),    q_i = G a_i                                                     (1)
!>     G c = w_i int_0^1 sigma(T(x)) dx                                                                              (2)
!>     T_face1 - T_face2 + r G mu = 0,    a_i = +-mu + V^2 (w_i + w_f/2),    w_1 + w_f + w_2 = 1,    w_f = R_f G     (3)
!>
!> in which nothing is divided by V or I. The unknowns of Newton's method are w_1, G over that of the cold spot, and mu.
!> Source: theory section 13, `I = S int sigma(T(phi)) dphi`; F. Kohlrausch, Ann. Phys. 306 (1900) 132; J. A. Greenwood,
!> J. B. P. Williamson, Proc. R. Soc. A 246 (1958) 13.
module litz_hot_spot
   use litz_kinds, only: dp
   use litz_property_table, only: property_at
   use litz_spot_metal, only: spot_metal_t, rise_above_bulk, theta_between, kinks_of
   implicit none
   private
   public :: hot_spot_t, constrictions_t, hot_spot, hot_ok, hot_bad_data, hot_no_solution
   public :: by_volt, by_both

   integer, parameter :: hot_ok = 0
   !> A conductance or resistivity that is not positive
   integer, parameter :: hot_bad_data = -1
   !> Newton's method has not found one
   integer, parameter :: hot_no_solution = -2

   !> Columns of the derivatives: V, T_1, T_2
   integer, parameter :: by_volt = 1, by_both(2) = [2, 3]

   !> Half of the abscissae and weights of Gauss on (0, 1), the other half is symmetric
   integer, parameter :: n_gauss = 16
   real(dp), parameter :: near_end(n_gauss/2) = [ &
      0.00529953250417503_dp, 0.02771248846338370_dp, 0.06718439880608412_dp, 0.12229779582249850_dp, &
      0.19106187779867811_dp, 0.27099161117138632_dp, 0.35919822461037054_dp, 0.45249374508118129_dp]
   real(dp), parameter :: half_weight(n_gauss/2) = [ &
      0.01357622970587709_dp, 0.03112676196932373_dp, 0.04757925584124630_dp, 0.06231448562776704_dp, &
      0.07479799440828835_dp, 0.08457825969750132_dp, 0.09130170752246182_dp, 0.09472530522753432_dp]
   real(dp), parameter :: abscissa(n_gauss) = [near_end, 1 - near_end(n_gauss/2:1:-1)]
   real(dp), parameter :: weight(n_gauss) = [half_weight, half_weight(n_gauss/2:1:-1)]

   !> Newton's method ends with a step of this size, over the unknowns; it converges quadratically
   real(dp), parameter :: last_step = 1.0e-10_dp
   integer, parameter :: max_iterations = 60
   !> A step leaves this part of what has to stay positive
   real(dp), parameter :: least_part = 0.2_dp

   !> The way of the current.
   type :: constrictions_t
      !> c [1/m], on either side
      real(dp) :: shape(2) = 0
      !> Of the film: resistance [ohm] and resistance to heat [K/W]
      real(dp) :: film_resistance = 0, film = 0
      !> Wiedemann-Franz metals, their Lorenz number [V^2/K^2], 0: that of their tables at the bulk; and absolute zero
      !> on the scale of the temperatures [K]
      logical :: is_metal = .false.
      real(dp) :: lorenz = 0, zero = 0
   end type constrictions_t

   type :: hot_spot_t
      !> [A], [S]
      real(dp) :: current = 0, conductance = 0
      !> To the bulks of wire 1 and 2 [W], and highest temperature in the constriction of either [K]
      real(dp) :: heat(2) = 0, hottest(2) = 0
      !> Derivatives by the columns above: [S, A/K], (2, :) [A, W/K], (2, :) [K/V, 1]
      real(dp) :: dcurrent(3) = 0, dheat(2, 3) = 0, dhottest(2, 3) = 0
   end type hot_spot_t

   !> Derivatives of what belongs to the way: by w_1, G over that of the cold spot, mu, V^2, T_1, T_2
   integer, parameter :: n_unknowns = 3, n_all = 6
   !> Those of a constriction: by w, a, V^2, T of its bulk
   integer, parameter :: n_own = 4

   !> One constriction at the present iterate.
   type :: side_t
      !> w and a [V^2], and their derivatives by all, with V^2 and T of the bulk (n_own, n_all)
      real(dp) :: share = 0, entering = 0, dby(n_own, n_all) = 0
      !> Mean of sigma over the voltage [S/m] and rise of the face [K], and their derivatives (n_own)
      real(dp) :: sigma = 0, dsigma(n_own) = 0, face = 0, dface(n_own) = 0
      !> T of the bulk [K], L there [V^2/K^2] or 0, and its derivative
      real(dp) :: bulk = 0, lorenz = 0, dlorenz = 0
   end type side_t

contains

   pure subroutine hot_spot(way, metals, voltage, temperature, found, info)
      type(constrictions_t), intent(in) :: way
      !> Of wire 1 and 2 (2)
      type(spot_metal_t), intent(in) :: metals(2)
      !> Of constrictions and film, of either sign [V]; of the bulks (2) [K]
      real(dp), intent(in) :: voltage, temperature(2)
      type(hot_spot_t), intent(out) :: found
      !> `hot_ok`, `hot_bad_data` or `hot_no_solution`
      integer, intent(out) :: info
      type(side_t) :: side(2)
      real(dp) :: unknown(n_unknowns), left(n_unknowns), slope(n_unknowns, n_all), cold
      real(dp) :: follows(n_unknowns, n_all - n_unknowns)
      integer :: iteration
      logical :: solved

      info = hot_bad_data
      if (.not. (all(way%shape > 0) .and. way%film_resistance >= 0 .and. way%film >= 0)) return
      if (way%is_metal .and. .not. all(temperature > way%zero)) return
      call start(way, metals, temperature, voltage**2, side, unknown, cold, solved)
      if (.not. solved) return
      info = hot_no_solution
      do iteration = 1, max_iterations
         call find_sides(way, metals, voltage**2, cold, unknown, side)
         call residual(way, cold, unknown, side, left, slope)
         call eliminate(slope(:, :n_unknowns), reshape(left, [n_unknowns, 1]), follows(:, :1), solved)
         if (.not. solved) return
         unknown = unknown - part_of_step(way%film_resistance*cold, unknown, follows(:, 1))*follows(:, 1)
         if (all(abs(follows(:2, 1)) <= last_step) .and. abs(follows(3, 1)) <= last_step*(abs(unknown(3)) &
            + voltage**2)) exit
      end do
      if (iteration > max_iterations) return
      call find_sides(way, metals, voltage**2, cold, unknown, side)
      call residual(way, cold, unknown, side, left, slope)
      call eliminate(slope(:, :n_unknowns), -slope(:, n_unknowns + 1:), follows, solved)
      if (.not. solved) return
      info = hot_ok
      call describe(way, metals, voltage, cold, unknown, side, follows, found)
   end subroutine hot_spot

   !> The cold spot; mu of constant properties.
   pure subroutine start(way, metals, temperature, square, side, unknown, cold, ok)
      type(constrictions_t), intent(in) :: way
      type(spot_metal_t), intent(in) :: metals(2)
      !> Of the bulks (2) [K]; V^2
      real(dp), intent(in) :: temperature(2), square
      type(side_t), intent(out) :: side(2)
      !> (n_unknowns), and conductance of the cold spot [S]
      real(dp), intent(out) :: unknown(n_unknowns), cold
      !> Data are allowed
      logical, intent(out) :: ok
      real(dp) :: rho(2), lambda(2), drho(2), dlambda(2), share(2), of_film, kappa(2)
      integer :: i

      do i = 1, 2
         call property_at(metals(i)%resistivity, temperature(i), rho(i), drho(i))
         lambda(i) = 1
         dlambda(i) = 0
         if (.not. (way%is_metal .and. way%lorenz > 0)) call property_at(metals(i)%heat_conductivity, &
            temperature(i), lambda(i), dlambda(i))
      end do
      unknown = 0
      cold = 0
      ok = all(rho > 0) .and. all(lambda > 0)
      if (.not. ok) return
      side%bulk = temperature
      kappa = lambda*rho
      if (way%is_metal) then
         side%bulk = temperature - way%zero
         side%lorenz = way%lorenz
         if (.not. way%lorenz > 0) then
            side%lorenz = lambda*rho/side%bulk
            side%dlorenz = side%lorenz*(drho/rho + dlambda/lambda - 1/side%bulk)
         end if
         kappa = side%lorenz*side%bulk
      end if
      cold = 1/(sum(way%shape*rho) + way%film_resistance)
      of_film = way%film_resistance*cold
      share = way%shape*rho*cold
      unknown(:2) = [share(1), 1.0_dp]
      unknown(3) = (temperature(2) - temperature(1) - share(1)*square*(share(1) + of_film)/2/kappa(1) &
         + share(2)*square*(share(2) + of_film)/2/kappa(2))/(sum(share/kappa) + way%film*cold)
   end subroutine start

   !> Both constrictions by (1) and (2).
   pure subroutine find_sides(way, metals, square, cold, unknown, side)
      type(constrictions_t), intent(in) :: way
      type(spot_metal_t), intent(in) :: metals(2)
      !> V^2, conductance of the cold spot [S], unknowns (n_unknowns)
      real(dp), intent(in) :: square, cold, unknown(n_unknowns)
      type(side_t), intent(inout) :: side(2)
      real(dp) :: of_film, dfilm(n_all), sign_of_mu
      integer :: i

      of_film = way%film_resistance*cold*unknown(2)
      dfilm = 0
      dfilm(2) = way%film_resistance*cold
      side%share = [unknown(1), 1 - unknown(1) - of_film]
      do i = 1, 2
         sign_of_mu = 3 - 2*i
         side(i)%entering = sign_of_mu*unknown(3) + square*(side(i)%share + of_film/2)
         side(i)%dby = 0
         side(i)%dby(1, 1) = sign_of_mu
         if (i == 2) side(i)%dby(1, :) = side(i)%dby(1, :) - dfilm
         side(i)%dby(2, :) = square*(side(i)%dby(1, :) + dfilm/2)
         side(i)%dby(2, 3) = side(i)%dby(2, 3) + sign_of_mu
         side(i)%dby(2, 4) = side(i)%dby(2, 4) + side(i)%share + of_film/2
         side(i)%dby(3, 4) = 1
         side(i)%dby(4, 4 + i) = 1
         call pass_constriction(metals(i), way%zero, square, side(i))
      end do
   end subroutine find_sides

   !> (1) and (2) of one constriction, from kink to kink of its properties.
   pure subroutine pass_constriction(metal, zero, square, side)
      type(spot_metal_t), intent(in) :: metal
      !> Absolute zero on the scale of the tables [K]; V^2
      real(dp), intent(in) :: zero, square
      type(side_t), intent(inout) :: side
      real(dp), allocatable :: ends(:)
      real(dp) :: x, of_point, rise, drise(n_own), rho, drho, of_metal
      integer :: piece, i

      of_metal = merge(zero, 0.0_dp, side%lorenz > 0)
      allocate (ends, source=pieces(metal, of_metal, square, side))
      side%sigma = 0
      side%dsigma = 0
      do piece = 1, size(ends) - 1
         do i = 1, n_gauss
            ! squared, as sigma of a metal may go with the root of the distance to a place near the bulk
            x = ends(piece) + (ends(piece + 1) - ends(piece))*abscissa(i)**2
            of_point = (ends(piece + 1) - ends(piece))*2*abscissa(i)*weight(i)
            call rise_at(metal, square, x, side, rise, drise)
            call property_at(metal%resistivity, side%bulk + of_metal + rise, rho, drho)
            side%sigma = side%sigma + of_point/rho
            side%dsigma = side%dsigma - of_point*drho/rho**2*drise
         end do
      end do
      call rise_at(metal, square, 1.0_dp, side, side%face, side%dface)
   end subroutine pass_constriction

   !> T(x) of (1) above the bulk; the derivative by the temperature of the bulk is that of T.
   pure subroutine rise_at(metal, square, x, side, rise, drise)
      type(spot_metal_t), intent(in) :: metal
      !> V^2; part of the voltage from the bulk
      real(dp), intent(in) :: square, x
      type(side_t), intent(in) :: side
      !> [K], and its derivatives (n_own)
      real(dp), intent(out) :: rise, drise(n_own)
      real(dp) :: theta

      associate (w => side%share, a => side%entering)
         theta = w*x*(a - square*w*x/2)
         drise(:3) = [x*(a - square*w*x), w*x, -(w*x)**2/2]
      end associate
      call finish_rise(metal, side, theta, rise, drise)
   end subroutine rise_at

   !> From Theta and its derivatives to the temperature and its own.
   pure subroutine finish_rise(metal, side, theta, rise, drise)
      type(spot_metal_t), intent(in) :: metal
      type(side_t), intent(in) :: side
      !> [V^2]
      real(dp), intent(in) :: theta
      !> [K]
      real(dp), intent(out) :: rise
      !> In: of Theta by the first three; out: of T (n_own)
      real(dp), intent(inout) :: drise(n_own)
      real(dp) :: slope, by_bulk

      call rise_above_bulk(metal, side%lorenz, side%bulk, theta, rise, slope, by_bulk)
      drise(:3) = slope*drise(:3)
      drise(4) = by_bulk
      if (side%lorenz > 0) drise(4) = by_bulk - slope*theta*side%dlorenz/side%lorenz
   end subroutine finish_rise

   !> Ends of the pieces between the kinks of the properties, from 0 to 1.
   pure function pieces(metal, zero, square, side) result(ends)
      type(spot_metal_t), intent(in) :: metal
      !> Of the temperatures of the side on the scale of the tables [K]; V^2
      real(dp), intent(in) :: zero, square
      type(side_t), intent(in) :: side
      real(dp), allocatable :: ends(:)
      real(dp), allocatable :: kinks(:)
      real(dp) :: theta, half_sum, root, x(2)
      integer :: i, j

      allocate (kinks, source=kinks_of(metal, side%lorenz))
      allocate (ends(2), source=[0.0_dp, 1.0_dp])
      if (size(kinks) < 2) return
      associate (w => side%share, a => side%entering)
         do i = 1, size(kinks)
            theta = theta_between(metal, side%lorenz, side%bulk, kinks(i) - zero)
            root = a**2 - 2*square*theta
            if (.not. root >= 0) cycle
            ! roots of theta = (a - V^2 w x/2) w x
            half_sum = a + sign(sqrt(root), a)
            if (.not. abs(half_sum) > 0) cycle
            x = 2
            x(1) = 2*theta/(half_sum*w)
            if (square*w > 0) x(2) = half_sum/(square*w)
            do j = 1, 2
               if (x(j) > 0 .and. x(j) < 1) ends = [pack(ends, ends < x(j)), x(j), pack(ends, ends > x(j))]
            end do
         end do
      end associate
   end function pieces

   !> (2) and (3), with their derivatives.
   pure subroutine residual(way, cold, unknown, side, left, slope)
      type(constrictions_t), intent(in) :: way
      !> Conductance of the cold spot [S], unknowns (n_unknowns)
      real(dp), intent(in) :: cold, unknown(n_unknowns)
      type(side_t), intent(in) :: side(2)
      !> (n_unknowns) and (n_unknowns, n_all)
      real(dp), intent(out) :: left(n_unknowns), slope(n_unknowns, n_all)
      real(dp) :: of_shape(2)
      integer :: i

      of_shape = 1/(way%shape*cold)
      do i = 1, 2
         left(i) = of_shape(i)*side(i)%share*side(i)%sigma - unknown(2)
         slope(i, :) = of_shape(i)*(side(i)%sigma*side(i)%dby(1, :) + side(i)%share*matmul(side(i)%dsigma, side(i)%dby))
         slope(i, 2) = slope(i, 2) - 1
      end do
      left(3) = side(1)%bulk - side(2)%bulk + side(1)%face - side(2)%face + way%film*cold*unknown(2)*unknown(3)
      slope(3, :) = matmul(side(1)%dface, side(1)%dby) - matmul(side(2)%dface, side(2)%dby)
      slope(3, 2:3) = slope(3, 2:3) + way%film*cold*[unknown(3), unknown(2)]
   end subroutine residual

   !> Of a step of Newton's method that leaves all parts of the voltage, and the conductance, positive.
   pure real(dp) function part_of_step(of_film, unknown, step) result(part)
      !> R_f over the resistance of the cold spot; unknowns and what is taken off them (n_unknowns)
      real(dp), intent(in) :: of_film, unknown(n_unknowns), step(n_unknowns)
      real(dp), dimension(3) :: positive, less

      positive = [unknown(:2), 1 - unknown(1) - of_film*unknown(2)]
      less = [step(:2), -step(1) - of_film*step(2)]
      part = minval([1.0_dp, (1 - least_part)*pack(positive/merge(less, 1.0_dp, less > 0), less > 0)])
   end function part_of_step

   !> Current, heats and temperatures.
   pure subroutine describe(way, metals, voltage, cold, unknown, side, follows, found)
      type(constrictions_t), intent(in) :: way
      type(spot_metal_t), intent(in) :: metals(2)
      !> V [V], conductance of the cold spot [S], unknowns (n_unknowns), and how these follow V^2, T_1 and T_2
      real(dp), intent(in) :: voltage, cold, unknown(n_unknowns), follows(n_unknowns, n_all - n_unknowns)
      type(side_t), intent(in) :: side(2)
      type(hot_spot_t), intent(inout) :: found
      real(dp) :: dby(n_own, 3), dconductance(3)
      integer :: i

      found%conductance = cold*unknown(2)
      dconductance = cold*follows(2, :)*[2*voltage, 1.0_dp, 1.0_dp]
      found%current = found%conductance*voltage
      found%dcurrent = dconductance*voltage
      found%dcurrent(by_volt) = found%dcurrent(by_volt) + found%conductance
      do i = 1, 2
         dby = matmul(side(i)%dby(:, :n_unknowns), follows) + side(i)%dby(:, n_unknowns + 1:)
         dby(:, 1) = 2*voltage*dby(:, 1)
         found%heat(i) = found%conductance*side(i)%entering
         found%dheat(i, :) = dconductance*side(i)%entering + found%conductance*dby(2, :)
         call find_hottest(metals(i), way%zero, voltage**2, side(i), dby, found%hottest(i), found%dhottest(i, :))
      end do
   end subroutine describe

   !> The hottest of bulk, face, and the place within where the heat changes its direction.
   pure subroutine find_hottest(metal, zero, square, side, dby, hottest, dhottest)
      type(spot_metal_t), intent(in) :: metal
      !> Absolute zero on the scale of the tables [K]; V^2; what belongs to the side by V, T_1 and T_2 (n_own, 3)
      real(dp), intent(in) :: zero, square, dby(n_own, 3)
      type(side_t), intent(in) :: side
      !> [K], and by V, T_1 and T_2 (3)
      real(dp), intent(out) :: hottest, dhottest(3)
      real(dp) :: rise, drise(n_own)

      rise = 0
      drise = [0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp]
      associate (a => side%entering)
         if (a > 0 .and. a <= square*side%share) then
            drise(:3) = [0.0_dp, a/square, -(a/square)**2/2]
            call finish_rise(metal, side, a/square*a/2, rise, drise)
         else if (side%face > 0) then
            rise = side%face
            drise = side%dface
         end if
      end associate
      hottest = side%bulk + merge(zero, 0.0_dp, side%lorenz > 0) + rise
      dhottest = matmul(drise, dby)
   end subroutine find_hottest

   !> `x = k^-1 b` by elimination with pivots.
   pure subroutine eliminate(k, b, x, ok)
      !> (n, n), (n, m)
      real(dp), intent(in) :: k(:, :), b(:, :)
      !> (n, m)
      real(dp), intent(out) :: x(:, :)
      !> The matrix is regular, and all are numbers
      logical, intent(out) :: ok
      real(dp) :: rows(size(k, 1), size(k, 1) + size(b, 2)), row(size(k, 1) + size(b, 2))
      integer :: n, i, j, pivot

      n = size(k, 1)
      rows(:, :n) = k
      rows(:, n + 1:) = b
      x = 0
      ok = .false.
      do i = 1, n
         pivot = i - 1 + maxloc(abs(rows(i:, i)), 1)
         if (.not. (abs(rows(pivot, i)) > 0 .and. abs(rows(pivot, i)) <= huge(1.0_dp))) return
         row = rows(pivot, :)
         rows(pivot, :) = rows(i, :)
         rows(i, :) = row/row(i)
         do j = 1, n
            if (j /= i) rows(j, :) = rows(j, :) - rows(j, i)*rows(i, :)
         end do
      end do
      x = rows(:, n + 1:)
      ok = all(abs(x) <= huge(1.0_dp))
   end subroutine eliminate

end module litz_hot_spot
