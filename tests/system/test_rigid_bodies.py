"""Rigid bodies: nodes that move with a reference node clamp, bend, twist and pull wires as closed forms say."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import root

from decks import straight, wire
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH = 1e11, 5e-4, 0.3
CONDUCTIVITY = 1e7
#: Bending stiffness and, with Poisson's ratio, torsional stiffness of a wire [N m^2]
EI = YOUNG * np.pi * RADIUS**4 / 4
#: Distance of wires from the axis of the bundle [m]
ARM = 5e-3
A, B = 901, 902


def bundle(
    places, step, *, poisson=0.3, kind="TIE", held="1, 6", elements=20, element="B33", static="0.05, 1, 1e-3, 0.05"
):
    """Parallel wires along x, through these places (y, z), between two rigid bodies with reference nodes on the axis."""
    text, first = "", 1
    for y, z in places:
        text += wire("WIRES", straight((0, y, z), (LENGTH, y, z), elements), first, element=element)
        first += elements + 1
    starts = range(1, first, elements + 1)
    ends = [start + elements for start in starts]
    return (
        f"{text}*NODE\n {A}, 0, 0, 0\n {B}, {LENGTH}, 0, 0\n"
        f"*NSET, NSET=STARTS\n {', '.join(map(str, starts))}\n*NSET, NSET=ENDS\n {', '.join(map(str, ends))}\n"
        f"*NSET, NSET=CLAMPS\n {A}, {B}\n"
        f"*RIGID BODY, REF NODE={A}, {kind} NSET=STARTS\n*RIGID BODY, REF NODE={B}, {kind} NSET=ENDS\n"
        f"*MATERIAL, NAME=STEEL\n*ELASTIC\n {YOUNG}, {poisson}\n"
        f"*BEAM SECTION, ELSET=WIRES, MATERIAL=STEEL, SECTION=CIRC\n {RADIUS}\n"
        f"*BOUNDARY\n {A}, {held}\n*STEP, INC=500\n*STATIC\n {static}\n{step}\n"
        "*NODE PRINT, NSET=CLAMPS\n U, UR, RF, RM\n*ENERGY PRINT\n*END STEP\n"
    )


def ring(n, radius=ARM):
    angles = 2 * np.pi * np.arange(n) / n
    return [(radius * np.cos(angle), radius * np.sin(angle)) for angle in angles]


def twisted(turns, extra=""):
    return f"*BOUNDARY\n {B}, 2, 3\n {B}, 4, 4, {2 * np.pi * turns!r}\n {B}, 5, 6{extra}"


def finished(run, deck, *arguments, name="deck"):
    process, results = run(deck, *arguments, name=name)
    assert process.returncode == 0, process.stderr
    return results


def last(results, quantity, node):
    return results.history[f"{quantity} node {node}"][-1]


def elastica_with_an_arm(px, py, along, across):
    """Displacement of the end of a rigid arm at the tip of an inextensible cantilever, loaded there; rotation of the tip."""

    def tip(point, part):
        def slope(_, state):
            angle, x, y = state
            moment = part * ((point[0] - x) * py - (point[1] - y) * px)
            return moment / EI, np.cos(angle), np.sin(angle)

        angle, x, y = solve_ivp(slope, (0, LENGTH), (0, 0, 0), rtol=1e-10, atol=1e-12).y[:, -1]
        arm = along * np.cos(angle) - across * np.sin(angle), along * np.sin(angle) + across * np.cos(angle)
        return np.array([x + arm[0], y + arm[1]]), angle

    point = start = np.array([LENGTH + along, across])
    for part in np.linspace(0.05, 1, 20):
        point = root(lambda p, part=part: tip(p, part)[0] - p, point, tol=1e-11).x
    return point - start, tip(point, 1)[1]


def test_a_cantilever_loaded_at_the_end_of_a_rigid_arm_is_an_eccentric_elastica(run):
    """Tip turned by 101 degrees. The program's wire stretches by N/EA = 6e-6; 20 elements are exact to 1e-5."""
    px, py, along, across = -4 * EI / LENGTH**2, EI / LENGTH**2, 0.1 * LENGTH, 0.3 * LENGTH
    load = f"*CLOAD\n {B}, 1, {px!r}\n {B}, 2, {py!r}"
    deck = bundle([(0, 0)], load).replace(f" {B}, {LENGTH}, 0, 0", f" {B}, {LENGTH + along}, {across}, 0")
    results = finished(run, deck)
    moved, angle = elastica_with_an_arm(px, py, along, across)
    assert angle > np.radians(100)
    assert [last(results, "U1", B), last(results, "U2", B)] == pytest.approx(moved, rel=3e-5)
    assert last(results, "UR3", B) == pytest.approx(angle, rel=3e-5)
    # the clamp carries the force and its moment about the clamp, both to round-off
    x, y = LENGTH + along + moved[0], across + moved[1]
    assert [last(results, "RF1", A), last(results, "RF2", A)] == pytest.approx([-px, -py], rel=1e-7)
    assert last(results, "RM3", A) == pytest.approx(-(x * py - y * px), rel=3e-5)


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_an_off_axis_wire_with_equal_stiffnesses_is_wound_into_a_helix_by_a_pure_torque(run, element):
    """With GJ = EI the moment vector K e_x bends and twists as K/EI about x everywhere: the exact equilibrium for any
    angle phi = K L/EI is the helix of the arm's radius, without force, with the slope cos(a) = phi R/L."""
    # about its arm, which is y, the first clamp turns freely; so does the second one about its own
    held = f"1, 4\n {A}, 6"
    step = f"*BOUNDARY\n {B}, 2, 3\n {B}, 4, 4, {1.6 * np.pi!r}"
    results = finished(run, bundle([(ARM, 0)], step, poisson=0.0, held=held, elements=40, element=element))
    end = results.positions()[40, 1:]
    angle = np.arctan2(end[1], end[0]) % (2 * np.pi)
    assert angle == pytest.approx(1.6 * np.pi, rel=1e-4)
    assert np.linalg.norm(end) == pytest.approx(ARM, rel=1e-8)
    assert last(results, "RM1", B) == pytest.approx(EI * angle / LENGTH, rel=1e-4)
    assert last(results, "RM1", A) == pytest.approx(-EI * angle / LENGTH, rel=1e-4)
    assert last(results, "U1", B) == pytest.approx(LENGTH * (np.sqrt(1 - (angle * ARM / LENGTH) ** 2) - 1), rel=2e-3)
    # of the forces that the clamps could carry there are none: far below K over the arm, 16 N
    assert [last(results, f"RF{i}", B) for i in (1, 2, 3)] == pytest.approx([0, 0, 0], abs=1e-3)


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_after_two_turns_the_wires_of_a_bundle_are_straight_and_have_the_torque_of_their_torsion(run, element):
    """Nothing keeps wires from crossing the axis: on the way they are pulled askew, after each turn only twisted."""
    pull = 200.0
    results = finished(run, bundle([(0, 0), *ring(6)], twisted(2, f"\n*CLOAD\n {B}, 1, {pull}"), element=element))
    torque = 7 * EI / 1.3 * 4 * np.pi / LENGTH
    assert last(results, "RM1", B) == pytest.approx(torque, rel=1e-6)
    assert last(results, "RM1", A) == pytest.approx(-torque, rel=1e-6)
    assert last(results, "RF1", A) == pytest.approx(-pull, rel=1e-9)
    assert last(results, "U1", B) == pytest.approx(pull * LENGTH / (7 * YOUNG * np.pi * RADIUS**2), rel=1e-6)
    # after half a turn
    assert results.history[f"U1 node {B}"][results.index(1, 5)] < -(ARM**2) / LENGTH


