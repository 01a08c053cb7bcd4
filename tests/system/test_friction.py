"""Friction of crossing wires: the law as a run shows it, and its memory."""

import itertools

import numpy as np
import pytest

from decks import CONDUCTOR, straight, wire
from litz import Results, build
from same_results import assert_same_end, written

MU = 0.3
PENALTY = 1e7
#: Overlap of the rigid wires [m], and so the force between them [N]
OVERLAP = 2e-7
FORCE = PENALTY * OVERLAP
STICK = 1e5


def rubbing(*steps, friction=f"*FRICTION, STICK STIFFNESS={STICK}\n {MU}", degrees=90.0, spot=""):
    """A fixed wire along x, and one across it, pressed on it with a constant force; `steps` move it, all of it alike."""
    a = np.radians(degrees)
    along = 0.02 * np.array([np.cos(a), np.sin(a), 0.0])
    up = np.array([0, 0, 2e-3])
    lower = wire("LOWER", straight((-0.02, 0, 0), (0.02, 0, 0), 10), 1, element="B33", backwards=(3, 5, 6))
    upper = wire("UPPER", straight(up - along, up + along, 10), 101, element="B33", backwards=(4, 7))
    return f"""*HEADING
rubbing
{lower}{upper}{CONDUCTOR}*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*BEAM SECTION, ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
 {PENALTY}
{friction}
{spot}*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 LOWER, ENCASTRE
 UPPER, 1, 6
 1, 9
 101, 9
*STEP
*STATIC
 1, 1
*BOUNDARY
 UPPER, 3, 3, {-OVERLAP}
*NODE PRINT, NSET=UPPER, TOTALS=ONLY
 RF
*ENERGY PRINT
*END STEP
{"".join(steps)}"""


def move(x, y=0.0, *, increments=10, z=-OVERLAP):
    return f"""*STEP, INC=1000
*STATIC, DIRECT
 {1 / increments!r}, 1
*BOUNDARY
 UPPER, 1, 1, {x:.17g}
 UPPER, 2, 2, {y:.17g}
 UPPER, 3, 3, {z:.17g}
*END STEP
"""


def reaction(results):
    """In-plane force that the supports of the moving wire need, over the increments (n, 2)."""
    return np.stack([results.history[f"RF{i} sum UPPER"] for i in (1, 2)], axis=-1)


def steps_of(results):
    return results.history["step"]


@pytest.mark.parametrize("increments", [4, 40])
def test_a_rubbing_cycle_has_the_loop_of_stick_and_slip(run, increments):
    """F = min(k u, mu N) going, and 4 mu N (U - mu N/k) of heat in a cycle, in large and in small increments."""
    amplitude = 1e-4
    process, results = run(rubbing(*[move(x, increments=increments) for x in (amplitude, -amplitude, amplitude)]))
    assert process.returncode == 0, process.stderr
    going = steps_of(results) == 2
    u = np.linspace(0, amplitude, increments + 1)[1:]
    np.testing.assert_allclose(reaction(results)[going, 0], np.minimum(STICK * u, MU * FORCE), rtol=1e-7)
    heat = results.history["ALLFD"]
    cycle = heat[-1] - heat[going][-1]
    assert cycle == pytest.approx(4 * MU * FORCE * (amplitude - MU * FORCE / STICK), rel=1e-9)
    # what is stored and what has become heat is what the supports have done
    assert np.abs(results.history["ETOTAL"]).max() < 1e-9 * results.history["ALLWK"][-1]
    contact = results.contacts_at(-1)
    assert contact["dissipation"] == pytest.approx(heat[-1], rel=1e-12)
    assert contact["slip_path"] == pytest.approx(heat[-1] / (MU * FORCE), rel=1e-9)


@pytest.mark.parametrize("degrees", [90, 40, 150])
def test_friction_is_the_same_in_every_direction_of_the_plane(run, degrees):
    for phi in np.radians([0, 35, 100, 215]):
        push = np.array([np.cos(phi), np.sin(phi)])
        _, results = run(rubbing(move(*1e-5 * push), move(*5e-5 * push), degrees=degrees))
        forces = reaction(results)
        for i in range(len(results.times)):
            if steps_of(results)[i] > 1:
                size = np.linalg.norm(forces[i])
                np.testing.assert_allclose(forces[i], size * push, atol=1e-7 * MU * FORCE)
        np.testing.assert_allclose(np.linalg.norm(forces[steps_of(results) == 2][4]), STICK * 5e-6, rtol=1e-7)
        np.testing.assert_allclose(np.linalg.norm(forces[-1]), MU * FORCE, rtol=1e-9)


