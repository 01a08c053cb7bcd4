"""Amplitudes that are closed curves over time - Fourier series, modulated and decaying ones - as points of a table."""

import math
from collections.abc import Callable, Sequence

from ..deck import Card

#: How far a chord of the table may be off, in the sum of the coefficients, and how many points a table may have
_OFF, _MOST = 1e-3, 20_000
#: A jump as a part of the time that the table covers
_JUMP = 1e-6


def curve_as_table(card: Card, definition: str, cards: list[Card]) -> list[float]:
    """Times and factors in turn; empty: the data are not those of the curve, or the points too many.

    Parameters
    ----------
    card : Card
        The `*AMPLITUDE`.
    definition : {"PERIODIC", "MODULATED", "DECAY"}
        What its data mean.
    cards : list of Card
        The deck, whose steps say how long it is needed.

    Notes
    -----
    Source: Abaqus, amplitude curves. Before t0 all are A0, then with s = t - t0
    PERIODIC (N, w, t0, A0; A1, B1, A2, B2, ...): A0 + sum of An cos(n w s) + Bn sin(n w s);
    MODULATED (A0, A, t0, w1, w2): A0 + A sin(w1 s) sin(w2 s);
    DECAY (A0, A, t0, td): A0 + A exp(-s/td).
    """
    values = [0.0 if value is None else float(value) for row in card.data for value in row]
    curve = _CURVES[definition](values)
    if curve is None:
        return []
    begin, before, after, step = curve
    end = _time_of_steps(cards, total=str(card.get("TIME", "")).upper().startswith("TOTAL"))
    table: list[float] = []
    first = max(begin, 0.0)
    if first > 0:
        table = [0.0, before]
        # a point just before a jump, where there is one
        if abs(after(0.0) - before) > 0 and first > _JUMP * end:
            table += [_short(first - _JUMP * end), before]
    if first >= end:
        return [0.0, before, _short(end), before]
    count = max(1, math.ceil((end - first) / step)) if step > 0 else 1
    if count > _MOST:
        return []
    for i in range(count + 1):
        time = first + (end - first) * i / count
        table += [_short(time), _short(after(time - begin))]
    return table


#: When it begins, the factor before, that after a time since then, and the longest piece of a table
_Curve = tuple[float, float, Callable[[float], float], float]


def _periodic(values: Sequence[float]) -> _Curve | None:
    if len(values) < 4 or values[0] < 1 or values[0] != int(values[0]) or values[1] <= 0:
        return None
    n, w, begin, mean = int(values[0]), *values[1:4]
    pairs = [*values[4:], *[0.0] * (2 * n)][: 2 * n]
    cosines, sines = pairs[::2], pairs[1::2]

    def after(s: float) -> float:
        each = zip(cosines, sines, strict=True)
        return mean + sum(a * math.cos(k * w * s) + b * math.sin(k * w * s) for k, (a, b) in enumerate(each, 1))

    sizes = [math.hypot(a, b) for a, b in zip(cosines, sines, strict=True)]
    return begin, mean, after, _piece(sum(sizes), sum((k * w) ** 2 * size for k, size in enumerate(sizes, 1)))


def _modulated(values: Sequence[float]) -> _Curve | None:
    if len(values) < 5:
        return None
    mean, size, begin, first, second = values[:5]
    bend = (abs(first) + abs(second)) ** 2 * abs(size)
    return begin, mean, lambda s: mean + size * math.sin(first * s) * math.sin(second * s), _piece(abs(size), bend)


def _decay(values: Sequence[float]) -> _Curve | None:
    if len(values) < 4 or values[3] <= 0:
        return None
    mean, size, begin, scale = values[:4]
    return begin, mean, lambda s: mean + size * math.exp(-s / scale), _piece(abs(size), abs(size) / scale**2)


_CURVES: dict[str, Callable[[Sequence[float]], _Curve | None]] = {
    "PERIODIC": _periodic, "MODULATED": _modulated, "DECAY": _decay,
}  # fmt: skip


def _piece(size: float, bend: float) -> float:
    """Length whose chord is off by no more than a part of the size, of a curve with a second derivative of at most `bend`."""
    return math.sqrt(8 * _OFF * size / bend) if bend > 0 else 0.0


def _time_of_steps(cards: list[Card], *, total: bool) -> float:
    """Time of all steps, or of the longest."""
    times = []
    for card in cards:
        if card.is_a("STATIC") or card.name.startswith("COUPLED") or card.is_a("HEAT TRANSFER"):
            values = [*(card.data or [[]])[0], None, None][:2]
            times.append(1.0 if values[1] is None or not float(values[1]) else float(values[1]))
    return (sum(times) if total else max(times, default=1.0)) or 1.0


def _short(value: float) -> float:
    return float(f"{value:.12g}")
