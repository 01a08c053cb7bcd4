!> The way of the heat through each contact of two wires that conduct heat.
!>
!> A constriction has the shape `c` [1/m]: in a metal of resistivity rho its resistance is `c rho`, in one of heat
!> conductivity lambda it conducts the heat `lambda/c`, or `L/(c rho)` as a Wiedemann-Franz metal. It is that of the
!> spot of the current, `c = -(dG/drho)/G^2`, or where there is none that of elastic wires; a strip along wires of
!> unlike radii has another one in either. rho and lambda are those at the temperatures of the wires at the contact.
!> Source: theory sections 6 and 13.
module litz_heated_contacts
   use litz_kinds, only: dp, pi
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_electricity, only: conductance_row
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t, pair_geometry
   use litz_contact_spots, only: find_spot
   use litz_contact_temperatures, only: spot_by_temperature, stiffer_by_temperature
   use litz_domain, only: domain_t
   use litz_fields, only: temperature_slots
   use litz_fin, only: fin_parts, fin_growth, fin_even
   use litz_heat_law, only: heat_law_t, heat_metal_law
   use litz_heat_within, only: part_reached, slow_and_fast
   use litz_hot_spot, only: constrictions_t
   use litz_law_input, only: wire_pair_t
   use litz_model, only: model_t, interaction_t
   use litz_normal_forces, only: wires_of, line_of_point, law_of_spot
   use litz_normal_law, only: force_of_gap_t
   use litz_property_table, only: property_at
   use litz_spot_heat, only: spot_path_t
   use litz_spot_laws, only: spot_law
   use litz_spot_metal, only: spot_metal_t
   implicit none
   private
   public :: heated_contact_t, heated_contact, can_pass_heat, conducting_metals
   public :: contact_rows_t, contact_rows, n_rows, left_of_settled

   type :: heated_contact_t
      !> Nodes of both elements, barred first, and their parts of the temperatures at its places, and of the heat that
      !> enters there; how these change as the places move
      integer :: nodes(4) = 0
      real(dp) :: part(4) = 0, dpart(4) = 0
      !> Of both elements: w^2 of (13.3), and what surrounds their films [K]
      real(dp) :: film(2) = 0, sink(2) = 0
      !> What heat does that enters at the place, `1 - xi^2` without a film, or evenly, half of that; and how these
      !> change as the place moves (2)
      real(dp) :: own(2) = 0, down(2) = 0, even(2) = 0, deven(2) = 0
      !> Both elements, their materials, and the places in them, barred first
      integer :: element(2) = 0, material(2) = 0
      real(dp) :: xi(2) = 0
      !> Of the spot at temperatures that are linear between the nodes [S]; 0: no current passes
      real(dp) :: conductance = 0
      !> rho L0/(4 A) [ohm] and L0/(4 lambda A) [K/W] of both elements; 0: what enters within them does so as at their
      !> nodes
      real(dp) :: series(2) = 0, heat_series(2) = 0
      !> Of the constrictions for the current [1/m], of a resistance that is given this follows from the resistivities;
      !> and for the heat [1/m], 0: its conductance is given
      real(dp) :: shape(2) = 0, heat_shape(2) = 0
      logical :: is_given = .false.
      !> Resistivities [ohm m] and of the constrictions resistances [ohm] at the temperatures that are linear between
      !> the nodes; and the former change with the temperatures
      real(dp) :: resistivity(2) = 0, linear_resistance(2) = 0
      logical :: follows(2) = .false.
      !> A Wiedemann-Franz metal, and its Lorenz number [V^2/K^2]; 0: that of lambda and rho
      logical :: is_metal = .false.
      real(dp) :: lorenz = 0
      !> Parts of a steady state that the temperature within both elements reaches in the increment, slow and fast part
      !> (2, 2), and the heat of the steady states in which these were (2, 2) [W]
      real(dp) :: reached(2, 2) = 1, settled_heat(2, 2) = 0
      !> Resistances of both constrictions and of what is between them [ohm]
      real(dp) :: resistance(2) = 0, film_resistance = 0
      !> How the former, and all in series, change with the temperatures of both places (2, 2), (2) [ohm/K]
      real(dp) :: dresistance(2, 2) = 0, dseries(2) = 0
      type(spot_path_t) :: path
      !> The current warms the spot, which resists more (SUPERTEMPERATURE), and its way
      logical :: is_hot = .false.
      type(constrictions_t) :: constrictions
      !> Heat can pass between the wires, and not only that of their friction enters them [W]
      logical :: is_passed = .false.
      !> A wire whose conductivity goes with the temperature is at absolute zero or below
      logical :: is_cold = .false.
      real(dp) :: friction_heat = 0
      !> What BDF2 gives to the nodes beyond that [W]; and both over the work of this increment [1/s]
      real(dp) :: friction_beyond = 0, of_work(2) = 0
      !> How ln(h) of both constrictions changes with the temperatures of both places (2, 2) [1/K]
      real(dp) :: dpath(2, 2) = 0
   contains
      procedure :: warm
      procedure :: series_resistance
      procedure :: linear_temperature
   end type heated_contact_t

   !> Motions of the four nodes of a contact, and the temperatures there that its mechanics sees
   integer, parameter :: n_rows = n_motions + 4

   !> How a contact changes with these.
   type :: contact_rows_t
      !> Its places (motions, 2)
      real(dp) :: place(n_motions, 2) = 0
      !> Resistance of the spot as the matrix has it, without what temperatures do to it [ohm]
      real(dp) :: resistance(n_motions) = 0
      !> Logarithms of the shape c of the constrictions for the current, and of the heat conductance of the spot
      real(dp) :: shape(n_rows) = 0, heat_conductance(n_rows) = 0
      !> Work of friction in this increment [J]
      real(dp) :: friction_work(n_rows) = 0
   end type contact_rows_t

