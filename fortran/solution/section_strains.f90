!> Strains and stresses that results show, from section forces at both nodes and at mid length.
!>
!> A fibre at the place `y` from the centroid has the strain `N/EA + kappa2 y3 - kappa3 y2`, `kappa` the change of the
!> curvature: at the radius of a round section at most its length. Thermal strain is not in it.
module litz_section_strains
   use litz_kinds, only: dp, pi
   use litz_beam_axes, only: along_principal_axes, along_section_axes
   use litz_problem, only: problem_t
   implicit none
   private
   public :: find_section_strains

contains

   subroutine find_section_strains(problem)
      type(problem_t), intent(inout) :: problem
      real(dp) :: strain(6, 3), fibres(2, 3)
      integer :: e, place

      associate (state => problem%state, elements => problem%elements)
         do e = 1, problem%model%n_elements
            strain = reshape([state%section_ends(:6, e), state%section_forces(:, e), state%section_ends(7:, e)], [6, 3])
            do place = 1, 3
               associate (axes => elements%axes(e))
                  strain(:, place) = along_section_axes(axes, along_principal_axes(axes, strain(:, place)) &
                     /elements%stiffness(:, e))
               end associate
               fibres(:, place) = strain(1, place) + extreme_bends(strain(5:6, place), e)
            end do
            associate (found => state%section_strains(:, e))
               found(1) = strain(1, 2)
               found(2:4) = strain(4:6, 2)
               found(5) = maxval(fibres(1, :))
               found(6) = minval(fibres(2, :))
               found(7:8) = elements%stiffness(1, e)/elements%area(e)*found(5:6)
            end associate
         end do
      end associate

   contains

      !> Largest and smallest strain of the fibres of a section by its curvatures (2).
      pure function extreme_bends(curvature, e) result(bends)
         !> About the first and the second axis (2) [1/m]
         real(dp), intent(in) :: curvature(2)
         !> Index of the element
         integer, intent(in) :: e
         real(dp) :: bends(2), radius

         associate (section => problem%model%sections(problem%model%element_section(e)))
            ! its corners lie farthest out
            if (allocated(section%corners)) then
               associate (at_corners => matmul([-curvature(2), curvature(1)], section%corners))
                  bends = [maxval(at_corners), minval(at_corners)]
               end associate
               return
            end if
            radius = problem%elements%radius(e)
            if (section%outer_radius > 0) radius = max(radius, section%outer_radius)
            ! a section without a radius is taken as a circle of its area
            if (.not. radius > 0) radius = sqrt(problem%elements%area(e)/pi)
            bends = radius*norm2(curvature)*[1, -1]
         end associate
      end function extreme_bends

   end subroutine find_section_strains

end module litz_section_strains
