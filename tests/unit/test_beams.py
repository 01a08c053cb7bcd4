"""Beam elements B31 and B33: each statement of the contract, over random configurations.

Differences are of sixth order with a step of 1e-3 on unknowns of size 1. Truncation is then about 1e-18 times the
seventh derivative over 140, round-off about 2e-13 times the size of what is differenced. Both leave the demanded 1e-8
of each 3x3 block with orders to spare, also where a block is much smaller than the matrix.
"""

from typing import ClassVar

import numpy as np
import pytest

from derivatives import derivative_of_batch, rotation, skew
from litz import _core, kernels

STIFFNESS = {
    "b31": {"ea": 2.0, "ga2": 1.3, "ga3": 0.8, "gj": 0.7, "ei2": 0.5, "ei3": 0.9},
    "b33": {"ea": 2.0, "gj": 0.7, "ei2": 0.5, "ei3": 0.9},
}
#: Largest rotation of each node against the element's rigid rotation [rad], in turn over the random configurations
NODE_ROTATIONS = [0.0, 1e-8, 1e-4, 0.02, 0.2, 0.5, 1.0, 1.4]
STEP = 1e-3
BLOCKS = [slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)]

elements = pytest.mark.parametrize("element", ["b31", "b33"])
configurations = pytest.mark.parametrize("seed", range(200))
some_configurations = pytest.mark.parametrize("seed", range(40))


class Configuration:
    """An element with a curved, pre-twisted stress-free state, turned by a large rotation and deformed strongly."""

    def __init__(self, element, seed):
        rng = np.random.default_rng(seed)
        self.rng = rng
        self.element = element
        self.stiffness = STIFFNESS[element]
        frame = rotation(3 * unit(rng))
        self.x0 = np.array([np.zeros(3), rng.uniform(0.5, 2) * frame[:, 0]]) + rng.normal(size=3)
        bend = 0.4 * rng.uniform(0, 1) * (seed % 4 > 0)
        self.triads0 = np.stack([frame @ rotation(bend * unit(rng)) for _ in range(2)])
        rigid = rotation(3 * unit(rng))
        amplitude = NODE_ROTATIONS[seed % len(NODE_ROTATIONS)]
        self.triads = np.stack([rigid @ t @ rotation(amplitude * unit(rng)) for t in self.triads0])
        self.x = self.x0 @ rigid.T + amplitude * rng.uniform(-0.2, 0.2, size=(2, 3))

    def moved(self, q):
        """Positions and triads after displacements and rotation vectors `q` (..., 12)."""
        q = q.reshape(*q.shape[:-1], 2, 6)
        return self.x + q[..., :3], rotation(q[..., 3:]) @ self.triads

    def __call__(self, q=None, **options):
        kernel = getattr(kernels, f"beam_{self.element}")
        x, triads = (self.x, self.triads) if q is None else self.moved(q)
        return kernel(x, triads, self.x0, self.triads0, **self.stiffness, **options)

    def strains(self, q=None):
        kernel = getattr(kernels, f"beam_{self.element}_strains")
        x, triads = (self.x, self.triads) if q is None else self.moved(q)
        return kernel(x, triads, self.x0, self.triads0)

    def rigidities(self):
        """What the docstrings promise between strains and section forces."""
        s, length = self.stiffness, self.strains().length
        shear = [s["ga2"], s["ga3"]] if self.element == "b31" else [12 * s[i] / length**2 for i in ("ei3", "ei2")]
        return np.array([s["ea"], *shear, s["gj"], s["ei2"], s["ei3"]])


def unit(rng):
    v = rng.normal(size=3)
    return v / np.linalg.norm(v)


def by_rotation_vectors(r, q):
    """Gradients (..., 12) by spins to gradients by the rotation vectors in `q`."""
    r = r.copy()
    for state in np.ndindex(r.shape[:-1]):
        for rows in (slice(3, 6), slice(9, 12)):
            r[state][rows] = _core.f2py_rotations.spin_tangent(q[state][rows]).T @ r[state][rows]
    return r


def assert_blocks_equal(k, expected, tolerance):
    for rows in BLOCKS:
        for columns in BLOCKS:
            size = np.abs(expected[rows, columns]).max()
            error = np.abs(k[rows, columns] - expected[rows, columns]).max()
            assert error <= tolerance * size, f"block {rows}, {columns}: {error:.1e} of {size:.1e}"


