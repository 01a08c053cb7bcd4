"""Contact of crossed wires of metal that yields: limits, published laws, identities, derivatives, bad input."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from verification.references import flattened_spheres

from derivatives import derivative
from litz import _core
from litz.kernels import contact_spot, normal_law

DEGREE = np.pi / 180
COPPER = dict(radius=1e-3, young=120e9, poisson=0.34)
UNEQUAL = dict(radius=[1e-3, 0.3e-3], young=[120e9, 70e9], poisson=[0.34, 0.2])
HARD = dict(yield_stress=300e6)
SOFT = dict(yield_stress=50e6, hardness=450e6)
RESISTIVITY = np.array([1.7e-8, 5e-8])
MODULUS = 1 / (2 * (1 - 0.34**2) / 120e9)


def points(
    given, *, is_force=False, largest=0.0, angle=np.pi / 2, yield_stress=50e6, hardness=0.0, radius, young, poisson
):
    """All numbers of the law by name, and p_Y, F_Y, delta_Y, h, F_p; the kernel itself, without checks."""
    given, largest = np.broadcast_arrays(np.atleast_1d(np.asarray(given, dtype=float)), largest)
    wires = [np.broadcast_to(value, 2).astype(float) for value in (radius, young, poisson)]
    values, onset, info = _core.f2py_yielding.normal_law_of_points(
        given.copy(), int(is_force), largest.astype(float), *wires, angle, np.broadcast_to(yield_stress, 2), hardness
    )
    assert info == 0
    onset = onset[:, 0]
    names = [
        "overlap",
        "force",
        "stiffness",
        "dstiffness",
        "by_angle",
        "by_largest",
        "a",
        "b",
        "disc",
        "dent",
        "energy",
        "dissipation",
    ]
    found = dict(zip(names, values, strict=False))
    found["area"] = np.pi * found["a"] * found["b"]
    found["darea"], found["ddisc"] = values[12:15], values[15:18]
    found["energy_by_largest"] = values[18]
    return found, dict(zip(["pressure", "force", "overlap", "h", "plastic"], onset, strict=True))


def elastic(force, angle, **wires):
    return contact_spot(force, angle=angle, resistivity=RESISTIVITY, **wires)


class TestOnset:
    @pytest.mark.parametrize("wires", [COPPER, UNEQUAL])
    @pytest.mark.parametrize("degrees", [90, 60, 30, 10, 2])
    def test_hertz_s_largest_pressure_is_then_the_yield_pressure(self, wires, degrees):
        _, onset = points([0.0], angle=degrees * DEGREE, **SOFT, **wires)
        spot = elastic(onset["force"], degrees * DEGREE, **wires)
        pressure = 1.5 * onset["force"] / (np.pi * spot.semi_major * spot.semi_minor)
        ratio = spot.semi_minor / spot.semi_major
        # the metal with the smaller Poisson's ratio yields first
        factor = flattened_spheres.onset_pressure(np.min(wires["poisson"])) * (1 + 0.11 * (1 - ratio) ** 2.8)
        assert pressure == pytest.approx(onset["pressure"], rel=1e-13)
        assert pressure == pytest.approx(factor * 50e6, rel=1e-13)
        assert spot.approach == pytest.approx(onset["overlap"], rel=1e-13)

    def test_a_sphere_on_a_plane(self):
        # by hand, R = r: a_Y = pi p_Y R/(2 E*), F_Y = (2/3) p_Y pi a_Y^2, delta_Y = a_Y^2/R
        _, onset = points([0.0], **HARD, **COPPER)
        pressure = flattened_spheres.onset_pressure(0.34) * 300e6
        a = np.pi * pressure * 1e-3 / (2 * MODULUS)
        assert onset["force"] == pytest.approx(2 / 3 * pressure * np.pi * a**2, rel=1e-13)
        assert onset["overlap"] == pytest.approx(a**2 / 1e-3, rel=1e-13)

    def test_the_softer_of_two_metals_yields(self):
        both = points([0.0], yield_stress=[50e6, 400e6], **UNEQUAL)[1]
        spot = elastic(both["force"], np.pi / 2, **UNEQUAL)
        of_ellipse = 1 + 0.11 * (1 - spot.semi_minor / spot.semi_major) ** 2.8
        assert both["pressure"] == pytest.approx(flattened_spheres.onset_pressure(0.34) * of_ellipse * 50e6, rel=1e-13)
        swapped = {name: value[::-1] for name, value in UNEQUAL.items()}
        assert points([0.0], yield_stress=[400e6, 50e6], **swapped)[1] == pytest.approx(both, rel=1e-13)

    @pytest.mark.parametrize("degrees", [90, 25])
    def test_below_it_the_wires_are_those_of_hertz_and_remember_nothing(self, degrees):
        wires = dict(angle=degrees * DEGREE, **SOFT, **UNEQUAL)
        _, onset = points([0.0], **wires)
        for share, largest in [(0.01, 0.0), (0.9, 0.0), (0.4, 0.99)]:
            force = share * onset["force"]
            found, _ = points(force, is_force=True, largest=largest * onset["force"], **wires)
            spot = elastic(force, degrees * DEGREE, **UNEQUAL)
            assert found["overlap"][0] == pytest.approx(spot.approach, rel=1e-13)
            assert [found["a"][0], found["b"][0]] == pytest.approx([spot.semi_major, spot.semi_minor], rel=1e-13)
            assert 4 * found["disc"][0] / RESISTIVITY.sum() == pytest.approx(spot.conductance, rel=1e-13)
            assert found["energy"][0] == pytest.approx(0.4 * force * spot.approach, rel=1e-13)
            assert found["dent"][0] == found["dissipation"][0] == 0

    def test_metal_without_a_yield_stress_is_that_of_hertz(self):
        overlaps = np.array([-1e-6, 0.0, 1e-9, 1e-7, 1e-5])
        law = normal_law(overlaps, angle=0.6, **UNEQUAL)
        wires = [np.broadcast_to(UNEQUAL[key], 2) for key in ("radius", "young", "poisson")]
        exact = [_core.f2py_contact.normal_force(2, [0.0], -overlap, *wires, 0.6)[0] for overlap in overlaps]
        assert law.force == pytest.approx([each[0] for each in exact], rel=1e-13)
        assert law.stiffness == pytest.approx([-each[1] for each in exact], rel=1e-13)
        assert law.dforce_dangle == pytest.approx([each[2] for each in exact], rel=1e-12)
        assert law.energy == pytest.approx([each[3] for each in exact], rel=1e-13)


class TestLoading:
    @pytest.mark.parametrize("wires", [dict(**HARD, **COPPER), dict(**SOFT, **UNEQUAL)])
    @pytest.mark.parametrize("degrees", [90, 30, 5])
    def test_force_stiffness_area_and_its_slope_are_continuous(self, wires, degrees):
        _, onset = points([0.0], angle=degrees * DEGREE, **wires)
        for overlap in (onset["overlap"], onset["overlap"] * onset["h"] ** 3):
            below, above = (points(overlap * (1 + d), angle=degrees * DEGREE, **wires)[0] for d in (-1e-12, 1e-12))
            for name in ("force", "stiffness", "area", "by_angle", "darea", "energy", "dissipation"):
                scale = above["force"] * overlap if name in ("energy", "dissipation") else np.abs(above[name])
                assert (np.abs(above[name] - below[name]) <= 1e-10 * scale).all(), name

    def test_mean_pressure_rises_to_the_hardness_and_no_further(self):
        forces = np.geomspace(1e-6, 1e4, 400)
        found, onset = points(forces, is_force=True, **SOFT, **COPPER)
        pressure = forces / found["area"]
        assert (np.diff(pressure) > 0).all()
        assert (pressure < 450e6).all()
        assert pressure[-1] == pytest.approx(450e6, rel=1e-2)
        assert onset["plastic"] < 1e3

    def test_work_is_the_integral_of_the_force(self):
        _, onset = points([0.0], **HARD, **COPPER)
        for omega in (0.5, 7.0, onset["h"] ** 3 * 2):
            steps = [x * onset["overlap"] for x in (1, onset["h"] ** 3) if x < omega]
            exact = quad(
                lambda x: points(x, **HARD, **COPPER)[0]["force"][0],
                0,
                omega * onset["overlap"],
                points=steps or None,
                epsabs=0,
                epsrel=1e-10,
            )[0]
            found, _ = points(omega * onset["overlap"], **HARD, **COPPER)
            assert found["energy"][0] + found["dissipation"][0] == pytest.approx(exact, rel=1e-9)

    @pytest.mark.parametrize("yield_stress", [20e6, 100e6, 300e6])
    def test_between_the_published_laws_of_a_sphere_on_a_plane(self, yield_stress):
        # the law is to be within 10 % of both, which differ by up to 6 % from each other, and one of which jumps by 1.7 % at 6
        wires = dict(radius=1e-3, young=120e9, poisson=0.3)
        modulus = 60e9 / (1 - 0.3**2)
        _, onset = points([0.0], yield_stress=yield_stress, **wires)
        omega = np.array([2, 3, 6, 6.001, 10, 20, 50, 80, 110])
        found, _ = points(omega * onset["overlap"], yield_stress=yield_stress, **wires)
        area = found["area"] * onset["pressure"] / (1.5 * onset["force"])
        for force, of_area in (
            flattened_spheres.kogut_etsion(omega),
            flattened_spheres.jackson_green(omega, yield_stress / modulus, 0.3),
        ):
            assert found["force"] / onset["force"] == pytest.approx(force, rel=0.1)
            assert area == pytest.approx(of_area, rel=0.1)


class TestUnloading:
    @pytest.mark.parametrize("wires", [dict(**HARD, **COPPER), dict(**SOFT, **UNEQUAL)])
    @pytest.mark.parametrize("degrees", [90, 30, 5])
    @pytest.mark.parametrize("multiple", [1.01, 2, 30, 3000])
    def test_barber_s_identity_holds_on_the_whole_branch(self, wires, degrees, multiple):
        # G = 2/(E* (rho1 + rho2)) dF/ddelta with G = 4 disc/(rho1 + rho2)
        angle = degrees * DEGREE
        _, onset = points([0.0], angle=angle, **wires)
        largest = multiple * onset["force"]
        forces = largest * np.array([1e-9, 1e-3, 0.1, 0.5, 0.9, 0.999])
        found, _ = points(forces, is_force=True, largest=largest, angle=angle, **wires)
        pairs = {name: np.broadcast_to(wires[name], 2) for name in ("young", "poisson")}
        modulus = 1 / ((1 - pairs["poisson"] ** 2) / pairs["young"]).sum()
        assert found["stiffness"] == pytest.approx(2 * modulus * found["disc"], rel=1e-13)

    def test_a_spot_under_even_pressure_opens_as_a_half_space_does(self):
        # I. N. Sneddon: the middle of a circle of radius a under an even pressure p sinks by 2 p a/E*; taken off from the
        # rim inwards by flat punches of radius x a, what is left of the force is 2/pi (asin x - x sqrt(1 - x^2)) of it
        force = 1e6 * points([0.0], **HARD, **COPPER)[1]["force"]
        top, _ = points(force, is_force=True, **HARD, **COPPER)
        a, even = top["disc"][0], force / top["area"][0]
        assert even == pytest.approx(2.8 * 300e6, rel=1e-3)
        drop = top["overlap"][0] - top["dent"][0]
        assert drop == pytest.approx(2 * even * a / MODULUS, rel=2e-3)
        share = 0.37
        lam = points(share * force, is_force=True, largest=force, **HARD, **COPPER)[0]["disc"][0] / a
        assert 2 / np.pi * (np.arcsin(lam) - lam * np.sqrt(1 - lam**2)) == pytest.approx(share, rel=1e-3)

    @pytest.mark.parametrize("wires", [dict(**HARD, **COPPER), dict(**SOFT, **UNEQUAL)])
    @pytest.mark.parametrize("multiple", [2, 30, 3000])
    def test_energy_is_the_integral_of_the_force_from_the_dent(self, wires, multiple):
        largest = multiple * points([0.0], angle=0.7, **wires)[1]["force"]
        top, _ = points(largest, is_force=True, largest=largest, angle=0.7, **wires)
        dent, span = top["dent"][0], top["overlap"][0] - top["dent"][0]
        for share in (0.01, 0.3, 0.9, 1.0):
            # with x = dent + span y^2 the integrand is smooth at the dent
            exact = quad(
                lambda y: points(dent + span * y**2, largest=largest, angle=0.7, **wires)[0]["force"][0] * 2 * span * y,
                0,
                np.sqrt(share),
                epsabs=0,
                epsrel=1e-11,
            )[0]
            found, _ = points(dent + span * share, largest=largest, angle=0.7, **wires)
            # with the force at the end of the branch on it
            assert found["energy"][0] == pytest.approx(exact, rel=1e-8)
            assert found["dissipation"][0] == pytest.approx(top["dissipation"][0], rel=1e-13)

    @pytest.mark.parametrize("multiple", [1.001, 5, 1e3, 1e6])
    def test_nothing_jumps_at_the_largest_force(self, multiple):
        largest = multiple * points([0.0], **SOFT, **COPPER)[1]["force"]
        top, _ = points(largest, is_force=True, **SOFT, **COPPER)
        for overlap in (np.nextafter(top["overlap"], 0), top["overlap"]):
            found, _ = points(overlap, largest=largest, **SOFT, **COPPER)
            for name in ("force", "area", "disc", "dent", "energy", "dissipation"):
                assert found[name] == pytest.approx(top[name], rel=1e-7), name

    def test_the_dent_against_the_published_fit(self):
        _, onset = points([0.0], yield_stress=100e6, radius=1e-3, young=120e9, poisson=0.3)
        omega = np.array([2, 3, 6, 10, 20, 50, 110])
        found, _ = points(omega * onset["overlap"], yield_stress=100e6, radius=1e-3, young=120e9, poisson=0.3)
        # of the largest overlap; the fit is to some per cent of it
        assert found["dent"] / found["overlap"] == pytest.approx(flattened_spheres.remaining_overlap(omega), abs=0.021)

    @pytest.mark.parametrize("ratio", [2.0, 2.8, 5.0, 10.0])
    @pytest.mark.parametrize("degrees", [90, 30, 5])
    def test_the_dent_deepens_with_the_force_and_unloading_is_stiffer_than_loading(self, ratio, degrees):
        wires = dict(angle=degrees * DEGREE, yield_stress=100e6, hardness=ratio * 100e6, **COPPER)
        forces = points([0.0], **wires)[1]["force"] * np.geomspace(1.0, 1e6, 2000)
        found, _ = points(forces, is_force=True, **wires)
        assert (np.diff(found["dent"]) >= 0).all()
        assert (found["stiffness"] <= 2 * MODULUS * found["disc"] * (1 + 1e-12)).all()

    def test_over_the_dent_there_is_no_force(self):
        top = normal_law(1e-6, angle=1.0, **HARD, **COPPER)
        overlaps = np.array([-1e-6, 0.0, 0.5 * top.dent, top.dent * (1 - 1e-12)])
        law = normal_law(overlaps, angle=1.0, largest_force=top.force, **HARD, **COPPER)
        for name in ("force", "stiffness", "semi_major", "energy"):
            assert not getattr(law, name).any(), name
        assert law.dent == pytest.approx(top.dent, rel=1e-13)
        assert law.dissipation == pytest.approx(top.dissipation, rel=1e-13)

    def test_reloading_goes_back_and_on(self):
        kept = normal_law([0.8e-6, 1e-6, 1.5e-6], angle=1.0, largest_force=0.0, **HARD, **COPPER)
        again = normal_law([0.8e-6, 1e-6, 1.5e-6], angle=1.0, largest_force=kept.force[1], **HARD, **COPPER)
        assert again.force[0] < kept.force[0]
        assert again.force[1:] == pytest.approx(kept.force[1:], rel=1e-13)
        assert again.largest_force == pytest.approx([kept.force[1], kept.force[1], kept.force[2]])


@pytest.mark.parametrize("hardness", [0.0, 450e6])
@pytest.mark.parametrize("degrees", [89, 60, 20, 6, 120])
@pytest.mark.parametrize("multiple", [0.0, 0.5, 2.0, 20.0, 0.8, 3.0, 30.0])
def test_derivatives(hardness, degrees, multiple):
    wires = dict(hardness=hardness, yield_stress=50e6, **UNEQUAL)
    angle = degrees * DEGREE
    _, onset = points([0.0], angle=angle, **wires)
    # 0.8, 3 and 30 times the force from which on the hardness acts
    largest = multiple * (onset["plastic"] if multiple in (0.8, 3.0, 30.0) else onset["force"])
    h3 = onset["h"] ** 3
    if largest > 0:
        top, _ = points(largest, is_force=True, angle=angle, **wires)
        overlaps = [top["dent"][0] + share * (top["overlap"][0] - top["dent"][0]) for share in (0.05, 0.4, 0.9)]
    else:
        top = {"overlap": np.zeros(1), "dent": np.zeros(1)}
        overlaps = [omega * onset["overlap"] for omega in (0.5, 3.0, 0.7 * h3, 3 * h3)]

    def numbers(overlap, of_angle=angle, of_largest=largest):
        found, _ = points(overlap, largest=of_largest, angle=of_angle, **wires)
        return np.array([found[name][0] for name in ("force", "area", "disc", "stiffness", "energy")])

    for overlap in overlaps:
        found, _ = points(overlap, largest=largest, angle=angle, **wires)
        size = numbers(overlap)
        # The differences stay on one branch, whose length is the scale on which all changes: truncation and noise are
        # (step/room)^6 and eps overlap/step, times change over room
        ends = [top["dent"][0], top["overlap"][0], onset["overlap"], h3 * onset["overlap"]]
        room = min(overlap, *(abs(overlap - end) for end in ends if end > 0))
        reach = room / overlap
        tolerance = 1e-9 * size / reach

        by_overlap = derivative(numbers, overlap, 0.01 * room)[:, 0] * overlap
        exact = np.array([found["stiffness"][0], found["darea"][0, 0], found["ddisc"][0, 0]]) * overlap
        assert (np.abs(exact - by_overlap[:3]) <= tolerance[:3] / reach).all()
        by_force = found["dstiffness"][0] * found["stiffness"][0] * overlap
        assert by_force == pytest.approx(by_overlap[3], abs=tolerance[3] / reach)
        if size[0] < max(largest, onset["force"]):
            assert by_overlap[4] == pytest.approx(size[0] * overlap, rel=1e-8 / reach)

        step = 5e-3 * reach * np.sin(angle)
        by_angle = derivative(lambda a, overlap=overlap: numbers(overlap, of_angle=a), angle, step)[:3, 0]
        exact = np.array([found["by_angle"][0], found["darea"][1, 0], found["ddisc"][1, 0]])
        assert (np.abs(exact - by_angle) * np.sin(angle) <= tolerance[:3] / reach).all()
        if 0 < size[0] < largest:
            by_largest = derivative(
                lambda m, overlap=overlap: numbers(overlap, of_largest=m), largest, 0.01 * reach * largest
            )
            exact = np.array([found["by_largest"][0], found["darea"][2, 0], found["ddisc"][2, 0]])
            assert (np.abs(exact - by_largest[:3, 0]) * largest <= tolerance[:3] / reach).all()
            if size[0] > 0 and largest > onset["force"]:
                energy = found["energy_by_largest"][0] - by_largest[4, 0]
                assert abs(energy) * largest <= 10 * tolerance[4] / reach


@pytest.mark.parametrize("multiple", [0.0, 0.5, 1.0001, 2.0, 100.0, 1e5])
@pytest.mark.parametrize("share", [1e-12, 1e-6, 1e-3, 0.3, 0.9, 1 - 1e-9, 1.0, 7.0])
def test_force_and_overlap_are_inverses_of_each_other(multiple, share):
    wires = dict(angle=0.8, **SOFT, **UNEQUAL)
    onset = points([0.0], **wires)[1]
    largest = multiple * onset["force"]
    force = share * (largest or onset["force"])
    found, _ = points(force, is_force=True, largest=largest, **wires)
    back, _ = points(found["overlap"], largest=largest, **wires)
    # round-off of the overlap, which the dent may be most of
    noise = 4 * np.finfo(float).eps * found["overlap"][0] * found["stiffness"][0]
    assert back["force"][0] == pytest.approx(force, rel=1e-13, abs=noise)


class TestResistance:
    def resistance(self, force, *, angle=np.pi / 2, resistivity=1.7e-8, **law):
        return 1 / contact_spot(force, angle=angle, resistivity=resistivity, **law).conductance

    def test_holm_s_limit(self):
        # R = (rho/2) sqrt(pi H/F); the area lags behind by what the elastic part has left
        for multiple, rel in [(1e3, 0.011), (1e6, 1e-3)]:
            force = multiple * points([0.0], **HARD, **COPPER)[1]["force"]
            wide = dict(COPPER, radius=1e-3)
            found, _ = points(force, is_force=True, **HARD, **wide)
            resistance = 2 * 1.7e-8 / (4 * found["disc"][0])
            assert resistance == pytest.approx(1.7e-8 / 2 * np.sqrt(np.pi * 2.8 * 300e6 / force), rel=rel)

    def test_slopes_over_the_force(self):
        metal = dict(yield_stress=20e6, **COPPER)
        onset = points([0.0], **metal)[1]["force"]

        def slope(force, **more):
            spot = contact_spot(force, angle=np.pi / 2, resistivity=1.7e-8, **metal, **more)
            return -spot.dconductance_dforce * force / spot.conductance

        assert slope(0.5 * onset) == pytest.approx(-1 / 3, rel=1e-12)
        assert slope(1e5 * onset) == pytest.approx(-1 / 2, abs=1e-3)
        largest = 1e5 * onset
        assert slope(largest * (1 - 1e-9), largest_force=largest) == pytest.approx(0, abs=1e-3)
        assert slope(largest * 1e-6, largest_force=largest) == pytest.approx(-1 / 3, abs=1e-3)

    def test_the_way_back_of_a_spot_under_even_pressure(self):
        def opening(share):
            return brentq(lambda x: 2 / np.pi * (np.arcsin(x) - x * np.sqrt(1 - x**2)) - share, 0, 1)

        largest = 1e5 * points([0.0], **HARD, **COPPER)[1]["force"]
        top, *back = (
            points(share * largest, is_force=True, largest=largest, **HARD, **COPPER)[0]["disc"][0]
            for share in (1, 0.5, 0.1)
        )
        assert [top / each for each in back] == pytest.approx([1 / opening(0.5), 1 / opening(0.1)], rel=1e-3)

    def test_film_and_sharvin_s_resistance_are_over_the_area_of_the_spot(self):
        law = dict(largest_force=2.0, angle=0.6, **SOFT, **UNEQUAL)
        bare = contact_spot(0.5, resistivity=RESISTIVITY, **law)
        area = np.pi * bare.semi_major * bare.semi_minor
        film = contact_spot(0.5, resistivity=RESISTIVITY, law="film", film_resistivity=1e-13, **law)
        assert 1 / film.conductance == pytest.approx(1 / bare.conductance + 1e-13 / area, rel=1e-13)
        # with long paths: gamma = 0.72 of Holm's, and 4 rho l/(3 S) with the mean of both metals
        paths = np.array([1.0, 2.0])
        small = contact_spot(0.5, resistivity=RESISTIVITY, mean_free_path=paths, **law)
        sharvin = 2 / 3 * (RESISTIVITY * paths).sum() / area
        assert 1 / small.conductance - sharvin == pytest.approx(0.72 / bare.conductance, rel=1e-3)

    @pytest.mark.parametrize(
        ("k", "gamma", "error"),
        [(0.5, 0.891, 0.010), (1, 0.849, 0.003), (2, 0.798, 0.004), (5, 0.751, 0.005), (10, 0.746, 0.004)],
    )
    def test_part_of_holm_s_resistance_in_small_spots(self, k, gamma, error):
        # gamma of a Monte Carlo solution of the Boltzmann equation with its standard error; two of these and 0.3 %
        bare = contact_spot(1e-4, angle=np.pi / 2, resistivity=1.7e-8, **COPPER)
        a = bare.semi_major
        small = contact_spot(1e-4, angle=np.pi / 2, resistivity=1.7e-8, mean_free_path=k * a, **COPPER)
        of_holm = (1 / small.conductance - 4 * 1.7e-8 * k * a / (3 * np.pi * a**2)) * bare.conductance
        assert of_holm == pytest.approx(gamma, abs=2 * error + 0.003)

    @pytest.mark.parametrize("law", [{}, dict(law="film", film_resistivity=1e-13)])
    @pytest.mark.parametrize("metal", [{}, dict(largest_force=2.0, **SOFT), dict(**SOFT)])
    @pytest.mark.parametrize("paths", [[0.0, 0.0], [3.9e-6, 1e-6]])
    def test_derivatives_of_the_conductance(self, law, metal, paths):
        given = dict(resistivity=RESISTIVITY, mean_free_path=paths, **law, **metal, **UNEQUAL)
        spot = contact_spot(0.5, angle=0.6, **given)
        by_log = derivative(lambda s: contact_spot(0.5 * np.exp(s), angle=0.6, **given).conductance, 0.0, 4e-3)[0]
        by_angle = derivative(lambda d: contact_spot(0.5, angle=0.6 + d, **given).conductance, 0.0, 4e-3)[0]
        assert spot.dconductance_dforce * 0.5 == pytest.approx(by_log, abs=1e-10 * spot.conductance)
        assert spot.dconductance_dangle == pytest.approx(by_angle, abs=1e-9 * spot.conductance)


class TestBadInput:
    @pytest.mark.parametrize(
        ("change", "words"),
        [
            (dict(yield_stress=0.0), "yield_stress must be greater than 0"),
            (dict(yield_stress=[1e8, -1.0]), "yield_stress must be greater than 0"),
            (dict(yield_stress=[1e8, 1e8, 1e8]), "yield_stress must have shape"),
            (dict(hardness=-1.0), "hardness must be greater than 0"),
            (dict(hardness=100e6), "hardness must be greater than the pressure at which wires .* begin to yield"),
            (dict(largest_force=-1.0), "largest_force must not be negative"),
            (dict(largest_force=np.nan), "largest_force must be finite"),
            (dict(angle=0.0), "angle must be between"),
            (dict(angle=1e-170), "close to parallel"),
            (dict(yield_stress=None, hardness=1e9), "hardness"),
            (dict(yield_stress=None, largest_force=1.0), "largest_force needs yield_stress"),
        ],
    )
    def test_is_refused(self, change, words):
        given = dict(angle=1.0, yield_stress=100e6, **COPPER) | change
        with pytest.raises(ValueError, match=words):
            normal_law(1e-7, **given)
        with pytest.raises(ValueError, match=words):
            contact_spot(1e-3, resistivity=1e-8, **given)

    def test_metal_that_is_compacted(self):
        with pytest.raises(ValueError, match="more than half of the smaller radius"):
            normal_law(3e-4, angle=1.0, **HARD, **COPPER)
        with pytest.raises(ValueError, match="more than half of the smaller radius"):
            contact_spot(1.0, angle=1.0, largest_force=1e4, resistivity=1e-8, **HARD, **COPPER)
        for overlap in (1e-7, -1e-7):
            with pytest.raises(ValueError, match="more than half of the smaller radius"):
                normal_law(overlap, angle=1.0, largest_force=1e4, **HARD, **COPPER)

    def test_laws_without_a_spot_of_the_mechanics(self):
        for law in (dict(law="plastic", hardness=1e9), dict(law="constant", resistance=1.0), dict(law="paper")):
            for more in (dict(yield_stress=1e8), dict(mean_free_path=1e-8)):
                with pytest.raises(ValueError, match='belongs to the spot laws "hertz" and "film"'):
                    contact_spot(1.0, angle=1.0, resistivity=1e-8, **law, **more, **COPPER)
        with pytest.raises(ValueError, match="mean_free_path must not be negative"):
            contact_spot(1.0, angle=1.0, resistivity=1e-8, mean_free_path=-1.0, **COPPER)

    def test_shapes_that_do_not_fit(self):
        with pytest.raises(ValueError, match="broadcast"):
            normal_law([1e-7, 2e-7], largest_force=[1.0, 2.0, 3.0], angle=1.0, **HARD, **COPPER)


def test_arrays_and_numbers():
    overlaps = np.array([[1e-7, 2e-7, 3e-7], [1e-6, 2e-6, 3e-6]])
    law = normal_law(overlaps, angle=1.0, **HARD, **COPPER)
    assert law.force.shape == law.dent.shape == (2, 3)
    one = normal_law(2e-6, angle=1.0, **HARD, **COPPER)
    assert isinstance(one.force, float)
    assert [float(each[1, 1]) for each in law] == pytest.approx(list(one), rel=1e-14)
