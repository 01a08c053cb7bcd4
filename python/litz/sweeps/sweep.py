"""Many runs over a grid of parameters."""

import hashlib
import inspect
import itertools
import json
import math
import os
import re
import signal
import sys
import threading
import time
import uuid
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor, as_completed, wait
from contextlib import contextmanager
from pathlib import Path
from pickle import PicklingError
from types import FrameType
from typing import Any, Literal

import numpy as np

from ..base import notebook
from ..base.names import nearest_name, unknown_name
from ..base.quantities import unit_of_conductance
from ..base.rearranged import files_beside
from ..deck import Deck
from ..deck.lines import to_text
from ..errors import FileError, LitzError
from ..model import Model
from ..results import Results
from ..runs.run import run_silently
from .sweep_table import DIRECTORY, MESSAGE, OWN_COLUMNS, STATUS, WARNINGS, SweepTable

#: A function of the parameters, or a deck with places such as {radius}
Case = Callable[..., Any] | str | os.PathLike
_OUTCOME = "outcome.json"
_PLACE = re.compile(r"\{(\w+)\}")
_MAX_NAME_LENGTH = 60
# Options of `litz.run` that a sweep passes on, and its own
_RUN_OPTIONS = ("solver", "threads", "restart", "quiet")
_SWEEP_OPTIONS = ("collect", "directory", "processes", "executor", "again", "progress")
_RESISTANCE, _CONDUCTANCE = "resistance ", "conductance "
#: What a run that was ended says, and the time it is given to end [s]
_CANCELLED, _TIME_TO_END = "the sweep was cancelled", 10.0


def sweep(
    case: Case,
    parameters: Mapping[str, Iterable[Any]] | Sequence[Mapping[str, Any]],
    *,
    collect: Callable[[Results], Mapping[str, float]] | None = None,
    directory: str | os.PathLike = "results/sweep",
    processes: int | None = None,
    executor: Executor | None = None,
    again: bool | Literal["failed"] = False,
    progress: bool = True,
    **options: Any,
) -> SweepTable:
    """Run a model for many values of its parameters, several at a time.

    Existing runs in the directory are not repeated if their decks are unchanged, and the files that these read. An interrupted
    sweep (Ctrl-C, SIGTERM) ends the programs that run for it, says how many runs have finished, and continues with the others
    when it is called again. Failed runs are reported by a warning and remain in the table.

    Parameters
    ----------
    case : callable or path
        A function of the parameters by name that returns a `Model`, a `Deck`, the text or the path of a deck, or the values
        themselves; or a deck in which `{name}` stands for each parameter.
    parameters : mapping or sequence of mappings
        Values of each parameter, of which all combinations are run; or the combinations one by one.
    collect : callable, optional
        What goes into the table: a function of the `Results` that returns numbers by name. Left out: `contacts`, their number
        at the end as the lines of a run have it, `contact force`, the sum of their forces, also on rigid surfaces, the last row
        of the history, and the `conductance A to B` of each `resistance A to B` in it.
    directory : path
        Directory of decks and results, with a subdirectory for each run.
    processes : int, optional
        Runs at a time; the number of processors when left out.
    executor : concurrent.futures.Executor, optional
        What runs them, in place of threads of this process: `ProcessPoolExecutor()`, `Client(...).get_executor()` of
        dask.distributed, `MPIPoolExecutor()` of mpi4py.futures. Its workers need litz and the same directory; `case` and
        `collect` are sent to them, for which they have to be functions of a module (dask takes any). It is not shut down.
    again : bool or "failed"
        True: repeat all runs; "failed": those that failed.
    progress : bool
        Show the number of finished runs: a line on a terminal, a bar in a notebook, a line at the end in a log.
    **options
        As those of `litz.run`; `threads` is 1 when left out.

    Returns
    -------
    SweepTable
        A row for each run, in the order of the parameters: the parameters, `status` ("finished" or "failed"), the values
        (nan where a run failed), `warnings` (their number), `message` and `directory`; `over("seed")` gives means and standard
        deviations, `to_pandas()` makes a data frame of it.

    Examples
    --------
    >>> def square(side):
    ...     return {"area": side**2}
    >>> table = sweep(square, {"side": [1.0, 2.0]}, directory=None, progress=False)
    >>> table["area"].tolist()
    [1.0, 4.0]

    With a deck: `litz.sweep("wires.inp", {"push": [1e-4, 2e-4]})`, where wires.inp has `UPPER, 3, 3, {push}`.
    """
    combinations = _combinations(parameters)
    if processes is not None and (isinstance(processes, bool) or processes < 1):
        raise ValueError(f"processes must be 1 or more, not {processes}")
    if executor is not None and processes is not None:
        raise ValueError("processes is for threads of this process: an executor has its own number of workers")
    if again not in (True, False, "failed"):
        raise ValueError(f'again must be True, False or "failed", not {again!r}')
    for name in options:
        if name not in _RUN_OPTIONS:
            raise TypeError(unknown_name("option", name, [*_RUN_OPTIONS, *_SWEEP_OPTIONS]))
    make = case if callable(case) else _Template(Path(case), combinations[0])
    if callable(case):
        check_call(case, combinations[0])
    options = {"threads": 1, **options}
    home = None if directory is None else Path(directory)
    if home is not None and executor is not None:
        # workers may be elsewhere
        home = home.absolute()
    running = None if home is None else home / f"running-{uuid.uuid4().hex[:8]}"
    runs = [_Run(make, combination, collect, home, options, again, running) for combination in combinations]
    count = _Count(len(runs)) if progress else None
    pool = executor or ThreadPoolExecutor(processes or os.cpu_count() or 1)
    try:
        with _ended_by_sigterm():
            runs = _run_all(runs, pool, running, count)
    finally:
        if executor is None:
            pool.shutdown(cancel_futures=True)
        if count is not None:
            count.close()
    _warn_of_failures(runs)
    return _table(runs)