def test_a_rubbed_wire_keeps_its_traction_over_the_ends_of_elements(run):
    """Over four elements of one wire and two of the other, some of which run against their wire."""
    _, results = run(rubbing(move(1.3e-2, 7e-3, increments=37), degrees=60))
    path = np.hypot(1.3e-2, 7e-3)
    contacts = results.contacts
    assert len(set(contacts["id"])) == 1
    assert len(set(contacts["element_2"])) > 2
    assert len(set(contacts["element_1"])) > 3
    slipping = contacts["friction"] == "slip"
    assert slipping[1:].all()
    traction = np.stack([contacts[f"traction_{i}"] for i in "xyz"], axis=-1)[1:]
    np.testing.assert_allclose(traction, MU * FORCE * np.array([1.3e-2, 7e-3, 0]) / path * np.ones((37, 1)), rtol=1e-6,
                               atol=1e-7)  # fmt: skip
    assert contacts["dissipation"][-1] == pytest.approx(MU * FORCE * (path - MU * FORCE / STICK), rel=1e-6)


def test_a_contact_that_opens_forgets_its_traction(run):
    _, results = run(rubbing(move(1e-4), move(1e-4, z=1e-6), move(1e-4), move(1.02e-4, increments=1)))
    contacts = results.contacts
    reclosed = contacts["time"] > 3.0
    last = results.contacts_at(-1)
    assert (contacts["dissipation"][reclosed] == 0).all()
    # sticks again, from where it closed
    assert list(last["friction"]) == ["stick"]
    assert reaction(results)[-1, 0] == pytest.approx(STICK * 2e-6, rel=1e-7)


OPEN = 3 * OVERLAP


def closing(x, y=0.0, *, increments=1, friction=f"*FRICTION, STICK STIFFNESS={STICK}\n {MU}"):
    """The wires part, and then close in proportion as the upper one moves: they touch at three quarters of the way."""
    deck = rubbing(move(x, y, increments=increments), friction=friction)
    return deck.replace(f"UPPER, 3, 3, {-OVERLAP}", f"UPPER, 3, 3, {OPEN}", 1)


@pytest.mark.parametrize("x", [4e-6, 4e-4, -4e-4])
def test_a_contact_that_closes_slips_from_where_it_has_closed(run, x):
    """T = min(k D, mu F) with the slip D after first touch, and mu F/2 for its heat: the force grows with the slip."""
    _, results = run(closing(x))
    contact = results.contacts_at(-1)
    slip = x * OVERLAP / (OVERLAP + OPEN)
    traction = np.sign(x) * min(STICK * abs(slip), MU * FORCE)
    assert contact["traction_x"] == pytest.approx(traction, rel=1e-7)
    assert reaction(results)[-1] == pytest.approx([traction, 0], rel=1e-7, abs=1e-12)
    slipped = abs(slip) - abs(traction) / STICK
    assert contact["slip_path"] == pytest.approx(slipped, rel=1e-6, abs=1e-12)
    heat = MU * FORCE / 2 * slipped
    assert contact["dissipation"] == pytest.approx(heat, rel=1e-6, abs=1e-15)
    # along the wires only after the touch; across them the mean force times the way, as of all supports
    work = FORCE / 2 * (OPEN + OVERLAP) + traction**2 / (2 * STICK) + heat
    assert results.history["ALLWK"][-1] == pytest.approx(work, rel=1e-6)


@pytest.mark.parametrize("increments", [4, 40])
def test_a_contact_that_closes_has_the_same_friction_in_any_number_of_increments(run, increments):
    _, once = run(closing(2e-4, 1e-4), name="once")
    _, often = run(closing(2e-4, 1e-4, increments=increments), name="often")
    for name in ("force", "traction_x", "traction_y"):
        assert once.contacts_at(-1)[name] == pytest.approx(often.contacts_at(-1)[name], rel=1e-6)


