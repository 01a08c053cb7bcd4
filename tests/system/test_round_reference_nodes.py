"""Bodies that turn about reference nodes far away go along arcs within an increment: what lies on the arc is met, although
start and end of the increment, and the straight way between them, are free of contact."""

import numpy as np
import pytest

from decks import straight, wire

R = 1e-3
MATERIAL = "*MATERIAL, NAME=COPPER\n*ELASTIC\n 120e9, 0.34\n*ELECTRICAL CONDUCTIVITY\n 5.88e7\n"
TOUCH = "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n{}*CONTACT PAIR, INTERACTION=TOUCH\n"
HEAD, DRUM = 3001, 4001


def bar(name, centre, first):
    """A wire along y."""
    x, y, z = centre
    points = straight([x, y - 6 * R, z], [x, y + 6 * R, z], 6)
    section = f"*BEAM SECTION, ELSET={name}, MATERIAL=COPPER, SECTION=CIRC\n {R}\n"
    return wire(name, points, first, element="B33") + section


def body(node, centre, elements):
    x, y, z = centre
    return f"*NODE\n {node}, {x}, {y}, {z}\n*RIGID BODY, REF NODE={node}, TIE NSET={elements}\n"


def turned(node, angle, others="", increments=1):
    size = 1 / increments
    return (
        f"*STEP, INC=500\n*STATIC\n {size}, 1., 1e-6, {size}\n*BOUNDARY, OP=NEW\n{others}"
        f" {node}, 1, 4\n {node}, 6, 6\n {node}, 5, 5, {angle}\n*NODE PRINT, NSET=SEEN\n RF, RM\n*ENERGY PRINT\n*END STEP\n"
    )


@pytest.mark.parametrize(("lever", "angle"), [(0.1, 0.2), (0.05, 0.9), (0.02, 1.5)])
def test_a_rigid_wire_does_not_pass_through_another_one_along_its_arc(run, lever, angle):
    """The other wire stands in the middle of the arc, by 0.6 of a radius off the chord."""
    middle = -lever * np.sin(angle / 2), lever * (1 - np.cos(angle / 2))
    deck = (
        MATERIAL
        + bar("MOVED", [0, 0, 0], 1)
        + bar("FIXED", [middle[0], 0.3 * R, middle[1]], 1001)
        + body(HEAD, [0, 0, lever], "MOVED")
        + f"*NSET, NSET=SEEN\n {HEAD}\n"
        + TOUCH.format("")
        + " MOVED, FIXED\n"
        + turned(HEAD, angle, " FIXED, ENCASTRE\n FIXED, 9\n MOVED, 9\n")
    )
    process, _ = run(deck)
    assert process.returncode == 2
    assert "overlap by" in process.stderr


@pytest.mark.parametrize("angle", [0.9, 1.5, 5.5])
def test_a_cylinder_does_not_orbit_through_a_wire(run, angle):
    lever, half = 20e-3, 0.45
    place = [lever * np.sin(half), 0.0, lever * (1 - np.cos(half))]
    deck = (
        MATERIAL
        + bar("FIXED", place, 1)
        + f"*NODE\n {DRUM}, 0, 0, {lever}\n*NSET, NSET=SEEN\n {DRUM}\n"
        + f"*RIGID SURFACE, NAME=ROD, TYPE=CYLINDER, REF NODE={DRUM}\n 0, 0, 0, 0, 1, 0, {2 * R}\n"
        + TOUCH.format("")
        + " FIXED, ROD\n"
        + turned(DRUM, -angle, " FIXED, ENCASTRE\n FIXED, 9\n")
    )
    process, _ = run(deck)
    assert process.returncode == 2
    assert "overlap by" in process.stderr


@pytest.mark.parametrize("angle", [1.0, 5.0, 2 * np.pi, 4 * np.pi])
def test_the_heat_of_friction_of_a_drum_is_that_of_all_its_turn_in_one_increment(run, angle):
    """A rigid wire is pressed on a drum that turns under it: mu N over the way of its surface."""
    radius, mu = 10 * R, 0.3
    held = f" {HEAD}, 1, 2\n {HEAD}, 4, 6\n {HEAD}, 3, 3, {-2e-3 * R}\n"
    points = straight([-8 * R, 0, 0], [8.6 * R, 0, 0], 8)
    deck = (
        MATERIAL
        + wire("BELT", points, 1, element="B33")
        + f"*BEAM SECTION, ELSET=BELT, MATERIAL=COPPER, SECTION=CIRC\n {R}\n"
        + body(HEAD, [0, 0, 0], "BELT")
        + f"*NODE\n {DRUM}, 0, 0, {-radius - R}\n*NSET, NSET=SEEN\n {HEAD}\n"
        + f"*RIGID SURFACE, NAME=DRUM, TYPE=CYLINDER, REF NODE={DRUM}\n 0, 0, {-radius - R}, 0, 1, 0, {radius}\n"
        + TOUCH.format(f"*FRICTION\n {mu}\n")
        + " BELT, DRUM\n"
        + turned(DRUM, 0.0, held + " BELT, 9\n", 4)
        + turned(DRUM, angle, held + " BELT, 9\n")
    )
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    history = results.history
    force = results.field("reaction_force")[-2]
    assert abs(force[2]) > 1
    assert abs(force[0]) == pytest.approx(mu * abs(force[2]), rel=1e-3)
    heat = history["ALLFD"][-1]
    assert heat == pytest.approx(mu * abs(force[2]) * radius * angle, rel=1.2e-2)
    assert np.ptp(history["ETOTAL"]) < 2e-2 * heat
