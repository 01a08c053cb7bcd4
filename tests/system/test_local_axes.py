"""*TRANSFORM: supports, loads and equations along axes of nodes, against turned models and closed forms."""

import numpy as np
import pytest

import litz
from decks import CONDUCTOR, MATERIAL, crossed, straight, wire
from litz import Results
from same_results import KEEP_ALL
from test_equations import equal, equation
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH = 200e9, 1e-3, 0.1
AREA = np.pi * RADIUS**2
EI = YOUNG * np.pi * RADIUS**4 / 4
SECTION = f"{MATERIAL}*BEAM SECTION, ELSET=W, MATERIAL=STEEL, SECTION=CIRC\n {RADIUS}\n"
#: A rotation about a skew axis
TURN = np.linalg.qr(np.array([[1.0, 2.0, -0.5], [0.3, 1.0, 4.0], [-2.0, 0.7, 1.0]]))[0]
TURN *= np.linalg.det(TURN)
GLOBAL = np.eye(3)


def rectangular(nset, axes):
    """Axes as columns; b lies off the second one, in the plane of the first two."""
    a, b = 3 * axes[:, 0], 0.5 * axes[:, 1] - 0.7 * axes[:, 0]
    return f"*TRANSFORM, NSET={nset}\n {', '.join(f'{value:.17g}' for value in [*a, *b])}\n"


def finished(run, deck, name="deck"):
    process, results = run(deck, name=name)
    assert process.returncode == 0, process.stderr
    return results


def turned_back(results, turn, name):
    """Vectors of the last increment, along the axes of the model before it was turned."""
    return results.field(name) @ turn


def assert_same_but_turned(plain, other, turn, *, scale=1e-9, noise=0.0):
    """Vectors agree to a part of the largest one, or of what counts as one."""
    for name in ("displacement", "reaction_force", "reaction_moment", "applied_force", "applied_moment"):
        expected = plain.field(name)
        size = max(np.abs(expected).max(), noise)
        np.testing.assert_allclose(turned_back(other, turn, name), expected, rtol=0, atol=scale * size, err_msg=name)


def supported_frame(turn):
    """Two wires that share a corner, bent far by forces, moments, prescribed rotations and an equation, turned as a whole."""
    corner = np.array([[0, 0, 0], [LENGTH, 0, 0], [LENGTH, LENGTH, 0.03]])
    points = np.r_[straight(corner[0], corner[1], 6), straight(corner[1], corner[2], 6)[1:]] @ turn.T
    ends = "*NSET, NSET=ALL\n W\n"
    axes = "" if turn is GLOBAL else rectangular("ALL", turn)
    return (
        wire("W", points, element="B33") + ends + axes + SECTION
        + f"*EQUATION\n{equation((4, 2, 1.0), (10, 1, 0.5), (7, 3, -0.3))}{equation((12, 4, 1.0), (2, 4, -0.2))}"
        + "*BOUNDARY\n 1, PINNED\n 1, 4\n 13, 3\n*STEP, INC=100\n*STATIC\n 0.25, 1, 1e-3, 0.25\n"
        + "*CLOAD\n 7, 3, 8.0\n 7, 5, 0.2\n 10, 6, -0.3\n*BOUNDARY\n 1, 6, 6, 0.4\n 13, 1, 1, -0.02\n*ENERGY PRINT\n*END STEP\n"
    )  # fmt: skip


def test_a_model_turned_with_its_axes_has_results_that_are_turned(run):
    """Forces, moments, single rotations and equations along local axes do what they do along the global ones."""
    plain = finished(run, supported_frame(GLOBAL), "plain")
    other = finished(run, supported_frame(TURN), "turned")
    assert np.abs(plain.field("rotation")).max() > 0.39
    assert_same_but_turned(plain, other, TURN, scale=1e-6)
    # the same tangent: no iteration more
    np.testing.assert_array_equal(plain.status["iterations"], other.status["iterations"])
    for name in ("ALLWK", "ALLSE"):
        np.testing.assert_allclose(other.history[name], plain.history[name], rtol=1e-6)
    assert abs(other.history["ETOTAL"][-1]) < 2e-2 * other.history["ALLWK"][-1]


