"""A thin cantilever that a crossing wire pushes far aside: large deflection, sliding contact, very soft penalty.

Source: data of the input deck beam3eb_static_contact_penalty_newgap_twocrossedbeams.dat of the 4C project
(github.com/4C-multiphysics/4C, tests/input_files), with its asserted tip, t = 1: (-1.5842198e-2, -1.7022534e-1).
Values: planar elastica from the clamp to the contact, the contact force normal to the deformed axis, straight beyond
it; references/pushed_cantilever.py. The penalty lets the wires sink into each other by 18 diameters on purpose, so that
the axes pass each other. A contact inside an element misses h^3 (1 - xi^2)^3/(192 E I) of the deflection, 1e-6 of it
with 40 elements: that is where the error of B33 ends.
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step, straight
from verification.references import pushed_cantilever
from verification.workspace import iterations

EI, EA, RADIUS, PENALTY = 8.3333333333e-9, 10.0, 5.70731993e-5, 1e-5
LEVELS = (0.80, 0.85, 0.90, 0.95, 1.00)
MESHES = (10, 20, 40)
#: Tip displacement asserted in the deck of the source, ten cubic elements
PUBLISHED = (-1.58421976019983111e-02, -1.70225340862305785e-01)
#: Iterations of the plain Newton method and of the mixed one in a prototype outside litz: 20 two-node elements,
#: derivatives by automatic differentiation; steps: (plain, mixed)
PROTOTYPE = {1: (24, 5), 2: (25, 6), 5: (22, 12), 10: (32, 21)}


def deck(element, n, increments):
    """The pusher crosses the thin wire at 0.4 of its length and moves by -0.155 along y, in equal increments."""
    pusher = np.array([[0.4, 0.1, -0.5], [0.4, 0.1, 0.5]])
    section = "\n".join(
        line
        for wire in ("THIN", "PUSHER")
        for line in (
            f"*BEAM SECTION, ELSET={wire}, MATERIAL=THREAD, SECTION=GENERAL, CONTACT RADIUS={RADIUS}",
            " 1.e-8, 8.3333333333e-18, 0., 8.3333333333e-18, 1.6666666667e-17",
        )
    )
    return join(
        heading(
            "Thin cantilever pushed aside by a crossing wire",
            f"Model   length 1, E A = 10, E I = 8.3333e-9: {n} {element} elements; penalty 1e-5, consistent units",
            "Source  input deck of the 4C project; planar elastica with a sliding contact",
        ),
        chain(straight(1.0, n), element, "THIN"),
        chain(pusher, element, "PUSHER", 1001),
        "*MATERIAL, NAME=THREAD\n*ELASTIC\n 1.e9, 0.",
        section,
        "*SURFACE INTERACTION, NAME=SOFT",
        f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR, PENETRATION=UNLIMITED\n {PENALTY}",
        "*CONTACT PAIR, INTERACTION=SOFT\n THIN, PUSHER",
        "*BOUNDARY\n 1, ENCASTRE\n PUSHER, 1\n PUSHER, 3, 6",
        step("*BOUNDARY\n PUSHER, 2, 2, -0.155", increments=increments),
    )


def exact(levels=LEVELS):
    """Solutions of the elastica, one for each level."""
    found, states = None, []
    for level in np.concatenate([[0.66, 0.70, 0.75], np.atleast_1d(levels)]):
        line = (0.4, 0.1 - 0.155 * level)
        found = pushed_cantilever.solve(line, 1.0, 2 * RADIUS, PENALTY, ei=EI, ea=EA, start=found)
        states.append(found)
    return states[3:]


def state(results, n, level):
    """Tip displacement (2), force, gap and arc length of the contact at a level."""
    index = int(np.flatnonzero(np.isclose(results.times, level))[0])
    contact = results.contacts_at(index)
    arc = (contact["element_1"][0] - 0.5 + contact["xi_1"][0] / 2) / n
    tip = results.field("displacement", index)[n, :2]
    return [*tip.tolist(), float(contact["force"][0]), float(contact["gap"][0]), float(arc)]


def measure(workspace):
    one_step = workspace.run("B33_40_one", deck("B33", 40, 1))
    values = {
        "pushed_cantilever.one_step": state(one_step, 40, 1.0),
        "pushed_cantilever.one_step.iterations": iterations(one_step)[0],
    }
    if workspace.quick:
        return values | {"figure": {}}
    runs = {(e, n): workspace.run(f"{e}_{n}", deck(e, n, 20)) for e in ("B31", "B33") for n in MESHES}
    states = {key: np.array([state(run, key[1], level) for level in LEVELS]) for key, run in runs.items()}
    for i, name in ((0, "tip_x"), (1, "tip_y"), (2, "force"), (3, "gap"), (4, "arc")):
        values[f"pushed_cantilever.{name}"] = states["B33", 40][:, i].tolist()
    values["pushed_cantilever.ten_elements"] = states["B33", 10][-1, :2].tolist()
    counts = {}
    for increments in PROTOTYPE:
        counts[increments] = iterations(workspace.run(f"B31_20_{increments}_steps", deck("B31", 20, increments)))[0]
    values["pushed_cantilever.iterations"] = [counts[1], counts[2]]
    truth = np.array([[*(s.tip - [1.0, 0.0]), s.force, s.gap, s.arc] for s in exact()])
    errors = {e: [float(np.abs(states[e, n][-1, :2] - truth[-1, :2]).max()) for n in MESHES] for e in ("B31", "B33")}
    values["pushed_cantilever.B31.order"] = float(np.log2(errors["B31"][-2] / errors["B31"][-1]))
    return values | {"figure": {"errors": errors, "counts": counts, "shape": runs["B33", 40].positions(-1)[:41]}}


def draw(values, path):
    figure = values["figure"]
    if not figure:
        return
    with figures.panels(path, columns=3) as (shape, error, count):
        last = exact((1.0,))[0]
        shape.plot(figure["shape"][:, 0], figure["shape"][:, 1], ".", color="#c4451c", label="40 B33")
        shape.plot(*np.array([last.position, last.tip]).T, label="elastica, beyond the contact", **figures.REFERENCE)
        shape.plot(0.4, 0.1 - 0.155, "x", color="#0b62a4", label="axis of the pusher")
        shape.set(xlabel="x", ylabel="y")
        shape.legend()
        for element, errors in figure["errors"].items():
            error.loglog(MESHES, errors, label=element, **figures.STYLES[element])
        figures.order_line(error, MESHES, 2, figure["errors"]["B31"][0])
        error.set(xlabel="elements", ylabel="error of the tip")
        error.legend()
        steps = list(PROTOTYPE)
        for column, name, style in ((0, "plain Newton, prototype", "x--"), (1, "mixed, prototype", "s--")):
            count.plot(steps, [PROTOTYPE[s][column] for s in steps], style, label=name)
        count.plot(steps, [figure["counts"][s] for s in steps], "o-", label="litz")
        count.set(xlabel="load steps", ylabel="iterations in all", ylim=(0, 45))
        count.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["pushed_cantilever"]))
