!> What is wrong with the contacts of a converged state, so that it is no solution.
module litz_contact_findings
   use litz_contact_joints, only: joined_radii
   use litz_kinds, only: dp, pi
   use litz_model, only: model_t
   use litz_text, only: to_text
   use litz_wires, only: corner_angle
   implicit none
   private
   public :: finding_t, worse_of
   public :: finding_none, finding_deep, finding_missed, finding_second, finding_joined, finding_end, finding_kink, &
      finding_line, finding_tight, finding_departed, finding_passed, finding_turned, finding_unfollowed, &
      finding_surface_deep, finding_surface_passed, finding_surface_turned

   !> From harmless to serious: of two findings the later one is reported
   integer, parameter :: finding_none = 0
   !> A contact overlaps by more than is allowed
   integer, parameter :: finding_deep = 1
   !> Wires overlap where there is no contact: without a reason that is known; beside another contact of the same two
   !> elements; of joined elements, beyond their joint
   integer, parameter :: finding_missed = 2, finding_second = 3, finding_joined = 4
   !> ... at the end of a wire; at a kink; side by side, or a contact as long as a line
   integer, parameter :: finding_end = 5, finding_kink = 6, finding_line = 7
   !> A wire is bent so tightly that both sides of the bend overlap
   integer, parameter :: finding_tight = 8
   !> The axes of two wires met on their way through the increment; a wire turned so far that its way is not known
   integer, parameter :: finding_passed = 9, finding_turned = 10
   !> A contact has left the part of a wire that the contact pair names
   integer, parameter :: finding_departed = 11
   !> A contact slides so far in the increment that it may be any of several
   integer, parameter :: finding_unfollowed = 12
   !> A wire and a rigid surface overlap by more than is allowed; it would have passed through the surface; the surface
   !> turned so far that the way of what it touches is not known
   integer, parameter :: finding_surface_deep = 13, finding_surface_passed = 14, finding_surface_turned = 15

   type :: finding_t
      integer :: kind = finding_none
      !> Elements, barred first; on a rigid surface twice the same
      integer :: elements(2) = 0
      !> Overlap over the smaller radius [-]
      real(dp) :: overlap = 0
      !> Penalty that would hold a deep contact, and its unit; 0: it has a law without one, which is called so
      real(dp) :: penalty = 0
      character(len=8) :: unit = 'N/m'
      character(len=40) :: law_title = ''
      !> What of the surface interaction does not serve contact along a line; blank: all of it does
      character(len=120) :: obstacle = ''
      !> A contact has become what its laws do not serve: smaller increments come to the same
      logical :: is_final = .false.
      !> Index of the rigid surface; 0: both are wires
      integer :: surface = 0
   contains
      procedure :: is_like
      procedure :: can_be_cut
      procedure :: describe
      procedure :: advice
   end type finding_t

