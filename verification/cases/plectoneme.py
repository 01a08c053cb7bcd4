"""A rubber rod is slackened and twisted until it winds around itself: angle, moment and line force of the ply at its tension.

Source: N. Clauvelin, B. Audoly, S. Neukirch, Biophysical Journal 96 (2009) 3716-3723; derived from the energy of the ply in
references/plectoneme.py, with the stiffness of the contact. Size and slack of the rod are those of examples/plectoneme.py of
dismech-newton, which accepts 3 % in the moment. The rod snaps when it first touches itself, and its plies slide along it without
friction: damping takes it from one equilibrium to the next, and is zero at the end, where nothing moves.
"""

import math
import warnings

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join
from verification.line_decks import material, touching
from verification.references.helical_rods import Rod
from verification.references.plectoneme import at_angle, under_tension

ROD, LENGTH, SLACK, TURNS = Rod(1.55e-3, 1.3e6, 0.499), 0.5, 0.15, 20
#: Force per length and overlap of the strands [N/m^2]: they overlap by 1.4 % of the radius in the end
STIFFNESS = 3e6
#: Turns before the ends are brought together
FIRST_TURNS = 4
MESHES = (200, 300)


def deck(elements):
    """The rod along x: first twisted a little, then slackened, then twisted, then left to itself."""
    s = np.linspace(-1.0, 1.0, elements + 1)
    bow = 1e-3 * LENGTH
    points = np.stack([LENGTH * s / 2, bow * np.cos(np.pi * s / 2) ** 2, 0.3 * bow * np.sin(np.pi * s)], axis=1)
    last = elements + 1

    def step(static, turns, slack):
        half = f"{math.pi * turns:.17g}", f"{slack / 2:.17g}"
        return (
            f"*STEP, INC=2000\n*STATIC\n {static}\n*CONTROLS, PARAMETERS=STABILIZE\n 1e-6\n*BOUNDARY\n"
            f" 1, 4, 4, -{half[0]}\n {last}, 4, 4, {half[0]}\n 1, 1, 1, {half[1]}\n {last}, 1, 1, -{half[1]}\n*END STEP"
        )

    return join(
        heading("A rod winds around itself", f"Model   {elements} B33, ends twisted by {TURNS} turns"),
        chain(points, "B33", "ROD"),
        material("RUBBER", ROD, "ROD"),
        touching(("ROD",), stiffness=STIFFNESS),
        f"*NSET, NSET=ENDS\n 1, {last}\n*BOUNDARY\n ENDS, 2, 3\n ENDS, 5, 6",
        step("0.1, 1, 1e-5, 0.1", FIRST_TURNS, 0.0),
        step("0.02, 1, 1e-6, 0.05", FIRST_TURNS, SLACK),
        step("0.01, 1, 1e-7, 0.01", TURNS, SLACK),
        step("0.1, 10, 1e-7, 5", TURNS, SLACK),
    )


def ply_of(results):
    """Tension and moment of the tails, and angle and line force in the middle of the plies, which lie about their loops."""
    force, moment = (results.field(f"reaction_{name}")[[0, -1], 0] for name in ("force", "moment"))
    contacts = results.contacts_at(-1)
    along = np.abs(contacts["element_1"] - contacts["element_2"])
    # far from the loop at the one end of a ply, and from the tails at the other one
    low, high = np.quantile(along, [0.3, 0.7])
    inner = (along > low) & (along < high) & (contacts["length"] > 0)
    angle = np.minimum(contacts["angle"], np.pi - contacts["angle"])[inner].mean() / 2
    pressed = contacts["force"][inner].sum() / contacts["length"][inner].sum()
    return (force[1] - force[0]) / 2, (moment[1] - moment[0]) / 2, angle, pressed


def measure(workspace):
    meshes = MESHES if not workspace.quick else MESHES[:1]
    with warnings.catch_warnings():
        # what is between the equilibria is not stable, and damped
        warnings.filterwarnings("ignore", message=".*negative pivots")
        found = {n: ply_of(workspace.run(f"rod_{n}", deck(n))) for n in meshes}
    force, moment, angle, pressed = found[meshes[-1]]
    exact = under_tension(force, ROD.radius, ROD.ei, STIFFNESS)
    return {
        "plectoneme.angle": angle / exact.angle,
        "plectoneme.moment": moment / exact.moment,
        "plectoneme.line_force": pressed / exact.line_force,
        "figure": {str(n): list(map(float, values)) for n, values in found.items()},
    }


def draw(values, path):
    plies = [at_angle(angle, ROD.radius, ROD.ei) for angle in np.radians(np.linspace(10, 26, 60))]
    force = [1e3 * ply.force for ply in plies]
    curves = (
        ("moment [mN m]", [1e3 * ply.moment for ply in plies], 1, 1e3),
        ("angle of the ply [degrees]", [math.degrees(ply.angle) for ply in plies], 2, 180 / math.pi),
        ("line force [N/m]", [ply.line_force for ply in plies], 3, 1.0),
    )
    with figures.panels(path, columns=3) as axes:
        for panel, (label, curve, column, factor) in zip(axes, curves, strict=True):
            panel.plot(force, curve, label="long ply", **figures.REFERENCE)
            for (mesh, row), marker in zip(values["figure"].items(), "so", strict=False):
                point = [1e3 * row[0]], [factor * row[column]]
                panel.plot(*point, marker, fillstyle="none", label=f"{mesh} elements")
            panel.set(xlabel="tension [mN]", ylabel=label)
        axes[0].legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["plectoneme"]))
