"""Line contact of metal that yields, per length: onset, loading, dent, conductance, bad input."""

import numpy as np
import pytest
from scipy.integrate import quad
from verification.references import flattened_spheres

from derivatives import derivative
from litz import _core
from litz.kernels import line_law, normal_law

EQUAL = dict(radius=[1e-3, 1e-3], young=[120e9, 120e9], poisson=[0.34, 0.34], resistivity=[1.7e-8, 1.7e-8])
UNEQUAL = dict(radius=[1e-3, 0.3e-3], young=[120e9, 70e9], poisson=[0.34, 0.2], resistivity=[1.7e-8, 5e-8])
WIRES = [pytest.param(EQUAL, id="equal wires"), pytest.param(UNEQUAL, id="unequal wires")]
ANGLES = [0.0, 0.03, 0.3]
STRESS = 50e6


def points(given, wires, *, is_overlap=False, largest=0.0, angle=0.0, film=0.0, stress=STRESS, hardness=0.0):
    """All numbers of the law by name; the kernel itself, without checks."""
    given = np.atleast_1d(np.asarray(given, dtype=float))
    n = len(given)
    columns = [np.repeat(np.array(value, dtype=float)[:, None], n, axis=1) for value in wires.values()]
    values, onset, _ = _core.f2py_yielding.line_law_of_points(
        given,
        int(is_overlap),
        np.broadcast_to(largest, n).astype(float),
        *columns,
        np.full(n, angle),
        np.full(n, film),
        np.full((2, n), stress),
        np.full(n, hardness),
    )
    names = ["force", "overlap", "compliance", "b", "conductance", "slope", "dent"]
    return dict(zip(names, values, strict=True)), onset[:, 0]


def modulus_and_radius(wires):
    young, poisson, radius = (np.array(wires[name]) for name in ("young", "poisson", "radius"))
    return 1 / ((1 - poisson**2) / young).sum(), radius.prod() / radius.sum()


def elastic(force, wires):
    return line_law(force, **wires)


@pytest.mark.parametrize("wires", WIRES)
class TestLoading:
    def test_begins_to_yield_at_the_pressure_of_a_slender_ellipse(self, wires):
        modulus, radius = modulus_and_radius(wires)
        pressure = 1.11 * flattened_spheres.onset_pressure(min(wires["poisson"])) * STRESS
        _, (yield_pressure, force, half_width) = points([0.0], wires)
        assert yield_pressure == pytest.approx(pressure, rel=1e-13)
        # p = 2 f/(pi b), b = 2 R p/E*
        assert half_width == pytest.approx(2 * radius * pressure / modulus, rel=1e-13)
        assert force == pytest.approx(np.pi * half_width * pressure / 2, rel=1e-13)

    @pytest.mark.parametrize("angle", ANGLES)
    def test_is_elastic_up_to_there(self, wires, angle):
        # across a crossing a film lies on the area of the spot, which is not quite that of strips
        film = 0.0 if angle else 1e-12
        onset = points([0.0], wires, angle=angle)[1][1]
        for share, largest in ((0.01, 0.0), (0.9, 0.0), (0.3, 0.99 * onset)):
            found, _ = points(share * onset, wires, largest=largest, angle=angle, film=film)
            exact = line_law(share * onset, angle=angle, film=film, **wires)
            values = [found[name][0] for name in ("b", "overlap", "compliance", "conductance", "slope")]
            assert values == pytest.approx(list(exact[:5]), rel=1e-13)
            assert found["dent"][0] == 0

    @pytest.mark.parametrize("angle", ANGLES)
    def test_the_dent_begins_with_none(self, wires, angle):
        """A difference of equal lengths at the onset left round-off of either sign."""
        onset = points([0.0], wires, angle=angle)[1][1]
        at_onset = points(onset * (1 + np.arange(8) * 2.2e-16), wires, angle=angle)[0]
        assert (at_onset["dent"] == 0).all()
        beyond = points(onset * (1 + np.logspace(-14, -3, 60)), wires, angle=angle)[0]
        assert (beyond["dent"] >= 0).all()
        assert beyond["dent"][-1] > 0

    def test_mean_pressure_rises_to_twice_that_at_the_onset(self, wires):
        pressure, onset, _ = points([0.0], wires)[1]
        forces = onset * np.geomspace(1, 1e4, 200)
        mean = forces / (2 * points(forces, wires)[0]["b"])
        assert mean[0] == pytest.approx(np.pi / 4 * pressure, rel=1e-12)
        assert (np.diff(mean) > 0).all()
        assert mean[-1] == pytest.approx(np.pi / 2 * pressure, rel=1e-3)

    @pytest.mark.parametrize("angle", ANGLES)
    def test_width_compliance_and_slope_of_the_conductance_are_continuous(self, wires, angle):
        onset = points([0.0], wires, angle=angle)[1][1]
        below, above = (points(onset * (1 + d), wires, angle=angle)[0] for d in (-1e-12, 1e-12))
        for name in ("overlap", "compliance", "b", "conductance", "slope"):
            # beyond the onset of a crossing slopes change with the root of the overlap, that of the conductance most: it
            # is a small part of its terms
            tolerance = (1e-3 if name == "slope" else 1e-5) if angle else 1e-8
            assert above[name] == pytest.approx(below[name], rel=tolerance), name

    def test_overlap_of_parallel_wires_is_that_of_the_strip_and_what_is_flattened_beyond_it(self, wires):
        modulus, radius = modulus_and_radius(wires)
        c = (1 - np.array(wires["poisson"]) ** 2) / np.array(wires["young"])
        force = 20 * points([0.0], wires)[1][1]
        found, _ = points(force, wires)
        b = found["b"][0]
        lam = c @ (np.log(2 * np.array(wires["radius"]) / b) - 1 / (8 * (1 - np.array(wires["poisson"])))) / c.sum()
        exact = 2 * force / (np.pi * modulus) * lam + (b**2 - 4 * force * radius / (np.pi * modulus)) / (2 * radius)
        assert found["overlap"][0] == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("wires", WIRES)
