!> The hottest places of spots in steps that do not solve for temperatures: those of their voltages.
!>
!> What a current does to a spot is a matter of its voltage and of the temperatures beside it (Kohlrausch), whether
!> these are solved for or given. Source: theory section 13.
module litz_spots_of_given_temperatures
   use litz_kinds, only: dp
   use litz_contact_forces, only: conducts_apart
   use litz_contact_points, only: contact_point_t
   use litz_domain, only: domain_t
   use litz_heated_contacts, only: heated_contact_t, heated_contact, can_pass_heat, conducting_metals
   use litz_passed_spots, only: passed_spot_t, cold_spot
   use litz_spot_metal, only: spot_metal_t
   implicit none
   private
   public :: find_hottest

contains

   !> Of contacts that pass a current, between wires that conduct heat.
   subroutine find_hottest(domain, points)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(inout) :: points(:)
      type(spot_metal_t), allocatable :: metals(:)
      integer :: i

      allocate (metals, source=conducting_metals(domain%model))
      do i = 1, size(points)
         if (.not. (points(i)%closed .or. conducts_apart(points(i)))) cycle
         if (.not. abs(points(i)%current) > 0) cycle
         if (can_pass_heat(domain, points(i))) call heat_spot(domain, metals, points(i))
      end do
   end subroutine find_hottest

   subroutine heat_spot(domain, metals, point)
      type(domain_t), intent(in) :: domain
      !> Those of the model
      type(spot_metal_t), intent(in) :: metals(:)
      type(contact_point_t), intent(inout) :: point
      type(heated_contact_t) :: contact
      type(passed_spot_t) :: spot
      real(dp) :: beside(2)
      logical :: ok

      contact = heated_contact(domain, point, 0.0_dp)
      beside = [point%temperature_bar, point%temperature]
      associate (zero => domain%model%absolute_zero)
         if (contact%is_metal .and. any(beside <= zero)) return
         call contact%warm(metals, beside, zero)
         call cold_spot(contact, beside - zero, point%current, spot, ok)
         if (ok) point%temperature_max = spot%hottest + zero
      end associate
   end subroutine heat_spot

end module litz_spots_of_given_temperatures
