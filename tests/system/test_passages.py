"""The audit, done once more by other means: no pair of wires passes through each other or overlaps without a contact."""

import numpy as np
import pytest

from decks import crossed
from litz import Results, build
from passages import overlaps_without_contact, passages


def pile(seed, n=14):
    """Straight wires of random places and directions in a box, whose ends move at random by up to ten radii."""
    random = np.random.default_rng(seed)
    radius, half = 1e-4, 6e-3
    wires = []
    while len(wires) < n:
        middle = random.uniform([-3e-3, -3e-3, -8e-4], [3e-3, 3e-3, 8e-4])
        angle = random.uniform(0, np.pi)
        along = half * np.array([np.cos(angle), np.sin(angle), random.uniform(-0.05, 0.05)])
        points = middle + np.linspace(-1, 1, 9)[:, None] * along
        if all(apart(points, other) > 2.02 * radius for other in wires):
            wires.append(points)
    lines = ["*HEADING", f"pile {seed}"]
    moves = []
    for w, points in enumerate(wires):
        first = 100 * (w + 1)
        axis = (points[-1] - points[0]) / np.linalg.norm(points[-1] - points[0])
        lines.append("*NODE, NSET=ALL")
        lines += [f" {first + k}, {x:.12g}, {y:.12g}, {z:.12g}" for k, (x, y, z) in enumerate(points)]
        lines.append("*ELEMENT, TYPE=B33, ELSET=WIRES")
        lines += [f" {first + k}, {first + k}, {first + k + 1}" for k in range(8)]
        for node in (first, first + 8):
            shift = random.uniform(-1, 1, 3) * np.array([4, 4, 10]) * radius
            # across the wire: pushed together along its axis it would buckle
            shift -= axis * (axis @ shift)
            moves += [f" {node}, {d + 1}, {d + 1}, {shift[d]:.6g}" for d in range(3)]
            moves += [f" {node}, 4, 6"]
    return "\n".join(
        [
            *lines,
            "*MATERIAL, NAME=M\n*ELASTIC\n 1e9, 0.3",
            f"*BEAM SECTION, ELSET=WIRES, MATERIAL=M, SECTION=CIRC\n {radius}",
            "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ",
            "*CONTACT PAIR, INTERACTION=TOUCH\n WIRES",
            "*STEP, INC=200\n*STATIC\n 0.25, 1., 1e-3, 0.25\n*BOUNDARY",
            *moves,
            "*END STEP\n",
        ]
    )


def apart(a, b):
    """Least distance between two straight wires, by trying."""
    s = np.linspace(0, 1, 60)[:, None]
    p, q = a[0] + s * (a[-1] - a[0]), b[0] + s * (b[-1] - b[0])
    return np.linalg.norm(p[:, None] - q[None], axis=-1).min() - 3e-5


def assert_no_passages(results):
    assert len(results.times) > 1
    assert passages(results) == []
    for increment in range(len(results.times)):
        assert overlaps_without_contact(results, increment) == [], f"increment {increment}"


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.filterwarnings("ignore:.*did not finish")
def test_no_wires_of_a_moving_pile_pass_through_each_other(litz, tmp_path, seed):
    deck = tmp_path / "pile.inp"
    deck.write_text(pile(seed))
    done = litz("run", deck, "-o", tmp_path / "out", "--quiet", timeout=300)
    # a pile may snap where no increment is small enough; what was accepted before must be right all the same
    assert done.returncode in (0, 2), done.stderr
    results = Results(tmp_path / "out" / "pile.vtkhdf")
    assert results.contacts.n_rows > 0
    assert_no_passages(results)


@pytest.mark.parametrize("seed", [1])
@pytest.mark.filterwarnings("ignore:.*did not finish")
def test_no_fibres_of_a_pressed_mat_pass_through_each_other(litz, tmp_path, seed):
    mat = build.fibre_mat((10e-3, 10e-3), 5, radius=0.1e-3, seed=seed, n_layers=3, clearance=5e-6, n_elements=8)
    mat.press(40e-6, voltage=1e-3)
    deck = mat.write(tmp_path / "mat.inp")
    done = litz("run", deck, "-o", tmp_path / "out", "--quiet", timeout=300)
    assert done.returncode in (0, 2), done.stderr
    assert_no_passages(Results(tmp_path / "out" / "mat.vtkhdf"))


@pytest.mark.parametrize("name", ["01_crossed_wires", "03_large_sliding", "04_wire_grid", "13_stick_slip"])
def test_no_wires_of_the_inputs_pass_through_each_other(run_of_input, name):
    assert_no_passages(Results(run_of_input(name) / f"{name}.vtkhdf"))


def test_the_search_finds_a_passage_and_an_overlap_without_contact(run):
    """Wires between which no contact is defined pass through each other as if they were air."""
    deck = crossed(push="-4e-3", static="0.25, 1, 0.25, 0.25").replace(
        "*CONTACT PAIR, INTERACTION=SPOT\n LOWER, UPPER", "*ELSET, ELSET=NONE\n 11\n*ELSET, ELSET=FAR\n 15\n"
        "*CONTACT PAIR, INTERACTION=SPOT\n NONE, FAR"
    )  # fmt: skip
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert passages(results) != []
    # after a quarter of the way the axes are 1 mm apart, and the radii are 1 mm each
    ((_, _, overlap),) = overlaps_without_contact(results, 1)
    assert overlap == pytest.approx(1, abs=1e-6)
