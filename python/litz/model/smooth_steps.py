"""Amplitudes of Abaqus that are smooth steps, tables with rounded corners or closed curves, as tables of litz."""

from collections.abc import Iterable, Iterator
from itertools import pairwise

from ..deck import Card
from .amplitude_curves import curve_as_table

#: Pieces of a table for each smooth step: with these it is off by 0.2 % of the change
_PIECES = 20
#: The same for a rounded corner, and the largest share of an interval that one may take
_PIECES_OF_CORNERS, _MOST_ROUNDED = 8, 0.5
#: Times and factors on a data line
_ON_A_LINE = 8
#: Increments that a step may have without `INC`
_INCREMENTS = 100


def smooth_steps_as_tables(cards: list[Card]) -> Iterator[str]:
    """Rewrite amplitudes that are smooth steps, rounded, or at equal times; what is to be said of each.

    Source: Abaqus, amplitude curves: from (t0, a0) to (t1, a1) it is a0 + (a1 - a0) s^3 (10 - 15 s + 6 s^2) of
    s = (t - t0)/(t1 - t0).
    """
    before = {id(card): len(points_of(card)) for card in cards if card.is_a("AMPLITUDE") and "DEFINITION" not in card}
    yield from _as_tables(cards)
    added = [
        len(points_of(card)) - before.get(id(card), 0)
        for card in cards
        if card.is_a("AMPLITUDE") and "DEFINITION" not in card
    ]
    _leave_room(cards, max(added, default=0))


def _leave_room(cards: list[Card], points: int) -> None:
    """Let steps have as many increments more as end at points of a table."""
    for card in cards if points > 0 else ():
        if card.is_a("STEP"):
            card["INC"] = int(card.get("INC", _INCREMENTS)) + points


def _as_tables(cards: list[Card]) -> Iterator[str]:
    for card in cards:
        definition = str(card.get("DEFINITION", "")).upper() if card.is_a("AMPLITUDE") else ""
        if definition == "TABULAR":
            del card["DEFINITION"]
        elif "".join(definition.split()) == "EQUALLYSPACED" and "FIXED INTERVAL" in card:
            interval, begin = float(card["FIXED INTERVAL"]), float(card.get("BEGIN", 0))
            factors = [float(value) for row in card.data for value in row if value is not None]
            for name in ("DEFINITION", "FIXED INTERVAL", *["BEGIN"] * ("BEGIN" in card)):
                del card[name]
            write_table(card, (value for i, factor in enumerate(factors) for value in (begin + i * interval, factor)))
            yield f"DEFINITION=EQUALLY SPACED of *AMPLITUDE, NAME={card.get('NAME')} is a table"
        elif "".join(definition.split()) == "SMOOTHSTEP":
            del card["DEFINITION"]
            write_table(card, _table(points_of(card)))
            yield (
                f"DEFINITION=SMOOTH STEP of *AMPLITUDE, NAME={card.get('NAME')} is a table of {_PIECES} pieces for each step,"
                " off by 0.2 % of the change; increments end at their ends"
            )
        elif definition in ("PERIODIC", "MODULATED", "DECAY"):
            table = curve_as_table(card, definition, cards)
            if table:
                del card["DEFINITION"]
                write_table(card, table)
                yield (
                    f"DEFINITION={definition} of *AMPLITUDE, NAME={card.get('NAME')} is a table up to time {table[-2]:g},"
                    " off by 0.1 % of its coefficients between points; increments end at their ends"
                )
        if card.is_a("AMPLITUDE") and "SMOOTH" in card and definition in ("", "TABULAR"):
            share = float(card["SMOOTH"])
            if 0 <= share <= _MOST_ROUNDED:
                del card["SMOOTH"]
                write_table(card, _rounded(points_of(card), share))
                yield (
                    f"SMOOTH={share:g} of *AMPLITUDE, NAME={card.get('NAME')}: its rounded corners are a table of"
                    f" {_PIECES_OF_CORNERS} pieces each; increments end at their ends"
                )


def points_of(card: Card) -> list[tuple[float, float]]:
    """Times and factors; a comma may end a line, and a factor that is left out is 0."""
    return [
        (float(row[i] or 0), float((*row, None)[i + 1] or 0))
        for row in card.data
        for i in range(0, len(row), 2)
        if row[i] is not None
    ]


def write_table(card: Card, values: Iterable[float]) -> None:
    """Give an amplitude times and factors in turn."""
    table = list(values)
    card.data = [table[i : i + _ON_A_LINE] for i in range(0, len(table), _ON_A_LINE)]


def _rounded(points: list[tuple[float, float]], share: float) -> Iterator[float]:
    """Times and factors in turn, with parabolas that are tangent to both lines at each corner.

    Source: Abaqus, amplitude curves, SMOOTH: the part of the shorter interval beside a corner that they take on either side.
    """
    yield from points[0]
    last = points[0][0]
    for (t0, a0), (t1, a1), (t2, a2) in zip(points, points[1:], points[2:], strict=False):
        reach = share * min(t1 - t0, t2 - t1)
        before, after = (a1 - a0) / (t1 - t0), (a2 - a1) / (t2 - t1)
        for i in range(_PIECES_OF_CORNERS + 1) if reach > 0 else [0]:
            s = 2 * reach * i / _PIECES_OF_CORNERS
            time = float(f"{t1 - reach + s:.12g}")
            # corners that take half of an interval share a point in its middle
            if time > last:
                yield time
                yield float(f"{a1 - before * (reach - s) + (after - before) * s * (i / _PIECES_OF_CORNERS) / 2:.12g}")
            last = time
    if points[-1][0] > last:
        yield from points[-1]


def _table(points: list[tuple[float, float]]) -> Iterator[float]:
    """Times and factors in turn."""
    yield from points[0]
    for (t0, a0), (t1, a1) in pairwise(points):
        for i in range(1, _PIECES + 1):
            s = i / _PIECES
            yield float(f"{t0 + s * (t1 - t0):.12g}")
            yield float(f"{a0 + (a1 - a0) * s**3 * (10 - 15 * s + 6 * s**2):.12g}")