contains

   !> Both wires conduct heat, and there is some for them: the interaction lets it pass, or they rub.
   logical function can_pass_heat(domain, point)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      integer :: side

      associate (law => domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction))
         can_pass_heat = law%heat%exists() .or. point%conductance > 0 .or. law%friction > 0
      end associate
      do side = 1, 2
         associate (e => merge(point%element_bar, point%element, side == 1), model => domain%model)
            can_pass_heat = can_pass_heat .and. allocated(model%materials(model%sections( &
               model%element_section(e))%material)%heat_conductivity)
         end associate
      end do
   end function can_pass_heat

   !> Those of a model.
   pure function conducting_metals(model) result(metals)
      type(model_t), intent(in) :: model
      type(spot_metal_t) :: metals(size(model%materials))
      integer :: i

      do i = 1, size(metals)
         associate (material => model%materials(i))
            if (allocated(material%resistivity)) metals(i)%resistivity = material%resistivity
            if (allocated(material%heat_conductivity)) metals(i)%heat_conductivity = material%heat_conductivity
         end associate
      end do
   end function conducting_metals

   !> What heat needs to know of a contact that it can pass; `warm` sets what depends on the temperatures of its places.
   type(heated_contact_t) function heated_contact(domain, point, rate) result(heated)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      !> By which the work of an increment is a power [1/s]; 0: time is a scale of loads
      real(dp), intent(in) :: rate
      type(wire_pair_t) :: pair
      integer :: side

      associate (law => domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction))
         heated%element = [point%element_bar, point%element]
         heated%material = domain%model%sections(domain%model%element_section(heated%element))%material
         heated%xi = [point%xi_bar, point%xi]
         heated%nodes = reshape(domain%model%connectivity(:, heated%element), [4])
         do side = 1, 2
            call place_in_film(domain, side, heated)
         end do
         heated%conductance = point%conductance
         heated%series = point%series_resistance
         do side = 1, 2
            if (law%voltage_correction) heated%heat_series(side) = heat_series_of(domain, heated%element(side))
            if (rate > 0) heated%reached(:, side) = part_reached(rate*time_constant(domain, heated%element(side)))
         end do
         if (rate > 0) heated%settled_heat = point%history%settled_heat
         associate (work => point%friction%dissipation, weights => domain%heat_weights)
            heated%of_work = law%heat%friction_fraction*rate*[1.0_dp, weights(1) - 1]
            heated%friction_heat = heated%of_work(1)*work
            heated%friction_beyond = heated%of_work(2)*work &
               - heated%of_work(1)*weights(2)*point%history%last_dissipation
         end associate
         heated%is_passed = law%heat%exists() .or. heated%conductance > 0
         if (.not. heated%is_passed) return
         pair = wires_of(domain%model, domain%elements, point)
         call find_constrictions(point, pair, heated)
         if (law%heat%is_given()) then
            heated%path = spot_path_t(is_metal=.false., conductance=2*given_conductance(domain, law, point, pair))
            return
         end if
         heated%heat_shape = heated%shape
         if (.not. heated%conductance > 0) heated%heat_shape = elastic_shape(domain, law, point, pair, heated)
         ! a place that has parted in its dent has no spot
         heated%is_passed = heated%heat_shape(1) > 0
         if (.not. heated%is_passed) return
         heated%is_metal = law%heat%number == heat_metal_law .and. heated%conductance > 0
         heated%lorenz = law%heat%lorenz
         heated%is_hot = law%supertemperature .and. heated%shape(1) > 0 .and. .not. heated%is_given
         if (heated%is_hot) heated%constrictions = constrictions_t(heated%shape, heated%film_resistance, &
            is_metal=heated%is_metal, lorenz=heated%lorenz, zero=domain%model%absolute_zero)
         do side = 1, 2
            heated%is_cold = heated%is_cold .or. heated%is_metal .and. heated%linear_temperature(side, &
               domain%iterate%value(temperature_slots(1), heated%nodes(2*side - 1:2*side))) &
               <= domain%model%absolute_zero
         end do
      end associate
   end function heated_contact

   !> What the place in an element does between its nodes.
   subroutine place_in_film(domain, side, heated)
      type(domain_t), intent(in) :: domain
      !> 1: barred, 2: unbarred
      integer, intent(in) :: side
      type(heated_contact_t), intent(inout) :: heated

      associate (w2 => heated%film(side), xi => heated%xi(side), part => heated%part(2*side - 1:2*side), &
         dpart => heated%dpart(2*side - 1:2*side))
         w2 = domain%film_between_nodes(heated%element(side))
         if (w2 > 0) heated%sink(side) = domain%sink(heated%element(side))
         call fin_parts(w2, xi, part, dpart)
         call fin_even(w2, xi, heated%even(side), heated%deven(side))
         heated%own(side) = 4*fin_growth(w2)*product(part)
         heated%down(side) = 4*fin_growth(w2)*sum(dpart*[part(2), part(1)])
      end associate
   end subroutine place_in_film

   !> Temperature at a place by those of the nodes [K].
   pure real(dp) function linear_temperature(self, side, temperature)
      class(heated_contact_t), intent(in) :: self
      !> 1: barred, 2: unbarred
      integer, intent(in) :: side
      !> Of the nodes of its element (2) [K]
      real(dp), intent(in) :: temperature(2)

      associate (sink => self%sink(side))
         linear_temperature = sink + dot_product(self%part(2*side - 1:2*side), temperature - sink)
      end associate
   end function linear_temperature

   !> Those of the spot of the current; a resistance that is given is all constriction.
   pure subroutine find_constrictions(point, pair, heated)
      type(contact_point_t), intent(in) :: point
      type(wire_pair_t), intent(in) :: pair
      type(heated_contact_t), intent(inout) :: heated

      heated%resistivity = pair%resistivity
      heated%follows = abs(pair%dresistivity) > 0
      if (.not. point%conductance > 0) return
      heated%shape = point%constriction
      heated%is_given = .not. heated%shape(1) > 0
      if (heated%is_given) heated%shape = 1/(point%conductance*sum(pair%resistivity))
      heated%linear_resistance = heated%shape*pair%resistivity
      heated%film_resistance = max(0.0_dp, 1/point%conductance - sum(heated%linear_resistance))
   end subroutine find_constrictions

   !> Resistances and the way of the heat at the temperatures of both places.
   pure subroutine warm(self, metals, temperature, absolute_zero)
      class(heated_contact_t), intent(inout) :: self
      !> Of the model
      type(spot_metal_t), intent(in) :: metals(:)
      !> Barred, unbarred (2), and absolute zero on their scale [K]
      real(dp), intent(in) :: temperature(2), absolute_zero
      real(dp), dimension(2) :: rho, drho, lambda, dlambda, shape, dshape
      integer :: i

      if (.not. self%is_passed) return
      rho = self%resistivity
      drho = 0
      do i = 1, 2
         associate (metal => metals(self%material(i)))
            call property_at(metal%heat_conductivity, temperature(i), lambda(i), dlambda(i))
            if (self%follows(i)) call property_at(metal%resistivity, temperature(i), rho(i), drho(i))
         end associate
      end do
      shape = self%shape
      dshape = 0
      if (self%is_given) then
         shape = 1/(self%conductance*sum(rho))
         dshape = -drho/sum(rho)
      end if
      if (self%conductance > 0) then
         self%resistance = shape*rho
         do i = 1, 2
            self%dresistance(i, :) = self%resistance(i)*dshape
            self%dresistance(i, i) = self%dresistance(i, i) + shape(i)*drho(i)
         end do
         self%dseries = merge([0.0_dp, 0.0_dp], sum(self%dresistance, 1), self%is_given)
      end if
      if (.not. self%heat_shape(1) > 0) return
      if (self%is_given) self%heat_shape = shape
      self%path = spot_path_t(is_metal=.false., conductance=lambda/self%heat_shape)
      self%dpath = reshape([dlambda(1)/lambda(1), 0.0_dp, 0.0_dp, dlambda(2)/lambda(2)], [2, 2]) - spread(dshape, 1, 2)
      if (self%is_metal) call follow_wiedemann_franz(self%lorenz, temperature - absolute_zero, self)
   end subroutine warm

   !> Of the spot at the temperatures of its places [ohm].
   pure real(dp) function series_resistance(self)
      class(heated_contact_t), intent(in) :: self

      series_resistance = 1/self%conductance
      if (.not. self%is_given) series_resistance = series_resistance + sum(self%resistance - self%linear_resistance)
   end function series_resistance

   !> lambda of an element at a temperature, and its derivative.
   pure subroutine conductivity_of(domain, e, temperature, lambda, dlambda)
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      !> [K]
      real(dp), intent(in) :: temperature
      !> [W/(m K)], [W/(m K^2)]
      real(dp), intent(out) :: lambda, dlambda

      associate (model => domain%model)
         call property_at(model%materials(model%sections(model%element_section(e))%material)%heat_conductivity, &
            temperature, lambda, dlambda)
      end associate
   end subroutine conductivity_of

   !> L0^2/(pi^2 kappa), with which temperatures within an element settle between nodes that stay, when the increment
   !> began [s].
   pure real(dp) function time_constant(domain, e)
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      real(dp) :: mean, lambda, heat, slope

      mean = sum(domain%state%value(temperature_slots(1), domain%model%connectivity(:, e)))/2
      call conductivity_of(domain, e, mean, lambda, slope)
      associate (material => domain%model%materials(domain%model%sections(domain%model%element_section(e))%material))
         call property_at(material%specific_heat, mean, heat, slope)
         time_constant = domain%elements%length(e)**2*material%density*heat/(pi**2*lambda)
      end associate
   end function time_constant

   !> L0/(4 lambda A) of an element [K/W].
   pure real(dp) function heat_series_of(domain, e) result(series)
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      real(dp) :: lambda, dlambda

      call conductivity_of(domain, e, domain%mean_temperature(e), lambda, dlambda)
      series = domain%elements%length(e)/(4*lambda*domain%elements%area(e))
   end function heat_series_of

   !> `h = L/R` of the constrictions, with `L = lambda rho/T` where none is given.
   pure subroutine follow_wiedemann_franz(lorenz, temperature, heated)
      !> [V^2/K^2]; 0: none is given
      real(dp), intent(in) :: lorenz
      !> Of both places, from absolute zero [K]
      real(dp), intent(in) :: temperature(2)
      type(heated_contact_t), intent(inout) :: heated
      integer :: i

      heated%path%is_metal = .true.
      if (lorenz > 0) then
         heated%path%conductance = lorenz/heated%resistance
         heated%dpath = -heated%dresistance/spread(heated%resistance, 2, 2)
         return
      end if
      heated%path%conductance = heated%path%conductance/temperature
      do i = 1, 2
         heated%dpath(i, i) = heated%dpath(i, i) - 1/temperature(i)
      end do
   end subroutine follow_wiedemann_franz

   !> c of the spot of elastic wires without a current: their heat conductivities are as good as conductivities [1/m];
   !> 0: there is no spot.
   function elastic_shape(domain, law, point, pair, heated, row) result(shape)
      type(domain_t), intent(in) :: domain
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      type(wire_pair_t), intent(in) :: pair
      type(heated_contact_t), intent(in) :: heated
      !> How -ln(c) changes with motions and temperatures (n_rows)
      real(dp), intent(out), optional :: row(:)
      real(dp) :: shape(2)
      type(interaction_t) :: elastic
      type(wire_pair_t) :: thermal_pair
      real(dp) :: conductance, conductivity, slope
      integer :: side

      elastic = law
      elastic%spot = spot_law('HERTZ')
      elastic%spot_memory = .false.
      thermal_pair = pair
      do side = 1, 2
         call conductivity_of(domain, heated%element(side), domain%mean_temperature(heated%element(side)), &
            conductivity, slope)
         thermal_pair%resistivity(side) = 1/conductivity
      end do
      thermal_pair%dresistivity = 0
      conductance = spot_conductance(domain, elastic, point, thermal_pair, row, shape)
      if (.not. conductance > 0) then
         shape = 0
         return
      end if
      shape = -shape/conductance**2
      if (present(row)) row = row/conductance
   end function elastic_shape

   !> Heat conductance that is given [W/K].
   real(dp) function given_conductance(domain, law, point, pair, row) result(conductance)
      type(domain_t), intent(in) :: domain
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      type(wire_pair_t), intent(in) :: pair
      !> How its logarithm changes with motions and temperatures (n_rows)
      real(dp), intent(out), optional :: row(:)
      type(interaction_t) :: thermal

      thermal = law
      thermal%spot = law%heat%as_spot_law()
      thermal%spot_memory = .false.
      conductance = spot_conductance(domain, thermal, point, pair, row)
      if (present(row)) row = row/conductance
   end function given_conductance

   real(dp) function spot_conductance(domain, law, point, pair, row, by_resistivity) result(conductance)
      type(domain_t), intent(in) :: domain
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      type(wire_pair_t), intent(in) :: pair
      !> How it changes with motions and temperatures (n_rows), and with the resistivities of the pair (2)
      real(dp), intent(out), optional :: row(:), by_resistivity(2)
      type(contact_point_t) :: looked_at
      type(spot_in_circuit_t) :: circuit
      real(dp) :: x(3, 4), t(3, 4), length(2)

      looked_at = point
      ! the strip along a line is that of these resistivities
      looked_at%line = line_of_point(pair, point)
      call pair_geometry(domain%model, domain%wires, domain%elements, point%element_bar, point%element, &
         domain%iterate%x, domain%iterate%rotation, x, t, length)
      call find_spot(domain%model, domain%elements, law, domain%wires, pair, x, t, length, looked_at, circuit)
      conductance = circuit%spot%conductance
      if (present(by_resistivity)) by_resistivity = circuit%spot%dconductance_dresistivity
      if (.not. present(row)) return
      associate (spot => circuit%spot, by_force => circuit%spot%dconductance_dforce*circuit%follows)
         associate (followed => law_of_spot(law%normal, looked_at))
            row(:n_motions) = conductance_row(point%kinematics, by_force*followed%dforce_dgap, &
               spot%dconductance_dangle + by_force*followed%dforce_dangle, circuit%dconductance)
            row(n_motions + 1:) = spot_by_temperature(domain, law, point, by_force*followed%dforce_dgap &
               + circuit%dconductance_dgap, by_force*point%force + circuit%dconductance_dln_force)
         end associate
      end associate
   end function spot_conductance

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

   !> Heat by which the temperature at a contact is above the linear one since before the increment [W].
   pure real(dp) function left_of_settled(contact, side)
      type(heated_contact_t), intent(in) :: contact
      !> 1: barred, 2: unbarred
      integer, intent(in) :: side

      left_of_settled = sum(slow_and_fast*(1 - contact%reached(:, side))*contact%settled_heat(:, side))
   end function left_of_settled

end module litz_heated_contacts
