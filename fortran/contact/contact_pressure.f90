!> The largest pressure between wires: of those that are elastic to be compared with that at which their metal yields.
!>
!> Source: H. Hertz; theory sections 6 and 10: `3 F/(2 pi a b)` of an ellipse, `2 f/(pi b)` of a strip.
module litz_contact_pressure
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_point_t
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_line_law, only: line_force_t, line_force
   use litz_normal_forces, only: is_lens
   use litz_place_forces, only: force_along_line
   use litz_yielding_lens, only: pressure_of_lens
   use litz_yielding_place, only: pressure_of_place
   use litz_yielding_wires, only: lens_of_wires
   use litz_normal_law, only: normal_law_t
   implicit none
   private
   public :: elastic_pressure

contains

   !> Largest pressure under the force of a contact, whatever law gives that [Pa]; 0 where there is none.
   pure real(dp) function elastic_pressure(law, pair, point) result(pressure)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(line_force_t) :: deepest

      pressure = 0
      if (.not. (point%force > 0 .and. point%weight > 0)) return
      if (law%yields()) then
         pressure = yielded_pressure(law, pair, point)
         return
      end if
      if (point%line_place > 0) then
         pressure = of_strip(point, force_along_line(point)/point%weight)
      else if (is_lens(law, point)) then
         deepest = line_force(point%line, -point%gap, law%line_penalty())
         pressure = of_strip(point, deepest%force)
      else
         pressure = of_ellipse(pair, point, point%force/point%weight)
      end if
   end function elastic_pressure

   !> The same of wires that yield.
   pure real(dp) function yielded_pressure(law, pair, point) result(pressure)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point

      pressure = 0
      if (point%line_place > 0) then
         pressure = pressure_of_place(point%yielding_place, -point%gap)
      else if (is_lens(law, point)) then
         pressure = pressure_of_lens(lens_of_wires(law, pair, point), -point%gap)
      else if (allocated(point%yielding)) then
         pressure = point%yielding%pressure
      end if
   end function yielded_pressure

   pure real(dp) function of_strip(point, force) result(pressure)
      type(contact_point_t), intent(in) :: point
      !> f [N/m]
      real(dp), intent(in) :: force

      pressure = 2/pi*sqrt(force/point%line%square_per_force)                              ! b^2 goes with f
   end function of_strip

   pure real(dp) function of_ellipse(pair, point, force) result(pressure)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> F [N]
      real(dp), intent(in) :: force
      type(hertz_ellipse_t) :: ellipse
      integer :: info

      pressure = 0
      info = hertz_ok
      ellipse = point%ellipse
      if (.not. ellipse%semi_major > 0) then
         call hertz_ellipse(pair%radius, pair%young, pair%poisson, point%law_angle, ellipse, info)
      end if
      if (info /= hertz_ok) return
      pressure = 1.5_dp*force**(1.0_dp/3)/(pi*ellipse%ratio*ellipse%semi_major**2)         ! a, b go with F^(1/3)
   end function of_ellipse

end module litz_contact_pressure
