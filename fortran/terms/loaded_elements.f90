!> What the terms of forces on the length of elements have in common: which elements, their nodes at the beginning of an
!> increment, and what becomes of their nodal forces when it has converged.
module litz_loaded_elements
   use litz_kinds, only: dp
   use litz_axis_choices, only: axis_linear, axis_hermite
   use litz_domain, only: domain_t
   use litz_end_forces, only: forces_at_ends, nodal_state
   use litz_element_loads, only: element_load_t
   use litz_fields, only: motion_slots
   use litz_term, only: term_t
   use litz_state, only: energies_t
   implicit none
   private
   public :: loaded_elements_t, load_axis

   type, abstract, extends(term_t) :: loaded_elements_t
      !> Elements with such loads, ascending (n)
      integer, allocatable :: members(:)
      !> Internal forces of their nodes, when the increment began and as last evaluated (12, n) [N, N m]
      real(dp), allocatable :: start_force(:, :), force(:, :)
   contains
      procedure :: take_loaded
      procedure :: add_energies
      procedure :: accept
   end type loaded_elements_t

contains

   !> Take the elements with a load of some kinds, on which no forces act yet.
   pure subroutine take_loaded(self, loads, first_kind, last_kind, n_elements)
      class(loaded_elements_t), intent(inout) :: self
      type(element_load_t), intent(in) :: loads(:)
      !> Range of `load_...`, and number of elements of the model
      integer, intent(in) :: first_kind, last_kind, n_elements
      logical :: is_loaded(n_elements)
      integer :: i

      is_loaded = .false.
      do i = 1, size(loads)
         if (loads(i)%kind >= first_kind .and. loads(i)%kind <= last_kind) is_loaded(loads(i)%element) = .true.
      end do
      self%members = pack([(i, i=1, n_elements)], is_loaded)
      self%force = spread(spread(0.0_dp, 1, 12), 2, size(self%members))
      self%start_force = self%force
   end subroutine take_loaded

   !> Interpolation of the axis that carries the load: that of the displacements of the element.
   pure integer function load_axis(domain, element) result(axis)
      type(domain_t), intent(in) :: domain
      !> Index of the element
      integer, intent(in) :: element

      axis = merge(axis_linear, axis_hermite, domain%elements%shear_flexible(element))
   end function load_axis

   !> The work of the loads: mean nodal force times displacement, mean moment times rotation.
   subroutine add_energies(self, domain, energies)
      class(loaded_elements_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies
      integer :: i

      do i = 1, size(self%members)
         energies%work = energies%work - dot_product(self%start_force(:, i) + self%force(:, i), &
            reshape(domain%iterate%change(motion_slots(1):motion_slots(2), &
            domain%model%connectivity(:, self%members(i))), [size(self%force, 1)]))/2
      end do
   end subroutine add_energies

   !> What acts on the nodes, and the mean force per length.
   subroutine accept(self, domain)
      class(loaded_elements_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      integer :: i, side

      associate (state => domain%state, last => motion_slots(2))
         do i = 1, size(self%members)
            associate (e => self%members(i), force => -self%force(:, i))
               do side = 1, 2
                  associate (outer => state%outer_force(motion_slots(1):last, domain%model%connectivity(side, e)))
                     outer = outer + force((side - 1)*last + 1:side*last)
                  end associate
               end do
               if (state%has_section_results) state%section_ends(:, e) = state%section_ends(:, e) &
                  + forces_at_ends(domain, e, self%force(:, i))
               state%line_load(:, e) = state%line_load(:, e) + (force(:3) + force(last + 1:last + 3)) &
                  /domain%elements%length(e)
            end associate
         end do
      end associate
   end subroutine accept

end module litz_loaded_elements
