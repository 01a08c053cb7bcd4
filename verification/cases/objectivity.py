"""A rigid rotation of a loaded frame changes nothing, nor does the way on which a state is reached.

Source: M. A. Crisfield, G. Jelenic, Proc. R. Soc. Lond. A 455 (1999) 1125-1147, on objectivity and path independence
of geometrically exact beams; A. Ibrahimbegovic, R. L. Taylor, Comput. Methods Appl. Mech. Eng. 191 (2002) 5159-5176,
the L-shaped frame whose clamp is turned. A frame of two legs carries a force along z, its clamp is turned twice about
z: the deformed frame turns as a rigid body. Loads that are conservative give the same state in any order, and no
state when they are gone.
"""

import numpy as np

from verification import figures
from verification.cases.iterations import CORNER
from verification.deck_text import Rigidity, chain, heading, join, step
from verification.numerics import rotation
from verification.references.rod import Piece, free_shape

RIGIDITY = Rigidity(ea=1e6, ga=1e6, gj=0.8, ei2=1.0, ei3=1.0)
ELEMENTS_PER_LEG = 8
TURNS = 2
INCREMENTS = 48
FORCE_1, FORCE_2 = (0.0, 0.0, 8.0), (-3.0, 4.0, 2.0)


def deck(element, title, *steps):
    """A frame of two legs of length 1/2 at right angles, clamped at the first end."""
    return join(
        heading(title, "Model   two legs of length 1/2, E I = 1", "Source  see verification/cases/objectivity.py"),
        chain(free_shape([Piece(0.5, corner=CORNER), Piece(0.5)], ELEMENTS_PER_LEG), element, "FRAME"),
        RIGIDITY.block("FRAME"),
        "*BOUNDARY\n 1, ENCASTRE",
        *steps,
    )


def load(*forces):
    """A step of one increment that ends with the sum of these forces at the tip."""
    total = np.sum(forces, axis=0) if forces else np.zeros(3)
    tip = 2 * ELEMENTS_PER_LEG + 1
    return step(*(f"*CLOAD\n {tip}, {i + 1}, {value}" for i, value in enumerate(total)), direct=False)


def measure(workspace):
    values = {}
    for element in ("B31", "B33"):
        turn = step(f"*BOUNDARY\n 1, 6, 6, {2 * np.pi * TURNS:.16g}", increments=INCREMENTS)
        results = workspace.run(f"{element}_turned", deck(element, "Turned clamp", load(FORCE_1), turn))
        angle = 2 * np.pi * TURNS * (results.times[1:] - 1.0)
        paths = np.array([results.positions(i + 1) for i in range(len(angle))])
        rigid = np.array([paths[0] @ rotation([0.0, 0.0, a]).T for a in angle])
        values[f"objectivity.{element}.rotation"] = float(np.abs(paths - rigid).max())
        m2, m3 = (results.field(f"bending_moment_{axis}", None)[1:] for axis in (2, 3))
        moments = np.hypot(m2, m3)
        values[f"objectivity.{element}.moments"] = float(np.abs(moments - moments[0]).max() / moments[0].max())

        loop = [load(FORCE_1), load(FORCE_1, FORCE_2), load(FORCE_2), load()]
        there = workspace.run(f"{element}_loop", deck(element, "Closed loop of loads", *loop))
        back = workspace.run(
            f"{element}_other_order", deck(element, "Loads in the other order", load(FORCE_2), load(FORCE_1, FORCE_2))
        )
        values[f"objectivity.{element}.loop"] = float(np.abs(there.field("displacement")).max())
        both = there.index(2, int(there.increments[there.steps == 2][-1]))
        values[f"objectivity.{element}.order"] = float(np.abs(there.positions(both) - back.positions()).max())
    return values | {"figure": paths}


def draw(values, path):
    paths = values["figure"]
    with figures.panels(path, columns=1) as axes:
        for x in paths[: INCREMENTS // TURNS + 1 : 4]:
            axes.plot(x[:, 0], x[:, 1], color="#c4451c")
        angle = np.linspace(0.0, 2 * np.pi, 200)
        radius = np.linalg.norm(paths[0, -1, :2])
        axes.plot(radius * np.cos(angle), radius * np.sin(angle), "--", **figures.REFERENCE)
        axes.plot(paths[:, -1, 0], paths[:, -1, 1], ".", color="#c4451c")
        axes.set(xlabel="x", ylabel="y", aspect="equal", title="frame whose clamp turns, from above")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["objectivity"]))
