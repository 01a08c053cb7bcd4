"""Strut lattices of 10^3, 10^4 and 10^5 elements against other programs

The same network, load and five equal increments for all programs; runs alternate, medians. litz and OpenSees stop at the same
largest residual force (1e-8 of the largest nodal force), Kratos and Exudyn at their own norms of it. Every program may use
all cores. Time of litz: the whole process with reading and writing of files; of the others: their increments only, without
the start of Python and the building of the model. Memory: most of the process. Of OpenSees' sparse solvers the fastest one
counts. A program that needs more than its limit of time is stopped after the increment, and compared by iteration.
"""

import statistics

import numpy as np

from verification import figures

from . import peers
from .growth import exponent
from .lattice import POISSON, RADIUS, STRAIN, YOUNG, lattice, lattice_deck
from .process import median, run_litz

SIZES = (1_000, 10_000, 100_000)
QUICK_SIZES = (1_000, 3_000)
#: OpenSees' sparse direct solvers for unsymmetric and symmetric matrices
SOLVERS = ("Mumps", "UmfPack")
#: Sizes up to which a program is run, and seconds after which one run is stopped
LARGEST = {"OpenSeesPy": 200_000, "Kratos": 2_000, "Exudyn": 2_000}
LIMIT = 240.0
#: Time of an iteration and in all over OpenSees' that were wanted, by the number of elements
AIMS = {1_000: (1 / 4, 1 / 6), 10_000: (1 / 8, 1 / 12), 100_000: (1 / 4, 1 / 6)}


def allowed_force(directory, stem):
    """Largest residual force at which litz stopped its last increment [N]."""
    head, *_, last = (directory / f"{stem}.cvg").read_text(encoding="utf-8").splitlines()
    # the name of the run may stand before the columns
    return float(last.split()[[word.partition("[")[0] for word in head.split()].index("force_allowed")])


def write_problem(path, n, tolerance, increments=5, per_strut=2):
    """The lattice as the problem file of the other programs."""
    nodes, elements, height = lattice(n, per_strut=per_strut)
    bottom, top = np.flatnonzero(nodes[:, 2] == 0.0), np.flatnonzero(nodes[:, 2] == height)
    held = [(node, dof) for node in bottom for dof in range(6)]
    held += [(node, dof) for node in top for dof in (0, 1, 3, 4, 5)]
    peers.write_frame(
        path,
        nodes=nodes,
        elements=elements,
        radius=np.full(len(elements), RADIUS),
        wire=np.arange(len(elements)) // per_strut,
        young=YOUNG,
        poisson=POISSON,
        held=np.array(held),
        moved=np.array([(node, 2) for node in top]),
        value=np.full(len(top), -STRAIN * height),
        increments=increments,
        tolerance=tolerance,
        links=np.empty((0, 2), dtype=int),
        gap=np.empty(0),
        penalty=0.0,
    )


def reaction(directory, stem):
    """Sum of the reactions along z on the top at the last increment [N]."""
    head, *_, last = (directory / f"{stem}_history.csv").read_text(encoding="utf-8").splitlines()
    names = [name.strip().lower() for name in head.split(",")]
    column = next(i for i, name in enumerate(names) if "rf" in name and ("3" in name or "z" in name))
    return float(last.split(",")[column])


def programs_for(size, best):
    """Programs and solvers to run at a size; of OpenSees only the fastest solver where one is known."""
    solvers = SOLVERS if size < 20_000 or best is None else (best,)
    wanted = [("OpenSeesPy", solver) for solver in solvers] + [("Kratos", ""), ("Exudyn", "")]
    return [(name, solver) for name, solver in wanted if size <= LARGEST[name]]


def measure(quick, directory):
    rows, best = [], None
    for size in QUICK_SIZES if quick else SIZES:
        text, elements = lattice_deck(size)
        stem = f"lattice_{elements}"
        deck, problem = directory / f"{stem}.inp", directory / f"{stem}.npz"
        deck.write_text(text, encoding="utf-8")
        results = directory / stem
        run_litz(deck, results)
        write_problem(problem, size, allowed_force(results, stem))
        programs = programs_for(size, best)
        ours, others = [], {program: [] for program in programs}
        for i in range(1 if quick or size > 20_000 else 3):
            ours.append(run_litz(deck, results))
            for name, solver in programs:
                # a run of minutes is not repeated
                if i == 0 or others[name, solver][0].run.seconds < 60:
                    others[name, solver].append(
                        peers.run_peer(name, problem, *([solver] if solver else []), limit=LIMIT)
                    )
                    ours.append(run_litz(deck, results))
        row = {"elements": elements, "litz": ours_row(ours, reaction(results, stem)), "others": []}
        for (name, solver), runs in others.items():
            row["others"].append(other_row(name, solver, runs, row["litz"]))
        open_sees = [o for o in row["others"] if o["program"] == "OpenSeesPy" and o.get("seconds_per_iteration")]
        if open_sees:
            best = min(open_sees, key=lambda o: o["seconds_per_iteration"])["solver"]
        rows.append(row)
    return {"sizes": rows, "growth": growth(rows)}


def ours_row(runs, force):
    iterations = sum(runs[0].iterations)
    return {
        "seconds": median(runs, lambda run: run.run.seconds),
        "spread": [min(run.run.seconds for run in runs), max(run.run.seconds for run in runs)],
        "runs": len(runs),
        "iterations": iterations,
        "seconds_per_iteration": median(runs, lambda run: run.newton_seconds) / iterations,
        "memory": max(run.memory for run in runs),
        "reaction": force,
    }


