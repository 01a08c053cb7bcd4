!> Fill-reducing order of a matrix: along the wires, then the joints in the better order of METIS and AMD.
!>
!> Source: G. Karypis, V. Kumar, SIAM J. Sci. Comput. 20 (1998) 359 (METIS); P. R. Amestoy, T. A. Davis, I. S. Duff,
!> SIAM J. Matrix Anal. Appl. 17 (1996) 886 (AMD).
module litz_elimination_order
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   use litz_errors, only: error_t, fail, exit_solver
   use litz_joint_order, only: joint_graph_t, find_joints, joints_last
   use litz_linear_solver, only: csr_matrix_t
   use litz_text, only: to_text
   implicit none
   private
   public :: find_elimination_order

   interface
      function cholmod_shim_order(n, start, row, order) bind(c) result(status)
         import :: c_int64_t, c_int
         implicit none
         !> Number of equations
         integer(c_int64_t), value :: n
         !> Place of the first entry of each column and one past the last (n + 1), from 0
         integer(c_int64_t), intent(in) :: start(*)
         !> Row of each entry, from 0
         integer(c_int64_t), intent(in) :: row(*)
         !> Equation that is eliminated first, second, ... (n), from 0
         integer(c_int64_t), intent(out) :: order(*)
         integer(c_int) :: status
      end function cholmod_shim_order
   end interface

contains

   subroutine find_elimination_order(matrix, order, error)
      !> Structurally symmetric but for blocks that are zero
      type(csr_matrix_t), intent(in) :: matrix
      !> Equation that is eliminated first, second, ... (n), from 0
      integer(c_int64_t), allocatable, intent(out) :: order(:)
      !> There is not enough memory
      type(error_t), allocatable, intent(out) :: error
      type(joint_graph_t) :: graph
      integer(c_int64_t), allocatable :: joint_order(:)
      integer(c_int) :: status

      status = 0
      graph = find_joints(matrix)
      allocate (joint_order(size(graph%joints)))
      if (size(joint_order) > 0) status = cholmod_shim_order(size(joint_order, kind=c_int64_t), &
         int(graph%edges%row_start, c_int64_t) - 1, int(graph%edges%column, c_int64_t) - 1, joint_order)
      if (status == 0) then
         order = int(joints_last(graph, int(joint_order) + 1), c_int64_t) - 1
      else
         error = fail(exit_solver, 'CHOLMOD: no order of elimination for '//to_text(matrix%n_rows)// &
            ' equations, status '//to_text(int(status)))
      end if
   end subroutine find_elimination_order

end module litz_elimination_order
