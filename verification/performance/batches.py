"""Kernels called from Python for many elements at once, over a loop of single calls

Pairs of crossed wires that overlap, points of line contact and beams, in arrays of `numpy`: microseconds per element of one
call for all of them, with the tangents and without, on one thread and on all; and of a loop of calls for one. The arrays of
tangents are made anew by each call. Medians.
"""

import json
import os
import statistics
import subprocess
import sys
import time

import numpy as np

from litz import kernels
from verification import figures

from .process import CORES

N, QUICK_N = 20_000, 2_000
#: Elements of the loop of single calls
IN_A_LOOP = 300
WIRES = {"radius": 1e-3, "young": 120e9, "poisson": 0.34, "resistivity": 1.7e-8}
#: What `contact_em` takes with the laws of the paper, and with those of Hertz and Holm
PAPER = {"eps_n": 1e7, "spot_law": "paper"}
HERTZ = {"normal_law": "hertz", "spot_law": "hertz"}


def crossings(n):
    """Crossed pairs that overlap by a tenth to a fifth of a radius."""
    rng = np.random.default_rng(1)
    x = np.array([[-1e-2, 0, 1.85e-3], [1e-2, 0, 1.85e-3], [0, -1e-2, 0], [0, 1e-2, 0]])
    x = x + rng.uniform(-2e-5, 2e-5, (n, 4, 3))
    t = np.array([[1.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]])
    return {"x": x, "t": np.tile(t, (n, 1, 1)), "length": np.full((n, 2), 2e-2), "v": rng.uniform(0, 1e-3, (n, 4))}


def beams(n):
    """Beams that are bent and stretched a little."""
    rng = np.random.default_rng(2)
    x0 = np.tile([[0.0, 0, 0], [1, 0, 0]], (n, 1, 1))
    triads = np.tile(np.eye(3), (n, 2, 1, 1))
    return {"x": x0 + rng.uniform(-1e-2, 1e-2, x0.shape), "triads": triads, "x0": x0, "triads0": triads}


def cases(n):
    """Name, kernel, arguments that each element has of its own, arguments that all share."""
    line = {"weight": 1e-3, "xi": 0.0, "eps_l": 1e9}
    section = dict.fromkeys(("ea", "ga2", "ga3", "gj", "ei2", "ei3"), 1.0)
    return [
        ("contact_em, paper", kernels.contact_em, crossings(n), WIRES | PAPER),
        ("contact_em, Hertz", kernels.contact_em, crossings(n), WIRES | HERTZ),
        ("line_point", kernels.line_point, crossings(n), WIRES | line),
        ("beam_b31", kernels.beam_b31, beams(n), section),
    ]


def microseconds(call, n, repetitions):
    seconds = []
    for _ in range(repetitions + 1):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    # the first call does not count
    return 1e6 * statistics.median(seconds[1:]) / n


def time_cases(n, repetitions):
    """Microseconds per element of each case."""
    found = {}
    for name, kernel, own, shared in cases(n):
        few = [{key: value[i] for key, value in own.items()} for i in range(IN_A_LOOP)]

        def loop(kernel=kernel, few=few, shared=shared):
            for one in few:
                kernel(**one, **shared)

        found[name] = {
            "batch": microseconds(lambda k=kernel, o=own, s=shared: k(**o, **s), n, repetitions),
            "without_tangent": microseconds(
                lambda k=kernel, o=own, s=shared: k(**o, **s, tangent=False), n, repetitions
            ),
            "loop": microseconds(loop, IN_A_LOOP, repetitions),
        }
    return found


def measure(quick, directory):
    found = {}
    for threads in sorted({1, CORES}):
        environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
        command = [sys.executable, "-m", "verification.performance.batches", str(QUICK_N if quick else N)]
        done = subprocess.run(
            [*command, "3" if quick else "7"], env=environment, capture_output=True, text=True, check=True
        )
        found[f"threads_{threads}"] = json.loads(done.stdout)
    return {"elements": QUICK_N if quick else N, "threads": found}


def tables(values):
    lines = [
        [name, threads.removeprefix("threads_"), *row.values(), row["loop"] / row["batch"]]
        for threads, rows in values["threads"].items()
        for name, row in rows.items()
    ]
    header = ["kernel", "threads", "in one call", "without tangents", "in a loop", "loop over one call"]
    return [(f"Microseconds per element, {values['elements']} elements", header, lines)]


def aims(values):
    fastest = values["threads"][max(values["threads"], key=lambda name: int(name.removeprefix("threads_")))]
    wanted = [
        (f"{name}, microseconds per pair in one call", fastest[name]["batch"], 2.0)
        for name in fastest
        if name.startswith("contact_em")
    ]
    return wanted + [
        (f"{name}, one call over a loop", row["batch"] / row["loop"], 0.1) for name, row in fastest.items()
    ]


def draw(values, path):
    with figures.panels(path, columns=1) as axes:
        rows = next(iter(values["threads"].values()))
        places = np.arange(len(rows))
        for i, kind in enumerate(("loop", "batch", "without_tangent")):
            axes.bar(places + 0.25 * i, [row[kind] for row in rows.values()], 0.25, label=kind.replace("_", " "))
        axes.set_xticks(places + 0.25, list(rows))
        axes.set(yscale="log", ylabel="microseconds per element, one thread")
        axes.legend()


if __name__ == "__main__":
    print(json.dumps(time_cases(int(sys.argv[1]), int(sys.argv[2]))))
