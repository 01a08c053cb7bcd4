"""Two crossed wires pressed together: force from the bending of both and the compliance of the contact.

Source: deflections of straight beams, Roark's Formulas for Stress and Strain, 7th ed., table 8.1; shear, Timoshenko,
Strength of Materials I, section 39; Hertz's contact, Johnson, Contact Mechanics, section 4.2. With the approach u of
the supports, F (c1 + c2) + delta(F) = u. Cubic elements (B33) are exact at their nodes; a contact inside an element of
length h at xi misses h^3 (1 - xi^2)^3/(192 E I), the part of the deflection that nodes do not see.
"""

import math

import numpy as np

from verification import figures
from verification.references import crossed_wires, hertz
from verification.wire_decks import COPPER, Crossing, interaction

LENGTH, APPROACH, PENALTY = 0.1, 2e-6, 1e5
SUPPORTS = ("cantilever", "supported", "clamped")
#: The crossing: 0.4 and 0.6 of the length from the first support, at nodes of ten elements
AT = (0.04, 0.06)
#: Small enough that shear is a good part of the deflection [N]
SHEAR_STIFFNESS = 400.0
#: G A of the wires with Cowper's factor 6(1 + nu)/(7 + 6 nu): Cowper, J. Appl. Mech. 33 (1966) 335-340 [N]
COPPER_SHEAR = 3 * COPPER.young * COPPER.area / (7 + 6 * COPPER.poisson)
#: Numbers of elements with the crossing in the middle of the middle one
ODD_MESHES = (5, 9, 17, 33)


def overlap(penalty):
    """Overlap that a force needs: linear penalty, or Hertz when it is None."""
    if penalty is not None:
        return lambda force: force / penalty
    modulus = hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2)
    unit = hertz.crossed_wires(
        1, math.pi / 2, radius=(COPPER.radius,) * 2, modulus=modulus, resistivity=(1, 1)
    ).approach
    return lambda force: unit * force ** (2 / 3)


def exact(support, at, penalty, missing=0.0, ga=math.inf):
    """Force of the closed form; `missing` of the compliance is left out for each wire."""
    compliance = sum(crossed_wires.deflection(support, LENGTH, x, x, ei=COPPER.ei, ga=ga) - missing for x in at)
    return crossed_wires.force(APPROACH, compliance, overlap(penalty))


def measured(workspace, name, crossing, penalty, **options):
    """Contact force of a run."""
    deck = crossing.deck(
        interaction(("LOWER", "UPPER"), penalty=penalty),
        [APPROACH],
        f"Model   copper, radius 1 mm, length 100 mm, {crossing.support}; the upper supports go down by 2 micrometres",
        "Source  F (c1 + c2) + overlap(F) = approach, with the deflections c of Roark's table 8.1",
        **options,
    )
    return float(workspace.run(name, deck).contacts_at(-1)["force"][0])


def even(support, n, element):
    nodes = np.linspace(0.0, LENGTH, n + 1)
    return Crossing(nodes, nodes, AT, support, element)


def middle(n, element):
    nodes = np.linspace(0.0, LENGTH, n + 1)
    return Crossing(nodes, nodes, (LENGTH / 2, LENGTH / 2), "clamped", element)


def measure(workspace):
    values = {}
    for law, penalty in (("linear", PENALTY), ("hertz", None)):
        values[f"crossed_beams.{law}"] = [
            measured(workspace, f"{support}_{law}", even(support, 10, "B33"), penalty) for support in SUPPORTS
        ]
    if workspace.quick:
        return values | {"figure": {}}
    values["crossed_beams.shear"] = []
    for support in SUPPORTS:
        coarse, fine = (
            measured(workspace, f"{support}_B31_{n}", even(support, n, "B31"), PENALTY, shear=SHEAR_STIFFNESS)
            for n in (20, 40)
        )
        # the compliance of one-point elements has an error in h^2 only
        values["crossed_beams.shear"].append(3 / (4 / fine - 1 / coarse))
    forces = {
        element: [measured(workspace, f"middle_{element}_{n}", middle(n, element), PENALTY) for n in ODD_MESHES]
        for element in ("B31", "B33")
    }
    values["crossed_beams.inside"] = forces["B33"]
    errors = {}
    for element, ga in (("B31", COPPER_SHEAR), ("B33", math.inf)):
        truth = exact("clamped", (LENGTH / 2, LENGTH / 2), PENALTY, ga=ga)
        errors[element] = [abs(force / truth - 1) for force in forces[element]]
        order = math.log(errors[element][-2] / errors[element][-1]) / math.log(ODD_MESHES[-1] / ODD_MESHES[-2])
        values[f"crossed_beams.{element}.order"] = order
    return values | {"figure": errors}


def draw(values, path):
    with figures.panels(path) as (bars, error):
        place = np.arange(len(SUPPORTS))
        for i, (law, penalty) in enumerate((("linear", PENALTY), ("hertz", None))):
            exact_forces = [exact(support, AT, penalty) for support in SUPPORTS]
            bars.bar(place + 0.36 * i, exact_forces, 0.34, alpha=0.35, label=f"closed form, {law}")
            forces = values[f"crossed_beams.{law}"]
            bars.plot(place + 0.36 * i, forces, "k_", markersize=14, label=None if i else "litz")
        bars.set_xticks(place + 0.18, SUPPORTS)
        bars.set(ylabel="contact force [N]", yscale="log", ylim=(1e-3, 4e-2))
        bars.set_yticks([1e-3, 2e-3, 5e-3, 1e-2, 2e-2], ["0.001", "0.002", "0.005", "0.01", "0.02"])
        bars.minorticks_off()
        bars.legend()
        if values["figure"]:
            for element, found in values["figure"].items():
                error.loglog(ODD_MESHES, found, label=f"{element}, contact inside", **figures.STYLES[element])
            missing = [(LENGTH / n) ** 3 / (192 * COPPER.ei) for n in ODD_MESHES]
            truth = exact("clamped", (LENGTH / 2, LENGTH / 2), PENALTY)
            theory = [exact("clamped", (LENGTH / 2, LENGTH / 2), PENALTY, m) / truth - 1 for m in missing]
            error.loglog(ODD_MESHES, theory, "--", label=r"$h^3/(192\,EI)$ missing", **figures.REFERENCE)
            error.set(xlabel="elements of a wire", ylabel="relative error of the force", ylim=(1e-5, 2))
            error.set_xticks(ODD_MESHES, [str(n) for n in ODD_MESHES])
            error.minorticks_off()
            error.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["crossed_beams"]))
