!> Attributes and texts in an HDF5 file.
!>
!> Every procedure passes `error` through and does nothing once it is allocated, so that a sequence of calls needs
!> one check at its end.
module litz_hdf5_attributes
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5screate_f, h5screate_simple_f, h5sclose_f, h5acreate_f, h5aopen_f, &
      h5awrite_f, h5aclose_f, h5aexists_f, h5dcreate_f, h5dwrite_f, h5dclose_f, h5tcopy_f, h5tclose_f, &
      h5tset_size_f, h5tset_strpad_f, h5tset_cset_f, h5kind_to_type, H5S_SCALAR_F, H5_INTEGER_KIND, &
      H5T_NATIVE_CHARACTER, H5T_STR_NULLPAD_F, H5T_CSET_UTF8_F, H5T_STD_I64LE
   use litz_kinds, only: int64
   use litz_errors, only: error_t
   use litz_hdf5_files, only: file_name, cannot_write
   implicit none
   private
   public :: hdf5_write_attribute, hdf5_write_text

   !> Writes an attribute, a new one or over the old value.
   interface hdf5_write_attribute
      procedure :: write_attribute_text
      procedure :: write_attribute_integers
      procedure :: write_attribute_integer
   end interface hdf5_write_attribute

contains

   subroutine write_attribute_text(object, name, text, error)
      !> Identifier of the file, group or dataset that has the attribute
      integer(hid_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> May be empty
      character(len=*), intent(in) :: text
      type(error_t), allocatable, intent(inout) :: error
      character(kind=c_char), target :: buffer(max(1, len(text)))
      integer(hid_t) :: type
      integer :: ignored

      if (allocated(error)) return
      call text_to_buffer(text, buffer)
      call make_text_type(len(text), type)
      call write_attribute(object, name, type, type, [integer(hsize_t) ::], c_loc(buffer), error)
      call h5tclose_f(type, ignored)
   end subroutine write_attribute_text

   subroutine write_attribute_integer(object, name, value, error)
      !> Identifier of the file, group or dataset that has the attribute
      integer(hid_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Any integer
      integer, intent(in) :: value
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), target :: buffer

      buffer = value
      call write_attribute(object, name, H5T_STD_I64LE, h5kind_to_type(int64, H5_INTEGER_KIND), [integer(hsize_t) ::], &
         c_loc(buffer), error)
   end subroutine write_attribute_integer

   subroutine write_attribute_integers(object, name, values, error)
      !> Identifier of the file, group or dataset that has the attribute
      integer(hid_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Integers (n)
      integer, intent(in) :: values(:)
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), target :: buffer(size(values))

      buffer = values
      call write_attribute(object, name, H5T_STD_I64LE, h5kind_to_type(int64, H5_INTEGER_KIND), &
         [size(values, kind=hsize_t)], c_loc(buffer), error)
   end subroutine write_attribute_integers

   !> A text as a dataset of one string.
   subroutine hdf5_write_text(parent, name, text, error)
      !> Identifier of the file or group that it is made in
      integer(hid_t), intent(in) :: parent
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> May be empty
      character(len=*), intent(in) :: text
      type(error_t), allocatable, intent(inout) :: error
      character(kind=c_char), allocatable, target :: buffer(:)
      integer(hid_t) :: type, space, dataset
      integer :: status, ignored

      if (allocated(error)) return
      ! on the heap: a deck may have a million lines
      allocate (buffer(max(1, len(text))))
      call text_to_buffer(text, buffer)
      call make_text_type(len(text), type)
      call h5screate_f(H5S_SCALAR_F, space, status)
      call h5dcreate_f(parent, name, type, space, dataset, status)
      if (status == 0) call h5dwrite_f(dataset, type, c_loc(buffer), status)
      if (status /= 0) error = cannot_write(file_name(parent), 'error at the dataset "'//name//'"')
      call h5dclose_f(dataset, ignored)
      call h5sclose_f(space, ignored)
      call h5tclose_f(type, ignored)
   end subroutine hdf5_write_text

   subroutine write_attribute(object, name, file_type, memory_type, extent, buffer, error)
      !> Identifier of the file, group or dataset that has the attribute
      integer(hid_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Identifier of the type in the file
      integer(hid_t), intent(in) :: file_type
      !> Identifier of the type in memory
      integer(hid_t), intent(in) :: memory_type
      !> Number of values (1); empty (0) for a scalar
      integer(hsize_t), intent(in) :: extent(:)
      type(c_ptr), intent(in) :: buffer
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: attribute, space
      logical :: there
      integer :: status, ignored

      if (allocated(error)) return
      call h5aexists_f(object, name, there, status)
      if (there) then
         call h5aopen_f(object, name, attribute, status)
      else
         if (size(extent) == 0) then
            call h5screate_f(H5S_SCALAR_F, space, status)
         else
            call h5screate_simple_f(1, extent, space, status)
         end if
         call h5acreate_f(object, name, file_type, space, attribute, status)
         call h5sclose_f(space, ignored)
      end if
      if (status == 0) call h5awrite_f(attribute, memory_type, buffer, status)
      if (status /= 0) error = cannot_write(file_name(object), 'error at the attribute "'//name//'"')
      call h5aclose_f(attribute, ignored)
   end subroutine write_attribute

   !> Null-padded, exactly as long as the text: VTK refuses strings that are padded with blanks, HDF5 those of length 0.
   subroutine make_text_type(length, type)
      !> Length of the text
      integer, intent(in) :: length
      !> Identifier of the new type, which the caller closes
      integer(hid_t), intent(out) :: type
      integer :: status

      call h5tcopy_f(H5T_NATIVE_CHARACTER, type, status)
      call h5tset_size_f(type, int(max(1, length), size_t), status)
      call h5tset_strpad_f(type, H5T_STR_NULLPAD_F, status)
      call h5tset_cset_f(type, H5T_CSET_UTF8_F, status)
   end subroutine make_text_type

   pure subroutine text_to_buffer(text, buffer)
      !> Any text
      character(len=*), intent(in) :: text
      !> Its letters (n), then null characters; at least as long as the text
      character(kind=c_char), intent(out) :: buffer(:)
      integer :: i

      buffer = c_null_char
      do i = 1, len(text)
         buffer(i) = text(i:i)
      end do
   end subroutine text_to_buffer

end module litz_hdf5_attributes
