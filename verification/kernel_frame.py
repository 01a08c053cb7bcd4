"""A frame of beams put together from `litz.kernels` alone: equilibrium and critical loads from the exact tangent."""

import numpy as np

from litz import kernels


def rotation(vector):
    """Rotation matrix of a rotation vector (Rodrigues)."""
    vector = np.asarray(vector, dtype=float)
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


class KernelFrame:
    """Beams of one element type and one section.

    Parameters
    ----------
    element : {"B31", "B33"}
    rigidity : Rigidity
    points : (n_nodes, 3)
        Positions at the start [m].
    elements : (n_elements, 2)
        Rows of `points`.
    triads : (n_elements, 2, 3, 3)
        Triads at both ends of each element at the start.
    fixed : (n_nodes, 6) of bool
        Unknowns that are held.
    free_state : ((n_elements, 2, 3), (n_elements, 2, 3, 3)), optional
        Points and triads of each element without stress, when that is not the start.
    """

    def __init__(self, element, rigidity, points, elements, triads, fixed, free_state=None):
        stiffness = {"ea": rigidity.ea, "gj": rigidity.gj, "ei2": rigidity.ei2, "ei3": rigidity.ei3}
        if element == "B31":
            self._kernel, self._stiffness = kernels.beam_b31, stiffness | {"ga2": rigidity.ga, "ga3": rigidity.ga}
        else:
            self._kernel, self._stiffness = kernels.beam_b33, stiffness
        self.elements = np.asarray(elements)
        self.triads = np.asarray(triads)
        points = np.asarray(points, dtype=float)
        self._free_state = free_state or (points[self.elements], self.triads)
        self.free = ~np.asarray(fixed).ravel()
        self.x = points.copy()
        self.rotations = np.tile(np.eye(3), (len(points), 1, 1))

    def assemble(self, form="spin"):
        """Tangent and internal forces of all unknowns, node by node (ux uy uz phix phiy phiz)."""
        n = 6 * len(self.x)
        k, r = np.zeros((n, n)), np.zeros(n)
        for nodes, triads, x0, triads0 in zip(self.elements, self.triads, *self._free_state, strict=True):
            now = self.rotations[nodes] @ triads
            beam = self._kernel(self.x[nodes], now, x0, triads0, **self._stiffness, form=form)
            rows = (6 * nodes[:, None] + np.arange(6)).ravel()
            k[np.ix_(rows, rows)] += beam.K
            r[rows] += beam.R
        return k, r

    def equilibrium(self, load, most=40):
        """Newton's method from the present state to equilibrium with a dead load (n_nodes, 6); least-norm steps.

        Ends at a residual of 1e-10 of the forces, or at round-off.
        """
        load = np.asarray(load, dtype=float).ravel()
        for _ in range(most):
            k, r = self.assemble("hessian")
            residual = (r - load)[self.free]
            round_off = 4 * np.finfo(float).eps * np.abs(k).max() * np.abs(self.x).max()
            if np.abs(residual).max() <= max(1e-10 * np.abs(load).max(), round_off):
                return
            step = np.zeros(len(load))
            step[self.free] = np.linalg.lstsq(k[np.ix_(self.free, self.free)], -residual, rcond=1e-10)[0]
            self.move(step.reshape(-1, 6))
        raise ArithmeticError(f"no equilibrium after {most} iterations")

    def move(self, step):
        """Add displacements, apply spins (n_nodes, 6)."""
        self.x = self.x + step[:, :3]
        self.rotations = np.array([rotation(s) @ q for s, q in zip(step[:, 3:], self.rotations, strict=True)])

    def eigenvalues(self, form="spin"):
        """Eigenvalues of the tangent of the free unknowns, by ascending real part."""
        k = self.assemble(form)[0][np.ix_(self.free, self.free)]
        return np.linalg.eigvalsh((k + k.T) / 2) if form == "hessian" else np.sort(np.linalg.eigvals(k).real)


def critical(is_stable, low, high, digits=11):
    """The parameter at which a state that is stable at `low` and not at `high` becomes unstable, by bisection."""
    if not is_stable(low) or is_stable(high):
        raise ArithmeticError(f"stability does not change between {low} and {high}")
    while high - low > 10.0**-digits * abs(high):
        middle = (low + high) / 2
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return (low + high) / 2


def extrapolate(coarse, fine, order):
    """Limit of two values whose meshes differ by a factor of two."""
    return fine + (fine - coarse) / (2.0**order - 1.0)
