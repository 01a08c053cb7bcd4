"""What litz does not model ends the run in words: which wires, what it is, and what helps."""

import re

import numpy as np
import pytest

from decks import MATERIAL, pair_of_wires, straight, wire
from litz import build


def lowered(first, second, push):
    """Deck of a wire A that is held at all nodes, and a wire B whose nodes are all lowered by `push` [m]."""
    # a free middle would give way sideways; here the way is what is prescribed
    return pair_of_wires(
        wire("A", first, 1, element="B33"),
        wire("B", second, 101, element="B33"),
        "A, 1, 6\nB, 1, 2\nB, 4, 6\n",
        f"B, 3, 3, {push}\n",
    )


def at_points(deck):
    """The deck with friction, which is for contacts at points."""
    return deck.replace("*CONTACT PAIR", "*FRICTION, STICK STIFFNESS=1e6\n 0.2\n*CONTACT PAIR")


def moved(points, *shift):
    """Points of a wire, moved by a vector [m]."""
    return points + np.array(shift)


ALONG = straight((-0.05, 0, 0), (0.05, 0, 0), 5)
ACROSS = straight((0, -0.05, 0), (0, 0.05, 0), 5)
CASES = {
    "parallel wires": (ALONG, moved(ALONG, 0.003, 0, 0.004), -8e-3, "side by side"),
    "wires at half a degree": (ALONG, straight((-0.05, -4.5e-4, 0.004), (0.05, 4.5e-4, 0.004), 5), -2.1e-3, "side by side"),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_contact_that_is_not_modelled_ends_the_run_and_is_named(run, case):
    first, second, push, words = CASES[case]
    process, results = run(at_points(lowered(first, second, push)))
    assert process.returncode == 2
    assert f"touch {words}" in process.stderr
    assert "STICK STIFFNESS of *FRICTION" in process.stderr
    assert re.search(r"the wires of elements \d+ and 1\d\d", process.stderr)
    # it is given up early, not after all cut-backs
    assert len(results.status["attempts"]) <= 20
    # what was accepted has no overlap, to a millionth of the radius
    height = results.positions(len(results.times) - 1)[:, 2]
    assert height[6:].min() - height[:6].max() > 2e-3 - 1e-9


@pytest.mark.parametrize("case", CASES)
def test_a_contact_that_is_not_modelled_is_refused_at_the_start(litz, tmp_path, case):
    first, second, _, words = CASES[case]
    (tmp_path / "deck.inp").write_text(at_points(lowered(first, moved(second, 0, 0, -0.0021), -1e-4)))
    for command in ("check", "run"):
        process = litz(command, "deck.inp", cwd=tmp_path)
        assert process.returncode == 1
        assert re.search(rf"at the start the wires of elements \d+ and \d+ touch {words}", process.stderr)


def test_a_pair_of_elements_has_a_second_contact(run):
    """An element that is bent by 46 degrees while it is lowered: its bow of 2 mm crosses a straight wire twice, alike."""
    bent = straight((-0.01, -0.001, 0.004), (0.01, -0.001, 0.004), 1)
    turn = np.radians(23)
    deck = pair_of_wires(
        wire("A", ALONG, 1, element="B33"), wire("B", bent, 101, element="B33"),
        "A, 1, 6\nB, 1, 2\nB, 4, 5\n", f"B, 3, 3, -2.02e-3\n101, 6, 6, {turn}\n102, 6, 6, {-turn}\n",
    )  # fmt: skip
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    crossings = contacts.where(contacts["length"] == 0)
    assert crossings["xi_1"] == pytest.approx(-crossings["xi_1"][::-1], abs=1e-6)
    assert len(crossings["xi_1"]) == 2
    left = contacts["point_1_x"] < 0
    assert contacts["force"][left].sum() == pytest.approx(contacts["force"][~left].sum(), rel=1e-6)


@pytest.mark.parametrize("axis", ["HERMITE", "LINEAR"])
@pytest.mark.parametrize("n", [16, 20])
def test_a_ring_of_few_elements_rests_on_a_wire_with_one_of_its_nodes(run, axis, n):
    """Kinks of 22.5 degrees are corners; with straight axes those of 18 degrees are, too. Both touch as round joints."""
    angle = 2 * np.pi * np.arange(n) / n - np.pi / 2
    ring = np.stack([0.01 * np.cos(angle), 0 * angle, 0.01205 + 0.01 * np.sin(angle)], axis=1)
    deck = pair_of_wires(
        wire("A", ACROSS, 1, element="B33"), wire("B", ring, 101, element="B33", closed=True),
        f"A, 1, 6\n{101 + n // 2}, 1, 2\n{101 + n // 2}, 4, 6\n", f"{101 + n // 2}, 3, 3, -1e-4\n",
    )  # fmt: skip
    process, results = run(deck.replace("NAME=TOUCH\n", f"NAME=TOUCH, AXIS={axis}\n", 1))
    assert process.returncode == 0, process.stderr
    assert results.warnings == []
    contacts = results.contacts_at(-1)
    # at the lowest node, which leads the load to the top of the ring
    assert contacts["point_2_x"] == pytest.approx([0], abs=1e-9)
    assert contacts["force"] == pytest.approx(
        -results.field("reaction_force", len(results.times) - 1)[6 + n // 2, 2], rel=1e-6
    )


def test_a_concave_kink_of_a_straight_axis_does_not_count_twice(run):
    """A rod in the crook of two straight elements, at 10 degrees, has a contact with both: one wire would have one."""
    valley = np.array([(-0.05, 0, 0.0044), (0, 0, 0), (0.05, 0, 0.0044)])
    deck = lowered(valley, moved(ACROSS, 0, 0, 0.0022), -2.2e-4).replace("NAME=TOUCH\n", "NAME=TOUCH, AXIS=LINEAR\n", 1)
    process, _ = run(deck)
    assert process.returncode == 2
    assert "at a kink" in process.stderr


def test_wires_of_no_contact_pair_that_overlap_are_one_warning(run):
    free = wire("C", straight((-0.05, -0.02, 0.0005), (0.05, 0.02, 0.0005), 3), 201, element="B33")
    deck = lowered(ALONG, moved(ACROSS, 0, 0, 0.0021), -1e-3).replace(MATERIAL, free + MATERIAL, 1)
    deck = deck.replace("*ELSET, ELSET=WIRES\n A, B\n", "*ELSET, ELSET=WIRES\n A, B, C\n").replace(
        "B, 4, 6\n", "B, 4, 6\nC, 1, 6\n"
    )
    process, results = run(deck.replace("B, 3, 3, -0.001\n", "B, 3, 3, -0.0001\n"), "--quiet")
    assert process.returncode == 0, process.stderr
    (warning,) = [entry for entry in results.warnings if entry.kind == "unpaired_overlap"]
    assert "that no *CONTACT PAIR names" in warning.message
    assert process.stderr.count("no *CONTACT PAIR names") == 1


def test_an_overlap_of_no_contact_pair_that_comes_and_goes_within_a_step_is_warned_of(run):
    """A wire that is lowered through one that its contact pair does not name, and raised again."""
    free = wire("C", straight((-0.05, -0.02, 0.0), (0.05, -0.02, 0.0), 3), 201, element="B33")
    deck = lowered(moved(ALONG, 0, 0, -0.02), moved(ACROSS, 0, 0, 0.004), -3e-3).replace(MATERIAL, free + MATERIAL, 1)
    deck = deck.replace("*ELSET, ELSET=WIRES\n A, B\n", "*ELSET, ELSET=WIRES\n A, B, C\n").replace(
        "B, 4, 6\n", "B, 4, 6\nC, 1, 6\n*AMPLITUDE, NAME=THERE AND BACK\n0, 0, 0.5, 1, 1, 0\n"
    )
    head, _, motion = deck.rpartition("*BOUNDARY\n")
    process, results = run(head + "*BOUNDARY, AMPLITUDE=THERE AND BACK\n" + motion)
    assert process.returncode == 0, process.stderr
    (warning,) = [entry for entry in results.warnings if entry.kind == "unpaired_overlap"]
    assert 0 < warning.time <= warning.last_time < results.times[-1]


@pytest.mark.parametrize("first_increment", [0.05, 0.5, 1.0])
def test_a_contact_that_leaves_the_part_of_a_wire_that_its_pair_names_ends_the_run(run, first_increment):
    """Half of A is named; B is pressed on that half, dragged beyond it, and would spring through the rest."""
    deck = pair_of_wires(
        wire("A", straight((-0.06, 0, 0), (0.06, 0, 0), 12), 1, element="B33"),
        wire("B", straight((-0.006, -0.06, 0.002), (-0.006, 0.06, 0.002), 12), 101, element="B33"),
        "1, 1, 6\n13, 1, 6\n101, 1, 2\n101, 4, 6\n113, 1, 2\n113, 4, 6\n",
        "101, 3, 3, -6e-5\n113, 3, 3, -6e-5\n",
    ).replace("\n A, B\n*BOUNDARY", "\n HALF, B\n*ELSET, ELSET=HALF\n 1, 2, 3, 4, 5, 6\n*BOUNDARY", 1)
    drag = f"*STEP\n*STATIC\n{first_increment}, 1.\n*BOUNDARY\n101, 1, 1, 0.0072\n113, 1, 1, 0.0072\n*END STEP\n"
    process, _ = run(deck + drag)
    assert process.returncode == 2
    assert "has left the part of one of them that *CONTACT PAIR names" in process.stderr


def v_shaped_wire(degrees, elements):
    """Two legs of 20 mm in the plane, joined in the origin; nodes 1 (joint), 101... and 201...; radius 0.5 mm."""
    half = np.radians(degrees / 2)
    nodes, lines = ["1, 0, 0, 0"], []
    for first, side in ((101, 1), (201, -1)):
        for k in range(elements):
            arc = 0.02 * (k + 1) / elements
            nodes.append(f"{first + k}, {arc * np.cos(half):.9g}, {side * arc * np.sin(half):.9g}, 0")
            lines.append(f"{first + k}, {first + k - 1 if k else 1}, {first + k}")
    return "\n".join(["*NODE", *nodes, "*ELEMENT, TYPE=B33, ELSET=V", *lines, ""])


@pytest.mark.parametrize("elements", [1, 2, 10])
@pytest.mark.parametrize(("degrees", "ends"), [(32, "refused"), (25, "built so")])
def test_legs_of_a_v_that_fold_up_next_to_their_joint_end_the_run(run, degrees, ends, elements):
    """Pushed together at the tips, legs at 32 degrees come to overlap 4 radii from their joint; at 25 they are built so."""
    push = 0.005 if ends == "refused" else 0.0005
    deck = f"""{v_shaped_wire(degrees, elements)}{MATERIAL}*BEAM SECTION, ELSET=V, MATERIAL=STEEL, SECTION=CIRC
0.0005
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
V, V
*BOUNDARY
1, 1, 6
*STEP
*STATIC
0.1, 1.
*BOUNDARY
{100 + elements}, 2, 2, {-push}
{200 + elements}, 2, 2, {push}
*END STEP
"""
    process, _ = run(deck)
    if ends == "refused":
        assert process.returncode == 2
        assert "touch beyond their joint" in process.stderr
    else:
        assert process.returncode == 0, process.stderr


def test_a_wire_that_swings_past_a_post_in_one_increment_is_stopped_by_it(run):
    """A clamp that turns by 150 degrees: each node alone would go straight and never come near the post."""
    arm, post = straight((0, 0, 0), (0.04, 0, 0), 8), straight((0, 0.03, -0.02), (0, 0.03, 0.02), 3)
    deck = pair_of_wires(
        wire("A", post, 1, element="B33"), wire("B", arm, 101, element="B33"),
        "A, 1, 6\n101, 1, 5\n", f"101, 6, 6, {np.radians(150)}\n",
    )  # fmt: skip
    process, results = run(deck)
    # bent by the post it may snap, or overlap too much; it is never on the far side without having touched it
    tip = results.positions(len(results.times) - 1)[-1]
    touched = len(results.contacts_at(-1)["force"]) > 0
    assert process.returncode != 0 or touched or tip[0] > 0


def test_the_default_fabric_has_no_kinks():
    for pitch in (1e-3, 0.6e-3, 0.47e-3):
        model = build.woven_fabric(3, 3, pitch=pitch, radius=0.1e-3, plates=False)
        for yarn in (*model.groups["WARP"].wires, *model.groups["WEFT"].wires):
            chords = np.diff(model.x[np.array(yarn.nodes) - 1], axis=0)
            chords /= np.linalg.norm(chords, axis=1)[:, None]
            assert np.degrees(np.arccos((chords[1:] * chords[:-1]).sum(1))).max() < 16
    with pytest.raises(ValueError, match=r"kinks of .* degrees"):
        build.woven_fabric(3, 3, pitch=0.5e-3, radius=0.1e-3, elements_per_pitch=4)
