"""Decks of round wires that cross: what the cases of contact share."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from verification.deck_text import chain, heading, join, step

INPUTS = Path(__file__).parents[1] / "inputs"


@dataclass(frozen=True)
class Wire:
    """A round wire of one material."""

    radius: float
    young: float
    poisson: float
    resistivity: float

    @property
    def area(self):
        """Area of the section [m^2]."""
        return math.pi * self.radius**2

    @property
    def ei(self):
        """Bending stiffness [N m^2]."""
        return self.young * math.pi * self.radius**4 / 4

    def resistance(self, length):
        """Resistance of a length [ohm]."""
        return self.resistivity * length / self.area


COPPER = Wire(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)


def section(wire, name, *sets, conducting=False, options="", shear=None):
    """Material and round sections of element sets.

    options: of *BEAM SECTION; shear: stiffness G A [N] in place of that of the section.
    """
    lines = [f"*MATERIAL, NAME={name}", "*ELASTIC", f" {wire.young:.16g}, {wire.poisson:.16g}"]
    if conducting:
        lines += ["*ELECTRICAL CONDUCTIVITY", f" {1 / wire.resistivity:.17g}"]
    for elements in sets:
        lines += [f"*BEAM SECTION, ELSET={elements}, MATERIAL={name}, SECTION=CIRC{options}", f" {wire.radius:.16g}"]
        if shear is not None:
            lines += ["*TRANSVERSE SHEAR STIFFNESS", f" {shear:.16g}, {shear:.16g}"]
    return "\n".join(lines)


def interaction(*pairs, penalty=None, spot="", axis="HERMITE", options=""):
    """Contact of pairs of element sets.

    penalty: of the linear law [N/m], None for Hertz; spot: law as *GAP ELECTRICAL CONDUCTANCE has it; options: of
    *SURFACE BEHAVIOR.
    """
    behavior = "HERTZ" if penalty is None else f"LINEAR{options}\n {penalty:.16g}"
    lines = [f"*SURFACE INTERACTION, NAME=TOUCH, AXIS={axis}", f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={behavior}"]
    if spot:
        lines.append(f"*GAP ELECTRICAL CONDUCTANCE, LAW={spot}")
    for pair in pairs:
        lines += ["*CONTACT PAIR, INTERACTION=TOUCH", " " + ", ".join(pair)]
    return "\n".join(lines)


def held(support, first, last, along, *, moving=False):
    """Data lines of *BOUNDARY for a wire along axis `along` (1 or 2) and the nodes that carry its height.

    support: "clamped" (one end may slide along the wire), "supported" (likewise), "sliding" (clamped, both ends may slide)
    or "cantilever" (clamped at `first`).
    The height of a moving wire is left out: it belongs to the step.
    """
    dofs = {
        "clamped": (set(range(1, 7)), set(range(1, 7)) - {along}),
        "supported": ({1, 2, 3, 3 + along}, {1, 2, 3} - {along}),
        "sliding": (set(range(1, 7)) - {along}, set(range(1, 7)) - {along}),
        "cantilever": (set(range(1, 7)), set()),
    }[support]
    ends = [(node, sorted(held_dofs)) for node, held_dofs in zip((first, last), dofs, strict=True) if held_dofs]
    lines = [f" {node}, {dof}" for node, held_dofs in ends for dof in held_dofs if not (moving and dof == 3)]
    return lines, [node for node, _ in ends]


@dataclass(frozen=True)
class Crossing:
    """Two wires at right angles, the lower one along x, the upper one along y and lowered in levels.

    `lower` and `upper` are the distances of the nodes from the first support, and `at` those of the crossing.
    """

    lower: np.ndarray
    upper: np.ndarray
    at: tuple
    support: str = "clamped"
    element: str = "B33"
    wire: Wire = COPPER
    clearance: float = 0.0

    @property
    def last(self):
        """Numbers of the last nodes; the first ones are 1001 and 2001."""
        return 1000 + len(self.lower), 2000 + len(self.upper)

    def deck(self, contact, levels, *notes, potentials="", step_cards="", options="", shear=None):
        """A deck with one step for each level of the upper supports [m].

        `potentials`: data lines of *BOUNDARY in the first step, where the wires are conductors; PLUS and MINUS are the
        first nodes of the lower and the upper wire. `step_cards` of the first step; `options` and `shear` as `section`.
        """
        zero = np.zeros_like
        low = np.column_stack([self.lower - self.at[0], zero(self.lower), zero(self.lower)])
        height = 2 * self.wire.radius + self.clearance
        high = np.column_stack([zero(self.upper), self.upper - self.at[1], height + zero(self.upper)])
        fixed, _ = held(self.support, 1001, self.last[0], 1)
        guided, moving = held(self.support, 2001, self.last[1], 2, moving=True)
        return join(
            heading("Two wires that cross at right angles", *notes),
            chain(low, self.element, "LOWER", 1001),
            chain(high, self.element, "UPPER", 2001),
            "*NSET, NSET=PLUS\n 1001\n*NSET, NSET=MINUS\n 2001",
            "*NSET, NSET=MOVING\n " + ", ".join(map(str, moving)),
            section(self.wire, "COPPER", "LOWER", "UPPER", conducting=bool(potentials), options=options, shear=shear),
            contact,
            "*BOUNDARY",
            *fixed,
            *guided,
            *(
                step(
                    f"*BOUNDARY\n MOVING, 3, 3, {-level:.16g}",
                    *((potentials, "*ELECTRODE PRINT\n PLUS, MINUS") if potentials and i == 0 else ()),
                    step_cards if i == 0 else "",
                )
                for i, level in enumerate(levels)
            ),
        )
