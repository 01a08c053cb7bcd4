"""The project's own rules for the Fortran sources: documented arguments, short procedures, short lists of arguments, short files.

``python tests/fortran_rules.py`` prints what breaks a rule as ``file:line: ...`` and ends with code 1.
"""

import re
import statistics
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[1]

MAX_PROCEDURE_LINES = 100
MAX_FILE_LINES = 500
MAX_ARGUMENTS = 12
MAX_MEDIAN_LINES = 15

# Files whose lists of arguments are dictated from outside.
DICTATED = {
    "interfaces/abaqus_uel.f90": "Abaqus calls it",
    "interfaces/feap_elmt.f90": "FEAP calls it",
    "interfaces/f2py_beams.f90": "f2py takes no derived types",
    "interfaces/f2py_contact.f90": "f2py takes no derived types",
    "interfaces/f2py_contact_em.f90": "f2py takes no derived types",
    "interfaces/f2py_heat.f90": "f2py takes no derived types",
    "interfaces/f2py_line.f90": "f2py takes no derived types",
    "interfaces/f2py_superconductor.f90": "f2py takes no derived types",
    "interfaces/f2py_surface.f90": "f2py takes no derived types",
    "interfaces/f2py_yielding.f90": "f2py takes no derived types",
    "solvers/umfpack.f90": "the C interface of UMFPACK",
}

TYPE_OR_PREFIX = r"(?:pure|elemental|impure|recursive|integer|real|logical|character|complex|type)"
IN_PARENTHESES = r"\((?:[^()]|\([^()]*\))*\)"
PREFIX = rf"(?:{TYPE_OR_PREFIX}\s*(?:{IN_PARENTHESES}\s*)?)*"
PROCEDURE = re.compile(rf"{PREFIX}(?:subroutine|function)\s+(\w+)\s*(?:\(([^)]*)\))?", re.IGNORECASE)
END_OF_PROCEDURE = re.compile(r"end\s*(?:subroutine|function)\b", re.IGNORECASE)
PLAIN_DECLARATION = re.compile(r"(?:integer|real|logical|character|complex)\b(.*?)::(.*)", re.IGNORECASE)


@dataclass
class Breach:
    """Something that breaks a rule."""

    rule: str
    path: Path
    line: int
    message: str

    def __str__(self):
        return f"{self.path}:{self.line}: {self.message}"


@dataclass
class Argument:
    """A dummy argument of plain type: a number, a truth value, a text, or an array of these."""

    name: str
    line: int
    shape: str
    comment: str

    @property
    def is_documented(self):
        """With words, which give the shape where the declaration does not."""
        return bool(self.comment) and (":" not in self.shape or "(" in self.comment)


@dataclass
class Procedure:
    """A procedure, or the interface of one that is elsewhere."""

    name: str
    line: int
    names: list
    is_interface: bool
    # of its documentation none count
    n_lines: int = 0
    arguments: list = field(default_factory=list)


def split_list(text):
    """The items of a list; commas in parentheses do not count."""
    items, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            items.append("")
        else:
            items[-1] += letter
    return [item.strip() for item in items]


def split_comment(line):
    """The code of a line and its comment; an exclamation mark in quotes begins none."""
    quote = ""
    for i, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter == "!":
            return line[:i].strip(), line[i:].strip()
    return line.strip(), ""


def statements(lines):
    """Each statement with the number of its first and last line and its documentation: ``!>`` above, ``!<`` behind."""
    above, behind, code, first = "", "", "", 0
    for number, line in enumerate(lines, 1):
        text, comment = split_comment(line)
        if comment.startswith("!<"):
            behind += comment[2:]
        if not text:
            if comment.startswith("!>"):
                above += comment[2:]
            elif not code and not comment.startswith("!"):
                above = ""
            continue
        first = first or number
        code += text.removeprefix("&")
        if code.endswith("&"):
            code = code.removesuffix("&")
            continue
        yield code, first, number, (above + behind).strip()
        above, behind, code, first = "", "", "", 0


def procedures(lines):
    """All procedures of a file, those within others and those of interfaces too."""
    unfinished, depth = [], 0
    for code, first, last, comment in statements(lines):
        if re.match(r"(abstract\s+)?interface\b", code, re.IGNORECASE):
            depth += 1
        elif re.match(r"end\s*interface\b", code, re.IGNORECASE):
            depth -= 1
        elif match := PROCEDURE.match(code):
            names = [name.lower() for name in split_list(match[2] or "") if name]
            unfinished.append(Procedure(match[1], first, names, depth > 0))
        elif END_OF_PROCEDURE.match(code):
            procedure = unfinished.pop()
            within = lines[procedure.line - 1 : last]
            procedure.n_lines = sum(not line.lstrip().startswith("!>") for line in within)
            yield procedure
        elif unfinished and (match := PLAIN_DECLARATION.match(code)):
            unfinished[-1].arguments += plain_arguments(unfinished[-1].names, match[1], match[2], first, comment)


def plain_arguments(dummies, attributes, names, line, comment):
    """The dummy arguments among the names of a declaration."""
    dimension = re.search(r"dimension\s*\(([^()]*)\)", attributes, re.IGNORECASE)
    for item in split_list(names):
        name, shape = re.match(r"(\w+)\s*(?:\((.*)\))?", item).groups()
        if name.lower() in dummies:
            yield Argument(name, line, shape or (dimension[1] if dimension else ""), comment)


def breaches_of(path, lines):
    """What breaks a rule in one file; ``path`` is relative to the folder of the Fortran sources."""
    if len(lines) > MAX_FILE_LINES:
        yield Breach("long file", path, 1, f"{len(lines)} lines; a file has at most {MAX_FILE_LINES}")
    for procedure in procedures(lines):
        if procedure.n_lines > MAX_PROCEDURE_LINES:
            message = f"{procedure.name} has {procedure.n_lines} lines; a procedure has at most {MAX_PROCEDURE_LINES}"
            yield Breach("long procedure", path, procedure.line, message)
        if len(procedure.names) > MAX_ARGUMENTS and path.as_posix() not in DICTATED:
            message = f"{procedure.name} has {len(procedure.names)} arguments; more than {MAX_ARGUMENTS} become a type"
            yield Breach("many arguments", path, procedure.line, message)
        for argument in procedure.arguments:
            if not argument.is_documented:
                lacks = "shape in the" if argument.comment else "!>"
                message = f"{argument.name} of {procedure.name} has no {lacks} documentation"
                yield Breach("undocumented", path, argument.line, message)


def problems(sources):
    """What must be cured, as lines of text; ``sources`` are the lines of each file by its path in the folder of the sources."""
    yield from (str(breach) for path, lines in sources.items() for breach in breaches_of(path, lines))
    lengths = [
        procedure.n_lines for lines in sources.values() for procedure in procedures(lines) if not procedure.is_interface
    ]
    if lengths and statistics.median(lengths) > MAX_MEDIAN_LINES:
        yield f"half of the procedures have more than {statistics.median(lengths)} lines; at most {MAX_MEDIAN_LINES}"


def main():
    folder = ROOT / "fortran"
    sources = {
        path.relative_to(folder): path.read_text(encoding="utf-8").splitlines()
        for path in sorted(folder.rglob("*.f90"))
    }
    found = list(problems(sources))
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
