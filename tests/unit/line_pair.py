"""Random elements that touch along a line, and the same contact written down in numpy, independent of the kernels."""

import numpy as np

from derivatives import derivative_of_batch, rotation, turned
from litz.kernels import line_point

LAWS = [
    {},
    dict(film=0.003),
    dict(hardness=0.4),
    dict(eps_l=0.8),
    dict(angle=0.3, film=0.001),
    dict(angle=1.3),
]


def hermite(length, xi, axis):
    """Weights of x1, t1, x2, t2 and their derivatives."""
    if axis == "linear":
        return np.array([(1 - xi) / 2, 0, (1 + xi) / 2, 0]), np.array([-0.5, 0, 0.5, 0]), np.zeros(4)
    s = length / 2
    return (
        np.array([2 - 3 * xi + xi**3, s * (1 - xi - xi**2 + xi**3), 2 + 3 * xi - xi**3, s * (-1 - xi + xi**2 + xi**3)])
        / 4,
        np.array([-3 + 3 * xi**2, s * (-1 - 2 * xi + 3 * xi**2), 3 - 3 * xi**2, s * (-1 + 2 * xi + 3 * xi**2)]) / 4,
        np.array([6 * xi, s * (-2 + 6 * xi), -6 * xi, s * (2 + 6 * xi)]) / 4,
    )


def complex_turned(t, theta):
    """`t` after a small rotation by a complex vector, to first order: what a complex step needs."""
    return t + np.cross(theta, t)


