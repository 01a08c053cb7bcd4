"""The value of a parameter at which the outcome of a run changes, by bisection: quench energies, critical loads."""

import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import LitzError
from ..results import Results
from .sweep import Case, check_call, sweep
from .sweep_table import DIRECTORY, MESSAGE, STATUS

_REACHED = "reached"
#: Brackets whose ends are more than this factor apart are halved in logarithms
_WIDE = 2.0
#: What is zero beside the larger of the first two values
_ZERO = 1e-6


@dataclass(frozen=True)
class Bracket:
    """The value at which the outcome changes lies between these."""

    #: Nearest values known not to reach it, and to reach it, which is smaller where small values reach it
    below: float
    above: float
    #: Number of runs, those taken over from an earlier call included
    runs: int

    @property
    def value(self) -> float:
        """The middle."""
        return (self.below + self.above) / 2


def bisect(
    case: Case,
    parameter: str,
    between: tuple[float, float],
    reached: Callable[[Any], bool],
    *,
    tolerance: float = 0.01,
    directory: str | os.PathLike | None = "results/bisect",
    again: bool = False,
    **options: Any,
) -> Bracket:
    """Find the value of a parameter at which the outcome of a run changes, as the minimum quench energy of a strand.

    Runs are made one after the other, each in the middle of what is left, in logarithms as long as that spans more than a factor
    of two. Runs in the directory are not repeated if their decks are unchanged, and the files that these read.

    Parameters
    ----------
    case : callable or path
        A function of the parameter by its name that returns a `Model`, a `Deck`, the text or the path of a deck, or numbers; or a
        deck in which `{name}` stands for the parameter.
    parameter : str
        Name of the parameter, as "energy".
    between : tuple of two floats
        A value at which the outcome is not reached, and one at which it is, in any order.
    reached : callable
        Whether it is: a function of the `Results` of the run, or of the numbers that `case` has returned.
    tolerance : float
        Of the value, relative: the bracket at the end is at most twice that wide. Around zero it is a millionth of the larger
        of the two values wide.
    directory : path
        Directory of decks and results, with a subdirectory for each run; None where `case` returns numbers.
    again : bool
        Repeat runs that are in the directory.
    **options
        As those of `litz.run`; `threads` is 1 when left out.

    Returns
    -------
    Bracket
        `below` and `above` it, their middle `value`, and the number of `runs`.

    Raises
    ------
    ValueError
        If the outcome is the same at both ends.
    LitzError
        If a run fails: its message, the value and the directory.

    Examples
    --------
    >>> found = bisect(lambda side: side**2, "side", (1.0, 2.0), lambda area: area > 2.0, directory=None, tolerance=1e-3)
    >>> abs(found.value - 2**0.5) < 2e-3
    True
    """
    below, above = (float(value) for value in between)
    if not (math.isfinite(below) and math.isfinite(above)) or below == above:
        raise ValueError(f"between must be two different numbers, not {between}")
    if not tolerance > 0:
        raise ValueError(f"tolerance must be greater than 0, not {tolerance}")
    if callable(case):
        check_call(case, {parameter: below})
    outcome = _Outcome(case, parameter, reached, {"directory": directory, "again": again, **options})
    at_ends = outcome(below), outcome(above)
    if at_ends[0] == at_ends[1]:
        raise ValueError(
            f"the outcome is {'reached' if at_ends[0] else 'not reached'} at {parameter} = {below:g} and at {above:g}: between "
            "must be a value at which it is not reached, and one at which it is"
        )
    if at_ends[0]:
        below, above = above, below
    zero = _ZERO * max(abs(below), abs(above))
    while abs(above - below) > tolerance * abs(above + below):
        if below * above <= 0 and abs(above - below) <= zero:
            # the outcome changes at zero, of which nothing is a part
            break
        middle = _middle(below, above)
        if middle in (below, above):
            break
        if outcome(middle):
            above = middle
        else:
            below = middle
    return Bracket(below, above, outcome.runs)


def _middle(below: float, above: float) -> float:
    if below * above > 0 and not 1 / _WIDE <= above / below <= _WIDE:
        return math.copysign(math.sqrt(below * above), below)
    return (below + above) / 2


class _Outcome:
    """Whether it is reached at a value of the parameter."""

    def __init__(self, case: Case, parameter: str, reached: Callable[[Any], bool], options: dict[str, Any]):
        self._case, self._parameter, self._reached, self._options = case, parameter, reached, options
        self.runs = 0

    def __call__(self, value: float) -> bool:
        self.runs += 1
        table = sweep(
            self._judged if callable(self._case) else self._case,
            [{self._parameter: value}],
            collect=self._of_results,
            progress=False,
            **self._options,
        )
        if table[STATUS][0] == "failed":
            place = f" ({table[DIRECTORY][0]})" if table[DIRECTORY][0] else ""
            raise LitzError(f"the run at {self._parameter} = {value:g} failed{place}: {table[MESSAGE][0]}")
        return bool(table[_REACHED][0])

    def _of_results(self, results: Results) -> dict[str, float]:
        return {_REACHED: float(self._reached(results))}

    def _judged(self, **parameters: float) -> Any:
        """What the case returns, or the outcome where that are numbers."""
        made = self._case(**parameters)  # type: ignore[operator]
        if isinstance(made, Mapping | float | int | np.number):
            return {_REACHED: float(self._reached(made))}
        return made
