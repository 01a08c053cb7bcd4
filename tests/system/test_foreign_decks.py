"""Decks as users of Abaqus and CalculiX write them: what runs as it stands, what is ignored in words, what is refused."""

import re

import numpy as np
import pytest

from litz import Results

#: A cantilever as Abaqus/CAE writes a flat model: length 30, radius 2, E = 210000, a force of 1 at its end
CAE = """\
*Heading
** Job name: Job-1 Model name: Model-1
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Node
      1,           0.,           0.,           0.
      2,          10.,           0.,           0.
      3,          20.,           0.,           0.
      4,          30.,           0.,           0.
*Element, type=B33
1, 1, 2
2, 2, 3
3, 3, 4
*Nset, nset=_PickedSet4, internal, generate
 1,  4,  1
*Elset, elset=_PickedSet4, internal, generate
 1,  3,  1
*Nset, nset=Set-1
 1,
*Nset, nset=Set-2
 4,
** Section: Section-1  Profile: Profile-1
*Beam Section, elset=_PickedSet4, material=Steel, temperature=GRADIENTS, section=CIRC
2.
0.,0.,-1.
*Amplitude, name=Amp-1
0., 0., 1., 1.
*Material, name=Steel
*Density
7.8e-09,
*Elastic
210000., 0.3
*Step, name=Step-1, nlgeom=NO
*Static
1., 1., 1e-05, 1.
*Boundary
Set-1, ENCASTRE
*Cload, amplitude=Amp-1
Set-2, 3, 1.
*Restart, write, frequency=0
*Output, field, variable=PRESELECT
*Output, history
*Node Output, nset=Set-2
CF1, RF1, U1
*Output, history, variable=PRESELECT
*End Step
"""


def warnings_in(text):
    return re.findall("^warning: (.*)$", text, re.MULTILINE)


def errors_in(text):
    return re.findall("^error: (.*)$", text, re.MULTILINE)


@pytest.fixture
def check(litz, tmp_path):
    def of(text):
        (tmp_path / "deck.inp").write_text(text)
        return litz("check", "deck.inp", cwd=tmp_path)

    return of


@pytest.fixture
def run(litz, tmp_path):
    def of(text, name="deck"):
        (tmp_path / f"{name}.inp").write_text(text)
        done = litz("run", f"{name}.inp", "-o", f"{name}_results", cwd=tmp_path)
        return done, Results(tmp_path / f"{name}_results") if done.returncode == 0 else None

    return of


def test_a_deck_of_cae_runs_and_what_changes_no_result_is_told_once_for_each_card(run, tmp_path):
    done, results = run(CAE)
    assert done.returncode == 0, done.stderr
    sag = 1 * 30**3 / (3 * 210000 * np.pi / 4 * 2**4)
    # the deflection is 1e-4 of the length, whose square is what large displacements change
    assert results.field("displacement")[3, 2] == pytest.approx(sag, rel=1e-7)
    told = warnings_in(done.stderr)
    words = ["*PREPRINT", '"temperature"', "NLGEOM=NO", "*OUTPUT", "*OUTPUT", "*NODE OUTPUT", "*OUTPUT"]
    assert len(told) == len(words)
    for warning, word in zip(told, words, strict=True):
        assert word in warning
    # they are kept, each message once
    kept = [entry.message for entry in results.warnings if entry.kind == "ignored"]
    assert len(kept) == 4
    assert [entry.kind for entry in results.warnings].count("large_displacements") == 1
    assert not list(tmp_path.glob("deck_results/*.restart.h5"))


#: Cards of CalculiX and Abaqus about output alone, and the word that the warning must have
OUTPUT = {
    "*NODE FILE, OUTPUT=2D, NSET=ALL\n U, NT": '"OUTPUT"',
    "*NODE FILE\n U, RF, TSF": '"TSF"',
    "*EL FILE, SECTION FORCES\n S, NOE": '"SECTION FORCES"',
    "*EL FILE\n S, E, PEEQ, SF": '"S"',
    "*CONTACT FILE, LAST ITERATIONS\n CDIS, CSTR": '"LAST ITERATIONS"',
    "*CONTACT OUTPUT\n CSTRESS": "*CONTACT OUTPUT",
    "*NODE PRINT, NSET=Set-2, FREQUENCY=100\n U": '"FREQUENCY"',
    "*NODE PRINT\n U": "no NSET",
    "*EL PRINT, ELSET=_PickedSet4\n S, ENER": '"S"',
    "*EL PRINT, FREQUENCY=10\n SF": '"FREQUENCY"',
    "*SECTION PRINT, SURFACE=CUT, NAME=SP1\n SOF": "*SECTION PRINT",
    "*FILE FORMAT, ASCII": "*FILE FORMAT",
    "*PREPRINT, ECHO=YES": "*PREPRINT",
    "*ENERGY FILE": "*ENERGY FILE",
    "*TIME POINTS, NAME=T1\n 0.1, 0.2": "*TIME POINTS",
    "*MONITOR, NODE=4, DOF=3": "*MONITOR",
    "*RESTART, WRITE, OVERLAY": '"OVERLAY"',
}


