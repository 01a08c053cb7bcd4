"""Wires on rigid planes and cylinders: press plates, drums, jackets."""

import numpy as np
import pytest

from test_restart import KEEP_ALL, assert_goes_on_from_everywhere

YOUNG, POISSON = 200e9, 0.3
ELASTIC = f"*MATERIAL, NAME=M\n*ELASTIC\n {YOUNG}, {POISSON}\n"
HERTZ = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
STIFF = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 1e7, 1e10\n"


def wire(points, radius, closed=False):
    """Elements from 1 on through the points; set WIRE, node set W."""
    n = len(points)
    nodes = "".join(f" {i}, {x:.17g}, {y:.17g}, {z:.17g}\n" for i, (x, y, z) in enumerate(points, 1))
    ends = [(i, i % n + 1) for i in range(1, n + closed)]
    elements = "".join(f" {i}, {a}, {b}\n" for i, (a, b) in enumerate(ends, 1))
    section = f"*BEAM SECTION, ELSET=WIRE, MATERIAL=M, SECTION=CIRC\n {radius}\n"
    return f"*NODE, NSET=W\n{nodes}*ELEMENT, TYPE=B33, ELSET=WIRE\n{elements}{ELASTIC}{section}"


def surface(shape, data, node=None, laws="", name="S"):
    """A surface, on the node of this number and place, with its contact pair; `laws` follow *SURFACE INTERACTION."""
    words = f"*SURFACE INTERACTION, NAME=I{name}\n{laws}*RIGID SURFACE, NAME={name}, TYPE={shape}"
    if node:
        words = f"*NODE\n {node[0]}, {node[1]}\n" + words + f", REF NODE={node[0]}"
    return words + f"\n {data}\n*CONTACT PAIR, INTERACTION=I{name}\n WIRE, {name}\n"


def step(words, static="0.5, 1"):
    return f"*STEP, INC=400\n*STATIC\n {static}\n{words}*END STEP\n"


def along_x(length, n, height=0.0):
    return [(x, 0, height) for x in np.linspace(-length / 2, length / 2, n + 1)]


def crossing(depth, shift=0.0, radius=5e-4):
    """A drum is pushed this deep into a straight wire that is held everywhere."""
    points = [(x + shift, y, z) for x, y, z in along_x(0.016, 4)]
    drum = surface("CYLINDER", f"0, 0, {2 * radius}, 0, 1, 0, {radius}", (99, f"0, 0, {2 * radius}"))
    hold = "*BOUNDARY\n W, 1, 3\n W, 5, 6\n 1, 4\n 99, 1, 2\n 99, 4, 6\n"
    return wire(points, radius) + drum + hold + step(f"*BOUNDARY\n 99, 3, 3, {-depth:.17g}\n")


@pytest.mark.parametrize("depth", [8.5e-8, 1.1e-5])
def test_a_drum_across_a_wire_is_a_hertz_contact(run, depth):
    """Equal radii at a right angle: a circle, `F = 4/3 E* sqrt(r) delta^1.5`, at shallow and at deep overlaps (the gap along
    the wire is that of a circle, not of a parabola)."""
    radius = 5e-4
    _, results = run(crossing(depth))
    hertz = 4 / 3 * YOUNG / (1 - POISSON**2) * np.sqrt(radius) * depth**1.5
    assert -results.field("reaction_force")[-1, 2] == pytest.approx(hertz, rel=2e-3)
    table = results.surface_contacts
    # at a node: either element has its part; the sum of sizes, in directions that differ by up to 0.2 rad from each other
    assert table["force"][table["increment"] == 2].sum() == pytest.approx(hertz, rel=4e-3)
    np.testing.assert_allclose(table["normal_z"], -1, rtol=max(1e-4, depth / radius))