@contextmanager
def _ended_by_sigterm() -> Iterator[None]:
    """SIGTERM ends this process as `sys.exit` does, so that what runs for it ends, too: workers of a pool would stay for ever.

    Only where nobody else handles it, and in the main thread, which alone can.
    """
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGTERM) != signal.SIG_DFL:
        yield
        return
    parent = os.getpid()

    def end(number: int, frame: FrameType | None) -> None:
        # a worker that was forked meanwhile has this handler, too
        if os.getpid() != parent:
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)
            return
        sys.exit(128 + number)

    signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _run_all(runs: list["_Run"], pool: Executor, running: Path | None, count: "_Count | None") -> list["_Run"]:
    """The runs after they have been run. Each ends when the file `running` is gone, which all workers see."""
    if running is not None:
        running.parent.mkdir(parents=True, exist_ok=True)
        running.touch()
    places: dict[Future, int] = {}
    done = list(runs)
    try:
        places = {pool.submit(one): place for place, one in enumerate(runs)}
        for future in as_completed(places):
            done[places[future]] = _result(future)
            if count is not None:
                count.add(done[places[future]])
    finally:
        if running is not None:
            running.unlink(missing_ok=True)
        for future in places:
            future.cancel()
        wait(places, _TIME_TO_END)
    return done


def _result(future: "Future[_Run]") -> "_Run":
    """A run that is over; an error that says what cannot be sent to another process."""
    try:
        return future.result()
    except BrokenExecutor:
        raise
    except (PicklingError, AttributeError, TypeError) as error:
        raise ValueError(
            f"case or collect cannot be sent to the workers of the executor ({error}): define them in a module, not in a "
            "function or a notebook"
        ) from error


