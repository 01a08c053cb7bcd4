!> Heat and temperatures of a contact spot that carries a current between two wires at different temperatures.
!>
!> The way of the heat has three parts in series: the constriction in wire 1, a film, the constriction in wire 2. In
!> the constrictions potential and temperature are functions of each other, so that the energy flux is the same multiple
!> of the current everywhere. With the heat `Q` that a part makes, half of it goes to either side, and `m`, the mean of
!> what flows through it towards wire 1,
!>
!>     theta(T_face) = theta(T_bulk) + (q_i - Q_i/2)/h_i,    T_face2 - T_face1 = r (q_1 - Q_1 - Q_f/2)               (1)
!>     q_1 + q_2 = Q_1 + Q_f + Q_2                                                                                   (2)
!>
!> `theta = T`, `h` the heat conductance of the constriction for constant properties; `theta = T^2/2`, `h = L G` for a
!> Wiedemann-Franz metal, `lambda rho = L T`, whose constriction has the conductance `G`. Where `q` changes its sign
!> within a constriction is the hottest point,
!>
!>     theta(T_max) = theta(T_bulk) + q^2/(2 Q h),    0 < q <= Q                                                     (3)
!>
!> Source: theory section 13; F. Kohlrausch, Ann. Phys. 306 (1900) 132; R. Holm, Electric Contacts; J. A. Greenwood,
!> J. B. P. Williamson, Proc. R. Soc. A 246 (1958) 13.
module litz_spot_heat
   use litz_kinds, only: dp
   implicit none
   private
   public :: spot_path_t, spot_heat_t, spot_heat, spot_wires_t, spot_heat_of_voltage, hot_conductance
   public :: heat_ok, heat_bad_data
   public :: by_heat, by_temperature, by_path, by_film
   public :: by_voltage, by_conductance, by_bulk

   integer, parameter :: heat_ok = 0
   !> A temperature of a metal or a conductance that is not positive, or a negative resistance or heat
   integer, parameter :: heat_bad_data = -1

   !> Columns of the derivatives of `spot_heat`: Q_1, Q_f, Q_2; T_1, T_2; ln h_1, ln h_2; r
   integer, parameter :: by_heat(3) = [1, 2, 3], by_temperature(2) = [4, 5], by_path(2) = [6, 7], by_film = 8, n_by = 8
   !> Columns of those of `spot_heat_of_voltage`: V, G, T_1, T_2
   integer, parameter :: by_voltage = 1, by_conductance = 2, by_bulk(2) = [3, 4], n_by_voltage = 4

   !> Newton's method stops at this change, relative to the heat that flows; it converges quadratically
   real(dp), parameter :: step_tolerance = 4*epsilon(1.0_dp)
   integer, parameter :: max_iterations = 100

   !> The way of the heat through a spot.
   type :: spot_path_t
      !> Whether h is that of a Wiedemann-Franz metal, wire 1 and wire 2
      logical :: is_metal(2) = .true.
      !> h of the constrictions: L G [W/K^2] of metals, else the heat conductance [W/K]
      real(dp) :: conductance(2) = 0
      !> Of the film to heat, r [K/W]; 0: none
      real(dp) :: film = 0
   end type spot_path_t

   !> What the spot gives to its wires.
   type :: spot_heat_t
      !> q_1, q_2 [W]: to the bulk of wire 1 and 2
      real(dp) :: heat(2) = 0
      !> T_max, and the temperatures of the two faces [K]
      real(dp) :: hottest = 0, face(2) = 0
      !> Derivatives of the heats (2, :) and of T_max (:), by what the columns above say
      real(dp) :: dheat(2, n_by) = 0, dhottest(n_by) = 0
   end type spot_heat_t

   !> Two wires whose constrictions share the voltage in proportion to their resistivities.
   type :: spot_wires_t
      !> Resistivities in any unit; only their ratio counts
      real(dp) :: resistivity(2) = 1
      !> Lorenz numbers [V^2/K^2]; 0: the heat conductance of the constriction counts
      real(dp) :: lorenz(2) = 0
      !> Heat conductance of the constriction of a wire that is no Wiedemann-Franz metal [W/K]
      real(dp) :: heat_conductance(2) = 0
      !> Of the film: resistance [ohm], and resistance to heat [K/W]
      real(dp) :: film_resistance = 0, film = 0
   end type spot_wires_t

