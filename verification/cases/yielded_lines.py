"""A run of wires side by side that yield: force and conductance per length up, back, and up again beyond.

Two parallel wires of different metals and radii are led to overlaps. Source: references/yielded_line.py, where the way
back is an integral over flat punches.
"""

import numpy as np

from verification import figures, line_decks
from verification.deck_text import chain, heading, join, step
from verification.references.parallel_wires import ParallelWires, PressedWire
from verification.references.yielded_line import YieldedLine

COPPER = PressedWire(1e-3, 120e9, 0.34, 1.7e-8)
BRASS = PressedWire(0.6e-3, 100e9, 0.35, 6.5e-8)
LINE = YieldedLine(ParallelWires(COPPER, BRASS), yield_stress=60e6)
LENGTH = 20e-3
#: Overlaps at the ends of the steps [m]
OVERLAPS = (2e-9, 0.5e-6, 1e-6, 0.9e-6, 0.8e-6, 0.95e-6, 1.5e-6, 1.35e-6)


def deck():
    height = COPPER.radius + BRASS.radius
    return join(
        heading("Parallel wires that yield, led to overlaps and back"),
        chain(line_decks.along_x(LENGTH, 8), "B33", "LOWER", line_decks.FIRST),
        chain(line_decks.along_x(LENGTH, 11, height), "B33", "UPPER", line_decks.SECOND),
        line_decks.material("COPPER", COPPER, "LOWER"),
        line_decks.material("BRASS", BRASS, "UPPER"),
        "*SURFACE INTERACTION, NAME=TOUCH",
        f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={LINE.yield_stress}",
        "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, VOLTAGE=LINEAR",
        "*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER",
        "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1, 2\n UPPER, 4, 6\n UPPER, 9",
        *(step(f"*BOUNDARY\n UPPER, 3, 3, {-overlap:.17g}\n LOWER, 9, 9, 1.") for overlap in OVERLAPS),
    )


def measure(workspace):
    results = workspace.run("yielded_lines", deck())
    contacts, found = results.contacts, []
    for number in range(1, len(OVERLAPS) + 1):
        last = contacts["increment"][contacts["step"] == number].max()
        here = (contacts["step"] == number) & (contacts["increment"] == last)
        middle = np.flatnonzero(here & (np.abs(contacts["point_1_x"] - LENGTH / 2) < LENGTH / 4))
        force, length = contacts["force"][middle], contacts["length"][middle]
        found.append((float(np.mean(force / length)), float(np.mean(1 / (contacts["resistance"][middle] * length)))))
    force, conductance = (list(values) for values in zip(*found, strict=True))
    return {
        "yielded_lines.force": force,
        "yielded_lines.conductance": conductance,
        "figure": (np.array(force), np.array(conductance)),
    }


def draw(values, path):
    """The way through force, overlap and conductance, numbered in the order of the steps."""
    force, conductance = values["figure"]
    overlap = 1e6 * np.array(OVERLAPS)
    with figures.panels(path) as axes:
        for panel, x, y, names in (
            (axes[0], overlap, force / 1e3, ("overlap / um", "force per length / (N/mm)")),
            (axes[1], force / 1e3, conductance / 1e6, ("force per length / (N/mm)", "conductance per length / (MS/m)")),
        ):
            panel.plot(x, y, marker="o", fillstyle="none")
            for number, at in enumerate(zip(x, y, strict=True), start=1):
                panel.annotate(str(number), at, textcoords="offset points", xytext=(5, -10))
            panel.set(xlabel=names[0], ylabel=names[1])


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["yielded_lines"]))