def test_nodes_along_local_axes_are_no_nodes_of_results(run):
    results = finished(run, supported_frame(TURN))
    assert results.field("node_id").tolist() == list(range(1, 14))
    assert results.positions(-1).shape == (13, 3)


def test_rotations_of_any_size_are_prescribed_along_local_axes(run):
    """All three of an end, by more than a turn: a wire rolled up about an axis of its own, which is stable so far."""
    results = []
    for turn, name in ((GLOBAL, "plain"), (TURN, "turned")):
        points = straight((0, 0, 0), (LENGTH, 0, 0), 10) @ turn.T
        deck = (
            wire("W", points, element="B33") + SECTION + "*NSET, NSET=ENDS\n 1, 11\n" + rectangular("ENDS", turn)
            + "*BOUNDARY\n 1, ENCASTRE\n*STEP, INC=100\n*STATIC\n 0.05, 1, 1e-3, 0.05\n"
            + f"*BOUNDARY\n 11, 6, 6, {2.05 * np.pi!r}\n 11, 4, 5\n*END STEP\n"
        )  # fmt: skip
        results.append(finished(run, deck, name))
    assert turned_back(results[1], TURN, "rotation")[-1] == pytest.approx([0, 0, 2.05 * np.pi], abs=1e-9)
    # M = phi E I/L
    moment = [0, 0, 2.05 * np.pi * EI / LENGTH]
    assert turned_back(results[1], TURN, "reaction_moment")[-1] == pytest.approx(moment, rel=1e-6, abs=1e-6)
    # a pure moment: no forces, but for what residuals of 1e-8 of it leave
    assert_same_but_turned(*results, TURN, scale=1e-7, noise=moment[2] / LENGTH)


def test_an_inclined_roller_carries_what_is_normal_to_it(run):
    """The end of a clamped wire slides on a plane at an angle; a force along the plane bends and stretches the wire."""
    force, angle = 1e-3, np.radians(35)
    along, normal = np.array([np.cos(angle), np.sin(angle), 0]), np.array([-np.sin(angle), np.cos(angle), 0])
    deck = (
        wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 8), element="B33") + SECTION + "*NSET, NSET=END\n 9\n"
        + rectangular("END", np.c_[along, normal, [0, 0, 1]])
        + f"*BOUNDARY\n 1, ENCASTRE\n 9, 2, 3\n*STEP\n*STATIC\n 1, 1\n*CLOAD\n 9, 1, {force}\n*END STEP\n"
    )  # fmt: skip
    results = finished(run, deck)
    stiffness = np.diag([YOUNG * AREA / LENGTH, 3 * EI / LENGTH**3, 1])
    moved = force / (along @ stiffness @ along)
    # deflections of 1e-8 of the length
    np.testing.assert_allclose(results.field("displacement")[-1], moved * along, rtol=1e-6, atol=1e-6 * moved)
    reaction = (normal @ stiffness @ along) * moved * normal
    np.testing.assert_allclose(results.field("reaction_force")[-1], reaction, rtol=1e-6, atol=1e-6 * force)
    np.testing.assert_allclose(results.field("applied_force")[-1], force * along, rtol=1e-12)
    assert results.field("reaction_force").sum(axis=0) == pytest.approx(-force * along, abs=1e-6 * force)


def spokes(n=5, centre=(0.2, -0.1, 0.05), axis=TURN[:, 2]):
    """Wires from a hub outwards; nodes of their outer ends in RIM, of the inner ones in HUB."""
    first = np.cross(axis, [1.0, 0, 0])
    first /= np.linalg.norm(first)
    text, radial = "*NSET, NSET=RIM\n", []
    wires = ""
    for i in range(n):
        angle = 2 * np.pi * i / n + 0.3
        radial.append(np.cos(angle) * first + np.sin(angle) * np.cross(axis, first))
        wires += wire("W", np.array(centre) + np.outer([0.05, 0.05 + LENGTH], radial[-1]), 10 * i + 1)
        text += f" {10 * i + 2}\n"
    text += "*NSET, NSET=HUB\n" + "".join(f" {10 * i + 1}\n" for i in range(n))
    return wires + text + SECTION, np.array(radial), np.array(centre), axis


