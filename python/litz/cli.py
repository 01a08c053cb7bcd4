"""The command `litz`: the commands of the Fortran program, and those that need Python."""

import os
import shutil
import signal
import subprocess
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from .base.program import program_environment, program_path
from .base.rearranged import INCLUDED, REARRANGED
from .errors import LitzError

_HELP = ("help", "-h", "--help")
_PYTHON_HELP = """
Commands of the Python package:
  litz summary RESULTS                    overview of the run: increments, contacts and the last increment in numbers
  litz table RESULTS                      contacts, contact force and the requested history output, over time
  litz plot RESULTS [KIND] [-o PICTURE]   a picture; KIND: overview (default), wires, resistance, residuals, contacts,
                                          lines, currents, shares, section, network, friction, surfaces or history;
                                          --animate: an animation
  litz report RESULTS [-o PAGE]           one HTML page about a run: convergence, balances, worst contacts, pictures, and
                                          the model to rotate; also for runs that did not converge
  litz view RESULTS [--no-browser]        the results in the browser: rotate, step through increments, select contacts
  litz new TASK [DECK]                    write a commented deck as a starting point; litz new --list shows the tasks
  litz convert MESH DECK --radius R       a deck from one of Abaqus or CalculiX, or from a mesh of gmsh, BeamMe or meshio
  litz export RESULTS --to FORMAT         results as csv, vtu (ParaView series), xdmf or vtkhdf; -o DIR says where to
  litz export feap|abaqus DECK            the model for a program with litz's contact element as a user element
  litz export ccx DECK                    the beams, supports and loads for CalculiX, without contacts and currents
  litz network RESULTS [--csv FILE] [--graphml FILE]
                                          resistances between wires; the circuit of wires and contacts as files
RESULTS is a result file (.vtkhdf), a deck (.inp) that was run here, or a directory with the results of one run.
"""

#: Module of `commands` and function of each command that this package has. The others are those of the program, which start
#: at once, without numpy and pictures; its messages name these, too.
COMMANDS = {
    "summary": ("results", "summary_command"),
    "table": ("results", "table_command"),
    "plot": ("pictures", "plot_command"),
    "report": ("report", "report_command"),
    "view": ("view", "view_command"),
    "new": ("decks", "new_command"),
    "convert": ("decks", "convert_command"),
    "export": ("results", "export_command"),
    "network": ("networks", "network_command"),
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point of the console script. Returns the exit code."""
    warnings.showwarning = _show_warning

    arguments = sys.argv[1:] if arguments is None else list(arguments)
    try:
        if len(arguments) > 1 and arguments[0] in _HELP and arguments[1] in COMMANDS:
            arguments = [arguments[1], "--help"]
        if arguments and arguments[0] in COMMANDS:
            module, function = COMMANDS[arguments[0]]
            return getattr(import_module(f".commands.{module}", __package__), function)(arguments[1:])
        return _run_program(arguments)
    except LitzError as error:
        # messages of the program say so themselves
        print(f"error: {str(error).removeprefix('error: ')}", file=sys.stderr)
        return error.exit_code
    except BrokenPipeError:
        # the reader of the output, such as head, has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _show_warning(message: Warning | str, *_: object, **_also: object) -> None:
    """A warning as a user reads it: without the line of the source that gave it."""
    print(f"warning: {message}", file=sys.stderr)


def _may_be_rearranged(deck: Path) -> bool:
    """Whether it is worth looking for parts and generated nodes: numpy, which that needs, takes a while to load."""
    text = deck.read_bytes()
    return any(pattern.search(text) for pattern in (REARRANGED, INCLUDED))


def _run_flat(program: str, arguments: list[str], deck: int, environment: dict[str, str]) -> int:
    """Run the program on a deck whose instances have been placed, and pass on the signals that end it."""
    flat_deck = import_module(".deck.instances", __package__).flat_deck
    with flat_deck(Path(arguments[deck])) as flat:
        command = [program, *arguments[:deck], str(flat), *arguments[deck + 1 :]]
        if str(flat) == arguments[deck]:
            os.execve(program, command, environment)
        with subprocess.Popen(command, env=environment) as process:
            # Ctrl-C goes to the program as well, which ends by itself
            signal.signal(signal.SIGINT, lambda *_: None)
            signal.signal(signal.SIGTERM, lambda *_: process.terminate())
            exit_code = process.wait()
    return exit_code if exit_code >= 0 else 128 - exit_code


def _run_program(arguments: list[str]) -> int:
    """Become the Fortran program, so that signals, standard streams and the exit code are its own."""
    program = str(program_path())
    if arguments and (arguments[0] not in _HELP or len(arguments) > 1):
        sys.stdout.flush()
        columns = str(shutil.get_terminal_size((100, 24)).columns)
        environment = {**program_environment(), "COLUMNS": columns}
        files = [
            i for i in range(1, len(arguments)) if arguments[i - 1] != "--restart" and Path(arguments[i]).is_file()
        ]
        if arguments[0] in ("run", "check") and files and _may_be_rearranged(Path(arguments[files[0]])):
            return _run_flat(program, arguments, files[0], environment)
        os.execve(program, [program, *arguments], environment)
    exit_code = subprocess.run([program, "--help"], check=False).returncode
    print(_PYTHON_HELP, end="")
    return exit_code
