"""One point of line contact: against formulas in numpy, its tangent against differences, and what must hold exactly.

Steps of the differences are 2 % of the overlap, as for the contact element: the truncation is of sixth order, 1e-10,
and the round-off at most 1e-16/step.
"""

import numpy as np
import pytest

from derivatives import rotation, turned
from line_pair import KINDS, LinePair, hermite
from litz import _core
from litz.kernels import closest_points, line_point
from test_line_law import Formulas

N_CONFIGURATIONS = 12
MM, ME, EE, UPPER = np.s_[:24, :24], np.s_[24:, :24], np.s_[24:, 24:], np.s_[:24, 24:]
WIRES = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)


def tolerance(pair):
    """Round-off of a gap of two axes, over the step."""
    return 1e-8 + 1e-14 / pair.step


def block_errors(k, numeric):
    """Largest difference in each block relative to its largest entry (a block that is zero must be exactly so)."""
    errors = {}
    for name, block in (("K_mm", MM), ("K_me", ME), ("K_ee", EE), ("upper right", UPPER)):
        size = np.abs(k[block]).max()
        errors[name] = np.abs(k[block] - numeric[block]).max() / (size or 1)
    return errors


PAIRS = [pytest.param(kind, seed, id=f"{kind} {seed}") for kind in KINDS for seed in range(N_CONFIGURATIONS)]


@pytest.fixture
def pair(kind, seed):
    return LinePair(seed, **KINDS[kind])


