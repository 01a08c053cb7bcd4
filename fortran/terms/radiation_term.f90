!> Heat that wires radiate from their sides, in steps that solve for temperatures. Source: theory section 13.
module litz_radiation_term
   use litz_kinds, only: dp, pi
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, temperature_slots
   use litz_loading, only: heat_at
   use litz_model, only: step_t, element_heat_t
   use litz_term, only: term_t
   use litz_wire_surface, only: wire_radiation
   implicit none
   private
   public :: radiation_term_t

   type, extends(term_t) :: radiation_term_t
      !> Elements that radiate, eps sigma P [W/(m K^4)], temperature of the surroundings [K], and what each radiates
      !> less what its film makes up for between the nodes [W]
      integer, allocatable :: elements(:)
      real(dp), allocatable :: coefficient(:), surroundings(:), heat(:)
   contains
      procedure :: apply_load
      procedure :: evaluate
      procedure :: hold
      procedure :: accept
   end type radiation_term_t

contains

   subroutine apply_load(self, domain, step, step_time, increment)
      class(radiation_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment
      type(element_heat_t) :: given(size(step%heat))
      integer :: e

      given = heat_at(domain%model, step, step_time, domain%state%time - domain%state%step_time)
      self%elements = pack([(e, e=1, size(step%heat))], step%heat%emissivity > 0)
      if (.not. step%solves(field_temperature)) self%elements = self%elements(:0)
      associate (model => domain%model, elements => self%elements)
         self%coefficient = given(elements)%emissivity*model%stefan_boltzmann &
            *2*pi*model%sections(model%element_section(elements))%contact_radius
         self%surroundings = given(elements)%surroundings
         self%heat = 0*self%surroundings
      end associate
   end subroutine apply_load

   subroutine evaluate(self, domain, error)
      class(radiation_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :)
      real(dp) :: slope(2), share, dshare
      integer :: i, info

      if (.not. allocated(self%elements)) return
      allocate (k(2, 2, size(self%elements)), r(2, size(self%elements)), source=0.0_dp)
      do i = 1, size(self%elements)
         associate (node => domain%model%connectivity(:, self%elements(i)))
            ! below absolute zero the heat term refuses the iterate
            call wire_radiation(domain%iterate%value(temperature_slots(1), node), &
               self%coefficient(i)*domain%conduction_length(self%elements(i)), self%surroundings(i), &
               domain%model%absolute_zero, slope, r(:, i), info)
            ! under a film as a sink in the element: the nodes give a part of it, the film the rest
            call domain%share_of_nodes(self%elements(i), share, dshare)
            k(:, :, i) = dshare*spread(r(:, i), 2, 2)
            k(1, 1, i) = k(1, 1, i) + share*slope(1)
            k(2, 2, i) = k(2, 2, i) + share*slope(2)
            r(:, i) = share*r(:, i)
            self%heat(i) = sum(r(:, i))
         end associate
      end do
      if (size(self%elements) > 0) call domain%add_cells(domain%model%connectivity(:, self%elements), &
         temperature_slots, temperature_slots, k, r)
   end subroutine evaluate

   !> What radiates has a temperature.
   subroutine hold(self, domain, field, held)
      class(radiation_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(inout) :: held(:)

      if (field == field_temperature .and. allocated(self%elements)) call domain%mark_nodes(self%elements, held)
   end subroutine hold

   subroutine accept(self, domain)
      class(radiation_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      if (.not. allocated(self%elements)) return
      associate (lost => domain%state%surface_heat, e => self%elements)
         lost(e) = lost(e) + self%heat
      end associate
   end subroutine accept

end module litz_radiation_term
