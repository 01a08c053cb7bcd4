"""The residual of the contact element of the paper in complex numbers, and its derivatives by complex steps.

Source: D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact: orthogonality
conditions, virtual work of the penalty force and of the current, Hertz's spot and Holm's resistance; HERTZ: K. L.
Johnson, Contact Mechanics (1985), section 4.2. Its force follows the crossing angle, and so does its energy, 2/5 of force
times overlap: the residual has what that resists turning by. Only residuals are written down here; no tangent is.
Complex steps: W. Squire, G. Trapp, SIAM Rev. 40 (1998) 110-112, exact to round-off, because nothing is subtracted.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

STEP = 1e-30
#: Central differences of eighth order: weights of the steps 1 to 4, and the step, in the squared cosine of the angle
DIFFERENCES, ANGLE_STEP = np.array([4 / 5, -1 / 5, 4 / 105, -1 / 280]), 2e-3


@dataclass(frozen=True)
class Pair:
    """Two elements in contact; barred first."""

    #: Positions and unit tangents of the nodes (4, 3), potentials (4)
    x: np.ndarray
    t: np.ndarray
    v: np.ndarray
    #: Lengths, radii, Young's moduli, Poisson's ratios, resistivities (2)
    length: np.ndarray
    radius: np.ndarray
    young: np.ndarray
    poisson: np.ndarray
    resistivity: np.ndarray
    #: "linear" or "hermite" axes; "paper" (penalty, circular spot) or "hertz" (elliptic contact) laws
    axis: str
    law: str
    penalty: float = 1.0


@dataclass(frozen=True)
class State:
    """What the residual is made of, at one place of the unknowns."""

    #: Weights of the nodal positions and tangents in xb - x (8), and their unit normal (3)
    weights: np.ndarray
    normal: np.ndarray
    #: Tangents that the nodes have carried along (4, 3)
    t: np.ndarray
    force: complex
    #: What the energy grows by with nodal positions and tangents at the same gap, as the angle changes (8, 3)
    turning: np.ndarray
    conductance: complex
    #: Shape functions of the voltage gap (4)
    n_v: np.ndarray
    v: np.ndarray

    def mechanical(self):
        """R_m (24): minus the force times the change of the gap, and what resists turning, by displacements and spins."""
        f = -self.force * np.outer(self.weights, self.normal) + self.turning
        return np.concatenate(
            [part for node in range(4) for part in (f[2 * node], np.cross(self.t[node], f[2 * node + 1]))]
        )

    def electric(self):
        """R_e (4): the current, at the nodes it leaves."""
        return self.conductance * (self.n_v @ self.v) * self.n_v


def residual(pair, q):
    """R (28) after displacements, spins and potentials q (28) in the order of the paper."""
    state = evaluate(pair, q)
    return np.concatenate([state.mechanical(), state.electric()])


def evaluate(pair, q):
    """The state after q."""
    move = q[:24].reshape(4, 6)
    x = pair.x + move[:, :3]
    # spins change the tangents to first order only, which is all that a complex step sees
    t = pair.t + np.cross(move[:, 3:], pair.t)
    points = np.stack([x, t], axis=1).reshape(8, 3)
    xi_bar, xi = _closest(pair, points)
    bar, _, _ = _shape(pair.axis, pair.length[0], xi_bar)
    plain, _, _ = _shape(pair.axis, pair.length[1], xi)
    weights = np.concatenate([bar, -plain])
    w = weights @ points
    distance = np.sqrt(w @ w)
    overlap = sum(pair.radius) - distance
    cosine_squared, by_points = _squared_cosine(pair, points, xi_bar, xi)
    law = {"paper": _paper, "hertz": _hertz}[pair.law]
    force, conductance = law(pair, overlap, cosine_squared)
    energy_slope = 0.4 * overlap * _slope(lambda c: law(pair, overlap, c)[0], cosine_squared)
    n_v = np.array([1 - xi_bar, 1 + xi_bar, -(1 - xi), -(1 + xi)]) / 2
    return State(weights, w / distance, t, force, energy_slope * by_points, conductance, n_v, pair.v + q[24:])


def derivative(function):
    """Jacobian (m, 28) of a complex function of the unknowns at zero."""
    return np.stack([function(1j * STEP * unit).imag / STEP for unit in np.eye(28)], axis=1)


def _shape(axis, length, xi):
    """Weights of x1, t1, x2, t2 in the axis, and their first and second derivatives by xi."""
    if axis == "linear":
        zero = 0 * xi
        return (
            np.array([(1 - xi) / 2, zero, (1 + xi) / 2, zero]),
            np.array([-0.5 + zero, zero, 0.5 + zero, zero]),
            np.array([zero, zero, zero, zero]),
        )
    h = length / 2
    return (
        np.array([2 - 3 * xi + xi**3, h * (1 - xi - xi**2 + xi**3), 2 + 3 * xi - xi**3, h * (-1 - xi + xi**2 + xi**3)])
        / 4,
        np.array([-3 + 3 * xi**2, h * (-1 - 2 * xi + 3 * xi**2), 3 - 3 * xi**2, h * (-1 + 2 * xi + 3 * xi**2)]) / 4,
        np.array([6 * xi, h * (-2 + 6 * xi), -6 * xi, h * (2 + 6 * xi)]) / 4,
    )


def _squared_cosine(pair, points, xi_bar, xi):
    """Squared cosine of the angle of the axes at the closest points, and how it changes with the points (8, 3)."""
    bar, plain = _shape(pair.axis, pair.length[0], xi_bar), _shape(pair.axis, pair.length[1], xi)
    _, bar1, bar2 = (s @ points[:4] for s in bar)
    _, x1, x2 = (s @ points[4:] for s in plain)
    unit_bar, unit = bar1 / np.sqrt(bar1 @ bar1), x1 / np.sqrt(x1 @ x1)
    cosine = unit_bar @ unit
    # how the cosine changes with the slopes of the axes, and with the places along them
    by_bar, by_plain = (unit - cosine * unit_bar) / np.sqrt(bar1 @ bar1), (unit_bar - cosine * unit) / np.sqrt(x1 @ x1)
    by_places = np.array([by_bar @ bar2, by_plain @ x2])
    # the places follow the points so that both conditions of the closest points stand
    _, by_place = _conditions(points, bar, plain)
    of_points = np.zeros((2, 8, 3), dtype=complex)
    w = bar[0] @ points[:4] - plain[0] @ points[4:]
    of_points[:, :4] = np.multiply.outer(bar[0], np.array([x1, bar1])).transpose(1, 0, 2)
    of_points[:, 4:] = -np.multiply.outer(plain[0], np.array([x1, bar1])).transpose(1, 0, 2)
    of_points[0, 4:] += np.outer(plain[1], w)
    of_points[1, :4] += np.outer(bar[1], w)
    by_points = np.concatenate([np.outer(bar[1], by_bar), np.outer(plain[1], by_plain)])
    by_points = by_points - np.tensordot(np.linalg.solve(by_place.T, by_places), of_points, axes=1)
    return cosine**2, 2 * cosine * by_points


def _conditions(points, bar, plain):
    """(xb - x) . x' and (xb - x) . xb', which vanish at the closest points, and how they change with the places."""
    bar, bar1, bar2 = (s @ points[:4] for s in bar)
    x, x1, x2 = (s @ points[4:] for s in plain)
    w = bar - x
    by_place = np.array([[bar1 @ x1, w @ x2 - x1 @ x1], [bar1 @ bar1 + w @ bar2, -(x1 @ bar1)]])
    return np.array([w @ x1, w @ bar1]), by_place


def _slope(function, x):
    """Derivative by central differences."""
    steps = ANGLE_STEP * np.arange(1, 5)
    return sum(w * (function(x + h) - function(x - h)) / ANGLE_STEP for w, h in zip(DIFFERENCES, steps, strict=True))


def _closest(pair, points):
    """The places of the closest points, by Newton's method."""
    places = np.zeros(2, dtype=complex)
    for _ in range(30):
        shapes = (_shape(pair.axis, length, place) for length, place in zip(pair.length, places, strict=True))
        conditions, by_place = _conditions(points, *shapes)
        places = places - np.linalg.solve(by_place, conditions)
    return places


