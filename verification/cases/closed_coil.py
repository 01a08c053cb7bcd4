"""A helical spring is closed: its turns come to lie on each other and take part of the force.

Source: uniform helices (A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927), articles 270-271)
with the energy of the contact of their turns: references/closed_coil.py. The turns at both ends are led as those of the exact
coil; those between them are free, and stay a uniform helix.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.line_decks import material, on_helix, prescribed, touching
from verification.references.closed_coil import ClosedCoil
from verification.references.helical_rods import Helix, Rod

RADIUS, PITCH, WIRE = 3e-3, 2.2e-3, Rod(1e-3, 200e9, 0.3)
#: Axial height of a turn at which the force is measured [m]: apart, and closed
HEIGHTS = (2.1e-3, 1.99e-3)
#: Turns in all, and those that are led at each end
TURNS, LED = 7, 2
MESHES = (24, 36, 48)


def coil():
    turn = math.hypot(2 * math.pi * RADIUS, PITCH)
    return ClosedCoil(WIRE, Helix(RADIUS, PITCH / turn, 2 * math.pi / turn), 1e9)


def exact():
    """The states at both heights."""
    return [coil().state(height / PITCH * coil().free.height) for height in HEIGHTS]


def deck(per_turn):
    """The coil, a step for each state; element for element its wire has equal lengths."""
    free = coil().free
    angle = 2 * math.pi * np.linspace(0, TURNS, TURNS * per_turn + 1)
    along = angle / free.turn
    points = np.stack([on_helix(free, a, free.height * s)[0] for a, s in zip(angle, along, strict=True)])
    led = [i for i, a in enumerate(angle) if min(a, angle[-1] - a) <= 2 * math.pi * LED * (1 + 1e-12)]
    steps = []
    for state in exact():
        rows = []
        for i in led:
            place, rotation = on_helix(state.helix, angle[i], state.helix.height * along[i])
            turned = (rotation * on_helix(free, angle[i], 0.0)[1].inv()).as_rotvec()
            rows += [(i + 1, dof, value) for dof, value in enumerate([*(place - points[i]), *turned], start=1)]
        steps.append(step(prescribed(rows), increments=2, direct=False))
    return join(
        heading("A helical spring is closed", f"Model   {per_turn} B33 for each turn; {LED} turns at each end are led"),
        chain(points, "B33", "WIRE"),
        material("STEEL", WIRE, "WIRE"),
        touching(("WIRE",), stiffness=coil().stiffness),
        *steps,
    )


def loads_of(results, increment, per_turn):
    """Axial force and moment on the turns that are led at the upper end, and line force and radius in the middle."""
    upper = slice((TURNS - LED) * per_turn, None)
    x = results.nodes + results.field("displacement", increment)
    force, moment = (results.field(f"reaction_{name}", increment) for name in ("force", "moment"))
    about_axis = x[:, 0] * force[:, 1] - x[:, 1] * force[:, 0] + moment[:, 2]
    contacts = results.contacts_at(increment)
    middle = [np.abs(contacts[f"element_{k}"] / per_turn - TURNS / 2) < 1 for k in (1, 2)]
    here = middle[0] & middle[1]
    pressed = contacts["force"][here].sum() / contacts["length"][here].sum() if here.any() else 0.0
    radius = np.hypot(x[:, 0], x[:, 1])[TURNS * per_turn // 2]
    return [force[upper, 2].sum(), about_axis[upper].sum(), pressed, radius]


def measure(workspace):
    meshes = MESHES if not workspace.quick else MESHES[:1]
    found = {}
    for n in meshes:
        results = workspace.run(f"coil_{n}", deck(n))
        found[n] = [loads_of(results, int(np.argmin(np.abs(results.times - 1 - k))), n) for k in range(len(HEIGHTS))]
    apart, closed = found[meshes[-1]]
    return {
        "closed_coil.apart.force": apart[0],
        "closed_coil.force": closed[0],
        "closed_coil.moment": closed[1],
        "closed_coil.line_force": closed[2],
        "figure": {str(n): [row[0] for row in rows] for n, rows in found.items()},
    }


def draw(values, path):
    heights = np.linspace(HEIGHTS[-1], PITCH, 60)
    with figures.panels(path, columns=1) as axes:
        force = [coil().state(height / PITCH * coil().free.height).force for height in heights]
        axes.plot(1e3 * heights, force, label="exact", **figures.REFERENCE)
        for mesh, marker in zip(values["figure"], "sox", strict=False):
            label = f"{mesh} elements a turn"
            axes.plot(1e3 * np.array(HEIGHTS), values["figure"][mesh], marker, fillstyle="none", label=label)
        axes.set(xlabel="height of a turn [mm]", ylabel="axial force [N]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["closed_coil"]))
