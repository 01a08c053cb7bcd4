!> What the heat of strips and spots does to the temperatures of others beside them on one wire, as their currents do to
!> the potentials there.
!>
!> Strips are those of all contacts through which heat passes, spots those of currents whose law asks for others.
!> Source: theory sections 10 and 13.
module litz_heat_beside_contacts
   use litz_contact_points, only: contact_point_t
   use litz_domain, only: domain_t
   use litz_heat_of_contacts, only: contact_heat_t
   use litz_heated_contacts, only: heated_contact_t
   use litz_kinds, only: dp
   use litz_line_places, only: line_places_t
   use litz_mutual_resistances, only: mutual_resistances_t, both_of, spots_of
   use litz_strips_of_wires, only: collect_strips
   implicit none
   private
   public :: find_heat_beside, normals_of

contains

   !> M of all contacts.
   subroutine find_heat_beside(domain, places, normal, is_line, heat)
      type(domain_t), intent(in) :: domain
      type(line_places_t), intent(in) :: places
      !> From the unbarred to the barred wire (3, contacts)
      real(dp), intent(in) :: normal(:, :)
      !> The contact is a point of a line (contacts)
      logical, intent(in) :: is_line(:)
      !> With its elements
      type(contact_heat_t), intent(inout) :: heat
      type(mutual_resistances_t) :: strips
      integer :: i

      associate (contacts => heat%contacts)
         call collect_strips(domain%model, domain%wires, domain%elements, places, &
            reshape([(contacts(i)%element, i=1, size(contacts))], [2, size(contacts)]), &
            reshape([(contacts(i)%xi, i=1, size(contacts))], [2, size(contacts)]), normal, is_line, &
            reshape([(own_of(heat, i), i=1, size(contacts))], [2, size(contacts)]), strips)
      end associate
      heat%beside = both_of(strips, spots_of(heat%conductors%mutual))
   end subroutine find_heat_beside

   !> What resists the heat of a contact in either wire, times its heat conductivity [1/m]; 0: no heat passes.
   pure function own_of(heat, i) result(own)
      type(contact_heat_t), intent(in) :: heat
      !> Contact
      integer, intent(in) :: i
      real(dp) :: own(2)

      associate (contact => heat%contacts(i))
         own = contact%heat_shape
         if (contact%is_passed .and. .not. contact%heat_shape(1) > 0) own = &
            heat%elements(heat%ends%place_of(:, i))%conductivity/contact%path%conductance
      end associate
   end function own_of

   !> From the unbarred to the barred wire, contact after contact.
   pure function normals_of(points, members) result(normals)
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (n)
      integer, intent(in) :: members(:)
      real(dp) :: normals(3*size(members))
      integer :: i

      normals = [(points(members(i))%kinematics%normal, i=1, size(members))]
   end function normals_of

end module litz_heat_beside_contacts
