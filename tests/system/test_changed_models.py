"""A run goes on only with the model that it began with: every value of every definition is changed, and refused."""

import json
import re
import shutil
import subprocess
from itertools import pairwise
from pathlib import Path

import h5py
import pytest

from decks import straight, wire

FORTRAN = Path(__file__).parents[2] / "fortran"

#: A lower wire and upper ones above it, apart from it; each with a spot law and a normal law of its own
LAWS = {
    "PAPER": (
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR, PENETRATION=LIMITED\n 1e5, 1e9",
        "LAW=PAPER, VOLTAGE=CORRECTED, MUTUAL RESISTANCE=NO\n*GAP CONDUCTANCE, LAW=CONSTANT, PER=SPOT\n 0.1"),
    "PLASTIC": (
        "*FRICTION, ELASTIC SLIP=1e-6\n 0.3",
        "LAW=PLASTIC, SPOT=PRESENT FORCE\n 1e9\n*GAP CONDUCTANCE, LAW=METAL, LORENZ=2.4e-8, TMELT=1300"),
    "FILM": (
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n*FRICTION, STICK STIFFNESS=1e5\n 0.2",
        "LAW=FILM\n 1e-12\n*GAP CONDUCTANCE, LAW=CONDUCTIVITY, FILM=1e-7, TSOFT=400, MELTING=END\n*GAP HEAT GENERATION\n 0.9"),
    "CONSTANT": (
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ",
        "LAW=CONSTANT, PER=SPOT\n 1e-3"),
    "TABLE": (
        "*FRICTION\n 0.1",
        "LAW=TABLE\n 0.1, 2e-3\n 1.0, 1e-3\n*GAP CONDUCTANCE, LAW=TABLE\n 0.1, 0.1\n 1.0, 0.2"),
}  # fmt: skip

COPPER = "*MATERIAL, NAME=COPPER\n*ELASTIC, TYPE=ISOTROPIC\n 120e9, 0.34\n*DENSITY\n 8960\n*ELECTRICAL CONDUCTIVITY\n 5.88e7\n"
BRASS = (
    "*MATERIAL, NAME=BRASS\n*ELASTIC\n 100e9, 0.33, 20\n 90e9, 0.33, 120\n"
    "*EXPANSION, TYPE=ISO, ZERO=5\n 19e-6, 20\n 21e-6, 120\n"
    "*ELECTRICAL CONDUCTIVITY\n 1.5e7, 20\n 1e7, 120\n"
)

#: Laws of superconducting filaments, each in a wire of its own
FILAMENTS = [
    "LAW=TABLE, N=30, FRACTION=0.4, EC=1e-5, FIELD=5, STRAIN=-1e-3\n 2e9, 4.2, 5",
    "LAW=NB3SN, N=30, RATIO=1.5, FIELD=12\n 7.5e10, 32.97, 16.06, 0.63, 2.1, 44.48, 4.0, 2.56e-3, 5e-4",
    "LAW=NBTI, N=30, RATIO=1.5, FIELD=5\n 3e9, 27.04, 14.5, 9.2, 0.57, 0.9, 2.32",
]

STEP = """\
*STEP, NAME=ONE, INC=50
*STATIC
 1.0, 1.0, 1e-3, 1.0
*BOUNDARY, AMPLITUDE=WAVE
 906, 9, 9, 1e-3
*CLOAD, AMPLITUDE=WAVE
 906, 3, 1e-3
*CECURRENT, AMPLITUDE=WAVE
 905, 9, 1e-3
*DLOAD, AMPLITUDE=WAVE
 901, PX, 1e-3
*DLOAD
 902, GRAV, 0.1, 0, 1, -1
*LORENTZ, AMPLITUDE=WAVE
 901, 0.1, 0.2, 0.3, 1, 2, 3, 4, 5, 6, 7, 8, -6
*TEMPERATURE, OP=MOD, AMPLITUDE=WAVE
 906, 40
*RESTART, WRITE
*END STEP
"""
LATER = """\
*STEP
*AMPLITUDE, NAME=LATER
 0, 0, 1, 1
*STATIC
*CLOAD, AMPLITUDE=LATER
 906, 2, 1e-3
*CLOAD, AMPLITUDE=OTHER
 905, 2, 1e-3
*NODE PRINT, NSET=SPARE
 U
*END STEP
"""


