"""A wire may touch itself wherever it has turned far enough to come back, however near along it, and nowhere else."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from decks import straight, wire

RADIUS = 1e-3
#: Penalties at crossings [N/m] and along lines [N/m^2]
PENALTY, LINE_PENALTY = 1e7, 2e9


def model(points, *, closed=False, contact=True, element="B33"):
    """A wire through points that may touch itself."""
    pair = "*CONTACT PAIR, INTERACTION=TOUCH\n WIRE\n" if contact else ""
    law = f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {PENALTY}, {LINE_PENALTY}\n"
    return (
        wire("WIRE", points, closed=closed, element=element)
        + f"*MATERIAL, NAME=SOFT\n*ELASTIC\n 1e9, 0.3\n*BEAM SECTION, ELSET=WIRE, MATERIAL=SOFT, SECTION=CIRC\n {RADIUS}\n"
        + (law if contact else "")
        + pair
    )


def moved(points, to):
    """Cards that hold all nodes of a wire and move them to other points, rotations held."""
    lines = [f" {1 + i}, {d + 1}, {d + 1}, {v:.17g}" for i, u in enumerate(to - points) for d, v in enumerate(u)]
    return "*BOUNDARY\n WIRE, 4, 6\n*STEP\n*STATIC\n 0.5, 1\n*BOUNDARY\n" + "\n".join(lines) + "\n*END STEP\n"


def step(prescribed, static="0.1, 1, 1e-5, 0.1"):
    return f"*STEP, INC=300\n*STATIC\n {static}\n*BOUNDARY\n{prescribed}*END STEP\n"


def coil(radius, pitch, turns, per_turn=24):
    angle = np.linspace(0, 2 * np.pi * turns, turns * per_turn + 1)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), pitch * angle / (2 * np.pi)], axis=1)


def distance_of_turns(radius, pitch):
    """Least distance of the axis of a coil from its next turn [m]: to one side it is nearer than straight above."""

    def square(angle):
        return (2 * radius * np.sin(angle / 2)) ** 2 + (pitch * angle / (2 * np.pi)) ** 2

    return np.sqrt(
        minimize_scalar(square, bounds=(1.5 * np.pi, 2.2 * np.pi), method="bounded", options={"xatol": 1e-10}).fun
    )


@pytest.mark.parametrize("radius", [1.2 * RADIUS, 5 * RADIUS], ids=["turns of less than 8 radii", "long turns"])
def test_a_coil_with_closed_turns_touches_itself_turn_by_turn(run, radius):
    """All nodes are lowered together until the turns overlap by 0.4 % of the diameter: the law along a line."""
    turns, per_turn = 4, 24
    pitch = 2 * RADIUS / distance_of_turns(radius, 2 * RADIUS) * 2 * RADIUS
    points = coil(radius, 1.001 * pitch, turns, per_turn)
    pressed = coil(radius, 0.996 * pitch, turns, per_turn)
    process, results = run(model(points) + moved(points, pressed))
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    overlap = 2 * RADIUS - distance_of_turns(radius, 0.996 * pitch)
    # the tangents at the ends of the coil are known less well, and there places stand for half a part
    first, last = np.sort([contacts["element_1"], contacts["element_2"]], axis=0)
    inner = (first > 1) & (last < per_turn * turns)
    # elements of 15 degrees leave the helix by 1e-4 of the radius of the wire, 2 % of this overlap
    assert (contacts["force"] / contacts["length"])[inner] == pytest.approx(LINE_PENALTY * overlap, rel=0.03)
    # each place touches the next turn, or the one before, and no other place
    assert np.all((last - first >= per_turn - 3) & (last - first <= per_turn + 1))
    # three gaps between four turns; the ends of the lines are known to the distance of the places
    turn = np.hypot(2 * np.pi * radius, pitch)
    assert contacts["length"].sum() == pytest.approx(turn * (turns - 1), abs=3 * RADIUS)


def test_a_spring_whose_turns_come_near_each_other_stays_open(run):
    """Places get a foot on the next turn and on the one before at different times, and neither is the other one."""
    turns, per_turn, gap = 4, 24, 1.3 * RADIUS
    points = coil(6 * RADIUS, 2 * RADIUS + gap, turns, per_turn)
    last = len(points)
    held = f"*BOUNDARY\n 1, ENCASTRE\n {last}, 1, 2\n {last}, 4, 6\n"
    process, results = run(model(points) + held + step(f" {last}, 3, 3, {-0.75 * turns * gap:.17g}\n"))
    assert process.returncode == 0, process.stderr
    assert len(results.contacts["force"]) == 0


def test_the_legs_of_a_hairpin_touch_along_a_line(run):
    """Parts of both legs, 20 mm long, are led together with their clamps: law along their length."""
    bend, leg, n, led = 4 * RADIUS, 40 * RADIUS, 16, 8
    angle = np.linspace(np.pi / 2, -np.pi / 2, 15)
    round_end = np.stack([leg + bend * np.cos(angle), bend * np.sin(angle), 0 * angle], axis=1)
    upper, lower = straight((0, bend, 0), (leg, bend, 0), n), straight((leg, -bend, 0), (0, -bend, 0), n)
    points = np.concatenate([upper[:-1], round_end, lower[1:]])
    first, last = range(1, led + 2), range(len(points) - led, len(points) + 1)
    overlap = 0.02 * RADIUS
    by = bend - RADIUS + overlap / 2
    held = "*BOUNDARY\n" + "".join(f" {i}, 1, 6\n" for i in (*first, *last))
    prescribed = [f" {i}, 2, 2, {-by:.17g}\n" for i in first] + [f" {i}, 2, 2, {by:.17g}\n" for i in last]
    process, results = run(model(points) + held + step("".join(prescribed)))
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    pressed = contacts["force"] / contacts["length"]
    between = np.maximum(contacts["point_1_x"], contacts["point_2_x"]) < led * leg / n
    assert pressed[between] == pytest.approx(LINE_PENALTY * overlap, rel=1e-6)
    # the led parts touch all along, and the legs part soon after
    assert led * leg / n < contacts["length"].sum() < led * leg / n + 6 * RADIUS
    # the legs hold each other: what is led up is pushed down
    reaction = results.field("reaction_force")[:, 1]
    assert reaction.sum() == pytest.approx(0, abs=1e-6 * contacts["force"].sum())


@pytest.mark.parametrize("begins", [0, 1, 36], ids=["at the contact", "beside it", "opposite"])
def test_a_ring_that_is_pinched_touches_itself_wherever_its_elements_begin(run, begins):
    """Two opposite nodes are moved together beyond first contact: what the contact takes is added to the forces."""
    n, radius, overlap = 72, 10 * RADIUS, 0.02 * RADIUS
    angle = np.pi / 2 + 2 * np.pi * (np.arange(n) + begins) / n
    points = radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    top, bottom = (n - begins) % n + 1, (n - begins + n // 2) % n + 1
    by = radius - RADIUS + overlap / 2
    held = f"*BOUNDARY\n {top}, 1, 1\n {bottom}, 1, 1\n WIRE, 3, 5\n"
    prescribed = step(f" {top}, 2, 2, {-by:.17g}\n {bottom}, 2, 2, {by:.17g}\n")
    process, results = run(model(points, closed=True) + held + prescribed)
    assert process.returncode == 0, process.stderr
    contact = results.contacts_at(-1)
    assert contact["force"] == pytest.approx([PENALTY * overlap], rel=1e-9)
    process, open_results = run(model(points, closed=True, contact=False) + held + prescribed, name="open")
    assert process.returncode == 0, process.stderr
    forces = [of.field("reaction_force")[top - 1, 1] for of in (results, open_results)]
    assert forces[0] - forces[1] == pytest.approx(-PENALTY * overlap, rel=1e-6)


@pytest.mark.parametrize("n", [8, 80], ids=["long elements", "elements of a fifth of a radius"])
def test_a_bent_wire_has_no_contact_with_itself(run, n):
    """Rolled up to 288 degrees with a radius of three wire radii: its ends come no nearer than 3.5 radii."""
    bend = 3 * RADIUS
    length = 0.8 * 2 * np.pi * bend
    moment = 1e9 * np.pi * RADIUS**4 / 4 / bend
    process, results = run(
        model(straight((0, 0, 0), (length, 0, 0), n))
        + "*BOUNDARY\n 1, ENCASTRE\n*STEP, INC=100\n*STATIC\n 0.05, 1, 1e-3, 0.05\n"
        + f"*CLOAD\n {n + 1}, 6, {moment:.17g}\n*END STEP\n"
    )
    assert process.returncode == 0, process.stderr
    assert len(results.contacts["force"]) == 0
    assert not results.warnings


def test_a_wire_that_is_bent_into_a_loop_touches_itself_where_it_crosses(run):
    """An arch of 100 degrees, whose legs are led across each other and pressed together; nothing comes back at first."""
    bend, leg, half, lift, across = 20 * RADIUS, 40 * RADIUS, np.radians(50), 1.5 * RADIUS, 15 * RADIUS
    angle = np.linspace(-half, half, 17)
    arch = bend * np.stack([np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    right = straight(arch[-1], arch[-1] + leg * np.array([np.cos(half), -np.sin(half), 0]), 12)[1:]
    points = np.concatenate([(right * [-1, 1, 1])[::-1], arch, right])
    last, x = len(points), right[-1, 0]

    def ends(dx, dz):
        return f" 1, 1, 1, {dx:.17g}\n {last}, 1, 1, {-dx:.17g}\n 1, 3, 3, {dz:.17g}\n {last}, 3, 3, {-dz:.17g}\n"

    held = "".join(f" {node}, 2, 2\n {node}, 4, 5\n" for node in (1, last))
    press = 3 * RADIUS
    process, results = run(
        model(points)
        + f"*BOUNDARY\n{held}"
        + step(ends(0, lift), "1, 1")
        + step(ends(x + across, lift), "0.05, 1, 1e-5, 0.05")
        + step(ends(x + across, -press), "0.1, 1, 1e-5, 0.1")
    )
    assert process.returncode == 0, process.stderr
    contact = results.contacts_at(-1)
    assert len(contact["force"]) == 1
    # half a turn about the y axis leaves the loop as it is
    assert contact["point_1_x"] == pytest.approx(-contact["point_2_x"], abs=1e-6 * RADIUS)
    assert contact["force"] == pytest.approx(-PENALTY * contact["gap"], rel=1e-9)


def test_a_bend_tighter_than_the_wire_is_thick_is_named_and_no_contact(run):
    """A quarter turn with a radius of half the wire's: a warning, and neither contact nor error."""
    process, results = run(bent_to(0.25, 0.5 * RADIUS))
    assert process.returncode == 0, process.stderr
    assert len(results.contacts["force"]) == 0
    (warning,) = [entry for entry in results.warnings if entry.kind == "tight_bend"]
    assert "bent more tightly than they are thick" in warning.message


