"""Wires that a plate earths, and that a plate cools: transfer length, fin, and warming by a current.

Source: the transmission line `V'' = r' g' V` of a conductor with leakage, and the fin `T'' = h'/(lambda A) (T - T0)`, both with a
free end; F. P. Incropera, D. P. DeWitt, Fundamentals of Heat and Mass Transfer, section 3.6 (adiabatic tip).
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join
from verification.surface_decks import boundary

RADIUS, LENGTH, ELEMENTS = 0.5e-3, 0.1, 80
AREA = math.pi * RADIUS**2
SIGMA, LAMBDA = 5e7, 400.0
#: Conductances per length [S/m], [W/(m K)], force per length [N/m] and current [A]
ELECTRIC, HEAT, FORCE, CURRENT = 1e4, 1.5, 1e3, 20.0
X = np.linspace(0, LENGTH, ELEMENTS + 1)


def measure(workspace):
    earthed = workspace.run("earthed", deck("CURRENT", [(1, 9, 9, 1.0), (99, 9, 9, 0.0)]))
    cooled = workspace.run("cooled", deck("HEAT", [(1, 9, 9, 0.0), (1, 11, 11, 1.0), (99, 11, 11, 0.0)]))
    fed = f"*CECURRENT\n 1, 9, {CURRENT}"
    warmed = workspace.run("warmed", deck("HEAT", [(ELEMENTS + 1, 9, 9, 0.0), (99, 11, 11, 0.0)], fed))
    potential = earthed.field("potential")[:-1]
    temperature = cooled.field("temperature")[:-1]
    return {
        "wires_on_plates.potential": potential[[20, 40, 80]].tolist(),
        "wires_on_plates.current": float(-earthed.field("reaction_current")[-1]),
        "wires_on_plates.fin": temperature[[20, 40, 80]].tolist(),
        "wires_on_plates.heat": float(-cooled.field("reaction_heat")[-1]),
        "wires_on_plates.warmed": float(warmed.field("temperature")[:-1].mean()),
        "figure": {"potential": potential.tolist(), "temperature": temperature.tolist()},
    }


def draw(values, path):
    with figures.panels(path, columns=2) as (left, right):
        for axes, name, length in (
            (left, "potential", 1 / math.sqrt(ELECTRIC / (SIGMA * AREA))),
            (right, "temperature", math.sqrt(LAMBDA * AREA / HEAT)),
        ):
            axes.plot(
                1e3 * X, np.cosh((LENGTH - X) / length) / math.cosh(LENGTH / length), label="exact", **figures.REFERENCE
            )
            axes.plot(
                1e3 * X[::4], values["figure"][name][::4], **figures.STYLES["B33"], linestyle="none", label="litz"
            )
            axes.set(xlabel="place [mm]", ylabel=f"{name} over that of the first end")
            axes.legend()


def deck(law, values, loads=""):
    """A straight wire is pressed evenly on a plate; current or heat passes."""
    laws = {
        "CURRENT": f"*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n {1 / ELECTRIC:.17g}",
        "HEAT": f"*GAP CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n {HEAT:.17g}",
    }
    procedure = "*STATIC" if law == "CURRENT" else "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, ELECTRICAL"
    return join(
        heading("A wire on a plate", "the plate has one potential and one temperature, at its reference node"),
        chain(np.column_stack([X, 0 * X, 0 * X + RADIUS]), "B33", "WIRE"),
        "*NODE\n 99, 0, 0, -0.01",
        f"*MATERIAL, NAME=M\n*ELASTIC\n 1e11, 0.3\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n*CONDUCTIVITY\n {LAMBDA}",
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=M, SECTION=CIRC\n {RADIUS}",
        "*RIGID SURFACE, NAME=PLATE, TYPE=PLANE, REF NODE=99\n 0, 0, 0, 0, 0, 1",
        f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n , 1e9\n{laws[law]}",
        "*CONTACT PAIR, INTERACTION=TOUCH\n WIRE, PLATE",
        boundary([("WIRE", 1, 2, 0.0), ("WIRE", 4, 6, 0.0), (99, 1, 6, 0.0)]),
        f"*STEP\n{procedure}",
        boundary([("WIRE", 3, 3, -FORCE / 1e9), *values]),
        loads,
        "*END STEP",
    )


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["wires_on_plates"]))
