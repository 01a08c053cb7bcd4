"""Residuals of the coupled problem in a run, iteration by iteration: with the whole matrix they fall quadratically.

Source: D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact: monolithic
Newton method with K = [K_mm 0; K_me1 + K_me2 + K_me3, K_ee], K_mm of two terms, eps dg dg and eps g ddg. L. V.
Kantorovich (1948): with the exact matrix the residuals fall quadratically; with any block of it missing or wrong they fall
linearly. Two clamped wires cross at 60 degrees inside an element of each, with currents along both; one step of load
presses them together with fourteen times the force and drags one along the other. COUPLING=MONOLITHIC takes
displacements and voltages from the same linear equations.
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.wire_decks import Wire, interaction, section

WIRE = Wire(radius=0.5e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
LENGTH, N, ANGLE = 0.05, 5, np.pi / 3
#: Places of the crossing along both wires, inside their third elements
AT = (0.52, 0.46)
#: Forces at both ends of the third element of the upper wire before the step and after it [N]
LOADS = ((0.0, 0.0, -0.4), (2.5, -1.5, -6.0))
#: Potentials of the ends of the wires [V]
ENDS = {1: 2e-3, N + 1: 0.5e-3, 101: 0.0, 101 + N: 1.2e-3}
LAWS = {
    "paper": interaction(("LOWER", "UPPER"), penalty=1e6, spot="PAPER, VOLTAGE=LINEAR"),
    "hertz": interaction(("LOWER", "UPPER"), spot="HERTZ"),
}


def deck(law):
    """Two steps of one increment; the first one closes the contact."""
    directions = np.array([[1.0, 0.0, 0.0], [np.cos(ANGLE), np.sin(ANGLE), 0.0]])
    stations = np.linspace(0.0, LENGTH, N + 1)
    lower, upper = (np.outer(stations - at * LENGTH, d) for at, d in zip(AT, directions, strict=True))
    upper[:, 2] += 2 * WIRE.radius - 1e-7
    loads = [
        "*CLOAD\n"
        + "\n".join(f" {node}, {i + 1}, {value}" for node in (103, 104) for i, value in enumerate(load) if value)
        for load in LOADS
    ]
    potentials = "*BOUNDARY\n" + "\n".join(f" {node}, 9, 9, {value}" for node, value in ENDS.items())
    return join(
        heading(
            "Two clamped wires that carry currents are pressed together and dragged along each other",
            f"Model   copper, radius 0.5 mm, length 50 mm, {N} B33 each",
            "Source  quadratic convergence of Newton's method",
        ),
        chain(lower, "B33", "LOWER"),
        chain(upper, "B33", "UPPER", 101),
        section(WIRE, "COPPER", "LOWER", "UPPER", conducting=True),
        LAWS[law],
        "*BOUNDARY\n" + "\n".join(f" {node}, ENCASTRE" for node in ENDS),
        step(potentials, loads[0], controls="*SOLVER, NAME=UMFPACK, COUPLING=MONOLITHIC"),
        step(loads[1]),
    )


def order(residuals):
    """Order of convergence of the last three residuals."""
    first, second, third = np.log(residuals[-3:])
    return float((third - second) / (second - first))


def measure(workspace):
    residuals = {}
    for law in LAWS:
        rows = workspace.run(law, deck(law)).convergence
        residuals[law] = {name: np.asarray(rows[name])[rows["step"] == 2] for name in ("force", "current")}
    return {
        "monolithic.force_order": order(residuals["paper"]["force"]),
        "monolithic.current_order": [order(found["current"]) for found in residuals.values()],
        "figure": residuals,
    }


def draw(values, path):
    with figures.panels(path, height=3.2) as panels:
        for panel, (name, unit) in zip(panels, (("force", "N"), ("current", "A")), strict=True):
            for law, style in (("paper", "ko-"), ("hertz", "s--")):
                found = values["figure"][law][name]
                panel.semilogy(range(1, len(found)), found[1:], style, label=f"LAW={law.upper()}")
            panel.set(xlabel="iteration", ylabel=f"largest {name} residual [{unit}]", xticks=range(1, len(found)))
            panel.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["monolithic"]))