def model():
    upper = "".join(
        wire(f"UP{i}", straight((0.01 * i, -0.02, 3e-3), (0.01 * i, 0.02, 3e-3), 3), 100 * i + 1) for i in range(1, 6)
    )
    contacts = "".join(
        f"*SURFACE INTERACTION, NAME={law}, AXIS=HERMITE\n{normal}\n*GAP ELECTRICAL CONDUCTANCE, {spot}\n"
        f"*CONTACT PAIR, INTERACTION={law}\n LOW, UP{i}\n"
        for i, (law, (normal, spot)) in enumerate(LAWS.items(), 1)
    )
    strands = "".join(
        wire(f"STRAND{i}", straight((0.2, 0.01 * i, 0), (0.21, 0.01 * i, 0), 1), 1000 + 10 * i)
        + f"*MATERIAL, NAME=STRAND{i}\n*ELASTIC\n 100e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n 5e9\n*SUPERCONDUCTOR, {law}\n"
        f"*BEAM SECTION, ELSET=STRAND{i}, MATERIAL=STRAND{i}, SECTION=CIRC\n 1e-3\n"
        f"*NSET, NSET=STARTS\n {1000 + 10 * i}\n"
        for i, law in enumerate(FILAMENTS, 1)
    )
    return (
        "*HEADING\nwires that do not touch\n*UNITS, LENGTH=m, FORCE=N, TIME=s, CURRENT=A, VOLTAGE=V, TEMPERATURE=K\n"
        "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0\n"
        + wire("LOW", straight((-0.01, 0, 0), (0.06, 0, 0), 5), 901, element="B33")
        + upper
        + "*NSET, NSET=HELD\n 901\n*NSET, NSET=HELD, GENERATE\n 101, 501, 100\n*NSET, NSET=SPARE\n 902\n"
        "*NSET, NSET=TIED\n 302\n*NSET, NSET=PINNED\n 304\n*NSET, NSET=TIED TOO\n 203\n*NSET, NSET=OTHER\n 204\n"
        "*RIGID BODY, REF NODE=303, TIE NSET=TIED, PIN NSET=PINNED\n*RIGID BODY, REF NODE=202, NSET=TIED TOO\n"
        "*EQUATION\n 2\n 402, 1, 1.0, 403, 1, -1.0\n*NSET, NSET=TURNED\n 403\n"
        "*TRANSFORM, NSET=TURNED, TYPE=R\n 1, 0.5, 0.25, -0.5, 1, 0.125\n"
        "*ELSET, ELSET=UPS\n UP1, UP2, UP3, UP4\n*ELSET, ELSET=SOME\n 101, 102\n*ELSET, ELSET=SOME, GENERATE\n 201, 203, 1\n"
        + COPPER
        + BRASS
        + "*BEAM SECTION, ELSET=LOW, MATERIAL=COPPER, SECTION=CIRC, CONTACT RADIUS=1e-3, CONDUCTION=REFERENCE LENGTH\n"
        " 1e-3\n 0, 1, 0\n"
        "*BEAM SECTION, ELSET=UPS, MATERIAL=BRASS, SECTION=GENERAL, CONTACT RADIUS=1e-3\n"
        " 3e-6, 8e-13, 0, 7e-13, 1.5e-12\n 1, 0.5, 0.25\n*TRANSVERSE SHEAR STIFFNESS\n 1e5, 2e5\n"
        "*CENTROID\n 1e-4, 2e-4\n*SHEAR CENTER\n 2e-4, -1e-4\n"
        "*BEAM SECTION, ELSET=UP5, MATERIAL=BRASS, SECTION=CIRC, STIFFNESS=0.9\n 1e-3\n"
        "*AMPLITUDE, NAME=WAVE, TIME=STEP TIME\n 0, 0, 1, 1\n"
        "*AMPLITUDE, NAME=OTHER\n 0, 0, 1, 2\n"
        "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n 902, 20\n"
        + strands
        + contacts
        + "*RIGID SURFACE, NAME=FLOOR, TYPE=CYLINDER, REF NODE=906\n 0.02, 0.01, -0.05, 1, 0.1, 0.2, 0.01\n"
        "*SURFACE INTERACTION, NAME=RUBBING\n*FRICTION\n 0.2\n*GAP HEAT GENERATION\n 0.9, 0.6\n"
        "*CONTACT PAIR, INTERACTION=RUBBING\n LOW, FLOOR\n"
        "*CONTACT PAIR, INTERACTION=TABLE\n SOME, UP4\n"
        "*SURFACE INTERACTION, NAME=SHARVIN\n*GAP ELECTRICAL CONDUCTANCE, LAW=SHARVIN\n 1e-15, 1e-13\n"
        "*CONTACT PAIR, INTERACTION=SHARVIN\n UP1, UP3\n"
        "*SURFACE INTERACTION, NAME=CLUSTER\n*GAP ELECTRICAL CONDUCTANCE, LAW=CLUSTER\n 1e9, 20, 1e-13\n"
        "*CONTACT PAIR, INTERACTION=CLUSTER\n UP2, UP4\n"
        "*SURFACE INTERACTION, NAME=PATH\n*GAP ELECTRICAL CONDUCTANCE, LAW=SHARVIN, MEAN FREE PATH=39e-9\n"
        "*ELSET, ELSET=PART\n 901, 902\n*CONTACT PAIR, INTERACTION=PATH\n PART\n"
        "*SURFACE INTERACTION, NAME=YIELDING\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD=2e8, HARDNESS=8e8\n"
        "*CONTACT PAIR, INTERACTION=YIELDING\n LOW\n"
        "*BOUNDARY\n HELD, 1, 6\n 901, 9\n 104, PINNED\n STARTS, ENCASTRE\n STARTS, 9\n"
    )


