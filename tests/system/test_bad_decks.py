"""Decks with one mistake each: what is said about it, where, and how the program ends."""

import re

import pytest

from in_parts import in_parts

DECK = """\
*HEADING
Two wires that cross
*NODE, NSET=ALL
1, 0., -0.01, 0.
2, 0., 0.01, 0.
3, -0.01, 0., 0.001
4, 0.01, 0., 0.001
*ELEMENT, TYPE=B31, ELSET=LOWER
1, 1, 2
*ELEMENT, TYPE=B33, ELSET=UPPER
2, 3, 4
*NSET, NSET=PLUS
1, 2
*MATERIAL, NAME=CU
*ELASTIC
1.2e11, 0.35
*ELECTRICAL CONDUCTIVITY
5.8e7
*BEAM SECTION, ELSET=LOWER, MATERIAL=CU, SECTION=CIRC
0.0005
0., 0., 1.
*BEAM SECTION, ELSET=UPPER, MATERIAL=CU, SECTION=GENERAL, CONTACT RADIUS=0.0005
8e-7, 5e-14, 0., 5e-14, 1e-13
*AMPLITUDE, NAME=UP
0., 0., 1., 1.
*SURFACE INTERACTION, NAME=SPOT
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e8
*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ
*CONTACT PAIR, INTERACTION=SPOT
LOWER, UPPER
*BOUNDARY
1, ENCASTRE
*STEP, INC=50
*STATIC
0.5, 1., 1e-4, 0.5
*BOUNDARY
2, PINNED
3, 1, 6
4, 1, 6
PLUS, 9
3, 9, 9, 0.01
*CLOAD, AMPLITUDE=UP
2, 4, 1e-6
*NODE PRINT, NSET=PLUS
RF, RCURR
*END STEP
"""


def line_of(text, deck):
    """Number of the first line that contains a text."""
    return next(number for number, line in enumerate(deck.splitlines(), 1) if text in line)


def errors_in(result):
    """All errors of a run, with their parts by name. Each must be complete: message, place, line, caret."""
    pattern = re.compile(
        r"^error: (?P<message>.*)\n"
        r" *--> (?P<file>.*?):(?P<line>\d+):(?P<column>\d+)\n"
        r"(?P<origin>(?: +included from .*\n)*)"
        r" +\|\n\d+ \| (?P<card>.*)\n +\| (?P<caret> *\^+)$",
        re.MULTILINE,
    )
    found = list(pattern.finditer(result.stderr))
    assert len(found) == result.stderr.count("error: "), result.stderr
    return found


def check_one_error(litz, directory, deck, message, line, marked):
    """The deck has one error and no other: this message at this line, and a caret below this text."""
    (directory / "bad.inp").write_text(deck)
    result = litz("check", "bad.inp", cwd=directory)
    assert result.returncode == 1, result.stderr
    found = errors_in(result)
    assert len(found) == 1, result.stderr
    error = found[0]
    assert message in error["message"]
    assert (error["file"], int(error["line"])) == ("bad.inp", line), result.stderr
    assert error["card"] == deck.splitlines()[line - 1]
    first = error["caret"].index("^")
    assert int(error["column"]) == first + 1
    assert error["card"][first : len(error["caret"])] == marked


def test_the_deck_without_a_mistake_is_accepted(litz, tmp_path):
    (tmp_path / "good.inp").write_text(DECK)
    result = litz("check", "good.inp", cwd=tmp_path)
    assert (result.returncode, result.stderr) == (0, "")


def case(name, old, new, message, marked, at=None):
    """One mistake: a place of the good deck, what stands there instead, what is said, and the text below which the
    caret stands (empty: behind the end of the line). ``at`` is the line that is blamed where that is not the first
    one from the change on that holds the text."""
    return pytest.param(old, new, message, marked, at, id=name)