@pytest.mark.parametrize(("kind", "seed"), PAIRS)
class TestAnyPair:
    def test_the_formulas_of_the_theory(self, pair):
        result = pair.evaluate()
        gap, xi_bar = pair.gap(np.zeros(24))
        formulas, laws = Formulas(pair.properties, pair.laws.get("angle", 0.0)), pair.laws
        f = laws["eps_l"] * -gap if "eps_l" in laws else formulas.force(-gap)
        b = f / (2 * laws["hardness"]) if "hardness" in laws else formulas.half_width(f)
        conductance = laws["weight"] * formulas.conductance(f, laws.get("film", 0.0), b)
        n_v = np.array([1 - xi_bar, 1 + xi_bar, -(1 - pair.xi), -(1 + pair.xi)]) / 2
        # in series: what the linear voltage in the elements misses
        series = laws.get("series_resistance", np.zeros(2)) @ [1 - xi_bar**2, 1 - pair.xi**2]

        assert result.active
        assert result.gap == pytest.approx(gap, abs=1e-14)
        assert result.xi_bar == pytest.approx(xi_bar, abs=1e-12)
        # the gap is known to 1e-16 of the positions
        noise = 1e-11 + 1e-14 / pair.depth
        assert result.force_per_length == pytest.approx(f, rel=noise)
        assert result.force == pytest.approx(laws["weight"] * f, rel=noise)
        assert result.half_width == pytest.approx(b, rel=noise)
        assert result.spot_radius == pytest.approx(np.sqrt(2 * b * laws["weight"] / np.pi), rel=noise)
        assert result.resistance == pytest.approx(1 / conductance, rel=noise)
        assert result.current == pytest.approx(n_v @ pair.v / (1 / conductance + series), rel=noise, abs=1e-12)
        assert result.voltage_gap == pytest.approx(result.current * result.resistance, rel=1e-13)
        assert result.R[24:] == pytest.approx(result.current * n_v, rel=1e-12, abs=1e-15)

    def test_the_residual_is_the_force_times_the_derivative_of_the_gap(self, pair):
        # by a complex step in numpy: forces and moments are -W f dg
        result = pair.evaluate()
        step = 1e-30
        dg = np.array([pair.gap(1j * step * e)[0].imag / step for e in np.eye(24)])
        assert result.R[:24] == pytest.approx(-result.force * dg, abs=1e-12 * result.force)

    def test_the_residual_is_the_gradient_of_the_energy(self, pair):
        result = pair.evaluate()
        gradient = pair.derivative(lambda dq: pair.evaluate(**pair.moved(dq)).energy)
        size = np.abs(result.R[:24]).max()
        assert result.R[:24] == pytest.approx(gradient[:24], abs=tolerance(pair) * size)
        assert not gradient[24:].any()

    def test_the_tangent_is_the_derivative_of_the_residual_by_spins(self, pair):
        result = pair.evaluate()
        errors = block_errors(result.K, pair.derivative(lambda dq: pair.evaluate(**pair.moved(dq)).R))
        assert max(errors.values()) < tolerance(pair), errors

    def test_the_tangent_by_rotation_vectors_is_symmetric_in_the_mechanics(self, pair):
        phi = pair.rng.uniform(-1.5, 1.5, (4, 3))
        start = turned(pair.t, -phi)

        def residual(dq):
            q = dq[:, :24].reshape(-1, 4, 6)
            vectors = phi + q[:, :, 3:]
            moved = dict(x=pair.x + q[:, :, :3], t=turned(start, vectors), v=pair.v + dq[:, 24:])
            return pair.evaluate(**moved, rotation_vectors=vectors).R

        result = pair.evaluate(rotation_vectors=phi)
        k_mm = result.K[MM]
        assert np.abs(k_mm - k_mm.T).max() < 1e-13 * np.abs(k_mm).max()
        errors = block_errors(result.K, pair.derivative(residual))
        assert max(errors.values()) < tolerance(pair), errors

    def test_forces_moments_and_currents_are_in_equilibrium(self, pair):
        result = pair.evaluate()
        nodes = result.R[:24].reshape(4, 6)
        forces, moments = nodes[:, :3], nodes[:, 3:]
        assert np.abs(forces.sum(axis=0)).max() < 1e-14 * result.force
        assert np.abs((np.cross(pair.x, forces) + moments).sum(axis=0)).max() < 1e-13 * result.force
        assert abs(result.R[24:].sum()) <= 1e-15 * abs(result.current) * 4
        # the barred wire is pushed along the normal
        assert forces[:2].sum(axis=0) == pytest.approx(-result.force * result.normal, abs=1e-14 * result.force)

    def test_a_rigid_motion_turns_the_forces_and_changes_nothing_else(self, pair):
        result = pair.evaluate()
        turn, shift = rotation([0.7, -1.9, 0.4]), np.array([0.3, -0.2, 0.5])
        laws = {name: turn @ pair.laws[name] for name in ("normal_before",) if name in pair.laws}
        moved = pair.evaluate(x=pair.x @ turn.T + shift, t=pair.t @ turn.T, **laws)
        expected = result.R[:24].reshape(8, 3) @ turn.T
        noise = 1e-12 + 1e-14 / pair.depth
        assert np.abs(moved.R[:24].reshape(8, 3) - expected).max() < noise * result.force
        assert moved.R[24:] == pytest.approx(result.R[24:], abs=noise * np.abs(result.R[24:]).max() + 1e-15)
        assert moved.normal == pytest.approx(turn @ result.normal, abs=1e-13)

    def test_rigid_motions_are_in_the_null_space_of_the_tangent_up_to_the_turning_of_the_residual(self, pair):
        result = pair.evaluate()
        k, r = result.K, result.R
        size = np.abs(k[:, :24]).max()
        for axis in np.eye(3):
            translation, spin = np.zeros((4, 6)), np.zeros((4, 6))
            translation[:, :3] = axis
            spin[:, :3] = np.cross(axis, pair.x)
            spin[:, 3:] = axis
            turned_r = np.cross(axis, r[:24].reshape(8, 3)).ravel()
            assert np.abs(k[:, :24] @ translation.ravel()).max() < 1e-12 * size
            assert np.abs(k[MM] @ spin.ravel() - turned_r).max() < 1e-12 * size
            assert np.abs(k[ME] @ spin.ravel()).max() < 1e-12 * size

    def test_equal_potentials_drive_no_current_and_the_power_is_current_times_voltage(self, pair):
        level = pair.evaluate(v=np.full(4, 3.0))
        assert np.abs(level.R[24:]).max() < 1e-14 / level.resistance
        result = pair.evaluate(series_resistance=(0.0, 0.0))
        assert result.R[24:] @ pair.v == pytest.approx(result.current * result.voltage_gap, rel=1e-12)
        assert result.current * result.voltage_gap >= 0

    def test_many_points_at_once_are_those_one_by_one(self, pair):
        one = pair.evaluate()
        many = pair.evaluate(
            x=np.array([pair.x] * 3),
            t=pair.t,
            v=[pair.v, 2 * pair.v, pair.v],
            weight=np.array([1.0, 1.0, 2.0]) * pair.laws["weight"],
        )
        assert many.K.shape == (3, 28, 28)
        for name, value in one._asdict().items():
            assert np.array_equal(getattr(many, name)[0], value), name
        assert many.current[1] == pytest.approx(2 * one.current, rel=1e-14, abs=1e-15)
        assert many.R[2, :24] == pytest.approx(2 * one.R[:24], rel=1e-14, abs=1e-16)


