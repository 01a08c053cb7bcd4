"""Small decks that several tests change in one place."""

import numpy as np

#: Two copper-like wires of 1 mm radius cross in the middle of their middle elements.
#: Placeholders: gap [m], behavior (card and data of the normal law), spot (card of the spot law), push [m],
#: static (data line), extra (cards of the step).
CROSSED = """\
*HEADING
crossed wires of a test
*UNITS, SYSTEM=SI
*NODE, NSET=LOWER
 1, -0.05, 0, 0
 2, -0.02, 0, 0
 3, -0.006, 0, 0
 4, 0.004, 0, 0
 5, 0.02, 0, 0
 6, 0.05, 0, 0
*NODE, NSET=UPPER
 11, 0, -0.05, {height}
 12, 0, -0.02, {height}
 13, 0, -0.005, {height}
 14, 0, 0.006, {height}
 15, 0, 0.02, {height}
 16, 0, 0.05, {height}
*NSET, NSET=LOWER_ENDS
 1, 6
*NSET, NSET=UPPER_ENDS
 11, 16
*ELEMENT, TYPE={element}, ELSET=LOWER
 1, 1, 2
 2, 2, 3
 3, 3, 4
 4, 4, 5
 5, 5, 6
*ELEMENT, TYPE={element}, ELSET=UPPER
 11, 11, 12
 12, 12, 13
 13, 13, 14
 14, 14, 15
 15, 15, 16
*ELSET, ELSET=WIRES
 LOWER, UPPER
*MATERIAL, NAME=COPPER
*ELASTIC
 120e9, 0.34
*ELECTRICAL CONDUCTIVITY
 58.823529411764706e6
*BEAM SECTION, ELSET=WIRES, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=SPOT
{behavior}
{spot}
*CONTACT PAIR, INTERACTION=SPOT{pair}
 LOWER, UPPER
*BOUNDARY
 LOWER_ENDS, 1, 6
*STEP, INC=200
*STATIC
 {static}
*BOUNDARY
 UPPER_ENDS, 1, 2
 UPPER_ENDS, 4, 6
 UPPER_ENDS, 3, 3, {push}
 1, 9, 9, 1e-3
 11, 9, 9, 0
{extra}
*END STEP
"""

DEFAULTS = {
    "height": "2e-3",
    "element": "B33",
    "behavior": "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ",
    "spot": "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ",
    "pair": "",
    "static": "1, 1, 1e-3, 1",
    "push": "-1e-4",
    "extra": "",
}


def crossed(**changes):
    """Text of the crossed wires, with some placeholders changed."""
    unknown = set(changes) - set(DEFAULTS)
    assert not unknown, f"no such placeholder: {unknown}"
    return CROSSED.format(**{**DEFAULTS, **changes})


#: Angle to the x-axis [degrees] and distance from the origin [mm] of three lower and three upper wires
MAT = (((-2.49, -11.58), (-2.44, -0.40), (1.41, 7.68)), ((89.58, -9.48), (88.71, 0.89), (87.01, 12.84)))


def thin_mat(push):
    """Two layers of slender wires (radius 0.05 mm, length 78 mm) that just touch; the upper one is lowered by `push` [m].

    Nine crossings of very different forces: some close and open again before the forces are found.
    """
    lines = ["*HEADING", "mat of slender wires", "*UNITS, SYSTEM=SI"]
    for layer, name in enumerate(("LOWER", "UPPER")):
        for i, (degrees, offset) in enumerate(MAT[layer]):
            angle, first = np.radians(degrees), 1000 * (3 * layer + i + 1)
            t, n = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
            lines.append(f"*NODE, NSET={name}")
            for k, s in enumerate(np.linspace(-0.039, 0.039, 12)):
                x, y = s * t + 1e-3 * offset * n
                lines.append(f" {first + k}, {x:.12g}, {y:.12g}, {1e-4 * layer}")
            lines.append(f"*NSET, NSET={name}_ENDS\n {first}, {first + 11}")
            lines.append(f"*ELEMENT, TYPE=B33, ELSET={name}")
            lines += [f" {first + k}, {first + k}, {first + k + 1}" for k in range(11)]
    return (
        "\n".join(lines)
        + f"""
*MATERIAL, NAME=COPPER
*ELASTIC
 120e9, 0.34
*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=CIRC
 5e-5
*BEAM SECTION, ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC
 5e-5
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 LOWER_ENDS, ENCASTRE
 UPPER_ENDS, 1, 2
 UPPER_ENDS, 4, 6
*STEP
*STATIC
 1., 1.
*BOUNDARY
 UPPER_ENDS, 3, 3, {-push}
*END STEP
"""
    )


