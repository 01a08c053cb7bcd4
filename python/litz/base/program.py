"""The Fortran program and its environment."""

import os
from importlib.resources import files
from pathlib import Path

from ..errors import FileError


def program_path() -> Path:
    """Path of the Fortran program: that in the environment variable LITZ_PROGRAM, or the one in this package."""
    named = os.environ.get("LITZ_PROGRAM")
    program = Path(named) if named else Path(str(files("litz") / "_bin" / "litz"))
    if not os.access(program, os.X_OK):
        where = "the environment variable LITZ_PROGRAM names it" if named else "reinstall litz, or set LITZ_PROGRAM"
        raise FileError(f"the program litz is not at {program} ({where})")
    return program


def program_environment() -> dict[str, str]:
    """Environment of the program: waiting threads sleep unless `OMP_WAIT_POLICY` is set.

    Spinning threads gain nothing here, and on a busy machine they make small models several times slower. The program
    would set this itself, but would have to restart to do so.
    """
    return {"OMP_WAIT_POLICY": "passive", **os.environ}
