!> The energy of a contact near the ends of its wires, where its lens of overlap is cut: what cylinders and round ends
!> have of it.
!>
!> Source: theory section 10. With the distances y1, y2 along the wires, towards their ends, from the place at which the
!> axes are nearest to each other or would be if they went on, the overlap is
!> `delta - (y1^2 - 2 gamma y1 y2 + y2^2)/(2 d)`, with the cosine gamma between the two ways to the ends. Over the
!> feet on
!> the other wire this is a parabola of the half length aW, which an end at `y = a` cuts: the cylinder keeps the part
!> `E(u)`, `u = a/aW`, of the energy, the end gets `1 - E(u)` of that of a sphere. All follows from an energy, so that
!> forces across the wires and along them are its derivatives. Of wires that are bent, y1^2 and y2^2 have factors c1, c2
!> with the curvatures `b1 = c1 - gamma^2/c2`, `b2 = c2 - gamma^2/c1` over the feet, times d.
module litz_cut_lens
   use litz_kinds, only: dp, pi
   use litz_jets, only: jet_t, variable, constant, composed, operator(+), operator(-), operator(*), operator(**)
   use litz_lens_law, only: smooth_step
   implicit none
   private
   public :: cut_lens_t, lens_part_t, cut_energy, energy_below, integral_to, is_whole, is_cut

   !> Energy of a contact over its overlap: the power of Hertz
   real(dp), parameter :: energy_power = 2.5_dp
   !> Sines of the angle between an axis and the surface of the other wire up to which they lie side by side, and from
   !> which on one runs into the other (5 and 15 degrees)
   real(dp), parameter, public :: flat_tilt = 0.0872_dp, steep_tilt = 0.2588_dp

   !> Sines of the angle between wires up to which they lie along each other, and from which on they cross (2.5 and 5
   !> degrees)
   real(dp), parameter :: lies_along = 0.0436_dp, crosses = 0.0872_dp
   !> kappa^2 of a spot that is as long as the overlap, and the part of the curvature where all is that of the wire
   real(dp), parameter :: whole_overlap = 1, all_own = 1
   !> An overlap that begins at the end is half a wedge where its place is this part of it (from half-spaces)
   real(dp), parameter :: wedge_from = 2
   !> kappa_w over 2 kappa^2, as a power (from half-spaces)
   real(dp), parameter :: wedge_power = 1/3.0_dp

   !> Square of the length on which cylinders fall beyond the ends of both wires, over that of the overlap (from
   !> half-spaces)
   real(dp), parameter :: spot_beyond_ends = 0.25_dp
   !> Part of the contact of a round end that lies beyond the end of a line
   real(dp), parameter :: half_of_end = 0.5_dp
   !> What two halves have at least in common, and at least not: without a corner where the other end comes first
   real(dp), parameter :: least_common = 0.01_dp

   !> What stays within an iteration.
   type :: cut_lens_t
      !> It has been found
      logical :: is_known = .false., has_energies = .false.
      !> Which of the two wires end near the contact, and to which of their ends (1 or 2) they do
      logical :: near(2) = .false.
      integer :: side(2) = 0
      !> Angle between the axes that the law sees [rad], and their distance d [m]
      real(dp) :: angle = 0, distance = 1
      !> gamma, and d times the curvature of the distance along either wire, over the feet on the other one (2) [-]
      real(dp) :: cosine = 0, bend(2) = 1
      !> Energy of the pairs of shapes over that of two cylinders, at the same overlap: index 1 of a cylinder, 2 of a
      !> round end, barred before unbarred (2, 2)
      real(dp) :: energy(2, 2) = 1
      !> Square of the length of the spot along either wire, over that of the overlap (2) [-]
      real(dp) :: extent(2) = 1
      !> The same of the spot of the round end of either wire on the other one (2) [-]
      real(dp) :: spot_of_end(2) = 1
      !> By how much less than the round end the cylinder behind it overlaps, over the square of its place (2) [1/m]
      real(dp) :: receding(2) = 0
      !> Part of the curvature that is that of the wires, and not that of the longest overlap (2) [-]
      real(dp) :: own_bend(2) = 1
      !> Curvature of an ellipse as long as the wedge from the end of a wire on, whose law the cylinders have there,
      !> over that of the overlap [-]
      real(dp) :: of_wedge = 1
      !> It is at a joint of either wire, or a joint cuts its overlap: what the cylinders (1) of all legs and the round
      !> joint (2) of the barred and the unbarred wire have of the force, in parts of what they would have alone (2, 2),
      !> and what counts of the part of both cylinders
      logical :: is_near_joint = .false.
      real(dp) :: of_joint(2, 2) = reshape([1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp], [2, 2]), of_crossing = 1
      !> The legs of a wire are not of one material: means of Young's modulus [Pa] and Poisson's ratio (2)
      logical :: is_mixed(2) = .false.
      real(dp) :: young(2) = 0, poisson(2) = 0
      !> What the ball of a joint adds to the radii (2) [m]
      real(dp) :: of_ball(2) = 0
      !> What the contact has of these pairs, of which other contacts or the places along a line have the rest (2, 2)
      real(dp) :: share(2, 2) = 1
      !> Part of what it has of round ends that it has beside places along a line, which carry the cylinders there
      real(dp) :: beside_places = 0
   end type cut_lens_t

   !> Part of the energy of two uncut cylinders, as a function of overlap and of both places.
   type :: lens_part_t
      !> All of it, and that of either pair of shapes (2, 2)
      type(jet_t) :: whole, pair(2, 2)
   end type lens_part_t

