"""Where the time of one Newton iteration goes, and the memory, over the number of beam elements.

    python -m verification.performance.iteration_profile [SIZES ...]

Runs the strut lattice for each size (default 1000, 10 000 and 100 000 elements) several times with `litz run --timing`
and prints a JSON object: for each size and phase the median of the seconds per iteration, the share of the phases that
are not the factorisation, the seconds in all, and the most memory per element.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from litz.run import program_path

from .lattice import lattice_deck

#: Phases that belong to the run, not to its iterations
OUTSIDE = ("reading", "preparation", "output")
ANALYSIS = ("analyse", "factor")


def timing_table(text):
    """Seconds of each phase, of the table that `litz run --timing` prints."""
    lines = text[text.index("phase ") :].splitlines()[1:]
    table = {}
    for line in lines:
        words = line.split()
        table[words[0]] = float(words[1])
        if words[0] == "total":
            return table
    raise ValueError("the table of times has no total")


def run_once(deck, directory, threads):
    """Phases [s], iterations and peak memory [bytes] of one run."""
    command = [program_path(), "run", deck, "-o", directory, "--timing", "--threads", str(threads)]
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, text=True) as process:
        printed = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"litz ended with code {process.returncode}:\n{printed}")
    finished = printed[printed.index("finished: ") :].split()
    return timing_table(printed), int(finished[3]), 1024 * usage.ru_maxrss


def measure(sizes=(1_000, 10_000, 100_000), repetitions=3, threads=2):
    """One row per size; see the head of this file."""
    rows = []
    with tempfile.TemporaryDirectory() as directory:
        for size in sizes:
            text, n = lattice_deck(size)
            deck = Path(directory) / f"lattice_{n}.inp"
            deck.write_text(text, encoding="utf-8")
            runs = [run_once(deck, directory, threads) for _ in range(repetitions)]
            iterations = runs[0][1]
            phases = {name: statistics.median(run[0][name] for run in runs) for name in runs[0][0]}
            newton = sum(seconds for name, seconds in phases.items() if name not in (*OUTSIDE, "total"))
            rows.append(
                {
                    "elements": n,
                    "iterations": iterations,
                    "seconds": phases.pop("total"),
                    "seconds_per_iteration": {name: seconds / iterations for name, seconds in phases.items()},
                    "share_besides_factorisation": 1 - sum(phases[name] for name in ANALYSIS) / newton,
                    "bytes_per_element": max(run[2] for run in runs) / n,
                }
            )
    return {"threads": threads, "load_average": os.getloadavg()[0], "sizes": rows}


if __name__ == "__main__":
    print(json.dumps(measure(*([tuple(map(int, sys.argv[1:]))] if sys.argv[1:] else [])), indent=1))
