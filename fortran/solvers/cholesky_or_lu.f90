!> One matrix solved by its Cholesky factor: exactly where it is symmetric and positive definite, as a preconditioner
!> where only its symmetric part is, or that of the matrix without a coupling that is given beside it; by LU where that
!> cannot be, or where the rest is too large for it, or by L D L^T of MUMPS where the matrix is symmetric. The factor of
!> an earlier matrix is a preconditioner, too, where a factorisation costs as much as many steps with it.
module litz_cholesky_or_lu
   use litz_kinds, only: dp
   use litz_cholmod, only: cholmod_factor_t
   use litz_concus_golub_widlund, only: symmetric_part, solve_by_symmetric_part
   use litz_equilibration, only: equilibrate
   use litz_errors, only: error_t
   use litz_gmres, only: linear_map_t, gmres
   use litz_linear_solver, only: linear_solver_t, csr_matrix_t, check_right_side
   use litz_lu_solver, only: create_lu_solver
   use litz_mumps, only: create_mumps_factor
   use litz_scaled_factor, only: scaled_factor_t
   use litz_sparse_factor, only: sparse_factor_t
   use litz_sparse_pattern, only: csr_add_product
   use litz_umfpack, only: umfpack_factor_t
   implicit none
   private
   public :: cholesky_or_lu_t

   type, extends(linear_solver_t) :: cholesky_or_lu_t
      type(scaled_factor_t) :: cholesky
      !> LU, or L D L^T
      class(linear_solver_t), allocatable :: lu
      !> The values are symmetric
      logical :: symmetric = .true.
      !> The LU has its symbolic work done
      logical :: lu_analysed = .false.
      !> The last factorisation is the LU
      logical :: lu_used = .false.
      !> The last factorisation is that of the matrix without the coupling
      logical :: is_near = .false.
      !> Steps at most with an earlier factor
      integer, private :: steps_with_kept = 0
      !> They have not sufficed since the first of these matrices: none is tried with them until the next first one
      logical, private :: kept_in_vain = .false.
      !> What the last `factor` was to leave out of its matrix, if it has kept an earlier factor (entries)
      real(dp), allocatable, private :: coupling(:)
   contains
      procedure :: analyse => solver_analyse
      procedure :: factor => solver_factor
      procedure :: solve => solver_solve
      procedure :: solve_once => solver_solve_once
      procedure :: release => solver_release
   end type cholesky_or_lu_t

   !> The matrix with its equations and unknowns scaled, and the Cholesky factor of what is near it.
   type, extends(linear_map_t) :: near_map_t
      type(csr_matrix_t), pointer :: matrix => null()
      type(scaled_factor_t), pointer :: factor => null()
      type(error_t), allocatable :: error
   contains
      procedure :: apply => multiply
      procedure :: precondition => solve_near
   end type near_map_t

   !> Residual of the iteration over that of its start, and steps beyond which an LU costs no more
   real(dp), parameter :: accurate_residual = 1.0e-9_dp
   integer, parameter :: max_steps = 30
   !> The same residual with an earlier factor, which is about what a Newton step leaves of its own; and steps below
   !> which such a factor is not tried
   real(dp), parameter :: residual_of_kept = 1.0e-4_dp
   integer, parameter :: fewest_steps = 4
   !> Operations of a factorisation, for each entry of the factor, that take as long as half a step: multiplications of
   !> dense blocks are faster than reading the factor from memory (measured with 10^4 to 10^5 elements)
   real(dp), parameter :: operations_per_entry = 40
   !> Number of equations from which L D L^T of MUMPS takes less time than LU of UMFPACK
   integer, parameter :: worth_mumps = 500

