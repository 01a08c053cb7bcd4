!> A time series of an unstructured grid in the VTKHDF format, version 2, that ParaView and pyvista read.
!>
!> Order of calls: `create`, `add_field` for each field, then for each step `write_cells` (once, if the cells stay the
!> same), `write_points`, `write_field` for each field, `end_step`; at last `close`. A field that is not written at a
!> step keeps its values. After `end_step` the file on the disk is complete up to that step, whatever happens to the
!> program. `publish` puts the file in the place of an older one, which stays whole until then.
!>
!> Errors are passed through as in `litz_hdf5_files`.
module litz_vtkhdf_writer
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, fail, exit_internal
   use litz_quantities, only: quantity_t, name_length, on_points, on_cells
   use litz_unit_labels, only: unit_labels_t
   use litz_version, only: version
   use litz_hdf5_files, only: hid_t, hdf5_start, hdf5_create_file, hdf5_create_group, hdf5_flush, &
      hdf5_publish_file, hdf5_close_file, hdf5_discard_file
   use litz_hdf5_attributes, only: hdf5_write_attribute
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_real, hdf5_integer, hdf5_byte
   implicit none
   private
   public :: vtkhdf_file_t
   public :: vtk_vertex, vtk_line

   !> Of what stands in /litz; the layout of /VTKHDF has its own number
   integer, parameter :: format_version = 1

   !> VTK's numbers of the cell types
   integer, parameter :: vtk_vertex = 1, vtk_line = 3

   !> A field over points or cells.
   type :: vtkhdf_field_t
      character(len=name_length) :: name
      type(hdf5_rows_t) :: rows, offsets
      !> First row of the values that hold at the present step
      integer(int64) :: start = 0
   end type vtkhdf_field_t

   type :: vtkhdf_file_t
      !> What the units of the fields are called
      type(unit_labels_t) :: units
      integer(hid_t) :: file = -1
      !> What is no part of VTKHDF: where the file comes from, and whether the run came to its end
      integer(hid_t) :: litz_group = -1
      integer :: n_steps = 0
      !> The file is in its place, or comes there with its first step
      logical, private :: is_public = .false.
      integer(hid_t), private :: root = -1, steps = -1
      integer(hid_t), private :: data_group(2) = -1, offset_group(2) = -1
      type(vtkhdf_field_t), allocatable, private :: fields(:)
      !> The mesh: points, and for each part (a set of cells) its sizes
      type(hdf5_rows_t), private :: points, connectivity, cell_offsets, cell_types
      type(hdf5_rows_t), private :: part_points, part_cells, part_connectivity
      !> One row per step
      type(hdf5_rows_t), private :: times, step_part, step_n_parts, step_points, step_cells, step_connectivity
      !> First rows of the present step's points and of the last part's cells
      integer(int64), private :: start_points = 0, start_cells = 0, start_connectivity = 0
   contains
      procedure :: create => vtkhdf_create
      procedure :: add_field => vtkhdf_add_field
      procedure :: write_cells => vtkhdf_write_cells
      procedure :: write_points => vtkhdf_write_points
      procedure, private :: write_reals, write_integers
      generic :: write_field => write_reals, write_integers
      procedure :: end_step => vtkhdf_end_step
      procedure :: publish => vtkhdf_publish
      procedure :: close => vtkhdf_close
   end type vtkhdf_file_t

