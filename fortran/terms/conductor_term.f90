!> Conduction along the wires.
module litz_conductor_term
   use litz_kinds, only: dp
   use litz_conductor, only: conductor
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: field_potential, motion_slots, potential_slots
   use litz_parallel, only: worth_threads
   use litz_scatter, only: chunk
   use litz_term, only: term_t
   implicit none
   private
   public :: conductor_term_t, new_conductor_term

   type, extends(term_t) :: conductor_term_t
      !> Elements that conduct
      integer, allocatable :: conducting(:)
      !> From the first to the second node [A], and heat [W], of each element (n_elements)
      real(dp), allocatable :: element_current(:), joule_heat(:)
   contains
      procedure :: request_slots
      procedure :: evaluate
      procedure :: link
      procedure :: accept
   end type conductor_term_t

contains

   pure type(conductor_term_t) function new_conductor_term(resistivity) result(conductors)
      !> (n_elements) [ohm m]; 0: does not conduct
      real(dp), intent(in) :: resistivity(:)
      integer :: e

      allocate (conductors%conducting, source=pack([(e, e=1, size(resistivity))], resistivity > 0))
      allocate (conductors%element_current(size(resistivity)), conductors%joule_heat(size(resistivity)), source=0.0_dp)
   end function new_conductor_term

   subroutine request_slots(self, domain, exists)
      class(conductor_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: i

      do i = 1, size(self%conducting)
         exists(potential_slots(1):potential_slots(2), domain%model%connectivity(:, self%conducting(i))) = .true.
      end do
   end subroutine request_slots

   subroutine evaluate(self, domain, error)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :), k_me(:, :, :)
      integer :: first, n, i

      n = min(chunk, size(self%conducting))
      allocate (k(2, 2, n), r(2, n), k_me(2, 12, n))
      do first = 1, size(self%conducting), chunk
         n = min(chunk, size(self%conducting) - first + 1)
         associate (members => self%conducting(first:first + n - 1), model => domain%model)
            !$omp parallel do schedule(static) if (n >= worth_threads)
            do i = 1, n
               call evaluate_element(members(i), k(:, :, i), r(:, i), k_me(:, :, i))
            end do
            !$omp end parallel do
            call domain%add_cells(model%connectivity(:, members), potential_slots, potential_slots, k(:, :, :n), &
               r(:, :n))
            if (any(model%sections(model%element_section(members))%current_length)) call domain%add_cells( &
               model%connectivity(:, members), potential_slots, motion_slots, k_me(:, :, :n))
         end associate
      end do

   contains

      subroutine evaluate_element(e, ke, re, k_me_e)
         !> Element
         integer, intent(in) :: e
         !> Conductances (2, 2) [S], currents that leave the nodes (2) [A], and their derivatives by the motion (2, 12)
         real(dp), intent(out) :: ke(2, 2), re(2), k_me_e(2, 12)
         real(dp) :: k_mu(2, 6), rho, drho

         ! with temperatures as unknowns, the heat term has the derivative by them
         call domain%resistivity(e, rho, drho)
         associate (node => domain%model%connectivity(:, e), elements => domain%elements, iterate => domain%iterate)
            call conductor(iterate%x(:, node), iterate%value(potential_slots(1), node), elements%length(e), &
               elements%area(e), rho, &
               domain%model%sections(domain%model%element_section(e))%current_length, ke, re, k_mu, &
               self%element_current(e), self%joule_heat(e))
         end associate
         k_me_e = 0
         k_me_e(:, 1:3) = k_mu(:, 1:3)
         k_me_e(:, 7:9) = k_mu(:, 4:6)
      end subroutine evaluate_element

   end subroutine evaluate

   subroutine link(self, domain, field, pairs)
      class(conductor_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> Nodes of the elements that conduct (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)

      allocate (pairs(2, merge(size(self%conducting), 0, field == field_potential)))
      if (size(pairs) > 0) pairs = domain%model%connectivity(:, self%conducting)
   end subroutine link

   subroutine accept(self, domain)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      associate (state => domain%state, model => domain%model)
         state%element_current = self%element_current
         state%current_density = self%element_current/model%sections(model%element_section)%area
         state%joule_heat = self%joule_heat
      end associate
   end subroutine accept

end module litz_conductor_term
