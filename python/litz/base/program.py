"""Where the Fortran program is, and what it runs in."""

import os
from importlib.resources import files
from pathlib import Path

from ..errors import FileError


def program_path() -> Path:
    """The Fortran program: the one the environment variable LITZ_PROGRAM names, or the one in this package."""
    named = os.environ.get("LITZ_PROGRAM")
    program = Path(named) if named else Path(str(files("litz") / "_bin" / "litz"))
    if not os.access(program, os.X_OK):
        where = "the environment variable LITZ_PROGRAM names it" if named else "reinstall litz, or set LITZ_PROGRAM"
        raise FileError(f"the program litz is not at {program} ({where})")
    return program


def program_environment() -> dict[str, str]:
    """What the program runs in: threads that wait sleep, unless `OMP_WAIT_POLICY` says otherwise.

    Threads that spin while they wait are worth nothing here, and on a machine with other work they slow a small model
    down several times over. The program would see to that by itself, but has to start a second time for it.
    """
    return {"OMP_WAIT_POLICY": "passive", **os.environ}