contains

   subroutine solver_analyse(self, matrix, error)
      class(cholesky_or_lu_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      self%lu_analysed = .false.
      if (.not. allocated(self%cholesky%backend)) allocate (cholmod_factor_t :: self%cholesky%backend)
      if (.not. allocated(self%lu)) call create_lu(self%lu)
      call self%lu%release()
      call self%cholesky%analyse(matrix, self%offset, error)
   end subroutine solver_analyse

   subroutine create_lu(solver)
      class(linear_solver_t), allocatable, intent(out) :: solver
      class(sparse_factor_t), allocatable :: backend, symmetric_backend

      allocate (umfpack_factor_t :: backend)
      call create_mumps_factor(.true., symmetric_backend)
      call create_lu_solver(backend, solver, symmetric_backend, worth_mumps)
   end subroutine create_lu

   !> Scales by itself: Cholesky wants a unit diagonal.
   subroutine solver_factor(self, matrix, symmetric, error, row_scale, column_scale, coupling)
      class(cholesky_or_lu_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> Its values are symmetric, at least among the equations whose pivots are counted
      logical, intent(in) :: symmetric
      type(error_t), allocatable, intent(out) :: error
      !> Powers of two (n_rows); without them the diagonal is made about 1
      real(dp), intent(in), optional :: row_scale(:), column_scale(:)
      !> A part of the matrix that a preconditioner leaves out (entries)
      real(dp), intent(in), optional :: coupling(:)

      self%negative_pivots = -1
      self%failed_equation = 0
      self%symmetric = symmetric
      if (allocated(self%coupling)) deallocate (self%coupling)
      self%steps_with_kept = 0
      self%kept_in_vain = self%kept_in_vain .and. self%may_keep
      if (self%may_keep .and. self%cholesky%factored .and. .not. self%kept_in_vain .and. matrix%n_rows > 0) then
         self%steps_with_kept = steps_worth_a_factor(self)
      end if
      self%has_kept = self%steps_with_kept >= fewest_steps
      if (self%has_kept) then
         if (present(coupling)) allocate (self%coupling, source=coupling)
      else
         call factor_anew(self, matrix, error, row_scale, column_scale, coupling)
      end if
   end subroutine solver_factor

   subroutine factor_anew(self, matrix, error, row_scale, column_scale, coupling)
      class(cholesky_or_lu_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      !> As of `factor` (n_rows)
      real(dp), intent(in), optional :: row_scale(:), column_scale(:)
      !> As of `factor` (entries)
      real(dp), intent(in), optional :: coupling(:)

      self%has_kept = .false.
      call self%lu%release()
      call factor_cholesky(self, matrix, error, coupling)
      self%failed_equation = self%cholesky%failed_equation
      self%lu_used = self%failed_equation > 0
      if (self%lu_used) call factor_lu(self, matrix, error, row_scale, column_scale)
      if (allocated(error)) return
      if (self%symmetric .or. self%lu_used .or. .not. self%is_near) call count_negative_pivots(self)
   end subroutine factor_anew

   subroutine factor_cholesky(self, matrix, error, coupling)
      class(cholesky_or_lu_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      !> As of `factor` (entries)
      real(dp), intent(in), optional :: coupling(:)
      type(csr_matrix_t) :: part, near
      real(dp) :: scale(matrix%n_rows)

      self%is_near = .not. self%symmetric .and. present(coupling)
      if (self%symmetric) then
         call equilibrate(matrix, scale)
         call self%cholesky%factor(matrix, scale, scale, error)
      else
         if (self%is_near) then
            near = matrix
            near%value = near%value - coupling
            call symmetric_part(near, part)
         else
            call symmetric_part(matrix, part)
         end if
         call equilibrate(part, scale)
         call self%cholesky%factor(part, scale, scale, error)
      end if
   end subroutine factor_cholesky

   subroutine factor_lu(self, matrix, error, row_scale, column_scale)
      class(cholesky_or_lu_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      !> As of `factor` (n_rows)
      real(dp), intent(in), optional :: row_scale(:), column_scale(:)

      call self%cholesky%release()
      if (.not. self%lu_analysed) then
         self%lu%offset = self%offset
         call self%lu%analyse(matrix, error)
         if (allocated(error)) return
         self%lu_analysed = .true.
      end if
      call self%lu%factor(matrix, self%symmetric, error, row_scale, column_scale)
      self%failed_equation = self%lu%failed_equation
   end subroutine factor_lu

   !> That Cholesky failed says only that there is a negative pivot; how many, the other factorisation may tell. A
   !> matrix with a positive definite symmetric part has none; without one that factorisation alone knows, as what
   !> friction makes unsymmetric leaves the pivots positive.
   subroutine count_negative_pivots(self)
      class(cholesky_or_lu_t), intent(inout) :: self

      self%negative_pivots = 0
      self%negative_pivots_exact = .true.
      if (.not. self%lu_used) return
      self%negative_pivots_exact = self%lu%negative_pivots >= 0
      if (self%symmetric .or. self%negative_pivots_exact) then
         self%negative_pivots = merge(self%lu%negative_pivots, 1, self%negative_pivots_exact)
      else
         self%negative_pivots = -1
      end if
   end subroutine count_negative_pivots

   subroutine solver_solve(self, matrix, b, x, error)
      class(cholesky_or_lu_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); of no use after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      logical :: converged

      call check_right_side(matrix, b, error)
      if (allocated(error)) return
      if (self%has_kept) then
         call iterate(matrix, self%cholesky, b, residual_of_kept, self%steps_with_kept, x, converged, error)
         if (allocated(error) .or. converged) return
         self%kept_in_vain = .true.
         call factor_anew(self, matrix, error, coupling=self%coupling)
         if (allocated(error)) return
      end if
      if (.not. (self%lu_used .or. self%symmetric)) then
         if (self%is_near) then
            call solve_by_near_part(matrix, self%cholesky, b, x, converged, error)
         else
            call solve_by_symmetric_part(matrix, self%cholesky, b, x, converged, error)
         end if
         self%failed_equation = self%cholesky%failed_equation
         if (allocated(error) .or. converged) return
         self%lu_used = .true.
         call factor_lu(self, matrix, error)
         if (allocated(error)) return
      end if
      if (self%lu_used) then
         call self%lu%solve(matrix, b, x, error)
         self%failed_equation = self%lu%failed_equation
      else
         call self%cholesky%solve(b, x, error)
         self%failed_equation = self%cholesky%failed_equation
      end if
   end subroutine solver_solve

   subroutine solver_solve_once(self, b, x, error)
      class(cholesky_or_lu_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Nearly the solution (n); of no use after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      if (self%lu_used) then
         call self%lu%solve_once(b, x, error)
      else
         call self%cholesky%solve_once(b, x, error)
      end if
   end subroutine solver_solve_once

   !> Steps of an iteration that take about half as long as a factorisation.
   integer function steps_worth_a_factor(self) result(steps)
      class(cholesky_or_lu_t), intent(in) :: self

      select type (backend => self%cholesky%backend)
      type is (cholmod_factor_t)
         steps = int(min(real(max_steps, dp), backend%operations()/(operations_per_entry*backend%entries())))
      class default
         steps = 0
      end select
   end function steps_worth_a_factor

   !> `A x = b` by the factor of what is near `A`; the first solution with it tells whether it is singular.
   subroutine solve_by_near_part(matrix, factor, b, x, converged, error)
      type(csr_matrix_t), intent(in), target :: matrix
      type(scaled_factor_t), intent(inout), target :: factor
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n)
      real(dp), intent(out) :: x(:)
      !> .false.: the matrices are too far from each other, `x` is not a solution
      logical, intent(out) :: converged
      type(error_t), allocatable, intent(out) :: error

      call factor%solve(b, x, error)
      if (allocated(error)) return
      call iterate(matrix, factor, b, accurate_residual, max_steps, x, converged, error)
   end subroutine solve_by_near_part

   !> `A x = b` by GMRES, which the factor of a matrix near `A` preconditions. Equations and unknowns are scaled as that
   !> is: forces and moments of soft and of stiff parts weigh the same.
   subroutine iterate(matrix, factor, b, accuracy, n_steps, x, converged, error)
      type(csr_matrix_t), intent(in), target :: matrix
      type(scaled_factor_t), intent(inout), target :: factor
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Residual over that of `x = 0` at which to stop
      real(dp), intent(in) :: accuracy
      !> Steps at most
      integer, intent(in) :: n_steps
      !> Solution (n)
      real(dp), intent(out) :: x(:)
      !> .false.: the matrices are too far from each other, `x` is not a solution
      logical, intent(out) :: converged
      type(error_t), allocatable, intent(out) :: error
      type(near_map_t) :: map

      map%matrix => matrix
      map%factor => factor
      call gmres(map, factor%row_scale*b, accuracy, n_steps, x, converged)
      if (allocated(map%error)) then
         call move_alloc(map%error, error)
         return
      end if
      x = factor%column_scale*x
   end subroutine iterate

   subroutine multiply(self, x, y)
      class(near_map_t), intent(inout) :: self
      !> (n)
      real(dp), intent(in) :: x(:)
      !> (n)
      real(dp), intent(out) :: y(:)

      y = 0
      call csr_add_product(self%matrix, 1.0_dp, self%factor%column_scale*x, y)
      y = self%factor%row_scale*y
   end subroutine multiply

   subroutine solve_near(self, x, y)
      class(near_map_t), intent(inout) :: self
      !> (n)
      real(dp), intent(in) :: x(:)
      !> (n)
      real(dp), intent(out) :: y(:)

      if (allocated(self%error)) then
         y = 0
         return
      end if
      call self%factor%solve_once(x/self%factor%row_scale, y, self%error)
      y = y/self%factor%column_scale
   end subroutine solve_near

   subroutine solver_release(self)
      class(cholesky_or_lu_t), intent(inout) :: self

      call self%cholesky%release()
      call self%lu%release()
   end subroutine solver_release

end module litz_cholesky_or_lu
