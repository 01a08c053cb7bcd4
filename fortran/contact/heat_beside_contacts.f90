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
      integer :: i, k

      associate (contacts => heat%contacts)
         call collect_strips(domain%model, domain%wires, domain%elements, places, &
            reshape([(contacts(i)%element, i=1, size(contacts))], [2, size(contacts)]), &
            reshape([(contacts(i)%xi, i=1, size(contacts))], [2, size(contacts)]), normal, is_line, strips)
      end associate
      heat%beside = both_of(strips, spots_of(heat%conductors%mutual))
      do k = 1, size(strips%shape)
         associate (a => strips%contacts(1, k), b => strips%contacts(2, k), shape => heat%beside%shape(k))
            shape = sign(min(abs(shape), sqrt(least_of(heat, strips, k, 1)*least_of(heat, strips, k, 2))), shape)
         end associate
      end do
   end subroutine find_heat_beside

   !> What resists the heat of one contact of a pair, times the heat conductivity [1/m]. A conductance that is given may
   !> be above that of any strip on such a wire: with no more than this, (1) of litz_heat_of_contacts has a solution.
   pure real(dp) function least_of(heat, strips, k, one) result(least)
      type(contact_heat_t), intent(in) :: heat
      type(mutual_resistances_t), intent(in) :: strips
      !> Pair, and which of its contacts
      integer, intent(in) :: k, one

      associate (i => strips%contacts(one, k), side => strips%sides(one, k))
         least = huge(1.0_dp)
         if (heat%contacts(i)%heat_shape(1) > 0) then
            least = sum(heat%contacts(i)%heat_shape)
         else if (heat%contacts(i)%is_passed) then
            least = heat%elements(heat%ends%place_of(side, i))%conductivity &
               *sum(1/heat%contacts(i)%path%conductance)
         end if
      end associate
   end function least_of

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
