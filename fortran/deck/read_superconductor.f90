!> *SUPERCONDUCTOR of a material.
module litz_read_superconductor
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_critical_law, only: superconductor_t, critical_table, critical_nb3sn, critical_nbti, n_parameters
   use litz_data_lines, only: read_line
   use litz_reader, only: reader_t, choice_of, fail_at, has_flag, parameter_of, real_parameter
   implicit none
   private
   public :: read_superconductor

contains

   !> Errors are reported; what is returned then does no harm.
   subroutine read_superconductor(self, card, material)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(superconductor_t), intent(out) :: material
      logical :: ok

      material%law = critical_table
      if (choice_of(self, card, 'LAW') == 'NB3SN') material%law = critical_nb3sn
      if (choice_of(self, card, 'LAW') == 'NBTI') material%law = critical_nbti
      material%exponent = real_parameter(self, card, 'N', 1.0_dp)
      material%criterion = real_parameter(self, card, 'EC', material%criterion)
      material%field = real_parameter(self, card, 'FIELD', 0.0_dp)
      material%strain = real_parameter(self, card, 'STRAIN', 0.0_dp)
      call read_fraction(self, card, material%fraction)
      if (material%law == critical_table) then
         call read_table(self, card, material)
         return
      end if
      allocate (material%parameters(n_parameters(material%law)), source=1.0_dp)
      ok = self%deck%cards(card)%last_data >= self%deck%cards(card)%first_data
      if (ok) call read_line(self, card, self%deck%cards(card)%first_data, ok)
      if (.not. ok) return
      material%parameters = self%values%real(:size(material%parameters))
      if (material%law == critical_nb3sn) call check_nb3sn(self, material%parameters)
   end subroutine read_superconductor

   !> FRACTION of the superconductor, or RATIO of normal metal to superconductor.
   subroutine read_fraction(self, card, fraction)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Between 0 and 1
      real(dp), intent(out) :: fraction

      fraction = 0.5_dp
      if (has_flag(self, card, 'FRACTION') .eqv. has_flag(self, card, 'RATIO')) then
         call fail_at(self, self%deck%cards(card)%name, '*SUPERCONDUCTOR needs either FRACTION, the part of the'// &
            ' cross-section that is superconductor, or RATIO, that of normal metal to superconductor')
      else if (has_flag(self, card, 'RATIO')) then
         fraction = 1/(1 + real_parameter(self, card, 'RATIO', 1.0_dp))
      else
         fraction = real_parameter(self, card, 'FRACTION', fraction)
         if (fraction < 1) return
         call fail_at(self, parameter_of(self, card, 'FRACTION'), 'FRACTION must be less than 1, as the metal of'// &
            ' *ELECTRICAL CONDUCTIVITY takes the rest of the cross-section; found '//to_text(fraction))
         fraction = 0.5_dp
      end if
   end subroutine read_fraction

   !> What the limits of the single values do not say.
   subroutine check_nb3sn(self, parameters)
      type(reader_t), intent(inout) :: self
      !> As of litz_critical_nb3sn (9)
      real(dp), intent(in) :: parameters(:)

      associate (ca1 => parameters(6), ca2 => parameters(7), e0 => parameters(8))
         if (ca2 >= ca1) then
            call fail_at(self, self%values%token(7), 'Ca2 must be less than Ca1; '//to_text(ca2)//' follows '// &
               to_text(ca1))
         else if (ca1*e0 >= 1) then
            call fail_at(self, self%values%token(8), 'Ca1 times e0 must be less than 1, it is '//to_text(ca1*e0)// &
               '; e0 is a strain, not in percent')
         end if
      end associate
   end subroutine check_nb3sn

   !> Lines of the density, temperature and flux density, in any order: one for each pair of the latter.
   subroutine read_table(self, card, material)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(superconductor_t), intent(inout) :: material
      real(dp), allocatable :: rows(:, :)
      logical, allocatable :: is_given(:, :)
      integer :: line, at_t, at_b, i
      logical :: ok

      allocate (rows(3, 0))
      material%temperature = [0.0_dp]
      material%flux_density = [0.0_dp]
      material%density = reshape([1.0_dp], [1, 1])
      associate (this => self%deck%cards(card), values => self%values)
         do line = this%first_data, this%last_data
            call read_line(self, card, line, ok)
            if (.not. ok) return
            if (this%last_data > this%first_data .and. .not. all(values%given(2:3))) then
               call fail_at(self, self%deck%line_token(line), 'every line of a table of critical current densities'// &
                  ' has three values: jc, T, B')
               return
            end if
            rows = reshape([rows, values%real(:3)], [3, size(rows, 2) + 1])
         end do
         if (size(rows, 2) == 0) return
         material%temperature = ascending(rows(2, :))
         material%flux_density = ascending(rows(3, :))
         deallocate (material%density)
         allocate (material%density(size(material%temperature), size(material%flux_density)), source=0.0_dp)
         allocate (is_given(size(material%temperature), size(material%flux_density)), source=.false.)
         do i = 1, size(rows, 2)
            at_t = count(material%temperature <= rows(2, i))
            at_b = count(material%flux_density <= rows(3, i))
            if (is_given(at_t, at_b)) call fail_at(self, self%deck%line_token(this%first_data + i - 1), &
               'there is another critical current density at T = '//to_text(rows(2, i))//' and B = '// &
               to_text(rows(3, i)))
            is_given(at_t, at_b) = .true.
            material%density(at_t, at_b) = rows(1, i)
         end do
         if (all(is_given)) return
         at_t = findloc(all(is_given, 2), .false., 1)
         at_b = findloc(is_given(at_t, :), .false., 1)
         call fail_at(self, this%name, 'the table has no critical current density at T = '// &
            to_text(material%temperature(at_t))//' and B = '//to_text(material%flux_density(at_b))// &
            ': it needs one for every temperature at every flux density')
      end associate
   end subroutine read_table

   !> The different values, ascending.
   pure function ascending(values) result(sorted)
      !> (n), one at least
      real(dp), intent(in) :: values(:)
      real(dp), allocatable :: sorted(:)

      sorted = [minval(values)]
      do while (any(values > sorted(size(sorted))))
         sorted = [sorted, minval(values, values > sorted(size(sorted)))]
      end do
   end function ascending

end module litz_read_superconductor
