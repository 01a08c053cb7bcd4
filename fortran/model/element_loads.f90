!> Forces on the length of elements: what *DLOAD and *LORENTZ give.
module litz_element_loads
   use litz_kinds, only: dp
   implicit none
   private
   public :: element_load_t, load_kind_named, load_label, load_choices, field_axes, field_planes, axes_of_planes
   public :: load_px, load_pz, load_p1, load_p2, load_grav, load_lorentz, n_load_kinds, n_dload_kinds

   !> Force per length along the global axes, and along the section axes, with which it turns; weight by an
   !> acceleration; force of a magnetic field on the current
   integer, parameter :: load_px = 1, load_pz = 3, load_p1 = 4, load_p2 = 5, load_grav = 6, load_lorentz = 7
   integer, parameter :: n_load_kinds = 7, n_dload_kinds = 6

   !> Labels of *DLOAD, in the order of the kinds; the last has a card of its own
   character(len=7), parameter :: labels(n_load_kinds) = [character(len=7) :: 'PX', 'PY', 'PZ', 'P1', 'P2', 'GRAV', &
      'LORENTZ']

   !> Axes along which *LORENTZ, ALONG gives a field
   character(len=1), parameter :: field_axes(3) = ['X', 'Y', 'Z']
   !> Planes over which it does, and both axes of each (2, 3)
   character(len=2), parameter :: field_planes(3) = ['XY', 'XZ', 'YZ']
   integer, parameter :: axes_of_planes(2, 3) = reshape([1, 2, 1, 3, 2, 3], [2, 3])

   type :: element_load_t
      integer :: element = 0
      !> One of `load_...`
      integer :: kind = 0
      !> At the end of the step, and before it. PX to P2: force per length [N/m]; GRAV: acceleration (3) [m/s^2];
      !> LORENTZ: flux density at the origin (3), and its derivatives by x, by y and by z (9) [N/(A m), N/(A m^2)]
      real(dp) :: value(12) = 0, before(12) = 0
      !> What these follow, indices into `amplitudes`; 0: the load ramps over the step
      integer :: amplitude = 0, before_amplitude = 0
   end type element_load_t

contains

   !> Kind of load with this label; 0: there is none.
   pure integer function load_kind_named(label) result(kind)
      !> In capitals
      character(len=*), intent(in) :: label

      kind = findloc(labels == label, .true., 1)
   end function load_kind_named

   pure function load_label(kind) result(label)
      !> One of `load_...`
      integer, intent(in) :: kind
      character(len=:), allocatable :: label

      label = trim(labels(kind))
   end function load_label

   !> The labels of *DLOAD, separated by bars: `PX|PY|...`.
   pure function load_choices() result(text)
      character(len=:), allocatable :: text
      integer :: i

      text = load_label(1)
      do i = 2, n_dload_kinds
         text = text//'|'//load_label(i)
      end do
   end function load_choices

end module litz_element_loads
