"""Contact at the ends of wires, which are round, and at kinks, which are round joints: against closed forms, and what must
hold while a contact slides on to an end, off it, and over a kink."""

import math

import numpy as np
import pytest
from verification.references.hertz import crossed_wires, effective_modulus, end_on_end, end_on_wire
from verification.references.parallel_wires import ParallelWires

from decks import wire
from line_wires import COPPER, HERTZ, LOWER, STEEL, linear, spot, step, two_wires
from same_results import assert_same_end, keeping

#: Overlap that the wires are moved by [m]
OVERLAP = 1e-7
VOLT = "*BOUNDARY\n LOWER, 9, 9, 1.\n UPPER, 9, 9, 0.\n"


def hertz(wires):
    """What the references need of the two wires: the first of them is the one that ends."""
    return {
        "radius": [each.radius for each in wires],
        "modulus": effective_modulus([each.young for each in wires], [each.poisson for each in wires]),
        "resistivity": [each.resistivity for each in wires],
    }


def force_for(overlap, spot_of, wires):
    """Force that makes this overlap: it goes with its power of 3/2 [N]."""
    return (overlap / spot_of(1.0, **hertz(wires)).approach) ** 1.5


def from_tip(tip, direction, n=6, length=0.012):
    """Points of a wire that leads from its tip in a direction."""
    direction = np.array(direction) / np.linalg.norm(direction)
    return np.array(tip) + np.outer(np.linspace(0, length, n + 1), direction)


def solved(outcome):
    """Results of a run that went well, without a warning."""
    process, results = outcome
    assert process.returncode == 0, process.stderr
    assert results.warnings == []
    return results


def moved(*motions, name="UPPER", increments=1):
    """A step in which all nodes of a wire move by [m], in the directions 1 to 3."""
    boundary = "".join(f" {name}, {d}, {d}, {u:.17g}\n" for d, u in enumerate(motions, start=1))
    return step(static=f"{1 / increments}, 1., 1e-9, {1 / increments}", boundary=boundary)


#: Everything of both wires is led, rotations stay
HELD = "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, ENCASTRE\n LOWER, 9\n UPPER, 9\n"
ALONG_X = np.linspace((-0.01, 0, 0), (0.01, 0, 0), 10)


@pytest.mark.parametrize("pair", ["LOWER, UPPER", "UPPER, LOWER"])
@pytest.mark.parametrize("degrees", [90, 60, 30])
def test_the_end_of_a_wire_on_the_side_of_another_is_a_sphere_on_a_cylinder(run, degrees, pair):
    wires = (STEEL, COPPER)
    distance = STEEL.radius + COPPER.radius
    lean = np.radians(degrees)
    tip = from_tip((0.0003, 0, distance), (np.cos(lean), 0.3, np.sin(lean) * 1.2))
    push = moved(0, 0, -OVERLAP).replace("*END STEP\n", VOLT + "*END STEP\n")
    deck = two_wires(ALONG_X, tip, HELD, push, wires=(COPPER, STEEL), pairs=(pair,), law=HERTZ + spot("HERTZ"))
    contacts = solved(run(deck)).contacts_at(-1)
    force = force_for(OVERLAP, end_on_wire, wires)
    assert len(contacts["force"]) == 1
    # the force is that of Hertz for the overlap along the normal, here along z
    assert contacts["force"][0] == pytest.approx(force, rel=1e-6)
    assert contacts["resistance"][0] == pytest.approx(end_on_wire(force, **hertz(wires)).resistance, rel=1e-6)
    sign = 1 if pair.startswith("UPPER") else -1
    assert sign * contacts["normal_z"][0] == pytest.approx(1, abs=1e-6)


def test_two_ends_are_two_spheres(run):
    wires = (STEEL, COPPER)
    apart = np.array([0.6, 0.0, 0.8]) * (STEEL.radius + COPPER.radius)
    lower = from_tip((0, 0, 0), (-1, 0.2, -0.5))
    upper = from_tip(apart, (0.3, 0.1, 1))
    deck = two_wires(lower, upper, HELD, moved(*(-OVERLAP * np.array([0.6, 0, 0.8]))), wires=(COPPER, STEEL))
    contacts = solved(run(deck)).contacts_at(-1)
    assert contacts["force"] == pytest.approx([force_for(OVERLAP, end_on_end, wires)], rel=1e-6)


