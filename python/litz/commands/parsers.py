"""Parsers of the arguments of commands."""

import argparse
import re
import sys
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from ..results import Results


def results_parser(command: str, description: str, epilog: str | None = None) -> argparse.ArgumentParser:
    """A parser for a command about the results of a run."""
    parser = command_parser(command, description, epilog)
    parser.add_argument("results", metavar="RESULTS", help="result file, deck that was run, or directory with results")
    return parser


def command_parser(command: str, description: str, epilog: str | None = None) -> argparse.ArgumentParser:
    """An argument parser with the exit code of the program for invalid arguments, 1."""

    class Parser(argparse.ArgumentParser):
        def error(self, message: str) -> NoReturn:
            self.print_usage(sys.stderr)
            self.exit(1, f"error: {message}\n")

    return Parser(
        prog=f"litz {command}",
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def increment_of(results: "Results", text: str) -> int:
    """Index of an increment that is written as STEP:INCREMENT, or as a number from 0, or from the end."""
    if step := re.fullmatch(r"(\d+):(\d+)", text):
        return results.index(int(step[1]), int(step[2]))
    if not re.fullmatch(r"[+-]?\d+", text):
        raise ValueError(f"an increment is STEP:INCREMENT or a whole number, not {text!r}")
    return int(text)
