!> Warning of work that is in no energy.
!>
!> The work of an increment is that of mean forces, and what is dissipated that of its path: increments that are too
!> large for the forces to change evenly leave an error in both. Where friction and yielding dissipate, results depend
!> on the path, and so on that error; what is elastic is right after any increments.
module litz_energy_warnings
   use litz_kinds, only: dp
   use litz_problem, only: problem_t
   use litz_state, only: energies_t
   use litz_step_end, only: reaches_end
   use litz_text, only: to_text
   implicit none
   private
   public :: add_energy_balance

   !> Part of what a step dissipates that may be in no energy
   real(dp), parameter :: allowed_part = 0.1_dp
   !> Part of all energies that may be in none, and that a step has to dissipate for its path to matter
   real(dp), parameter :: least_part = 0.02_dp

contains

   !> At the end of a step.
   subroutine add_energy_balance(problem)
      type(problem_t), intent(inout) :: problem
      character(len=:), allocatable :: label
      real(dp) :: dissipated, lost, least

      associate (state => problem%state, now => problem%state%energies, before => problem%energies_before)
         if (.not. reaches_end(problem%model%steps(state%step), state%step_time)) return
         dissipated = by_path(now) - by_path(before)
         lost = abs(held(now) - now%work - now%thermal - (held(before) - before%work - before%thermal))
         least = least_part*max(turnover(now), turnover(before))
         if (.not. (dissipated > least .and. lost > max(least, allowed_part*dissipated))) return
         label = problem%model%units%after('J')
         call problem%warnings%add('energy_balance', 'work of '//to_text(lost)//label//' in this step is in no'// &
            ' energy, '//to_text(100*lost/dissipated)//' % of the '//to_text(dissipated)//label//' that friction'// &
            ' and yielding have dissipated in it: forces change too much within an increment, of which the work is'// &
            ' that of their mean, or a law of contact has reached its limits. Smaller increments (first and fourth'// &
            ' value of the procedure) tell; *ENERGY PRINT has the energies', value=100*lost/dissipated, unit='%')
      end associate
   end subroutine add_energy_balance

   !> The largest energy of a state: what wires hold comes back as they are let go [J].
   elemental real(dp) function turnover(energies)
      type(energies_t), intent(in) :: energies

      turnover = max(held(energies), abs(energies%work), abs(energies%thermal))
   end function turnover

   !> Dissipated by what depends on the path [J].
   elemental real(dp) function by_path(energies)
      type(energies_t), intent(in) :: energies

      by_path = energies%friction + energies%yielding
   end function by_path

   !> Held, dissipated, and taken by damping [J].
   elemental real(dp) function held(energies)
      type(energies_t), intent(in) :: energies

      held = energies%strain + energies%contact + by_path(energies) + energies%stabilization
   end function held

end module litz_energy_warnings
