!> Checks of the whole model before anything is solved: stiffnesses that cannot be computed with, beams that nothing
!> holds, and conductors without a path to a prescribed potential. The last two would make the equations singular.
module litz_model_checks
   use litz_kinds, only: dp
   use litz_conduction, only: passes_to_surface, surface_conducts
   use litz_fields, only: fields, field_displacement, field_potential, field_of_dof, group_mechanical
   use litz_model, only: model_t, step_t, equation_t, dof_potential, n_nodes_of_deck
   use litz_parts, only: parts_t, find_parts, describe_part, join, find_root
   use litz_rigid_modes, only: add_support, support_row, free_modes, describe_modes
   use litz_text, only: to_text
   implicit none
   private
   public :: finding_t, check_connections, conductors_by_contact

   type :: finding_t
      character(len=:), allocatable :: message
      !> The element it is about
      integer :: element = 0
      !> Code word of a warning; empty: it is an error
      character(len=32) :: kind = ''
   end type finding_t

contains

   subroutine check_connections(model, findings)
      !> Without errors of its own
      type(model_t), intent(in) :: model
      type(finding_t), allocatable, intent(out) :: findings(:)
      character(len=:), allocatable :: by_contact
      integer :: n

      allocate (findings(16))
      n = 0
      call check_stiffnesses(model, findings, n)
      if (n > 0) then
         findings = findings(:n)
         return
      end if
      call check_beams(model, findings, n)
      call check_conductors(model, findings, n, by_contact)
      findings = findings(:n)
   end subroutine check_connections

   pure subroutine add(findings, n, message, element, kind)
      type(finding_t), allocatable, intent(inout) :: findings(:)
      !> Number of findings so far
      integer, intent(inout) :: n
      !> A sentence without a full stop
      character(len=*), intent(in) :: message
      !> Index of the element that it is about
      integer, intent(in) :: element
      !> Code word of a warning; empty: an error
      character(len=*), intent(in) :: kind
      type(finding_t), allocatable :: grown(:)
      integer :: i

      if (n == size(findings)) then
         allocate (grown(2*n))
         do i = 1, n
            call move_alloc(findings(i)%message, grown(i)%message)
            grown(i)%element = findings(i)%element
            grown(i)%kind = findings(i)%kind
         end do
         call move_alloc(grown, findings)
      end if
      n = n + 1
      findings(n)%message = message
      findings(n)%element = element
      findings(n)%kind = kind
   end subroutine add

   !> ` in step 2`, or nothing for the first
   pure function describe_step(step) result(words)
      !> Number of the step
      integer, intent(in) :: step
      character(len=:), allocatable :: words

      words = ''
      if (step > 1) words = ' in step '//to_text(step)
   end function describe_step

   pure function describe_conductor(model, parts, part) result(text)
      type(model_t), intent(in) :: model
      type(parts_t), intent(in) :: parts
      !> Index of the part, or of a rigid surface behind all parts
      integer, intent(in) :: part
      character(len=:), allocatable :: text

      if (part > parts%n) then
         text = 'the rigid surface '//model%surfaces(part - parts%n)%name
         return
      end if
      text = 'the conductor '
      if (parts%set(part) == 0) text = text//'of '
      text = text//describe_part(model, parts, part)
   end function describe_conductor

   !> How many others a warning stands for: a mat may have thousands of wires that only contacts hold.
   pure function describe_others(n_others) result(words)
      !> How many there are besides the one that is named
      integer, intent(in) :: n_others
      character(len=:), allocatable :: words

      words = ''
      if (n_others > 0) words = '; likewise '//to_text(n_others)//' more'
   end function describe_others

   !> What the equations are made of, and the squares in their norms, must be numbers that the program can hold. Judged
   !> by exponents, because the numbers themselves might overflow.
   subroutine check_stiffnesses(model, findings, n)
      type(model_t), intent(in) :: model
      type(finding_t), allocatable, intent(inout) :: findings(:)
      !> Number of findings so far
      integer, intent(inout) :: n
      real(dp), parameter :: largest = 100
      real(dp) :: length, exponents(8)
      integer :: e, first, n_wrong

      n_wrong = 0
      first = 0
      do e = 1, model%n_elements
         associate (section => model%sections(model%element_section(e)), node => model%connectivity(:, e))
            associate (material => model%materials(section%material))
               length = log10(norm2(model%x(:, node(2)) - model%x(:, node(1))))
               exponents = [length, log10(section%stiffness*[section%ga2, section%ga3]) - length, &
                  log10(material%young) + log10([section%area, section%i2, section%i3, section%j]) &
                  + log10(section%stiffness) - length*[1, 3, 3, 1], 0.0_dp]
               if (material%conductivity > 0) exponents(8) = log10(material%conductivity) + log10(section%area) - length
            end associate
         end associate
         if (all(abs(exponents) < largest)) cycle
         if (first == 0) first = e
         n_wrong = n_wrong + 1
      end do
      if (first > 0) call add(findings, n, 'the length, the stiffnesses or the conductance of element '// &
         to_text(model%element_id(first))// &
         ' are too large or too small for this program; check the units of its nodes, section and material'// &
         describe_others(n_wrong - 1), first, '')
   end subroutine check_stiffnesses

   !> Every connected part needs supports against its six rigid motions. Where contacts may hold it, this is a warning.
   subroutine check_beams(model, findings, n)
      type(model_t), intent(in) :: model
      type(finding_t), allocatable, intent(inout) :: findings(:)
      !> Number of findings so far
      integer, intent(inout) :: n
      type(parts_t) :: parts
      real(dp), allocatable :: centre(:, :), length(:), supports(:, :, :)
      logical, allocatable :: included(:), reported(:), in_contact(:)
      real(dp) :: modes(6, 6)
      integer :: step, part, n_free, n_alike, first_alike
      character(len=:), allocatable :: first_message

      allocate (included(model%n_elements), source=.true.)
      call find_parts(model, included, parts, with_bodies=.true.)
      call measure_parts(model, parts, centre, length)
      allocate (in_contact, source=parts_in_contact(model, parts))
      allocate (reported(parts%n), source=.false.)
      do step = 1, size(model%steps)
         if (.not. model%steps(step)%solves(field_displacement)) cycle
         supports = support_matrices(model, model%steps(step), parts, centre, length)
         n_alike = 0
         do part = 1, parts%n
            if (reported(part)) cycle
            call free_modes(supports(:, :, part), n_free, modes)
            if (n_free == 0) cycle
            ! damped, as the warning says
            if (in_contact(part) .and. model%steps(step)%controls%stabilize > 0) cycle
            reported(part) = .true.
            if (in_contact(part)) then
               n_alike = n_alike + 1
               if (n_alike > 1) cycle
               first_alike = part
               first_message = describe_free_part()// &
                  '; only contacts can hold it, or *CONTROLS, PARAMETERS=STABILIZE damp it'
            else
               call add(findings, n, describe_free_part()//'; *BOUNDARY must prevent that', &
                  parts%first_element(part), '')
            end if
         end do
         if (n_alike > 0) call add(findings, n, first_message//describe_others(n_alike - 1), &
            parts%first_element(first_alike), 'held_by_contact')
      end do

   contains

      function describe_free_part() result(words)
         character(len=:), allocatable :: words

         if (n_free == 6) then
            words = 'nothing holds '//describe_part(model, parts, part)//describe_step(step)// &
               ': no displacement or rotation of its nodes is prescribed'
         else
            words = describe_part(model, parts, part)//' can still move'//describe_step(step)//': '// &
               describe_modes(n_free, modes, centre(:, part), length(part))
         end if
      end function describe_free_part

   end subroutine check_beams

   !> Centre of the nodes of each part, and the largest distance from it.
   pure subroutine measure_parts(model, parts, centre, length)
      type(model_t), intent(in) :: model
      type(parts_t), intent(in) :: parts
      !> Centre of the nodes of each part (3, parts) [m]
      real(dp), allocatable, intent(out) :: centre(:, :)
      !> Largest distance of a node from it (parts) [m]
      real(dp), allocatable, intent(out) :: length(:)
      integer, allocatable :: n_nodes(:)
      integer :: node, part

      allocate (centre(3, parts%n), length(parts%n), source=0.0_dp)
      allocate (n_nodes(parts%n), source=0)
      do node = 1, model%n_nodes
         part = parts%of_node(node)
         if (part == 0) cycle
         n_nodes(part) = n_nodes(part) + 1
         centre(:, part) = centre(:, part) + model%x(:, node)
      end do
      do part = 1, parts%n
         centre(:, part) = centre(:, part)/n_nodes(part)
      end do
      do node = 1, model%n_nodes
         part = parts%of_node(node)
         if (part > 0) length(part) = max(length(part), norm2(model%x(:, node) - centre(:, part)))
      end do
   end subroutine measure_parts

   !> The prescribed displacements and rotations of a step as conditions on the rigid motions of each part.
   pure function support_matrices(model, step, parts, centre, length) result(matrices)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      type(parts_t), intent(in) :: parts
      !> Centre of the nodes of each part (3, parts) [m]
      real(dp), intent(in) :: centre(:, :)
      !> Size of each part (parts) [m]
      real(dp), intent(in) :: length(:)
      real(dp), allocatable :: matrices(:, :, :)
      integer :: i, part

      allocate (matrices(6, 6, parts%n), source=0.0_dp)
      do i = 1, size(step%boundary)
         associate (item => step%boundary(i))
            part = parts%of_node(moved_node(model, item%node))
            if (fields(field_of_dof(item%dof))%group /= group_mechanical .or. part == 0) cycle
            call add_support(matrices(:, :, part), row_of(model, item%node, item%dof, centre(:, part), length(part)))
         end associate
      end do
      do i = 1, size(model%equations)
         call add_equation(model, model%equations(i), parts, centre, length, matrices)
      end do
   end function support_matrices

   !> An equation as a condition on each part in it: it is taken to hold it as if the other parts, and nodes of no
   !> element, did not move.
   pure subroutine add_equation(model, equation, parts, centre, length, matrices)
      type(model_t), intent(in) :: model
      type(equation_t), intent(in) :: equation
      type(parts_t), intent(in) :: parts
      !> Centre of the nodes of each part (3, parts) [m], and its size (parts) [m]
      real(dp), intent(in) :: centre(:, :), length(:)
      !> Of supports (6, 6, parts)
      real(dp), intent(inout) :: matrices(:, :, :)
      real(dp) :: c(6)
      integer :: of_term(size(equation%node)), i, k, part

      if (fields(field_of_dof(equation%dof(1)))%group /= group_mechanical) return
      of_term = [(parts%of_node(moved_node(model, equation%node(k))), k=1, size(of_term))]
      do i = 1, size(of_term)
         part = of_term(i)
         if (part == 0 .or. any(of_term(:i - 1) == part)) cycle
         c = 0
         do k = 1, size(of_term)
            if (of_term(k) == part) c = c + equation%coefficient(k)*row_of(model, equation%node(k), equation%dof(k), &
               centre(:, part), length(part))
         end do
         call add_support(matrices(:, :, part), c/maxval(abs(equation%coefficient)))
      end do
   end subroutine add_equation

   !> The node of the deck that a node is, or for whose motions along local axes it stands.
   pure integer function moved_node(model, node)
      type(model_t), intent(in) :: model
      !> Index of the node
      integer, intent(in) :: node

      moved_node = node
      if (node > n_nodes_of_deck(model)) moved_node = model%local_axes(node - n_nodes_of_deck(model))%node
   end function moved_node

   !> A degree of freedom, along local axes where the node stands for motions along these, as `c . (t, L theta)` of its
   !> part.
   pure function row_of(model, node, dof, centre, length) result(c)
      type(model_t), intent(in) :: model
      !> Index of the node, and its degree of freedom in Abaqus's numbers
      integer, intent(in) :: node, dof
      !> Centre of the part (3), and its size [m]
      real(dp), intent(in) :: centre(3), length
      real(dp) :: c(6), arm(3)
      integer :: first, i

      arm = (model%x(:, node) - centre)/length
      if (node <= n_nodes_of_deck(model)) then
         c = support_row(dof, arm)
         return
      end if
      first = merge(1, 4, dof < 4)
      c = 0
      associate (axis => model%local_axes(node - n_nodes_of_deck(model))%axes(:, dof - first + 1))
         do i = 1, 3
            c = c + axis(i)*support_row(first + i - 1, arm)
         end do
      end associate
   end function row_of

   !> Conductors that equations join to one that is held, or to a node of no element, are held.
   pure subroutine hold_by_equations(model, parts, held)
      type(model_t), intent(in) :: model
      type(parts_t), intent(in) :: parts
      !> A potential of the part is prescribed (parts)
      logical, intent(inout) :: held(:)
      logical :: has_changed
      integer :: i

      has_changed = .true.
      do while (has_changed)
         has_changed = .false.
         do i = 1, size(model%equations)
            associate (equation => model%equations(i))
               if (equation%dof(1) /= dof_potential) cycle
               associate (joined => parts%of_node(equation%node))
                  if (.not. (any(joined == 0) .or. any(held(pack(joined, joined > 0))))) cycle
                  has_changed = has_changed .or. .not. all(held(pack(joined, joined > 0)))
                  held(pack(joined, joined > 0)) = .true.
               end associate
            end associate
         end do
      end do
   end subroutine hold_by_equations

   !> Parts with an element in some contact pair.
   pure function parts_in_contact(model, parts) result(in_contact)
      type(model_t), intent(in) :: model
      type(parts_t), intent(in) :: parts
      logical :: in_contact(parts%n)
      integer :: i

      in_contact = .false.
      do i = 1, size(model%contact_pairs)
         call mark(model%element_sets(model%contact_pairs(i)%set_bar)%members)
         call mark(model%element_sets(model%contact_pairs(i)%set)%members)
      end do
      do i = 1, size(model%surface_pairs)
         call mark(model%element_sets(model%surface_pairs(i)%set)%members)
      end do

   contains

      pure subroutine mark(members)
         !> Indices of the elements of a set (n)
         integer, intent(in) :: members(:)

         in_contact(parts%of_element(members)) = .true.
      end subroutine mark

   end function parts_in_contact

   !> The conductors whose potential only contacts can give, as in any network of wires: a line, or nothing.
   function conductors_by_contact(model) result(line)
      !> Without errors of its own
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: line
      type(finding_t), allocatable :: findings(:)
      integer :: n

      allocate (findings(16))
      n = 0
      call check_conductors(model, findings, n, line)
      if (len(line) > 0) line = line//new_line('a')
   end function conductors_by_contact

   !> Every connected conductor needs a prescribed potential, or contacts that may lead to one. Rigid surfaces to which
   !> current passes stand behind the parts.
   subroutine check_conductors(model, findings, n, by_contact)
      type(model_t), intent(in) :: model
      type(finding_t), allocatable, intent(inout) :: findings(:)
      !> Number of findings so far
      integer, intent(inout) :: n
      !> Those that contacts may lead to one, in words; empty: none
      character(len=:), allocatable, intent(out) :: by_contact
      type(parts_t) :: parts
      logical, allocatable :: included(:), reported(:), held(:), group_held(:)
      integer, allocatable :: group(:)
      integer :: e, step, part, i, n_alike, first_alike, n_all

      by_contact = ''
      allocate (included(model%n_elements))
      do e = 1, model%n_elements
         included(e) = model%materials(model%sections(model%element_section(e))%material)%conductivity > 0
      end do
      call find_parts(model, included, parts)
      allocate (group, source=groups_by_contact(model, parts))
      n_all = size(group)
      allocate (reported(n_all), source=.false.)
      reported(parts%n + 1:) = [(.not. surface_conducts(model, i, field_potential), i=1, size(model%surfaces))]
      do step = 1, size(model%steps)
         allocate (held(n_all), group_held(n_all), source=.false.)
         associate (boundary => model%steps(step)%boundary)
            do i = 1, size(boundary)
               part = parts%of_node(boundary(i)%node)
               if (boundary(i)%dof /= dof_potential) cycle
               if (part > 0) held(part) = .true.
               held(parts%n + 1:) = held(parts%n + 1:) .or. model%surfaces%node == boundary(i)%node
            end do
         end associate
         call hold_by_equations(model, parts, held)
         do part = 1, n_all
            if (held(part)) group_held(group(part)) = .true.
         end do
         n_alike = 0
         do part = 1, n_all
            if (held(part) .or. reported(part)) cycle
            if (group_held(group(part))) then
               n_alike = n_alike + 1
               if (n_alike == 1) first_alike = part
               reported(part) = .true.
            else
               call add(findings, n, describe_conductor(model, parts, part)// &
                  ' has no path to a prescribed potential'//describe_step(step)// &
                  describe_others(count(group == group(part) .and. .not. reported) - 1)// &
                  ': prescribe degree of freedom '//to_text(dof_potential)//' at one of its nodes, or leave out '// &
                  '*ELECTRICAL CONDUCTIVITY where no current is to flow', parts%first_element(part), '')
               reported = reported .or. group == group(part)
            end if
         end do
         if (n_alike > 0 .and. len(by_contact) == 0) by_contact = describe_conductor(model, parts, first_alike)// &
            ' has no prescribed potential'//describe_step(step)//'; only contacts can connect it to one'// &
            describe_others(n_alike - 1)
         deallocate (held, group_held)
      end do
   end subroutine check_conductors

   !> Parts that contacts with a spot law may join carry the same number, and rigid surfaces behind them.
   function groups_by_contact(model, parts) result(group)
      type(model_t), intent(in) :: model
      type(parts_t), intent(in) :: parts
      integer :: group(parts%n + size(model%surfaces))
      integer :: i, part, anchor

      group = [(part, part=1, size(group))]
      do i = 1, size(model%contact_pairs)
         associate (pair => model%contact_pairs(i))
            if (.not. model%interactions(pair%interaction)%spot%exists()) cycle
            anchor = 0
            call join_members(model%element_sets(pair%set_bar)%members)
            call join_members(model%element_sets(pair%set)%members)
         end associate
      end do
      do i = 1, size(model%surface_pairs)
         associate (pair => model%surface_pairs(i))
            if (.not. passes_to_surface(model, i, field_potential)) cycle
            anchor = parts%n + pair%surface
            if (parts%of_node(model%surfaces(pair%surface)%node) > 0) call join(group, anchor, &
               parts%of_node(model%surfaces(pair%surface)%node))
            call join_members(model%element_sets(pair%set)%members)
         end associate
      end do
      do part = 1, size(group)
         group(part) = find_root(group, part)
      end do

   contains

      subroutine join_members(members)
         !> Indices of the elements of a set (n)
         integer, intent(in) :: members(:)
         integer :: k, this

         do k = 1, size(members)
            this = parts%of_element(members(k))
            if (this == 0) cycle
            if (anchor == 0) anchor = this
            call join(group, anchor, this)
         end do
      end subroutine join_members

   end function groups_by_contact

end module litz_model_checks
