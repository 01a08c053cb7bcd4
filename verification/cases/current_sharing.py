"""How two strands share a current: the ladder of a contact all along them, and a single joint.

Source: the transmission line of W. Thomson, Proc. R. Soc. 7 (1855) 382-399, in references/line_joints.py; Kirchhoff's laws
for one joint in references/two_strands.py.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.line_decks import FIRST, SECOND, material, pressed_pair, touching, uniform_spot
from verification.numerics import extrapolate
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires, PressedWire
from verification.references.two_strands import TwoStrands

STRANDS = (PressedWire(0.5e-3, 120e9, 0.34, 1.7e-8), PressedWire(0.3e-3, 120e9, 0.34, 1.5e-7))
PER_LENGTH = tuple(wire.resistivity / (math.pi * wire.radius**2) for wire in STRANDS)
LENGTH, OVERLAP, CONDUCTANCE = 20e-3, 1e-7, 1e4
LADDER = LineJoint(LENGTH, CONDUCTANCE, *PER_LENGTH)
#: Elements of each strand: places of contact are 0.1 and 0.05 mm apart
MESHES = (40, 200)
#: Places along the strands at which their shares are compared, over the length
PLACES = (0.1, 0.25, 0.5, 0.75)
#: The strands with one joint cross at 20 degrees, each inclined by half of that, after a third of their length
ANGLE, ELEMENTS, JOINT = math.radians(20), 7, 2e-4
ONE_JOINT = TwoStrands(PER_LENGTH, JOINT, (LENGTH / 3,) * 2, (2 * LENGTH / 3,) * 2)


def ladder(workspace, elements):
    """Results of a lap joint with the same conductance all along it."""
    pair = ParallelWires(*STRANDS)
    text = pressed_pair(pair, [OVERLAP], LENGTH, elements, spot=uniform_spot(CONDUCTANCE), potentials="lap")
    return workspace.run(f"ladder_{elements}", text)


def one_joint(workspace):
    """Results of two strands that cross; the current enters one and leaves both."""
    along = np.linspace(-LENGTH / 3, 2 * LENGTH / 3, ELEMENTS + 1)
    height = sum(wire.radius for wire in STRANDS) - OVERLAP
    lower, upper = (
        np.column_stack([math.cos(ANGLE / 2) * along, sign * math.sin(ANGLE / 2) * along, np.full_like(along, z)])
        for sign, z in ((1, 0.0), (-1, height))
    )
    # they come down on each other, as no model begins with an overlap
    upper[:, 2] += 2 * OVERLAP
    return workspace.run(
        "one_joint",
        join(
            heading("Two strands with one joint", "Model   7 B33 each, all nodes are led, a contact of 0.2 mohm"),
            chain(lower, "B33", "LOWER", FIRST),
            chain(upper, "B33", "UPPER", SECOND),
            f"*NSET, NSET=PLUS\n {FIRST}\n*NSET, NSET=MINUS\n {FIRST + ELEMENTS}, {SECOND + ELEMENTS}",
            material("ONE", STRANDS[0], "LOWER"),
            material("OTHER", STRANDS[1], "UPPER"),
            touching(("LOWER", "UPPER"), spot=f"CONSTANT\n {JOINT:.17g}"),
            "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1, 2\n UPPER, 4, 6",
            step(
                f"*BOUNDARY\n UPPER, 3, 3, {-2 * OVERLAP:.17g}\n PLUS, 9, 9, 1e-3\n MINUS, 9, 9, 0.",
                "*ELECTRODE PRINT\n PLUS, MINUS",
            ),
        ),
    )


def measure(workspace):
    crossed = one_joint(workspace)
    values = {
        "current_sharing.joint.between": float(crossed.interstrand_resistance().matrix[0, 1]),
        "current_sharing.joint.resistance": float(crossed.history["resistance PLUS to MINUS"][-1]),
        "current_sharing.joint.share": float(crossed.current_shares(count=2).share[1, -1]),
    }
    runs = [ladder(workspace, elements) for elements in (MESHES[:1] if workspace.quick else MESHES)]
    values["current_sharing.length"] = float(runs[0].redistribution_lengths()[0])
    if workspace.quick:
        return values | {"figure": {}}
    values["current_sharing.ladder"] = [
        extrapolate(*(float(run.interstrand_resistance(at=at).matrix[0, 1]) for run in runs), 2) for at in (0.0, 0.5)
    ]
    shares = [run.current_shares(count=201) for run in runs]
    rows = [round(200 * place) for place in PLACES]
    values["current_sharing.share"] = [extrapolate(*(float(one.share[0, row]) for one in shares), 2) for row in rows]
    return values | {"figure": {"place": shares[1].place, "share": shares[1].share[0]}}


def draw(values, path):
    if not values["figure"]:
        return
    with figures.panels(path, columns=1) as axes:
        x = np.linspace(0, LENGTH, 200)
        axes.plot(1e3 * x, LADDER.lap_current(x), color="#222222", label="ladder")
        every = slice(None, None, 10)
        place, share = values["figure"]["place"][every], values["figure"]["share"][every]
        axes.plot(1e3 * place, share, **figures.STYLES["B33"], linestyle="none", label="litz")
        axes.set(xlabel="x [mm]", ylabel="share of the first strand")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["current_sharing"]))