HEATED = (
    wire("LOW", straight((-0.01, 0, 0), (0.06, 0, 0), 5), 901, element="B33")
    + "*NSET, NSET=SPARE\n 902\n*MATERIAL, NAME=COPPER\n*ELASTIC\n 120e9, 0.34\n*ELECTRICAL CONDUCTIVITY\n 5.88e7\n"
    "*CONDUCTIVITY, TYPE=ISO\n 390., 250\n 380., 350\n*JOULE HEAT FRACTION\n 0.9\n"
    "*DENSITY\n 8960.\n*SPECIFIC HEAT\n 385., 250\n 390., 350\n*LATENT HEAT\n 2e5, 1300., 1310.\n"
    "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-1.0, STEFAN BOLTZMANN=5.67e-8\n"
    "*BEAM SECTION, ELSET=LOW, MATERIAL=COPPER, SECTION=CIRC\n 1e-3\n"
    "*AMPLITUDE, NAME=WAVE\n 0, 0, 1, 1\n*AMPLITUDE, NAME=OTHER\n 0, 0, 1, 2\n*BOUNDARY\n 901, 9\n"
    "*SURFACE INTERACTION, NAME=TOUCH\n*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SUPERTEMPERATURE=NO\n"
    "*CONTACT PAIR, INTERACTION=TOUCH\n LOW\n"
)
HEAT_STEP = """\
*STEP
*COUPLED THERMAL-ELECTRICAL, STEADY STATE
 1.0, 1.0, 1e-3, 1.0
*BOUNDARY, AMPLITUDE=WAVE
 901, 11, 11, 300
*CECURRENT, AMPLITUDE=OTHER
 906, 9, 1.0
*CFLUX, AMPLITUDE=WAVE
 906, 11, 0.01
*DFLUX, AMPLITUDE=WAVE
 903, BF, 1e5
*FILM, AMPLITUDE=WAVE, FILM AMPLITUDE=WAVE
 904, F, 290, 40
*RADIATE, AMPLITUDE=WAVE
 905, R, 280, 0.5
*RESTART, WRITE
*END STEP
"""
HEAT_LATER = """\
*STEP
*COUPLED THERMAL-ELECTRICAL, STEADY STATE
*NODE PRINT, NSET=SPARE
 NT
*END STEP
"""


@pytest.fixture(scope="module")
def kept_heated(litz_of_module, tmp_path_factory):
    """Directory of a run with heat, with its restart file."""
    place = tmp_path_factory.mktemp("kept_heated")
    (place / "deck.inp").write_text(HEATED + HEAT_STEP + HEAT_LATER)
    done = litz_of_module("run", place / "deck.inp", "-o", place)
    assert done.returncode == 0, done.stderr
    return place


