"""Contact at kinks and branches: the same force whichever of the elements there comes first, however much the wire turns
there, and wherever next to the joint the other wire is pressed on."""

import math

import numpy as np
import pytest
from verification.references.hertz import crossed_wires, effective_modulus, end_on_end, end_on_wire

from decks import wire
from line_wires import COPPER, HERTZ, UPPER, PressedWire, linear, material, step, two_wires

R = COPPER.radius
HELD = "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, ENCASTRE\n LOWER, 9\n UPPER, 9\n"
LAWS = [HERTZ, linear("", 1e10)]


def hertz(overlap, spot_of, *more):
    """Force of a Hertz contact of two equal wires at this overlap [N]."""
    data = {
        "radius": [R, R],
        "modulus": effective_modulus([COPPER.young] * 2, [COPPER.poisson] * 2),
        "resistivity": [COPPER.resistivity] * 2,
    }
    return (overlap / spot_of(1.0, *more, **data).approach) ** 1.5


def leg(yaw, fall, n=6, length=12 * R):
    """Points of a wire that leads from the origin in a direction [degrees], and falls."""
    yaw, fall = math.radians(yaw), math.radians(fall)
    direction = [math.cos(yaw) * math.cos(fall), math.sin(yaw) * math.cos(fall), -math.sin(fall)]
    return np.linspace(0, length, n + 1)[:, None] * np.array(direction)


def in_order(legs, order):
    """Cards of legs that meet in the origin; those of `order` whose number is negative are read from their far end."""
    nodes, elements = " 1, 0, 0, 0\n", ""
    for k, points in enumerate(legs):
        nodes += "".join(
            f" {10 * k + i + 1}, {x:.17g}, {y:.17g}, {z:.17g}\n" for i, (x, y, z) in enumerate(points) if i
        )
    number = 0
    for k in order:
        for i in range(6):
            number += 1
            ends = [10 * (abs(k) - 1) + i + 1 if i else 1, 10 * (abs(k) - 1) + i + 2]
            elements += " {}, {}, {}\n".format(number, *(ends if k > 0 else ends[::-1]))
    return f"*NODE, NSET=LOWER\n{nodes}*ELEMENT, TYPE=B33, ELSET=LOWER\n{elements}"


def force_on(
    run, lower, yaw, rise=0.0, overlap=0.02 * R, law=HERTZ, pairs=("LOWER, UPPER",), at=(0, 0, 0), until=12.07
):
    """Force of a rod that is pressed on a place by an overlap [m], its direction given by two angles [degrees]; it ends so
    many radii behind the place."""
    yaw, rise = math.radians(yaw), math.radians(rise)
    along = np.array([math.cos(rise) * math.cos(yaw), math.cos(rise) * math.sin(yaw), math.sin(rise)])
    normal = np.array([0, 0, 1]) - along * along[2]
    normal /= np.linalg.norm(normal)
    rod = np.array(at) + 2 * R * normal + np.linspace(-11.93 * R, until * R, 25)[:, None] * along
    push = "".join(f" UPPER, {d}, {d}, {-overlap * u:.17g}\n" for d, u in enumerate(normal, start=1))
    upper = wire("UPPER", rod, UPPER, element="B33")
    deck = two_wires(lower, upper, HELD, step(boundary=push), law=law, pairs=pairs)
    process, results = run(deck, name="joint")
    assert process.returncode == 0, process.stderr
    return results.contacts_at(-1)["force"].sum()


def of_legs(legs, order, wires):
    """The same cards with legs of several wires, and what turns a deck of one lower wire into one of these."""
    cards, elements = in_order(legs, order).split("*ELEMENT, TYPE=B33, ELSET=LOWER\n")
    rows, text, sections = elements.splitlines(), "", "*ELSET, ELSET=LOWER\n LEG1, LEG2\n"
    for i, k in enumerate(map(abs, order)):
        text += f"*ELEMENT, TYPE=B33, ELSET=LEG{k}\n" + "\n".join(rows[6 * i : 6 * i + 6]) + "\n"
        sections += material(f"LEG{k}", wires[k - 1])
    return cards + text + sections