@pytest.mark.parametrize("card", OUTPUT)
def test_output_that_litz_does_not_have_is_one_warning(check, card):
    plain = check(CAE)
    with_card = check(CAE.replace("*Restart, write, frequency=0", card))
    assert with_card.returncode == 0, with_card.stderr
    new = [one for one in warnings_in(with_card.stderr) if one not in warnings_in(plain.stderr)]
    new += ["ignored"] * (len(warnings_in(with_card.stderr)) - len(warnings_in(plain.stderr)) - len(new))
    assert len(new) == 1
    assert "ignored" in new[0]
    if new[0] != "ignored":
        assert OUTPUT[card] in new[0]


def test_the_quantities_that_litz_has_are_written_beside_those_that_it_lacks(run):
    done, results = run(CAE.replace("*Output, history\n", "*NODE PRINT, NSET=Set-2, FREQUENCY=5\n COORD, U, V\n"))
    assert done.returncode == 0, done.stderr
    assert [name for name in results.history if name.startswith("U")]
    assert not [name for name in results.history if name.startswith(("COORD", "V"))]


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("*NODE PRINT, NSET=Set-3\n U", 'there is no node set "Set-3"'),
        ("*NODE PRINT, NSET=Set-2\n RCUR", 'found "RCUR"; did you mean RCURR?'),
        ("*RESTART, READ", "--restart FILE.restart.h5"),
        ("*NODE PRIMT, NSET=Set-2\n U", "did you mean *NODE PRINT?"),
    ],
)
def test_what_is_wrong_about_output_is_an_error_still(check, card, message):
    told = check(CAE.replace("*Restart, write, frequency=0", card))
    assert told.returncode == 1
    assert len(errors_in(told.stderr)) == 1
    assert message in told.stderr


@pytest.mark.parametrize(
    ("step", "n_lines", "n_warnings"),
    [("*Step", 1, 0), ("*Step, nlgeom=NO", 0, 1), ("*Step, nlgeom=YES", 0, 0), ("*Step, nlgeom", 0, 0)],
)
def test_a_step_without_nlgeom_says_in_one_line_that_displacements_are_large(run, step, n_lines, n_warnings):
    done, results = run(CAE.replace("*Step, name=Step-1, nlgeom=NO", step))
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("displacements are large in every step, with or without NLGEOM\n") == n_lines
    assert [one.kind for one in results.warnings].count("large_displacements") == n_warnings


def test_nlgeom_holds_for_the_steps_that_follow(check):
    more = "*Step\n*Static\n*End Step\n"
    assert "displacements are large" not in check(CAE.replace("nlgeom=NO", "nlgeom=YES") + more).stdout


@pytest.mark.parametrize(
    ("name", "degrees_of_freedom"),
    [
        ("XSYMM", [1, 5, 6]),
        ("YSYMM", [2, 4, 6]),
        ("ZSYMM", [3, 4, 5]),
        ("XASYMM", [2, 3, 4]),
        ("YASYMM", [1, 3, 5]),
        ("zasymm", [1, 2, 6]),
    ],
)
def test_supports_of_symmetry(check, name, degrees_of_freedom):
    told = check(CAE.replace("*Cload", f"*Boundary\nSet-2, {name}\n*Cload"))
    assert told.returncode == 0, told.stderr
    held = [int(dof) for dof in re.findall(r"prescribed at degree of freedom (\d): 2 nodes", told.stdout)]
    assert held == degrees_of_freedom
    more = check(CAE.replace("*Cload", f"*Boundary\nSet-2, {name}, 1\n*Cload"))
    assert f"nothing follows {name}, which prescribes zero values" in more.stderr


