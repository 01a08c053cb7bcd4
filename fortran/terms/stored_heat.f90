!> Heat that wires store, as the change of temperature that it would make by the specific heat alone.
!>
!> While a wire melts or freezes its temperature hardly changes, however much heat enters it: that it is not steady, and
!> how exact an increment is, the heat tells. What is amiss of it becomes an error of the temperature behind the change
!> of phase. Source: theory section 13.
module litz_stored_heat
   use litz_kinds, only: dp
   use litz_heat_capacity, only: latent_heat_t, enthalpy_difference
   use litz_model, only: model_t
   use litz_property_table, only: property_at
   implicit none
   private
   public :: storing_elements, latent_heats, changes_by_heat

contains

   !> Elements that store heat in steps over time.
   pure function storing_elements(model) result(elements)
      type(model_t), intent(in) :: model
      integer, allocatable :: elements(:)
      integer :: e

      elements = pack([(e, e=1, model%n_elements)], [(stores_heat(model, e), e=1, model%n_elements)])
   end function storing_elements

   pure logical function stores_heat(model, e)
      type(model_t), intent(in) :: model
      !> Element
      integer, intent(in) :: e

      associate (wire => model%materials(model%sections(model%element_section(e))%material))
         stores_heat = allocated(wire%heat_conductivity) .and. allocated(wire%specific_heat) .and. wire%density > 0
      end associate
   end function stores_heat

   !> Changes of phase of a material.
   pure function latent_heats(model, material) result(latent)
      type(model_t), intent(in) :: model
      !> Index of the material
      integer, intent(in) :: material
      type(latent_heat_t), allocatable :: latent(:)
      integer :: i

      allocate (latent(0))
      if (.not. allocated(model%materials(material)%latent_heat)) return
      associate (table => model%materials(material)%latent_heat)
         latent = [(latent_heat_t(table(1, i), table(2, i), table(3, i)), i=1, size(table, 2))]
      end associate
   end function latent_heats

   !> Between each time and the one before it, by the specific heat at the latest one. Where no phase changes, these are
   !> the changes of the temperatures.
   pure function changes_by_heat(model, length, temperature) result(change)
      type(model_t), intent(in) :: model
      !> Of the elements (n_elements) [m]
      real(dp), intent(in) :: length(:)
      !> The latest one first (n_nodes, times) [K]
      real(dp), intent(in) :: temperature(:, :)
      real(dp) :: change(size(temperature, 1), size(temperature, 2) - 1)
      real(dp) :: stored(size(temperature, 1), size(temperature, 2) - 1), capacity(size(temperature, 1))
      integer, allocatable :: elements(:)
      integer :: i, k

      change = temperature(:, :size(change, 2)) - temperature(:, 2:)
      if (.not. any([(allocated(model%materials(i)%latent_heat), i=1, size(model%materials))])) return
      elements = storing_elements(model)
      stored = 0
      capacity = 0
      do i = 1, size(elements)
         call add_element(model, elements(i), length(elements(i)), temperature, stored, capacity)
      end do
      do k = 1, size(change, 2)
         where (capacity > 0) change(:, k) = stored(:, k)/capacity
      end do
   end function changes_by_heat

   !> What an element stores at its nodes.
   pure subroutine add_element(model, e, length, temperature, stored, capacity)
      type(model_t), intent(in) :: model
      !> Element
      integer, intent(in) :: e
      !> [m]
      real(dp), intent(in) :: length
      !> The latest one first (n_nodes, times) [K]
      real(dp), intent(in) :: temperature(:, :)
      !> Between the times (n_nodes, times - 1) [J], and per kelvin by the specific heat (n_nodes) [J/K]
      real(dp), intent(inout) :: stored(:, :), capacity(:)
      type(latent_heat_t), allocatable :: latent(:)
      real(dp) :: mass, heat, slope, difference
      integer :: side, k

      associate (section => model%sections(model%element_section(e)))
         latent = latent_heats(model, section%material)
         associate (wire => model%materials(section%material))
            mass = wire%density*section%area*length/2
            do side = 1, 2
               associate (node => model%connectivity(side, e))
                  call property_at(wire%specific_heat, temperature(node, 1), heat, slope)
                  capacity(node) = capacity(node) + mass*heat
                  do k = 1, size(stored, 2)
                     call enthalpy_difference(temperature(node, k), temperature(node, k + 1), wire%specific_heat, &
                        latent, difference, slope)
                     stored(node, k) = stored(node, k) + mass*difference
                  end do
               end associate
            end do
         end associate
      end associate
   end subroutine add_element

end module litz_stored_heat