@pytest.fixture(scope="module")
def kept(litz_of_module, tmp_path_factory):
    """Directory of a run of the model, with its restart file."""
    place = tmp_path_factory.mktemp("kept")
    (place / "deck.inp").write_text(model() + STEP + LATER)
    done = litz_of_module("run", place / "deck.inp", "-o", place)
    assert done.returncode == 0, done.stderr
    return place


@pytest.fixture(scope="module")
def litz_of_module(litz_program):
    """The program, for the whole module."""

    def run(*arguments):
        return subprocess.run(
            [litz_program, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False
        )

    return run


@pytest.fixture
def go_on(litz_of_module, kept, kept_heated, tmp_path):
    """Continue a kept run with a deck, from the end of its first step."""

    def run(text, heated=False):
        (tmp_path / "other.inp").write_text(text)
        place = f"{(kept_heated if heated else kept) / 'deck.restart.h5'}:1:1"
        return litz_of_module("run", tmp_path / "other.inp", "-o", tmp_path / "out", "--restart", place)

    return run


REFUSED = "the deck differs from that of the run that wrote it"

#: Cards that a user may change, and why; all others decide results
FREE = {
    "HEADING": "text", "INCLUDE": "what is included counts", "MESH": "what is in the file counts: tested by itself",
    "BEAM GENERAL SECTION": "counts as *BEAM SECTION",
    "STEP": "text, and how many increments there may be", "END STEP": "nothing to change",
    "CONTROLS": "how it is solved", "SOLVER": "how it is solved", "SOLUTION TECHNIQUE": "how it is solved",
    "NODE PRINT": "output", "EL PRINT": "output", "CONTACT PRINT": "output", "ENERGY PRINT": "output",
    "ELECTRODE PRINT": "output", "NODE FILE": "output", "EL FILE": "output", "CONTACT FILE": "output", "RESTART": "output",
}  # fmt: skip
#: Dimensions of the shapes of cross-sections
SIDES = ("a", "b", "b1", "b2", "h", "l", "r", "t", "t1", "t2", "t3", "t4")
#: Values that a user may change, and why
FREE_VALUES = {
    ("BEAM SECTION", "Gamma0"): "0 alone", ("BEAM SECTION", "GammaW"): "0 alone",
    ("STATIC", "DIRECT"): "size of the increments", ("STATIC", "first"): "size of the increments",
    ("STATIC", "smallest"): "size of the increments", ("STATIC", "largest"): "size of the increments",
    ("UNITS", "SYSTEM"): "one choice", ("ELASTIC", "TYPE"): "one choice", ("INITIAL CONDITIONS", "TYPE"): "one choice",
    ("EXPANSION", "TYPE"): "one choice", ("CONDUCTIVITY", "TYPE"): "one choice",
    ("COUPLED THERMAL-ELECTRICAL", "STEADY STATE"): "a flag: tested by itself",
    ("COUPLED THERMAL-ELECTRICAL", "DELTMX"): "size of the increments",
    ("COUPLED THERMAL-ELECTRICAL", "ERROR"): "size of the increments",
    ("COUPLED THERMAL-ELECTRICAL", "END"): "when it ends",
    ("COUPLED THERMAL-ELECTRICAL", "rate"): "when it ends",
    ("COUPLED THERMAL-ELECTRICAL", "DIRECT"): "size of the increments",
    ("COUPLED THERMAL-ELECTRICAL", "first"): "size of the increments",
    ("COUPLED THERMAL-ELECTRICAL", "smallest"): "size of the increments",
    ("COUPLED THERMAL-ELECTRICAL", "largest"): "size of the increments",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "STEADY STATE"): "as that of *COUPLED THERMAL-ELECTRICAL",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "DELTMX"): "size of the increments",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "ERROR"): "size of the increments",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "END"): "when it ends",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "rate"): "when it ends",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "ELECTRICAL"): "needed where a material conducts currents",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "total"): "as that of *STATIC",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "DIRECT"): "size of the increments",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "first"): "size of the increments",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "smallest"): "size of the increments",
    ("COUPLED TEMPERATURE-DISPLACEMENT", "largest"): "size of the increments",
    ("DFLUX", "label"): "one choice", ("FILM", "label"): "one choice", ("RADIATE", "label"): "one choice",
    ("CFLUX", "dof"): "11 or empty",
    ("EQUATION", "terms"): "form of the data",
    ("DLOAD", "OP"): "none before", ("LORENTZ", "OP"): "none before",
    ("LORENTZ", "dBx/dx"): "a field has no divergence", ("LORENTZ", "dBy/dy"): "a field has no divergence",
    ("LORENTZ", "dBz/dz"): "a field has no divergence",
    ("LORENTZ", "ALONG"): "fields that change evenly count", ("LORENTZ", "place"): "fields that change evenly count",
    ("LORENTZ", "second place"): "fields that change evenly count",
    ("BEAM SECTION", "I12"): "angle of the principal axes and second moments about them count",
    ("BEAM SECTION", "OFFSET1"): "the shear centre counts", ("BEAM SECTION", "OFFSET2"): "the shear centre counts",
    ("NSET", "ELSET"): "its nodes count",
    ("CECURRENT", "dof"): "9 or empty", ("TRANSVERSE SHEAR STIFFNESS", "SCF"): "softens nothing",
    ("RIGID SURFACE", "TYPE"): "tested with rigid surfaces",
    ("RIGID SURFACE", "RADIUS AMPLITUDE"): "tested with surfaces that shrink",
    # names: the things that they name are the same
    ("MATERIAL", "NAME"): "a name", ("AMPLITUDE", "NAME"): "a name", ("SURFACE INTERACTION", "NAME"): "a name",
    ("RIGID SURFACE", "NAME"): "a name",
    ("NODE", "NSET"): "a name", ("ELEMENT", "ELSET"): "a name", ("NSET", "NSET"): "a name", ("ELSET", "ELSET"): "a name",
    # one carries over, the other removes: in the first step there is nothing else
    ("BOUNDARY", "OP"): "tested by itself", ("CLOAD", "OP"): "none before", ("CECURRENT", "OP"): "none before",
    ("TEMPERATURE", "OP"): "none before", ("CFLUX", "OP"): "none before", ("DFLUX", "OP"): "none before",
    ("FILM", "OP"): "none before", ("RADIATE", "OP"): "none before",
    ("BOUNDARY", "first"): "tested by its last one", ("BOUNDARY", "FIXED"): "tested by itself, as it takes no value",
    ("NSET", "GENERATE"): "form of the data", ("ELSET", "GENERATE"): "form of the data",
    ("SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE"): "tested by itself, with its data",
    **{("BEAM SECTION", side): "area, stiffnesses and corners that follow from it count" for side in SIDES},
    ("ELEMENT", "n3"): "of quadratic beams: the nodes of their two elements count",
    ("SUPERCONDUCTOR", "LAW"): "form of the data",
    ("ELSET", "INTERNAL"): "of a CAE", ("NSET", "INTERNAL"): "of a CAE",
    ("SURFACE INTERACTION", "thickness"): "of contact in two dimensions",
    ("BEAM SECTION", "SECTION"): "form of the data", ("BEAM SECTION", "ELSET"): "every element has one section",
}  # fmt: skip


