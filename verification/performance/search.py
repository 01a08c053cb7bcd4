"""Contact search alone: time and pairs found over the number of elements, at constant density

Elements of mixed radii and lengths lie at random in a box that grows with their number. Time per element and core: what
one core does in the time, on one core and on all.
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

from .growth import exponent
from .process import CORES

SIZES = (10_000, 100_000, 1_000_000)
QUICK_SIZES = (10_000, 30_000)


def random_elements(n, seed=1, fraction=0.05, thickest=4.0, longest=4.0):
    """Straight elements in all directions: positions (2 n, 3), connectivity (n, 2), radii (n,).

    Radii and lengths are spread over factors `thickest` and `longest` (each evenly in its logarithm) around 1 and 10,
    and the elements fill the given fraction of the volume.
    """
    rng = np.random.default_rng(seed)
    radius = thickest ** rng.uniform(-0.5, 0.5, n)
    length = 10.0 * longest ** rng.uniform(-0.5, 0.5, n)
    side = (np.sum(np.pi * radius**2 * length) / fraction) ** (1 / 3)
    direction = rng.normal(size=(n, 3))
    direction *= (length / np.linalg.norm(direction, axis=1))[:, None]
    start = rng.uniform(0.0, side, (n, 3))
    x = np.concatenate([start, start + direction])
    return x, np.stack([np.arange(n), n + np.arange(n)], axis=1), radius


def time_search(n, repetitions, skin=0.2):
    """Pairs and seconds of each repetition; `skin` is the distance of surfaces up to which a pair counts."""
    x, connectivity, radius = random_elements(n)
    seconds = []
    for _ in range(repetitions):
        start = time.perf_counter()
        pairs = kernels.contact_search(x, connectivity, radius, skin=skin)
        seconds.append(time.perf_counter() - start)
    return {"pairs": len(pairs), "seconds": seconds}


def measure(quick, directory):
    rows = []
    for n in QUICK_SIZES if quick else SIZES:
        row = {"elements": n}
        for cores in sorted({1, CORES}):
            environment = {**os.environ, "OMP_NUM_THREADS": str(cores)}
            command = [sys.executable, "-m", "verification.performance.search", str(n), "3" if quick else "7"]
            done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
            found = json.loads(done.stdout)
            row["pairs"] = found["pairs"]
            seconds = statistics.median(found["seconds"])
            row[f"cores_{cores}"] = {
                "seconds": seconds,
                "fastest": min(found["seconds"]),
                "microseconds_per_element_and_core": 1e6 * seconds * cores / n,
            }
        rows.append(row)
    n = [row["elements"] for row in rows]
    return {
        "sizes": rows,
        "exponent": {c: exponent(n, [row[f"cores_{c}"]["seconds"] for row in rows]) for c in {1, CORES}},
    }


def tables(values):
    lines = []
    for row in values["sizes"]:
        for key, cores in ((key, key.removeprefix("cores_")) for key in row if key.startswith("cores_")):
            time_ = row[key]
            lines.append([row["elements"], row["pairs"], cores, *time_.values()])
    header = "elements,pairs,cores,time [s],fastest [s],per element and core [microseconds]"
    growth = [[cores, value] for cores, value in values["exponent"].items()]
    return [("Time", header.split(","), lines), ("Exponent of the growth", ["cores", "exponent"], growth)]


def aims(values):
    largest = values["sizes"][-1]
    found = [
        (
            f"microseconds per element and core, {largest['elements']} elements, {key.removeprefix('cores_')} cores",
            largest[key]["microseconds_per_element_and_core"],
            1.0,
        )
        for key in largest
        if key.startswith("cores_")
    ]
    return found + [(f"exponent of growth, {cores} cores", value, 1.1) for cores, value in values["exponent"].items()]


def draw(values, path):
    with figures.panels(path, columns=1) as axes:
        n = [row["elements"] for row in values["sizes"]]
        for key in (key for key in values["sizes"][0] if key.startswith("cores_")):
            cores = key.removeprefix("cores_")
            label = f"{cores} core" + ("s" if cores != "1" else "")
            axes.loglog(n, [row[key]["seconds"] for row in values["sizes"]], "o-", label=label)
        axes.set(xlabel="elements", ylabel="search [s]")
        axes.legend()


if __name__ == "__main__":
    print(json.dumps(time_search(int(sys.argv[1]), int(sys.argv[2]))))
