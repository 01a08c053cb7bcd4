"""What the tests share: the built program, and what else its build directory can make."""

import contextlib
import fcntl
import functools
import importlib
import importlib.resources
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest


def load_numpy_with_one_thread():
    """The tests are divided among as many processes as there are processors; threads of BLAS would wait for each other."""
    chosen = os.environ.get("OPENBLAS_NUM_THREADS")
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    importlib.import_module("numpy")
    if chosen is None:
        # the programs that tests start choose themselves
        del os.environ["OPENBLAS_NUM_THREADS"]
    else:
        os.environ["OPENBLAS_NUM_THREADS"] = chosen


load_numpy_with_one_thread()

# another ninja than that of the environment would build all anew, and the next import of litz once more
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", os.defpath)])


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


def settle_libraries():
    """Have the libraries of the program chosen as it would, which starts once more for that: thousands of times else."""
    if "OMP_WAIT_POLICY" in os.environ or importlib.util.find_spec("litz") is None:
        return
    version = subprocess.run([find_program(), "--version"], capture_output=True, text=True, check=False).stdout
    os.environ["OMP_WAIT_POLICY"] = "passive"
    if kernels := re.search(r"^BLAS: OpenBLAS .* DYNAMIC_ARCH .*?(\w+) MAX_THREADS", version, re.MULTILINE):
        os.environ.setdefault("OPENBLAS_CORETYPE", kernels[1])


def pytest_configure(config):
    """Slow tests run where tests are chosen: by `-m`, `-k`, or the names of files or folders."""
    settle_libraries()
    chosen = config.option.keyword or config.option.markexpr
    if config.args_source is pytest.Config.ArgsSource.TESTPATHS and not chosen:
        config.option.markexpr = "not slow"


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
def shared_folder(tmp_path_factory) -> Path:
    """A folder for all processes among which the tests are divided."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "shared"
    folder.mkdir(exist_ok=True)
    return folder


@pytest.fixture(scope="session")
def alone(shared_folder):
    """``with alone("builds"):`` is for one process of the tests at a time."""

    @contextlib.contextmanager
    def lock(name):
        with (shared_folder / f"{name}.lock").open("w", encoding="utf-8") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield

    return lock


@pytest.fixture(scope="session")
def made_once(shared_folder, alone):
    """``made_once("name", make)``: the folder that ``make(folder)`` has filled for all processes of the tests."""

    def made(name, make) -> Path:
        folder, done = shared_folder / name, shared_folder / f"{name}.done"
        with alone(name):
            if not done.exists():
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                make(folder)
                done.touch()
        return folder

    return made


@pytest.fixture(scope="session")
def build_target(litz_program, alone):
    """Build one target where the program was built: ``build_target("tests/read_decks") -> Path``."""

    def build(target) -> Path:
        directory = litz_program.resolve().parents[1]
        if not (directory / "build.ninja").is_file() or shutil.which("ninja") is None:
            pytest.skip(f"{directory} is no build directory: {target} is not there")
        with alone("build"):
            subprocess.run(["ninja", "-C", directory, target], check=True, capture_output=True)
        return directory / target

    return build
