!> B33: two-node Euler-Bernoulli beam: cubic bending in a corotational frame, for large rotations and small strains.
!>
!> The frame is the mid triad of the nodes. With `lambda = |gamma|` and the rotation of the chord in that frame,
!>
!>     beta_j = (omega/g) gamma_j,  j = 2, 3,   g = sqrt(gamma2^2 + gamma3^2),  omega = atan2(g, gamma1)         (1)
!>
!> the end rotations against the chord are `-beta -+ psi/2` in each bending plane, and the strains, minus those of the
!> stress-free state, are
!>
!>     e1 = lambda + (beta2^2 + beta3^2)/10 + (psi2^2 + psi3^2)/24                                               (2)
!>     e2 = beta2,  e3 = beta3,  (e4, e5, e6) = psi/L0                                                           (3)
!>
!> (2) is the mean axial strain of the cubic, `(2 th1^2 - th1 th2 + 2 th2^2)/30` in each plane. Energy
!> `Pi = (L0/2) e.C e`, `C = diag(EA, 12 EI3/L0^2, 12 EI2/L0^2, GJ, EI2, EI3)`: the energy `(2 EI/L0)(th1^2 + th1 th2 +
!> th2^2)` of the cubic in its antisymmetric and symmetric part.
!>
!> Source: C. Oran, J. Struct. Div. ASCE 99 (1973) 987-1001 (mean axial strain); rotation of the chord in the mid triad
!> in place of a frame on the chord keeps the energy free of a choice of section axes.
module litz_beam_b33
   use litz_kinds, only: dp
   use litz_beam_kinematics, only: chord_rotation, chord_rotation_residual, chord_rotation_rows, chord_rotation_t, &
      chord_rotation_tangent, diagonal, outer, reference_length
   use litz_rotations, only: identity3
   implicit none
   private
   public :: beam_b33, beam_b33_reference, beam_b33_rigidities

   integer :: power

   !> Below this square of `g/gamma1` the functions of (1) come from their power series, which lose less than round-off
   real(dp), parameter :: series_slope_squared = 0.04_dp
   integer, parameter :: terms = 12
   !> `atan(t)/t = sum_n (-t^2)^n/(2n + 1)`; columns are powers of `-t^2`, rows are what `arc_functions` describes
   real(dp), parameter :: series(3, 0:terms) = reshape([( &
      1.0_dp/(2*power + 1), -2.0_dp*(power + 1)/(2*power + 3), 4.0_dp*(power + 1)*(power + 2)/(2*power + 5), &
      power=0, terms)], [3, terms + 1])

   !> The functions `omega/g` of (1), and what follows from it
   type :: arc_t
      !> `lambda` and its square
      real(dp) :: lambda, lambda_squared
      !> `rho = omega/g`, `kappa = (drho/dg)/g`, `tau = (dkappa/dg)/g`
      real(dp) :: rho, kappa, tau
   end type arc_t

