"""Heat, temperatures and conductance of a contact spot between wires of different temperatures."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from litz.kernels import hot_conductance, spot_heat

L = 2.44e-8
G = 700.0
VOLTAGES = [0.0, 1e-9, 1e-3, 0.05, -0.3]
BULKS = [(300.0, 300.0), (293.0, 400.0), (1100.0, 280.0)]
COPPER_BRASS = dict(lorenz=(2.23e-8, 2.7e-8), resistivity=(1.7e-8, 6.4e-8))
CASES = {
    "one metal": {},
    "two metals": COPPER_BRASS,
    "constant properties": dict(heat_conductance=(4e-3, 7e-3), resistivity=(1.0, 3.0)),
    "metal and carbon": dict(heat_conductance=(None, 2e-3), resistivity=(1.0, 1e3)),
    "film": dict(film_resistance=0.3 / G, film_heat_conductance=3e-3, **COPPER_BRASS),
    "film that insulates": dict(film_resistance=0.99 / G, film_heat_conductance=1e-9),
    "film on carbon": dict(heat_conductance=(2e-3, None), film_resistance=0.1 / G, film_heat_conductance=1e-2),
}
cases = pytest.mark.parametrize("case", CASES.values(), ids=CASES)
voltages = pytest.mark.parametrize("voltage", VOLTAGES)
bulks = pytest.mark.parametrize("bulk", BULKS)


def sqrt(x):
    return np.sqrt(x + 0j)


class Chain:
    """Three parts in series, of which each gives half of its heat to either side: the equations, for complex numbers too."""

    def __init__(self, voltage, conductance, bulk, *, lorenz=L, resistivity=1.0, heat_conductance=(None, None),
                 film_resistance=0.0, film_heat_conductance=np.inf):  # fmt: skip
        weight = np.broadcast_to(resistivity, 2) / np.broadcast_to(resistivity, 2).sum()
        ohm = 1 / conductance - film_resistance if conductance != 0 else 0
        current = voltage * conductance
        self.made = np.array([current**2 * ohm * weight[0], current**2 * film_resistance, current**2 * ohm * weight[1]])
        self.is_metal = [one is None for one in heat_conductance]
        self.h = [
            number / (ohm * share) if one is None else one
            for one, number, share in zip(heat_conductance, np.broadcast_to(lorenz, 2), weight, strict=True)
        ]
        self.bulk, self.film = bulk, 1 / film_heat_conductance

    def faces(self, q):
        """Temperatures of the faces if the heat q enters wire 1."""
        entering = [q - self.made[0] / 2, sum(self.made) - q - self.made[2] / 2]
        return [
            sqrt(t**2 + 2 * e / h) if metal else t + e / h
            for t, e, h, metal in zip(self.bulk, entering, self.h, self.is_metal, strict=True)
        ]

    def mismatch(self, q):
        face = self.faces(q)
        return face[0] - face[1] + self.film * (q - self.made[0] - self.made[1] / 2)

    def heat(self, q, slope):
        """The heat into wire 1 with the imaginary part that belongs to the data, given its real part."""
        return q - 1j * self.mismatch(q).imag / slope

    def hottest(self, q):
        # where all are equal to round-off, the place within
        candidates = []
        for heat, made, t, h, metal in zip(
            [q, sum(self.made) - q], self.made[[0, 2]], self.bulk, self.h, self.is_metal, strict=True
        ):
            if 0 < np.real(heat) <= np.real(made):
                above = heat**2 / (2 * made * h)
                candidates.append(sqrt(t**2 + 2 * above) if metal else t + above)
        return max([*candidates, *self.bulk, *self.faces(q)], key=np.real)


class TestOneMetal:
    @pytest.mark.parametrize("voltage", [1e-6, 0.01, 0.1, 0.4])
    def test_hottest_between_equal_bulks(self, voltage):
        """R. Holm, Electric Contacts: V^2 = 4 L (Tmax^2 - T0^2)."""
        spot = spot_heat(voltage, [293, 293], current=G * voltage)
        assert spot.hottest == pytest.approx(np.sqrt(293**2 + voltage**2 / (4 * L)), rel=1e-14)

    @pytest.mark.parametrize(("melts", "volt", "measured"), [(463, 0.112, 0.12), (1358, 0.414, 0.43)])
    def test_voltages_at_which_copper_softens_and_melts(self, melts, volt, measured):
        """Holm measured 0.12 V and 0.43 V; the law of Wiedemann and Franz gives 0.112 V and 0.414 V."""
        at = brentq(lambda v: spot_heat(v, [293, 293], current=G * v).hottest - melts, 0.01, 1)
        assert at == pytest.approx(volt, abs=0.0005)
        assert at == pytest.approx(measured, rel=0.08)

    @bulks
    @pytest.mark.parametrize("voltage", [1e-3, 0.05, 0.3])
    @pytest.mark.parametrize("sign", [1, -1])
    def test_kohlrausch(self, bulk, voltage, sign):
        """q1 = I V/2 + (I/V) int L T dT, whatever the shape of the spot."""
        integral = quad(lambda t: L * t, *bulk)[0]
        spot = spot_heat(sign * voltage, bulk, current=sign * G * voltage)
        q1 = G * voltage**2 / 2 + G * integral
        assert spot.heat == pytest.approx([q1, G * voltage**2 - q1], rel=1e-12)

    @pytest.mark.parametrize(("resistivity", "bulk", "voltage"), [((1, 1), (293, 400), 0.1), ((1, 9), (500, 300), 0.2)])
    def test_the_boundary_between_wires_of_one_lorenz_number_does_not_matter(self, resistivity, bulk, voltage):
        one = spot_heat(voltage, bulk, conductance=G)
        other = spot_heat(voltage, bulk, conductance=G, resistivity=resistivity)
        assert other.heat == pytest.approx(one.heat, rel=1e-13)
        v1 = one.heat[0] / (G * voltage)
        assert 0 < v1 < voltage
        assert [one.hottest, other.hottest] == pytest.approx([np.sqrt(bulk[0] ** 2 + v1**2 / L)] * 2, rel=1e-13)

    def test_the_hottest_place_is_a_bulk_if_heat_flows_out_of_it(self):
        spot = spot_heat(0.01, [400, 300], current=10)
        assert spot.heat[0] < 0
        assert spot.hottest == 400

    @pytest.mark.slow
    def test_potential_and_temperature_of_a_conical_constriction(self):
        """The differential equations of heat and current along a tube of any section, here a cone, by finite volumes."""
        n, bulk, voltage, conductivity = 400, (300.0, 500.0), 0.25, 380.0
        faces = np.linspace(-1, 1, n + 1)
        area = 1e-9 * (0.1 + (faces[1:] + faces[:-1]) ** 2 / 4)
        weight = area / (2e-5 / n)
        t = np.linspace(*bulk, n + 1)
        for _ in range(200):
            g = weight * conductivity / (L * (t[1:] + t[:-1]) / 2)
            current = voltage / (1 / g).sum()
            made = current**2 / g
            k = weight * conductivity
            matrix = np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
            source = (made[1:] + made[:-1]) / 2
            source[0] += k[0] * bulk[0]
            source[-1] += k[-1] * bulk[1]
            t[1:-1] = np.linalg.solve(matrix, source)
        q1 = k[0] * (t[1] - t[0]) + made[0] / 2
        spot = spot_heat(voltage, bulk, current=current)
        # the cells are of second order: 2e-5 with 400
        assert spot.heat[0] == pytest.approx(q1, rel=1e-4)
        assert spot.hottest == pytest.approx(t.max(), rel=1e-4)


class TestConstantProperties:
    def test_equal_wires_have_a_parabola(self):
        """lambda rho = P: V^2 = 8 P (Tmax - T0)."""
        spot = spot_heat(0.1, [300, 300], conductance=G, heat_conductance=2 * G * 7e-6)
        assert spot.hottest - 300 == pytest.approx(0.1**2 / (8 * 7e-6), rel=1e-12)
        assert spot.heat == pytest.approx([G * 0.005, G * 0.005], rel=1e-13)

    def test_two_metals(self):
        """c = q1/I by the fluxes of energy in both, with P = lambda rho of each and their voltages."""
        p, rho, bulk, voltage = np.array([7e-6, 9e-6]), np.array([1.7e-8, 6e-8]), [300, 340], 0.12
        v = voltage * rho / rho.sum()
        c = (bulk[1] - bulk[0] + v[0] ** 2 / (2 * p[0]) + v[1] * (2 * v[0] + v[1]) / (2 * p[1])) / (v / p).sum()
        spot = spot_heat(voltage, bulk, conductance=G, resistivity=rho, heat_conductance=p * rho.sum() / rho * G)
        assert spot.heat[0] == pytest.approx(c * G * voltage, rel=1e-13)

    def test_equal_products_of_conductivity_and_resistivity_share_the_heat_evenly(self):
        rho = np.array([1.0, 5.0])
        spot = spot_heat(0.1, [300, 300], conductance=G, resistivity=rho, heat_conductance=7e-6 * rho.sum() / rho * G)
        assert spot.heat[0] == pytest.approx(spot.heat[1], rel=1e-13)

    def test_insulated_wires_conduct_heat_through_both_constrictions(self):
        """4 a lambda of each, in series."""
        a, conductivity = 1e-5, np.array([390.0, 110.0])
        spot = spot_heat(5.0, [300, 350], conductance=0.0, heat_conductance=4 * a * conductivity)
        assert spot.heat[0] == pytest.approx(50 / (1 / (4 * a * conductivity)).sum(), rel=1e-13)
        assert spot.heat.sum() == 0
        assert spot.hottest == 350


class TestFilms:
    def test_the_heat_of_a_film_goes_half_and_half(self):
        spot = spot_heat(0.1, [300, 300], conductance=G, film_resistance=0.999 / G, film_heat_conductance=1e-5)
        assert spot.heat == pytest.approx([G * 0.005, G * 0.005], rel=1e-13)

    def test_a_film_that_conducts_badly_keeps_the_heat_of_each_side_there(self):
        spot = spot_heat(0.1, [300, 400], conductance=G, film_resistance=0.2 / G, film_heat_conductance=1e-12,
                         resistivity=(1, 3))  # fmt: skip
        assert spot.heat == pytest.approx(G * 0.01 * np.array([0.3, 0.7]), rel=1e-8)

    def test_a_film_hinders_what_flows_between_wires_of_different_temperatures(self):
        clean = 1 / (2e-3 * 4e-3 / 6e-3)
        film = spot_heat(0, [300, 310], conductance=G, heat_conductance=(2e-3, 4e-3), film_heat_conductance=1e-3)
        assert film.heat == pytest.approx(np.array([10, -10]) / (clean + 1e3), rel=1e-13)


@cases
@bulks
@voltages
class TestEverySpot:
    @staticmethod
    def spot(case, bulk, voltage, conductance=G):
        return spot_heat(voltage, bulk, conductance=conductance, **case)

    def test_the_equations_hold(self, case, bulk, voltage):
        spot = self.spot(case, bulk, voltage)
        chain = Chain(voltage, G, bulk, **case)
        # round-off of the temperatures, and of what flows through the film
        largest = max(bulk) + chain.film * abs(spot.heat).max()
        assert abs(chain.mismatch(spot.heat[0])) < 1e-14 * largest
        assert spot.hottest == pytest.approx(np.real(chain.hottest(spot.heat[0])), rel=1e-12)
        assert spot.heat.sum() == pytest.approx(G * voltage**2, rel=1e-12, abs=1e-15 * abs(spot.heat).max())

    def test_nothing_in_it_is_colder_than_the_colder_bulk(self, case, bulk, voltage):
        spot = self.spot(case, bulk, voltage)
        assert spot.hottest >= max(bulk)
        assert min(np.real(Chain(voltage, G, bulk, **case).faces(spot.heat[0]))) > min(bulk) * (1 - 1e-14)

    def test_wires_in_turn(self, case, bulk, voltage):
        turned = {name: value[::-1] if isinstance(value, tuple) else value for name, value in case.items()}
        one, other = self.spot(case, bulk, voltage), self.spot(turned, bulk[::-1], voltage)
        assert other.heat[::-1] == pytest.approx(one.heat, rel=1e-12, abs=1e-14 * abs(one.heat).max())
        assert other.hottest == pytest.approx(one.hottest, rel=1e-14)

    def test_derivatives_by_a_complex_step(self, case, bulk, voltage):
        spot = self.spot(case, bulk, voltage)
        slope = Chain(voltage, G, bulk, **case).mismatch(spot.heat[0] + 1e-30j).imag / 1e-30
        for column, size in enumerate([1.0, G, bulk[0], bulk[1]]):
            at = np.array([voltage, G, *bulk], dtype=complex)
            at[column] += 1e-30j * size
            chain = Chain(at[0], at[1], at[2:], **case)
            q = chain.heat(spot.heat[0], slope)
            expected = np.array([q, sum(chain.made) - q]).imag / (1e-30 * size)
            scale = np.abs(spot.dheat[:, column]).max() + abs(spot.heat).max() / size
            np.testing.assert_allclose(spot.dheat[:, column], expected, rtol=1e-10, atol=1e-12 * scale)
            if bulk[0] != bulk[1] or voltage != 0:
                np.testing.assert_allclose(
                    spot.dhottest[column],
                    chain.hottest(q).imag / (1e-30 * size),
                    rtol=1e-8,
                    atol=1e-12 * max(bulk) / size,
                )


class TestHotConductance:
    @bulks
    @pytest.mark.parametrize("voltage", [1e-6, 1e-3, 0.1, 1.0])
    def test_integral_of_the_conductivity_over_the_potential(self, bulk, voltage):
        """I = S int sigma dphi, with the temperature that belongs to each potential and sigma = lambda/(L T)."""
        v1 = voltage / 2 + L * (bulk[1] ** 2 - bulk[0] ** 2) / (2 * voltage)
        # T^2 = T1^2 + (v1^2 - u^2)/L, u = v1 - (potential above wire 1)
        mean = quad(
            lambda s: 1 / np.sqrt(bulk[0] ** 2 + s * voltage * (2 * v1 - s * voltage) / L), 0, 1, epsabs=0, epsrel=1e-12
        )[0]
        assert hot_conductance(voltage, bulk).ratio == pytest.approx(mean * sum(bulk) / 2, rel=1e-10)

    @bulks
    @pytest.mark.parametrize("voltage", [0.0, 1e-5, 0.9e-4, 1.1e-4, 0.03, -0.5])
    def test_derivatives_by_a_complex_step(self, bulk, voltage):
        found = hot_conductance(voltage, bulk)
        for column, size in enumerate([1.0, *bulk]):
            at = np.array([voltage, *bulk], dtype=complex)
            at[column] += 1e-30j * size
            u = at[0] / (np.sqrt(L) * at[1:].sum())
            # arctan(u)/u near 0 by its series
            ratio = sum((-1) ** i * u ** (2 * i) / (2 * i + 1) for i in range(9)) if abs(u) < 0.01 else np.arctan(u) / u
            assert found.ratio == pytest.approx(ratio.real, rel=1e-14)
            assert found.dratio[column] == pytest.approx(ratio.imag / (1e-30 * size), rel=1e-9, abs=1e-18)

    def test_the_current_has_a_bound(self):
        at = [hot_conductance(v, [300, 300]).ratio * v for v in (1, 10, 1e3)]
        assert at == sorted(at)
        assert at[-1] == pytest.approx(np.pi / 2 * np.sqrt(L) * 600, rel=1e-3)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (dict(temperature=[300, 0]), "temperature must be greater than 0 K"),
        (dict(temperature=[300, -1]), "temperature must not be below absolute zero"),
        (dict(temperature=300), r"temperature must have shape \(2,\)"),
        (dict(current=None), "current or conductance is needed"),
        (dict(voltage=0), "conductance is needed"),
        (dict(current=-1), "current must have the sign of the voltage"),
        (dict(conductance=5), "contradict"),
        (dict(conductance=-5), "conductance must not be negative"),
        (dict(current=0), "need heat_conductance"),
        (dict(lorenz=0), "lorenz must be greater than 0"),
        (dict(heat_conductance=(1, None, 2)), "heat_conductance must be a number or two"),
        (dict(heat_conductance=(1, 0)), "heat_conductance must be greater than 0"),
        (dict(film_resistance=0.1), "film_resistance must be less than V/I"),
        (dict(film_resistance=-0.1), "film_resistance must not be negative"),
        (dict(film_heat_conductance=0), "film_heat_conductance must be greater than 0"),
        (dict(resistivity=-1), "resistivity must be greater than 0"),
        (dict(voltage=1e-300, current=1e300, lorenz=1e300), "too large or too small"),
    ],
)
def test_refusals(changes, words):
    with pytest.raises(ValueError, match=words):
        spot_heat(**(dict(voltage=0.1, temperature=[300, 310], current=1.0) | changes))


def test_hot_conductance_refuses_absolute_zero():
    with pytest.raises(ValueError, match="temperature must be greater than 0 K"):
        hot_conductance(0.1, [0, 300])