def test_a_contact_that_closes_goes_on_sliding_or_sticking_in_the_next_increment(run):
    """The traction of the closing increment is remembered: turning back, it falls by the stick stiffness."""
    back = 4e-6
    _, results = run(closing(4e-4) + move(4e-4 - back, increments=2))
    np.testing.assert_allclose(reaction(results)[-2:, 0], MU * FORCE - STICK * back * np.array([0.5, 1]), rtol=1e-6)


def test_elastic_slip_is_where_friction_reaches_its_limit(run):
    _, results = run(rubbing(move(1e-5), friction=f"*FRICTION, ELASTIC SLIP=4e-6\n {MU}"))
    u = np.linspace(0, 1e-5, 11)[1:]
    expected = MU * FORCE * np.minimum(u / 4e-6, 1)
    np.testing.assert_allclose(reaction(results)[steps_of(results) == 2, 0], expected, rtol=1e-7)


def test_without_a_stiffness_a_contact_sticks_as_stiff_as_mindlin_says(run):
    _, results = run(rubbing(move(1e-8), friction=f"*FRICTION\n {MU}"))
    assert reaction(results)[-1, 0] == pytest.approx(2 * (1 - 0.34) / (2 - 0.34) * PENALTY * 1e-8, rel=1e-6)


RADIUS = 1e-3


def turn(x, angle, *, increments=10):
    """The upper wire, which lies along y, moves along the lower one and turns about its own axis."""
    return move(x, increments=increments).replace("*END STEP", f" UPPER, 5, 5, {angle:.17g}\n*END STEP")


@pytest.mark.parametrize("increments", [1, 10])
def test_a_wire_that_rolls_on_the_other_feels_no_friction(run, increments):
    way = 1e-3
    _, results = run(rubbing(turn(way, way / RADIUS, increments=increments)))
    # the radius at which it rolls is that of the surface in which the overlap is shared
    assert np.abs(reaction(results)).max() < STICK * way * OVERLAP / RADIUS
    contacts = results.contacts
    assert set(contacts["friction"]) == {"stick"}
    assert contacts["slip_path"][-1] == 0


@pytest.mark.parametrize("increments", [1, 10])
def test_a_wire_that_turns_on_the_spot_slips_and_gives_both_wires_their_moments(run, increments):
    """The friction has the arm of either radius: it turns the one wire back about its axis, and bends the other."""
    angle = 0.1
    deck = rubbing(turn(0, angle, increments=increments))
    deck = deck.replace(" RF\n", " RF, RM\n").replace(
        "*ENERGY PRINT", "*NODE PRINT, NSET=LOWER, TOTALS=ONLY\n RM\n*ENERGY PRINT"
    )
    _, results = run(deck)
    contact = results.contacts_at(-1)
    assert list(contact["friction"]) == ["slip"]
    assert contact["slip_path"] == pytest.approx(RADIUS * angle - MU * FORCE / STICK, rel=1e-3)
    assert contact["dissipation"] == pytest.approx(MU * FORCE * contact["slip_path"], rel=1e-6)
    # its lowest point goes against x: the supports hold it back
    assert reaction(results)[-1] == pytest.approx([-MU * FORCE, 0], rel=1e-6, abs=1e-9)
    # moments of the supports about the axes of the nodes, which lie in one plane for each wire
    upper, lower = (results.history[f"RM2 sum {name}"][-1] for name in ("UPPER", "LOWER"))
    assert upper == pytest.approx(RADIUS * MU * FORCE, rel=1e-3)
    assert lower == pytest.approx(RADIUS * MU * FORCE, rel=1e-3)


def test_no_friction_is_a_coefficient_of_zero(run):
    steps = [move(1e-4, 2e-4)]
    _, without = run(rubbing(*steps, friction=""), name="without")
    _, zero = run(rubbing(*steps, friction="*FRICTION\n 0"), name="zero")
    for name in ("displacement", "reaction_force", "axial_force"):
        np.testing.assert_array_equal(zero.field(name, None), without.field(name, None))


