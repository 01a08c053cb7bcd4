!> Materials, amplitudes and interactions by their names.
module litz_definitions
   use litz_deck, only: token_t
   use litz_reader, only: reader_t, definitions_t, fail_at, name_of, names_hint, may_be_defined
   implicit none
   private
   public :: add_definition, find_definition

contains

   !> A new name of a material, amplitude or interaction; `index` is 0 when it is there already.
   subroutine add_definition(self, definitions, what, token, index)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(inout) :: definitions
      !> What is defined, as messages name it: `material`, `amplitude`, `interaction`
      character(len=*), intent(in) :: what
      !> The name
      type(token_t), intent(in) :: token
      !> Index of the definition
      integer, intent(out) :: index
      integer :: before

      call make_room(definitions)
      before = definitions%names%n
      call definitions%names%put(name_of(self, token), index)
      if (definitions%names%n > before) then
         definitions%token(index) = token
         definitions%used(index) = .false.
      else
         call fail_at(self, token, 'the '//what//' '//self%deck%shown(token)//' is defined twice; first in '// &
            self%deck%place(definitions%token(index)%line))
         index = 0
      end if
   end subroutine add_definition

   !> Room for one more definition.
   pure subroutine make_room(definitions)
      type(definitions_t), intent(inout) :: definitions
      type(token_t), allocatable :: token(:)
      logical, allocatable :: used(:)

      if (.not. allocated(definitions%token)) allocate (definitions%token(16), definitions%used(16))
      associate (n => definitions%names%n)
         if (n < size(definitions%token)) return
         allocate (token(2*n), used(2*n))
         token(:n) = definitions%token
         used(:n) = definitions%used
      end associate
      call move_alloc(token, definitions%token)
      call move_alloc(used, definitions%used)
   end subroutine make_room

   !> Look a name up and mark it as used; 0 and an error when it does not exist.
   subroutine find_definition(self, definitions, what, token, index)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(inout) :: definitions
      !> What is defined, as messages name it: `material`, `amplitude`, `interaction`
      character(len=*), intent(in) :: what
      type(token_t), intent(in) :: token
      !> Index of the definition
      integer, intent(out) :: index

      index = definitions%names%get(name_of(self, token))
      if (index > 0) then
         definitions%used(index) = .true.
      else
         definitions%missed = .true.
         if (token%last < token%first) return
         if (may_be_defined(self, 'NAME', token)) return
         call fail_at(self, token, 'there is no '//what//' '//self%deck%shown(token)// &
            names_hint(self, definitions%names, token))
      end if
   end subroutine find_definition

end module litz_definitions