class TestUnloadingOfParallelWires:
    @pytest.mark.parametrize("multiple", [1.5, 5, 100])
    def test_is_that_of_elastic_strips_of_less_and_less_width(self, wires, multiple):
        # ddelta/df of an elastic contact whose strip has the same width; f/f_m over lambda as it stands in the
        # theory, integrated numerically
        pressure, onset, _ = points([0.0], wires)[1]
        modulus, radius = modulus_and_radius(wires)
        largest = multiple * onset
        top, _ = points(largest, wires)
        phi = 2 * largest / (np.pi * pressure * top["b"][0]) - 1
        square = 4 * radius / (np.pi * modulus)
        unit = elastic(1.0, wires)
        assert unit.half_width**2 == pytest.approx(square, rel=1e-12)
        section = np.exp(-np.pi * modulus * unit.approach) / square

        def compliance_times_df(theta):
            lam, s = np.sin(theta), np.cos(theta)
            of_strip = section * (lam * top["b"][0]) ** 2
            logarithm = -np.log(of_strip) / 2
            df = largest * (2 * (1 - phi) * lam * s + phi * lam)
            return 2 / (np.pi * modulus) * (logarithm - 0.5) * df

        for share in (0.9, 0.5, 0.01):
            found, _ = points(share * largest, wires, largest=largest)
            lam = found["b"][0] / top["b"][0]
            assert (1 - phi) * lam**2 + phi * (1 - np.sqrt(1 - lam**2)) == pytest.approx(share, rel=1e-10)
            drop = quad(compliance_times_df, np.arcsin(lam), np.pi / 2, epsabs=0, epsrel=1e-11)[0]
            assert top["overlap"][0] - found["overlap"][0] == pytest.approx(drop, rel=2e-6)
        drop = quad(compliance_times_df, 0, np.pi / 2, epsabs=0, epsrel=1e-11)[0]
        assert top["overlap"][0] - top["dent"][0] == pytest.approx(drop, rel=2e-6)


@pytest.mark.parametrize("wires", WIRES)
@pytest.mark.parametrize("angle", ANGLES)
class TestUnloading:
    def test_nothing_jumps_at_the_largest_force_and_reloading_goes_on(self, wires, angle):
        largest = 7 * points([0.0], wires, angle=angle)[1][1]
        up, _ = points([largest, 2 * largest], wires, angle=angle)
        back, _ = points([largest * (1 - 1e-13), 2 * largest], wires, largest=largest, angle=angle)
        for name in ("overlap", "b", "conductance", "dent"):
            assert back[name] == pytest.approx(up[name], rel=1e-6), name

    def test_over_the_dent_there_is_no_force(self, wires, angle):
        largest = 7 * points([0.0], wires, angle=angle)[1][1]
        dent = points(largest, wires, angle=angle)[0]["dent"][0]
        assert dent > 0
        found, _ = points([-1e-6, 0.0, dent * (1 - 1e-12)], wires, is_overlap=True, largest=largest, angle=angle)
        assert not found["force"].any()

    @pytest.mark.parametrize("multiple", [0, 0.5, 2, 50])
    def test_derivatives_and_the_inverse(self, wires, angle, multiple):
        onset = points([0.0], wires, angle=angle)[1][1]
        largest = multiple * onset
        for force in np.array([0.02, 0.3, 0.7]) * max(largest, onset) if largest else np.array([0.5, 4, 60]) * onset:
            found, _ = points(force, wires, largest=largest, angle=angle, film=1e-12)

            def numbers(f, largest=largest):
                values, _ = points(f, wires, largest=largest, angle=angle, film=1e-12)
                return np.array([values["overlap"][0], values["conductance"][0]])

            exact = np.array([found["compliance"][0], found["slope"][0]])
            assert derivative(numbers, force, 0.01 * force)[:, 0] == pytest.approx(exact, rel=1e-8)
            back, _ = points(found["overlap"], wires, is_overlap=True, largest=largest, angle=angle)
            assert back["force"][0] == pytest.approx(force, rel=1e-11)


