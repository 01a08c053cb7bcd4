"""Curves that are drawn with so few elements that each node is a kink: `litz check` and the run tell it, once for all wires."""

import numpy as np
import pytest

from decks import wire
from line_wires import HERTZ

RADIUS = 1e-3
KIND = "coarse_curve"


def coil(turns, elements_a_turn, radius, *, first=1, name="COIL", start=(0.0, 0.0, 0.0), reversed_ones=()):
    """A wire along a helix whose turns touch: the lengths are in radii of the wire."""
    rise = 2 * 0.997 / np.cos(np.arcsin(2 / (2 * np.pi * radius)))
    angle = np.linspace(0, 2 * np.pi * turns, round(turns * elements_a_turn) + 1)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), rise * angle / (2 * np.pi)], axis=1) + start
    return wire(name, RADIUS * points, first, element="B33", backwards=reversed_ones)


def deck(wires, names=("COIL",), pair="COIL, COIL"):
    """All nodes are held: the overlap is that of the mesh."""
    sets = "".join(f"*BEAM SECTION, ELSET={name}, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n" for name in names)
    held = "".join(f" {name}, ENCASTRE\n" for name in names)
    return (
        f"{wires}*MATERIAL, NAME=COPPER\n*ELASTIC\n 120e9, 0.34\n{sets}"
        f"*SURFACE INTERACTION, NAME=TOUCH\n{HERTZ}*CONTACT PAIR, INTERACTION=TOUCH\n {pair}\n"
        f"*BOUNDARY\n{held}*STEP\n*STATIC\n 1., 1.\n*END STEP\n"
    )


def told(results):
    """Messages of this kind."""
    return [entry.message for entry in results.warnings if entry.kind == KIND]


@pytest.mark.parametrize(("elements", "degrees", "turn"), [(17, 21, 17), (12, 30, 12), (8, 45, 8)])
def test_a_coil_of_kinks_is_told(run, elements, degrees, turn):
    process, results = run(deck(coil(3, elements, 3.0, reversed_ones=(2, 5))))
    assert process.returncode == 0, process.stderr
    (message,) = told(results)
    assert f"the wire of elements 1 to {3 * elements} is drawn with {turn} elements a turn" in message
    assert f"it turns by {degrees} degrees at each of several nodes in a row" in message
    assert "nodes that turn by more than 20 degrees are kinks, with round joints" in message
    assert "take at least 19 elements a turn" in message
    assert message in process.stderr


def test_its_force_is_too_large_and_without_kinks_it_is_right(run):
    """What the warning is about: the law per length of the turns, by any mesh of smaller turns."""
    forces = []
    for elements in (17, 19, 38):
        process, results = run(deck(coil(4, elements, 3.0)), name=f"coil{elements}")
        assert process.returncode == 0, process.stderr
        ledger = results.contacts_at(-1)
        middle = (np.minimum(ledger["element_1"], ledger["element_2"]) - 1) // elements == 1
        forces.append(ledger["force"][middle].sum())
        assert bool(told(results)) == (elements == 17)
    assert forces[0] / forces[2] == pytest.approx(1.17, abs=0.03)
    assert forces[1] / forces[2] == pytest.approx(1.0, abs=0.01)


