"""A column is compressed beyond its Euler load.

Source: L. Euler (1744); S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., section 2.7:
K(sin(angle/2)) = (pi/2) sqrt(P/P_E) gives the deflection of a clamped-free column; P_E = pi^2 E I/(4 L^2). The
perfect column stays straight and its tangent gets a negative pivot. Pushed aside while the load passes P_E and let go
again it stays bent, as the source has it.
"""

import numpy as np

from verification import figures
from verification.deck_text import Rigidity, chain, heading, join, step, straight
from verification.references import elastica

EULER = np.pi**2 / 4.0
RATIOS = (1.1, 1.3, 1.6, 2.0, 3.0)
PUSH = 0.05 * EULER
# weaker in one plane, else the plane of the buckled column would not be determined
RIGIDITY = Rigidity(ea=1e7, ga=1e7, gj=0.8, ei2=1.0, ei3=4.0)
N = 20


def deck(element, loads, n=N):
    """A column of length 1 along z; each pair of compression and push to the side is reached in one *STEP."""
    return join(
        heading(
            "Column beyond its Euler load",
            f"Model   length 1, E I = 1: {n} {element} elements, clamped at the foot",
            "Source  Timoshenko and Gere, Theory of Elastic Stability, section 2.7",
        ),
        chain(straight(1.0, n, (0.0, 0.0, 1.0)), element, "COLUMN"),
        RIGIDITY.block("COLUMN", first_axis=(0.0, 1.0, 0.0)),
        "*BOUNDARY\n 1, ENCASTRE",
        *(
            step(f"*CLOAD\n {n + 1}, 3, {-load:.16g}\n {n + 1}, 1, {push:.16g}", increments=4, direct=False)
            for load, push in loads
        ),
    )


def measure(workspace):
    values = {}
    for element in ("B31", "B33"):
        # the discrete column of one-point elements buckles 0.1 % later
        straight_up = workspace.run(f"{element}_perfect", deck(element, [(0.99 * EULER, 0.0), (1.01 * EULER, 0.0)]))
        pivots = straight_up.status["negative_pivots"]
        steps = straight_up.status["step"]
        values[f"column.{element}.pivots"] = [int(pivots[steps == number][-1]) for number in (1, 2)]
        loads = [(RATIOS[0] * EULER, PUSH), *((ratio * EULER, 0.0) for ratio in RATIOS)]
        bent = workspace.run(f"{element}_bent", deck(element, loads))
        last = [int(np.flatnonzero(bent.steps == number + 2)[-1]) for number in range(len(RATIOS))]
        tips = np.array([bent.field("displacement", increment)[-1] for increment in last])
        values[f"column.{element}.deflection"] = np.abs(tips[:, 0]).tolist()
        values[f"column.{element}.shortening"] = (-tips[:, 2]).tolist()
    return values


def draw(values, path):
    ratios = np.geomspace(1.0001, 3.1, 30)
    exact = np.array([elastica.column(ratio) for ratio in ratios])
    with figures.panels(path, columns=1) as axes:
        axes.plot([0, 0], [0, 3.1], **figures.REFERENCE)
        for i, name in enumerate(("deflection", "shortening")):
            axes.plot(exact[:, i], ratios, label=None if i else "elliptic integrals", **figures.REFERENCE)
            for element in ("B31", "B33"):
                axes.plot(
                    values[f"column.{element}.{name}"],
                    RATIOS,
                    linestyle="none",
                    fillstyle="none",
                    label=None if i else f"{N} {element}",
                    **figures.STYLES[element],
                )
        axes.set(xlabel="deflection / L (left), shortening / L (right)", ylabel=r"$P/P_E$")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["column"]))
