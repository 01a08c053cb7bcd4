"""What charts share: legends beside the data, equal curves drawn as one, and what is only round-off."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.legend import Legend

from ..results import Results
from ..results.contact_history import FORCE_ROUND_OFF
from ..wires.chains import Wire
from .hidden_curves import show_hidden_curves

# Curves that differ by less, relative to the largest value of all, are the same curve: what an iteration leaves
_SAME_CURVE = 1e-6
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# Axes that begin at zero reach at least to this multiple of what is drawn
_ROOM = 1.05
# Of curves that are one, so many are named
_MAX_NAMES = 3


def legend_beside(axes: Axes, **options: object) -> Legend:
    """A legend at the right of the axes, where it hides no data; curves that lie on each other are all seen."""
    if show_hidden_curves(axes):
        # room for three dashes
        options.setdefault("handlelength", 3.5)
    return axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), **options)


def from_zero(axes: Axes) -> None:
    """Begin the axis of values at zero, with room above what is drawn: values that are all alike are at the top otherwise."""
    axes.set_ylim(bottom=0)
    top = axes.dataLim.y1
    if np.isfinite(top) and top > 0:
        axes.set_ylim(top=max(axes.get_ylim()[1], _ROOM * top))


def power_of_ten(value: float) -> str:
    """A power of ten as text.

    Examples
    --------
    >>> power_of_ten(1e-12), power_of_ten(1000.0)
    ('10⁻¹²', '10³')
    """
    return "10" + str(round(math.log10(value))).translate(_SUPERSCRIPTS)


def equal_curves(curves: list[np.ndarray]) -> list[list[int]]:
    """Numbers of the curves in groups that look the same, in the order of the first of each.

    Parameters
    ----------
    curves : list of ndarray
        Curves of the same shape are compared, value by value.
    """
    allowed = _SAME_CURVE * max((np.abs(one[np.isfinite(one)]).max(initial=0.0) for one in curves), default=0.0)
    groups: list[list[int]] = []
    for number, curve in enumerate(curves):
        for group in groups:
            first = curves[group[0]]
            if first.shape == curve.shape and np.allclose(first, curve, rtol=0.0, atol=allowed, equal_nan=True):
                group.append(number)
                break
        else:
            groups.append([number])
    return groups


def equal_over_places(places: list[np.ndarray], values: list[np.ndarray]) -> list[list[int]]:
    """Numbers of the curves in groups with the same values at the same places."""
    same_places = {one: place for place, group in enumerate(equal_curves(places)) for one in group}
    groups = equal_curves(values)
    return [
        [one for one in group if same_places[one] == place]
        for group in groups
        for place in dict.fromkeys(same_places[one] for one in group)
    ]


def name_of_group(names: list[str], what: str) -> str:
    """What a legend says of curves that are drawn as one: how many they are, and which."""
    if len(names) == 1:
        return names[0]
    short = [name.removeprefix(f"{what} ") for name in names]
    shown = ", ".join(short) if len(short) <= _MAX_NAMES else f"{short[0]}, {short[1]}, ... {short[-1]}"
    return f"{len(names)} equal {what}s: {shown}"


def has_force(force: np.ndarray) -> np.ndarray:
    """Which contact forces (n) [N] are more than round-off of the largest."""
    return np.abs(force) >= FORCE_ROUND_OFF * np.abs(force).max(initial=0.0)


def wire_names(results: Results, wires: list[Wire]) -> list[str]:
    """Name of each wire: that of the first element set which has its elements and no others, or else its number."""
    sets = {frozenset(rows.tolist()): name for name, rows in reversed(results.element_sets.items())}
    return [sets.get(frozenset(wire.elements.tolist()), str(number)) for number, wire in enumerate(wires, 1)]
