!> Damping of loose wires and of snaps: every free displacement and rotation of an increment is resisted a little.
!>
!> A node that moves by `du` in an increment `dt` of a step of length `T` is resisted by `s du T/dt`, a turn alike. What
!> stands still is not resisted, so that the end of a movement is an equilibrium without help; what a part that floats
!> does is determined. The work against it is `ALLSD`: like that of supports and loads, of the mean of the forces at the
!> start and at the end of an increment, so that the energies balance where the damping begins, ends or jumps.
module litz_stabilization_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: field_displacement, field_of_slot, motion_slots
   use litz_model, only: model_t, step_t
   use litz_state, only: energies_t
   use litz_term, only: term_t
   implicit none
   private
   public :: stabilization_term_t

   type, extends(term_t) :: stabilization_term_t
      !> Against displacement [N/m] and rotation [N m]; 0: none
      real(dp) :: stiffness(2) = 0
      !> What resists the free unknowns (n_slots, n_nodes) [N, N m]
      real(dp), allocatable :: force(:, :)
   contains
      procedure :: apply_load
      procedure :: evaluate
      procedure :: add_energies
      procedure :: accept
   end type stabilization_term_t

contains

   subroutine apply_load(self, domain, step, step_time, increment)
      class(stabilization_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      self%stiffness = step%controls%stabilize/(increment/step%total) &
         *(-domain%processes%largest(-least_stiffness(domain%model, domain%elements%length)))
   end subroutine apply_load

   !> The least stiffness of any element in tension [N/m] and in bending [N m]: `s` against displacement and against
   !> rotation is a part of it.
   pure function least_stiffness(model, length) result(stiffness)
      type(model_t), intent(in) :: model
      !> Reference lengths of the elements (n_elements) [m]
      real(dp), intent(in) :: length(:)
      real(dp) :: stiffness(2)
      integer :: e

      stiffness = huge(1.0_dp)
      do e = 1, model%n_elements
         associate (section => model%sections(model%element_section(e)))
            associate (young => section%stiffness*model%materials(section%material)%young)
               stiffness(1) = min(stiffness(1), young*section%area/length(e))
               stiffness(2) = min(stiffness(2), young*min(section%i2, section%i3)/length(e))
            end associate
         end associate
      end do
   end function least_stiffness

   !> Add the damping of what has moved since the increment began.
   subroutine evaluate(self, domain, error)
      class(stabilization_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :)
      integer :: n, node, slot

      if (domain%motions_stand) return
      n = domain%model%n_nodes
      self%force = 0*domain%iterate%change
      if (.not. any(self%stiffness > 0)) return
      associate (first => motion_slots(1), last => motion_slots(2), change => domain%iterate%change)
         allocate (k(last, last, n), r(last, n), source=0.0_dp)
         do node = 1, n
            if (.not. domain%processes%owns(node)) cycle
            do slot = first, last
               if (domain%equations%number(slot, node) == 0) cycle
               associate (s => self%stiffness(merge(1, 2, field_of_slot(slot) == field_displacement)))
                  k(slot, slot, node) = s
                  r(slot, node) = s*change(slot, node)
               end associate
            end do
         end do
         call domain%add_cells(reshape([(node, node=1, n)], [1, n]), motion_slots, motion_slots, k, r)
         self%force(first:last, :) = r
      end associate
   end subroutine evaluate

   subroutine add_energies(self, domain, energies)
      class(stabilization_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies

      energies%stabilization = energies%stabilization &
         + sum(domain%processes%own_part((domain%state%damping + self%force)*domain%iterate%change))/2
   end subroutine add_energies

   !> The force on the nodes is against their motion.
   subroutine accept(self, domain)
      class(stabilization_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      domain%state%outer_force = domain%state%outer_force - self%force
      domain%state%damping = self%force
   end subroutine accept

end module litz_stabilization_term
