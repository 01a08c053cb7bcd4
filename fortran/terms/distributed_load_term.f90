!> *DLOAD: forces per length along global axes, along section axes, and weight. Source: theory section 16.
module litz_distributed_load_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_element_loads, only: element_load_t, load_px, load_pz, load_p1, load_p2, load_grav
   use litz_end_forces, only: nodal_state
   use litz_errors, only: error_t
   use litz_fields, only: motion_slots
   use litz_line_forces, only: distributed_force
   use litz_loaded_elements, only: loaded_elements_t, load_axis
   use litz_loading, only: element_loads_at
   use litz_model, only: step_t
   use litz_parallel, only: worth_threads
   use litz_scatter, only: chunk
   implicit none
   private
   public :: distributed_load_term_t, new_distributed_load_term

   type, extends(loaded_elements_t) :: distributed_load_term_t
      !> Force per reference length along global axes (3, n), and along section axes (2, n) [N/m]: at the end of the
      !> increment, and when it began
      real(dp), allocatable :: fixed(:, :), turning(:, :), start_fixed(:, :), start_turning(:, :)
   contains
      procedure :: apply_load
      procedure :: start
      procedure :: evaluate
   end type distributed_load_term_t

contains

   pure type(distributed_load_term_t) function new_distributed_load_term() result(term)
      allocate (term%members(0), term%start_force(12, 0), term%force(12, 0), term%fixed(3, 0), term%turning(2, 0), &
         term%start_fixed(3, 0), term%start_turning(2, 0))
   end function new_distributed_load_term

   subroutine apply_load(self, domain, step, step_time, increment)
      class(distributed_load_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      call self%take_loaded(step%element_loads, load_px, load_grav, domain%model%n_elements)
      associate (state => domain%state, n => size(self%members))
         self%fixed = spread([0.0_dp, 0.0_dp, 0.0_dp], 2, n)
         self%turning = self%fixed(:2, :)
         self%start_fixed = self%fixed
         self%start_turning = self%turning
         if (n == 0) return
         call collect(self, domain, element_loads_at(domain%model, step, step_time, state%time - state%step_time), &
            self%fixed, self%turning)
         call collect(self, domain, element_loads_at(domain%model, step, state%step_time, &
            state%time - state%step_time), self%start_fixed, self%start_turning)
      end associate
   end subroutine apply_load

   !> Sum up what acts on each element.
   subroutine collect(self, domain, loads, fixed, turning)
      class(distributed_load_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(element_load_t), intent(in) :: loads(:)
      !> As in the term (3, n), (2, n) [N/m]; zero before
      real(dp), intent(inout) :: fixed(:, :), turning(:, :)
      integer :: place(domain%model%n_elements), i

      place(self%members) = [(i, i=1, size(self%members))]
      do i = 1, size(loads)
         associate (load => loads(i), e => loads(i)%element)
            select case (load%kind)
            case (load_px:load_pz)
               associate (f => fixed(load%kind - load_px + 1, place(e)))
                  f = f + load%value(1)
               end associate
            case (load_p1:load_p2)
               associate (p => turning(load%kind - load_p1 + 1, place(e)))
                  p = p + load%value(1)
               end associate
            case (load_grav)
               associate (section => domain%model%sections(domain%model%element_section(e)))
                  fixed(:, place(e)) = fixed(:, place(e)) &
                     + domain%model%materials(section%material)%density*section%area*load%value(:3)
               end associate
            end select
         end associate
      end do
   end subroutine collect

   !> Forces of the last increment, of which half of the work is.
   subroutine start(self, domain)
      class(distributed_load_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      real(dp) :: x(3, 2), triads(3, 3, 2), k(12, 12)
      integer :: i

      do i = 1, size(self%members)
         associate (e => self%members(i))
            call nodal_state(domain, e, x, triads)
            call distributed_force(load_axis(domain, e), x, triads, domain%elements%length(e), self%start_fixed(:, i), &
               self%start_turning(:, i), k, self%start_force(:, i))
         end associate
      end do
   end subroutine start

   subroutine evaluate(self, domain, error)
      class(distributed_load_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :)
      integer :: first, last, i

      if (domain%motions_stand .or. size(self%members) == 0) return
      if (any(abs(self%turning) > 0)) call domain%lose_symmetry()
      allocate (k(12, 12, min(chunk, size(self%members))))
      do first = 1, size(self%members), chunk
         last = min(size(self%members), first + chunk - 1)
         !$omp parallel do schedule(static) if (last - first >= worth_threads)
         do i = first, last
            call evaluate_element(i, k(:, :, i - first + 1))
         end do
         !$omp end parallel do
         call domain%add_cells(domain%model%connectivity(:, self%members(first:last)), motion_slots, motion_slots, &
            k(:, :, :last - first + 1), self%force(:, first:last))
      end do

   contains

      subroutine evaluate_element(i, ke)
         !> Place among the members
         integer, intent(in) :: i
         !> (12, 12)
         real(dp), intent(out) :: ke(12, 12)
         real(dp) :: x(3, 2), triads(3, 3, 2)

         associate (e => self%members(i))
            call nodal_state(domain, e, x, triads)
            call distributed_force(load_axis(domain, e), x, triads, domain%elements%length(e), self%fixed(:, i), &
               self%turning(:, i), ke, self%force(:, i))
         end associate
      end subroutine evaluate_element

   end subroutine evaluate

end module litz_distributed_load_term
