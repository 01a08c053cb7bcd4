"""A straight rod is rolled up to one and to two full circles by a moment at its end.

Source: the elastic line of a rod under an end moment M is a circle of radius E I/M (Euler 1744); J. C. Simo, L. Vu-
Quoc, Comput. Methods Appl. Mech. Eng. 58 (1986) 79-116, section 7.1. The moment acts about an axis that is fixed in
space (*CLOAD, degree of freedom 6). M = 2 pi E I/L closes the circle.
"""

import numpy as np

from verification import figures
from verification.deck_text import Rigidity, chain, heading, join, step, straight
from verification.numerics import extrapolate

MESHES = (10, 20, 40, 80)
ORDER = {"B31": 2, "B33": 4}
RIGIDITY = Rigidity(ea=1e6, ga=1e6, gj=1.0, ei2=1.0, ei3=1.0)
INCREMENTS = 8


def deck(element, n):
    """A rod of length 1 and E I = 1; the first *STEP rolls it up once, the second twice."""
    return join(
        heading(
            "Roll-up to one and two circles",
            f"Model   length 1, E I = 1, E A = G A = 1e6: {n} {element} elements; end moment 2 pi, then 4 pi",
            "Source  a circle of radius E I/M: Euler (1744); Simo and Vu-Quoc (1986), section 7.1",
            "Expect  the end comes back to the clamp after each step",
        ),
        chain(straight(1.0, n), element, "ROD"),
        RIGIDITY.block("ROD"),
        "*BOUNDARY\n 1, ENCASTRE",
        *(
            step(f"*CLOAD\n {n + 1}, 6, {2 * np.pi * circles:.16g}", increments=INCREMENTS, direct=False)
            for circles in (1, 2)
        ),
    )


def ends_of_steps(results):
    """Indices of the increments that end the two steps."""
    return [int(np.flatnonzero(results.steps == number)[-1]) for number in (1, 2)]


def measure(workspace):
    values, figure = {}, {}
    for element in ("B31", "B33"):
        meshes = (10,) if workspace.quick else MESHES
        runs = {n: workspace.run(f"{element}_{n}", deck(element, n)) for n in meshes}
        coarse = runs[10]
        for circles, increment in zip(("one", "two"), ends_of_steps(coarse), strict=True):
            moment = 2 * np.pi * {"one": 1, "two": 2}[circles]
            turned = coarse.field("rotation", increment)[:, 2] - moment * coarse.nodes[:, 0]
            values[f"roll_up.{element}.{circles}.rotation"] = float(np.abs(np.exp(1j * turned) - 1.0).max())
            values[f"roll_up.{element}.{circles}.closure"] = float(np.linalg.norm(coarse.positions(increment)[-1]))
        if workspace.quick:
            continue
        across = []
        for n, results in runs.items():
            x = results.positions(ends_of_steps(results)[0])
            across.append(float(np.linalg.norm(x[n // 2] - x[0])))
        values[f"roll_up.{element}.diameter"] = float(extrapolate(across[-2], across[-1], ORDER[element]))
        figure[element] = [abs(d - 1 / np.pi) for d in across]
        values[f"roll_up.{element}.order"] = float(np.log2(figure[element][0] / figure[element][1]))
    if not workspace.quick:
        figure["shapes"] = [runs[40].positions(increment) for increment in range(INCREMENTS + 1)]
    return values | {"figure": figure}


def draw(values, path):
    figure = dict(values["figure"])
    with figures.panels(path) as (shape, error):
        for x in figure.pop("shapes"):
            shape.plot(x[:, 0], x[:, 1], color="#c4451c")
        shape.set(xlabel="x/L", ylabel="y/L", aspect="equal", title="40 B33, M L/(2 pi E I) = 0 to 1")
        figures.convergence(error, MESHES, figure, ORDER, "error of the diameter / L")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["roll_up"]))