contains

   !> Length and strains of the stress-free state, which may be curved and twisted.
   pure subroutine beam_b33_reference(x0, triads0, length, strain0)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x0(3, 2)
      !> Nodal triads (3, axis, node), axes: tangent, first, second section axis
      real(dp), intent(in) :: triads0(3, 3, 2)
      !> Length of the axis [m]
      real(dp), intent(out) :: length
      !> Strains (6) [-, 1/m]
      real(dp), intent(out) :: strain0(6)
      type(chord_rotation_t) :: q

      length = reference_length(x0, triads0)
      q = chord_rotation(x0, triads0, length)
      strain0 = strains(q, arc_functions(q%gamma))
   end subroutine beam_b33_reference

   !> What multiplies the strains in the section forces: EA, 12 EI3/L0^2, 12 EI2/L0^2, GJ, EI2, EI3.
   pure function beam_b33_rigidities(stiffness, length) result(c)
      !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2]; GA2 and GA3 are not used
      real(dp), intent(in) :: stiffness(6)
      !> Reference length [m]
      real(dp), intent(in) :: length
      !> Rigidities (6), in the order of the strains
      real(dp) :: c(6)

      c = stiffness
      c(2) = 12*stiffness(6)/length**2
      c(3) = 12*stiffness(5)/length**2
   end function beam_b33_rigidities

   !> Residual, tangent, energy and section forces of an element.
   pure subroutine beam_b33(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x(3, 2)
      !> Nodal triads (3, axis, node), axes: tangent, first, second section axis
      real(dp), intent(in) :: triads(3, 3, 2)
      !> Reference length [m] and strains of the stress-free state (6), from `beam_b33_reference`
      real(dp), intent(in) :: length, strain0(6)
      !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2]; index 2: bending about the first section axis; GA2, GA3 not used
      real(dp), intent(in) :: stiffness(6)
      !> Tangent in the Hessian form (12, 12) [N/m, N, N m]; symmetric
      real(dp), intent(out) :: k(12, 12)
      !> Internal forces and moments (12) [N, N m]
      real(dp), intent(out) :: r(12)
      !> Strain energy [J]
      real(dp), intent(out) :: energy
      !> N, Q2, Q3, T, M2, M3 (6) [N, N m]; tension positive, moments at mid length
      real(dp), intent(out) :: section_forces(6)
      !> Strains against the stress-free state (6) [-, 1/m]
      real(dp), intent(out) :: strain(6)
      !> Derivatives of the strains by displacements and spins (6, 12)
      real(dp), intent(out) :: b(6, 12)
      !> Section forces that the geometric part of `k` takes instead of those of the strains (6) [N, N m]
      real(dp), intent(in), optional :: sigma(6)
      type(chord_rotation_t) :: q
      type(arc_t) :: arc
      integer :: i
      real(dp) :: c(6), s(6), by_gamma(3, 3), bow(3), n(3), m(3), c_gamma(3, 3), c_psi(3, 3)

      q = chord_rotation(x, triads, length)
      arc = arc_functions(q%gamma)
      c = beam_b33_rigidities(stiffness, length)
      strain = strains(q, arc) - strain0
      section_forces = c*strain
      energy = length/2*dot_product(section_forces, strain)

      by_gamma = strains_by_gamma(q%gamma, arc)
      bow = [0.0_dp, q%psi(2), q%psi(3)]/12
      b = chord_rotation_rows(q)
      do i = 1, 12
         b(1:3, i) = by_gamma(:, 1)*b(1, i) + by_gamma(:, 2)*b(2, i) + by_gamma(:, 3)*b(3, i)
         b(1, i) = b(1, i) + dot_product(bow, b(4:6, i))
         b(4:6, i) = b(4:6, i)/length
      end do
      call by_gamma_and_psi(section_forces, n, m)
      r = chord_rotation_residual(q, n, m)

      s = section_forces
      if (present(sigma)) s = sigma
      call by_gamma_and_psi(s, n, m)
      c_gamma = strains_by_gamma_twice(q%gamma, arc, by_gamma, s(1:3))
      do i = 1, 3
         c_gamma = c_gamma + c(i)*outer(by_gamma(i, :), by_gamma(i, :))
      end do
      c_psi = diagonal(c(4:6))/length + length*(c(1)*outer(bow, bow) + diagonal([0.0_dp, s(1), s(1)])/12)
      k = chord_rotation_tangent(q, n, m, length*c_gamma, c_psi, length*c(1)*outer(by_gamma(1, :), bow))

   contains

      !> Derivatives of the energy by gamma and psi from section forces: the chain rule through (2), (3).
      pure subroutine by_gamma_and_psi(forces, n, m)
         !> Section forces (6): N, Q2, Q3, T, M2, M3 [N, N m]
         real(dp), intent(in) :: forces(6)
         !> Derivative of the energy with respect to gamma [N m]
         real(dp), intent(out) :: n(3)
         !> Derivative of the energy with respect to psi [N m]
         real(dp), intent(out) :: m(3)
         integer :: j

         do j = 1, 3
            n(j) = length*dot_product(forces(1:3), by_gamma(:, j))
         end do
         m = forces(4:6) + length*forces(1)*bow
      end subroutine by_gamma_and_psi
   end subroutine beam_b33

   !> Source: (2), (3).
   pure function strains(q, arc) result(e)
      type(chord_rotation_t), intent(in) :: q
      type(arc_t), intent(in) :: arc
      real(dp) :: e(6)

      e(2:3) = arc%rho*q%gamma(2:3)
      e(1) = arc%lambda + dot_product(e(2:3), e(2:3))/10 + dot_product(q%psi(2:3), q%psi(2:3))/24
      e(4:6) = q%psi/q%length
   end function strains

   !> `lambda`, `rho = omega/g`, `kappa = (drho/dg)/g = (gamma1/lambda^2 - rho)/g^2` and
   !> `tau = (dkappa/dg)/g = -(2 gamma1/lambda^4 + 3 kappa)/g^2`, `gamma1` held fixed in both.
   pure function arc_functions(gamma) result(arc)
      !> Chord over the reference length, in the mid triad (3) [-]
      real(dp), intent(in) :: gamma(3)
      type(arc_t) :: arc
      real(dp) :: g_squared, slope_squared, c(3)
      integer :: n

      g_squared = gamma(2)**2 + gamma(3)**2
      arc%lambda_squared = gamma(1)**2 + g_squared
      arc%lambda = sqrt(arc%lambda_squared)
      if (gamma(1) > 0 .and. g_squared < series_slope_squared*gamma(1)**2) then
         slope_squared = g_squared/gamma(1)**2
         c = series(:, terms)
         do n = terms - 1, 0, -1
            c = series(:, n) - c*slope_squared
         end do
         arc%rho = c(1)/gamma(1)
         arc%kappa = c(2)/gamma(1)**3
         arc%tau = c(3)/gamma(1)**5
      else
         arc%rho = atan2(sqrt(g_squared), gamma(1))/sqrt(g_squared)
         arc%kappa = (gamma(1)/arc%lambda_squared - arc%rho)/g_squared
         arc%tau = -(2*gamma(1)/arc%lambda_squared**2 + 3*arc%kappa)/g_squared
      end if
   end function arc_functions

   !> Derivatives of (e1, e2, e3) by gamma: `dbeta_j/dgamma1 = -gamma_j/lambda^2`,
   !> `dbeta_j/dgamma_k = rho delta_jk + kappa gamma_j gamma_k`.
   pure function strains_by_gamma(gamma, arc) result(rows)
      !> Chord over the reference length, in the mid triad (3) [-]
      real(dp), intent(in) :: gamma(3)
      type(arc_t), intent(in) :: arc
      !> (strain, component of gamma)
      real(dp) :: rows(3, 3)
      integer :: j

      do j = 2, 3
         rows(j, 1) = -gamma(j)/arc%lambda_squared
         rows(j, 2:3) = arc%kappa*gamma(j)*gamma(2:3)
         rows(j, j) = rows(j, j) + arc%rho
      end do
      rows(1, :) = gamma/arc%lambda + arc%rho/5*(gamma(2)*rows(2, :) + gamma(3)*rows(3, :))
   end function strains_by_gamma

   !> Second derivatives of (e1, e2, e3) by gamma, contracted with the section forces `s`.
   !>
   !> With `t_j = s_j + s_1 beta_j/5` for the curvature of beta, and `t.gamma` over j = 2, 3:
   !>
   !>     by gamma1 twice      2 gamma1 (t.gamma)/lambda^4
   !>     by gamma1, gamma_k   -t_k/lambda^2 + 2 (t.gamma) gamma_k/lambda^4
   !>     by gamma_k, gamma_l  kappa (t_k gamma_l + gamma_k t_l + delta_kl t.gamma) + tau (t.gamma) gamma_k gamma_l
   pure function strains_by_gamma_twice(gamma, arc, rows, s) result(h)
      !> Chord over the reference length, in the mid triad (3) [-]
      real(dp), intent(in) :: gamma(3)
      type(arc_t), intent(in) :: arc
      !> The first derivatives, from `strains_by_gamma`
      real(dp), intent(in) :: rows(3, 3)
      !> Section forces that belong to the three strains [N]
      real(dp), intent(in) :: s(3)
      real(dp) :: h(3, 3)
      real(dp) :: t(2), t_gamma
      integer :: k

      t = s(2:3) + s(1)/5*arc%rho*gamma(2:3)
      t_gamma = dot_product(t, gamma(2:3))

      h = s(1)*((identity3 - outer(gamma, gamma)/arc%lambda_squared)/arc%lambda &
         + (outer(rows(2, :), rows(2, :)) + outer(rows(3, :), rows(3, :)))/5)
      h(1, 1) = h(1, 1) + 2*gamma(1)*t_gamma/arc%lambda_squared**2
      do k = 2, 3
         h(k, 1) = h(k, 1) - t(k - 1)/arc%lambda_squared + 2*t_gamma*gamma(k)/arc%lambda_squared**2
         h(1, k) = h(k, 1)
         h(2:3, k) = h(2:3, k) + arc%kappa*(t*gamma(k) + gamma(2:3)*t(k - 1)) + arc%tau*t_gamma*gamma(2:3)*gamma(k)
         h(k, k) = h(k, k) + arc%kappa*t_gamma
      end do
   end function strains_by_gamma_twice

end module litz_beam_b33