# values and what they mean
VALUES = [
    case(
        "two diameters, as in CalculiX",
        "0.0005\n0.,",
        "0.001, 0.001\n0.,",
        "*BEAM SECTION takes 1 on this line: radius; as in Abaqus it is the radius: two values are diameters, as in CalculiX",
        "0.001",
    ),
    case(
        "number of a node",
        "1, 0., -0.01",
        "one, 0., -0.01",
        'id (number of the node), must be a whole number; found "one"',
        "one",
    ),
    case("coordinate", "2, 0., 0.01", "2, zero, 0.01", 'x (position), must be a number; found "zero"', "zero"),
    case(
        "blanks instead of commas",
        "1.2e11, 0.35",
        "1.2e11 0.35, 0.3",
        "values are separated by commas",
        "1.2e11 0.35",
    ),
    case("real for a node number", "2, 3, 4\n", "2, 3, 4.\n", "must be a whole number", "4."),
    case("NaN", "2, 0., 0.01", "2, nan, 0.01", "must be a finite number", "nan"),
    case("infinity", "1.2e11", "-Infinity", "must be a finite number", "-Infinity"),
    case("overflow", "1.2e11", "1.2e999", "is too large", "1.2e999"),
    case("underflow", "1.2e11", "1.2e-999", "is too small", "1.2e-999"),
    case("integer overflow", "1, 1, 2\n", "1, 1, 99999999999\n", "is too large", "99999999999"),
    case("negative number of an element", "1, 1, 2\n", "-1, 1, 2\n", "must be greater than 0", "-1"),
    case(
        "Young's modulus zero",
        "1.2e11, 0.35",
        "0., 0.35",
        'E (Young\'s modulus), is "0."; it must be greater than 0',
        "0.",
    ),
    case("Young's modulus negative", "1.2e11, 0.35", "-1.2e11, 0.35", "must be greater than 0", "-1.2e11"),
    case(
        "Poisson's ratio too large",
        "0.35",
        "0.5",
        'nu (Poisson\'s ratio), is "0.5"; it must be between -1 and 0.5',
        "0.5",
    ),
    case("Poisson's ratio too small", "0.35", "-1", "must be between -1 and 0.5", "-1"),
    case(
        "conductivity",
        "5.8e7",
        "-5.8e7",
        'sigma (electrical conductivity), is "-5.8e7"; it must be greater than 0',
        "-5.8e7",
    ),
    case(
        "radius negative",
        "0.0005\n0.,",
        "-0.0005\n0.,",
        'radius (radius of the wire), is "-0.0005"; it must be greater',
        "-0.0005",
    ),
    case("radius zero", "0.0005\n0.,", "0\n0.,", "must be greater than 0", "0"),
    case(
        "radius beyond all units",
        "0.0005\n0.,",
        "5e-50\n0.,",
        "the length, the stiffnesses or the conductance of element 1 are too large or too small",
        "1, 1, 2",
        at="1, 1, 2",
    ),
    case(
        "radius too large to square",
        "0.0005\n0.,",
        "1e160\n0.,",
        "is too large; litz accepts numbers up to 1e60",
        "1e160",
    ),
    case("radius too small to square", "0.0005\n0.,", "1e-90\n0.,", "is too small; it must be at least 1e-60", "1e-90"),
    case("position too large", "2, 0., 0.01", "2, 0., -1e61", "is too large; litz accepts numbers up to 1e60", "-1e61"),
    case("load too large", "2, 4, 1e-6", "2, 4, 1e61", "is too large; litz accepts numbers up to 1e60", "1e61"),
    case("contact radius", "RADIUS=0.0005", "RADIUS=-1", 'CONTACT RADIUS is "-1"; it must be greater than 0', "-1"),
    case(
        "mixed second moment",
        "5e-14, 0., 5e-14",
        "5e-14, 6e-14, 5e-14",
        "no section has the product of inertia",
        "6e-14",
    ),
    case("area", "8e-7", "0", 'A (area), is "0"; it must be greater than 0', "0"),
    case("penalty", "\n1e8", "\n-1e8", 'value 1, penalty, is "-1e8"', "-1e8"),
    case("empty value", "2, 0., 0.01, 0.", "2, , 0.01, 0.", "value 2, x (position), is missing", ","),
    case("increment zero", "0.5, 1., 1e-4", "0., 1., 1e-4", "must be greater than 0", "0."),
    case("increment negative", "0.5, 1., 1e-4", "0.5, 1., -1e-4", "must be greater than 0", "-1e-4"),
    case(
        "first increment larger than the step",
        "0.5, 1., 1e-4, 0.5",
        "2., 1., 1e-4",
        "the first increment, 2, is larger than the step, 1",
        "2.",
    ),
    case(
        "smallest increment larger than the first",
        "1e-4, 0.5",
        "0.6, 0.7",
        "the smallest increment, 0.6, is larger than the first",
        "0.6",
    ),
    case(
        "largest increment smaller than the first",
        "1e-4, 0.5",
        "1e-4, 0.4",
        "the largest increment, 0.4, is smaller than the first",
        "0.4",
    ),
    case(
        "too few increments allowed",
        "INC=50",
        "INC=1",
        "the step needs 2 increments at least, but INC allows 1",
        "1",
        at="*STEP, INC=1",
    ),
    case("increments not a number", "INC=50", "INC=many", 'INC must be a whole number; found "many"', "many"),
    case("increments zero", "INC=50", "INC=0", "must be greater than 0", "0", at="*STEP, INC=0"),
    case(
        "too many values",
        "1, 1, 2\n",
        "1, 1, 2, 3\n",
        "too many values: *ELEMENT takes 3 on this line: id, n1, n2",
        "3",
    ),
    case(
        "amplitude not ascending",
        "1., 1.\n*SURF",
        "0., 1.\n*SURF",
        "the times of an amplitude must ascend; 0 follows 0",
        "0.",
    ),
    case("undefined node in an element", "1, 1, 2\n", "1, 1, 7\n", "element 1 has node 7, which is not defined", "7"),
    case("node in a set", "PLUS\n1, 2\n", "PLUS\n1, 7\n", "there is no node 7", "7"),
    case(
        "element set in a section",
        "ELSET=LOWER, MAT",
        "ELSET=LOWR, MAT",
        'there is no element set "LOWR"; did you mean LOWER?',
        "LOWR",
    ),
    case(
        "node set for an element set",
        "ELSET=LOWER, MAT",
        "ELSET=PLUS, MAT",
        "(there is a node set of this name)",
        "PLUS",
    ),
    case(
        "material",
        "MATERIAL=CU, SECTION=C",
        "MATERIAL=CO, SECTION=C",
        'there is no material "CO"; did you mean CU?',
        "CO",
    ),
    case(
        "interaction",
        "INTERACTION=SPOT",
        "INTERACTION=SOPT",
        'there is no surface interaction "SOPT"; did you mean SPOT?',
        "SOPT",
    ),
    case("amplitude", "AMPLITUDE=UP", "AMPLITUDE=UPP", 'there is no amplitude "UPP"; did you mean UP?', "UPP"),
    case(
        "set in a contact pair",
        "LOWER, UPPER",
        "LOWER, UPER",
        'there is no element set "UPER"; did you mean UPPER?',
        "UPER",
    ),
    case("set in *BOUNDARY", "PLUS, 9", "PLUSS, 9", 'there is no node set "PLUSS"; did you mean PLUS?', "PLUSS"),
    case("node in *BOUNDARY", "3, 1, 6", "33, 1, 6", "there is no node 33", "33"),
    case("set in *NODE PRINT", "PRINT, NSET=PLUS", "PRINT, NSET=MINUS", 'there is no node set "MINUS"', "MINUS"),
    case("degree of freedom 7", "3, 1, 6", "3, 1, 7", "degree of freedom 7 does not exist", "7"),
    case("degree of freedom 0", "PLUS, 9", "PLUS, 0", "degree of freedom 0 does not exist", "0"),
    case(
        "degree of freedom unknown word",
        "2, PINNED",
        "2, PINED",
        '4-6 (rotation), 9 (potential) or 11 (temperature); found "PINED"',
        "PINED",
    ),
    case("value after PINNED", "2, PINNED", "2, PINNED, 3", "nothing follows PINNED", "3"),
    case("range backwards", "3, 1, 6", "3, 6, 1", "the last degree of freedom, 1, is smaller than the first, 6", "1"),
    case(
        "range over two fields",
        "3, 1, 6",
        "3, 1, 9",
        "a range must not reach from displacement to potential; use two lines",
        "9",
    ),
    case(
        "value before the first step",
        "1, ENCASTRE",
        "1, 1, 6, 0.1",
        "before the first step only zero values can be prescribed",
        "0.1",
    ),
    case(
        "prescribed twice",
        "4, 1, 6\n",
        "4, 1, 6\n3, 3, 3, 0.001\n",
        "degree of freedom 3 of node 3 is prescribed twice",
        "3",
        at="3, 3, 3, 0.001",
    ),
    case(
        "force at degree of freedom 9",
        "2, 4, 1e-6",
        "2, 9, 1e-6",
        "forces and moments act in directions 1-6; found 9; currents are given by *CECURRENT",
        "9",
    ),
    case(
        "unknown quantity",
        "RF, RCURR",
        "RF, RCUR",
        'must be U, UR, RF, RM, CF, CM, EPOT, NT, RCURR, RFL, CECUR or CFL; found "RCUR"; did you mean RCURR?',
        "RCUR",
    ),
    case("quantity twice", "RF, RCURR", "RF, RF", "the quantity RF is requested twice", "RF"),
    case("zero axis", "\n0., 0., 1.\n", "\n0., 0., 0.\n", "the first section axis n1 is zero", "0., 0., 0."),
    case(
        "axis along the wire",
        "\n0., 0., 1.\n",
        "\n0., 2., 0.\n",
        "the first section axis n1 is parallel to element 1",
        "0., 2., 0.",
    ),
    case(
        "nodes at the same place",
        "4, 0.01, 0., 0.001",
        "4, -0.01, 0., 0.001",
        "element 2 has no length: its nodes 3 and 4 are at the same place",
        "2, 3, 4",
    ),
    case("same node twice", "2, 3, 4\n", "2, 3, 3\n", "element 2 has no length", "2, 3, 3"),
    case(
        "range of a set backwards",
        "*NSET, NSET=PLUS\n1, 2\n",
        "*NSET, NSET=PLUS, GENERATE\n2, 1\n",
        "is smaller than the first",
        "1",
    ),
    case(
        "range of a set empty",
        "*NSET, NSET=PLUS\n1, 2\n",
        "*NSET, NSET=PLUS\n1\n*NSET, NSET=PLUS, GENERATE\n20, 30, 5\n",
        "there is no node with a number in this range",
        "20",
    ),
    case("name too long", "INC=50", "INC=50, NAME=" + 81 * "U", "is longer than 80 characters", 81 * "U"),
]