def test_a_spot_that_remembers_keeps_the_resistance_of_the_largest_force_until_it_slips(run):
    spot = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE\n"
    pressed, released = -5 * OVERLAP, -OVERLAP
    slip, back = (move(x, z=released, increments=1) for x in (1e-4, 0.99e-4))
    _, results = run(rubbing(move(0, z=pressed), move(0, z=released), slip, back, spot=spot))
    contacts = results.contacts
    resistance = {step: contacts["resistance"][contacts["step"] == step] for step in (1, 2, 3, 4, 5)}
    # slightly more force: slightly less resistance, down to a fifth of the force to the power of one third
    assert resistance[2][-1] == pytest.approx(resistance[1][-1] * 5 ** (-1 / 3), rel=1e-7)
    np.testing.assert_allclose(resistance[3], resistance[2][-1], rtol=1e-12)
    np.testing.assert_allclose(resistance[4][-1], resistance[1][-1], rtol=1e-7)
    # it sticks again, and has forgotten the larger force
    assert contacts["friction"][-1] == "stick"
    np.testing.assert_allclose(resistance[5], resistance[1][-1], rtol=1e-7)


def test_a_contact_that_an_interference_fit_closes_slips_from_where_it_has_closed(run):
    """Lifted off first, and lowered while half of the fit is resolved: it touches half-way, and slips the other half."""
    fit, slip = 4 * OVERLAP, 1e-6
    lift = "*AMPLITUDE, NAME=LIFT\n 0, 0, 0.25, 1, 0.5, 0\n*AMPLITUDE, NAME=DRAG\n 0, 0, 0.25, 0, 0.5, 1\n"
    deck = rubbing().replace("*CONTACT PAIR, INTERACTION=TOUCH", "*CONTACT PAIR, INTERACTION=TOUCH, INTERFERENCE FIT")
    deck = deck.replace("0.002\n", f"{2e-3 - fit:.17g}\n").replace(" 1, 1\n*BOUNDARY", " 0.25, 1\n*BOUNDARY", 1)
    deck = deck.replace("*STATIC\n", "*STATIC, DIRECT\n").replace(
        f"*BOUNDARY\n UPPER, 3, 3, {-OVERLAP}\n",
        f"*BOUNDARY, AMPLITUDE=LIFT\n UPPER, 3, 3, {3 * OVERLAP}\n*BOUNDARY, AMPLITUDE=DRAG\n UPPER, 1, 1, {slip}\n",
    )
    process, results = run(lift + deck)
    assert process.returncode == 0, process.stderr
    contact = results.contacts.where(results.contacts["increment"] == 2)
    # gap of the law: 2 overlaps at the start of the second increment, minus 2 at its end
    assert contact["force"] == pytest.approx([2 * FORCE], rel=1e-9)
    assert abs(contact["traction_x"]) == pytest.approx([STICK * slip / 2], rel=1e-7)


def test_a_spot_without_friction_stays_until_the_contact_has_moved_by_more_than_it(run):
    spot = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE\n"
    pressed, released = -5 * OVERLAP, -OVERLAP
    # the spot of Hertz under five times the force; 1.34 is 1 - nu squared, over twice E of 120 GPa
    radius = (3 * 5 * FORCE * 1e-3 * (1 - 0.34**2) / (2 * 120e9)) ** (1 / 3)
    steps = [move(0, z=pressed)] + [move(x * radius, z=released) for x in (0.0, 0.5, -0.9, 1.5, 2.0)]
    _, results = run(rubbing(*steps, friction="", spot=spot))
    contacts = results.contacts
    first, largest, still, there, back, beyond, on = (
        contacts["resistance"][contacts["step"] == step][-1] for step in range(1, 8)
    )
    np.testing.assert_allclose([still, there, back], largest, rtol=1e-9)
    # the new spot is that of the force there
    np.testing.assert_allclose([beyond, on], first, rtol=1e-9)


# with wires that bend


