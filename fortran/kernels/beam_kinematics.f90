!> Kinematics shared by the two-node beams: the chord seen from the mid triad, and the relative rotation of the nodes.
!>
!> With nodal triads `L1`, `L2` (columns: tangent, first, second section axis) and `d = x2 - x1`,
!>
!>     psi   = log(L1^T L2)            relative rotation                                     (1)
!>     Lm    = L1 exp(psi/2)           mid triad, half-way on the geodesic                   (2)
!>     gamma = Lm^T d / L0             chord in the mid triad                                (3)
!>
!> `gamma` and `psi` do not change under rigid motion, so every energy in them is objective and path independent.
!>
!> For spins `delta_i` (held fixed in space) and displacements `u_i` let `D = u2 - u1`, `r = delta2 - delta1`,
!> `s = (delta1 + delta2)/2`, everything in global axes, `theta = |psi|`, `W = w psi^`. Then
!>
!>     psi'   = A r,                  A = f 1 + h psi psi^T,  f = (theta/2)/sin(theta/2),  h = (1 - f)/theta^2    (4)
!>     mu     = s - W r/2,            w = tan(theta/4)/theta,  the spin of the mid triad                          (5)
!>     gamma' = gamma x mu + D/L0                                                                                 (6)
!>     psi''  = (dA[A r]) r + A (r x mu)                                                                          (7)
!>     gamma''= (gamma x mu) x mu + 2 (D x mu)/L0 + gamma x mu'                                                   (8)
!>     mu'    = s x mu - (dW[A r] r + W (r x mu))/2                                                               (9)
!>
!> The second derivatives along fixed `delta_i` make the Hessian form of the tangent. The relative rotation of the two
!> nodes must stay below pi, where (1) jumps.
module litz_beam_kinematics
   use litz_kinds, only: dp
   use litz_rotations, only: cross, identity3, rotation_exp, rotation_log, skew
   implicit none
   private
   public :: chord_rotation_t, chord_rotation, reference_length
   public :: chord_rotation_rows, chord_rotation_residual, chord_rotation_tangent
   public :: diagonal, outer

   !> Chord and relative rotation of an element, with what their derivatives are made of.
   type :: chord_rotation_t
      !> Reference length [m]
      real(dp) :: length
      !> Mid triad, columns as those of the nodes
      real(dp) :: mid(3, 3)
      !> Chord over reference length, and relative rotation [rad], in the mid triad
      real(dp) :: gamma(3), psi(3)
      !> The same in global axes
      real(dp) :: chord(3), turn(3)
      !> Coefficients of (4) and (5), and their derivatives by the angle over the angle
      real(dp) :: f, h, w, df, dh, dw
   end type chord_rotation_t

   integer :: i

   !> Below this angle [rad] the coefficients come from their power series in the squared angle, which has then lost
   !> less than round-off
   real(dp), parameter :: series_angle = 1.0_dp
   integer, parameter :: terms = 12
   !> `(t/2)/sin(t/2) = sum_n 2 eta(2n) (t/(2 pi))^(2n)`, `eta` the alternating zeta function
   real(dp), parameter :: series_f(0:terms) = [1.0_dp, 4.16666666666666667e-2_dp, 1.21527777777777778e-3_dp, &
      3.20353835978835979e-5_dp, 8.20260830026455026e-7_dp, 2.08359820718761691e-8_dp, 5.28160996772133718e-10_dp, &
      1.33809029202683355e-11_dp, 3.38957685148932107e-13_dp, 8.58599654982294742e-15_dp, &
      2.17486455032522313e-16_dp, 5.50900020146297631e-18_dp, 1.39544630223107021e-19_dp]
   !> `tan(t/4)/t = sum_k 8 (4^k - 1) zeta(2k) t^(2k-2)/(4 pi)^(2k)`, `k` from 1
   real(dp), parameter :: series_w(0:terms) = [2.5e-1_dp, 5.20833333333333333e-3_dp, 1.30208333333333333e-4_dp, &
      3.29396081349206349e-6_dp, 8.34254781194885362e-8_dp, 2.11316002128176607e-9_dp, 5.35268789019060286e-11_dp, &
      1.35585142956238079e-12_dp, 3.43441172122015840e-14_dp, 8.69946649776657001e-16_dp, &
      2.20360060596464116e-17_dp, 5.58178554162464508e-19_dp, 1.41388279478329124e-20_dp]
   !> Rows f, h, w, df, dh, dw; columns are powers of the squared angle
   real(dp), parameter :: series(6, 0:terms) = transpose(reshape([ &
      series_f, &
      -series_f(1:), 0.0_dp, &
      series_w, &
      [(2*i*series_f(i), i=1, terms)], 0.0_dp, &
      [(-2*i*series_f(i + 1), i=1, terms - 1)], 0.0_dp, 0.0_dp, &
      [(2*i*series_w(i), i=1, terms)], 0.0_dp], [terms + 1, 6]))