def test_a_bend_whose_sides_overlap_ends_the_run(run):
    """A turn of 160 degrees with a radius of half the wire's: its legs lie in each other, and no law is for that."""
    process, _ = run(bent_to(160 / 360, 0.5 * RADIUS))
    assert process.returncode == 2
    assert "is bent more tightly than it is thick: the sides of the bend overlap" in process.stderr
    assert "model a thinner one" in process.stderr


def bent_to(turns, bend):
    """A wire whose middle is led into a bend; its nodes and their rotations are prescribed."""
    n, leg, arc = 16, 6 * RADIUS, 2 * np.pi * turns * bend
    s = np.concatenate([np.linspace(-leg - arc / 2, -arc / 2, 9)[:-1], np.linspace(-arc / 2, arc / 2, n + 1)])
    s = np.concatenate([s, np.linspace(arc / 2, leg + arc / 2, 9)[1:]])
    points = np.stack([s, 0 * s, 0 * s], axis=1)
    prescribed, increments = [], 20
    angle = np.clip(s, -arc / 2, arc / 2) / bend
    x = bend * np.sin(angle) + (s - np.clip(s, -arc / 2, arc / 2)) * np.cos(angle)
    y = bend * (1 - np.cos(angle)) + (s - np.clip(s, -arc / 2, arc / 2)) * np.sin(angle)
    for i in range(len(s)):
        moves = ((1, x[i] - s[i]), (2, y[i]), (6, angle[i]))
        prescribed += [f" {i + 1}, {d}, {d}, {v:.17g}\n" for d, v in moves]
    return (
        model(points)
        + "*BOUNDARY\n WIRE, 3, 5\n"
        + step("".join(prescribed), f"{1 / increments}, 1, 1e-3, {1 / increments}")
    )
