"""A copy of the sources with a build of its own, in which faults are tried."""

import filecmp
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

from catalogue import ROOT

#: Seconds after which a build, or tests that take minutes at most, are taken to hang
LIMIT = 1200.0
#: What has no sources, in the folder of the project
LEFT_OUT = {".git", ".venv", "results", "build", "debug"}
BUILD_OPTIONS = ("-Dbuildtype=plain", "-Doptimization=1", "-Dpython=enabled", "-Dmpi=auto")


class Scratch:
    """The copy and its build folder beside it, which both stay for the next time."""

    def __init__(self, place: Path) -> None:
        self.source, self.build = place / "source", place / "build"
        fresh = place / "fresh"
        shutil.rmtree(fresh, ignore_errors=True)
        shutil.copytree(ROOT, fresh, ignore=without_products, symlinks=True)
        mirror(fresh, self.source)
        shutil.rmtree(fresh)
        if not (self.build / "build.ninja").is_file():
            shutil.rmtree(self.build, ignore_errors=True)
            require(["meson", "setup", self.build, self.source, *BUILD_OPTIONS], place)

    def compiles(self) -> bool:
        return finish(["ninja", "-C", self.build], self.source)[0] == 0

    def first_failure(self, tests: list[str]) -> str:
        """The first test that fails, of Fortran test programs and pytest files; empty: none does."""
        programs = [Path(test).stem for test in tests if test.endswith(".f90")]
        files = [test for test in tests if not test.endswith(".f90")]
        return (programs and self.first_failed_program(programs)) or (files and self.first_failed_test(files)) or ""

    def first_failed_program(self, programs: list[str]) -> str:
        code, output = finish(["meson", "test", "-C", self.build, "--maxfail=1", *programs], self.source)
        if code == 0:
            return ""
        return "hangs" if code is None else last_line_with(output, "FAIL", "TIMEOUT", "ERROR")

    def first_failed_test(self, files: list[str]) -> str:
        (extension,) = (self.build / "python").glob("_core*.so")
        code, output = finish(
            [
                sys.executable, "tests/run_in_build.py", "--package", self.source / "python" / "litz",
                "--extension", extension, "--program", self.build / "fortran" / "litz",
                "--stage", self.build / "tests" / "stage", "-x", "-q", "-p", "no:cacheprovider", *files,
            ],
            self.source,
        )  # fmt: skip
        if code == 0:
            return ""
        return "hangs" if code is None else last_line_with(output, "FAILED ", "ERROR ")


def without_products(folder: str, names: list[str]) -> set[str]:
    return {name for name in names if name == "__pycache__" or (Path(folder) == ROOT and name in LEFT_OUT)}


def mirror(fresh: Path, copy: Path) -> None:
    """Make the copy what the fresh one is; files that are the same keep their times, so that little is compiled."""
    files = {path.relative_to(fresh) for path in fresh.rglob("*") if not path.is_dir()}
    for path in [path for path in copy.rglob("*") if not path.is_dir() and path.relative_to(copy) not in files]:
        path.unlink()
    for path in files:
        if not (copy / path).is_file() or not filecmp.cmp(fresh / path, copy / path, shallow=False):
            (copy / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(fresh / path, copy / path)


def finish(command: list[object], folder: Path) -> tuple[int | None, str]:
    """Run a command; its exit code, None where it hangs, and what it printed. All it has started ends with it."""
    process = subprocess.Popen(
        [str(word) for word in command], cwd=folder, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
        start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
    )  # fmt: skip
    try:
        output, _ = process.communicate(timeout=LIMIT)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return None, process.communicate()[0]
    return process.returncode, output


def require(command: list[object], folder: Path) -> None:
    code, output = finish(command, folder)
    if code != 0:
        sys.exit(f"{output}\nthis failed: {' '.join(str(word) for word in command)}")


def last_line_with(output: str, *words: str) -> str:
    lines = [line.strip() for line in output.splitlines() if any(word in line for word in words)]
    return lines[-1] if lines else "tests that cannot be run"
