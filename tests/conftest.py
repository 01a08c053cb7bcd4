"""What the tests share: the built program, and what else its build directory can make."""

import functools
import importlib.resources
import importlib.util
import os
import re
import shutil
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


@functools.cache
def solvers_of_program() -> list[str]:
    """Names of the solvers that the program was built with."""
    version = subprocess.run([find_program(), "--version"], capture_output=True, text=True, check=True).stdout
    names = re.search(r"^solvers: (.*)$", version, re.MULTILINE)[1]
    return re.sub(r" *\([^)]*\)", "", names).split(", ")


def pytest_runtest_setup(item):
    if item.get_closest_marker("mumps") and "MUMPS" not in solvers_of_program():
        pytest.skip("the program was built without MUMPS")


@pytest.fixture(scope="session")
def solvers() -> list[str]:
    """The solvers of the program, the default first."""
    return solvers_of_program()


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


@pytest.fixture(scope="session")
def build_target(litz_program):
    """Build one target where the program was built: ``build_target("tests/read_decks") -> Path``."""

    def build(target) -> Path:
        directory = litz_program.resolve().parents[1]
        if not (directory / "build.ninja").is_file() or shutil.which("ninja") is None:
            pytest.skip(f"{directory} is no build directory: {target} is not there")
        subprocess.run(["ninja", "-C", directory, target], check=True, capture_output=True)
        return directory / target

    return build
