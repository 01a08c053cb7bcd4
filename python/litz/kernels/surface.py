"""Surfaces of solids in the plane that touch: node to segment, and segment to segment."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .area_laws import area_laws
from .batch import Batch, Floats
from .wire_pair import Numbers

# The constants of the kernels
_ACTIVE = 0
_FAILURES = {
    -1: "the two nodes of a segment coincide",
    -3: "the table must have ascending pressures and positive resistances",
}


class NodeToSegment(NamedTuple):
    """Result of `node_to_segment_em`; for many pairs each array has a leading axis n, and each number is an array (n,)."""

    #: Tangent (9, 9) in the order {master 1 (2), master 2 (2), slave (2), V master (2), V slave}
    K: Floats
    #: Residual (9,): forces [N], currents leaving the nodes [A]
    R: Floats
    #: Whether the bodies press each other there
    active: bool | NDArray[np.bool_]
    #: Place of the slave node in the master segment, which is [-1, 1)
    xi_bar: float | Floats
    #: Gap [m], negative in contact; 0 where the node is not opposite the segment
    gap: float | Floats
    #: Unit normal (2,) of the segment, into the master's body
    normal: Floats
    #: Contact pressure, per reference area [Pa]
    pressure: float | Floats
    #: Conductance of the contact, area times conductance per area [S]
    conductance: float | Floats
    #: Current from the master to the slave [A]
    current: float | Floats
    #: Voltage across the contact [V]
    voltage_gap: float | Floats


class SegmentToSegment(NamedTuple):
    """Result of `segment_to_segment_em`; for many pairs each array has a leading axis n, and each number is an array (n,).

    The piece of the slave segment opposite the master has two Gauss points.
    """

    #: Tangent (12, 12) in the order {master 1 (2), master 2 (2), slave 1 (2), slave 2 (2), V master (2), V slave (2)}
    K: Floats
    #: Residual (12,): forces [N], currents leaving the nodes [A]
    R: Floats
    #: Whether the bodies press each other at one of the points
    active: bool | NDArray[np.bool_]
    #: Places of the points in the master segment, which is [-1, 1] (2,)
    xi_bar: Floats
    #: Places of the points in the slave segment, which is [-1, 1] (2,)
    xi: Floats
    #: Gaps at the points [m], negative in contact (2,)
    gap: Floats
    #: Unit normal (2,) of the master segment, into its body
    normal: Floats
    #: Reference areas for which the points stand [m^2] (2,)
    area: Floats
    #: Contact pressures, per reference area [Pa] (2,)
    pressure: Floats
    #: Conductance of the piece [S]
    conductance: float | Floats
    #: Current from the master to the slave [A]
    current: float | Floats
    #: Voltages across the contact at the points [V] (2,)
    voltage_gap: Floats


def node_to_segment_em(
    x_bar: ArrayLike,
    x: ArrayLike,
    v_bar: ArrayLike,
    v: Numbers,
    *,
    area: Numbers,
    normal_law: str,
    spot_law: str,
    reach: ArrayLike = (0.0, 0.0),
    augmentation: Numbers = 0.0,
    **data: ArrayLike,
) -> NodeToSegment:
    """Contact of a node with a segment in the plane, mechanical and electric: tangent and residual.

    The classical element of solids in contact, after which the element of two beams was formulated. Sums over slave
    nodes do not pass the patch test; those of `segment_to_segment_em` do.

    Parameters
    ----------
    x_bar : array_like, shape (2, 2) or (n, 2, 2)
        Present positions of the nodes of the master segment [m]; its body lies on the left of the way from node 1 to
        node 2. With a leading axis n these are many pairs; every other array then has that axis, too, or serves them all.
    x : array_like, shape (2,)
        Present position of the slave node [m].
    v_bar : array_like, shape (2,)
        Voltages of the master [V].
    v : float
        Voltage of the slave node [V].
    area : float
        Reference area for which the slave node stands [m^2].
    normal_law : {"linear", "exponential"}
        Pressure over gap, with `data`:

        - "linear": ``p = augmentation + eps_n |g|``, with `eps_n` [Pa/m];
        - "exponential": ``p = p_0 exp(-g/decay)`` of rough surfaces, at any gap, with `p_0` [Pa] and `decay` [m].
    spot_law : {"cmy", "film", "elastic rough", "constant", "table", "none"}
        Conductance per area, with `data`; `resistivity` [ohm m] is a number, or a pair (barred, unbarred):

        - "cmy": of Cooper, Mikic and Yovanovich, with `hardness` [Pa], `slope`, `roughness` [m], `resistivity`;
        - "film": as "cmy", with a film of `sigma_f` [ohm m^2] on the true area ``p/hardness``;
        - "elastic rough": from the stiffness of the contact, with `resistivity`, `young` [Pa], `poisson`;
        - "constant": `resistance` times area [ohm m^2];
        - "table": `table`, shape (2, k): pressures [Pa], ascending, and resistances times area [ohm m^2];
        - "none": no current.
    reach : array_like, shape (2,)
        How far the segment goes on straight beyond its nodes 1 and 2, in lengths of the segment: for the ends of a
        surface, where a node just beyond the last segment would else touch nothing.
    augmentation : float
        Pressure of Uzawa's iteration, of "linear" [Pa]; 0: a penalty.
    **data
        Numbers of the laws, by the names above.

    Returns
    -------
    NodeToSegment
        `K` (9, 9), `R` (9,), `active`, `xi_bar`, `gap` [m], `normal` (2,), `pressure` [Pa], `conductance` [S], `current`
        [A], `voltage_gap` [V]. `R` is internal minus external, Newton solves ``K dq = -R``. Where the node is not
        opposite the segment (half open, so that a node opposite a joint counts once), or nothing presses, `K` and `R`
        are zero and ``active=False``.

    Raises
    ------
    ValueError
        Invalid input, a number that a law lacks or does not take, a law per spot in place of one per area; an overlap so
        deep that the exponential law has no number for it.

    Notes
    -----
    ``dg = b . dp``, ``R_u = -A p b``, ``R_V = A h g_V [f1, f2, -1]``; the upper right block of `K` is zero. Formulas:
    ``fortran/kernels/surface_point.f90`` and ``fortran/laws/area_law.f90``; P. Wriggers, Computational Contact
    Mechanics, 2nd ed. 2006, chapters 4, 9 and 10.

    Examples
    --------
    >>> contact = node_to_segment_em(
    ...     [[0, 0], [1e-3, 0]], [3e-4, 1e-7], [1e-3, 1e-3], 0.0, area=1e-7, normal_law="linear", eps_n=1e15,
    ...     spot_law="cmy", hardness=1e9, slope=0.1, roughness=1e-6, resistivity=1.7e-8)
    >>> print(f"{contact.pressure:.3g} Pa, {contact.current:.4g} A")
    1e+08 Pa, 82.5 A
    """
    of = Batch()
    of.array("x_bar", x_bar, (2, 2))
    of.array("x", x, (2,))
    of.array("v_bar", v_bar, (2,))
    of.array("v", v)
    areas = of.positive("area", area)
    of.not_negative("reach", reach, (2,))
    k, r, numbers, normal, info = _call(
        [(9, 9), (9,), (6,), (2,), ()], _core.f2py_surface.node_to_segment, of, normal_law, spot_law, data, augmentation
    )
    xi_bar, gap, pressure, per_area, current, voltage_gap = numbers
    areas = np.broadcast_to(areas, of.shape).ravel()
    fields: list[NDArray[Any]] = [
        k, r, info == _ACTIVE, xi_bar, gap, normal, pressure, areas * per_area, current, voltage_gap,
    ]  # fmt: skip
    return NodeToSegment(*map(of.result, fields))


def segment_to_segment_em(
    x_bar: ArrayLike,
    x: ArrayLike,
    v_bar: ArrayLike,
    v: ArrayLike,
    *,
    length: Numbers,
    normal_law: str,
    spot_law: str,
    width: Numbers = 1.0,
    augmentation: Numbers = 0.0,
    **data: ArrayLike,
) -> SegmentToSegment:
    """Contact of two segments in the plane, mechanical and electric: tangent and residual.

    The slave segment is cut where the nodes of the master project onto it; the piece between has two Gauss points. Sums
    over all pairs of segments transmit a uniform pressure exactly, whatever the meshes.

    Parameters
    ----------
    x_bar, x : array_like, shape (2, 2) or (n, 2, 2)
        Present positions of the nodes of master and slave segment [m]; the bodies lie on the left of the ways from node
        1 to node 2, so that segments in contact run in opposite directions. With a leading axis n these are many pairs;
        every other array then has that axis, too, or serves them all.
    v_bar, v : array_like, shape (2,)
        Their voltages [V].
    length : float
        Reference length of the slave segment [m].
    normal_law, spot_law, augmentation, **data
        As in `node_to_segment_em`.
    width : float or array_like, shape (2,)
        Width of the surface at the slave nodes [m]: the thickness, or 2 pi times the reference radius in bodies of
        revolution; one number serves both.

    Returns
    -------
    SegmentToSegment
        `K` (12, 12), `R` (12,), `active`, and of the two points (2,): `xi_bar`, `xi`, `gap` [m], `area` [m^2], `pressure`
        [Pa], `voltage_gap` [V]; `normal` (2,), `conductance` [S], `current` [A]. `K` contains how the cuts move.

    Raises
    ------
    ValueError
        As `node_to_segment_em`.

    Notes
    -----
    Each point is that of `node_to_segment_em` with the shape functions of the slave segment in place of its one node.
    ``fortran/kernels/segment_to_segment.f90``. In corners of the master the pieces overlap, or leave a gap, of the order
    of the angle times the gap.
    """
    of = Batch()
    of.array("x_bar", x_bar, (2, 2))
    of.array("x", x, (2, 2))
    of.array("v_bar", v_bar, (2,))
    of.array("v", v, (2,))
    of.positive("length", length)
    widths = of.pair("width", width)
    checks.refuse("width", widths, widths < 0, 1, "must not be negative, but holds {value:g}")
    k, r, numbers, normal, info = _call(
        [(12, 12), (12,), (8, 2), (2,), ()],
        _core.f2py_surface.segment_to_segment,
        of,
        normal_law,
        spot_law,
        data,
        augmentation,
    )
    xi_bar, xi, gap, area, pressure, per_area, current, voltage_gap = numbers
    fields: list[NDArray[Any]] = [
        k, r, info == _ACTIVE, xi_bar, xi, gap, normal, area, pressure, (area * per_area).sum(axis=0),
        current.sum(axis=0), voltage_gap,
    ]  # fmt: skip
    return SegmentToSegment(*map(of.result, fields))


def _call(
    shapes: list[tuple[int, ...]],
    kernel: Callable[..., Any],
    of: Batch,
    normal_law: str,
    spot_law: str,
    data: dict[str, ArrayLike],
    augmentation: Numbers,
) -> tuple[NDArray[Any], ...]:
    """Take the laws, call the kernel, raise what it could not do."""
    laws = area_laws(normal_law, spot_law, data)
    pressed = of.array("augmentation", augmentation)
    if not laws.can_be_augmented and pressed.any():
        raise ValueError('augmentation belongs to normal_law="linear"')
    of.share("data of the pressure law", laws.normal_data, 1)
    of.share("data of the conductance law", laws.spot_data, 1)
    of.share("young, poisson and resistivity", laws.bodies, 2)
    normal_data, spot_data, bodies = of.shared_columns()
    result: tuple[NDArray[Any], ...] = of.call(
        shapes, kernel, *of.columns(), laws.normal, normal_data, laws.spot, spot_data, bodies
    )
    of.raise_failures(result[-1], _FAILURES, "pair")
    tangents = result[0]
    infinite = ~np.isfinite(tangents).all(axis=tuple(range(tangents.ndim - 1)))
    if infinite.any():
        raise ValueError(
            f"{of.named(infinite, 'pair')}the bodies overlap so deeply that the tangent is beyond the largest number"
        )
    return result