# keywords, parameters, missing and double things
KEYWORDS = [
    case("unknown keyword", "*HEADING", "*HAEDING", 'unknown keyword "HAEDING"; did you mean *HEADING?', "*HAEDING"),
    case(
        "unknown keyword, nothing near",
        "*STATIC",
        "*XYZZY\n*STATIC",
        'unknown keyword "XYZZY"; `litz keywords` lists',
        "*XYZZY",
    ),
    case(
        "unknown keyword that was to define a set in use",
        "*NSET, NSET=PLUS",
        "*NSTE, NSET=PLUS",
        'unknown keyword "NSTE"; did you mean *NSET?',
        "*NSTE",
    ),
    case(
        "unknown keyword that was to define a name in use",
        "*AMPLITUDE",
        "*AMPLITUDDE",
        'unknown keyword "AMPLITUDDE"; did you mean *AMPLITUDE?',
        "*AMPLITUDDE",
    ),
    case("keyword of Abaqus", "*GAP", "*PLASTIC\n*GAP", "litz has no *PLASTIC: beams are elastic", "*PLASTIC"),
    case("procedure of Abaqus", "*STATIC", "*Dynamic, application=quasi-static", "use *STATIC", "*Dynamic"),
    case(
        "parameter of Abaqus",
        "INC=50",
        "INC=50, UNSYMM=YES",
        'unknown parameter "UNSYMM" of *STEP: leave it out: litz chooses automatically; allowed: NAME',
        "UNSYMM",
    ),
    case("value of Abaqus", "TYPE=B31", "TYPE=PIPE31", 'found "PIPE31"; use B31 with SECTION=PIPE', "PIPE31"),
    case(
        "data of Abaqus",
        "1.2e11, 0.35",
        "1.2e11, 0.35, 293., 7.",
        "too many values: *ELASTIC takes 3 on this line: E, nu, T; material data depend on temperature alone",
        "7.",
    ),
    case(
        "comma missing behind a keyword",
        "*AMPLITUDE, NAME=UP",
        "*HEADING\n*NODE PRINT NSET=ALL\n*AMPLITUDE, NAME=UP",
        'unknown keyword "NODE PRINT NSET=ALL"; a comma is missing after *NODE PRINT',
        "*NODE PRINT NSET=ALL",
    ),
    case(
        "number in place of a set",
        "LOWER, UPPER",
        "1, UPPER",
        'there is no element set "1" (a name is needed here; a set may hold one element)',
        "1",
    ),
    case("comment of C", "*HEADING", "// a deck\n*HEADING", "a comment begins with **", "// a deck"),
    case("no comma in a data line", "1, ENCASTRE", "1 ENCASTRE", "(values are separated by commas)", ""),
    case("comment behind a value", "5.8e7", "5.8e7 ** S/m", "a comment has a line of its own", "5.8e7 ** S/m"),
    case(
        "unknown parameter",
        "*NODE, NSET=ALL",
        "*NODE, NSETT=ALL",
        'unknown parameter "NSETT" of *NODE; did you mean NSET?',
        "NSETT",
    ),
    case(
        "parameter of a keyword without any",
        "*ELECTRICAL CONDUCTIVITY",
        "*ELECTRICAL CONDUCTIVITY, TYPE=ISO",
        "which has no parameters",
        "TYPE",
    ),
    case("parameter twice", "NSET=ALL", "NSET=ALL, NSET=ALL2", "the parameter NSET is given twice", "NSET"),
    case("parameter without value", "INC=50", "INC=", "the parameter INC needs a value", "INC"),
    case("parameter with nothing", "INC=50", "INC", "the parameter INC needs a value", "INC"),
    case("flag with a value", "*STATIC", "*STATIC, DIRECT=YES", "the parameter DIRECT takes no value", "YES"),
    case("wrong choice", "TYPE=B33", "TYPE=B34", 'found "B34"; did you mean B31?', "B34"),
    case("wrong choice with hint", "LAW=HERTZ", "LAW=HERZ", "did you mean HERTZ?", "HERZ"),
    case(
        "OP before the first step",
        "*BOUNDARY\n1",
        "*BOUNDARY, OP=NEW\n1",
        "OP has no meaning before the first step",
        "NEW",
    ),
    case(
        "FIXED before the first step",
        "*BOUNDARY\n1",
        "*BOUNDARY, FIXED\n1",
        "FIXED has no meaning before the first step",
        "FIXED",
    ),
    case(
        "FIXED with a value",
        "*CLOAD, AMP",
        "*BOUNDARY, FIXED\n3, 1, 1, 0.1\n*CLOAD, AMP",
        "what is FIXED stays what it is: leave out the value",
        "0.1",
    ),
    case(
        "FIXED with an amplitude",
        "*CLOAD, AMP",
        "*BOUNDARY, FIXED, AMPLITUDE=UP\n2, 5\n*CLOAD, AMP",
        "what is FIXED follows no amplitude",
        "UP",
    ),
    case(
        "OP mixed",
        "*CLOAD, AMP",
        "*BOUNDARY, OP=NEW\n3, 1\n*CLOAD, AMP",
        "must have the same OP; this one has OP=NEW, an earlier one OP=MOD",
        "NEW",
    ),
    case(
        "no loads",
        "*CLOAD, AMP",
        "*CLOAD\n*CLOAD, AMP",
        "a data line is missing: *CLOAD needs at least 1",
        "CLOAD",
    ),
    case("quote", "INC=50", 'INC=50, NAME="FIRST', "this quotation mark is never closed", '"'),
    case(
        "step keyword in the model part",
        "*MATERIAL",
        "*STATIC\n*MATERIAL",
        "*STATIC belongs in a step",
        "STATIC",
    ),
    case(
        "model keyword in a step",
        "*CLOAD",
        "*NSET, NSET=X\n1\n*CLOAD",
        "*NSET belongs in the model part, before the first *STEP",
        "NSET",
    ),
    case(
        "elastic alone",
        "*AMPLITUDE",
        "*ELASTIC\n1., 0.\n*AMPLITUDE",
        "*ELASTIC must follow the *MATERIAL it belongs to",
        "ELASTIC",
    ),
    case(
        "elastic twice",
        "*ELECTRICAL",
        "*ELASTIC\n1., 0.\n*ELECTRICAL",
        "the material CU has two *ELASTIC",
        "ELASTIC",
    ),
    case(
        "behavior twice",
        "*GAP",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n*GAP",
        "this surface interaction has two *SURFACE BEHAVIOR",
        "SURFACE BEHAVIOR",
    ),
    case(
        "friction twice",
        "*GAP",
        "*FRICTION\n0.3\n*FRICTION\n0.2\n*GAP",
        "this surface interaction has two *FRICTION",
        "FRICTION",
        at="*FRICTION",
    ),
    case(
        "friction of two stiffnesses",
        "*GAP",
        "*FRICTION, ELASTIC SLIP=1e-6, STICK STIFFNESS=1e5\n0.3\n*GAP",
        "*FRICTION takes ELASTIC SLIP or STICK STIFFNESS, not both",
        "FRICTION",
    ),
    case(
        "conductance twice",
        "*CONTACT PAIR",
        "*GAP ELECTRICAL CONDUCTANCE, LAW=PAPER\n*CONTACT PAIR",
        "this surface interaction has two *GAP ELECTRICAL CONDUCTANCE",
        "GAP ELECTRICAL CONDUCTANCE",
        at="*GAP ELECTRICAL CONDUCTANCE, LAW=PAPER",
    ),
    case(
        "table of resistances not ascending",
        "LAW=HERTZ",
        "LAW=TABLE\n1., 2e-3\n0.5, 3e-3",
        "the forces of the table must ascend; 0.5 follows 1",
        "0.5",
        at="0.5, 3e-3",
    ),
    case(
        "factor that should shrink increments",
        "*CLOAD",
        "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n, , , 16\n1.25\n*CLOAD",
        "this factor shrinks increments, so it must be smaller than 1; found 1.25",
        "1.25",
    ),
    case(
        "factor that should let increments grow",
        "*CLOAD",
        "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n, , , 16\n, , , , , , 0.75\n*CLOAD",
        "this factor lets increments grow, so it must be 1 or greater; found 0.75",
        "0.75",
    ),
    case("static twice", "*CLOAD", "*STATIC\n*CLOAD", "this step has two *STATIC", "STATIC"),
    case(
        "controls twice",
        "*CLOAD",
        "*CONTROLS, PARAMETERS=FIELD\n 1e-6\n*controls, parameters=field\n 1e-4\n*CLOAD",
        'this step has two *CONTROLS, PARAMETERS="field"; first in bad.inp:',
        "controls",
    ),
    case(
        "controls of another program, with what only follows from it",
        "*CLOAD",
        "*CONTROLS, PARAMETERS=LINE SEARCH\n 4\n*CONTROLS, PARAMETERS=FIELD\n 1e-6\n*CLOAD",
        "the parameter PARAMETERS must be FIELD, TIME INCREMENTATION, ROTATION or STABILIZE; found",
        "LINE SEARCH",
    ),
    case(
        "a misspelt parameter that is required",
        "*CLOAD",
        "*CONTROLS, PARAMETER=FIELD\n 1e-6\n*CLOAD",
        'unknown parameter "PARAMETER" of *CONTROLS; did you mean PARAMETERS?',
        "PARAMETER",
    ),
    case(
        "a parameter of another program in place of one that is required",
        "*CLOAD",
        "*CONTROLS, ANALYSIS=DISCONTINUOUS\n*CLOAD",
        'unknown parameter "ANALYSIS" of *CONTROLS: leave the keyword out',
        "ANALYSIS",
    ),
    case(
        "solver twice",
        "*CLOAD",
        "*SOLVER, NAME=UMFPACK\n*solver, NAME=BLOCK\n*CLOAD",
        "this step has two *SOLVER; first in bad.inp:",
        "solver",
    ),
    case(
        "solution technique twice",
        "*CLOAD",
        "*SOLUTION TECHNIQUE, TYPE=NEWTON\n*solution technique, TYPE=MODIFIED NEWTON\n*CLOAD",
        "this step has two *SOLUTION TECHNIQUE; first in bad.inp:",
        "solution technique",
    ),
    case(
        "material twice",
        "*AMPLITUDE",
        "*MATERIAL, NAME=cu\n*ELASTIC\n1., 0.\n*AMPLITUDE",
        'the material "cu" is defined twice; first in bad.inp:14',
        "cu",
    ),
    case(
        "material never used",
        "*AMPLITUDE",
        "*MATERIAL, NAME=AL\n*ELASTIC\n1., 0.\n*AMPLITUDE",
        "the material AL is defined but never used",
        "AL",
    ),
    case(
        "amplitude never used",
        "*AMPLITUDE",
        "*AMPLITUDE, NAME=DOWN\n0., 1.\n*AMPLITUDE",
        "the amplitude DOWN is defined but never used",
        "DOWN",
    ),
    case(
        "interaction never used",
        "*SURFACE INTERACTION",
        "*SURFACE INTERACTION, NAME=IDLE\n*SURFACE INTERACTION",
        "the surface interaction IDLE is defined but never used",
        "IDLE",
    ),
    case(
        "no shear stiffness",
        "*AMPLITUDE",
        "*TRANSVERSE SHEAR STIFFNESS\n , 0., 0.25\n*AMPLITUDE",
        "a shear stiffness is missing: K23, for shear along n2, or K13, for shear along n1",
        ", 0., 0.25",
    ),
    case(
        "slenderness compensation that is no number",
        "*AMPLITUDE",
        "*TRANSVERSE SHEAR STIFFNESS\n 1e5, 1e5, SFC\n*AMPLITUDE",
        "SCF must be a number, 0 or greater, or the word SCF; found",
        "SFC",
    ),
    case(
        "material without elasticity",
        "*AMPLITUDE",
        "*MATERIAL, NAME=AL\n*BEAM SECTION, ELSET=NONE, MATERIAL=AL, SECTION=CIRC\n1.\n"
        "*ELEMENT, TYPE=B31, ELSET=NONE\n9, 1, 3\n*AMPLITUDE",
        "the material AL has no *ELASTIC",
        "AL",
    ),
    case("required parameter missing", ", TYPE=B33", "", "*ELEMENT needs the parameter TYPE=B31|B33", "ELEMENT"),
    case(
        "data line missing",
        "5.8e7\n",
        "",
        "a data line is missing: *ELECTRICAL CONDUCTIVITY needs at least 1",
        "ELECTRICAL CONDUCTIVITY",
        at="*ELECTRICAL CONDUCTIVITY",
    ),
    case(
        "nodes of a set of elements that is not there",
        "*MATERIAL",
        "*NSET, NSET=OF, ELSET=LOVER\n*MATERIAL",
        "there is no element set",
        "LOVER",
    ),
    case("data lines missing", "PLUS\n1, 2\n", "PLUS\n1, 2\n*NSET, NSET=MORE\n", "*NSET needs at least 1", "NSET"),
    case(
        "too many data lines",
        "0.5, 1., 1e-4, 0.5\n",
        "0.5, 1., 1e-4, 0.5\n6e7\n",
        "more data lines than *STATIC takes, which is 1",
        "6e7",
    ),
    case(
        "data over temperature without temperatures",
        "5.8e7\n",
        "5.8e7\n6e7\n",
        "a temperature is missing: every line of a table has one",
        "",
        at="5.8e7",
    ),
    case(
        "too few values",
        "1.2e11, 0.35",
        "1.2e11",
        "value 2, nu (Poisson's ratio), is missing; the line holds E, nu",
        "",
        at="1.2e11",
    ),
    case(
        "half a pair",
        "0., 0., 1., 1.",
        "0., 0., 1.",
        "value 4, a (factor at that time), is missing",
        "",
        at="0., 0., 1.",
    ),
    case("continuation missing", "INC=50\n", "INC=50,\n", "ends with a comma, but no line continues it", ","),
    case(
        "node twice",
        "4, 0.01, 0., 0.001\n",
        "4, 0.01, 0., 0.001\n3, 0.02, 0., 0.001\n",
        "node 3 is defined twice; first in bad.inp:6",
        "3",
    ),
    case("element twice", "\n2, 3, 4\n", "\n1, 3, 4\n", "element 1 is defined twice; first in bad.inp:9", "1"),
    case(
        "element without section",
        "2, 3, 4\n",
        "2, 3, 4\n*ELEMENT, TYPE=B31\n5, 2, 3\n6, 2, 4\n",
        "element 5 has no *BEAM SECTION, nor have 1 others",
        "5, 2, 3",
    ),
    case(
        "element in two sections",
        "*AMPLITUDE",
        "*BEAM SECTION, ELSET=LOWER, MATERIAL=CU, SECTION=CIRC\n1.\n*AMPLITUDE",
        "element 1 has two sections; the first one is in bad.inp:19",
        "LOWER",
    ),
    case(
        "radius for contact missing",
        ", CONTACT RADIUS=0.0005",
        "",
        "its *BEAM SECTION of UPPER has no CONTACT RADIUS",
        "UPPER",
        at="LOWER, UPPER",
    ),
    case(
        "contact pair twice",
        "LOWER, UPPER\n",
        "LOWER, UPPER\n*CONTACT PAIR, INTERACTION=SPOT\nUPPER, LOWER\n",
        "this contact pair is given twice; first in bad.inp:31",
        "UPPER",
    ),
    case(
        "loads of different amplitudes",
        "2, 4, 1e-6\n",
        "2, 4, 1e-6\n*CLOAD\n2, 4, 1e-6\n",
        "node 2 has loads of different amplitudes",
        "2",
        at="2, 4, 1e-6",
    ),
    case(
        "step without procedure",
        "*STATIC\n0.5, 1., 1e-4, 0.5\n",
        "",
        "this step has no *STATIC",
        "STEP",
        at="*STEP, INC=50",
    ),
    case("step without end", "*END STEP\n", "", "*END STEP of this step is missing", "STEP", at="*STEP, INC=50"),
]


