"""What sections that are not round look like."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class SectionOutline:
    """The outline of a section.

    Attributes
    ----------
    corners : ndarray
        Along the first and the second section axis from the node, anticlockwise, (k, 2) [m].
    first_axis : ndarray
        Approximate direction of the first section axis before any deformation, (3).
    """

    corners: np.ndarray
    first_axis: np.ndarray
