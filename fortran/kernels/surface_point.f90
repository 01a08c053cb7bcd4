!> One point of contact of two surfaces in the plane: a point of the slave surface against a straight master segment.
!>
!> Barred: master, whose body lies on the left of the way from its node 1 to its node 2; unbarred: slave. `n` is the
!> segment's normal, which points into the master's body, `g = n . (x_bar - x)` is negative where the bodies overlap,
!> `delta = -g`. The slave point `x = sum N_i x_i` stands for the reference area `w`. With the row `a = [f1, f2, -N]`
!> and `b = a (x) n`:
!>
!>     R_u = -w p b,    R_V = I a,    I = w h g_V,    g_V = a . V
!>
!> `K` is the derivative of `R` by all unknowns, those on which `N`, `w` and the place depend included: a point may move
!> along the slave segment. Source: P. Wriggers, Computational Contact Mechanics, 2nd ed. 2006, sections 4.1 and 10.2;
!> the three parts of K_Vu are those of (5.4) of the theory. Order: displacements of master 1, master 2, slave nodes,
!> then the voltages of the same nodes.
module litz_surface_point
   use litz_kinds, only: dp
   use litz_area_law, only: pressure_law_t, area_conductance_law_t, body_pair_t, pressure_t, area_conductance_t, &
      pressure_at_gap, conductance_at_pressure
   implicit none
   private
   public :: slave_point_t, surface_laws_t, surface_point_t, segment_t, segment_of, add_surface_point

   !> The master segment.
   type :: segment_t
      !> Node 1 (2) [m], unit vectors along it and normal to it (2), length [m]
      real(dp) :: origin(2) = 0, tangent(2) = 0, normal(2) = 0, length = 0
   end type segment_t

   !> A point of the slave surface with `m` nodes.
   type :: slave_point_t
      !> Shape functions at the point and their derivatives along the segment (m)
      real(dp), allocatable :: shape(:), dshape(:)
      !> Derivative of its place s by the displacements (4 + 2m) [1/m]
      real(dp), allocatable :: ds(:)
      !> Reference area for which it stands [m^2], and its derivative by the displacements (4 + 2m) [m]
      real(dp) :: area = 0
      real(dp), allocatable :: darea(:)
   end type slave_point_t

   type :: surface_laws_t
      type(pressure_law_t) :: normal
      type(area_conductance_law_t) :: conductance
      type(body_pair_t) :: bodies
      !> Pressure of augmentation [Pa]
      real(dp) :: augmentation = 0
   end type surface_laws_t

   type :: surface_point_t
      !> Place in the master segment, which is [-1, 1]; gap [m]
      real(dp) :: xi_bar = 0, gap = 0
      type(pressure_t) :: normal
      type(area_conductance_t) :: spot
      !> Area [m^2], current from master to slave [A] and voltage across the contact [V]
      real(dp) :: area = 0, current = 0, voltage_gap = 0
   end type surface_point_t

