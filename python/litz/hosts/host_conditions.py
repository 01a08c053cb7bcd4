"""Supports, prescribed values and loads of the first step of a deck, for other programs."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..deck import Card
from ..deck.keyword_table import squeezed
from ..model.loading import PROCEDURES, SUPPORTS

#: Degree of freedom of the potential in decks
POTENTIAL = 9
#: What other programs are given: not temperatures, in whose place the potential stands there
_DOFS = (1, 2, 3, 4, 5, 6, POTENTIAL)


class HostConditions:
    """What holds at the end of the first step of a deck, amplitudes included.

    Attributes
    ----------
    supports : set
        Rows of nodes and degrees of freedom of decks that are zero all the time.
    prescribed : dict
        Other values, by row and degree of freedom.
    loads : dict
        Forces, moments and currents, the sum of those of the same place.
    local_axes : list
        Rows of nodes with local axes, with the type and the two points of a `*TRANSFORM`.
    """

    def __init__(self, cards: list[Card], node_numbers: NDArray[np.int64], node_sets: Mapping[str, NDArray[np.int64]]):
        self.supports: set[tuple[int, int]] = set()
        self.prescribed: dict[tuple[int, int], float] = {}
        self.loads: dict[tuple[int, int], float] = {}
        self.local_axes: list[tuple[NDArray[np.int64], str, list[float]]] = []
        self._row_of = {int(number): row for row, number in enumerate(node_numbers)}
        self._sets = {name.upper(): members for name, members in node_sets.items()}
        self._factors = _factors(cards)
        n_steps = 0
        for card in cards:
            n_steps += card.is_a("STEP")
            if n_steps > 1:
                break
            self._read(card)

    def _read(self, card: Card) -> None:
        if card.is_a("TRANSFORM"):
            points = [float(value or 0) for value in [*card.data[0], *[0.0] * 6][:6]]
            self.local_axes.append((self._rows(card["NSET"]), str(card.get("TYPE", "R")).upper(), points))
        elif card.is_a("BOUNDARY"):
            if str(card.get("OP", "")).upper() == "NEW":
                self.supports.clear()
                self.prescribed.clear()
            for place, value in self._boundary(card):
                self._prescribe(place, value)
        elif card.is_a("CLOAD") or card.is_a("CECURRENT"):
            rows: list[list[Any]] = card.data
            for where, dof, load, *_ in rows:
                for row in self._rows(where):
                    key = (int(row), int(dof) if card.is_a("CLOAD") else POTENTIAL)
                    self.loads[key] = self.loads.get(key, 0.0) + float(load) * self._factor(card)

    def _boundary(self, card: Card) -> Iterator[tuple[tuple[int, int], float]]:
        """Rows of nodes with degrees of freedom, and what they are to be."""
        for where, first, *rest in card.data:
            last, value = [*rest, None, None][:2]
            dofs = SUPPORTS[first.upper()] if isinstance(first, str) else _between(first, last)
            number = 0.0 if isinstance(first, str) else float(value or 0) * self._factor(card)
            for row in self._rows(where):
                for dof in dofs:
                    yield (int(row), dof), number

    def _prescribe(self, key: tuple[int, int], value: float) -> None:
        if value == 0:
            self.supports.add(key)
            self.prescribed.pop(key, None)
        else:
            self.prescribed[key] = value
            self.supports.discard(key)

    def _factor(self, card: Card) -> float:
        """What the amplitude of a card makes of its values."""
        return self._factors[squeezed(str(card["AMPLITUDE"]))] if "AMPLITUDE" in card else 1.0

    def _rows(self, where: Any) -> NDArray[np.int64]:
        """Rows of a node or of a node set."""
        return np.array([self._row_of[where]]) if isinstance(where, int) else self._sets[str(where).upper()]


def _factors(cards: list[Card]) -> dict[str, float]:
    """Factors of the amplitudes at the end of the first step, by their names; there both times are the same."""
    data: list[list[Any]] = next((card.data for card in cards if any(map(card.is_a, PROCEDURES))), [])
    total = (*data[0], None, None)[1] if data else None
    end = 1.0 if total is None else float(total)
    factors = {}
    for card in cards:
        if card.is_a("AMPLITUDE"):
            values = [float(value or 0) for row in card.data for value in row]
            factors[squeezed(str(card["NAME"]))] = float(np.interp(end, values[::2], values[1::2]))
    return factors


def _between(first: Any, last: Any) -> tuple[int, ...]:
    """Those of a range of degrees of freedom that other programs are given."""
    return tuple(dof for dof in range(int(first), int(first if last is None else last) + 1) if dof in _DOFS)
