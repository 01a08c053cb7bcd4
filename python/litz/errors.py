"""The exceptions and warnings of litz."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class WarningEntry:
    """A warning of a run, and how often it came.

    `str(entry)` is the message with the counts.

    Attributes
    ----------
    kind : str
        Code word, such as "shallow_angle"; the README has a list.
    message : str
        What is to be known, as of the first increment that has it.
    elements : tuple of int
        Numbers in the deck of the elements that it is about: none, one or two.
    step, increment : int
        First increment that has it; 0, 0 is the start of the run.
    time : float
        Total time of it [s].
    last_step, last_increment : int
        Last increment that has it.
    last_time : float
        Total time of it [s].
    count : int
        Number of increments that have it.
    worst : float or None
        Worst value over these increments, in `unit`; None where the warning has no value.
    unit : str
        Such as "degrees"; empty where the warning has no value.
    is_rest : bool
        It stands for all elements beyond the first hundred with this kind of warning.
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
        """The message; where it came again, with the increments and the worst value."""
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
    """What a run has warned of; `litz.Results.warnings` has it as data.

    `warnings.filterwarnings("ignore", category=litz.RunWarning)` keeps quiet about all of them, "error" makes each one an
    exception. `entry` is the `WarningEntry`, or None where there is no result file to have it.
    """

    def __init__(self, message: str, entry: WarningEntry | None = None):
        super().__init__(message)
        self.entry = entry


class LitzError(Exception):
    """The program ended with an error; `str(error)` is the program's own message.

    `exit_code` is the program's exit code, `results_path` the result file as far as it was written (or None), and
    `warnings` what the run has warned of before, a list like `Results.warnings`.
    """

    exit_code = 5

    def __init__(self, message: str, results_path: Path | None = None):
        super().__init__(message)
        self.results_path = results_path
        self.warnings: list[WarningEntry] = []


class InputError(LitzError):
    """Something in the deck or in the arguments is wrong."""

    exit_code = 1


class NotConvergedError(LitzError):
    """The Newton iteration gave up; the increments before it are in the result file."""

    exit_code = 2


class SolverError(LitzError):
    """The linear equations have no solution."""

    exit_code = 3


class FileError(LitzError):
    """A file could not be read or written."""

    exit_code = 4


class InternalError(LitzError):
    """A defect of the program."""

    exit_code = 5


class OutOfMemoryError(LitzError):
    """The model does not fit into the memory of this machine, or into what the process may take of it."""

    exit_code = 6
