"""Templates of decks: blocks of text that are put together with `join`."""

from dataclasses import dataclass

import numpy as np


def join(*blocks):
    """One deck from its blocks."""
    return "\n".join(block.strip("\n") for block in blocks if block) + "\n"


def heading(title, *notes):
    """*HEADING with a title, and comment lines that say what is modelled and what to expect."""
    return "\n".join(["*HEADING", title, "**", *(f"** {note}" for note in notes), "**"])


def chain(points, element, name, first=1):
    """Nodes and elements of a wire through `points` (n, 3), both numbered from `first`, both in sets called `name`."""
    lines = [f"*NODE, NSET={name}"]
    lines += [f" {first + i}, {x:.16g}, {y:.16g}, {z:.16g}" for i, (x, y, z) in enumerate(points)]
    lines.append(f"*ELEMENT, TYPE={element}, ELSET={name}")
    lines += [f" {first + i}, {first + i}, {first + i + 1}" for i in range(len(points) - 1)]
    return "\n".join(lines)


@dataclass(frozen=True)
class Rigidity:
    """A section by its stiffnesses: E A, G A (both shears), G J, E I2, E I3 [N, N m^2]."""

    ea: float
    ga: float
    gj: float
    ei2: float
    ei3: float

    def block(self, elements, first_axis=None):
        """Material and section with these stiffnesses; E = 2, nu = 0, so that G = 1."""
        axis = [" " + ", ".join(f"{value:.16g}" for value in first_axis)] if first_axis is not None else []
        return "\n".join(
            [
                f"*MATERIAL, NAME=M_{elements}",
                "*ELASTIC",
                " 2., 0.",
                f"*BEAM SECTION, ELSET={elements}, MATERIAL=M_{elements}, SECTION=GENERAL",
                f" {self.ea / 2:.16g}, {self.ei2 / 2:.16g}, 0., {self.ei3 / 2:.16g}, {self.gj:.16g}",
                *axis,
                "*TRANSVERSE SHEAR STIFFNESS",
                f" {self.ga:.16g}, {self.ga:.16g}",
            ]
        )


def step(*cards, increments=1, most=100, direct=True, controls=""):
    """A *STEP of time 1 in equal increments of fixed size, or with `direct` false in increments that may be cut."""
    first = f"{1.0 / increments:.16g}"
    static = ["*STATIC, DIRECT", f" {first}, 1."] if direct else ["*STATIC", f" {first}, 1., 1.e-4, {first}"]
    return "\n".join([f"*STEP, INC={most:d}", *static, controls, *cards, "*END STEP"]).replace("\n\n", "\n")


def straight(length, n, direction=(1.0, 0.0, 0.0)):
    """n + 1 points along a line from the origin."""
    return np.linspace(0.0, length, n + 1)[:, None] * np.asarray(direction, dtype=float)


def arc(radius, angle, n):
    """n + 1 points along an arc that begins at the origin along x and bends towards y."""
    phi = np.linspace(0.0, angle, n + 1)
    return radius * np.column_stack([np.sin(phi), 1.0 - np.cos(phi), np.zeros(n + 1)])
