!> The unknowns of a node: one table of fields, and the slots in which their components stand.
!>
!> State, loads, reactions and corrections are arrays (n_slots, n_nodes). A field has the slots
!> `first_slot(field):last_slot(field)`, a group of fields those from `first_slot_of_group` to `last_slot_of_group`. A
!> group is what the scheme solves for at once; how groups depend on each other says `depends_on`. A field whose unknown
!> no term has at a node may still have a value there, which is given, such as a temperature.
!>
!> Decks, results, tables of progress, restart files, tolerances and messages follow the rows.
module litz_fields
   use litz_text, only: to_text, join_words
   implicit none
   private
   public :: field_t, fields, n_fields, field_displacement, field_rotation, field_potential, field_temperature
   public :: n_slots, first_slot, last_slot, field_of_slot, slot_of_dof
   public :: motion_slots, rotation_slots, potential_slots, temperature_slots, slots_of_fields
   public :: last_dof, max_dof, field_of_dof, dof_range, describe_dofs, list_units
   public :: n_groups, group_mechanical, group_transport, first_slot_of_group, last_slot_of_group, depends_on

   type :: field_t
      !> As in the names of results
      character(len=16) :: name
      character(len=40) :: meaning
      !> Of its largest correction, in the names of columns
      character(len=3) :: symbol
      !> Its first place among the unknowns of a node, and how many it has
      integer :: first_slot, n_components
      !> Abaqus's number of its first degree of freedom
      integer :: first_dof
      integer :: group
      !> Sums of its corrections are turns about fixed axes
      logical :: is_rotation
      !> Only its differences matter: a part without a path to a prescribed value floats
      logical :: is_level
      character(len=8) :: unit
      !> What does work on it or flows by it, the residual of its equations: in the names of results, and in sentences
      character(len=8) :: flux
      character(len=12) :: flux_in_words
      character(len=8) :: flux_unit
      !> By which decks ask for its values, for its reactions and for its loads in the history
      character(len=8) :: value_word, reaction_word, load_word
      !> Keyword of its loads
      character(len=12) :: load_keyword
      !> Files show it only where the model has it
      logical :: is_optional
   end type field_t

   !> What moves, and what flows through the wires
   integer, parameter :: group_mechanical = 1, group_transport = 2

   type(field_t), parameter :: fields(*) = [ &
      field_t('displacement', 'displacement from the reference position', 'u', 1, 3, 1, group_mechanical, &
      .false., .false., 'm', 'force', 'force', 'N', 'U', 'RF', 'CF', 'CLOAD', .false.), &
      field_t('rotation', 'rotation vector from the reference', 'phi', 4, 3, 4, group_mechanical, &
      .true., .false., 'rad', 'moment', 'moment', 'N m', 'UR', 'RM', 'CM', 'CLOAD', .false.), &
      field_t('potential', 'electric potential', 'V', 7, 1, 9, group_transport, &
      .false., .true., 'V', 'current', 'current', 'A', 'EPOT', 'RCURR', 'CECUR', 'CECURRENT', .false.), &
      field_t('temperature', 'temperature, on the scale of the deck', 'T', 8, 1, 11, group_transport, &
      .false., .true., 'K', 'heat', 'heat flow', 'W', 'NT', 'RFL', 'CFL', 'CFLUX', .true.)]
   integer, parameter :: field_displacement = 1, field_rotation = 2, field_potential = 3, field_temperature = 4

   integer, private :: i, j
   integer, parameter :: n_fields = size(fields)
   integer, parameter :: first_slot(n_fields) = fields%first_slot
   integer, parameter :: last_slot(n_fields) = fields%first_slot + fields%n_components - 1
   integer, parameter :: n_slots = maxval(last_slot)
   !> In Abaqus's numbers
   integer, parameter :: last_dof(n_fields) = fields%first_dof + fields%n_components - 1
   integer, parameter :: max_dof = maxval(last_dof)
   !> First and last slot of displacements and rotations, of rotations, of potentials, and of temperatures
   integer, parameter :: motion_slots(2) = [first_slot(field_displacement), last_slot(field_rotation)]
   integer, parameter :: rotation_slots(2) = [first_slot(field_rotation), last_slot(field_rotation)]
   integer, parameter :: potential_slots(2) = [first_slot(field_potential), last_slot(field_potential)]
   integer, parameter :: temperature_slots(2) = [first_slot(field_temperature), last_slot(field_temperature)]
   integer, parameter :: field_of_slot(n_slots) = [(count(first_slot <= i), i=1, n_slots)]
   integer, parameter :: n_groups = maxval(fields%group)
   integer, parameter :: first_slot_of_group(n_groups) = [(minval(first_slot, fields%group == i), i=1, n_groups)]
   integer, parameter :: last_slot_of_group(n_groups) = [(maxval(last_slot, fields%group == i), i=1, n_groups)]

   !> The equations of the first group may have the unknowns of the second one in them: a group depends on those before
   !> it, as currents change with the spots
   logical, parameter :: depends_on(n_groups, n_groups) = reshape([((i >= j, i=1, n_groups), j=1, n_groups)], &
      [n_groups, n_groups])

contains

   !> Slot of a degree of freedom in Abaqus's numbers; 0: there is none.
   pure integer function slot_of_dof(dof) result(slot)
      !> Such as 1-6, 9
      integer, intent(in) :: dof
      integer :: field

      slot = 0
      field = field_of_dof(dof)
      if (field > 0) slot = first_slot(field) + dof - fields(field)%first_dof
   end function slot_of_dof

   !> Field of a degree of freedom in Abaqus's numbers; 0: there is none.
   elemental integer function field_of_dof(dof) result(field)
      !> Such as 1-6, 9
      integer, intent(in) :: dof

      do field = 1, n_fields
         if (dof >= fields(field)%first_dof .and. dof <= last_dof(field)) return
      end do
      field = 0
   end function field_of_dof

   !> The slots of some of the fields, ascending.
   pure function slots_of_fields(chosen) result(slots)
      !> (n_fields)
      logical, intent(in) :: chosen(:)
      integer, allocatable :: slots(:)
      integer :: slot

      slots = pack([(slot, slot=1, n_slots)], chosen(field_of_slot))
   end function slots_of_fields

   !> The degrees of freedom of neighbouring fields as `1-6`, or `9` where there is only one.
   pure function dof_range(first, last) result(text)
      !> The first field
      integer, intent(in) :: first
      !> The last field; absent: the first one
      integer, intent(in), optional :: last
      character(len=:), allocatable :: text
      integer :: last_field

      last_field = first
      if (present(last)) last_field = last
      text = to_text(fields(first)%first_dof)
      if (last_dof(last_field) > fields(first)%first_dof) text = text//'-'//to_text(last_dof(last_field))
   end function dof_range

   !> All degrees of freedom in words: `1-3 (displacement), 4-6 (rotation) or 9 (potential)`.
   pure function describe_dofs(conjunction) result(text)
      !> What stands before the last field: `and`, `or`
      character(len=*), intent(in) :: conjunction
      character(len=:), allocatable :: text
      character(len=24) :: words(n_fields)
      integer :: field

      do field = 1, n_fields
         words(field) = dof_range(field)//' ('//trim(fields(field)%name)//')'
      end do
      text = join_words(words, conjunction)
   end function describe_dofs

   !> The units of all fields: `m, rad or V`.
   pure function list_units() result(text)
      character(len=:), allocatable :: text

      text = join_words(fields%unit, 'or')
   end function list_units

end module litz_fields
