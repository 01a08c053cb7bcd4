"""Broad phase of the contact search."""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core

#: More pairs than this are refused; the core counts them in integers of 32 bits
MAX_PAIRS = 2**29
#: A search is two calls of the core, which keeps the pairs from one to the other: another thread must not search in between
_ONE_SEARCH = threading.Lock()


def contact_search(
    x: ArrayLike,
    connectivity: ArrayLike,
    radius: ArrayLike,
    *,
    skin: float = 0.0,
) -> NDArray[np.int64]:
    """Pairs of straight elements whose surfaces come within `skin` of each other.

    Elements that share a node are not pairs. The time grows like the number of elements and pairs.

    Parameters
    ----------
    x : (n, 3) array
        Nodal positions [m].
    connectivity : (m, 2) array of int
        Nodes of each element, counted from 0.
    radius : (m,) array
        Contact radius of each element [m], positive.
    skin : float
        Largest distance between two surfaces [m] at which the elements are still a pair; 0 or positive.

    Returns
    -------
    (k, 2) array of int
        Elements of each pair, counted from 0, the smaller number first; sorted.

    Raises
    ------
    ValueError
        For wrong shapes, nodes that do not exist, values that are not finite or radii that are not positive.

    Examples
    --------
    >>> from litz.kernels import contact_search
    >>> x = [[-1, 0, 0], [1, 0, 0], [0, -1, 0.3], [0, 1, 0.3]]
    >>> contact_search(x, [[0, 1], [2, 3]], [0.1, 0.1], skin=0.2).tolist()
    [[0, 1]]
    >>> contact_search(x, [[0, 1], [2, 3]], [0.1, 0.1]).tolist()
    []
    """
    x = np.asarray(x, dtype=float)
    connectivity = np.asarray(connectivity)
    radius = np.asarray(radius, dtype=float)
    if x.ndim != 2 or x.shape[1] != 3:
        raise ValueError(f"x must have the shape (n, 3), not {x.shape}")
    if connectivity.ndim != 2 or connectivity.shape[1] != 2 or connectivity.dtype.kind not in "iu":
        raise ValueError("connectivity must be an array of integers of shape (m, 2)")
    if radius.shape != (len(connectivity),):
        raise ValueError(f"radius must have one value for each of the {len(connectivity)} elements")
    if connectivity.size and (connectivity.min() < 0 or connectivity.max() >= len(x)):
        raise ValueError(f"connectivity names nodes outside 0 to {len(x) - 1}")
    if not np.isfinite(x).all():
        raise ValueError("x must be finite")
    if not (np.isfinite(radius).all() and (radius > 0).all()):
        raise ValueError("radius must be positive and finite")
    if not (np.isfinite(skin) and skin >= 0):
        raise ValueError("skin must be 0 or positive, and finite")
    if len(connectivity) < 2:
        return np.empty((0, 2), dtype=np.int64)
    first, last = x[connectivity[:, 0]], x[connectivity[:, 1]]
    with _ONE_SEARCH:
        count = _core.f2py_search.find_near_segments(first.T, last.T, radius + skin / 2, MAX_PAIRS)
        if count < 0:
            raise ValueError(
                f"more than {MAX_PAIRS} pairs of elements come within {skin} of each other; choose a smaller skin"
            )
        pairs = _core.f2py_search.take_near_segments(count).T.astype(np.int64) - 1
    first, second = connectivity[pairs[:, 0]], connectivity[pairs[:, 1]]
    joined = (first[:, :, None] == second[:, None, :]).any(axis=(1, 2))
    return pairs[~joined]
