"""Bundles of straight rods in a round jacket that shrinks: the void fraction at which they jam.

Source: rigid discs in the smallest circle, 3 and 4 in a ring and 7 in a hexagon; R. L. Graham, B. D. Lubachevsky, K. J. Nurmela,
P. R. J. Ostergard, Discrete Math. 181 (1998) 139-154. The rods are elastic, so that the force between them begins there.
"""

import math

import numpy as np

import litz
from verification import figures

STEEL = litz.Material("STEEL", 200e9, 0.3, units="SI")
RADIUS, LENGTH, LOOSE = 0.5e-3, 4e-3, 1.06
#: Radius of the jacket over that of the rods as they jam, of rings of 3 and 4 and of a hexagon around a core
JAMMED = {3: 1 + 2 / math.sqrt(3), 4: 1 + math.sqrt(2), 7: 3.0}
#: Radii of the jacket over those, from the second step on
NEAR, STEPS = 1.0005, 40


def measure(workspace):
    runs = {count: run(workspace, count) for count in JAMMED}
    return {
        "compacted_bundles.void_fraction": [void_of(count, onset(*runs[count])) for count in JAMMED],
        "figure": {str(count): [np.asarray(part).tolist() for part in runs[count]] for count in JAMMED},
    }


def draw(values, path):
    with figures.panels(path, columns=1) as axes:
        for (count, (radii, forces)), style in zip(values["figure"].items(), figures.STYLES.values(), strict=False):
            axes.plot([void_of(int(count), radius) for radius in radii], forces, label=f"{count} rods", **style)
            axes.axvline(1 - int(count) / JAMMED[int(count)] ** 2, **figures.REFERENCE)
        axes.set(xlabel="void fraction", ylabel="force between rods [N]")
        axes.legend()


def run(workspace, count):
    """Radius of the jacket over that of the rods, and the force between them [N], as it passes where they jam."""
    model = litz.Model(f"{count} rods in a jacket")
    ring = count - (count == 7)
    angle = 2 * np.pi * np.arange(ring) / ring
    centres = np.column_stack([np.cos(angle), np.sin(angle)]) * (JAMMED[count] - 1) * LOOSE * RADIUS
    if count == 7:
        centres = np.vstack([centres, [0, 0]])
    axes = [np.column_stack([np.tile(centre, (3, 1)), np.linspace(0, LENGTH, 3)]) for centre in centres]
    rods = model.wires("RODS", axes, radius=RADIUS, material=STEEL)
    model.contact(rods)
    size = (JAMMED[count] - 1) * LOOSE * RADIUS + RADIUS
    shrinks = [1, NEAR * JAMMED[count] * RADIUS / size, JAMMED[count] / NEAR * RADIUS / size]
    jacket = model.bore(
        "JACKET", (0, 0, 0), (0, 0, 1), size, radius_amplitude=model.amplitude("SHRINK", [0, 1, 2], shrinks, "TOTAL TIME")
    )  # fmt: skip
    model.contact(rods, jacket)
    model.fix("RODS", "z", "rotations")
    model.step("CLOSE", increment=0.25).controls("STABILIZE", factor=1e-6)
    model.step("JAM", increment=1 / STEPS)
    results = workspace.run(f"rods_{count}", model.to_deck())
    after = [i for i, time in enumerate(results.times) if time >= 1]
    radii = size / RADIUS * np.interp(np.asarray(results.times)[after], [0, 1, 2], shrinks)
    return radii, np.array([results.contacts_at(i)["force"].sum() for i in after])


def onset(radii, forces):
    """Radius at which the force begins: it goes with the overlap, but for a logarithm."""
    first = np.flatnonzero(forces > 0.02 * forces.max())[0]
    slope = (forces[first + 1] - forces[first]) / (radii[first + 1] - radii[first])
    return radii[first] - forces[first] / slope


def void_of(count, radius):
    """Part of the section of the jacket that is not metal."""
    return 1 - count / radius**2


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["compacted_bundles"]))
