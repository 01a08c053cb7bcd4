"""Rigid surfaces of a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from numbers import Integral

from .loading import Amplitude
from .surfaces import RigidSurface
from .wire_model import WireModel
from .wires import Nodes

#: A reference node: its number, a node, or the position of a new one
Reference = int | Nodes | Sequence[float]


class SurfaceModel(WireModel):
    """Wires, and rigid surfaces that they touch."""

    def plane(
        self, name: str, point: Sequence[float], normal: Sequence[float], *, reference: Reference | None = None
    ) -> RigidSurface:
        """Add a rigid plane, such as a press plate.

        Parameters
        ----------
        name : str
            Name of the surface.
        point : (3) array
            A point of the plane [m].
        normal : (3) array
            Its normal, towards the wires [-].
        reference : int, Nodes or (3) array, optional
            Node with which the plane moves and turns, and on which the forces of the wires act, or the position of a
            new one [m]; without it the plane is fixed in space.

        Returns
        -------
        RigidSurface
            The plane; `contact` takes it as the partner of wires, `fix`, `move` and the like in place of its
            reference node.

        Examples
        --------
        A ring is pressed between two plates:

        >>> import numpy as np
        >>> import litz
        >>> model = litz.Model("a ring between two plates")
        >>> steel = model.material("STEEL", young=200e9, poisson=0.3)
        >>> around = lambda t: (0.05 * np.sin(t), 0.0, -0.05 * np.cos(t))
        >>> ring = model.wire("RING", curve=around, span=(0, 2 * np.pi), closed=True, elements=60, radius=1e-3,
        ...                   material=steel)
        >>> table = model.plane("TABLE", (0, 0, -0.051), (0, 0, 1))
        >>> plate = model.plane("PLATE", (0, 0, 0.051), (0, 0, -1), reference=(0, 0, 0.06))
        >>> for surface in (table, plate):
        ...     pair = model.contact(ring, surface, friction=0.2)
        >>> model.fix(ring, "y", "rx", "rz")
        >>> model.fix(ring.start, "x", "ry")
        >>> model.fix(plate, "x", "y", "rotations")
        >>> step = model.step("PRESS", increment=0.25)
        >>> step.move(plate, "z", -1e-3)
        >>> step.node_print(plate, "RF")
        """
        return self._add_surface(RigidSurface(name, "PLANE", _vector(point), _vector(normal)), reference)

    def cylinder(
        self,
        name: str,
        point: Sequence[float],
        axis: Sequence[float],
        radius: float,
        *,
        reference: Reference | None = None,
        radius_amplitude: Amplitude | str | None = None,
    ) -> RigidSurface:
        """Add a rigid cylinder that wires touch from outside, such as a drum.

        Parameters
        ----------
        name : str
            Name of the surface.
        point : (3) array
            A point of the axis [m].
        axis : (3) array
            Direction of the axis [-].
        radius : float
            Radius of the cylinder [m].
        reference : int, Nodes or (3) array, optional
            As that of `plane`.
        radius_amplitude : Amplitude or str, optional
            Amplitude over total time (`model.amplitude(..., time="TOTAL TIME")`) that multiplies the radius, which
            makes a jacket shrink; without it the radius stays.
        """
        return self._add_surface(self._round("CYLINDER", name, point, axis, radius, radius_amplitude), reference)

    def bore(
        self,
        name: str,
        point: Sequence[float],
        axis: Sequence[float],
        radius: float,
        *,
        reference: Reference | None = None,
        radius_amplitude: Amplitude | str | None = None,
    ) -> RigidSurface:
        """Add a rigid cylinder that wires touch from inside, such as a jacket or a die.

        Parameters
        ----------
        name, point, axis, radius, reference, radius_amplitude
            As those of `cylinder`.

        Examples
        --------
        A jacket shrinks by a tenth around two wires:

        >>> import litz
        >>> model = litz.Model("two wires in a jacket")
        >>> places = [[(x, 0, 2.5e-3 * i) for i in range(9)] for x in (-1e-3, 1e-3)]
        >>> pair = model.wires("PAIR", places, radius=1e-3, material=litz.COPPER)
        >>> shrink = model.amplitude("SHRINK", [0, 1], [1, 0.9], time="TOTAL TIME")
        >>> jacket = model.bore("JACKET", (0, 0, 0), (0, 0, 1), 2.2e-3, radius_amplitude=shrink)
        >>> jacket.radius_amplitude
        'SHRINK'
        """
        return self._add_surface(self._round("BORE", name, point, axis, radius, radius_amplitude), reference)

    def _round(
        self,
        shape: str,
        name: str,
        point: Sequence[float],
        axis: Sequence[float],
        radius: float,
        radius_amplitude: Amplitude | str | None,
    ) -> RigidSurface:
        amplitude = self.amplitude_name(radius_amplitude)
        return RigidSurface(name, shape, _vector(point), _vector(axis), radius, radius_amplitude=amplitude)

    def _add_surface(self, surface: RigidSurface, reference: Reference | None) -> RigidSurface:
        self._claim(surface.name)
        if reference is not None:
            node = self._reference_node(reference, "a rigid surface")
            surface = replace(surface, node=node)
        self.surfaces[surface.name] = surface
        return surface

    def _reference_node(self, reference: Reference, what: str) -> int:
        """The number of a node, or of a new one at a position."""
        known = isinstance(reference, Nodes | Integral)
        node, *others = self._members(reference) if known else self.nodes([reference])
        if others:
            raise ValueError(f"{what} has one reference node, not {reference!r}")
        return node


def _vector(values: Sequence[float]) -> tuple[float, ...]:
    return tuple(float(value) for value in values)
