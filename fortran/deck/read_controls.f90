!> *CONTROLS, *SOLVER and *SOLUTION TECHNIQUE.
module litz_read_controls
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_model, only: step_t, controls_t, coupling_monolithic, coupling_updated, coupling_full
   use litz_solver_names, only: solver_block, solver_umfpack, solver_skyline, solver_mumps
   use litz_reader, only: reader_t, fail_at, choice_of, integer_parameter, parameter_of
   use litz_data_lines, only: read_line
   implicit none
   private
   public :: read_controls, read_solver, read_solution_technique

   !> Of *CONTROLS, PARAMETERS=STABILIZE without a number
   real(dp), parameter :: default_stabilization = 1.0e-8_dp
   !> Of *SOLUTION TECHNIQUE, TYPE=MODIFIED NEWTON, as in Abaqus
   integer, parameter :: default_reform_kernel = 8

contains

   subroutine read_controls(self, card, controls)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(controls_t), intent(inout) :: controls
      integer :: line
      logical :: ok

      if (choice_of(self, card, 'PARAMETERS') == 'STABILIZE') controls%stabilize = default_stabilization
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         select case (choice_of(self, card, 'PARAMETERS'))
         case ('FIELD')
            call take_real(1, controls%r_n)
            call take_real(2, controls%c_n)
         case ('TIMEINCREMENTATION')
            if (line == self%deck%cards(card)%first_data) then
               call take_whole(4, controls%i_c)
               call take_whole(5, controls%i_l)
               call take_whole(6, controls%i_g)
               call take_whole(8, controls%i_a)
            else
               call take_factor(1, controls%d_f, below_one=.true.)
               call take_factor(3, controls%d_b, below_one=.true.)
               call take_factor(7, controls%d_d, below_one=.false.)
            end if
         case ('STABILIZE')
            call take_real(1, controls%stabilize)
         case ('ROTATION')
            call take_real(1, controls%rotation_cap)
         end select
      end do

   contains

      subroutine take_real(i, value)
         !> Place of the value on the data line
         integer, intent(in) :: i
         !> In: the default. Out: what the line gives, where it gives anything
         real(dp), intent(inout) :: value

         if (self%values%given(i)) value = self%values%real(i)
      end subroutine take_real

      subroutine take_whole(i, value)
         !> Place of the value on the data line
         integer, intent(in) :: i
         !> In: the default. Out: what the line gives, where it gives anything
         integer, intent(inout) :: value

         if (self%values%given(i)) value = self%values%whole(i)
      end subroutine take_whole

      !> A factor that shrinks increments, or one that lets them grow.
      subroutine take_factor(i, value, below_one)
         !> Place of the value on the data line
         integer, intent(in) :: i
         !> In: the default. Out: what the line gives, where it gives anything
         real(dp), intent(inout) :: value
         !> .true.: the factor shrinks increments; .false.: it lets them grow
         logical, intent(in) :: below_one

         call take_real(i, value)
         if (.not. self%values%given(i)) return
         if (below_one .and. value >= 1) call fail_at(self, self%values%token(i), &
            'this factor shrinks increments, so it must be smaller than 1; found '//to_text(value))
         if (.not. below_one .and. value < 1) call fail_at(self, self%values%token(i), &
            'this factor lets increments grow, so it must be 1 or greater; found '//to_text(value))
      end subroutine take_factor

   end subroutine read_controls

   subroutine read_solver(self, card, step)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step

      select case (choice_of(self, card, 'NAME'))
      case ('BLOCK')
         step%solver = solver_block
      case ('UMFPACK')
         step%solver = solver_umfpack
      case ('SKYLINE')
         step%solver = solver_skyline
      case ('MUMPS')
         step%solver = solver_mumps
      end select
      select case (choice_of(self, card, 'COUPLING'))
      case ('MONOLITHIC')
         step%coupling = coupling_monolithic
      case ('UPDATED')
         step%coupling = coupling_updated
      case ('FULL')
         step%coupling = coupling_full
      end select
   end subroutine read_solver

   subroutine read_solution_technique(self, card, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step

      step%reform_kernel = 0
      select case (choice_of(self, card, 'TYPE'))
      case ('MODIFIEDNEWTON')
         step%reform_kernel = integer_parameter(self, card, 'REFORM KERNEL', default_reform_kernel)
      case ('NEWTON')
         associate (token => parameter_of(self, card, 'REFORM KERNEL'))
            if (token%line > 0) call fail_at(self, token, &
               'TYPE=NEWTON keeps no factor; REFORM KERNEL goes with TYPE=MODIFIED NEWTON')
         end associate
      end select
   end subroutine read_solution_technique

end module litz_read_controls