@pytest.mark.parametrize(
    ("degrees", "law"),
    [
        *((each, law) for each in (90, 30, 5, 2) for law in (HERTZ, linear("", 1e10))),
        (90, linear(1e5)),
        (30, linear(1e5)),
    ],
)
def test_a_crossing_slides_off_the_end_of_a_wire_without_a_jump(run, degrees, law):
    """The force falls from that of crossed wires to zero; half way there, the wires cross at the very end."""
    angle = np.radians(degrees)
    distance = 2 * COPPER.radius
    reach = math.sqrt(2 * distance * OVERLAP) / math.sin(angle)
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 9)
    t = np.array([np.cos(angle), np.sin(angle), 0])
    upper = np.array([-2 * reach, 0, distance - OVERLAP]) + np.outer(np.linspace(-0.0151, 0.0149, 13), t)
    increments = 80
    deck = two_wires(lower, upper, HELD, moved(4 * reach, increments=increments), law=law)
    results = solved(run(deck))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    # 2 half lengths before the end nothing is felt of it, 1 half length behind it nothing is left
    # (lenses that places resolve: to their ripple)
    assert force[:19] == pytest.approx(force[0], rel=1e-9 if degrees > 2 else 5e-3)
    assert np.all(force[61:] == 0)
    # the force of the cylinder falls as (2 + 3u - u^3)/4, by at most 3/4 of a step of u = 1/20, a penalty at the end as
    # 1 - u^2; what the one loses first the other has a little later: 1 %
    assert np.max(-np.diff(force)) < (0.1 if law == linear(1e5) else 0.08) * force[0]
    assert np.max(np.diff(force)) < 0.01 * force[0]
    if law == HERTZ and degrees >= 30:
        wires = (COPPER, COPPER)
        crossing = (OVERLAP / crossed_wires(1.0, angle, **hertz(wires)).approach) ** 1.5
        assert force[0] == pytest.approx(crossing, rel=1e-6)
        # at the very end cylinder and round end have a half each
        assert force[39] == pytest.approx((crossing + force_for(OVERLAP, end_on_wire, wires)) / 2, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("law", [HERTZ, linear("", 1e10)])
@pytest.mark.parametrize(
    ("degrees", "left", "error"),
    [(90, None, 1e-3), (45, None, 1e-3), (13, None, 1e-3), (90, 0.3, 1e-3), (10, 0.3, 0.02), (10, -0.3, 0.02)],
)
def test_what_a_contact_holds_is_work_of_the_way_on_which_it_slides_off(run, degrees, left, error, law):
    """Both wires are led, so that the supports do all of the work, and ETOTAL stays what it was when the slide began: to
    the error of means of forces over increments, a quarter per mille. Where the other wire ends, too, `left` half
    lengths behind the crossing (negative: before it), the parts at both ends go over into each other to two per cent."""
    angle = np.radians(degrees)
    distance = 2 * COPPER.radius
    reach = math.sqrt(2 * distance * 1e-6) / math.sin(angle)
    s = np.linspace(-0.0151, 0.0149, 13)
    if left is not None:
        s = np.linspace(*sorted((-math.copysign(0.03, left), left * reach)), 13)
    upper = np.array([-2 * reach, 0, distance]) + np.outer(s, [np.cos(angle), np.sin(angle), 0])
    print_energy = "*ENERGY PRINT\n*END STEP"
    steps = [moved(0, 0, -1e-6), moved(4 * reach, 0, -1e-6, increments=160)]
    deck = two_wires(np.linspace((-0.02, 0, 0), (0, 0, 0), 9), upper, HELD, *steps, law=law)
    history = solved(run(deck.replace("*END STEP", print_energy))).history
    held = history["ALLCCE"][1]
    assert history["ALLCCE"][-1] == 0
    assert np.abs(history["ETOTAL"][2:] - history["ETOTAL"][1]).max() < error * held
    force = -held  # nothing of the energy is left: the supports have got all of it
    assert history["ALLWK"][-1] - history["ALLWK"][1] == pytest.approx(force, rel=error)


def kinked(degrees, n=6, length=0.012):
    """A wire along x with a kink in the origin, the legs of which fall to both sides."""
    fall = np.radians(degrees) / 2
    s = np.linspace(0, length, n + 1)[:, None]
    left, right = np.array([-np.cos(fall), 0, -np.sin(fall)]), np.array([np.cos(fall), 0, -np.sin(fall)])
    return np.concatenate([s[::-1] * left, s[1:] * right])


def carried_over(degrees, law, increments):
    """A rod across that is carried over a kink at the same overlap; its path is straight, round the kink, and straight."""
    fall, distance = np.radians(degrees) / 2, 2 * COPPER.radius - OVERLAP
    round_the_kink = np.linspace(-fall, fall, increments - 9)
    path = distance * np.column_stack([np.sin(round_the_kink), 0 * round_the_kink, np.cos(round_the_kink)])
    outward = np.linspace(1, 0, 6)[:-1, None] * 4e-5
    before = path[0] + outward * [-np.cos(fall), 0, -np.sin(fall)]
    after = path[-1] + outward[::-1] * [np.cos(fall), 0, -np.sin(fall)]
    path = np.concatenate([before, path, after])
    rod = path[0] + np.outer(np.linspace(-0.0121, 0.0119, 11), [0, 1, 0])
    times = np.linspace(0, 1, len(path))
    amplitudes = ""
    for d in (0, 2):
        rows = zip(times, path[:, d] - path[0, d], strict=True)
        amplitudes += f"*AMPLITUDE, NAME=P{d + 1}\n" + "".join(f" {t:.17g}, {u:.17g}\n" for t, u in rows)
    motion = "".join(f"*BOUNDARY, AMPLITUDE=P{d}\n UPPER, {d}, {d}, 1.\n" for d in (1, 3))
    static = f"*STATIC\n {times[1]:.17g}, 1., 1e-9, {times[1]:.17g}\n"
    return two_wires(kinked(degrees), rod, HELD, amplitudes, f"*STEP, INC=500\n{static}{motion}*END STEP\n", law=law)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [90, 30])
