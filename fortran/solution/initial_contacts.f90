!> The contacts of the reference configuration: interference fits, and overlaps that are errors.
module litz_initial_contacts
   use litz_contact_findings, only: finding_t, finding_none, finding_deep
   use litz_contact_net, only: inspect_contacts
   use litz_contact_candidates, only: find_candidates
   use litz_contact_crossings, only: locate_points
   use litz_contact_points, only: contact_point_t
   use litz_errors, only: error_t, fail, exit_input
   use litz_kinds, only: dp
   use litz_line_points, only: locate_line_points
   use litz_line_shares, only: share_crossings
   use litz_model, only: model_t, procedure_of
   use litz_problem, only: problem_t
   use litz_surface_findings, only: overlaps_of_surfaces
   use litz_text, only: to_text
   use litz_wire_turning, only: measure_turning
   implicit none
   private
   public :: find_initial_overlap

   !> Wires may overlap in the reference by this fraction of the smaller radius without being an interference fit
   real(dp), parameter :: allowed_overlap = 0.01_dp

contains

   !> Largest overlap of the reference configuration for each pair that is meant as an interference fit; an error for
   !> any other pair.
   subroutine find_initial_overlap(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error
      logical :: changed

      call refuse_surface_overlap(problem, error)
      if (allocated(error) .or. .not. problem%contact%present) return
      associate (model => problem%model, contact => problem%contact, state => problem%state)
         call measure_turning(model, problem%wires, problem%elements, model%x, state%rotation, contact%turning)
         call find_candidates(model, problem%wires, problem%elements, model%x, state%rotation, model%x, &
            state%rotation, contact, changed, error)
         if (allocated(error)) return
         call locate_points(model, problem%wires, problem%elements, model%x, state%rotation, model%x, state%rotation, &
            contact)
         ! whatever place a fit may come to needs its own part of it from the start
         if (any(model%contact_pairs%interference_fit)) contact%depth = max(0.0_dp, maxval(-contact%points%gap))
         call locate_line_points(model, problem%wires, problem%elements, model%x, state%rotation, model%x, &
            state%rotation, contact)
         call share_crossings(model, problem%wires, problem%elements, contact)
         call find_fits(model, contact%points, contact%overlap)
         call find_fits(model, contact%line_points, contact%overlap)
         contact%converged = contact%points
         allocate (contact%left_dents%wires(3, 0), contact%left_dents%dents(0))
         contact%converged_line_points = contact%line_points
         ! an interference fit begins without stress: what resolves it does work from the first increment on
         contact%clearance = contact%overlap
         contact%converged_clearance = contact%overlap
         call refuse_unmodelled(problem, error)
         if (.not. allocated(error)) call refuse_overlap(problem, error)
      end associate
   end subroutine find_initial_overlap

   !> What is to be resolved at each crossing or place of a line of the pairs that are meant as an interference fit.
   pure subroutine find_fits(model, points, largest)
      type(model_t), intent(in) :: model
      !> Of the reference configuration
      type(contact_point_t), intent(inout) :: points(:)
      !> Largest overlap of each pair so far (n_pairs) [m]
      real(dp), intent(inout) :: largest(:)
      integer :: i

      do i = 1, size(points)
         associate (point => points(i))
            if (.not. model%contact_pairs(point%pair)%interference_fit) cycle
            point%fit = max(0.0_dp, -point%gap)
            largest(point%pair) = max(largest(point%pair), point%fit)
         end associate
      end do
   end subroutine find_fits

   !> Wires that overlap at the start by more than is allowed, and are not meant to.
   subroutine refuse_overlap(problem, error)
      type(problem_t), intent(in) :: problem
      type(error_t), allocatable, intent(inout) :: error
      integer :: n_refused, worst, worst_of_lines

      n_refused = 0
      associate (points => problem%contact%points, line_points => problem%contact%line_points)
         call find_refused(problem, points, n_refused, worst)
         call find_refused(problem, line_points, n_refused, worst_of_lines)
         if (n_refused == 0) return
         if (worst > 0 .and. worst_of_lines > 0) then
            if (line_points(worst_of_lines)%gap < points(worst)%gap) worst = 0
         end if
         if (worst > 0) then
            error = overlap_error(problem, n_refused, points(worst))
         else
            error = overlap_error(problem, n_refused, line_points(worst_of_lines))
         end if
      end associate
   end subroutine refuse_overlap

   !> Points of pairs without an interference fit that overlap by more than is allowed.
   pure subroutine find_refused(problem, points, n_refused, worst)
      type(problem_t), intent(in) :: problem
      type(contact_point_t), intent(in) :: points(:)
      !> Number so far
      integer, intent(inout) :: n_refused
      !> The one of these points that overlaps most; 0: none
      integer, intent(out) :: worst
      integer :: i

      worst = 0
      do i = 1, size(points)
         if (problem%model%contact_pairs(points(i)%pair)%interference_fit) cycle
         if (.not. -points(i)%gap > allowed_overlap*smaller_radius(problem, points(i))) cycle
         n_refused = n_refused + 1
         if (worst == 0) worst = i
         if (points(i)%gap < points(worst)%gap) worst = i
      end do
   end subroutine find_refused

   type(error_t) function overlap_error(problem, n_refused, point) result(error)
      type(problem_t), intent(in) :: problem
      !> Points that overlap too much
      integer, intent(in) :: n_refused
      !> The worst one
      type(contact_point_t), intent(in) :: point
      character(len=400) :: text

      associate (model => problem%model, pair => problem%model%contact_pairs(point%pair))
         write (text, '(a, i0, a, i0, a, es9.2, a, a, a, i0, a)') 'the wires of elements ', &
            model%element_id(point%element_bar), ' and ', model%element_id(point%element), &
            ' overlap at the start by', -point%gap, model%units%after('m')//', that is ', &
            to_text(-100*point%gap/smaller_radius(problem, point)), &
            ' % of the smaller radius (allowed: 1 %; ', n_refused, &
            ' places overlap in all); move the wires apart, or add INTERFERENCE FIT to *CONTACT PAIR'
         error = fail(exit_input, trim(text))
         error%file = pair%file
         error%line = pair%line
      end associate
   end function overlap_error

   !> Of the two wires of a point [m].
   pure real(dp) function smaller_radius(problem, point)
      type(problem_t), intent(in) :: problem
      type(contact_point_t), intent(in) :: point

      smaller_radius = minval(problem%elements%radius([point%element_bar, point%element]))
   end function smaller_radius

   !> Wires that begin within a rigid surface.
   subroutine refuse_surface_overlap(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error
      type(finding_t) :: finding

      if (size(problem%model%surface_pairs) == 0) return
      call problem%iterate%start(problem%state, problem%model%x)
      finding = overlaps_of_surfaces(problem%domain_t, allowed_overlap)
      if (finding%kind == finding_none) return
      error = fail(exit_input, 'the wire of element '//to_text(problem%model%element_id(finding%elements(1)))// &
         ' overlaps the rigid surface '//problem%model%surfaces(finding%surface)%name//' at the start by '// &
         to_text(100*finding%overlap)//' % of its radius (allowed: 1 %): move one of them')
   end subroutine refuse_surface_overlap

   !> Wires that overlap at the start in a way that is not modelled.
   subroutine refuse_unmodelled(problem, error)
      type(problem_t), intent(in) :: problem
      type(error_t), allocatable, intent(out) :: error
      type(finding_t) :: finding

      finding = inspect_contacts(problem%model, problem%wires, problem%elements, problem%contact, problem%model%x, &
         problem%state%rotation)
      if (finding%kind == finding_none .or. finding%kind == finding_deep) return
      error = fail(exit_input, 'at the start '//finding%describe(problem%model)//'. '// &
         finding%advice(problem%model, procedure_of(problem%model%steps(1))))
   end subroutine refuse_unmodelled

end module litz_initial_contacts
