"""Friction at a point of a line contact: slip, forces, and the tangent against differences of the residual.

Differences of the sixth order with steps of 1e-3 of the overlap leave 1e-8 of the largest entry of the tangent.
"""

import numpy as np
import pytest

from derivatives import derivative, rotation
from line_pair import LinePair
from litz import _core

KINDS = {
    "straight and parallel": dict(bend=0.0),
    "parallel and curved": dict(bend=0.3),
    "strands": dict(degrees=(5, 20)),
    "crossed": dict(degrees=(60, 120)),
    "against each other": dict(degrees=(170, 190)),
    "strongly curved": dict(degrees=(-30, 30), bend=0.8),
    "foot held at an end": dict(degrees=(-10, 10), held=True),
}
STICK, SLIP = 1, 2
EPS_N = 2.0
TOLERANCE = 1e-8


class RubbedPair(LinePair):
    """A point of a line whose nodes and foot have moved since an increment began, with a traction from before."""

    def __init__(self, seed, status=STICK, **kind):
        # cubic axes: only those of linear ones are not met
        super().__init__(4 * seed, laws={}, **kind)
        rng = self.rng
        self.turned = np.array([rotation(rng.uniform(-0.2, 0.2, 3)) for _ in range(4)])
        w = self.vector(self.x, self.t)
        self.normal_before = rotation(rng.uniform(-0.1, 0.1, 3)) @ (w / np.linalg.norm(w))
        self.arc_before = self.length[0] / 2 * self.xi_bar + rng.uniform(-0.02, 0.02)
        force = -EPS_N * self.gap(np.zeros(24))[0]
        self.traction_start = rng.uniform(-0.1, 0.1, 2) * force
        self.stiffness = rng.uniform(0.5, 1.0) * EPS_N
        self.mu = 1e6
        trial = np.linalg.norm(self.rub()[1][2:4])
        self.mu = trial / force * (rng.uniform(1.2, 3.0) if status == STICK else rng.uniform(0.2, 0.8))

    def rub(self, x=None, t=None, turned=None):
        """Tangent, (slip, traction, status), residual and the directions of the slip."""
        x, t = (self.x if x is None else x), (self.t if t is None else t)
        turned = self.turned if turned is None else turned
        held = any(self.ends)
        xi_bar = self.xi_bar if held else self.foot(x, t, self.xi_bar)
        gap = np.linalg.norm(self.vector(x, t, xi_bar)) - self.properties["radius"].sum()
        moved = self.length[0] / 2 * xi_bar - self.arc_before
        k, r, values, frame, info = _core.f2py_line.line_friction(
            x.T, t.T, self.length, self.properties["radius"], xi_bar, self.xi, held, np.zeros(3),
            np.moveaxis(turned, 0, -1), self.normal_before, moved, self.mu, [-EPS_N * gap, -EPS_N],
            [self.stiffness * -gap, -self.stiffness / -EPS_N], self.traction_start,
        )  # fmt: skip
        assert info == 0
        return k, values, r, frame

    def after(self, dq):
        """Positions, tangents and rotations after displacements and spins (24)."""
        q = np.asarray(dq).reshape(4, 6)
        turns = rotation(q[:, 3:])
        return self.x + q[:, :3], (turns @ self.t[:, :, None])[:, :, 0], turns @ self.turned

    def residual(self, dq):
        return self.rub(*self.after(dq))[2]

    def slip(self, dq):
        return self.rub(*self.after(dq))[1][:2]