def test_the_energy_of_a_lens_is_the_work_of_pressing_while_the_section_comes_to_count(run):
    """A drum of twenty radii is pressed until the overlap is 1.5 radii long on either side: with half of the increments the
    error, which is that of means of forces, is a quarter."""
    radius, depth = 5e-4, 2.4e-5
    deck = crossing(depth, radius=radius).replace(f"0, 0, {2 * radius}", f"0, 0, {21 * radius}")
    deck = deck.replace(f"0, 1, 0, {radius}", f"0, 1, 0, {20 * radius}").replace(
        "*BOUNDARY\n 99, 3", "*ENERGY PRINT\n*BOUNDARY\n 99, 3"
    )

    def drift(increment):
        process, results = run(
            deck.replace(" 0.5, 1\n", f" {increment}, 1, 1e-9, {increment}\n"), name=f"by{increment}"
        )
        assert process.returncode == 0, process.stderr
        history = results.history
        return abs(history["ETOTAL"][-1]) / history["ALLCCE"][-1]

    coarse, fine = drift(0.1), drift(0.05)
    assert coarse < 8e-3
    assert fine < 0.35 * coarse


@pytest.mark.parametrize("last", ["WIRE", "BOTH"])
def test_of_two_contact_pairs_of_a_wire_and_a_surface_the_last_one_holds(run, last):
    """The elements beside the drum touch it once, by the laws of the last pair that names them."""
    deck, pair = crossing(8.5e-8), "*CONTACT PAIR, INTERACTION=IS\n WIRE, S\n"
    stiff = "*CONTACT PAIR, INTERACTION=ISTIFF\n BOTH, S\n"
    laws = f"*ELSET, ELSET=BOTH\n 2, 3\n*SURFACE INTERACTION, NAME=ISTIFF\n{STIFF}"
    _, alone = run(deck if last == "WIRE" else deck.replace("NAME=IS\n", f"NAME=IS\n{STIFF}"))
    process, both = run(deck.replace(pair, laws + (stiff + pair if last == "WIRE" else pair + stiff)))
    assert process.returncode == 0, process.stderr
    for name in ("element", "force"):
        assert both.surface_contacts_at(-1)[name] == pytest.approx(alone.surface_contacts_at(-1)[name], rel=1e-12)


@pytest.mark.parametrize("clamped", ["both ends", "one end"])
@pytest.mark.parametrize("node", [5, 9])
def test_a_wire_that_exactly_touches_a_plane_is_pressed_in_one_increment(run, clamped, node):
    """At a gap of zero there is neither force nor stiffness, and where the wire lifts off does not depend on the size of the
    load: no smaller increment would find it more easily. A wire that is an immeasurable gap above is pressed alike."""
    supports = "*BOUNDARY\n 1, ENCASTRE\n" + " 17, ENCASTRE\n" * (clamped == "both ends")
    load = step(f"*CLOAD\n {node}, 3, -10\n", "1, 1")

    def pressed(height):
        plane = surface("PLANE", "0, 0, -1e-3, 0, 0, 1")
        process, results = run(wire(along_x(0.04, 16, height), 1e-3) + plane + supports + load, name=f"at{height}")
        assert process.returncode == 0, process.stderr
        return results

    touching = pressed(0.0)
    assert list(touching.status["attempts"]) == [1]
    now, beside = (results.surface_contacts_at(-1) for results in (touching, pressed(1e-13)))
    np.testing.assert_array_equal(now["element"], beside["element"])
    # what the gap is of the overlap of some 1e-7 m
    np.testing.assert_allclose(now["force"], beside["force"], rtol=1e-4, atol=1e-4)


def held_wire(points, shape, data, depth, radius):
    """A surface is raised by `depth` against a wire whose nodes are held."""
    hold = "*BOUNDARY\n W, 1, 6\n 999, 1, 2\n 999, 4, 6\n"
    deck = wire(points, radius) + surface(shape, data, (999, "0, 0, 0")) + hold
    return deck + step(f"*BOUNDARY\n 999, 3, 3, {depth:.17g}\n", static="1, 1")


