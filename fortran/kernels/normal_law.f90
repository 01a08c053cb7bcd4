!> The normal force of a contact from the gap between the surfaces.
!>
!> Source: theory section 6. LINEAR: `F = eps |g|`. HERTZ: the inverse of the exact approach `delta(F)`, with
!> `delta = -g`: the real compliance of two round wires, which leaves no penalty to guess.
module litz_normal_law
   use litz_kinds, only: dp
   use litz_laws, only: normal_linear, normal_hertz
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   implicit none
   private
   public :: normal_force, normal_force_of_ellipse, hertz_approach, hertz_approach_of_ellipse
   public :: normal_ok, normal_parallel, normal_unknown_law

   integer, parameter :: normal_ok = 0
   !> HERTZ: the axes are parallel
   integer, parameter :: normal_parallel = -1
   integer, parameter :: normal_unknown_law = -2

contains

   !> Force and its derivatives; all 0 when the gap is open.
   pure subroutine normal_force(law, penalty, gap, radius, young, poisson, angle, force, dforce_dgap, dforce_dangle, &
      info)
      !> `normal_linear` or `normal_hertz` of litz_laws
      integer, intent(in) :: law
      !> LINEAR: penalty stiffness eps [N/m]; else not used
      real(dp), intent(in) :: penalty
      !> Gap between the surfaces [m], negative in contact
      real(dp), intent(in) :: gap
      !> Wire radii (2) [m], Young's moduli (2) [Pa], Poisson's ratios (2) [-]: barred, unbarred (HERTZ)
      real(dp), intent(in) :: radius(2), young(2), poisson(2)
      !> Angle between the tangents [rad], in (0, pi) (HERTZ)
      real(dp), intent(in) :: angle
      !> F [N], pushing the wires apart, dF/dg [N/m] (negative in contact), dF/dangle [N/rad]
      real(dp), intent(out) :: force, dforce_dgap, dforce_dangle
      !> `normal_ok`, or what is wrong; all results are then 0
      integer, intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      integer :: ellipse_info

      if (law == normal_hertz .and. gap < 0) then
         call hertz_ellipse(radius, young, poisson, angle, ellipse, ellipse_info)
         if (ellipse_info /= hertz_ok) then
            force = 0
            dforce_dgap = 0
            dforce_dangle = 0
            info = normal_parallel
            return
         end if
      end if
      call normal_force_of_ellipse(law, penalty, gap, ellipse, force, dforce_dgap, dforce_dangle, info)
   end subroutine normal_force

   !> The same where the Hertz ellipse is already known (LINEAR does not look at it).
   pure subroutine normal_force_of_ellipse(law, penalty, gap, ellipse, force, dforce_dgap, dforce_dangle, info)
      !> `normal_linear` or `normal_hertz`
      integer, intent(in) :: law
      !> LINEAR: penalty stiffness [N/m]
      real(dp), intent(in) :: penalty
      !> Gap [m], negative in contact
      real(dp), intent(in) :: gap
      !> From `hertz_ellipse` at the present angle
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Contact force [N], positive in contact
      real(dp), intent(out) :: force
      !> dF/dg at fixed angle [N/m], not positive
      real(dp), intent(out) :: dforce_dgap
      !> dF/dangle at fixed gap [N/rad]
      real(dp), intent(out) :: dforce_dangle
      !> `normal_ok` or `normal_unknown_law`
      integer, intent(out) :: info
      real(dp) :: scaled

      force = 0
      dforce_dgap = 0
      dforce_dangle = 0
      info = normal_ok
      select case (law)
      case (normal_linear)
         if (gap >= 0) return
         force = -penalty*gap                                                    ! F = eps |g|
         dforce_dgap = -penalty
      case (normal_hertz)
         if (gap >= 0) return
         scaled = -gap/ellipse%approach
         force = scaled*sqrt(scaled)                                             ! delta = cd F^(2/3)
         dforce_dgap = 3*force/(2*gap)
         dforce_dangle = -3*force*ellipse%dapproach_dangle/(2*ellipse%approach)
      case default
         info = normal_unknown_law
      end select
   end subroutine normal_force_of_ellipse

   !> The approach `delta(F)` of the Hertz law and the compliance of the contact.
   !>
   !> `delta(F)` is close to a straight line where `F(delta)` is steep: a Newton iteration that carries the force as
   !> an unknown linearises this one.
   pure subroutine hertz_approach(force, radius, young, poisson, angle, delta, ddelta_dforce, info)
      !> F [N]
      real(dp), intent(in) :: force
      !> Wire radii (2) [m], Young's moduli (2) [Pa], Poisson's ratios (2) [-]: barred, unbarred
      real(dp), intent(in) :: radius(2), young(2), poisson(2)
      !> Angle between the tangents [rad], in (0, pi)
      real(dp), intent(in) :: angle
      !> delta [m] and ddelta/dF [m/N]; without a force 0 and `huge`, which stands for the infinite compliance there
      real(dp), intent(out) :: delta, ddelta_dforce
      !> `normal_ok` or `normal_parallel`
      integer, intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      integer :: ellipse_info

      delta = 0
      ddelta_dforce = huge(delta)
      info = normal_parallel
      call hertz_ellipse(radius, young, poisson, angle, ellipse, ellipse_info)
      if (ellipse_info /= hertz_ok) return
      info = normal_ok
      call hertz_approach_of_ellipse(force, ellipse, delta, ddelta_dforce)
   end subroutine hertz_approach

   !> The same where the Hertz ellipse is already known.
   pure subroutine hertz_approach_of_ellipse(force, ellipse, delta, ddelta_dforce)
      !> Contact force [N]
      real(dp), intent(in) :: force
      !> From `hertz_ellipse` at the present angle
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Approach of the axes [m]; 0 without a force
      real(dp), intent(out) :: delta
      !> Its derivative [m/N]; without a force the largest number
      real(dp), intent(out) :: ddelta_dforce
      real(dp) :: cube_root

      delta = 0
      ddelta_dforce = huge(delta)
      if (force <= 0) return
      cube_root = force**(1.0_dp/3)
      delta = ellipse%approach*cube_root**2                                      ! delta = cd F^(2/3)
      ddelta_dforce = 2*ellipse%approach/(3*cube_root)
   end subroutine hertz_approach_of_ellipse

end module litz_normal_law
