"""What temperatures add to the time of an increment

A layered mat of nichrome fibres has been pressed between two electrodes and is pressed further, with its currents alone
(`*STATIC`) or with the heat that they make (`*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, STEADY STATE`), which raises its
temperatures and lengthens its fibres: motions and temperatures in one Newton step, or in turns (`COUPLING=UPDATED`).
Friction holds the fibres: without it a mat of 10^4 elements snaps as it is pressed.
The time of the first step, of a run that ends with it, is taken off; that of reading,
preparation and output does not count. Runs alternate, medians.
"""

from dataclasses import replace

from litz import build
from litz.model import HERTZ_AND_HOLM, GapConductance
from verification import figures

from .process import OUTSIDE, median, run_litz

LAYERS, RADIUS, VOLTAGE, ROOM, FRICTION = 4, 0.1e-3, 0.005, 293.15, 0.3
#: By how much the mat is pressed at the end of the first and of the second step [m]
CLOSED, PRESSED = 32e-6, 36e-6
#: Side of the smallest mat [m], elements of each of its fibres and bars of each of its plates
SIDE, ELEMENTS, BARS = 10e-3, 12, 6
#: Fibres of each layer; they cross the whole mat, whose side grows with their number
SMALLEST = 6
SIZES = (16, 27)
QUICK_SIZES = (16,)
CLOSING_INCREMENTS, INCREMENTS = 8, 4
NICHROME = build.Material(
    "NICHROME", young=220e9, poisson=0.3, conductivity=0.9e6, thermal_conductivity=11.3, expansion=14e-6
)
STATIC, COUPLED = "STATIC", "COUPLED TEMPERATURE-DISPLACEMENT"
TURNS = "TURNS"


def mat(per_layer, procedure):
    """Model of a mat that is pressed, and pressed further by a step of the procedure; None: not further."""
    share = per_layer / SMALLEST
    model = build.fibre_mat(
        (SIDE * share, SIDE * share),
        per_layer,
        radius=RADIUS,
        seed=1,
        n_layers=LAYERS,
        clearance=5e-6,
        spread=0.1,
        n_elements=round(ELEMENTS * share),
        n_bars=round(BARS * share),
        material=NICHROME,
        interaction=replace(HERTZ_AND_HOLM, friction=FRICTION, heat=GapConductance("CONDUCTIVITY")),
    )
    model.initial_temperature(ROOM)
    model.press(CLOSED, voltage=VOLTAGE, increment=1 / CLOSING_INCREMENTS)
    if procedure is None:
        return model
    options = {} if procedure == STATIC else {"procedure": COUPLED, "steady_state": True}
    step = model.press(PRESSED, voltage=VOLTAGE, name="FURTHER", increment=1 / INCREMENTS, **options)
    if procedure == TURNS:
        step.solver("BLOCK", coupling="UPDATED")
    if procedure != STATIC:
        for electrode in ("PLATE_BOTTOM", "PLATE_TOP"):
            step.temperature(electrode, ROOM)
    return model


def measure(quick, directory):
    rows = []
    for per_layer in QUICK_SIZES if quick else SIZES:
        decks = {}
        for name in (None, STATIC, COUPLED, TURNS):
            model = mat(per_layer, name)
            decks[name] = model.write(directory / f"mat_{per_layer}_{(name or 'closed').split()[0].lower()}.inp")
        runs = {name: [] for name in decks}
        for _ in range(1 if quick else 3):
            for name, deck in decks.items():
                runs[name].append(run_litz(deck, directory / deck.stem))
        row = {"fibres": per_layer * LAYERS, "elements": len(model.connectivity)}
        for name in (STATIC, COUPLED, TURNS):
            row[name] = beyond(runs[name], runs[None])
        alone = row[STATIC]["seconds_per_increment"]
        row["ratio"] = {name: row[name]["seconds_per_increment"] / alone for name in (STATIC, COUPLED, TURNS)}
        rows.append(row)
    return {"sizes": rows}


def beyond(runs, before):
    """Iterations and times of the last step of runs, beyond those of runs that end before it."""
    iterations = runs[0].iterations[len(before[0].iterations) :]
    phases = {
        phase: median(runs, lambda run, phase=phase: run.phases[phase])
        - median(before, lambda run, phase=phase: run.phases[phase])
        for phase in runs[0].phases
        if phase not in OUTSIDE
    }
    return {
        "increments": len(iterations),
        "iterations": sum(iterations),
        "seconds_per_increment": sum(phases.values()) / INCREMENTS,
        "phases": {phase: seconds / INCREMENTS for phase, seconds in phases.items()},
    }


def tables(values):
    header = ["elements", "procedure", "increments", "iterations", "per increment [s]", "over STATIC"]
    lines, shares = [], []
    for row in values["sizes"]:
        for name in (STATIC, COUPLED, TURNS):
            run, ratio = row[name], row["ratio"][name]
            lines.append(
                [row["elements"], name, run["increments"], run["iterations"], run["seconds_per_increment"], ratio]
            )
        shares += [
            [row["elements"], phase, *(row[name]["phases"][phase] for name in (STATIC, COUPLED, TURNS))]
            for phase in row[STATIC]["phases"]
        ]
    return [
        ("Time of an increment", header, lines),
        ("Seconds of its phases", ["elements", "phase", STATIC, COUPLED, TURNS], shares),
    ]


def aims(values):
    return [
        (f"{row['elements']} elements: coupled increment over one without temperatures", row["ratio"][COUPLED], 1.5)
        for row in values["sizes"]
    ]


def draw(values, path):
    with figures.panels(path, columns=1, height=3.6) as axes:
        labels = [
            f"{row['elements']}, {name.split()[0].lower()}"
            for row in values["sizes"]
            for name in (STATIC, COUPLED, TURNS)
        ]
        runs = [row[name] for row in values["sizes"] for name in (STATIC, COUPLED, TURNS)]
        bottom = [0.0] * len(runs)
        for phase in runs[0]["phases"]:
            part = [run["phases"][phase] for run in runs]
            axes.bar(labels, part, bottom=bottom, label=phase)
            bottom = [a + b for a, b in zip(bottom, part, strict=True)]
        axes.set(ylabel="time of an increment [s]")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=4)
