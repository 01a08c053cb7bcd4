!> The keyword of superconducting wires.
module litz_superconductor_keywords
   use litz_critical_law, only: critical_choices
   use litz_keywords, only: keyword_t, keyword_table_t, place_model, limit_none, limit_positive, limit_not_negative, &
      limit_one, parameter_spec_t
   use litz_keyword_builders, only: begin, finish, real_field, choice, number
   implicit none
   private
   public :: add_superconductor

contains

   pure subroutine add_superconductor(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      type(parameter_spec_t) :: exponent

      call begin(k, 'SUPERCONDUCTOR', place_model, 'Filaments that superconduct, in a metal of the given'// &
         ' *ELECTRICAL CONDUCTIVITY (litz extension): E = EC (J/jc)^N in parallel with the metal, each with its'// &
         ' part of the cross-section. TABLE: a critical current density, or several over temperature and flux'// &
         ' density, linear in between and constant outside. NB3SN: the ITER-2008 parametrization, over strain too.'// &
         ' NBTI: the fit of Bottura (2000). Temperatures count from absolute zero. The strain is that of the beam'// &
         ' along its axis, without that of temperature, and STRAIN; the flux density that of *LORENTZ in the middle'// &
         ' of the element, otherwise FIELD.', after='MATERIAL')
      call k%add(choice('LAW', critical_choices, 'law of the critical current density', default='TABLE'))
      exponent = number('N', 'exponent of the power law, 1 or more', limit_one)
      exponent%required = .true.
      call k%add(exponent)
      call k%add(number('EC', 'electric field at the critical current', limit_positive, '1e-4'))
      call k%add(number('FRACTION', 'part of the cross-section that is superconductor, to which jc refers; or RATIO', &
         limit_positive))
      call k%add(number('RATIO', 'area of normal metal over that of superconductor, as copper to non-copper', &
         limit_positive))
      call k%add(number('FIELD', 'flux density where no *LORENTZ gives one', limit_not_negative, '0'))
      call k%add(number('STRAIN', 'axial strain of the filaments in a beam without strain, as by cool-down', &
         limit_none, '0'))
      call k%add_data([real_field('jc', 'A/m^2', 'critical current density', limit_not_negative), &
         real_field('T', 'K', 'temperature, from absolute zero; of several lines each has one', limit_not_negative, &
         required=.false.), real_field('B', 'N/(A m)', 'flux density; of several lines each has one', &
         limit_not_negative, required=.false.)], when='LAW=TABLE', last=0)
      call k%add_data([real_field('C', 'N/m^3', 'scaling constant', limit_positive), &
         real_field('Bc20', 'N/(A m)', 'upper critical flux density at 0 K without strain', limit_positive), &
         real_field('Tc0', 'K', 'critical temperature without flux and strain', limit_positive), &
         real_field('p', '-', 'exponent of b', limit_positive), &
         real_field('q', '-', 'exponent of 1 - b', limit_positive), &
         real_field('Ca1', '-', 'second invariant of the strain function', limit_positive), &
         real_field('Ca2', '-', 'third invariant', limit_not_negative), &
         real_field('e0', '-', 'residual strain', limit_positive), &
         real_field('em', '-', 'strain at which jc is largest')], when='LAW=NB3SN')
      call k%add_data([real_field('jref', 'A/m^2', 'critical current density at 4.2 K and 5 T', limit_positive), &
         real_field('C0', 'N/(A m)', 'normalisation', limit_positive), &
         real_field('Bc20', 'N/(A m)', 'upper critical flux density at 0 K', limit_positive), &
         real_field('Tc0', 'K', 'critical temperature without flux', limit_positive), &
         real_field('alpha', '-', 'exponent of b', limit_positive), &
         real_field('beta', '-', 'exponent of 1 - b', limit_positive), &
         real_field('gamma', '-', 'exponent of 1 - t^1.7', limit_positive)], when='LAW=NBTI')
      call finish(table, k)
   end subroutine add_superconductor

end module litz_superconductor_keywords