contains

   !> Length 0: the nodes coincide.
   pure type(segment_t) function segment_of(x_bar) result(segment)
      !> Nodes (2, 2) [m]: components, nodes
      real(dp), intent(in) :: x_bar(2, 2)

      segment%origin = x_bar(:, 1)
      segment%length = norm2(x_bar(:, 2) - x_bar(:, 1))
      if (.not. segment%length > 0) return
      segment%tangent = (x_bar(:, 2) - x_bar(:, 1))/segment%length
      segment%normal = [-segment%tangent(2), segment%tangent(1)]
   end function segment_of

   !> Add a point to tangent and residual; nothing is added where the surfaces do not press each other.
   pure subroutine add_surface_point(segment, x, v_bar, v, at, laws, k, r, point, info)
      type(segment_t), intent(in) :: segment
      !> Slave nodes (2, m) [m]
      real(dp), intent(in) :: x(:, :)
      !> Voltages of master (2) and slave (m) [V]
      real(dp), intent(in) :: v_bar(2), v(:)
      type(slave_point_t), intent(in) :: at
      type(surface_laws_t), intent(in) :: laws
      !> Tangent (6 + 3m, 6 + 3m) and residual (6 + 3m): forces [N], then currents leaving the nodes [A]
      real(dp), intent(inout) :: k(:, :), r(:)
      type(surface_point_t), intent(out) :: point
      !> `area_ok` or `area_bad_data`
      integer, intent(out) :: info
      !> a and da/du; b; dxi_bar/du, dg/du, dn/du
      real(dp) :: a(2 + size(v)), da(2 + size(v), 4 + 2*size(v)), b(4 + 2*size(v))
      real(dp) :: dxi(4 + 2*size(v)), dgap(4 + 2*size(v)), dn(2, 4 + 2*size(v))
      real(dp) :: voltage(2 + size(v)), along(2)

      voltage = [v_bar, v]
      along = matmul(x, at%dshape)
      associate (t => segment%tangent, n => segment%normal, l => segment%length, x_s => matmul(x, at%shape))
         point%xi_bar = 2*dot_product(t, x_s - segment%origin)/l - 1
         point%gap = dot_product(n, segment%origin - x_s)
         a = [(1 - point%xi_bar)/2, (1 + point%xi_bar)/2, -at%shape]             ! a = [f1, f2, -N]
         b = spread_over(a, n)                                                   ! b = a (x) n
         ! dxi_bar = -(2/l) (a (x) t + (g/l) [-n, n, 0]) . du, and where the point moves along the slave
         dxi = -2/l*(spread_over(a, t) + point%gap/l*turning(n, size(b))) + 2/l*dot_product(t, along)*at%ds
         dgap = b - dot_product(n, along)*at%ds
         dn = -outer(t, turning(n, size(b)))/l
      end associate
      da = outer([-0.5_dp, 0.5_dp, 0*at%shape], dxi) - outer([0.0_dp, 0.0_dp, at%dshape], at%ds)

      point%area = at%area
      point%normal = pressure_at_gap(laws%normal, point%gap, laws%augmentation)
      call conductance_at_pressure(laws%conductance, point%normal, laws%bodies, point%spot, info)
      point%voltage_gap = dot_product(a, voltage)
      point%current = at%area*point%spot%conductance*point%voltage_gap           ! I = w h g_V
      if (.not. point%normal%pressure > 0) return

      call add_forces(a, b, da, dn, dgap, segment%normal, at, point, k, r)
      call add_currents(a, da, dgap, voltage, at, point, k, r)
   end subroutine add_surface_point

   !> `R_u = -w p b`.
   pure subroutine add_forces(a, b, da, dn, dgap, normal, at, point, k, r)
      !> a (2 + m) and b (4 + 2m)
      real(dp), intent(in) :: a(:), b(:)
      !> Derivatives of a (2 + m, 4 + 2m), n (2, 4 + 2m) and g (4 + 2m) by the displacements
      real(dp), intent(in) :: da(:, :), dn(:, :), dgap(:)
      !> n (2)
      real(dp), intent(in) :: normal(2)
      type(slave_point_t), intent(in) :: at
      type(surface_point_t), intent(in) :: point
      !> Tangent (6 + 3m, 6 + 3m) and residual (6 + 3m)
      real(dp), intent(inout) :: k(:, :), r(:)
      real(dp) :: db(size(b), size(b)), dforce(size(b))
      integer :: i, m

      m = size(b)
      do i = 1, size(a)
         db(2*i - 1:2*i, :) = outer(normal, da(i, :)) + a(i)*dn
      end do
      associate (p => point%normal%pressure)
         dforce = -at%area*point%normal%stiffness*dgap + p*at%darea              ! d(w p)
         r(:m) = r(:m) - at%area*p*b
         k(:m, :m) = k(:m, :m) - outer(b, dforce) - at%area*p*db
      end associate
   end subroutine add_forces

   !> `R_V = I a`, `I = w h a . V`.
   pure subroutine add_currents(a, da, dgap, voltage, at, point, k, r)
      !> a (2 + m)
      real(dp), intent(in) :: a(:)
      !> Derivatives of a (2 + m, 4 + 2m) and g (4 + 2m) by the displacements
      real(dp), intent(in) :: da(:, :), dgap(:)
      !> V (2 + m) [V], master and slave
      real(dp), intent(in) :: voltage(:)
      type(slave_point_t), intent(in) :: at
      type(surface_point_t), intent(in) :: point
      !> Tangent (6 + 3m, 6 + 3m) and residual (6 + 3m)
      real(dp), intent(inout) :: k(:, :), r(:)
      real(dp) :: dcurrent(size(dgap))
      integer :: m

      m = size(dgap)
      associate (h => point%spot%conductance, g_v => point%voltage_gap)
         dcurrent = -at%area*point%spot%dconductance_ddelta*g_v*dgap &
            + at%area*h*matmul(voltage, da) + h*g_v*at%darea
         r(m + 1:) = r(m + 1:) + point%current*a
         k(m + 1:, :m) = k(m + 1:, :m) + outer(a, dcurrent) + point%current*da
         k(m + 1:, m + 1:) = k(m + 1:, m + 1:) + at%area*h*outer(a, a)
      end associate
   end subroutine add_currents

   !> `a (x) d`: the entries of `a` times a direction, node after node (2 size(a)).
   pure function spread_over(a, direction) result(row)
      !> Entries of the nodes (n), and the direction (2)
      real(dp), intent(in) :: a(:), direction(2)
      real(dp) :: row(2*size(a))

      row = reshape(outer(direction, a), [2*size(a)])
   end function spread_over

   !> `[-n, n, 0]`: how the master segment turns, times its length.
   pure function turning(normal, n_entries) result(row)
      !> n (2)
      real(dp), intent(in) :: normal(2)
      !> Length of the row
      integer, intent(in) :: n_entries
      real(dp) :: row(n_entries)

      row = 0
      row(:4) = [-normal, normal]
   end function turning

   !> `u v'`.
   pure function outer(u, v) result(product)
      !> Vectors (n), (m)
      real(dp), intent(in) :: u(:), v(:)
      real(dp) :: product(size(u), size(v))

      product = spread(u, 2, size(v))*spread(v, 1, size(u))
   end function outer

end module litz_surface_point