@pytest.mark.parametrize("size", [2.0, 0.5, 0.25])
@pytest.mark.parametrize("shape", ["BORE", "CYLINDER"])
def test_a_wire_that_conforms_to_a_surface_has_the_law_of_its_length_in_any_mesh(run, shape, size):
    """An arc of 60 degrees about the axis of a cylinder of 30 of its radii, in touch all along it, has across it the relative
    curvature of a straight wire on a plane, and none along it: elements shorter than their arc is open see no lens."""
    radius, depth = 1e-3, 3e-6

    def force(points, shape, data, depth):
        _, results = run(held_wire(points, shape, data, depth, radius))
        table = results.surface_contacts
        return np.sum(table["force"] * np.abs(table["normal_z"]))

    # of a straight wire, per length, and the power of the overlap that it goes with
    plane = [force(along_x(4 * radius, 4, radius), "PLANE", "0, 0, 0, 0, 0, 1", d) for d in (0.9 * depth, depth)]
    power = np.log(plane[1] / plane[0]) / np.log(1 / 0.9)
    side, down = (29, 1) if shape == "BORE" else (31, -1)
    angles = np.radians(np.linspace(-30, 30, 1 + round(np.radians(60) * side / size)))
    arc = [(side * radius * np.sin(a), 0, -down * side * radius * np.cos(a)) for a in angles]
    places = np.radians(np.linspace(-30, 30, 2001))
    expected = plane[1] / 4 * side * np.trapezoid(np.cos(places) ** (1 + power), places)
    assert force(arc, shape, f"0, 0, 0, 0, 1, 0, {30 * radius}", depth) == pytest.approx(expected, rel=2e-3)


def test_the_force_does_not_depend_on_where_it_is_in_the_mesh(run):
    """In the middle of an element, near a node, at a node."""
    runs = [run(crossing(3e-7, shift), name=f"at{i}")[1] for i, shift in enumerate((0, 1e-3, 1.9999e-3))]
    forces = [-results.field("reaction_force")[-1, 2] for results in runs]
    # the quadrature over a lens that a node divides
    np.testing.assert_allclose(forces, forces[1], rtol=1e-4)


def standing(points, depth, laws=HERTZ):
    """A wire above a plane is lowered this deep into it."""
    lowest = min(z for _, _, z in points)
    points = [(x, y, z - lowest + 5e-4) for x, y, z in points]
    hold = "*BOUNDARY\n W, 1, 2\n W, 4, 6\n"
    plane = surface("PLANE", "0, 0, 0, 0, 0, 1", laws=laws)
    return wire(points, 5e-4) + plane + hold + step(f"*BOUNDARY\n W, 3, 3, {-depth:.17g}\n")


def leaning(degrees, n=8, length=0.016):
    """Points of a wire at an angle to the plane."""
    angle = np.radians(degrees)
    return [(s * np.cos(angle), 0, s * np.sin(angle)) for s in np.linspace(0, length, n + 1)]


def force_on_plane(run, points, depth, **how):
    _, results = run(standing(points, depth, **how))
    table = results.surface_contacts
    return table["force"][table["increment"] == 2].sum()


@pytest.mark.parametrize("degrees", [90, 40, 15])
def test_a_wire_that_stands_on_a_plane_is_a_sphere_on_it(run, degrees):
    """The cylinder above its end does not reach the plane, though its axis has more overlap than that."""
    depth = 1e-5
    sphere = 4 / 3 * YOUNG / (1 - POISSON**2) * np.sqrt(5e-4) * depth**1.5
    assert force_on_plane(run, leaning(degrees), depth) == pytest.approx(sphere, rel=1e-5)


def kinked(first, second):
    """Points of a wire with a kink at the origin, whose legs rise by these angles."""
    return [(-x, y, z) for x, y, z in leaning(first)[:0:-1]] + leaning(second)


@pytest.mark.parametrize("angles", [(40, 40), (15, 50), (50, 15)])
def test_a_wire_that_stands_on_its_kink_is_a_sphere_on_the_plane(run, angles):
    depth = 1e-5
    sphere = 4 / 3 * YOUNG / (1 - POISSON**2) * np.sqrt(5e-4) * depth**1.5
    assert force_on_plane(run, kinked(*angles), depth) == pytest.approx(sphere, rel=1e-4)


@pytest.mark.parametrize("angle", [0, 0.3])
def test_a_kink_with_a_leg_along_the_plane_has_the_same_force_whichever_leg_comes_first(run, angle):
    one, other = (force_on_plane(run, kinked(*angles), 1e-6) for angles in ((angle, 30), (30, angle)))
    assert one == pytest.approx(other, rel=1e-9)


