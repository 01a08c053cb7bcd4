"""What acts on a model: degrees of freedom and their names, prescribed values, loads, amplitudes."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..deck.keyword_table import check_card, check_name, keyword
from ..deck.lines import CardSpec

#: A node number or the name of a node set
Target = int | str
#: Degree of freedom: its number, as in Abaqus, or its name
Direction = int | str
#: Names of supports, and the degrees of freedom that they hold
SUPPORTS = {
    "ENCASTRE": (1, 2, 3, 4, 5, 6), "PINNED": (1, 2, 3),
    "XSYMM": (1, 5, 6), "YSYMM": (2, 4, 6), "ZSYMM": (3, 4, 5),
    "XASYMM": (2, 3, 4), "YASYMM": (1, 3, 5), "ZASYMM": (1, 2, 6),
}  # fmt: skip
#: Cards that have the time of their step
PROCEDURES = ("STATIC", "COUPLED THERMAL-ELECTRICAL", "COUPLED TEMPERATURE-DISPLACEMENT")


def directions_of(card: str, value: str) -> dict[str, int]:
    """Names and numbers of the degrees of freedom that a value of a card may be, from the keyword table.

    Examples
    --------
    >>> directions_of("CLOAD", "dof")
    {'x': 1, 'y': 2, 'z': 3, 'rx': 4, 'ry': 5, 'rz': 6}
    """
    directions: dict[str, int] = {}
    for field in _fields_of(card, value):
        numbers = range(field["first"], field["last"] + 1)
        axes = ["rx", "ry", "rz"] if field["rotation"] else ["x", "y", "z"]
        directions |= zip(axes if len(numbers) == 3 else [field["name"]], numbers, strict=True)
    return directions


def direction_names(numbers: Iterable[int]) -> list[str]:
    """Names of degrees of freedom.

    Examples
    --------
    >>> direction_names([3, 4, 9])
    ['z', 'rx', 'potential']
    """
    names = {number: name for name, number in directions_of("BOUNDARY", "first").items()}
    return [names[number] for number in numbers]


def unit_of(number: int) -> str:
    """SI unit of a degree of freedom.

    Examples
    --------
    >>> unit_of(3), unit_of(9)
    ('m', 'V')
    """
    return next(one["unit"] for one in _fields_of("BOUNDARY", "first") if one["first"] <= number <= one["last"])


def degrees_of_freedom(field: str) -> range:
    """Numbers of the degrees of freedom of a field.

    Examples
    --------
    >>> degrees_of_freedom("rotation")
    range(4, 7)
    """
    found = next(one for one in _fields_of("BOUNDARY", "first") if one["name"] == field)
    return range(found["first"], found["last"] + 1)


def describe_fields() -> tuple[str, str]:
    """Degrees of freedom of all fields, and their units, in words.

    Examples
    --------
    >>> describe_fields()
    ('1-3 displacement, 4-6 rotation, 9 potential, 11 temperature', 'm, rad, V, K')
    """
    fields = _fields_of("BOUNDARY", "first")
    ranges = [f"{one['first']}-{one['last']}" if one["last"] > one["first"] else str(one["first"]) for one in fields]
    names = [f"{numbers} {one['name']}" for numbers, one in zip(ranges, fields, strict=True)]
    return ", ".join(names), ", ".join(one["unit"] for one in fields)


def _fields_of(card: str, value: str) -> list[dict[str, Any]]:
    values = keyword(card)["data"][0]["values"]
    return next(one["fields"] for one in values if one["name"] == value)


def _group(name: str) -> Iterable[int] | None:
    """Degrees of freedom that one word stands for; None: it is no such word."""
    if name == "encastre":
        return directions_of("CLOAD", "dof").values()
    field = {"pinned": "displacement", "rotations": "rotation"}.get(name)
    return degrees_of_freedom(field) if field else None


def degree_of_freedom(direction: Direction, allowed: Iterable[int] | None = None) -> int:
    """Number of a degree of freedom, one of those `allowed`, or any without them.

    Examples
    --------
    >>> degree_of_freedom("z"), degree_of_freedom("rx"), degree_of_freedom(9)
    (3, 4, 9)
    """
    directions = directions_of("BOUNDARY", "first")
    number = directions.get(direction.lower()) if isinstance(direction, str) else direction
    allowed = list(directions.values() if allowed is None else allowed)
    if not isinstance(number, Integral) or number not in allowed:
        names = ", ".join(f'"{name}" ({number})' for name, number in directions.items() if number in allowed)
        raise ValueError(f"a direction must be one of {names}, not {direction!r}")
    return int(number)


def ranges_of(directions: Sequence[Direction]) -> list[tuple[int, int]]:
    """First and last of each run of degrees of freedom; ENCASTRE without any.

    Examples
    --------
    >>> ranges_of(["x", "y", "rotations"])
    [(1, 2), (4, 6)]
    """
    numbers: set[int] = set()
    for direction in directions or ("encastre",):
        group = _group(direction.lower()) if isinstance(direction, str) else None
        numbers |= set(group) if group else {degree_of_freedom(direction)}
    runs: list[tuple[int, int]] = []
    for number in sorted(numbers):
        if runs and number == runs[-1][1] + 1:
            runs[-1] = (runs[-1][0], number)
        else:
            runs.append((number, number))
    return runs


@dataclass(frozen=True)
class Amplitude:
    """A factor over time, linear between the points and constant beyond them.

    Attributes
    ----------
    name : str
        Name in the deck.
    t : tuple of float
        Times, ascending [s].
    a : tuple of float
        Factor at each [-].
    time : {"STEP TIME", "TOTAL TIME"}
        Origin of the times.
    """

    name: str
    t: tuple[float, ...]
    a: tuple[float, ...]
    time: str = "STEP TIME"

    def __post_init__(self) -> None:
        """Checks the values."""
        check_name(self.name, "the name of an amplitude")
        for name in ("t", "a"):
            object.__setattr__(self, name, tuple(float(value) for value in getattr(self, name)))
        if len(self.t) != len(self.a) or not self.t:
            raise ValueError(
                f"an amplitude needs a factor for each time; found {len(self.t)} times, {len(self.a)} factors"
            )
        if any(later <= earlier for earlier, later in zip(self.t, self.t[1:], strict=False)):
            raise ValueError("the times of an amplitude must ascend")
        for card in self.cards():
            check_card(*card)

    def cards(self) -> Iterator[CardSpec]:
        """The card of the amplitude."""
        parameters = {"NAME": self.name}
        if self.time != "STEP TIME":
            parameters["TIME"] = self.time
        points = [value for point in zip(self.t, self.a, strict=True) for value in point]
        yield "AMPLITUDE", parameters, [points[i : i + 8] for i in range(0, len(points), 8)]


@dataclass(frozen=True)
class Prescribed:
    """A line of `*BOUNDARY`: `value` [m, rad, V] for the degrees of freedom `first` to `last` of a node or node set."""

    target: Target
    first: int
    last: int
    value: float = 0.0
    amplitude: str | None = None
    #: It stays what it is when the step begins
    fixed: bool = False

    def row(self) -> list:
        """The values of the line; zeros are left out."""
        if self.value:
            return [self.target, self.first, self.last, self.value]
        return [self.target, self.first, self.last] if self.last != self.first else [self.target, self.first]


@dataclass(frozen=True)
class Temperature:
    """A line of `*TEMPERATURE` [K]."""

    target: Target
    value: float
    amplitude: str | None = None

    def row(self) -> list:
        """The values of the line."""
        return [self.target, self.value]


@dataclass(frozen=True)
class Load:
    """A line of `*CLOAD` [N, N m], `*CECURRENT` [A] or `*CFLUX` [W]."""

    target: Target
    dof: int
    value: float
    amplitude: str | None = None

    def row(self) -> list:
        """The values of the line."""
        return [self.target, self.dof, self.value]


@dataclass(frozen=True)
class ElementLoad:
    """A line of `*DLOAD` or `*LORENTZ`; without a target it acts on all wires."""

    card: str
    target: str | None
    values: tuple
    amplitude: str | None = None
    #: Axis along which `*LORENTZ` gives the field at places
    along: str | None = None
    #: Lines of one table have the same number
    table: int = 0

    def row(self) -> list:
        """The values of the line."""
        return [self.target, *self.values]


def field_rows(
    field: ArrayLike,
    gradient: Sequence[Sequence[float]] | None,
    along: str | None,
    places: Sequence[float] | Sequence[Sequence[float]] | None,
) -> list[list[float]]:
    """Values of the lines of `*LORENTZ`; the arguments are those of `Step.lorentz`."""
    if (along is None) != (places is None):
        raise ValueError("a field at places needs both, along= and places=")
    values = np.asarray(field, dtype=float)
    if along is None or places is None:
        # the deck has the derivatives by x first
        rest = [] if gradient is None else [float(gradient[i][j]) for j in range(3) for i in range(3)]
        return [values.tolist() + rest]
    if gradient is not None:
        raise ValueError("a field at places has no gradient= of its own")
    if len(along) == 1:
        if values.shape != (len(places), 3):
            raise ValueError(f"{len(places)} places need a field of shape ({len(places)}, 3), not {values.shape}")
        return np.column_stack([values, np.asarray(places, dtype=float)]).tolist()
    if len(places) != 2 or any(np.ndim(one) != 1 for one in places):
        raise ValueError(
            f"a field over a plane, along={along!r}, needs the places along each of both axes: places=(first, second)"
        )
    axes = [np.asarray(one, dtype=float) for one in places]
    shape = (len(axes[0]), len(axes[1]), 3)
    if values.shape != shape:
        raise ValueError(f"{shape[0]} times {shape[1]} places need a field of shape {shape}, not {values.shape}")
    return np.dstack([values, *np.meshgrid(*axes, indexing="ij")]).reshape(-1, 5).tolist()


def grouped(
    card: str, items: Sequence[Prescribed | Load | Temperature | ElementLoad], op: str = "MOD"
) -> Iterator[CardSpec]:
    """Cards for prescribed values or loads: one for each run of lines with the same parameters.

    With `OP=NEW` and no lines a card that removes what earlier steps prescribed.
    """
    if op != "MOD" and not items:
        yield card, {"OP": op}, []

    def parameters_of(item: Prescribed | Load | Temperature | ElementLoad) -> tuple[str | None, bool, str | None, int]:
        return item.amplitude, getattr(item, "fixed", False), getattr(item, "along", None), getattr(item, "table", 0)

    for (amplitude, fixed, along, _), lines in groupby(items, parameters_of):
        parameters: dict[str, str | bool | None] = {} if op == "MOD" else {"OP": op}
        if amplitude is not None:
            parameters["AMPLITUDE"] = amplitude
        if fixed:
            parameters["FIXED"] = True
        if along is not None:
            parameters["ALONG"] = along
        yield card, parameters, [item.row() for item in lines]
