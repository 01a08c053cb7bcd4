"""The project's own rules for the Fortran sources find what breaks them, and nothing else."""

from pathlib import Path

import pytest

import fortran_rules
from fortran_rules import breaches_of, problems, procedures

KERNEL = Path("kernels/example.f90")

DOCUMENTED = """
   !> Sum of the squares of some numbers over a reference.
   pure real(dp) function scaled_sum(model, values, reference, wanted, name) result(total)
      type(model_t), intent(in) :: model
      !> Numbers (n) [m]
      real(dp), intent(in) :: values(:)
      real(dp), intent(in) :: reference  !< What they are scaled by [m], positive
      !> Which of them count (n), and what
      !> they are called
      logical, intent(in) :: &
         wanted(:)
      !> Name, or "!"
      character(len=*), intent(in) :: name
      real(dp) :: not_an_argument
   end function scaled_sum
"""


def rules_broken(text, path=KERNEL):
    return [(breach.rule, breach.line) for breach in breaches_of(path, text.splitlines())]


def procedure_of(n_lines, header="subroutine long()"):
    return "\n".join([header, *["x = 1"] * (n_lines - 2), "end subroutine long"])


def test_documented_arguments_pass():
    assert rules_broken(DOCUMENTED) == []
    assert [argument.name for argument in next(procedures(DOCUMENTED.splitlines())).arguments] == [
        "values",
        "reference",
        "wanted",
        "name",
    ]


@pytest.mark.parametrize(
    ("documentation", "line"),
    [("!> Numbers (n) [m]", 6), ("!< What they are scaled by [m], positive", 7), ('!> Name, or "!"', 13)],
)
def test_an_argument_without_documentation_is_found(documentation, line):
    assert documentation in DOCUMENTED
    assert rules_broken(DOCUMENTED.replace(documentation, "")) == [("undocumented", line)]


def test_the_documentation_of_an_assumed_shape_gives_the_shape():
    assert rules_broken(DOCUMENTED.replace("Numbers (n) [m]", "Numbers [m]")) == [("undocumented", 6)]


def test_a_plain_comment_documents_nothing():
    assert rules_broken(DOCUMENTED.replace("!> Numbers (n)", "! Numbers (n)")) == [("undocumented", 6)]


def test_documentation_belongs_to_one_declaration():
    text = DOCUMENTED.replace(":: values(:)", ":: values(:)\n      real(dp), intent(in) :: other")
    text = text.replace("(model, values,", "(model, values, other,")
    assert rules_broken(text) == [("undocumented", 7)]


def test_arguments_of_interfaces_count_too():
    text = "interface\nsubroutine c_free(n)\ninteger, value :: n\nend subroutine c_free\nend interface"
    assert rules_broken(text) == [("undocumented", 3)]


def test_arguments_of_inner_procedures_are_those_of_the_inner_procedure():
    text = "subroutine outer()\ncontains\nsubroutine inner(n)\ninteger :: n\nend subroutine inner\nend subroutine outer"
    assert rules_broken(text) == [("undocumented", 4)]


def test_a_long_procedure_is_found():
    assert rules_broken(procedure_of(100)) == []
    assert rules_broken(procedure_of(101)) == [("long procedure", 1)]


def test_documentation_makes_no_procedure_long():
    text = procedure_of(100, "subroutine long(n)\n!> Number\ninteger :: n").replace("x = 1\n", "", 1)
    assert rules_broken(text) == []


def test_a_long_file_is_found():
    assert rules_broken("\n" * 500) == []
    assert rules_broken("\n" * 501) == [("long file", 1)]


def test_a_long_list_of_arguments_is_found():
    def subroutine(n):
        return f"subroutine many({', '.join(f'a{i}' for i in range(n))})\nend subroutine many"

    assert rules_broken(subroutine(12)) == []
    assert rules_broken(subroutine(13)) == [("many arguments", 1)]
    assert rules_broken(subroutine(13), Path("interfaces/abaqus_uel.f90")) == []


def test_names_of_the_lists_of_exceptions_exist():
    assert all((fortran_rules.ROOT / "fortran" / name).is_file() for name in fortran_rules.DICTATED)


def test_a_breach_is_told_with_its_place():
    lines = ["subroutine some(a)", "integer :: a", "end subroutine some"]
    assert list(problems({Path("kernels/example.f90"): lines})) == [
        "kernels/example.f90:2: a of some has no !> documentation"
    ]


@pytest.mark.parametrize(("n_lines", "is_too_long"), [(15, False), (16, True)])
def test_half_of_the_procedures_are_short(n_lines, is_too_long):
    texts = [procedure_of(2), procedure_of(n_lines), procedure_of(50)]
    sources = {KERNEL: "\n".join(texts).splitlines()}
    assert any("half of the procedures" in problem for problem in problems(sources)) == is_too_long
