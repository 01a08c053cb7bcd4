!> What adds to the equations: beams, conductors, contacts, dampers. A run asks each of a list of terms.
!>
!> A term says what it is by what it does when it is asked; what a term has nothing to say about is left as it is here.
!> Forces are internal ones: the residual of a node is the sum over the terms minus the load.
module litz_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_model, only: step_t
   use litz_state, only: energies_t
   implicit none
   private
   public :: term_t, term_entry_t, status_t
   public :: max_anticipations, nearly_balanced

   !> In how many iterations of an increment terms anticipate at most: as many as it takes from there, so that nothing
   !> is left to update where forces balance; and the largest force that is left over by then, over the largest that
   !> they bear
   integer, parameter :: max_anticipations = 5
   real(dp), parameter :: nearly_balanced = 0.1_dp

   !> One-sided conditions of an iteration: contacts that are closed.
   type :: status_t
      !> Those that hold; those that hold against, and that do not hold in spite of, what the last iteration predicted
      integer :: active = 0, new = 0, lost = 0
      !> Sum of the forces of those that hold [N], and deepest overlap [m]
      real(dp) :: force = 0, penetration = 0
   end type status_t

   type, abstract :: term_t
   contains
      !> What the term is made of
      procedure :: request_slots
      procedure :: connect
      !> An increment begins
      procedure :: apply_load
      procedure :: start
      !> An iteration
      procedure :: locate
      procedure(evaluate), deferred :: evaluate
      procedure :: refusal
      procedure :: rejection
      procedure :: exceeded_limit
      procedure :: count_status
      procedure :: link
      procedure :: hold
      procedure :: has_mutual_tangent
      procedure :: add_mutual_tangent
      procedure :: foresee
      procedure :: suppose
      procedure :: bearable_fraction
      procedure :: shorten
      procedure :: follow
      procedure :: predict
      procedure :: anticipate
      procedure :: settle
      procedure :: bearable_increment
      !> An increment has converged
      procedure :: agree
      procedure :: add_energies
      procedure :: accept
   end type term_t

   !> A place in the list of terms.
   type :: term_entry_t
      class(term_t), allocatable :: term
   end type term_entry_t

   abstract interface
      !> Add the forces at the present iterate and their tangent to the system.
      subroutine evaluate(self, domain, error)
         import :: term_t, domain_t, error_t
         implicit none
         class(term_t), intent(inout) :: self
         type(domain_t), intent(inout) :: domain
         !> Input that cannot be evaluated; no smaller increment would help
         type(error_t), allocatable, intent(out) :: error
      end subroutine evaluate
   end interface

contains

   !> Mark the unknowns that the cells of the term have.
   subroutine request_slots(self, domain, exists)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
   end subroutine request_slots

   !> Nodes that share a cell of the term, unless it is an element: entries of the tangent.
   subroutine connect(self, domain, nodes)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (nodes of a cell, cells)
      integer, allocatable, intent(out) :: nodes(:, :)

      allocate (nodes(0, 0))
   end subroutine connect

   !> What the time at the end of the increment prescribes.
   subroutine apply_load(self, domain, step, step_time, increment)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment
   end subroutine apply_load

   !> The iterate has been set to the last converged state.
   subroutine start(self, domain)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
   end subroutine start

   !> Find the cells at the present iterate, before the pattern of the tangent is needed.
   subroutine locate(self, domain, error)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> There are more than can be counted
      type(error_t), allocatable, intent(out) :: error
   end subroutine locate

   !> Why the iteration cannot go on from here; empty where it can. A smaller increment may not come here.
   function refusal(self, domain) result(reason)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = ''
   end function refusal

   !> Why the iterate, whose residuals are within their tolerances, is no solution; empty where it is one.
   function rejection(self, domain) result(reason)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = ''
   end function rejection

   !> Which limit of the deck the iterate is beyond, though it may be a solution; empty: all are kept.
   function exceeded_limit(self, domain) result(reason)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = ''
   end function exceeded_limit

   !> Add to the numbers of one-sided conditions.
   subroutine count_status(self, status)
      class(term_t), intent(in) :: self
      type(status_t), intent(inout) :: status
   end subroutine count_status

   !> Pairs of nodes between which the flux of a field can pass.
   subroutine link(self, domain, field, pairs)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)

      allocate (pairs(2, 0))
   end subroutine link

   !> Mark nodes at which the term determines the level of a field.
   subroutine hold(self, domain, field, held)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(inout) :: held(:)
   end subroutine hold

   !> The tangent of a group has more than the matrix holds: what cells of the term do to each other.
   logical function has_mutual_tangent(self, group)
      class(term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      has_mutual_tangent = .false.
   end function has_mutual_tangent

   !> Add that tangent times values.
   subroutine add_mutual_tangent(self, group, accuracy, value, force)
      class(term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> Of what is solved for within, relative
      real(dp), intent(in) :: accuracy
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: force(:, :)
   end subroutine add_mutual_tangent

   !> A linear step has been found: what it may bring into play takes part in what is asked of it.
   subroutine foresee(self, domain, correction)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
   end subroutine foresee

   !> One-sided conditions that a linear step changes are supposed to be as it has them, where the iterate is, if there
   !> are so many that the step is worth taking anew.
   subroutine suppose(self, domain, correction, has_changed)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
      !> Forces and tangent are to be assembled again
      logical, intent(inout) :: has_changed
   end subroutine suppose

   !> The part of a step, at most 1, that the linearisation of the term is good for.
   real(dp) function bearable_fraction(self, domain, step, correction)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)

      bearable_fraction = 1
   end function bearable_fraction

   !> Keep the correction of a group that takes its turn to where the linearisation of the term ends, node by node.
   subroutine shorten(self, domain, correction)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
   end subroutine shorten

   !> A group that takes its turn is about to change by a correction: the term takes along what it iterates itself.
   subroutine follow(self, domain, correction)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
   end subroutine follow

   !> The increment that has converged, over the largest one that the term bears: less than 1 is a reason for another.
   subroutine bearable_increment(self, domain, step, ratio, reason)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Over the one that has converged
      real(dp), intent(out) :: ratio
      !> Why no larger one is, for messages
      character(len=:), allocatable, intent(out) :: reason

      ratio = huge(ratio)
      reason = ''
   end subroutine bearable_increment

   !> The next evaluation takes what the term iterates itself from the unknowns instead.
   subroutine agree(self)
      class(term_t), intent(inout) :: self
   end subroutine agree

   !> Take what the term iterates itself along with the step `eta dq` of the unknowns.
   subroutine predict(self, domain, eta, correction)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, correction(:, :)
   end subroutine predict

   !> The forces do not balance yet: what the term holds back in the iteration may take its place if it will hardly be
   !> another in the end.
   subroutine anticipate(self, domain, residual, has_moved)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Largest force that is left over at any node [N]
      real(dp), intent(in) :: residual
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
   end subroutine anticipate

   !> The forces balance: what the term has held back in the iteration takes its place.
   subroutine settle(self, domain, has_moved)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
   end subroutine settle

   !> Energies at the end of an increment that has converged; the state is still that of its start.
   subroutine add_energies(self, domain, energies)
      class(term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies
   end subroutine add_energies

   !> The increment has converged: results and memory of the term.
   subroutine accept(self, domain)
      class(term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
   end subroutine accept

end module litz_term
