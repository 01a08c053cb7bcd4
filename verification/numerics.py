"""Small numerics that the cases share."""

import numpy as np


def rotation(vector):
    """Rotation matrix of a rotation vector (Rodrigues)."""
    vector = np.asarray(vector, dtype=float)
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def extrapolate(coarse, fine, order):
    """Limit of two values whose meshes differ by a factor of two."""
    return fine + (fine - coarse) / (2.0**order - 1.0)
