"""The warnings of a run, as its result file keeps them."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np


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


def read_warnings(path: Path) -> list[WarningEntry]:
    """The warnings in a result file, in the order in which they came; none in that of a litz before 0.2."""
    with h5py.File(path, "r", locking=False) as file:
        group = file.get("litz/warnings")
        if group is None:
            return []
        n = int(group.attrs["n_warnings"])
        lines = bytes(np.asarray(group["text"], np.uint8)).decode("utf-8", errors="replace").split("\n")[:n]
        integers, reals = group["integers"][:n].tolist(), group["reals"][:n].tolist()
    entries = []
    for line, row, (time, last_time, worst) in zip(lines, integers, reals, strict=True):
        kind, unit, message = line.split("\t", 2)
        step, increment, last_step, last_increment, count, is_rest = row[2:]
        entries.append(
            WarningEntry(
                kind,
                message,
                tuple(element for element in row[:2] if element > 0),
                step,
                increment,
                time,
                last_step,
                last_increment,
                last_time,
                count,
                worst if unit else None,
                unit,
                bool(is_rest),
            )
        )
    return entries
