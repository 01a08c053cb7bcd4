"""The contact element: every block of its tangent against differences of its residual, and what must hold exactly.

Noise of the differences: the gap is known to about 1e-16 of the positions, the electric residual goes with the cube
root of the gap. A step of 2 % of the overlap leaves a truncation of 1e-10 (sixth order) and a round-off of
1e-16/step, 1e-9 at the shallowest overlap below; 1e-8 of the largest entry of a block covers both. Near parallel axes
a small turn moves the closest points far, and an overlap beyond the axes is no small length: there the step is smaller.
"""

from typing import ClassVar

import numpy as np
import pytest

from contact_pair import CLASSES, Pair
from derivatives import derivative_along, derivative_of_batch, random_direction, rotation, skew, turned
from litz import _core
from litz.kernels import closest_points, contact_coupling, contact_em, contact_spot, normal_law

TOLERANCE = 1e-8
N_CONFIGURATIONS = 200
#: Of these, the first ones by every column; the others along a direction that moves all nodes, and one of all voltages
N_BY_COLUMNS = 20

MM, ME, EE, UPPER = np.s_[:24, :24], np.s_[24:, :24], np.s_[24:, 24:], np.s_[:24, 24:]


def block_errors(k, numeric):
    """Largest difference in each block relative to its largest entry (a block that is zero must be exactly so)."""
    errors = {}
    for name, block in (("K_mm", MM), ("K_me", ME), ("K_ee", EE), ("upper right", UPPER)):
        size = np.abs(k[block]).max()
        errors[name] = np.abs(k[block] - numeric[block]).max() / (size or 1)
    return errors


def errors_along(k, residual, pair):
    """The same by one motion and one change of the voltages in place of all columns."""
    errors = {}
    for columns, rows in ((np.s_[:24], ("K_mm", "K_me")), (np.s_[24:], ("upper right", "K_ee"))):
        direction = random_direction(pair.rng, columns)
        difference = np.abs(k @ direction - derivative_along(residual, direction, pair.step))
        for name, part in zip(rows, (np.s_[:24], np.s_[24:]), strict=True):
            errors[name] = difference[part].max() / (np.abs(k[part, columns]).max() or 1)
    return errors


def errors_of_tangent(seed, k, residual, pair):
    if seed < N_BY_COLUMNS:
        return block_errors(k, derivative_of_batch(residual, np.zeros(28), pair.step))
    return errors_along(k, residual, pair)


@pytest.mark.parametrize("name", CLASSES)
def test_tangent_is_the_derivative_of_the_residual_by_spins(name):
    for seed in range(N_CONFIGURATIONS):
        pair = Pair(seed, **CLASSES[name])
        result = pair.evaluate()
        assert result.active, seed
        errors = errors_of_tangent(seed, result.K, pair.residual, pair)
        assert max(errors.values()) < TOLERANCE, (seed, pair.laws, errors)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["oblique", "strongly pre-rotated", "axes passed each other"])
