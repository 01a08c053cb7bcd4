"""Points of lines that a picture needs: less where they run straight and their colour hardly changes."""

import numpy as np

# Between two points lines turn by so much at most [rad], and values change by this part of the range of the colours
_TURN, _CHANGE = np.radians(3.0), 1 / 32
# Values that change more than so many times as much as before and behind have a step there, of this part of the range at least
_STEEPER, _LEAST_STEP = 2.0, 1e-3
# What turns more is a kink [rad]
_KINK = np.radians(20.0)
_SAME_RADIUS = 1e-6
# Pieces within which lines turn and change by less than this part of what they may
_FINE = 0.5


def needed_points(
    points: np.ndarray, starts: np.ndarray, radius: np.ndarray, value: np.ndarray, limits: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the points that are kept, and the first of each line among these, with the number of all at the end.

    Parameters
    ----------
    points : ndarray
        Of all lines, one line after the other, (n, 3) [m].
    starts : ndarray
        First point of each line, and n at the end.
    radius, value : ndarray
        At the points, (n).
    limits : tuple of float
        Range of the colours.
    """
    low, high = limits
    # where there is no value, it is far from all others
    value = np.where(np.isfinite(value), value, 2 * low - high - 1)
    within = np.ones(len(points) - 1, dtype=bool)
    within[starts[1:-1] - 1] = False
    chords = np.diff(points, axis=0)
    chords /= np.maximum(np.linalg.norm(chords, axis=1, keepdims=True), np.finfo(float).tiny)
    turn = np.arccos(np.clip(np.sum(chords[:-1] * chords[1:], axis=1), -1.0, 1.0)) * (within[:-1] & within[1:])
    change = np.abs(np.diff(value)) / ((high - low) or 1.0) * within
    beside = np.maximum(np.append(0.0, change[:-1]), np.append(change[1:], 0.0))
    is_step = within & (
        (change > _STEEPER * beside + _LEAST_STEP) | (np.abs(np.diff(radius)) > _SAME_RADIUS * radius[1:])
    )
    kept = np.zeros(len(points), dtype=bool)
    kept[starts[:-1]] = kept[starts[1:] - 1] = True
    kept[:-1] |= is_step
    kept[1:] |= is_step
    kept[1:-1] |= turn > _KINK
    for amount in (np.where(turn > _KINK, 0.0, turn) / _TURN, np.where(is_step, 0.0, change) / _CHANGE):
        # what passes a whole number within a piece comes on top of what there was before
        most = amount.max(initial=0.0)
        is_fine = most < _FINE
        passed = np.floor(np.cumsum(amount) / (1 - most if is_fine else 1.0))
        ends = np.flatnonzero(np.diff(passed, prepend=0.0) > 0)
        kept[ends + 1] = True
        if not is_fine:
            kept[ends] = True
    rows = np.flatnonzero(kept)
    return rows, np.searchsorted(rows, starts)
