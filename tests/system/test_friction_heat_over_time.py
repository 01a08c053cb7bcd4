"""Heat of friction over time: what the wires keep of it is its work, however the increments lie to its beginning and end."""

import numpy as np
import pytest

from run_of_deck import run_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

RADIUS, DENSITY, HEAT, ROOM, COEFFICIENT = 0.5e-3, 7800.0, 460.0, 300.0, 0.3
RAMP = "*AMPLITUDE, NAME=RAMP\n0, 0, 0.4, 1\n*BOUNDARY, AMPLITUDE=RAMP\n"
#: Parts of the path of the rubbing wire over time
MOTIONS = {
    name: f"*AMPLITUDE, NAME=MOTION\n{path}\n*BOUNDARY, AMPLITUDE=MOTION\n"
    for name, path in (
        ("ends within the step", "0, 0, 0.1, 1, 0.4, 1"),
        ("begins within the step", "0, 0, 0.1, 0, 0.4, 1"),
        ("within the step", "0, 0, 0.1, 0, 0.2, 1, 0.4, 1"),
        ("to and fro", "0, 0, 0.1, 1, 0.2, 0, 0.4, 0"),
    )
}


def wire(first, name, ends, elements):
    """Nodes and elements of a straight wire."""
    places = np.linspace(*ends, elements + 1)
    nodes = "\n".join(f"{first + i}, {x:.17g}, {y:.17g}, {z:.17g}" for i, (x, y, z) in enumerate(places))
    members = "\n".join(f"{first + i}, {first + i}, {first + i + 1}" for i in range(elements))
    return f"*NODE, NSET={name}\n{nodes}\n*ELEMENT, TYPE=B33, ELSET={name}\n{members}\n"


def deck(
    increments,
    motion,
    *,
    procedure="*COUPLED TEMPERATURE-DISPLACEMENT",
    conductivity=50,
    held="",
    step="",
    path=0.012,
    elements=20,
    gap=1e-6,
    model="",
):
    """A wire that is dragged along another one, both held all over and without a way out for their heat but `held`; one more
    at a distance of `gap` from the lower one, which can be dragged, too."""
    return f"""\
{wire(1, "LOWER", ((0, 0, 0), (0.02, 0, 0)), elements)}\
{wire(1001, "UPPER", ((0.004, -0.01, 0.9995e-3), (0.004, 0.01, 0.9995e-3)), elements + 1)}\
{wire(2001, "LIGHT", ((0.002, -0.01, 1e-3 + gap), (0.002, 0.01, 1e-3 + gap)), elements + 1)}\
*NSET, NSET=ALL
LOWER, UPPER, LIGHT
*ELSET, ELSET=ABOVE
UPPER, LIGHT
*NSET, NSET=ENDS
1, {elements + 1}, 1001, {elements + 1002}
*MATERIAL, NAME=STEEL
*ELASTIC
2e11, 0.3
*CONDUCTIVITY
{conductivity}
*DENSITY
{DENSITY}
*SPECIFIC HEAT
{HEAT}
*BEAM SECTION, ELSET=LOWER, MATERIAL=STEEL, SECTION=CIRC
{RADIUS}
*BEAM SECTION, ELSET=ABOVE, MATERIAL=STEEL, SECTION=CIRC
{RADIUS}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e7
*FRICTION
{COEFFICIENT}
*CONTACT PAIR, INTERACTION=TOUCH
LOWER, ABOVE
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {ROOM}
{model}*BOUNDARY
ALL, ENCASTRE
*STEP
*STATIC
*BOUNDARY
UPPER, 3, 3, -1e-6
*END STEP
*STEP, INC=10000
{procedure}
{increments}
{motion}UPPER, 1, 1, {path}
{held}{step}*ENERGY PRINT
*NODE PRINT, NSET=ALL
NT
*EL PRINT, ELSET=LOWER, TOTALS=YES
QSTORE
*END STEP
"""


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