def test_the_name_of_a_set_may_be_a_number(check):
    """A number is a node where there is one, as in CalculiX, and otherwise the set."""
    sets = "*Nset, nset=4711\n 4,\n*Nset, nset=1\n 1, 4\n*Amplitude, name=Amp-1"
    deck = CAE.replace("*Amplitude, name=Amp-1", sets)
    told = check(deck.replace("Set-2, 3, 1.", "4711, 3, 1.").replace("Set-1, ENCASTRE", "1, ENCASTRE"))
    assert told.returncode == 0, told.stderr
    assert "node set 4711: 1 member" in told.stdout
    assert "loads at degree of freedom 3: 1 node, 1\n" in told.stdout
    assert "prescribed at degree of freedom 3: 1 node, 0\n" in told.stdout
    assert [one for one in warnings_in(told.stderr) if "name of a node set" in one] == [
        "1 is a node and the name of a node set; it is taken as the node"
    ]
    wrong = check(deck.replace("Set-2, 3, 1.", "4712, 3, 1."))
    assert errors_in(wrong.stderr) == ["there is no node 4712"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        # a node that cannot be read is missing in an element, a set and a load
        ("      4,          30.,           0.,           0.", "   four, 30., 0., 0.", "must be a whole number"),
        ("      2,          10.,           0.,           0.", "   2, ten, 0., 0.", "must be a number"),
        # a set is missing wherever it is named
        ("*Nset, nset=Set-2\n 4,\n", "", 'there is no node set "Set-2"'),
        # what defines or uses something is reported itself
        ("*Amplitude, name", "*Amplitudes, name", "did you mean *AMPLITUDE?"),
        (
            "*Material, name",
            "*Solid Section, material=Al\n*Material, name=Al\n*Elastic\n 7e4, 0.3\n*Material, name",
            "SOLID",
        ),
        # elements of another kind have other nodes, and are missing in sets, sections and supports
        ("*Element, type=B33\n1, 1, 2", "*Element, type=C3D8\n1, 1, 2, 3, 4, 1, 2, 3, 4", 'found "C3D8"'),
        ("*Static\n1., 1., 1e-05, 1.", "*Frequency\n 10", "there are no eigenvalues"),
        ("*Static\n1., 1., 1e-05, 1.", "*Heat Transfer", "use *COUPLED THERMAL-ELECTRICAL"),
    ],
)
def test_no_error_follows_from_another(check, old, new, message):
    assert CAE.count(old) == 1
    told = check(CAE.replace(old, new).replace("*Output, history\n", "*Cload\nSet-2, 2, 0.1\n*Output, history\n"))
    assert told.returncode == 1
    # the loads of both cards have different amplitudes: the second one is in another direction
    assert len(errors_in(told.stderr)) == 1, told.stderr
    assert message in told.stderr


def test_parts_are_one_error(check):
    """Two parts with the same numbers, instances, and sets of them."""
    part = CAE[CAE.index("*Node") : CAE.index("*Nset, nset=Set-1")]
    parts = f"*Part, name=A\n{part}*End Part\n*Part, name=B\n{part}*End Part\n*Assembly, name=Assembly\n"
    parts += "".join(f"*Instance, name={one}-1, part={one}\n*End Instance\n" for one in "AB")
    told = check(CAE.replace(part, parts).replace("nset=Set-1", "nset=Set-1, instance=A-1"))
    assert told.returncode == 1
    (told_once,) = errors_in(told.stderr)
    assert (
        "litz has no *PART: the program reads flat decks: `litz run` and `litz check` of the Python package place"
        in told_once
    )


@pytest.mark.parametrize(("foreign", "own"), [("B31R", "B31"), ("B31H", "B31"), ("B33H", "B33")])
def test_types_of_abaqus_that_litz_has_under_another_name(run, foreign, own):
    results = [run(CAE.replace("type=B33", f"type={name}"), name)[1] for name in (foreign, own)]
    np.testing.assert_array_equal(results[0].field("displacement"), results[1].field("displacement"))


