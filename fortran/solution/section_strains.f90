!> Strains and stresses that results show, from section forces at both nodes and at mid length.
!>
!> A fibre at the distance `rho` from the axis has the strain `N/EA + rho kappa`, `kappa` the change of the curvature
!> across it: at most the length of both components. Thermal strain is not in it.
module litz_section_strains
   use litz_kinds, only: dp, pi
   use litz_problem, only: problem_t
   implicit none
   private
   public :: find_section_strains

contains

   subroutine find_section_strains(problem)
      type(problem_t), intent(inout) :: problem
      real(dp) :: stretch(3), bend(3), radius
      integer :: e

      associate (state => problem%state, elements => problem%elements)
         do e = 1, problem%model%n_elements
            associate (c => elements%stiffness(:, e), mid => state%section_forces(:, e), &
               first => state%section_ends(:6, e), last => state%section_ends(7:, e), &
               found => state%section_strains(:, e))
               found(1) = mid(1)/c(1)
               found(2:4) = mid(4:6)/c(4:6)
               stretch = [first(1), mid(1), last(1)]/c(1)
               bend = [norm2(first(5:6)/c(5:6)), norm2(mid(5:6)/c(5:6)), norm2(last(5:6)/c(5:6))]
               radius = elements%radius(e)
               ! a section without a radius is taken as a circle of its area
               if (.not. radius > 0) radius = sqrt(elements%area(e)/pi)
               found(5) = maxval(stretch + radius*bend)
               found(6) = minval(stretch - radius*bend)
               found(7:8) = c(1)/elements%area(e)*found(5:6)
            end associate
         end do
      end associate
   end subroutine find_section_strains

end module litz_section_strains
