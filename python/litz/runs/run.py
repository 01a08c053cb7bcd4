"""Runs the Fortran program from Python; its exit codes become exceptions that carry its own message."""

import contextlib
import inspect
import os
import re
import subprocess
import sys
import tempfile
import threading
import warnings
from collections.abc import Iterable
from pathlib import Path

from ..base.program import program_environment, program_path
from ..deck.instances import flat_deck
from ..errors import (
    FileError,
    InputError,
    InternalError,
    LitzError,
    NotConvergedError,
    OutOfMemoryError,
    RunWarning,
    SolverError,
    WarningEntry,
)
from ..results import Results
from ..results.run_warnings import read_warnings
from .progress import Progress, someone_watches, total_time

#: Time for the program to terminate, and between two looks at a file without which it is ended [s]
_TERMINATION_TIMEOUT, _LOOK_INTERVAL = 5.0, 0.2

_ERRORS: dict[int, type[LitzError]] = {
    error.exit_code: error
    for error in (InputError, NotConvergedError, SolverError, FileError, InternalError, OutOfMemoryError)
}

#: Advice in messages that refers to decks, and its counterpart in Python
_IN_PYTHON = {
    "increments of INC=": "inc=... of Model.step and Model.press",
    "I_C of *CONTROLS": "Step.controls('TIME INCREMENTATION', i_c=...)",
    "PARAMETERS=STABILIZE": "Step.controls('STABILIZE')",
    "*FRICTION": "friction=... of Model.contact and litz.Interaction",
    "third value of *STATIC": "smallest=... of Model.step and Model.press",
}


def run(
    deck: str | os.PathLike[str],
    *,
    output_directory: str | os.PathLike[str] = ".",
    solver: str | None = None,
    threads: int | None = None,
    restart: str | os.PathLike[str] | None = None,
    quiet: bool = True,
    progress: bool | None = None,
) -> Results:
    """Run a deck and read its results.

    Parameters
    ----------
    deck : path
        The .inp file.
    output_directory : path
        Directory of the result files; created if necessary.
    solver : {"block", "umfpack", "skyline", "mumps"}, optional
        Replaces the choice of the deck.
    threads : int, optional
        Number of threads.
    restart : path or str, optional
        Restart file to continue from, or ``FILE:STEP:INCREMENT``, written by ``*RESTART, WRITE``.
    quiet : bool
        False: show the output of the program as it runs.
    progress : bool, optional
        Show the progress of the run: a line on a terminal, a bar in a notebook, a few lines in a log. Left out: on a terminal
        and in a notebook, unless the output of the program is shown.

    Returns
    -------
    Results

    Raises
    ------
    InputError, NotConvergedError, SolverError, FileError, InternalError, OutOfMemoryError
        All of them `LitzError`, with the message of the program.

    Warns
    -----
    RunWarning
        For each warning of the run, even if it ends with an error; `Results.warnings` has them as data.
    """
    if not isinstance(deck, str | os.PathLike):
        raise TypeError(
            f"litz.run takes the path of a deck, not {type(deck).__name__}: a model has its own `run(directory)`, and a"
            " litz.Deck is written first"
        )
    if progress is None:
        progress = quiet and someone_watches()
    options = (deck, output_directory, solver, threads, restart, quiet, progress)
    try:
        results = run_silently(*options)
    except LitzError as error:
        # if warnings are exceptions, the error takes precedence
        with contextlib.suppress(RunWarning):
            _warn(error.warnings)
        raise
    _warn(results.warnings)
    return results


def run_silently(
    deck: str | os.PathLike[str],
    output_directory: str | os.PathLike[str] = ".",
    solver: str | None = None,
    threads: int | None = None,
    restart: str | os.PathLike[str] | None = None,
    quiet: bool = True,
    progress: bool = False,
    while_exists: Path | None = None,
) -> Results:
    """As `run`, without Python warnings: those of the run are in its results, or in the exception.

    The program is ended as soon as the file `while_exists` is gone.
    """
    deck, output_directory = Path(deck), Path(output_directory)
    command: list[str | Path] = ["-o", output_directory]
    if solver is not None:
        command += ["--solver", str(solver)]
    if threads is not None:
        command += ["--threads", str(threads)]
    if restart is not None:
        command += ["--restart", str(restart)]

    shown = _progress_of(deck) if progress else None
    results_path = output_directory / (deck.stem + ".vtkhdf")
    before = _changed(results_path)
    with flat_deck(deck) as flat:
        exit_code, printed, message = _call([program_path(), "run", flat, *command], quiet, shown, while_exists)
    if exit_code != 0:
        error = _error_of(exit_code, message or printed, results_path if results_path.exists() else None)
        has_results = _changed(results_path) != before
        error.warnings = _read_warnings(results_path) if has_results else _warnings_in(message)
        _add_notes(error, has_results)
        raise error

    return Results(results_path)