@elements
@configurations
class TestDerivatives:
    def test_residual_is_the_gradient_of_the_energy(self, element, seed):
        case = Configuration(element, seed)
        gradient = derivative_of_batch(lambda q: case(q).energy, np.zeros(12), STEP)
        # round-off of the energy difference against a residual that may vanish: 2e-13 of the stiffness 1
        assert np.abs(case().R - gradient).max() < 1e-9 * np.abs(gradient).max() + 1e-13

    def test_spin_form_is_the_derivative_by_spins(self, element, seed):
        case = Configuration(element, seed)
        assert_blocks_equal(case().K, derivative_of_batch(lambda q: case(q).R, np.zeros(12), STEP), 1e-8)

    def test_hessian_form_is_the_derivative_by_rotation_vectors(self, element, seed):
        case = Configuration(element, seed)
        numeric = derivative_of_batch(lambda q: by_rotation_vectors(case(q).R, q), np.zeros(12), STEP)
        assert_blocks_equal(case(form="hessian").K, numeric, 1e-8)

    def test_hessian_form_is_symmetric_to_round_off(self, element, seed):
        k = Configuration(element, seed)(form="hessian").K
        assert np.abs(k - k.T).max() < 2e-15 * np.abs(k).max()

    def test_hessian_form_is_the_second_difference_of_the_energy(self, element, seed):
        case = Configuration(element, seed)
        direction = case.rng.normal(size=12)
        direction /= np.linalg.norm(direction)
        # weights of the second difference of eighth order; round-off eps/step^2 = 1e-12, like the truncation
        step, weights = 1.5e-2, np.array([8 / 5, -1 / 5, 8 / 315, -1 / 560])
        around = [
            case(i * step * direction).energy + case(-i * step * direction).energy - 2 * case().energy
            for i in range(1, 5)
        ]
        expected = direction @ case(form="hessian").K @ direction
        assert weights @ around / step**2 == pytest.approx(expected, rel=1e-8, abs=1e-9)

    def test_rows_of_b_are_the_derivatives_of_the_strains(self, element, seed):
        case = Configuration(element, seed)
        numeric = derivative_of_batch(lambda q: case.strains(q).strain, np.zeros(12), STEP)
        assert np.abs(case.strains().B - numeric).max() < 1e-10 * np.abs(numeric).max()

    def test_given_section_forces_enter_through_the_second_derivatives_of_the_strains_only(self, element, seed):
        case = Configuration(element, seed)
        sigma = case.rng.normal(size=6)
        own, given = case(form="hessian"), case(form="hessian", sigma=sigma)
        assert np.array_equal(own.R, given.R)
        assert np.array_equal(own.section_forces, given.section_forces)
        assert own.energy == given.energy
        assert np.array_equal(case(form="hessian", sigma=own.section_forces).K, own.K)

        state = case.strains()
        material = state.length * state.B.T @ np.diag(case.rigidities()) @ state.B

        def contracted(q):
            return state.length * by_rotation_vectors(sigma @ case.strains(q).B, q)

        geometric = derivative_of_batch(contracted, np.zeros(12), STEP)
        assert np.abs(given.K - material - geometric).max() < 1e-9 * np.abs(given.K).max()