def bending(*steps, law="HERTZ", friction=f"*FRICTION\n {MU}", degrees=70.0):
    """Two clamped copper wires that cross; their ends are moved."""
    a = np.radians(degrees)
    along = 0.05 * np.array([np.cos(a), np.sin(a), 0.0])
    up = np.array([0, 0, 2e-3])
    lower = wire("LOWER", straight((-0.05, 0, 0), (0.05, 0, 0), 11), 1, element="B33")
    upper = wire("UPPER", straight(up - along, up + along, 11), 101, element="B33")
    return f"""*HEADING
rubbing of wires that bend
{lower}{upper}{CONDUCTOR}*NSET, NSET=ENDS
 101, 112
*NSET, NSET=FIXED
 1, 12
*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*BEAM SECTION, ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}
{friction}
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 FIXED, ENCASTRE
 ENDS, 1, 6
 1, 9
 101, 9
*STEP
*STATIC, DIRECT
 0.5, 1
*BOUNDARY
 ENDS, 3, 3, -1e-4
*ENERGY PRINT
*END STEP
{"".join(steps)}"""


def drag(x, y=0.0, *, static="0.1, 1", direct=True, extra=""):
    return f"""*STEP, INC=1000
*STATIC{", DIRECT" if direct else ""}
 {static}
*BOUNDARY
 ENDS, 1, 1, {x:.17g}
 ENDS, 2, 2, {y:.17g}
{extra}*END STEP
"""


@pytest.mark.parametrize("law", ["HERTZ", "LINEAR\n 1e6"])
@pytest.mark.parametrize("gap", [0.0, 3e-5])
def test_wires_pressed_and_dragged_at_once_have_their_friction_in_a_single_increment(run, law, gap):
    """Opposite to the slip, and mu F; the same as in 60 increments of the same path, to squares of the rotations."""
    push = np.array([2.0, 1.0]) / np.sqrt(5)
    contacts = []
    for n in (1, 2, 6, 60):
        pressed = f"ENDS, 3, 3, -1e-4\n ENDS, 1, 1, {2e-3 * push[0]:.17g}\n ENDS, 2, 2, {2e-3 * push[1]:.17g}"
        deck = bending(law=law, friction="*FRICTION\n 0.5").replace("ENDS, 3, 3, -1e-4", pressed)
        deck = raised(deck, gap).replace(" 0.5, 1\n", f" {1 / n!r}, 1\n")
        _, results = run(deck, name=f"increments{n}")
        contacts.append(results.contacts_at(-1))
    for contact in contacts:
        assert list(contact["friction"]) == ["slip"]
        traction = np.array([contact[f"traction_{i}"][0] for i in "xyz"])
        assert np.linalg.norm(traction) == pytest.approx(0.5 * contact["force"][0], rel=1e-9)
        assert contact["force"] == pytest.approx(contacts[-1]["force"], rel=1e-4)
        reference = np.array([contacts[-1][f"traction_{i}"][0] for i in "xyz"])
        np.testing.assert_allclose(traction, reference, atol=1e-3 * np.linalg.norm(reference))
        np.testing.assert_allclose(traction[:2] / np.linalg.norm(traction[:2]), push, atol=0.01)


def raised(deck, gap):
    """The deck of `bending` with the upper wire higher by `gap` [m]."""
    return deck.replace(", 0.002\n", f", {2e-3 + gap:.17g}\n") if gap else deck


@pytest.mark.parametrize(("status", "distance"), [("stick", 2e-7), ("slip", 1e-3)])
@pytest.mark.parametrize("law", ["HERTZ", "LINEAR\n 1e6"])
def test_the_iteration_converges_quadratically_in_stick_and_in_slip(run, law, status, distance):
    _, results = run(bending(drag(distance, distance / 3, extra="*CONTROLS, PARAMETERS=FIELD\n 1e-12\n"), law=law))
    assert list(results.contacts_at(-1)["friction"]) == [status]
    table = results.convergence
    last = (table["step"] == 2) & (table["increment"] == 2)
    force = table["force"][last]
    force = force[force > 10 * table["force_allowed"][last]][1:] / (MU * results.contacts_at(-1)["force"])
    assert len(force) <= 4
    for before, after in itertools.pairwise(force):
        assert after < before**2


