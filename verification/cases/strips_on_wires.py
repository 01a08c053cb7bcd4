"""Currents of several strips on one wire: a stack of three wires, and six wires around a core, all straight.

Source: the potential of a disc with several arcs on its rim, in references/strips_on_discs.py; width of the strips and force
per length in references/parallel_wires.py.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.line_decks import along_x, material, touching
from verification.references.parallel_wires import ParallelWires, PressedWire
from verification.references.strips_on_discs import from_arc_to_arc, from_each_of

COPPER = PressedWire(0.5e-3, 120e9, 0.34, 1 / 5.88e7)
CORE = PressedWire(0.55e-3, 120e9, 0.34, 1 / 5.88e7)
LENGTH, AROUND, OVERLAP = 10e-3, 6, 2e-7
#: Elements of the wires, so that nodes do not match
ELEMENTS = (8, 11, 9)


def arcs(pair):
    """Half angles of the strip on both wires of a pair."""
    b = pair.half_width(pair.force(OVERLAP))
    return b / pair.first.radius, b / pair.second.radius


def stack_reference():
    """Conductance per length from the lowest to the highest of three wires [S/m]."""
    beta, _ = arcs(ParallelWires(COPPER, COPPER))
    outer = from_each_of(1, COPPER.resistivity, beta)
    return 1 / (from_arc_to_arc(COPPER.resistivity, beta) + 2 * outer)


def core_reference():
    """Conductance per length from a core to each of the wires around it [S/m]."""
    of_core, of_wire = arcs(ParallelWires(CORE, COPPER))
    return 1 / (from_each_of(AROUND, CORE.resistivity, of_core) + from_each_of(1, COPPER.resistivity, of_wire))


def deck(title, wires, places, pairs, plus, minus):
    """Straight wires at places in the plane across them, which overlap as interference fits; all nodes are held."""
    names = [f"W{i}" for i in range(len(wires))]
    chains = [
        chain(along_x(LENGTH, ELEMENTS[i % 3]) + np.array([0.0, *place]), "B33", name, 1000 * i + 1)
        for i, (name, place) in enumerate(zip(names, places, strict=True))
    ]
    contact = touching(*((f"W{a}", f"W{b}") for a, b in pairs), spot="HERTZ, VOLTAGE=LINEAR")
    electrodes = [(f"W{i}", volts) for numbers, volts in ((plus, 1.0), (minus, 0.0)) for i in numbers]
    return join(
        heading(title),
        *chains,
        *(material(name, each, name) for name, each in zip(names, wires, strict=True)),
        contact.replace("INTERACTION=TOUCH\n", "INTERACTION=TOUCH, INTERFERENCE FIT\n"),
        "*NSET, NSET=PLUS\n " + ", ".join(f"W{i}" for i in plus),
        "*NSET, NSET=MINUS\n " + ", ".join(f"W{i}" for i in minus),
        "*BOUNDARY\n" + "\n".join(f" {name}, ENCASTRE" for name in names),
        step(
            "*BOUNDARY\n" + "\n".join(f" {name}, 9, 9, {volts}" for name, volts in electrodes),
            "*ELECTRODE PRINT\n PLUS, MINUS",
        ),
    )


def conductance(workspace, name, text):
    """Per length [S/m]."""
    return 1 / (workspace.run(name, text).history["resistance PLUS to MINUS"][-1] * LENGTH)


def measure(workspace):
    height = 2 * COPPER.radius - OVERLAP
    stack = deck(
        "Three wires on each other", [COPPER] * 3, [(0, i * height) for i in range(3)], [(0, 1), (1, 2)], [0], [2]
    )
    out = CORE.radius + COPPER.radius - OVERLAP
    places = [(out * math.cos(a), out * math.sin(a)) for a in 2 * np.pi * np.arange(AROUND) / AROUND]
    ring = range(1, AROUND + 1)
    core = deck(
        "Six wires around a core", [CORE] + [COPPER] * AROUND, [(0, 0), *places], [(0, i) for i in ring], [0], ring
    )
    found = {
        "stack": conductance(workspace, "stack", stack),
        "core": conductance(workspace, "core", core) / AROUND,
    }
    return {f"strips_on_wires.{name}": value for name, value in found.items()} | {"figure": found}


def draw(values, path):
    found = values["figure"]
    pairs = ParallelWires(COPPER, COPPER), ParallelWires(CORE, COPPER)
    # through a stack the current passes two strips
    alone = [pair.conductance(pair.force(OVERLAP)) / strips for pair, strips in zip(pairs, (2, 1), strict=True)]
    exact = np.array([stack_reference(), core_reference()]) / alone
    measured = np.array([found["stack"], found["core"]]) / alone
    with figures.panels(path, columns=1) as axes:
        axes.plot([0, 1], exact, "_", color="#222222", markersize=30, label="exact")
        axes.plot([0, 1], measured, **figures.STYLES["B33"], linestyle="none")
        axes.set(
            xlim=(-0.5, 1.5),
            xticks=[0, 1],
            xticklabels=["stack", "core"],
            ylabel="conductance over that of strips alone",
        )
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["strips_on_wires"]))
