"""Round ends of wires on wires: tips that lean, and crossings just before an end, as in a half-space.

Source: boundary-element solutions, references/end_in_half_space.py.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.line_decks import FIRST, SECOND, material, touching
from verification.wire_decks import Wire

RADIUS, OVERLAP = 1e-3, 1e-5
WIRE = Wire(radius=RADIUS, young=120e9, poisson=0.34, resistivity=0.0)
MODULUS = WIRE.young / (1 - WIRE.poisson**2) / 2
#: E* r^(1/2) delta^(3/2) [N], and sqrt(r delta) [m]
FORCE, LENGTH = MODULUS * RADIUS**0.5 * OVERLAP**1.5, math.sqrt(RADIUS * OVERLAP)
#: Slopes of tips, in sqrt(delta/r)
SLOPES = (1.0, 0.5, 0.25)
#: Places of crossings before the end, in sqrt(r delta)
BEFORE = (0.0, 0.3, 0.6, 1.0)


def measure(workspace):
    tips = [force_of(workspace, f"tip_{v}", straight((0, 0), v * math.sqrt(OVERLAP / RADIUS))) for v in SLOPES]
    across = [force_of(workspace, f"before_{place}", straight((0, -place * LENGTH), math.inf)) for place in BEFORE]
    return {
        "ends_on_wires.tips": tips,
        "ends_on_wires.crossings": across,
        "figure": {"tips": tips, "crossings": across},
    }


def draw(values, path):
    with figures.panels(path) as (tips, crossings):
        tips.plot(SLOPES, values["figure"]["tips"], "o", label="litz")
        tips.plot(SLOPES, [1.133, 1.185, 1.432], label="half-space", **figures.REFERENCE)
        tips.set(xlabel="slope of the tip [(delta/r)^(1/2)]", ylabel="force [E* r^(1/2) delta^(3/2)]", ylim=(0, None))
        tips.legend()
        crossings.plot(BEFORE, values["figure"]["crossings"], "o")
        crossings.plot(BEFORE, [1.236, 1.297, 1.326, 1.334], **figures.REFERENCE)
        crossings.set(xlabel="way from the crossing to the end [(r delta)^(1/2)]", ylim=(0, None))


def straight(tip, slope, n=10, length=10 * RADIUS):
    """Points of a wire from its tip on: along x and up, or with an infinite slope along y; the other wire is along x."""
    s = np.linspace(0, length, n + 1)
    if math.isinf(slope):
        return np.column_stack([0 * s, tip[1] + s, 0 * s])
    return np.column_stack([tip[0] + s / math.hypot(1, slope), tip[1] + 0 * s, s * slope / math.hypot(1, slope)])


def force_of(workspace, name, upper):
    """Force of the upper wire on one along x, over E* r^(1/2) delta^(3/2)."""
    lower = np.linspace(-8 * RADIUS, 12 * RADIUS, 21)[:, None] * [1, 0, 0]
    deck = join(
        heading("The end of a wire on another one", "Model   all nodes are led"),
        chain(lower, "B33", "LOWER", FIRST),
        chain(upper + np.array([0, 0, 2 * RADIUS]), "B33", "UPPER", SECOND),
        material("METAL", WIRE, "LOWER", "UPPER"),
        touching(("LOWER", "UPPER")),
        "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1, 2\n UPPER, 4, 6",
        step(f"*BOUNDARY\n UPPER, 3, 3, {-OVERLAP:.17g}"),
    )
    return float(workspace.run(name, deck).contacts_at(-1)["force"].sum()) / FORCE


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["ends_on_wires"]))