def test_of_unlike_legs_of_a_kink_the_thicker_one_touches(run):
    depth, points = 1e-6, kinked(30, 30)
    deck = standing(points, depth).replace(
        "*BOUNDARY", "*ELSET, ELSET=THIN\n 9, 10, 11, 12, 13, 14, 15, 16\n*BOUNDARY", 1
    )
    deck = deck.replace("*BOUNDARY", "*BEAM SECTION, ELSET=THIN, MATERIAL=M, SECTION=CIRC\n 4e-4\n*BOUNDARY", 1)
    deck = deck.replace("ELSET=WIRE, MATERIAL=M", "ELSET=THICK, MATERIAL=M").replace(
        "*MATERIAL", "*ELSET, ELSET=THICK\n 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL", 1
    )
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    sphere = 4 / 3 * YOUNG / (1 - POISSON**2) * np.sqrt(5e-4) * depth**1.5
    assert results.surface_contacts_at(-1)["force"].sum() == pytest.approx(sphere, rel=1e-4)


@pytest.mark.parametrize("degrees", [20, 3, 1])
def test_friction_of_an_end_resists_at_any_slope(run, degrees):
    """A plane is pressed on the end of a wire and then drawn along it: force mu N, and its work is heat but for the stick at
    first, 2 % of the path."""
    depth, path, mu = 1e-5, 1e-4, 0.3
    points = [(x, y, z + 5e-4) for x, y, z in leaning(degrees)]
    plane = surface("PLANE", "0, 0, 0, 0, 0, 1", (99, "0, 0, 0"), HERTZ + f"*FRICTION\n {mu}\n")
    held = "*BOUNDARY\n W, 1, 6\n 99, 1, 2\n 99, 4, 6\n"
    pressed = step(f"*BOUNDARY\n 99, 3, 3, {depth}\n*ENERGY PRINT\n", "0.2, 1")
    drawn = step(f"*BOUNDARY\n 99, 1, 1, {path}\n", "0.1, 1, 1e-5, 0.1")
    process, results = run(wire(points, 5e-4) + plane + held + pressed + drawn)
    assert process.returncode == 0, process.stderr
    force = results.field("reaction_force")[-1]
    assert force[0] == pytest.approx(mu * force[2], rel=1e-9)
    assert results.history["ALLFD"][-1] == pytest.approx(mu * force[2] * path, rel=0.03)


def test_a_wire_that_lies_on_a_plane_has_all_of_the_force_along_it(run):
    short, long = (force_on_plane(run, along_x(length, 8), 1e-7) for length in (0.016, 0.032))
    assert long == pytest.approx(2 * short, rel=1e-12)


@pytest.mark.parametrize("laws", [HERTZ, STIFF])
def test_a_tip_that_tilts_flat_keeps_the_balance_of_energies(run, laws):
    """From 0.5 to 0.03 degrees about its tip the contact goes over from the end to the wire beside it. All nodes are led: the
    supports do all of the work, to the error of means over increments."""
    tilt, radius, depth = np.radians(0.5), 5e-4, 1e-6
    along = np.linspace(0, 0.016, 9)
    points = [(x, y, z + radius) for x, y, z in leaning(0.5)]

    def led(part):
        return "*ENERGY PRINT\n*BOUNDARY\n" + "".join(
            f" {i}, 1, 1, {part * s * (1 - np.cos(tilt)):.17g}\n {i}, 2, 2\n {i}, 4, 4\n {i}, 6, 6\n"
            f" {i}, 3, 3, {-depth - part * s * np.sin(tilt):.17g}\n {i}, 5, 5, {part * tilt:.17g}\n"
            for i, s in enumerate(along, 1)
        )

    deck = wire(points, radius) + surface("PLANE", "0, 0, 0, 0, 0, 1", laws=laws)
    process, results = run(
        deck + step(led(0), "1, 1") + step(led(0.94), "0.0025, 1, 1e-9, 0.0025").replace("400", "500")
    )
    assert process.returncode == 0, process.stderr
    held = results.history["ALLCCE"]
    assert held[-1] > 5 * held[1]
    # by means of forces over 400 increments; the energy of the end alone, left out, would be 1
    drift = np.abs(results.history["ETOTAL"][2:] - results.history["ETOTAL"][1])
    assert drift.max() < 4e-3 * held[1]


