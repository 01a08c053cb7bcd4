"""A wire that crosses itself: the force is that of two wires, wherever along the wire its ends are."""

import numpy as np
import pytest

from decks import CONDUCTOR, wire

RADIUS, LOOP = 1e-3, 0.01
PENALTY, OVERLAP = 1e6, 2e-6
#: Resistance of the contact [ohm]
SPOT = 1e-5
#: Nodes of a straight leg
LEG = 12


def looped():
    """Points, and the number of those before the second leg.

    They go along x, three quarters of a round turn, and back across over the first leg: they cross at the
    origin. The height rises along the turn by a diameter; both legs are straight and level.
    """
    leg = np.linspace(-LOOP, LOOP, LEG)
    first = np.stack([leg, 0 * leg, 0 * leg], axis=1)
    angle = np.linspace(-np.pi / 2, np.pi, 36)[1:-1]
    rise = 2 * RADIUS * (angle + np.pi / 2) / (1.5 * np.pi)
    turn = np.stack([LOOP + LOOP * np.cos(angle), LOOP + LOOP * np.sin(angle), rise], axis=1)
    second = np.stack([0 * leg, -leg, 0 * leg + 2 * RADIUS], axis=1)
    return np.concatenate([first, turn, second]), len(first) + len(turn)


def pressed(backwards=(), pair="WIRE, WIRE"):
    """All nodes are held; those of the second leg are lowered onto the first one."""
    points, upper = looped()
    nodes = "".join(f" {1 + i}\n" for i in range(upper, len(points)))
    return f"""{wire("WIRE", points, element="B33", backwards=backwards)}*NSET, NSET=UPPER
{nodes}{CONDUCTOR}*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC
 {RADIUS}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
 {PENALTY}
*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT
 {SPOT}
*CONTACT PAIR, INTERACTION=TOUCH
 {pair}
*BOUNDARY
 WIRE, ENCASTRE
*STEP
*STATIC
 0.5, 1
*BOUNDARY
 UPPER, 3, 3, {-OVERLAP}
 1, 9, 9, 1e-3
 {len(points)}, 9, 9, 0
*END STEP
"""


@pytest.mark.parametrize("backwards", [(), (3, 4, 20), tuple(range(30, 45))], ids=["forward", "some", "a leg"])
@pytest.mark.parametrize("pair", ["WIRE, WIRE", "WIRE"])
def test_a_wire_presses_on_itself_where_its_legs_cross(run, backwards, pair):
    process, results = run(pressed(backwards, pair))
    assert process.returncode == 0, process.stderr
    contact = results.contacts_at(-1)
    assert contact["force"] == pytest.approx([PENALTY * OVERLAP], rel=1e-9)
    assert contact["angle"] == pytest.approx([np.pi / 2], rel=1e-9)
    assert [contact[f"point_{axis}"][0] for axis in "xy"] == pytest.approx([0, 0], abs=1e-12)
    # the supports hold the lower leg up and the upper one down
    _, upper = looped()
    reaction = results.field("reaction_force")[:, 2]
    assert reaction[:LEG].sum() == pytest.approx(PENALTY * OVERLAP, rel=1e-9)
    # bent where the second leg begins, and so not held by the contact alone
    assert reaction[upper + 2 :].sum() == pytest.approx(-PENALTY * OVERLAP, rel=1e-9)


def test_the_contact_bridges_the_loop(run):
    """The current takes the loop and the contact side by side: Ohm's law."""
    process, results = run(pressed())
    assert process.returncode == 0, process.stderr
    per_length = 1 / (5e7 * np.pi * RADIUS**2)
    helix = np.hypot(1.5 * np.pi * LOOP, 2 * RADIUS)
    loop = per_length * (2 * LOOP + helix)
    bridge = loop * SPOT / (loop + SPOT)
    total = 1e-3 / (per_length * 2 * LOOP + bridge)
    # elements of 7.7 degrees are shorter than the arc by less than 1e-5
    assert results.field("reaction_current")[0] == pytest.approx(total, rel=1e-4)
    assert abs(results.contacts_at(-1)["current"][0]) == pytest.approx(total * loop / (loop + SPOT), rel=1e-4)
