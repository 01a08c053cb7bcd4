!> Warnings that many contacts may share in an increment: one for each kind, about the worst contact, with their number.
module litz_shared_warnings
   use litz_kinds, only: dp
   use litz_run_warnings, only: is_worse, kind_length, run_warnings_t
   use litz_text, only: to_text
   implicit none
   private
   public :: shared_warnings_t

   !> What contacts share
   type :: shared_warning_t
      character(len=kind_length) :: kind = ''
      !> Of the worst contact
      character(len=:), allocatable :: message
      !> Its elements, by the user's numbers (1 or 2)
      integer, allocatable :: elements(:)
      real(dp) :: value = 0
      character(len=:), allocatable :: unit
      logical :: smaller_is_worse = .false.
      !> Number of contacts
      integer :: count = 0
   end type shared_warning_t

   type :: shared_warnings_t
      type(shared_warning_t), allocatable, private :: items(:)
   contains
      procedure :: add => shared_add
      procedure :: report => shared_report
   end type shared_warnings_t

contains

   !> Takes down what is wrong with a contact; of each kind the worst one is kept.
   pure subroutine shared_add(self, kind, message, elements, value, unit, smaller_is_worse)
      class(shared_warnings_t), intent(inout) :: self
      !> The code word
      character(len=*), intent(in) :: kind
      !> A sentence without a full stop
      character(len=*), intent(in) :: message
      !> The user's numbers of the elements that it is about (1 or 2)
      integer, intent(in) :: elements(:)
      !> How bad it is
      real(dp), intent(in) :: value
      !> Unit of `value`
      character(len=*), intent(in) :: unit
      !> .true.: the smallest value is the worst
      logical, intent(in), optional :: smaller_is_worse
      type(shared_warning_t) :: new
      integer :: i

      if (.not. allocated(self%items)) allocate (self%items(0))
      do i = 1, size(self%items)
         if (self%items(i)%kind == kind) exit
      end do
      if (i > size(self%items)) then
         new%kind = kind
         if (present(smaller_is_worse)) new%smaller_is_worse = smaller_is_worse
         self%items = [self%items, new]
      end if
      associate (item => self%items(i))
         item%count = item%count + 1
         if (item%count > 1 .and. .not. is_worse(value, item%value, item%smaller_is_worse)) return
         item%message = message
         item%elements = elements
         item%value = value
         item%unit = unit
      end associate
   end subroutine shared_add

   !> Hands the warnings of an increment on. One that several contacts share is about no element, so that the increments
   !> of a run have one entry together.
   pure subroutine shared_report(self, warnings)
      class(shared_warnings_t), intent(in) :: self
      type(run_warnings_t), intent(inout) :: warnings
      integer :: i

      if (.not. allocated(self%items)) return
      do i = 1, size(self%items)
         associate (item => self%items(i))
            if (item%count == 1) then
               call warnings%add(trim(item%kind), item%message, item%elements, item%value, item%unit, &
                  item%smaller_is_worse)
            else
               call warnings%add(trim(item%kind), item%message//'; it is the worst of '//to_text(item%count)// &
                  ' places of contact', value=item%value, unit=item%unit, smaller_is_worse=item%smaller_is_worse)
            end if
         end associate
      end do
   end subroutine shared_report

end module litz_shared_warnings
