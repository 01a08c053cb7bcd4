!> The places at which contacts lie in elements, element by element in order along them.
module litz_element_ends
   use litz_kinds, only: dp
   use litz_parallel, only: worth_threads
   use litz_potential_rise, only: potential_rise
   implicit none
   private
   public :: element_ends_t, collect_ends, rise_at_ends

   type :: element_ends_t
      !> Elements that have any (n_elements)
      integer, allocatable :: element(:)
      !> First end on each of these (n_elements + 1); contact and side (1: barred) of each end, in order along its
      !> element
      integer, allocatable :: first(:), contact(:), side(:)
      !> Place of each end, in [-1, 1]
      real(dp), allocatable :: xi(:)
      !> Which of the elements each contact is on (2, contacts), barred first
      integer, allocatable :: place_of(:, :)
   end type element_ends_t

contains

   pure subroutine collect_ends(elements, xi, ends)
      !> Elements of each contact (2, contacts), barred first
      integer, intent(in) :: elements(:, :)
      !> Places in them (2, contacts)
      real(dp), intent(in) :: xi(:, :)
      type(element_ends_t), intent(out) :: ends
      integer, allocatable :: number_of(:), free(:)
      integer :: i, n, k, side, n_elements

      n = size(elements, 2)
      allocate (number_of(maxval([0, elements])), source=0)
      allocate (ends%element(2*n), ends%place_of(2, n))
      n_elements = 0
      do i = 1, n
         do side = 1, 2
            associate (e => elements(side, i))
               if (number_of(e) == 0) then
                  n_elements = n_elements + 1
                  number_of(e) = n_elements
                  ends%element(n_elements) = e
               end if
               ends%place_of(side, i) = number_of(e)
            end associate
         end do
      end do
      ends%element = ends%element(:n_elements)
      allocate (ends%contact(2*n), ends%side(2*n), ends%xi(2*n))
      allocate (ends%first(n_elements + 1), source=0)
      do i = 1, n
         ends%first(ends%place_of(:, i) + 1) = ends%first(ends%place_of(:, i) + 1) + 1
      end do
      ends%first(1) = 1
      do k = 1, n_elements
         ends%first(k + 1) = ends%first(k) + ends%first(k + 1)
      end do
      free = ends%first(:n_elements)
      do i = 1, n
         do side = 1, 2
            k = ends%place_of(side, i)
            call insert(ends, ends%first(k), free(k), i, side, xi(side, i))
            free(k) = free(k) + 1
         end do
      end do
   end subroutine collect_ends

   !> Put an end behind those of its element that lie before it.
   pure subroutine insert(ends, first, free, contact, side, xi)
      type(element_ends_t), intent(inout) :: ends
      !> First end of the element, the first free place, and the contact and side of the end (1: barred)
      integer, intent(in) :: first, free, contact, side
      !> Place of the end in its element, in [-1, 1]
      real(dp), intent(in) :: xi
      integer :: k

      k = free
      do while (k > first)
         if (ends%xi(k - 1) <= xi) exit
         ends%xi(k) = ends%xi(k - 1)
         ends%contact(k) = ends%contact(k - 1)
         ends%side(k) = ends%side(k - 1)
         k = k - 1
      end do
      ends%xi(k) = xi
      ends%contact(k) = contact
      ends%side(k) = side
   end subroutine insert

   !> How what enters the elements at the ends raises the potential or the temperature there, above the linear one.
   subroutine rise_at_ends(ends, scale, entering, rise, film)
      type(element_ends_t), intent(in) :: ends
      !> rho L0/(4 A) of each element that has ends, or L0/(4 lambda A) (elements) [ohm], [K/W]
      real(dp), intent(in) :: scale(:)
      !> (ends) [A], [W]
      real(dp), intent(in) :: entering(:)
      !> On the barred and on the unbarred wire (2, contacts) [V], [K]
      real(dp), intent(out) :: rise(:, :)
      !> w^2 of (13.3) of each element, whose film takes a part between the nodes (elements); absent: none does
      real(dp), intent(in), optional :: film(:)
      real(dp) :: above(size(entering)), w2(size(scale))
      integer :: k, i

      w2 = 0
      if (present(film)) w2 = film
      !$omp parallel do schedule(static) if (size(scale) >= worth_threads)
      do k = 1, size(scale)
         call potential_rise(scale(k), w2(k), ends%xi(ends%first(k):ends%first(k + 1) - 1), &
            entering(ends%first(k):ends%first(k + 1) - 1), above(ends%first(k):ends%first(k + 1) - 1))
      end do
      !$omp end parallel do
      do i = 1, size(above)
         rise(ends%side(i), ends%contact(i)) = above(i)
      end do
   end subroutine rise_at_ends

end module litz_element_ends