contains

   !> The more serious of two findings; the first of two alike.
   pure type(finding_t) function worse_of(a, b) result(worse)
      type(finding_t), intent(in) :: a, b

      worse = a
      if (b%kind > a%kind .or. (b%kind == a%kind .and. b%overlap > a%overlap)) worse = b
   end function worse_of

   !> The same is wrong with the same two wires.
   pure logical function is_like(self, other, wire)
      class(finding_t), intent(in) :: self
      type(finding_t), intent(in) :: other
      !> Wire of each element (n_elements)
      integer, intent(in) :: wire(:)

      is_like = self%kind == other%kind .and. self%kind /= finding_none .and. self%surface == other%surface
      if (is_like) is_like = all(wire(self%elements) == wire(other%elements))
   end function is_like

   !> A smaller increment can do better: the motion is to blame, and not what litz does not model.
   pure logical function can_be_cut(self)
      class(finding_t), intent(in) :: self

      can_be_cut = any(self%kind == [finding_passed, finding_missed, finding_turned, finding_departed, &
         finding_unfollowed, finding_surface_passed, finding_surface_turned])
   end function can_be_cut

   !> What was found, with the two elements.
   pure function describe(self, model) result(text)
      class(finding_t), intent(in) :: self
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: text, pair, depth

      pair = 'the wires of elements '//to_text(model%element_id(self%elements(1)))//' and '// &
         to_text(model%element_id(self%elements(2)))
      depth = ' overlap by '//to_text(100*self%overlap)//' % of the smaller radius'
      if (self%surface > 0) pair = 'the wire of element '//to_text(model%element_id(self%elements(1)))// &
         ' and the rigid surface '//model%surfaces(self%surface)%name
      select case (self%kind)
      case (finding_surface_deep)
         text = pair//' overlap by '//to_text(100*self%overlap)//' % of the radius of the wire, 5 % are allowed'
      case (finding_surface_passed)
         text = pair//': the wire would pass through it, or slide round it by more than a'// &
            ' right angle, in this increment'
      case (finding_surface_turned)
         text = 'the rigid surface '//model%surfaces(self%surface)%name//' turns by more than 90 degrees in this'// &
            ' increment: contacts along the way cannot be determined'
      case (finding_deep)
         text = pair//depth//', 5 % are allowed'
      case (finding_second)
         text = pair//' cross a second time within these elements, and'//depth//' there'
      case (finding_joined)
         text = pair//', which are joined, touch beyond their joint, and'//depth//' there'
      case (finding_end)
         text = pair//' touch at the end of one of them, and'//depth//' there'
      case (finding_kink)
         text = pair//' touch at a kink of one of them, and'//depth//' there'
      case (finding_line)
         text = pair//' touch side by side, along a line, and'//depth//' there'
      case (finding_tight)
         text = 'the wire of elements '//to_text(model%element_id(minval(self%elements)))//' to '// &
            to_text(model%element_id(maxval(self%elements)))//' is bent more tightly than it is thick: the sides'// &
            ' of the bend'//depth
      case (finding_departed)
         text = 'the contact of '//pair//' has left the part of one of them that *CONTACT PAIR names, and they'// &
            ' overlap by '//to_text(100*self%overlap)//' % of the smaller radius beyond it'
      case (finding_turned)
         text = 'the wire of element '//to_text(model%element_id(self%elements(1)))// &
            ' turns by more than 150 degrees in this increment: contacts along the way cannot be determined'
      case (finding_unfollowed)
         text = 'the contact of '//pair//' slides so far in this increment that it cannot be distinguished from others'
      case (finding_passed)
         text = pair//' would pass through each other in this increment'
      case default
         text = pair//depth//' where there is no contact'
      end select
   end function describe

   !> What can be done about it.
   pure function advice(self, model, procedure) result(text)
      class(finding_t), intent(in) :: self
      type(model_t), intent(in) :: model
      !> The keyword that has the increments
      character(len=*), intent(in) :: procedure
      character(len=:), allocatable :: text

      select case (self%kind)
      case (finding_surface_deep)
         text = 'The force is too large for this wire, or its contact too soft (second number of LINEAR in'// &
            ' *SURFACE BEHAVIOR). '
      case (finding_surface_passed, finding_surface_turned)
         text = 'Begin with a smaller increment (first value of '//procedure//'). '
      case (finding_deep)
         text = 'The '//trim(self%law_title)//' is valid for smaller overlaps: the force is too large for these wires. '
         if (self%penalty > 0) text = 'The contact force there requires a penalty of at least '// &
            to_text(self%penalty)// &
            model%units%after(trim(self%unit))//' (*SURFACE BEHAVIOR). '
      case (finding_second)
         text = 'Each pair of elements can have four contacts: use shorter elements. '
      case (finding_joined)
         text = 'Elements of two wires have no contact where the way from one to the other, along wires that meet'// &
            ' at nodes, is shorter than '//to_text(nint(joined_radii))//' radii; a node at which a wire turns'// &
            ' by more than '//to_text(nint(corner_angle*180/pi))//' degrees joins two wires, too. Draw bends with'// &
            ' smaller turns at each node, use shorter elements, or bend the wire less. '
      case (finding_tight)
         text = 'A bend with a radius of curvature below the radius of the wire folds into itself, which no law of'// &
            ' contact describes: bend the wire less, or model a thinner one. '
      case (finding_end, finding_departed)
         text = 'Contact at the end of the part of a wire that *CONTACT PAIR names is not modelled: let it name the'// &
            ' whole wire. '
      case (finding_kink)
         text = 'With AXIS=LINEAR a wire has a kink at each node, and both of its elements touch what lies in its'// &
            ' crook: use AXIS=HERMITE, or shorter elements. '
      case (finding_line)
         text = 'Their surface interaction is for contact at points: '//trim(self%obstacle)//' does not serve'// &
            ' contact along a line. Change it, keep such wires apart, or let them cross at larger angles. '
         if (len_trim(self%obstacle) == 0) text = 'Use shorter elements there, so that the places of the contact'// &
            ' are closer to each other. '
      case (finding_unfollowed)
         text = 'Begin with a smaller increment (first value of '//procedure//'). '
      case default
         text = 'Begin with a smaller increment (first value of '//procedure//'), or stiffen the contact'// &
            ' (*SURFACE BEHAVIOR). '
      end select
   end function advice

end module litz_contact_findings