#: Two beams with nodes in the middle, and one without, in elements and sets of all kinds
QUADRATIC = """\
*NODE, NSET=ALL
 1, 0., 0., 0.
 2, 10., 0., 0.
 3, 20., 0., 0.
 4, 30., 0., 0.
 5, 40., 0., 0.
 6, 50., 0., 0.
*ELEMENT, TYPE=B32, ELSET=FIRST
 7, 1, 2, 3
*ELEMENT, TYPE=B32R
 3, 3, 4, 5
*ELEMENT, TYPE=B31, ELSET=LAST
 9, 5, 6
*ELSET, ELSET=SECOND
 3
*ELSET, ELSET=WHOLE, GENERATE
 3, 9
*ELSET, ELSET=OF SETS
 FIRST, SECOND
*MATERIAL, NAME=STEEL
*ELASTIC
 210000., 0.3
*BEAM SECTION, ELSET=WHOLE, MATERIAL=STEEL, SECTION=CIRC
 1.
*BOUNDARY
 1, ENCASTRE
*STEP, NLGEOM
*STATIC
*DLOAD
 3, PZ, 1e-3
*END STEP
"""

#: The same, written with two elements for each
SPLIT = (
    QUADRATIC.replace("TYPE=B32, ELSET=FIRST\n 7, 1, 2, 3", "TYPE=B31, ELSET=FIRST\n 7, 1, 2\n 10, 2, 3")
    .replace("TYPE=B32R\n 3, 3, 4, 5", "TYPE=B31\n 3, 3, 4\n 11, 4, 5")
    .replace("ELSET=SECOND\n 3", "ELSET=SECOND\n 3, 11")
    .replace(" 3, 9\n", " 3, 11\n")
    .replace(" 3, PZ, 1e-3", " 3, PZ, 1e-3\n 11, PZ, 1e-3")
)


def test_a_node_in_the_middle_joins_two_elements(check):
    quadratic, split = check(QUADRATIC), check(SPLIT)
    assert quadratic.returncode == 0, quadratic.stderr
    assert quadratic.stdout == split.stdout
    for line in ("FIRST: 2", "SECOND: 2", "WHOLE: 5", "OF SETS: 4", "LAST: 1"):
        assert f"element set {line} member" in quadratic.stdout
    told = warnings_in(quadratic.stderr)
    assert [one[:32] for one in told] == ["each B32 is taken as two B31, wh", "each B32R is taken as two B31, w"]


def test_a_range_has_no_second_half_of_an_element_outside_of_it(check):
    for last in (99, 2147483647):
        told = check(
            QUADRATIC.replace(
                "*ELSET, ELSET=OF SETS", f"*ELSET, ELSET=END, GENERATE\n 8, {last}\n*ELSET, ELSET=OF SETS"
            )
        )
        assert told.returncode == 0, told.stderr
        assert "element set END: 1 member\n" in told.stdout


def test_a_run_with_nodes_in_the_middle_is_that_of_twice_as_many_elements(run):
    (done, quadratic), (_, split) = run(QUADRATIC, "quadratic"), run(SPLIT, "split")
    assert done.returncode == 0, done.stderr
    np.testing.assert_array_equal(quadratic.field("displacement"), split.field("displacement"))
    np.testing.assert_array_equal(np.sort(quadratic.field("element_id")), [3, 7, 9, 10, 11])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (" 7, 1, 2, 3\n", " 7, 1, 2\n", "value 4, n3 (last node), is missing"),
        (" 7, 1, 2, 3\n", " 7, 1, 2, 8\n", "element 7 has node 8, which is not defined"),
        (" 7, 1, 2, 3\n", " 7, 1, 2, 2\n", "element 7 has no length: its nodes 2 and 2"),
        (" 7, 1, 2, 3\n", " 7, 1, 2, 3, 6\n", "a node that gives the first axis of the section is not read"),
        (" 9, 5, 6\n", " 9, 5, 6, 1\n", "a node that gives the first axis of the section is not read"),
        (" 9, 5, 6\n", " 2147483647, 5, 6\n", "there are no numbers left"),
        ("TYPE=B31, ELSET=LAST", "TYPE=B31OS, ELSET=LAST", "warping of open sections is free"),
        ("TYPE=B31, ELSET=LAST", "TYPE=U1, ELSET=LAST", "a shear factor in CalculiX"),
    ],
)
def test_elements_of_three_nodes_that_are_wrong(check, old, new, message):
    assert QUADRATIC.count(old) == 1
    told = check(QUADRATIC.replace(old, new).replace(" 3, 9\n", " 3, 2147483647\n"))
    assert told.returncode == 1
    assert len(errors_in(told.stderr)) == 1, told.stderr
    assert message in told.stderr
