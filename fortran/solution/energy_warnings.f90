!> Warning of work that is in no energy.
!>
!> The work of an increment is that of mean forces, and what is dissipated that of its path: increments that are too
!> large for the forces to change evenly leave an error in both. Where friction and yielding dissipate, results depend
!> on the path, and so on that error; what is elastic is right after any increments.
module litz_energy_warnings
   use litz_kinds, only: dp
   use litz_problem, only: problem_t
   use litz_step_end, only: reaches_end
   use litz_text, only: to_text
   implicit none
   private
   public :: add_energy_balance

   !> Part of what is dissipated that may be in no energy
   real(dp), parameter :: allowed_part = 0.1_dp
   !> Part of the work that may be in no energy, and that has to be dissipated for the path to matter
   real(dp), parameter :: least_part = 0.02_dp

contains

   !> At the end of a step.
   subroutine add_energy_balance(problem)
      type(problem_t), intent(inout) :: problem
      character(len=:), allocatable :: label
      real(dp) :: dissipated, held, left_over

      associate (state => problem%state, energies => problem%state%energies)
         if (.not. reaches_end(problem%model%steps(state%step), state%step_time)) return
         dissipated = energies%friction + energies%yielding
         held = energies%strain + energies%contact + dissipated + energies%stabilization
         left_over = held - energies%work - energies%thermal
         associate (least => least_part*max(held, abs(energies%work), abs(energies%thermal)))
            if (.not. (dissipated > least .and. abs(left_over) > max(least, allowed_part*dissipated))) return
         end associate
         label = problem%model%units%after('J')
         call problem%warnings%add('energy_balance', 'work of '//to_text(abs(left_over))//label//' is in no energy,'// &
            ' '//to_text(100*abs(left_over)/dissipated)//' % of the '//to_text(dissipated)//label//' that'// &
            ' friction and yielding have dissipated: forces change too much within an increment, of which the work'// &
            ' is that of their mean, or a law of contact has reached its limits. Smaller increments (first and'// &
            ' fourth value of the procedure) tell; *ENERGY PRINT has the energies', &
            value=100*abs(left_over)/dissipated, unit='%')
      end associate
   end subroutine add_energy_balance

end module litz_energy_warnings
