"""Decks of a piece of an endless strand that is pulled and bent: its ends move alike, but for a stretch and a turn."""

import math

import numpy as np

from verification.deck_text import chain, heading, join
from verification.line_decks import FIRST, SECOND, material, touching

#: Nodes of no element that stretch the piece, and turn its ends against each other: along z, by as many radians as metres
STRETCH, BEND = 90001, 90002


def bent_strand(strand, strain, curvatures, elements, *, friction, elastic_slip, stiffness, increments):
    """A sixth of a lay along z; each wire goes on where the next one begins.

    strand: `helical_rods.Strand` of six wires; curvatures: of each step [1/m], about x, reached in as many increments as
    `increments` has for it. Each wire has the load across that keeps its tension on the arc.
    """
    length = strand.pitch / strand.count
    z = np.linspace(-length / 2, length / 2, elements + 1)
    radius, zero = strand.free.radius, np.zeros_like(z)
    blocks = [chain(np.column_stack([zero, zero, z]), "B33", "CORE", FIRST)]
    names, firsts, across = [], [FIRST], [0.0]
    for number in range(strand.count):
        angle = 2 * math.pi * (z / strand.pitch + number / strand.count)
        firsts.append(SECOND + 1000 * number)
        names.append(f"WIRE{number + 1}")
        across.append(radius * math.sin(angle[0]))
        points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])
        blocks.append(chain(points, "B33", names[-1], firsts[-1]))
    goes_on = [0, *(1 + (number + 1) % strand.count for number in range(strand.count))]
    tied = [_tied(firsts[i] + elements, firsts[j], across[j]) for i, j in enumerate(goes_on)]
    blocks += [
        f"*NODE, NSET=ENDS\n {STRETCH}, 0., 0., 0.\n {BEND}, 0., 0., 0.",
        "*ELSET, ELSET=WIRES\n " + "\n ".join(names),
        material("ONE", strand.core, "CORE"),
        material("OTHER", strand.wire, *names),
        touching(
            ("CORE", "WIRES"),
            stiffness=stiffness,
            friction=f"*FRICTION, ELASTIC SLIP={elastic_slip:.17g}\n {friction:.17g}",
        ),
        *tied,
        f"*BOUNDARY\n {FIRST}, 1, 3\n {FIRST}, 6",
        _step(2, f" {STRETCH}, 3, 3, {strain * length:.17g}\n {BEND}, 3\n {FIRST}, 4"),
    ]
    tension = strand.wire.ea * (strand.state(strain).helix.stretch - 1) * math.cos(strand.free.angle) ** 2
    for curvature, count in zip(curvatures, increments, strict=True):
        turned = f" {BEND}, 3, 3, {curvature * length:.17g}\n {FIRST}, 4, 4, {-curvature * length / 2:.17g}"
        loads = [
            "*DLOAD",
            f" CORE, PY, {strand.core.ea * strain * curvature:.17g}",
            f" WIRES, PY, {tension * curvature:.17g}",
        ]
        blocks.append(_step(count, turned, *loads))
    return join(
        heading("A pulled strand is bent", f"Model   {elements} B33 for each wire on a sixth of a lay, ends alike"),
        *blocks,
    )


def _tied(end, start, across):
    """Equations by which an end moves as the start does that it goes on in, which is at `across` from the neutral plane."""
    alike = [f"*EQUATION\n 2\n {end}, {dof}, 1., {start}, {dof}, -1." for dof in (1, 2, 5, 6)]
    turned = [f"*EQUATION\n 3\n {end}, 4, 1., {start}, 4, -1., {BEND}, 3, -1."]
    terms = [f"{end}, 3, 1., {start}, 3, -1., {STRETCH}, 3, -1.", *([f"{BEND}, 3, {-across:.17g}"] if across else [])]
    count = 3 + bool(across)
    return "\n".join([*alike, *turned, f"*EQUATION\n {count}\n {', '.join(terms)}"])


def _step(increments, boundary, *loads):
    first = f"{1 / increments:.17g}"
    static = f"*STATIC\n {first}, 1., 1.e-6, {first}"
    printed = "*NODE PRINT, NSET=ENDS\n U, RF\n*ENERGY PRINT"
    return "\n".join(["*STEP, INC=1000", static, "*BOUNDARY", boundary, *loads, printed, "*END STEP"])
