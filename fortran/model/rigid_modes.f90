!> Which rigid motions a set of supports leaves to a body, and their description in messages.
module litz_rigid_modes
   use litz_kinds, only: dp
   use litz_rotations, only: cross
   use litz_symmetric_matrices, only: dsyev
   use litz_text, only: to_text
   implicit none
   private
   public :: add_support, support_row, free_modes, describe_modes

   !> Supports restrain a motion when its eigenvalue is larger than this part of the largest
   real(dp), parameter :: rank_tolerance = 1.0e-10_dp
   !> Components of a direction smaller than this are round-off
   real(dp), parameter :: direction_tolerance = 1.0e-5_dp

contains

   !> Add a condition `c . (t, L theta) = 0` on the translation `t` and the rotation `theta` of the body to the matrix
   !> of supports, `sum of c c^T`.
   pure subroutine add_support(matrix, c)
      !> Matrix of supports (6, 6) in `(t, L theta)` [-]
      real(dp), intent(inout) :: matrix(6, 6)
      !> Condition (6)
      real(dp), intent(in) :: c(6)

      matrix = matrix + spread(c, 2, 6)*spread(c, 1, 6)
   end subroutine add_support

   !> A degree of freedom of a node as `c . (t, L theta)`.
   pure function support_row(dof, arm) result(c)
      !> 1-3 displacement, 4-6 rotation
      integer, intent(in) :: dof
      !> Position of the node from the centre of the body, over its size L [-]
      real(dp), intent(in) :: arm(3)
      real(dp) :: c(6)
      real(dp) :: axis(3)

      c = 0
      c(dof) = 1
      if (dof <= 3) then
         axis = 0
         axis(dof) = 1
         ! u_i = t_i + (theta x r) . e_i = t_i + theta . (r x e_i)
         c(4:6) = cross(arm, axis)
      end if
   end function support_row

   !> Basis of the motions that no support restrains.
   pure subroutine free_modes(matrix, n, modes)
      !> Matrix of supports (6, 6), see add_support
      real(dp), intent(in) :: matrix(6, 6)
      !> Number of motions that nothing restrains, 0 to 6
      integer, intent(out) :: n
      !> Columns: t, L theta; the first `n` are set
      real(dp), intent(out) :: modes(6, 6)
      real(dp) :: eigenvalues(6), work(64)
      integer :: info

      modes = matrix
      call dsyev('V', 'U', 6, modes, 6, eigenvalues, work, size(work), info)
      n = count(eigenvalues <= rank_tolerance*max(1.0_dp, eigenvalues(6)))
      if (info /= 0) n = 0
      call simplify(modes(:, :n))
   end subroutine free_modes

   !> Gauss-Jordan elimination, rotations first, so that the basis has as many pure translations as there are, and
   !> motions along and about single axes where that is possible.
   pure subroutine simplify(modes)
      !> Basis (6, n): columns `t, L theta`
      real(dp), intent(inout) :: modes(:, :)
      integer, parameter :: order(6) = [4, 5, 6, 1, 2, 3]
      real(dp) :: column(6)
      integer :: k, row, done, best, j

      done = 0
      do k = 1, 6
         row = order(k)
         if (done == size(modes, 2)) exit
         best = done + maxloc(abs(modes(row, done + 1:)), 1)
         if (abs(modes(row, best)) < direction_tolerance) cycle
         done = done + 1
         column = modes(:, best)/modes(row, best)
         modes(:, best) = modes(:, done)
         modes(:, done) = column
         do j = 1, size(modes, 2)
            if (j /= done) modes(:, j) = modes(:, j) - modes(row, j)*column
         end do
      end do
   end subroutine simplify

   !> `translation along x, rotation about the x direction through (0, 0, 0)`
   pure function describe_modes(n, modes, centre, length) result(words)
      !> Number of motions
      integer, intent(in) :: n
      !> Their directions (6, 6): the first `n` columns `t, L theta`
      real(dp), intent(in) :: modes(6, 6)
      !> Centre [m] and size [m] of the body
      real(dp), intent(in) :: centre(3), length
      character(len=:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, n
         if (i > 1) words = words//', '
         words = words//describe_mode(modes(1:3, i), modes(4:6, i)/length, centre, length)
      end do
   end function describe_modes

   pure function describe_mode(translation, rotation, centre, length) result(words)
      !> Translation of the centre (3), of any length
      real(dp), intent(in) :: translation(3)
      !> Rotation (3) that belongs to it, in its unit over [m]
      real(dp), intent(in) :: rotation(3)
      !> Centre of the body [m]
      real(dp), intent(in) :: centre(3)
      !> Size of the body [m]
      real(dp), intent(in) :: length
      character(len=:), allocatable :: words
      real(dp) :: point(3), axis(3), advance

      if (norm2(rotation)*length <= direction_tolerance*norm2(translation)) then
         words = 'translation along '//describe_direction(translation/norm2(translation))
         return
      end if
      axis = rotation/norm2(rotation)
      ! the point that does not move: t + theta x r = 0 across the axis
      point = centre + cross(axis, translation)/norm2(rotation)
      where (abs(point) < direction_tolerance*length) point = 0
      words = 'rotation about '//describe_direction(axis)//' through ('//to_text(point(1))//', '//to_text(point(2))// &
         ', '// &
         to_text(point(3))//')'
      advance = dot_product(axis, translation)
      if (abs(advance) > direction_tolerance*norm2(rotation)*length) words = words//' with translation along it'
   end function describe_mode

   pure function describe_direction(direction) result(words)
      !> Unit vector (3)
      real(dp), intent(in) :: direction(3)
      character(len=:), allocatable :: words
      character(len=1), parameter :: names(3) = ['x', 'y', 'z']
      real(dp) :: d(3)

      if (maxval(abs(direction)) > 1 - direction_tolerance**2) then
         words = names(maxloc(abs(direction), 1))
      else
         d = direction
         where (abs(d) < direction_tolerance) d = 0
         words = 'the direction ('//to_text(d(1))//', '//to_text(d(2))//', '//to_text(d(3))//')'
      end if
   end function describe_direction

end module litz_rigid_modes