@pytest.mark.parametrize(("old", "new", "message", "marked", "at"), VALUES + KEYWORDS)
def test_one_mistake(litz, tmp_path, old, new, message, marked, at):
    assert DECK.count(old) == 1, "the case must change one place"
    deck = DECK.replace(old, new)
    lines = deck.splitlines()
    change = next(i for i, good in enumerate(DECK.splitlines()) if i >= len(lines) or good != lines[i])
    if at is not None:
        line = max(i for i, text in enumerate(lines) if text == at)
    else:
        line = next(i for i in range(change, len(lines)) if marked in lines[i])
    check_one_error(litz, tmp_path, deck, message, line + 1, marked)


@pytest.mark.parametrize(
    ("pair", "message", "marked"),
    [
        ("LOWER, PLAET", 'there is no element set or rigid surface "PLAET"; did you mean PLATE?', "PLAET"),
        ("LOWER, BUTTON", 'rigid surface "BUTTON"; there is LOWER, UPPER and PLATE', "BUTTON"),
        ("PLATE, LOWER", '"PLATE" (there is a rigid surface of this name, which *CONTACT PAIR names after', "PLATE"),
        ("LOWR, PLATE", 'there is no element set "LOWR"; did you mean LOWER?', "LOWR"),
        ("LOWER, PLATE, UPPER", "too many values: *CONTACT PAIR takes 2 on this line", "UPPER"),
    ],
)
def test_a_pair_with_a_surface_that_is_not_found_is_one_mistake(litz, tmp_path, pair, message, marked):
    """That no pair uses the surface follows from it."""
    plate = "*RIGID SURFACE, NAME=PLATE, TYPE=PLANE\n0., 0., -0.001, 0., 0., 1.\n*CONTACT PAIR, INTERACTION=SPOT\n"
    deck = DECK.replace("*CONTACT PAIR, INTERACTION=SPOT\nLOWER, UPPER\n", f"{plate}{pair}\n")
    deck = deck.replace("LINEAR\n1e8", "HERTZ")
    check_one_error(litz, tmp_path, deck, message, line_of(pair, deck), marked)
    wrong = deck.replace(pair, "LOWER, PLATE").replace("*CONTACT PAIR", "*CONTACT PIAR")
    check_one_error(litz, tmp_path, wrong, "did you mean *CONTACT PAIR", line_of("PIAR", wrong), "*CONTACT PIAR")


