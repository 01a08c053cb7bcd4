"""The command `litz view`: by itself, as others need no server."""

from importlib import import_module

from ..results import Results
from .parsers import results_parser


def view_command(arguments: list[str]) -> int:
    """`litz view`: results in the browser."""
    parser = results_parser("view", "Show results in the browser, from a small server on this machine.")
    parser.add_argument("--port", type=int, default=0, help="port of the server; default: any free port")
    parser.add_argument("--no-browser", action="store_true", help="only print the address")
    options = parser.parse_args(arguments)
    if not 0 <= options.port <= 65535:
        parser.error(f"a port is a number from 0 to 65535, not {options.port}")
    results = Results(options.results)
    # takes long to load, and is of no use without results
    view = import_module("..viewer.server", __package__).view
    view(results, port=options.port, open_browser=not options.no_browser)
    return 0
