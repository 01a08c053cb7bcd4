!> The HDF5 library itself, made ready for reading and writing.
module litz_hdf5_library
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   use hdf5, only: h5open_f, h5dont_atexit_f, h5eset_auto_f
   use litz_errors, only: error_t, fail, exit_files
   implicit none
   private
   public :: hdf5_start

   interface
      !> POSIX setenv
      integer(c_int) function c_setenv(name, value, overwrite) bind(c, name='setenv')
         import :: c_char, c_int
         implicit none
         !> Name of the variable and its value, each ended by a null character
         character(kind=c_char), intent(in) :: name(*), value(*)
         !> 0: a value that is there already stays
         integer(c_int), value :: overwrite
      end function c_setenv
   end interface

contains

   !> Readies the HDF5 library; may be called again. Its error stack is turned off: messages are made by the callers.
   subroutine hdf5_start(error)
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      integer(c_int) :: ignored

      if (allocated(error)) return
      ! so that ParaView and h5py can look into the file while the run goes on; the user's own setting prevails
      ignored = c_setenv('HDF5_USE_FILE_LOCKING'//c_null_char, 'FALSE'//c_null_char, 0_c_int)
      ! HDF5 would try once more, when the program ends, to write what did not fit on the disk, and crash
      call h5dont_atexit_f(status)
      call h5open_f(status)
      if (status == 0) call h5eset_auto_f(0, status)
      if (status /= 0) error = fail(exit_files, 'the HDF5 library does not start')
   end subroutine hdf5_start

end module litz_hdf5_library
