!> The contact element as other finite-element programs want it: four nodes with seven unknowns each, node by node.
!>
!> Nodes: barred 1, barred 2, 1, 2. Unknowns of a node: displacements, rotations, voltage (`ux uy uz phix phiy phiz v`).
!> The wires are straight between their nodes before they are loaded. `abaqus_uel.f90` and `feap_elmt.f90` are made of
!> it.
module litz_user_element
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp, pi
   use litz_contact_em, only: contact_em, contact_em_t, contact_laws_t, contact_active, contact_open, &
      contact_beyond, contact_parallel, contact_not_unique, contact_not_converged, contact_unknown_law, &
      contact_bad_data, contact_compacts
   use litz_axis_choices, only: axis_linear, axis_hermite
   use litz_law_input, only: wire_pair_t
   use litz_law_words, only: law_words_t
   use litz_normal_laws, only: normal_law
   use litz_rotations, only: rotation_exp
   use litz_spot_laws, only: spot_law
   implicit none
   private
   public :: user_contact, check_user_contact, user_contact_failure, words_length
   public :: n_unknowns, n_history, n_properties, n_options
   public :: option_normal_law, option_spot_law, option_axis, option_voltage, option_rotations
   public :: history_side, history_gap, history_force, history_resistance, history_current, history_energy
   ! what `info` may be
   public :: contact_active, contact_open, contact_beyond, contact_parallel, contact_not_unique, &
      contact_not_converged, contact_unknown_law, contact_bad_data, contact_compacts

   integer, parameter :: n_unknowns = 28
   !> Numbers that are kept for each element. The side must be that of the last converged state; the others are
   !> results: gap [m], force [N], resistance of the spot [ohm], current from the barred to the unbarred wire [A],
   !> elastic energy [J]
   integer, parameter :: n_history = 6, history_side = 1, history_gap = 2, history_force = 3, history_resistance = 4, &
      history_current = 5, history_energy = 6
   !> Properties, each of the barred and the unbarred wire: radius [m], Young's modulus [Pa], Poisson's ratio [-],
   !> resistivity [ohm m]; then the penalty [N/m] and the number of the spot law (PLASTIC: hardness [Pa], FILM: film
   !> resistivity [ohm m^2], CONSTANT: resistance [ohm]). Pairs of force [N] and resistance [ohm] of TABLE may follow.
   integer, parameter :: n_properties = 10
   !> Options: normal law, spot law and axis by their numbers in litz_normal_laws, litz_spot_laws and litz_axis_choices;
   !> voltage 0 linear, 1 corrected; rotations 0 spins (the program multiplies rotations), 1 additive (it adds the
   !> components of rotation vectors)
   integer, parameter :: n_options = 5, option_normal_law = 1, option_spot_law = 2, option_axis = 3, &
      option_voltage = 4, option_rotations = 5

   !> Length of what `check_user_contact` and `user_contact_failure` say
   integer, parameter :: words_length = 100

   !> Places of the unknowns of each node among those of `contact_em`
   integer, parameter :: place(7, 4) = reshape([ &
      1, 2, 3, 4, 5, 6, 25, &
      7, 8, 9, 10, 11, 12, 26, &
      13, 14, 15, 16, 17, 18, 27, &
      19, 20, 21, 22, 23, 24, 28], [7, 4])

