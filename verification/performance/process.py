"""Runs of programs with their time and memory, and what the machine was doing meanwhile."""

import functools
import os
import platform
import re
import statistics
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

from litz.base.program import program_environment, program_path

#: Cores that every program may use
CORES = int(os.environ.get("OMP_NUM_THREADS", os.cpu_count()))


@dataclass(frozen=True)
class Run:
    """What one process printed and took."""

    printed: str
    code: int
    #: Wall-clock time from start to end [s]
    seconds: float


@functools.cache
def blas_kernels():
    """The kernels that litz has OpenBLAS take, for other programs that use the OpenBLAS of the system."""
    if "OPENBLAS_CORETYPE" in os.environ:
        return {}
    told = subprocess.run([program_path(), "--version"], capture_output=True, text=True, check=True).stdout
    found = re.search(r"^BLAS: OpenBLAS.* (\w+) MAX_THREADS", told, re.MULTILINE)
    return {"OPENBLAS_CORETYPE": found[1]} if found else {}


def run_process(command, *, limit=3600.0, environment=None):
    """Run a command with all cores and these variables of the environment; it is ended after `limit` seconds."""
    threads = {"OMP_NUM_THREADS": str(CORES), "OPENBLAS_NUM_THREADS": str(CORES)}
    environment = {**program_environment(), **threads, **(environment or {})}
    begin = time.perf_counter()
    with subprocess.Popen(
        ["timeout", str(limit), *map(str, command)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        env=environment,
    ) as process:
        printed = process.stdout.read()
    return Run(printed, process.returncode, time.perf_counter() - begin)


@dataclass(frozen=True)
class LitzRun:
    """A run of litz with its table of times."""

    run: Run
    #: Seconds of each phase, without the total
    phases: dict
    #: Iterations of each increment
    iterations: list
    #: Most memory [bytes]
    memory: float

    @property
    def newton_seconds(self):
        """Time of the iterations: all but reading, preparation and output [s]."""
        return sum(seconds for name, seconds in self.phases.items() if name not in OUTSIDE)


#: Phases that belong to the run, not to its iterations
OUTSIDE = ("reading", "preparation", "output")


def timing_table(text):
    """Seconds of each phase and in all, of the table that `litz run --timing` prints."""
    table = {}
    for line in text[text.index("phase ") :].splitlines()[1:]:
        words = line.split()
        table[words[0]] = float(words[1])
        if words[0] == "total":
            return table
    raise ValueError("the table of times has no total")


def run_litz(deck, directory, *, limit=3600.0):
    """Run a deck; a run that fails is an error."""
    run = run_process([program_path(), "run", deck, "-o", directory, "--timing", "--threads", CORES], limit=limit)
    if run.code != 0:
        raise RuntimeError(f"litz ended with code {run.code} on {deck}:\n{run.printed}")
    phases = timing_table(run.printed)
    del phases["total"]
    status = (Path(directory) / f"{Path(deck).stem}.sta").read_text(encoding="utf-8").splitlines()
    column = status[0].split().index("iterations")
    rows = [line.split() for line in status[1:] if not line.startswith("#")]
    number, unit = run.printed[run.printed.index(", at most ") :].removeprefix(", at most ").split()[:2]
    memory = float(number) * {"MB": 1e6, "GB": 1e9}[unit]
    return LitzRun(run, phases, [int(row[column]) for row in rows], memory)


def median(runs, quantity):
    """Median of a function over runs."""
    return statistics.median(quantity(run) for run in runs)


def machine():
    """Processor, cores, system and load."""
    model = platform.machine()
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.partition(":")[2].strip()
            break
    return {
        "processor": model,
        "cores": CORES,
        "system": platform.platform(),
        "load_average": os.getloadavg()[0],
        "time": time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()),
    }