@pytest.mark.parametrize("growth", [5.0, 0.1])
@pytest.mark.parametrize("increments", [1, 2, 10])
def test_the_heat_of_a_slip_under_a_changing_force_is_its_work(run, increments, growth):
    """The force goes in proportion to the way from F to `growth` F: heat is mu times the mean force times the slip.

    What supports have done, by their own forces and ways, is that heat, the elastic slip, and the overlap.
    """
    begin, way = 2e-5, 2e-4
    deck = rubbing(move(begin, increments=1), move(begin + way, increments=increments, z=-growth * OVERLAP))
    process, results = run(deck.replace(" RF\n", " RF, U\n"))
    assert process.returncode == 0, process.stderr
    history, last = results.history, results.history["step"] == 3
    first = np.flatnonzero(last)[0] - 1
    slip = way - MU * (growth - 1) * FORCE / STICK
    heat = history["ALLFD"][-1] - history["ALLFD"][first]
    assert heat == pytest.approx(MU * FORCE * (1 + growth) / 2 * slip, rel=1e-6)
    force = np.stack([history[f"RF{i} sum UPPER"] for i in (1, 2, 3)], axis=-1)[first:]
    place = np.stack([history[f"U{i} mean UPPER"] for i in (1, 2, 3)], axis=-1)[first:]
    work = ((force[1:] + force[:-1]) / 2 * np.diff(place, axis=0)).sum()
    assert history["ALLWK"][-1] - history["ALLWK"][first] == pytest.approx(work, rel=1e-6)
    # the slip begins within the second step: what it does there beyond the mean of its forces is counted
    assert abs(history["ETOTAL"][-1]) < 1e-9 * history["ALLWK"][-1]


def test_a_turn_of_the_whole_model_leaves_the_traction_as_it_is(run):
    """All supports turn about z by half a radian, with a contact that sticks under load."""
    drags = drag(2e-7, 1e-7)
    _, results = run(bending(drags), name="first")
    before = results.contacts_at(-1)
    ids = list(results.node_ids)
    turns = []
    for angle in np.linspace(0, 0.5, 11)[1:]:
        turned = z_rotation(angle)
        cards = ""
        for node in (1, 12, 101, 112):
            row = ids.index(node)
            u = turned @ results.positions()[row] - results.nodes[row]
            cards += "".join(f" {node}, {dof}, {dof}, {u[dof - 1]:.17g}\n" for dof in (1, 2, 3))
            cards += f" {node}, 4, 5\n {node}, 6, 6, {angle:.17g}\n"
        turns.append(f"*STEP\n*STATIC, DIRECT\n 1, 1\n*BOUNDARY\n{cards}*END STEP\n")
    process, results = run(bending(drags, *turns), name="turned")
    assert process.returncode == 0, process.stderr
    after = results.contacts_at(-1)
    assert list(after["friction"]) == list(before["friction"]) == ["stick"]
    vectors = [np.array([table[f"traction_{i}"][0] for i in "xyz"]) for table in (before, after)]
    assert np.linalg.norm(vectors[0]) > 1e-3
    np.testing.assert_allclose(vectors[1], turned @ vectors[0], atol=1e-6 * np.linalg.norm(vectors[0]))
    assert after["force"] == pytest.approx(before["force"], rel=1e-9)


