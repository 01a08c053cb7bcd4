!> Reports of an iteration and of an increment.
module litz_reports
   use litz_fields, only: n_fields
   use litz_kinds, only: dp
   implicit none
   private
   public :: iteration_report_t, increment_report_t

   !> One Newton iteration.
   type :: iteration_report_t
      integer :: step = 0, increment = 0
      !> 1 for the first attempt at the increment, one more after each cut-back
      integer :: attempt = 1
      integer :: iteration = 0
      !> Residual norms and their allowed values: force [N], moment [N m], current [A]
      real(dp) :: residual(n_fields) = 0, allowed(n_fields) = 0
      !> The nodes where they are (numbers of the deck; 0: none)
      integer :: residual_node(n_fields) = 0
      !> Largest corrections: displacement [m], rotation [rad], potential [V]
      real(dp) :: correction(n_fields) = 0
      !> The nodes where they are (numbers of the deck; 0: none)
      integer :: correction_node(n_fields) = 0
      integer :: contacts_active = 0, contacts_new = 0, contacts_lost = 0
      !> Sum of the forces of all active ones [N], and worst penetration [m], positive
      real(dp) :: contact_force = 0, penetration = 0
      !> Iterations before this one that have used the same factor of the tangent
      integer :: factor_age = 0
   end type iteration_report_t

   !> One increment, converged or given up.
   type :: increment_report_t
      integer :: step = 0, increment = 0
      !> Tries, 1 more than cut-backs; iterations of the last try
      integer :: attempts = 1, iterations = 0
      real(dp) :: time = 0, step_time = 0, time_increment = 0
      !> Last residual norms: force [N], moment [N m], current [A]
      real(dp) :: residual(n_fields) = 0
      !> Negative pivots of the last factorisation; -1: not known
      integer :: negative_pivots = -1
      !> Active ones, and the sum of their forces [N]
      integer :: contacts = 0
      real(dp) :: contact_force = 0
      !> Worst figures of the audit, as in the state; 0 where an increment was given up
      real(dp) :: audit(5) = 0
      !> It was accepted; no: cut, or given up
      logical :: converged = .false.
      !> The tolerance that ended the iteration was that of round-off in one of the fields
      logical :: at_round_off = .false.
      !> What is worth knowing, such as why the increment was cut
      character(len=:), allocatable :: remark
   end type increment_report_t

end module litz_reports
