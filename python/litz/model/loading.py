"""What acts on a model: degrees of freedom and their names, prescribed values, loads, amplitudes."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from numbers import Integral

from ..deck.keyword_table import check_card, check_name
from ..deck.lines import CardSpec

#: A node number or the name of a node set
Target = int | str
#: Degree of freedom: its number, as in Abaqus, or its name
Direction = int | str

_DIRECTIONS = {"x": 1, "y": 2, "z": 3, "rx": 4, "ry": 5, "rz": 6, "potential": 9}
_GROUPS = {"encastre": range(1, 7), "pinned": range(1, 4), "rotations": range(4, 7)}
POTENTIAL = _DIRECTIONS["potential"]


def degree_of_freedom(direction: Direction, allowed: Iterable[int] = (1, 2, 3, 4, 5, 6, 9)) -> int:
    """Number of a degree of freedom.

    Examples
    --------
    >>> degree_of_freedom("z"), degree_of_freedom("rx"), degree_of_freedom(9)
    (3, 4, 9)
    """
    number = _DIRECTIONS.get(direction.lower()) if isinstance(direction, str) else direction
    allowed = list(allowed)
    if not isinstance(number, Integral) or number not in allowed:
        names = ", ".join(f'"{name}" ({number})' for name, number in _DIRECTIONS.items() if number in allowed)
        raise ValueError(f"a direction must be one of {names}, not {direction!r}")
    return int(number)


def ranges_of(directions: Sequence[Direction]) -> list[tuple[int, int]]:
    """First and last of each run of degrees of freedom; ENCASTRE (1-6) without any.

    Examples
    --------
    >>> ranges_of(["x", "y", "rotations"])
    [(1, 2), (4, 6)]
    """
    numbers: set[int] = set()
    for direction in directions or ("encastre",):
        group = _GROUPS.get(direction.lower()) if isinstance(direction, str) else None
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

    def row(self) -> list:
        """The values of the line; zeros are left out."""
        if self.value:
            return [self.target, self.first, self.last, self.value]
        return [self.target, self.first, self.last] if self.last != self.first else [self.target, self.first]


@dataclass(frozen=True)
class Load:
    """A line of `*CLOAD` (`dof` 1-6) [N, N m] or `*CECURRENT` (`dof` 9) [A]."""

    target: Target
    dof: int
    value: float
    amplitude: str | None = None

    def row(self) -> list:
        """The values of the line."""
        return [self.target, self.dof, self.value]


def grouped(keyword: str, items: Sequence[Prescribed | Load], op: str = "MOD") -> Iterator[CardSpec]:
    """Cards for prescribed values or loads: one for each run of lines with the same amplitude.

    With `OP=NEW` and no lines a card that removes what earlier steps prescribed.
    """
    if op != "MOD" and not items:
        yield keyword, {"OP": op}, []
    begin = 0
    for end in range(1, len(items) + 1):
        if end < len(items) and items[end].amplitude == items[begin].amplitude:
            continue
        parameters: dict[str, str | None] = {} if op == "MOD" else {"OP": op}
        if items[begin].amplitude is not None:
            parameters["AMPLITUDE"] = items[begin].amplitude
        yield keyword, parameters, [item.row() for item in items[begin:end]]
        begin = end