@pytest.mark.parametrize(("system", "third"), [("C", False), ("S", False), ("S", True)])
def test_a_rim_is_widened_by_one_line(run, system, third):
    """One displacement along the radius stretches all spokes; the third axis of a sphere points to its pole."""
    model, radial, centre, axis = spokes()
    values = [*centre, *(centre + 0.3 * axis)]
    card = f"*TRANSFORM, NSET=RIM, TYPE={system}\n {', '.join(f'{value:.17g}' for value in values)}\n"
    push = " RIM, 2, 6\n RIM, 1, 1, 1e-6\n" if not third else " RIM, 1, 2\n RIM, 4, 6\n RIM, 3, 3, 1e-6\n"
    results = finished(
        run, f"{model}{card}*BOUNDARY\n HUB, ENCASTRE\n*STEP\n*STATIC\n 1, 1\n*BOUNDARY\n{push}*END STEP\n"
    )
    rim = slice(1, None, 2)
    moved = np.broadcast_to(axis, radial.shape) if third else radial
    np.testing.assert_allclose(results.field("displacement")[rim], 1e-6 * moved, atol=1e-16)
    if not third:
        force = YOUNG * AREA / LENGTH * 1e-6
        np.testing.assert_allclose(results.field("reaction_force")[rim], force * radial, rtol=1e-5, atol=1e-5 * force)
        np.testing.assert_allclose(results.field("axial_force"), force, rtol=1e-5)


def test_the_tangential_axis_follows_from_the_axis_by_the_right_hand(run):
    model, radial, centre, axis = spokes()
    values = [*centre, *(centre + axis)]
    card = f"*TRANSFORM, NSET=RIM, TYPE=C\n {', '.join(f'{value:.17g}' for value in values)}\n"
    push = " RIM, 3, 6\n RIM, 1\n RIM, 2, 2, 1e-6\n"
    results = finished(
        run, f"{model}{card}*BOUNDARY\n HUB, ENCASTRE\n*STEP\n*STATIC\n 1, 1\n*BOUNDARY\n{push}*END STEP\n"
    )
    np.testing.assert_allclose(results.field("displacement")[1::2], 1e-6 * np.cross(axis, radial), atol=1e-16)


def test_reference_nodes_and_pinned_nodes_have_axes(run):
    """A clamp at both ends of a bundle, of which one is led, and moments on the free rotations of pinned nodes."""
    results = []
    for turn, name in ((GLOBAL, "plain"), (TURN, "turned")):
        wires = "".join(
            wire("W", straight((0, 0.01 * y, 0), (LENGTH, 0.01 * y, 0), 4) @ turn.T, 10 * y + 1, element="B33") for y in (0, 1)
        )  # fmt: skip
        places = np.array([[0, 0.005, 0], [LENGTH, 0.005, 0]]) @ turn.T
        nodes = "".join(f" {91 + i}, {', '.join(f'{v:.17g}' for v in place)}\n" for i, place in enumerate(places))
        deck = (
            f"{wires}*NODE\n{nodes}*NSET, NSET=A\n 1, 11\n*NSET, NSET=B\n 5, 15\n*NSET, NSET=ALL\n A, B, 91, 92\n{SECTION}"
            "*RIGID BODY, REF NODE=91, TIE NSET=A\n*RIGID BODY, REF NODE=92, PIN NSET=B\n" + rectangular("ALL", turn)
            + "*BOUNDARY\n 91, 1, 6\n*STEP, INC=100\n*STATIC\n 0.25, 1, 1e-3, 0.25\n"
            + "*BOUNDARY\n 92, 3, 3, 0.02\n 92, 4, 4, 0.3\n 92, 5, 5\n 15, 5, 5, 0.2\n"
            + "*CLOAD\n 5, 5, 0.02\n 92, 1, 3.0\n*END STEP\n"
        )  # fmt: skip
        results.append(finished(run, deck, name))
    assert_same_but_turned(*results, TURN, scale=1e-6)


