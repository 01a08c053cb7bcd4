!> Numbers that carry their first and second derivatives with respect to three variables: what is composed of them has
!> its derivatives by the rules of differentiation, without differences.
module litz_jets
   use litz_kinds, only: dp
   implicit none
   private
   public :: jet_t, variable, constant, composed
   public :: operator(+), operator(-), operator(*), operator(**)

   integer, parameter, public :: n_variables = 3

   type :: jet_t
      real(dp) :: value = 0
      !> First derivatives (3), and second ones (3, 3)
      real(dp) :: first(n_variables) = 0, second(n_variables, n_variables) = 0
   end type jet_t

   interface operator(+)
      module procedure sum_of_jets, number_plus_jet
   end interface operator(+)

   interface operator(-)
      module procedure difference, number_minus_jet
   end interface operator(-)

   interface operator(*)
      module procedure product_of_jets, number_times_jet
   end interface operator(*)

   interface operator(**)
      module procedure power
   end interface operator(**)

contains

   !> One of the variables.
   pure type(jet_t) function variable(value, number) result(jet)
      !> Its value
      real(dp), intent(in) :: value
      !> Which one it is
      integer, intent(in) :: number

      jet%value = value
      jet%first(number) = 1
   end function variable

   !> What does not depend on the variables.
   pure type(jet_t) function constant(value) result(jet)
      !> Its value
      real(dp), intent(in) :: value

      jet%value = value
   end function constant

   !> A function of a jet.
   elemental type(jet_t) function composed(a, value, slope, curvature) result(jet)
      type(jet_t), intent(in) :: a
      !> The function and its first and second derivative at `a`
      real(dp), intent(in) :: value, slope, curvature

      jet%value = value
      jet%first = slope*a%first
      jet%second = slope*a%second + curvature*outer(a%first, a%first)
   end function composed

   elemental type(jet_t) function power(a, exponent) result(jet)
      !> Positive
      type(jet_t), intent(in) :: a
      !> Of the power
      real(dp), intent(in) :: exponent

      associate (v => a%value)
         jet = composed(a, v**exponent, exponent*v**(exponent - 1), exponent*(exponent - 1)*v**(exponent - 2))
      end associate
   end function power

   elemental type(jet_t) function sum_of_jets(a, b) result(jet)
      type(jet_t), intent(in) :: a, b

      jet = jet_t(a%value + b%value, a%first + b%first, a%second + b%second)
   end function sum_of_jets

   elemental type(jet_t) function number_plus_jet(number, a) result(jet)
      !> A constant
      real(dp), intent(in) :: number
      type(jet_t), intent(in) :: a

      jet = a
      jet%value = number + a%value
   end function number_plus_jet

   elemental type(jet_t) function difference(a, b) result(jet)
      type(jet_t), intent(in) :: a, b

      jet = a + (-1.0_dp)*b
   end function difference

   elemental type(jet_t) function number_minus_jet(number, a) result(jet)
      !> A constant
      real(dp), intent(in) :: number
      type(jet_t), intent(in) :: a

      jet = number + (-1.0_dp)*a
   end function number_minus_jet

   elemental type(jet_t) function number_times_jet(number, a) result(jet)
      !> A constant
      real(dp), intent(in) :: number
      type(jet_t), intent(in) :: a

      jet = jet_t(number*a%value, number*a%first, number*a%second)
   end function number_times_jet

   elemental type(jet_t) function product_of_jets(a, b) result(jet)
      type(jet_t), intent(in) :: a, b

      jet%value = a%value*b%value
      jet%first = a%value*b%first + b%value*a%first
      jet%second = a%value*b%second + b%value*a%second + outer(a%first, b%first) + outer(b%first, a%first)
   end function product_of_jets

   pure function outer(a, b) result(c)
      !> (3) each
      real(dp), intent(in) :: a(n_variables), b(n_variables)
      real(dp) :: c(n_variables, n_variables)

      c = spread(a, 2, n_variables)*spread(b, 1, n_variables)
   end function outer

end module litz_jets
