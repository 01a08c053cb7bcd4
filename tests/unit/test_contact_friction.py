"""Friction of wires that cross: the return map, the slip of the surfaces, and the tangent against differences.

Noise of the differences as in test_contact_em: 1e-8 of the largest entry of the tangent.
"""

import numpy as np
import pytest

from contact_pair import CLASSES, Pair
from derivatives import derivative, derivative_along, random_direction, rotation
from litz import _core
from litz.kernels import closest_points

AXES = {"linear": 1, "hermite": 2}
KINDS = {name: kind for name, kind in CLASSES.items() if name != "zero voltage difference"}
TOLERANCE = 1e-8
N_CONFIGURATIONS = 200
#: Of these, the first ones by every column, the others along a direction that moves all nodes
N_BY_COLUMNS = 20
STICK, SLIP = 1, 2
EPS_N = 2.0


class RubbedPair(Pair):
    """A pair whose nodes and closest points have moved since an increment began, with a traction from before."""

    def __init__(self, seed, status, **kind):
        super().__init__(seed, laws=dict(spot_law="none", normal_law="linear", eps_n=EPS_N), **kind)
        force = self.evaluate().force
        self.status = status
        self.along = self.rng.choice([-1.0, 1.0], 2)
        self.start = np.array(self.places) + self.rng.uniform(-0.1, 0.1, 2)
        self.turned = np.array([rotation(self.rng.uniform(-0.2, 0.2, 3)) for _ in range(4)])
        self.normal_before = rotation(self.rng.uniform(-0.1, 0.1, 3)) @ self.kinematics(self.x, self.t)[2]
        # constant, or as of a round Hertz spot
        self.stiffness = (0.7, 0.0) if seed % 2 else (0.7 * force ** (-1 / 3), 1 / 3)
        self.traction_start = self.rng.uniform(-0.1, 0.1, 2) * force
        # first so much friction that it sticks, then the coefficient of the status that is wanted
        self.mu = 1e6
        trial = np.linalg.norm(self.rub()[1][:2])
        # the direction of a small trial traction turns fast
        self.step = min(0.3 * self.step, 0.02 * trial / self.tangential_stiffness(force)[0])
        self.mu = trial / force * (self.rng.uniform(1.2, 3.0) if status == STICK else self.rng.uniform(0.2, 0.8))

    def tangential_stiffness(self, force):
        """Stiffness and its derivative over the force."""
        factor, power = self.stiffness
        return factor * force**power, power * factor * force ** (power - 1)

    def kinematics(self, x, t):
        """Closest points, (distance, gap, angle, ...), and the normal."""
        found = closest_points(x, t, self.length, axis=self.axis)
        assert found.status == "inside"
        geometry = (x.T, t.T, self.length, AXES[self.axis], self.properties["radius"])
        xi = np.array([found.xi_bar, found.xi])
        values, normal, _, info = _core.f2py_contact.contact_kinematics(*geometry, *xi, self.laws.get("side", 0))
        assert info == 0
        return xi, values, normal

    def rub(self, x=None, t=None, turned=None):
        """Tangent, (traction, plastic slip, dissipation, status, slip) and residual of the friction."""
        x, t = (self.x if x is None else x), (self.t if t is None else t)
        xi, (_, gap, *_), _ = self.kinematics(x, t)
        force = -EPS_N * gap
        k, r, values, _, info = _core.f2py_contact.contact_friction(
            x.T, t.T, self.length, AXES[self.axis], self.properties["radius"], *xi, self.laws.get("side", 0),
            self.along, np.moveaxis(self.turned if turned is None else turned, 0, -1), self.normal_before,
            self.length / 2 * (xi - self.start), self.mu, [force, -EPS_N, 0.0], self.tangential_stiffness(force),
            self.traction_start,
        )  # fmt: skip
        assert info == 0
        return k, values, r

    def after(self, dq):
        """Positions, tangents and rotations after displacements and spins (24)."""
        moved = self.moved(np.concatenate([dq, np.zeros(4)]))
        return moved["x"], moved["t"], rotation(np.reshape(dq, (4, 6))[:, 3:]) @ self.turned

    def friction_residual(self, dq):
        _, values, r = self.rub(*self.after(dq))
        assert values[5] == self.status
        return r

    def friction_residuals(self, states):
        return np.array([self.friction_residual(dq) for dq in states])

    def slip(self, dq):
        return self.rub(*self.after(dq))[1][6:]

    def noise(self):
        """Round-off of the closest points, over the square of the sine, and of the force, over the gap."""
        _, (_, gap, angle, *_), _ = self.kinematics(self.x, self.t)
        return 1e-14 * (1 / np.sin(angle) ** 2 + self.properties["radius"].min() / abs(gap))

    def turn_round(self):
        """Exchange the nodes of both elements: the same wires, and the same axes."""
        order = [1, 0, 3, 2]
        self.x, self.t, self.turned = self.x[order], -self.t[order], self.turned[order]
        self.along, self.start = -self.along, -self.start
        return np.arange(24).reshape(4, 6)[order].ravel()