def test_tangent_is_the_derivative_of_the_residual_by_rotation_vectors(name):
    # rotation vectors up to beyond a half turn, from starting tangents that are not known to the element
    for seed in range(N_CONFIGURATIONS // 2):
        pair = Pair(seed, **CLASSES[name])
        phi = pair.rng.uniform(-2.5, 2.5, (4, 3))
        start = turned(pair.t, -phi)

        def residual(dq, pair=pair, phi=phi, start=start):
            q = dq[:, :24].reshape(-1, 4, 6)
            vectors = phi + q[..., 3:]
            moved = dict(x=pair.x + q[..., :3], t=turned(start, vectors), v=pair.v + dq[:, 24:])
            return pair.evaluate(**moved, rotation_vectors=vectors).R

        result = pair.evaluate(rotation_vectors=phi)
        errors = errors_of_tangent(seed, result.K, residual, pair)
        assert max(errors.values()) < TOLERANCE, (seed, pair.laws, errors)


@pytest.mark.slow
@pytest.mark.parametrize("name", CLASSES)
def test_residual_of_the_penalty_law_is_the_gradient_of_its_energy(name):
    laws = dict(spot_law="paper", eps_n=2.0, normal_law="linear")
    for seed in range(20):
        pair = Pair(seed, laws=laws, **CLASSES[name])

        def energy(dq, pair=pair):
            return pair.evaluate(**pair.moved(dq)).gap ** 2  # eps_n = 2: Pi = eps g^2/2

        r = pair.evaluate().R[:24]
        gradient = derivative_of_batch(energy, np.zeros(28), pair.step)[:24]
        assert np.abs(r - gradient).max() < TOLERANCE * np.abs(r).max(), seed


@pytest.mark.parametrize("name", CLASSES)
def test_residual_of_hertz_is_the_gradient_of_its_energy(name):
    """Two fifths of force times overlap, which depend on the angle: crossed wires that press resist to be turned."""
    for seed in range(20):
        pair = Pair(seed, laws=dict(spot_law="none", normal_law="hertz"), **CLASSES[name])

        def energy(dq, pair=pair):
            found = pair.evaluate(**pair.moved(dq))
            return -0.4 * found.force * found.gap

        r = pair.evaluate().R[:24]
        gradient = derivative_of_batch(energy, np.zeros(28), pair.step)[:24]
        assert np.abs(r - gradient).max() < TOLERANCE * np.abs(r).max(), seed


def yielding(pair, spot, larger):
    """Laws of the pair with metal that yields well below its present overlap, and a dent of `larger` times its force."""
    laws = dict(normal_law="hertz", spot_law=spot) | (dict(film_resistivity=0.1) if spot == "film" else {})
    pair.laws = {key: value for key, value in pair.laws.items() if key in ("side", "series_resistance")} | laws
    elastic = pair.evaluate(spot_law="hertz", film_resistivity=None)
    pressure = 1.5 * elastic.force / (np.pi * elastic.semi_major * elastic.semi_minor)
    pair.laws |= dict(yield_stress=0.2 * pressure, hardness=1.2 * pressure)
    pair.laws["largest_force"] = larger * pair.evaluate().force


@pytest.mark.parametrize("name", ["oblique", "strongly pre-rotated"])
@pytest.mark.parametrize("spot", ["hertz", "film", "none"])
@pytest.mark.parametrize("larger", [0.0, 1.5])
def test_tangent_of_wires_that_yield(name, spot, larger):
    """On the loading, where the dent and its torque grow, and on the way back."""
    for seed in range(N_BY_COLUMNS):
        pair = Pair(seed, **(CLASSES[name] | dict(overlap=(0.01, 0.05))))
        yielding(pair, spot, larger)
        result = pair.evaluate()
        assert result.active, seed
        assert result.dent > 0
        errors = errors_of_tangent(seed, result.K, pair.residual, pair)
        assert max(errors.values()) < TOLERANCE, (seed, pair.laws, errors)


@pytest.mark.parametrize("largest_force", [0.0, 6.0])
def test_wires_that_yield_have_the_law_of_the_spot(largest_force):
    """Force, spot and dent are those of `normal_law`, the conductance that of `contact_spot`; over the dent there is nothing."""
    metal = dict(
        radius=1e-3, young=120e9, poisson=0.34, yield_stress=200e6, hardness=800e6, largest_force=largest_force
    )
    x = np.array([[-0.01, 0, 1.998e-3], [0.01, 0, 1.998e-3], [0, -0.01, 0], [0, 0.01, 0]])
    t = [[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
    laws = dict(normal_law="hertz", spot_law="hertz", resistivity=1.7e-8, **metal)
    found = contact_em(x, t, [0.02, 0.02], [1e-3, 1e-3, 0, 0], **laws)
    law = normal_law(2e-6, angle=np.pi / 2, **metal)
    spot = contact_spot(law.force, angle=np.pi / 2, resistivity=1.7e-8, **metal)
    for name in ("force", "semi_major", "dent", "largest_force"):
        assert getattr(found, name) == pytest.approx(getattr(law, name), rel=1e-9), name
    assert found.resistance == pytest.approx(1 / spot.conductance, rel=1e-9)
    kept = contact_em(x, t, [0.02, 0.02], [1e-3, 1e-3, 0, 0], keeps_spot=True, **laws)
    top = contact_spot(law.largest_force, angle=np.pi / 2, resistivity=1.7e-8, **metal)
    assert kept.resistance == pytest.approx(1 / top.conductance, rel=1e-9)
    lifted = x + np.array([[0, 0, 2e-6 - 0.99 * law.dent]] * 2 + [[0, 0, 0]] * 2)
    over = contact_em(lifted, t, [0.02, 0.02], np.zeros(4), **(laws | dict(largest_force=law.largest_force)))
    assert not over.active
    assert over.gap < 0
    assert not over.K.any()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(normal_law="linear", eps_n=1.0), 'yield_stress belongs to normal_law="hertz"'),
        (dict(spot_law="plastic"), "makes a spot of its own"),
        (dict(spot_law="paper"), "makes a spot of its own"),
        (dict(hardness=250e6), "hardness must be greater than the pressure"),
        (dict(yield_stress=-1.0), "yield_stress must be greater than 0"),
        (dict(largest_force=-1.0), "largest_force must not be negative"),
        (dict(yield_stress=None, hardness=None, largest_force=1.0), "largest_force needs yield_stress"),
        (dict(ends=[0, 1]), "at the ends of wires"),
        (dict(x=[[-0.01, 0, 1.8e-3], [0.01, 0, 1.8e-3], [0, -0.01, 0], [0, 0.01, 0]]), "more than half of the smaller"),
    ],
)
def test_what_does_not_go_with_wires_that_yield_is_refused(change, words):
    good = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8, normal_law="hertz", spot_law="hertz",
                yield_stress=200e6, hardness=800e6)  # fmt: skip
    x = [[-0.01, 0, 1.998e-3], [0.01, 0, 1.998e-3], [0, -0.01, 0], [0, 0.01, 0]]
    t = [[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
    with pytest.raises(ValueError, match=words):
        contact_em(**(dict(x=x, t=t, length=[0.02, 0.02], v=np.zeros(4)) | good | change))


def test_wires_that_press_resist_to_be_turned_from_crossed_towards_parallel():
    """3/5 F delta of Hertz by the logarithm of the approach at a fixed force, about the normal."""
    angle, step, apart = 0.6, 1e-4, 0.19
    wires = dict(radius=0.1, young=2.0, poisson=0.0, resistivity=3.0)

    def contact(angle):
        t = np.array([np.cos([0, 0, angle, angle]), np.sin([0, 0, angle, angle]), np.zeros(4)]).T
        x = t * np.array([-1, 1, -1, 1])[:, None] + np.array([[0, 0, apart]] * 2 + [[0, 0, 0]] * 2)
        return x, contact_em(x, t, [2.0, 2.0], np.zeros(4), normal_law="hertz", spot_law="none", **wires)

    x, found = contact(angle)
    nodes = found.R[12:24].reshape(2, 6)
    torque = (np.cross(x[2:], nodes[:, :3]) + nodes[:, 3:]).sum(axis=0)[2]
    approach = [contact_spot(found.force, angle=angle + d, **wires).approach for d in (-step, step)]
    slope = (approach[1] - approach[0]) / (2 * step) / (2.0 * 0.1 - apart)
    assert torque == pytest.approx(-0.6 * found.force * (0.2 - apart) * slope, rel=1e-6)
    assert slope > 0 > torque  # what it feels is -R


def torque_and_row(pair, result):
    """dPi/dpsi of the law of the pair, and dpsi over its unknowns."""
    wires = [np.broadcast_to(pair.properties[name], 2) for name in ("radius", "young", "poisson")]
    values, info = _core.f2py_contact.normal_force(
        2 if pair.laws.get("normal_law") == "hertz" else 1,
        [pair.laws.get("eps_n", 0.0)],
        result.gap,
        *wires,
        result.angle,
    )
    assert info == 0
    *_, rows, info = _core.f2py_contact.contact_kinematics(
        pair.x.T, pair.t.T, pair.length, 1 if pair.axis == "linear" else 2, pair.properties["radius"],
        result.xi_bar, result.xi, pair.laws.get("side", 0),
    )  # fmt: skip
    assert info == 0
    return values[4], rows[:, 4]


PAIRS = [pytest.param(name, seed, id=f"{name} {seed}") for name in CLASSES for seed in range(12)]


@pytest.mark.parametrize(("name", "seed"), PAIRS)
class TestWhatHoldsExactly:
    @pytest.fixture
    def pair(self, name, seed):
        return Pair(seed, **CLASSES[name])

    def test_forces_moments_and_currents_are_in_equilibrium(self, pair):
        result = pair.evaluate()
        nodes = result.R[:24].reshape(4, 6)
        forces, moments = nodes[:, :3], nodes[:, 3:]
        assert np.abs(forces.sum(axis=0)).max() < 1e-14 * result.force
        total = (np.cross(pair.x, forces) + moments).sum(axis=0)
        assert np.abs(total).max() < 1e-13 * result.force
        assert abs(result.R[24:].sum()) <= 1e-15 * abs(result.current) * 4

    def test_rigid_motions_are_in_the_null_space_of_the_tangent_up_to_the_turning_of_the_residual(self, pair):
        result = pair.evaluate()
        k, r = result.K, result.R
        size = np.abs(k[MM]).max()
        for axis in np.eye(3):
            translation, spin = np.zeros((4, 6)), np.zeros((4, 6))
            translation[:, :3] = axis
            spin[:, :3] = np.cross(axis, pair.x)
            spin[:, 3:] = axis
            turned_r = np.cross(axis, r[:24].reshape(8, 3)).ravel()
            assert np.abs(k[:, :24] @ translation.ravel()).max() < 1e-12 * max(size, np.abs(k[ME]).max())
            assert np.abs(k[:24, :24] @ spin.ravel() - turned_r).max() < 1e-12 * size
            assert np.abs(k[24:, :24] @ spin.ravel()).max() <= 1e-12 * max(1e-3, np.abs(k[ME]).max())

    def test_a_rigid_motion_turns_the_forces_and_changes_nothing_else(self, pair):
        result = pair.evaluate()
        turn, shift = rotation([0.7, -1.9, 0.4]), np.array([0.3, -0.2, 0.5])
        moved = pair.evaluate(x=pair.x @ turn.T + shift, t=pair.t @ turn.T)
        expected = result.R[:24].reshape(8, 3) @ turn.T
        noise = 1e-13 * (1 + 0.1 / abs(result.gap))
        assert np.abs(moved.R[:24].reshape(8, 3) - expected).max() < noise * result.force
        assert moved.R[24:] == pytest.approx(result.R[24:], abs=noise * np.abs(result.R[24:]).max() + 1e-15)
        assert moved.gap == pytest.approx(result.gap, abs=1e-14)
        assert moved.normal == pytest.approx(turn @ result.normal, abs=1e-13)

    def test_swapping_the_beams_gives_the_same_element_permuted(self, pair):
        result = pair.evaluate()
        order = np.r_[12:24, 0:12, 26, 27, 24, 25]
        beams = [2, 3, 0, 1]
        swapped_pair = dict(x=pair.x[beams], t=pair.t[beams], v=pair.v[beams])
        properties = {key: value[::-1] for key, value in pair.properties.items()}
        series = pair.laws.get("series_resistance", np.zeros(2))[::-1]
        length, pair.length = pair.length, pair.length[::-1]
        # w and x' x xb' both change sign, so the side is the same
        swapped = pair.evaluate(**swapped_pair, **properties, series_resistance=series)
        pair.length = length
        noise = 1e-11 * (1 + 0.1 / abs(result.gap))
        for block in (MM, ME, EE):
            k, other = result.K[block], swapped.K[np.ix_(order, order)][block]
            assert np.abs(k - other).max() <= noise * np.abs(k).max()
        assert swapped.R[order] == pytest.approx(result.R, abs=noise * np.abs(result.R).max())
        assert swapped.normal == pytest.approx(-result.normal, abs=1e-12)
        assert swapped.current == pytest.approx(-result.current, abs=noise * abs(result.current) + 1e-15)
        assert swapped[3:6] == pytest.approx((result.xi, result.xi_bar, result.gap), abs=1e-11)

    def test_the_force_is_normal_to_both_axes(self, pair):
        result = pair.evaluate()
        # where wires are bent, the torque moves the contact along them
        torque, dangle = torque_and_row(pair, result)
        force_bar = (result.R[:12] - torque * dangle[:12]).reshape(2, 6)[:, :3].sum(axis=0)
        assert force_bar == pytest.approx(-result.force * result.normal, abs=1e-14 * result.force)
        for beam, xi in enumerate((result.xi_bar, result.xi)):
            length, x, t = pair.length[beam], pair.x[2 * beam :][:2], pair.t[2 * beam :][:2]
            tangent = (x[1] - x[0]) / 2
            if pair.axis == "hermite":
                tangent = (3 - 3 * xi**2) / 4 * (x[1] - x[0]) + length / 8 * (
                    (-1 - 2 * xi + 3 * xi**2) * t[0] + (-1 + 2 * xi + 3 * xi**2) * t[1]
                )
            assert abs(tangent @ result.normal) < 1e-14 * np.linalg.norm(tangent) * 10

    def test_the_mechanics_does_not_feel_the_voltages(self, pair):
        result = pair.evaluate()
        assert not result.K[UPPER].any()
        other = pair.evaluate(v=10 * pair.v + 3)
        assert (other.K[MM] == result.K[MM]).all()
        assert (other.R[:24] == result.R[:24]).all()

    def test_the_electric_field_is_linear_in_the_voltages(self, pair):
        result = pair.evaluate()
        assert result.R[24:] == pytest.approx(result.K[EE] @ pair.v, abs=1e-13 * np.abs(result.K[EE]).max())
        assert (result.K[EE] == result.K[EE].T).all()
        assert np.abs(result.K[EE].sum(axis=0)).max() <= 1e-15 * np.abs(result.K[EE]).max() * 4

    def test_the_parts_of_the_coupling_add_up(self, pair):
        result = pair.evaluate()
        parts = contact_coupling(pair.x, pair.t, pair.length, pair.v, axis=pair.axis, **pair.properties, **pair.laws)
        size = max(np.abs(part).max() for part in parts)
        assert np.abs(sum(parts) - result.K[ME]).max() <= 1e-14 * size
        angle_matters = (
            pair.laws["spot_law"] in ("hertz", "film", "sharvin", "cluster") or pair.laws.get("normal_law") == "hertz"
        )
        if not angle_matters:
            assert not parts.K_me4.any()
        if "series_resistance" not in pair.laws:
            assert not parts.K_me5.any()

    def test_the_reported_quantities_belong_together(self, pair):
        result = pair.evaluate()
        assert result.current == pytest.approx(result.R[24:26].sum(), rel=1e-13, abs=1e-15)
        assert 0 < result.angle < np.pi
        assert result.spot_radius == pytest.approx(np.sqrt(result.semi_major * result.semi_minor), rel=1e-14)
        assert result.voltage_gap == pytest.approx(result.current * result.resistance, rel=1e-14) or (
            pair.laws["spot_law"] == "none"
        )
        if pair.laws.get("normal_law") != "hertz":
            assert result.force == pytest.approx(-2.0 * result.gap, rel=1e-14)


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("name", ["oblique", "strongly pre-rotated", "axes passed each other"])
class TestFormsOfTheMechanicalTangent:
    force, stiffness = 1.3, 2.1

    @pytest.fixture
    def mechanics(self, name, seed):
        pair = Pair(seed, **CLASSES[name])
        found = closest_points(pair.x, pair.t, pair.length, axis=pair.axis)

        def evaluate(form, geometric_force=self.force, dforce_dangle=0.0, stiffness=self.stiffness):
            k, r, info = _core.f2py_contact.contact_mechanics(
                pair.x.T, pair.t.T, pair.length, 1 if pair.axis == "linear" else 2, pair.properties["radius"],
                *found[:2], pair.laws.get("side", 0), self.force, stiffness, geometric_force, form, dforce_dangle,
            )  # fmt: skip
            assert info == 0
            return k, r

        return evaluate

    def test_hessian_form_is_symmetric(self, mechanics):
        k, _ = mechanics(form=2)
        assert np.abs(k - k.T).max() < 1e-13 * np.abs(k).max()

    def test_spin_form_differs_by_half_the_moments(self, mechanics):
        k_spin, r = mechanics(form=1)
        k_hessian, same_r = mechanics(form=2)
        assert (r == same_r).all()
        for node in range(4):
            block = np.s_[6 * node + 3 : 6 * node + 6]
            k_spin[block, block] += skew(r[block]) / 2
        assert np.abs(k_spin - k_hessian).max() < 1e-14 * np.abs(k_hessian).max()

    def test_geometric_force_acts_on_the_geometric_part_only(self, mechanics):
        # K is linear in it, what is left without it is the rank one of the stiffness, R does not see it
        k0, r0 = mechanics(2, geometric_force=0.0)
        k1, r1 = mechanics(2, geometric_force=1.0)
        k3, _ = mechanics(2, geometric_force=3.0)
        b = -r0 / self.force
        assert (r0 == r1).all()
        assert np.abs(k0 - self.stiffness * np.outer(b, b)).max() < 1e-14 * np.abs(k0).max()
        assert np.abs(k3 - k0 - 3 * (k1 - k0)).max() < 1e-13 * np.abs(k3).max()


@pytest.mark.parametrize("name", CLASSES)
def test_variations_of_gap_places_and_angle(name):
    for seed in range(20):
        pair = Pair(seed, **CLASSES[name])
        axis, radius, side = 1 if pair.axis == "linear" else 2, pair.properties["radius"], pair.laws.get("side", 0)

        def kinematics(x, t, places, pair=pair, axis=axis, radius=radius, side=side):
            (_, gap, angle, cos_angle, _), _, rows, info = _core.f2py_contact.contact_kinematics(
                x.T, t.T, pair.length, axis, radius, *places, side
            )
            assert info == 0
            return np.array([gap, *places, cos_angle, angle]), rows.T

        def values(dq, pair=pair, kinematics=kinematics):
            x, t, _ = pair.moved(dq).values()
            places = np.transpose(closest_points(x, t, pair.length, axis=pair.axis)[:2])
            return np.array([kinematics(*state)[0] for state in zip(x, t, places, strict=True)])

        here, rows = kinematics(pair.x, pair.t, closest_points(pair.x, pair.t, pair.length, axis=pair.axis)[:2])
        numeric = derivative_of_batch(values, np.zeros(28), 1e-3 * min(1, abs(here[4])))[:, :24]
        errors = np.abs(rows - numeric).max(axis=1) / np.abs(rows).max(axis=1)
        assert errors.max() < TOLERANCE, (seed, errors)


class TestByHand:
    """Straight wires of length 2 along x and y that cross in their middles."""

    length = np.array([2.0, 2.0])
    t = np.eye(3)[[0, 0, 1, 1]]
    v = np.array([1.0, 0.6, 0.2, 0.0])
    wires: ClassVar = dict(radius=0.1, young=2.0, poisson=0.0, resistivity=3.0)

    def x(self, height, place_bar=0.0, place=0.0):
        bar = [[-1 - place_bar, 0, height], [1 - place_bar, 0, height]]
        return np.array([*bar, [0, -1 - place, 0], [0, 1 - place, 0]])

    def evaluate(self, height, place_bar=0.0, place=0.0, **changes):
        options = {"eps_n": 5.0, **self.wires, **changes}
        return contact_em(self.x(height, place_bar, place), self.t, self.length, self.v, **options)

    @pytest.mark.parametrize("axis", ["linear", "hermite"])
    def test_perpendicular_crossing(self, axis):
        result = self.evaluate(0.15, axis=axis)
        force = 5.0 * 0.05
        moment = force * 2.0 / 8 if axis == "hermite" else 0
        up = np.array([0, 0, 1.0])
        # the barred wire above is pushed up: internal minus external forces point down there
        expected = np.concatenate([-force / 2 * up, [0, moment, 0], -force / 2 * up, [0, -moment, 0]])
        expected = np.concatenate([expected, force / 2 * up, [moment, 0, 0], force / 2 * up, [-moment, 0, 0]])
        assert result.R[:24] == pytest.approx(expected, abs=1e-15)
        assert result.normal == pytest.approx(up)
        assert (result.xi_bar, result.xi) == pytest.approx((0, 0), abs=1e-15)
        assert result.gap == pytest.approx(-0.05)
        # the paper's spot: r* = r/2, E* = E/2 = 1, R = rho/(2a); Vb = 0.8, V = 0.1
        a = (3 * force * 0.05 / 4) ** (1 / 3)
        assert result.spot_radius == pytest.approx(a)
        assert result.resistance == pytest.approx(3.0 / (2 * a))
        assert result.voltage_gap == pytest.approx(0.7)
        assert result.current == pytest.approx(0.7 * 2 * a / 3.0)
        assert result.R[24:] == pytest.approx(result.current * np.array([0.5, 0.5, -0.5, -0.5]))

    def test_hertz_force_and_spot_are_those_of_the_spot_law(self):
        result = self.evaluate(0.19, eps_n=None, normal_law="hertz", spot_law="hertz")
        spot = contact_spot(result.force, angle=np.pi / 2, **self.wires)
        assert spot.approach == pytest.approx(0.01, rel=1e-13)
        assert (result.spot_radius, result.resistance) == pytest.approx((spot.semi_major, 1 / spot.conductance))

    @pytest.mark.parametrize("height", [0.2, 0.201, 5.0])
    def test_open(self, height):
        result = self.evaluate(height + 1e-15)
        assert result.active is False
        assert not result.K.any()
        assert not result.R.any()
        assert (result.force, result.spot_radius, result.resistance, result.current, result.voltage_gap) == (0,) * 5
        assert result.gap == pytest.approx(height - 0.2, abs=1e-14)

    @pytest.mark.parametrize("place", [1.01, 1.4, 3.0, -1.01])
    def test_beyond_an_end(self, place):
        for places in (dict(place_bar=place), dict(place=place), dict(place=place, place_bar=-place)):
            result = self.evaluate(0.15, **places)
            assert result.active is False
            assert not result.K.any()
            assert not result.R.any()

    def test_series_resistance_replaces_what_the_linear_voltage_misses(self):
        # a wire of resistance W with a current fed in at xi: seen from there its ends, grounded, are in parallel, (1 -
        # xi^2) W/4. With linear voltage and grounded nodes the element shows no resistance at all: s = W/4 is what is
        # missing, rho L0/(4 A)
        xi, s = 0.3, 0.8
        bare = self.evaluate(0.15, place_bar=xi)
        result = self.evaluate(0.15, place_bar=xi, series_resistance=[s, 0.5])
        total = bare.resistance + s * (1 - xi**2) + 0.5
        assert bare.xi_bar == pytest.approx(xi)
        assert result.current == pytest.approx(bare.voltage_gap / total)
        assert result.voltage_gap == pytest.approx(result.current * bare.resistance)
        assert result.resistance == bare.resistance

    def test_constant_voltages_let_no_current_flow_and_couple_nothing(self):
        result = contact_em(self.x(0.15), self.t, self.length, np.full(4, 0.7), eps_n=5.0, **self.wires)
        assert np.abs(result.R[24:]).max() < 1e-16
        assert np.abs(result.K[ME]).max() < 1e-15


class TestSide:
    """A wire pushed down through another one: with its side remembered, the gap goes on falling."""

    hand = TestByHand()

    def evaluate(self, height, side):
        return self.hand.evaluate(height, side=side)

    @pytest.mark.parametrize("height", [0.15, 0.01, 1e-9, 0.0, -1e-9, -0.01, -0.15])
    def test_gap_and_force_go_on_through_the_axis(self, height):
        # x' x xb' of the unbarred along y and the barred along x points down: the barred wire began above, side -1
        result = self.evaluate(height, side=-1)
        assert result.active
        assert result.gap == pytest.approx(height - 0.2, abs=1e-15)
        assert result.normal == pytest.approx([0, 0, 1])
        assert result.force == pytest.approx(5.0 * (0.2 - height))

    def test_tangent_is_a_smooth_function_of_the_height_through_the_axis(self):
        # with the penalty law it is a polynomial: force times at most the square of the distance
        heights = np.linspace(-0.15, 0.15, 7)
        k = np.array([self.evaluate(h, side=-1).K[MM].ravel() for h in heights])
        fit = np.polynomial.polynomial.polyfit(heights[[0, 2, 4, 6]], k[[0, 2, 4, 6]], 3)
        others = np.polynomial.polynomial.polyval(heights[[1, 3, 5]], fit).T
        assert np.abs(others - k[[1, 3, 5]]).max() < 1e-12 * np.abs(k).max()

    def test_the_side_of_one_state_is_that_to_give_to_the_next(self):
        side = self.evaluate(0.15, side=0).side
        assert side == -1
        assert self.evaluate(-0.15, side=side).gap == self.evaluate(-0.15, side=-1).gap
        assert self.evaluate(-0.15, side=side).side == side

    def test_without_a_side_the_wire_is_pushed_out_on_the_other_side(self):
        result = self.evaluate(-0.15, side=0)
        assert result.normal == pytest.approx([0, 0, -1])
        assert result.gap == pytest.approx(-0.05)

    def test_the_wrong_side_is_taken_at_its_word(self):
        assert self.evaluate(0.15, side=1).gap == pytest.approx(-0.35)


class TestWiresWithoutAPointContact:
    length = (2.0, 2.0)
    wires: ClassVar = dict(radius=0.1, young=2.0, poisson=0.0, resistivity=3.0, eps_n=5.0)

    def evaluate(self, apart):
        x = np.array([[-1, 0, apart], [1, 0, apart], [-1, 0, 0], [1, 0, 0]], dtype=float)
        return contact_em(x, np.eye(3)[[0, 0, 0, 0]], self.length, np.zeros(4), **self.wires)

    def test_parallel_and_apart_is_open(self):
        result = self.evaluate(0.3)
        assert result.active is False
        assert result.gap == pytest.approx(0.1)

    def test_parallel_and_overlapping_is_refused(self):
        with pytest.raises(ValueError, match="overlap where their axes are parallel"):
            self.evaluate(0.15)

    @pytest.mark.parametrize("radius", [0.3, 0.5])
    def test_two_closest_pairs_are_refused_when_they_overlap(self, radius):
        # the parabola of the tests of closest points; both pairs are sqrt(0.5) apart
        slopes = np.array([[1, -2, 0], [1, 2, 0]]) / np.sqrt(5)
        x = np.array([[-1, 1, 0], [1, 1, 0], [0, 0.75, -0.5], [0, 0.75, 0.5]])
        t = np.vstack([slopes, [[0, 0, 1], [0, 0, 1]]])
        arguments = (x, t, [2 * np.sqrt(5), 1.0], np.zeros(4))
        if 2 * radius < np.sqrt(0.5):
            assert contact_em(*arguments, **{**self.wires, "radius": radius}).active is False
        else:
            with pytest.raises(ValueError, match="not unique"):
                contact_em(*arguments, **{**self.wires, "radius": radius})

    def test_coincident_nodes_are_refused(self):
        x = np.array([[0, 0, 0], [0, 0, 0], [0, -1, 0.1], [0, 1, 0.1]], dtype=float)
        with pytest.raises(ValueError, match="do two nodes of an element coincide"):
            contact_em(x, np.eye(3)[[0, 0, 1, 1]], self.length, np.zeros(4), axis="linear", **self.wires)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(x=np.zeros(12)), r"x must have shape \(4, 3\), not \(12,\)"),
        (dict(x=np.full((4, 3), np.inf)), "x must be finite"),
        (dict(t=np.zeros((4, 3))), "unit length"),
        (dict(length=[2.0, -2.0]), "length must be greater than 0"),
        (dict(v=[0.0, np.nan, 0.0, 0.0]), "v must be finite"),
        (dict(v=0.0), r"v must have shape \(4,\)"),
        (dict(radius=0.0), "radius must be greater than 0"),
        (dict(young=[1.0, 0.0]), "young must be greater than 0"),
        (dict(poisson=0.5), "poisson must be between -1 and 0.5"),
        (dict(poisson=-1.0), "poisson must be between -1 and 0.5"),
        (dict(resistivity=-1.0), "resistivity must be greater than 0"),
        (dict(eps_n=0.0), "eps_n must be greater than 0"),
        (dict(eps_n=None), "needs eps_n"),
        (dict(normal_law="hertz"), 'eps_n belongs to normal_law="linear"'),
        (dict(normal_law="penalty"), 'normal_law must be one of "linear", "hertz"'),
        (dict(axis="cubic"), 'axis must be one of "linear", "hermite"'),
        (dict(spot_law="Paper"), 'spot_law must be one of "none", "paper"'),
        (dict(spot_law="film"), "needs film_resistivity"),
        (dict(side=2), "side must be -1, 0 or 1"),
        (dict(series_resistance=[-1.0, 0.0]), "series_resistance must not be negative"),
        (dict(rotation_vectors=np.zeros(3)), r"rotation_vectors must have shape \(4, 3\)"),
    ],
)
def test_bad_input_is_refused_in_words(change, words):
    hand = TestByHand()
    good = dict(x=hand.x(0.15), t=hand.t, length=hand.length, v=hand.v, eps_n=5.0, **hand.wires)
    with pytest.raises(ValueError, match=words):
        contact_em(**{**good, **change})


