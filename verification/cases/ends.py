"""Wires that touch with their round ends: on the side of another wire, on its end, and in a lap that ends between nodes.

Source: H. Hertz (1882), K. L. Johnson, Contact Mechanics (1985), section 4.2: a sphere on a cylinder, and two spheres; R. Holm,
Electric Contacts (1967), sections 3 and 4; in references/hertz.py. The lap: force goes with length, beside half of
the contact of either round end (theory, 10.18b).
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.line_decks import FIRST, SECOND, material, touching
from verification.references.hertz import effective_modulus, end_on_wire
from verification.references.parallel_wires import ParallelWires, PressedWire

COPPER = PressedWire(0.5e-3, 120e9, 0.34, 1 / 5.88e7)
STEEL = PressedWire(0.3e-3, 200e9, 0.28, 1.4e-7)
OVERLAP = 1e-7
#: Between the axes of the two wires [degrees]
ANGLES = (90, 60, 30)
#: Lengths of the lap [m]
LAPS = (6e-3, 5.9e-3, 5.83e-3, 5.77e-3)


def properties():
    """Of the wire that ends and of the other one, as the references want them."""
    wires = (STEEL, COPPER)
    return {
        "radius": [wire.radius for wire in wires],
        "modulus": effective_modulus([wire.young for wire in wires], [wire.poisson for wire in wires]),
        "resistivity": [wire.resistivity for wire in wires],
    }


def exact(spot_of):
    """Force [N] and resistance [ohm] with the overlap of the cases."""
    force = (OVERLAP / spot_of(1.0, **properties()).approach) ** 1.5
    return force, spot_of(force, **properties()).resistance


def force_of_round_ends():
    """Half of the contacts of the hemispheres of both wires, each on the other wire [N]."""
    turned = {key: value[::-1] if isinstance(value, list) else value for key, value in properties().items()}
    return sum(float((OVERLAP / end_on_wire(1.0, **each).approach) ** 1.5) / 2 for each in (properties(), turned))


def pressed(lower, upper, direction):
    """A steel wire above a copper wire, all nodes of both are led: moved by the overlap in a direction."""
    moves = "\n".join(f" UPPER, {d}, {d}, {OVERLAP * part:.17g}" for d, part in enumerate(direction, start=1))
    return join(
        heading("A wire touches another one with its end", "Model   all nodes are led"),
        chain(lower, "B33", "LOWER", FIRST),
        chain(upper, "B33", "UPPER", SECOND),
        "*NSET, NSET=PLUS\n LOWER\n*NSET, NSET=MINUS\n UPPER",
        material("ONE", COPPER, "LOWER"),
        material("OTHER", STEEL, "UPPER"),
        touching(("LOWER", "UPPER"), spot="HERTZ, VOLTAGE=LINEAR"),
        "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 4, 6",
        step(
            f"*BOUNDARY\n{moves}",
            "*BOUNDARY\n PLUS, 9, 9, 1.\n MINUS, 9, 9, 0.",
            "*ELECTRODE PRINT\n PLUS, MINUS",
        ),
    )


def measured(workspace, name, text):
    """Force [N] and resistance [ohm] of the one contact of a deck."""
    contacts = workspace.run(name, text).contacts_at(-1)
    return float(contacts["force"].sum()), 1 / float((1 / contacts["resistance"]).sum())


def on_the_side(workspace, degrees):
    """The steel wire leads away from its tip at an angle to the copper wire, and out of the plane of both."""
    lean = np.radians(degrees)
    away = np.array([np.cos(lean), 0.2, np.sin(lean)])
    tip = np.array([0.3e-3, 0, COPPER.radius + STEEL.radius])
    upper = tip + np.outer(np.linspace(0, 12e-3, 7), away / np.linalg.norm(away))
    lower = np.linspace((-0.01, 0, 0), (0.01, 0, 0), 10)
    return measured(workspace, f"end_{degrees}", pressed(lower, upper, (0, 0, -1)))


def on_the_end(workspace):
    """The tips of both wires meet, with the normal at 53 degrees to one of them."""
    normal = np.array([0.6, 0, 0.8])
    lower = np.outer(np.linspace(0, 12e-3, 7), [-0.9, 0.2, -0.4])
    upper = (COPPER.radius + STEEL.radius) * normal + np.outer(np.linspace(0, 12e-3, 7), [0.3, 0.1, 0.95])
    return measured(workspace, "end_on_end", pressed(lower, upper, -normal))


def force_of_lap(workspace, lap):
    """Two wires side by side, one of which begins where the other one still goes on for the length of the lap."""
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 14)
    upper = np.linspace((-lap, 0, COPPER.radius + STEEL.radius), (0.02 - lap, 0, COPPER.radius + STEEL.radius), 18)
    return measured(workspace, f"lap_{round(1e6 * lap)}", pressed(lower, upper, (0, 0, -1)))[0]


def measure(workspace):
    side = [on_the_side(workspace, degrees) for degrees in ANGLES]
    end = on_the_end(workspace)
    laps = np.array([force_of_lap(workspace, lap) for lap in LAPS])
    per_length = ParallelWires(STEEL, COPPER).force(OVERLAP)
    return {
        "ends.side.force": [force for force, _ in side],
        "ends.side.resistance": [resistance for _, resistance in side],
        "ends.end.force": end[0],
        "ends.end.resistance": end[1],
        "ends.lap": ((laps[0] - laps[1:]) / (LAPS[0] - np.array(LAPS[1:])) / per_length).tolist(),
        "ends.lap.ends": float(laps[0] - per_length * LAPS[0]),
        "figure": {"angles": ANGLES, "force": [force for force, _ in side]},
    }


def draw(values, path):
    with figures.panels(path) as (force, lap):
        force.axhline(exact(end_on_wire)[0], color="#222222", label="Hertz, sphere on cylinder")
        force.plot(values["figure"]["angles"], values["figure"]["force"], "o", label="litz")
        force.set(xlabel="angle of the wire that ends [degrees]", ylabel="force [N]", ylim=(0, None))
        force.legend()
        lap.plot([1e3 * length for length in LAPS[1:]], values["ends.lap"], "o")
        lap.set(
            xlabel="length of the lap [mm]", ylabel="force of what is added, over that of a line", ylim=(0.99, 1.01)
        )


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["ends"]))
