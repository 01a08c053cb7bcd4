"""A run of crossed wires that yield: resistance over force through two loops, with a spring before the spot.

Source: `inputs/23_dented_wires.inp`, where a beam on two supports that move presses a spot: 48 E I/L^3 in series with the
law of loading, dent and unloading (references/yielded_spot.py: K. L. Johnson, Contact Mechanics (1985), R. L. Jackson, I.
Green (2005), and flat punches taken off a half-space, by quadrature). What the way up and the way back enclose is what
yielding has dissipated, `ALLPD`.
"""

import math
from pathlib import Path

import numpy as np

from verification import figures
from verification.references.yielded_spot import YieldedSpot

DECK = Path(__file__).resolve().parents[2] / "inputs" / "23_dented_wires.inp"
SPOT = YieldedSpot(radius=5e-4, young=120e9, poisson=0.34, yield_stress=200e6, hardness=560e6)
STIFFNESS = 48 * SPOT.young * math.pi * SPOT.radius**4 / 4 / 0.02**3
#: rho1 + rho2 [ohm m]
RESISTIVITY = 2 / 58.8e6
#: Where the supports are at the ends of the steps, as the deck moves them [m]
CORNERS = {0: 0.0, 1: 20e-6, 2: 0.0, 3: 40e-6, 4: 0.0}
#: Times on the four ways: force and resistance are compared there
TIMES = (0.5, 1.0, 1.5, 1.9, 2.3, 2.5, 2.8, 3.0, 3.5, 3.9)


def position(time):
    return float(np.interp(time, list(CORNERS), list(CORNERS.values())))


def history(times):
    """Force and resistance at each time; the largest force is that of the corners before."""
    found = []
    for time in times:
        tops = [position(corner) for corner in (1, 3) if corner < time]
        largest = max((SPOT.behind_spring(STIFFNESS, top, 0.0)[0] for top in tops), default=0.0)
        force, radius = SPOT.behind_spring(STIFFNESS, position(time), largest)
        found.append((force, RESISTIVITY / (4 * radius)))
    return np.array(found)


def measure(workspace):
    results = workspace.run("dented_wires", DECK.read_text(encoding="utf-8"))
    ledger = [results.contacts_at(int(np.argmin(np.abs(results.times - when)))) for when in TIMES]
    return {
        "yielded_wires.force": [float(one["force"][0]) for one in ledger],
        "yielded_wires.resistance": [float(one["resistance"][0]) for one in ledger],
        "yielded_wires.dent": [float(ledger[TIMES.index(when)]["dent"][0]) for when in (1.9, 3.9)],
        "yielded_wires.dissipation": float(results.history["ALLPD"][-1]),
        "figure": {name: results.contacts[name].tolist() for name in ("force", "resistance")},
    }


def draw(values, path):
    found = values["figure"]
    ways = [history(np.linspace(k + 0.05, k + 0.95, 13)) for k in range(4)]
    with figures.panels(path, columns=1, height=3.2) as axes:
        for k, (force, resistance) in enumerate(way.T for way in ways):
            axes.loglog(force, 1e3 * resistance, color="#777777", label="spring and spot" if k == 0 else None)
        axes.loglog(
            found["force"], 1e3 * np.array(found["resistance"]), "o", markersize=4, color="#c4451c", label="litz"
        )
        axes.set(xlabel="contact force [N]", ylabel="contact resistance [mohm]")
        axes.legend(fontsize=8)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["yielded_wires"]))
