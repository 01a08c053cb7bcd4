"""Current, heat and temperatures of a contact spot that its current warms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from litz.kernels import hot_conductance, hot_spot, spot_heat

L = 2.44e-8
#: Lines of temperature and value
COPPER = dict(rho=[[200, 293, 600, 1300], [1.06e-8, 1.7e-8, 3.9e-8, 9.5e-8]], lam=[[200, 400, 1300], [413, 392, 330]])
BRASS = dict(rho=[[250, 800], [6.0e-8, 9.5e-8]], lam=[[250, 700], [110, 150]])
SHAPE = 1e4


def linear(rho_of_kelvin, upper=1e5):
    """A table of a resistivity that is proportional to the temperature."""
    return [[0.0, upper], [1e-300, rho_of_kelvin * upper]]


def spot(voltage, bulk, first=COPPER, second=COPPER, **way):
    tables = dict(resistivity=[first["rho"], second["rho"]])
    if "lorenz" not in way:
        tables["conductivity"] = [first["lam"], second["lam"]]
    return hot_spot(voltage, bulk, shape=SHAPE, **tables, **way)


class TestWiedemannFranzOfConstantConductivity:
    LAMBDA = 400.0
    RHO = linear(L / LAMBDA)

    def spot(self, voltage, bulk):
        return hot_spot(voltage, bulk, shape=SHAPE, resistivity=self.RHO, lorenz=L)

    @pytest.mark.parametrize("bulk", [(300, 300), (293, 400), (900, 280)])
    @pytest.mark.parametrize("voltage", [0.0, 1e-6, 0.02, -0.1, 0.4, 2.0])
    def test_arctangent(self, voltage, bulk):
        cold = voltage / (SHAPE * L / self.LAMBDA * sum(bulk))
        expected = hot_conductance(voltage, bulk).ratio * cold
        # 16 points of Gauss, far beyond the voltage at which any metal melts
        accurate = 1e-9 if abs(voltage) < 0.5 else 2e-5
        assert self.spot(voltage, bulk).current == pytest.approx(expected, rel=accurate, abs=0)

    @pytest.mark.parametrize("bulk", [(300, 300), (293, 400)])
    def test_arcsine(self, bulk):
        """I = (lambda/(c sqrt(L))) [asin(v1/(sqrt(L) Tmax)) + asin(v2/(sqrt(L) Tmax))], v_i = q_i/I."""
        found = self.spot(0.2, bulk)
        v = found.heat / found.current
        expected = np.arcsin(v / (np.sqrt(L) * found.hottest.max())).sum() * self.LAMBDA / (np.sqrt(L) * 2 * SHAPE)
        # S = 1/(2 c) of both constrictions in series
        assert found.current == pytest.approx(expected, rel=1e-9)
        assert found.hottest.max() == pytest.approx(np.sqrt(bulk[0] ** 2 + v[0] ** 2 / L), rel=1e-12)

    def test_the_current_is_bounded(self):
        """However high the voltage, it stays below pi S lambda/sqrt(L), and comes near it."""
        bound = np.pi * self.LAMBDA / (np.sqrt(L) * 2 * SHAPE)
        currents = [self.spot(v, [300, 300]).current for v in (1.0, 5.0, 20.0)]
        assert currents == sorted(currents)
        assert 0.99 * bound < currents[-1] < bound


class TestOneMetal:
    @pytest.mark.parametrize("voltage", [1e-4, 1e-3, 5e-3])
    def test_two_thirds_of_the_rise(self, voltage):
        """R_hot = R_cold (1 + 2/3 alpha (Tmax - T0)) to first order, for a resistivity linear in the temperature."""
        alpha = 3.9e-3
        rho = [[293, 1293], [1.7e-8, 1.7e-8 * (1 + 1000 * alpha)]]
        found = hot_spot(voltage, [293, 293], shape=SHAPE, resistivity=rho, lorenz=L)
        ratio = voltage / found.current / (2 * SHAPE * 1.7e-8)
        rise = found.hottest[0] - 293
        # the next order is the square of the rise over the temperature
        assert ratio - 1 == pytest.approx(2 / 3 * alpha * rise, rel=2 * alpha * rise)

    @pytest.mark.parametrize("bulk", [(293, 293), (320, 500)])
    def test_heat_and_hottest_place_do_not_depend_on_the_resistivity(self, bulk):
        """For lambda rho = L T they follow from voltage, current and bulks alone (Kohlrausch)."""
        found = spot(0.15, bulk, lorenz=L)
        cold = spot_heat(0.15, bulk, current=found.current, lorenz=L)
        assert found.heat == pytest.approx(cold.heat, rel=1e-11)
        assert found.hottest.max() == pytest.approx(cold.hottest, rel=1e-11)

    def test_no_current_without_a_voltage_and_heat_by_the_mean_conductivity(self):
        found = spot(0.0, [300, 380])
        assert found.current == 0
        low, high = np.interp([300, 380], *COPPER["lam"])
        assert found.heat == pytest.approx(np.array([1, -1]) * 80 * (low + high) / 2 / (2 * SHAPE), rel=1e-12)

    def test_constant_properties_resist_as_when_cold(self):
        rho, lam = (2e-8, 5e-8), (300.0, 90.0)
        found = hot_spot(0.05, [300, 340], shape=SHAPE, resistivity=rho, conductivity=lam)
        cold = spot_heat(0.05, [300, 340], conductance=1 / (SHAPE * sum(rho)), resistivity=rho,
                         heat_conductance=[x / SHAPE for x in lam])  # fmt: skip
        assert found.current == pytest.approx(0.05 / (SHAPE * sum(rho)), rel=1e-13)
        assert found.heat == pytest.approx(cold.heat, rel=1e-12)
        assert found.hottest.max() == pytest.approx(cold.hottest, rel=1e-13)


def by_differential_equations(voltage, bulk, first, second, film_resistance=0.0, film=0.0, lorenz=None):
    """Both constrictions as wires of unit cross-section and the length SHAPE: lambda T' = q, q' = -I^2 rho, by shooting."""

    def conduct(metal, temperature):
        rho = np.interp(temperature, *metal["rho"])
        return rho, lorenz * temperature / rho if lorenz else np.interp(temperature, *metal["lam"])

    def shoot(metal, start, heat, current):
        def slopes(_, y):
            rho, lam = conduct(metal, y[0])
            return [y[1] / lam, -(current**2) * rho, current * rho]

        kinks = [lambda _, y, at=at: y[0] - at for at in metal["rho"][0] + metal["lam"][0]]
        done = solve_ivp(slopes, (0, SHAPE), [start, heat, 0.0], rtol=1e-11, atol=1e-13, method="DOP853", events=kinks,
                         max_step=SHAPE / 50, dense_output=True)  # fmt: skip
        return done.y[:, -1], done.sol(np.linspace(0, SHAPE, 2001))[0].max()

    def ends(unknown):
        current, *heat = unknown * scale
        return current, [shoot(m, t, q, current) for m, t, q in zip((first, second), bulk, heat, strict=True)]

    def mismatch(unknown):
        current, ((one, _), (two, _)) = ends(unknown)
        through = one[1] - current**2 * film_resistance / 2
        return [
            (one[2] + two[2] + current * film_resistance) / voltage - 1,
            (one[0] - two[0] + film * through) / 300,
            (one[1] + two[1] - current**2 * film_resistance) / scale[1],
        ]

    cold = voltage / (
        SHAPE * sum(conduct(m, t)[0] for m, t in zip((first, second), bulk, strict=True)) + film_resistance
    )
    scale = np.array([cold, abs(cold * voltage), abs(cold * voltage)])
    solution = fsolve(mismatch, [0.8, 0.4, 0.4], xtol=1e-12)
    current, sides = ends(solution)
    return current, solution[1:] * scale[1:], [hottest for _, hottest in sides]


@pytest.mark.parametrize(
    ("voltage", "bulk", "way"),
    [
        (0.12, (293, 293), {}),
        (-0.12, (293, 420), {}),
        (0.25, (350, 300), dict(lorenz=L)),
        (0.1, (300, 340), dict(second=BRASS)),
        (0.15, (300, 500), dict(second=BRASS, film_resistance=1e-4, film_heat_conductance=0.05)),
        (0.2, (320, 300), dict(second=BRASS, lorenz=2.6e-8, film_resistance=3e-4)),
    ],
    ids=["one metal", "unequal bulks", "Wiedemann-Franz", "two metals", "film", "Wiedemann-Franz film"],
)
def test_differential_equations_of_any_metals(voltage, bulk, way):
    found = spot(voltage, bulk, **way)
    other = dict(way)
    film = other.pop("film_heat_conductance", None)
    first, second = COPPER, other.pop("second", COPPER)
    current, heat, hottest = by_differential_equations(
        voltage, bulk, first, second, film=1 / film if film else 0.0, **other
    )
    # the shooting has the kinks of the tables only within its steps
    assert found.current == pytest.approx(current, rel=2e-6)
    assert found.heat == pytest.approx(heat, rel=1e-5, abs=1e-5 * abs(current * voltage))
    assert found.hottest == pytest.approx(hottest, rel=1e-5)
    assert found.heat.sum() == pytest.approx(found.current * voltage, rel=1e-11)


@pytest.mark.parametrize("voltage", [0.0, 1e-5, 0.03, -0.2])
@pytest.mark.parametrize("bulk", [(293.4, 293.6), (310, 450)])
@pytest.mark.parametrize(
    "way",
    [
        {},
        dict(lorenz=L),
        dict(second=BRASS),
        dict(second=BRASS, film_resistance=2e-4, film_heat_conductance=0.05),
        dict(second=BRASS, lorenz=2.6e-8, film_resistance=2e-4),
    ],
    ids=["tables", "Wiedemann-Franz", "two metals", "film", "Wiedemann-Franz film"],
)
def test_derivatives(voltage, bulk, way):
    found = spot(voltage, bulk, **way)
    at = np.array([voltage, *bulk])
    scale = abs(spot(0.01, (293, 293), **way).current) / 0.01
    for column, h in enumerate([1e-6, 1e-3, 1e-3]):
        step = h * np.eye(3)[column]
        up, down = (spot(x[0], x[1:], **way) for x in (at + step, at - step))
        # central differences: h^2 over the square of the scale of the change, and round-off over h
        floor = {0: scale, 1: scale * 1e-4, 2: scale * 1e-4}[column]
        assert (up.current - down.current) / (2 * h) == pytest.approx(
            found.dcurrent[column], rel=1e-6, abs=1e-7 * floor
        )
        heat = (up.heat - down.heat) / (2 * h)
        assert heat == pytest.approx(found.dheat[:, column], rel=1e-6, abs=1e-6 * floor)
        hottest = (up.hottest - down.hottest) / (2 * h)
        assert hottest == pytest.approx(found.dhottest[:, column], rel=1e-5, abs=1e-5 if column else 1e-2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "conductivity or lorenz is needed"),
        (dict(conductivity=400.0, lorenz=L), "not both"),
        (dict(lorenz=L, temperature=[0, 300]), "temperature must be greater than 0 K"),
        (dict(conductivity=400.0, shape=0.0), "shape must be"),
        (dict(conductivity=-1.0), "the values of conductivity must be greater than 0|conductivity must be"),
        (dict(conductivity=400.0, film_resistance=-1.0), "film_resistance must not be negative"),
    ],
)
def test_refused(arguments, message):
    given = dict(voltage=0.1, temperature=[300, 300], shape=SHAPE, resistivity=1.7e-8) | arguments
    with pytest.raises(ValueError, match=message):
        hot_spot(**given)