def check(deck: str | os.PathLike[str]) -> str:
    """Read and check a deck without running it.

    Parameters
    ----------
    deck : path
        The .inp file.

    Returns
    -------
    str
        The model as the program reads it, and the crossings within the search distance.

    Raises
    ------
    InputError, FileError
        With the message of the program.

    Warns
    -----
    RunWarning
        For each warning of the program.
    """
    with flat_deck(Path(deck)) as flat:
        exit_code, printed, message = _call([program_path(), "check", flat], quiet=True)
    found = _warnings_in(message)
    if exit_code != 0:
        error = _error_of(exit_code, message or printed)
        error.warnings = found
        with contextlib.suppress(RunWarning):
            _warn(found)
        raise error
    _warn(found)
    return printed


def _warn(found: Iterable[WarningEntry]) -> None:
    """Issue the warnings of a run as Python warnings, at the calling line outside this package."""
    level, frame = 1, inspect.currentframe()
    while frame is not None and frame.f_globals.get("__name__", "").startswith("litz."):
        level, frame = level + 1, frame.f_back
    for entry in found:
        warnings.warn(RunWarning(str(entry), entry), stacklevel=level)


def _warnings_in(messages: str) -> list[WarningEntry]:
    """The warnings among the messages of a run without results."""
    return [WarningEntry("", message) for message in re.findall(r"^warning: (.*)$", messages, re.MULTILINE)]


def _read_warnings(path: Path) -> list[WarningEntry]:
    """The warnings in the result file of a failed run, if it can be read."""
    try:
        return read_warnings(path)
    except OSError:
        return []


def _error_of(exit_code: int, message: str, results_path: Path | None = None) -> LitzError:
    """The exception of an exit code, with the program's own message."""
    # earlier warnings of the program are not part of the error
    found = re.search(r"^error\b", message, re.MULTILINE)
    if found:
        message = message[found.start() :]
    if exit_code < 0:
        message += f"the program was ended by signal {-exit_code}\n"
    return _ERRORS.get(exit_code, InternalError)(message.rstrip(), results_path)


def _changed(path: Path) -> int | None:
    """Modification time of a file, if it exists [ns]."""
    return path.stat().st_mtime_ns if path.exists() else None


def _add_notes(error: LitzError, has_results: bool) -> None:
    """Add the path of the results and the advice for Python to the message (from Python 3.11 on)."""
    if not (isinstance(error, NotConvergedError) and hasattr(error, "add_note")):
        return
    advice = [python for word, python in _IN_PYTHON.items() if word in str(error)]
    if advice:
        error.add_note(f"In Python: {'; '.join(advice)}.")
    if has_results:
        error.add_note(f"The increments before: litz.Results({str(error.results_path)!r})")


def _progress_of(deck: Path) -> Progress:
    return Progress(total_time(deck), deck.stem)


def _end(process: subprocess.Popen) -> None:
    """Terminate a program that may still run, so that it removes its lock."""
    process.terminate()
    try:
        process.wait(timeout=_TERMINATION_TIMEOUT)
    except subprocess.TimeoutExpired:
        process.kill()


def _end_without(file: Path, process: subprocess.Popen, is_over: threading.Event) -> None:
    """Terminate a program when a file is gone."""
    while not is_over.wait(_LOOK_INTERVAL):
        if not file.exists():
            _end(process)
            return


def _call(
    command: list[str | Path], quiet: bool, progress: Progress | None = None, while_exists: Path | None = None
) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a command; the output is shown line by line if requested."""
    printed, is_over = [], threading.Event()
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as messages:
        process = subprocess.Popen(
            [str(word) for word in command],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=messages,
            encoding="utf-8",
            errors="replace",
            # lines are not buffered
            env={"GFORTRAN_UNBUFFERED_PRECONNECTED": "y", **program_environment()},
        )
        if while_exists is not None:
            threading.Thread(target=_end_without, args=(while_exists, process, is_over), daemon=True).start()
        with process:
            try:
                for line in process.stdout or ():
                    printed.append(line)
                    if progress is not None:
                        progress.feed(line)
                    if not quiet:
                        sys.stdout.write(line)
                        sys.stdout.flush()
                exit_code = process.wait()
            finally:
                is_over.set()
                _end(process)
        if progress is not None:
            progress.close(exit_code == 0)
        messages.seek(0)
        return exit_code, "".join(printed), messages.read()
