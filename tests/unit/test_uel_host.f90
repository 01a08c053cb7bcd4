!> A host as strict as Abaqus: what it does not promise to set is poisoned, what a user element must not touch is
!> watched, all that it may ask for is asked for, and increments are cut back and repeated.
program test_uel_host
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use litz_kinds, only: dp
   use host_stand_ins, only: start_host, n_stops, n_warnings, message
   use litz_user_element, only: history_side, history_gap, history_force, history_current
   implicit none

   real(dp), parameter :: length = 0.02_dp, radius = 1.0e-3_dp, overlap = 2.0e-6_dp
   !> LFLAGS(3)
   integer, parameter :: normal = 1, tangent = 2, damping = 3, mass = 4, residual = 5, residual_and_mass = 6, &
      perturbation_output = 100
   real(dp), parameter :: good(10) = [radius, radius, 120.0e9_dp, 100.0e9_dp, 0.34_dp, 0.3_dp, 1.7e-8_dp, 2.0e-8_dp, &
      1.0e6_dp, 0.0_dp]
   integer, parameter :: options(5) = [1, 2, 2, 0, 1]                     ! LINEAR, HERTZ, Hermite, additive

   !> What Abaqus has, and what it gives back
   type :: element_t
      integer :: jtype = 1, nnode = 4, mcrd = 3, ndofel = 28, nsvars = 6, mlvarx = 31, nrhs = 1
      real(dp), allocatable :: coords(:, :), u(:), du(:, :), props(:), svars(:), rhs(:, :), amatrx(:, :)
      integer, allocatable :: jprops(:)
      real(dp) :: energy(8) = 0, pnewdt = 1
   end type element_t

   call test_all_that_may_be_asked_for()
   call test_a_linear_perturbation_is_the_tangent_times_it()
   call test_increments_that_are_cut_back_leave_no_trace()
   call test_bad_input_ends_the_analysis_with_its_own_message()
   call test_a_failure_that_smaller_increments_may_avoid_is_a_warning()
   call test_a_type_that_does_not_exist()
   call test_the_conductor()
   call test_the_conductor_over_the_present_length()
   call test_the_conductor_refuses()

