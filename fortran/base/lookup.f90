!> Hash tables: from the user's numbers and names to indices, in constant time however they are spread.
module litz_lookup
   use litz_kinds, only: int64
   use litz_text, only: nearest_word, join_words
   implicit none
   private
   public :: id_map_t, name_map_t

   !> Tables are kept at most half full
   integer, parameter :: smallest_table = 64
   !> Most names that a hint lists, and the longest that it considers
   integer, parameter :: max_listed = 8, longest_hint = 80

   !> Integer keys. Open addressing with linear probing.
   type :: id_map_t
      private
      integer :: n = 0
      integer, allocatable :: key(:), index(:)
   contains
      procedure :: put => id_map_put
      procedure :: get => id_map_get
   end type id_map_t

   type :: entry_t
      character(len=:), allocatable :: name
   end type entry_t

   !> Names, case as given. The index of a name is its place in the order of the `put`s.
   type :: name_map_t
      integer :: n = 0
      type(entry_t), allocatable, private :: entries(:)
      integer, allocatable, private :: slots(:)
   contains
      procedure :: put => name_map_put
      procedure :: get => name_map_get
      procedure :: name => name_map_name
      procedure :: hint => name_map_hint
   end type name_map_t

contains

   !> Store `key -> index`; the key must be new.
   pure subroutine id_map_put(self, key, index)
      class(id_map_t), intent(inout) :: self
      !> A number of the user's
      integer, intent(in) :: key
      !> What `get` will return for the key, positive
      integer, intent(in) :: index
      integer :: slot

      if (.not. allocated(self%key)) then
         allocate (self%key(0:smallest_table - 1), self%index(0:smallest_table - 1), source=0)
      else if (2*(self%n + 1) > size(self%key)) then
         call grow(self)
      end if
      slot = slot_of(self, key)
      self%key(slot) = key
      self%index(slot) = index
      self%n = self%n + 1
   end subroutine id_map_put

   !> Index of a key, 0 when it is not there.
   pure integer function id_map_get(self, key) result(index)
      class(id_map_t), intent(in) :: self
      !> A number of the user's
      integer, intent(in) :: key

      index = 0
      if (allocated(self%key)) index = self%index(slot_of(self, key))
   end function id_map_get

   !> The slot that holds the key, or the free one where it belongs.
   pure integer function slot_of(self, key) result(slot)
      class(id_map_t), intent(in) :: self
      !> A number of the user's
      integer, intent(in) :: key

      slot = int(iand(hash(int(key, int64)), int(size(self%key) - 1, int64)))
      do while (self%index(slot) /= 0)
         if (self%key(slot) == key) return
         slot = iand(slot + 1, size(self%key) - 1)
      end do
   end function slot_of

   pure subroutine grow(self)
      type(id_map_t), intent(inout) :: self
      integer, allocatable :: key(:), index(:)
      integer :: i, slot

      call move_alloc(self%key, key)
      call move_alloc(self%index, index)
      allocate (self%key(0:2*size(key) - 1), self%index(0:2*size(key) - 1), source=0)
      do i = 0, size(key) - 1
         if (index(i) == 0) cycle
         slot = slot_of(self, key(i))
         self%key(slot) = key(i)
         self%index(slot) = index(i)
      end do
   end subroutine grow

   !> Bits mixed so that ids in steps of any size spread evenly. Source: xorshift with shifts 13 and 7, folded.
   pure integer(int64) function hash(key)
      !> Any number
      integer(int64), intent(in) :: key

      hash = ieor(key, shiftl(key, 13))
      hash = ieor(hash, shiftr(hash, 7))
      hash = ieor(hash, shiftr(hash, 17))
   end function hash

   !> Index of a name, which is added when it is new.
   pure subroutine name_map_put(self, name, index)
      class(name_map_t), intent(inout) :: self
      !> A name, compared letter by letter: the case matters
      character(len=*), intent(in) :: name
      !> Place of the name in the order of the `put`s, from 1
      integer, intent(out) :: index
      type(entry_t), allocatable :: grown(:)
      integer :: slot, i

      if (.not. allocated(self%slots)) then
         allocate (self%entries(smallest_table/2))
         allocate (self%slots(0:smallest_table - 1), source=0)
      end if
      slot = name_slot(self, name)
      index = self%slots(slot)
      if (index /= 0) return
      if (self%n == size(self%entries)) then
         allocate (grown(2*self%n))
         do i = 1, self%n
            call move_alloc(self%entries(i)%name, grown(i)%name)
         end do
         call move_alloc(grown, self%entries)
         deallocate (self%slots)
         allocate (self%slots(0:2*size(self%entries) - 1), source=0)
         do i = 1, self%n
            self%slots(name_slot(self, self%entries(i)%name)) = i
         end do
         slot = name_slot(self, name)
      end if
      self%n = self%n + 1
      self%entries(self%n)%name = name
      self%slots(slot) = self%n
      index = self%n
   end subroutine name_map_put

   !> Index of a name, 0 when it is not there.
   pure integer function name_map_get(self, name) result(index)
      class(name_map_t), intent(in) :: self
      !> A name, compared letter by letter: the case matters
      character(len=*), intent(in) :: name

      index = 0
      if (allocated(self%slots)) index = self%slots(name_slot(self, name))
   end function name_map_get

   pure function name_map_name(self, index) result(name)
      class(name_map_t), intent(in) :: self
      !> Place of the name, 1 to `n`
      integer, intent(in) :: index
      character(len=:), allocatable :: name

      name = self%entries(index)%name
   end function name_map_name

   !> What else may have been meant, as the end of a sentence: the nearest name, or all when they are few.
   pure function name_map_hint(self, name, others) result(hint)
      class(name_map_t), intent(in) :: self
      !> The name that was not found
      character(len=*), intent(in) :: name
      !> More names that it may be, listed after these
      type(name_map_t), intent(in), optional :: others
      character(len=:), allocatable :: hint
      character(len=longest_hint), allocatable :: names(:)

      names = all_names(self)
      if (present(others)) names = [names, all_names(others)]
      hint = nearest_word(name, names)
      if (len(hint) > 0) then
         hint = '; did you mean '//hint//'?'
      else if (size(names) == 0) then
         hint = '; none is defined'
      else if (size(names) <= max_listed) then
         hint = '; there is '//join_words(names, 'and')
      end if
   end function name_map_hint

   !> Names in the order of the `put`s, (n).
   pure function all_names(map) result(names)
      class(name_map_t), intent(in) :: map
      character(len=longest_hint), allocatable :: names(:)
      integer :: i

      allocate (names(map%n))
      do i = 1, map%n
         names(i) = map%entries(i)%name
      end do
   end function all_names

   pure integer function name_slot(self, name) result(slot)
      class(name_map_t), intent(in) :: self
      !> A name, compared letter by letter: the case matters
      character(len=*), intent(in) :: name
      integer(int64) :: code
      integer :: i

      code = len(name)
      do i = 1, len(name)
         code = iand(code*31_int64 + iachar(name(i:i)), int(z'FFFFFFFFFFFF', int64))
      end do
      slot = int(iand(hash(code), int(size(self%slots) - 1, int64)))
      do while (self%slots(slot) /= 0)
         if (self%entries(self%slots(slot))%name == name) return
         slot = iand(slot + 1, size(self%slots) - 1)
      end do
   end function name_slot

end module litz_lookup
