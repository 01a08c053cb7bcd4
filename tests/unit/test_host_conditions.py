"""What a deck holds, prescribes and loads is what another program is given, and so are the properties of its contacts."""

import re
import warnings

import pytest

import litz
from in_process import command
from litz.errors import FileError
from litz.hosts import abaqus_input, ccx_input, feap_input, read_host_model

#: Two wires of two materials, one across the other
DECK = """\
*NODE, NSET=ALL
 1, -10, 0, 0
 2, -3, 0, 0
 3, 4, 0, 0
 4, 10, 0, 0
 11, 0.5, -10, 1.001
 12, 0.5, -3, 1.001
 13, 0.5, 4, 1.001
 14, 0.5, 10, 1.001
*ELEMENT, TYPE=B31, ELSET=LOWER
 1, 1, 2
 2, 2, 3
 3, 3, 4
*ELEMENT, TYPE=B31, ELSET=UPPER
 11, 11, 12
 12, 12, 13
 13, 13, 14
*NSET, NSET=ENDS
 11, 14
*MATERIAL, NAME=COPPER
*ELASTIC
 120000, 0.34
*ELECTRICAL CONDUCTIVITY
 5.88e4
*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=CIRC
 0.5
*BEAM SECTION, ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC
 0.5
*SURFACE INTERACTION, NAME=TOUCH
*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 1, ENCASTRE
 4, ENCASTRE
 ENDS, 1, 2
 ENDS, 4, 6
 1, 9
*STEP
*STATIC
 0.1, 1.
*BOUNDARY
 ENDS, 3, 3, -0.01
*END STEP
"""


@pytest.fixture
def model(tmp_path):
    def of(*changes):
        text = DECK
        for old, new in changes:
            assert old in text
            text = text.replace(old, new, 1)
        (tmp_path / "deck.inp").write_text(text)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message="each B32 is taken as two B31")
            return read_host_model(tmp_path / "deck.inp")

    return of


def held(model, row):
    return {dof for one, dof in model.supports if one == row}


@pytest.mark.parametrize(
    ("name", "dofs"),
    [
        ("PINNED", {1, 2, 3}),
        ("XSYMM", {1, 5, 6}),
        ("YSYMM", {2, 4, 6}),
        ("ZSYMM", {3, 4, 5}),
        ("XASYMM", {2, 3, 4}),
        ("YASYMM", {1, 3, 5}),
        ("ZASYMM", {1, 2, 6}),
    ],
)
def test_supports_have_names_and_symmetries(model, name, dofs):
    assert held(model(("4, ENCASTRE", f"4, {name}")), 3) == dofs


def test_loads_of_one_place_add_up_and_currents_are_among_them(model):
    """As in litz; the current is positive into the wire, as *CFLUX of Abaqus and the force of FEAP."""
    loads = "*CLOAD\n 2, 3, -1.\n ALL, 3, -0.5\n*CECURRENT\n ENDS, 9, 2.\n 14, , 1.\n*END STEP"
    given = model(("*END STEP", loads))
    assert given.loads == {(1, 3): -1.5, **{(row, 3): -0.5 for row in (0, 2, 3, 4, 5, 6, 7)}, (4, 9): 2.0, (7, 9): 3.0}
    assert "*CFLUX\n 11, 11, 2\n 14, 11, 3\n" in abaqus_input(given)
    assert re.search(r"\nFORCe\n.*\n  8, 0, 0, 0, -5\.0+e-01, 0, 0, 0, 3\.0+e\+00\n", feap_input(given), re.DOTALL)


@pytest.mark.parametrize(("time", "factor"), [("0.1, 1.", 3.0), ("0.1", 3.0), ("0.1, 0.5", 1.5), ("0.1, 9.", 3.0)])
def test_loads_are_those_at_the_end_of_the_step(model, time, factor):
    """An amplitude is linear between its points, constant beyond them, and holds for what is prescribed, too."""
    amplitude = "*AMPLITUDE, NAME=Up\n 0., 0., 1., 3.\n*STEP"
    new = "*BOUNDARY, AMPLITUDE=UP\n ENDS, 3, 3, -0.01\n*CLOAD, AMPLITUDE=Up\n 2, 2, 4.\n*CLOAD\n 2, 3, 1.\n*END STEP"
    found = model(("*STEP", amplitude), (" 0.1, 1.", f" {time}"), ("*BOUNDARY\n ENDS, 3, 3, -0.01\n*END STEP", new))
    assert found.loads == {(1, 2): pytest.approx(4 * factor), (1, 3): 1.0}
    assert found.prescribed[4, 3] == pytest.approx(-0.01 * factor)