@elements
@some_configurations
class TestInvariance:
    @staticmethod
    def round_off(result):
        """Positions of size 5 are known to 1e-15; the tangent tells what that does to forces."""
        return 2e-14 * np.abs(result.K).max()

    def test_rigid_motion_changes_nothing_but_directions(self, element, seed):
        case = Configuration(element, seed)
        before = case()
        q, shift = rotation(2.5 * unit(case.rng)), case.rng.normal(size=3)
        case.x, case.triads = case.x @ q.T + shift, q @ case.triads
        after = case()
        turn = np.kron(np.eye(4), q)
        round_off = self.round_off(before)
        assert abs(after.energy - before.energy) < round_off
        assert np.abs(after.section_forces - before.section_forces).max() < round_off
        assert np.abs(after.R - turn @ before.R).max() < round_off
        assert np.abs(after.K - turn @ before.K @ turn.T).max() < round_off

    def test_rigid_motion_of_the_stress_free_state_changes_nothing(self, element, seed):
        case = Configuration(element, seed)
        before = case()
        q, shift = rotation(2.5 * unit(case.rng)), case.rng.normal(size=3)
        case.x0, case.triads0 = case.x0 @ q.T + shift, q @ case.triads0
        assert np.abs(case().R - before.R).max() < self.round_off(before)
        assert np.abs(case().K - before.K).max() < self.round_off(before)

    def test_nodal_forces_and_moments_are_in_equilibrium(self, element, seed):
        case = Configuration(element, seed)
        f1, m1, f2, m2 = case().R.reshape(4, 3)
        assert np.abs(f1 + f2).max() == 0
        assert np.abs(m1 + m2 + np.cross(case.x[1] - case.x[0], f2)).max() < 2e-15 * np.abs(case().R).max()

    def test_rigid_motion_increments_are_not_resisted(self, element, seed):
        case = Configuration(element, seed)
        case.x, case.triads = case.x0, case.triads0
        turn = [-skew(case.x[0]), np.eye(3), -skew(case.x[1]), np.eye(3)]
        shift = [np.eye(3), np.zeros((3, 3)), np.eye(3), np.zeros((3, 3))]
        motions = np.hstack([np.vstack(shift), np.vstack(turn)])
        k = case().K
        assert np.abs(k @ motions).max() < 1e-13 * np.abs(k).max()
        assert np.linalg.matrix_rank(k, tol=1e-9) == 6

    def test_stress_free_state_is_free_of_forces(self, element, seed):
        case = Configuration(element, seed)
        case.x, case.triads = case.x0, case.triads0
        at_rest = case()
        assert at_rest.energy == 0
        assert np.abs(at_rest.R).max() == 0
        assert np.abs(at_rest.section_forces).max() == 0

    def test_strains_give_section_forces_and_energy(self, element, seed):
        case = Configuration(element, seed)
        state, result = case.strains(), case()
        assert np.abs(result.section_forces - case.rigidities() * state.strain).max() < 1e-15
        assert result.energy == pytest.approx(state.length / 2 * result.section_forces @ state.strain, rel=1e-14)

    def test_work_does_not_depend_on_the_path(self, element, seed):
        """Work along a winding path of positions and rotation vectors is the difference of the energies.

        From the stress-free state, so that the relative rotation stays below half a turn on the way.
        """
        case = Configuration(element, seed)
        case.x, case.triads = case.x0, case.triads0
        size = np.tile(np.repeat([0.1, 0.3], 3), 2)
        way, detour = size * case.rng.uniform(-1, 1, size=(2, 12))
        points, weights = np.polynomial.legendre.leggauss(30)
        s = (points[:, None] + 1) / 2
        q = s * way + np.sin(np.pi * s) * detour
        speed = way + np.pi * np.cos(np.pi * s) * detour
        work = weights / 2 @ (by_rotation_vectors(case(q).R, q) * speed).sum(axis=1)
        assert work == pytest.approx(case(way).energy - case().energy, rel=1e-10, abs=1e-12)


@elements
class TestSwitchesBetweenSeriesAndClosedForms:
    """The coefficients change from series to closed forms; residual and tangent must not notice."""

    @pytest.mark.parametrize("seed", range(20))
    def test_relative_rotation_of_one_radian(self, element, seed):
        case = Configuration(element, 8 * seed)
        case.triads0 = np.stack([case.triads0[0]] * 2)
        axis = unit(case.rng)
        self.compare(case, lambda e: (case.x, np.stack([case.triads[0], case.triads[0] @ rotation((1 + e) * axis)])))

    @pytest.mark.parametrize("seed", range(20))
    def test_chord_slope_of_one_fifth(self, element, seed):
        case = Configuration(element, 8 * seed)
        triad, angle = case.triads[0], case.rng.uniform(0, 2 * np.pi)

        def state(e):
            slope = 0.2 * (1 + e)
            chord = triad @ np.array([1, slope * np.cos(angle), slope * np.sin(angle)])
            return np.array([case.x[0], case.x[0] + chord]), np.stack([triad, triad])

        self.compare(case, state)

    @staticmethod
    def compare(case, state):
        gap = 2e-14
        kernel = getattr(kernels, f"beam_{case.element}")
        below, above = (kernel(*state(e), case.x0, case.triads0, **case.stiffness) for e in (-gap, gap))
        # the states differ by 2 gap, the forces by about as much; the closed forms lose some digits in the tangent
        assert np.abs(above.R - below.R).max() < 1e-13 * np.abs(above.K).max()
        assert np.abs(above.K - below.K).max() < 1e-12 * np.abs(above.K).max()


def straight(length, frame):
    x0 = np.array([np.zeros(3), length * frame[:, 0]])
    return x0, np.stack([frame, frame])


