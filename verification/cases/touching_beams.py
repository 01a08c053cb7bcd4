"""Two beams side by side: cantilevers that touch at a tip, three-point bending, and a load that two clamped beams share.

Source: S. Timoshenko, Strength of Materials, part II (1956), leaf springs; L. M. Keer, J. Dundurs, K. C. Tsai, J. Appl. Mech.
39 (1972) 1115-1120, receding contact; M. Hetenyi, Beams on Elastic Foundation (1946); in references/touching_beams.py.
"""

import numpy as np

from verification import figures
from verification.line_decks import cantilevers, shared_load, three_point_bending
from verification.references.helical_rods import Rod
from verification.references.touching_beams import Cantilevers, SharedLoad, ThreePointBending

LOWER, UPPER = Rod(0.5e-3, 200e9, 0.3), Rod(0.5e-3, 100e9, 0.3)
TIPS = Cantilevers(0.075, 0.05, UPPER.ei, LOWER.ei, 2e-3)
BENDING = ThreePointBending(0.1, UPPER.ei, LOWER.ei, 5e-3)
SHARED = SharedLoad(0.1, UPPER.ei, LOWER.ei, 0.5, 1e9)


def measure(workspace):
    history = workspace.run("cantilevers", cantilevers(LOWER, UPPER, TIPS, (20, 31))).history
    values = {
        "touching_beams.tip": [-float(history[f"U3 node {node}"][-1]) for node in (21, 10032)],
        "touching_beams.tip_force": float(history["RF3 node 1"][-1]),
    }
    history = workspace.run("three_points", three_point_bending(LOWER, UPPER, BENDING, (20, 27))).history
    values["touching_beams.middle"] = [-float(history["RF3 node 10001"][-1]), -float(history["U3 node 1"][-1])]
    if workspace.quick:
        return values | {"figure": []}
    results = workspace.run("shared", shared_load(LOWER, UPPER, SHARED, (60, 83)))
    values["touching_beams.reaction"] = float(results.history["RF3 node 1"][-1])
    contacts = results.contacts_at(-1)
    return values | {"figure": [contacts["point_1_x"].tolist(), contacts["force"].tolist()]}


def draw(values, path):
    if not values["figure"]:
        return
    with figures.panels(path) as (gap, pressure):
        x = np.linspace(0, TIPS.support, 100)
        gap.plot(1e3 * x, 1e6 * TIPS.gap(x), label="gap of the cantilevers", **figures.REFERENCE)
        gap.set(xlabel="x [mm]", ylabel="gap [micrometres]")
        x = np.linspace(0, SHARED.span, 1000)
        pressure.plot(1e3 * x, SHARED.pressure(x), label="exact", **figures.REFERENCE)
        place, force = (np.array(column) for column in values["figure"])
        edges = np.linspace(0, SHARED.span, 21)
        mean = np.histogram(place, edges, weights=force)[0] / np.diff(edges)
        pressure.plot(1e3 * (edges[1:] + edges[:-1]) / 2, mean, **figures.STYLES["B33"], linestyle="none", label="litz")
        pressure.set(xlabel="x [mm]", ylabel="line force [N/m]")
        pressure.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["touching_beams"]))