@pytest.mark.parametrize("kind", ["B33", "B31"])
def test_contacts_currents_and_steps_do_not_care(run, kind):
    """Crossed wires that are held along local axes at their ends: pressed, and then dragged by a force."""
    results = []
    for name, axes, x, y, z in (("plain", None, 1, 2, 3), ("local", np.eye(3)[:, [1, 2, 0]], 3, 1, 2)):
        held = " UPPER_ENDS, {}\n" * 2
        extra = f"*BOUNDARY, OP=NEW\n{held.format(x, y)} UPPER_ENDS, 4, 6\n UPPER_ENDS, {z}, {z}, -1e-4\n"
        extra += " 1, 9, 9, 1e-3\n 11, 9, 9, 0\n LOWER_ENDS, 1, 6\n"
        deck = crossed(element=kind, static="0.25, 1, 1e-3, 0.5", extra="CUT")
        head, _, _ = deck.partition("*BOUNDARY")
        steps = (
            f"*STEP, INC=200\n*STATIC\n 0.25, 1, 1e-3, 0.5\n{extra}*END STEP\n"
            f"*STEP, INC=200\n*STATIC\n 0.25, 1, 1e-3, 0.5\n"
            + extra.replace(" LOWER_ENDS, 1, 6\n", f" 1, 1, 6\n 6, {y}\n 6, {z}\n 6, 4, 6\n")
            + f"*CLOAD\n 6, {x}, 30.0\n 13, 2, 0.1\n*END STEP\n"
        )
        card = rectangular("UPPER_ENDS", axes) + rectangular("LOWER_ENDS", axes) if axes is not None else ""
        results.append(finished(run, head + card + steps, name))
    assert_same_but_turned(*results, GLOBAL, scale=1e-6)
    currents = [one.contacts["current"] for one in results]
    np.testing.assert_allclose(*currents, rtol=1e-6)
    assert len(currents[0]) >= 8


WARM = f"""\
{CONDUCTOR}*CONDUCTIVITY
 400
*EXPANSION
 17e-6
*DENSITY
 8960
*SPECIFIC HEAT
 385
*BEAM SECTION, ELSET=W, MATERIAL=COPPER, SECTION=CIRC
 {RADIUS}
*INITIAL CONDITIONS, TYPE=TEMPERATURE
 W, 293
*BOUNDARY
 1, ENCASTRE
 9, 2, 6
 1, 9
*STEP, INC=200
*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL
 0.5, 5
*BOUNDARY
 1, 11, 11, 293
 9, 11, 11, 350
*CECURRENT
 9, , 30
*CLOAD
 9, 1, -20
*END STEP
*STEP, INC=200
*STATIC
 1, 1
*TEMPERATURE
 W, 300
*CLOAD
 9, 1, 5
*END STEP
"""


#: Motions are held
HELD = """\
*STEP
*COUPLED THERMAL-ELECTRICAL, STEADY STATE
 1, 1
*BOUNDARY
 9, 11, 11, 400
*END STEP
"""


@pytest.mark.parametrize("held", ["", HELD])
def test_steps_that_solve_for_temperatures_have_local_axes(run, held):
    """Temperatures, potentials and currents have no direction, and stay at the nodes of the deck."""
    results = []
    warm = WARM.replace("*STEP, INC=200\n*STATIC", f"{held}*STEP, INC=200\n*STATIC")
    for turn, name in ((GLOBAL, "plain"), (TURN, "turned")):
        wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 8) @ turn.T, element="B33")
        results.append(finished(run, f"{wires}*NSET, NSET=ENDS\n 1, 9\n{rectangular('ENDS', turn)}{warm}", name))
    # moments are those that residuals leave
    assert_same_but_turned(*results, TURN, scale=1e-9, noise=1e-3)
    for name in ("temperature", "potential", "reaction_heat"):
        np.testing.assert_allclose(results[1].field(name), results[0].field(name), rtol=1e-9, atol=1e-12)