contains

   !> Tangent and residual of one pair of elements.
   pure subroutine user_contact(coordinates, u, properties, options, history, k, r, info)
      !> Positions of the nodes before loading (3, 4) [m]
      real(dp), intent(in) :: coordinates(3, 4)
      !> Displacements [m], rotation vectors [rad] and voltages [V] (7, 4), all of them totals
      real(dp), intent(in) :: u(7, 4)
      !> Properties (`n_properties` and more)
      real(dp), intent(in) :: properties(:)
      !> Options (`n_options`)
      integer, intent(in) :: options(:)
      !> History (`n_history`): in, that of the last converged state (zeros at the start); out, the present one
      real(dp), intent(inout) :: history(:)
      !> Tangent (28, 28) and residual (28), internal minus external: forces [N], moments [N m], currents leaving [A]
      real(dp), intent(out) :: k(28, 28), r(28)
      !> `contact_active`, `contact_open` or `contact_beyond`; what is negative is a failure, and `k` and `r` are zero
      integer, intent(out) :: info
      real(dp) :: x(3, 4), t(3, 4), length(2), k_paper(28, 28), r_paper(28)
      type(wire_pair_t) :: wires
      type(contact_laws_t) :: laws
      type(contact_em_t) :: contact
      integer :: order(28), side

      call present_shape(coordinates, u, x, t, length)
      wires = wires_of(properties, options, length)
      call set_laws(properties, options, laws)
      side = nint(history(history_side))
      if (options(option_rotations) == 0) then
         call contact_em(x, t, length, u(7, :), wires, laws, side, k_paper, r_paper, contact, info)
      else
         call contact_em(x, t, length, u(7, :), wires, laws, side, k_paper, r_paper, contact, info, u(4:6, :))
      end if
      order = reshape(place, [28])
      k = k_paper(order, order)
      r = r_paper(order)
      history(:n_history) = 0
      history(history_gap) = contact%gap
      if (info /= contact_active) return
      history(history_side) = contact%side
      history(history_force) = contact%force
      history(history_resistance) = contact%resistance
      history(history_current) = contact%current
      history(history_energy) = contact%energy
   end subroutine user_contact

   !> What is wrong with the input of an element, for the host to say; blank: nothing.
   !>
   !> Hosts fill what is missing with zeros, so that values are checked.
   pure function check_user_contact(coordinates, properties, options) result(words)
      !> Positions of the nodes before loading (3, 4) [m]
      real(dp), intent(in) :: coordinates(3, 4)
      !> Properties (`n_properties` and more)
      real(dp), intent(in) :: properties(:)
      !> Options (`n_options`)
      integer, intent(in) :: options(:)
      character(len=words_length) :: words

      words = ''
      if (size(properties) < n_properties) then
         words = 'fewer than 10 real properties: radii, moduli, ratios, resistivities, penalty, datum of the spot'
      else if (size(options) < n_options) then
         words = 'fewer than 5 options: normal law, spot law, axis, voltage, rotations'
      else if (.not. all(is_positive(properties(1:2)))) then
         words = 'properties 1 and 2, the radii of the barred and the unbarred wire, must be greater than 0'
      else if (.not. all(is_positive(properties(3:4)))) then
         words = 'properties 3 and 4, the Young''s moduli of the wires, must be greater than 0'
      else if (.not. all(is_positive(properties(5:6) + 1) .and. is_positive(0.5_dp - properties(5:6)))) then
         words = 'properties 5 and 6, the Poisson''s ratios of the wires, must be between -1 and 0.5'
      else if (.not. all(is_positive(properties(7:8)))) then
         words = 'properties 7 and 8, the resistivities of the wires, must be greater than 0'
      else
         words = check_laws(properties, options)
         if (words == '') words = check_choices(options)
         if (words == '' .and. .not. is_positive(norm2(coordinates(:, 2) - coordinates(:, 1)))) then
           words = 'nodes 1 and 2, those of the barred wire, coincide'
         end if
         if (words == '' .and. .not. is_positive(norm2(coordinates(:, 4) - coordinates(:, 3)))) then
           words = 'nodes 3 and 4, those of the unbarred wire, coincide'
         end if
      end if
   end function check_user_contact

   pure function check_laws(properties, options) result(words)
      !> Properties (`n_properties` and more)
      real(dp), intent(in) :: properties(:)
      !> Options (`n_options`)
      integer, intent(in) :: options(:)
      character(len=words_length) :: words
      type(contact_laws_t) :: laws
      type(law_words_t) :: normal, spot

      words = ''
      laws%normal = normal_law(options(option_normal_law))
      laws%spot = spot_law(options(option_spot_law))
      normal = laws%normal%law_words_t
      spot = laws%spot%law_words_t
      if (.not. normal%exists()) then
         words = 'option 1, the normal law, must be 1 (LINEAR) or 2 (HERTZ)'
      else if (normal%n_fields() > 0 .and. .not. is_positive(properties(9))) then
         words = 'property 9, the penalty of the normal law LINEAR, must be greater than 0'
      else if (options(option_spot_law) /= 0 .and. .not. spot%exists()) then
         words = 'option 2, the spot law, must be 0 (no current) or the number of a spot law'
      else if (spot%has_table) then
         words = check_table(properties(n_properties + 1:))
      else
         associate (needed => spot%n_needed())
            if (size(properties) < n_properties - 1 + needed) then
               words = 'properties 10, ..., the numbers of the spot law '//trim(spot%name)//', are missing'
            else if (.not. all(is_positive(properties(10:9 + needed)))) then
               words = 'properties 10, ..., the numbers of the spot law '//trim(spot%name)//', must be greater than 0'
            end if
         end associate
      end if
   end function check_laws

   pure function check_table(pairs) result(words)
      !> Forces [N] and resistances [ohm] in turn (n)
      real(dp), intent(in) :: pairs(:)
      character(len=words_length) :: words
      integer :: n

      n = size(pairs)/2
      words = ''
      if (n == 0 .or. size(pairs) /= 2*n) then
         words = 'properties 11, 12, ... must be pairs of force and resistance of the spot law TABLE, at least one'
      else if (.not. all(is_positive(pairs))) then
         words = 'properties 11, 12, ..., forces and resistances of the spot law TABLE, must be greater than 0'
      else if (any(pairs(3::2) <= pairs(1:2*n - 2:2))) then
         words = 'properties 11, 13, ..., the forces of the spot law TABLE, must ascend'
      end if
   end function check_table

   pure function check_choices(options) result(words)
      !> Options (`n_options`)
      integer, intent(in) :: options(:)
      character(len=words_length) :: words

      words = ''
      if (all(options(option_axis) /= [axis_linear, axis_hermite])) then
         words = 'option 3, the axis, must be 1 (linear) or 2 (Hermite)'
      else if (all(options(option_voltage) /= [0, 1])) then
         words = 'option 4, the voltage, must be 0 (linear) or 1 (corrected)'
      else if (all(options(option_rotations) /= [0, 1])) then
         words = 'option 5, the rotations, must be 0 (spins) or 1 (additive)'
      end if
   end function check_choices

   !> Greater than zero, and neither infinite nor no number.
   pure elemental logical function is_positive(value)
      !> Any
      real(dp), intent(in) :: value

      is_positive = .false.
      if (ieee_is_finite(value)) is_positive = value > 0
   end function is_positive

   !> What a negative `info` of `user_contact` means.
   pure function user_contact_failure(info) result(words)
      !> One of the constants
      integer, intent(in) :: info
      character(len=words_length) :: words

      select case (info)
      case (contact_parallel)
         words = 'the wires overlap where their axes are parallel (crossing angle below 0.06 degrees)'
      case (contact_not_unique)
         words = 'the wires overlap, but their closest points are not unique'
      case (contact_not_converged)
         words = 'the closest points were not found: nodes that coincide, or unknowns that are no numbers'
      case (contact_unknown_law)
         words = 'there is no law with the number of option 1 or option 2'
      case (contact_bad_data)
         words = 'a length, radius, modulus or resistivity is not positive, or the forces of a TABLE do not ascend'
      case (contact_compacts)
         words = 'the spot of wires that yield is too large for their thickness'
      case default
         words = ''
      end select
   end function user_contact_failure

   !> Positions and unit tangents of the nodes as they are now, and lengths as they were.
   pure subroutine present_shape(coordinates, u, x, t, length)
      !> Positions of the nodes before loading (3, 4) [m]
      real(dp), intent(in) :: coordinates(3, 4)
      !> Displacements [m], rotation vectors [rad] and voltages [V] (7, 4), all of them totals
      real(dp), intent(in) :: u(7, 4)
      !> Present positions of the nodes (3, 4) [m]
      real(dp), intent(out) :: x(3, 4)
      !> Present unit tangents of the nodes (3, 4)
      real(dp), intent(out) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(out) :: length(2)
      real(dp) :: chord(3)
      integer :: node, beam

      x = coordinates + u(1:3, :)
      do node = 1, 4
         beam = (node + 1)/2
         chord = coordinates(:, 2*beam) - coordinates(:, 2*beam - 1)
         length(beam) = norm2(chord)
         t(:, node) = matmul(rotation_exp(u(4:6, node)), chord/length(beam))
      end do
   end subroutine present_shape

   !> The wires of the pair; their voltages are corrected where the options ask for it (theory section 7).
   pure type(wire_pair_t) function wires_of(properties, options, length) result(wires)
      !> Properties (`n_properties` and more)
      real(dp), intent(in) :: properties(:)
      !> Options (`n_options`)
      integer, intent(in) :: options(:)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)

      wires%radius = properties(1:2)
      wires%young = properties(3:4)
      wires%poisson = properties(5:6)
      wires%resistivity = properties(7:8)
      if (options(option_voltage) == 1) wires%series_resistance = wires%resistivity*length/(4*pi*wires%radius**2)
   end function wires_of

   !> The laws of the contact.
   pure subroutine set_laws(properties, options, laws)
      !> Properties (`n_properties` and more)
      real(dp), intent(in) :: properties(:)
      !> Options (`n_options`)
      integer, intent(in) :: options(:)
      type(contact_laws_t), intent(out) :: laws

      laws%axis = options(option_axis)
      laws%normal = normal_law(options(option_normal_law), properties(9:9))
      laws%spot = spot_law(options(option_spot_law))
      call laws%spot%take(properties(merge(n_properties + 1, n_properties, laws%spot%has_table):))
   end subroutine set_laws

end module litz_user_element
