!> Strains and stresses that results show, from section forces at both nodes and at mid length.
!>
!> A fibre at the distance `rho` from the axis has the strain `N/EA + rho kappa`, `kappa` the change of the curvature
!> across it: at most the length of both components, and at a corner the sum of both. Thermal strain is not in it.
module litz_section_strains
   use litz_kinds, only: dp, pi
   use litz_problem, only: problem_t
   implicit none
   private
   public :: find_section_strains

contains

   subroutine find_section_strains(problem)
      type(problem_t), intent(inout) :: problem
      real(dp) :: stretch(3), bend(3)
      integer :: e

      associate (state => problem%state, elements => problem%elements)
         do e = 1, problem%model%n_elements
            associate (c => elements%stiffness(:, e), mid => state%section_forces(:, e), &
               first => state%section_ends(:6, e), last => state%section_ends(7:, e), &
               found => state%section_strains(:, e))
               found(1) = mid(1)/c(1)
               found(2:4) = mid(4:6)/c(4:6)
               stretch = [first(1), mid(1), last(1)]/c(1)
               bend = [largest_bend(first(5:6)/c(5:6), e), largest_bend(mid(5:6)/c(5:6), e), &
                  largest_bend(last(5:6)/c(5:6), e)]
               found(5) = maxval(stretch + bend)
               found(6) = minval(stretch - bend)
               found(7:8) = c(1)/elements%area(e)*found(5:6)
            end associate
         end do
      end associate

   contains

      !> Of all fibres of the section.
      pure real(dp) function largest_bend(curvature, e)
         !> About the first and the second axis (2) [1/m]
         real(dp), intent(in) :: curvature(2)
         !> Index of the element
         integer, intent(in) :: e
         real(dp) :: radius

         associate (section => problem%model%sections(problem%model%element_section(e)))
            radius = problem%elements%radius(e)
            if (section%outer_radius > 0) radius = max(radius, section%outer_radius)
            ! a section without a radius is taken as a circle of its area
            if (.not. radius > 0) radius = sqrt(problem%elements%area(e)/pi)
            largest_bend = radius*norm2(curvature)
            ! its corners lie farthest out
            if (any(section%corner > 0)) largest_bend = dot_product(section%corner([2, 1]), abs(curvature))
         end associate
      end function largest_bend

   end subroutine find_section_strains

end module litz_section_strains