@pytest.mark.parametrize(
    ("keyword", "wrong", "message"),
    [
        ("*NODE, NSET=ALL", "*NOED, NSET=ALL", 'unknown keyword "NOED"; did you mean *NODE?'),
        ("*ELEMENT, TYPE=B33", "*ELEMENX, TYPE=B33", 'unknown keyword "ELEMENX"; did you mean *ELEMENT?'),
        ("*NODE, NSET=ALL", "*NGEN, NSET=ALL", "litz has no *NGEN"),
        ("*ELEMENT, TYPE=B33", "*ELGEN, TYPE=B33", "litz has no *ELGEN"),
    ],
)
def test_nodes_and_elements_of_an_unknown_keyword_are_not_told_to_be_missing(litz, tmp_path, keyword, wrong, message):
    deck = DECK.replace(keyword, wrong)
    check_one_error(litz, tmp_path, deck, message, line_of(wrong, deck), wrong.partition(",")[0])


def test_a_load_on_a_node_of_no_element(litz, tmp_path):
    deck = DECK.replace("3, -0.01", "9, 0., 0., 1.\n3, -0.01").replace("2, 4, 1e-6", "9, 1, 1.")
    check_one_error(litz, tmp_path, deck, "node 9 belongs to no element", line_of("9, 1, 1.", deck), "9")


