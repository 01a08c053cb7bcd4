"""Random pairs of elements in contact, and how they move."""

import numpy as np

from derivatives import rotation, turned
from litz import _core
from litz.kernels import closest_points, contact_em

SPOT_LAWS = [
    dict(spot_law="paper"),
    dict(spot_law="hertz"),
    dict(spot_law="plastic", hardness=3.0),
    dict(spot_law="paper"),
    dict(spot_law="hertz"),
    dict(spot_law="film", film_resistivity=0.02),
    dict(spot_law="sharvin", law_value=[0.3, 0.1]),
    dict(spot_law="cluster", law_value=[3.0, 5.0]),
    dict(spot_law="cluster", law_value=[3.0, 5.0, 0.1]),
    dict(spot_law="constant", resistance=0.7),
    dict(spot_law="table"),
    dict(spot_law="none"),
]


class Pair:
    """Two random elements in contact; lengths, radii, moduli and voltages of order one."""

    def __init__(
        self,
        seed,
        *,
        degrees=(25, 155),
        places=(0.0, 0.8),
        overlap=(0.05, 0.3),
        bend=0.15,
        spread=1.5,
        through=False,
        no_voltage=False,
        laws=None,
        step=0.02,
    ):
        self.rng = rng = np.random.default_rng(seed)
        self.length = rng.uniform(1.5, 2.5, 2)
        ratio = spread ** rng.uniform(-1, 1, 4)
        self.properties = dict(
            radius=np.array([0.1, 0.1 * ratio[0]]),
            young=np.array([3.0, 3.0 * ratio[1]]),
            poisson=np.array([0.3, 0.3 / max(1, ratio[2])]),
            resistivity=np.array([0.5, 0.5 * ratio[3]]),
        )
        self.laws = dict(SPOT_LAWS[seed % len(SPOT_LAWS)] if laws is None else laws)
        if "normal_law" not in self.laws:
            self.laws |= dict(normal_law="hertz") if seed % 5 == 0 else dict(eps_n=2.0)
        if seed % 2 == 0:
            self.laws["series_resistance"] = rng.uniform(0.05, 0.5, 2)
        self.axis = "linear" if seed % 4 == 1 else "hermite"
        while not self.shape(degrees, places, bend):
            pass
        reach = self.properties["radius"].sum()
        depth = rng.uniform(*overlap) * (reach if through else self.properties["radius"].min())
        self.push_together(reach - depth)
        turn, origin = rotation(rng.normal(size=3)), rng.uniform(-1, 1, 3)
        self.x, self.t = self.x @ turn.T + origin, self.t @ turn.T
        if through:
            self.laws["side"] = int(self.side_before)
        self.v = rng.normal(size=4)
        if self.laws["spot_law"] == "table":
            # the present force away from the pairs, where the second derivative of the table jumps
            force = self.evaluate(spot_law="none").force
            self.laws["table"] = [force * np.array([0.1, 0.7, 3.0, 20.0]), [20.0, 3.0, 1.5, 0.2]]
        if no_voltage:
            self.balance()
        self.step = step * depth

    def balance(self):
        """Shift the voltages of the unbarred beam until the contact has none."""
        result = self.evaluate()
        n_v = np.array([1 - result.xi_bar, 1 + result.xi_bar, -(1 - result.xi), -(1 + result.xi)]) / 2
        self.v[2:] += n_v @ self.v

    def shape(self, degrees, places, bend):
        """Try one crossing; whether its closest points lie where they are wanted."""
        rng = self.rng
        angle = np.radians(rng.uniform(*degrees))
        directions = np.array([[1, 0, 0], [np.cos(angle), np.sin(angle), 0]])
        place = rng.uniform(*places, 2) * rng.choice([-1, 1], 2)
        self.x, self.t = np.empty((4, 3)), np.empty((4, 3))
        for node in range(4):
            beam, end = divmod(node, 2)
            self.x[node] = directions[beam] * self.length[beam] / 2 * (2 * end - 1 - place[beam])
            self.t[node] = rotation(rng.uniform(-bend, bend, 3)) @ directions[beam]
        self.x[:2, 2] += rng.choice([-1, 1]) * 0.1
        found = closest_points(self.x, self.t, self.length, axis=self.axis)
        self.places = found[:2]
        low, high = places
        return found.status == "inside" and all(low <= abs(xi) <= high + 0.1 * (1 - high) for xi in self.places)

    def push_together(self, distance):
        """Move the unbarred beam along the common normal until the axes have this distance (negative: passed)."""
        radius = self.properties["radius"]
        values, normal, _, info = _core.f2py_contact.contact_kinematics(
            self.x.T, self.t.T, self.length, 1 if self.axis == "linear" else 2, radius, *self.places, 0
        )
        assert info == 0
        self.side_before = values[4]
        self.x[2:] += (values[0] - distance) * normal

    def evaluate(self, *, x=None, t=None, v=None, rotation_vectors=None, **changes):
        return contact_em(
            self.x if x is None else x,
            self.t if t is None else t,
            self.length,
            self.v if v is None else v,
            axis=self.axis,
            rotation_vectors=rotation_vectors,
            **{**self.properties, **self.laws, **changes},
        )

    def moved(self, dq):
        """Positions, tangents and voltages after displacements, rotations by a vector, and voltages `dq` (..., 28)."""
        q = dq[..., :24].reshape(*dq.shape[:-1], 4, 6)
        return dict(x=self.x + q[..., :3], t=turned(self.t, q[..., 3:]), v=self.v + dq[..., 24:])

    def residual(self, dq):
        result = self.evaluate(**self.moved(dq))
        assert np.all(result.active)
        return result.R


#: Kinds of pairs: arguments of `Pair`
CLASSES = {
    "perpendicular": dict(degrees=(90, 90)),
    "oblique": dict(degrees=(25, 155)),
    "5 degrees from parallel": dict(degrees=(5, 5), bend=0.003, step=0.003),
    "strongly pre-rotated": dict(degrees=(60, 120), bend=0.9),
    "near element ends": dict(places=(0.96, 0.99), bend=0.05),
    "shallow": dict(overlap=(1e-3, 1e-2)),
    "deep": dict(overlap=(0.6, 1.2)),
    "axes passed each other": dict(overlap=(1.1, 1.8), through=True, step=0.003),
    "zero voltage difference": dict(no_voltage=True),
    "unequal materials and radii": dict(spread=10.0),
}