def force_on_legs(run, degrees, order, wires, at=(0, 0, 0), normal=(0, 0, 1), law=HERTZ, overlap=0.02 * R, yaw=90):
    """Force of a rod across that is pressed on a kink, the legs of which are of several wires."""
    lower = of_legs([leg(180, degrees / 2), leg(0, degrees / 2)], order, wires)
    distance = R + max(each.radius for each in wires)
    normal = np.array(normal)
    along = np.array([math.cos(math.radians(yaw)), math.sin(math.radians(yaw)), 0])
    rod = np.array(at) + distance * normal + np.linspace(-11.93 * R, 12.07 * R, 25)[:, None] * along
    push = "".join(f" UPPER, {d}, {d}, {-overlap * u:.17g}\n" for d, u in enumerate(normal, start=1))
    deck = two_wires(lower, wire("UPPER", rod, UPPER, element="B33"), HELD, step(boundary=push), law=law)
    process, results = run(deck.replace(material("LOWER", COPPER), ""), name="legs")
    assert process.returncode == 0, process.stderr
    return results.contacts_at(-1)["force"].sum()


def step_of(law):
    """What force may change by as a contact comes to a joint: at the joint the section of the wires does not bound the far
    field of what crosses there, which a penalty does not have."""
    return 5e-3 if law == HERTZ else 2e-4


def assert_same(forces):
    # nothing but round-off, and the tolerance of the law's own iterations, is different
    assert forces == pytest.approx(np.full(len(forces), forces[0]), rel=1e-7)


@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize(("degrees", "rise"), [(21, 3), (21, 7.5), (30, -6), (30, 12), (39, 16.5)])
def test_the_order_of_the_legs_of_a_kink_makes_no_difference(run, law, degrees, rise):
    """A rod in the plane of the kink, which lies along one of its legs and leans against the other."""
    legs = [leg(180, degrees / 2), leg(0, degrees / 2)]
    orders = [(1, 2), (2, 1), (-1, 2), (-2, -1)]
    assert_same([force_on(run, in_order(legs, order), 0, rise, law=law) for order in orders])


@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize("falls", [(0, 0, 0), (5, 8, 3), (0, 10, 10), (2, 2, 20)])
@pytest.mark.parametrize("yaw", [90, 60, 10, 0])
def test_the_order_of_three_wires_that_meet_makes_no_difference(run, law, falls, yaw):
    legs = [leg(180, falls[0]), leg(-12, falls[1]), leg(13, falls[2])]
    orders = [(1, 2, 3), (3, 2, 1), (-2, 1, -3)]
    forces = [force_on(run, in_order(legs, order), yaw, law=law) for order in orders]
    forces.append(force_on(run, in_order(legs, (2, 3, 1)), yaw, law=law, pairs=("UPPER, LOWER",)))
    assert_same(forces)


@pytest.mark.slow
@pytest.mark.parametrize("yaw", [90, 45, 15])
@pytest.mark.parametrize("overlap", [0.01 * R, 5e-4 * R])
def test_a_kink_begins_as_a_smooth_bend_and_ends_as_a_sphere(run, yaw, overlap):
    """From 20 degrees, where it is a kink, the force falls from that of crossed wires to that of a hemisphere."""
    crossing, sphere = hertz(overlap, crossed_wires, math.radians(yaw)), hertz(overlap, end_on_wire)
    angles = [19.9, 20.1, 21, 24, 28, 33, 40, 90]
    forces = [force_on(run, in_order([leg(180, a / 2), leg(0, a / 2)], (1, 2)), yaw, overlap=overlap) for a in angles]
    # a tenth of a degree beyond where it is a kink
    assert forces[:2] == pytest.approx([crossing] * 2, rel=5e-3)
    assert np.all(np.diff(forces[1:]) < 1e-6 * sphere)
    assert forces[-2:] == pytest.approx([sphere] * 2, rel=1e-5)