def heat_in_wires(results, increment=-1):
    ends = results.nodes[results.elements]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    warmer = results.field("temperature", increment)[results.elements].mean(axis=1) - ROOM
    return DENSITY * HEAT * np.pi * RADIUS**2 * np.sum(length * warmer)


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("increments", ["0.1, 0.4", "0.05, 0.4", "0.013, 0.4, , 0.071"])
def test_wires_keep_the_work_of_friction(run, motion, increments):
    """At all times, by the temperatures of their nodes: half of each element belongs to either."""
    results = run(increments, MOTIONS[motion])
    work = results.history["ALLFD"]
    path = 0.024 if motion == "to and fro" else 0.012
    # without what the wires stick before they slip, 0.1 um each way
    assert work[-1] == pytest.approx(COEFFICIENT * results.contacts_at(-1)["force"].sum() * path, rel=1e-3)
    kept = [heat_in_wires(results, increment) for increment in range(len(work))]
    np.testing.assert_allclose(kept, work, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("procedure", ["DELTMX=0.3", "ERROR=0.05"])
def test_increments_of_their_own_size_keep_it(run, procedure):
    results = run("0.02, 0.4", MOTIONS["to and fro"], procedure="*COUPLED TEMPERATURE-DISPLACEMENT, " + procedure)
    assert len(set(np.round(np.diff(results.times), 9))) > 5
    assert heat_in_wires(results) == pytest.approx(results.history["ALLFD"][-1], rel=1e-9)


def test_the_ledger_has_the_work_of_each_increment(run):
    results = run("0.05, 0.4", MOTIONS["within the step"])
    spans = np.diff(results.times, prepend=0.0)
    work = np.diff(results.history["ALLFD"], prepend=0.0)
    for increment, (span, done) in enumerate(zip(spans, work, strict=True)):
        row = results.contacts_at(increment)
        assert (row["heat_1"] + row["heat_2"]).sum() * span == pytest.approx(done, rel=1e-9, abs=1e-15)


def test_a_contact_that_opens_leaves_its_heat(run):
    """Beside one of much more friction, so that the increment in which it opens is no other than those before it."""
    lift = "*AMPLITUDE, NAME=LIFT\n0, 0, 0.2, 0, 0.21, 1, 0.4, 1\n*BOUNDARY, AMPLITUDE=LIFT\nLIGHT, 3, 3, 1e-6\n"
    results = run("0.02, 0.4", lift + RAMP + "LIGHT, 1, 1, 6e-3\n", gap=-5e-9, path=6e-3)
    spans = np.diff(results.times, prepend=0.0)
    rows = [results.contacts_at(increment) for increment in range(len(spans))]
    assert (len(rows[1]["heat_1"]), len(rows[-1]["heat_1"])) == (2, 1)
    heats = [row["heat_1"] + row["heat_2"] for row in rows]
    assert 0 < heats[3].min() < 0.01 * heats[3].max()
    given = np.cumsum([span * heat.sum() for span, heat in zip(spans, heats, strict=True)])
    kept = [heat_in_wires(results, increment) for increment in range(len(spans))]
    np.testing.assert_allclose(kept, given, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("motion", MOTIONS)
def test_no_temperature_falls_below_that_of_the_ends(run, motion):
    """Of wires that lose their heat in much less than an increment: friction that ends takes no heat back."""
    results = run("0.02, 0.4", MOTIONS[motion], conductivity=5e4, held=f"*BOUNDARY\nENDS, 11, 11, {ROOM}\n")
    temperatures = results.field("temperature", None)
    rise = temperatures.max() - ROOM
    assert rise > 5e-3
    # BDF2 itself passes a final temperature by up to 3 %; if friction took heat back it would be half of the rise
    assert temperatures.min() > ROOM - 0.03 * rise


#: Force, and with it the heat of friction, that grows over the step
GROWS = "*AMPLITUDE, NAME=PRESS\n0, 0.1, 0.4, 1\n*BOUNDARY, AMPLITUDE=PRESS\nUPPER, 3, 3, -1e-5\n" + RAMP


@pytest.mark.parametrize("film", ["", "*FILM\nLOWER, F, 300, 1e4\n"])
def test_heat_that_leaves_at_prescribed_temperatures_is_the_work_of_friction(run, film):
    """All nodes keep their temperature, so that nothing is stored: in each increment they give off, or films take, what
    friction does in it."""
    keeps = f"*BOUNDARY\nALL, 11, 11, {ROOM}\n"
    results = run("0.013, 0.4, , 0.071", GROWS, path=1e-3, elements=6, held=keeps + film)
    work = np.diff(results.history["ALLFD"], prepend=0.0)
    assert work.max() > 3 * work[work > 0].min()
    spans = np.diff(results.times, prepend=0.0)
    given = np.array([results.field("reaction_heat", i).sum() for i in range(len(spans))])
    taken = np.array([results.field("surface_heat", i).sum() for i in range(len(spans))])
    np.testing.assert_allclose((taken - given) * spans, work, rtol=1e-9, atol=1e-13)
    assert (taken.max() > 0) == bool(film)


def test_friction_of_no_consequence_does_not_change_the_order_elsewhere(run):
    """A wire far away with a source and a film, T' = (T_end - T)/tau, beside one that rubs on and off and is heated by a
    millionth of that."""
    film, end, increments = 2e3, 40.0, 40
    tau = DENSITY * HEAT * RADIUS / (2 * film)
    far = wire(9001, "FAR", ((0, 0, 0.1), (0.02, 0, 0.1)), 2) + (
        f"*BEAM SECTION, ELSET=FAR, MATERIAL=STEEL, SECTION=CIRC\n{RADIUS}\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\n"
        f"FAR, {ROOM}\n*BOUNDARY\n9001, ENCASTRE\n"
    )
    heated = f"*FILM\nFAR, F, {ROOM}, {film}\n*DFLUX\nFAR, BF, {end * 2 * film / RADIUS:.17g}\n"
    worst = []
    for path in (0, 1e-6):
        results = run(f"{0.4 / increments}, 0.4", MOTIONS["to and fro"], path=path, elements=4, model=far, held=heated)
        far_away = np.isclose(results.nodes[:, 2], 0.1)
        late = results.times - results.times[-1] + 0.4
        exact = ROOM + end * (1 - np.exp(-np.maximum(late, 0) / tau))
        worst.append(np.abs(results.field("temperature", None)[:, far_away] - exact[:, None]).max())
        assert (results.history["ALLFD"][-1] > 0) == (path > 0)
    assert worst[1] == pytest.approx(worst[0], rel=1e-6)


def test_friction_that_grows_steadily_is_of_second_order(run):
    """The force and so the heat grows with time: errors by the differences of halved increments, a quarter each time."""
    hottest = []
    for increments in (20, 40, 80):
        results = run(f"{0.4 / increments}, 0.4", GROWS, path=1e-3, elements=6)
        hottest.append(results.field("temperature").max())
    first, second = np.abs(np.diff(hottest))
    assert hottest[-1] > ROOM + 0.1
    assert first > 3.5 * second


@pytest.mark.slow
def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    text = deck("0.05, 0.4", MOTIONS["within the step"], step=KEEP_ALL, path=1e-3, elements=4)
    assert_goes_on_from_everywhere(litz, tmp_path, text)