@pytest.mark.slow
@pytest.mark.parametrize("status", [STICK, SLIP], ids=["stick", "slip"])
@pytest.mark.parametrize("name", KINDS)
def test_tangent_is_the_derivative_of_the_residual(name, status):
    for seed in range(N_CONFIGURATIONS):
        pair = RubbedPair(seed, status, **KINDS[name])
        k, values, _ = pair.rub()
        assert values[5] == status
        if seed < N_BY_COLUMNS:
            difference = k - derivative(pair.friction_residual, np.zeros(24), pair.step)
        else:
            direction = random_direction(pair.rng, np.s_[:24])[:24]
            difference = k @ direction - derivative_along(pair.friction_residuals, direction, pair.step)
        assert np.abs(difference).max() < TOLERANCE * np.abs(k).max(), seed


@pytest.mark.parametrize("status", [STICK, SLIP], ids=["stick", "slip"])
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", KINDS)
class TestWhatHoldsExactly:
    @pytest.fixture
    def pair(self, name, seed, status):
        return RubbedPair(seed, status, **KINDS[name])

    def test_forces_and_moments_are_in_equilibrium(self, pair):
        nodes = pair.rub()[2].reshape(4, 6)
        forces, moments = nodes[:, :3], nodes[:, 3:]
        size = np.abs(nodes).max()
        assert np.abs(forces.sum(axis=0)).max() < 1e-13 * size
        assert np.abs((np.cross(pair.x, forces) + moments).sum(axis=0)).max() < 1e-13 * size

    def test_a_rigid_motion_turns_the_forces_and_changes_nothing_else(self, pair):
        _, values, r = pair.rub()
        turn, shift = rotation([0.7, -1.9, 0.4]), np.array([0.3, -0.2, 0.5])
        _, moved_values, moved_r = pair.rub(pair.x @ turn.T + shift, pair.t @ turn.T, turn @ pair.turned)
        noise = pair.noise()
        assert moved_values == pytest.approx(values, rel=10 * noise, abs=noise)
        assert np.abs(moved_r - (r.reshape(8, 3) @ turn.T).ravel()).max() < 100 * noise * np.abs(r).max()

    def test_the_traction_works_on_the_slip_of_the_surfaces(self, pair):
        """When an increment begins, the work of the traction is traction times slip."""
        xi, _, normal = pair.kinematics(pair.x, pair.t)
        pair.normal_before, pair.turned, pair.start = normal, np.array([np.eye(3)] * 4), xi
        pair.status, pair.mu = STICK, 1e6
        _, values, r = pair.rub()
        assert np.abs(values[6:]).max() < 1e-12
        rows = derivative(pair.slip, np.zeros(24), pair.step)
        assert np.abs(values[:2] @ rows - r).max() < TOLERANCE * np.abs(r).max()

    def test_elements_that_run_the_other_way_give_the_same(self, pair):
        k, values, r = pair.rub()
        rows = pair.turn_round()
        k_round, values_round, r_round = pair.rub()
        noise = pair.noise()
        assert values_round == pytest.approx(values, rel=10 * noise, abs=noise)
        assert np.abs(r_round - r[rows]).max() < 100 * noise * np.abs(r).max()
        assert np.abs(k_round - k[np.ix_(rows, rows)]).max() < 1000 * noise * np.abs(k).max()

    def test_the_traction_is_in_the_cone(self, pair, status):
        force = -EPS_N * pair.kinematics(pair.x, pair.t)[1][1]
        _, values, _ = pair.rub()
        size = np.linalg.norm(values[:2])
        if status == STICK:
            assert size < pair.mu * force
            assert (values[2:5] == 0).all()
        else:
            assert size == pytest.approx(pair.mu * force, rel=1e-14)
            # heat: traction times plastic slip, which has its direction
            assert values[4] == pytest.approx(values[:2] @ values[2:4], rel=1e-13)
            assert values[4] > 0