@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
def test_a_rod_across_feels_little_of_a_kink_of_little_more_than_20_degrees(run, law):
    """Over the joint and along a leg: everywhere within 2 % of the force of crossed wires."""
    fall = math.radians(20.5 / 2)
    kink = in_order([leg(180, 20.5), leg(0, 0)], (1, 2))
    on_leg = [force_on(run, kink, 90, law=law, at=(s * R, 0, 0)) for s in (0, 1e-3, 0.05, 0.1, 0.2, 0.4, 0.8)]
    on_top = force_on(run, in_order([leg(180, math.degrees(fall)), leg(0, math.degrees(fall))], (1, 2)), 90, law=law)
    assert [*on_leg, on_top] == pytest.approx(np.full(8, on_leg[-1]), rel=0.02)


@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize(("degrees", "yaw"), [(20.1, 15), (25, 15), (45, 30), (90, 60)])
def test_a_rod_moves_from_leg_to_leg_of_a_flat_kink_without_a_jump(run, law, degrees, yaw):
    """The rod crosses one leg at a small angle, on which places carry the contact, and the other one at a large angle:
    over the joint it has half of either."""
    kink = in_order([leg(180 + degrees / 2, 0), leg(-degrees / 2, 0)], (1, 2))
    across = R * np.array([-math.sin(math.radians(yaw)), math.cos(math.radians(yaw)), 0])
    forces = [force_on(run, kink, yaw, law=law, at=s * across) for s in (-1e-5, 0, 1e-5)]
    assert forces == pytest.approx(np.full(3, forces[1]), rel=step_of(law))
    halves = []
    for turn in (degrees / 2, -degrees / 2):
        straight = leg(turn, 0, n=12, length=24 * R)
        halves.append(force_on(run, wire("LOWER", straight - straight[6], 1, element="B33"), yaw, law=law) / 2)
    # Hertz has one ellipse for both
    assert forces[1] == pytest.approx(sum(halves), rel=0.025 if law == HERTZ else 2e-3)


@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize("degrees", [20.1, 45, 90])
@pytest.mark.parametrize("yaw", [5, 15, 60])
def test_a_rod_moves_from_a_leg_on_to_the_joint_without_a_jump(run, law, degrees, yaw):
    """The other leg falls away."""
    kink = in_order([leg(180, 0), leg(0, degrees)], (1, 2))
    forces = [force_on(run, kink, yaw, law=law, at=(s * R, 0, 0)) for s in (-1e-5, 0)]
    assert forces[0] == pytest.approx(forces[1], rel=step_of(law))


@pytest.mark.parametrize("chamfer", [0.02, 0.1])
def test_a_corner_with_a_short_chamfer_is_a_corner(run, chamfer):
    """90 degrees as two kinks of 45 degrees: the wire between them is so short that the joints have all of the force.

    A bend of that radius would have up to 4 % more than the sphere of a kink.
    """
    overlap, half = 0.01 * R, chamfer * R / 2
    legs = np.linspace(0, 12 * R, 7)[:, None] * np.array([math.sqrt(0.5), 0, -math.sqrt(0.5)])
    out = np.array([half, 0, 0])
    points = np.concatenate([(legs * [-1, 1, 1] - out)[::-1], legs + out])
    for place in (0.0, 0.6 * half):
        force = force_on(run, wire("LOWER", points, 1, element="B33"), 90, overlap=overlap, at=(place, 0, 0))
        assert force == pytest.approx(hertz(overlap, end_on_wire), rel=0.03)


def test_a_branch_adds_what_its_cylinder_has(run):
    """Three legs at one height: a rod across all of them has half of a crossing on each."""
    legs = [leg(180, 0), leg(0, 0), leg(25, 0)]
    half = [hertz(0.02 * R, crossed_wires, math.radians(90 - yaw)) / 2 for yaw in (0, 0, 25)]
    force = force_on(run, in_order(legs, (1, 2, 3)), 90)
    # one ellipse for all three of them, at their mean angle
    assert force == pytest.approx(sum(half), rel=0.01)