def parallel(offset=0.0, gap=-1e-7, length=4e-3):
    """Two straight parallel wires of radius 1 mm, the barred one shifted along itself."""
    x = np.array([[-0.5, 0, 0], [0.5, 0, 0], [-0.5, 0, 0], [0.5, 0, 0]]) * length
    x[:2] += [offset * length, 0, 2e-3 + gap]
    return dict(x=x, t=[[1, 0, 0]] * 4, length=[length] * 2, v=[1e-3, 1e-3, 0, 0], weight=length, **WIRES)


def exchanged(arguments):
    """The same with the wires in the other roles."""
    order = [2, 3, 0, 1]
    return {**arguments, **{name: np.asarray(arguments[name])[order] for name in ("x", "t", "v")}}


class TestParallelWires:
    @pytest.mark.parametrize("xi", [-0.9, 0.0, 0.5])
    def test_each_wire_may_have_the_points(self, xi):
        one, other = line_point(**parallel(), xi=xi), line_point(**exchanged(parallel()), xi=xi)
        assert one.quality == other.quality == 1
        assert one.xi_bar == pytest.approx(xi, abs=1e-12)
        assert other.force == pytest.approx(one.force, rel=1e-9)
        assert other.normal == pytest.approx(-one.normal, abs=1e-15)
        assert other.current == pytest.approx(-one.current, rel=1e-9)
        assert other.R[[*range(12, 24), *range(12)]] == pytest.approx(one.R[:24], abs=1e-9 * one.force)

    def test_half_passes_add_up_to_the_strip(self):
        # Simpson's rule on each wire, half of the weight each: a uniform overlap
        total = sum(
            line_point(**{**arguments, "weight": 4e-3 * share / 12}, xi=xi).force
            for arguments in (parallel(), exchanged(parallel()))
            for xi, share in ((-1, 1), (0, 4), (1, 1))
        )
        assert total == pytest.approx(4e-3 * line_point(**parallel(), xi=0).force_per_length, rel=1e-9)


class TestEnds:
    def test_a_foot_beyond_an_element_belongs_to_its_neighbour(self):
        result = line_point(**parallel(offset=0.4), xi=-0.9)
        assert not result.active
        assert result.xi_bar == pytest.approx(-1.5, abs=1e-12)  # as far as the search goes
        assert not result.K.any()
        assert not result.R.any()
        assert line_point(**parallel(offset=0.1), xi=-0.9).xi_bar == pytest.approx(-1.1, abs=1e-12)

    def test_a_foot_beyond_the_end_of_a_wire_is_held_there(self):
        # the wires overlap less there: the end of the axis is the centre of a round cap
        offset = 0.0505
        result = line_point(**parallel(offset=offset, gap=-3e-5), xi=-1.0, ends=(True, False))
        assert result.active
        assert result.at_end
        assert result.xi_bar == -1
        distance = np.hypot(2e-3 - 3e-5, offset * 4e-3)
        assert result.gap == pytest.approx(distance - 2e-3, abs=1e-16)
        assert line_point(**parallel(offset=0.4, gap=-1e-5), xi=-0.9, ends=(True, False)).gap > 0

    def test_the_forces_pass_over_the_end_without_a_jump(self):
        inside, beyond = (
            line_point(**parallel(offset=0.05 + small), xi=-0.9, ends=(True, False)) for small in (-1e-9, 1e-9)
        )
        assert (inside.at_end, beyond.at_end) == (False, True)
        assert np.abs(beyond.R - inside.R).max() < 1e-7 * np.abs(inside.R).max()

    def test_a_node_opposite_the_end_stands_over_it(self):
        result = line_point(**parallel(), xi=1.0, ends=(True, True))
        assert result.xi_bar == 1
        assert not result.at_end


