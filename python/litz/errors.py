"""The exceptions and warnings of litz."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class WarningEntry:
    """A warning of a run, and how often it occurred.

    `str(entry)` is the message with the counts.

    Attributes
    ----------
    kind : str
        Identifier, such as "shallow_angle"; docs/results.md has a list.
    message : str
        The message, as of the first increment with this warning.
    elements : tuple of int
        Numbers in the deck of the elements concerned: none, one or two.
    step, increment : int
        First increment with this warning; 0, 0 is the start of the run.
    time : float
        Total time of it [s].
    last_step, last_increment : int
        Last increment with this warning.
    last_time : float
        Total time of it [s].
    count : int
        Number of increments with this warning.
    worst : float or None
        Worst value over these increments, in `unit`; None where the warning has no value.
    unit : str
        Such as "degrees"; empty where the warning has no value.
    is_rest : bool
        It summarizes all elements beyond the first hundred with this kind of warning.
    """

    kind: str
    message: str
    elements: tuple[int, ...] = ()
    step: int = 0
    increment: int = 0
    time: float = 0.0
    last_step: int = 0
    last_increment: int = 0
    last_time: float = 0.0
    count: int = 1
    worst: float | None = None
    unit: str = ""
    is_rest: bool = False

    def __str__(self) -> str:
        """The message; if repeated, with the increments and the worst value."""
        if self.count == 1:
            return self.message
        worst = f", worst {self.worst:.6g} {self.unit}" if self.worst is not None else ""
        return f"{self.message} ({self.count} increments, {self.first} to {self.last}{worst})"

    @property
    def first(self) -> str:
        """First increment as STEP:INCREMENT, or "the start"."""
        return f"{self.step}:{self.increment}" if self.step else "the start"

    @property
    def last(self) -> str:
        """Last increment as STEP:INCREMENT, or "the start"."""
        return f"{self.last_step}:{self.last_increment}" if self.last_step else "the start"


class RunWarning(RuntimeWarning):
    """A warning of a run; `litz.Results.warnings` has it as data.

    `warnings.filterwarnings("ignore", category=litz.RunWarning)` suppresses all of them, "error" turns them into
    exceptions. `entry` is the `WarningEntry`, or None without a result file.
    """

    def __init__(self, message: str, entry: WarningEntry | None = None):
        super().__init__(message)
        self.entry = entry


class LitzError(Exception):
    """The program ended with an error; `str(error)` is the program's own message.

    `exit_code` is the program's exit code, `results_path` the result file up to that point (or None), and
    `warnings` the earlier warnings of the run, a list like `Results.warnings`.
    """

    exit_code = 5

    def __init__(self, message: str, results_path: Path | None = None):
        super().__init__(message)
        self.results_path = results_path
        self.warnings: list[WarningEntry] = []


class InputError(LitzError):
    """The deck or the arguments are invalid."""

    exit_code = 1


class NotConvergedError(LitzError):
    """The Newton iteration gave up; the increments before it are in the result file."""

    exit_code = 2


class SolverError(LitzError):
    """The linear system could not be solved."""

    exit_code = 3


class FileError(LitzError):
    """A file could not be read or written."""

    exit_code = 4


class InternalError(LitzError):
    """An internal error of the program."""

    exit_code = 5


class OutOfMemoryError(LitzError):
    """The model does not fit into the memory of this machine, or exceeds the memory limit of the process."""

    exit_code = 6
