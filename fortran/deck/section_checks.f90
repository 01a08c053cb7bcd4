!> Checks of the dimensions of cross-sections, of which a data line was read last.
module litz_section_checks
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_reader, only: reader_t, fail_at
   implicit none
   private
   public :: check_second_moments, check_warping, check_walls, check_flanges, check_legs, is_same

contains

   !> Second moments are those of some area, and no section twists harder than its polar moment says, I11 + I22, the
   !> value of a circle.
   !> Source: Timoshenko and Goodier, Theory of Elasticity, 3rd edition, section 105: warping makes it softer.
   subroutine check_second_moments(self, ok)
      type(reader_t), intent(inout) :: self
      !> .false.: something was reported
      logical, intent(out) :: ok
      real(dp) :: largest

      associate (given => self%values%real)
         ok = given(3)**2 < given(2)*given(4)
         if (.not. ok) then
            call fail_at(self, self%values%token(3), 'no section has the product of inertia I12 = '// &
               to_text(given(3))//' with these second moments: its size is below the root of I11 I22, '// &
               to_text(sqrt(given(2)*given(4))))
            return
         end if
         largest = given(2) + given(4)
         ! values of tables are rounded
         ok = given(5) <= largest*1.01_dp
         if (.not. ok) call fail_at(self, self%values%token(5), 'no section has the torsion constant J = '// &
            to_text(given(5))//' with these second moments: it is at most I11 + I22 = '//to_text(largest)// &
            '; the fifth value of CalculiX, for its elements U1, is a shear factor')
      end associate
   end subroutine check_second_moments

   !> What Abaqus has behind J for open sections: litz has no warping.
   subroutine check_warping(self, ok)
      type(reader_t), intent(inout) :: self
      !> .false.: something was reported
      logical, intent(out) :: ok

      associate (given => self%values%real, token => self%values%token)
         ok = .not. any(abs(given(6:7)) > 0)
         if (.not. ok) call fail_at(self, token(merge(6, 7, abs(given(6)) > 0)), 'litz has no warping of sections:'// &
            ' its constants behind J must be 0 or left out; torsion is that of St Venant')
      end associate
   end subroutine check_warping

   !> Walls of a box: room between them.
   subroutine check_walls(self, ok)
      type(reader_t), intent(inout) :: self
      !> .false.: something was reported
      logical, intent(out) :: ok

      associate (given => self%values%real)
         ok = given(3) + given(5) < given(1) .and. given(4) + given(6) < given(2)
         if (.not. ok) call fail_at(self, self%values%token(3), 'the walls of the box leave no room between them:'// &
            ' t1 + t3 must be smaller than a, t2 + t4 smaller than b')
      end associate
   end subroutine check_walls

   !> Flanges of an I: alike, so that its shear centre is in the middle.
   subroutine check_flanges(self, ok)
      type(reader_t), intent(inout) :: self
      !> .false.: something was reported
      logical, intent(out) :: ok

      associate (given => self%values%real, token => self%values%token)
         ok = is_same(given(3), given(4)) .and. is_same(given(5), given(6))
         if (.not. ok) then
            call fail_at(self, token(3), 'both flanges of an I must be alike, b1 = b2 and t1 = t2: otherwise its'// &
               ' shear'// &
               ' centre is beside its centroid')
            return
         end if
         ok = 2*given(5) < given(2) .and. given(7) <= given(3)
         if (.not. ok) call fail_at(self, token(5), 'the flanges of the I leave no room for its web: 2 t1 must be'// &
            ' smaller than h, and t3 not larger than b1')
      end associate
   end subroutine check_flanges

   !> Legs of an L: longer than thick.
   subroutine check_legs(self, ok)
      type(reader_t), intent(inout) :: self
      !> .false.: something was reported
      logical, intent(out) :: ok

      associate (given => self%values%real)
         ok = given(4) < given(1) .and. given(3) < given(2)
         if (.not. ok) call fail_at(self, self%values%token(3), 'the legs of the L are no longer than the other'// &
            ' one is'// &
            ' thick: t2 must be smaller than a, t1 smaller than b')
      end associate
   end subroutine check_legs

   !> Equal but for the digits that a deck leaves out.
   pure logical function is_same(a, b)
      !> Lengths [m]
      real(dp), intent(in) :: a, b

      is_same = abs(a - b) <= 1.0e-6_dp*max(a, b)
   end function is_same

end module litz_section_checks