@pytest.mark.parametrize("until", [0.1, 1e-3, -1e-3])
@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize(("falls", "yaw"), [((13, 13, 40), 80), ((0, 5, 10), 60)])
def test_the_order_of_wires_that_meet_below_the_end_of_another_one_makes_no_difference(run, law, falls, yaw, until):
    legs = [leg(180, falls[0]), leg(-12, falls[1]), leg(13, falls[2])]
    orders = [(1, 2, 3), (3, 2, 1), (-2, 1, -3)]
    forces = [force_on(run, in_order(legs, order), yaw, law=law, until=until) for order in orders]
    forces.append(force_on(run, in_order(legs, (2, 3, 1)), yaw, law=law, pairs=("UPPER, LOWER",), until=until))
    assert_same(forces)


def test_the_end_of_a_rod_over_a_corner_is_half_a_sphere_on_a_sphere(run):
    """Over the corner the rod has the half of its cylinder, on either side of its end."""
    corner = in_order([leg(180, 45), leg(0, 45)], (1, 2))
    half = (hertz(0.02 * R, end_on_wire) + hertz(0.02 * R, end_on_end)) / 2
    forces = [force_on(run, corner, 90, until=until) for until in (1e-4, 0.0, -1e-4)]
    # the slope of the force over a ten thousandth of a radius
    assert forces == pytest.approx([half] * 3, rel=1e-3)
    assert force_on(run, corner, 90, until=0.5) == pytest.approx(hertz(0.02 * R, end_on_wire), rel=1e-5)


HARD = PressedWire(R, 400e9, 0.28, 1.4e-7)
THIN = PressedWire(0.8 * R, COPPER.young, COPPER.poisson, COPPER.resistivity)


@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize("legs", [(COPPER, HARD), (COPPER, THIN)], ids=["hard", "thin"])
@pytest.mark.parametrize(("degrees", "shift"), [(90, 0), (30, 0), (25, 0), (25, 0.05), (25, -0.05), (60, 0.3)])
def test_the_order_of_legs_of_several_wires_makes_no_difference(run, law, legs, degrees, shift):
    fall = math.radians(degrees / 2)
    at = abs(shift) * R * np.array([math.copysign(math.cos(fall), shift), 0, -math.sin(fall)])
    normal = (math.copysign(math.sin(fall), shift) if shift else 0, 0, math.cos(fall) if shift else 1)
    orders = [(1, 2), (2, 1), (-1, 2), (-2, -1)]
    assert_same([force_on_legs(run, degrees, order, legs, at, normal, law) for order in orders])


@pytest.mark.slow
def test_the_modulus_of_a_joint_is_that_of_its_legs_without_a_jump(run):
    """A rod across a kink of 30 degrees, from one leg over the joint on to the other one."""
    fall, overlap, n = math.radians(15), 0.02 * R, 16
    along = np.array([[-math.cos(fall), 0, -math.sin(fall)], [math.cos(fall), 0, -math.sin(fall)]])
    out = np.array([[-math.sin(fall), 0, math.cos(fall)], [math.sin(fall), 0, math.cos(fall)]])
    places = [(s * along[0], out[0]) for s in np.linspace(0.4 * R, 0, n)]
    places += [(0 * out[0], [math.sin(a), 0, math.cos(a)]) for a in np.linspace(-fall, fall, n)]
    places += [(s * along[1], out[1]) for s in np.linspace(0, 0.4 * R, n)]
    force = np.array([force_on_legs(run, 30, (1, 2), (COPPER, HARD), at, normal) for at, normal in places])
    moduli = [effective_modulus([COPPER.young, w.young], [COPPER.poisson, w.poisson]) for w in (COPPER, HARD)]
    crossing = [hertz(overlap, crossed_wires, math.pi / 2) * modulus / moduli[0] for modulus in moduli]
    assert force[[0, -1]] == pytest.approx(crossing, rel=1e-5)
    # the steps of a smooth change: in a tenth of its way or more
    assert np.max(np.abs(np.diff(force))) < (crossing[1] - crossing[0]) / 5