contains

   !> Length of the axis between two nodes of the stress-free state [m].
   !>
   !> The chord times `(phi/2)/sin(phi/2)`, `phi` the angle between the two tangents: exact for a straight element and
   !> for a circular arc whose end tangents are given.
   pure function reference_length(x0, triads0) result(length)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x0(3, 2)
      !> Nodal triads (3, axis, node)
      real(dp), intent(in) :: triads0(3, 3, 2)
      real(dp) :: length
      real(dp) :: c(6), phi

      associate (t1 => triads0(:, 1, 1), t2 => triads0(:, 1, 2))
         phi = atan2(norm2(cross(t1, t2)), dot_product(t1, t2))
      end associate
      c = coefficients(phi**2)
      length = c(1)*norm2(x0(:, 2) - x0(:, 1))
   end function reference_length

   !> Chord and relative rotation of the nodes. Source: (1) to (3).
   pure function chord_rotation(x, triads, length) result(q)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x(3, 2)
      !> Nodal triads (3, axis, node), axes: tangent, first, second section axis
      real(dp), intent(in) :: triads(3, 3, 2)
      !> Reference length [m]
      real(dp), intent(in) :: length
      type(chord_rotation_t) :: q
      real(dp) :: c(6), relative(3, 3), half(3, 3)

      q%length = length
      relative = matmul(transpose(triads(:, :, 1)), triads(:, :, 2))
      q%psi = rotation_log(relative)                                             ! (1)
      half = rotation_exp(q%psi/2)
      q%mid = matmul(triads(:, :, 1), half)                                      ! (2)
      q%chord = (x(:, 2) - x(:, 1))/length
      q%gamma = matmul(q%chord, q%mid)                                           ! (3)
      q%turn = matmul(q%mid, q%psi)
      c = coefficients(dot_product(q%psi, q%psi))
      q%f = c(1)
      q%h = c(2)
      q%w = c(3)
      q%df = c(4)
      q%dh = c(5)
      q%dw = c(6)
   end function chord_rotation

   !> f, h, w of (4), (5), and their derivatives by the angle over the angle.
   pure function coefficients(angle_squared) result(c)
      !> Square of the relative rotation of the nodes [rad^2]
      real(dp), intent(in) :: angle_squared
      real(dp) :: c(6)
      real(dp) :: angle, sine, cosine, f, h, w, df
      integer :: n

      if (angle_squared < series_angle**2) then
         c = series(:, terms)
         do n = terms - 1, 0, -1
            c = c*angle_squared + series(:, n)
         end do
      else
         angle = sqrt(angle_squared)
         sine = sin(angle/2)
         cosine = cos(angle/2)
         f = angle/2/sine
         h = (1 - f)/angle_squared
         w = tan(angle/4)/angle
         df = (1 - f*cosine)/(2*angle*sine)
         ! 1/(4 cos^2(angle/4)) = 1/(2 (1 + cos(angle/2)))
         c = [f, h, w, df, -(df + 2*h)/angle_squared, (0.5_dp/(1 + cosine) - w)/angle_squared]
      end if
   end function coefficients

   !> Derivatives of `gamma` and `psi`, components in the mid triad, by the twelve unknowns.
   pure function chord_rotation_rows(q) result(rows)
      type(chord_rotation_t), intent(in) :: q
      !> Three rows of `gamma`, three of `psi` (6, 12); unknowns: displacement and spin of node 1, then of node 2
      real(dp) :: rows(6, 12)
      real(dp) :: by_mu(3), by_r(3)
      integer :: a

      do a = 1, 3
         associate (axis => q%mid(:, a))
            by_mu = cross(axis, q%chord)                    ! axis . (gamma x mu)
            by_r = q%w/2*cross(q%turn, by_mu)               ! through mu = s - W r/2
            rows(a, 1:3) = -axis/q%length                   ! (6)
            rows(a, 4:6) = by_mu/2 - by_r
            rows(a, 7:9) = axis/q%length
            rows(a, 10:12) = by_mu/2 + by_r
            by_r = q%f*axis + q%h*q%psi(a)*q%turn           ! (4)
            rows(3 + a, 1:3) = 0
            rows(3 + a, 4:6) = -by_r
            rows(3 + a, 7:9) = 0
            rows(3 + a, 10:12) = by_r
         end associate
      end do
   end function chord_rotation_rows

   !> Gradient of an energy whose derivatives by `gamma` and `psi` are `n` and `m`.
   pure function chord_rotation_residual(q, n, m) result(r)
      type(chord_rotation_t), intent(in) :: q
      !> Derivatives of the energy, in the mid triad (3) [J]
      real(dp), intent(in) :: n(3), m(3)
      !> Forces and moments on the nodes (12) [N, N m]
      real(dp) :: r(12)
      real(dp) :: force(3), moment(3), half_difference(3), n_global(3), m_global(3)

      n_global = matmul(q%mid, n)
      m_global = matmul(q%mid, m)
      force = n_global/q%length
      moment = cross(n_global, q%chord)
      half_difference = q%f*m_global + q%h*dot_product(q%psi, m)*q%turn + q%w/2*cross(q%turn, moment)
      r(1:3) = -force
      r(4:6) = moment/2 - half_difference
      r(7:9) = force
      r(10:12) = moment/2 + half_difference
   end function chord_rotation_residual

   !> Hessian of an energy with the derivatives `n`, `m` and the second derivatives `c` by `gamma` and `psi`.
   !>
   !> Blocks over (D, mu, r) first, where (4) to (9) are short, then over (D, s, r), then over the nodes. With
   !> `c = n x gamma`, `p = A m`, `t = c x psi`, the contractions of (7) and (8) are
   !>
   !>     m.psi''   = r.(A Z r) + mu.(p x r)
   !>     n.gamma'' = (gamma.mu)(n.mu) - (gamma.n)(mu.mu) - (2/L0) D.(n x mu)
   !>                 + (w/2) mu.[c (psi.r) - (c.psi) r] - (1/2)(dw + w h)(psi.r)(t.r)
   !>     A Z       = psi [(df + f h) m + (dh + 2 h^2)(m.psi) psi]^T + f h (m.psi) 1      (symmetric part)
   pure function chord_rotation_tangent(q, n, m, c_gamma, c_psi, c_gamma_psi) result(k)
      type(chord_rotation_t), intent(in) :: q
      !> Derivatives of the energy, in the mid triad (3) [J]
      real(dp), intent(in) :: n(3), m(3)
      !> Second derivatives by gamma twice and by psi twice, in the mid triad (3, 3) [J]
      real(dp), intent(in) :: c_gamma(3, 3), c_psi(3, 3)
      !> Second derivatives by gamma (row) and psi (column) (3, 3) [J]; zero when absent
      real(dp), intent(in), optional :: c_gamma_psi(3, 3)
      !> Tangent in the Hessian form (12, 12) [N/m, N, N m]
      real(dp) :: k(12, 12)
      real(dp), dimension(3, 3) :: turn_by_r, chord_by_mu, n_skew, half_w, cg_by_mu, cg_psi, cp_by_r
      real(dp), dimension(3, 3) :: k_dd, k_ds, k_dr, k_ss, k_sr, k_rr
      real(dp) :: n_global(3), m_global(3), c(3), p(3), psi_m, c_psi_dot, v(3)

      n_global = matmul(q%mid, n)
      m_global = matmul(q%mid, m)
      n_skew = skew(n_global)
      chord_by_mu = skew(q%chord)
      turn_by_r = q%f*identity3 + q%h*outer(q%turn, q%turn)
      half_w = q%w/2*skew(q%turn)

      c = cross(n_global, q%chord)
      psi_m = dot_product(q%psi, m)
      p = q%f*m_global + q%h*psi_m*q%turn
      c_psi_dot = dot_product(c, q%turn)
      v = (q%df + q%f*q%h)*m_global + (q%dh + 2*q%h**2)*psi_m*q%turn - (q%dw + q%w*q%h)/2*cross(c, q%turn)

      ! over (D, mu, r): second derivatives of the energy, then its first ones times the curvature of the kinematics
      k_dd = to_global(q%mid, c_gamma)
      cg_by_mu = matmul(k_dd, chord_by_mu)
      k_dd = k_dd/q%length**2
      k_ds = (cg_by_mu - n_skew)/q%length
      k_ss = -matmul(chord_by_mu, cg_by_mu) + symmetric_outer(q%chord, n_global) - dot_product(q%gamma, n)*identity3
      k_dr = 0
      k_sr = (skew(p) + q%w/2*(outer(c, q%turn) - c_psi_dot*identity3))/2
      if (present(c_gamma_psi)) then
         cg_psi = to_global(q%mid, c_gamma_psi)
         k_dr = matmul(cg_psi, turn_by_r)
         k_sr = k_sr - matmul(chord_by_mu, k_dr)
         k_dr = k_dr/q%length
      end if
      cp_by_r = to_global(q%mid, c_psi)
      cp_by_r = matmul(cp_by_r, turn_by_r)
      k_rr = matmul(turn_by_r, cp_by_r) + symmetric_outer(q%turn, v) &
         + q%f*q%h*psi_m*identity3

      ! over (D, s, r): mu = s - half_w r                                                                       (5)
      k_rr = k_rr + matmul(half_w, k_sr)
      k_sr = k_sr - matmul(k_ss, half_w)
      k_rr = k_rr - matmul(transpose(k_sr), half_w)
      k_dr = k_dr - matmul(k_ds, half_w)

      k = over_nodes(k_dd, k_ds, k_dr, k_ss, k_sr, k_rr)
   end function chord_rotation_tangent

   !> From blocks over `D = u2 - u1`, `s = (delta1 + delta2)/2`, `r = delta2 - delta1` to the unknowns of the nodes.
   pure function over_nodes(dd, ds, dr, ss, sr, rr) result(k)
      !> Second derivatives of the energy (3, 3): the first letter is of the rows, the second of the columns
      real(dp), dimension(3, 3), intent(in) :: dd, ds, dr, ss, sr, rr
      real(dp) :: k(12, 12)

      k(1:3, 1:3) = dd
      k(1:3, 7:9) = -dd
      k(7:9, 1:3) = -dd
      k(7:9, 7:9) = dd
      k(1:3, 4:6) = dr - ds/2
      k(1:3, 10:12) = -dr - ds/2
      k(7:9, 4:6) = -k(1:3, 4:6)
      k(7:9, 10:12) = -k(1:3, 10:12)
      k(4:6, 1:3) = transpose(k(1:3, 4:6))
      k(4:6, 7:9) = -k(4:6, 1:3)
      k(10:12, 1:3) = transpose(k(1:3, 10:12))
      k(10:12, 7:9) = -k(10:12, 1:3)
      k(4:6, 4:6) = ss/4 - (sr + transpose(sr))/2 + rr
      k(4:6, 10:12) = ss/4 + (sr - transpose(sr))/2 - rr
      k(10:12, 4:6) = ss/4 - (sr - transpose(sr))/2 - rr
      k(10:12, 10:12) = ss/4 + (sr + transpose(sr))/2 + rr
   end function over_nodes

   !> Matrix in the mid triad to global axes.
   pure function to_global(mid, c) result(g)
      !> Mid triad, its axes as columns
      real(dp), intent(in) :: mid(3, 3)
      !> Components in the mid triad
      real(dp), intent(in) :: c(3, 3)
      real(dp) :: g(3, 3)

      g = matmul(matmul(mid, c), transpose(mid))
   end function to_global

   pure function diagonal(entries) result(c)
      !> Diagonal of the matrix
      real(dp), intent(in) :: entries(3)
      real(dp) :: c(3, 3)

      c = 0
      c(1, 1) = entries(1)
      c(2, 2) = entries(2)
      c(3, 3) = entries(3)
   end function diagonal

   pure function outer(a, b) result(c)
      !> The factors: `a` gives the rows, `b` the columns
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: c(3, 3)

      c(:, 1) = a*b(1)
      c(:, 2) = a*b(2)
      c(:, 3) = a*b(3)
   end function outer

   !> Symmetric part of `a b^T`.
   pure function symmetric_outer(a, b) result(c)
      !> The factors, in any order
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: c(3, 3)

      c = (outer(a, b) + outer(b, a))/2
   end function symmetric_outer

end module litz_beam_kinematics
