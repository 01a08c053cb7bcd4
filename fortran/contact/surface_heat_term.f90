!> Heat of friction on rigid surfaces that enters the wires, and surfaces that have a temperature, in steps over time
!> that solve for temperatures.
!>
!> What friction does there is the matter of the surface term. Source: theory section 13.
module litz_surface_heat_term
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, motion_slots, temperature_slots
   use litz_kinds, only: dp
   use litz_model, only: step_t
   use litz_rubbing, only: rubbing_t, is_abrupt, power_of
   use litz_term, only: term_t
   implicit none
   private
   public :: surface_heat_term_t

   type, extends(term_t) :: surface_heat_term_t
      !> By which the work of an increment is a power [1/s]; 0: time is a scale of loads
      real(dp), private :: rate = 0
      !> Into the elements by their nodes (2, n_elements), and what of it their films take between these (n_elements)
      !> [W]
      real(dp), allocatable, private :: made(:, :), through_film(:)
      !> Into the reference nodes of surfaces (n_nodes) [W]
      real(dp), allocatable, private :: of_surfaces(:)
   contains
      procedure :: apply_load
      procedure :: evaluate
      procedure :: settle
      procedure :: accept
   end type surface_heat_term_t

contains

   subroutine apply_load(self, domain, step, step_time, increment)
      class(surface_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      self%rate = 0
      if (step%transient .and. step%solves(field_temperature)) self%rate = 1/increment
   end subroutine apply_load

   subroutine evaluate(self, domain, error)
      class(surface_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      self%made = reshape(spread(0.0_dp, 1, 2*domain%model%n_elements), [2, domain%model%n_elements])
      self%through_film = spread(0.0_dp, 1, domain%model%n_elements)
      self%of_surfaces = spread(0.0_dp, 1, domain%model%n_nodes)
      if (.not. (self%rate > 0 .and. allocated(domain%surface_rubbing))) return
      do i = 1, size(domain%surface_rubbing)
         associate (this => domain%surface_rubbing(i), xi => domain%surface_rubbing(i)%xi(1))
            associate (made => self%made(:, this%element(1)), nodes => domain%model%connectivity(:, this%element(1)))
               made = made + this%share(1)*[1 - xi, 1 + xi]/2*[power_at(nodes(1), this), power_at(nodes(2), this)]
            end associate
            if (this%node > 0) self%of_surfaces(this%node) = self%of_surfaces(this%node) &
               + this%share(2)*power_at(this%node, this)
         end associate
      end do
      do i = 1, domain%model%n_elements
         if (any(abs(self%made(:, i)) > 0)) call add_element(self, domain, i)
      end do
      associate (leaving => domain%forces%internal(temperature_slots(1), :))
         leaving = leaving - self%of_surfaces
      end associate
      if (.not. domain%coupled_step) return
      do i = 1, size(domain%surface_rubbing)
         call add_tangent(self, domain, domain%surface_rubbing(i))
      end do

   contains

      !> As a node has it [W].
      pure real(dp) function power_at(node, rubbing)
         !> Index of the node
         integer, intent(in) :: node
         type(rubbing_t), intent(in) :: rubbing

         power_at = power_of(rubbing, domain%heat_weights_at(node), 1/self%rate)
      end function power_at

   end subroutine evaluate

   !> How the heat of one cell changes with motions, and with temperatures that the mechanics sees.
   subroutine add_tangent(self, domain, this)
      class(surface_heat_term_t), intent(in) :: self
      type(domain_t), intent(inout) :: domain
      type(rubbing_t), intent(in) :: this
      real(dp) :: share, unused, rows(3), k(3, 18), k_t(3, 3), weights(2)
      integer :: nodes(3), n, i

      call domain%share_of_nodes(this%element(1), share, unused)
      rows(:2) = -share*this%share(1)*[1 - this%xi(1), 1 + this%xi(1)]/2
      rows(3) = merge(-this%share(2), 0.0_dp, this%node > 0)
      nodes = [domain%model%connectivity(:, this%element(1)), this%mover]
      n = merge(3, 2, this%mover > 0)
      do i = 1, n
         weights = domain%heat_weights_at(nodes(i))
         rows(i) = weights(1)*self%rate*rows(i)
      end do
      k = spread(rows, 2, 18)*spread(this%dheat, 1, 3)
      k_t = spread(rows, 2, 3)*spread([this%dheat_dtemperature, 0.0_dp], 1, 3)
      call domain%add_cells(reshape(nodes(:n), [n, 1]), temperature_slots, motion_slots, &
         reshape(k(:n, :6*n), [n, 6*n, 1]))
      call domain%add_cells(reshape(nodes(:n), [n, 1]), temperature_slots, temperature_slots, &
         reshape(k_t(:n, :n), [n, n, 1]))
   end subroutine add_tangent

   !> What enters an element comes to its nodes, but for what its film takes between them.
   subroutine add_element(self, domain, e)
      class(surface_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Index of the element
      integer, intent(in) :: e
      real(dp) :: share, dshare

      call domain%share_of_nodes(e, share, dshare)
      self%through_film(e) = (1 - share)*sum(self%made(:, e))
      associate (nodes => domain%model%connectivity(:, e))
         associate (leaving => domain%forces%internal(temperature_slots(1), :))
            leaving(nodes) = leaving(nodes) - share*self%made(:, e)
         end associate
         if (abs(dshare) > 0) call domain%add_cells(reshape(nodes, [2, 1]), temperature_slots, temperature_slots, &
            reshape(-dshare*spread(self%made(:, e), 2, 2), [2, 2, 1]))
      end associate
   end subroutine add_element

   !> The forces balance, so that friction is known: an increment in which it sets in or ends takes backward Euler.
   subroutine settle(self, domain, has_moved)
      class(surface_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved

      if (.not. (self%rate > 0 .and. domain%heat_weights(2) > 0 .and. allocated(domain%surface_rubbing))) return
      associate (increment => 1/self%rate, rubbing => domain%surface_rubbing)
         if (.not. is_abrupt(domain%processes, rubbing, increment, domain%state%time_increment, &
            domain%fastest_warming(increment))) return
      end associate
      domain%heat_weights = [1, 0]
      has_moved = .true.
   end subroutine settle

   !> What results show; the heat of a surface comes into the model at its node.
   subroutine accept(self, domain)
      class(surface_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      if (.not. allocated(self%made)) return
      domain%state%heat_made = domain%state%heat_made + sum(self%made, 1)
      domain%state%surface_heat = domain%state%surface_heat + self%through_film
      associate (outer => domain%state%outer_force(temperature_slots(1), :))
         outer = outer + self%of_surfaces
      end associate
   end subroutine accept

end module litz_surface_heat_term