def test_a_joint_is_a_ball_of_its_thickest_leg_and_the_thin_one_comes_out_of_it(run):
    joint = force_on_legs(run, 90, (1, 2), (COPPER, THIN))
    assert joint == pytest.approx(hertz(0.02 * R, end_on_wire), rel=1e-5)
    fall = math.radians(45)
    on_thin = np.array([math.cos(fall), 0, -math.sin(fall)])
    normal = np.array([math.sin(fall), 0, math.cos(fall)])
    # outside the ball it has its own radius; the force along the wire is that of the rising radius
    force = force_on_legs(run, 90, (1, 2), (COPPER, THIN), 1.5 * R * on_thin, normal, overlap=0.22 * R)
    data = {
        "radius": [R, THIN.radius],
        "modulus": effective_modulus([COPPER.young] * 2, [COPPER.poisson] * 2),
        "resistivity": [COPPER.resistivity] * 2,
    }
    approach = crossed_wires(1.0, math.pi / 2, **data).approach
    assert force == pytest.approx((0.02 * R / approach) ** 1.5, rel=1e-5)


def forces_along(run, points, yaw, places, law):
    """Forces of rods that lie across copies of a wire at these places [radii along x]: independent of each other, in one
    deck. They are pressed on in several increments, so that all of their shares are settled."""
    yaw = math.radians(yaw)
    along = np.linspace(-11.93 * R, 12.07 * R, 25)[:, None] * np.array([math.cos(yaw), math.sin(yaw), 0])
    lower = upper = ""
    for i, place in enumerate(places):
        aside = np.array([0, 100 * R * i, 0])
        lower += wire("LOWER", points + aside, 1 + 100 * i, element="B33")
        rod = along + aside + np.array([place * R, 0, 2 * R])
        upper += wire("UPPER", rod, 100001 + 100 * i, element="B33")
    push = f" UPPER, 1, 2\n UPPER, 3, 3, {-0.02 * R:.17g}\n"
    deck = two_wires(lower, upper, HELD, step(static="0.2, 1., 1e-3, 0.2", boundary=push), law=law)
    process, results = run(deck, name="dragged")
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    forces = np.zeros(len(places))
    np.add.at(forces, (np.minimum(contacts["element_1"], contacts["element_2"]) - 1) // 100, contacts["force"])
    return forces


def stands_out(forces):
    """By how much of the force each change between neighbours exceeds those beside it."""
    change = np.diff(forces)
    beside = np.stack([change[:-2], change[2:]])
    beyond = np.maximum(change[1:-1] - beside.max(0), beside.min(0) - change[1:-1])
    return np.maximum(beyond, 0) / np.maximum(forces[1:-2], forces[2:-1]).clip(1e-3 * forces.max())


def largest_step(run, points, yaw, law, first, last):
    """Largest step of the force of a rod that is dragged over a wire [of the force]: where a change stands out, whether it
    still does over a hundredth of the way."""
    places = np.arange(first, last, 0.05) + 1e-4
    found = stands_out(forces_along(run, points, yaw, places, law))
    suspects = [k for k in np.argsort(found)[-3:] if found[k] > 0.01]
    steps = [0.0]
    for k in suspects:
        fine = np.linspace(places[k + 1] - 0.005, places[k + 2] + 0.005, 121)
        steps.append(stands_out(forces_along(run, points, yaw, fine, law)).max())
    return max(steps)


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize(
    ("degrees", "yaw"),
    [
        (5, 20),
        (10, 10),
        (15, 5),
        (15, 10),
        (15, 15),
        (20.1, 30),
        (30, 10),
        (30, 30),
        (45, 10),
        (60, 15),
        (60, 60),
        (90, 30),
    ],
)
def test_a_rod_is_dragged_over_a_flat_kink_without_a_step(run, law, degrees, yaw):
    """A smooth bend up to 20 degrees, of elements of two radii; crossed at other angles on either side of it."""
    turn = degrees / 2
    points = np.concatenate([leg(180 + turn, 0)[::-1], leg(-turn, 0)[1:]])
    assert largest_step(run, points, yaw, law, -2.5, 2.5) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS, ids=["hertz", "linear"])