def test_a_rod_slides_over_a_kink_without_a_jump(run, degrees):
    results = solved(run(carried_over(degrees, HERTZ, 100)))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    assert all(len(results.contacts_at(i)["force"]) == 1 for i in range(1, len(results.times)))
    wires = (COPPER, COPPER)
    crossing = (OVERLAP / crossed_wires(1.0, np.pi / 2, **hertz(wires)).approach) ** 1.5
    joint = force_for(OVERLAP, end_on_wire, wires)
    assert force[0] == pytest.approx(crossing, rel=1e-5)
    assert force[-1] == pytest.approx(crossing, rel=1e-5)
    assert force.min() == pytest.approx(joint, rel=1e-5 if degrees > 60 else 0.01)
    # symmetric about the middle of the path, which begins with a state before the first increment, but for parts of
    # cylinder and joint that are 0.002 old
    assert force[:-1] == pytest.approx(force[-2::-1], rel=5e-3)
    assert np.max(np.abs(np.diff(force))) < 0.75 * (crossing - joint)


def largest_step(values):
    """Of a curve, what stands alone against its slope on both sides, over its largest value."""
    slope = np.diff(values)
    alone = slope[1:-1] - np.array([slope[:-2], slope[2:]])
    return np.where(alone[0] * alone[1] > 0, np.abs(alone).min(axis=0), 0).max() / values.max()


def dragged_past_the_end(degrees, overlap, behind, law, begin=-0.4, end=1.4, increments=80):
    """Wires at a small angle, of which the other one goes on or begins some radii `behind` the crossing. That is moved past
    the end, from and to these half lengths of the overlap, whose depth is in radii."""
    angle, radius = np.radians(degrees), COPPER.radius
    reach = math.sqrt(4 * overlap) * radius / np.sin(angle)
    along = np.linspace(-0.0151 if behind is None else -behind * radius, 0.0149, 12)
    upper = np.array([begin * reach, 0, 2 * radius]) + np.outer(along, [np.cos(angle), np.sin(angle), 0])
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 9)
    down = f" UPPER, 3, 3, {-overlap * radius:.17g}\n"
    static = f"{1 / increments:.17g}, 1., 1e-9, {1 / increments:.17g}"
    drag = step(static=static, boundary=f" UPPER, 1, 1, {(end - begin) * reach:.17g}\n{down}")
    return two_wires(lower, upper, HELD, step(boundary=down), drag, law=law + spot("HERTZ"))


def totals(results):
    """Force [N] and conductance [S] of all contacts, by increment."""
    contacts = [results.contacts_at(i) for i in range(1, len(results.times))]
    return [np.array([values.sum() for values in each]) for each in (
        [c["force"] for c in contacts], [1 / c["resistance"] for c in contacts],
    )]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("degrees", "overlap", "behind", "law"),
    [
        (2, 0.002, None, HERTZ),
        (5, 0.01, None, HERTZ),
        (5, 0.01, 3, HERTZ),
        (5, 0.01, None, linear("", 1e10)),
        (10, 0.02, 2, HERTZ),
        (10, 0.02, 0.5, linear("", 1e10)),
        (13, 0.02, 1, HERTZ),
    ],
)
def test_the_force_past_the_end_of_a_wire_falls_without_a_step(run, degrees, overlap, behind, law):
    force, conductance = totals(solved(run(dragged_past_the_end(degrees, overlap, behind, law))))
    assert largest_step(force) < 0.015
    # at last touch conductance falls with infinite slope
    assert largest_step(conductance[force > 0]) < 0.015