def test_steps_that_hold_motions_have_local_axes(run):
    """Between two that move: supports and loads along local axes are there, and wait."""
    held = "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n0.5, 1\n*END STEP\n"
    first, second = WARM.split("*END STEP\n*STEP")
    cards = f"{first}*END STEP\n{held}*STEP{second}"
    results = []
    for turn, name in ((GLOBAL, "plain"), (TURN, "turned")):
        wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 8) @ turn.T, element="B33")
        results.append(finished(run, f"{wires}*NSET, NSET=ENDS\n 1, 9\n{rectangular('ENDS', turn)}{cards}", name))
    assert_same_but_turned(*results, TURN, scale=1e-9, noise=1e-3)
    for name in ("temperature", "potential", "reaction_heat"):
        np.testing.assert_allclose(results[1].field(name), results[0].field(name), rtol=1e-9, atol=1e-12)
    moved = results[1].field("displacement", increment=None)
    np.testing.assert_array_equal(moved[-2], moved[-4])
    assert abs(moved[-2]).max() > 1e-6
    assert abs(moved[-1] - moved[-2]).max() > 1e-6


def test_a_run_with_local_axes_goes_on_from_everywhere(litz, tmp_path):
    assert_goes_on_from_everywhere(litz, tmp_path, supported_frame(TURN).replace("*END STEP", KEEP_ALL + "*END STEP"))


def test_a_restart_notices_other_axes(run, litz, tmp_path):
    deck = supported_frame(TURN).replace("*END STEP", KEEP_ALL + "*END STEP")
    finished(run, deck)
    changed = tmp_path / "changed.inp"
    changed.write_text(deck.replace(rectangular("ALL", TURN), rectangular("ALL", TURN.T)))
    done = litz("run", changed, "-o", tmp_path / "out", "--restart", f"{tmp_path}/deck/deck.restart.h5:1:2")
    assert done.returncode == 1
    assert "the local axes (*TRANSFORM)" in done.stderr


def test_histories_are_along_global_axes(run):
    deck = supported_frame(TURN).replace("*END STEP", "*NODE PRINT, NSET=ALL\n U, RF, CF\n*END STEP")
    results = finished(run, deck)
    for axis in range(3):
        for name, field in (("U", "displacement"), ("RF", "reaction_force"), ("CF", "applied_force")):
            assert results.history[f"{name}{axis + 1} node 13"][-1] == results.field(field)[-1, axis]


def slider(cards, held=" 1, 2, 6\n"):
    points = straight((0, 0, 0), (LENGTH, 0, 0), 2)
    return (
        wire("W", points) + SECTION + "*NSET, NSET=SOME\n 1, 2\n" + cards
        + f"*BOUNDARY\n{held}*STEP\n*STATIC\n 1, 1\n*BOUNDARY\n 3, 2, 2, 1e-6\n*END STEP\n"
    )  # fmt: skip


