"""Rigid surfaces that wires touch: planes, cylinders, bores."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..deck.keyword_table import check_card
from ..deck.lines import CardSpec


@dataclass(frozen=True)
class RigidSurface:
    """A rigid, endless surface that wires can touch, made by `Model.plane`, `Model.cylinder` and `Model.bore`.

    Where a model takes nodes, to hold, move, turn or load them, the surface stands for its reference node.

    Attributes
    ----------
    name : str
        Name in the deck.
    shape : {"PLANE", "CYLINDER", "BORE"}
        A plane with the wires on the side of its normal, a cylinder that is touched from outside, or one from inside.
    point : tuple of float
        A point of the plane or of the axis [m].
    direction : tuple of float
        Normal of the plane towards the wires, or direction of the axis [-].
    radius : float, optional
        Radius of a cylinder or bore [m].
    node : int, optional
        Number of the reference node, with which the surface moves; None: it is fixed in space.
    radius_amplitude : str, optional
        Name of the amplitude over total time that multiplies the radius; None: it stays.
    """

    name: str
    shape: str
    point: tuple[float, ...]
    direction: tuple[float, ...]
    radius: float | None = None
    node: int | None = None
    radius_amplitude: str | None = None

    def __post_init__(self) -> None:
        """Checks the values."""
        _check_vector("point", self.point)
        _check_vector("direction", self.direction)
        if not any(self.direction):
            raise ValueError(f"the direction of the surface {self.name} cannot be 0 0 0")
        for card in self.cards():
            check_card(*card)

    @property
    def reference_node(self) -> int:
        """Number of the reference node; an error if the surface is fixed in space."""
        if self.node is None:
            raise ValueError(
                f"the surface {self.name} is fixed in space: to hold, move or load it, give it a reference node"
            )
        return self.node

    def cards(self) -> Iterator[CardSpec]:
        """The card of the surface."""
        parameters: dict = {"NAME": self.name, "TYPE": self.shape}
        if self.node is not None:
            parameters["REF NODE"] = self.node
        if self.radius_amplitude is not None:
            parameters["RADIUS AMPLITUDE"] = self.radius_amplitude
        radius = [] if self.radius is None else [self.radius]
        yield "RIGID SURFACE", parameters, [[*self.point, *self.direction, *radius]]


def _check_vector(what: str, values: Sequence[float]) -> None:
    if len(values) != 3 or not np.isfinite(values).all():
        raise ValueError(f"the {what} of a surface must be three finite numbers, not {tuple(values)}")