@pytest.mark.parametrize(
    ("degrees", "behind", "middle", "times"),
    [
        # the crossing comes to the end, and is held there
        (13, 1, 0, 10),
        # what is left between both ends becomes shorter than the distance of places
        (10, 0.5, 0.095, 10),
        # the wires end beside each other, where the force rises for a moment: see docs/limits.md
        (10, 0.5, 0.3, 20),
    ],
)
def test_a_contact_between_two_ends_changes_its_kind_without_a_step(run, degrees, behind, middle, times):
    """Over a thousandth of its half length a contact changes as by sliding off, which takes 1.5 half lengths, and no more:
    by ten times the mean."""
    deck = dragged_past_the_end(degrees, 0.02, behind, HERTZ, middle - 0.02, middle + 0.02, 40)
    force, conductance = totals(solved(run(deck)))
    for values in (force, conductance):
        assert np.abs(np.diff(values[1:])).max() < times / 1500 * values.max()


def test_a_lap_ends_where_the_wires_end(run):
    """The force of two wires that lie along each other goes with the length of their lap, wherever their nodes are:
    what their round ends add beside that stays, and the sections bound the far field of more than six radii."""
    distance = 2 * COPPER.radius - OVERLAP
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 14)
    upper = np.linspace((-0.008, 0, distance), (0.012, 0, distance), 18)
    slide = 0.8 * COPPER.radius
    results = solved(run(two_wires(lower, upper, HELD, moved(slide, increments=40))))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    per_length = ParallelWires(COPPER, COPPER).force(OVERLAP)
    assert np.diff(force) == pytest.approx(-per_length * slide / 40, rel=1e-7)
    of_ends = force[-1] - per_length * (0.008 - slide)
    assert of_ends == pytest.approx(float(force_for(OVERLAP, end_on_wire, (COPPER, COPPER))), rel=1e-5)


@pytest.mark.parametrize("pair", ["LOWER, UPPER", "UPPER, LOWER"])
def test_an_end_that_is_dragged_along_a_wire_sticks_and_then_slips(run, pair):
    """A rigid drag of the tip: at first the traction grows with the slip, in the end it is mu F against the motion."""
    friction = "*FRICTION\n 0.3\n"
    tip = from_tip((0.0003, 0, COPPER.radius + STEEL.radius), (0.2, 0.1, 1))
    deck = two_wires(
        ALONG_X, tip, HELD, moved(0, 0, -OVERLAP), moved(2e-7, 0, -OVERLAP, increments=20),
        wires=(COPPER, STEEL), law=HERTZ + friction, pairs=(pair,),
    )  # fmt: skip
    results = solved(run(deck))
    contacts = [results.contacts_at(i) for i in range(2, len(results.times))]
    traction = np.array([each["traction_x"][0] for each in contacts])
    if pair.startswith("LOWER"):
        # the traction is that on the barred wire, which is the one that stays
        traction = -traction
    normal = contacts[-1]["force"][0]
    assert np.all(np.diff(traction) <= 1e-12)
    assert traction[0] == pytest.approx(traction[1] / 2, rel=1e-3)
    assert traction[-1] == pytest.approx(-0.3 * normal, rel=1e-9)
    assert contacts[-1]["friction"][0] == contacts[-2]["friction"][0] != contacts[0]["friction"][0]


def test_a_contact_that_slides_on_to_an_end_keeps_its_identity_and_its_friction(run):
    """A crossing that sticks, and is carried to the end of its wire by steps that are small beside its stick."""
    angle, distance = np.pi / 2, 2 * COPPER.radius
    reach = math.sqrt(2 * distance * OVERLAP)
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 9)
    upper = np.array([-0.3 * reach, 0, distance - OVERLAP]) + np.outer(
        np.linspace(-0.0151, 0.0149, 13), [0, np.sin(angle), 0]
    )
    drag = 0.6 * reach
    deck = two_wires(lower, upper, HELD, moved(drag, increments=60), law=HERTZ + "*FRICTION, ELASTIC SLIP=1e-4\n 5.\n")
    results = solved(run(deck))
    contacts = [results.contacts_at(i) for i in range(1, len(results.times))]
    assert {each["id"][0] for each in contacts} == {1}
    traction = np.array([each["traction_x"][0] for each in contacts])
    force = np.array([each["force"][0] for each in contacts])
    # what sticks with the stiffness mu F/(elastic slip) has the traction of the way that it has been dragged
    stiffness = 5.0 * force / 1e-4
    assert np.abs(np.diff(traction)).max() < 2.5 * np.abs(stiffness * drag / 60).max()
    assert np.sign(traction[5:]).tolist() == [np.sign(traction[5])] * len(traction[5:])


