"""Steps that move wires after one that has heated them and held them: they take up the temperatures that it has left."""

import numpy as np
import pytest

from run_of_deck import run_of_deck
from same_results import KEEP_ALL
from test_coupled_temperatures import ALPHA, AREA, CRITICAL, LENGTH, PROCEDURE, RADIUS, YOUNG, deck, voltage_for
from test_heat_over_time import STORED
from test_restart import assert_goes_on_from_everywhere

HELD = "*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n"
#: Mean of the elements' mean temperatures over the mean of the parabola, of 7 elements
MEAN = 1 - 1 / 49


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


def static(increments="", cards=""):
    return f"*STEP\n*STATIC\n{increments}{cards}*END STEP\n"


def test_a_clamped_wire_pushes(run):
    """As in one step that solves for all; over half of the step half of it."""
    results = run(voltage_for(0.5 * CRITICAL), elements=7, procedure=HELD, later=static("0.5, 1\n"))
    force = YOUNG * AREA * ALPHA * 0.5 * CRITICAL * MEAN
    np.testing.assert_allclose(
        results.field("reaction_force", increment=None)[1:, 0, 0], [0, force / 2, force], rtol=1e-9, atol=1e-9 * force
    )
    warm = results.field("temperature", increment=None)[1:]
    np.testing.assert_array_equal(warm[1:], warm[:1] * np.ones((2, 1)))
    assert results.history["ALLTW"][-1] == pytest.approx(results.history["ALLSE"][-1], rel=1e-9)


@pytest.mark.parametrize("procedure", ["*STATIC\n", PROCEDURE])
def test_a_free_wire_lengthens(run, procedure):
    later = f"*STEP\n{procedure}0.25, 1\n*END STEP\n"
    results = run(voltage_for(60.0), elements=7, ends="1, ENCASTRE", procedure=HELD, later=later)
    moved = results.field("displacement", increment=None)[1:, -1, 0]
    assert moved[0] == 0
    assert moved[1] == pytest.approx(0.25 * ALPHA * 60 * MEAN * LENGTH, rel=1e-9)
    assert moved[-1] == pytest.approx(ALPHA * 60 * MEAN * LENGTH, rel=1e-9)


def test_what_a_list_of_temperatures_lets_go_returns_to_the_initial_one(run):
    """All others stay as the coupled step has left them, also in steps after that."""
    later = static(cards="*TEMPERATURE\n4, 400\n") + static("0.5, 1\n", "*TEMPERATURE, OP=NEW\n") + static()
    warm = run(voltage_for(60.0), elements=7, procedure=HELD, later=later).field("temperature", increment=None)[1:]
    np.testing.assert_allclose(warm[1:, 3], [400, 350, 300, 300], rtol=1e-12)
    others = np.delete(warm, 3, axis=1)
    np.testing.assert_array_equal(others[1:], others[:1] * np.ones((4, 1)))


def test_over_time_it_does_at_once(run):
    later = "*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL\n1e-6, 2e-6\n*END STEP\n"
    results = run(voltage_for(60.0), elements=7, ends="1, ENCASTRE", procedure=HELD, later=later,
                  conductivity=f"390.0\n{STORED.rstrip()}")  # fmt: skip
    moved = results.field("displacement", increment=None)[1:, -1, 0]
    np.testing.assert_allclose(moved, ALPHA * 60 * MEAN * LENGTH * np.array([0, 1, 1]), rtol=1e-6)


def test_a_wire_with_a_bow_buckles(run):
    bow, share = RADIUS / 20, 4.0
    results = run(
        voltage_for(share * CRITICAL), elements=40, bow=bow, procedure=HELD, later=static("0.05, 1, , 0.05\n")
    )
    w = max(np.roots([0.25 / RADIUS**2, 0, 1 - share - 0.25 * (bow / RADIUS) ** 2, -bow]).real)
    assert results.field("displacement")[20, 1] + bow == pytest.approx(w, rel=3e-3)