contains

   !> Begins the file anew with the groups and the datasets of the mesh.
   subroutine vtkhdf_create(self, path, expected_points, expected_cells, expected_steps, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> Where the file will be once it is published
      character(len=*), intent(in) :: path
      !> Usual numbers in a step: a guide for the layout of the file
      integer, intent(in) :: expected_points, expected_cells
      !> Most steps that may come
      integer, intent(in) :: expected_steps
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      self%n_steps = 0
      self%is_public = .false.
      allocate (self%fields(0))
      call hdf5_start(error)
      call hdf5_create_file(path, expected_steps, self%file, error)
      call hdf5_create_group(self%file, 'VTKHDF', self%root, error)
      call hdf5_write_attribute(self%root, 'Version', [2, 0], error)
      call hdf5_write_attribute(self%root, 'Type', 'UnstructuredGrid', error)
      call hdf5_create_group(self%root, 'PointData', self%data_group(on_points), error)
      call hdf5_create_group(self%root, 'CellData', self%data_group(on_cells), error)
      call self%points%create(self%root, 'Points', 3, hdf5_real, expected_points, error)
      call self%connectivity%create(self%root, 'Connectivity', 1, hdf5_integer, 2*expected_cells, error)
      call self%cell_offsets%create(self%root, 'Offsets', 1, hdf5_integer, expected_cells + 1, error)
      call self%cell_types%create(self%root, 'Types', 1, hdf5_byte, expected_cells, error)
      call self%part_points%create(self%root, 'NumberOfPoints', 1, hdf5_integer, 1, error)
      call self%part_cells%create(self%root, 'NumberOfCells', 1, hdf5_integer, 1, error)
      call self%part_connectivity%create(self%root, 'NumberOfConnectivityIds', 1, hdf5_integer, 1, error)
      call create_steps(self, error)
      call hdf5_create_group(self%file, 'litz', self%litz_group, error)
      call hdf5_write_attribute(self%litz_group, 'format_version', format_version, error)
      call hdf5_write_attribute(self%litz_group, 'version', version, error)
      call hdf5_write_attribute(self%litz_group, 'finished', 0, error)
   end subroutine vtkhdf_create

   subroutine create_steps(self, error)
      type(vtkhdf_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      call hdf5_create_group(self%root, 'Steps', self%steps, error)
      call hdf5_write_attribute(self%steps, 'NSteps', 0, error)
      call hdf5_create_group(self%steps, 'PointDataOffsets', self%offset_group(on_points), error)
      call hdf5_create_group(self%steps, 'CellDataOffsets', self%offset_group(on_cells), error)
      call self%times%create(self%steps, 'Values', 1, hdf5_real, 1, error)
      call self%step_part%create(self%steps, 'PartOffsets', 1, hdf5_integer, 1, error)
      call self%step_n_parts%create(self%steps, 'NumberOfParts', 1, hdf5_integer, 1, error)
      call self%step_points%create(self%steps, 'PointOffsets', 1, hdf5_integer, 1, error)
      call self%step_cells%create(self%steps, 'CellOffsets', 1, hdf5_integer, 1, error)
      call self%step_connectivity%create(self%steps, 'ConnectivityIdOffsets', 1, hdf5_integer, 1, error)
   end subroutine create_steps

   !> Declares a field; its unit, description and components become attributes of its dataset.
   subroutine vtkhdf_add_field(self, quantity, expected_rows, error)
      class(vtkhdf_file_t), intent(inout) :: self
      class(quantity_t), intent(in) :: quantity
      !> Usual number of points or cells in a step
      integer, intent(in) :: expected_rows
      type(error_t), allocatable, intent(inout) :: error
      type(vtkhdf_field_t) :: field

      if (allocated(error)) return
      field%name = quantity%name
      call field%rows%create(self%data_group(quantity%place), trim(field%name), quantity%components, &
         merge(hdf5_integer, hdf5_real, quantity%is_integer), expected_rows, error)
      call field%offsets%create(self%offset_group(quantity%place), trim(field%name), 1, hdf5_integer, 1, error)
      call hdf5_write_attribute(field%rows%dataset, 'unit', self%units%label(trim(quantity%unit)), error)
      call hdf5_write_attribute(field%rows%dataset, 'description', trim(quantity%text), error)
      call hdf5_write_attribute(field%rows%dataset, 'components', &
         trim(merge('x, y, z', 'scalar ', quantity%components == 3)), error)
      self%fields = [self%fields, field]
   end subroutine vtkhdf_add_field

   !> The cells from this step on.
   subroutine vtkhdf_write_cells(self, cell_type, connectivity, n_points, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> `vtk_vertex` or `vtk_line`
      integer, intent(in) :: cell_type
      !> (points of a cell, cells), counted from 1
      integer, intent(in) :: connectivity(:, :)
      !> Points that belong to the cells
      integer, intent(in) :: n_points
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable :: flat(:, :)
      integer :: n_cells, i

      if (allocated(error)) return
      n_cells = size(connectivity, 2)
      self%start_cells = self%cell_types%n_rows
      self%start_connectivity = self%connectivity%n_rows
      allocate (flat(1, size(connectivity)))
      flat(1, :) = reshape(connectivity, [size(connectivity)]) - 1
      call self%connectivity%append(flat, error)
      flat = reshape([(int(i*size(connectivity, 1), int64), i=0, n_cells)], [1, n_cells + 1])
      call self%cell_offsets%append(flat, error)
      flat = reshape([(int(cell_type, int64), i=1, n_cells)], [1, n_cells])
      call self%cell_types%append(flat, error)
      call self%part_points%append(int(n_points, int64), error)
      call self%part_cells%append(int(n_cells, int64), error)
      call self%part_connectivity%append(size(connectivity, kind=int64), error)
   end subroutine vtkhdf_write_cells

   !> The positions of this step's points.
   subroutine vtkhdf_write_points(self, points, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> (3, points) [m]
      real(dp), intent(in) :: points(:, :)
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      self%start_points = self%points%n_rows
      call self%points%append(points, error)
   end subroutine vtkhdf_write_points

   !> A field of reals at this step.
   subroutine write_reals(self, name, values, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> Of the field
      character(len=*), intent(in) :: name
      !> (components, points or cells)
      real(dp), intent(in) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      call find_field(self, name, i, error)
      if (allocated(error)) return
      self%fields(i)%start = self%fields(i)%rows%n_rows
      call self%fields(i)%rows%append(values, error)
   end subroutine write_reals

   !> A field of integers at this step.
   subroutine write_integers(self, name, values, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> Of the field
      character(len=*), intent(in) :: name
      !> One value per point or cell (n)
      integer, intent(in) :: values(:)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      call find_field(self, name, i, error)
      if (allocated(error)) return
      self%fields(i)%start = self%fields(i)%rows%n_rows
      call self%fields(i)%rows%append(reshape(int(values, int64), [1, size(values)]), error)
   end subroutine write_integers

   !> Completes the step: its offsets, then its data to the disk, and only then the number of steps.
   subroutine vtkhdf_end_step(self, time, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> Total time [s]
      real(dp), intent(in) :: time
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      if (allocated(error)) return
      call self%times%append(reshape([time], [1, 1]), error)
      call self%step_part%append(self%part_cells%n_rows - 1_int64, error)
      call self%step_n_parts%append(1_int64, error)
      call self%step_points%append(self%start_points, error)
      call self%step_cells%append(self%start_cells, error)
      call self%step_connectivity%append(self%start_connectivity, error)
      do i = 1, size(self%fields)
         call self%fields(i)%offsets%append(self%fields(i)%start, error)
      end do
      call hdf5_flush(self%file, error)
      if (.not. allocated(error)) self%n_steps = self%n_steps + 1
      call hdf5_write_attribute(self%steps, 'NSteps', self%n_steps, error)
      call hdf5_flush(self%file, error)
      if (self%is_public .and. self%n_steps == 1) call hdf5_publish_file(self%file, error)
   end subroutine vtkhdf_end_step

   !> Puts the file in the place of an older one, as soon as a step is complete in it.
   subroutine vtkhdf_publish(self, error)
      class(vtkhdf_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (self%n_steps > 0) call hdf5_publish_file(self%file, error)
      self%is_public = .not. allocated(error)
   end subroutine vtkhdf_publish

   !> Closes the file, and notes whether the run came to its end; one that was not published is removed.
   subroutine vtkhdf_close(self, finished, error)
      class(vtkhdf_file_t), intent(inout) :: self
      !> The run came to its end
      logical, intent(in) :: finished
      type(error_t), allocatable, intent(inout) :: error

      if (self%file < 0) return
      if (finished) call hdf5_write_attribute(self%litz_group, 'finished', 1, error)
      if (.not. self%is_public .or. self%n_steps == 0) call hdf5_discard_file(self%file)
      call hdf5_close_file(self%file, error)
   end subroutine vtkhdf_close

   !> Index of a declared field; asking for another is a mistake of the program, not of its user.
   pure subroutine find_field(self, name, i, error)
      class(vtkhdf_file_t), intent(in) :: self
      !> Of the field
      character(len=*), intent(in) :: name
      !> Its place among the fields; 0: there is none
      integer, intent(out) :: i
      type(error_t), allocatable, intent(inout) :: error

      i = 0
      if (allocated(error)) return
      do i = 1, size(self%fields)
         if (self%fields(i)%name == name) return
      end do
      error = fail(exit_internal, 'the field "'//name//'" is written but was not declared')
   end subroutine find_field

end module litz_vtkhdf_writer