def test_a_contact_at_an_end_goes_on_from_a_restart_file(run, litz, tmp_path):
    tip = from_tip((0.0003, 0, COPPER.radius + STEEL.radius), (0.2, 0.1, 1))
    steps = [moved(0, 0, -OVERLAP), moved(2e-7, 0, -OVERLAP, increments=4)]
    deck = keeping(two_wires(ALONG_X, tip, HELD, *steps, wires=(COPPER, STEEL), law=HERTZ + "*FRICTION\n 0.3\n"))
    whole = solved(run(deck, name="whole"))
    kept = tmp_path / "whole" / "whole.restart.h5"
    part = solved(run(deck, "--restart", f"{kept}:2:2", name="part"))
    assert_same_end(whole, part, 2, 2)


def test_a_cantilever_rests_on_a_wire_with_its_end(run):
    """The tip is exactly above a wire across: what the contact does not carry of the load, the cantilever does."""
    lower = np.linspace((0, -0.01, 0), (0, 0.01, 0), 10)
    upper = np.linspace((0.0, 0.0, 2 * COPPER.radius), (0.02, 0, 2 * COPPER.radius), 11)
    supports = "*BOUNDARY\n LOWER, ENCASTRE\n 1011, ENCASTRE\n LOWER, 9\n UPPER, 9\n"
    load = 0.01
    results = solved(run(two_wires(lower, upper, supports, step(f"*CLOAD\n 1001, 3, {-load}\n", static="0.25, 1."))))
    contacts = results.contacts_at(-1)
    stiffness = 3 * COPPER.young * math.pi * COPPER.radius**4 / 4 / 0.02**3
    # both neglect that the cantilever turns its end about the wire, where the pressure is off its middle by part of the spot
    assert contacts["force"].sum() == pytest.approx(load + stiffness * contacts["gap"][0], rel=1e-4)


def test_kinks_bring_no_warning(run):
    solved(run(two_wires(kinked(60), ALONG_X + np.array([0, 0.005, 0.004]), HELD, moved(0, 0, -1e-4))))


def test_a_wire_is_wire_again_behind_its_kink(run):
    """Nothing of the law of the joint is felt more than a lens away from it."""
    results = solved(run(carried_over(60, linear(1e5), 100)))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    assert force == pytest.approx(1e5 * OVERLAP, rel=1e-6)


def side_by_side(gap_or_lap, overlap=5e-6, degrees=0.0):
    """Two wires that lie along each other, one of which ends about where the other one begins; the latter may be turned."""
    angle = np.radians(degrees)
    distance = 2 * COPPER.radius + 1e-6
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 11)
    upper = np.array([-gap_or_lap, 0, distance]) + np.outer(np.linspace(0, 0.02, 11), [np.cos(angle), np.sin(angle), 0])
    return two_wires(lower, upper, HELD, moved(0, 0, -1e-6 - overlap))


@pytest.mark.parametrize("degrees", [0, 5])
def test_wires_that_lie_end_by_end_touch_like_spheres_and_not_like_lines(run, degrees):
    """A thousandth of the radius more or less of lap makes little difference: 1 to 2 times the force of two spheres."""
    spheres = force_for(5e-6, end_on_end, (COPPER, COPPER))
    for i, lap in enumerate((2e-6, 1e-6, -1e-6, -2e-6)):
        process, results = run(side_by_side(lap, degrees=degrees), name=f"lap{i}")
        assert process.returncode == 0, process.stderr
        force = results.contacts_at(-1)["force"].sum()
        assert 0.4 * spheres < force < 1.6 * spheres, lap


