!> Whether a model can be computed on this machine at all, before any work is done.
module litz_size_check
   use litz_available_memory, only: available_memory, memory_text
   use litz_errors, only: error_t, fail, exit_memory
   use litz_kinds, only: int64
   use litz_model, only: model_t
   implicit none
   private
   public :: check_size

   !> The least that was measured for an element, in a straight wire without contacts, is 7.3 kB; less is taken here,
   !> so that nothing is refused that might fit
   integer(int64), parameter :: bytes_per_element = 5000
   !> Entries of the equations: a block of 7 x 7 for each node and two for each element
   integer(int64), parameter :: entries_per_block = 49

contains

   subroutine check_size(model, error)
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(out) :: error
      integer(int64) :: entries, bytes, available
      character(len=24) :: number

      entries = entries_per_block*(model%n_nodes + 2_int64*model%n_elements)
      write (number, '(i0)') model%n_elements
      if (entries > huge(model%n_nodes)) then
         error = fail(exit_memory, 'the equations of '//trim(number)//' elements have more entries than the solvers'// &
            ' can number, 2147483647; reduce the model')
         return
      end if
      bytes = bytes_per_element*model%n_elements
      available = available_memory()
      if (bytes > available) error = fail(exit_memory, 'not enough memory: '//trim(number)// &
         ' elements need '//memory_text(bytes)//' at least, and '//memory_text(available)//' are available')
   end subroutine check_size

end module litz_size_check
