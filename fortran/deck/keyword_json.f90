!> The keyword table for other programs, as JSON: a list of keywords in the order of the reference.
!>
!> A limit stands in numbers (`exclusive_minimum`, `minimum`, `exclusive_maximum`, `maximum`) and as text. `last` of
!> data lines is null where any number of lines is allowed, `repeats` where the values of a line may repeat any number
!> of times.
module litz_keyword_json
   use litz_fields, only: fields, n_fields, last_dof
   use litz_growing_text, only: growing_text_t
   use litz_keywords, only: keyword_table_t, keyword_t, parameter_spec_t, data_spec_t, field_spec_t, place_model, &
      place_step, place_both, kind_flag, kind_integer, kind_real, kind_choice, kind_name, kind_item, kind_file, &
      limit_none, limit_positive, limit_not_negative, limit_poisson, limit_unused, limit_one, &
      describe_limit
   use litz_text, only: to_text
   implicit none
   private
   public :: keyword_json

   character(len=1), parameter :: nl = new_line('a')

contains

   pure function keyword_json(table) result(text)
      type(keyword_table_t), intent(in) :: table
      character(len=:), allocatable :: text
      type(growing_text_t) :: json
      integer :: i

      call json%append('['//nl)
      do i = 1, table%n
         call json%append(keyword_object(table%keywords(i)))
         if (i < table%n) call json%append(',')
         call json%append(nl)
      end do
      call json%append(']'//nl)
      text = json%text()
   end function keyword_json

   pure function keyword_object(keyword) result(json)
      type(keyword_t), intent(in) :: keyword
      character(len=:), allocatable :: json
      integer :: i

      json = ' {"name": '//quoted(keyword%name)//', "place": '//quoted(place_word(keyword%place))//', "after": '// &
         quoted_or_null(keyword%after)//', "help": '//quoted(keyword%help)//','//nl//'  "parameters": ['
      do i = 1, size(keyword%parameters)
         if (i > 1) json = json//','
         json = json//nl//'   '//parameter_object(keyword%parameters(i))
      end do
      json = json//'],'//nl//'  "data": ['
      do i = 1, size(keyword%data)
         if (i > 1) json = json//','
         json = json//nl//'   '//data_object(keyword%data(i))
      end do
      json = json//']}'
   end function keyword_object

   pure function parameter_object(parameter) result(json)
      type(parameter_spec_t), intent(in) :: parameter
      character(len=:), allocatable :: json

      json = '{"name": '//quoted(parameter%name)//', "kind": '//quoted(kind_word(parameter%kind))//', "choices": '// &
         choice_list(parameter%choices)//', "required": '//truth(parameter%required)//', "value_optional": '// &
         truth(parameter%value_optional)//', "default": '//quoted_or_null(parameter%default)// &
         limit_members(parameter%limit)//', "help": '//quoted(parameter%help)//'}'
   end function parameter_object

   pure function data_object(form) result(json)
      type(data_spec_t), intent(in) :: form
      character(len=:), allocatable :: json
      integer :: i

      json = '{"when": '//quoted_or_null(form%when)//', "first": '//to_text(form%first)//', "last": '// &
         number_or_null(form%last)//', "required": '//truth(form%required)//', "optional_with": '// &
         quoted_or_null(form%optional_with)//', "repeats": '//number_or_null(form%repeats)//', "values": ['
      do i = 1, size(form%fields)
         if (i > 1) json = json//','
         json = json//nl//'    '//field_object(form%fields(i))
      end do
      json = json//']}'
   end function data_object

   pure function field_object(field) result(json)
      type(field_spec_t), intent(in) :: field
      character(len=:), allocatable :: json

      json = '{"name": '//quoted(field%name)//', "kind": '//quoted(kind_word(field%kind))//', "choices": '// &
         choice_list(field%choices)//', "required": '//truth(field%required)//', "unit": '// &
         quoted_or_null(field%unit)//limit_members(field%limit)//dof_members(field)//', "help": '// &
         quoted(field%help)//'}'
   end function field_object

   !> The fields whose degrees of freedom a value may be, with a comma before them; nothing for other values.
   pure function dof_members(value) result(json)
      type(field_spec_t), intent(in) :: value
      character(len=:), allocatable :: json
      integer :: i

      json = ''
      if (.not. any(value%dofs_of)) return
      do i = 1, n_fields
         if (.not. value%dofs_of(i)) cycle
         associate (field => fields(i))
            if (len(json) > 0) json = json//', '
            json = json//'{"name": '//quoted(field%name)//', "first": '//to_text(field%first_dof)//', "last": '// &
               to_text(last_dof(i))//', "unit": '//quoted(field%unit)//', "rotation": '// &
               truth(field%is_rotation)//'}'
         end associate
      end do
      json = ', "fields": ['//json//']'
   end function dof_members

   pure function place_word(place) result(word)
      !> One of `place_...`
      integer, intent(in) :: place
      character(len=:), allocatable :: word

      select case (place)
      case (place_model)
         word = 'model'
      case (place_step)
         word = 'step'
      case (place_both)
         word = 'model or step'
      case default
         word = 'begins step'
      end select
   end function place_word

   pure function kind_word(kind) result(word)
      !> One of `kind_...`
      integer, intent(in) :: kind
      character(len=:), allocatable :: word

      select case (kind)
      case (kind_flag)
         word = 'flag'
      case (kind_integer)
         word = 'integer'
      case (kind_real)
         word = 'real'
      case (kind_choice)
         word = 'choice'
      case (kind_name)
         word = 'name'
      case (kind_item)
         word = 'number or set'
      case (kind_file)
         word = 'file'
      case default
         word = 'text'
      end select
   end function kind_word

   !> Members of an object, each with a comma before it.
   pure function limit_members(limit) result(json)
      !> One of `limit_...`
      integer, intent(in) :: limit
      character(len=:), allocatable :: json

      select case (limit)
      case (limit_positive)
         json = ', "exclusive_minimum": 0'
      case (limit_not_negative)
         json = ', "minimum": 0'
      case (limit_poisson)
         json = ', "exclusive_minimum": -1, "exclusive_maximum": 0.5'
      case (limit_one)
         json = ', "minimum": 1'
      case (limit_unused)
         json = ', "unused": true'
      case default
         json = ''
      end select
      if (limit /= limit_none) json = json//', "limit": '//quoted(describe_limit(limit))
   end function limit_members

   !> Words that bars separate.
   pure function choice_list(choices) result(json)
      !> The words
      character(len=*), intent(in) :: choices
      character(len=:), allocatable :: json
      integer :: i

      json = '['
      if (len_trim(choices) > 0) json = json//'"'
      do i = 1, len_trim(choices)
         if (choices(i:i) == '|') then
            json = json//'", "'
         else
            json = json//choices(i:i)
         end if
      end do
      if (len_trim(choices) > 0) json = json//'"'
      json = json//']'
   end function choice_list

   pure function quoted(text) result(json)
      !> Blanks at its end do not count
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: json
      integer :: i

      json = '"'
      do i = 1, len_trim(text)
         if (text(i:i) == '"' .or. text(i:i) == '\') json = json//'\'
         json = json//text(i:i)
      end do
      json = json//'"'
   end function quoted

   pure function quoted_or_null(text) result(json)
      !> Empty or blank: null
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: json

      json = 'null'
      if (len_trim(text) > 0) json = quoted(text)
   end function quoted_or_null

   !> 0 stands for any number.
   pure function number_or_null(number) result(json)
      !> Not negative
      integer, intent(in) :: number
      character(len=:), allocatable :: json

      json = 'null'
      if (number > 0) json = to_text(number)
   end function number_or_null

   pure function truth(value) result(json)
      !> The value as JSON has it
      logical, intent(in) :: value
      character(len=:), allocatable :: json

      json = trim(merge('true ', 'false', value))
   end function truth

end module litz_keyword_json
