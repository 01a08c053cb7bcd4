!> Creates the solver a deck or the command line asks for; this build has all of them, MUMPS perhaps.
module litz_solver_factory
   use, intrinsic :: iso_c_binding, only: c_int
   use litz_errors, only: error_t, fail, exit_solver, exit_internal
   use litz_linear_solver, only: linear_solver_t
   use litz_solver_names, only: solver_default, solver_block, solver_umfpack, solver_skyline, solver_mumps
   use litz_cholesky_or_lu, only: cholesky_or_lu_t
   use litz_lu_solver, only: create_lu_solver
   use litz_mumps, only: has_mumps, create_mumps_factor, mumps_version
   use litz_sparse_factor, only: sparse_factor_t
   use litz_umfpack, only: umfpack_factor_t
   use litz_skyline, only: skyline_factor_t
   use litz_blas_threads, only: default_blas_threads
   implicit none
   private
   public :: create_solver, resolved_solver, available_solvers, solver_libraries

   interface
      !> Three numbers each of SuiteSparse, CHOLMOD and UMFPACK
      subroutine suitesparse_versions(versions) bind(c, name='litz_suitesparse_versions')
         import :: c_int
         implicit none
         !> Main, sub and patch version of each of the three (9)
         integer(c_int), intent(out) :: versions(9)
      end subroutine suitesparse_versions
   end interface

contains

   subroutine create_solver(kind, solver, error)
      !> One of the constants of litz_solver_names
      integer, intent(in) :: kind
      class(linear_solver_t), allocatable, intent(out) :: solver
      type(error_t), allocatable, intent(out) :: error
      class(sparse_factor_t), allocatable :: backend, symmetric_backend

      call default_blas_threads()
      select case (resolved_solver(kind))
      case (solver_block)
         allocate (cholesky_or_lu_t :: solver)
      case (solver_umfpack)
         allocate (umfpack_factor_t :: backend)
         call create_lu_solver(backend, solver)
      case (solver_skyline)
         allocate (skyline_factor_t :: backend)
         call create_lu_solver(backend, solver)
      case (solver_mumps)
         if (has_mumps) then
            call create_mumps_factor(.false., backend)
            call create_mumps_factor(.true., symmetric_backend)
            call create_lu_solver(backend, solver, symmetric_backend)
         else
            error = fail(exit_solver, 'solver MUMPS is not part of this program, which was built without MUMPS '// &
               '(Debian package libmumps-seq-dev); allowed: BLOCK, UMFPACK and SKYLINE')
         end if
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
      if (kind == solver_default) resolved_solver = solver_block
   end function resolved_solver

   !> For `litz --version`.
   pure function available_solvers() result(text)
      character(len=:), allocatable :: text

      if (has_mumps) then
         text = 'BLOCK (CHOLMOD, MUMPS, UMFPACK), UMFPACK, SKYLINE, MUMPS'
      else
         text = 'BLOCK (CHOLMOD, UMFPACK), UMFPACK, SKYLINE (built without MUMPS)'
      end if
   end function available_solvers

   !> The libraries of the solvers with their versions, for `litz --version`.
   function solver_libraries() result(text)
      character(len=:), allocatable :: text
      integer(c_int) :: versions(9)
      character(len=80) :: line

      call suitesparse_versions(versions)
      write (line, '(3(a, i0, 2(".", i0)), a)') 'SuiteSparse ', versions(1:3), ' (CHOLMOD ', versions(4:6), &
         ', UMFPACK ', versions(7:9), ')'
      text = trim(line)//', '//mumps_version()
   end function solver_libraries

end module litz_solver_factory
