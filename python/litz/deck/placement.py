"""Where copies of nodes stand: a shift, then a rotation about an axis."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileError
from .card import Card


def placed(places: NDArray, card: Card, path: Path) -> NDArray:
    """Positions (n, 3) moved by the data lines of an `*INSTANCE` or `*NCOPY`: a shift, then a rotation about an axis."""
    rows = card.data
    lines = [[float(value or 0) for value in row if not isinstance(value, str)] for row in rows]
    places = places.reshape(-1, 3) + (np.array([*lines[0], 0, 0, 0][:3]) if lines else np.zeros(3))
    name = f"*{card.name} {card.get('NAME', '')}".strip()
    if len(lines) > 2:
        raise FileError(f"{path}: {name} has two data lines, of a shift and of a rotation, not {len(lines)}")
    if len(lines) > 1:
        if len(lines[1]) != 7 or rows[1][6] is None:
            raise FileError(f"{path}: the second line of {name} needs seven numbers")
        if lines[1][:3] == lines[1][3:6]:
            raise FileError(
                f"{path}: the axis of the rotation of {name} has no length: both of its points are the same"
            )
        places = rotated(places, np.array(lines[1][:3]), np.array(lines[1][3:6]), lines[1][6])
    return places


def rotated(places: NDArray, a: NDArray, b: NDArray, degrees: float) -> NDArray:
    """Turned about the axis from a to b."""
    length = float(np.linalg.norm(b - a))
    axis = (b - a) / length
    cosine, sine = cosine_and_sine(degrees)
    arms = places - a
    # Rodrigues' rotation formula
    along = np.outer(arms @ axis, axis)
    return a + cosine * (arms - along) + sine * np.cross(axis, arms) + along


def cosine_and_sine(degrees: float) -> tuple[float, float]:
    """Of an angle; exact at multiples of a right angle, so that places that were zero stay so."""
    angle = np.deg2rad(degrees)
    cosine, sine = float(np.cos(angle)), float(np.sin(angle))
    return (round(cosine), round(sine)) if degrees % 90 == 0 else (cosine, sine)
