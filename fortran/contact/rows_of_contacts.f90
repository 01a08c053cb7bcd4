!> How the heat through a contact of two wires changes with motions, and with temperatures that its mechanics sees,
!> where these are in the same Newton step. Source: theory section 13.
module litz_rows_of_contacts
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t
   use litz_contact_temperatures, only: spot_by_temperature, stiffer_by_temperature
   use litz_domain, only: domain_t
   use litz_heated_contacts, only: heated_contact_t, contact_rows_t, n_rows, elastic_shape, given_conductance
   use litz_law_input, only: wire_pair_t
   use litz_normal_forces, only: wires_of, law_of_spot
   use litz_normal_law, only: force_of_gap_t
   implicit none
   private
   public :: contact_rows

contains

   !> How a contact changes with motions and with temperatures that its mechanics sees. A film conducts by its area, as
   !> which goes the square of the shape.
   type(contact_rows_t) function contact_rows(domain, point, heated) result(rows)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      type(heated_contact_t), intent(in) :: heated
      type(wire_pair_t) :: pair
      real(dp) :: conductance(n_rows), by_place(n_motions), unused

      rows%place = reshape([point%kinematics%rows%dxi_bar, point%kinematics%rows%dxi], shape(rows%place))
      associate (law => domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction))
         if (point%friction%dissipation > 0) rows%friction_work = [point%dfriction_work, work_by_temperature(domain, &
            point, law_of_spot(law%normal, point))]
         if (.not. heated%is_passed) return
         pair = wires_of(domain%model, domain%elements, point)
         if (point%conductance > 0) then
            conductance(:n_motions) = point%dconductance
            conductance(n_motions + 1:) = spot_by_temperature(domain, law, point, point%dconductance_dgap, &
               point%dconductance_dln_force)
            rows%resistance = -point%dconductance/point%conductance**2
            by_place = matmul(rows%place, heated%shape*pair%dresistivity*pair%dtemperature)
            if (heated%is_given) then
               rows%shape = -conductance/point%conductance
            else
               rows%shape = -conductance/point%conductance**2
               rows%shape(:n_motions) = rows%shape(:n_motions) - by_place
               rows%shape = rows%shape/(sum(heated%linear_resistance) + 2*heated%film_resistance)
            end if
         end if
         if (law%heat%is_given()) then
            unused = given_conductance(domain, law, point, pair, rows%heat_conductance)
         else if (point%conductance > 0) then
            rows%heat_conductance = -rows%shape
         else
            unused = sum(elastic_shape(domain, law, point, pair, heated, rows%heat_conductance))
         end if
      end associate
   end function contact_rows

   !> How the work of friction changes with temperatures where nothing moves: as the normal force does (4) [J/K].
   pure function work_by_temperature(domain, point, at_gap) result(slope)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      type(force_of_gap_t), intent(in) :: at_gap
      real(dp) :: slope(4)

      slope = point%dfriction_work_dforce*(at_gap%dforce_dgap*point%dgap_dtemperature &
         + point%force*stiffer_by_temperature(domain, point))
   end function work_by_temperature

end module litz_rows_of_contacts