def plane_bending(entries, deflection, rotation_about, sign):
    """12x12 matrix from a 4x4 one in (v1, th1, v2, th2); `sign` is that of dv/ds = sign th."""
    where = [deflection, 3 + rotation_about, 6 + deflection, 9 + rotation_about]
    flip = np.diag([1, sign, 1, sign])
    k = np.zeros((12, 12))
    k[np.ix_(where, where)] = flip @ entries @ flip
    return k


def bar(stiffness_over_length, unknown):
    k = np.zeros((12, 12))
    k[np.ix_([unknown, unknown + 6], [unknown, unknown + 6])] = stiffness_over_length * np.array([[1, -1], [-1, 1]])
    return k


def cubic_bending(ei, h):
    """Euler-Bernoulli: Przemieniecki, Theory of Matrix Structural Analysis (1968), eq. 5.85 without shear."""
    return (ei / h**3) * np.array(
        [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h**2, -6 * h, 2 * h**2],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h**2, -6 * h, 4 * h**2],
        ]
    )


def one_point_timoshenko_bending(ei, ga, h):
    """Linear Timoshenko element, one-point integration: Hughes, The Finite Element Method (1987), section 5.4."""
    shear = np.array([-1 / h, -1 / 2, 1 / h, -1 / 2])
    curvature = np.array([0, -1 / h, 0, 1 / h])
    return h * (ga * np.outer(shear, shear) + ei * np.outer(curvature, curvature))


def geometric_bending(n, h):
    """Beam under an axial force: Przemieniecki (1968), eq. 15.44."""
    return (n / (30 * h)) * np.array(
        [
            [36, 3 * h, -36, 3 * h],
            [3 * h, 4 * h**2, -3 * h, -(h**2)],
            [-36, -3 * h, 36, -3 * h],
            [3 * h, -(h**2), -3 * h, 4 * h**2],
        ]
    )


@pytest.mark.parametrize("seed", range(20))
class TestTextbookMatrices:
    H = 1.7

    def matrix(self, seed, element, **options):
        frame = rotation(3 * unit(np.random.default_rng(seed)))
        x0, triads0 = straight(self.H, frame)
        kernel = getattr(kernels, f"beam_{element}")
        k = kernel(x0, triads0, x0, triads0, **STIFFNESS[element], **options).K
        local = np.kron(np.eye(4), frame)
        return local.T @ k @ local

    def test_b33_is_the_cubic_euler_bernoulli_matrix(self, seed):
        s, h = STIFFNESS["b33"], self.H
        expected = (
            bar(s["ea"] / h, 0)
            + bar(s["gj"] / h, 3)
            + plane_bending(cubic_bending(s["ei3"], h), deflection=1, rotation_about=2, sign=1)
            + plane_bending(cubic_bending(s["ei2"], h), deflection=2, rotation_about=1, sign=-1)
        )
        assert np.abs(self.matrix(seed, "b33") - expected).max() < 1e-14 * np.abs(expected).max()

    def test_b31_is_the_one_point_timoshenko_matrix(self, seed):
        s, h = STIFFNESS["b31"], self.H
        expected = (
            bar(s["ea"] / h, 0)
            + bar(s["gj"] / h, 3)
            + plane_bending(one_point_timoshenko_bending(s["ei3"], s["ga2"], h), 1, 2, sign=1)
            + plane_bending(one_point_timoshenko_bending(s["ei2"], s["ga3"], h), 2, 1, sign=-1)
        )
        assert np.abs(self.matrix(seed, "b31") - expected).max() < 1e-14 * np.abs(expected).max()

    def test_b33_under_axial_force_has_the_consistent_geometric_matrix(self, seed):
        n, h = 0.8, self.H
        geometric = self.matrix(seed, "b33", form="hessian", sigma=[n, 0, 0, 0, 0, 0]) - self.matrix(
            seed, "b33", form="hessian", sigma=np.zeros(6)
        )
        expected = plane_bending(geometric_bending(n, h), 1, 2, sign=1) + plane_bending(
            geometric_bending(n, h), 2, 1, sign=-1
        )
        assert np.abs(geometric - expected).max() < 1e-14