@pytest.mark.parametrize(
    ("cards", "message"),
    [
        ("*TRANSFORM, NSET=SOMEE\n 1, 0, 0, 0, 1, 0\n", 'there is no node set "SOMEE"'),
        ("*TRANSFORM, TYPE=C\n 1, 0, 0, 0, 1, 0\n", "*TRANSFORM needs the parameter NSET"),
        ("*TRANSFORM, NSET=SOME, TYPE=X\n 1, 0, 0, 0, 1, 0\n", "TYPE"),
        ("*TRANSFORM, NSET=SOME\n", "*TRANSFORM"),
        ("*TRANSFORM, NSET=SOME\n 1, 0, 0, 2, 0, 0\n", "the origin and the points a and b of a rectangular system"),
        ("*TRANSFORM, NSET=SOME\n 0, 0, 0, 0, 1, 0\n", "the origin and the points a and b of a rectangular system"),
        ("*TRANSFORM, NSET=SOME, TYPE=C\n 1, 0, 0, 1, 0, 0\n", "the points a and b are the same"),
        ("*TRANSFORM, NSET=SOME, TYPE=C\n 0, 0, 0, 1, 0, 0\n", "node 1 lies on the axis of its *TRANSFORM, TYPE=C"),
        ("*TRANSFORM, NSET=SOME, TYPE=S\n 0, 0, 0, 0, 0, 1\n", "node 1 lies on the axis of its *TRANSFORM, TYPE=S"),
        ("*TRANSFORM, NSET=SOME\n 1, 0, 0, 0, 1, 0\n*TRANSFORM, NSET=W\n 1, 0, 0, 0, 1, 0\n", "node 1 of W has a *TRANSFORM"),
    ],
)  # fmt: skip
def test_what_is_wrong_about_axes_is_named(litz, tmp_path, cards, message):
    (tmp_path / "deck.inp").write_text(slider(cards))
    done = litz("check", "deck.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert message in done.stderr
    assert "deck.inp:" in done.stderr


def test_what_supports_along_local_axes_leave_free_is_reported(litz, tmp_path):
    """Without the axes the wire could slide along x, which is the second of them."""
    axes = rectangular("SOME", np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]]))
    (tmp_path / "deck.inp").write_text(slider(axes, " 1, 1\n 1, 3, 6\n"))
    done = litz("check", "deck.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert "can still move: translation along x" in done.stderr
    (tmp_path / "deck.inp").write_text(slider(axes, " 1, 2, 6\n"))
    done = litz("check", "deck.inp", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "supports, loads or equations along local axes at 1 node" in done.stdout


def test_nodes_that_nothing_is_said_of_may_lie_anywhere(run):
    """Axes are needed only where there are supports and loads: here not on the axis of the cylinder."""
    results = finished(run, slider("*TRANSFORM, NSET=W, TYPE=C\n 0.05, 0, 0, 0.05, 0, 1\n", " 1, 1, 6\n 3, 1\n"))
    assert isinstance(results, Results)
    assert results.field("displacement")[2, 1] == pytest.approx(1e-6, rel=1e-12)


def test_an_equation_between_nodes_with_different_axes(run):
    """Equal motions along two axes make the ends of two wires move so."""
    first, second = TURN, TURN[:, [1, 2, 0]]
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 4), 1) + wire("W", straight((0, 1, 0), (LENGTH, 1, 0), 4), 11)
    deck = (
        wires + SECTION + "*NSET, NSET=A\n 5\n*NSET, NSET=B\n 15\n" + rectangular("A", first) + rectangular("B", second)
        + f"*EQUATION\n{equal(5, 15, (1, 2))}*BOUNDARY\n 1, ENCASTRE\n 11, ENCASTRE\n"
        + "*STEP\n*STATIC\n 1, 1\n*CLOAD\n 5, 1, 0.01\n 15, 3, 0.02\n*END STEP\n"
    )  # fmt: skip
    results = finished(run, deck)
    a, b = results.field("displacement")[[4, 9]]
    np.testing.assert_allclose((a @ first)[:2], (b @ second)[:2], rtol=1e-9, atol=1e-12 * np.abs(a).max())
    applied = results.field("applied_force")
    np.testing.assert_allclose(applied[[4, 9]], [0.01 * first[:, 0], 0.02 * second[:, 2]], atol=1e-15)


def test_models_of_python_have_local_axes(tmp_path):
    """A force along the first axis of a cylinder about the z-axis, of an end on the line x = y."""
    model = litz.Model("radial force")
    end = np.array([1, 1, 0]) * 0.1 / np.sqrt(2)
    wire_of_model = model.wire("WIRE", (0, 0, 0), end, radius=1e-3, material=litz.STEEL, elements=4)
    model.fix(wire_of_model.start)
    model.local_axes(wire_of_model.end, (0, 0, 0), (0, 0, 1), "cylindrical")
    model.step().force(wire_of_model.end, "x", 2.0)
    results = model.run(tmp_path / "radial")
    np.testing.assert_allclose(results.field("applied_force")[-1], 2 * end / 0.1, atol=1e-14)
    with pytest.raises(ValueError, match="system must be one of rectangular, cylindrical, spherical, not 'polar'"):
        model.local_axes(wire_of_model.end, (0, 0, 0), (0, 0, 1), "polar")
