"""Two wires pressed side by side: force and conductance per length, and lap and hairpin joints.

Source: K. L. Johnson, Contact Mechanics (1985), sections 4.2(c) and 5.6, and the potential of a disc, in
references/parallel_wires.py; the transmission line of W. Thomson, Proc. R. Soc. 7 (1855) 382-399, in
references/line_joints.py.
"""

import math

import numpy as np

from verification import figures
from verification.line_decks import pressed_pair, uniform_spot
from verification.numerics import extrapolate
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires, PressedWire

COPPER = PressedWire(0.5e-3, 120e9, 0.34, 1 / 5.88e7)
STEEL = PressedWire(0.3e-3, 200e9, 0.28, 1.4e-7)
FILM, LENGTH, OVERLAP = 1e-12, 20e-3, 2e-7
#: Conductances per length of the joints [S/m]
CONDUCTANCES = (1e2, 1e4, 1e6)
RESISTANCE = COPPER.resistivity / (math.pi * COPPER.radius**2)
PAIRS = {
    "equal": ParallelWires(COPPER, COPPER),
    "unequal": ParallelWires(COPPER, STEEL),
    "film": ParallelWires(COPPER, STEEL, FILM),
}


def spot(pair):
    """Law of the spots without the resistance of the wires from the nodes, which are all electrodes."""
    return f"FILM, VOLTAGE=LINEAR\n {pair.film:.17g}" if pair.film else "HERTZ, VOLTAGE=LINEAR"


def pressed(workspace, name):
    """Force [N/m] and conductance [S/m] per length of a pair whose nodes do not match."""
    history = workspace.run(
        name, pressed_pair(PAIRS[name], [OVERLAP], LENGTH, 8, elements_2=11, spot=spot(PAIRS[name]))
    ).history
    return [-history["RF3 sum UPPER"][-1] / LENGTH, 1 / (history["resistance PLUS to MINUS"][-1] * LENGTH)]


def joint(workspace, kind, conductance, elements):
    """Resistance of a joint of uniform conductance."""
    text = pressed_pair(PAIRS["equal"], [OVERLAP], LENGTH, elements, spot=uniform_spot(conductance), potentials=kind)
    return float(workspace.run(f"{kind}_{conductance:.0e}_{elements}", text).history["resistance PLUS to MINUS"][-1])


def measure(workspace):
    values = {}
    for name in PAIRS:
        force, conductance = pressed(workspace, name)
        values |= {f"line_joints.{name}.force": force, f"line_joints.{name}.conductance": conductance}
    if workspace.quick:
        return values | {"figure": {}}
    joints = {
        kind: [[joint(workspace, kind, g, n) for n in (40, 120)] for g in CONDUCTANCES] for kind in ("lap", "hairpin")
    }
    for kind, found in joints.items():
        values[f"line_joints.{kind}"] = [extrapolate(coarse, fine, 2) for coarse, fine in found]
    return values | {"figure": joints}


def draw(values, path):
    if not values["figure"]:
        return
    with figures.panels(path) as (resistance, current):
        g = np.geomspace(1e2, 1e6, 100)
        for kind, style in (("lap", "-"), ("hairpin", "--")):
            line = [getattr(LineJoint(LENGTH, value, RESISTANCE, RESISTANCE), kind)() for value in g]
            resistance.loglog(g, line, style, color="#222222", label=kind)
            resistance.loglog(CONDUCTANCES, values[f"line_joints.{kind}"], **figures.STYLES["B33"], linestyle="none")
        resistance.set(xlabel="conductance [S/m]", ylabel="resistance [ohm]")
        resistance.legend()
        x = np.linspace(0, LENGTH, 200)
        for value in CONDUCTANCES:
            share = LineJoint(LENGTH, value, RESISTANCE, RESISTANCE).lap_current(x)
            current.plot(1e3 * x, share, label=f"{value:.0e} S/m")
        current.set(xlabel="x [mm]", ylabel="current of the first wire, lap joint")
        current.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["line_joints"]))
