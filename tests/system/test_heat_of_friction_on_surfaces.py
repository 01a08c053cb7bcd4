"""Heat of friction on rigid surfaces: the wire keeps its part of what friction does, the rest is lost to the surface."""

import numpy as np
import pytest

from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_friction_heat_over_time import COEFFICIENT, DENSITY, HEAT, RADIUS, ROOM, heat_in_wires, wire
from test_restart import assert_goes_on_from_everywhere

#: Of the wire along the surface over time; it sticks for the first 0.1 um
MOTIONS = {
    "steadily": "0, 0, 0.4, 1",
    "at once": "0, 0, 0.1, 1, 0.4, 1",
    "within the step": "0, 0, 0.1, 0, 0.2, 1, 0.4, 1",
    "to and fro": "0, 0, 0.1, 1, 0.2, 0, 0.4, 0",
}


def deck(increments, motion, *, law="", step="", pair="WIRE, TABLE", elements=6, path=5e-3, keep=""):
    """A wire that lies on a plane, held all over, is pressed down and dragged along."""
    return f"""\
{wire(1, "WIRE", ((0, 0, RADIUS), (0.02, 0, RADIUS)), elements)}\
*MATERIAL, NAME=STEEL
*ELASTIC
2e11, 0.3
*CONDUCTIVITY
50
*DENSITY
{DENSITY}
*SPECIFIC HEAT
{HEAT}
*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC
{RADIUS}
*RIGID SURFACE, NAME=TABLE, TYPE=PLANE
0, 0, 0, 0, 0, 1
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e7, 1e8
*FRICTION
{COEFFICIENT}
{law}*CONTACT PAIR, INTERACTION=TOUCH
{pair}
*INITIAL CONDITIONS, TYPE=TEMPERATURE
WIRE, {ROOM}
*BOUNDARY
WIRE, ENCASTRE
*STEP
*STATIC
*BOUNDARY
WIRE, 3, 3, -1e-6
*END STEP
*STEP, INC=10000
*COUPLED TEMPERATURE-DISPLACEMENT
{increments}
*AMPLITUDE, NAME=MOTION
{MOTIONS[motion]}
*BOUNDARY, AMPLITUDE=MOTION
WIRE, 1, 1, {path}
{step}*ENERGY PRINT
*NODE PRINT, NSET=WIRE
NT
{keep}*END STEP
"""


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("increments", ["0.05, 0.4", "0.013, 0.4, , 0.071"])
def test_the_wire_keeps_half_of_the_work(run, motion, increments):
    results = run(increments, motion)
    work = results.history["ALLFD"]
    path = 0.01 if motion == "to and fro" else 0.005
    # 1e8 N/m^2 times 1 um on 20 mm; without what the wire sticks before it slips
    assert work[-1] == pytest.approx(COEFFICIENT * 1e8 * 1e-6 * 0.02 * path, rel=1e-3)
    kept = [heat_in_wires(results, increment) for increment in range(len(work))]
    np.testing.assert_allclose(kept, np.array(work) / 2, rtol=1e-9, atol=1e-12)
    # all of the wire rubs alike
    assert np.ptp(results.field("temperature")) < 1e-3 * (results.field("temperature").max() - ROOM)


def test_a_wire_that_rubs_evenly_under_a_film_is_as_warm_on_any_mesh(run):
    """Friction, storage and film are even along it: nothing is left for a mesh to tell."""
    film = f"*FILM\nWIRE, F, {ROOM}, 1e4\n"
    ends = []
    for elements in (1, 4, 16):
        results = run("0.05, 0.4", "to and fro", elements=elements, step=film)
        temperature = results.field("temperature")
        assert temperature == pytest.approx(temperature[0], abs=1e-9)
        ends.append(temperature[0])
    assert ends[0] > ROOM + 1e-3
    assert ends[1:] == pytest.approx([ends[0]] * 2, abs=1e-9)


def test_heat_that_leaves_at_prescribed_temperatures_is_the_part_of_the_work(run):
    """All nodes keep their temperature, so that nothing is stored: in each increment they give off half of the work that
    friction does in it, although that grows."""
    press = "*AMPLITUDE, NAME=PRESS\n0, 0.1, 0.4, 1\n*BOUNDARY, AMPLITUDE=PRESS\nWIRE, 3, 3, -1e-5\n"
    results = run("0.013, 0.4, , 0.071", "steadily", path=1e-3, step=press + f"*BOUNDARY\nWIRE, 11, 11, {ROOM}\n")
    work = np.diff(results.history["ALLFD"], prepend=0.0)
    assert work.max() > 3 * work[work > 0].min()
    spans = np.diff(results.times, prepend=0.0)
    given = np.array([-results.field("reaction_heat", i).sum() for i in range(len(spans))])
    np.testing.assert_allclose(given * spans, work / 2, rtol=1e-9, atol=1e-13)


def test_its_part_is_data(run):
    results = run("0.05, 0.4", "to and fro", law="*GAP HEAT GENERATION\n0.8, 0.7\n")
    assert heat_in_wires(results) == pytest.approx(0.8 * 0.7 * results.history["ALLFD"][-1], rel=1e-9)


def test_a_wire_that_is_lifted_keeps_its_part_of_what_it_has_lost(run):
    """In the increment in which it opens, what its friction held elastically is lost, too."""
    lift = "*AMPLITUDE, NAME=LIFT\n0, 1, 0.2, 1, 0.21, -10, 0.4, -10\n*BOUNDARY, AMPLITUDE=LIFT\nWIRE, 3, 3, -1e-6\n"
    results = run("0.05, 0.4", "at once", step=lift)
    work = results.history["ALLFD"]
    assert work[-1] == work[-2] > work[1]
    assert heat_in_wires(results) == pytest.approx(work[-1] / 2, rel=1e-9)


def test_the_part_of_one_of_two_wires_is_refused(refused):
    both = "WIRE, TABLE\n*CONTACT PAIR, INTERACTION=TOUCH\nWIRE"
    message = refused(1, "0.05, 0.4", "at once", law="*GAP HEAT GENERATION\n1, 0.7\n", pair=both)
    assert "half and half" in message
    assert "TOUCH" in message
    assert "not 0.7" in message


def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    text = deck("0.05, 0.4", "within the step", elements=3, keep=KEEP_ALL)
    assert_goes_on_from_everywhere(litz, tmp_path, text)
