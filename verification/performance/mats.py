"""Mats with friction, pressed and released

Layered mats of `litz.build` whose gaps are all equal, so that thousands of contacts close at one instant, are pressed by 15 um
beyond that and released, in tenths of either step unless the run takes others, with the settings that `Model.press` has by
itself. The table says how many iterations an increment takes with friction and without, and how many were lost in attempts
that were cut. Without friction some fibres of a large mat slide off sideways: such a run is a snap and needs `STABILIZE`; it is
shown as far as it comes.
"""

import itertools
import math
from pathlib import Path

import litz
from litz import build
from litz.base.program import program_path
from verification import figures

from .process import CORES, run_process

RADIUS, CLEARANCE, LAYERS = 0.1e-3, 5e-6, 4
#: Distance of neighbouring fibres and bars on average, and of the nodes of fibres [m]
PITCH, BAR_PITCH = 1e-3, 1.7e-3
#: Press beyond the first touch [m], and the increments of each step
PRESSED, INCREMENTS = 15e-6, 10
STEEL = build.Material("STEEL", young=200e9, poisson=0.3)
FRICTIONS = (0.0, 0.1, 0.3, 0.6)
#: Fibres of each layer, elements of each fibre, and its largest deviation from the direction of its layer [degrees], with which
#: this seed finds room for all: 10^3, 10^4 and 2 10^4 elements
SEED = 11
SIZES = ((10, 20, 3), (24, 88, 3), (36, 132, 6))
QUICK_SIZES = SIZES[:1]
#: Iterations per increment that were wanted: few increments are pressed, and the first touch is one of them
MOST_ITERATIONS = {"pressed": 12.0, "released": 6.0}
#: Longest run [s]
LIMIT = 900.0


def mat(per_layer, n_elements, spread, friction):
    """A mat that is pressed and released."""
    side = per_layer * PITCH
    model = build.fibre_mat(
        (side, side),
        per_layer,
        radius=RADIUS,
        seed=SEED,
        n_layers=LAYERS,
        spread=math.radians(spread),
        n_elements=n_elements,
        n_bars=round(side / BAR_PITCH),
        clearance=CLEARANCE,
        material=STEEL,
        interaction=build.Interaction(friction=friction),
    )
    model.press((LAYERS + 1) * CLEARANCE + PRESSED, increment=1 / INCREMENTS)
    model.press(0.0, name="RELEASE", increment=1 / INCREMENTS)
    return model


def run_mat(deck, directory):
    """Iterations of a run, pressed and released, whether it reaches its end or not."""
    run = run_process([program_path(), "run", deck, "-o", directory, "--threads", CORES, "--quiet"], limit=LIMIT)
    results = Path(directory) / f"{Path(deck).stem}.vtkhdf"
    lines = [
        line.split()
        for line in results.with_suffix(".sta").read_text(encoding="utf-8").splitlines()[1:]
        if line[0] != "#"
    ]
    # step, attempt, iterations, contacts, and whether the attempt was cut
    attempts = [(int(w[0]), int(w[2]), int(w[3]), int(w[11]), "cut:" in w) for w in lines]
    row = {"finished": run.code == 0, "seconds": run.seconds, "contacts": max(a[3] for a in attempts)}
    for name, step in (("pressed", 1), ("released", 2)):
        touching = [a for a in attempts if a[0] == step and (a[3] > 0 or a[4])]
        kept = [a[2] for a in touching if not a[4]]
        row[name] = {
            "increments": len(kept),
            "iterations": sum(kept),
            "most": max(kept, default=0),
            "cuts": sum(a[4] for a in touching),
            "lost": sum(a[2] for a in touching if a[4]),
        }
    return row


def measure(quick, directory):
    rows = []
    for size, friction in itertools.product(QUICK_SIZES if quick else SIZES, FRICTIONS):
        model = mat(*size, friction)
        stem = f"mat_{size[0]}_{friction}"
        row = run_mat(model.write(directory / f"{stem}.inp"), directory / stem)
        rows.append({"elements": len(model.connectivity), "friction": friction} | row)
    return {"version": litz.__version__, "rows": rows}


def per_increment(of_step):
    """Iterations per increment with contacts, those of cut attempts among them; None: there was none."""
    if not of_step["increments"]:
        return None
    return (of_step["iterations"] + of_step["lost"]) / of_step["increments"]


def tables(values):
    columns = ["elements", "friction", "contacts", "time [s]", "outcome"]
    for step in ("pressed", "released"):
        columns += [
            f"{step}: {text}" for text in ("increments", "iterations each", "most", "cut attempts", "iterations lost")
        ]
    lines = []
    for row in values["rows"]:
        line = [row["elements"], row["friction"], row["contacts"], row["seconds"]]
        line.append("finished" if row["finished"] else "gave up")
        for step in ("pressed", "released"):
            part = row[step]
            line += [part["increments"], per_increment(part), part["most"], part["cuts"], part["lost"]]
        lines.append(line)
    return [("Iterations of increments with contacts; those of attempts that were cut count", columns, lines)]


def aims(values):
    found = []
    for row in values["rows"]:
        if not row["friction"] > 0:
            continue
        name = f"{row['elements']} elements, friction {row['friction']}"
        found.append((f"{name}: steps not finished", float(not row["finished"]), 0.0))
        found += [
            (f"{name}, {step}: iterations per increment", per_increment(row[step]), MOST_ITERATIONS[step])
            for step in MOST_ITERATIONS
            if row[step]["increments"]
        ]
    return found


def draw(values, path):
    with figures.panels(path, columns=2) as panels:
        for axes, step in zip(panels, ("pressed", "released"), strict=True):
            for friction in FRICTIONS:
                points = [
                    (row["elements"], per_increment(row[step]))
                    for row in values["rows"]
                    if row["friction"] == friction and row[step]["increments"]
                ]
                if points:
                    axes.semilogx(*zip(*points, strict=True), "o-", label=f"friction {friction}")
            axes.set(xlabel="elements", ylabel=f"iterations per increment, {step}", ylim=(0, None))
        panels[0].legend()
