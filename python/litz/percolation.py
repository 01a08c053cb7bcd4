"""Whether wires lead from one electrode to the other, and from which density on they do.

`spans` says so of a run. `threshold` drops sticks on a square until they do, many times over: Li and Zhang (Phys. Rev. E 80,
040104, 2009) found 5.63726 sticks per square of their length where all crossings touch. Level sticks, which touch only the
highest of those they cross, need about three times as many.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .build.planar import Crossings, draw, find_crossings
from .results import Results

#: Sticks per square of their length where those that touch at all crossings lead across an infinite square
STICKS = 5.63726
#: Sticks are drawn up to this multiple of the threshold at a time, and of level ones, which touch less
_ENOUGH, _ENOUGH_LEVEL = 1.5, 4.0
#: The median of a normal distribution scatters by this much more than the mean
_MEDIAN = math.sqrt(math.pi / 2)


@dataclass(frozen=True)
class Threshold:
    """Density of sticks at which they begin to lead across a square.

    Attributes
    ----------
    density : float
        Median over all squares of the number of sticks per square of their length.
    error : float
        Its standard error.
    densities : (n) array
        That of each square.
    """

    density: float
    error: float
    densities: NDArray[np.float64] = field(repr=False)


def spans(results: Results | str | Path, increment: int = -1, *, plus: str = "PLUS", minus: str = "MINUS") -> bool:
    """Whether wires and the contacts between them that conduct lead from one electrode to the other.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    increment : int
        Index of the increment.
    plus, minus : str
        Node sets.

    Examples
    --------
    The share of films that conduct, over their density: `collect` of `litz.sweep`, and the mean over the seeds.

    >>> table = litz.sweep(make_film, {"n_wires": [45, 90], "seed": range(10)},             # doctest: +SKIP
    ...                    collect=lambda results: {"spans": litz.percolation.spans(results)})
    >>> table.over("seed")["spans"]                                                         # doctest: +SKIP
    """
    results = results if isinstance(results, Results) else Results(results)
    network = results.contact_network(increment)
    for name in (plus, minus):
        if name not in network.wires_at:
            raise KeyError(f"there is no node set {name!r}; there are: {', '.join(network.wires_at)}")
    conducting = network.wires[np.isfinite(network.resistance)]
    clusters = _Clusters(len(network.wire_length))
    for first, second in conducting.tolist():
        clusters.join(first, second)
    return bool({clusters.of(w) for w in network.wires_at[plus]} & {clusters.of(w) for w in network.wires_at[minus]})


def threshold(
    seeds: int | Iterable[int] = 100, *, ratio: float = 20.0, smallest_angle: float = 0.0, stacked: bool = False
) -> Threshold:
    """Density at which straight sticks on a square begin to lead from one side to the other.

    The median over squares converges to the threshold of an infinite square, because the probability of a path is one half there.

    Parameters
    ----------
    seeds : int or sequence of int
        Seeds of the squares, or their number.
    ratio : float
        Side of the squares in lengths of the sticks [-].
    smallest_angle : float
        A stick that would cross another at less than this angle [rad] is drawn anew, as `litz.build.nanowire_film` does.
    stacked : bool
        Each stick is level and touches only the highest ones of those that it crosses; otherwise all of them.

    Examples
    --------
    >>> found = threshold(4, ratio=5.0)
    >>> 4 < found.density < 7
    True
    """
    if not ratio >= 1:
        raise ValueError(f"ratio must be 1 or more, not {ratio:g}")
    if not 0 <= smallest_angle < math.pi / 2:
        raise ValueError(f"smallest_angle must be at least 0 and less than a right angle [rad], not {smallest_angle:g}")
    chosen = range(seeds) if isinstance(seeds, int) else list(seeds)
    if len(chosen) < 2:
        raise ValueError("a threshold needs two squares at least")
    found = [_first_path(np.random.default_rng(seed), ratio, smallest_angle, stacked) / ratio**2 for seed in chosen]
    return Threshold(
        float(np.median(found)), float(_MEDIAN * np.std(found, ddof=1) / math.sqrt(len(found))), np.array(found)
    )


def _first_path(rng: np.random.Generator, ratio: float, smallest_angle: float, stacked: bool) -> int:
    """Number of sticks of the length 1 with which there is a path across a square."""
    ends = np.empty((0, 2, 2))
    while True:
        count = math.ceil((_ENOUGH_LEVEL if stacked else _ENOUGH) * STICKS * ratio**2)
        ends = np.concatenate([ends, draw(rng, count, np.array([ratio, ratio]), 1.0)])
        found = find_crossings(ends, 1e-9)
        found = found.where(found.crosses)
        number = _path(ends, found, ratio, math.sin(smallest_angle), stacked)
        if number:
            return number


def _path(ends: NDArray, found: Crossings, ratio: float, smallest_sine: float, stacked: bool) -> int:
    """Number of sticks at the first path; 0: there is none."""
    first = np.searchsorted(found.wires[:, 1], np.arange(len(ends) + 1)).tolist()
    others, too_small = found.wires[:, 0].tolist(), (np.abs(found.sine) < smallest_sine).tolist()
    left, right = len(ends), len(ends) + 1
    clusters = _Clusters(len(ends) + 2)
    at_left, at_right = ends[:, :, 0].min(axis=1) <= 0, ends[:, :, 0].max(axis=1) >= ratio
    level: list[int] = [-1] * len(ends)
    count = 0
    for stick in range(len(ends)):
        rows = [row for row in range(first[stick], first[stick + 1]) if level[others[row]] >= 0]
        if any(too_small[row] for row in rows):
            continue
        top = max((level[others[row]] for row in rows), default=-1)
        level[stick] = top + 1
        for row in rows:
            if not stacked or level[others[row]] == top:
                clusters.join(stick, others[row])
        for is_there, side in ((at_left[stick], left), (at_right[stick], right)):
            if is_there:
                clusters.join(stick, side)
        count += 1
        if clusters.of(left) == clusters.of(right):
            return count
    return 0


class _Clusters:
    """Clusters of members that are joined (union-find)."""

    def __init__(self, count: int):
        self._parent = list(range(count))

    def of(self, member: int) -> int:
        """The member that stands for its cluster."""
        parent = self._parent
        while parent[member] != member:
            parent[member] = parent[parent[member]]
            member = parent[member]
        return member

    def join(self, first: int, second: int) -> None:
        """Put two members into one cluster."""
        self._parent[self.of(first)] = self.of(second)
