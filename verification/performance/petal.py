"""A petal of 240 strands: as many contacts along lines as a cable has

Three, four, four and five: 240 strands of 0.82 mm in four stages (lays of 80, 140, 190 and 300 mm) in a round jacket, and a
cable of 45 strands in three, with sliding ends, friction and an oxide, and 1 mV from end to end. The jacket begins to shrink:
the first increment is measured, in which strands come to lie on each other. Times are those of an iteration, by the phases of
the run; memory is that of the process.
"""

from dataclasses import dataclass

import numpy as np

from litz import Results, build
from litz.model import FilmSpot, Interaction
from verification import figures

from .growth import exponent
from .process import run_litz

RADIUS, LAYS = 0.41e-3, (80e-3, 140e-3, 190e-3, 300e-3)
STRAND = build.Material("STRAND", young=110e9, poisson=0.3, conductivity=5e9)
#: By how much the void fraction becomes smaller in an increment: a jacket that moves by 0.15 radii of a strand
VOID, INCREMENTS = 1.9e-3, 1
#: Of an increment [s]: damping goes with velocities, and that of `build.compact` is meant for a compaction of a second
TIME = 1 / 16
#: Phases that a contact takes part in
OF_CONTACT = ("search", "contact", "assembly")


@dataclass(frozen=True)
class Cable:
    """What is compacted: bundles of each stage, and length [m]."""

    bundles: tuple
    length: float

    @property
    def name(self):
        return f"{np.prod(self.bundles)}_{1e3 * self.length:.3g}mm"

    def model(self):
        """In a jacket that has begun to shrink."""
        model = build.cable(
            [[members] for members in self.bundles],
            radius=RADIUS,
            lay_lengths=LAYS[: len(self.bundles)],
            length=self.length,
            material=STRAND,
            interaction=Interaction(conductance=FilmSpot(1e-11), friction=0.3),
            ends="sliding",
        )
        size = (np.hypot(model.x[:, 0], model.x[:, 1]) + RADIUS).max()
        metal = np.linalg.norm(np.diff(model.x[model.connectivity], axis=1), axis=2).sum() * RADIUS**2 / self.length
        void = 1 - metal / size**2 - INCREMENTS * VOID
        step = build.compact(model, void, increments=INCREMENTS, total=INCREMENTS * TIME, friction=0.1)
        step.controls("TIME INCREMENTATION", i_c=24, i_l=16, i_g=8)
        model.fix("MINUS", "potential")
        step.potential("PLUS", 1e-3)
        return model


PETAL, FEW = (3, 4, 4, 5), (3, 3, 5)
CABLES = (Cable(FEW, LAYS[2]), Cable(PETAL, LAYS[3] / 8), Cable(PETAL, LAYS[3]))
QUICK_CABLES = (Cable(FEW, 6e-3), Cable(FEW, 12e-3))


def measure(quick, directory):
    rows = []
    for cable in QUICK_CABLES if quick else CABLES:
        model = cable.model()
        run = run_litz(model.write(directory / f"{cable.name}.inp"), directory / cable.name, limit=20000)
        status = Results(directory / cable.name / f"{cable.name}.vtkhdf").status
        iterations = sum(run.iterations)
        rows.append(
            {
                "strands": int(np.prod(cable.bundles)),
                "length": cable.length,
                "elements": len(model.connectivity),
                "contacts": int(max(status["contacts"])),
                "iterations": iterations,
                "iteration": run.newton_seconds / iterations,
                "of_contact": sum(run.phases[phase] for phase in OF_CONTACT) / run.newton_seconds,
                "factorisation": (run.phases["analyse"] + run.phases["factor"] + run.phases["solve"])
                / run.newton_seconds,
                "memory": run.memory,
            }
        )
    return {"sizes": rows}


def petals(values):
    """The rows of the largest cable, in all of its lengths."""
    most = max(row["strands"] for row in values["sizes"])
    return [row for row in values["sizes"] if row["strands"] == most]


def tables(values):
    header = "strands,length [mm],elements,contacts,iterations,an iteration [s],contacts of it,factor of it,memory [GB]"
    lines = [
        [
            row["strands"],
            1e3 * row["length"],
            *(row[key] for key in ("elements", "contacts", "iterations", "iteration", "of_contact", "factorisation")),
            row["memory"] / 1e9,
        ]
        for row in values["sizes"]
    ]
    return [("Cables that are compacted", header.split(","), lines)]


def aims(values):
    rows = petals(values)
    largest = rows[-1]
    found = [
        (f"memory of an element [kB], of {largest['elements']}", largest["memory"] / largest["elements"] / 1e3, 300.0)
    ]
    power = exponent([row["elements"] for row in rows], [row["iteration"] for row in rows])
    if power is not None:
        found.append(("power with which the time of an iteration grows", power, 1.1))
    return found


def draw(values, path):
    with figures.panels(path, columns=1, height=3.6) as axes:
        for strands in sorted({row["strands"] for row in values["sizes"]}):
            rows = [row for row in values["sizes"] if row["strands"] == strands]
            axes.loglog(
                [row["elements"] for row in rows],
                [row["iteration"] for row in rows],
                "o-",
                label=f"{strands} strands",
            )
        axes.set(xlabel="elements", ylabel="time of an iteration [s]")
        axes.legend()