contains

   !> Two wires that cross, overlap and conduct.
   type(element_t) function crossing() result(element)
      allocate (element%coords, source=reshape([-0.5_dp, 0.0_dp, 0.0_dp, 0.5_dp, 0.1_dp, 0.0_dp, -0.1_dp, -0.4_dp, &
         0.0_dp, 0.1_dp, 0.6_dp, 0.0_dp]*length, [3, 4]))
      element%coords(3, 1:2) = 2*radius - overlap
      element%props = good
      element%jprops = options
      allocate (element%u(28), element%du(31, 2), element%svars(6), element%rhs(31, 2), element%amatrx(28, 28))
      element%u = 0
      element%u([7, 14]) = [2.0e-3_dp, 1.0e-3_dp]
      element%u([4, 12, 20]) = [0.02_dp, -0.05_dp, 0.03_dp]
      element%du = 0
      element%svars = 0
   end function crossing

   type(element_t) function bar(ndofel) result(element)
      !> 2: voltages; 8: motions, too
      integer, intent(in) :: ndofel

      element%jtype = 2
      element%nnode = 2
      element%ndofel = ndofel
      element%nsvars = 2
      allocate (element%coords, source=reshape([0.0_dp, 0.0_dp, 0.0_dp, 0.3_dp, 0.4_dp, 0.0_dp], [3, 2]))
      element%props = [1.0e-6_dp, 2.0e-8_dp]
      element%jprops = [0]
      allocate (element%u(ndofel), element%du(31, 2), element%svars(2), element%rhs(31, 2), &
         element%amatrx(ndofel, ndofel))
      element%u = 0
      element%u(ndofel/2) = 3.0e-3_dp
      element%u(ndofel) = 1.0e-3_dp
      element%du = 0
      element%svars = 0
   end function bar

   !> One call. Scratch is poisoned before, and all that belongs to others is looked at after.
   subroutine call_uel(element, wanted, perturbs)
      type(element_t), intent(inout) :: element
      !> LFLAGS(3)
      integer, intent(in) :: wanted
      !> LFLAGS(4)
      integer, intent(in) :: perturbs
      real(dp) :: poison, none(1, 1), params(3), energy(8), no_field(2, 1, 4)
      real(dp), allocatable :: nothing(:)
      integer :: no_loads(1, 1), lflags(5)

      poison = ieee_value(poison, ieee_quiet_nan)
      none = poison
      params = poison
      no_field = poison
      no_loads = -huge(1)
      lflags = [71, 1, wanted, perturbs, 0]
      element%rhs = huge(1.0_dp)
      element%rhs(:, 2) = poison
      element%amatrx = poison
      energy = 7.0_dp
      element%energy = energy
      element%pnewdt = 1
      allocate (nothing(element%ndofel))
      nothing = poison
      call uel(element%rhs, element%amatrx, element%svars, element%energy, element%ndofel, element%nrhs, &
         element%nsvars, element%props, size(element%props), element%coords, element%mcrd, element%nnode, element%u, &
         element%du, nothing, nothing, element%jtype, [1.0_dp, 1.0_dp], 0.1_dp, 3, 4, 17, params, 0, no_loads, none, &
         no_field(:, :, :element%nnode), 1, lflags, element%mlvarx, none, 1, element%pnewdt, element%jprops, &
         size(element%jprops), 1.0_dp)
      call expect(all(ieee_is_finite(element%amatrx)), 'the tangent is set')
      call expect(all(ieee_is_finite(element%rhs(:element%ndofel, :element%nrhs))), 'the right-hand side is set')
      call expect(all(abs(element%rhs(element%ndofel + 1:, 1)) >= huge(1.0_dp)), 'rows of others are not touched')
      call expect(all(abs(element%energy([1, 3, 4, 5, 6, 7, 8]) - 7) <= 0), 'energies of others are not touched')
   end subroutine call_uel

   subroutine test_all_that_may_be_asked_for()
      type(element_t) :: all_of_it, asked
      integer :: i
      integer, parameter :: requests(5) = [tangent, damping, mass, residual, residual_and_mass]

      call start_host()
      all_of_it = crossing()
      call call_uel(all_of_it, normal, 0)
      call expect(all_of_it%svars(history_force) > 1 .and. all_of_it%svars(history_current) > 1, 'they conduct')
      call expect(maxval(abs(all_of_it%rhs(:28, 1))) > 1 .and. maxval(abs(all_of_it%amatrx)) > 1, 'it acts')
      do i = 1, size(requests)
         asked = crossing()
         call call_uel(asked, requests(i), 0)
         call expect(equal(asked%amatrx, merge(1, 0, requests(i) == tangent)*all_of_it%amatrx), 'tangent')
         call expect(all(abs(asked%rhs(:28, 1) - merge(1, 0, any(requests(i) == [residual, residual_and_mass])) &
            *all_of_it%rhs(:28, 1)) <= 0), 'right-hand side')
      end do
      call expect(n_stops == 0 .and. n_warnings == 0 .and. message == '', 'nothing to be said')
      ! the method of Riks has two right-hand sides
      asked = crossing()
      asked%nrhs = 2
      call call_uel(asked, normal, 0)
      call expect(all(abs(asked%rhs(:28, 2)) <= 0), 'there is no load that grows')
   end subroutine test_all_that_may_be_asked_for

   subroutine test_a_linear_perturbation_is_the_tangent_times_it()
      type(element_t) :: base, element
      integer :: i

      base = crossing()
      call call_uel(base, normal, 0)
      element = base
      element%nrhs = 2
      element%du(:28, 1) = [(1.0e-6_dp*cos(real(i, dp)), i=1, 28)]
      element%du(:28, 2) = [(1.0e-6_dp*sin(real(i, dp)), i=1, 28)]
      call call_uel(element, normal, 1)
      call expect(equal(element%amatrx, base%amatrx), 'the tangent of the base state')
      do i = 1, 2
         call expect(all(abs(element%rhs(:28, i) + matmul(base%amatrx, element%du(:28, i))) <= 0), &
            'forces of the perturbation')
      end do
      call expect(all(abs(element%svars - base%svars) <= 0), 'the base state keeps its history')
      call call_uel(element, perturbation_output, 1)
      call expect(all(abs(element%amatrx) <= 0), 'output needs no tangent')
      call expect(all(abs(element%rhs(:28, 1) + matmul(base%amatrx, element%du(:28, 1))) <= 0), 'forces for output')
   end subroutine test_a_linear_perturbation_is_the_tangent_times_it

   !> The side that the wires had when an increment began decides, not that of an iterate that was given up.
   subroutine test_increments_that_are_cut_back_leave_no_trace()
      type(element_t) :: element, straight
      real(dp) :: converged(6)
      integer :: iteration

      element = crossing()
      call call_uel(element, normal, 0)
      converged = element%svars
      call expect(nint(abs(converged(history_side))) == 1, 'there is a side')
      ! iterates that pass through the other wire, then open: each begins from what has converged
      do iteration = 1, 3
         element%svars = converged
         element%u(3) = -1.0e-3_dp - 2*radius*iteration
         element%u(10) = element%u(3)
         call call_uel(element, normal, 0)
         call expect(element%svars(history_gap) < -2*radius, 'the other side is an overlap')
         element%svars = converged
         element%u([3, 10]) = 1.0e-3_dp
         call call_uel(element, normal, 0)
         call expect(element%svars(history_gap) > 0 .and. nint(element%svars(history_side)) == 0, 'apart')
      end do
      element%svars = converged
      element%u([3, 10]) = -1.0e-6_dp
      call call_uel(element, normal, 0)
      straight = crossing()
      straight%svars = converged
      straight%u([3, 10]) = -1.0e-6_dp
      call call_uel(straight, normal, 0)
      call expect(equal(element%amatrx, straight%amatrx) .and. all(abs(element%svars - straight%svars) <= 0) &
         .and. all(abs(element%rhs(:28, 1) - straight%rhs(:28, 1)) <= 0), &
         'as if there had been no other iterate')
   end subroutine test_increments_that_are_cut_back_leave_no_trace

   subroutine test_bad_input_ends_the_analysis_with_its_own_message()
      type(element_t) :: element
      integer :: i
      character(len=40), parameter :: words(9) = [character(len=40) :: 'radii', 'radii', 'Young', 'Young', 'Poisson', &
         'Poisson', 'resistivities', 'resistivities', 'penalty']

      do i = 1, 9
         element = crossing()
         element%props(i) = merge(-1.0_dp, 0.0_dp, i == 5 .or. i == 6)
         call refuse(element, words(i))
         element%props(i) = ieee_value(1.0_dp, ieee_quiet_nan)
         call refuse(element, words(i))
      end do
      do i = 1, 5
         element = crossing()
         element%jprops(i) = 99
         call refuse(element, 'option '//achar(iachar('0') + i))
      end do
      element = crossing()
      element%props = good(:8)
      call refuse(element, 'fewer than 10 real properties')
      element = crossing()
      element%jprops = options(:4)
      call refuse(element, 'fewer than 5 options')
      element = crossing()
      element%jprops(2) = 3
      call refuse(element, 'the numbers of the spot law PLASTIC')
      element%jprops(2) = 7
      call refuse(element, 'the numbers of the spot law SHARVIN')
      element%jprops(2) = 6
      call refuse(element, 'pairs of force and resistance of the spot law TABLE')
      element%props = [good, 1.0_dp, 2.0_dp, 0.5_dp, 1.0_dp]
      call refuse(element, 'must ascend')
      element = crossing()
      element%coords(:, 2) = element%coords(:, 1)
      call refuse(element, 'nodes 1 and 2')
      element = crossing()
      element%coords(:, 4) = element%coords(:, 3)
      call refuse(element, 'nodes 3 and 4')
      element = crossing()
      element%nsvars = 5
      call refuse(element, 'VARIABLES=6')
      element = crossing()
      element%ndofel = 24
      deallocate (element%amatrx)
      allocate (element%amatrx(24, 24))
      call refuse(element, '7 degrees of freedom')
   end subroutine test_bad_input_ends_the_analysis_with_its_own_message

   subroutine refuse(element, words)
      type(element_t), intent(inout) :: element
      !> What the message says
      character(len=*), intent(in) :: words

      call start_host()
      call call_uel(element, normal, 0)
      call expect(n_stops == 1, 'the analysis ends: '//words)
      call expect(index(message, trim(words)) > 0, 'message of '//words//': '//message)
      call expect(index(message, 'element 17') > 0, 'the element is named')
   end subroutine refuse

   subroutine test_a_failure_that_smaller_increments_may_avoid_is_a_warning()
      type(element_t) :: element

      call start_host()
      element = crossing()
      element%u = 0
      element%coords(:, 3:4) = element%coords(:, 1:2)
      element%coords(3, 3:4) = element%coords(3, 1:2) - radius
      call call_uel(element, normal, 0)
      call expect(n_stops == 0 .and. n_warnings == 1 .and. index(message, 'parallel') > 0, 'the reason is told')
      call expect(element%pnewdt < 1, 'the increment is shortened')
      call expect(all(abs(element%svars) <= 0), 'nothing is kept of it')
   end subroutine test_a_failure_that_smaller_increments_may_avoid_is_a_warning

   subroutine test_a_type_that_does_not_exist()
      type(element_t) :: element

      element = crossing()
      element%jtype = 3
      call refuse(element, 'TYPE must be U1')
   end subroutine test_a_type_that_does_not_exist

   !> Ohm's law: 2 mV over 0.5 m of 1 mm^2 with 2e-8 ohm m.
   subroutine test_the_conductor()
      real(dp), parameter :: conductance = 1.0e-6_dp/(2.0e-8_dp*0.5_dp)
      type(element_t) :: element

      call start_host()
      element = bar(2)
      call call_uel(element, normal, 0)
      call expect(near(element%svars(1), 0.2_dp) .and. near(element%svars(2), 0.4e-3_dp), 'current and heat')
      call expect(near(element%rhs(1, 1), -0.2_dp) .and. near(element%rhs(2, 1), 0.2_dp), 'currents leave the nodes')
      call expect(near(element%amatrx(1, 1), conductance) .and. near(element%amatrx(1, 2), -conductance), 'conductance')
      call expect(n_stops == 0, 'nothing wrong')
   end subroutine test_the_conductor

   !> Its tangent over the motions is the difference of its currents.
   subroutine test_the_conductor_over_the_present_length()
      real(dp), parameter :: step = 1.0e-6_dp
      type(element_t) :: element, above, below
      integer :: i

      element = bar(8)
      element%jprops = [1]
      element%u(:3) = [0.01_dp, -0.02_dp, 0.03_dp]
      call call_uel(element, normal, 0)
      do i = 1, 8
         above = element
         below = element
         above%u(i) = above%u(i) + step
         below%u(i) = below%u(i) - step
         call call_uel(above, residual, 0)
         call call_uel(below, residual, 0)
         ! truncation: (step/length)^2 of the entry
         call expect(all(abs((above%rhs(:8, 1) - below%rhs(:8, 1))/(2*step) + element%amatrx(:, i)) < 1.0e-8_dp &
            *maxval(abs(element%amatrx))), 'tangent of the conductor')
      end do
   end subroutine test_the_conductor_over_the_present_length

   subroutine test_the_conductor_refuses()
      type(element_t) :: element

      element = bar(2)
      element%props(1) = 0
      call refuse(element, 'cross-section')
      element = bar(2)
      element%props(2) = 0
      call refuse(element, 'resistivity')
      element = bar(2)
      element%props = [1.0_dp]
      call refuse(element, 'fewer than 2 real properties')
      element = bar(2)
      element%jprops = [1]
      call refuse(element, 'over the present length')
      element = bar(8)
      element%jprops = [2]
      call refuse(element, 'the length, must be 0')
      element = bar(2)
      element%coords(:, 2) = element%coords(:, 1)
      call refuse(element, 'coincide')
      element = bar(2)
      element%nsvars = 1
      call refuse(element, 'VARIABLES=2')
   end subroutine test_the_conductor_refuses

   pure logical function equal(a, b)
      !> Of one shape
      real(dp), intent(in) :: a(:, :), b(:, :)

      equal = all(abs(a - b) <= 0)
   end function equal

   pure logical function near(a, b)
      !> Equal but for the order of the operations
      real(dp), intent(in) :: a, b

      near = abs(a - b) <= 1.0e-13_dp*abs(b)
   end function near

   subroutine expect(condition, what)
      !> What must hold
      logical, intent(in) :: condition
      !> In words
      character(len=*), intent(in) :: what

      if (condition) return
      print '(2a)', 'does not hold: ', trim(what)
      error stop 1
   end subroutine expect

end program test_uel_host