@elements
class TestSigns:
    """One small deformation at a time on an element along x with section axes y and z."""

    H, SMALL = 0.5, 1e-7

    def forces(self, element, q):
        x0, triads0 = straight(self.H, np.eye(3))
        q = np.reshape(q, (2, 6))
        triads = np.stack([rotation(p) for p in q[:, 3:]])
        return getattr(kernels, f"beam_{element}")(x0 + q[:, :3], triads, x0, triads0, **STIFFNESS[element])

    @pytest.mark.parametrize(
        ("unknown", "force", "stiffness"), [(6, 0, "ea"), (9, 3, "gj"), (10, 4, "ei2"), (11, 5, "ei3")]
    )
    def test_second_node_moved_ahead_or_turned_about_an_axis(self, element, unknown, force, stiffness):
        q = np.zeros(12)
        q[unknown] = self.SMALL
        expected = STIFFNESS[element][stiffness] * self.SMALL / self.H
        assert self.forces(element, q).section_forces[force] == pytest.approx(expected, rel=1e-6)

    @pytest.mark.parametrize(("unknown", "force"), [(7, 1), (8, 2)])
    def test_second_node_moved_along_a_section_axis_is_pulled_back_by_the_shear_force(self, element, unknown, force):
        q = np.zeros(12)
        q[unknown] = self.SMALL
        result = self.forces(element, q)
        assert result.section_forces[force] > 0
        assert result.R[unknown] == pytest.approx(result.section_forces[force], rel=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_b33_moments_at_the_ends_follow_from_moment_and_shear_at_mid_length(seed):
    # quadratic terms are 1e-8 of the linear ones
    h, small = 0.5, 1e-8
    x0, triads0 = straight(h, np.eye(3))
    q = small * np.random.default_rng(seed).normal(size=(2, 6))
    triads = np.stack([rotation(p) for p in q[:, 3:]])
    result = kernels.beam_b33(x0 + q[:, :3], triads, x0, triads0, **STIFFNESS["b33"])
    _, q2, q3, _, m2, m3 = result.section_forces
    at_first, at_second = -result.R[4:6], result.R[10:12]
    assert np.abs(at_first - [m2 - q3 * h / 2, m3 + q2 * h / 2]).max() < 1e-5 * small
    assert np.abs(at_second - [m2 + q3 * h / 2, m3 - q2 * h / 2]).max() < 1e-5 * small


class TestReferenceLength:
    def test_of_a_straight_element_is_the_chord(self):
        x0, triads0 = straight(1.3, rotation([0.3, -2, 1]))
        assert kernels.beam_b31_strains(x0, triads0, x0, triads0).length == pytest.approx(1.3, rel=1e-15)

    @pytest.mark.parametrize("angle", [1e-6, 0.1, 0.999, 1.001, np.pi / 2, 3.0])
    def test_of_an_arc_is_the_arc(self, angle):
        radius = 2.0
        x0 = radius * np.array([[0, 0, 0], [np.sin(angle), 1 - np.cos(angle), 0]])
        triads0 = np.stack([np.eye(3), rotation([0, 0, angle])])
        # the chord itself, a difference of numbers near 1, is known to round-off over the angle
        assert kernels.beam_b31_strains(x0, triads0, x0, triads0).length == pytest.approx(
            radius * angle, rel=1e-15 + 1e-16 / angle
        )

    def test_pre_twist_does_not_lengthen(self):
        x0, triads0 = straight(1.3, np.eye(3))
        triads0[1] = rotation([2.0, 0, 0])
        assert kernels.beam_b31_strains(x0, triads0, x0, triads0).length == pytest.approx(1.3, rel=1e-15)


class RollUp:
    """A cantilever under an end moment `2 pi EI/L`, which rolls it up to a full circle.

    Newton with independent section forces: those of the linear prediction stand in the geometric part of the tangent.
    """

    L, EA, EI = 1.0, 1e4, 1.0

    def __init__(self, element, n):
        self.element, self.n, self.h = element, n, self.L / n
        self.frame = rotation([0.4, -0.9, 1.3])
        self.x0 = np.outer(np.arange(n + 1) * self.h, self.frame[:, 0])
        self.triads0 = np.stack([self.frame] * (n + 1))
        self.stiffness = {"ea": self.EA, "gj": 0.7, "ei2": 0.6, "ei3": self.EI}
        shear = 12 * self.EI / self.h**2, 12 * 0.6 / self.h**2
        if element == "b31":
            shear = 0.4 * self.EA, 0.4 * self.EA
            self.stiffness |= {"ga2": shear[0], "ga3": shear[1]}
        self.c = np.array([self.EA, *shear, 0.7, 0.6, self.EI])

    def solve(self, iterations):
        """Return positions and triads, and the residual before the last solve."""
        n = self.n
        kernel, strains = (getattr(kernels, f"beam_{self.element}{part}") for part in ("", "_strains"))
        x, triads, sigma = self.x0.copy(), self.triads0.copy(), np.zeros((n, 6))
        load = np.zeros(6 * (n + 1))
        load[-3:] = 2 * np.pi * self.EI / self.L * self.frame[:, 2]
        for _ in range(iterations):
            k, r = np.zeros((6 * n + 6, 6 * n + 6)), -load
            for e in range(n):
                pair, rows = slice(e, e + 2), slice(6 * e, 6 * e + 12)
                part = kernel(
                    x[pair],
                    triads[pair],
                    self.x0[pair],
                    self.triads0[pair],
                    **self.stiffness,
                    sigma=sigma[e],
                )
                k[rows, rows] += part.K
                r[rows] += part.R
            dq = np.concatenate([np.zeros(6), np.linalg.solve(k[6:, 6:], -r[6:])])
            for e in range(n):
                pair, rows = slice(e, e + 2), slice(6 * e, 6 * e + 12)
                state = strains(x[pair], triads[pair], self.x0[pair], self.triads0[pair])
                sigma[e] = self.c * (state.strain + state.B @ dq[rows])
            x += dq.reshape(-1, 6)[:, :3]
            triads = np.stack([rotation(d) @ t for d, t in zip(dq.reshape(-1, 6)[:, 3:], triads, strict=True)])
        return x, triads, np.abs(r[6:]).max()


class TestRollUp:
    N = 8
    #: The strains of B31 are linear in the chord: three solves; the chord of B33 has to turn back from far off
    ITERATIONS: ClassVar = {"b31": 4, "b33": 14}

    @elements
    def test_nodal_rotations_are_exact_and_the_circle_closes(self, element):
        case = RollUp(element, self.N)
        x, triads, residual = case.solve(self.ITERATIONS[element])
        assert residual < 1e-9
        for i, triad in enumerate(triads):
            exact = case.frame @ rotation([0, 0, 2 * np.pi * i / self.N])
            assert np.abs(triad - exact).max() < 1e-11
        assert np.abs(x[-1] - x[0]).max() < 1e-12

    def test_b31_nodes_stand_on_a_polygon_of_unstretched_sides(self):
        x, _, _ = RollUp("b31", self.N).solve(self.ITERATIONS["b31"])
        assert np.linalg.norm(np.diff(x, axis=0), axis=1) == pytest.approx(np.full(self.N, 1 / self.N), rel=1e-12)

    def test_b33_nodes_stand_on_the_circle_to_fourth_order(self):
        """Chord `h (1 - psi^2/24)` against `h sin(psi/2)/(psi/2)`: `psi^4/1920` too short."""
        psi = 2 * np.pi / self.N
        x, _, _ = RollUp("b33", self.N).solve(self.ITERATIONS["b33"])
        sides = np.linalg.norm(np.diff(x, axis=0), axis=1) * self.N
        assert sides == pytest.approx(np.full(self.N, 1 - psi**2 / 24), rel=1e-12)
        assert sides == pytest.approx(np.full(self.N, np.sin(psi / 2) / (psi / 2)), abs=1.01 * psi**4 / 1920)


@elements
class TestRefusals:
    def arguments(self, element):
        x0, triads0 = straight(1.0, np.eye(3))
        return {"x": x0, "triads": triads0, "x0": x0, "triads0": triads0, **STIFFNESS[element]}

    def refused(self, element, message, **changes):
        with pytest.raises(ValueError, match=message):
            getattr(kernels, f"beam_{element}")(**(self.arguments(element) | changes))

    @pytest.mark.parametrize("name", ["x", "x0"])
    def test_wrong_shape_of_positions(self, element, name):
        self.refused(element, rf"{name} must have shape \(2, 3\), not \(3, 2\)", **{name: np.ones((3, 2))})

    @pytest.mark.parametrize("name", ["triads", "triads0"])
    def test_wrong_shape_of_triads(self, element, name):
        self.refused(element, rf"{name} must have shape \(2, 3, 3\), not \(3, 3\)", **{name: np.eye(3)})

    @pytest.mark.parametrize("name", ["x", "x0", "triads", "triads0"])
    def test_not_a_number(self, element, name):
        broken = self.arguments(element)[name].copy()
        broken.flat[1] = np.nan
        self.refused(element, f"{name} must be finite, but holds nan", **{name: broken})

    @pytest.mark.parametrize("name", ["triads", "triads0"])
    def test_triads_that_are_not_orthonormal(self, element, name):
        self.refused(
            element, rf"columns of {name}\[1\] must be orthonormal", **{name: np.stack([np.eye(3), 1.001 * np.eye(3)])}
        )

    @pytest.mark.parametrize("name", ["triads", "triads0"])
    def test_left_handed_triads(self, element, name):
        self.refused(element, rf"{name}\[0\] must be right-handed", **{name: np.stack([np.diag([1, 1, -1])] * 2)})

    @pytest.mark.parametrize("name", ["x", "x0"])
    def test_element_without_length(self, element, name):
        self.refused(element, f"{name}: the two nodes coincide", **{name: np.ones((2, 3))})

    @pytest.mark.parametrize("value", [0.0, -1.0])
    def test_stiffness_that_is_not_positive(self, element, value):
        for name in STIFFNESS[element]:
            self.refused(element, f"{name} must be greater than 0, not {value:g}", **{name: value})

    def test_stiffness_that_is_not_a_number(self, element):
        self.refused(element, "ei3 must be finite", ei3=np.nan)
        self.refused(element, "ei3 must be an array of real numbers", ei3="stiff")

    def test_unknown_form(self, element):
        self.refused(element, "form must be 'spin' or 'hessian', not 'total'", form="total")

    def test_wrong_shape_of_section_forces(self, element):
        self.refused(element, r"sigma must have shape \(6,\), not \(3,\)", sigma=np.ones(3))


@elements
@some_configurations
def test_a_stress_free_strain_is_taken_from_the_axial_strain_alone(element, seed):
    beam = Configuration(element, seed)
    strain, _, length = beam.strains()
    rigidities = beam.rigidities()
    thermal = 0.03
    heated = beam(stress_free_strain=thermal)
    np.testing.assert_allclose(
        heated.section_forces, rigidities * (strain - thermal * np.eye(6)[0]), rtol=1e-13, atol=1e-14
    )
    assert heated.energy == pytest.approx(length / 2 * (heated.section_forces**2 / rigidities).sum(), rel=1e-13)
    cold = beam()
    np.testing.assert_array_equal(beam(stress_free_strain=0.0).K, cold.K)
    # what bends, turns and shears is the same
    np.testing.assert_array_equal(heated.section_forces[1:], cold.section_forces[1:])


@elements
@some_configurations
def test_the_tangent_at_a_stress_free_strain_is_the_derivative_of_the_forces(element, seed):
    beam = Configuration(element, seed)
    numerical = derivative_of_batch(lambda q: beam(q, stress_free_strain=0.02).R, np.zeros(12), STEP)
    tangent = beam(stress_free_strain=0.02).K
    for i in BLOCKS:
        for j in BLOCKS:
            assert np.abs(tangent[i, j] - numerical[i, j]).max() < 1e-8 * max(np.abs(tangent).max(), 1e-3)


@elements
@some_configurations
def test_forces_by_temperature_are_the_derivative_of_the_forces(element, seed):
    """All stiffnesses and the stress-free strain change with the temperature; the differences are exact for cubics."""
    beam = Configuration(element, seed)
    strains, rigidities, rate = beam.strains(), beam.rigidities(), -0.3
    thermal, expansion = 0.01, 0.4

    def forces(temperature):
        hot = Configuration(element, seed)
        hot.stiffness = {name: value * (1 + rate * temperature) for name, value in beam.stiffness.items()}
        return hot(stress_free_strain=thermal + expansion * temperature).R

    step = 1e-3
    numerical = (8 * (forces(step) - forces(-step)) - (forces(2 * step) - forces(-2 * step))) / (12 * step)
    found = kernels.beam_forces_by_temperature(
        strains,
        rigidity=rigidities,
        drigidity=rate * rigidities,
        stress_free_strain=thermal,
        dstress_free_strain=expansion,
    )
    np.testing.assert_allclose(found, numerical, rtol=0, atol=1e-9 * max(np.abs(numerical).max(), 1))


def test_a_stress_free_strain_must_be_a_number():
    beam = Configuration("b31", 1)
    with pytest.raises(ValueError, match="stress_free_strain"):
        beam(stress_free_strain=np.nan)
