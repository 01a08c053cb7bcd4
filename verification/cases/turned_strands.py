"""A strand of a core and six wires, and three wires without a core, pulled and then turned both ways.

Source: G. A. Costello, Theory of Wire Rope, 2nd ed. (1997), for rods that stay helices; energy of uniform helices and of the
lines along which they touch, in references/helical_rods.py.
"""

import math

import numpy as np

from verification import figures
from verification.cases.twisted_pair import approach_of, end_loads
from verification.line_decks import FIRST, SECOND, pulled_strand
from verification.references.helical_rods import Bundle, Rod, Strand

CORE, WIRE = Rod(0.52e-3, 120e9, 0.34), Rod(0.5e-3, 120e9, 0.34)
STRAND = Strand(CORE, WIRE, 6, 45e-3)
TRIANGLE = Bundle(WIRE, 3, 30e-3)
STRAIN, TURN = 5e-4, 0.04
#: Pulled, then turned with the lay and against it
TURNS = (0.0, TURN, -TURN)
LENGTH, ELEMENTS = 30e-3, 60


def strand_states():
    """The approach of core and wire is that of the mean of two forces per length, of the core and of a wire."""
    approach = approach_of(CORE, WIRE)
    share = (1 + STRAND.free.height) / 2
    return [STRAND.state(STRAIN, turn / LENGTH, lambda force: approach(force / share)) for turn in TURNS]


def triangle_states():
    return [TRIANGLE.state(STRAIN, turn / LENGTH, approach_of(WIRE, WIRE)) for turn in TURNS]


def loads_of(workspace, name, strand, states):
    """Force, moment, and line force in the middle half, at the end of each step."""
    results = workspace.run(name, pulled_strand(strand, states, LENGTH, ELEMENTS, increments=4))
    history = results.history
    starts = {FIRST + ELEMENTS: (0.0, 0.0)} if strand.core else {}
    for number in range(strand.count):
        angle = 2 * math.pi * (LENGTH / strand.pitch + number / strand.count)
        starts[SECOND + 1000 * number + ELEMENTS] = (
            strand.free.radius * math.cos(angle),
            strand.free.radius * math.sin(angle),
        )
    found = []
    for time in range(1, len(states) + 1):
        row = int(np.flatnonzero(np.isclose(history["time"], time))[0])
        contacts = results.contacts_at(row)
        # from the middle of an element on, where no place is
        low = LENGTH / 4 + LENGTH / (4 * ELEMENTS)
        middle = (contacts["point_1_z"] >= low) & (contacts["point_1_z"] < low + LENGTH / 2)
        line = contacts["force"][middle].sum() / strand.count / (LENGTH / 2) * strand.free.height
        found.append([*end_loads({key: history[key][: row + 1] for key in history}, starts), float(line)])
    return np.transpose(found).tolist()


def measure(workspace):
    values = {}
    for name, strand, states in (("strand", STRAND, strand_states()), ("triangle", TRIANGLE, triangle_states())):
        found = loads_of(workspace, name, strand, states)
        for what, value in zip(("force", "moment", "line_force"), found, strict=True):
            values[f"turned_strands.{name}.{what}"] = value
    return values | {"figure": {}}


def draw(values, path):
    with figures.panels(path) as panels:
        for panel, name, states in zip(
            panels, ("strand", "triangle"), (strand_states(), triangle_states()), strict=True
        ):
            panel.plot([0, 1, 2], [state.force for state in states], label="exact", **figures.REFERENCE)
            panel.plot(
                [0, 1, 2],
                values[f"turned_strands.{name}.force"],
                **figures.STYLES["B33"],
                linestyle="none",
                label="litz",
            )
            panel.set_xticks(
                [0, 1, 2], ["pulled", f"{math.degrees(TURN):.1f} degrees", f"{math.degrees(-TURN):.1f} degrees"]
            )
            panel.set(title=name, ylabel="axial force [N]")
            panel.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["turned_strands"]))