contains

   !> Solve (1) and (2) for given heats of the three parts.
   !>
   !> The unknown is m, what flows through the film; the difference of the two faces less that of the film increases
   !> with m. The first guess is exact unless a metal has a film or touches a wire of the other kind.
   pure subroutine spot_heat(path, temperature, heat, found, info)
      type(spot_path_t), intent(in) :: path
      !> Of the bulks, T_1, T_2 [K]
      real(dp), intent(in) :: temperature(2)
      !> Q_1, Q_f, Q_2 [W]
      real(dp), intent(in) :: heat(3)
      type(spot_heat_t), intent(out) :: found
      !> `heat_ok` or `heat_bad_data`
      integer, intent(out) :: info
      real(dp), dimension(2) :: at_rest, entering, rise, kappa
      real(dp) :: m, low, high, difference, step
      integer :: iteration

      info = heat_bad_data
      if (.not. (all(temperature > 0 .or. .not. path%is_metal) .and. all(path%conductance > 0))) return
      if (.not. (all(heat >= 0) .and. path%film >= 0)) return
      info = heat_ok
      associate (t => temperature, h => path%conductance)
         ! what a constriction carries to its bulk, on the mean, where nothing flows through the film
         at_rest = (heat([1, 3]) + heat(2))/2
         kappa = merge(sum(t)/2, 1.0_dp, path%is_metal)
         m = (t(2) - t(1) + at_rest(2)/(h(2)*kappa(2)) - at_rest(1)/(h(1)*kappa(1)))/(sum(1/(h*kappa)) + path%film)
         ! the face of a metal is not below absolute zero
         low = -at_rest(1) - merge(h(1)*t(1)**2/2, huge(low)/4, path%is_metal(1))
         high = at_rest(2) + merge(h(2)*t(2)**2/2, huge(high)/4, path%is_metal(2))
         do iteration = 1, max_iterations
            m = min(max(m, low), high)
            entering = at_rest + [m, -m]
            rise = rise_of_face(path, t, entering)
            kappa = merge(t + rise, 1.0_dp, path%is_metal)
            difference = t(1) - t(2) + rise(1) - rise(2) + path%film*m
            if (difference < 0) low = m
            if (difference > 0) high = m
            step = -difference/(sum(1/(h*kappa)) + path%film)
            ! also where the step is no number
            if (.not. (m + step >= low .and. m + step <= high)) step = (low + high)/2 - m
            m = m + step
            if (abs(step) <= step_tolerance*(abs(m) + sum(at_rest))) exit
         end do
      end associate
      call describe(path, temperature, heat, m, found)
   end subroutine spot_heat

   !> Temperature of the faces above the bulks by (1), without a cancellation.
   pure function rise_of_face(path, temperature, entering) result(rise)
      type(spot_path_t), intent(in) :: path
      !> Of the bulks (2) [K]
      real(dp), intent(in) :: temperature(2)
      !> q - Q/2 (2) [W]
      real(dp), intent(in) :: entering(2)
      real(dp) :: rise(2)

      rise = entering/path%conductance
      where (path%is_metal) rise = 2*rise/(temperature + sqrt(max(temperature**2 + 2*rise, 0.0_dp)))
   end function rise_of_face

   !> Heats and temperatures at the solution, and their derivatives.
   pure subroutine describe(path, temperature, heat, m, found)
      type(spot_path_t), intent(in) :: path
      !> T_1, T_2 [K]; Q_1, Q_f, Q_2 [W]; from the face of wire 2 to that of wire 1 [W]
      real(dp), intent(in) :: temperature(2), heat(3), m
      type(spot_heat_t), intent(inout) :: found
      real(dp) :: entering(2), kappa(2), bulk_kappa(2), dface(2, n_by), dm(n_by), slope(2)
      integer :: i

      associate (h => path%conductance)
         entering = (heat([1, 3]) + heat(2))/2 + [m, -m]
         found%face = temperature + rise_of_face(path, temperature, entering)
         found%heat = [m, -m] + heat([1, 3]) + heat(2)/2
         kappa = merge(found%face, 1.0_dp, path%is_metal)
         bulk_kappa = merge(temperature, 1.0_dp, path%is_metal)
         slope = 1/(h*kappa)
         ! of the faces at fixed m
         dface = 0
         do i = 1, 2
            dface(i, [by_heat(2*i - 1), by_heat(2)]) = slope(i)/2
            dface(i, by_temperature(i)) = bulk_kappa(i)/kappa(i)
            dface(i, by_path(i)) = -entering(i)*slope(i)
         end do
         dm = dface(2, :) - dface(1, :)
         dm(by_film) = -m
         dm = dm/(sum(slope) + path%film)
         dface(1, :) = dface(1, :) + slope(1)*dm
         dface(2, :) = dface(2, :) - slope(2)*dm
         found%dheat(1, :) = dm
         found%dheat(2, :) = -dm
         do i = 1, 2
            found%dheat(i, by_heat(2*i - 1)) = found%dheat(i, by_heat(2*i - 1)) + 1
            found%dheat(i, by_heat(2)) = found%dheat(i, by_heat(2)) + 0.5_dp
         end do
      end associate
      call find_hottest(path, temperature, heat, dface, found)
   end subroutine describe

   !> The hottest of bulks, faces and places within the constrictions, by (3).
   pure subroutine find_hottest(path, temperature, heat, dface, found)
      type(spot_path_t), intent(in) :: path
      !> T_1, T_2 [K]; Q_1, Q_f, Q_2 [W]
      real(dp), intent(in) :: temperature(2), heat(3)
      !> Derivatives of the temperatures of the faces
      real(dp), intent(in) :: dface(2, n_by)
      type(spot_heat_t), intent(inout) :: found
      real(dp) :: above, hottest, kappa, slope
      integer :: i

      i = maxloc(temperature, 1)
      found%hottest = temperature(i)
      found%dhottest(by_temperature(i)) = 1
      i = maxloc(found%face, 1)
      if (found%face(i) > found%hottest) then
         found%hottest = found%face(i)
         found%dhottest = dface(i, :)
      end if
      do i = 1, 2
         associate (q => found%heat(i), made => heat(2*i - 1), t => temperature(i), h => path%conductance(i))
            if (.not. (q > 0 .and. q <= made)) cycle
            above = q/made*q/(2*h)
            hottest = t + above
            if (path%is_metal(i)) hottest = sqrt(t**2 + 2*above)
            if (hottest < found%hottest) cycle
            kappa = merge(hottest, 1.0_dp, path%is_metal(i))
            slope = q/(made*h*kappa)
            found%hottest = hottest
            found%dhottest = slope*found%dheat(i, :)
            found%dhottest(by_heat(2*i - 1)) = found%dhottest(by_heat(2*i - 1)) - slope*q/(2*made)
            found%dhottest(by_path(i)) = found%dhottest(by_path(i)) - above/kappa
            found%dhottest(by_temperature(i)) = found%dhottest(by_temperature(i)) &
               + merge(t, 1.0_dp, path%is_metal(i))/kappa
         end associate
      end do
   end subroutine find_hottest

   !> The same over voltage and conductance: the derivatives are by V, G, T_1 and T_2, at a fixed film.
   pure subroutine spot_heat_of_voltage(wires, voltage, conductance, temperature, found, info)
      type(spot_wires_t), intent(in) :: wires
      !> V [V], across constrictions and film, of either sign, and G [S] of all; 0: no current
      real(dp), intent(in) :: voltage, conductance
      !> Of the bulks, T_1, T_2 [K]
      real(dp), intent(in) :: temperature(2)
      !> Its columns beyond the fourth are 0
      type(spot_heat_t), intent(out) :: found
      !> `heat_ok` or `heat_bad_data`
      integer, intent(out) :: info
      type(spot_path_t) :: path
      real(dp) :: share(3), heat(3), constriction, dheat_dg(3)

      info = heat_bad_data
      if (.not. (conductance >= 0 .and. all(wires%resistivity > 0) .and. wires%film_resistance >= 0)) return
      constriction = 1 - wires%film_resistance*conductance
      if (.not. constriction > 0) return
      share([1, 3]) = wires%resistivity/sum(wires%resistivity)*constriction
      share(2) = wires%film_resistance*conductance
      heat = share*voltage**2*conductance
      path%is_metal = wires%lorenz > 0
      path%conductance = merge(wires%lorenz*conductance/share([1, 3]), wires%heat_conductance, path%is_metal)
      path%film = wires%film
      call spot_heat(path, temperature, heat, found, info)
      if (info /= heat_ok) return

      ! at fixed film: the constriction carries what the film does not, R_i = w_i (1/G - R_f)
      dheat_dg([1, 3]) = voltage**2*(share([1, 3]) - wires%resistivity/sum(wires%resistivity)*share(2))
      dheat_dg(2) = 2*voltage**2*share(2)
      call gather(found%dheat(1, :))
      call gather(found%dheat(2, :))
      call gather(found%dhottest)

   contains

      !> From the columns of `spot_heat` to those by voltage and conductance.
      pure subroutine gather(row)
         !> (n_by)
         real(dp), intent(inout) :: row(n_by)
         real(dp) :: gathered(n_by_voltage)

         gathered(by_voltage) = 2*voltage*conductance*dot_product(row(by_heat), share)
         gathered(by_conductance) = dot_product(row(by_heat), dheat_dg)
         if (any(path%is_metal)) gathered(by_conductance) = gathered(by_conductance) &
            + sum(row(by_path), path%is_metal)/(conductance*constriction)
         gathered(by_bulk) = row(by_temperature)
         row(:n_by_voltage) = gathered
         row(n_by_voltage + 1:) = 0
      end subroutine gather

   end subroutine spot_heat_of_voltage

   !> Conductance of a spot whose own heat changes the resistivity of the metal, over that at the mean temperature of
   !> the bulks: `arctan(u)/u` with `u = V/(sqrt(L) (T_1 + T_2))`.
   !>
   !> Source: theory section 13, a Wiedemann-Franz metal of constant heat conductivity, `rho = L T/lambda`.
   pure subroutine hot_conductance(voltage, temperature, lorenz, ratio, dratio)
      !> V [V], T_1, T_2 [K], L [V^2/K^2]
      real(dp), intent(in) :: voltage, temperature(2), lorenz
      !> Hot over cold conductance, and its derivatives by V, T_1 and T_2 (3) [1/V, 1/K]
      real(dp), intent(out) :: ratio, dratio(3)
      real(dp), parameter :: small = 1.0e-3_dp
      real(dp) :: u, dratio_du

      u = voltage/(sqrt(lorenz)*sum(temperature))
      if (abs(u) < small) then
         ratio = 1 - u**2/3 + u**4/5
         dratio_du = u*(-2.0_dp/3 + 4*u**2/5 - 6*u**4/7)
      else
         ratio = atan(u)/u
         dratio_du = (1/(1 + u**2) - ratio)/u
      end if
      dratio(1) = dratio_du/(sqrt(lorenz)*sum(temperature))
      dratio(2:3) = -dratio_du*u/sum(temperature)
   end subroutine hot_conductance

end module litz_spot_heat