def _combinations(parameters: Mapping[str, Iterable[Any]] | Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The parameters of each run."""
    if isinstance(parameters, Mapping):
        values = {}
        for name, given in parameters.items():
            if isinstance(given, str) or not isinstance(given, Iterable):
                raise ValueError(f"the parameter {name} needs a sequence of values, not {given!r}")
            values[name] = [_plain(value) for value in given]
            if not values[name]:
                raise ValueError(f"the parameter {name} has no values")
        combinations = [dict(zip(values, one, strict=True)) for one in itertools.product(*values.values())]
    else:
        combinations = [{name: _plain(value) for name, value in one.items()} for one in parameters]
        if any(set(one) != set(combinations[0]) for one in combinations):
            raise ValueError("all combinations need the same parameters")
    if not combinations or not combinations[0]:
        raise ValueError("a sweep needs at least one parameter with at least one value")
    taken = set(OWN_COLUMNS) & set(combinations[0])
    if taken:
        raise ValueError(f"a parameter may not be called {taken.pop()}: the table has a column of this name")
    if len({_key(one) for one in combinations}) < len(combinations):
        raise ValueError("two runs have the same parameters")
    return combinations


def check_call(case: Callable[..., Any], combination: Mapping[str, Any]) -> None:
    """An error if a function does not take the parameters: each run would fail for it."""
    try:
        signature = inspect.signature(case)
    except (TypeError, ValueError):
        # not all callables tell
        return
    try:
        signature.bind(**combination)
    except TypeError as error:
        name = getattr(case, "__name__", "the case")
        raise TypeError(
            f"{name}{signature} cannot be called with the parameters {', '.join(combination)}: {error}"
        ) from None


def _plain(value: Any) -> Any:
    """A numpy number as a Python number."""
    return value.item() if isinstance(value, np.generic) else value


def _key(combination: Mapping[str, Any]) -> str:
    return json.dumps(combination, sort_keys=True, default=str)


class _Template:
    """A deck with places for parameters."""

    def __init__(self, path: Path, combination: Mapping[str, Any]):
        self._path = path
        try:
            self._text = path.read_text(encoding="utf-8")
        except OSError as error:
            raise FileError(f"cannot read the deck {path}: {error.strerror}") from None
        places = set(_PLACE.findall(self._text))
        for name in sorted(set(combination) - places):
            there = ", ".join(f"{{{place}}}" for place in sorted(places)) or "none"
            raise ValueError(f"{path} has no place {{{name}}}{nearest_name(name, places)}; there are: {there}")
        for name in sorted(places - set(combination)):
            raise ValueError(f"{path} has the placeholder {{{name}}}, for which there is no parameter")

    def __call__(self, **parameters: Any) -> Deck:
        """The deck for some parameters."""
        deck = Deck.parse(_PLACE.sub(lambda place: to_text(parameters[place[1]]), self._text))
        deck.path = self._path
        return deck


class _Run:
    """One run of a sweep."""

    def __init__(
        self,
        make: Callable[..., Any],
        parameters: dict[str, Any],
        collect: Callable[[Results], Mapping[str, float]] | None,
        home: Path | None,
        options: dict[str, Any],
        again: bool | str,
        running: Path | None = None,
    ):
        self._make, self._collect, self._options, self._again = make, collect, options, again
        self._running = running
        self.parameters = parameters
        label = "_".join(f"{name}={to_text(value)}" for name, value in parameters.items())
        name = re.sub(r"[^\w.=+-]", "", label)[:_MAX_NAME_LENGTH]
        digest = hashlib.sha256(_key(parameters).encode()).hexdigest()[:8]
        self.directory = None if home is None else home / f"{name}-{digest}"
        self.status, self.message = "failed", ""
        self.n_warnings = 0
        self.values: dict[str, float] = {}
        self.units: dict[str, str] = {}

    def __call__(self) -> "_Run":
        """Run it, or reuse the results of an earlier sweep."""
        if self._is_cancelled():
            self.message = _CANCELLED
            return self
        try:
            made = self._make(**self.parameters)
            if isinstance(made, Mapping | float | int | np.number):
                self.values = _numbers(made if isinstance(made, Mapping) else {"value": made})
                self.status = "finished"
                return self
            self._run_deck(made)
        except Exception as error:
            # an error in the user's function concerns this run only; the others continue
            self.message = str(error) if isinstance(error, LitzError) else f"{type(error).__name__}: {error}"
            self._keep(None)
        return self

    def _is_cancelled(self) -> bool:
        return self._running is not None and not self._running.exists()

    def _run_deck(self, made: Any) -> None:
        if self.directory is None:
            raise ValueError("a sweep that runs decks needs a directory")
        self.directory.mkdir(parents=True, exist_ok=True)
        deck = self.directory / "deck.inp"
        fresh = self.directory / "fresh.inp"
        if isinstance(made, Model | Deck):
            made.write(fresh)
        elif isinstance(made, str) and "\n" in made:
            fresh.write_text(made, encoding="utf-8")
        elif isinstance(made, str | os.PathLike):
            Deck.read(made).write(fresh)
        else:
            raise TypeError(f"the case must return a Model, a Deck, a deck or numbers by name, not {made!r}")
        identity = _identity(fresh, self._options)
        if self._taken_over(self.directory, identity):
            fresh.unlink()
            return
        fresh.replace(deck)
        (self.directory / _OUTCOME).unlink(missing_ok=True)
        try:
            results = run_silently(deck, output_directory=self.directory, while_exists=self._running, **self._options)
        except LitzError as error:
            if self._is_cancelled():
                self.message = _CANCELLED
                return
            self.message, self.n_warnings = str(error), len(error.warnings)
            # a full disk, or another run in the same directory: a later sweep should try again
            self._keep(None if isinstance(error, FileError) else identity)
            return
        self.n_warnings = len(results.warnings)
        self.values = _numbers(self._collected(results))
        self.status = "finished"
        self._keep(identity)

    def _collected(self, results: Results) -> Mapping[str, float]:
        if self._collect is not None:
            return self._collect(results)
        history = results.history
        self.units = {**history.units, "contact force": results.unit_labels["N"]}
        ledgers = (results.written_contacts_at(-1), results.surface_contacts_at(-1))
        values = {
            "contacts": float(sum(ledger.n_rows for ledger in ledgers)),
            "contact force": float(sum(ledger["force"].sum() for ledger in ledgers if ledger.n_rows)),
        }
        if not results.has_contacts()[-1]:
            # the last increment of a step has them, unless the deck wants none
            values = dict.fromkeys(values, math.nan)
        for name in (name for name in history if name not in ("step", "increment", "time")):
            values[name] = history[name][-1]
            if name.startswith(_RESISTANCE):
                conductance = _CONDUCTANCE + name.removeprefix(_RESISTANCE)
                values[conductance] = 1 / values[name] if values[name] else math.inf
                self.units[conductance] = unit_of_conductance(history.units[name])
        # a parameter of this name is in the table already
        return {name: value for name, value in values.items() if name not in self.parameters}

    def _taken_over(self, directory: Path, identity: str) -> bool:
        """Reuse the run of an earlier sweep, if there is one; its values are collected anew."""
        try:
            outcome = json.loads((directory / _OUTCOME).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return False
        if outcome.get("identity") != identity or self._again is True:
            return False
        if outcome[STATUS] == "failed":
            self.message, self.n_warnings = outcome[MESSAGE], outcome.get(WARNINGS, 0)
            return self._again != "failed"
        results = Results(directory / "deck.vtkhdf")
        self.n_warnings = len(results.warnings)
        self.values = _numbers(self._collected(results))
        self.status = "finished"
        return True

    def _keep(self, identity: str | None) -> None:
        if self.directory is None or identity is None:
            return
        outcome = {
            "identity": identity,
            "parameters": self.parameters,
            STATUS: self.status,
            WARNINGS: self.n_warnings,
            MESSAGE: self.message,
        }
        (self.directory / _OUTCOME).write_text(json.dumps(outcome, default=str, indent=1), encoding="utf-8")


def _identity(deck: Path, options: Mapping[str, Any]) -> str:
    """A digest of all that the results depend on: the deck, the files that it reads, the options, and the restart file."""
    digest = hashlib.sha256(deck.read_bytes() + repr(sorted(options.items())).encode())
    files = list(files_beside(deck))
    if options.get("restart") is not None:
        # behind its name there may be a step and an increment
        restart = Path(re.sub(r":\d+:\d+$", "", os.fspath(options["restart"])))
        files += [restart] if restart.is_file() else []
    for path in files:
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def _numbers(values: Mapping[str, Any]) -> dict[str, float]:
    """Values of a run, each a number."""
    if not isinstance(values, Mapping):
        raise TypeError(f"the values of a run are numbers by name, as {{'force': 1.5}}, not {type(values).__name__}")
    numbers = {}
    for name, value in values.items():
        if np.ndim(value) != 0:
            raise ValueError(f"the value {name} must be one number, not an array of shape {np.shape(value)}")
        numbers[name] = float(value)
    return numbers


def _warn_of_failures(runs: list[_Run]) -> None:
    failed = [one for one in runs if one.status == "failed"]
    if failed:
        first = ", ".join(f"{name}={value}" for name, value in failed[0].parameters.items())
        warnings.warn(
            f"{len(failed)} of {len(runs)} runs failed; the first, {first}: {failed[0].message}",
            stacklevel=3,
        )


def _table(runs: list[_Run]) -> SweepTable:
    columns: dict[str, np.ndarray] = {
        name: np.array([one.parameters[name] for one in runs]) for name in runs[0].parameters
    }
    columns[STATUS] = np.array([one.status for one in runs])
    units = {name: unit for one in runs for name, unit in one.units.items()}
    for name in dict.fromkeys(name for one in runs for name in one.values):
        if name in (*columns, *OWN_COLUMNS):
            raise ValueError(f"the values may not hold {name}: the table has a column of this name")
        columns[name] = np.array([one.values.get(name, np.nan) for one in runs])
    columns[WARNINGS] = np.array([one.n_warnings for one in runs])
    columns[MESSAGE] = np.array([one.message for one in runs])
    columns[DIRECTORY] = np.array([str(one.directory or "") for one in runs])
    return SweepTable(columns, {name: units.get(name, "") for name in columns}, list(runs[0].parameters))


class _Count:
    """A line on a terminal, or a bar in a notebook, with the number of finished runs."""

    def __init__(self, total: int):
        self._total, self._done, self._failed = total, 0, 0
        self._start = time.monotonic()
        self._lock = threading.Lock()
        self._handle = notebook.place()
        self._on_terminal = self._handle is None and sys.stderr.isatty()

    def add(self, one: _Run) -> None:
        """Count a run."""
        with self._lock:
            self._done += 1
            self._failed += one.status == "failed"
            if self._handle is not None:
                self._handle.update(notebook.bar(self._done / self._total, self._text()))
            elif self._on_terminal:
                sys.stderr.write(f"\r{self._text():79}")
                sys.stderr.flush()

    def close(self) -> None:
        """End the line."""
        if self._handle is not None:
            return
        sys.stderr.write(("\r" if self._on_terminal else "") + f"{self._text():79}".rstrip() + "\n")
        sys.stderr.flush()

    def _text(self) -> str:
        failed = f", {self._failed} failed" if self._failed else ""
        return f"{self._done} of {self._total} runs{failed}, {time.monotonic() - self._start:.0f} s"
