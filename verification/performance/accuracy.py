"""Strut lattices at equal accuracy, beside OpenSees

The lattice of the first benchmark with more and more elements in each strut, in five increments to 2 %. The limit is the force
on the top that litz finds with 16 elements `B33` in each. The most accurate run of OpenSees that finds a solution is compared
with litz at the fewest elements with which it is as accurate. OpenSees, with both its solvers, stops at the largest residual
force at which litz stopped. Time of litz: the whole process; of OpenSees: the increments only.
"""

import numpy as np

from verification import figures

from . import peers
from .lattice import lattice_deck
from .networks import SOLVERS, allowed_force, reaction, write_problem
from .process import run_litz

#: Elements of a lattice with two in each strut, and how many elements a strut gets; the last gives the limit
SIZES, QUICK_SIZES = (1_000, 10_000), (1_000,)
PER_STRUT = (1, 2, 4, 8, 16)
#: Time in all over OpenSees' that was wanted with 10^4 elements
LARGEST_SHARE = 1 / 12
#: Seconds after which a run of OpenSees is stopped
LIMIT = 600.0


def measure(quick, directory):
    rows = []
    for size in QUICK_SIZES if quick else SIZES:
        ours = {per_strut: run_with(size, per_strut, directory) for per_strut in PER_STRUT}
        limit = ours[PER_STRUT[-1]][0]
        rows.append({"size": size, "limit": limit, "runs": []})
        for per_strut, (force, run, problem, elements) in ours.items():
            common = {"elements": elements, "per_strut": per_strut}
            rows[-1]["runs"].append(
                common
                | {"program": "litz", "deviation": abs(force / limit - 1), "seconds": run.run.seconds}
                | {"iterations": sum(run.iterations), "memory": run.memory}
            )
            for solver in SOLVERS:
                result = peers.run_peer("OpenSeesPy", problem, solver, limit=LIMIT).result
                if result is None or not result["finished"]:
                    continue
                rows[-1]["runs"].append(
                    common
                    | {"program": f"OpenSeesPy {solver}", "deviation": abs(result["reactions"][-1] / limit - 1)}
                    | {"seconds": result["seconds"], "iterations": sum(result["iterations"])}
                    | {"memory": result["memory"]}
                )
    return {"version": peers.version("OpenSeesPy"), "sizes": rows}


def run_with(size, per_strut, directory):
    """Force on the top, the run, the problem file of the other program, and the number of elements."""
    n = size * per_strut // 2
    text, elements = lattice_deck(n, per_strut=per_strut)
    stem = f"accuracy_{size}_{per_strut}"
    deck, problem = directory / f"{stem}.inp", directory / f"{stem}.npz"
    deck.write_text(text, encoding="utf-8")
    run = run_litz(deck, directory / stem)
    write_problem(problem, n, allowed_force(directory / stem, stem), per_strut=per_strut)
    return reaction(directory / stem, stem), run, problem, elements


def compared(runs):
    """The runs of litz and OpenSees at equal accuracy; None: there is none.

    Of OpenSees the fastest of those with the smallest deviation but for round-off, of litz that with the fewest elements which
    is as accurate.
    """
    theirs = [run for run in runs if run["program"].startswith("OpenSeesPy")]
    if not theirs:
        return None, None
    best = 1.001 * min(run["deviation"] for run in theirs)
    other = min((run for run in theirs if run["deviation"] <= best), key=lambda run: run["seconds"])
    good = [run for run in runs if run["program"] == "litz" and run["deviation"] <= other["deviation"]]
    return min(good, key=lambda run: run["per_strut"], default=None), other


def tables(values):
    columns = ["elements", "per strut", "program", "off the limit [%]", "iterations", "time [s]", "memory [MB]"]
    columns += ["time / litz at equal accuracy"]
    found = []
    for row in values["sizes"]:
        ours, _ = compared(row["runs"])
        lines = []
        for run in row["runs"]:
            share = run["seconds"] / ours["seconds"] if ours else None
            of_run = run["elements"], run["per_strut"], run["program"], 100 * run["deviation"], run["iterations"]
            lines.append([*of_run, run["seconds"], run["memory"] / 1e6, share])
        found.append(
            (f"Lattice of {row['size']} elements at two per strut, limit {row['limit']:.6g} N", columns, lines)
        )
    return found


def aims(values):
    found = []
    for row in values["sizes"]:
        ours, theirs = compared(row["runs"])
        name = f"lattice of {row['size']} elements"
        two = [run["deviation"] for run in row["runs"] if run["program"] == "litz" and run["per_strut"] == 2]
        found += [(f"{name}: off the limit with two elements per strut", deviation, 5e-4) for deviation in two]
        if ours and theirs:
            share = ours["seconds"] / theirs["seconds"]
            found.append((f"{name}: time over OpenSees' at equal accuracy", share, LARGEST_SHARE))
    return found


def draw(values, path):
    with figures.panels(path, columns=len(values["sizes"])) as panels:
        for axes, row in zip(np.atleast_1d(panels), values["sizes"], strict=True):
            for program in ("litz", *(f"OpenSeesPy {solver}" for solver in SOLVERS)):
                runs = [run for run in row["runs"] if run["program"] == program]
                axes.semilogy(
                    [100 * run["deviation"] for run in runs], [run["seconds"] for run in runs], "o-", label=program
                )
            axes.set(xlabel="off the limit [%]", ylabel="time [s]", title=f"{row['size']} elements at two per strut")
            axes.legend()