class PairAtEnds:
    """A bent element whose end overlaps the side, or an end, of another one."""

    def __init__(self, seed, ends):
        self.rng = rng = np.random.default_rng(seed)
        self.ends, self.length = ends, np.array([2.0, 1.7])
        self.wires = dict(radius=[0.1, 0.13], young=[3.0, 2.0], poisson=[0.3, 0.2], resistivity=[0.5, 0.7])
        self.laws = [
            dict(eps_n=2.0, spot_law="hertz"),
            dict(normal_law="hertz", spot_law="film", film_resistivity=0.02),
        ][seed % 2]
        self.v = rng.normal(size=4)
        self.x, self.t = np.zeros((4, 3)), np.zeros((4, 3))
        for wire in range(2):
            direction = np.array([1.0, 0.0, 0.0]) if wire == 0 else rng.normal(size=3)
            direction /= np.linalg.norm(direction)
            # the place that touches, about in the origin
            place = ends[wire] or rng.uniform(-0.5, 0.5)
            for node, xi in ((2 * wire, -1), (2 * wire + 1, 1)):
                self.x[node] = (xi - place) * self.length[wire] / 2 * direction
                self.t[node] = direction + rng.uniform(-0.15, 0.15, 3)
                self.t[node] /= np.linalg.norm(self.t[node])
        self.depth = rng.uniform(0.01, 0.03)
        apart = (
            np.array([0.2, rng.normal(), rng.normal()]) if all(ends) else np.array([0.0, rng.normal(), rng.normal()])
        )
        self.x[2:] += apart / np.linalg.norm(apart) * 0.5
        for _ in range(30):
            contact = self.evaluate()
            self.x[2:] += (contact.gap + self.depth) * self.between(contact)

    def between(self, contact):
        """Unit vector from the unbarred to the barred wire at the places of a contact that may be open."""
        ends = [self.point(0, contact.xi_bar), self.point(1, contact.xi)]
        return (ends[0] - ends[1]) / np.linalg.norm(ends[0] - ends[1])

    def point(self, wire, xi):
        n = 2 * wire
        weights = [(2 - 3 * xi + xi**3) / 4, (2 + 3 * xi - xi**3) / 4]
        slopes = self.length[wire] / 8 * np.array([1 - xi - xi**2 + xi**3, -1 - xi + xi**2 + xi**3])
        return weights @ self.x[n : n + 2] + slopes @ self.t[n : n + 2]

    def evaluate(self, dq=None, **changed):
        x, t, v = self.x.copy(), self.t.copy(), self.v.copy()
        if dq is not None:
            moves = dq[:, :24].reshape(-1, 4, 6)
            x, t, v = x + moves[..., :3], turned(t, moves[..., 3:]), v + dq[:, 24:]
        return contact_em(x, t, self.length, v, **self.wires, **self.laws, **{"ends": self.ends, **changed})

    def residual(self, dq):
        return self.evaluate(dq).R