def test_turns_of_the_whole_strain_nothing(run):
    """Three turns about an oblique axis, and a displacement: in 60 increments of 18 degrees nothing is left behind."""
    axis = np.array([1.0, 2.0, -0.5])
    axis *= 6 * np.pi / np.linalg.norm(axis)
    turn = "".join(f"\n {A}, {4 + i}, {4 + i}, {angle!r}" for i, angle in enumerate(axis.tolist()))
    results = finished(run, bundle(ring(3), f"*BOUNDARY\n {A}, 1, 1, 0.1{turn}", static="0.016, 1, 1e-3, 0.017"))
    displacement = results.field("displacement", -1)
    assert displacement[:, 0] == pytest.approx(np.full(len(displacement), 0.1), abs=1e-9)
    assert displacement[:, 1:] == pytest.approx(np.zeros((len(displacement), 2)), abs=1e-9)
    # the section forces of a strain of 1e-10
    assert np.abs(results.field("axial_force", -1)).max() < 1e-10 * YOUNG * np.pi * RADIUS**2
    assert np.abs(results.history["ALLSE"]).max() < 1e-12


def test_nodes_keep_their_distances_at_every_instant(run):
    results = finished(run, bundle(ring(3), twisted(1)))
    ends = [20, 41, 62, 64]
    for increment in range(len(results.times)):
        x = results.positions(increment)[ends]
        assert np.linalg.norm(x[:3] - x[3], axis=1) == pytest.approx([ARM] * 3, rel=1e-13)
        rotations = results.field("rotation", increment)[ends]
        assert np.array_equal(rotations, np.broadcast_to(rotations[3], rotations.shape))