def test_check_tells_it_once_for_all_wires(litz, tmp_path):
    two = coil(2, 12, 3.0) + coil(2, 12, 3.0, first=101, name="OTHER", start=(20.0, 0.0, 0.0))
    (tmp_path / "deck.inp").write_text(
        deck(two + "*ELSET, ELSET=BOTH\n COIL, OTHER\n", ("COIL", "OTHER"), "BOTH, BOTH")
    )
    process = litz("check", "deck.inp", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    text = process.stdout + process.stderr
    assert text.count("is drawn with") == 1
    assert "(and 1 more)" in text


CORNER = np.array([(0, 0, 0), (10, 0, 0), (20, 0, 0), (30, 0, 0), (30, 10, 0), (30, 20, 0), (30, 30, 0)], dtype=float)
SQUARE = np.array([(0, 0, 0), (20, 0, 0), (20, 20, 0), (0, 20, 0), (0, 40, 0)], dtype=float)
ZIGZAG = np.array([(10 * k, 5 * (k % 2), 0) for k in range(8)], dtype=float)
#: Two kinks of 30 degrees, as a bend that is meant as such
BEND = np.array([(0, 0, 0), (10, 0, 0), (20, 0, 0), (28.7, 5, 0), (33.7, 13.7, 0), (38.7, 22.3, 0)])


@pytest.mark.parametrize("points", [CORNER, SQUARE, ZIGZAG, BEND], ids=["corner", "square", "zigzag", "two kinks"])
def test_kinks_that_are_meant_are_not(run, points):
    process, results = run(deck(wire("COIL", RADIUS * points, element="B33")))
    assert process.returncode == 0, process.stderr
    assert told(results) == []


def test_a_ring_of_kinks_across_a_wire_is_not(run):
    """It touches with one of its kinks, as such."""
    angle = 2 * np.pi * np.arange(16) / 16 - np.pi / 2
    ring = np.stack([10 * np.cos(angle), 0 * angle, 10 * np.sin(angle)], axis=1)
    across = np.array([(0, y, -11.998) for y in np.linspace(-10, 10, 9)])
    wires = wire("COIL", RADIUS * ring, element="B33", closed=True) + wire("OTHER", RADIUS * across, 101, element="B33")
    process, results = run(deck(wires, ("COIL", "OTHER"), "COIL, OTHER"))
    assert process.returncode == 0, process.stderr
    assert results.contacts_at(-1).n_rows > 0
    assert told(results) == []


def test_a_coil_that_comes_to_lie_along_a_wire_is_told_then(run):
    """Its turns do not touch; a straight wire is lowered onto the side of a coarse arc, whose first elements lead along it."""
    angle = np.linspace(-0.9, 0.9, 5)
    arc = np.stack([4 * np.sin(angle), 0 * angle, 4 * np.cos(angle) - 4], axis=1)
    bar = np.array([(x, 0, 2.5) for x in np.linspace(-6, 6, 13)])
    wires = wire("COIL", RADIUS * arc, element="B33") + wire("OTHER", RADIUS * bar, 101, element="B33")
    text = deck(wires, ("COIL", "OTHER"), "COIL, OTHER")
    text = text.replace(" OTHER, ENCASTRE\n", " OTHER, 1, 2\n OTHER, 4, 6\n")
    process, results = run(text.replace("*END STEP", f"*BOUNDARY\n OTHER, 3, 3, {-0.502 * RADIUS}\n*END STEP"))
    assert process.returncode == 0, process.stderr
    (entry,) = [entry for entry in results.warnings if entry.kind == KIND]
    assert (entry.step, entry.increment) == (1, 1)


def test_a_wire_that_touches_nothing_is_not(run):
    straight = wire("OTHER", RADIUS * np.array([(50.0, 0, 0), (60.0, 0, 0)]), 501, element="B33")
    process, results = run(deck(coil(2, 12, 3.0) + straight, ("COIL", "OTHER"), "OTHER, OTHER"))
    assert process.returncode == 0, process.stderr
    assert told(results) == []


def test_turns_that_are_joined_by_kinks_are_refused_with_the_reason(litz, tmp_path):
    """A coil of 1.2 radii: no nodes are shared, and the way from turn to turn is shorter than 8 radii."""
    (tmp_path / "deck.inp").write_text(deck(coil(3, 12, 1.2)))
    process = litz("run", "deck.inp", cwd=tmp_path)
    assert process.returncode == 1
    assert (
        "where the way from one to the other, along wires that meet at nodes, is shorter than 8 radii" in process.stderr
    )
    assert "a node at which a wire turns by more than 20 degrees joins two wires, too" in process.stderr
    assert "Draw bends with smaller turns at each node" in process.stderr