@pytest.mark.parametrize("laws", [HERTZ, STIFF])
def test_a_wire_that_is_raised_from_a_plane_about_its_end_has_less_force_at_each_angle(run, laws):
    angles = [0, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1, 3, 10, 45, 90]
    forces = [force_on_plane(run, leaning(angle), 1e-7, laws=laws) for angle in angles]
    # (at 90 degrees nothing but the end is left, to half a per cent at 45)
    assert np.all(np.diff(forces) < 5e-3 * forces[-1])
    assert forces[0] > 100 * forces[-1]


def hanging(n, tension, laws, pull=""):
    """Benchmark of a rod over a drum: centre line on a circle of 50 mm, tails pulled down at both ends."""
    radius, r = 0.05, 5e-4
    length = np.pi * radius + 6 * radius
    force = tension * YOUNG * np.pi * r**4 / 4 / radius**2
    drum = surface("CYLINDER", f"0, 0, 0, 0, 1, 0, {radius - r}", laws=laws)
    middle, last = n // 2 + 1, n + 1
    hold = " W, 2, 2\n W, 4, 4\n W, 6, 6\n"
    held = hold + f" {middle}, 1\n {middle}, 5\n"
    text = wire(along_x(length, n, radius + 1e-7), r) + drum + f"*NSET, NSET=END\n {last}\n*BOUNDARY\n{held}"
    text += step(f"*BOUNDARY\n 1, 3, 3, -2e-4\n {last}, 3, 3, -2e-4\n", "1, 1")
    text += step(f"*BOUNDARY, OP=NEW\n{held}*CLOAD\n 1, 3, {-force}\n {last}, 3, {-force}\n", "0.01, 1, 1e-5, 0.1")
    if pull:
        end = f"*BOUNDARY, OP=NEW\n{hold} {last}, 3, 3, {pull}\n*CLOAD, OP=NEW\n 1, 3, {-force}\n"
        text += step(end, "0.02, 1, 1e-5, 0.2")
    return text, force, radius


def test_a_rod_over_a_drum_touches_it_along_an_arc_with_forces_at_its_ends(run):
    """Exact: arc of 128.316 degrees, between points with the force 2.17945 B/R^2 (rigid drum)."""
    n = 120
    text, force, _ = hanging(n, 5, STIFF.replace("1e10", "1e9"))
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    table = results.surface_contacts
    last = (table["step"] == 2) & (table["increment"] == table["increment"][-1])
    angle = np.arctan2(table["point_x"][last], table["point_z"][last])
    order = np.argsort(angle)
    angle, load = angle[order], table["force"][last][order] / (force / 5)
    # force and moment of the first spans are those of the point force P at the angle a and of N/R from there on
    spans, line = 10, 4.5
    to = (angle[spans - 1] + angle[spans]) / 2
    total, moment = load[:spans].sum(), (load * angle)[:spans].sum()
    # P = total - line (to - a), P a = moment - line (to^2 - a^2)/2
    a = np.roots([line / 2, total - line * to, line * to**2 / 2 - moment])
    a = a[np.argmin(abs(a - angle[0]))]
    assert np.degrees(-2 * a) == pytest.approx(128.316134, rel=1e-3)
    assert total - line * (to - a) == pytest.approx(2.17944947, rel=5e-3)


def test_a_drum_pressed_into_a_wire_takes_few_iterations(run):
    """The far field of the arc in touch is brought up to date on the way, not where forces have balanced with an earlier one."""
    n, radius, drum = 20, 5e-4, 0.03
    height = drum + radius
    hold = f"*BOUNDARY\n 1, 1, 4\n {n + 1}, 2, 4\n 999, 1, 2\n 999, 4, 6\n"
    text = wire(along_x(0.04, n), radius)
    text += surface("CYLINDER", f"0, 0, {height}, 0, 1, 0, {drum}", (999, f"0, 0, {height}"), HERTZ) + hold
    process, results = run(text + step("*BOUNDARY\n 999, 3, 3, -4e-3\n", "0.1, 1, 0.1, 0.1"))
    assert process.returncode == 0, process.stderr
    assert results.status["iterations"][1:].mean() <= 6


