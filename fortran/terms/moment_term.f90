!> Moments about fixed axes, which do not follow from a potential: what they take off the Hessian of the energy.
!>
!> The same holds for the reaction moment at a node of which one rotation is held and two are free, about fixed axes of
!> its own where it has these, and for what an equation does to rotations about single axes: this term comes after those
!> that make the forces. Source: theory sections 3 and 17.
module litz_moment_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: rotation_slots
   use litz_model, only: n_nodes_of_deck
   use litz_rotations, only: skew
   use litz_term, only: term_t
   implicit none
   private
   public :: moment_term_t

   type, extends(term_t) :: moment_term_t
   contains
      procedure :: evaluate
   end type moment_term_t

contains

   subroutine evaluate(self, domain, error)
      class(moment_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: moment(3)
      integer :: node
      logical :: free(3)

      if (domain%motions_stand) return
      associate (first => rotation_slots(1), last => rotation_slots(2), load => domain%loading%load, &
         internal => domain%forces%internal, constraints => domain%iterate%constraints)
         do node = 1, size(load, 2)
            free = domain%equations%number(first:last, node) > 0 .or. constraints%of(first:last, node) > 0
            if (constraints%turns_alone(node)) then
               moment = internal(first:last, node)
            else
               if (count(free) < 2) cycle
               moment = merge(load(first:last, node), moment_at(domain, node), free)
            end if
            if (.not. any(abs(moment) > 0)) cycle
            call domain%lose_symmetry()
            call domain%add_turning(node, -skew(moment)/2)
         end do
      end associate
   end subroutine evaluate

   !> What the cells do to a node, or to the one whose rotations about local axes it stands for [N m].
   pure function moment_at(domain, node) result(moment)
      type(domain_t), intent(in) :: domain
      !> Node
      integer, intent(in) :: node
      real(dp) :: moment(3)

      associate (internal => domain%forces%internal(rotation_slots(1):rotation_slots(2), :), &
         i => node - n_nodes_of_deck(domain%model))
         moment = internal(:, node)
         if (i <= 0) return
         associate (local => domain%model%local_axes(i))
            if (domain%iterate%constraints%turns_alone(local%node)) return
            moment = matmul(internal(:, local%node), local%axes)
         end associate
      end associate
   end function moment_at

end module litz_moment_term