MATERIAL = """\
*MATERIAL, NAME=STEEL
*ELASTIC
 200e9, 0.3
"""

CONDUCTOR = """\
*MATERIAL, NAME=COPPER
*ELASTIC
 120e9, 0.34
*ELECTRICAL CONDUCTIVITY
 5e7
"""


def wire(name, points, first=1, *, element="B31", closed=False, backwards=()):
    """Cards of a chain of elements through points; nodes and elements are numbered from `first`.

    A closed chain returns to its first node; the elements counted in `backwards` run against the chain.
    """
    nodes = [f" {first + i}, {x:.17g}, {y:.17g}, {z:.17g}" for i, (x, y, z) in enumerate(points)]
    elements = []
    for i in range(len(points) - (not closed)):
        ends = (first + i, first + (i + 1) % len(points))
        if i in backwards:
            ends = ends[::-1]
        elements.append(f" {first + i}, {ends[0]}, {ends[1]}")
    return "\n".join([f"*NODE, NSET={name}", *nodes, f"*ELEMENT, TYPE={element}, ELSET={name}", *elements, ""])


def pair_of_wires(first, second, supports, prescribed="", static="1., 1."):
    """Two steel wires A and B of 1 mm radius that may touch; supports of the model and prescribed values of its step."""
    return (
        f"{first}{second}{MATERIAL}*ELSET, ELSET=WIRES\n A, B\n"
        "*BEAM SECTION, ELSET=WIRES, MATERIAL=STEEL, SECTION=CIRC\n 1e-3\n"
        "*SURFACE INTERACTION, NAME=TOUCH\n*CONTACT PAIR, INTERACTION=TOUCH\n A, B\n"
        f"*BOUNDARY\n{supports}*STEP\n*STATIC\n {static}\n"
        + (f"*BOUNDARY\n{prescribed}" if prescribed else "")
        + "*END STEP\n"
    )


def straight(start, end, n):
    """Points at equal distances from start to end, for n elements."""
    return np.linspace(start, end, n + 1)


def cantilever(*steps, element="B31", static="1, 1, 1e-3, 1", n=10):
    """A steel wire of 100 mm along x, clamped at node 1; `steps` are the cards of each step."""
    model = wire("WIRE", straight((0, 0, 0), (0.1, 0, 0), n), element=element) + MATERIAL
    model += "*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC\n 1e-3\n*BOUNDARY\n 1, ENCASTRE\n"
    return model + "".join(f"*STEP, INC=500\n*STATIC\n {static}\n{cards}\n*END STEP\n" for cards in steps)


def grid(n, pitch=0.01):
    """n wires along x and n across them (radius 1 mm), pressed together by lowering all nodes of the upper ones;
    those of the lower ones stay at their height.

    They cross in the middle of elements, n * n times; a current enters at the lower wires and leaves at the upper ones.
    """
    along = (np.arange(n + 2) - 0.5) * pitch
    blocks = ["*HEADING\nwire grid of a test\n*UNITS, SYSTEM=SI\n"]
    ends = {"LOWER": [], "UPPER": []}
    for i in range(n):
        across = np.full(n + 2, i * pitch)
        for name, first, points in (
            ("LOWER", 1 + i * (n + 2), np.c_[along, across, 0 * along]),
            ("UPPER", 1 + (n + i) * (n + 2), np.c_[across, along, 0 * along + 2e-3]),
        ):
            blocks.append(wire(name, points, first, element="B33"))
            ends[name] += [f" {first}", f" {first + n + 1}"]
    blocks += [f"*NSET, NSET={name}_ENDS\n" + "\n".join(lines) + "\n" for name, lines in ends.items()]
    return (
        "".join(blocks)
        + f"""\
*ELSET, ELSET=WIRES
 LOWER, UPPER
{MATERIAL.strip()}
*ELECTRICAL CONDUCTIVITY
 5e7
*BEAM SECTION, ELSET=WIRES, MATERIAL=STEEL, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
 1e5
*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 LOWER_ENDS, ENCASTRE
 LOWER, 3
*STEP
*STATIC
 1., 1.
*BOUNDARY
 UPPER, 1, 2
 UPPER, 4, 6
 UPPER, 3, 3, -2e-5
 LOWER_ENDS, 9, 9, 1e-3
 UPPER_ENDS, 9, 9, 0
*END STEP
"""
    )
