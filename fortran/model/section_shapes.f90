!> Areas, second moments, torsion constants and shear factors of cross-sections that decks describe by their dimensions.
!>
!> All have two axes of symmetry, n1 and n2: their centroid, at the node, is their shear centre as well.
!> Sources: Timoshenko and Goodier, Theory of Elasticity, 3rd edition (1970), for torsion; Cowper, The shear coefficient
!> in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335-340, for shear.
module litz_section_shapes
   use litz_kinds, only: dp, pi
   implicit none
   private
   public :: section_shape_t, round_wire, rectangle, box, pipe, i_section

   !> Terms of the series of the torsion of a rectangle: the first one left out is 1e-12 of the sum
   integer, parameter :: n_terms = 120

   type :: section_shape_t
      !> Area [m^2]
      real(dp) :: area = 0
      !> Second moments for bending about n1 and n2, and torsion constant [m^4]
      real(dp) :: i11 = 0, i22 = 0, j = 0
      !> Shear stiffness over G A, for shear along n1 and n2
      real(dp) :: shear_factor(2) = 1
      !> Largest distances of its corners along n1 and n2 [m]; 0: it has none
      real(dp) :: corner(2) = 0
      !> Radius of a round one [m]; 0: it is not round
      real(dp) :: radius = 0
   end type section_shape_t

contains

   !> Solid circle.
   pure type(section_shape_t) function round_wire(radius, poisson) result(shape)
      !> Radius [m]; Poisson's ratio
      real(dp), intent(in) :: radius, poisson

      shape = pipe(radius, radius, poisson)
   end function round_wire

   !> Solid rectangle.
   pure type(section_shape_t) function rectangle(a, b, poisson) result(shape)
      !> Sides along n1 and n2 [m]; Poisson's ratio
      real(dp), intent(in) :: a, b, poisson

      shape%area = a*b
      shape%i11 = a*b**3/12
      shape%i22 = b*a**3/12
      shape%j = torsion_of_rectangle(max(a, b), min(a, b))
      shape%shear_factor = 10*(1 + poisson)/(12 + 11*poisson)                      ! Cowper, table 1
      shape%corner = [a, b]/2
   end function rectangle

   !> Torsion constant of a rectangle [m^4]. Source: Timoshenko and Goodier, section 109, eq. (163).
   pure real(dp) function torsion_of_rectangle(long, short) result(j)
      !> Sides [m]
      real(dp), intent(in) :: long, short
      real(dp) :: total
      integer :: n

      total = 0
      do n = 2*n_terms - 1, 1, -2
         total = total + tanh(n*pi*long/(2*short))/real(n, dp)**5
      end do
      j = long*short**3/3*(1 - 192*short/(pi**5*long)*total)
   end function torsion_of_rectangle

   !> Hollow rectangle whose opposite walls are alike; the torsion constant is that of a thin wall (Bredt).
   pure type(section_shape_t) function box(a, b, t1, t2, poisson) result(shape)
      !> Outer sides along n1 and n2 [m]
      real(dp), intent(in) :: a, b
      !> Thickness of the two walls across n1, and of those across n2 [m]; Poisson's ratio
      real(dp), intent(in) :: t1, t2, poisson
      real(dp) :: width, height

      width = a - t1
      height = b - t2
      shape%area = a*b - (a - 2*t1)*(b - 2*t2)
      shape%i11 = (a*b**3 - (a - 2*t1)*(b - 2*t2)**3)/12
      shape%i22 = (b*a**3 - (b - 2*t2)*(a - 2*t1)**3)/12
      shape%j = 4*(width*height)**2/(2*height/t1 + 2*width/t2)                     ! Timoshenko and Goodier, section 116
      shape%shear_factor = [shear_of_box(height, width, t1, t2, poisson), shear_of_box(width, height, t2, t1, poisson)]
      shape%corner = [a, b]/2
   end function box

   !> Shear factor of a thin-walled box. Source: Cowper, table 1.
   pure real(dp) function shear_of_box(b, h, flange, web, poisson) result(factor)
      !> Mean sides across and along the shear force [m]
      real(dp), intent(in) :: b, h
      !> Thickness of the walls across and along the force [m]; Poisson's ratio
      real(dp), intent(in) :: flange, web, poisson
      real(dp) :: m, n

      m = b*flange/(h*web)
      n = b/h
      factor = 10*(1 + poisson)*(1 + 3*m)**2/(12 + 72*m + 150*m**2 + 90*m**3 &
         + poisson*(11 + 66*m + 135*m**2 + 90*m**3) + 10*n**2*((3 + poisson)*m + 3*m**2))
   end function shear_of_box

   !> Hollow circle; solid where the wall is as thick as the radius.
   pure type(section_shape_t) function pipe(radius, thickness, poisson) result(shape)
      !> Outer radius and thickness of the wall [m]; Poisson's ratio
      real(dp), intent(in) :: radius, thickness, poisson
      real(dp) :: inner, m

      inner = radius - thickness
      shape%area = pi*(radius**2 - inner**2)
      shape%i11 = pi*(radius**4 - inner**4)/4
      shape%i22 = shape%i11
      shape%j = 2*shape%i11
      m = inner/radius
      shape%shear_factor = 6*(1 + poisson)*(1 + m**2)**2/((7 + 6*poisson)*(1 + m**2)**2 + (20 + 12*poisson)*m**2)
      shape%radius = radius
   end function pipe

   !> I of two equal flanges; its torsion constant is the sum over thin walls.
   pure type(section_shape_t) function i_section(h, b, flange, web, poisson) result(shape)
      !> Height along n2 and width of the flanges along n1 [m]
      real(dp), intent(in) :: h, b
      !> Thickness of flanges and web [m]; Poisson's ratio
      real(dp), intent(in) :: flange, web, poisson
      real(dp) :: clear, depth, m, n, horizontal

      clear = h - 2*flange
      depth = h - flange
      shape%area = 2*b*flange + clear*web
      shape%i11 = (b*h**3 - (b - web)*clear**3)/12
      shape%i22 = (2*flange*b**3 + clear*web**3)/12
      shape%j = (2*b*flange**3 + depth*web**3)/3                                   ! Timoshenko and Goodier, section 113
      m = 2*b*flange/(depth*web)
      n = b/depth
      ! Cowper, table 1; along the flanges these carry the force as two rectangles
      shape%shear_factor(2) = 10*(1 + poisson)*(1 + 3*m)**2/(12 + 72*m + 150*m**2 + 90*m**3 &
         + poisson*(11 + 66*m + 135*m**2 + 90*m**3) + 30*n**2*(m + m**2) + 5*poisson*n**2*(8*m + 9*m**2))
      horizontal = 2*b*flange/shape%area
      shape%shear_factor(1) = 10*(1 + poisson)/(12 + 11*poisson)*horizontal
      shape%corner = [b, h]/2
   end function i_section

end module litz_section_shapes