def cards_of(text):
    """Cards as (first line, lines of the card)."""
    lines = text.splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith("*")] + [len(lines)]
    return [(start, lines[start:end]) for start, end in pairwise(starts)]


def parameters_of(line):
    """Parameters of a keyword line, as written."""
    words = [word.strip() for word in line.split(",")[1:]]
    return {word.split("=")[0].strip(): [*word.split("="), "YES"][1].strip() for word in words}


def other_values(text, spec):
    """Values that may stand in the place of one."""
    if spec.get("choices"):
        values = spec["choices"]
    elif spec["kind"] == "real":
        number = float(text)
        return [repr(x) for x in (number * 1.01, number * 0.99, number + 0.01, -number) if x != number]
    elif spec["kind"] in ("integer", "number or set"):
        values = ["902", "3", "2", "102", "103", "403", "402", "401", "200", "SPARE", "UP4"]
    else:
        values = ["BRASS", "COPPER", "OTHER", "PAPER", "PLASTIC", "UP1", "UP3", "mm", "kN", "ms", "mA", "mV"]
    return [value for value in values if value != text]


def renumbered(text, number):
    """The deck with another number of a node or element wherever it stands at the start of a line or behind a comma."""
    return re.sub(rf"(?m)(^ |, ){number}(?=,|$)", r"\g<1>7777", text)


def with_line(text, at, line):
    """The deck with another line in the place of one."""
    lines = text.splitlines()
    return "\n".join([*lines[:at], line, *lines[at + 1 :]]) + "\n"


