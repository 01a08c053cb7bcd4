"""A strand of a core and six wires is pulled, its ends held against turning: force, moment and line contact.

Source: G. A. Costello, Theory of Wire Rope, 2nd ed. (1997), for rods that keep their shape as helices; dimensions of the
strand tested by W. S. Utting, N. Jones, Int. J. Mech. Sci. 29 (1987) 605-619; exact for uniform helices in
references/helical_rods.py, where the approach of core and wires under their line force is included.
"""

import math

import numpy as np

from verification import figures
from verification.cases.twisted_pair import approach_of, end_loads, line_force
from verification.line_decks import FIRST, SECOND, pulled_strand
from verification.references.helical_rods import Rod, Strand

STRAND = Strand(Rod(1.97e-3, 188e9, 0.3), Rod(1.865e-3, 188e9, 0.3), 6, 0.115)
LENGTH, STRAIN = STRAND.pitch / 2, 1e-3
MESHES = (8, 16, 32)


def exact(strain=STRAIN):
    """The state of the strand; its wires are pressed by the mean of two forces per length, of the core and of a wire."""
    approach = approach_of(STRAND.core, STRAND.wire)
    share = (1 + STRAND.free.height) / 2
    return STRAND.state(strain, approach=lambda force: approach(force / share))


def loads_at(workspace, elements):
    """Force, moment and line force of one wire per length of it, in the middle half."""
    results = workspace.run(f"strand_{elements}", pulled_strand(STRAND, [exact()], LENGTH, elements))
    starts = {FIRST + elements: (0.0, 0.0)}
    for number in range(STRAND.count):
        angle = 2 * math.pi * (LENGTH / STRAND.pitch + number / STRAND.count)
        place = STRAND.free.radius * np.array([math.cos(angle), math.sin(angle)])
        starts[SECOND + 1000 * number + elements] = tuple(place)
    force, moment = end_loads(results.history, starts)
    pressed = line_force(results, LENGTH, elements) / STRAND.count
    return [force, moment, pressed * STRAND.free.height]


def measure(workspace):
    meshes = MESHES if not workspace.quick else MESHES[1:2]
    found = {n: loads_at(workspace, n) for n in meshes}
    finest = found[meshes[-1]]
    values = {f"pulled_strand.{name}": finest[i] for i, name in enumerate(("force", "moment", "line_force"))}
    return values | {"figure": {str(n): loads for n, loads in found.items()}}


def draw(values, path):
    strains = np.linspace(1e-5, STRAIN, 30)
    curve = [exact(strain) for strain in strains]
    with figures.panels(path, columns=3) as axes:
        for i, (panel, name) in enumerate(zip(axes, ("force", "moment", "line_force"), strict=True)):
            panel.plot(1e3 * strains, [getattr(state, name) for state in curve], label="exact", **figures.REFERENCE)
            for mesh, marker in zip(values["figure"], "sox", strict=False):
                panel.plot(
                    [1e3 * STRAIN], [values["figure"][mesh][i]], marker, fillstyle="none", label=f"{mesh} elements"
                )
            panel.set(xlabel="strain [1e-3]", ylabel=name.replace("_", " "))
        axes[0].legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["pulled_strand"]))
