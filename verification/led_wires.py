"""Decks of pairs of straight wires whose nodes are all led: their contacts have a known overlap, whatever bends elsewhere."""

import math
from dataclasses import dataclass

import numpy as np

from verification.deck_text import chain, heading, join, step
from verification.wire_decks import Wire, section

#: Voltage between the wires of each pair [V]
VOLTAGE = 1e-3
#: Nodes along a wire, in radii from the crossing, which lies inside the element in the middle
STATIONS = np.array([-30.0, -12.0, 18.0, 30.0])


@dataclass(frozen=True)
class LedPair:
    """Two wires that cross and overlap."""

    lower: Wire
    upper: Wire
    degrees: float
    overlap: float
    #: Data of the spot law as *GAP ELECTRICAL CONDUCTANCE has them
    law: str = "HERTZ"
    #: Penalty of the linear law [N/m], None for Hertz
    penalty: float | None = None

    def force(self):
        """Contact force of the linear law [N]."""
        return self.penalty * self.overlap

    def blocks(self, number, place):
        """Everything of this pair but the step: nodes from 100 times its number, crossing at `place` along y."""
        low, high, first = f"LOWER{number}", f"UPPER{number}", 100 * number
        angle, size = math.radians(self.degrees), max(self.lower.radius, self.upper.radius)
        crossing = np.array([0.0, place, 0.0])
        height = np.array([0.0, 0.0, self.lower.radius + self.upper.radius])
        along = np.array([math.cos(angle), math.sin(angle), 0.0])
        behavior = "HERTZ" if self.penalty is None else f"LINEAR\n {self.penalty:.16g}"
        name, *data = self.law.split("\n")
        return [
            chain(crossing + size * np.outer(STATIONS, [1, 0, 0]), "B33", low, first),
            chain(crossing + height + size * np.outer(STATIONS[::-1], -along), "B33", high, first + 50),
            section(self.lower, f"M{low}", low, conducting=True),
            section(self.upper, f"M{high}", high, conducting=True),
            f"*SURFACE INTERACTION, NAME=TOUCH{number}",
            f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={behavior}",
            # every node has its potential: nothing is missing inside the elements
            "\n".join([f"*GAP ELECTRICAL CONDUCTANCE, LAW={name}, VOLTAGE=LINEAR", *data]),
            f"*CONTACT PAIR, INTERACTION=TOUCH{number}\n {low}, {high}",
        ]


def deck(pairs, title, *notes):
    """One deck of all pairs, side by side; the upper wires come down by the overlaps in one increment."""
    reach = 2 * max(np.abs(STATIONS)) * max(max(pair.lower.radius, pair.upper.radius) for pair in pairs)
    numbers = range(1, len(pairs) + 1)
    held = [f" LOWER{n}, ENCASTRE\n UPPER{n}, 1, 2\n UPPER{n}, 4, 6" for n in numbers]
    led = [
        f" UPPER{n}, 3, 3, {-pair.overlap:.17g}\n LOWER{n}, 9, 9, {VOLTAGE}\n UPPER{n}, 9, 9, 0."
        for n, pair in zip(numbers, pairs, strict=True)
    ]
    return join(
        heading(
            title, "Model   straight wires, all nodes led and at given potentials; one crossing for each pair", *notes
        ),
        *(block for n, pair in zip(numbers, pairs, strict=True) for block in pair.blocks(n, (n - 1) * reach)),
        "*BOUNDARY",
        *held,
        step("*BOUNDARY", *led),
    )


def contacts(results, pairs):
    """The ledger at the end, one row for each pair; `resistance` is the voltage of the pair over the contact current."""
    ledger = results.contacts_at(-1)
    order = np.argsort(np.minimum(ledger["element_2"], ledger["element_1"]))
    if len(order) != len(pairs):
        raise ValueError(f"{len(order)} contacts for {len(pairs)} pairs")
    names = ("force", "gap", "semi_major", "semi_minor", "current")
    found = {name: np.asarray(ledger[name])[order] for name in names}
    return found | {"resistance": VOLTAGE / np.abs(found["current"])}
