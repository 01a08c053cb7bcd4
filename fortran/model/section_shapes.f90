!> Areas, second moments, torsion constants and shear factors of cross-sections that decks describe by their dimensions.
!>
!> Those with two axes of symmetry, n1 and n2, have centroid and shear centre at the node. An L and a box of unlike
!> walls do not: second moments and shear factors are those of their principal axes.
!> Sources: Timoshenko and Goodier, Theory of Elasticity, 3rd edition (1970), for torsion; Cowper, The shear coefficient
!> in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335-340, for shear.
module litz_section_shapes
   use litz_kinds, only: dp, pi
   use litz_thin_walls, only: wall_shear_t, shear_of_walls
   implicit none
   private
   public :: section_shape_t, round_wire, rectangle, box, unlike_box, pipe, i_section, l_section, turn_to_principal_axes

   !> Terms of the series of the torsion of a rectangle: the first one left out is 1e-12 of the sum
   integer, parameter :: n_terms = 120

   type :: section_shape_t
      !> Area [m^2]
      real(dp) :: area = 0
      !> Second moments for bending about the principal axes, and torsion constant [m^4]
      real(dp) :: i11 = 0, i22 = 0, j = 0
      !> Shear stiffness over G A, for shear along the principal axes
      real(dp) :: shear_factor(2) = 1
      !> Corners of its outline along n1 and n2, from the centroid, anticlockwise (2, n) [m]; not allocated: it has none
      real(dp), allocatable :: corners(:, :)
      !> Angle from n1 to the first principal axis [rad]
      real(dp) :: turn = 0
      !> Shear centre from the node, and centroid from the shear centre, along n1 and n2 (2) [m]
      real(dp) :: shear_centre(2) = 0, centroid(2) = 0
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
      shape%corners = corners_of([a, b]/2)
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
      shape%corners = corners_of([a, b]/2)
   end function box

   !> Hollow rectangle of four walls. Where one of them is thin the cell hardly resists torsion, and the plates do.
   pure type(section_shape_t) function unlike_box(a, b, t) result(shape)
      !> Outer sides along n1 and n2 [m]
      real(dp), intent(in) :: a, b
      !> Thickness of the walls at the end of n1, of n2, and opposite to these (4) [m]
      real(dp), intent(in) :: t(4)
      real(dp) :: inner(2), middle(2), points(2, 5), length(4), centroid(2), second(3)

      inner = [a - t(1) - t(3), b - t(2) - t(4)]
      middle = [t(3) - t(1), t(4) - t(2)]/2
      shape%area = a*b - inner(1)*inner(2)
      centroid = -inner(1)*inner(2)*middle/shape%area
      second = moments_of_plate([a, b], -centroid) - moments_of_plate(inner, middle - centroid)
      points = reshape([a - t(1), -b + t(4), a - t(1), b - t(2), -a + t(3), b - t(2), -a + t(3), -b + t(4), a - t(1), &
         -b + t(4)], [2, 5])/2
      length = [points(2, 2) - points(2, 1), points(1, 2) - points(1, 3), points(2, 3) - points(2, 4), &
         points(1, 5) - points(1, 4)]
      shape%j = 4*(length(1)*length(2))**2/sum(length/t) + sum(length*t**3)/3      ! Bredt, and the plates
      call set_unsymmetric(shape, second, points, t, centroid)
      shape%corners = corners_of([a, b]/2) - spread(centroid, 2, 4)
   end function unlike_box

   !> L of two legs, from the node along n1 and n2: their mean lines meet at the node, which is the shear centre.
   pure type(section_shape_t) function l_section(a, b, t1, t2) result(shape)
      !> Outer lengths of the legs along n1 and n2 [m]
      real(dp), intent(in) :: a, b
      !> Their thickness [m]
      real(dp), intent(in) :: t1, t2
      real(dp) :: centroid(2), second(3), points(2, 3), own(2, 2), side(2, 2)

      ! the plates: the leg along n1 with the corner, and the rest of the other one
      side = reshape([a, t1, t2, b - t1], [2, 2])
      own = reshape([a - t2, 0.0_dp, 0.0_dp, b], [2, 2])/2
      shape%area = sum(product(side, 1))
      centroid = matmul(own, product(side, 1))/shape%area
      second = moments_of_plate(side(:, 1), own(:, 1) - centroid) + moments_of_plate(side(:, 2), own(:, 2) - centroid)
      points = reshape([a - t2/2, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, b - t1/2], [2, 3])
      shape%j = ((a - t2/2)*t1**3 + (b - t1/2)*t2**3)/3                            ! Timoshenko and Goodier, section 113
      call set_unsymmetric(shape, second, points, [t1, t2], centroid)
      shape%corners = reshape([-t2, -t1, 2*a - t2, -t1, 2*a - t2, t1, t2, t1, t2, 2*b - t1, -t2, 2*b - t1], [2, 6])/2 &
         - spread(centroid, 2, 6)
   end function l_section

   !> Second moments of a rectangle about a point: integrals of y2^2, y1 y2, and y1^2 (3) [m^4].
   pure function moments_of_plate(side, middle) result(second)
      !> Sides, and the place of its middle (2) [m]
      real(dp), intent(in) :: side(2), middle(2)
      real(dp) :: second(3)

      second = side(1)*side(2)*[side(2)**2/12 + middle(2)**2, middle(1)*middle(2), side(1)**2/12 + middle(1)**2]
   end function moments_of_plate

   !> Principal axes, shear centre and shear factors of a section of thin walls. Poisson's ratio is not in the energy of
   !> the shear flow, which gives the factors.
   pure subroutine set_unsymmetric(shape, second, points, thickness, centroid)
      type(section_shape_t), intent(inout) :: shape
      !> I11, I12, I22 about the centroid (3) [m^4]
      real(dp), intent(in) :: second(3)
      !> Mean lines of the walls (2, n + 1), their thickness (n), and the centroid (2), all from the node [m]
      real(dp), intent(in) :: points(:, :), thickness(:), centroid(2)
      type(wall_shear_t) :: shear
      real(dp) :: axes(2, 2), compliance(2, 2)
      integer :: i

      call turn_to_principal_axes(shape, second)
      shear = shear_of_walls(points, thickness)
      shape%shear_centre = shear%centre
      shape%centroid = centroid - shear%centre
      axes = reshape([cos(shape%turn), sin(shape%turn), -sin(shape%turn), cos(shape%turn)], [2, 2])
      compliance = matmul(transpose(axes), matmul(shear%compliance, axes))
      shape%shear_factor = [(1/(compliance(i, i)*shape%area), i=1, 2)]
   end subroutine set_unsymmetric

   !> The principal axes nearest to n1 and n2, and the second moments about them.
   pure subroutine turn_to_principal_axes(shape, second)
      type(section_shape_t), intent(inout) :: shape
      !> I11, I12, I22: integrals of y2^2, y1 y2 and y1^2 over the section, y from its centroid (3) [m^4]
      real(dp), intent(in) :: second(3)
      real(dp) :: half(2)

      ! tan(2 turn) = 2 I12/(I22 - I11), |turn| <= 45 degrees
      shape%turn = 0
      if (abs(second(2)) > 0) shape%turn = atan2(sign(1.0_dp, second(3) - second(1))*2*second(2), &
         abs(second(3) - second(1)))/2
      half = [cos(shape%turn), sin(shape%turn)]
      shape%i11 = second(1)*half(1)**2 + second(3)*half(2)**2 - 2*second(2)*half(1)*half(2)
      shape%i22 = second(3)*half(1)**2 + second(1)*half(2)**2 + 2*second(2)*half(1)*half(2)
   end subroutine turn_to_principal_axes

   !> Four corners of a section that n1 and n2 divide evenly.
   pure function corners_of(half) result(corners)
      !> Half of its sides along n1 and n2 (2) [m]
      real(dp), intent(in) :: half(2)
      real(dp) :: corners(2, 4)

      corners = reshape([half(1), half(2), -half(1), half(2), -half(1), -half(2), half(1), -half(2)], [2, 4])
   end function corners_of

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
      real(dp) :: clear, depth, m, n, horizontal, right(2, 6)

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
      right = reshape([b, -h, b, -clear, web, -clear, web, clear, b, clear, b, h], [2, 6])/2
      allocate (shape%corners(2, 12))
      shape%corners(:, :6) = right
      shape%corners(:, 7:) = -right
   end function i_section

end module litz_section_shapes
