!> Current and heat from wires into rigid surfaces that have a potential and a temperature.
!>
!> The conductance per length of a place follows its force per length; what the end of a wire carries has none. The
!> places move with the ends of the parts that touch, and the tangent is that of the sum over them: a conductance may
!> begin there with a step, or grow steeply. A film takes its part of the heat between the nodes.
!> Source: theory section 12.
module litz_surface_flows
   use litz_axis, only: axis_shape, on_axis
   use litz_conduction, only: conducts, passes_to_surface, surface_conducts
   use litz_domain, only: domain_t
   use litz_fields, only: field_potential, field_temperature, motion_slots, potential_slots, temperature_slots, &
      first_slot
   use litz_hertz, only: hertz_ellipse_t
   use litz_kinds, only: dp
   use litz_law_input, only: wire_pair_t
   use litz_rigid_surface, only: rigid_surface_t, surface_distance, distance_row
   use litz_spot_law, only: spot_law_t, contact_spot_t, contact_spot, spot_ok
   use litz_state, only: surface_contact_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t
   use litz_surface_overlap, only: gap_at, surface_overlap_t
   use litz_surface_poses, only: present_surface, element_axis, surface_node
   use litz_surface_swelling, only: swelling_of
   use litz_surface_transfer, only: surface_transfer, n_transfer
   implicit none
   private
   public :: request_flow_slots, add_flows, link_flows, note_flows

   !> What may flow
   integer, parameter :: flowing(2) = [field_potential, field_temperature]
   !> Of each node: potential and temperature
   integer, parameter :: both_slots(2) = [potential_slots(1), temperature_slots(2)]

   !> Equations of the heat of the element in a cell
   integer, parameter :: of_wire(2) = [2, 4]

   !> What moves places: the motions of the nodes, and the temperatures of the element, with which its radius grows
   integer, parameter :: n_moves = 20

   !> Places of a cell through which something flows: current, heat.
   type :: flow_places_t
      !> In the element (n), and conductances (n, 2) [S, W/K]
      real(dp), allocatable :: xi(:), conductance(:, :)
      !> How they change with what moves them (n_moves, n), (n_moves, n, 2)
      real(dp), allocatable :: dxi(:, :), dconductance(:, :, :)
   end type flow_places_t

   !> What flows through a cell, node by node: potential and temperature of both nodes and of the surface.
   type :: cell_flows_t
      real(dp) :: k(n_transfer, n_transfer) = 0, r(n_transfer) = 0, by_motion(n_transfer, n_moves) = 0
      !> Of the current through the contact [W], and its conductance [S]
      real(dp) :: joule_heat = 0, conductance = 0
      !> That the contact gives to the wire, and what of it leaves by the film of the element between its nodes [W]
      real(dp) :: heat = 0, through_film = 0
   end type cell_flows_t