def changed_parameters(keyword, text, start, line):
    given = parameters_of(line)
    for spec in keyword["parameters"]:
        name = spec["name"]
        if spec["kind"] == "flag" and name not in given:
            yield spec, [with_line(text, start, f"{line}, {name}")]
        elif spec["kind"] != "flag" and name in given:
            others = other_values(given[name], spec)
            yield spec, [with_line(text, start, line.replace(f"{name}={given[name]}", f"{name}={x}")) for x in others]


def changed_data(form, text, at, line):
    values = [value.strip() for value in line.split(",")]
    for i, (value, spec) in enumerate(zip(values, form["values"], strict=False)):
        if not value:
            continue
        decks = [
            with_line(text, at, " " + ", ".join([*values[:i], other, *values[i + 1 :]]))
            for other in other_values(value, spec)
        ]
        if spec["name"] == "id":
            decks.insert(0, renumbered(text, value))
        if spec["name"] == "n1":
            decks.insert(0, with_line(text, at, f" {values[0]}, {values[2]}, {values[1]}"))
        yield spec, decks


def changes(keyword, text):
    """(description, decks in which it alone is another) for each value of a keyword that the deck has."""
    for start, card in cards_of(text):
        if card[0].split(",")[0].strip().upper() != f"*{keyword['name']}":
            continue
        yield from changed_parameters(keyword, text, start, card[0])
        given = parameters_of(card[0])
        for form in keyword["data"]:
            parameter, _, word = (form["when"] or "=").partition("=")
            if form["first"] < len(card) and (not parameter or given.get(parameter, "NO") == word):
                at = form["first"]
                yield from changed_data(form, text, start + at, card[at])


def test_every_value_that_decides_results_is_compared(litz_of_module, go_on):
    missed, covered, expected = [], set(), set()
    for keyword in json.loads(litz_of_module("keywords", "--json").stdout):
        name = keyword["name"]
        if name in FREE:
            continue
        values = [spec["name"] for spec in keyword["parameters"]]
        values += [spec["name"] for form in keyword["data"] for spec in form["values"]]
        expected |= {(name, value) for value in values if (name, value) not in FREE_VALUES}
        # the step that has not begun may change
        given = [(model() + STEP, LATER, False), (HEATED + HEAT_STEP, HEAT_LATER, True)]
        for spec, decks, later, heated in (
            (*change, later, heated) for text, later, heated in given for change in changes(keyword, text)
        ):
            what = (name, spec["name"])
            if what in FREE_VALUES or what in covered:
                continue
            for deck in decks:
                done = go_on(deck + later, heated)
                if REFUSED in done.stderr:
                    assert done.returncode == 1
                    covered.add(what)
                    break
                # another number or word is another model, but another member may be in the set already
                if done.returncode == 0 and (spec["kind"] == "real" or spec["choices"]):
                    missed.append(what)
    unchanged = sorted(expected - covered)
    assert not missed, f"changed without a word: {missed}"
    assert not unchanged, (
        f"no deck of this test changes {unchanged}: give model() a card with it, or say why it is free"
    )
    assert len(covered) > 50


def test_a_step_that_stores_heat_is_another(go_on):
    done = go_on((HEATED + HEAT_STEP).replace(", STEADY STATE", "") + HEAT_LATER, heated=True)
    assert done.returncode == 1
    assert "step 1: heat in the deck, but not in the restart file" in done.stderr


SOURCES = {name: (FORTRAN / "model" / f"{name}.f90").read_text() for name in ("model", "model_record")}

#: Fields of the model that a user may change, and why
FREE_FIELDS = {
    "model_t": {"heading", "deck_text", "node_sets"},
    "contact_pair_t": {"file", "line"},
    "rigid_body_t": {"file", "line"},
    "step_t": {
        # text, size of the increments, output, how it is solved
        "title", "nlgeom", "max_increments", "first", "smallest", "largest", "direct", "requests", "output_frequency",
        "has_section_results", "contact_frequency",
        "restart_frequency", "largest_change", "largest_error", "steady_rate", "controls", "solver", "coupling", "reform_kernel",
        # follow from what the steps solve for, and from what they and the steps before name
        "has_solved", "let_go",
    },
}  # fmt: skip


