"""The command `litz report`: by itself, as what it needs is loaded while VTK starts."""

import os
import sys
from importlib import import_module

from ..pictures.drawing_process import ready
from .parsers import results_parser


def report_command(arguments: list[str]) -> int:
    """`litz report`: a page about a run."""
    parser = results_parser("report", "Write one HTML page about a run, which needs nothing beside it.")
    parser.add_argument("-o", "--output", metavar="PAGE", help="default: STEM_report.html next to the results")
    options = parser.parse_args(arguments)
    # Linux alone forks without harm, and says how many processors there are for this process
    processes = len(os.sched_getaffinity(0)) if sys.platform == "linux" else 0
    with ready():
        # VTK starts meanwhile
        results = import_module("..results", __package__).Results(options.results)
        report = import_module("..reports.report", __package__).report
        page = report(results, options.output, processes=processes if processes > 1 else 0)
    print(f"report: {page}")
    return 0