class LinePair:
    """Two random elements side by side; lengths and moduli of order one, radii 0.1."""

    def __init__(self, seed, *, degrees=(0, 0), bend=0.1, depth=(1e-3, 0.05), held=False, through=False, laws=None):
        self.rng = rng = np.random.default_rng(seed)
        self.length = rng.uniform(0.8, 1.2, 2)
        ratio = 1.5 ** rng.uniform(-1, 1, 4)
        self.properties = dict(
            radius=np.array([0.1, 0.1 * ratio[0]]),
            young=np.array([3.0, 3.0 * ratio[1]]),
            poisson=np.array([0.3, 0.3 / max(1, ratio[2])]),
            resistivity=np.array([0.5, 0.5 * ratio[3]]),
        )
        self.laws = dict(LAWS[seed % len(LAWS)] if laws is None else laws)
        self.laws["weight"] = rng.uniform(0.1, 0.5)
        if seed % 2 == 0:
            self.laws["series_resistance"] = rng.uniform(0.05, 0.5, 2)
        self.axis = "linear" if seed % 4 == 1 else "hermite"
        self.xi = rng.choice([-1.0, 0.0, 1.0, rng.uniform(-1, 1)])
        self.ends = (False, True) if held else (False, False)
        angle = np.radians(rng.uniform(*degrees))
        self.lay(angle, bend, held)
        while held and self.foot(self.x, self.t, 1.0) < 1.01:
            self.lay(angle, bend, held)
        self.push_together(rng.uniform(*depth), through)
        turn, origin = rotation(rng.normal(size=3)), rng.uniform(-1, 1, 3)
        self.x, self.t = self.x @ turn.T + origin, self.t @ turn.T
        if through:
            self.laws["normal_before"] = turn @ self.before
        self.v = rng.normal(size=4)
        self.step = 0.01 * (abs(self.distance) if through else 2 * self.depth)

    def lay(self, angle, bend, held):
        """Two elements whose point and foot lie where they are wanted, at some distance."""
        directions = np.array([[1, 0, 0], [np.cos(angle), np.sin(angle), 0]])
        foot = self.rng.uniform(1.02, 1.1) if held else self.rng.uniform(-0.8, 0.8)
        places = foot, self.xi
        self.x, self.t = np.empty((4, 3)), np.empty((4, 3))
        for node in range(4):
            beam, end = divmod(node, 2)
            self.x[node] = directions[beam] * self.length[beam] / 2 * (2 * end - 1 - places[beam])
            self.t[node] = rotation(self.rng.uniform(-bend, bend, 3)) @ directions[beam]
        self.x[:2, 2] += self.properties["radius"].sum()
        self.xi_bar = 1.0 if held else self.foot(self.x, self.t)

    def push_together(self, share, through):
        """Move the unbarred element along the normal until the wires overlap, or have passed each other."""
        radius = self.properties["radius"]
        self.depth = share * radius.min()
        w = self.vector(self.x, self.t)
        distance = np.linalg.norm(w)
        self.before = w / distance
        wanted = radius.sum() - self.depth
        if through:
            # beyond the axes the law has gone on as a straight line; a penalty has no such end
            wanted = -0.3 * radius.min()
            self.depth = radius.sum() - wanted
        self.distance = wanted
        self.x[2:] += (distance - wanted) * self.before

    def vector(self, x, t, xi_bar=None):
        """From the point to its foot."""
        xi_bar = self.xi_bar if xi_bar is None else xi_bar
        h, *_ = hermite(self.length[1], self.xi, self.axis)
        hb, *_ = hermite(self.length[0], xi_bar, self.axis)
        at = [x[0], t[0], x[1], t[1], x[2], t[2], x[3], t[3]]
        return sum(a * b for a, b in zip([*hb, *-h], at, strict=True))

    def foot(self, x, t, xi_bar=0.0):
        """Foot by Newton's method, for complex positions too."""
        for _ in range(30):
            _, hb1, hb2 = hermite(self.length[0], xi_bar, self.axis)
            at = [x[0], t[0], x[1], t[1]]
            tangent = sum(a * b for a, b in zip(hb1, at, strict=True))
            bend = sum(a * b for a, b in zip(hb2, at, strict=True))
            w = self.vector(x, t, xi_bar)
            change = (w @ tangent) / (tangent @ tangent + w @ bend)
            xi_bar = xi_bar - change
            # of a complex step this was the iteration that is exact to first order
            if abs(change.real) < 1e-14:
                break
        return xi_bar

    def gap(self, dq):
        """Gap after displacements and small rotations, which may be complex (24,)."""
        q = np.asarray(dq).reshape(4, 6)
        x = self.x + q[:, :3]
        t = np.array([complex_turned(t, theta) for t, theta in zip(self.t, q[:, 3:], strict=True)])
        xi_bar = self.xi_bar if any(self.ends) else self.foot(x, t, self.xi_bar)
        w = self.vector(x, t, xi_bar)
        side = 1 if self.vector(self.x, self.t).real @ self.laws.get("normal_before", w.real) >= 0 else -1
        return side * np.sqrt(w @ w) - self.properties["radius"].sum(), xi_bar

    def evaluate(self, *, x=None, t=None, v=None, **changes):
        return line_point(
            self.x if x is None else x,
            self.t if t is None else t,
            self.length,
            self.v if v is None else v,
            **{"xi": self.xi, "axis": self.axis, "ends": self.ends, **self.properties, **self.laws, **changes},
        )

    def moved(self, dq):
        """Positions, tangents and voltages of states (n, 28): displacements, rotations by a vector, and voltages."""
        q = dq[:, :24].reshape(-1, 4, 6)
        return dict(x=self.x + q[:, :, :3], t=turned(self.t, q[:, :, 3:]), v=self.v + dq[:, 24:])

    def derivative(self, function):
        """Derivative by the 28 unknowns of a function of many states, by differences of sixth order; new axis last."""
        return derivative_of_batch(function, np.zeros(28), self.step)


#: Kinds of pairs: arguments of `LinePair`
KINDS = {
    "straight and parallel": dict(bend=0.0),
    "parallel and curved": dict(bend=0.3),
    "strands": dict(degrees=(5, 20)),
    "crossed": dict(degrees=(60, 120)),
    "strongly curved": dict(degrees=(-30, 30), bend=0.8),
    "shallow": dict(depth=(1e-5, 1e-4)),
    "foot held at an end": dict(degrees=(-10, 10), held=True),
    "axes passed each other": dict(degrees=(10, 60), through=True, laws=dict(eps_l=0.003)),
}
