"""Weights of several steps: CalculiX adds them where they have other directions or sets, Abaqus and litz replace them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ..deck import Card
from ..deck.lines import Value

# Directions whose cosine is nearer to 1 are the same in CalculiX
_SAME = 1e-10


@dataclass
class _Weight:
    """A line of `*DLOAD` that acts, and the amplitude of its card."""

    row: list[Value]
    amplitude: str

    @property
    def direction(self) -> tuple[float, ...]:
        values = [float(value or 0) for value in [*self.row[3:6], 0, 0, 0][:3]]
        return tuple(value / (math.hypot(*values) or 1.0) for value in values)

    def is_of(self, other: "_Weight") -> bool:
        """Whether CalculiX takes one in place of the other: they have the same set and direction."""
        cosine = sum(one * two for one, two in zip(self.direction, other.direction, strict=True))
        return str(self.row[0]).upper() == str(other.row[0]).upper() and abs(cosine - 1.0) <= _SAME


def keep_weights_of_earlier_steps(cards: list[Card], dialect: str | None, path: Path) -> Iterator[str]:
    """Write weights of earlier steps again into the steps of a deck of CalculiX that add others, and tell which.

    Parameters
    ----------
    cards : list of Card
        Of a flat deck.
    dialect : {"abaqus", "ccx"}, optional
        Whose deck it is.
    path : Path
        The deck, for messages.
    """
    if dialect == "abaqus":
        return
    acting: list[_Weight] = []
    again: list[tuple[int, list[_Weight]]] = []
    for number, (first, last) in enumerate(_steps(cards), 1):
        loads = [card for card in cards[first:last] if card.is_a("DLOAD")]
        new = [weight for card in loads for weight in _weights(card)]
        kept = [weight for weight in acting if not any(weight.is_of(one) for one in new)]
        if any(str(card.get("OP", "")).upper() == "NEW" for card in loads):
            kept = []
        acting = kept + new
        if not new or not kept:
            continue
        if dialect is None:
            raise ValueError(
                f"{path}: GRAV of step {number} has another direction or set than that of an earlier step: in Abaqus it takes"
                " its place, in CalculiX it is added to it: which of them is meant must be told by --dialect abaqus or"
                " --dialect ccx (in Python dialect='abaqus' or dialect='ccx')"
            )
        amplitudes = {weight.amplitude.upper() for weight in (*kept, *new)}
        if len(amplitudes) > 1:
            names = " and ".join(name or "none" for name in sorted(amplitudes))
            raise ValueError(
                f"{path}: GRAV of step {number}: CalculiX adds it to that of earlier steps, with another *AMPLITUDE"
                f" ({names}): weights that act together have one in litz"
            )
        again.append((last, kept))
        yield (
            f"GRAV of step {number}: CalculiX adds it to that of earlier steps, as it has another direction or set; theirs is"
            " written there again"
        )
    for last, kept in reversed(again):
        for weight in kept:
            parameters = {"AMPLITUDE": weight.amplitude} if weight.amplitude else {}
            cards.insert(last, Card.make("DLOAD", parameters, [weight.row]))


def _steps(cards: list[Card]) -> Iterator[tuple[int, int]]:
    """First and last card of each step."""
    first = 0
    for place, card in enumerate(cards):
        if card.is_a("STEP"):
            first = place
        elif card.is_a("END STEP"):
            yield first, place


def _weights(card: Card) -> Iterator[_Weight]:
    """The lines of a `*DLOAD` that give weight."""
    for row in card.data:
        if len(row) > 2 and str(row[1]).upper() == "GRAV":
            yield _Weight(row, str(card.get("AMPLITUDE", "")))