@pytest.mark.parametrize(
    ("cards", "line", "node"),
    [
        ("PLUS, 9\n", "PLUS, 9", "1 of PLUS"),
        ("*CECURRENT\n2, 9, 1e-3\n", "2, 9, 1e-3", "2"),
        ("*CECURRENT\n2, , 1e-3\n", "2, , 1e-3", "2"),
    ],
)
def test_a_potential_or_current_where_there_is_no_electric_field(litz, tmp_path, cards, line, node):
    deck = DECK.replace("*ELECTRICAL CONDUCTIVITY\n5.8e7\n", "").replace("PLUS, 9\n3, 9, 9, 0.01\n", cards)
    message = f"node {node} has no electric potential: no material of its elements has *ELECTRICAL CONDUCTIVITY"
    check_one_error(litz, tmp_path, deck, message, line_of(line, deck), line.split(",")[0])


def test_a_deck_without_steps(litz, tmp_path):
    deck = DECK[: DECK.index("*STEP")].replace("*AMPLITUDE, NAME=UP\n0., 0., 1., 1.\n", "")
    check_one_error(litz, tmp_path, deck, "the deck ends without any *STEP", len(deck.splitlines()), "")


def test_a_step_that_begins_in_a_step(litz, tmp_path):
    deck = DECK.replace("*END STEP\n", "") + "*STEP\n*STATIC\n*END STEP\n"
    line = len(deck.splitlines()) - 2
    check_one_error(litz, tmp_path, deck, "*END STEP is missing", line, "STEP")


def test_data_before_the_first_keyword(litz, tmp_path):
    check_one_error(litz, tmp_path, "1, 2, 3\n4, 5\n" + DECK, "data before the first keyword", 1, "1, 2, 3")


def test_a_keyword_between_two_steps(litz, tmp_path):
    deck = DECK + "*BOUNDARY\n2, 1\n*STEP\n*STATIC\n*END STEP\n"
    line = line_of("*END STEP", deck) + 1
    check_one_error(litz, tmp_path, deck, "*BOUNDARY is between two steps", line, "BOUNDARY")


def test_two_steps_of_one_name(litz, tmp_path):
    deck = DECK.replace("INC=50", "INC=50, NAME=PRESS") + "*STEP, NAME=Press\n*STATIC\n*END STEP\n"
    check_one_error(litz, tmp_path, deck, "two steps with the name", line_of("NAME=Press", deck), "Press")


def test_a_place_that_litz_does_not_use_in_controls(litz, tmp_path):
    deck = DECK.replace("*CLOAD", "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n4, 8\n*CLOAD")
    (tmp_path / "bad.inp").write_text(deck)
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    assert [error["message"] for error in errors_in(result)] == [
        'value 1, I_0 (not used by litz, leave empty), is "4"; it must be left empty, litz does not use it',
        'value 2, I_R (not used by litz, leave empty), is "8"; it must be left empty, litz does not use it',
    ]


def test_all_errors_come_in_one_pass_and_in_the_order_of_the_deck(litz, tmp_path):
    deck = DECK.replace("0.35", "0.6").replace("1, 1, 2", "1, 1, 8").replace("*HEADING", "*HEADNG")
    deck = deck.replace("PLUS, 9", "NONE, 9").replace("RF, RCURR", "RF, EPTO")
    (tmp_path / "bad.inp").write_text(deck)
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    assert [int(error["line"]) for error in errors_in(result)] == [
        line_of(text, deck) for text in ("*HEADNG", "1, 1, 8", "0.6", "NONE, 9", "RF, EPTO")
    ]


def test_many_errors_are_cut_short_with_their_number(litz, tmp_path):
    deck = DECK.replace("*MATERIAL", "*NODE\n" + "x, 0., 0., 0.\n" * 10000 + "*MATERIAL")
    (tmp_path / "bad.inp").write_text(deck)
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    assert len(errors_in(result)) == 50
    assert result.stderr.endswith("and 9950 more errors\n")


def test_run_refuses_what_check_refuses_and_writes_nothing(litz, tmp_path):
    (tmp_path / "bad.inp").write_text(DECK.replace("0.35", "0.6"))
    result = litz("run", "bad.inp", "-o", "out", cwd=tmp_path)
    assert result.returncode == 1
    assert "must be between -1 and 0.5" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["bad.inp"]


# files


def test_a_deck_that_does_not_exist(litz, tmp_path):
    result = litz("check", "none.inp", cwd=tmp_path)
    assert result.returncode == 4
    assert result.stderr == 'error: the deck file "none.inp" does not exist\n'


def test_a_deck_without_its_ending_is_found(litz, tmp_path):
    (tmp_path / "wires.inp").write_text(DECK)
    result = litz("check", "wires", cwd=tmp_path)
    assert result.returncode == 4
    assert result.stderr == 'error: the deck file "wires" does not exist; did you mean "wires.inp"?\n'


def test_a_deck_that_is_a_directory(litz, tmp_path):
    result = litz("check", ".", cwd=tmp_path)
    assert result.returncode == 4
    assert 'error: the deck file "." cannot be read' in result.stderr