def test_what_an_amplitude_takes_back_is_a_support(model):
    amplitude = "*AMPLITUDE, NAME=BACK\n 0., 0., 0.5, 1., 1., 0.\n*STEP"
    found = model(("*STEP", amplitude), ("*BOUNDARY\n ENDS, 3", "*BOUNDARY, AMPLITUDE=BACK\n ENDS, 3"))
    assert {(4, 3), (7, 3)} <= found.supports
    assert not found.prescribed


def test_a_step_that_begins_anew_has_its_own_supports_alone(model):
    anew = "*BOUNDARY, OP=NEW\n 1, ENCASTRE\n 2, PINNED\n 1, 9\n ENDS, 1, 2\n ENDS, 4, 6\n ENDS, 3"
    given = model(("*BOUNDARY\n ENDS, 3", anew))
    assert [held(given, row) for row in (1, 3)] == [{1, 2, 3}, set()]
    assert given.prescribed == {(4, 3): -0.01, (7, 3): -0.01}


def test_potentials_of_insulators_are_held_as_the_element_has_them(model):
    """Nothing else determines them: the tangent would be singular."""
    given = model(
        ("*ELECTRICAL CONDUCTIVITY\n 5.88e4\n", ""), ("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n", ""), (" 1, 9\n", "")
    )
    assert {row for row, dof in given.supports if dof == 9} == {1, 2, 5, 6}
    assert "\n 2, 11, 11, 0\n" in abaqus_input(given)
    assert "potentials" not in ccx_input(given)


def test_axis_and_length_of_conduction_are_passed_on(model):
    given = model(
        ("NAME=TOUCH", "NAME=TOUCH, AXIS=LINEAR"),
        (
            "ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC",
            "ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC, CONDUCTION=CURRENT LENGTH",
        ),
    )
    text = abaqus_input(given)
    # normal law HERTZ, spot law HERTZ, linear axis, corrected voltage, spins
    assert "\n 0, 0, 2, 2, 1, 1, 0\n" in text
    assert "TYPE=U2, NODES=2, COORDINATES=3, PROPERTIES=2, I PROPERTIES=1, VARIABLES=2\n 1, 2, 3, 11\n" in text
    lengths = re.findall(r"PROPERTY, ELSET=CONDUCTORS_\d\n \S+ \S+ (\d)\n", text)
    assert lengths == ["0", "1"]
    text = feap_input(given)
    assert "\n  2, 2, 1, 1, 0\n" in text
    assert re.findall(r"USER, 2\n  \S+ \S+ (\d)\n", text) == ["0", "1"]


@pytest.mark.parametrize(
    ("old", "new", "young", "conductivity"),
    [
        # at a temperature, in either order
        ("0.34\n", "0.34, 20.\n", 120e3, 5.88e4),
        ("5.88e4\n", "5.88e4, 20.\n", 120e3, 5.88e4),
        ("*ELASTIC\n 120000, 0.34\n*ELECTRICAL CONDUCTIVITY\n 5.88e4\n",
         "*ELECTRICAL CONDUCTIVITY\n 5.88e4\n*ELASTIC\n 120000, 0.34\n", 120e3, 5.88e4),
        # the same at two
        ("0.34\n", "0.34, 20.\n 120000, 0.34, 500.\n", 120e3, 5.88e4),
    ],
)  # fmt: skip
def test_constants_of_a_material_are_those_of_its_cards(model, old, new, young, conductivity):
    for _, material in model((old, new)).sections:
        assert (material.young, material.poisson, material.conductivity) == (young, 0.34, conductivity)


def test_a_temperature_is_no_conductivity(model):
    text = "*ELECTRICAL CONDUCTIVITY\n 5.88e4\n"
    found = model(
        (text, ""), ("0.34\n", "0.34, 20.\n"), (" 1, 9\n", ""), ("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n", "")
    )
    assert all(material.conductivity is None for _, material in found.sections)


