!> The degrees of freedom that a data line of *BOUNDARY names.
module litz_boundary_dofs
   use litz_deck, only: token_t
   use litz_fields, only: field_t, fields, field_rotation, field_displacement, last_dof, field_of_dof, describe_dofs
   use litz_numbers, only: parse_integer, number_ok
   use litz_reader, only: reader_t, fail_at, name_of
   use litz_text, only: to_text
   use litz_value_checks, only: advice_about_value, behind_semicolon
   implicit none
   private
   public :: find_supports, find_boundary_dofs

contains

   !> Supports with a name: what they prescribe to be zero, first and last of each range; none where no name is given.
   subroutine find_supports(self, dofs, ok)
      type(reader_t), intent(inout) :: self
      !> First and last of each range (2, n)
      integer, allocatable, intent(out) :: dofs(:, :)
      !> .false.: an error was reported
      logical, intent(out) :: ok

      associate (values => self%values)
         select case (name_of(self, values%token(2)))
         case ('ENCASTRE')
            dofs = reshape([1, last_dof(field_rotation)], [2, 1])
         case ('PINNED')
            dofs = reshape([1, last_dof(field_displacement)], [2, 1])
         case ('XSYMM')
            dofs = reshape([1, 1, 5, 6], [2, 2])
         case ('YSYMM')
            dofs = reshape([2, 2, 4, 4, 6, 6], [2, 3])
         case ('ZSYMM')
            dofs = reshape([3, 5], [2, 1])
         case ('XASYMM')
            dofs = reshape([2, 4], [2, 1])
         case ('YASYMM')
            dofs = reshape([1, 1, 3, 3, 5, 5], [2, 3])
         case ('ZASYMM')
            dofs = reshape([1, 2, 6, 6], [2, 2])
         case default
            allocate (dofs(2, 0))
         end select
         ok = size(dofs) == 0 .or. values%n == 2
         if (.not. ok) call fail_at(self, values%token(3), 'nothing follows '//self%deck%text(values%token(2))// &
            ', which prescribes zero values')
      end associate
   end subroutine find_supports

   !> A range of numbers.
   subroutine find_boundary_dofs(self, first, last, ok)
      type(reader_t), intent(inout) :: self
      !> First and last degree of freedom, with Abaqus's numbers
      integer, intent(out) :: first, last
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: status

      first = 1
      last = 0
      ok = .true.
      associate (values => self%values)
         call parse_integer(self%deck%text(values%token(2)), first, status)
         if (status /= number_ok) then
            ok = .false.
            call fail_at(self, values%token(2), &
               'value 2 must be ENCASTRE, PINNED, XSYMM, ..., or a degree of freedom: '//describe_dofs('or')// &
               '; found '// &
               self%deck%shown(values%token(2))//behind_semicolon(advice_about_value(self, values%token(2))))
            return
         end if
         last = merge(values%whole(3), first, values%given(3))
         call check_dof(values%token(2), first)
         if (ok .and. values%given(3)) call check_dof(values%token(3), last)
         if (ok .and. last < first) then
            ok = .false.
            call fail_at(self, values%token(3), 'the last degree of freedom, '//to_text(last)// &
               ', is smaller than the first, '//to_text(first))
         else if (ok) then
            call check_range(fields(field_of_dof(first)), fields(field_of_dof(last)))
         end if
      end associate

   contains

      subroutine check_dof(token, dof)
         type(token_t), intent(in) :: token
         !> The number that the line names
         integer, intent(in) :: dof

         ok = field_of_dof(dof) > 0
         if (.not. ok) call fail_at(self, token, 'degree of freedom '//to_text(dof)//' does not exist; there are '// &
            describe_dofs('and'))
      end subroutine check_dof

      !> A range stays within fields that are solved for together.
      subroutine check_range(from, to)
         type(field_t), intent(in) :: from, to

         ok = from%group == to%group
         if (.not. ok) call fail_at(self, self%values%token(3), 'a range must not reach from '//trim(from%name)// &
            ' to '//trim(to%name)//'; use two lines')
      end subroutine check_range

   end subroutine find_boundary_dofs

end module litz_boundary_dofs