TYPES = [
    "model_t", "material_t", "section_t", "amplitude_t", "interaction_t", "contact_pair_t", "rigid_body_t", "nodal_value_t",
    "step_t",
]  # fmt: skip


@pytest.mark.parametrize("name", TYPES)
def test_every_field_of_the_model_is_recorded_or_free(name):
    """A field that is added to a type of the model is entered in model_record.f90, or here with its reason."""
    body = re.search(rf"type :: {name}\n(.*?)end type", SOURCES["model"], re.DOTALL)[1]
    fields = set()
    for line in re.sub(r"!.*", "", body).splitlines():
        if "::" in line:
            names = re.sub(r"\([^)]*\)|=[^,]*", "", line.split("::")[1])
            fields |= {field.strip() for field in names.split(",")}
    assert len(fields) >= 3
    used = set(re.findall(r"%(\w+)", re.sub(r"!.*", "", SOURCES["model_record"])))
    assert fields - used == FREE_FIELDS.get(name, set())


def differences(done):
    assert done.returncode == 1, done.stderr
    return done.stderr.split(REFUSED + ": ")[1]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("120e9, 0.34", "110e9, 0.34", "material COPPER: Young's modulus 1.2e+11 in the restart file, 1.1e+11 in the deck"),
        ("120e9", "120000000001", "Young's modulus 1.20000000000000000E+011 in the restart file, 1.20000000001"),
        ("LENGTH=m", "LENGTH=mm", "the units (*UNITS): length m in the restart file, mm in the deck"),
        ("TYPE=B33", "TYPE=B31", "the elements: types changed"),
        ("0, 0, 1, 1", "0, 0, 1, 1.5", "amplitude WAVE of step 1: factors changed"),
        ("*FRICTION\n 0.1", "*FRICTION\n 0.4", "coefficient of friction 0.1 in the restart file, 0.4 in the deck"),
        (" SOME, UP4", " SOME, UP3", "*CONTACT PAIR 6 of the deck: elements of the second set changed"),
        ("*NSET, NSET=TIED\n 302", "*NSET, NSET=TIED\n 902", "the rigid body of node 303: tied nodes changed"),
        ("REF NODE=202", "REF NODE=902", "the rigid body of node 202 in the restart file, but not in the deck"),
        (" 104, PINNED", " 104, 1, 2", "step 1: *BOUNDARY of degree of freedom 3 changed"),
        ("*BOUNDARY, AMPLITUDE=WAVE\n 906, 9, 9, 1e-3", "*BOUNDARY, FIXED\n 906, 9", "*BOUNDARY of degree of freedom 9 changed"),
        (" 906, 3, 1e-3", " 906, 3, 2e-3", "step 1: *CLOAD of degree of freedom 3 changed"),
        (" 906, 3, 1e-3", " 906, 2, 1e-3", "step 1: *CLOAD of degree of freedom 3 in the restart file, but not in the deck"),
        ("OVERCLOSURE=HERTZ\n", "OVERCLOSURE=LINEAR\n 1e5\n", "interaction CONSTANT of *CONTACT PAIR 4: normal law"),
        ("BRASS", "BRONZE", "material BRASS in the restart file, but not in the deck"),
        ("3e-6, 8e-13, 0, 7e-13, 1.5e-12", "3.1e-6, 8.1e-13, 0, 7.1e-13, 1.51e-12", "and 1 more"),
    ],
)  # fmt: skip
def test_what_has_changed_is_named(go_on, old, new, words):
    text = model() + STEP + LATER
    assert old in text
    assert words in differences(go_on(text.replace(old, new)))


def test_supports_that_are_taken_away_in_the_step_are_named(go_on):
    text = (model() + STEP + LATER).replace("*BOUNDARY, AMPLITUDE=WAVE", "*BOUNDARY, OP=NEW, AMPLITUDE=WAVE")
    held = " 901, 1, 6\n 901, 9\n STARTS, 1, 6\n STARTS, 9\n 201, 1, 6\n"
    text = text.replace(" 906, 9, 9, 1e-3\n", " 906, 9, 9, 1e-3\n" + held, 1)
    assert "*BOUNDARY of degree of freedom 1" in differences(go_on(text))