def z_rotation(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def test_an_increment_that_is_cut_leaves_no_trace(run):
    """The first attempt slips far and fails for want of iterations; what follows is as if it had never been."""
    cut = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , 5\n"
    _, tried = run(bending(drag(4e-3, 2e-3, static="1, 1, 1e-3", direct=False, extra=cut)), name="tried")
    assert tried.status["attempts"].max() > 1
    times = tried.history["time"][tried.history["step"] == 2] - 1
    steps = [
        drag(4e-3 * last, 2e-3 * last, static=f"{last - first:.17g}, {last - first:.17g}")
        for first, last in zip([0.0, *times[:-1]], times, strict=True)
    ]
    _, straight_on = run(bending(*steps), name="straight_on")
    np.testing.assert_allclose(tried.field("displacement"), straight_on.field("displacement"), rtol=0, atol=1e-11)
    for name in ("force", "traction_x", "traction_y", "slip_path", "dissipation"):
        assert tried.contacts_at(-1)[name] == pytest.approx(straight_on.contacts_at(-1)[name], rel=1e-6), name


@pytest.mark.parametrize("law", ["HERTZ", "LINEAR\n 1e6"])
def test_the_energies_balance_as_the_increments_become_small(run, law):
    errors = []
    for n in (10, 20):
        _, results = run(bending(drag(1e-3, 2e-3, static=f"{1 / n!r}, 1"), law=law), name=f"steps{n}")
        history = results.history
        dragging = history["step"] == 2
        errors.append(abs(history["ETOTAL"][-1] - history["ETOTAL"][~dragging][-1]) / history["ALLFD"][-1])
    assert errors[0] < 1e-6
    assert errors[1] < 0.65 * errors[0]


def test_a_restart_remembers_traction_slip_and_energies(run, tmp_path):
    steps = [drag(3e-4, 1e-4), drag(-2e-4)]
    deck = bending(*steps).replace("*ENERGY PRINT", "*ENERGY PRINT\n*RESTART, WRITE, FREQUENCY=1", 1)
    _, whole = run(deck, name="whole")
    restart = tmp_path / "whole" / "whole.restart.h5"
    process, continued = run(deck, "--restart", f"{restart}:2:5", name="continued")
    assert process.returncode == 0, process.stderr
    for name in ("displacement", "rotation", "reaction_force"):
        np.testing.assert_array_equal(continued.field(name), whole.field(name))
    for column in ("force", "traction_x", "traction_y", "slip_path", "dissipation"):
        assert continued.contacts_at(-1)[column] == whole.contacts_at(-1)[column]
    for column in ("ALLWK", "ALLSE", "ALLCCE", "ALLFD"):
        assert continued.history[column][-1] == whole.history[column][-1]


@pytest.mark.slow
def test_a_run_goes_on_with_all_that_contacts_remember(litz, tmp_path):
    """Pressed and released, so that the spot is that of the largest force; stuck, slipping with more and more force, and
    opened at last, where the energy of the spring becomes heat."""
    spot = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE\n"
    pressed, released = -5 * OVERLAP, -2 * OVERLAP
    steps = [
        move(0, z=pressed, increments=1),
        move(4e-6, z=released, increments=2),
        move(1e-4, 5e-5, z=2 * pressed, increments=2),
        move(1.02e-4, 5e-5, z=released, increments=2),
        move(1.02e-4, 5e-5, z=OVERLAP, increments=1),
    ]
    deck = tmp_path / "deck.inp"
    deck.write_text(rubbing(*steps, spot=spot).replace("*ENERGY PRINT", "*ENERGY PRINT\n*RESTART, WRITE", 1))
    assert litz("run", deck, "-o", tmp_path / "whole").returncode == 0
    whole = Results(tmp_path / "whole")
    assert {"stick", "slip"} <= set(whole.contacts["friction"])
    kept = written(tmp_path / "whole" / "deck.restart.h5")
    for step, increment in kept[:-1]:
        place = f"{tmp_path / 'whole' / 'deck.restart.h5'}:{step}:{increment}"
        part = tmp_path / f"part_{step}_{increment}"
        done = litz("run", deck, "-o", part, "--restart", place)
        assert done.returncode == 0, done.stderr
        assert_same_end(whole, Results(part), step, increment)


# a closed wire


def rubbed_ring(first):
    """A fixed ring of 24 elements, and a straight wire across it that is dragged along it; its node `first` is node 1."""
    angles = 2 * np.pi * (np.arange(24) + first) / 24
    ring = wire(
        "RING", 0.02 * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1), element="B33", closed=True
    )
    across = wire("ACROSS", straight((0.012, -3e-3, 2e-3), (0.028, -3e-3, 2e-3), 3), 101, element="B33")
    step = "*BOUNDARY\n ACROSS, 3, 3, {z}\n ACROSS, 2, 2, {y}\n*END STEP\n"
    return f"""*HEADING
a ring rubbed
{ring}{across}{CONDUCTOR}*BEAM SECTION, ELSET=RING, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*BEAM SECTION, ELSET=ACROSS, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
 {PENALTY}
*FRICTION, STICK STIFFNESS={STICK}
 {MU}
*CONTACT PAIR, INTERACTION=TOUCH
 RING, ACROSS
*BOUNDARY
 RING, ENCASTRE
 ACROSS, 1, 6
 1, 9
 101, 9
*STEP
*STATIC, DIRECT
 1, 1
{step.format(z=-OVERLAP, y=0)}*STEP
*STATIC, DIRECT
 0.125, 1
{step.format(z=-OVERLAP, y=6e-3)}"""


