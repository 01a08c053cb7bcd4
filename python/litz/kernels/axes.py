"""The axes of two elements: their closest points."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .batch import Batch, Floats
from .wire_pair import take_geometry

Axis = Literal["linear", "hermite"]
Status = Literal["inside", "beyond", "parallel", "not_unique", "not_converged"]

# The constants of fortran/kernels/axis.f90 and closest_points.f90
AXES = {"linear": 1, "hermite": 2}
_STATUS: dict[int, Status] = {0: "inside", 1: "beyond", -1: "parallel", -2: "not_unique", -3: "not_converged"}


class ClosestPoints(NamedTuple):
    """Closest points of two element axes; of many pairs each is an array."""

    #: Place in the barred element, which is [-1, 1]
    xi_bar: float | Floats
    #: Place in the unbarred element
    xi: float | Floats
    #: "inside", "beyond" an end, "parallel", "not_unique" or "not_converged"
    status: Status | NDArray[np.str_]


def closest_points(
    x: ArrayLike, t: ArrayLike, length: ArrayLike, *, axis: Axis = "hermite", start: ArrayLike | None = None
) -> ClosestPoints:
    """Closest points of the axes of two elements.

    Parameters
    ----------
    x : array_like, shape (4, 3)
        Nodal positions in the order barred 1, barred 2, 1, 2 [m]. All arguments may have leading axes, see `litz.kernels`.
    t : array_like, shape (4, 3)
        Unit tangents at the nodes, pointing from node 1 to node 2 of their element; "linear" does not look at them.
    length : array_like, shape (2,)
        Reference lengths of the barred and the unbarred element [m].
    axis : {"hermite", "linear"}
        Cubic or straight axes between the nodes.
    start : array_like, shape (2,), optional
        Places (xi_bar, xi) to start from; the minimum of the distance next to it is found. Otherwise the closest pair
        of points within the elements is found.

    Returns
    -------
    ClosestPoints
        `xi_bar`, `xi` and `status`:

        - "inside": both points lie in their element, -1 <= xi <= 1 (to 1e-10);
        - "beyond": an axis continued beyond an end, up to abs(xi) = 1.5, comes closer than its own points do;
        - "parallel": the tangents there enclose less than 0.06 degrees; the points are at the least distance;
        - "not_unique": other points are as close; the points are one choice;
        - "not_converged": an axis has no tangent, for example where its nodes coincide.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite, tangents that are not of unit length, a length that is not positive.

    Notes
    -----
    The conditions are ``w . x' = 0`` and ``w . xb' = 0`` with ``w = xb - x``. The method is described in
    ``fortran/kernels/closest_points.f90``.
    """
    of = Batch()
    take_geometry(of, x, t, length)
    of.array("start", (0.0, 0.0) if start is None else start, (2,))
    xi_bar, xi, status = of.call(
        [(), (), ()], _core.f2py_contact.closest_points,
        *of.columns(), checks.choice("axis", axis, AXES), start is not None,
    )  # fmt: skip
    names = [_STATUS[int(number)] for number in status]
    words = names[0] if not of.shape else np.array(names, dtype="U13").reshape(of.shape)
    return ClosestPoints(of.result(xi_bar), of.result(xi), words)
