!> Creates the solver a deck or the command line asks for; this build has no SuiteSparse, so only the skyline solver.
module litz_solver_factory
   use litz_errors, only: error_t, fail, exit_solver, exit_internal
   use litz_linear_solver, only: linear_solver_t
   use litz_solver_names, only: solver_default, solver_block, solver_umfpack, solver_skyline, &
      solver_mumps, solver_keyword
   use litz_lu_solver, only: create_lu_solver
   use litz_sparse_factor, only: sparse_factor_t
   use litz_skyline, only: skyline_factor_t
   use litz_blas_threads, only: default_blas_threads
   implicit none
   private
   public :: create_solver, resolved_solver, available_solvers, solver_libraries

contains

   subroutine create_solver(kind, solver, error)
      !> One of the constants of litz_solver_names
      integer, intent(in) :: kind
      class(linear_solver_t), allocatable, intent(out) :: solver
      type(error_t), allocatable, intent(out) :: error
      class(sparse_factor_t), allocatable :: backend

      call default_blas_threads()
      select case (resolved_solver(kind))
      case (solver_skyline)
         allocate (skyline_factor_t :: backend)
         call create_lu_solver(backend, solver)
      case (solver_block, solver_umfpack, solver_mumps)
         error = fail(exit_solver, 'solver '//trim(solver_keyword(kind))//' is not part of this program, which was '// &
            'built without SuiteSparse; allowed: SKYLINE')
      case default
         error = fail(exit_internal, 'linear solver: there is no solver of this kind')
      end select
      if (allocated(solver)) solver%kind = resolved_solver(kind)
   end subroutine create_solver

   !> The solver that is meant: the default of this build where nobody chose.
   pure integer function resolved_solver(kind)
      !> A constant of litz_solver_names; `solver_default`: nobody chose
      integer, intent(in) :: kind

      resolved_solver = kind
      if (kind == solver_default) resolved_solver = solver_skyline
   end function resolved_solver

   !> For `litz --version`.
   pure function available_solvers() result(text)
      character(len=:), allocatable :: text

      text = 'SKYLINE (built without SuiteSparse: no BLOCK, no UMFPACK, no MUMPS)'
   end function available_solvers

   !> The libraries of the solvers with their versions, for `litz --version`.
   pure function solver_libraries() result(text)
      character(len=:), allocatable :: text

      text = 'none'
   end function solver_libraries

end module litz_solver_factory
