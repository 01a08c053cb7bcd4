"""Decks of two wires that cross and conduct current and heat from spot to ends."""

import numpy as np

RADIUS, HALF, LAMBDA, ROOM, AMPERES = 0.5e-3, 0.01, 390.0, 300.0, 90.0
METAL = "*GAP CONDUCTANCE, LAW=METAL, LORENZ=2.44e-8"


def crossing(elements, sigma, increments, *, load, procedure="", place=0.0, stored="", law=METAL, spot="HERTZ"):
    """The second wire crosses with its middle, at `place` of the first one; all ends are held at room temperature, and the
    first one of the first wire at the potential 0. `sigma` are lines of *ELECTRICAL CONDUCTIVITY."""
    text = ""
    for first, name in ((1, "A"), (1001, "B")):
        places = np.linspace(-HALF, HALF, elements + 1)
        at = [(s, 0.0, 0.0) if name == "A" else (place, s, 2 * RADIUS - 4e-7) for s in places]
        nodes = "\n".join(f"{first + i}, {x:.17g}, {y:.17g}, {z:.17g}" for i, (x, y, z) in enumerate(at))
        members = "\n".join(f"{first + i}, {first + i}, {first + i + 1}" for i in range(elements))
        text += f"*NODE, NSET=ALL\n{nodes}\n*ELEMENT, TYPE=B33, ELSET={name}\n{members}\n"
    return f"""\
*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0
{text}*MATERIAL, NAME=COPPER
*ELASTIC
1.2e11, 0.3
*CONDUCTIVITY
{LAMBDA}
*ELECTRICAL CONDUCTIVITY
{sigma}
{stored}*BEAM SECTION, ELSET=A, MATERIAL=COPPER, SECTION=CIRC
{RADIUS}
*BEAM SECTION, ELSET=B, MATERIAL=COPPER, SECTION=CIRC
{RADIUS}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*GAP ELECTRICAL CONDUCTANCE, LAW={spot}
{law}
*CONTACT PAIR, INTERACTION=TOUCH
A, B
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {ROOM}
*BOUNDARY
ALL, ENCASTRE
*NSET, NSET=ENDS
1, {elements + 1}, 1001, {elements + 1001}
*STEP, INC=10000
*COUPLED THERMAL-ELECTRICAL{procedure}
{increments}
*BOUNDARY
ENDS, 11, 11, {ROOM}
1, 9
{load}*END STEP
"""