@pytest.mark.parametrize("again", ["", "*BOUNDARY\n8, 4, 4, 7.0\n"])
def test_an_angle_beyond_half_a_turn_is_held_and_goes_on(run, again):
    """One angle about the axis, that is added up, and not the rotation vector of the node."""
    turn = "*STEP\n*STATIC\n0.1, 1, , 0.1\n*BOUNDARY\n8, 4, 4, 7.0\n8, 2, 3\n1, 9\n*END STEP\n"
    results = run(
        voltage_for(60.0), elements=7, ends="1, ENCASTRE", model=turn, procedure=HELD, later=static(cards=again)
    )
    moment = results.field("reaction_moment", increment=None)[:, -1, 0]
    torque = YOUNG / (2 * 1.34) * np.pi / 2 * RADIUS**4 * 7.0 / LENGTH
    assert moment[10] == pytest.approx(torque, rel=1e-6)
    assert moment[-1] == pytest.approx(torque, rel=1e-3)


@pytest.mark.slow
def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    later = static("0.3, 1\n", KEEP_ALL) + f"*STEP\n{HELD}*BOUNDARY\n1, 9, 9, 0.01\n*END STEP\n" + static("0.5, 1\n")
    later += static("0.5, 1\n", "*TEMPERATURE\n4, 320\n") + static("0.3, 1\n", "*TEMPERATURE, OP=NEW\n")
    text = deck(voltage_for(60.0), elements=7, bow=RADIUS / 4, increments="0.5, 1\n", step=KEEP_ALL, procedure=HELD,
                later=later)  # fmt: skip
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_a_straight_wire_has_the_negative_pivots_of_its_increment(run):
    """Two for each critical load that is passed: 4 pi^2, 80.76 and 16 pi^2 E I/L^2."""
    results = run(voltage_for(4.4 * CRITICAL), elements=40, increments="0.05, 1, , 0.05\n")
    s = np.linspace(0, 1, 41)
    mean = (6 * s * (1 - s))[:-1].mean()
    share = mean * 4.4 * results.times[1:] ** 2
    expected = 2 * sum(share > critical for critical in (1, 2.0457, 4))
    np.testing.assert_array_equal(results.status["negative_pivots"], expected)
    (warning,) = results.warnings
    assert (warning.increment, warning.count) == (np.flatnonzero(expected)[0] + 1, np.count_nonzero(expected))
    assert "has 2 negative pivots" in warning.message
    assert warning.worst == 6


def test_a_straight_wire_whose_given_temperature_rises_has_them_too(run):
    """Nothing moves, so that no increment has an iteration."""
    results = run(0.0, elements=20, procedure="*STATIC\n", increments="0.1, 1, , 0.1\n", heat="1, 9",
                  loads=f"*TEMPERATURE\nALL, {300 + 1.95 * CRITICAL}\n")  # fmt: skip
    beyond = 1.95 * results.times[1:] > 1
    np.testing.assert_array_equal(results.status["negative_pivots"], 2 * beyond)
    (warning,) = results.warnings
    assert (warning.increment, warning.count) == (np.flatnonzero(beyond)[0] + 1, np.count_nonzero(beyond))


def test_a_wire_that_rubs_elsewhere_does_not_hide_them(run):
    """Its friction makes the tangent unsymmetric, whose pivots count negative eigenvalues all the same."""
    rubbing = f"""\
*NODE, NSET=RUB
1001, 0, 1, {RADIUS}
1002, 0.01, 1, {RADIUS}
*ELEMENT, TYPE=B33, ELSET=RUB
1001, 1001, 1002
*BEAM SECTION, ELSET=RUB, MATERIAL=COPPER, SECTION=CIRC
{RADIUS}
*RIGID SURFACE, NAME=FLOOR, TYPE=PLANE
0, 1, 0, 0, 0, 1
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e7, 1e8
*FRICTION
0.2
*CONTACT PAIR, INTERACTION=TOUCH
RUB, FLOOR
*INITIAL CONDITIONS, TYPE=TEMPERATURE
RUB, 300
*BOUNDARY
RUB, 2
RUB, 4, 6
"""
    loads = f"1001, 9\nRUB, 3, 3, -1e-6\n1001, 1, 1, 1e-3\n*TEMPERATURE\nALL, {300 + 1.95 * CRITICAL}\n"
    results = run(0.0, elements=20, procedure="*STATIC\n", increments="0.1, 1, , 0.1\n", heat="1, 9", loads=loads,
                  model=rubbing)  # fmt: skip
    np.testing.assert_array_equal(results.status["negative_pivots"], 2 * (1.95 * results.times[1:] > 1))
    (warning,) = results.warnings
    assert "has 2 negative pivots" in warning.message