@pytest.mark.slow
@pytest.mark.parametrize(("tension", "friction", "expected"), [(5, 0.1, 1.33855346), (5, 0.3, 2.42600087)])
def test_a_rod_that_is_pulled_over_a_drum_multiplies_its_tension(run, tension, friction, expected):
    """Exact for friction on the centre line; on the surface its moment takes off about `mu wrap a/R`, a/R = 0.01."""
    text, force, _ = hanging(200, tension, f"*FRICTION\n {friction}\n", pull=-0.2015)
    process, results = run(text.replace("*STATIC\n 0.02", "*NODE PRINT, NSET=END\n RF\n*STATIC\n 0.02"))
    assert process.returncode == 0, process.stderr
    ratio = -results.field("reaction_force")[200, 2] / force
    assert ratio == pytest.approx(expected * (1 - friction * np.pi * 0.01), rel=1e-3)
    assert set(results.surface_contacts["friction"][-20:]) == {"slip"}
    # the first step has forces of round-off
    later = results.steps > 1
    assert max(figure[later].max() for name, figure in results.audit.items() if name.endswith("balance")) < 1e-7


def test_a_ring_between_two_plates_is_shortened_as_by_two_forces(run):
    """`delta = F R^3/(EI) (pi/4 - 2/pi)` of a thin ring (S. Timoshenko, Strength of Materials II); displacements of 0.1 %
    of the radius, and plates that are a thousand times stiffer."""
    radius, r, n, push = 0.05, 5e-4, 80, 5e-5
    angle = 2 * np.pi * np.arange(n) / n
    points = [(radius * np.cos(a), 0, radius * np.sin(a)) for a in angle]
    top = radius + r
    plates = surface("PLANE", f"0, 0, {-top}, 0, 0, 1", laws=STIFF, name="LOWER")
    plates += surface("PLANE", f"0.01, 0, {top}, 0, 0, -1", (99, f"0, 0, {top}"), laws=STIFF, name="UPPER")
    hold = "*BOUNDARY\n W, 2, 2\n W, 4, 4\n W, 6, 6\n 1, 1\n 1, 3\n 1, 5\n 99, 1, 2\n 99, 4, 6\n"
    text = wire(points, r, closed=True) + plates + hold
    text += step(f"*BOUNDARY\n 99, 3, 3, {-push}\n 1, 3, 3, {-push / 2}\n", "0.25, 1")
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    force = -results.field("reaction_force")[-1, 2]
    stiffness = YOUNG * np.pi * r**4 / 4 / radius**3 / (np.pi / 4 - 2 / np.pi)
    table = results.surface_contacts
    last = table["increment"] == table["increment"][-1]
    assert set(table["surface"][last]) == {"LOWER", "UPPER"}
    assert table["force"][last][table["surface"][last] == "LOWER"].sum() == pytest.approx(force, rel=1e-6)
    assert force == pytest.approx(stiffness * push, rel=0.02)


def test_a_rod_that_buckles_in_a_bore_leans_on_its_wall(run):
    """Between the first and four times that load of Euler it touches in one point. With `k^2 = P/(EI)`, half length l and
    clearance c the force there is `Q = 2 P c/(l - tan(k l)/k)`, from the equation of the bent half."""
    length, r, clearance, n = 0.2, 5e-4, 2e-4, 40
    bending = YOUNG * np.pi * r**4 / 4
    force = 2 * np.pi**2 * bending / length**2
    bore = surface("BORE", f"0, 0, 0, 1, 0, 0, {r + clearance}", laws=STIFF)
    hold = f" 1, 1, 4\n {n + 1}, 2, 4\n W, 2, 2\n W, 4, 4\n W, 6, 6\n"
    middle = n // 2 + 1
    text = wire(along_x(length, n), r) + bore + f"*BOUNDARY\n{hold}"
    text += step(f"*BOUNDARY\n {middle}, 3, 3, {-1.0001 * clearance}\n", "1, 1")
    text += step(f"*BOUNDARY, OP=NEW\n{hold}*CLOAD\n {middle}, 3, -0.02\n {n + 1}, 1, {-force}\n", "0.2, 1")
    text += step(f"*BOUNDARY, OP=NEW\n{hold}*CLOAD, OP=NEW\n {n + 1}, 1, {-force}\n", "0.2, 1")
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    table = results.surface_contacts
    last = (table["step"] == 3) & (table["increment"] == table["increment"][-1])
    half, k = length / 2, np.sqrt(force / bending)
    assert table["force"][last].sum() == pytest.approx(2 * force * clearance / (half - np.tan(k * half) / k), rel=5e-3)