def other_row(name, solver, runs, ours):
    row = {"program": name, "version": peers.version(name), "solver": solver, "runs": len(runs)}
    good = [run for run in runs if run.result]
    if not good:
        last = [line for line in runs[-1].run.printed.splitlines() if line.strip()][-1:]
        return row | {"failed": f"code {runs[-1].run.code}: {' '.join(last)[:120]}"}
    result = good[0].result
    iterations = sum(result["iterations"]) + result["in_vain"]
    row |= {
        "finished": result["finished"],
        "increments": len(result["iterations"]),
        "iterations": iterations,
        "seconds": statistics.median(run.result["seconds"] for run in good),
        "memory": max(run.result["memory"] for run in good),
        "reaction": result["reactions"][-1] if result["reactions"] else None,
        "in_vain": result["in_vain"],
    }
    row["seconds_per_iteration"] = row["seconds"] / iterations
    row["time_ratio"] = row["seconds"] / ours["seconds"] if row["finished"] else None
    row["iteration_ratio"] = row["seconds_per_iteration"] / ours["seconds_per_iteration"]
    row["memory_ratio"] = row["memory"] / ours["memory"]
    return row


def growth(rows):
    """Exponents of time and memory from the second size on."""
    sizes = [row["elements"] for row in rows]
    found = {"litz": {key: exponent(sizes, [row["litz"][key] for row in rows]) for key in ("seconds", "memory")}}
    for name in LARGEST:
        of_name = [
            (row["elements"], min(o["seconds_per_iteration"] for o in matches), min(o["memory"] for o in matches))
            for row in rows
            if (matches := [o for o in row["others"] if o["program"] == name and "memory" in o])
        ]
        if len(of_name) > 1:
            n, seconds, memory = zip(*of_name, strict=True)
            found[name] = {"seconds_per_iteration": exponent(n, seconds), "memory": exponent(n, memory)}
    n = [row["elements"] for row in rows]
    found["litz"]["seconds_per_iteration"] = exponent(n, [row["litz"]["seconds_per_iteration"] for row in rows])
    return found


def tables(values):
    header = (
        "elements,program,iterations,time [s],per iteration [s],memory [MB],time / litz,iteration / litz,memory / litz"
    )
    lines = []
    for row in values["sizes"]:
        ours = row["litz"]
        lines.append([row["elements"], "litz", *_figures(ours), 1, 1, 1])
        for other in row["others"]:
            name = " ".join(filter(None, (other["program"], other["version"], other["solver"])))
            if "failed" in other:
                lines.append([row["elements"], name, other["failed"], *[None] * 6])
                continue
            if other["in_vain"]:
                name += f" (no solution of increment {other['increments'] + 1} in {other['in_vain']} iterations)"
            elif not other["finished"]:
                name += f" (stopped after increment {other['increments']})"
            ratios = (other[key] for key in ("time_ratio", "iteration_ratio", "memory_ratio"))
            lines.append([row["elements"], name, *_figures(other), *ratios])
    growths = [[name, *(g.get(key) for key in _GROWTH)] for name, g in values["growth"].items()]
    return [
        ("Time and memory", header.split(","), lines),
        (
            "Exponents of the growth with the number of elements",
            ["program", "time", "time per iteration", "memory"],
            growths,
        ),
    ]


_GROWTH = ("seconds", "seconds_per_iteration", "memory")


def _figures(row):
    return row["iterations"], row["seconds"], row["seconds_per_iteration"], row["memory"] / 1e6


def aims(values):
    """What was wanted of the networks that OpenSees ran, and what came."""
    found = []
    for row in values["sizes"]:
        runs = [o for o in row["others"] if o["program"] == "OpenSeesPy" and "memory" in o]
        if not runs:
            continue
        best = min(runs, key=lambda o: o["seconds_per_iteration"])
        n = row["elements"]
        of_iteration, in_all = AIMS[min(AIMS, key=lambda size: abs(np.log(size / n)))]
        found.append(
            (f"{n} elements: time per iteration over OpenSees' best", 1 / best["iteration_ratio"], of_iteration)
        )
        if best["time_ratio"]:
            found.append((f"{n} elements: time in all over OpenSees' best", 1 / best["time_ratio"], in_all))
        found.append((f"{n} elements: memory over OpenSees'", 1 / min(o["memory_ratio"] for o in runs), 1.0))
    return found


def draw(values, path):
    with figures.panels(path, columns=2) as (time, memory):
        for axes, key, scale, label in (
            (time, "seconds_per_iteration", 1.0, "time per iteration [s]"),
            (memory, "memory", 1e-6, "memory [MB]"),
        ):
            n = [row["elements"] for row in values["sizes"]]
            axes.loglog(n, [scale * row["litz"][key] for row in values["sizes"]], "o-", color="#c4451c", label="litz")
            for name, marker in zip(LARGEST, "s^v", strict=True):
                points = [
                    (row["elements"], scale * min(found))
                    for row in values["sizes"]
                    if (found := [o[key] for o in row["others"] if o["program"] == name and key in o])
                ]
                if points:
                    axes.loglog(*zip(*points, strict=True), marker=marker, label=name)
            axes.set(xlabel="elements", ylabel=label)
        time.legend()