@pytest.mark.parametrize("degrees", [90, 60, 30, 12, 150])
def test_friction_is_isotropic_in_the_plane_of_the_axes(degrees):
    """A straight wire is pushed in its plane: the force that resists is against the push, and mu F, whatever way."""
    psi = np.radians(degrees)
    length, radius = np.array([2.0, 2.0]), np.array([0.1, 0.1])
    directions = np.array([[1, 0, 0], [np.cos(psi), np.sin(psi), 0.0]])
    t = directions[[0, 0, 1, 1]]
    x0 = t * np.array([[-1], [1], [-1], [1]])
    x0[:2, 2] = 0.15
    for phi in np.linspace(0, 2 * np.pi, 12, endpoint=False):
        push = np.array([np.cos(phi), np.sin(phi), 0])
        for distance, status in ((1e-4, STICK), (1e-2, SLIP)):
            x = x0.copy()
            x[:2] += distance * push
            found = closest_points(x, t, length)
            xi = np.array([found.xi_bar, found.xi])
            moved = length / 2 * xi
            along, turned, normal = [1, 1], np.moveaxis([np.eye(3)] * 4, 0, -1), [0, 0, 1]
            _, r, values, on_bar, info = _core.f2py_contact.contact_friction(
                x.T, t.T, length, AXES["hermite"], radius, *xi, 0, along, turned, normal, moved, 0.4,
                [0.1, -2.0, 0.0], [50.0, 0.0], [0, 0]
            )  # fmt: skip
            assert info == 0
            assert values[5] == status
            # R is internal minus external: positive against a displacement
            resisting = r.reshape(4, 6)[:2, :3].sum(axis=0)
            assert resisting == pytest.approx(min(50 * distance, 0.4 * 0.1) * push, abs=1e-12)
            assert on_bar == pytest.approx(-resisting, abs=1e-12)


