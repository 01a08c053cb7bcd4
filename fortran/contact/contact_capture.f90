!> Contacts of a converged iterate: what results show of them, and what they remember.
module litz_contact_capture
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
   use litz_kinds, only: pi
   use litz_contact_history, only: contact_history_t, advanced_history, spot_of_history
   use litz_contact_points, only: contact_set_t, contact_point_t
   use litz_contact_pressure, only: elastic_pressure
   use litz_element_library, only: elements_t
   use litz_line_cell, only: touching_length
   use litz_line_places, only: line_places_t
   use litz_model, only: model_t
   use litz_normal_forces, only: wires_of
   use litz_place_forces, only: force_along_line
   use litz_spot_memory, only: shape_of_spot
   use litz_state, only: state_t, contact_t
   implicit none
   private
   public :: capture_contacts

contains

   !> The points of the converged iterate, crossings before those of line contacts.
   subroutine capture_contacts(model, elements, contact, state)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(inout) :: contact
      type(state_t), intent(inout) :: state

      call set_pressures(model, elements, contact%points)
      call set_pressures(model, elements, contact%line_points)
      deallocate (state%contacts)
      allocate (state%contacts(count(is_shown(contact%points)) + count(is_shown(contact%line_points))))
      call capture_points(contact%points, 0, contact%places, contact%last_id, state)
      call capture_points(contact%line_points, count(is_shown(contact%points)), contact%places, contact%last_id, state)
      contact%converged_clearance = contact%clearance
   end subroutine capture_contacts

   pure subroutine set_pressures(model, elements, points)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: points(:)
      integer :: i

      do i = 1, size(points)
         points(i)%pressure = 0
         if (.not. points(i)%closed) cycle
         associate (law => model%interactions(model%contact_pairs(points(i)%pair)%interaction))
            points(i)%pressure = elastic_pressure(law%normal, wires_of(model, elements, points(i)), points(i))
         end associate
      end do
   end subroutine set_pressures

   !> Contacts that carry a force, a current or heat: a place of a line may have only the latter, where a part of the
   !> wire touches for which it stands.
   elemental logical function is_shown(point)
      type(contact_point_t), intent(in) :: point

      is_shown = point%closed .or. point%conductance > 0 .or. abs(point%heat_bar) + abs(point%heat) > 0
   end function is_shown

   !> These contacts, each with an identity that it keeps while it lives.
   subroutine capture_points(points, n_before, places, last_id, state)
      type(contact_point_t), intent(inout) :: points(:)
      !> Contacts of the state before these
      integer, intent(in) :: n_before
      type(line_places_t), intent(in) :: places
      !> The last identity given
      integer, intent(inout) :: last_id
      type(state_t), intent(inout) :: state
      type(contact_history_t) :: history
      integer :: i, m

      m = n_before
      do i = 1, size(points)
         associate (point => points(i), shape => shape_of_spot(points(i)))
            if (point%closed) then
               history = advanced_history(point%history, [point%arc_bar, point%arc], point%force, point%weight, &
                  force_along_line(point)/point%weight, shape, point%friction, point%new_spot)
               history%reverses = .false.
               if (allocated(point%friction_iteration)) history%reverses = point%friction_iteration%reverses
            else
               history = merge(spot_of_history(point%history, [point%arc_bar, point%arc], point%whole_force, &
                  shape, point%new_spot), contact_history_t(), point%gap < 0 .or. point%cell_touches)
            end if
            history%dent = point%history%dent
            history%ploughing = point%ploughing
            if (is_shown(point)) history%settled_heat = point%history%settled_heat
            point%history = history
            if (.not. is_shown(point)) cycle
            if (point%id == 0) then
               last_id = last_id + 1
               point%id = last_id
            end if
            m = m + 1
            state%contacts(m) = contact_of_point(point)
            ! the first place of an element lies within it and stands for one of its parts
            if (point%line_place > 0) state%contacts(m)%spacing = places%length(places%first(point%element))
            ! the current enters within the elements: their heat includes what the linear voltage misses
            state%joule_heat(point%element_bar) = state%joule_heat(point%element_bar) + point%heat_inside(1)
            state%joule_heat(point%element) = state%joule_heat(point%element) + point%heat_inside(2)
         end associate
      end do
   end subroutine capture_points

   !> What results show of a point, with what follows from the iteration.
   pure function contact_of_point(point) result(contact)
      type(contact_point_t), intent(in) :: point
      type(contact_t) :: contact

      contact = point%contact_t
      contact%angle = min(point%kinematics%angle, pi - point%kinematics%angle)
      contact%normal = point%kinematics%normal
      contact%point_bar = point%kinematics%point_bar
      contact%point = point%kinematics%point
      contact%friction_status = point%friction%status
      contact%slip_path = point%history%slip_path
      contact%dissipation = point%history%dissipation
      contact%resistance = ieee_value(contact%resistance, ieee_positive_inf)
      if (point%conductance > 0) contact%resistance = 1/point%conductance
      contact%joule_heat = point%current*point%voltage_gap + point%heat_of_others
      if (point%line_place == 0) return
      contact%length = point%weight
      contact%end_force = point%lap%round_end%force
      contact%end_current = point%lap%round_end%share_of_conductance*point%current
      if (.not. point%closed) contact%length = point%weight*touching_length(point%cell)/sum(point%cell%reach)
   end function contact_of_point

end module litz_contact_capture
