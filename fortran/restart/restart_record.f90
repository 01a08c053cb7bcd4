!> Rows of numbers that go to a restart file or come back from it.
!>
!> One procedure per type names the fields, and serves both ways: a new field is one line there.
module litz_restart_record
   use litz_kinds, only: dp, int64
   use litz_contact_history, only: contact_history_t
   use litz_contact_points, only: contact_point_t
   use litz_state, only: contact_t
   implicit none
   private
   public :: record_t, name_length
   public :: exchange_point, exchange_contact

   integer, parameter :: most_fields = 64, name_length = 32

   type :: record_t
      !> .true.: the fields are set from the record; .false.: the record from the fields
      logical :: restoring = .false.
      integer :: n_reals = 0, n_integers = 0
      real(dp) :: reals(most_fields) = 0
      integer(int64) :: integers(most_fields) = 0
      !> Names of the columns
      character(len=name_length) :: real_names(most_fields) = '', integer_names(most_fields) = ''
   contains
      procedure, private :: real_field, vector_field, integer_field, logical_field
      generic :: field => real_field, vector_field, integer_field, logical_field
   end type record_t

contains

   !> What the next increment needs of a crossing: its place, its memory, and how it stood.
   pure subroutine exchange_point(record, point)
      type(record_t), intent(inout) :: record
      type(contact_point_t), intent(inout) :: point

      call record%field('id', point%id)
      call record%field('element_bar', point%element_bar)
      call record%field('element', point%element)
      call record%field('pair', point%pair)
      call record%field('closed', point%closed)
      call record%field('xi_bar', point%xi_bar)
      call record%field('xi', point%xi)
      call record%field('arc_bar', point%arc_bar)
      call record%field('arc', point%arc)
      call record%field('gap', point%gap)
      call record%field('fit', point%fit)
      call record%field('distance_gap', point%kinematics%gap)
      call record%field('normal', point%kinematics%normal)
      call record%field('side', point%kinematics%side)
      call record%field('angle', point%kinematics%angle)
      call record%field('force', point%force)
      call exchange_history(record, point%history)
   end subroutine exchange_point

   pure subroutine exchange_history(record, history)
      type(record_t), intent(inout) :: record
      type(contact_history_t), intent(inout) :: history

      call record%field('was_closed', history%closed)
      call record%field('converged_arc_bar', history%arc(1))
      call record%field('converged_arc', history%arc(2))
      call record%field('converged_force', history%force)
      call record%field('traction_1', history%traction(1))
      call record%field('traction_2', history%traction(2))
      call record%field('slip_path', history%slip_path)
      call record%field('dissipation', history%dissipation)
      call record%field('elastic_energy', history%elastic_energy)
      call record%field('largest_force', history%largest_force)
   end subroutine exchange_history

   pure subroutine exchange_contact(record, contact)
      type(record_t), intent(inout) :: record
      type(contact_t), intent(inout) :: contact

      call record%field('id', contact%id)
      call record%field('element_bar', contact%element_bar)
      call record%field('element', contact%element)
      call record%field('pair', contact%pair)
      call record%field('xi_bar', contact%xi_bar)
      call record%field('xi', contact%xi)
      call record%field('angle', contact%angle)
      call record%field('gap', contact%gap)
      call record%field('normal', contact%normal)
      call record%field('point_bar', contact%point_bar)
      call record%field('point', contact%point)
      call record%field('force', contact%force)
      call record%field('semi_major', contact%semi_major)
      call record%field('semi_minor', contact%semi_minor)
      call record%field('resistance', contact%resistance)
      call record%field('current', contact%current)
      call record%field('voltage_gap', contact%voltage_gap)
      call record%field('joule_heat', contact%joule_heat)
      call record%field('friction', contact%friction_status)
      call record%field('traction', contact%traction)
      call record%field('slip_path', contact%slip_path)
      call record%field('dissipation', contact%dissipation)
   end subroutine exchange_contact

   pure subroutine real_field(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(inout) :: value

      self%n_reals = self%n_reals + 1
      self%real_names(self%n_reals) = name
      if (self%restoring) then
         value = self%reals(self%n_reals)
      else
         self%reals(self%n_reals) = value
      end if
   end subroutine real_field

   pure subroutine vector_field(self, name, values)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(inout) :: values(3)
      character(len=1), parameter :: axes(3) = ['x', 'y', 'z']
      integer :: i

      do i = 1, 3
         call self%real_field(name//'_'//axes(i), values(i))
      end do
   end subroutine vector_field

   pure subroutine integer_field(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(inout) :: value

      self%n_integers = self%n_integers + 1
      self%integer_names(self%n_integers) = name
      if (self%restoring) then
         value = int(self%integers(self%n_integers))
      else
         self%integers(self%n_integers) = value
      end if
   end subroutine integer_field

   pure subroutine logical_field(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(inout) :: value
      integer :: number

      number = merge(1, 0, value)
      call self%integer_field(name, number)
      value = number /= 0
   end subroutine logical_field

end module litz_restart_record