@pytest.mark.filterwarnings("ignore:.*the section of")
@pytest.mark.parametrize(
    ("old", "new"), [("0.34\n", "0.34, 20.\n 60000, 0.34, 500.\n"), ("5.88e4\n", "5.88e4, 20.\n 2e4, 500.\n")]
)
def test_materials_that_depend_on_temperature_are_refused(tmp_path, old, new):
    (tmp_path / "deck.inp").write_text(
        DECK.replace(old, new).replace("*BOUNDARY", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, 500.\n*BOUNDARY", 1)
    )
    with pytest.raises(FileError, match="an elastic material that is constant can be exported"):
        read_host_model(tmp_path / "deck.inp")


def test_a_surface_of_another_radius_is_refused(model):
    """The element has one radius for what touches and what conducts."""
    same = model(("ELSET=UPPER, MATERIAL=COPPER,", "ELSET=UPPER, MATERIAL=COPPER, CONTACT RADIUS=0.5,"))
    assert feap_input(same)
    other = model(("ELSET=UPPER, MATERIAL=COPPER,", "ELSET=UPPER, MATERIAL=COPPER, CONTACT RADIUS=0.45,"))
    for write in (abaqus_input, feap_input):
        with pytest.raises(FileError, match="CONTACT RADIUS other than the radius of the wire cannot be exported"):
            write(other)


def test_beams_of_another_stiffness_are_refused(tmp_path):
    deck = DECK.replace("ELSET=UPPER, MATERIAL=COPPER,", "ELSET=UPPER, MATERIAL=COPPER, STIFFNESS=0.5,")
    assert deck != DECK
    (tmp_path / "deck.inp").write_text(deck)
    with pytest.raises(
        FileError, match=r"factor of their stiffness \(STIFFNESS of \*BEAM SECTION\) cannot be exported"
    ):
        read_host_model(tmp_path / "deck.inp")


def test_quadratic_beams_are_two_elements_as_in_litz(model):
    given = model(
        (
            "TYPE=B31, ELSET=LOWER\n 1, 1, 2\n 2, 2, 3\n 3, 3, 4\n",
            "TYPE=B32, ELSET=LOWER\n 1, 1, 2, 3\n*ELEMENT, TYPE=B31, ELSET=LOWER\n 3, 3, 4\n",
        )
    )
    assert given.element_numbers.tolist() == [1, 14, 3, 11, 12, 13]
    assert given.connectivity[:3].tolist() == [[0, 1], [1, 2], [2, 3]]


#: The same wires as two instances of a part
PARTS = """\
*PART, NAME=WIRE
*NODE
 1, -10, 0, 0
 2, -3, 0, 0
 3, 4, 0, 0
 4, 10, 0, 0
*ELEMENT, TYPE=B31, ELSET=ALL
 1, 1, 2
 2, 2, 3
 3, 3, 4
*BEAM SECTION, ELSET=ALL, MATERIAL=COPPER, SECTION=CIRC
 0.5
*END PART
*ASSEMBLY, NAME=BOTH
*INSTANCE, NAME=LOW, PART=WIRE
*END INSTANCE
*INSTANCE, NAME=UP, PART=WIRE
 0.5, 0, 1.001
 0.5, 0, 0, 0.5, 0, 1, 90
*END INSTANCE
*NSET, NSET=ENDS, INSTANCE=UP
 1, 4
*END ASSEMBLY
"""


def test_instances_of_parts_stand_where_litz_places_them(tmp_path):
    text = (
        PARTS + DECK[DECK.index("*MATERIAL") : DECK.index("*BEAM SECTION")] + DECK[DECK.index("*SURFACE INTERACTION") :]
    )
    text = text.replace("LOWER, UPPER", "LOW.ALL, UP.ALL").replace("\n 1, 9\n", "\n LOW.1, 9\n")
    text = text.replace(" 1, ENCASTRE\n 4, ENCASTRE", " LOW.1, ENCASTRE\n LOW.4, ENCASTRE")
    (tmp_path / "parts.inp").write_text(text)
    (tmp_path / "deck.inp").write_text(DECK)
    parts, flat = read_host_model(tmp_path / "parts.inp"), read_host_model(tmp_path / "deck.inp")
    assert parts.x == pytest.approx(flat.x, abs=1e-12)
    assert parts.supports == flat.supports
    assert parts.prescribed == flat.prescribed
    assert parts.pairs.tolist() == flat.pairs.tolist()


def test_errors_of_the_deck_are_told_once(tmp_path):
    (tmp_path / "deck.inp").write_text(DECK.replace("0.34", "0.64"))
    done = command("export", "abaqus", "deck.inp", cwd=tmp_path)
    assert done.returncode == litz.InputError.exit_code
    assert done.stderr.startswith("error: value 2, nu")
