"""The kernels as element routines of a program written in Python: frames of PyNite, contacts and conductors in batches.

`pip install PyNiteFEA`; without it these tests are skipped.
"""

from pathlib import Path

import numpy as np
import pytest

from derivatives import rotation
from litz import kernels
from litz.hosts import read_host_model

INPUTS = Path(__file__).parents[2] / "inputs"


def stiffness_of_frames(host):
    """The stiffness of the wires alone as PyNite has it, six unknowns for each node in the order of the model."""
    pynite = pytest.importorskip("Pynite", reason="the package PyNiteFEA is not installed: pip install PyNiteFEA")
    frame = pynite.FEModel3D()
    for place, (section, material) in enumerate(host.sections):
        inertia = np.pi * section.radius**4 / 4
        shear = material.young / (2 * (1 + material.poisson))
        frame.add_material(f"E{place}", material.young, shear, material.poisson, 0.0)
        frame.add_section(f"S{place}", np.pi * section.radius**2, inertia, inertia, 2 * inertia)
    for row, place in enumerate(host.x):
        frame.add_node(f"N{row}", *map(float, place))
        frame.def_support(f"N{row}", *((row, dof) in {*host.supports, *host.prescribed} for dof in range(1, 7)))
    for row, ((first, last), place) in enumerate(zip(host.connectivity, host.section_of, strict=True)):
        frame.add_member(f"M{row}", f"N{first}", f"N{last}", f"E{place}", f"S{place}")
    frame.analyze_linear(check_stability=False)
    stiffness = getattr(frame, "Ke", None) or frame.K
    assert [node.ID for node in frame.nodes.values()] == list(range(len(host.x)))
    return np.asarray(stiffness(check_stability=False, sparse=False))


class Solver:
    """Newton's method over six motions and a voltage of each node."""

    def __init__(self, host):
        self.host = host
        self.n = n = len(host.x)
        self.linear = np.zeros((7 * n, 7 * n))
        self.linear[: 6 * n, : 6 * n] = stiffness_of_frames(host)
        ends = host.x[host.connectivity]
        self.length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        self.tangents = (ends[:, 1] - ends[:, 0]) / self.length[:, None]
        self.add_conductors()
        wires, _ = host.contact_properties(next(iter(host.contact_kinds())))
        names = ("radius", "young", "poisson", "resistivity")
        self.wires = {name: wires[2 * i : 2 * i + 2] for i, name in enumerate(names)}
        self.nodes = host.connectivity[host.pairs].reshape(-1, 4)
        series = self.wires["resistivity"] * self.length[host.pairs] / (4 * np.pi * np.square(self.wires["radius"]))
        self.laws = dict(normal_law="hertz", spot_law="hertz", series_resistance=series)

    def add_conductors(self):
        """One call for all elements."""
        area = np.array([np.pi * section.radius**2 for section, _ in self.host.sections])[self.host.section_of]
        rho = np.array([1 / material.conductivity for _, material in self.host.sections])[self.host.section_of]
        all_of_them = kernels.conductor(
            self.host.x[self.host.connectivity], [0, 0], self.length, area=area, resistivity=rho
        )
        for place, k in zip(6 * self.n + self.host.connectivity, all_of_them.K, strict=True):
            self.linear[np.ix_(place, place)] += k

    def contacts(self, q):
        """One call for all pairs that may touch."""
        u, v = q[: 6 * self.n].reshape(-1, 6), q[6 * self.n :]
        phi = u[self.nodes, 3:]
        along = np.repeat(self.tangents[self.host.pairs], 2, axis=1)
        turned = np.array(
            [[rotation(p) @ t for p, t in zip(*pair, strict=True)] for pair in zip(phi, along, strict=True)]
        )
        x = self.host.x[self.nodes] + u[self.nodes, :3]
        return kernels.contact_em(
            x,
            turned,
            self.length[self.host.pairs],
            v[self.nodes],
            **self.wires,
            **self.laws,
            rotation_vectors=phi,
        )

    def solve(self, increments, n_iterations=30):
        """The contacts at the end of the step."""
        place = {
            (row, dof): 6 * self.n + row if dof == 9 else 6 * row + dof - 1
            for row in range(self.n)
            for dof in range(1, 10)
        }
        held = sorted(place[key] for key in {*self.host.supports, *self.host.prescribed})
        free = np.setdiff1d(np.arange(7 * self.n), held)
        motions = (6 * self.nodes[:, :, None] + np.arange(6)).reshape(len(self.nodes), 24)
        rows = np.concatenate([motions, 6 * self.n + self.nodes], axis=1)
        q = np.zeros(7 * self.n)
        for increment in range(1, increments + 1):
            for key, value in self.host.prescribed.items():
                q[place[key]] = value * increment / increments
            for _ in range(n_iterations):
                found = self.contacts(q)
                residual, tangent = self.linear @ q, self.linear.copy()
                for where, r, k in zip(rows, found.R, found.K, strict=True):
                    residual[where] += r
                    tangent[np.ix_(where, where)] += k
                step = np.linalg.solve(tangent[np.ix_(free, free)], residual[free])
                q[free] -= step
                if abs(step).max() < 1e-14:
                    break
            else:
                raise AssertionError("Newton's method does not converge")
        return self.contacts(q)


def test_two_crossed_wires():
    host = read_host_model(INPUTS / "01_crossed_wires.inp", reach=0.03)
    assert len(host.pairs) > 9
    found = Solver(host).solve(10)
    # one of the pairs that may touch does; of the others the closest points lie beyond
    assert found.active.sum() == 1
    # the exact solution in the head of the deck; the cubic of an element misses (10 mm/100 mm)^3 of the deflection
    assert found.force[found.active] == pytest.approx([0.900591], rel=1.5e-3)
    assert found.current[found.active] == pytest.approx([1.068100], rel=1e-3)
