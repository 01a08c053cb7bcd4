!> The reference of the deck, from the keyword table: for the terminal and as Markdown.
module litz_keyword_reference
   use litz_text, only: to_text, words_of, join_words, wrapped, word_length
   use litz_foreign_words, only: foreign_word_t, foreign_words
   use litz_keywords, only: keyword_table_t, keyword_t, parameter_spec_t, data_spec_t, field_spec_t, place_model, &
      place_step, place_both, kind_flag, kind_integer, kind_real, kind_choice, kind_name, kind_file, kind_text, &
      limit_none, limit_unused, describe_limit
   implicit none
   private
   public :: keyword_list, keyword_page, keyword_markdown

   character(len=1), parameter :: nl = new_line('a')
contains

   !> One line per keyword.
   pure function keyword_list(table, width) result(text)
      type(keyword_table_t), intent(in) :: table
      !> Columns of the terminal
      integer, intent(in) :: width
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, table%n
         associate (keyword => table%keywords(i))
            text = text//wrapped('*'//keyword%name//first_sentence(keyword%help), width, 1 + len(keyword%name))
         end associate
      end do
   end function keyword_list

   pure function first_sentence(help) result(sentence)
      !> Sentences
      character(len=*), intent(in) :: help
      character(len=:), allocatable :: sentence
      integer :: stop_at

      stop_at = index(help, '. ')
      if (stop_at == 0) stop_at = len(help)
      sentence = help(:stop_at)
   end function first_sentence

   !> Everything about one keyword, for the terminal.
   pure function keyword_page(keyword, width) result(text)
      type(keyword_t), intent(in) :: keyword
      !> Columns of the terminal
      integer, intent(in) :: width
      character(len=:), allocatable :: text
      integer :: i, j

      text = '*'//trim(keyword%name)//' - '//describe_place(keyword)//nl//wrapped(keyword%help, width, 0)
      if (size(keyword%parameters) > 0) text = text//'Parameters:'//nl
      do i = 1, size(keyword%parameters)
         text = text//wrapped('  '//parameter_form(keyword%parameters(i))//': '// &
            parameter_help(keyword%parameters(i)), width, 6)
      end do
      do i = 1, size(keyword%data)
         associate (form => keyword%data(i))
            text = text//line_title(form)//': '//line_form(form)//nl
            do j = 1, size(form%fields)
               text = text//wrapped('  '//trim(form%fields(j)%name)//': '//field_help(form%fields(j)), width, 6)
            end do
         end associate
      end do
   end function keyword_page

   !> The whole reference as Markdown.
   pure function keyword_markdown(table) result(text)
      type(keyword_table_t), intent(in) :: table
      character(len=:), allocatable :: text
      integer :: i

      text = '# Deck reference'//nl//nl// &
         'Written by `litz keywords --markdown` from the table that also drives the checks of the reader.'//nl//nl// &
         'A line `** ...` is a comment. Case and blanks around commas do not matter. A keyword line that ends'// &
         ' with a comma goes on in the next line. Units are SI, or other consistent ones (*UNITS).'//nl
      do i = 1, table%n
         text = text//nl//markdown_section(table%keywords(i))
      end do
      text = text//nl//markdown_foreign_words(foreign_words())
   end function keyword_markdown

   !> What a user of Abaqus or CalculiX may look for, and what is there in its place.
   pure function markdown_foreign_words(words) result(text)
      type(foreign_word_t), intent(in) :: words(:)
      character(len=:), allocatable :: text
      integer :: i

      text = '## Words of Abaqus and CalculiX that litz does not have'//nl//nl// &
         'The reader of a deck gives the same advice, and so does, for example, `litz keywords DYNAMIC`.'//nl//nl// &
         '| word | in litz |'//nl//'|---|---|'//nl
      do i = 1, size(words)
         text = text//'| '//foreign_form(words(i))//' | '//escaped(trim(words(i)%advice))//' |'//nl
      end do
   end function markdown_foreign_words

   !> `*KEYWORD`, `*KEYWORD, PARAMETER`, `*KEYWORD, PARAMETER=VALUE`, or `VALUE` in the data of `*KEYWORD`
   pure function foreign_form(word) result(form)
      type(foreign_word_t), intent(in) :: word
      character(len=:), allocatable :: form

      form = listed(word%keywords, '*')
      if (len_trim(word%values) == 0) then
         if (len_trim(word%parameters) > 0) form = form//': '//listed(word%parameters, '')
      else if (len_trim(word%parameters) > 0) then
         form = form//': '//listed(word%values, trim(word%parameters)//'=')
      else if (word%values == '+') then
         form = form//': more data'
      else
         form = form//', data: '//listed(word%values, '')
      end if
   end function foreign_form

   !> Each word of the list as code, behind `before`.
   pure function listed(list, before) result(text)
      !> Words with bars between them
      character(len=*), intent(in) :: list
      !> What stands before each of them
      character(len=*), intent(in) :: before
      character(len=:), allocatable :: text
      character(len=word_length), allocatable :: words(:)
      integer :: i

      allocate (words, source=words_of(list))
      text = ''
      do i = 1, size(words)
         if (i > 1) text = text//', '
         text = text//'`'//before//trim(words(i))//'`'
      end do
   end function listed

   pure function markdown_section(keyword) result(text)
      type(keyword_t), intent(in) :: keyword
      character(len=:), allocatable :: text
      integer :: i, j

      text = '## \*'//trim(keyword%name)//nl//nl//'*'//describe_place(keyword)//'.* '//keyword%help//nl
      if (size(keyword%parameters) > 0) text = text//nl//'| parameter | meaning |'//nl//'|---|---|'//nl
      do i = 1, size(keyword%parameters)
         text = text//'| `'//escaped(parameter_form(keyword%parameters(i)))//'` | '// &
            parameter_help(keyword%parameters(i))//' |'//nl
      end do
      do i = 1, size(keyword%data)
         associate (form => keyword%data(i))
            text = text//nl//line_title(form)//': `'//line_form(form)//'`'//nl//nl//'| value | meaning |'//nl// &
               '|---|---|'//nl
            do j = 1, size(form%fields)
               text = text//'| `'//trim(form%fields(j)%name)//'` | '//field_help(form%fields(j))//' |'//nl
            end do
         end associate
      end do
   end function markdown_section

   !> A bar would end the cell of a table.
   pure function escaped(text) result(cell)
      !> Text of a cell
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: cell
      integer :: i

      cell = ''
      do i = 1, len(text)
         if (text(i:i) == '|') cell = cell//'\'
         cell = cell//text(i:i)
      end do
   end function escaped

   pure function describe_place(keyword) result(words)
      type(keyword_t), intent(in) :: keyword
      character(len=:), allocatable :: words

      select case (keyword%place)
      case (place_model)
         words = 'model part'
      case (place_step)
         words = 'in a step'
      case (place_both)
         words = 'model part or in a step'
      case default
         words = 'after the model part'
      end select
      if (len_trim(keyword%after) > 0) words = words//', after *'//trim(keyword%after)
   end function describe_place

   pure function parameter_form(parameter) result(form)
      type(parameter_spec_t), intent(in) :: parameter
      character(len=:), allocatable :: form

      form = trim(parameter%name)
      select case (parameter%kind)
      case (kind_choice)
         form = form//'='//trim(parameter%choices)
      case (kind_name)
         form = form//'=name'
      case (kind_file)
         form = form//'=file'
      case (kind_integer, kind_real)
         form = form//'=number'
      end select
   end function parameter_form

   pure function parameter_help(parameter) result(help)
      type(parameter_spec_t), intent(in) :: parameter
      character(len=:), allocatable :: help

      help = parameter%help
      if (parameter%limit /= limit_none) help = help//'; '//describe_limit(parameter%limit)
      if (parameter%required) help = help//'; required'
      if (len_trim(parameter%default) > 0) help = help//'; default '//trim(parameter%default)
   end function parameter_help

   pure function line_title(form) result(title)
      type(data_spec_t), intent(in) :: form
      character(len=:), allocatable :: title

      if (form%last == 0) then
         title = 'Data lines'
      else
         title = 'Data line '//to_text(form%first)
      end if
      if (len_trim(form%when) > 0) title = title//' ('//describe_condition()//')'
      if (.not. form%required) title = title//', optional'
      if (len_trim(form%optional_with) > 0) title = title//', optional with '//trim(form%optional_with)

   contains

      pure function describe_condition()
         character(len=:), allocatable :: describe_condition

         describe_condition = trim(form%when)
         if (describe_condition == 'GENERATE=YES') describe_condition = 'with GENERATE'
         if (describe_condition == 'GENERATE=NO') describe_condition = 'without GENERATE'
      end function describe_condition

   end function line_title

   pure function line_form(form) result(line)
      type(data_spec_t), intent(in) :: form
      character(len=:), allocatable :: line
      integer :: i

      line = ''
      do i = 1, size(form%fields)
         if (i > 1) line = line//', '
         line = line//trim(form%fields(i)%name)
      end do
      if (form%repeats /= 1) line = line//', '//line//', ...'
      if (form%repeats > 1) line = line//' (at most '//to_text(form%repeats*size(form%fields))//' values)'
   end function line_form

   pure function field_help(field) result(help)
      type(field_spec_t), intent(in) :: field
      character(len=:), allocatable :: help

      help = field%help
      if (field%kind == kind_choice) help = help//'; '//join_words(words_of(field%choices), 'or')
      if (len_trim(field%unit) > 0) help = help//' ['//trim(field%unit)//']'
      if (field%limit /= limit_none .and. field%limit /= limit_unused) help = help//'; '//describe_limit(field%limit)
      if (.not. field%required .and. index(help, 'left out') == 0 .and. index(help, 'empty') == 0) help = help// &
         '; optional'
   end function field_help

end module litz_keyword_reference
