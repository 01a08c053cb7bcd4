"""Wires at small angles that are held, and swell: what crossings and lines share is that of the temperatures in balance."""

import numpy as np
import pytest

from run_of_deck import run_of_deck

RADIUS, LENGTH, ELEMENTS, OVERLAP = 0.5e-3, 0.01, 41, 0.2e-6
HEATED = "*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, STEADY STATE\n"


def deck(degrees, increments, later="", coupling="FULL"):
    """Two wires that pass a current to each other and are cooled where it enters and leaves."""
    angle = np.radians(degrees)
    s = np.linspace(-LENGTH / 2, LENGTH / 2, ELEMENTS + 1)
    nodes = "".join(
        f"{first + i}, {x:.17g}, {y:.17g}, {z:.17g}\n"
        for first, axis, z in ((1, (1, 0), 0.0), (101, (np.cos(angle), np.sin(angle)), 2 * RADIUS))
        for i, (x, y) in enumerate(np.outer(s, axis))
    )
    wires = ""
    for name, first, swells, conducts, sigma in (("A", 1, 17e-6, 390, 5.8e7), ("B", 101, 10e-6, 100, 2e7)):
        members = "".join(f"{first + i}, {first + i}, {first + i + 1}\n" for i in range(ELEMENTS))
        wires += f"""\
*ELEMENT, TYPE=B33, ELSET={name}
{members}*MATERIAL, NAME={name}
*ELASTIC
1.2e11, 0.34
*EXPANSION
{swells}
*ELECTRICAL CONDUCTIVITY
{sigma}, 300
{sigma / 5}, 1300
*CONDUCTIVITY
{conducts}
*BEAM SECTION, ELSET={name}, MATERIAL={name}, SECTION=CIRC
{RADIUS}
"""
    return f"""\
*NODE, NSET=ALL
{nodes}{wires}*NSET, NSET=UPPER, GENERATE
101, {101 + ELEMENTS}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
A, B
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 300
*BOUNDARY
ALL, ENCASTRE
1, 9
*STEP
*STATIC
0.5, 1
*BOUNDARY
UPPER, 3, 3, {-OVERLAP}
*END STEP
*STEP
{HEATED}{increments}
*SOLVER, NAME=BLOCK, COUPLING={coupling}
*BOUNDARY
1, 11, 11, 300
101, 11, 11, 310
*CECURRENT
101, 9, 60
*END STEP
{later}"""


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.mark.parametrize("degrees", [5, 8, 12])
def test_one_increment_finds_what_many_do(run, degrees):
    """Nothing but temperatures iterates: motions are in balance from the first iteration on."""
    once, often = (run(degrees, increments) for increments in ("1, 1", "0.1, 1, 1e-5, 0.1"))
    assert len(once.contacts_at(-1)["force"]) == len(often.contacts_at(-1)["force"])
    for name, rtol in (("force", 1e-3), ("joule_heat", 1e-2)):
        assert once.contacts_at(-1)[name].sum() == pytest.approx(often.contacts_at(-1)[name].sum(), rel=rtol)
    np.testing.assert_allclose(once.field("temperature"), often.field("temperature"), atol=1e-2)


@pytest.mark.parametrize("coupling", ["FULL", "UPDATED"])
def test_a_step_in_which_nothing_changes_leaves_forces_as_they_are(run, coupling):
    results = run(8, "1, 1", later="*STEP\n*STATIC\n1, 1\n*END STEP\n", coupling=coupling)
    before, after = (results.contacts_at(increment)["force"] for increment in (-2, -1))
    assert len(before) > 5
    assert after.sum() == pytest.approx(before.sum(), rel=1e-3)
    np.testing.assert_allclose(after, before, atol=1e-3 * before.max())
