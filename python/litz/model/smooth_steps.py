"""Amplitudes of Abaqus that are smooth steps, as tables of litz."""

from collections.abc import Iterator
from itertools import pairwise

from ..deck import Card

#: Pieces of a table for each smooth step: with these it is off by 0.2 % of the change
_PIECES = 20
#: Times and factors on a data line
_ON_A_LINE = 8


def smooth_steps_as_tables(cards: list[Card]) -> Iterator[str]:
    """Rewrite amplitudes that are smooth steps; what is to be said of each.

    Source: Abaqus, amplitude curves: from (t0, a0) to (t1, a1) it is a0 + (a1 - a0) s^3 (10 - 15 s + 6 s^2) of
    s = (t - t0)/(t1 - t0).
    """
    for card in cards:
        definition = str(card.get("DEFINITION", "")).upper() if card.is_a("AMPLITUDE") else ""
        if definition == "TABULAR":
            del card["DEFINITION"]
        elif "".join(definition.split()) == "SMOOTHSTEP":
            # a comma may end a line, and a factor that is left out is 0
            points = [
                (float(row[i] or 0), float((*row, None)[i + 1] or 0))
                for row in card.data
                for i in range(0, len(row), 2)
                if row[i] is not None
            ]
            del card["DEFINITION"]
            table = list(_table(points))
            card.data = [table[i : i + _ON_A_LINE] for i in range(0, len(table), _ON_A_LINE)]
            yield (
                f"DEFINITION=SMOOTH STEP of *AMPLITUDE, NAME={card.get('NAME')} is a table of {_PIECES} pieces for each step,"
                " off by 0.2 % of the change; increments end at their ends"
            )


def _table(points: list[tuple[float, float]]) -> Iterator[float]:
    """Times and factors in turn."""
    yield from points[0]
    for (t0, a0), (t1, a1) in pairwise(points):
        for i in range(1, _PIECES + 1):
            s = i / _PIECES
            yield float(f"{t0 + s * (t1 - t0):.12g}")
            yield float(f"{a0 + (a1 - a0) * s**3 * (10 - 15 * s + 6 * s**2):.12g}")
