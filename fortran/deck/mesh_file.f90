!> Mesh files: nodes, elements and sets in HDF5, for models that are too large to be read from text.
!>
!>     /nodes/id (n), /nodes/position (n, 3)                  number and position [m] of each node
!>     /elements/TYPE/id (m), /elements/TYPE/nodes (m, 2)     number of each element and of its two nodes, by type
!>     /node_sets/NAME (k), /element_sets/NAME (k)            numbers of the members of a set
module litz_mesh_file
   use litz_element_types, only: element_types, list_element_types
   use litz_errors, only: error_t, fail, exit_input
   use litz_hdf5_input, only: hid_t, longest_name, hdf5_open_file, hdf5_close_input, hdf5_has, hdf5_names, &
      hdf5_read_integers, hdf5_read_reals
   use litz_kinds, only: dp
   use litz_text, only: to_text
   implicit none
   private
   public :: mesh_file_t, mesh_set_t, read_mesh_file

   type :: mesh_set_t
      character(len=:), allocatable :: name
      integer, allocatable :: ids(:)
   end type mesh_set_t

   type :: mesh_file_t
      integer, allocatable :: node_id(:)
      !> (3, n) [m]
      real(dp), allocatable :: position(:, :)
      integer, allocatable :: element_id(:), element_type(:)
      !> Numbers of the nodes of each element (2, m)
      integer, allocatable :: element_nodes(:, :)
      type(mesh_set_t), allocatable :: node_sets(:), element_sets(:)
   end type mesh_file_t

contains

   !> Everything a mesh file holds; empty after an error.
   subroutine read_mesh_file(path, mesh, error)
      !> The mesh file
      character(len=*), intent(in) :: path
      type(mesh_file_t), intent(out) :: mesh
      !> What the file does or has, to follow its name
      type(error_t), allocatable, intent(out) :: error
      type(mesh_file_t) :: nothing
      integer(hid_t) :: file
      integer :: i

      call start_empty(mesh)
      call hdf5_open_file(path, file, error)
      call read_nodes(file, mesh, error)
      do i = 1, size(element_types)
         call read_elements(file, i, mesh, error)
      end do
      call refuse_others(file, error)
      call read_sets(file, 'node_sets', mesh%node_sets, error)
      call read_sets(file, 'element_sets', mesh%element_sets, error)
      call hdf5_close_input(file)
      if (.not. allocated(error)) return
      call start_empty(nothing)
      mesh = nothing
   end subroutine read_mesh_file

   pure subroutine start_empty(mesh)
      type(mesh_file_t), intent(out) :: mesh

      allocate (mesh%node_id(0), mesh%position(3, 0), mesh%element_id(0), mesh%element_type(0), &
         mesh%element_nodes(2, 0), mesh%node_sets(0), mesh%element_sets(0))
   end subroutine start_empty

   subroutine read_nodes(file, mesh, error)
      !> Identifier of the open mesh file
      integer(hid_t), intent(in) :: file
      type(mesh_file_t), intent(inout) :: mesh
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: ids(:, :)
      real(dp), allocatable :: position(:, :)

      if (allocated(error)) return
      if (.not. hdf5_has(file, 'nodes')) return
      call hdf5_read_integers(file, 'nodes/id', 1, ids, error)
      call hdf5_read_reals(file, 'nodes/position', 3, position, error)
      if (allocated(error)) return
      if (size(ids, 2) /= size(position, 2)) then
         error = unequal('nodes/id', size(ids, 2), 'nodes/position', size(position, 2))
         return
      end if
      mesh%node_id = ids(1, :)
      call move_alloc(position, mesh%position)
   end subroutine read_nodes

   !> The elements of one type, behind those read before.
   subroutine read_elements(file, kind, mesh, error)
      !> Identifier of the open mesh file
      integer(hid_t), intent(in) :: file
      !> One of `element_types`
      integer, intent(in) :: kind
      type(mesh_file_t), intent(inout) :: mesh
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: group
      integer, allocatable :: ids(:, :), nodes(:, :)
      integer :: i

      if (allocated(error)) return
      group = 'elements/'//trim(element_types(kind)%name)
      if (.not. hdf5_has(file, group)) return
      call hdf5_read_integers(file, group//'/id', 1, ids, error)
      call hdf5_read_integers(file, group//'/nodes', 2, nodes, error)
      if (allocated(error)) return
      if (size(ids, 2) /= size(nodes, 2)) then
         error = unequal(group//'/id', size(ids, 2), group//'/nodes', size(nodes, 2))
         return
      end if
      mesh%element_nodes = reshape([mesh%element_nodes, nodes], [2, size(mesh%element_id) + size(ids, 2)])
      mesh%element_id = [mesh%element_id, ids(1, :)]
      mesh%element_type = [mesh%element_type, (kind, i=1, size(ids, 2))]
   end subroutine read_elements

   !> A misspelt type of element, or group of the file, must not be passed over in silence.
   subroutine refuse_others(file, error)
      !> Identifier of the open mesh file
      integer(hid_t), intent(in) :: file
      type(error_t), allocatable, intent(inout) :: error
      character(len=longest_name), allocatable :: names(:)
      integer :: i

      call hdf5_names(file, '/', names, error)
      if (allocated(error)) return
      do i = 1, size(names)
         if (any(names(i) == [character(len=12) :: 'nodes', 'elements', 'node_sets', 'element_sets'])) cycle
         error = fail(exit_input, 'has a member "'//trim(names(i))// &
            '"; allowed are nodes, elements, node_sets and element_sets')
         return
      end do
      call hdf5_names(file, 'elements', names, error)
      if (allocated(error)) return
      do i = 1, size(names)
         if (any(names(i) == element_types%name)) cycle
         error = fail(exit_input, 'has elements of a type "'//trim(names(i))//'"; allowed are '//list_element_types())
         return
      end do
   end subroutine refuse_others

   subroutine read_sets(file, group, sets, error)
      !> Identifier of the open mesh file
      integer(hid_t), intent(in) :: file
      !> Group of the file: `node_sets` or `element_sets`
      character(len=*), intent(in) :: group
      type(mesh_set_t), allocatable, intent(inout) :: sets(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=longest_name), allocatable :: names(:)
      integer, allocatable :: ids(:, :)
      integer :: i

      call hdf5_names(file, group, names, error)
      if (allocated(error)) return
      deallocate (sets)
      allocate (sets(size(names)))
      do i = 1, size(names)
         call hdf5_read_integers(file, group//'/'//trim(names(i)), 1, ids, error)
         if (allocated(error)) return
         sets(i)%name = trim(names(i))
         sets(i)%ids = ids(1, :)
      end do
   end subroutine read_sets

   pure type(error_t) function unequal(first, n_first, second, n_second) result(error)
      !> Paths of the two datasets
      character(len=*), intent(in) :: first, second
      !> Their numbers of rows
      integer, intent(in) :: n_first, n_second

      error = fail(exit_input, 'has '//to_text(n_first)//' rows in '//first//' and '//to_text(n_second)//' in '// &
         second//'; there must be as many')
   end function unequal

end module litz_mesh_file