@pytest.mark.parametrize("law", [HERTZ, linear("", 1e10)], ids=["hertz", "per length"])
@pytest.mark.parametrize("yaw", [0, 90, 180])
@pytest.mark.parametrize("lean", [2, 4, 7])
def test_ends_that_lead_away_from_each_other_become_two_spheres(run, lean, yaw, law):
    """The tips of two wires, both of which lean away from the other one, at any angle to each other: with less overlap than
    wire beside the ends can have, force and conductance are those of two spheres. A penalty per length has a constant
    part of that."""
    slope, turn, radius = np.radians(lean), np.radians(yaw), COPPER.radius
    normal = np.array([np.sin(slope), 0, np.cos(slope)])
    # the upper wire leans as much, whichever way it leads
    way = np.array([np.cos(turn), np.sin(turn), 0])
    way += normal * (np.sin(slope) - way @ normal)
    lower = from_tip((0, 0, 0), (-1, 0, 0))
    overlaps = np.array([1e-6, 1e-5, 1e-4, 1e-3, 5e-3, 2e-2])
    steps = [moved(*(-overlap * radius * normal)).replace("*END STEP\n", VOLT + "*END STEP\n") for overlap in overlaps]
    deck = two_wires(lower, from_tip(2 * radius * normal, way), HELD, *steps, law=law + spot("HERTZ"))
    force, conductance = (each[-len(overlaps) :] for each in totals(solved(run(deck))))
    spheres = np.array([force_for(overlap * radius, end_on_end, (COPPER, COPPER)) for overlap in overlaps])
    conduct = np.array([1 / end_on_end(each, **hertz((COPPER, COPPER))).resistance for each in spheres])
    whole = 1 if law == HERTZ else force[0] / spheres[0]
    apart = overlaps < slope**2 / 100
    assert force[apart] == pytest.approx(whole * spheres[apart], rel=0.01)
    # boundary elements have 1.1 to 1.25 times the force at most
    assert np.all(force < (1.3 if law == HERTZ else 1.55) * whole * spheres)
    assert np.all(force > 0.99 * whole * spheres)
    if law == HERTZ:
        assert conductance[apart] == pytest.approx(conduct[apart], rel=0.01)
        assert np.all(conductance < 1.35 * conduct)


@pytest.mark.parametrize(("begin", "left"), [(0.3, 0.05), (-0.05, 0.015)])
def test_what_a_lap_holds_is_work_of_the_way_on_which_it_is_pulled_apart(run, begin, left):
    """Of wires side by side, from a lap and from ends just past each other, to where nothing touches: the force falls to
    that of two spheres and to nothing."""
    radius, overlap, end, increments = COPPER.radius, 0.01, 0.21, 100
    away = np.linspace(0, 0.02, 11)[:, None] * [1, 0, 0]
    upper = away + np.array([-begin * radius, 0, 2 * radius])
    down = -overlap * radius
    steps = [moved(0, 0, down), moved((begin + end) * radius, 0, down, increments=increments)]
    deck = two_wires(-away[::-1], upper, HELD, *steps).replace("*END STEP", "*ENERGY PRINT\n*END STEP")
    results = solved(run(deck))
    history, held = results.history, results.history["ALLCCE"][1]
    assert history["ALLCCE"][-1] == 0
    assert np.abs(history["ETOTAL"][2:] - history["ETOTAL"][1]).max() < left * held
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    assert np.diff(force).max() < 0.01 * force[0]
    gap = -begin + (begin + end) * np.arange(increments + 1) / increments
    normal_overlap = 2 - np.hypot(2 - overlap, gap)
    thin = (gap > 0) & (normal_overlap > 0) & (normal_overlap < 1e-3)
    spheres = [force_for(each * radius, end_on_end, (COPPER, COPPER)) for each in normal_overlap[thin]]
    assert force[-len(gap) :][thin] == pytest.approx(spheres, rel=0.05)


def dragged_tip(degrees, overlap, begin, end, spacing, increments):
    """The tip of a wire that leans on another one, pressed to this depth, is dragged from and to these places before the end
    of that one, which leads the other way; all lengths in radii."""
    radius, slope = COPPER.radius, math.tan(math.radians(degrees))
    lower = np.linspace((-20 * radius, 0, 0), (0, 0, 0), round(20 / spacing) + 1)
    s = np.linspace(0, 20, round(16 / spacing) + 1)[:, None] * radius
    upper = s * [1, 0, slope] + np.array([-begin, 0, 2]) * radius
    down = -overlap * radius
    steps = [moved(0, 0, down, increments=10), moved((begin - end) * radius, 0, down, increments=increments)]
    deck = two_wires(lower, upper, HELD, *steps, law=HERTZ + spot("HERTZ"))
    return deck.replace("*END STEP", "*ENERGY PRINT\n*END STEP")


