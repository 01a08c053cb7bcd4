"""Curves that would hide each other: those that are drawn later have gaps, in which the earlier ones are seen."""

from collections.abc import Iterator

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import StepPatch
from numpy.typing import NDArray

# Part of a curve that another one must cover to hide it
_COVERED = 0.5
# Places at which two curves are compared
_PLACES = 400
# Dashes and gaps of the second, third, ... curve at one place, in widths of the line: each shows a part of all that are below
_DASHES = ((0, (5, 5)), (0, (2.5, 7.5)), (0, (1.2, 8.8)))
# Markers of a curve above others, in those below
_SMALLER = 0.55


def show_hidden_curves(axes: Axes) -> bool:
    """Give dashes to curves that lie on earlier ones to within the width of a line, over half of their length or more.

    Returns
    -------
    bool
        Whether there are any.
    """
    # limits follow the curves when someone asks for them, and not before
    axes.get_xlim(), axes.get_ylim()
    level: dict[int, int] = {}
    curves = list(_curves(axes))
    for number, (artist, points) in enumerate(curves):
        below = [level[k] for k in range(number) if _covers(points, curves[k][1], _width(axes, artist))]
        level[number] = 1 + max(below) if below else 0
        if below:
            artist.set_linestyle(_DASHES[min(level[number], len(_DASHES)) - 1])
            if isinstance(artist, Line2D):
                artist.set_dash_capstyle("butt")
                artist.set_markersize(artist.get_markersize() * _SMALLER ** level[number])
    return any(level.values())


def _curves(axes: Axes) -> Iterator[tuple[Artist, NDArray]]:
    """Solid curves from left to right, and their points in pixels (n, 2)."""
    for artist in [*axes.lines, *(patch for patch in axes.patches if isinstance(patch, StepPatch))]:
        if artist.get_linestyle() not in ("-", "solid") or not artist.get_transform().contains_branch(axes.transData):
            continue
        if isinstance(artist, Line2D):
            x, y = (np.asarray(one, dtype=float) for one in artist.get_data())
        else:
            steps = artist.get_data()
            x, y = np.repeat(steps.edges, 2)[1:-1], np.repeat(steps.values, 2)
        if len(x) > 1 and (np.diff(x) >= 0).all() and np.ptp(x) > 0:
            yield artist, axes.transData.transform(np.stack([x, y], axis=1))


def _width(axes: Axes, artist: Artist) -> float:
    """Of the line of a curve [pixels]."""
    return artist.get_linewidth() * axes.figure.dpi / 72


def _covers(upper: NDArray, lower: NDArray, width: float) -> bool:
    """Whether the upper curve is no farther from the lower one than that, over the part of its length that counts."""
    place = np.linspace(upper[0, 0], upper[-1, 0], _PLACES)
    one, other = (np.interp(place, *curve.T) for curve in (upper, lower))
    length = np.hypot(1.0, np.gradient(one, place))
    # where curves are steep they are nearer to each other than they are above each other
    distance = np.abs(one - other) / length
    shared = (place >= lower[0, 0]) & (place <= lower[-1, 0])
    with np.errstate(invalid="ignore"):
        covered = shared & (distance <= width)
    known = np.isfinite(one)
    return bool(length[covered & known].sum() >= _COVERED * length[known].sum() > 0)