@pytest.mark.parametrize("text", ["", "\n\n", "** only a comment\n"])
def test_an_empty_deck(litz, tmp_path, text):
    (tmp_path / "empty.inp").write_text(text)
    result = litz("check", "empty.inp", cwd=tmp_path)
    assert result.returncode == 1
    assert result.stderr.startswith("error: the deck is empty\n")


def test_a_missing_included_file(litz, tmp_path):
    deck = DECK.replace("*MATERIAL", "*INCLUDE, INPUT=none.inp\n*MATERIAL")
    message = 'the included file "none.inp" does not exist'
    check_one_error(litz, tmp_path, deck, message, line_of("*INCLUDE", deck), "none.inp")


def test_an_include_without_a_file(litz, tmp_path):
    deck = DECK.replace("*MATERIAL", "*INCLUDE\n*MATERIAL")
    check_one_error(litz, tmp_path, deck, "*INCLUDE needs INPUT=file", line_of("*INCLUDE", deck), "INCLUDE")


@pytest.mark.parametrize("keyword", ["*NODE, NSET=ALL", "*ELEMENT, TYPE=B31, ELSET=LOWER"])
def test_nodes_and_elements_of_another_file_are_not_missing_as_well(litz, tmp_path, keyword):
    """Data lines of Abaqus in a file of their own: one error tells what to write, and none of all that follows."""
    first = DECK.index(f"{keyword}\n") + len(keyword)
    deck = DECK[:first] + ", INPUT=mesh.inp" + DECK[DECK.index("\n*", first) :]
    line = line_of("INPUT=mesh.inp", deck)
    check_one_error(litz, tmp_path, deck, "write *INCLUDE, INPUT=... in place of its data lines", line, "INPUT")


def test_loads_on_lengths_can_be_printed_where_there_are_any(litz, tmp_path):
    """An empty card only takes loads away."""
    request = "*EL PRINT, ELSET=LOWER\nDLOAD\n"
    deck = DECK.replace("*END STEP", f"*DLOAD, OP=NEW\n{request}*END STEP")
    message = "DLOAD cannot be printed: no *DLOAD or *LORENTZ gives a force on the length of wires"
    check_one_error(litz, tmp_path, deck, message, line_of("*EL PRINT", deck) + 1, "DLOAD")
    (tmp_path / "good.inp").write_text(DECK.replace("*END STEP", f"{request}*DLOAD\nLOWER, PZ, 1e-3\n*END STEP"))
    assert litz("check", "good.inp", cwd=tmp_path).returncode == 0


def test_an_error_in_an_included_file_shows_the_chain(litz, tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "outer.inp").write_text("** a comment\n*INCLUDE, INPUT=inner.inp\n")
    (tmp_path / "parts" / "inner.inp").write_text("*MATERIAL, NAME=CU\n*ELASTIC\n1.2e11, 0.7\n")
    deck = DECK.replace("*MATERIAL, NAME=CU\n*ELASTIC\n1.2e11, 0.35\n", '*INCLUDE, INPUT="parts/outer.inp"\n')
    (tmp_path / "bad.inp").write_text(deck)
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    (error,) = errors_in(result)
    assert (error["file"], error["line"], error["column"]) == ("parts/inner.inp", "3", "9")
    assert [line.strip() for line in error["origin"].splitlines()] == [
        "included from parts/outer.inp:2",
        f"included from bad.inp:{line_of('*INCLUDE', deck)}",
    ]


def test_a_circle_of_included_files(litz, tmp_path):
    (tmp_path / "bad.inp").write_text("*INCLUDE, INPUT=other.inp\n" + DECK)
    (tmp_path / "other.inp").write_text("*INCLUDE, INPUT=./bad.inp\n")
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    (error,) = errors_in(result)
    assert error["message"] == 'the file "./bad.inp" includes itself, directly or through others'
    assert (error["file"], error["line"]) == ("other.inp", "1")


# lines of any shape


def test_the_caret_counts_characters_and_tabs(litz, tmp_path):
    deck = DECK.replace("0.35", "0.6").replace("1.2e11,", "\t1.2e11,\t")
    (tmp_path / "bad.inp").write_text(deck)
    (error,) = errors_in(litz("check", "bad.inp", cwd=tmp_path))
    assert (error["column"], error["card"], error["caret"]) == ("11", " 1.2e11,  0.6", 10 * " " + "^^^")

    deck = DECK.replace("NAME=SPOT", "NAME=Berührung").replace("INTERACTION=SPOT", "INTERACTION=Berührung, WORD=ü")
    (tmp_path / "bad.inp").write_text(deck)
    (error,) = errors_in(litz("check", "bad.inp", cwd=tmp_path))
    assert error["card"][error["caret"].index("^") : len(error["caret"])] == "WORD"


def test_of_a_very_long_line_the_part_around_the_mistake_is_shown(litz, tmp_path):
    members = "1, " * 5000 + "77, " + "2, " * 5000
    deck = DECK.replace("PLUS\n1, 2\n", f"PLUS\n{members}\n")
    (tmp_path / "bad.inp").write_text(deck)
    (error,) = errors_in(litz("check", "bad.inp", cwd=tmp_path))
    assert error["message"] == "there is no node 77"
    assert error["column"] == "15001"
    assert len(error["card"]) < 130
    assert error["card"][error["caret"].index("^") : len(error["caret"])] == "77"


# beams that nothing holds, conductors without potential


def check_held(litz, directory, deck):
    """The one error or warning about a part of the model: exit code, message, line."""
    (directory / "loose.inp").write_text(deck)
    result = litz("check", "loose.inp", cwd=directory)
    found = re.findall(r"^(error|warning): (.*)\n +--> loose.inp:(\d+):", result.stderr, re.MULTILINE)
    assert len(found) == 1, result.stderr
    return result.returncode, *found[0]


NO_CONTACT = DECK.replace("*CONTACT PAIR, INTERACTION=SPOT\nLOWER, UPPER\n", "").replace(
    DECK[DECK.index("*SURFACE INTERACTION") : DECK.index("*CONTACT PAIR")], ""
)


def test_a_beam_that_nothing_holds(litz, tmp_path):
    deck = NO_CONTACT.replace("3, 1, 6\n4, 1, 6\n", "")
    code, kind, message, line = check_held(litz, tmp_path, deck)
    assert (code, kind, int(line)) == (1, "error", line_of("2, 3, 4", deck))
    assert message.startswith("nothing holds UPPER (element 2): no displacement or rotation")