contains

   !> Reference nodes of surfaces have the fields that pass to them.
   pure subroutine request_flow_slots(domain, exists)
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: i, field

      do i = 1, size(domain%model%surfaces)
         do field = field_potential, field_temperature
            if (field == field_temperature .and. .not. domain%loading%solves(field)) cycle
            if (.not. surface_conducts(domain%model, i, field)) cycle
            exists(first_slot(field), domain%model%surfaces(i)%node) = .true.
         end do
      end do
   end subroutine request_flow_slots

   !> The flux of a field passes through a cell that touches.
   pure logical function carries(domain, cell, field)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      !> One of litz_fields
      integer, intent(in) :: field

      carries = cell%force > 0
      if (carries) carries = passes_to_surface(domain%model, cell%pair, field) &
         .and. conducts(domain%model, cell%element, field)
      if (field == field_temperature) carries = carries .and. domain%loading%solves(field)
   end function carries

   !> The cells that carry current or heat.
   pure function carrying(domain, cells) result(list)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      integer, allocatable :: list(:)
      integer :: i

      list = pack([(i, i=1, size(cells))], [(carries(domain, cells(i), field_potential) &
         .or. carries(domain, cells(i), field_temperature), i=1, size(cells))])
   end function carrying

   !> Add currents and heat flows of all cells to the system.
   subroutine add_flows(domain, cells)
      type(domain_t), intent(inout) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      type(cell_flows_t), allocatable :: flows(:)
      integer, allocatable :: list(:), nodes(:, :)
      integer :: i

      allocate (list, source=carrying(domain, cells))
      if (size(list) == 0) return
      nodes = reshape([(nodes_of(domain, cells(list(i))), i=1, size(list))], [3, size(list)])
      allocate (flows(size(list)))
      do i = 1, size(list)
         flows(i) = flows_of_cell(domain, cells(list(i)))
         if (.not. has_temperature(domain, cells(list(i)))) call leave_out(flows(i), [6])
      end do
      call add_rows(potential_slots, 1, merge(2, 1, domain%coupled_step .and. domain%loading%solves(field_temperature)))
      if (domain%loading%solves(field_temperature)) call add_rows(temperature_slots, 2, 2)

   contains

      !> Equations of a field, by all unknowns.
      subroutine add_rows(rows, first, n_unknowns)
         !> Its slots
         integer, intent(in) :: rows(2)
         !> The first of them in a cell, and unknowns of a node that it depends on: the potential, or both
         integer, intent(in) :: first, n_unknowns
         real(dp) :: k(3, 3*n_unknowns, size(flows)), by_motion(3, 18, size(flows)), r(3, size(flows))
         integer :: j

         do j = 1, size(flows)
            if (n_unknowns == 1) k(:, :, j) = flows(j)%k(first::2, 1::2)
            if (n_unknowns == 2) k(:, :, j) = flows(j)%k(first::2, :)
            by_motion(:, :, j) = flows(j)%by_motion(first::2, :18)
            r(:, j) = flows(j)%r(first::2)
         end do
         call domain%add_cells(nodes, rows, merge(potential_slots, both_slots, n_unknowns == 1), k, r)
         call domain%add_cells(nodes, rows, motion_slots, by_motion)
      end subroutine add_rows

   end subroutine add_flows

   !> Nodes of the element and of the surface.
   pure function nodes_of(domain, cell) result(nodes)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      integer :: nodes(3)

      nodes = [domain%model%connectivity(:, cell%element), surface_node(domain, cell)]
   end function nodes_of

   !> The surface of a cell has a temperature.
   pure logical function has_temperature(domain, cell)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell

      has_temperature = surface_conducts(domain%model, domain%model%surface_pairs(cell%pair)%surface, field_temperature)
   end function has_temperature

   !> What flows through a cell at the present iterate.
   pure type(cell_flows_t) function flows_of_cell(domain, cell) result(flows)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      type(flow_places_t) :: places
      real(dp), allocatable :: by_conductance(:, :, :), by_place(:, :)

      call find_places(domain, cell, places)
      flows%conductance = sum(places%conductance(:, 1))
      associate (n => size(places%xi), nodes => nodes_of(domain, cell), value => domain%iterate%value)
         allocate (by_conductance(n_transfer, n, 2), by_place(n_transfer, n))
         call surface_transfer(places%xi, places%conductance, value(potential_slots(1), nodes), &
            value(temperature_slots(1), nodes), flows%k, flows%r, by_conductance, by_place, flows%joule_heat)
      end associate
      flows%by_motion = matmul(by_conductance(:, :, 1), transpose(places%dconductance(:, :, 1))) &
         + matmul(by_conductance(:, :, 2), transpose(places%dconductance(:, :, 2))) &
         + matmul(by_place, transpose(places%dxi))
      flows%k(:, of_wire) = flows%k(:, of_wire) + flows%by_motion(:, 19:)
      if (.not. domain%loading%solves(field_temperature)) call leave_out(flows, [2, 4, 6])
      if (.not. conducts(domain%model, cell%element, field_temperature)) call leave_out(flows, [2, 4])
      flows%heat = -sum(flows%r(of_wire))
      call exchange_with_film(domain, cell%element, flows)
   end function flows_of_cell

   !> Under a film only a part of what enters an element comes to its nodes, as of what is made or stored there.
   pure subroutine exchange_with_film(domain, element, flows)
      type(domain_t), intent(in) :: domain
      !> Index of the element
      integer, intent(in) :: element
      type(cell_flows_t), intent(inout) :: flows
      real(dp) :: share, dshare

      call domain%share_of_nodes(element, share, dshare)
      flows%through_film = (1 - share)*flows%heat
      flows%k(of_wire, :) = share*flows%k(of_wire, :)
      flows%k(of_wire, of_wire) = flows%k(of_wire, of_wire) + dshare*spread(flows%r(of_wire), 2, 2)
      flows%by_motion(of_wire, :) = share*flows%by_motion(of_wire, :)
      flows%r(of_wire) = share*flows%r(of_wire)
   end subroutine exchange_with_film

   !> Equations that do not exist.
   pure subroutine leave_out(flows, equations)
      type(cell_flows_t), intent(inout) :: flows
      !> Of the cell (n)
      integer, intent(in) :: equations(:)

      flows%k(equations, :) = 0
      flows%r(equations) = 0
      flows%by_motion(equations, :) = 0
   end subroutine leave_out

   !> Places of the forces: as the parts that touch grow with the motions, the places and their lengths go with them.
   pure subroutine find_places(domain, cell, places)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      type(flow_places_t), intent(out) :: places
      type(spot_law_t) :: law
      real(dp) :: dlength(n_moves, size(cell%points)), doverlap(n_moves, size(cell%points)), g(2)
      integer :: i, kind

      associate (points => cell%points, interaction => domain%model%interactions( &
         domain%model%surface_pairs(cell%pair)%interaction))
         places%xi = points%xi
         allocate (places%conductance(size(points), 2), places%dconductance(n_moves, size(points), 2), source=0.0_dp)
         allocate (places%dxi(n_moves, size(points)))
         call move_places(domain, cell, places%dxi, dlength, doverlap)
         do kind = 1, size(flowing)
            if (.not. carries(domain, cell, flowing(kind))) cycle
            if (kind == 1) law = interaction%spot
            if (kind == 2) law = interaction%heat%as_spot_law()
            do i = 1, size(points)
               ! what the end of a wire carries is no force per length
               if (points(i)%at_end) cycle
               g = per_length(law, points(i)%normal%force)*points(i)%weight
               places%conductance(i, kind) = g(1)
               places%dconductance(:, i, kind) = g(2)*points(i)%normal%stiffness*doverlap(:, i) + g(1)*dlength(:, i)
            end do
         end do
      end associate
   end subroutine find_places

   !> How places in parts that touch, the lengths for which they stand, and the overlaps there change with what moves
   !> them.
   !> The places of metal that remembers its dents stay where they are.
   pure subroutine move_places(domain, cell, dxi, dlength, doverlap)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      !> (n_moves, n): place, change of length over the length, and overlap
      real(dp), intent(out) :: dxi(:, :), dlength(:, :), doverlap(:, :)
      type(rigid_surface_t) :: surface
      type(wire_axis_t) :: axis
      real(dp) :: ends(n_moves, 2, cell%overlap%n), part, gap, slope, swelling(2)
      integer :: i, k

      surface = present_surface(domain, cell%pair)
      axis = element_axis(domain, cell%element, cell%pair)
      swelling = swelling_of(domain, cell%element)
      do k = 1, cell%overlap%n
         ends(:, 1, k) = change_of_end(surface, axis, swelling, cell%overlap, cell%overlap%first(k))
         ends(:, 2, k) = change_of_end(surface, axis, swelling, cell%overlap, cell%overlap%last(k))
      end do
      dxi = 0
      dlength = 0
      do i = 1, size(cell%points)
         associate (point => cell%points(i), first => cell%overlap%first, last => cell%overlap%last)
            k = count(first(:cell%overlap%n) <= point%xi)
            if (k > 0 .and. point%place == 0) then
               part = (point%xi - first(k))/(last(k) - first(k))
               dxi(:, i) = (1 - part)*ends(:, 1, k) + part*ends(:, 2, k)
               dlength(:, i) = (ends(:, 2, k) - ends(:, 1, k))/(last(k) - first(k))
            end if
            call gap_at(surface, axis%p, axis%radius, point%xi, gap, slope)
            doverlap(:, i) = [-point%row, swelling] - slope*dxi(:, i)
         end associate
      end do
   end subroutine move_places

   !> How an end of a part that touches moves: `dxi = -dg/(dg/dxi)`. The ends of the element stay, and so do places that
   !> divide what touches on both of their sides.
   pure function change_of_end(surface, axis, swelling, overlap, xi) result(change)
      type(rigid_surface_t), intent(in) :: surface
      type(wire_axis_t), intent(in) :: axis
      !> Of the radius by the temperatures of the nodes (2) [m/K]
      real(dp), intent(in) :: swelling(2)
      type(surface_overlap_t), intent(in) :: overlap
      !> The end
      real(dp), intent(in) :: xi
      real(dp) :: change(n_moves), weight(4), w1(4), w2(4), x(3), distance, normal(3), gap, slope

      change = 0
      if (abs(xi) >= 1 .or. count(abs([overlap%first(:overlap%n), overlap%last(:overlap%n)] - xi) <= 0) > 1) return
      call gap_at(surface, axis%p, axis%radius, xi, gap, slope)
      if (.not. abs(slope) > 0) return
      call axis_shape(axis%interpolation, axis%length, xi, weight, w1, w2)
      x = on_axis(weight, axis%x, axis%t)
      call surface_distance(surface, x, distance, normal)
      change = [-distance_row(weight, axis%t, x - surface%centre, normal), swelling]/slope
   end function change_of_end

   !> Conductance per length at a force per length, and its derivative (2) [S/m], [S/N].
   pure function per_length(law, force) result(g)
      type(spot_law_t), intent(in) :: law
      !> [N/m]
      real(dp), intent(in) :: force
      real(dp) :: g(2)
      type(contact_spot_t) :: spot
      integer :: info

      g = 0
      call contact_spot(law, force, wire_pair_t(), hertz_ellipse_t(), spot, info)
      if (info == spot_ok) g = [spot%conductance, spot%dconductance_dforce]
   end function per_length

   !> Pairs of nodes between which the flux of a field can pass.
   pure function link_flows(domain, cells, field) result(pairs)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      !> One of litz_fields
      integer, intent(in) :: field
      integer, allocatable :: pairs(:, :), list(:)
      integer :: i

      list = pack([(i, i=1, size(cells))], [(carries(domain, cells(i), field), i=1, size(cells))])
      pairs = reshape([(domain%model%connectivity(1, cells(list(i))%element), surface_node(domain, cells(list(i))), &
         i=1, size(list))], [2, size(list)])
   end function link_flows

   !> What results show of the flows of a cell that touches. Heat of the current that enters a surface without a
   !> temperature leaves the model there.
   subroutine note_flows(domain, cell, contact)
      type(domain_t), intent(inout) :: domain
      type(surface_cell_t), intent(in) :: cell
      type(surface_contact_t), intent(inout) :: contact
      type(cell_flows_t) :: flows

      if (.not. (carries(domain, cell, field_potential) .or. carries(domain, cell, field_temperature))) return
      flows = flows_of_cell(domain, cell)
      contact%conductance = flows%conductance
      contact%current_of_nodes = flows%r([1, 3])
      contact%current = -flows%r(5)
      contact%joule_heat = flows%joule_heat
      contact%heat = flows%heat
      contact%heat_of_surface = -flows%r(6)
      associate (lost => domain%state%surface_heat(cell%element))
         lost = lost + flows%through_film
      end associate
      if (has_temperature(domain, cell)) return
      associate (outer => domain%state%outer_force(temperature_slots(1), surface_node(domain, cell)))
         outer = outer - contact%heat_of_surface
      end associate
   end subroutine note_flows

end module litz_surface_flows