@pytest.mark.parametrize(("degrees", "yaw"), [(20.1, 10), (30, 10), (30, 15), (60, 20), (60, 45)])
def test_a_rod_is_dragged_on_to_a_kink_and_beyond_without_a_step(run, law, degrees, yaw):
    """Along a leg, while the feet of its places pass the joint one after the other; the other leg falls away."""
    points = np.concatenate([leg(180, 0)[::-1], leg(0, degrees)[1:]])
    assert largest_step(run, points, yaw, law, -3.0, 0.5) < 0.02


@pytest.mark.parametrize(
    ("law", "yaw"), [(HERTZ, 15), (HERTZ, 30), (LAWS[1], 5)], ids=["hertz-15", "hertz-30", "linear-5"]
)
def test_a_rod_is_dragged_past_the_end_of_a_wire_without_a_step(run, law, yaw):
    """docs/limits.md says at which angles there is one."""
    assert largest_step(run, leg(180, 0)[::-1], yaw, law, -3.0, 1.2) < 0.02


@pytest.mark.parametrize(("degrees", "yaw"), [(60, 40), (90, 60), (15, 20)])
def test_friction_leaves_the_force_of_a_rod_that_is_dragged_over_a_kink_as_it_is(run, degrees, yaw):
    """What legs, joint and places have of the force changes from increment to increment, with friction as without."""
    turn, direction = degrees / 2, np.array([math.cos(math.radians(yaw)), math.sin(math.radians(yaw)), 0])
    lower = wire("LOWER", np.concatenate([leg(180 + turn, 0)[::-1], leg(-turn, 0)[1:]]), 1, element="B33")
    rod = np.array([-2.5 * R, 0, 2 * R]) + np.linspace(-11.93 * R, 12.07 * R, 25)[:, None] * direction
    upper = wire("UPPER", rod, UPPER, element="B33")
    down = f" UPPER, 3, 3, {-0.02 * R:.17g}\n"
    held = HELD.replace("UPPER, ENCASTRE", "UPPER, 4, 6")
    press = step(static="0.2, 1., 1e-3, 0.2", boundary=f" UPPER, 1, 2\n{down}")
    drag = step(static="0.02, 1., 1e-3, 0.02", boundary=f" UPPER, 1, 1, {5 * R:.17g}\n UPPER, 2, 2\n{down}")
    forces = []
    for name, law in {"smooth": HERTZ, "rough": f"{HERTZ}*FRICTION\n 0.1\n"}.items():
        process, results = run(two_wires(lower, upper, held, press + drag, law=law), name=name)
        assert process.returncode == 0, process.stderr
        forces.append([results.contacts_at(i)["force"].sum() for i in range(len(results.times))])
    assert forces[1] == pytest.approx(forces[0], rel=1e-3, abs=1e-9)


@pytest.mark.parametrize("before", [3e-6, 1.2e-6, 8e-7, 5e-7, 0.0])
@pytest.mark.parametrize("bend", [5, -5, -15])
def test_a_crossing_next_to_a_node_where_the_curvature_jumps_is_one(run, bend, before):
    """At the node beside a bend: the two elements that meet there find the place at different distances from it."""
    turn = math.radians(bend)
    straight = [[k * R, 0, 0] for k in range(-8, 2)]
    lower = np.array(straight + [[R + k * R * math.cos(turn), 0, -k * R * math.sin(turn)] for k in range(1, 8)])
    forces = {}
    for at in (2e-5, -before):
        yaw = math.radians(50)
        along = np.linspace(-11.93 * R, 12.07 * R, 25)[:, None] * np.array([math.cos(yaw), math.sin(yaw), 0])
        rod = wire("UPPER", np.array([at * R, 0, 2 * R]) + along, UPPER, element="B33")
        push = f" UPPER, 3, 3, {-0.002 * R:.17g}\n"
        process, results = run(two_wires(lower, rod, HELD, step(boundary=push), law=HERTZ), name="jump")
        assert process.returncode == 0, process.stderr
        assert len(results.contacts_at(-1)["force"]) == 1
        forces[at] = results.contacts_at(-1)["force"].sum()
    assert forces[-before] == pytest.approx(forces[2e-5], rel=2e-4)