@pytest.mark.parametrize(("degrees", "overlap"), [(0.25, 0.01), (0.5, 0.01), (1, 0.01), (0.5, 0.02), (1, 0.02)])
def test_tips_that_lead_opposite_ways_pass_each_other_without_a_step(run, degrees, overlap):
    """From a wedge that is whole to where nothing touches: the force falls, and what contacts hold is work of the way."""
    wedge = overlap / math.radians(degrees)
    results = solved(run(dragged_tip(degrees, overlap, 1.25 * wedge, -2.2 * math.sqrt(overlap), 2.2, 80)))
    history, held = results.history, results.history["ALLCCE"][10]
    assert history["ALLCCE"][-1] == 0
    assert np.abs(history["ETOTAL"][11:] - history["ETOTAL"][10]).max() < 0.04 * held
    force, conductance = (each[9:] for each in totals(results))
    assert np.diff(force).max() < 0.005 * force[0]
    assert np.diff(conductance).max() < 0.02 * conductance[0]
    assert largest_step(force) < 0.02


@pytest.mark.parametrize("degrees", [0.5, 1])
def test_tips_that_lead_the_same_way_pass_each_other_without_a_step(run, degrees):
    """Where end meets end, a wire leans on the other one as if that went on: nothing jumps as it comes to that."""
    radius, slope, down, increments = COPPER.radius, math.tan(math.radians(degrees)), -0.01 * COPPER.radius, 60
    lower = np.linspace((-20 * radius, 0, 0), (0, 0, 0), 10)
    upper = np.linspace(0, 20, 8)[:, None] * radius * [-1, 0, slope] + np.array([-0.03, 0, 2]) * radius
    steps = [moved(0, 0, down, increments=10), moved(0.1 * radius, 0, down, increments=increments)]
    deck = two_wires(lower, upper, HELD, *steps, law=HERTZ + spot("HERTZ")).replace(
        "*END STEP", "*ENERGY PRINT\n*END STEP"
    )
    results = solved(run(deck))
    history, held = results.history, results.history["ALLCCE"][10]
    assert np.abs(history["ETOTAL"][11:] - history["ETOTAL"][10]).max() < 0.06 * held
    for values in totals(results):
        assert np.diff(values[9:]).max() < 0.005 * values[9]
        assert largest_step(values[9:]) < 0.01


@pytest.mark.parametrize("spacing", [2.2, 0.7])
def test_a_tip_that_is_dragged_along_a_wire_holds_what_it_holds(run, spacing):
    """While places carry a part of it, and wherever they are: over four radii, on which 30 % of it were in no energy."""
    results = solved(run(dragged_tip(0.57, 0.01, 7, 3, spacing, 80)))
    history, held = results.history, results.history["ALLCCE"][10]
    assert np.abs(history["ETOTAL"][11:] - history["ETOTAL"][10]).max() < 0.035 * held


@pytest.mark.parametrize("yaw", [0.0, 1e-8, 1e-3])
@pytest.mark.parametrize("n", [10, 13])
def test_a_tip_that_leans_in_the_plane_of_both_wires_is_a_sphere(run, yaw, n):
    """The wire beside its tip adds to the force; straight axes in one plane are no special case, nor is the mesh."""
    lean, overlap = np.radians(8), 1e-6
    away = np.array([np.cos(lean) * np.cos(yaw), np.cos(lean) * np.sin(yaw), np.sin(lean)])
    tip = from_tip((0.0013, 0, 2 * COPPER.radius), away)
    deck = two_wires(np.linspace((-0.01, 0, 0), (0.01, 0, 0), n), tip, HELD, moved(0, 0, -overlap))
    (force,) = solved(run(deck)).contacts_at(-1)["force"]
    assert force == pytest.approx(force_for(overlap, end_on_wire, (COPPER, COPPER)), rel=0.05)


def test_a_wire_lies_along_one_leg_of_another_one(run):
    """The other leg leads away: what is laid along it touches a line up to the kink, and nothing else."""
    legs = np.concatenate(
        [np.linspace((-0.012, 0, 0), (0, 0, 0), 7), np.linspace((0, 0, 0), (0.004, 0, -0.008), 5)[1:]]
    )
    along = np.linspace((-0.01, 0, 2 * COPPER.radius), (0.01, 0, 2 * COPPER.radius), 11)
    process, results = run(two_wires(legs, along, HELD, moved(0, 0, -OVERLAP)))
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    assert contacts["length"].sum() == pytest.approx(0.01, rel=1e-6)


def test_a_branch_on_the_far_side_does_not_divide_a_wire(run):
    """A wire across, exactly over the node from which a third wire leads away."""
    across = np.linspace((0, -0.01, 2 * COPPER.radius), (0, 0.01, 2 * COPPER.radius), 10)
    straight = wire("LOWER", np.linspace((-0.01, 0, 0), (0.01, 0, 0), 11), LOWER, element="B33")
    branch = "*NODE, NSET=LOWER\n 501, 0, 0, -0.002\n*ELEMENT, TYPE=B33, ELSET=LOWER\n 501, 6, 501\n"
    forces = []
    for i, cards in enumerate((straight, straight + branch)):
        results = solved(run(two_wires(cards, across, HELD, moved(0, 0, -OVERLAP)), name=f"tee{i}"))
        forces.append(results.contacts_at(-1)["force"].sum())
    assert forces[1] == pytest.approx(forces[0], rel=1e-6)


