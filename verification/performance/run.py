"""Run the benchmarks and write the page.

    python -m verification.performance.run [--quick] [-o DIRECTORY] [NAME ...]

A benchmark is a module of this folder whose docstring begins with its title, with
    measure(quick, directory)   everything that was measured, of numbers, texts, lists and dictionaries
    tables(values)              title, names of the columns and lines of each table
    aims(values)                what was wanted: text, measured value, and the bound it should not exceed
    draw(values, path)          a picture
"""

import argparse
import importlib
import json
import subprocess
import sys
import time
import traceback
from pathlib import Path

import matplotlib

from litz.base.program import program_path

from .page import write_page
from .process import machine

#: Their order on the page
BENCHMARKS = (
    "networks",
    "accuracy",
    "pile",
    "mats",
    "strand",
    "petal",
    "search",
    "batches",
    "iteration_profile",
    "factorisation",
    "coupling",
)


def run_benchmark(name, quick, directory):
    """What a benchmark measured, with the load of the machine before and after; what goes wrong is told, not hidden."""
    module = importlib.import_module(f"verification.performance.{name}")
    before, begin = machine()["load_average"], time.monotonic()
    try:
        values = module.measure(quick, directory)
        record = {"values": values, "aims": module.aims(values)}
        module.draw(values, directory / f"{name}.svg")
    except Exception as error:  # the others go on
        (directory / f"{name}_failure.txt").write_text(traceback.format_exc(), encoding="utf-8")
        record = {"failure": f"{type(error).__name__}: {error}"}
    return record | {
        "load_average": [before, machine()["load_average"]],
        "seconds": time.monotonic() - begin,
        "quick": quick,
    }


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="benchmarks", description="Measure time and memory beside other programs.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(BENCHMARKS)}; default: all")
    parser.add_argument("--quick", action="store_true", help="small sizes and few repetitions")
    parser.add_argument("-o", "--output", type=Path, default=Path("results/bench"), metavar="DIRECTORY")
    options = parser.parse_args(arguments)
    if unknown := set(options.names) - set(BENCHMARKS):
        print(
            f"error: there is no benchmark {', '.join(sorted(unknown))}; there are {', '.join(BENCHMARKS)}",
            file=sys.stderr,
        )
        return 2
    matplotlib.use("Agg")
    options.output.mkdir(parents=True, exist_ok=True)
    directory = options.output.resolve()
    record_path = directory / "bench.json"
    # what was measured before stays on the page
    records = json.loads(record_path.read_text(encoding="utf-8"))["benchmarks"] if record_path.exists() else {}
    for name in options.names or BENCHMARKS:
        print(f"{name} ...", flush=True)
        records[name] = run_benchmark(name, options.quick, directory) | {"machine": machine()}
        if "failure" in records[name]:
            print(f"   failed: {records[name]['failure']}")
        for text, value, bound in records[name].get("aims", ()):
            print(
                f"   {'met   ' if value <= bound else 'MISSED'} {text}: {value:.3g}, aim at most {bound:.3g}",
                flush=True,
            )
        program = subprocess.run([program_path(), "--version"], capture_output=True, text=True, check=True)
        ordered = {known: records[known] for known in BENCHMARKS if known in records}
        document = {"program": " ".join(program.stdout.split()), "benchmarks": ordered}
        record_path.write_text(json.dumps(document, indent=1), encoding="utf-8")
        write_page(document, directory)
    print(f"the page is {options.output / 'bench.html'}")
    return 1 if any("failure" in record for record in records.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
