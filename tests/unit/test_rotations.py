"""Finite rotations, and the forms of a tangent in rotational unknowns."""

import numpy as np
import pytest

from derivatives import derivative, rotation, skew
from litz import _core

rotations = _core.f2py_rotations

ANGLES = [0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.29999, 0.30001, 1.0, 2.0, 3.0, 3.14, 4.0, 6.0]
STEP = 2e-3


def direction(seed):
    v = np.random.default_rng(seed).normal(size=3)
    return v / np.linalg.norm(v)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("seed", range(10))
class TestOneRotation:
    def test_exponential_is_the_matrix_exponential(self, angle, seed):
        v = angle * direction(seed)
        assert np.abs(rotations.rotation_exp(v) - rotation(v)).max() < 1e-14

    def test_exponential_is_orthonormal(self, angle, seed):
        r = rotations.rotation_exp(angle * direction(seed))
        assert np.abs(r @ r.T - np.eye(3)).max() < 4e-15

    def test_logarithm_inverts_the_exponential(self, angle, seed):
        n = direction(seed)
        expected = angle * n if angle <= np.pi else (angle - 2 * np.pi) * n
        assert np.abs(rotations.rotation_log(rotations.rotation_exp(angle * n)) - expected).max() < 2e-15 * max(
            1, np.abs(expected).max()
        )

    def test_spin_tangent_is_the_derivative_of_the_exponential(self, angle, seed):
        v = angle * direction(seed)
        r = rotation(v)
        numeric = np.stack(
            [vector_of(slope @ r.T) for slope in np.moveaxis(derivative(rotation, v, STEP), -1, 0)], axis=-1
        )
        assert np.abs(rotations.spin_tangent(v) - numeric).max() < 1e-11

    def test_derivative_of_the_transposed_spin_tangent(self, angle, seed):
        v, m = angle * direction(seed), direction(seed + 100)
        numeric = derivative(lambda w: rotations.spin_tangent(w).T @ m, v, STEP)
        assert np.abs(rotations.spin_tangent_transpose_derivative(v, m) - numeric).max() < 1e-10


def vector_of(s):
    return np.array([s[2, 1] - s[1, 2], s[0, 2] - s[2, 0], s[1, 0] - s[0, 1]]) / 2


@pytest.mark.parametrize("seed", range(20))
def test_logarithm_of_a_half_turn_has_the_axis_up_to_sign(seed):
    n = direction(seed)
    v = rotations.rotation_log(2 * np.outer(n, n) - np.eye(3))
    assert np.linalg.norm(v) == pytest.approx(np.pi, rel=1e-15)
    assert np.abs(np.cross(v, n)).max() < 1e-14


@pytest.mark.parametrize("angle", [1e-9, 1e-5, 1e-2])
def test_logarithm_of_a_small_rotation_keeps_its_relative_accuracy(angle):
    v = angle * direction(1)
    r = np.eye(3) + skew(v) + skew(v) @ skew(v) / 2 - angle**2 / 6 * skew(v)
    assert np.abs(rotations.rotation_log(r) / v - 1).max() < angle**4 + 1e-15 / angle


class TwoDirectors:
    """Energy `p.A p/2` of `p = (y, t1, t2)`, `t_i = R_i c_i`, and a row `a.t1` that is no gradient.

    Unknowns in this order: `y` (3), rotation of node 1 (3), the extra one `v` (1), rotation of node 2 (3).
    """

    first = np.array([4, 8])
    y, theta1, v, theta2 = slice(0, 3), slice(3, 6), 6, slice(7, 10)

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        a = rng.normal(size=(9, 9))
        self.a = a + a.T
        self.c = rng.normal(size=(2, 3))
        self.row = rng.normal(size=3)
        self.start = [rotation(rng.normal(size=3)) for _ in range(2)]
        self.q = rng.normal(size=10)

    def directors(self, q):
        phi = q[self.theta1], q[self.theta2]
        return [rotation(p) @ r @ c for p, r, c in zip(phi, self.start, self.c, strict=True)]

    def energy(self, q):
        p = np.concatenate([q[self.y], *self.directors(q)])
        return p @ self.a @ p / 2

    def extra_residual(self, q):
        return self.row @ self.directors(q)[0]

    def spin_form(self, q):
        t = self.directors(q)
        p = np.concatenate([q[self.y], *t])
        f = self.a @ p
        to_p = np.zeros((9, 10))
        to_p[:3, self.y] = np.eye(3)
        to_p[3:6, self.theta1] = -skew(t[0])
        to_p[6:9, self.theta2] = -skew(t[1])
        r = to_p.T @ f
        k = to_p.T @ self.a @ to_p
        k[self.theta1, self.theta1] += skew(f[3:6]) @ skew(t[0])
        k[self.theta2, self.theta2] += skew(f[6:9]) @ skew(t[1])
        r[self.v] = self.row @ t[0]
        k[self.v, self.theta1] = -self.row @ skew(t[0])
        return k, r

    def rotation_vector_form(self, q):
        phi = np.column_stack([q[self.theta1], q[self.theta2]])
        return rotations.spin_to_rotation_vectors(*self.spin_form(q), phi, self.first)


@pytest.mark.parametrize("seed", range(20))
class TestForms:
    def test_residual_in_rotation_vectors_is_the_gradient_by_them(self, seed):
        case = TwoDirectors(seed)
        gradient = derivative(case.energy, case.q, STEP)
        gradient[case.v] = case.extra_residual(case.q)
        assert np.abs(case.rotation_vector_form(case.q)[1] - gradient).max() < 1e-10 * np.abs(gradient).max()

    def test_tangent_in_rotation_vectors_is_the_derivative_by_them(self, seed):
        case = TwoDirectors(seed)
        k, _ = case.rotation_vector_form(case.q)
        numeric = derivative(lambda q: case.rotation_vector_form(q)[1], case.q, STEP)
        assert np.abs(k - numeric).max() < 1e-10 * np.abs(k).max()

    def test_tangent_of_a_gradient_is_symmetric_in_rotation_vectors(self, seed):
        case = TwoDirectors(seed)
        k, _ = case.rotation_vector_form(case.q)
        gradient = np.delete(np.delete(k, case.v, 0), case.v, 1)
        assert np.abs(gradient - gradient.T).max() < 1e-13 * np.abs(gradient).max()

    def test_hessian_form_is_the_one_in_rotation_vectors_at_zero(self, seed):
        case = TwoDirectors(seed)
        case.q[case.theta1] = case.q[case.theta2] = 0
        k, r = case.spin_form(case.q)
        at_zero, same_r = rotations.spin_to_rotation_vectors(k, r, np.zeros((3, 2)), case.first)
        assert np.abs(same_r - r).max() < 1e-15
        assert np.abs(rotations.spin_to_hessian(k, r, case.first) - at_zero).max() < 1e-14 * np.abs(k).max()

    def test_hessian_to_spin_inverts_spin_to_hessian(self, seed):
        case = TwoDirectors(seed)
        k, r = case.spin_form(case.q)
        there = rotations.spin_to_hessian(k, r, case.first)
        assert np.abs(there - k).max() > 0.1
        assert np.abs(rotations.hessian_to_spin(there, r, case.first) - k).max() < 1e-14 * np.abs(k).max()