ENDS = [(0, -1), (0, 1), (-1, 0), (1, 0), (1, -1), (-1, -1)]


@pytest.mark.slow
@pytest.mark.parametrize("ends", ENDS)
def test_the_tangent_of_a_contact_at_an_end_is_the_derivative_of_its_residual(ends):
    for seed in range(20):
        pair = PairAtEnds(seed, ends)
        result = pair.evaluate()
        assert result.active, seed
        assert result.gap == pytest.approx(-pair.depth, rel=1e-6)
        errors = block_errors(result.K, derivative_of_batch(pair.residual, np.zeros(28), 0.02 * pair.depth))
        assert max(errors.values()) < TOLERANCE, (seed, errors)


@pytest.mark.parametrize("ends", ENDS)
def test_which_wire_is_barred_makes_no_difference_at_an_end(ends):
    pair = PairAtEnds(3, ends)
    result = pair.evaluate()
    order = [2, 3, 0, 1]
    wires = {name: values[::-1] for name, values in pair.wires.items()}
    other = contact_em(
        pair.x[order], pair.t[order], pair.length[::-1], pair.v[order], **wires, **pair.laws, ends=ends[::-1]
    )
    columns = np.concatenate([np.arange(12, 24), np.arange(12), [26, 27, 24, 25]])
    assert other.force == pytest.approx(result.force, rel=1e-12)
    assert other.normal == pytest.approx(-result.normal, rel=1e-12)
    assert other.R[columns] == pytest.approx(result.R, rel=1e-10, abs=1e-12)
    assert np.abs(other.K[np.ix_(columns, columns)] - result.K).max() < 1e-10 * np.abs(result.K).max()


def test_an_end_has_the_force_of_a_sphere():
    """A hemisphere on the end of another one: F = 4/3 E* sqrt(R) delta^1.5, R = r rb/(r + rb)."""
    pair = PairAtEnds(1, (1, -1))
    result = pair.evaluate()
    modulus = 1 / ((1 - 0.3**2) / 3 + (1 - 0.2**2) / 2)
    assert result.force == pytest.approx(4 / 3 * modulus * np.sqrt(0.1 * 0.13 / 0.23) * pair.depth**1.5, rel=1e-6)


def test_an_end_is_one_of_two():
    pair = PairAtEnds(1, (1, -1))
    with pytest.raises(ValueError, match="ends must be -1, 0 or 1 each"):
        pair.evaluate(ends=(2, 0))
