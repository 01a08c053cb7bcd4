"""The command `litz report`: by itself, as what it needs is loaded while VTK starts."""

import gc
import os
import sys
from importlib import import_module

from ..pictures.drawing_process import ready
from ..pictures.loading import load_matplotlib
from .parsers import results_parser

# Processors that texts and charts keep busy while VTK draws
_FEW = 2


def report_command(arguments: list[str]) -> int:
    """`litz report`: a page about a run."""
    parser = results_parser("report", "Write one HTML page about a run, which needs nothing beside it.")
    parser.add_argument("-o", "--output", metavar="PAGE", help="default: STEM_report.html next to the results")
    options = parser.parse_args(arguments)
    # Linux alone forks without harm, and says how many processors there are for this process
    processes = len(os.sched_getaffinity(0)) if sys.platform == "linux" else 0
    # looking for garbage takes longer than what it finds here is worth
    gc.set_threshold(100_000)
    # to start threads of BLAS, here and where VTK draws, takes longer than what they have to do
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if processes <= _FEW:
        # so do those of Mesa, which would wait for each other: charts are drawn meanwhile
        os.environ.setdefault("LP_NUM_THREADS", "0")
    with ready():
        # VTK starts meanwhile
        results = import_module("..results", __package__).Results(options.results)
        write_report = import_module("..reports.report", __package__).write_report
        page = write_report(results, options.output, processes if processes > 1 else 0, load_matplotlib)
    print(f"report: {page}")
    # what is left ends with the process: to look at all of it for garbage takes a while
    gc.freeze()
    return 0
