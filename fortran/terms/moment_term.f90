!> Moments about fixed axes, which do not follow from a potential: what they take off the Hessian of the energy.
!>
!> The same holds for the reaction moment at a node of which one rotation is held and two are free, and for what an
!> equation does to rotations about single axes: this term comes after those that make the forces. Source: theory
!> sections 3 and 17.
module litz_moment_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: rotation_slots
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
               moment = merge(load(first:last, node), internal(first:last, node), free)
            end if
            if (.not. any(abs(moment) > 0)) cycle
            call domain%lose_symmetry()
            call domain%add_turning(node, -skew(moment)/2)
         end do
      end associate
   end subroutine evaluate

end module litz_moment_term
