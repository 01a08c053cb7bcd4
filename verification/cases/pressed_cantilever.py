"""A cantilever pressed against a clamped beam: Zavarise and Wriggers, Example 2, without friction.

Source: data and forces of the paper, G. Zavarise, P. Wriggers, Int. J. Numer. Methods Eng. 49 (2000) 977-1006, Fig. 7,
as transcribed in tests/contact/test1.pro and test1.py of github.com/hortulanusT/dynLattice. The values compared with
are exact for these data: planar shear-flexible rod of large displacement, clamped at the driven end, pressed normal to
its axis by a clamped beam of small deflection (references/pushed_cantilever.py).

In step 3 the paper's force is the exact one; in step 6 it is 2.8 % larger. The transcription says that the driven end
moves by 0.03 along the cantilever in each step, which makes the arm longer and the force smaller. If it moved so in the
first three steps only, the exact forces would be 17.20, 34.40, 51.47 and 68.29: within 0.4 % of the paper in all steps.
A difference of the data can thus account for it; which data the paper used cannot be told from here.
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.references import crossed_wires, pushed_cantilever
from verification.workspace import iterations

EA, GA, EI, RADIUS, PENALTY = 4e6, 2e6, 2e4, 0.2, 1e4
#: Motion of the driven end along the cantilever in each step
DRIFT = 0.03
STEPS = (3, 4, 5, 6)
#: Forces of the paper's Fig. 7 at these steps
PAPER = (17.2, 34.3, 51.3, 68.4)
#: What the reference leaves out: stretching makes the beam stiffer by E A w^2/(16 E I) at a deflection w (shape
#: 1 - cos), w = 0.0174 in step 6, and the beam has 1.45 % of the compliance
STRETCHING = 0.0145 * EA * 0.0174**2 / (16 * EI)
#: Elements of the clamped beam and of the cantilever; the coarsest is the source's mesh
MESHES = ((20, 28), (40, 56), (80, 112))


def deck(n_beam, n_cantilever):
    """The driven end moves by (0.03, 0, 0.3) in each of six steps and does not turn."""
    beam = np.linspace([4.0, 0.0, 1.0], [4.0, 10.0, 1.0], n_beam + 1)
    cantilever = np.linspace([14.0, 5.0, 0.0], [0.0, 5.0, 0.0], n_cantilever + 1)
    sections = [
        f"*BEAM SECTION, ELSET={name}, MATERIAL=BAR, SECTION=GENERAL, CONTACT RADIUS={RADIUS}\n"
        " 4.e-2, 2.e-4, 0., 2.e-4, 4.e-4\n*TRANSVERSE SHEAR STIFFNESS\n 2.e6, 2.e6"
        for name in ("BEAM", "CANTILEVER")
    ]
    motion = (step(f"*BOUNDARY\n 1001, 1, 1, {DRIFT * k:.16g}\n 1001, 3, 3, {0.3 * k:.16g}") for k in range(1, 7))
    return join(
        heading(
            "Cantilever pressed against a clamped beam: Zavarise and Wriggers (2000), Example 2, frictionless",
            f"Model   E = 1e8, nu = 0, A = 4e-2, I = 2e-4, G A = 2e6, radius 0.2; {n_beam} and {n_cantilever} B31",
            "Expect  forces 17.199, 34.100, 50.582, 66.533 in steps 3 to 6 (the paper: 17.2, 34.3, 51.3, 68.4)",
        ),
        chain(beam, "B31", "BEAM"),
        chain(cantilever, "B31", "CANTILEVER", 1001),
        "*MATERIAL, NAME=BAR\n*ELASTIC\n 1.e8, 0.",
        *sections,
        f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {PENALTY}",
        "*CONTACT PAIR, INTERACTION=TOUCH\n CANTILEVER, BEAM",
        f"*BOUNDARY\n 1, ENCASTRE\n {n_beam + 1}, ENCASTRE\n 1001, 2\n 1001, 4, 6",
        *motion,
    )


def exact(steps=STEPS, drifting_steps=6):
    """Solutions at some steps, which may be fractions: seen from the driven end, the beam lies ahead and above.

    The driven end drifts along the cantilever in the first `drifting_steps` only.
    """
    compliance = crossed_wires.deflection("clamped", 10.0, 5.0, 5.0, ei=EI, ga=GA)
    found, states = None, []
    for k in np.concatenate([[2.2, 2.5], np.atleast_1d(steps)]):
        line = (10.0 + DRIFT * min(k, drifting_steps), 1.0 - 0.3 * k)
        found = pushed_cantilever.solve(
            line, 14.0, 2 * RADIUS, PENALTY, ei=EI, ea=EA, ga=GA, support_compliance=compliance, start=found
        )
        states.append(found)
    return states[2:]


def state(results, n_cantilever, k):
    """Force, gap and arc length of the contact from the driven end, after a step."""
    contact = results.contacts_at(results.index(k, 1))
    arc = (contact["element_1"][0] - 1000.5 + contact["xi_1"][0] / 2) * 14.0 / n_cantilever
    return [float(contact["force"][0]), float(contact["gap"][0]), float(arc)]


def measure(workspace):
    meshes = MESHES[1:] if not workspace.quick else MESHES[1:2]
    runs = {mesh: workspace.run(f"mesh_{mesh[1]}", deck(*mesh)) for mesh in meshes}
    states = {mesh: np.array([state(run, mesh[1], k) for k in STEPS]) for mesh, run in runs.items()}
    values = {"pressed_cantilever.iterations": iterations(runs[MESHES[1]])[0]}
    if workspace.quick:
        return values | {"figure": {}}
    limit = (4 * states[MESHES[2]] - states[MESHES[1]]) / 3
    for i, name in enumerate(("force", "gap", "arc")):
        values[f"pressed_cantilever.{name}"] = limit[:, i].tolist()
    coarse = workspace.run("mesh_28", deck(*MESHES[0]))
    forces = [state(coarse, 28, k)[0] for k in STEPS]
    values["pressed_cantilever.paper"] = forces
    values["pressed_cantilever.grazing"] = float(coarse.contacts_at(coarse.index(2, 1))["force"].sum())
    truth = exact((6,))[0].force
    errors = [abs(state(run, mesh[1], 6)[0] / truth - 1) for mesh, run in {MESHES[0]: coarse, **runs}.items()]
    return values | {"figure": {"errors": errors, "coarse": forces}}


def draw(values, path):
    figure = values["figure"]
    if not figure:
        return
    with figures.panels(path, columns=3) as (force, difference, error):
        steps = np.linspace(2.05, 6, 30)
        truth, no_drift = (np.array([s.force for s in exact(steps, drifting)]) for drifting in (6, 3))
        at_steps = np.array([s.force for s in exact()])
        force.plot(steps, truth, label="exact, data as transcribed", **figures.REFERENCE)
        difference.axhline(0.0, **figures.REFERENCE)
        above = 100 * (no_drift / truth - 1)
        difference.plot(steps, above, ":", label="exact, no drift after step 3", **figures.REFERENCE)
        paper = {"marker": "x", "linestyle": "none", "color": "#555555", "label": "paper, Fig. 7"}
        litz = {"linestyle": "none", "fillstyle": "none", "label": "litz, the source's mesh", **figures.STYLES["B31"]}
        for values_of, style in ((PAPER, paper), (figure["coarse"], litz)):
            force.plot(STEPS, values_of, **style)
            difference.plot(STEPS, 100 * (values_of / at_steps - 1), **style)
        force.set(xlabel="step", ylabel="contact force")
        force.legend()
        difference.set(xlabel="step", ylabel="difference from exact [%]", xlim=(2.8, 6.2), ylim=(-0.3, 3))
        difference.legend()
        errors = {"B31": figure["errors"]}
        meshes = [mesh[1] for mesh in MESHES]
        figures.convergence(error, meshes, errors, {"B31": 2}, "relative error of the force, step 6")
        error.axhline(STRETCHING, linestyle=":", label="stretching left out", **figures.REFERENCE)
        error.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["pressed_cantilever"]))
