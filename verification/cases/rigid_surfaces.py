"""Beams and wires on rigid planes and in bores: point forces at the ends of contact, and the law of a long contact.

Source: equilibrium and S. Timoshenko's solutions, derived in references/pressed_on_plane.py.
"""

import math

import numpy as np

from verification import figures
from verification.references import pressed_on_plane as exact
from verification.references.helical_rods import Rod
from verification.surface_decks import beam_in_bore, curved_beam_on_plane, ring_between_plates, wire_between_plates

WIRE = Rod(0.5e-3, 200e9, 0.3)
BENDING = WIRE.young * math.pi * WIRE.radius**4 / 4
#: Half the length of the curved beam [m], its curvature [1/m], and the forces at its ends
HALF, CURVATURE, ELEMENTS = 0.05, 0.4, 100
LOADS = BENDING * CURVATURE / HALF * np.array([1.25, 5 / 3, 2.5, 5.0])
#: A hinged beam in a bore: length and clearance [m], loads over the first one of Euler
LENGTH, CLEARANCE = 0.2, 2e-4
COMPRESSIONS = math.pi**2 * BENDING / LENGTH**2 * np.array([1.5, 2.0, 3.0])
#: Ring [m]
RING, SHORTENING = 0.05, 2e-5
#: Approaches of two plates [m]
APPROACHES = np.array([2e-7, 1e-6, 3e-6])


def measure(workspace):
    beam = workspace.run("curved_beam", curved_beam_on_plane(WIRE, HALF, CURVATURE, LOADS, ELEMENTS))
    centres, inside = zip(*(_half(beam, step) for step in range(2, len(LOADS) + 2)), strict=True)
    bore = workspace.run("bore", beam_in_bore(WIRE, LENGTH, CLEARANCE, COMPRESSIONS, 40))
    ring = workspace.run("ring", ring_between_plates(WIRE, RING, SHORTENING, 160))
    wire = workspace.run("wire", wire_between_plates(WIRE, 0.01, APPROACHES, 10))
    return {
        "rigid_surfaces.flat": list(centres),
        "rigid_surfaces.inside": max(inside),
        "rigid_surfaces.bore": [float(_last(bore, step)["force"].sum()) for step in range(3, len(COMPRESSIONS) + 3)],
        "rigid_surfaces.ring": float(-ring.field("reaction_force")[-1, 2]) / SHORTENING,
        "rigid_surfaces.pressed": [
            float(-_reaction(wire, step)[-1, 2]) / 0.01 for step in range(1, len(APPROACHES) + 1)
        ],
        "figure": {"place": _last(beam, 5)["point_x"].tolist(), "force": _last(beam, 5)["force"].tolist()},
    }


def _last(results, step):
    """The contacts at the end of a step."""
    table = results.surface_contacts
    of_step = table["step"] == step
    return table.where(of_step & (table["increment"] == table["increment"][of_step].max()))


def _reaction(results, step):
    return results.field("reaction_force", int(np.flatnonzero(results.steps == step)[-1]))


def _half(results, step):
    """Centre of the force on the right half, and the part of the force that is in the inner two thirds of the flat part."""
    now = _last(results, step)
    x, force = now["point_x"], now["force"]
    right = x > 0
    centre = float((x * force)[right].sum() / force[right].sum())
    return centre, float(force[np.abs(x) < 2 / 3 * centre].sum() / force.sum())


def draw(values, path):
    with figures.panels(path, columns=2) as (left, right):
        loads = np.linspace(1.0, 5.5, 100) * BENDING * CURVATURE / HALF
        flat = [1e3 * exact.flat_half(load, HALF, BENDING, CURVATURE) for load in loads]
        left.plot(1e3 * loads, flat, label="exact", **figures.REFERENCE)
        centres = 1e3 * np.array(values["rigid_surfaces.flat"])
        left.plot(1e3 * LOADS, centres, **figures.STYLES["B33"], linestyle="none", label="litz")
        left.set(xlabel="force at each end [mN]", ylabel="half of the flat part [mm]")
        left.legend()
        figure = values["figure"]
        right.stem(1e3 * np.array(figure["place"]), 1e3 * np.array(figure["force"]), basefmt=" ")
        right.set(xlabel="place [mm]", ylabel="force of an element [mN]")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["rigid_surfaces"]))
