"""Decks of two round wires that lie side by side, or cross at small angles."""

import sys
from pathlib import Path

import numpy as np

from decks import wire

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification.references.parallel_wires import PressedWire

COPPER = PressedWire(1e-3, 120e9, 0.34, 1.7e-8)
STEEL = PressedWire(0.6e-3, 200e9, 0.28, 1.4e-7)
HERTZ = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
#: First nodes and elements of the two wires
LOWER, UPPER = 1, 1001
#: All nodes of both wires are led: the upper one is lowered
LED = "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1, 2\n UPPER, 4, 6\n"


def linear(*stiffnesses):
    """Penalties at crossings [N/m] and along lines [N/m^2]; empty: none."""
    return "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n " + ", ".join(map(str, stiffnesses)) + "\n"


def spot(law):
    """Law of the contact spots, as *GAP ELECTRICAL CONDUCTANCE has it."""
    return f"*GAP ELECTRICAL CONDUCTANCE, LAW={law}\n"


def along(length, n, *, degrees=0.0, shift=0.0, height=0.0, start=0.0):
    """Points of a wire of n elements from x = start on, moved by `shift` along itself and turned about the z axis."""
    s, angle = np.linspace(start, start + length, n + 1) + shift, np.radians(degrees)
    return np.column_stack([s * np.cos(angle), s * np.sin(angle), np.full_like(s, height)])


def two_wires(
    lower, upper, *cards, law=HERTZ, wires=(COPPER, COPPER), pairs=("LOWER, UPPER",), pair="", interaction=""
):
    """Model of two wires through points, in the sets LOWER and UPPER, and what follows the contact pair.

    `lower` and `upper` are points, or cards with other numbers; `pair` and `interaction` are parameters of these cards.
    """
    chains = [
        points if isinstance(points, str) else wire(name, points, first, element="B33")
        for name, points, first in (("LOWER", lower, LOWER), ("UPPER", upper, UPPER))
    ]
    return (
        "".join(chains)
        + "".join(material(name, each) for name, each in zip(("LOWER", "UPPER"), wires, strict=True))
        + f"*SURFACE INTERACTION, NAME=TOUCH{interaction}\n{law}"
        + "".join(f"*CONTACT PAIR, INTERACTION=TOUCH{pair}\n {sets}\n" for sets in pairs)
        + "".join(cards)
    )


def material(name, of):
    """Material and section of the wire in an element set."""
    return (
        f"*MATERIAL, NAME={name}\n*ELASTIC\n {of.young}, {of.poisson}\n"
        f"*ELECTRICAL CONDUCTIVITY\n {1 / of.resistivity:.17g}\n"
        f"*BEAM SECTION, ELSET={name}, MATERIAL={name}, SECTION=CIRC\n {of.radius}\n"
    )


def step(*cards, static="1., 1.", boundary=""):
    """A step with prescribed values and other cards."""
    prescribed = f"*BOUNDARY\n{boundary}" if boundary else ""
    return f"*STEP, INC=200\n*STATIC\n {static}\n{prescribed}{''.join(cards)}*END STEP\n"


def lowered(overlap, *cards, static="1., 1."):
    """All nodes of the upper wire are lowered by `overlap` [m]."""
    return step(*cards, static=static, boundary=f" UPPER, 3, 3, {-overlap:.17g}\n")


def pressed(overlap, *, length=20e-3, elements=(8, 8), degrees=0.0, shift=0.0, cards=(), static="1., 1.", **model):
    """Two straight wires that just touch are pressed together as a whole; the upper one may be turned and shifted."""
    height = sum(each.radius for each in model.get("wires", (COPPER, COPPER)))
    lower, upper = (
        along(length, n, start=-length / 2, **place)
        for n, place in zip(elements, ({}, dict(degrees=degrees, shift=shift, height=height)), strict=True)
    )
    return two_wires(lower, upper, LED, lowered(overlap, *cards, static=static), **model)


def crossing_at_a_small_angle(overlaps, of_spot="", law="HERTZ", data="", n=9, sine=0.12):
    """Two straight wires of 1 mm radius, rigid and led: one step for each overlap [m]. Their lens is about a radius long,
    so that places along it and the crossing share the contact."""
    arc = np.linspace(-0.00995, 0.00995, n + 1)
    lines = ["*NODE, NSET=A"]
    lines += [f" {i}, {s:.12g}, 0, 0" for i, s in enumerate(arc, 1)]
    lines += ["*NODE, NSET=B"]
    direction = np.array([np.sqrt(1 - sine**2), sine])
    places = (arc[:, None] + 2e-4) * direction
    lines += [f" {1001 + i}, {x:.12g}, {y:.12g}, 0.002" for i, (x, y) in enumerate(places)]
    for name, first in (("A", 1), ("B", 1001)):
        lines += [f"*ELEMENT, TYPE=B33, ELSET={name}"]
        lines += [f" {first + i}, {first + i}, {first + i + 1}" for i in range(n)]
        lines += [f"*BEAM SECTION, ELSET={name}, MATERIAL=M, SECTION=CIRC", " 1e-3"]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", " 120e9, 0.34", "*ELECTRICAL CONDUCTIVITY", " 5.88e7"]
    lines += ["*NODE", " 901, 0, 0, 0", " 902, 0, 0, 0.002"]
    lines += ["*RIGID BODY, REF NODE=901, TIE NSET=A", "*RIGID BODY, REF NODE=902, TIE NSET=B"]
    lines += ["*SURFACE INTERACTION, NAME=T", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"]
    lines += [f"*GAP ELECTRICAL CONDUCTANCE, LAW={law}{of_spot}", *([data] if data else [])]
    lines += [
        "*CONTACT PAIR, INTERACTION=T",
        " A, B",
        "*BOUNDARY",
        " 901, ENCASTRE",
        " 902, 1, 2",
        " 902, 4, 6",
        " B, 9",
    ]
    for overlap in overlaps:
        lines += ["*STEP, INC=200", "*STATIC", " 0.25, 1", "*BOUNDARY", f" 902, 3, 3, {-overlap}", " A, 9, 9, 1"]
        lines += ["*END STEP"]
    return "\n".join(lines) + "\n"


def conductances_of_places(results, n_steps):
    """Conductance of all places and crossings at the end of each step [S]."""
    contacts = results.contacts
    found = []
    for number in range(1, n_steps + 1):
        last = contacts["increment"][contacts["step"] == number].max()
        resistance = contacts["resistance"][(contacts["step"] == number) & (contacts["increment"] == last)]
        found.append((1 / resistance[resistance > 0]).sum())
    return np.array(found)
