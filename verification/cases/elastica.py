"""Cantilever under a transverse dead load at its tip, P L^2/(E I) = 0.2 to 10.

Source: K. E. Bisshopp, D. C. Drucker, Quart. Appl. Math. 3 (1945) 272-275; K. Mattiasson, Int. J. Numer. Methods Eng.
17 (1981) 145-153, table 1. The rod of the source neither stretches nor shears; here E A L^2/(E I) = G A L^2/(E I) =
1e8.
"""

import numpy as np

from verification import figures
from verification.deck_text import Rigidity, chain, heading, join, step, straight
from verification.numerics import extrapolate
from verification.references import elastica

LOADS = (0.2, 0.4, 0.5, 0.8, 1, 2, 4, 5, 6, 9, 10)
MESHES = (5, 10, 20, 40, 80)
ORDER = {"B31": 2, "B33": 4}
RIGIDITY = Rigidity(ea=1e8, ga=1e8, gj=1.0, ei2=1.0, ei3=1.0)


def deck(element, n, loads=LOADS):
    """A cantilever of length 1 along x with E I = 1; one step of one increment for each tip load along y."""
    return join(
        heading(
            "Elastica: cantilever under a transverse load at its tip",
            f"Model   length 1, E I = 1, E A = G A = 1e8: {n} {element} elements; one load step for each load",
            "Source  Bisshopp and Drucker (1945), Mattiasson (1981) table 1",
        ),
        chain(straight(1.0, n), element, "ROD"),
        RIGIDITY.block("ROD"),
        "*BOUNDARY\n 1, ENCASTRE",
        *(step(f"*CLOAD\n {n + 1}, 2, {load}") for load in loads),
    )


def tip(results):
    """w/L, u/L and tip angle at each load, (loads, 3)."""
    u = results.field("displacement", None)[1:, -1]
    angle = results.field("rotation", None)[1:, -1, 2]
    return np.column_stack([u[:, 1], -u[:, 0], angle])


def measure(workspace):
    values, errors = {}, {}
    meshes = (20,) if workspace.quick else MESHES
    exact = np.array([elastica.cantilever(load) for load in LOADS])
    for element in ("B31", "B33"):
        tips = {n: tip(workspace.run(f"{element}_{n}", deck(element, n))) for n in meshes}
        for i, name in enumerate(("deflection", "shortening", "angle")):
            values[f"elastica.{element}.{name}"] = tips[20][:, i].tolist()
        if not workspace.quick:
            errors[element] = [float(np.abs(tips[n] - exact).max()) for n in meshes]
            values[f"elastica.{element}.order"] = float(np.log2(errors[element][0] / errors[element][1]))
            values[f"elastica.{element}.limit"] = extrapolate(tips[40][-1], tips[80][-1], ORDER[element]).tolist()
    return values | {"figure": errors}


def draw(values, path):
    loads = np.geomspace(0.1, 10, 25)
    exact = np.array([elastica.cantilever(load) for load in loads])
    with figures.panels(path) as (curve, error):
        for i, name in enumerate(("deflection", "shortening")):
            curve.plot(loads, exact[:, i], label=None if i else "elliptic integrals", **figures.REFERENCE)
            for element in ("B31", "B33"):
                curve.plot(
                    LOADS,
                    values[f"elastica.{element}.{name}"],
                    linestyle="none",
                    fillstyle="none",
                    label=None if i else f"20 {element}",
                    **figures.STYLES[element],
                )
        curve.annotate("w/L", (8, 0.82))
        curve.annotate("u/L", (8, 0.43))
        curve.set(xlabel=r"$PL^2/EI$", ylabel="tip displacement / length")
        curve.legend()
        figures.convergence(error, MESHES, values["figure"], ORDER, "largest error of w/L, u/L, angle")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["elastica"]))
