"""The command `litz`: the commands of the Fortran program, and those that need Python."""

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    import argparse

    from .model import Model

_HELP = ("help", "-h", "--help")
_PYTHON_HELP = """
Commands of the Python package:
  litz summary RESULTS                    what was run, the increments, the contacts and the last increment in numbers
  litz table RESULTS                      contacts, contact force and the history that the deck asked for, over time
  litz plot RESULTS [KIND] [-o PICTURE]   a picture; KIND: overview (default), wires, resistance, residuals, contacts,
                                          currents, network, friction or history; --animate: a moving one
  litz report RESULTS [-o PAGE]           one HTML page about a run: convergence, balances, worst contacts, pictures, and
                                          the model to turn; also for runs that did not converge
  litz view RESULTS [--no-browser]        the results in the browser: turn, scrub through increments, pick contacts
  litz new TASK [DECK]                    write a commented deck to begin with; litz new --list shows the tasks
  litz convert MESH DECK --radius R       a deck from a mesh of gmsh, Abaqus or BeamMe, or any that meshio reads
  litz export RESULTS --to FORMAT         results as csv, vtu (ParaView series), xdmf or vtkhdf; -o DIR says where to
RESULTS is a result file (.vtkhdf), a deck (.inp) that was run here, or a directory with the results of one run.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point of the console script. Returns the exit code."""
    import warnings

    from .errors import LitzError

    warnings.showwarning = _show_warning

    arguments = sys.argv[1:] if arguments is None else list(arguments)
    try:
        if len(arguments) > 1 and arguments[0] in _HELP and arguments[1] in COMMANDS:
            arguments = [arguments[1], "--help"]
        if arguments and arguments[0] in COMMANDS:
            return COMMANDS[arguments[0]](arguments[1:])
        return _run_program(arguments)
    except LitzError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    except BrokenPipeError:
        # the reader of the output, such as head, has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _show_warning(message: Warning | str, *_: object, **_also: object) -> None:
    """A warning as a user reads it: without the line of the source that gave it."""
    print(f"warning: {message}", file=sys.stderr)


def _run_program(arguments: list[str]) -> int:
    """Become the Fortran program, so that signals, standard streams and the exit code are its own."""
    from .run import program_environment, program_path

    program = str(program_path())
    if arguments and (arguments[0] not in _HELP or len(arguments) > 1):
        sys.stdout.flush()
        os.execve(program, [program, *arguments], program_environment())
    import subprocess

    exit_code = subprocess.run([program, "--help"], check=False).returncode
    print(_PYTHON_HELP, end="")
    return exit_code


def results_parser(command: str, description: str, epilog: str | None = None) -> "argparse.ArgumentParser":
    """A parser for a command about the results of a run."""
    parser = command_parser(command, description, epilog)
    parser.add_argument("results", metavar="RESULTS", help="result file, deck that was run, or directory with results")
    return parser


def command_parser(command: str, description: str, epilog: str | None = None) -> "argparse.ArgumentParser":
    """A parser of arguments that ends as the program does: with exit code 1 when they are wrong."""
    import argparse

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


def _new(arguments: list[str]) -> int:
    from .starters import new, starter_list

    parser = command_parser("new", "Write a commented deck to begin with, which runs as it stands.", starter_list())
    parser.add_argument("task", metavar="TASK", nargs="?", help="one of those below")
    parser.add_argument("deck", metavar="DECK", nargs="?", help="default: TASK.inp; a file that is there is kept")
    parser.add_argument("--list", action="store_true", help="list the tasks")
    options = parser.parse_args(arguments)
    if options.list:
        print(starter_list(), end="")
        return 0
    if options.task is None:
        parser.error("which task? litz new --list shows them")
    try:
        deck = new(options.task, options.deck)
    except ValueError as error:
        parser.error(str(error))
    print(f"wrote {deck}\nrun it: litz run {deck} -o {deck.with_suffix('')}")
    return 0


