"""The commands that print and export results."""

from ..results import Results
from ..results.exports import export
from ..results.history_table import history_table
from .parsers import results_parser


def export_command(arguments: list[str]) -> int:
    """`litz export`: results for another program."""
    parser = results_parser("export", "Write results for another program.")
    parser.add_argument("--to", required=True, metavar="FORMAT", help="csv, vtu, xdmf or vtkhdf")
    parser.add_argument("-o", "--output", metavar="DIR", help="default: next to the results")
    options = parser.parse_args(arguments)
    try:
        print(f"wrote {export(options.results, options.to, options.output)}")
    except ValueError as error:
        parser.error(str(error))
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
