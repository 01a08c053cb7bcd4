!> Friction of the cells of rigid surfaces in a run: from the state of the model to the forces of a cell.
!>
!> Cells of one zone of contact hand it on to each other where it slides along the wire. Source: theory section 12.
module litz_surface_rubbing
   use litz_kinds, only: dp
   use litz_conduction, only: surface_conducts
   use litz_domain, only: domain_t
   use litz_element_library, only: material_at
   use litz_fields, only: field_temperature, motion_slots
   use litz_rigid_surface, only: rigid_surface_t
   use litz_rubbing, only: rubbing_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t
   use litz_surface_friction, only: surface_slip_t, surface_slip, sticking_t, rub_cell, stick_stiffness_of, &
      place_friction
   use litz_surface_overlap, only: gap_at
   use litz_surface_swelling, only: force_by_radius, swelling_of
   use litz_surface_poses, only: present_surface, surface_at_start, element_axis, axis_moved_by, surface_node, &
      surface_turn
   use litz_wires, only: arc_from_to
   implicit none
   private
   public :: touched_t, sticking_of, rub, find_friction_work, rubbing_of_cells, rubbing_turn

   !> A cell that touched when the increment began.
   type :: touched_t
      integer :: element = 0, pair = 0
   end type touched_t

contains

   !> How the contact of a cell sticks and slips.
   pure type(sticking_t) function sticking_of(domain, cell) result(sticking)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell

      associate (model => domain%model)
         associate (this => model%interactions(model%surface_pairs(cell%pair)%interaction), &
            there => material_at(model, domain%elements, cell%element, cell%overlap%nearest))
            sticking = sticking_t(this%friction, this%stick_law, this%stick_value, there%young, there%poisson)
         end associate
      end associate
   end function sticking_of

   !> Add the friction of a cell that touches.
   subroutine rub(domain, touched, cell, k, r)
      type(domain_t), intent(inout) :: domain
      type(touched_t), intent(in) :: touched(:)
      type(surface_cell_t), intent(inout) :: cell
      !> Tangent (18, 18), and residual (18)
      real(dp), intent(inout) :: k(:, :), r(:)
      type(surface_slip_t) :: slip
      real(dp) :: difference(18)

      associate (model => domain%model)
         associate (interaction => model%interactions(model%surface_pairs(cell%pair)%interaction))
            if (.not. interaction%friction > 0) return
            if (cell%has_place) then
               slip = slip_at(domain, cell)
            else
               call close_cell(domain, touched, cell, slip)
            end if
            call rub_cell(sticking_of(domain, cell), slip, cell, k, r, difference)
            call add_difference(model%connectivity(1, cell%element), difference(1:6))
            call add_difference(model%connectivity(2, cell%element), difference(7:12))
            if (surface_node(domain, cell) > 0) call add_difference(surface_node(domain, cell), difference(13:18))
         end associate
      end associate
      call domain%take_friction()

   contains

      subroutine add_difference(node, values)
         !> Of a cell
         integer, intent(in) :: node
         !> Forces and moments on it (6) [N, N m]
         real(dp), intent(in) :: values(6)

         associate (iteration => domain%forces%iteration(motion_slots(1):motion_slots(2), node))
            iteration = iteration + values
         end associate
      end subroutine add_difference

   end subroutine rub

   !> Where a cell that has closed rubs, and its slip.
   subroutine close_cell(domain, touched, cell, slip)
      type(domain_t), intent(in) :: domain
      type(touched_t), intent(in) :: touched(:)
      type(surface_cell_t), intent(inout) :: cell
      type(surface_slip_t), intent(out) :: slip
      type(rigid_surface_t) :: before

      associate (x => domain%iterate%x_start, rotation => domain%state%rotation)
         before = surface_at_start(domain, cell%pair)
         call place_friction(before, axis_moved_by(domain, cell%element, cell%pair, x, rotation), &
            present_surface(domain, cell%pair), element_axis(domain, cell%element, cell%pair), cell)
      end associate
      cell%stick_stiffness = stick_stiffness_of(sticking_of(domain, cell), cell)
      slip = slip_at(domain, cell)
      call take_over(domain, touched, before, slip%slip(1), cell)
   end subroutine close_cell

   !> Slip of the place of a cell since the increment began.
   pure type(surface_slip_t) function slip_at(domain, cell) result(slip)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cell
      real(dp) :: turned(3, 3, 2)
      integer :: side

      associate (start => domain%state%rotation, x_start => domain%iterate%x_start)
         do side = 1, 2
            associate (node => domain%model%connectivity(side, cell%element))
               turned(:, :, side) = matmul(domain%iterate%rotation(:, :, node), transpose(start(:, :, node)))
            end associate
         end do
         slip = surface_slip(surface_at_start(domain, cell%pair), &
            axis_moved_by(domain, cell%element, cell%pair, x_start, start), present_surface(domain, cell%pair), &
            element_axis(domain, cell%element, cell%pair), turned, cell%xi)
      end associate
   end function slip_at

   !> A contact that slides along a wire goes from cell to cell. Where the place of the wire that was where this cell is
   !> now touched when the increment began, all of the slip counts.
   pure subroutine take_over(domain, touched, surface, slip, cell)
      type(domain_t), intent(in) :: domain
      type(touched_t), intent(in) :: touched(:)
      !> When the increment began
      type(rigid_surface_t), intent(in) :: surface
      !> Of the surface of the wire along it, in the direction of the element [m]
      real(dp), intent(in) :: slip
      type(surface_cell_t), intent(inout) :: cell
      type(wire_axis_t) :: axis
      real(dp) :: arc, to_middle, gap, unused_slope
      integer :: i

      associate (wires => domain%wires, length => domain%elements%length)
         arc = wires%arc(cell%element) + wires%direction(cell%element)*(cell%xi*length(cell%element)/2 + slip)
         do i = 1, size(touched)
            associate (e => touched(i)%element)
               if (touched(i)%pair /= cell%pair .or. wires%wire(e) /= wires%wire(cell%element)) cycle
               to_middle = arc_from_to(wires%arc(e), arc, wires%circumference(wires%wire(e)))
               if (abs(to_middle) > length(e)/2) cycle
               axis = axis_moved_by(domain, e, cell%pair, domain%iterate%x_start, domain%state%rotation)
               call gap_at(surface, axis%p, axis%radius, 2*wires%direction(e)*to_middle/length(e), gap, unused_slope)
               if (gap < 0) cell%part = 1
               return
            end associate
         end do
      end associate
   end subroutine take_over

   !> The largest turn in this increment of a surface with friction that touches [rad].
   pure real(dp) function rubbing_turn(domain, cells) result(turn)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      integer :: i

      turn = 0
      do i = 1, size(cells)
         associate (pair => domain%model%surface_pairs(cells(i)%pair))
            if (.not. cells(i)%force > 0 .or. .not. domain%model%interactions(pair%interaction)%friction > 0) cycle
            turn = max(turn, surface_turn(domain, pair%surface))
         end associate
      end do
   end function rubbing_turn

   !> What friction has done to a cell in this increment. A cell that opens in it has rubbed while its traction fell to
   !> nothing; what it held elastically is lost.
   pure subroutine find_friction_work(domain, cell)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(inout) :: cell
      type(surface_slip_t) :: slip

      cell%friction_work = cell%friction%dissipation
      if (.not. cell%has_place .or. cell%force > 0) return
      associate (start => cell%memory%start)
         cell%friction_work = start%elastic_energy
         if (.not. norm2(start%traction) > 0) return
         slip = slip_at(domain, cell)
         cell%friction_work = max(0.0_dp, start%elastic_energy + dot_product(start%traction, slip%slip)/2)
         if (cell%friction_work > 0) cell%dfriction_work = matmul(start%traction, slip%row)/2
      end associate
   end subroutine find_friction_work

   !> Cells that give heat of friction to wires which conduct heat.
   pure function rubbing_of_cells(domain, cells) result(rubbing)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(in) :: cells(:)
      type(rubbing_t), allocatable :: rubbing(:)
      integer :: i, n

      allocate (rubbing(count(cells%friction_work + cells%memory%last_dissipation > 0)))
      n = 0
      do i = 1, size(cells)
         associate (cell => cells(i), model => domain%model)
            if (.not. cell%friction_work + cell%memory%last_dissipation > 0) cycle
            if (.not. allocated(model%materials(model%sections(model%element_section(cell%element))%material) &
               %heat_conductivity)) cycle
            n = n + 1
            associate (law => model%interactions(model%surface_pairs(cell%pair)%interaction)%heat)
               rubbing(n) = rubbing_t(element=[cell%element, 0], xi=[cell%xi, 0.0_dp], &
                  share=[law%surface_share, 1 - law%surface_share], heat=law%friction_fraction*cell%friction_work, &
                  heat_before=law%friction_fraction*cell%memory%last_dissipation, &
                  dheat=law%friction_fraction*cell%dfriction_work)
               rubbing(n)%dheat_dtemperature = law%friction_fraction*cell%friction%ddissipation_dforce &
                  *force_by_radius(cell)*swelling_of(domain, cell%element)
            end associate
            rubbing(n)%capacity(1) = domain%least_capacity(cell%element)
            rubbing(n)%mover = surface_node(domain, cell)
            if (.not. surface_conducts(model, model%surface_pairs(cell%pair)%surface, field_temperature)) cycle
            rubbing(n)%node = surface_node(domain, cell)
         end associate
      end do
      rubbing = rubbing(:n)
   end function rubbing_of_cells

end module litz_surface_rubbing