def test_a_closed_wire_remembers_where_its_numbering_begins(run):
    """Rubbed over node 1, or with node 1 on the far side: one contact, that slips all the way with mu F."""
    tables = []
    for first in (0, 12):
        process, results = run(rubbed_ring(first), name=f"first{first}")
        assert process.returncode == 0, process.stderr
        tables.append(results.contacts)
    over, elsewhere = tables
    assert set(over["id"]) == set(elsewhere["id"]) == {1}
    assert len(over["id"]) == 9
    assert set(over["element_1"]) == {1, 24}
    assert (over["friction"][1:] == "slip").all()
    traction = np.stack([over[f"traction_{i}"] for i in "xyz"], axis=-1)[1:]
    np.testing.assert_allclose(np.linalg.norm(traction, axis=1), MU * over["force"][1:], rtol=1e-9)
    for name in ("force", "traction_x", "traction_y", "traction_z", "slip_path", "dissipation"):
        np.testing.assert_allclose(over[name], elsewhere[name], rtol=1e-9, atol=1e-9 * np.abs(elsewhere[name]).max())


@pytest.mark.slow
def test_a_mat_with_friction_is_pressed_and_released_without_a_cut(run):
    """Contacts open and close within the iterations: none may keep a force of before. And what the shares of contacts and the
    bends of wires change is known before forces balance: at most six iterations an increment with contacts, on average."""
    model = build.fibre_mat((10e-3, 10e-3), 10, radius=0.1e-3, seed=11, n_layers=4, clearance=5e-6)
    model.press(40e-6, voltage=1e-3)
    model.press(0.0, voltage=1e-3, name="RELEASE")
    hertz = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
    deck = model.to_deck().replace(hertz, f"{hertz}*FRICTION\n 0.3\n")
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert results.status["attempts"].max() == 1
    assert results.status["contacts"].max() > 300
    touching = np.array(results.status["contacts"]) > 0
    assert np.mean(np.array(results.status["iterations"])[touching]) <= 6


@pytest.mark.slow
def test_nothing_is_left_to_settle_where_the_forces_of_mats_balance(run):
    """Shares and bends keep pace with the iteration: where that ended after three iterations of an increment, one more
    followed in half of the increments, 124 in all against 114."""
    iterations = 0
    for side, n_fibres, n_layers, pressed in ((10e-3, 10, 8, 85e-6), (13e-3, 14, 6, 65e-6)):
        model = build.fibre_mat((side, side), n_fibres, radius=0.1e-3, seed=11, n_layers=n_layers, clearance=5e-6)
        model.press(pressed, voltage=1e-3)
        model.press(0.0, voltage=1e-3, name="RELEASE")
        hertz = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
        process, results = run(model.to_deck().replace(hertz, f"{hertz}*FRICTION\n 0.1\n"), name=f"layers{n_layers}")
        assert process.returncode == 0, process.stderr
        assert results.status["attempts"].max() == 1
        touching = np.array(results.status["contacts"]) > 0
        assert np.count_nonzero(touching) == 9
        iterations += np.array(results.status["iterations"])[touching].sum()
    assert iterations < 120


@pytest.mark.slow
@pytest.mark.parametrize("coefficient", [1e-5, 1e-3])
def test_a_very_small_friction_in_a_mat_hardly_matters(run, coefficient):
    """Neither to the forces, which it changes in proportion, nor to the iterations: slips that turn back do not stick."""
    model = build.fibre_mat((10e-3, 10e-3), 6, radius=0.1e-3, seed=1, n_layers=4, clearance=5e-6)
    model.press(40e-6, voltage=1e-3)
    hertz = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
    without, with_friction = (
        run(model.to_deck().replace(hertz, hertz + friction), name=name)[1]
        for name, friction in (("without", ""), ("with_friction", f"*FRICTION\n {coefficient}\n"))
    )
    assert with_friction.status["attempts"].max() == 1
    assert with_friction.status["iterations"].sum() <= 1.6 * without.status["iterations"].sum()
    force, force_without = (results.contacts_at(-1)["force"].sum() for results in (with_friction, without))
    assert force == pytest.approx(force_without, rel=20 * coefficient)