def _convert(arguments: list[str]) -> int:
    from .errors import FileError
    from .meshes import read_mesh
    from .model import COPPER, Material, Model

    parser = command_parser(
        "convert", "Write the wires and sets of a mesh as a deck, to which supports and steps are added."
    )
    parser.add_argument("mesh", metavar="MESH", help="Abaqus, gmsh or BeamMe (.inp), gmsh (.msh), or what meshio reads")
    parser.add_argument("deck", metavar="DECK", help="the deck to write; a file that is there is kept")
    parser.add_argument(
        "--radius",
        type=float,
        help="radius of the wires, in the unit of length of the mesh; not needed where the mesh has sections",
    )
    parser.add_argument(
        "--young", type=float, default=COPPER.young, help="Young's modulus; default: copper in SI units"
    )
    parser.add_argument("--poisson", type=float, default=COPPER.poisson, help="Poisson's ratio; default: copper")
    parser.add_argument("--conductivity", type=float, help="electrical conductivity; without it an insulator")
    parser.add_argument(
        "--element", choices=("B31", "B33"), default="B33", help="where the mesh does not say; default B33"
    )
    options = parser.parse_args(arguments)
    if Path(options.deck).exists():
        raise FileError(f"{options.deck} is there already and is not replaced; give another name")
    try:
        mesh = read_mesh(options.mesh)
        notes = ["Supports, contacts and loads are to be added: outlines stand below, litz keywords explains them."]
        model = Model(f"Wires of {mesh.path.name}", notes)
        material = Material("WIRE", options.young, options.poisson, options.conductivity)
        model.mesh(
            mesh, radius=options.radius, material=None if options.radius is None else material, element=options.element
        )
        model.step()
        _write_with_outline(model, Path(options.deck))
    except ValueError as error:
        parser.error(str(error))
    print(f"wrote {options.deck}: {len(mesh.x)} nodes, {len(mesh.connectivity)} elements")
    for what, sets in (("element sets", model.element_sets | model.groups), ("node sets", model.node_sets)):
        if sets:
            print(f"{what}: {', '.join(sets)}")
    return 0


def _write_with_outline(model: "Model", path: Path) -> None:
    """Write the deck, with what it still lacks as comments: keywords with the names of its sets."""
    groups = model.groups
    # sets of all nodes of the wires are no places to hold them
    whole = {len(group.nodes) for group in groups.values()}
    sets = [name for name, nodes in model.node_sets.items() if len(nodes) not in whole]
    conducts = any(group.material.conductivity is not None for group in groups.values())
    outline = ["*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"]
    outline += ["*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ"] * conducts
    outline += ["*CONTACT PAIR, INTERACTION=TOUCH", f" {', '.join([*groups][:2])}"]
    loads = []
    if sets:
        outline += ["*BOUNDARY", *(f" {name}, ENCASTRE" for name in sets), *[f" {sets[0]}, 9"] * conducts]
        loads = ["*BOUNDARY", f" {sets[-1]}, 3, 3, {-next(iter(groups.values())).radius:g}"]
    text = model.to_deck()
    for before, lines in (("*STEP", outline), ("*END STEP", loads)):
        head, keyword, rest = text.rpartition(f"\n{before}")
        comments = "".join(f"\n** {line}" for line in lines)
        text = f"{head}{comments}{keyword}{rest}"
    path.write_text(text, encoding="utf-8")


def _export(arguments: list[str]) -> int:
    from .exports import export

    parser = results_parser("export", "Write results for another program.")
    parser.add_argument("--to", required=True, metavar="FORMAT", help="csv, vtu, xdmf or vtkhdf")
    parser.add_argument("-o", "--output", metavar="DIR", help="default: beside the results")
    options = parser.parse_args(arguments)
    try:
        print(f"wrote {export(options.results, options.to, options.output)}")
    except ValueError as error:
        parser.error(str(error))
    return 0


def _summary(arguments: list[str]) -> int:
    from .results import Results

    options = results_parser("summary", "What was run, how it went, and the last increment in numbers.").parse_args(
        arguments
    )
    print(Results(options.results).summary(), end="")
    return 0


def _table(arguments: list[str]) -> int:
    from .history_table import history_table
    from .results import Results

    options = results_parser("table", "Contacts, contact force and the history of a run, over time.").parse_args(
        arguments
    )
    print(history_table(Results(options.results)), end="")
    return 0


def _plot(arguments: list[str]) -> int:
    from .picture_commands import plot_command

    return plot_command(arguments)


def _report(arguments: list[str]) -> int:
    from .picture_commands import report_command

    return report_command(arguments)


def _view(arguments: list[str]) -> int:
    from .picture_commands import view_command

    return view_command(arguments)


#: The commands of this package; the others are those of the program, whose messages name these, too
COMMANDS: dict[str, Callable[[list[str]], int]] = {
    "summary": _summary,
    "table": _table,
    "plot": _plot,
    "report": _report,
    "view": _view,
    "new": _new,
    "convert": _convert,
    "export": _export,
}