class TestWiresThatRoll:
    """A straight wire of radius 0.1 lies across a fixed one of radius 0.2 that runs along x, at an angle."""

    RADIUS = np.array([0.1, 0.2])

    def slip(self, degrees, shift, turns, turns_of_fixed=(0, 0, 0)):
        """How far, as a vector, the barred wire has slipped over the other one."""
        psi, length = np.radians(degrees), np.array([2.0, 2.0])
        directions = np.array([[np.cos(psi), np.sin(psi), 0.0], [1, 0, 0]])
        t0 = directions[[0, 0, 1, 1]]
        turned = np.array([rotation(turns)] * 2 + [rotation(turns_of_fixed)] * 2)
        t = np.einsum("nij,nj->ni", turned, t0)
        x = np.empty((4, 3))
        x[:2] = np.array([0, 0, self.RADIUS.sum()]) + shift + (rotation(turns) @ (t0[:2] * [[-1], [1]]).T).T
        x[2:] = t[2:] * [[-1], [1]]
        found = closest_points(x, t, length)
        xi = np.array([found.xi_bar, found.xi])
        # a traction of one times the slip
        _, r, _, on_bar, info = _core.f2py_contact.contact_friction(
            x.T, t.T, length, AXES["hermite"], self.RADIUS, *xi, 0, [1, 1], np.moveaxis(turned, 0, -1), [0, 0, 1],
            length / 2 * xi, 1e6, [1.0, 0.0, 0.0], [1.0, 0.0], [0, 0]
        )  # fmt: skip
        assert info == 0
        return -on_bar, r.reshape(4, 6)

    @pytest.mark.parametrize("degrees", [90, 40, 140])
    def test_a_wire_that_rolls_on_the_other_does_not_slip_across_its_axis(self, degrees):
        """However far: it moves perpendicularly to its axis by its radius times the angle."""
        psi = np.radians(degrees)
        axis, across = np.array([np.cos(psi), np.sin(psi), 0]), np.array([np.sin(psi), -np.cos(psi), 0])
        for angle in (0.01, 0.5, -2.0):
            slip, _ = self.slip(degrees, 0.1 * angle * across, angle * axis)
            # the place of the contact on its own wire moves as well: that is the slide along it
            assert np.linalg.norm(slip) == pytest.approx(0, abs=1e-12)

    def test_a_wire_that_turns_on_the_spot_slips_by_its_radius_times_the_angle(self):
        slip, nodes = self.slip(90, (0, 0, 0), (0, 0.02, 0))
        # its lowest point moves against x
        assert slip == pytest.approx([-0.1 * 0.02, 0, 0], abs=1e-12)
        # the traction, of the size of the slip, turns it back with the arm of its radius
        assert nodes[:2, 4].sum() == pytest.approx(0.1 * np.linalg.norm(slip), rel=1e-12)
        # and bends the fixed wire with the arm of the other radius
        assert nodes[2:, 4].sum() == pytest.approx(0.2 * np.linalg.norm(slip), rel=1e-12)

    def test_a_wire_that_is_pushed_without_turning_slips_by_its_way(self):
        for way in ((0.03, 0, 0), (0, 0.05, 0), (-0.02, 0.03, 0)):
            assert self.slip(60, way, (0, 0, 0))[0] == pytest.approx(way, abs=1e-12)


def test_a_point_rubbed_to_and_fro_dissipates_the_area_of_its_loop():
    """Four mu N (U - mu N/k_t) a cycle under constant force, in any steps."""
    mu, force, stiffness, amplitude = 0.3, 2.0, 40.0, 0.05
    for n in (1, 3, 10):
        path = amplitude * np.concatenate(
            [
                np.linspace(0, 1, n + 1),
                *2 * [np.r_[np.linspace(1, -1, 2 * n + 1)[1:], np.linspace(-1, 1, 2 * n + 1)[1:]]],
            ]
        )
        traction, heat = np.zeros(2), np.zeros(len(path))
        for i in range(1, len(path)):
            slip = (path[i] - path[i - 1]) * np.array([0.6, 0.8])
            values = friction_law(mu, force, stiffness, 0.0, traction, slip)
            traction, heat[i] = values[:2], values[4]
        cycle = 4 * mu * force * (amplitude - mu * force / stiffness)
        assert heat[-4 * n :].sum() == pytest.approx(cycle, rel=1e-12)


def friction_law(mu, force, stiffness, dstiffness_dforce, traction, slip):
    """Traction, plastic slip, dissipation, status."""
    return _core.f2py_contact.friction_law(mu, force, stiffness, dstiffness_dforce, traction, slip)[0]


def test_the_stiffness_of_equal_materials_is_mindlins():
    for nu in (0.0, 0.3, 0.49):
        ratio = _core.f2py_contact.mindlin_ratio([3.0, 3.0], [nu, nu])
        assert ratio == pytest.approx(2 * (1 - nu) / (2 - nu), rel=1e-14)
    # a rigid partner leaves the compliance of the other one alone
    assert _core.f2py_contact.mindlin_ratio([3.0, 3e12], [0.2, 0.4]) == pytest.approx(2 * 0.8 / 1.8, rel=1e-9)
