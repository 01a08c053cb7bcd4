"""Strands in contact along lines, beside grids of crossings

A strand of 1 + 6 + 12 steel wires, the layers laid in opposite directions, between two clamps: pulled by 0.1 %, without friction,
and with friction 0.2 also let go. It touches along the helices of its core, between the neighbours of a layer, and where the
layers cross at small angles. A grid of wires that cross at right angles is pressed with the same friction, in turn with the
strand. The cost of a contact is the time of search, contact and assembly over the iterations and the contacts that are
closed: places of lines here, crossings there. Places that are near and open are not counted, although they cost, too.
"""

import numpy as np

from litz import Results, build
from verification import figures

from .process import median, run_litz

STEEL = build.Material("STEEL", young=200e9, poisson=0.3)
RADII, LAYS, PULL = (0.52e-3, 0.5e-3, 0.5e-3), (50e-3, 80e-3), 1e-3
#: Lengths of the strands [m]; the last one is two lays of the outer layer
LENGTHS, QUICK_LENGTHS = (40e-3, 160e-3), (10e-3,)
#: Wires of each layer of the grid
WIRES, QUICK_WIRES = 40, 12
FRICTION = (0.0, 0.2)
#: Phases in which a contact takes part, besides the factorisation
OF_CONTACT = ("search", "contact", "assembly")


def strand(length, friction):
    """A strand between clamps that is pulled; with friction it is let go again."""
    model = build.strand(
        [1, 6, 12],
        radius=RADII,
        lay_length=LAYS,
        direction="SZ",
        length=length,
        enlarge=True,
        material=STEEL,
        interaction=build.Interaction(friction=friction) if friction else build.Interaction(),
    )
    model.supports = []
    model.fix(model.rigid_body((0, 0, 0), tie="MINUS"), "encastre")
    model.node_set("CLAMP", model.rigid_body((0, 0, length), tie="PLUS"))
    pull = model.step("PULL", increment=0.1)
    pull.hold("CLAMP", "x", "y", "rotations")
    pull.move("CLAMP", "z", PULL * length)
    if friction:
        model.step("RELEASE", increment=0.1).move("CLAMP", "z", 0.0)
    return model


def grid(wires, friction):
    """Wires that cross at right angles, all nodes of one layer pressed against the other, so that all crossings close."""
    model = build.wire_grid(
        wires,
        wires,
        pitch=5e-3,
        radius=RADII[-1],
        elements_per_pitch=1,
        supports="ends",
        material=STEEL,
        interaction=build.Interaction(friction=friction) if friction else build.Interaction(),
    )
    model.supports = []
    model.fix("LOWER", "pinned")
    step = model.step("PRESS", increment=0.1)
    step.hold("LOWER_ENDS", "rotations")
    step.hold("UPPER_ENDS", "rotations")
    step.hold("UPPER", "x", "y")
    step.move("UPPER", "z", -1e-3 * RADII[-1])
    return model


def runs_of(models, directory, repetitions):
    """What runs of models, by their names, took in turn, and what a contact of each costs."""
    decks = {name: model.write(directory / f"{name}.inp") for name, model in models.items()}
    runs = {name: [] for name in models}
    for _ in range(repetitions):
        for name, deck in decks.items():
            runs[name].append(run_litz(deck, directory / name))
    return {name: summary(name, models[name], directory, runs[name]) for name in models}


def summary(name, model, directory, runs):
    """What runs of a model took, and what a contact of it costs."""
    status = Results(directory / name / f"{name}.vtkhdf").status
    iterations = np.array(runs[0].iterations)
    closed = sum(iterations * np.array(status["contacts"]))
    return {
        "elements": len(model.connectivity),
        "contacts": int(max(status["contacts"])),
        "increments": len(iterations),
        "iterations": int(iterations.sum()),
        "seconds": median(runs, lambda run: run.run.seconds),
        "per_contact": median(runs, lambda run: sum(run.phases[phase] for phase in OF_CONTACT)) / float(closed),
        "memory": max(run.memory for run in runs),
    }


def measure(quick, directory):
    rows = []
    for friction in FRICTION:
        crossing = f"grid_{friction}"
        models = {crossing: grid(QUICK_WIRES if quick else WIRES, friction)}
        for length in QUICK_LENGTHS if quick else LENGTHS:
            models[f"strand_{1e3 * length:.0f}_{friction}"] = strand(length, friction)
        found = runs_of(models, directory, 1 if quick else 3)
        for name, row in found.items():
            ratio = row["per_contact"] / found[crossing]["per_contact"]
            rows.append({"what": name.partition("_")[0], "friction": friction, **row, "over_crossing": ratio})
    return {"sizes": rows}


def tables(values):
    header = (
        "model,friction,elements,contacts,increments,iterations,time [s],a contact [us],over a crossing,memory [MB]"
    )
    lines = [
        [
            *(row[key] for key in ("what", "friction", "elements", "contacts", "increments", "iterations", "seconds")),
            1e6 * row["per_contact"],
            row["over_crossing"],
            row["memory"] / 1e6,
        ]
        for row in values["sizes"]
    ]
    return [("Time of contacts", header.split(","), lines)]


def aims(values):
    found = []
    for row in values["sizes"]:
        if row["what"] == "strand":
            label = f"{row['elements']} elements, friction {row['friction']}"
            found.append((f"cost of a closed place over that of a crossing, {label}", row["over_crossing"], 1.0))
            # pulled in 20 s, and let go in as much again
            if row["contacts"] > 10_000:
                found.append((f"time of the strand [s], {label}", row["seconds"], 40.0 if row["friction"] else 20.0))
    return found


def draw(values, path):
    with figures.panels(path, columns=1, height=3.6) as axes:
        for friction, style in zip(FRICTION, ("o-", "s--"), strict=True):
            rows = [row for row in values["sizes"] if row["what"] == "strand" and row["friction"] == friction]
            axes.loglog(
                [row["contacts"] for row in rows], [row["seconds"] for row in rows], style, label=f"friction {friction}"
            )
        axes.set(xlabel="contacts", ylabel="time [s]")
        axes.legend()
