"""The command `litz network`."""

import argparse
from pathlib import Path

import numpy as np

from ..base.quantities import engineering
from ..errors import FileError, InputError
from ..results import Results
from .parsers import increment_of, results_parser

_EXAMPLES = """
examples:
  litz network deck.vtkhdf                            mean resistances within and between the stages of a cable
  litz network deck.vtkhdf --superconducting          of the contacts alone
  litz network deck.vtkhdf --csv circuit.csv --graphml circuit.graphml
"""
#: Lengths that are printed
_MAX_LENGTHS = 5


def network_command(arguments: list[str]) -> int:
    """`litz network`: resistances between wires, and the circuit as files."""
    parser = results_parser(
        "network", "Resistances between wires, from a circuit of the wires and all places of contacts.", _EXAMPLES
    )
    parser.add_argument("--increment", default="-1", metavar="N",
                        help="STEP:INCREMENT, or counted from 0, or from the end; default: -1, the last")  # fmt: skip
    parser.add_argument("--at", type=float, default=0.0, metavar="PLACE",
                        help="where the current enters the wires, from 0 (first nodes, default) to 1 (last nodes)")  # fmt: skip
    parser.add_argument(
        "--superconducting",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="all wires have no resistance along them, or none; default: those with superconducting filaments",
    )
    parser.add_argument("--csv", metavar="FILE", help="write a row for each piece of wire and each place of a contact")
    parser.add_argument(
        "--graphml", metavar="FILE", help="write them as a graph, for NetworkX, igraph, Gephi and others"
    )
    options = parser.parse_args(arguments)
    try:
        results = Results(options.results)
        increment = increment_of(results, options.increment)
        circuit = results.circuit(increment, superconducting=options.superconducting)
        written = []
        for path, write in ((options.csv, circuit.to_csv), (options.graphml, circuit.to_graphml)):
            if path is None:
                continue
            try:
                Path(path).parent.mkdir(parents=True, exist_ok=True)
                written.append(write(path))
            except OSError as error:
                raise FileError(f"cannot write {path}: {error.strerror or error}") from None
        print(_resistances(results, increment, options.at, options.superconducting), end="")
    except (ValueError, LookupError) as error:
        raise InputError(error.args[0]) from None
    for path in written:
        print(f"wrote {path}: {len(circuit.points)} resistances between {len(circuit.arc)} points")
    return 0


def _resistances(results: Results, increment: int, at: float, superconducting: bool | None) -> str:
    found = results.interstrand_resistance(increment, at=at, superconducting=superconducting)
    units, table = results.unit_labels, found.stages()
    place = f"step {results.steps[increment]}, increment {results.increments[increment]}"
    lines = [
        f"{place}, time {results.times[increment]:g} {units['s']}: {len(found.matrix)} wires",
        f"resistance between two wires, current enters at {at:g} of their length",
    ]
    names = ("mean", "median", "smallest", "largest")
    counts = ["stage", "pairs"]
    if table["not_joined"].any():
        # resistances are those of the others
        counts.append("not_joined")
    heads = [
        *(name.replace("_", " ") for name in counts),
        *(f"{name} [{units['ohm']}]" for name in names),
        f"times length [{units['ohm']} {units['m']}]",
    ]
    rows = [heads]
    for row in range(table.n_rows):
        values = [f"{table[name][row]:.5g}" for name in (*names, "times_length")]
        rows.append([*(str(table[name][row]) for name in counts), *values])
    widths = [max(len(row[i]) for row in rows) for i in range(len(heads))]
    lines += ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
    lengths = results.redistribution_lengths(increment, superconducting=superconducting)
    if np.isfinite(lengths).any():
        factor, unit = engineering(lengths[np.isfinite(lengths)], units["m"])
        shown = ", ".join(f"{factor * length:.4g}" for length in lengths[:_MAX_LENGTHS])
        more = f", ... {len(lengths)} in all" if len(lengths) > _MAX_LENGTHS else ""
        lines.append(f"lengths over which unequal currents even out [{unit}]: {shown}{more}")
    return "\n".join(lines) + "\n"
