"""Contact search alone: time and pairs found over the number of elements, at constant density.

    python -m verification.performance.search [SIZES ...]

Elements of mixed radii and lengths lie at random in a box that grows with their number. Prints a JSON object: for each
size the pairs, the seconds (median of several runs) and the microseconds per element and core, and the exponent of
the growth from the second size on.
"""

import json
import os
import statistics
import sys
import time

import numpy as np

from litz import kernels


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


def measure(sizes=(10_000, 100_000, 1_000_000), repetitions=5, skin=0.2):
    """Time of the search for each size; `skin` is the distance of surfaces [mean radius] up to which a pair counts."""
    cores = int(os.environ.get("OMP_NUM_THREADS", os.cpu_count()))
    rows = []
    for n in sizes:
        x, connectivity, radius = random_elements(n)
        seconds = []
        for _ in range(repetitions):
            start = time.perf_counter()
            pairs = kernels.contact_search(x, connectivity, radius, skin=skin)
            seconds.append(time.perf_counter() - start)
        median = statistics.median(seconds)
        rows.append(
            {
                "elements": n,
                "pairs": len(pairs),
                "seconds": median,
                "microseconds_per_element_and_core": 1e6 * median * cores / n,
            }
        )
    size, time_ = (np.log([row[key] for row in rows]) for key in ("elements", "seconds"))
    exponent = float(np.polyfit(size, time_, 1)[0]) if len(rows) > 1 else None
    return {"cores": cores, "sizes": rows, "exponent": exponent}


if __name__ == "__main__":
    print(json.dumps(measure(*([tuple(map(int, sys.argv[1:]))] if sys.argv[1:] else [])), indent=1))
