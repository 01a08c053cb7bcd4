"""The commands that print and export results."""

from pathlib import Path

from ..errors import FileError, InputError
from ..hosts import abaqus_input, ccx_input, feap_input, missing_in_ccx, read_host_model
from ..results import Results
from ..results.exports import export
from ..results.history_table import history_table
from .parsers import command_parser, results_parser

#: Programs for which models are written, and the names of their input files, of that of the deck
_HOSTS = {
    "feap": (feap_input, "I{}"),
    "abaqus": (abaqus_input, "{}_abaqus.inp"),
    "ccx": (ccx_input, "{}_ccx.inp"),
}


def export_command(arguments: list[str]) -> int:
    """`litz export`: results, or a model, for another program."""
    if arguments and arguments[0] in _HOSTS:
        return _export_model(arguments)
    parser = results_parser("export", "Write results for another program.")
    parser.add_argument("--to", required=True, metavar="FORMAT", help="csv, vtu, xdmf or vtkhdf")
    parser.add_argument("-o", "--output", metavar="DIR", help="default: next to the results")
    options = parser.parse_args(arguments)
    try:
        print(f"wrote {export(options.results, options.to, options.output)}")
    except ValueError as error:
        parser.error(str(error))
    return 0


def _export_model(arguments: list[str]) -> int:
    """`litz export feap|abaqus|ccx DECK`: the model for another program."""
    parser = command_parser(
        "export",
        "Write the model of a deck for a program that has litz's contact element as a user element (feap, abaqus), or its"
        " beams without contacts and currents (ccx).",
    )
    parser.add_argument("program", choices=_HOSTS, help="feap, abaqus or ccx")
    parser.add_argument("deck", metavar="DECK", help="deck of wires with round sections")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="default: IDECK for FEAP, whose input begins with I; DECK_abaqus.inp or DECK_ccx.inp",
    )
    parser.add_argument(
        "--reach",
        type=float,
        metavar="LENGTH",
        help="elements whose surfaces are that near before loading are candidates of contact; default: largest diameter",
    )
    options = parser.parse_args(arguments)
    if options.reach is not None and not options.reach > 0:
        parser.error(f"--reach must be greater than 0, not {options.reach:g}")
    write, name = _HOSTS[options.program]
    deck = Path(options.deck)
    try:
        model = read_host_model(deck, options.reach)
    except ValueError as error:
        raise InputError(str(error)) from None
    path = options.output or deck.with_name(name.format(deck.stem))
    if path.exists():
        raise FileError(f"{path} exists already and is not overwritten; choose another name with -o")
    text = write(model)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror or error}") from None
    print(f"wrote {path}: {len(model.x)} nodes, {len(model.connectivity)} beams", end="")
    if options.program == "ccx":
        print(f"; run it: ccx -i {path.with_suffix('')}")
        print("".join(f"left out: {one}\n" for one in missing_in_ccx(model)), end="")
    else:
        n_pairs = len(model.pairs)
        print(f", {n_pairs} pair{'s' * (n_pairs != 1)} that may touch")
        print("how to build the program with the elements, and to run it: docs/user_element.md")
        if options.program == "feap" and not path.name.startswith("I"):
            print("FEAPpv writes to a file NONE where the name of its input does not begin with I")
    return 0


def summary_command(arguments: list[str]) -> int:
    """`litz summary`: a page of text about a run."""
    options = results_parser("summary", "What was run, how it went, and the last increment in numbers.").parse_args(
        arguments
    )
    print(Results(options.results).summary(), end="")
    return 0


def table_command(arguments: list[str]) -> int:
    """`litz table`: the history of a run as a table."""
    options = results_parser("table", "Contacts, contact force and the history of a run, over time.").parse_args(
        arguments
    )
    print(history_table(Results(options.results)), end="")
    return 0