def over_lens(deepest, wires, angle, earlier=0.0):
    """Force [N] and conductance [S] of the lens of two crossed wires, which has been deeper by `earlier` [m]."""
    u = (np.arange(1000) + 0.5) / 1000
    half_length = np.sqrt(2 * (sum(wires["radius"]) - deepest - earlier) * deepest) / np.sin(angle)
    places = deepest * (1 - u**2)
    largest = points(places + earlier, wires, is_overlap=True, angle=angle)[0]["force"] if earlier else 0.0
    found, _ = points(places, wires, is_overlap=True, angle=angle, largest=largest)
    return [2 * half_length * found[name].mean() for name in ("force", "conductance")]


@pytest.mark.parametrize("wires", WIRES)
@pytest.mark.parametrize("angle", [np.pi / 2, np.pi / 4])
@pytest.mark.parametrize("deepest", [1e-9, 5e-9, 2e-8, 1e-7])
class TestLensOfCrossing:
    """All places of a short lens together are the crossing."""

    def crossing(self, overlap, wires, angle, largest=0.0):
        mechanical = {name: wires[name] for name in ("radius", "young", "poisson")}
        found = normal_law(overlap, angle=angle, yield_stress=STRESS, largest_force=largest, **mechanical)
        return found.force, 4 * found.disc_radius / sum(wires["resistivity"])

    def test_force_and_conductance_as_it_is_loaded(self, wires, angle, deepest):
        assert over_lens(deepest, wires, angle) == pytest.approx(self.crossing(deepest, wires, angle), rel=3e-3)

    @pytest.mark.parametrize("part", [0.95, 0.8, 0.65])
    def test_force_and_conductance_on_the_way_back(self, wires, angle, deepest, part):
        largest = self.crossing(deepest, wires, angle)
        force, conductance = self.crossing(part * deepest, wires, angle, largest[0])
        found = over_lens(part * deepest, wires, angle, (1 - part) * deepest)
        assert found[0] == pytest.approx(force, abs=0.015 * largest[0])
        if force > 0.05 * largest[0]:
            assert found[1] == pytest.approx(conductance, rel=0.04)


class TestInput:
    def test_many_points_and_one(self):
        many = line_law([0.0, 1e2, 1e3], yield_stress=STRESS, largest_force_per_length=5e2, **EQUAL)
        one = line_law(1e2, yield_stress=STRESS, largest_force_per_length=5e2, **EQUAL)
        assert [each[1] for each in many] == pytest.approx(list(one), rel=1e-14)
        assert [each[0] for each in many] == [0, 0, 0, 0, 0, pytest.approx(one.dent)]

    @pytest.mark.parametrize(
        ("change", "words"),
        [
            (dict(yield_stress=0.0), "yield_stress must be greater than 0"),
            (dict(yield_stress=[1e8, 1e8, 1e8]), "yield_stress must have shape"),
            (dict(yield_stress=STRESS, largest_force_per_length=-1.0), "largest_force_per_length must not be negative"),
            (dict(largest_force_per_length=1.0), "largest_force_per_length needs yield_stress"),
            (dict(yield_stress=5e5), "wider than the law holds for"),
            (dict(yield_stress=STRESS, largest_force_per_length=1e6), "wider than the law holds for"),
            (dict(yield_stress=STRESS, hardness=9e7), "hardness must be greater than the pressure"),
            (dict(hardness=9e8), "hardness needs yield_stress"),
        ],
    )
    def test_is_refused(self, change, words):
        with pytest.raises(ValueError, match=words):
            line_law(1e3, **EQUAL, **change)