def test_a_beam_that_only_contacts_can_hold(litz, tmp_path):
    deck = DECK.replace("3, 1, 6\n4, 1, 6\n", "")
    code, kind, message, line = check_held(litz, tmp_path, deck)
    assert (code, kind, int(line)) == (0, "warning", line_of("2, 3, 4", deck))
    assert message.endswith("only contacts can hold it, or *CONTROLS, PARAMETERS=STABILIZE damp it")


@pytest.mark.parametrize(
    ("supports", "free"),
    [
        ("3, PINNED\n4, 2, 3", "rotation about x through (0, 0, 0.001)"),
        ("3, 2, 6\n4, 2, 6", "translation along x"),
        (
            "3, PINNED",
            (
                "rotation about x through (0, 0, 0.001), rotation about y through (-0.01, 0, 0.001), "
                "rotation about z through (-0.01, 0, 0.001)"
            ),
        ),
        (
            "3, 1, 2\n4, 1, 2",
            "rotation about x through (0, 0, 0.001), rotation about y through (0, 0, 0.001), translation along z",
        ),
        (
            "3, 3\n4, 3\n3, 4",
            "rotation about z through (0, 0, 0.001), translation along x, translation along y",
        ),
    ],
)
def test_the_free_motion_of_a_beam_is_told_in_words(litz, tmp_path, supports, free):
    deck = NO_CONTACT.replace("3, 1, 6\n4, 1, 6", supports)
    code, kind, message, _ = check_held(litz, tmp_path, deck)
    assert (code, kind) == (1, "error")
    assert message == f"UPPER (element 2) can still move: {free}; *BOUNDARY must prevent that"


def test_a_conductor_without_potential(litz, tmp_path):
    deck = NO_CONTACT.replace("3, 9, 9, 0.01\n", "")
    code, kind, message, line = check_held(litz, tmp_path, deck)
    assert (code, kind, int(line)) == (1, "error", line_of("2, 3, 4", deck))
    assert message.startswith("the conductor UPPER (element 2) has no path to a prescribed potential")


def test_conductors_that_contacts_can_join_are_one_error_if_none_has_a_potential(litz, tmp_path):
    deck = DECK.replace("PLUS, 9\n3, 9, 9, 0.01\n", "")
    code, kind, message, line = check_held(litz, tmp_path, deck)
    assert (code, kind, int(line)) == (1, "error", line_of("1, 1, 2", deck))
    assert message.startswith(
        "the conductor LOWER (element 1) has no path to a prescribed potential; likewise 1 more: "
    )
    assert message.endswith("or leave out *ELECTRICAL CONDUCTIVITY where no current is to flow")


def test_a_conductor_that_only_contacts_connect(litz, tmp_path):
    deck = DECK.replace("3, 9, 9, 0.01\n", "")
    (tmp_path / "deck.inp").write_text(deck)
    checked = litz("check", tmp_path / "deck.inp")
    assert checked.returncode == 0
    assert (
        "the conductor UPPER (element 2) has no prescribed potential; only contacts can connect it to one"
        in checked.stdout
    )
    assert "warning" not in checked.stderr


def test_contacts_without_a_spot_law_connect_nothing(litz, tmp_path):
    deck = DECK.replace("3, 9, 9, 0.01\n", "").replace("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n", "")
    code, kind, message, _ = check_held(litz, tmp_path, deck)
    assert (code, kind) == (1, "error")
    assert "has no path to a prescribed potential" in message


def test_supports_that_a_later_step_takes_away(litz, tmp_path):
    step = "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n1, 1, 6\n3, 1, 5\n1, 9\n3, 9\n*END STEP\n"
    code, kind, message, _ = check_held(litz, tmp_path, NO_CONTACT + step)
    assert (code, kind) == (1, "error")
    assert message == (
        "UPPER (element 2) can still move in step 2: rotation about z through (-0.01, 0, 0.001); "
        "*BOUNDARY must prevent that"
    )


# every keyword and parameter of the table


def keyword_table(litz):
    """Keywords of the reference: name, place, the keyword they follow, and parameters with their forms."""
    keywords = litz("keywords", "--markdown").stdout.split("\n## Keywords of ")[0]
    for section in keywords.split("\n## \\*")[1:]:
        name, place, after = re.match(r"(.*)\n\n\*(.*?)(?:, after \*(.*))?\.\*", section).groups()
        parameters = re.findall(r"^\| `([^`]*?)(?:=([^`]*))?` \| .* \|$", section.split("Data line")[0], re.MULTILINE)
        yield name, place, after, [(parameter, form.replace("\\|", "|")) for parameter, form in parameters]


MAY_BE_NEGATIVE = {"ABSOLUTE ZERO", "ZERO", "TSOFT", "TMELT", "STRAIN", "OFFSET1", "OFFSET2"}


def wrong_parameters(parameters):
    """Misused parameters with the message that each must get."""
    yield "QZX=1", 'unknown parameter "QZX" of'
    for parameter, form in parameters:
        if form == "":
            yield f"{parameter}=1", f"the parameter {parameter} takes no value"
        else:
            yield f"{parameter}=", f"the parameter {parameter} needs a value"
        if form == "number":
            yield f"{parameter}=@", f"the parameter {parameter} must be a"
            if parameter not in MAY_BE_NEGATIVE:
                yield f"{parameter}=-1", f"the parameter {parameter} is"
        elif "|" in form:
            yield f"{parameter}=@", f"the parameter {parameter} must be"


def test_every_parameter_of_the_table_is_checked(litz, tmp_path):
    n_keywords, n_mistakes = 0, 0
    for name, place, after, parameters in keyword_table(litz):
        n_keywords += 1
        if name == "INCLUDE":
            continue
        before = "*STEP" if place == "in a step" else f"*{after}" if after else ""
        for mistakes in in_parts(wrong_parameters(parameters)):
            lines = [line for parameter, _ in mistakes for line in (before, f"*{name}, {parameter}") if line]
            (tmp_path / "bad.inp").write_text("\n".join(lines) + "\n")
            result = litz("check", "bad.inp", cwd=tmp_path)
            assert result.returncode == 1
            errors = errors_in(result)
            for parameter, message in mistakes:
                line = lines.index(f"*{name}, {parameter}") + 1
                told = [error for error in errors if message in error["message"] and int(error["line"]) == line]
                assert len(told) == 1, f"{parameter}\n{result.stderr}"
                first, end = told[0]["caret"].index("^"), len(told[0]["caret"])
                assert told[0]["card"][first:end] in parameter
                n_mistakes += 1
    # the pattern that reads the reference has found it all
    assert n_keywords >= 30
    assert n_mistakes >= 90