@pytest.mark.slow
@pytest.mark.parametrize("status", [STICK, SLIP], ids=["stick", "slip"])
@pytest.mark.parametrize("name", KINDS)
def test_the_tangent_is_the_derivative_of_the_residual(name, status):
    for seed in range(6):
        pair = RubbedPair(seed, status, **KINDS[name])
        k, values, _, _ = pair.rub()
        assert values[4] == status
        difference = k - derivative(pair.residual, np.zeros(24), 1e-3 * pair.depth)
        assert np.abs(difference).max() < TOLERANCE * np.abs(k).max(), seed


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", KINDS)
class TestWhatHoldsExactly:
    def test_forces_and_moments_are_in_equilibrium(self, name, seed):
        pair = RubbedPair(seed, **KINDS[name])
        nodes = pair.rub()[2].reshape(4, 6)
        forces, moments = nodes[:, :3], nodes[:, 3:]
        size = np.abs(nodes).max()
        assert np.abs(forces.sum(axis=0)).max() < 1e-13 * size
        assert np.abs((np.cross(pair.x, forces) + moments).sum(axis=0)).max() < 1e-13 * size

    def test_a_rigid_motion_turns_the_forces_and_changes_nothing_else(self, name, seed):
        pair = RubbedPair(seed, **KINDS[name])
        _, values, r, _ = pair.rub()
        turn, shift = rotation([0.7, -1.9, 0.4]), np.array([0.3, -0.2, 0.5])
        _, moved_values, moved_r, _ = pair.rub(pair.x @ turn.T + shift, pair.t @ turn.T, turn @ pair.turned)
        assert moved_values == pytest.approx(values, rel=1e-10, abs=1e-12)
        assert np.abs(moved_r - (r.reshape(8, 3) @ turn.T).ravel()).max() < 1e-10 * np.abs(r).max()

    def test_the_traction_works_on_the_slip_of_the_surfaces(self, name, seed):
        """When an increment begins, the work of the traction is traction times slip."""
        pair = RubbedPair(seed, **KINDS[name])
        w = pair.vector(pair.x, pair.t)
        pair.normal_before, pair.turned = w / np.linalg.norm(w), np.array([np.eye(3)] * 4)
        pair.arc_before = pair.length[0] / 2 * pair.xi_bar
        _, values, r, _ = pair.rub()
        assert np.abs(values[:2]).max() < 1e-13
        rows = derivative(pair.slip, np.zeros(24), 1e-3 * pair.depth)
        assert np.abs(values[2:4] @ rows - r).max() < TOLERANCE * np.abs(r).max()


def parallel_pair(turn_of_barred, turn, roll):
    """Two straight wires of the radii 0.1 and 0.2 side by side; the unbarred one goes around the other by `roll` and
    either wire has turned about its axis. Slip since the start, residual, directions."""
    radius, length = np.array([0.1, 0.2]), np.array([1.0, 1.0])
    axis = np.array([1.0, 0, 0])
    normal_before = np.array([0, 0, 1.0])
    # from the unbarred to the barred axis
    normal = rotation(roll * axis) @ normal_before
    x = np.array([[-0.5, 0, 0], [0.5, 0, 0], [-0.5, 0, 0], [0.5, 0, 0]])
    x[2:] -= radius.sum() * normal
    turned = np.array([rotation(turn_of_barred * axis)] * 2 + [rotation(turn * axis)] * 2)
    _, r, values, frame, info = _core.f2py_line.line_friction(
        x.T, np.array([axis] * 4).T, length, radius, 0.0, 0.0, 0, np.zeros(3), np.moveaxis(turned, 0, -1), normal_before,
        0.0, 1e6, [1.0, 0.0], [1.0, 0.0], np.zeros(2),
    )  # fmt: skip
    assert info == 0
    return values[:2], r.reshape(4, 6), frame


class TestWiresThatRoll:
    @pytest.mark.parametrize("roll", [0.01, 0.3, 1.5])
    def test_rolling_around_a_wire_that_rests_is_no_slip_however_far(self, roll):
        slip, _, _ = parallel_pair(0.0, roll * (1 + 0.1 / 0.2), roll)
        assert slip == pytest.approx([0, 0], abs=1e-14)

    def test_wires_that_turn_as_gears_do_not_slip(self):
        slip, _, _ = parallel_pair(0.4, -0.2, 0.0)
        assert slip == pytest.approx([0, 0], abs=1e-14)

    def test_wires_that_turn_the_same_way_slip_across(self):
        slip, _, frame = parallel_pair(0.01, 0.01, 0.0)
        # the surface of the barred wire is below its axis, that of the other one above
        velocity = np.cross([0.01, 0, 0], [0, 0, -0.1]) - np.cross([0.01, 0, 0], [0, 0, 0.2])
        assert slip == pytest.approx(frame.T @ velocity, rel=1e-4, abs=1e-15)

    def test_each_wire_gets_the_moment_of_the_traction_about_its_axis(self):
        slip, nodes, _ = parallel_pair(0.01, 0.01, 0.0)
        traction = slip[1]
        moments = nodes[:, 3].reshape(2, 2).sum(axis=1)
        # stiffness 1: the traction is the slip, and its arms are the radii
        assert np.abs(moments) == pytest.approx(np.array([0.1, 0.2]) * abs(traction), rel=1e-12)
        assert np.sign(moments[0]) == np.sign(moments[1])