def wrapped(shift=0.0):
    """A wire of radius 1 mm along 15 degrees of a straight drum of 5 mm, across it, pressed on by 1 um."""
    around = 6e-3 - 1e-6
    angles = np.array([-1.0, 1.0]) * np.pi / 24
    tangents = [[-np.sin(a), np.cos(a), 0.0] for a in angles]
    wire = [[around * np.cos(a), around * np.sin(a), 0.0] for a in angles]
    drum = [[shift, 0, -10e-3], [shift, 0, 10e-3]]
    return dict(
        x=[*wire, *drum],
        t=[*tangents, [0, 0, 1], [0, 0, 1]],
        length=[around * np.pi / 12, 20e-3],
        v=[1e-3, 1e-3, 0, 0],
        weight=1e-3,
        **(WIRES | dict(radius=[1e-3, 5e-3])),
    )


class TestWrappedWires:
    def test_a_drum_has_no_foot_on_the_wire_around_it(self):
        # all places of the wire are equally far
        with pytest.raises(ValueError, match="exchange the wires"):
            line_point(**wrapped(), xi=0.0)

    def test_the_wire_has_one_on_the_drum(self):
        arguments = exchanged(wrapped()) | dict(radius=[5e-3, 1e-3], length=wrapped()["length"][::-1])
        for xi in (-1.0, 0.0, 1.0):
            result = line_point(**arguments, xi=xi)
            assert result.quality == 1
            assert result.angle == pytest.approx(np.pi / 2, abs=1e-12)
            # in the middle the cubic is off the arc by angle^4/384 of its radius
            assert result.gap == pytest.approx(-1e-6, abs=8e-8 if xi == 0 else 1e-15)

    def test_a_wire_that_does_not_touch_may_be_curved_about_the_other(self):
        arguments = wrapped()
        arguments["radius"] = [0.9e-3, 5e-3]
        assert not line_point(**arguments, xi=0.0).active

    def test_curvature_away_from_the_point_makes_the_foot_the_surer(self):
        # an arc that touches the drum from the other side: q = 1 + d/radius of the arc = 2
        arguments = wrapped(shift=2 * (6e-3 - 1e-6))
        assert line_point(**arguments, xi=0.0).quality == pytest.approx(2, rel=1e-2)


def test_the_foot_follows_a_start():
    # a point within a high arch: a foot on either side, that on the right a little nearer
    x = np.array([[-1, 0, 0], [1, 0, 0], [0.02, 0, 0.3], [0.02, 1, 0.3]])
    up, down = rotation([0, -1.4, 0]) @ [1, 0, 0], rotation([0, 1.4, 0]) @ [1, 0, 0]
    t = [up, down, [0, 1, 0], [0, 1, 0]]
    arguments = dict(x=x, t=t, length=[6, 1], v=np.zeros(4), xi=-1.0, weight=1.0, **(WIRES | dict(radius=0.01)))
    nearest = line_point(**arguments)
    left, right = (line_point(**arguments, start=start) for start in (-0.5, 0.5))
    assert left.xi_bar < -0.3 < 0.3 < right.xi_bar == pytest.approx(nearest.xi_bar, abs=1e-9)
    assert left.gap > right.gap
    for result in (left, right):
        place, slope, _ = hermite(6, result.xi_bar, "hermite")
        at = np.array([x[0], t[0], x[1], t[1]])
        assert (place @ at - x[2]) @ (slope @ at) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    ("degrees", "bends"),
    [(2, (0, 0)), (2, (0.03, 0.03)), (20, (0, 0)), (20, (-0.03, 0.01)), (90, (-0.03, 0.01)), (90, (0.03, 0.03))],
)
def test_the_sine_of_a_lens_gives_its_length_as_measured_along_both_wires(degrees, bends):
    # the gap over a wire is a parabola, gap + c s^2/2 over its arc length, and open from s = sqrt(-2 gap/c) on
    angle = np.radians(degrees)
    along = np.array([[np.cos(a), np.sin(a), 0.0] for a in (0.0, angle)])
    x = np.array([-along[0], along[0], -along[1], along[1]])
    x[:2, 2] += 0.19
    t = np.array([
        rotation(sign * bends[beam] * np.cross(along[beam], [0, 0, 1])) @ along[beam] for beam in (0, 1) for sign in (-1, 1)
    ])  # fmt: skip
    length = np.array([2.0, 2.0])
    place = closest_points(x, t, length)
    sine, info = _core.f2py_line.lens_sine(x.T, t.T, length, 2, [0.1, 0.1], place.xi_bar, place.xi)
    assert info == 0
    if not any(bends):
        assert sine == pytest.approx(np.sin(angle), rel=1e-12)

    step, halves = 1e-3, []
    for nodes, xi in (([0, 1, 2, 3], place.xi), ([2, 3, 0, 1], place.xi_bar)):
        before, here, after = (
            line_point(x[nodes], t[nodes], length, np.zeros(4), xi + s, weight=1.0, **(WIRES | dict(radius=0.05))).gap
            for s in (-step, 0.0, step)
        )
        _, slope, _ = hermite(2.0, xi, "hermite")
        tangent = slope @ np.array([x[nodes[2]], t[nodes[2]], x[nodes[3]], t[nodes[3]]])
        halves.append(np.linalg.norm(tangent) * step / np.sqrt(after - 2 * here + before))
    # for a unit overlap; truncation of second order in the step, round-off 1e-16/step^2 of the parabola at 2 degrees
    assert np.sqrt(here + 0.1) / sine == pytest.approx(np.mean(halves), rel=1e-4)


