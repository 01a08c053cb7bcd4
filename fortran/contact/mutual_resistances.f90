!> What the current of one contact adds to the voltage of another one through a wire that both touch, and what its heat
!> adds to the temperature there.
!>
!> Source: theory section 10. Strips side by side on a wire (strips_of_wires) and spots near each other
!> (spots_beside_spots) are such contacts.
module litz_mutual_resistances
   use litz_kinds, only: dp
   implicit none
   private
   public :: mutual_resistances_t, both_of, spots_of

   type :: mutual_resistances_t
      !> Pairs of contacts (2, n); which of its wires each shares with the other one (2, n), 1: the barred one; and the
      !> voltage of either that a current of the other one adds (n) [ohm]
      integer, allocatable :: contacts(:, :), sides(:, :)
      real(dp), allocatable :: resistance(:)
      !> Voltage over resistivity and current that enters, or temperature times heat conductivity over heat that
      !> enters (n) [1/m]
      real(dp), allocatable :: shape(:)
      !> Nodes of the elements in which the metal is that resists, and how the resistance changes with their
      !> temperatures (4, n) [ohm/K]
      integer, allocatable :: nodes(:, :)
      real(dp), allocatable :: by_temperature(:, :)
      !> The contacts are spots, not strips beside each other (n)
      logical, allocatable :: is_spot(:)
   contains
      procedure :: rises
      procedure :: voltages
      procedure :: voltages_in_wires
      procedure :: warmed_voltages
   end type mutual_resistances_t

contains

   !> Those of two lists.
   pure type(mutual_resistances_t) function both_of(a, b) result(both)
      type(mutual_resistances_t), intent(in) :: a, b
      integer :: n

      n = size(a%resistance)
      allocate (both%contacts(2, n + size(b%resistance)), both%sides(2, n + size(b%resistance)), &
         both%nodes(4, n + size(b%resistance)), both%by_temperature(4, n + size(b%resistance)))
      both%sides(:, :n) = a%sides
      both%sides(:, n + 1:) = b%sides
      both%contacts(:, :n) = a%contacts
      both%contacts(:, n + 1:) = b%contacts
      both%nodes(:, :n) = a%nodes
      both%nodes(:, n + 1:) = b%nodes
      both%by_temperature(:, :n) = a%by_temperature
      both%by_temperature(:, n + 1:) = b%by_temperature
      allocate (both%resistance, source=[a%resistance, b%resistance])
      allocate (both%shape, source=[a%shape, b%shape])
      allocate (both%is_spot, source=[a%is_spot, b%is_spot])
   end function both_of

   !> Those of spots.
   pure type(mutual_resistances_t) function spots_of(all) result(spots)
      type(mutual_resistances_t), intent(in) :: all
      integer, allocatable :: members(:)
      integer :: k

      members = pack([(k, k=1, size(all%is_spot))], all%is_spot)
      spots%contacts = all%contacts(:, members)
      spots%sides = all%sides(:, members)
      spots%nodes = all%nodes(:, members)
      spots%by_temperature = all%by_temperature(:, members)
      spots%resistance = all%resistance(members)
      spots%shape = all%shape(members)
      spots%is_spot = all%is_spot(members)
   end function spots_of

   !> What heat that enters the wires at other contacts adds to the temperature at each, times the heat conductivity
   !> (2, n) [W/m].
   pure function rises(self, heat)
      class(mutual_resistances_t), intent(in) :: self
      !> Into the barred and the unbarred wire (2, n) [W]
      real(dp), intent(in) :: heat(:, :)
      real(dp) :: rises(2, size(heat, 2))
      integer :: k

      rises = 0
      do k = 1, size(self%shape)
         associate (a => self%contacts(1, k), b => self%contacts(2, k), of_a => self%sides(1, k), &
            of_b => self%sides(2, k))
            rises(of_a, a) = rises(of_a, a) + self%shape(k)*heat(of_b, b)
            rises(of_b, b) = rises(of_b, b) + self%shape(k)*heat(of_a, a)
         end associate
      end do
   end function rises

   !> What the currents of other contacts add to the voltage of each (n) [V].
   pure function voltages(self, current)
      class(mutual_resistances_t), intent(in) :: self
      !> From the barred to the unbarred wire (n) [A]
      real(dp), intent(in) :: current(:)
      real(dp) :: voltages(size(current))
      integer :: k

      voltages = 0
      do k = 1, size(self%resistance)
         associate (a => self%contacts(1, k), b => self%contacts(2, k))
            voltages(a) = voltages(a) + self%resistance(k)*current(b)
            voltages(b) = voltages(b) + self%resistance(k)*current(a)
         end associate
      end do
   end function voltages

   !> The same by the wire in which they are, barred first (2, n) [V].
   pure function voltages_in_wires(self, current) result(voltages)
      class(mutual_resistances_t), intent(in) :: self
      !> From the barred to the unbarred wire (n) [A]
      real(dp), intent(in) :: current(:)
      real(dp) :: voltages(2, size(current))

      voltages = voltages_by(self, self%resistance, current)
   end function voltages_in_wires

   !> How these change as the metal gets warmer at the same currents (2, n) [V].
   pure function warmed_voltages(self, current, temperature) result(voltages)
      class(mutual_resistances_t), intent(in) :: self
      !> From the barred to the unbarred wire (n) [A], and changes of the temperatures of the nodes (n_nodes) [K]
      real(dp), intent(in) :: current(:), temperature(:)
      real(dp) :: voltages(2, size(current))
      integer :: k

      voltages = voltages_by(self, [(dot_product(self%by_temperature(:, k), temperature(self%nodes(:, k))), &
         k=1, size(self%resistance))], current)
   end function warmed_voltages

   pure function voltages_by(self, resistance, current) result(voltages)
      type(mutual_resistances_t), intent(in) :: self
      !> Of the pairs (n) [ohm], and from the barred to the unbarred wire (n) [A]
      real(dp), intent(in) :: resistance(:), current(:)
      real(dp) :: voltages(2, size(current))
      integer :: k

      voltages = 0
      do k = 1, size(resistance)
         associate (a => self%contacts(1, k), b => self%contacts(2, k), of_a => self%sides(1, k), &
            of_b => self%sides(2, k))
            voltages(of_a, a) = voltages(of_a, a) + resistance(k)*current(b)
            voltages(of_b, b) = voltages(of_b, b) + resistance(k)*current(a)
         end associate
      end do
   end function voltages_by

end module litz_mutual_resistances
