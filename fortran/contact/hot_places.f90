!> Contacts that are hotter than what is known of their metals. Source: theory section 13.
module litz_hot_places
   use litz_contact_points, only: contact_point_t
   use litz_domain, only: domain_t
   use litz_heat_of_contacts, only: contact_heat_t
   use litz_kinds, only: dp
   use litz_text, only: to_text
   implicit none
   private
   public :: melted, beyond_table, beyond_table_inside

contains

   !> The hottest of these above the melting point of its metal; empty: none.
   function melted(domain, points) result(words)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: points(:)
      character(len=:), allocatable :: words
      real(dp) :: above, most
      integer :: i

      words = ''
      most = 0
      do i = 1, size(points)
         associate (law => domain%model%interactions(domain%model%contact_pairs(points(i)%pair)%interaction)%heat)
            if (.not. law%has_melting .or. law%may_melt) cycle
            above = points(i)%temperature_max - law%melting
            if (.not. above > most) cycle
            most = above
            words = 'the spot of elements '//to_text(domain%model%element_id(points(i)%element_bar))//' and '// &
               to_text(domain%model%element_id(points(i)%element))//' would be at '// &
               to_text(points(i)%temperature_max)//domain%model%units%after('K')//' and melt (TMELT='// &
               to_text(law%melting)//' of *GAP CONDUCTANCE; MELTING=WARN lets it)'
         end associate
      end do
   end function melted

   !> The wire that is farthest above the table of its resistivity where it touches another one, and a current passes;
   !> empty: none. As along the wires, a constant resistivity would hold temperatures steady that in truth run away.
   function beyond_table(domain, points) result(words)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: points(:)
      character(len=:), allocatable :: words
      real(dp) :: temperature(2), above, most
      integer :: element(2), i, side

      words = ''
      most = 0
      do i = 1, size(points)
         if (.not. points(i)%conductance > 0) cycle
         element = [points(i)%element_bar, points(i)%element]
         temperature = [points(i)%temperature_bar, points(i)%temperature]
         do side = 1, 2
            associate (model => domain%model)
               associate (table => model%materials(model%sections(model%element_section(element(side)))%material) &
                  %resistivity)
                  if (size(table, 2) == 1) cycle
                  above = temperature(side) - table(1, size(table, 2))
                  if (.not. above > most) cycle
                  most = above
                  words = 'the temperature in element '//to_text(model%element_id(element(side)))// &
                     ' where it touches element '//to_text(model%element_id(element(3 - side)))//' would be '// &
                     to_text(temperature(side))//model%units%after('K')// &
                     ', where the table of *ELECTRICAL CONDUCTIVITY ends at '//to_text(table(1, size(table, 2)))
               end associate
            end associate
         end do
      end do
   end function beyond_table

   !> The same of the insides of spots that their current warms.
   function beyond_table_inside(domain, heat) result(words)
      type(domain_t), intent(in) :: domain
      type(contact_heat_t), intent(in) :: heat
      character(len=:), allocatable :: words
      real(dp) :: above, most
      integer :: i, side

      words = ''
      most = 0
      do i = 1, size(heat%resistance)
         if (.not. heat%contacts(i)%is_hot) cycle
         do side = 1, 2
            associate (table => heat%metals(heat%contacts(i)%material(side))%resistivity, &
               hottest => heat%hot_spots(i)%hottest(side), element => heat%contacts(i)%element)
               if (size(table, 2) == 1) cycle
               above = hottest - table(1, size(table, 2))
               if (.not. above > most) cycle
               most = above
               words = 'the spot of elements '//to_text(domain%model%element_id(element(1)))//' and '// &
                  to_text(domain%model%element_id(element(2)))//' would be at '//to_text(hottest)// &
                  domain%model%units%after('K')//', where the table of *ELECTRICAL CONDUCTIVITY ends at '// &
                  to_text(table(1, size(table, 2)))
            end associate
         end do
      end do
   end function beyond_table_inside

end module litz_hot_places