ROLLER = wire([(0, -1e-3, 1e-3), (0, 1e-3, 1e-3)], 1e-3) + surface(
    "PLANE", "0, 0, 0, 0, 0, 1", (99, "0, 0, 0"), laws=STIFF + "*FRICTION\n 0.5\n"
)


def test_a_wire_that_is_pushed_over_a_plane_rolls(run):
    """The slip is that of the surfaces: a wire that is free to turn does so by its path over its radius."""
    text = ROLLER + "*BOUNDARY\n W, 2, 2\n W, 4, 4\n W, 6, 6\n 99, 1, 6\n"
    text += step("*BOUNDARY\n W, 1, 1\n W, 5, 5\n W, 3, 3, -1e-7\n", "1, 1")
    text += step(
        "*BOUNDARY, OP=NEW\n W, 2, 2\n W, 3, 3, -1e-7\n W, 4, 4\n W, 6, 6\n 99, 1, 6\n W, 1, 1, 5e-4\n", "0.1, 1"
    )
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    np.testing.assert_allclose(results.field("rotation")[:2, 1], 0.5, rtol=1e-2)
    table = results.surface_contacts
    assert set(table["friction"][table["step"] == 2]) == {"stick"}
    # without a moment on it there is nothing that friction could push against
    assert abs(table["traction_x"][-1]) < 1e-3 * table["force"][-1]


@pytest.mark.parametrize("n", [23, 100])
@pytest.mark.parametrize("increment", [0.2, 0.02])
def test_the_heat_of_friction_is_complete_where_a_contact_slides_along_a_wire(run, n, increment):
    """A wire is drawn along itself across a drum: over elements that touch neither at the beginning nor at the end of an
    increment, heat is work, but for what the spring of the stick holds; the moments balance at each increment."""
    mu, drum, path, depth = 0.3, 5e-3, 2.3e-3, 1e-6
    points = [(x, 0, drum + 5e-4) for x, _, _ in along_x(0.02, n)]
    rigid = "*NODE\n 999, 0, 1e-3, 4e-3\n*RIGID BODY, REF NODE=999, TIE NSET=W\n"
    laws = f"{HERTZ}*FRICTION\n {mu}\n"
    lead = f"*BOUNDARY\n 999, 1, 1, {{}}\n 999, 2\n 999, 3, 3, {-depth}\n 999, 4, 6\n"
    steps = step(lead.format(0) + "*ENERGY PRINT\n", "1, 1") + step(lead.format(path), f"{increment}, 1")
    process, results = run(
        wire(points, 5e-4) + rigid + surface("CYLINDER", f"0, 0, 0, 0, 1, 0, {drum}", laws=laws) + steps
    )
    assert process.returncode == 0, process.stderr
    history = results.history
    begun = history["step"] == 1
    work, heat = (history[name][~begun] - history[name][begun][-1] for name in ("ALLWK", "ALLFD"))
    table = results.surface_contacts
    force = table["force"][table["step"] == 1].sum()
    np.testing.assert_allclose(heat[-1], work[-1], rtol=0.01)
    # in the first increment the traction grows from nothing
    assert heat[-1] == pytest.approx(mu * force * path, rel=0.01 + increment / 2)


def test_a_plane_that_moves_takes_a_wire_along_and_feels_its_forces(run):
    """A plate pressed onto a held wire and moved along it: Coulomb's force, and its moment about the reference node."""
    plate = ROLLER.replace(" 99, 0, 0, 0\n", " 99, 0, 0, -0.01\n")
    text = plate + "*BOUNDARY\n W, 1, 6\n 99, 1, 2\n 99, 4, 6\n"
    text = text.replace(" W, 1, 6\n", " W, 1, 4\n W, 6, 6\n 1, 5\n")
    text += step("*BOUNDARY\n 99, 3, 3, 1e-7\n", "1, 1")
    text += step("*BOUNDARY\n 99, 2, 2, 1e-4\n", "0.1, 1")
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    force, moment = results.field("reaction_force")[-1], results.field("reaction_moment")[-1]
    # what the support of the plate does to it: presses it up and drags it along
    assert force[2] > 1
    np.testing.assert_allclose(force, [0, 0.5 * force[2], force[2]], rtol=1e-6, atol=1e-6 * force[2])
    # the node is 10 mm below the plane, and has moved by 0.1 mm along the wire
    assert moment[0] == pytest.approx(-0.01 * force[1] - 1e-4 * force[2], rel=1e-3)


