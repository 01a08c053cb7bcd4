"""Temperatures of contacts within elements over time: they follow the heat as the wire within the element does."""

import numpy as np
import pytest

from crossing_conductors import AMPERES, HALF, LAMBDA, RADIUS, ROOM, crossing
from run_of_deck import run_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

RHO, DENSITY, HEAT = 1.7e-8, 8900.0, 385.0
AREA = np.pi * RADIUS**2
#: L^2/(pi^2 kappa) of a wire between its ends
TAU = (2 * HALF) ** 2 * DENSITY * HEAT / (np.pi**2 * LAMBDA)


def deck(elements, increments, *, procedure="", place=0.0, load=f"*CECURRENT\n1001, , {AMPERES}\n", step=""):
    """Both wires store heat and cross at `place` of the first one."""
    stored = f"*DENSITY\n{DENSITY}\n*SPECIFIC HEAT\n{HEAT}\n"
    return crossing(
        elements, f"{1 / RHO:.17g}", increments, procedure=procedure, place=place, stored=stored, load=load + step
    )


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


def rise_of_wire(times, spot_heat, place=0.0, cells=800):
    """Where the wires touch: of heat that enters there and that of the current from one end to there, by the eigenvectors of
    finite differences in space, exact in time."""
    step = 2 * HALF / cells
    x = -HALF + step * np.arange(1, cells)
    matrix = LAMBDA * AREA / step * (2 * np.eye(cells - 1) - np.eye(cells - 1, k=1) - np.eye(cells - 1, k=-1))
    source = np.where(x < place - step / 2, AMPERES**2 * RHO / AREA * step, 0.0)
    at = int(np.argmin(np.abs(x - place)))
    source[at] = spot_heat + AMPERES**2 * RHO / AREA * step / 2
    values, vectors = np.linalg.eigh(matrix)
    grown = (1 - np.exp(-np.outer(times, values) / (DENSITY * HEAT * AREA * step))) / values
    return (grown * (vectors.T @ source)) @ vectors[at]


def temperatures(results):
    """Of the first wire at the contact after each increment, and the heat that enters it there."""
    rows = [results.contacts_at(increment) for increment in range(1, len(results.times))]
    return np.array([row["temperature_1"][0] for row in rows]), rows[-1]["joule_heat"][0] / 2


@pytest.mark.slow
@pytest.mark.parametrize("elements", [1, 3])
def test_the_contact_warms_as_the_wire_does(run, elements):
    """Within 8.5 % of the rise of a steady state: the series of one heat in the middle, whose fast parts are taken as one, is
    met to 2.5 %; the even heat of a current, and nodes that take up their heat at once, make the rest."""
    found, heat = temperatures(run(elements, f"{TAU / 200}, {2 * TAU}"))
    times = np.arange(1, len(found) + 1) * TAU / 200
    steady = rise_of_wire(np.array([1e3 * TAU]), heat)[0]
    assert steady > 40
    exact = rise_of_wire(times, heat)
    np.testing.assert_allclose(found - ROOM, exact, atol=0.085 * steady)


@pytest.mark.parametrize("part", [1e-4, 1e-3, 1e-2])
def test_a_short_increment_warms_it_by_little(run, part):
    found, heat = temperatures(run(1, f"{part * TAU}, {part * TAU}"))
    steady = rise_of_wire(np.array([1e3 * TAU]), heat)[0]
    exact = rise_of_wire(np.array([part * TAU]), heat)[0]
    assert exact < 0.1 * steady
    assert found[0] - ROOM == pytest.approx(exact, abs=0.05 * steady)


def test_it_ends_in_the_steady_state(run):
    after, _ = temperatures(run(1, f"{TAU / 4}, {40 * TAU}"))
    steady, _ = temperatures(run(1, "1, 1", procedure=", STEADY STATE"))
    assert after[-1] == pytest.approx(steady[-1], rel=1e-9)


def test_it_cools_when_the_current_ends(run):
    """Free of heat, it falls with the time constants of the wire: nothing of the rise is left at once."""
    points = f"0, 1, {9 * TAU:.17g}, 1, {9.001 * TAU:.17g}, 0, {11 * TAU:.17g}, 0"
    pulse = f"*AMPLITUDE, NAME=PULSE\n{points}\n*CECURRENT, AMPLITUDE=PULSE\n1001, , {AMPERES}\n"
    results = run(1, f"{TAU / 50}, {11 * TAU}", load=pulse)
    found, _ = temperatures(results)
    top = int(np.argmax(found))
    fallen = (found[top:] - ROOM) / (found[top] - ROOM)
    times = results.times[1:]
    spans = (times[top:] - times[top]) / TAU
    k = np.arange(1, 400, 2)
    exact = np.array([np.sum(8 / (np.pi * k) ** 2 * np.exp(-(k**2) * span)) for span in spans])
    np.testing.assert_allclose(fallen, exact, atol=0.06)


def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    assert_goes_on_from_everywhere(litz, tmp_path, deck(3, f"{TAU / 4}, {TAU}", place=0.001, step=KEEP_ALL))