def test_a_mesh_in_a_file_is_compared_by_what_it_says(litz, tmp_path):
    position = [[0.0, 0, 0], [0.05, 0, 0], [0.1, 0, 0]]
    with h5py.File(tmp_path / "mesh.h5", "w") as file:
        file["nodes/id"], file["nodes/position"] = [1, 2, 3], position
        file["elements/B31/id"], file["elements/B31/nodes"] = [1, 2], [[1, 2], [2, 3]]
        file["element_sets/WIRE"] = [1, 2]
    deck = tmp_path / "deck.inp"
    deck.write_text(
        "*MESH, INPUT=mesh.h5\n*MATERIAL, NAME=STEEL\n*ELASTIC\n 200e9, 0.3\n"
        "*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC\n 1e-3\n*BOUNDARY\n 1, ENCASTRE\n"
        "*STEP\n*STATIC\n 0.5, 1\n*CLOAD\n 3, 2, 0.1\n*RESTART, WRITE\n*END STEP\n"
    )
    assert litz("run", deck, "-o", tmp_path / "first").returncode == 0
    place = f"{tmp_path / 'first' / 'deck.restart.h5'}:1:1"
    assert litz("run", deck, "-o", tmp_path / "second", "--restart", place).returncode == 0
    with h5py.File(tmp_path / "mesh.h5", "r+") as file:
        file["nodes/position"][2, 0] = 0.11
    assert "the nodes: positions changed" in differences(
        litz("run", deck, "-o", tmp_path / "third", "--restart", place)
    )


def test_what_a_user_may_change_is_accepted(go_on):
    text = model() + STEP
    later = LATER.replace("1, 1\n", "1, 2\n").replace("906, 2, 1e-3", "906, 2, 2e-3") + LATER.replace("LATER", "LAST")
    for old, new in (
        ("wires that do not touch", "another heading"),
        ("*NSET, NSET=SPARE\n 902", "** a comment\n*NSET, NSET=SPARE\n 903"),
        ("*AMPLITUDE, NAME=OTHER\n 0, 0, 1, 2\n", "*AMPLITUDE, NAME=OTHER\n 0, 1, 1, 3\n"),
        # another order, and numbers written otherwise
        (COPPER + BRASS, BRASS + COPPER),
        ("120e9, 0.34", "1.2E+11, 0.340"),
        (" HELD, 1, 6\n 901, 9\n", " 901, 9\n HELD, 1, 3\n HELD, 4, 6\n"),
        ("*STEP, NAME=ONE, INC=50", "*STEP, NAME=FIRST, INC=60\na title"),
        ("*STATIC\n 1.0, 1.0, 1e-3, 1.0", "*STATIC\n 0.5, 1.0, 1e-4, 0.5"),
        ("*RESTART, WRITE", "*CONTROLS, PARAMETERS=FIELD\n 1e-9\n*SOLVER, NAME=SKYLINE\n*NODE PRINT, NSET=SPARE\n U"),
    ):
        assert old in text
        done = go_on(text.replace(old, new) + LATER)
        assert done.returncode == 0, f"{new}: {done.stderr}"
        text = text.replace(old, new)
    done = go_on(text + later)
    assert done.returncode == 0, done.stderr


def test_files_of_an_earlier_format_are_refused_in_words(litz, kept, tmp_path):
    shutil.copy(kept / "deck.restart.h5", tmp_path / "old.h5")
    with h5py.File(tmp_path / "old.h5", "r+") as file:
        file.attrs["format_version"] = file.attrs["format_version"] - 1
    done = litz("run", kept / "deck.inp", "-o", tmp_path / "out", "--restart", tmp_path / "old.h5")
    assert done.returncode == 4
    assert "another version of litz wrote it, in format 39 (this one reads format 40)" in done.stderr
    assert not (tmp_path / "out").exists() or not list((tmp_path / "out").iterdir())


@pytest.mark.parametrize("place", [0, 1, 2, -1])
def test_a_record_with_one_changed_bit_is_refused(litz, kept, tmp_path, place):
    """Length, checksum, and the text itself."""
    shutil.copy(kept / "deck.restart.h5", tmp_path / "bad.h5")
    with h5py.File(tmp_path / "bad.h5", "r+") as file:
        file["model_record"][place] = file["model_record"][place] ^ 16
    done = litz("run", kept / "deck.inp", "-o", tmp_path / "out", "--restart", tmp_path / "bad.h5")
    assert done.returncode == 4
    assert "model_record" in done.stderr
