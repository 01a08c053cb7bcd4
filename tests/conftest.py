"""What the tests share: the built program."""

import importlib.resources
import importlib.util
import os
import subprocess
from pathlib import Path

import pytest


def find_program() -> Path:
    """The Fortran program: the one LITZ_PROGRAM names, or that of the installed package."""
    named = os.environ.get("LITZ_PROGRAM")
    if named:
        return Path(named)
    if importlib.util.find_spec("litz") is None:
        pytest.fail("No litz program: set LITZ_PROGRAM to it, or install the package")
    return Path(str(importlib.resources.files("litz") / "_bin" / "litz"))


@pytest.fixture(scope="session")
def litz_program() -> Path:
    program = find_program()
    assert program.is_file(), f"{program} does not exist"
    return program


@pytest.fixture
def litz(litz_program):
    """Run the program: ``litz("check", path, cwd=...) -> CompletedProcess`` with text output."""

    def run(*arguments, cwd=None, timeout=120, env=None):
        return subprocess.run(
            [str(litz_program), *map(str, arguments)],
            cwd=cwd,
            timeout=timeout,
            env=env,
            capture_output=True,
            text=True,
            check=False,
        )

    return run
