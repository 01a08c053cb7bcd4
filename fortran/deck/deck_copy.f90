!> The deck in one text, with included files in place of their *INCLUDE lines, so that results can keep what they
!> were computed from.
module litz_deck_copy
   use litz_deck, only: deck_t
   implicit none
   private
   public :: deck_copy_t

   !> A range of a source that goes into the copy of the deck, or lines that are in no file.
   type :: piece_t
      integer :: source = 0, first = 1, last = 0
      character(len=:), allocatable :: words
   end type piece_t

   !> The pieces in the order of the deck.
   type :: deck_copy_t
      private
      type(piece_t), allocatable :: pieces(:)
      integer :: n_pieces = 0
   contains
      procedure :: append_range
      procedure :: append_words
      procedure :: text_of
   end type deck_copy_t

contains

   !> A range of a source.
   pure subroutine append_range(self, source, first, last)
      class(deck_copy_t), intent(inout) :: self
      !> Index of the source
      integer, intent(in) :: source
      !> First and last position in its text; nothing where `last < first`
      integer, intent(in) :: first, last

      call append_piece(self, piece_t(source, first, last))
   end subroutine append_range

   !> Words that are in no file. A structure constructor would do, but gfortran 12 never frees a text in one.
   pure subroutine append_words(self, words)
      class(deck_copy_t), intent(inout) :: self
      !> Whole lines, each with its end
      character(len=*), intent(in) :: words
      type(piece_t) :: piece

      piece%words = words
      call append_piece(self, piece)
   end subroutine append_words

   pure subroutine append_piece(self, piece)
      class(deck_copy_t), intent(inout) :: self
      type(piece_t), intent(in) :: piece
      type(piece_t), allocatable :: grown(:)

      if (.not. allocated(self%pieces)) allocate (self%pieces(16))
      if (self%n_pieces == size(self%pieces)) then
         allocate (grown(2*self%n_pieces))
         grown(:self%n_pieces) = self%pieces
         call move_alloc(grown, self%pieces)
      end if
      self%n_pieces = self%n_pieces + 1
      self%pieces(self%n_pieces) = piece
   end subroutine append_piece

   !> All pieces, one behind the other.
   pure subroutine text_of(self, deck, text)
      class(deck_copy_t), intent(in) :: self
      !> The deck whose sources the ranges are of
      type(deck_t), intent(in) :: deck
      !> The whole text
      character(len=:), allocatable, intent(out) :: text
      integer :: i, length, at

      length = 0
      do i = 1, self%n_pieces
         length = length + piece_length(self%pieces(i))
      end do
      allocate (character(len=length) :: text)
      at = 0
      do i = 1, self%n_pieces
         associate (piece => self%pieces(i))
            length = piece_length(piece)
            if (piece%source == 0) then
               text(at + 1:at + length) = piece%words
            else
               text(at + 1:at + length) = deck%sources(piece%source)%text(piece%first:piece%last)
            end if
            at = at + length
         end associate
      end do
   end subroutine text_of

   pure integer function piece_length(piece) result(length)
      type(piece_t), intent(in) :: piece

      if (piece%source == 0) then
         length = len(piece%words)
      else
         length = max(0, piece%last - piece%first + 1)
      end if
   end function piece_length

end module litz_deck_copy