def test_a_run_with_friction_on_a_drum_goes_on_from_everywhere(litz, tmp_path):
    text, _, _ = hanging(60, 5, "*FRICTION\n 0.1\n")
    head, first, _ = text.split("*STEP, INC=400\n")
    pull = f"*STATIC\n 0.25, 1\n{KEEP_ALL}*BOUNDARY\n 1, 3, 3, -2e-3\n 61, 3, 3, -1e-3\n*END STEP\n"
    assert_goes_on_from_everywhere(litz, tmp_path, head + "*STEP, INC=400\n" + first + "*STEP, INC=400\n" + pull)


def test_a_run_goes_on_with_the_same_shapes_only(litz, tmp_path):
    deck, there = tmp_path / "deck.inp", tmp_path / "there"
    soft = STIFF.replace("LINEAR", "LINEAR, PENETRATION=UNLIMITED")
    drum = surface("CYLINDER", "0, 0, 1e-2, 0, 1, 0, 2e-3", laws=soft)
    words = wire(along_x(0.016, 4), 5e-4) + drum + "*BOUNDARY\n W, 1, 5\n"
    text = words + step("*RESTART, WRITE\n*BOUNDARY\n W, 6, 6, 1e-3\n", "1, 1") + step("")
    deck.write_text(text)
    assert litz("run", deck, "-o", there).returncode == 0
    deck.write_text(text.replace("CYLINDER", "BORE"))
    refused = litz("run", deck, "-o", tmp_path / "here", "--restart", there / "deck.restart.h5")
    assert refused.returncode == 1
    assert "rigid surface S" in refused.stderr
    assert "TYPE" in refused.stderr


def test_a_wire_does_not_pass_through_a_drum(run):
    drum = surface("CYLINDER", "0, 0, 1e-2, 0, 1, 0, 2e-3")
    text = wire(along_x(0.016, 4), 5e-4) + drum + "*BOUNDARY\n W, 1, 2\n W, 4, 4\n W, 6, 6\n 1, 5\n"
    process, _ = run(text + step("*BOUNDARY\n W, 3, 3, 0.02\n", "1, 1, 0.5"))
    assert process.returncode == 2
    assert "the rigid surface S: the wire would pass through it" in process.stderr


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (STIFF, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 1e7\n", "needs its second number"),
        (", REF NODE=99", ", REF NODE=98", 'there is no node "98"'),
        ("NAME=S,", "NAME=WIRE,", 'there is an element set of the name "WIRE"'),
        ("0, 0, 0, 0, 0, 1\n", "0, 0, 0, 0, 0, 0\n", "the direction of a surface cannot be 0 0 0"),
        ("0, 0, 0, 0, 0, 1\n", "0, 0, 1e-4, 0, 0, 1\n", "overlaps the rigid surface S at the start by 10 %"),
        ("TYPE=PLANE", "TYPE=BORE", "radius"),
        ("INTERACTION=IS\n", "INTERACTION=IS, INTERFERENCE FIT\n", "INTERFERENCE FIT is for wires"),
        (STIFF, f"{STIFF}*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n", "has *GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ"),
        (STIFF, f"{STIFF}*GAP CONDUCTANCE, LAW=METAL\n", "has *GAP CONDUCTANCE, LAW=METAL"),
    ],
)
def test_what_is_wrong_with_a_surface_is_said(run, old, new, message):
    text = ROLLER + "*BOUNDARY\n W, 1, 5\n 99, 1, 6\n" + step("*BOUNDARY\n W, 6, 6, 0.1\n")
    assert old in text
    process, _ = run(text.replace(old, new))
    assert process.returncode != 0
    assert message in process.stderr
