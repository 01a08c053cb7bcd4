"""A pulled strand of a core and six wires is bent forth and back, and its wires stick and slip on the core.

Source: K. O. Papailiou, IEEE Trans. Power Delivery 12 (1997) 1576-1588, and F. Foti, L. Martinelli, Int. J. Solids Struct. 91
(2016) 1-17: plane sections, and the friction of a rope on a drum. They leave out what is of the second order in the lay angle,
above all that wires roll on the core; thin rods that do so are in references/bent_strand.py.
"""

import numpy as np

from verification import figures
from verification.references.bent_strand import Papailiou, Rods
from verification.references.helical_rods import Rod, Strand
from verification.strand_decks import BEND, bent_strand

CORE, WIRE = Rod(0.52e-3, 120e9, 0.34), Rod(0.5e-3, 120e9, 0.34)
LAYS = {"long": 90e-3, "short": 45e-3}
STRAIN, FRICTION, ELEMENTS = 5e-4, 0.2, 20
#: A coefficient of friction that holds the layer from sliding as a whole, and no more
SMOOTH = 1e-5
#: Before friction reaches its limit [m], and force of a contact per length and overlap [N/m^2]: neither gives way
ELASTIC_SLIP, STIFFNESS = 1e-11, 1e13
#: Largest curvature, and where the moment is compared, over that at which wires begin to slip
LARGEST, COMPARED = 3.0, (0.9, 1.2, 1.5, 2.1, 3.0)


def strand_of(lay):
    return Strand(CORE, WIRE, 6, LAYS[lay])


def theory(kind, lay):
    """`Papailiou` or `Rods` for a strand as it is pulled."""
    strand = strand_of(lay)
    return kind(strand, FRICTION, WIRE.ea * (strand.state(STRAIN).helix.stretch - 1))


def bent(workspace, name, lay, curvatures, increments, friction=FRICTION):
    """Results, and for each step that bends curvature, moment, and work of friction per length."""
    deck = bent_strand(
        strand_of(lay), STRAIN, curvatures, ELEMENTS, friction=friction, elastic_slip=ELASTIC_SLIP, stiffness=STIFFNESS,
        increments=increments,
    )  # fmt: skip
    results = workspace.run(name, deck)
    history, length = results.history, LAYS[lay] / 6
    scales = {f"U3 node {BEND}": 1 / length, f"RF3 node {BEND}": 1.0, "ALLFD": 1 / length}
    rows = [np.flatnonzero(history["step"] == 2 + number) for number in range(len(curvatures))]
    return results, [np.array([scale * history[key][row] for key, scale in scales.items()]) for row in rows]


def first_slip(results, curvature, length):
    """Curvature at which the place nearest to its limit would slip, from one at which all stick, in the middle half.

    There wires cross the neutral plane, and the ends of axes do not count.
    """
    now = results.contacts_at(-1)
    used = np.sqrt(sum(now[f"traction_{axis}"] ** 2 for axis in "xyz")) / (FRICTION * now["force"])
    return float(curvature / used[np.abs(now["point_1_z"]) < length / 4].max())


def measure(workspace):
    values = {}
    for lay, pitch in LAYS.items():
        curvature = theory(Papailiou, lay).first_slip / 2
        results, [(_, moment, _)] = bent(workspace, f"sticks_{lay}", lay, [curvature], [1])
        values[f"bent_strand.sticking.{lay}"] = values[f"bent_strand.sticking_rods.{lay}"] = moment[-1] / curvature
        values[f"bent_strand.first_slip.{lay}"] = first_slip(results, curvature, pitch / 6)
        values[f"bent_strand.first_slip_rods.{lay}"] = values[f"bent_strand.first_slip.{lay}"]
        _, [(_, moment, _)] = bent(workspace, f"smooth_{lay}", lay, [curvature], [1], friction=SMOOTH)
        values[f"bent_strand.smooth.{lay}"] = moment[-1] / curvature
    return values if workspace.quick else values | _cycle(workspace)


def _cycle(workspace):
    """Bent to three times the curvature at which wires slip, to the opposite one, and back."""
    first = theory(Papailiou, "short").first_slip
    largest = LARGEST * first
    _, steps = bent(workspace, "cycle", "short", [largest, -largest, largest], [30, 30, 30])
    curvature, moment, _ = steps[0]
    loop = np.hstack([steps[0][:, -1:], steps[1], steps[2]])
    work = loop[2, -1] - loop[2, 0]
    area = float(np.trapezoid(loop[1], loop[0]))
    return {
        "bent_strand.moment": np.interp(np.array(COMPARED) * first, curvature, moment).tolist(),
        "bent_strand.slipped": float(moment[-1]),
        "bent_strand.loop": float(work),
        "bent_strand.closed": float(abs(loop[1, -1] / loop[1, 0] - 1)),
        "bent_strand.audit": float(abs(work / area - 1)),
        "figure": {"curvature": [*curvature, *loop[0]], "moment": [*moment, *loop[1]]},
    }


def draw(values, path):
    plane, rods = theory(Papailiou, "short"), theory(Rods, "short")
    largest = LARGEST * plane.first_slip
    up = np.linspace(0, largest, 60)
    down = np.linspace(largest, -largest, 90)
    back = [plane.unloading(x, largest) for x in down]
    with figures.panels(path, columns=1) as axes:
        axes.plot(up, [1e3 * plane.moment(x) for x in up], label="Papailiou", **figures.REFERENCE)
        axes.plot(down, 1e3 * np.array(back), **figures.REFERENCE)
        axes.plot(-down, -1e3 * np.array(back), **figures.REFERENCE)
        full = np.array([2.0 * plane.first_slip, largest])
        slid = 1e3 * (rods.slipping * full + rods.friction_moment)
        axes.plot(full, slid, ":", color="#5b8e3e", label="rods that roll, all slip")
        found = values["figure"]
        axes.plot(found["curvature"], 1e3 * np.array(found["moment"]), ".", color="#c4451c", markersize=3, label="litz")
        axes.set(xlabel="curvature [1/m]", ylabel="moment [mN m]", ylim=(-8, 13))
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["bent_strand"]))