@pytest.mark.parametrize("name", ["straight and parallel", "parallel and curved"])
def test_rotations_do_not_enter_a_linear_axis(name):
    result = LinePair(1, **KINDS[name]).evaluate()
    rotations = [6 * node + 3 + i for node in range(4) for i in range(3)]
    assert not result.R[rotations].any()
    assert not result.K[:, rotations].any()


class TestWhatIsRefused:
    @pytest.mark.parametrize(
        ("changed", "words"),
        [
            (dict(xi=1.1), "xi must be from -1 to 1"),
            (dict(weight=0.0), "weight must be greater than 0"),
            (dict(x=np.zeros((3, 3))), r"x must have shape \(4, 3\)"),
            (dict(t=np.ones((4, 3))), r"t\[0\] must have unit length"),
            (dict(length=[1.0, 0.0]), "length must be greater than 0"),
            (dict(eps_l=-1.0), "eps_l must be greater than 0"),
            (dict(hardness=0.0), "hardness must be greater than 0"),
            (dict(film=-1.0), "film must not be negative"),
            (dict(angle=4.0), "angle must be from 0"),
            (dict(axis="cubic"), "axis must be one of"),
            (dict(series_resistance=[-1.0, 0.0]), "series_resistance must not be negative"),
            (dict(radius=[1e-3] * 3), r"radius must have shape \(2,\)"),
            (dict(x=[[0, 0, 1e-3]] * 2 + [[0, 0, 0], [1e-3, 0, 0]], axis="linear"), "the foot was not found"),
            (dict(x=[[-2e-3, 0, 0], [2e-3, 0, 0]] * 2), "the axes meet"),
        ],
    )
    def test_bad_input(self, changed, words):
        with pytest.raises(ValueError, match=words):
            line_point(**{**parallel(), "xi": 0.0, **changed})

    def test_a_strip_wider_than_a_quarter_of_the_radius(self):
        # b = r/4: the overlap is (r/16) (ln 8 - 1/(8 (1 - nu)))
        limit = 1e-3 / 16 * (np.log(8) - 1 / (8 * 0.66))
        assert line_point(**parallel(gap=-0.999 * limit), xi=0.0).half_width == pytest.approx(0.25e-3, rel=1e-2)
        with pytest.raises(ValueError, match="half width is more than a quarter"):
            line_point(**parallel(gap=-1.001 * limit), xi=0.0)

    def test_one_of_many_is_named(self):
        arguments = parallel()
        with pytest.raises(ValueError, match=r"weight\[1\] must be greater than 0"):
            line_point(**arguments | dict(x=[arguments["x"]] * 2, weight=[1.0, -1.0]), xi=0.0)
        with pytest.raises(ValueError, match="point 1: the axes meet"):
            line_point(**arguments | dict(x=[arguments["x"], [[-2e-3, 0, 0], [2e-3, 0, 0]] * 2]), xi=0.0)