@pytest.mark.parametrize("yaw", [0.0, 0.02])
def test_a_tip_that_leans_in_the_plane_of_both_wires_is_pressed_harder_the_deeper_it_is(run, yaw):
    """The overlap becomes two radii long, from a point to a line; in a plane only its length bounds the field of places."""
    slope = 0.02
    tip = from_tip((0.0003, 0, 2 * COPPER.radius), (1, yaw, slope), n=8, length=0.01)
    push = moved(0, 0, -2 * slope * COPPER.radius, increments=40).replace("*END STEP\n", VOLT + "*END STEP\n")
    results = solved(run(two_wires(ALONG_X, tip, HELD, push, law=HERTZ + spot("HERTZ"))))
    every = [results.contacts_at(i) for i in range(1, len(results.times))]
    force, current = (np.array([abs(each[name]).sum() for each in every]) for name in ("force", "current"))
    assert np.all(np.diff(force) > 0)
    assert np.all(np.diff(current) > 0)
    # what is pressed conducts
    assert all(np.all(np.isfinite(each["resistance"][each["force"] > 0])) for each in every)


@pytest.mark.parametrize("lap", [0.35, 0.5, 0.8, 1.2])
def test_a_lap_of_two_ends_has_the_same_force_in_any_direction(run, lap):
    """The ends of both wires share what is between them, whichever of them is found first."""
    along = np.linspace(0, 0.012, 10)[:, None]
    forces = []
    for direction, up in (
        ((1, 0, 0), (0, 0, 1)),
        ((0.6, 0, 0.8), (-0.8, 0, 0.6)),
        ((2 / 3, 1 / 3, 2 / 3), (1 / 3, 2 / 3, -2 / 3)),
    ):
        lower = (along - 0.012 + lap * COPPER.radius) * direction
        upper = along * direction + 2 * COPPER.radius * np.array(up)
        deck = two_wires(lower, upper, HELD, moved(*(-100 * OVERLAP * np.array(up)), increments=2))
        forces.append(solved(run(deck)).contacts_at(-1)["force"].sum())
    assert forces == pytest.approx([forces[0]] * 3, rel=1e-6)


@pytest.mark.parametrize("bend", [3e-3, 1e-2])
def test_an_end_beside_the_end_of_the_other_wire_has_no_more_than_one_on_a_long_wire(run, bend):
    """Strands that end in one plane: one that is bent away from the other one [1/radii] leads off from its end there."""
    radius, slope, overlaps = COPPER.radius, 0.012, np.array([1e-4, 3e-4, 1e-3, 3e-3, 1e-2])
    way = np.linspace(0, 0.012, 11)
    upper = np.column_stack([-way, np.zeros(11), 2 * radius + slope * way + bend / radius * way**2 / 2])
    forces = []
    for beyond in (0.02, 6.0):
        lower = np.linspace((-0.02, 0, 0), (beyond * radius, 0, 0), 15)
        steps = [moved(0, 0, -overlap * radius) for overlap in overlaps]
        results = solved(run(two_wires(lower, upper, HELD, *steps)))
        forces.append(np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(overlaps) + 1)]))
    assert np.all(np.diff(forces[0]) > 0)
    assert np.all(forces[0] < 1.02 * forces[1])
    assert np.all(forces[0] > 0.5 * forces[1])


@pytest.mark.parametrize("before", [1e-8, 1e-4])
def test_an_end_that_is_pressed_from_a_touch_to_a_tenth_of_a_percent_in_one_increment_has_its_force(run, before):
    """All motions are given, so that nothing is left to be balanced: what the ends have is found for the overlap that is."""
    radius = COPPER.radius
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 11)
    upper = from_tip((0.3 * radius, 0, math.sqrt(4 - 0.09) * radius), (1, 0, 0.05), n=10, length=0.02)
    way = np.array([0.3, 0, math.sqrt(4 - 0.09)]) / 2
    steps = [moved(*(-overlap * radius * way)) for overlap in (before, 1e-3)]
    results = solved(run(two_wires(lower, upper, HELD, *steps)))
    spheres = force_for(1e-3 * radius, end_on_end, (COPPER, COPPER))
    assert results.contacts_at(-1)["force"].sum() == pytest.approx(spheres, rel=0.05)
