"""Round ends and kinks of wires on a plate, and a wire across a drum: short contacts, as in a half-space.

Source: H. Hertz, and boundary-element solutions of the end of a cylinder in a half-space, references/end_in_half_space.py.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join
from verification.line_decks import material
from verification.references.hertz import force_of_approach
from verification.surface_decks import boundary, on_surface, static
from verification.wire_decks import Wire

RADIUS = 1e-3
WIRE = Wire(radius=RADIUS, young=120e9, poisson=0.34, resistivity=0.0)
MODULUS = WIRE.young / (1 - WIRE.poisson**2)
#: Slopes v = t sqrt(r/delta) of straight wires, and of wires bent away from the plate: v, kappa
SLOPES = (1.2, 0.5, 0.3, 0.2)
BENT = ((0.3, 0.1), (0.2, 0.3))
DEEP, SHALLOW = 2e-2 * RADIUS, 2e-3 * RADIUS
#: Overlaps of a wire across a drum of five of its radii, over its radius
DRUM = (1e-3, 3e-3, 5e-3, 7e-3)


def measure(workspace):
    straight = [force_of(workspace, f"straight_{v}", leg(slope_at(v, SHALLOW)), SHALLOW) for v in SLOPES]
    bent = [force_of(workspace, f"bent_{v}_{bend}", leg(slope_at(v, SHALLOW), bend), SHALLOW) for v, bend in BENT]
    kinks = []
    for name, angles in (("even", (20, 20)), ("uneven", (10, 40)), ("reversed", (40, 10))):
        first, second = (leg(math.sin(math.radians(angle))) for angle in angles)
        points = np.vstack([(first * [-1, 1, 1])[:0:-1], second])
        kinks.append(force_of(workspace, f"kink_{name}", points, DEEP))
    drum = [
        float(
            total(workspace.run(f"drum_{part}", across_a_drum(part)))
            / force_of_approach(part * RADIUS, math.pi / 2, radius=(RADIUS, 5 * RADIUS), modulus=MODULUS)
        )
        for part in DRUM
    ]
    return {
        "ends_on_plates.straight": straight,
        "ends_on_plates.bent": bent,
        "ends_on_plates.kinks": kinks,
        "ends_on_plates.drum": drum,
        "figure": {"straight": straight},
    }


def draw(values, path):
    with figures.panels(path, columns=1) as axes:
        v = np.linspace(0.15, 1.2, 200)
        e = 0.1 * np.maximum(1 - v, 0) ** 3.4 / v
        axes.plot(v, 1 + e - v * np.gradient(e, v) / 5, label="fit to half-spaces", **figures.REFERENCE)
        axes.plot(SLOPES, values["figure"]["straight"], **figures.STYLES["B33"], linestyle="none", label="litz")
        axes.set(xlabel="slope of the wire [(delta/r)^(1/2)]", ylabel="force over that of a sphere")
        axes.legend()


def slope_at(v, overlap):
    """Slope t."""
    return v * math.sqrt(overlap / RADIUS)


def leg(slope, bend=0.0):
    """Points of a wire that rises from its end at the origin, bent away from the plate with kappa = `bend`.

    Elements of a quarter of a radius, which is longer than the contact.
    """
    s = np.arange(0, 41 if not bend else 9) * RADIUS / 4
    curvature = bend / (1 - bend) / RADIUS
    if not curvature:
        return np.column_stack([s * math.sqrt(1 - slope**2), 0 * s, s * slope])
    start = math.asin(slope)
    angle = start + curvature * s
    return np.column_stack([np.sin(angle) - math.sin(start), 0 * s, math.cos(start) - np.cos(angle)]) / curvature


def force_of(workspace, name, points, overlap):
    """Force over that of a sphere."""
    return float(total(workspace.run(name, lowered(points, overlap))) / (4 / 3 * MODULUS * RADIUS**0.5 * overlap**1.5))


def total(results):
    return results.surface_contacts_at(-1)["force"].sum()


def lowered(points, overlap):
    """A wire that is held everywhere is lowered on a plate, so that its node at the origin overlaps."""
    return join(
        heading("The end of a wire, or its kink, on a plate"),
        chain(points + np.array([0, 0, RADIUS]), "B33", "WIRE"),
        material("M", WIRE, "WIRE"),
        on_surface("PLATE", "PLANE", [0, 0, 0, 0, 0, 1]),
        boundary([("WIRE", 1, 2, 0.0), ("WIRE", 4, 6, 0.0)]),
        static(boundary([("WIRE", 3, 3, -overlap)]), "0.5, 1"),
    )


def across_a_drum(part):
    """A straight wire that is held everywhere, across a drum of five radii."""
    x = np.linspace(-8, 8, 5) * RADIUS
    return join(
        heading("A wire across a drum"),
        chain(np.column_stack([x, 0 * x, 0 * x]), "B33", "WIRE"),
        material("M", WIRE, "WIRE"),
        on_surface("DRUM", "CYLINDER", [0, 0, -6 * RADIUS, 0, 1, 0, 5 * RADIUS]),
        boundary([("WIRE", 1, 2, 0.0), ("WIRE", 4, 6, 0.0)]),
        static(boundary([("WIRE", 3, 3, -part * RADIUS)]), "0.25, 1"),
    )


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["ends_on_plates"]))
