!> The law of line contact over a whole lens of overlap: two wires that cross, as one point.
!>
!> Source: theory section 10. Along the lens, of half length `aW = sqrt(2 d delta)/s`, the overlap is `delta (1 - u^2)`
!> at `u = x/aW`; `s` is the sine of the crossing, corrected for the curvature of the wires. The integrals over u from
!> -1 to 1 are those of four Gauss points, of which the two at u < 0 are the same as the others: exact where the force
!> goes with the overlap, as in a Hertz contact.
module litz_lens_law
   use litz_gauss, only: six_places, six_weights
   use litz_kinds, only: dp
   use litz_line_law, only: line_wires_t, line_force_t, line_force, line_spot_t, line_spot
   implicit none
   private
   public :: lens_integral, n_depths, gauss_depth, gauss_weight
   public :: lens_t, lens_force, kept_lens, lens_spot_t, lens_spot, lens_energy, grown_energy, share_of_point, &
      share_of_ends, share_of_line, slope_of_line_share, smooth_step

   integer, parameter :: n_depths = 2
   !> `1 - u^2` of the Gauss points, and twice their weights
   real(dp), parameter :: gauss_depth(n_depths) = 1 - [0.33998104358485626480_dp, 0.86113631159405257522_dp]**2
   real(dp), parameter :: gauss_weight(n_depths) = 2*[0.65214515486254614263_dp, 0.34785484513745385737_dp]
   !> Gauss points in (0, 1) and their weights, over the square root of the overlap, for the energy: there the integrand
   !> is a polynomial but for the slow change of a logarithm
   real(dp), parameter :: energy_place(6) = 0.5_dp + 0.5_dp*six_places, energy_weight(6) = 0.5_dp*six_weights
   !> A lens is a point up to the first half length, a line from the second one on, in spacings of the line points
   real(dp), parameter, public :: point_up_to = 2, line_from = 6
   !> Beside the smaller radius the half length of a lens is short up to the first value, so that the lens is the far
   !> field and the spot is that of crossed wires; from the second one on it is long, as a line whose far field is the
   !> section of the wires
   real(dp), parameter :: short_up_to = 0.3_dp, long_from = 1

   !> Lens and force; all 0 where the wires do not overlap.
   type :: lens_t
      !> aW [m], daW/dg [-], daW/dangle [m/rad]
      real(dp) :: half_length = 0, dhalf_length_dgap = 0, dhalf_length_dangle = 0
      !> F [N], dF/dg [N/m], dF/dangle [N/rad] at fixed gap
      real(dp) :: force = 0, dforce_dgap = 0, dforce_dangle = 0
      !> d2F/dangle2 [N/rad^2] at fixed gap
      real(dp) :: d2force_dangle2 = 0
      !> The law at the deepest place, and at the Gauss points
      type(line_force_t) :: deepest, along(n_depths)
      !> Gap of its deepest place [m], and how the overlap at the Gauss points changes with that [-]
      real(dp) :: gap = 0
      real(dp) :: doverlap_dgap(n_depths) = -gauss_depth
   end type lens_t

   !> Conductance of a lens, 0 where there is no force.
   type :: lens_spot_t
      !> G [S], dG/dg [S/m] at fixed angle, dG/dangle [S/rad] at fixed gap
      real(dp) :: conductance = 0, dconductance_dgap = 0, dconductance_dangle = 0
      !> dG/drho of the barred and of the unbarred wire (2) [S/(ohm m)]
      real(dp) :: dconductance_dresistivity(2) = 0
      !> Half width of the strip at the deepest place [m]
      real(dp) :: half_width = 0
      !> The strip is wider than the law holds for
      logical :: too_wide = .false.
   end type lens_spot_t