def test_the_iteration_converges_quadratically(run):
    """The arm of the elastica turns freely, with its force: each rotation is at most thirty squares of the one before, down to
    round-off below 1e-11, and the increments take 4 or 5 iterations, as with the arm of a stiff beam."""
    load = f"*CLOAD\n {B}, 1, {-4 * EI / LENGTH**2!r}\n {B}, 2, {EI / LENGTH**2!r}"
    deck = bundle([(0, 0)], load).replace(f" {B}, {LENGTH}, 0, 0", f" {B}, {1.1 * LENGTH}, {0.3 * LENGTH}, 0")
    results = finished(run, deck)
    assert results.increments.max() == 20
    table = results.convergence
    for increment in range(1, 21):
        rotations = table["rotation"][table["increment"] == increment][2:]
        assert 3 <= len(rotations) <= 4
        for before, after in pairwise(rotations):
            assert after < 30 * before**2 + 1e-11


def test_the_work_of_moments_and_forces_on_arms_is_the_energy_of_the_wire(run):
    """The mean load times the displacement of an increment is right to the square of it: half of it, a quarter of the gap."""
    load = f"*CLOAD\n {B}, 1, {-EI / LENGTH**2!r}\n {B}, 2, {EI / LENGTH**2!r}\n {B}, 4, {0.2 * EI / LENGTH!r}"
    gaps = []
    for size in (0.1, 0.05):
        deck = bundle([(0, 0)], load, static=f"{size}, 1, 1e-3, {size}")
        results = finished(
            run, deck.replace(f" {B}, {LENGTH}, 0, 0", f" {B}, {LENGTH}, {0.3 * LENGTH}, 0"), name=f"by{size}"
        )
        gaps.append(results.history["ETOTAL"][-1])
    assert abs(gaps[0]) < 1e-2 * results.history["ALLSE"][-1]
    assert gaps[1] == pytest.approx(gaps[0] / 4, rel=0.1)


def test_pinned_nodes_carry_no_moment(run):
    """A wire between two pinned nodes of bodies that do not turn is simply supported: w = F L^3/(48 EI), for a sag of
    1e-4 of the length, at which it stretches by the square of that."""
    force = 48 * EI / LENGTH**3 * 1e-4 * LENGTH
    deck = bundle([(0, ARM)], f"*CLOAD\n 11, 2, {force!r}\n*BOUNDARY\n {B}, 2, 6", kind="PIN")
    # its own axis is the one about which the wire could turn
    results = finished(run, deck.replace(f" {A}, 1, 6\n", f" {A}, 1, 6\n 11, 4\n"))
    assert results.field("displacement", -1)[10, 1] == pytest.approx(1e-4 * LENGTH, rel=1e-4)
    for node in (A, B):
        assert last(results, "RF2", node) == pytest.approx(-force / 2, rel=1e-7)
        # the force at the arm, which lies along z
        assert last(results, "RM1", node) == pytest.approx(ARM * force / 2, rel=1e-7)
        assert abs(last(results, "RM3", node)) < 1e-8 * force * LENGTH


def test_wires_in_a_clamp_keep_their_own_potentials(run):
    """Each conducts what its voltage drives through its resistance."""
    potentials = "1, 9, 9, 0\n 21, 9, 9, 1e-3\n 22, 9, 9, 0\n 42, 9, 9, -2e-3"
    deck = bundle([(0, ARM), (0, -ARM)], f"*BOUNDARY\n {B}, 4, 4, 0.5\n {potentials}")
    results = finished(run, deck.replace("*BEAM", f"*ELECTRICAL CONDUCTIVITY\n {CONDUCTIVITY}\n*BEAM"))
    conductance = CONDUCTIVITY * np.pi * RADIUS**2 / LENGTH
    current = results.field("element_current", -1)
    assert current == pytest.approx(np.repeat([-1e-3, 2e-3], 20) * conductance, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("solver", ["BLOCK", "UMFPACK", "SKYLINE", pytest.param("MUMPS", marks=pytest.mark.mumps)])
def test_a_run_with_rigid_bodies_goes_on_bit_for_bit(litz, tmp_path, solver):
    cards = twisted(1, f"\n*CLOAD\n {B}, 1, 5\n*SOLVER, NAME={solver}\n{KEEP_ALL.strip()}")
    text = bundle(ring(2), cards, elements=8, static="0.1, 0.4, 1e-3, 0.1")
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_a_rigid_body_is_held_by_its_reference_node_and_holds_its_wires(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(bundle(ring(2), twisted(1)))
    done = litz("check", deck)
    assert (done.returncode, done.stderr) == (0, "")
    assert "rigid body of reference node 901: 2 nodes tied, 0 pinned" in done.stdout
    deck.write_text(bundle(ring(2), f"*CLOAD\n {B}, 1, 1.", held="1, 5"))
    done = litz("check", deck)
    assert done.returncode == 1
    assert "can still move: rotation about z through (0, 0, 0)" in done.stderr


def test_a_rigid_body_that_can_turn_about_its_only_pinned_node_is_named(run):
    process, _ = run(bundle([(0, 0)], f"*CLOAD\n {B}, 2, 0.001", kind="PIN", static="1, 1, 0.5"))
    assert process.returncode == 2
    assert f"The equation is that of the rotation about x of node {B}. Something can move freely" in process.stderr
