"""Energies of contacts that open: what they held is work of the supports, or has become heat."""

import numpy as np
import pytest

from decks import crossed
from test_friction import FORCE, MU, OVERLAP, PENALTY, STICK, move, rubbing


def at_end_of(results, step, column):
    return results.history[column][results.history["step"] == step][-1]


def test_a_contact_that_opens_while_it_sticks_loses_its_spring_as_heat(run):
    """The spring of the tangential stiffness is not let go along the wires: T^2/(2 k) becomes heat, where the contact opens
    within one increment (in more, it would slip first)."""
    slip = 0.5 * MU * FORCE / STICK
    process, results = run(rubbing(move(slip), move(slip, z=1e-6, increments=1), move(2 * slip, z=1e-6)))
    assert process.returncode == 0, process.stderr
    held = STICK * slip**2 / 2
    overlap = PENALTY * OVERLAP**2 / 2
    assert at_end_of(results, 2, "ALLFD") == 0
    assert at_end_of(results, 2, "ALLCCE") == pytest.approx(held + overlap, rel=1e-7)
    for step in (3, 4):
        assert at_end_of(results, step, "ALLFD") == pytest.approx(held, rel=1e-7)
        assert at_end_of(results, step, "ALLCCE") == 0


def test_a_contact_that_stays_closed_keeps_its_spring(run):
    """Moved back to where it stuck first, it gives all of it back."""
    slip = 0.5 * MU * FORCE / STICK
    process, results = run(rubbing(move(slip), move(0)))
    assert process.returncode == 0, process.stderr
    overlap = PENALTY * OVERLAP**2 / 2
    assert at_end_of(results, 3, "ALLCCE") == pytest.approx(overlap, rel=1e-7)
    assert at_end_of(results, 3, "ALLWK") == pytest.approx(overlap, rel=1e-7)
    assert at_end_of(results, 3, "ALLFD") == 0


def test_the_work_of_a_fit_counts_the_force_of_a_contact_that_opens(run):
    """Held wires that overlap, lifted apart while the fit is resolved: mean force times what was resolved, and times
    the way of the supports, increment for increment."""
    fit, lift, penalty, n = 4e-5, 6e-5, 1e5, 5
    deck = crossed(
        height=f"{2e-3 - fit:.17g}", pair=", INTERFERENCE FIT", push="0", static=f"{1 / n}, 1, 1e-4, {1 / n}",
        behavior=f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {penalty}", spot="",
        extra="*BOUNDARY, AMPLITUDE=LIFT\n UPPER, 3, 3, 1\n*ENERGY PRINT\n",
    )  # fmt: skip
    deck = deck.replace(" LOWER_ENDS, 1, 6\n", " LOWER, 1, 6\n UPPER, 1, 2\n UPPER, 4, 6\n", 1)
    deck = deck.replace(" UPPER_ENDS, 3, 3, 0\n", "")
    deck = deck.replace("*STEP", f"*AMPLITUDE, NAME=LIFT\n 0, 0, 0.4, 0, 0.8, {lift}\n*STEP")
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    time = np.arange(n + 1) / n
    resolved, lifted = fit * time, np.interp(time, [0, 0.4, 0.8], [0, 0, lift])
    force = penalty * np.maximum(resolved - lifted, 0)
    assert (force > 0).tolist() == [False, True, True, False, False, False]
    mean = (force[1:] + force[:-1]) / 2
    work = np.cumsum(mean * (np.diff(resolved) - np.diff(lifted)))
    np.testing.assert_allclose(results.history["ALLWK"][1:], work, rtol=1e-9, atol=1e-9 * work.max())


def turned(increments):
    """A rigid wire is pressed on one that is clamped, and turned from crossed to 11 degrees."""
    return f"""*NODE
 1, -0.01, 0, 0
 2, 0, 0, 0
 3, 0.01, 0, 0
 11, 0, -0.01, 1.001e-3
 12, 0, 0.01, 1.001e-3
 20, 0, 0, 1e-3
*NSET, NSET=ENDS
 11, 12
*NSET, NSET=REFERENCE
 20
*ELEMENT, TYPE=B33, ELSET=LOWER
 1, 1, 2
 2, 2, 3
*ELEMENT, TYPE=B33, ELSET=UPPER
 11, 11, 12
*RIGID BODY, REF NODE=20, TIE NSET=ENDS
*MATERIAL, NAME=CU
*ELASTIC
 120e9, 0.34
*BEAM SECTION, SECTION=CIRC, ELSET=LOWER, MATERIAL=CU
 0.5e-3
*BEAM SECTION, SECTION=CIRC, ELSET=UPPER, MATERIAL=CU
 0.5e-3
*SURFACE INTERACTION, NAME=TOUCH
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 1, 1, 6
 3, 1, 6
 20, 1, 2
 20, 4, 6
*STEP
*STATIC
 0.1, 1
*BOUNDARY
 20, 3, 3, -4e-6
*NODE PRINT, NSET=REFERENCE
 RM
*ENERGY PRINT
*END STEP
*STEP, INC=1000
*STATIC, DIRECT
 {1 / increments}, 1
*BOUNDARY
 20, 6, 6, -1.3788
*END STEP
"""


def test_wires_that_turn_while_they_press_get_the_work_of_the_torque(run):
    """Their force depends on the angle: without a torque about it what the contact holds would come from nowhere."""
    left = []
    for increments in (20, 80):
        process, results = run(turned(increments), name=f"by{increments}")
        assert process.returncode == 0, process.stderr
        history = results.history
        change = history["ETOTAL"][-1] - at_end_of(results, 1, "ETOTAL")
        held = at_end_of(results, 1, "ALLCCE")
        work = history["ALLWK"][-1] - at_end_of(results, 1, "ALLWK")
        assert work > 0.8 * held
        left.append(abs(change) / held)
    # the work of an increment is that of the mean torque
    assert left[0] < 3e-3
    assert left[1] < left[0] / 12
