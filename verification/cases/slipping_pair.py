"""Two cantilevers pressed together bend as one beam until they slip, then as two: a loop of friction.

Source: L. E. Goodman, J. H. Klumpp, J. Appl. Mech. 23 (1956) 421-429, for leaf springs; for round wires in
references/slipping_pair.py.
"""

import numpy as np

from verification import figures
from verification.line_decks import slipping_pair
from verification.references.helical_rods import Rod
from verification.references.slipping_pair import SlippingPair

WIRE = Rod(0.5e-3, 200e9, 0.3)
#: Pressed so lightly that the axial force 2 a q, as which the dead loads act when the pair bends, is 1e-3 of what matters
PAIR = SlippingPair(WIRE.radius, 0.05, WIRE.young, 20.0, 0.3)
ELEMENTS = 100
#: Elastic slip before friction reaches its limit, far below the slip of the pair [m]
ELASTIC_SLIP = 1e-11
#: Forces at the tips of the steps, over that of first slip
FORCES = PAIR.slip_force * np.array([0.9, 2.0, 0.2, -2.0, 2.0])


def measure(workspace):
    history = workspace.run("slipping_pair", slipping_pair(WIRE, PAIR, ELEMENTS, FORCES, ELASTIC_SLIP)).history
    tip = -(history[f"U3 node {1 + ELEMENTS}"] + history[f"U3 node {10001 + ELEMENTS}"]) / 2
    last = [np.flatnonzero(history["step"] == step)[-1] for step in range(2, len(FORCES) + 2)]
    return {
        "slipping_pair.path": [float(tip[row]) for row in last],
        # from one reversal at twice the force of first slip to the next one
        "slipping_pair.loss": float(history["ALLFD"][last[4]] - history["ALLFD"][last[1]]),
        "figure": {"tip": tip.tolist()},
    }


def draw(values, path):
    with figures.panels(path, columns=1) as axes:
        way = np.concatenate([np.linspace(a, b, 50) for a, b in zip([0, *FORCES[:-1]], FORCES, strict=True)])
        axes.plot(1e3 * np.array(PAIR.path(way)), 1e3 * way, label="exact", **figures.REFERENCE)
        axes.plot(
            1e3 * np.array(values["slipping_pair.path"]),
            1e3 * FORCES,
            **figures.STYLES["B33"],
            linestyle="none",
            label="litz",
        )
        axes.set(xlabel="deflection of the tip [mm]", ylabel="force [mN]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["slipping_pair"]))