def _paper(pair, overlap, _):
    """Penalty force; circle of the mean radius r rb/(r + rb); R_c = (rho + rhob)/(4 a)."""
    force = pair.penalty * overlap
    mean_radius = np.prod(pair.radius) / sum(pair.radius)
    a = (3 * force * mean_radius / (4 * _modulus(pair))) ** (1 / 3)
    return force, 4 * a / sum(pair.resistivity)


def _hertz(pair, overlap, cosine_squared):
    """Force and conductance of the ellipse; F from delta = 3 F K/(2 pi a E*), R_c = (rho + rhob) K/(2 pi a)."""
    curvature = 1 / pair.radius
    total = sum(curvature) / 2
    difference = np.sqrt(sum(curvature**2) + 2 * (2 * cosine_squared - 1) * np.prod(curvature)) / 2
    ratio = _axis_ratio((total + difference) / (total - difference))
    k, e = _elliptic(1 - ratio**2)
    modulus = _modulus(pair)
    # a^3 = unit^3 F
    unit = (3 * e / (2 * np.pi * ratio**2 * total * modulus)) ** (1 / 3)
    force = (overlap * 2 * np.pi * unit * modulus / (3 * k)) ** 1.5
    a = unit * force ** (1 / 3)
    return force, 2 * np.pi * a / (sum(pair.resistivity) * k)


def _modulus(pair):
    return 1 / sum((1 - pair.poisson**2) / pair.young)


def _axis_ratio(curvature_ratio):
    """b/a from B/A = ((a/b)^2 E - K)/(K - E), for ellipses that are no circles."""

    def excess(ratio):
        k, e = _elliptic(1 - ratio**2)
        return (e / ratio**2 - k) / (k - e) - curvature_ratio

    real = brentq(lambda ratio: excess(ratio).real, 1e-4, 1 - 1e-6, xtol=1e-15)
    slope = (excess(real + 1e-6) - excess(real - 1e-6)).real / 2e-6
    ratio = complex(real)
    for _ in range(6):
        ratio -= excess(ratio) / slope
    return ratio


def _elliptic(m):
    """K(m), E(m) by the arithmetic-geometric mean, Abramowitz and Stegun 17.6."""
    a, b, total, weight = 1.0 + 0j, np.sqrt(1 - m + 0j), m / 2, 0.5
    for _ in range(8):
        c = (a - b) / 2
        a, b = (a + b) / 2, np.sqrt(a * b)
        weight *= 2
        total = total + weight * c**2
    k = np.pi / (2 * a)
    return k, k * (1 - total)
