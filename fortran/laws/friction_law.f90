!> Coulomb friction at a point: the traction that resists a slip, by a return map with a tangential stiffness.
!>
!> Source: J. C. Simo, T. A. Laursen, Comput. Struct. 42 (1992) 97-116, the return map of friction in analogy to
!> plasticity, for two components in the tangential plane: trial traction `T* = T_n + k_t D`, with `T_n` the traction
!> when the increment began and `D` the slip since; stick while `|T*| <= mu F`, else slip with `T = mu F T*/|T*|`.
!>
!> Where the stiffness has fallen with the normal force, the elastic slip is held: `T* = T_n k_t/k_n + k_t D`, and what
!> the spring loses of its energy is heat. A traction that stayed would give back more than it has taken. (Source: C.
!> Thornton, S. J. Cummins, P. W. Cleary, Powder Technol. 233 (2013) 30-46, on Mindlin's spring under varying forces.)
module litz_friction_law
   use litz_kinds, only: dp
   implicit none
   private
   public :: friction_law_t, friction_start_t, friction_law, cut_to, mindlin_ratio
   public :: friction_none, friction_stick, friction_slip

   !> No traction: the contact is open, or has no friction
   integer, parameter :: friction_none = 0
   integer, parameter :: friction_stick = 1
   integer, parameter :: friction_slip = 2

   !> Traction and how it changes.
   type :: friction_law_t
      !> One of the constants above
      integer :: status = friction_none
      !> Traction (2) [N] against the slip, and the trial traction T* that it follows from
      real(dp) :: traction(2) = 0, trial(2) = 0
      !> dT/dD (2, 2) [N/m], and dT/dF (2) [-], with the stiffness following the force
      real(dp) :: dtraction_dslip(2, 2) = 0, dtraction_dforce(2) = 0
      !> Change of the energy of the spring [J]
      real(dp) :: elastic_work = 0
      !> What elastic work and dissipation have beyond `(T_n + T) . D/2`, because slip begins within the increment [J]
      real(dp) :: work_beyond_mean = 0
      !> Part of the slip that is not elastic (2) [m], and what it and a softer spring turn to heat, never negative [J]
      real(dp) :: plastic_slip(2) = 0, dissipation = 0
      !> dE/dD (2) [N] and dE/dF [m] of the dissipation E
      real(dp) :: ddissipation_dslip(2) = 0, ddissipation_dforce = 0
   end type friction_law_t

   !> The contact when the increment began; all 0: it was open.
   type :: friction_start_t
      !> Traction (2) and normal force [N]
      real(dp) :: traction(2) = 0, force = 0
      !> Tangential stiffness [N/m], and energy of the spring [J]
      real(dp) :: stiffness = 0, elastic_energy = 0
   end type friction_start_t

contains

   pure function friction_law(mu, force, stiffness, dstiffness_dforce, start, slip, taken_as, expected) result(law)
      !> Coefficient of friction [-], and normal force [N]; both at least 0
      real(dp), intent(in) :: mu, force
      !> Tangential stiffness k_t [N/m], greater than 0, and how it changes with the normal force [1/m]
      real(dp), intent(in) :: stiffness, dstiffness_dforce
      type(friction_start_t), intent(in) :: start
      !> Slip since the start of the increment (2) [m]
      real(dp), intent(in) :: slip(2)
      !> `friction_stick` or `friction_slip`: the status that an iteration supposes, whatever the trial traction says
      integer, intent(in), optional :: taken_as
      !> Traction (2) [N] that an iteration expects, for the tangent (9.1) of a slip; that of the slip itself gives the
      !> derivative, as without it
      real(dp), intent(in), optional :: expected(2)
      type(friction_law_t) :: law
      real(dp) :: held(2), dtrial_dforce(2), size_of_trial, direction(2), along(2), ratio, softening, dsoftening
      integer :: i

      softening = 1
      dsoftening = 0
      direction = 0
      held = start%traction
      dtrial_dforce = dstiffness_dforce*slip
      if (stiffness < start%stiffness) then
         softening = stiffness/start%stiffness
         dsoftening = dstiffness_dforce/start%stiffness
         held = softening*start%traction
         dtrial_dforce = dtrial_dforce + dsoftening*start%traction
      end if
      law%trial = held + stiffness*slip                                                   ! T* = T_n + k_t D
      size_of_trial = norm2(law%trial)
      law%status = merge(friction_stick, friction_slip, size_of_trial <= mu*force)
      if (present(taken_as)) law%status = taken_as
      if (law%status == friction_stick .or. .not. size_of_trial > 0) then
         law%traction = law%trial
         law%dtraction_dforce = dtrial_dforce
         law%dtraction_dslip(1, 1) = stiffness
         law%dtraction_dslip(2, 2) = stiffness
      else
         direction = law%trial/size_of_trial
         ratio = mu*force/size_of_trial
         law%traction = mu*force*direction                                                ! T = mu F T*/|T*|
         along = law%traction/size_of_trial
         if (present(expected)) along = cut_to(mu*force, expected)/size_of_trial
         law%dtraction_dforce = mu*direction + ratio*dtrial_dforce - along*dot_product(direction, dtrial_dforce)
         do i = 1, 2
            law%dtraction_dslip(:, i) = -stiffness*along*direction(i)
            law%dtraction_dslip(i, i) = law%dtraction_dslip(i, i) + ratio*stiffness
         end do
         law%plastic_slip = (size_of_trial - mu*force)/stiffness*direction
         ! a limit that changes along the slip counts with its mean
         law%dissipation = mu*(softening*start%force + force)/2*norm2(law%plastic_slip)
         law%ddissipation_dslip = mu*(softening*start%force + force)/2*direction
         law%ddissipation_dforce = mu*(dsoftening*start%force + 1)/2*norm2(law%plastic_slip) &
            + mu*(softening*start%force + force)/2*dslip_dforce()
      end if
      law%elastic_work = dot_product(held + law%traction, slip - law%plastic_slip)/2
      law%work_beyond_mean = law%dissipation - dot_product(start%traction + law%traction, law%plastic_slip)/2 &
         + dot_product(held - start%traction, slip - law%plastic_slip)/2
      associate (lost => (1 - softening)*start%elastic_energy, &
         of_motion => (1 - softening)*mu*start%force/2*slip_of_motion(mu, force, stiffness, start, law%plastic_slip))
         law%elastic_work = law%elastic_work - lost
         law%dissipation = law%dissipation + lost + of_motion
         law%work_beyond_mean = law%work_beyond_mean + of_motion
         law%ddissipation_dforce = law%ddissipation_dforce - dsoftening*start%elastic_energy
         if (.not. of_motion > 0) return
         law%ddissipation_dslip = law%ddissipation_dslip + (1 - softening)*mu*start%force/2*direction
         law%ddissipation_dforce = law%ddissipation_dforce - dsoftening*of_motion/(1 - softening) + (1 - softening) &
            *mu*start%force/2*(dslip_dforce() + mu*(1 - force*dstiffness_dforce/stiffness)/stiffness)
      end associate

   contains

      !> How the part of the slip that is not elastic changes with the normal force [m/N].
      pure real(dp) function dslip_dforce()

         dslip_dforce = 0
         if (norm2(law%plastic_slip) > 0) dslip_dforce = (dot_product(direction, dtrial_dforce) - mu &
            - norm2(law%plastic_slip)*dstiffness_dforce)/stiffness
      end function dslip_dforce

   end function friction_law

   !> A traction, of the size of the limit of friction at most.
   pure function cut_to(limit, traction) result(cut)
      !> [N]
      real(dp), intent(in) :: limit
      !> (2) [N]
      real(dp), intent(in) :: traction(2)
      real(dp) :: cut(2)

      cut = traction
      if (norm2(traction) > limit) cut = traction*(limit/norm2(traction))
   end function cut_to

   !> Slip against a limit that falls from `mu F_n`, besides what a spring that becomes softer is shortened by [m].
   pure real(dp) function slip_of_motion(mu, force, stiffness, start, plastic_slip)
      !> As in `friction_law`
      real(dp), intent(in) :: mu, force, stiffness
      type(friction_start_t), intent(in) :: start
      !> (2) [m]
      real(dp), intent(in) :: plastic_slip(2)

      slip_of_motion = 0
      if (.not. stiffness < start%stiffness) return
      slip_of_motion = max(0.0_dp, norm2(plastic_slip) - mu*(start%force/start%stiffness - force/stiffness))
   end function slip_of_motion

   !> Tangential over normal stiffness of a round Hertz spot that sticks: `k_t/k_n = 4 G*/E*`.
   !>
   !> Source: R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268: `k_t = 8 a G*`, `1/G* = (2 - nu)/G + (2 - nub)/Gb`,
   !> beside Hertz's `k_n = 2 a E*`; `2 (1 - nu)/(2 - nu)` for equal materials.
   pure real(dp) function mindlin_ratio(young, poisson) result(ratio)
      !> Young's moduli (2) [Pa], Poisson's ratios (2) [-]: barred, unbarred
      real(dp), intent(in) :: young(2), poisson(2)
      real(dp) :: g_star, e_star, shear(2)

      shear = young/(2*(1 + poisson))
      g_star = 1/sum((2 - poisson)/shear)
      e_star = 1/sum((1 - poisson**2)/young)
      ratio = 4*g_star/e_star
   end function mindlin_ratio

end module litz_friction_law
