"""The command `litz`: the commands of the Fortran program, and those that need Python."""

import os
import sys

_PYTHON_HELP = """
Commands of the Python package:
  litz table DIR|FILE                  the history of a run as a table
  litz plot DIR|FILE [-o PICTURE.png]  a picture of the wires, coloured by voltage, and of resistance over force
"""


def main(arguments=None):
    """Entry point of the console script. Returns the exit code."""
    from .run import LitzError

    arguments = sys.argv[1:] if arguments is None else list(arguments)
    commands = {"table": _table, "plot": _plot}
    try:
        if arguments and arguments[0] in commands:
            return commands[arguments[0]](arguments[1:])
        return _run_program(arguments)
    except LitzError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code


def _run_program(arguments):
    """Become the Fortran program, so that signals, standard streams and the exit code are its own."""
    from .run import program_path

    program = str(program_path())
    if not arguments or arguments[0] in ("help", "-h", "--help"):
        import subprocess

        exit_code = subprocess.run([program, "--help"], check=False).returncode
        print(_PYTHON_HELP, end="")
        return exit_code
    sys.stdout.flush()
    os.execv(program, [program, *arguments])


def _table(arguments):
    raise SystemExit("not yet")


def _plot(arguments):
    raise SystemExit("not yet")