contains

   !> An end or a joint is near.
   pure logical function is_cut(lens)
      type(cut_lens_t), intent(in) :: lens

      is_cut = any(lens%near) .or. lens%is_near_joint
   end function is_cut

   !> No end or joint is near enough to be felt, and the contact is not at one.
   pure logical function is_whole(lens, held, overlap, place)
      type(cut_lens_t), intent(in) :: lens
      !> The contact is at the end of the barred, of the unbarred wire (2)
      logical, intent(in) :: held(2)
      !> Overlap [m], and places as `cut_energy` has them (2) [m]
      real(dp), intent(in) :: overlap, place(2)

      is_whole = .not. (lens%is_near_joint .or. any(lens%near .and. (held .or. lens%bend*place**2 &
         < 2*lens%distance*overlap)))
   end function is_whole

   !> The energy over that of two cylinders without ends at the overlap of the contact.
   pure type(lens_part_t) function cut_energy(lens, held, overlap, place) result(part)
      type(cut_lens_t), intent(in) :: lens
      !> The contact is at the end of the barred, of the unbarred wire (2)
      logical, intent(in) :: held(2)
      !> At the contact, positive [m]
      real(dp), intent(in) :: overlap
      !> Of a contact that is not at the end, how far that is along the wire; else minus d times the slope with which
      !> the distance grows from the end on (2) [m]
      real(dp), intent(in) :: place(2)

      part%pair = parts_of_pairs(lens, held, overlap, place)
      if (lens%is_near_joint) part%pair = divided_at_joints(lens, part%pair)
      part%pair = (lens%share*lens%energy)*part%pair
      part%whole = part%pair(1, 1) + part%pair(2, 1) + part%pair(1, 2) + part%pair(2, 2)
   end function cut_energy

   !> What the pairs of shapes have of the overlap: index 1 of a cylinder, 2 of a round end, barred before unbarred.
   pure function parts_of_pairs(lens, held, overlap, place) result(pair)
      type(cut_lens_t), intent(in) :: lens
      !> The contact is at the end (2)
      logical, intent(in) :: held(2)
      !> As `cut_energy` has them [m]
      real(dp), intent(in) :: overlap, place(2)
      type(jet_t) :: pair(2, 2)
      type(jet_t) :: delta, middle, at_end(2), corner, a(2), foot(2), cylinder(2), over_foot(2), flat(2), both, scale
      type(jet_t) :: of_cylinders, recess, of_end(2), lean(2)
      real(dp) :: root(2), opposite
      integer :: i

      delta = variable(overlap, 1)
      call find_overlaps(lens, held, delta, [variable(place(1), 2), variable(place(2), 3)], a, foot, middle, at_end, &
         corner)
      root = sqrt(curvatures_of(lens)/(2*lens%distance))
      opposite = 0
      if (all(lens%near)) opposite = opposite_ways(lens%cosine)
      do i = 1, 2
         cylinder(i) = constant(1.0_dp)
         over_foot(i) = constant(1.0_dp)
         flat(i) = constant(1.0_dp)
         if (.not. lens%near(i)) cycle
         recess = constant(0.0_dp)
         if (held(i) .and. place(i) < 0) recess = lens%receding(i)*variable(place(i), i + 1)*variable(place(i), i + 1)
         cylinder(i) = energy_to(sqrt(lens%bend(i)/(2*lens%distance))*a(i), at_end(i) - recess, &
            lens%extent(i), lens%own_bend(i))
         over_foot(i) = energy_to(root(i)*foot(i), corner, whole_overlap, all_own)
         if (opposite > 0) over_foot(i) = (1 - opposite)*over_foot(i) + opposite*on_its_side(root(i)*foot(i), corner, &
            lens%spot_of_end(3 - i))
         middle = middle - recess
         if (.not. held(i)) cycle
         flat(i) = flatness((-1/lens%distance)*variable(place(i), i + 1))
         cylinder(i) = flat(i)*cylinder(i)
         over_foot(i) = flat(i)*over_foot(i)
      end do
      both = of_both(cylinder, lens%cosine)
      lean = [constant(0.0_dp), constant(0.0_dp)]
      if (opposite > 0) call cut_behind_end(lens, held, opposite, a, middle, flat, cylinder, both, lean)
      of_cylinders = constant(1.0_dp)
      ! straight wires lead away from the ends of each other, however long their overlap counts
      if (all(held)) foot = [variable(place(1), 2), variable(place(2), 3)]
      if (all(held)) root = sqrt(1/(2*lens%distance))
      if (all(lens%near)) of_cylinders = left_by_ends(root, foot, corner)
      both = of_cylinders*both
      scale = delta**(-energy_power)
      ! the law of a shorter ellipse, along as long an overlap
      pair(1, 1) = sqrt(lens%of_wedge)*both*energy_of(middle)*scale
      associate (beside => opposite*lens%beside_places)
         do i = 1, 2
            of_end(i) = 1.0_dp - cylinder(i)
            of_end(i) = (1 - beside)*of_end(i) + beside*(half_of_end*lean(i) + (1.0_dp - lean(i)) &
               *beside_places(of_end(i)))
         end do
         both = (1.0_dp - beside*(lean(1) + lean(2)))*both
      end associate
      pair(2, 1) = of_cylinders*of_end(1)*over_foot(2)
      pair(1, 2) = of_cylinders*of_end(2)*over_foot(1)
      pair(2, 2) = constant(0.0_dp)
      if (all(lens%near)) pair(2, 2) = at_least_zero(1.0_dp - both - pair(2, 1) - pair(1, 2))*energy_of(corner)*scale
      pair(2, 1) = pair(2, 1)*energy_of(at_end(1))*scale
      pair(1, 2) = pair(1, 2)*energy_of(at_end(2))*scale
   end function parts_of_pairs

   !> Where one wire leans on the other one with its end, and that one ends within the overlap so begun and leads the
   !> other way: both cylinders have what lies between the ends, which is none as these pass each other. What lies
   !> beyond the other end is an overlap that begins there, by the law of the first one.
   pure subroutine cut_behind_end(lens, held, opposite, a, middle, flat, cylinder, both, beyond)
      type(cut_lens_t), intent(in) :: lens
      !> The contact is at the end (2)
      logical, intent(in) :: held(2)
      !> How much they lead opposite ways
      real(dp), intent(in) :: opposite
      !> From the middle to the ends (2), the overlap there, and how flat either wire lies (2)
      type(jet_t), intent(in) :: a(2), middle, flat(2)
      !> What either cylinder keeps (2), and what both of them do
      type(jet_t), intent(inout) :: cylinder(2), both
      !> How much an end lies beyond that on which the other wire leans (2)
      type(jet_t), intent(inout) :: beyond(2)
      type(jet_t) :: own, other, at_end, square, lean, kept
      real(dp) :: of_wedge
      integer :: i

      i = findloc(held .and. a%value < 0, .true., 1)
      if (i == 0) return
      own = sqrt(lens%bend(i)/(2*lens%distance))*a(i)
      other = sqrt(lens%bend(3 - i)/(2*lens%distance))*a(3 - i)
      at_end = middle - own*own
      if (.not. (other%value > 0 .and. at_end%value > 0)) return
      square = own*own
      lean = (wedge_from*opposite)*square*(lens%own_bend(i)*at_end + wedge_from*square)**(-1.0_dp)
      associate (extent => lens%extent(3 - i))
         of_wedge = min(1.0_dp, (2*extent)**wedge_power)
         square = other*other
         at_end = middle - square
         kept = at_end*(extent + (of_wedge - extent)*lean) + square*(extent + (1 - extent)*lean)
         cylinder(3 - i) = constant(1.0_dp)
         if (square%value < kept%value) cylinder(3 - i) = energy_below(other*kept**(-0.5_dp))
         cylinder(3 - i) = flat(3 - i)*cylinder(3 - i)
      end associate
      beyond(3 - i) = lean
      both = (1.0_dp - lean)*of_both(cylinder, lens%cosine) + lean*at_least_zero(cylinder(1) + cylinder(2) &
         - constant(1.0_dp))
   end subroutine cut_behind_end

   !> How much two wires lead opposite ways from their ends: side by side, not across.
   pure real(dp) function opposite_ways(cosine) result(opposite)
      !> gamma
      real(dp), intent(in) :: cosine

      opposite = 0
      if (cosine < 0) opposite = 1 - smooth_step((sqrt(max(0.0_dp, 1 - cosine**2)) - lies_along)/(crosses - lies_along))
   end function opposite_ways

   !> What a round end has over a wire that leads the other way than its own: its side of the contact as long as the end
   !> of that is beyond its own, else what the spot reaches of that.
   pure type(jet_t) function on_its_side(x, corner, extent) result(part)
      !> `y sqrt(c/(2 d))` of the foot [m^(1/2)], and overlap of end over end
      type(jet_t), intent(in) :: x, corner
      !> kappa^2 of the spot
      real(dp), intent(in) :: extent
      type(jet_t) :: whole

      part = constant(1.0_dp)
      if (.not. x%value < 0) return
      whole = extent*(corner + x*x)
      part = constant(0.0_dp)
      if (x%value**2 < whole%value) part = 2.0_dp*energy_below(x*whole**(-0.5_dp))
   end function on_its_side

   !> What a round end has of its contact beside a line that places carry up to the end: what lies beyond the end, a
   !> half as the wire leans.
   pure type(jet_t) function beside_places(of_end) result(part)
      !> What it has of a lens that the contact carries
      type(jet_t), intent(in) :: of_end
      real(dp) :: s

      part = of_end
      s = 2*of_end%value - 1
      if (s > 0) part = composed(of_end, (1 + s*(1 - s)**2)/2, (1 - s)*(1 - 3*s), 2*(6*s - 4))
   end function beside_places

   !> What joints leave of the parts of cylinders and ends: of each cylinder those of its legs, the joint has the rest.
   pure function divided_at_joints(lens, pair) result(divided)
      type(cut_lens_t), intent(in) :: lens
      !> Index 1 of a cylinder, 2 of a round end, barred before unbarred (2, 2)
      type(jet_t), intent(in) :: pair(2, 2)
      type(jet_t) :: divided(2, 2)

      associate (bar => lens%of_joint(:, 1), unbarred => lens%of_joint(:, 2))
         divided(1, 1) = (bar(1)*unbarred(1)*lens%of_crossing)*pair(1, 1)
         divided(2, 1) = unbarred(1)*(pair(2, 1) + bar(2)*pair(1, 1))
         divided(1, 2) = bar(1)*(pair(1, 2) + unbarred(2)*pair(1, 1))
         divided(2, 2) = pair(2, 2) + unbarred(2)*(pair(2, 1) + bar(2)*pair(1, 1)) + bar(2)*pair(1, 2)
      end associate
   end function divided_at_joints

   !> Places and overlaps round the contact, from the place at which it is.
   pure subroutine find_overlaps(lens, held, delta, place, a, foot, middle, at_end, corner)
      type(cut_lens_t), intent(in) :: lens
      !> (2)
      logical, intent(in) :: held(2)
      type(jet_t), intent(in) :: delta, place(2)
      !> From the nearest place of both axes to the ends, from the foot of either end to that of the other wire (2),
      !> overlap in that place, at the ends over their feet (2), and of end over end
      type(jet_t), intent(out) :: a(2), foot(2), middle, at_end(2), corner
      real(dp) :: c(2), k_foot(2)
      integer :: i

      c = curvatures_of(lens)
      k_foot = c/(2*lens%distance)
      associate (gamma => lens%cosine, k => lens%bend/(2*lens%distance))
         if (all(held)) then
            do i = 1, 2
               foot(i) = (1/c(i))*place(i)
               a(i) = (1/lens%bend(i))*(place(i) + (gamma/c(3 - i))*place(3 - i))
            end do
            do i = 1, 2
               at_end(i) = delta + k_foot(3 - i)*foot(3 - i)*foot(3 - i)
            end do
            corner = delta
            middle = at_end(1) + k(1)*a(1)*a(1)
         else if (any(held)) then
            associate (own => merge(1, 2, held(1)))
               a(own) = (1/lens%bend(own))*place(own)
               foot(3 - own) = place(3 - own)
               a(3 - own) = place(3 - own) + (gamma/c(3 - own))*a(own)
               foot(own) = (1/c(own))*(place(own) - gamma*place(3 - own))
               at_end(own) = delta
               middle = delta + k(own)*a(own)*a(own)
               at_end(3 - own) = middle - k(3 - own)*a(3 - own)*a(3 - own)
               corner = delta - k_foot(3 - own)*foot(3 - own)*foot(3 - own)
            end associate
         else
            a = place
            middle = delta
            do i = 1, 2
               at_end(i) = middle - k(i)*a(i)*a(i)
               foot(i) = a(i) - (gamma/c(i))*a(3 - i)
            end do
            corner = at_end(1) - k_foot(2)*foot(2)*foot(2)
         end if
      end associate
   end subroutine find_overlaps

   !> c1 and c2, of straight wires 1 (2) [-].
   pure function curvatures_of(lens) result(c)
      type(cut_lens_t), intent(in) :: lens
      real(dp) :: c(2)

      associate (b => lens%bend)
         c = (b + sqrt(b**2 + 4*lens%cosine**2*b/b([2, 1])))/2
      end associate
   end function curvatures_of

   !> Energy of an overlap but for a factor; 0 where there is none.
   pure type(jet_t) function energy_of(overlap) result(energy)
      type(jet_t), intent(in) :: overlap

      energy = constant(0.0_dp)
      if (overlap%value > 0) energy = overlap**energy_power
   end function energy_of

   !> `E(u)` of what a cylinder keeps before its end. The pressure is that of Hertz's ellipse, whose length along the
   !> wire is a part of that of the overlap: `u^2 = x^2/(kappa^2 delta)` before the end. Of an overlap that only begins
   !> at the end, where the wire leans, the same up to `u^2 = x^2/(kappa_w delta_c + x^2)` of a wedge, whose `kappa_w`
   !> follows from that of the whole ellipse. Source: theory (10.17), (10.18a).
   pure type(jet_t) function energy_to(x, overlap, extent, own_bend) result(energy)
      !> `a sqrt(k/2)` [m^(1/2)], and the overlap of the cylinder at its end, delta_c
      type(jet_t), intent(in) :: x, overlap
      !> kappa^2, and the part of k that is that of the wires
      real(dp), intent(in) :: extent, own_bend
      type(jet_t) :: u, square, whole, lean
      real(dp) :: of_wedge

      energy = constant(merge(1.0_dp, 0.0_dp, x%value > 0))
      square = x*x
      whole = overlap + square
      of_wedge = min(1.0_dp, (2*extent)**wedge_power)
      if (x%value > 0) then
         if (.not. square%value < extent*whole%value) return
         u = x*(extent*whole)**(-0.5_dp)
      else
         if (.not. overlap%value > 0) return
         ! kappa^2 where it begins to lean
         lean = wedge_from*square
         u = x*(square + overlap*((own_bend*extent)*overlap + of_wedge*lean)*(own_bend*overlap + lean)**(-1.0_dp)) &
            **(-0.5_dp)
      end if
      energy = energy_below(u)
   end function energy_to

   !> `E(u)`.
   pure type(jet_t) function energy_below(u) result(energy)
      !> Between -1 and 1
      type(jet_t), intent(in) :: u

      energy = composed(u, integral_to(u%value), 15*(1 - u%value**2)**2/16, -15*u%value*(1 - u%value**2)/4)
   end function energy_below

   !> `E(u)`, the part of the integral of `(1 - v^2)^2` from -1 to 1 that lies below u.
   elemental real(dp) function integral_to(u) result(part)
      !> Between -1 and 1
      real(dp), intent(in) :: u

      part = (1 + u)**3*(8 - 9*u + 3*u**2)/16
   end function integral_to

   !> Part of a lens that two ends leave of it. Along wires that are perpendicular to each other each end cuts for
   !> itself;
   !> along wires that lie side by side the one that comes first does, or what is between them is left. Two halves of a
   !> distribution with elliptical contours have the part `1/4 + asin(gamma)/(2 pi)` in common. Source: R. L. Plackett,
   !> J. Am. Stat. Assoc. 60 (1965) 516-522, for what is between.
   pure type(jet_t) function of_both(part, cosine) result(both)
      !> Of either end alone (2)
      type(jet_t), intent(in) :: part(2)
      !> gamma
      real(dp), intent(in) :: cosine
      type(jet_t) :: b
      real(dp) :: halves, theta

      halves = 0.25_dp + asin(max(-1.0_dp, min(1.0_dp, cosine)))/(2*pi)
      halves = max(least_common, min(0.5_dp - least_common, halves))
      theta = (2*halves/(1 - 2*halves))**2
      b = 1.0_dp + (theta - 1)*(part(1) + part(2))
      both = (2*theta)*part(1)*part(2)*(b + (b*b - (4*theta*(theta - 1))*part(1)*part(2))**0.5_dp)**(-1.0_dp)
   end function of_both

   !> What cylinders keep where both wires end: all that either end leaves as long as one foot is on its wire. Where
   !> both feet are beyond the ends, nothing overlaps as much as these do: with that overlap what cylinders have goes to
   !> zero, faster than the energy of two round ends.
   pure type(jet_t) function left_by_ends(scale, foot, corner) result(part)
      !> `sqrt(c/(2 d))` (2) [m^(-1/2)]
      real(dp), intent(in) :: scale(2)
      !> From the feet of the ends to those of the other wire (2), overlap of end over end
      type(jet_t), intent(in) :: foot(2), corner
      type(jet_t) :: x, rest(2)
      integer :: i

      part = constant(1.0_dp)
      if (.not. (all(foot%value < 0) .and. corner%value > 0)) return
      do i = 1, 2
         x = scale(i)*foot(i)
         rest(i) = fall_of(x*(spot_beyond_ends*corner + x*x)**(-0.5_dp))
      end do
      part = rest(1) + rest(2) - rest(1)*rest(2)
   end function left_by_ends

   !> `(1 + u)^4 (1 - 4 u + 10 u^2)`, from 0 to 1, where its first two derivatives are 0.
   pure type(jet_t) function fall_of(u) result(fall)
      !> Between -1 and 0
      type(jet_t), intent(in) :: u

      associate (v => u%value)
         fall = composed(u, (1 + v)**4*(1 - 4*v + 10*v**2), 60*v**2*(1 + v)**3, 60*v*(1 + v)**2*(2 + 5*v))
      end associate
   end function fall_of

   pure type(jet_t) function at_least_zero(a) result(b)
      type(jet_t), intent(in) :: a

      b = constant(0.0_dp)
      if (a%value > 0) b = a
   end function at_least_zero

   !> 1 where an axis lies along the surface of the other wire, 0 where it runs into it.
   pure type(jet_t) function flatness(tilt)
      !> Sine of the angle
      type(jet_t), intent(in) :: tilt
      real(dp) :: u

      u = max(0.0_dp, min(1.0_dp, (tilt%value - flat_tilt)/(steep_tilt - flat_tilt)))
      flatness = composed(tilt, 1 - u**2*(3 - 2*u), -6*u*(1 - u)/(steep_tilt - flat_tilt), &
         -6*(1 - 2*u)*merge(1.0_dp, 0.0_dp, u > 0 .and. u < 1)/(steep_tilt - flat_tilt)**2)
   end function flatness

end module litz_cut_lens