contains

   !> `F = aW int f du` and its derivatives.
   pure type(lens_t) function lens_force(line, gap, sine, penalty) result(lens)
      !> At the angle whose sine is `min(sine, 1)`
      type(line_wires_t), intent(in) :: line
      !> Gap between the surfaces [m], negative in contact
      real(dp), intent(in) :: gap
      !> s, positive [-]
      real(dp), intent(in) :: sine
      !> eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: penalty
      real(dp) :: distance, f, df_dgap, df_dangle, d2f_dangle2
      integer :: i

      if (gap >= 0) return
      distance = sum(line%radius) + gap                                                    ! d
      lens%gap = gap
      lens%half_length = sqrt(-2*distance*gap)/sine
      lens%dhalf_length_dgap = -(distance + gap)/(sine**2*lens%half_length)
      lens%dhalf_length_dangle = -lens%half_length*cosine(sine)/sine
      lens%deepest = line_force(line, -gap, penalty)
      do i = 1, n_depths
         lens%along(i) = line_force(line, -gap*gauss_depth(i), penalty)
      end do
      f = dot_product(gauss_weight, lens%along%force)
      df_dgap = -dot_product(gauss_weight*gauss_depth, lens%along%stiffness)
      df_dangle = dot_product(gauss_weight, lens%along%dforce_dangle)
      d2f_dangle2 = dot_product(gauss_weight, lens%along%d2force_dangle2)
      lens%force = f*lens%half_length
      lens%dforce_dgap = f*lens%dhalf_length_dgap + df_dgap*lens%half_length
      lens%dforce_dangle = f*lens%dhalf_length_dangle + df_dangle*lens%half_length
      lens%d2force_dangle2 = (f*(1 + 2*(cosine(sine)/sine)**2) + d2f_dangle2)*lens%half_length &
         + 2*df_dangle*lens%dhalf_length_dangle
   end function lens_force

   !> The present lens and its force, with the law of the overlaps along it when it was deeper: these stay.
   pure type(lens_t) function kept_lens(line, gap, sine, penalty, made) result(lens)
      type(line_wires_t), intent(in) :: line
      !> Gap between the surfaces [m], negative in contact
      real(dp), intent(in) :: gap
      !> s, positive [-]
      real(dp), intent(in) :: sine
      !> eps_l [N/m^2]; 0: the elastic law. The deepest overlap that it had [m]
      real(dp), intent(in) :: penalty, made
      integer :: i

      lens = lens_force(line, gap, sine, penalty)
      do i = 1, n_depths
         lens%along(i) = line_force(line, made + gap*(1 - gauss_depth(i)), penalty)
      end do
      lens%doverlap_dgap = 1 - gauss_depth
   end function kept_lens

   !> `G = aW int g' du` and its derivatives.
   pure type(lens_spot_t) function lens_spot(line, lens, film, hardness) result(spot)
      type(line_wires_t), intent(in) :: line
      type(lens_t), intent(in) :: lens
      !> sigma_f [ohm m^2], H [Pa]; see line_spot
      real(dp), intent(in) :: film, hardness
      type(line_spot_t) :: at
      real(dp) :: g, dg_dgap, dg_dangle, dg_dresistivity(2)
      integer :: i

      at = line_spot(line, lens%deepest%force, film, hardness)
      spot%half_width = at%half_width
      spot%too_wide = at%too_wide
      g = 0
      dg_dgap = 0
      dg_dangle = 0
      dg_dresistivity = 0
      do i = 1, n_depths
         associate (f => lens%along(i))
            at = line_spot(line, f%force, film, hardness)
            g = g + gauss_weight(i)*at%conductance
            dg_dgap = dg_dgap + gauss_weight(i)*at%dconductance_dforce*f%stiffness*lens%doverlap_dgap(i)
            dg_dangle = dg_dangle + gauss_weight(i)*(at%dconductance_dangle + at%dconductance_dforce*f%dforce_dangle)
            dg_dresistivity = dg_dresistivity + gauss_weight(i)*at%dconductance_dresistivity
         end associate
      end do
      spot%dconductance_dresistivity = dg_dresistivity*lens%half_length
      spot%conductance = g*lens%half_length
      spot%dconductance_dgap = g*lens%dhalf_length_dgap + dg_dgap*lens%half_length
      spot%dconductance_dangle = g*lens%dhalf_length_dangle + dg_dangle*lens%half_length
   end function lens_spot

   !> Integral along the lens of what depends on the force per length, and how it changes with the gap.
   pure subroutine lens_integral(lens, value, slope, integral, dintegral_dgap)
      !> From lens_force
      type(lens_t), intent(in) :: lens
      !> At the forces `lens%along`, and its derivative with respect to the force [per N/m]
      real(dp), intent(in) :: value(n_depths), slope(n_depths)
      !> Over the length [m], and its derivative with respect to the gap
      real(dp), intent(out) :: integral, dintegral_dgap
      real(dp) :: mean

      mean = dot_product(gauss_weight, value)
      integral = mean*lens%half_length
      dintegral_dgap = mean*lens%dhalf_length_dgap &
         + dot_product(gauss_weight*lens%doverlap_dgap, slope*lens%along%stiffness)*lens%half_length
   end subroutine lens_integral

   !> Integral of the force over the overlap at a fixed angle, and how it changes with the angle.
   pure subroutine lens_energy(line, gap, sine, penalty, energy, denergy_dangle, d2energy_dangle2)
      !> At the angle whose sine is `min(sine, 1)`
      type(line_wires_t), intent(in) :: line
      !> Gap between the surfaces [m], negative in contact
      real(dp), intent(in) :: gap
      !> s, positive [-]
      real(dp), intent(in) :: sine
      !> eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: penalty
      !> [J, J/rad, J/rad^2]
      real(dp), intent(out) :: energy, denergy_dangle, d2energy_dangle2
      type(lens_t) :: lens
      real(dp) :: weight
      integer :: i

      energy = 0
      denergy_dangle = 0
      d2energy_dangle2 = 0
      do i = 1, size(energy_place)
         lens = lens_force(line, gap*energy_place(i)**2, sine, penalty)
         weight = -energy_weight(i)*2*energy_place(i)*gap
         energy = energy + weight*lens%force
         denergy_dangle = denergy_dangle + weight*lens%dforce_dangle
         d2energy_dangle2 = d2energy_dangle2 + weight*lens%d2force_dangle2
      end do
   end subroutine lens_energy

   !> What the force has done from first touch, while the section of the wires came to count as the lens grew [J].
   pure real(dp) function grown_energy(line, gap, sine, reach, deepest) result(energy)
      !> With the whole section
      type(line_wires_t), intent(in) :: line
      !> Gap between the surfaces [m], negative in contact, and s [-]
      real(dp), intent(in) :: gap, sine
      !> aW in smaller radii by which the section counts [-], which goes with the root of the overlap up to this one [m]
      real(dp), intent(in) :: reach, deepest
      type(line_wires_t) :: before
      type(lens_t) :: lens
      integer :: i

      energy = 0
      before = line
      do i = 1, size(energy_place)
         before%section = share_of_line(reach*sqrt(min(1.0_dp, -gap*energy_place(i)**2/min(-gap, deepest)))) &
            *line%section
         lens = lens_force(before, gap*energy_place(i)**2, sine, 0.0_dp)
         energy = energy - energy_weight(i)*2*energy_place(i)*gap*lens%force
      end do
   end function grown_energy

   !> Share w_P of the contact that the point carries; the line points carry the rest.
   pure subroutine share_of_point(half_length, spacing, weight, dweight_dhalf_length)
      !> aW [m]
      real(dp), intent(in) :: half_length
      !> Distance of neighbouring line points [m]
      real(dp), intent(in) :: spacing
      !> w_P in [0, 1], and its derivative with respect to aW [1/m]
      real(dp), intent(out) :: weight, dweight_dhalf_length
      real(dp) :: u

      u = (line_from - half_length/spacing)/(line_from - point_up_to)
      u = max(0.0_dp, min(1.0_dp, u))
      weight = smooth_step(u)
      dweight_dhalf_length = -6*u*(1 - u)/((line_from - point_up_to)*spacing)
   end subroutine share_of_point

   !> What round ends carry of a contact beside the places along its line: all that these leave, and the whole of what
   !> is too short for them.
   pure real(dp) function share_of_ends(line_share, length, spacing) result(share)
      !> Part that places carry, length of the overlap as ends leave it [m], and distance of neighbouring places [m]
      real(dp), intent(in) :: line_share, length, spacing
      real(dp) :: slope

      call share_of_point(length, spacing, share, slope)
      share = max(1 - line_share, share)
   end function share_of_ends

   !> How far a lens has turned from a point into a line, by its length beside the radii.
   elemental real(dp) function share_of_line(half_length) result(share)
      !> aW in smaller radii [-]
      real(dp), intent(in) :: half_length

      share = smooth_step((half_length - short_up_to)/(long_from - short_up_to))
   end function share_of_line

   !> Its derivative.
   elemental real(dp) function slope_of_line_share(half_length) result(slope)
      !> aW in smaller radii [-]
      real(dp), intent(in) :: half_length
      real(dp) :: u

      u = max(0.0_dp, min(1.0_dp, (half_length - short_up_to)/(long_from - short_up_to)))
      slope = 6*u*(1 - u)/(long_from - short_up_to)
   end function slope_of_line_share

   !> 0 up to 0, 1 from 1 on, without a corner.
   elemental real(dp) function smooth_step(u)
      !> [-]
      real(dp), intent(in) :: u

      associate (v => max(0.0_dp, min(1.0_dp, u)))
         smooth_step = v**2*(3 - 2*v)
      end associate
   end function smooth_step

   !> Of the angle whose sine is `sine`, between 0 and 90 degrees.
   pure real(dp) function cosine(sine)
      !> s, which the curvature of the wires can make greater than 1
      real(dp), intent(in) :: sine

      cosine = sqrt(max(0.0_dp, (1 - sine)*(1 + sine)))
   end function cosine

end module litz_lens_law
