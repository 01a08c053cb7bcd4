!> The pieces of which the table of keywords is put together, each in one call.
module litz_keyword_builders
   use litz_keywords, only: keyword_t, parameter_spec_t, field_spec_t, keyword_table_t, kind_integer, kind_real, &
      kind_choice, kind_name, kind_item, kind_file, kind_text, limit_positive, limit_unused
   implicit none
   private
   public :: begin, finish, field, integer_field, real_field, dofs_of, choice_field, name_field, item_field, &
      text_field, &
      unused, flag, choice, name, item, number, count_of, file

contains

   pure subroutine begin(k, name, place, help, after)
      type(keyword_t), intent(out) :: k
      !> The keyword in capitals
      character(len=*), intent(in) :: name
      !> Sentences for the reference
      character(len=*), intent(in) :: help
      !> Where the keyword may stand, one of `place_...`
      integer, intent(in) :: place
      !> Keyword of the group that it belongs to; absent: it begins a group
      character(len=*), intent(in), optional :: after

      k%name = name
      k%place = place
      k%help = help
      if (present(after)) k%after = after
      allocate (k%parameters(0), k%data(0))
   end subroutine begin

   pure subroutine finish(table, k)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t), intent(in) :: k

      table%n = table%n + 1
      table%keywords(table%n) = k
   end subroutine finish

   pure type(field_spec_t) function field(name, kind, unit, help, limit, required, choices) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> Unit in SI; empty: none
      character(len=*), intent(in) :: unit
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> One of `kind_...`
      integer, intent(in) :: kind
      !> What the number must satisfy, one of `limit_...`
      integer, intent(in), optional :: limit
      !> .true.: must not be left out
      logical, intent(in), optional :: required
      !> The words allowed, separated by bars
      character(len=*), intent(in), optional :: choices

      spec%name = name
      spec%kind = kind
      spec%unit = unit
      spec%help = help
      if (present(limit)) spec%limit = limit
      if (present(required)) spec%required = required
      if (present(choices)) spec%choices = choices
   end function field

   pure type(field_spec_t) function integer_field(name, help, limit, required) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> What the number must satisfy, one of `limit_...`
      integer, intent(in), optional :: limit
      !> .true.: must not be left out
      logical, intent(in), optional :: required

      spec = field(name, kind_integer, '', help, limit, required)
   end function integer_field

   pure type(field_spec_t) function real_field(name, unit, help, limit, required) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> Unit in SI; empty: none
      character(len=*), intent(in) :: unit
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> What the number must satisfy, one of `limit_...`
      integer, intent(in), optional :: limit
      !> .true.: must not be left out
      logical, intent(in), optional :: required

      spec = field(name, kind_real, unit, help, limit, required)
   end function real_field

   !> A value that is a degree of freedom.
   pure type(field_spec_t) function dofs_of(unknowns, value) result(spec)
      !> Of which fields (n), by index in litz_fields
      integer, intent(in) :: unknowns(:)
      type(field_spec_t), intent(in) :: value

      spec = value
      spec%dofs_of(unknowns) = .true.
   end function dofs_of

   pure type(field_spec_t) function choice_field(name, choices, help) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> The words allowed, separated by bars
      character(len=*), intent(in) :: choices
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help

      spec = field(name, kind_choice, '', help, choices=choices)
   end function choice_field

   pure type(field_spec_t) function name_field(name, help, required) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> .true.: must not be left out
      logical, intent(in), optional :: required

      spec = field(name, kind_name, '', help, required=required)
   end function name_field

   pure type(field_spec_t) function item_field(name, help) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help

      spec = field(name, kind_item, '', help)
   end function item_field

   pure function text_field(name, help) result(spec)
      !> What the field is called in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means
      character(len=*), intent(in) :: help
      type(field_spec_t) :: spec

      spec = field(name, kind_text, '', help)
   end function text_field

   !> A place of CalculiX's that litz has no use for.
   pure function unused(name) result(spec)
      !> CalculiX's name of the field
      character(len=*), intent(in) :: name
      type(field_spec_t) :: spec

      spec = real_field(name, '', 'not used by litz, leave empty', limit_unused, .false.)
   end function unused

   pure type(parameter_spec_t) function flag(name, help) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help

      spec%name = name
      spec%help = help
   end function flag

   pure type(parameter_spec_t) function choice(name, choices, help, required, default, value_optional) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> The words allowed, separated by bars
      character(len=*), intent(in) :: choices
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> .true.: must not be left out
      logical, intent(in), optional :: required
      !> .true.: the parameter may stand without a value
      logical, intent(in), optional :: value_optional
      !> Value that holds where there is none
      character(len=*), intent(in), optional :: default

      spec%name = name
      spec%kind = kind_choice
      spec%choices = choices
      spec%help = help
      if (present(required)) spec%required = required
      if (present(default)) spec%default = default
      if (present(value_optional)) spec%value_optional = value_optional
   end function choice

   pure type(parameter_spec_t) function name(parameter, help, required) result(spec)
      !> The parameter in capitals
      character(len=*), intent(in) :: parameter
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> .true.: must not be left out
      logical, intent(in), optional :: required

      spec%name = parameter
      spec%kind = kind_name
      spec%help = help
      if (present(required)) spec%required = required
   end function name

   !> The number of a node or element, or the name of a set; it must not be left out.
   pure type(parameter_spec_t) function item(parameter, help) result(spec)
      !> The parameter in capitals
      character(len=*), intent(in) :: parameter
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help

      spec%name = parameter
      spec%kind = kind_item
      spec%required = .true.
      spec%help = help
   end function item

   !> A real number.
   pure type(parameter_spec_t) function number(name, help, limit, default) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> What the number must satisfy, one of `limit_...`
      integer, intent(in) :: limit
      !> Value that holds where there is none
      character(len=*), intent(in), optional :: default

      spec%name = name
      spec%kind = kind_real
      spec%limit = limit
      spec%help = help
      if (present(default)) spec%default = default
   end function number

   !> A whole number of at least 1, or with another limit.
   pure type(parameter_spec_t) function count_of(name, help, default, limit) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help
      !> Value that holds where there is none
      character(len=*), intent(in) :: default
      !> What the number must satisfy, one of `limit_...`
      integer, intent(in), optional :: limit

      spec%name = name
      spec%kind = kind_integer
      spec%limit = limit_positive
      if (present(limit)) spec%limit = limit
      spec%help = help
      spec%default = default
   end function count_of

   pure type(parameter_spec_t) function file(name, help) result(spec)
      !> Name in the reference and in messages
      character(len=*), intent(in) :: name
      !> What it means, for the reference and for messages
      character(len=*), intent(in) :: help

      spec%name = name
      spec%kind = kind_file
      spec%required = .true.
      spec%help = help
   end function file

end module litz_keyword_builders
