"""Elements may run along their wire or against it: the physics is the same."""

import numpy as np
import pytest

from decks import CONDUCTOR, wire

AGAINST = ((2, 5, 6), (1, 4))


def bent(n, span, height, sag):
    """Points of a parabola along x that sags in the xy plane."""
    s = np.linspace(-1, 1, n + 1)
    return np.stack([span * s, sag * s**2, np.full(n + 1, height)], axis=1)


def pressed(element, backwards, *, slide=1.2e-2):
    """Two bent wires that cross aslant, pressed together by their ends and then dragged over nodes, with a current."""
    lower = wire("LOWER", bent(9, 0.03, 0, 4e-3), 1, element=element, backwards=backwards[0])
    turned = bent(7, 0.03, 2e-3, -3e-3)
    angle = np.radians(70)
    along = np.stack([turned[:, 0] * np.cos(angle) - turned[:, 1] * np.sin(angle),
                      turned[:, 0] * np.sin(angle) + turned[:, 1] * np.cos(angle), turned[:, 2]], axis=1)  # fmt: skip
    upper = wire("UPPER", along, 101, element=element, backwards=backwards[1])
    return f"""{lower}{upper}{CONDUCTOR}*ELSET, ELSET=WIRES
 LOWER, UPPER
*BEAM SECTION, ELSET=WIRES, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
 1e6
*FRICTION, STICK STIFFNESS=1e5
 0.3
*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*NSET, NSET=ENDS
 101, 108
*BOUNDARY
 1, ENCASTRE
 10, ENCASTRE
 ENDS, 1, 6
*STEP
*STATIC
 0.5, 1
*BOUNDARY
 ENDS, 3, 3, -5e-5
 1, 9, 9, 1e-3
 101, 9, 9, 0
*ENERGY PRINT
*END STEP
*STEP
*STATIC
 0.125, 1, 1e-3, 0.125
*BOUNDARY
 ENDS, 1, 1, {slide}
*END STEP
"""


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_a_wire_may_have_elements_that_run_against_it(run, element):
    """Forces, tractions, currents and energies of a contact that slides from elements of one sense to those of the other."""
    process, forward = run(pressed(element, ((), ())), name="forward")
    assert process.returncode == 0, process.stderr
    process, mixed = run(pressed(element, AGAINST), name="mixed")
    assert process.returncode == 0, process.stderr
    assert np.array_equal(mixed.times, forward.times)
    ours, theirs = mixed.contacts, forward.contacts
    assert len(set(theirs["element_1"])) > 2
    for name in ("id", "element_1", "element_2", "friction", "status"):
        assert list(ours[name]) == list(theirs[name])
    columns = ("force", "gap", "angle", "resistance", "current", "traction_x", "traction_y", "slip_path", "dissipation")
    for name in columns:
        # what the two iterations leave, each a part of 1e-8
        np.testing.assert_allclose(
            ours[name], theirs[name], rtol=1e-6, atol=1e-7 * np.abs(theirs[name]).max(), err_msg=name
        )
    for name in ("ALLWK", "ALLSE", "ALLCCE", "ALLFD"):
        np.testing.assert_allclose(mixed.history[name], forward.history[name], rtol=1e-6)
    np.testing.assert_allclose(mixed.field("reaction_force"), forward.field("reaction_force"), atol=1e-5)
