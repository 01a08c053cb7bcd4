"""Conduction of current and heat along wires, films and radiation on their sides, and what they store."""

import numpy as np
import pytest

from litz.kernels import conductor, conductor_heat, heat_capacity, wire_radiation

COPPER = dict(area=1e-6, conductivity=390.0, resistivity=1.7e-8)
OVER_TEMPERATURE = dict(
    area=2e-6,
    conductivity=[[200.0, 400.0, 900.0], [430.0, 390.0, 340.0]],
    resistivity=[[100.0, 300.0, 350.0, 1200.0], [0.35e-8, 1.7e-8, 2.1e-8, 9e-8]],
)
FILM = dict(film=2000.0, perimeter=3e-3, sink=290.0)
WIRES = {
    "constant": COPPER,
    "over temperature": OVER_TEMPERATURE,
    "film": COPPER | FILM,
    "thin film": COPPER | FILM | dict(film=1.0),
    "film over temperature": OVER_TEMPERATURE | FILM | dict(heat_fraction=0.7),
    "insulator": dict(area=1e-6, conductivity=[[250.0, 500.0], [0.2, 0.9]]) | FILM,
}
wires = pytest.mark.parametrize("wire", WIRES.values(), ids=WIRES)
STATES = [([0.02, -0.01], [310.0, 333.0]), ([0.0, 0.0], [290.0, 290.0]), ([-0.5, 0.3], [260.0, 700.0]),
          ([0.1, 0.0], [2000.0, 1500.0]), ([1e-3, 0.0], [80.0, 20.0])]  # fmt: skip
states = pytest.mark.parametrize(("v", "t"), STATES)


def tabulated(value, t):
    """A property at a temperature that may be complex."""
    if np.ndim(value) == 0:
        return value
    temperatures, values = map(np.asarray, value)
    i = np.clip(np.searchsorted(temperatures, t.real, side="right"), 1, len(values) - 1)
    slope = np.diff(values)[i - 1] / np.diff(temperatures)[i - 1]
    inside = temperatures[0] <= t.real < temperatures[-1]
    return values[i - 1] + slope * (t - temperatures[i - 1]) if inside else np.interp(t.real, temperatures, values)


def residual(q, length, *, area, conductivity, resistivity=None, heat_fraction=1.0, film=0.0, perimeter=0.0, sink=0.0):
    """R over V1, V2, T1, T2, which may be complex: as `sqrt(h P lambda A) [coth, -1/sinh]` with a film."""
    v, t = q[:2], q[2:]
    conductivity = tabulated(conductivity, t.mean())
    current = 0 if resistivity is None else area / (tabulated(resistivity, t.mean()) * length) * (v[0] - v[1])
    heat = heat_fraction * current * (v[0] - v[1])
    if film == 0:
        flow = conductivity * area / length * (t[0] - t[1])
        return np.array([current, -current, flow - heat / 2, -flow - heat / 2])
    ml = np.sqrt(film * perimeter / (conductivity * area)) * length
    root = np.sqrt(film * perimeter * conductivity * area)
    theta = t - sink - heat / length / (film * perimeter)
    # without an overflow
    coth, cosech = (1 + np.exp(-2 * ml)) / (1 - np.exp(-2 * ml)), 2 * np.exp(-ml) / (1 - np.exp(-2 * ml))
    q1 = root * (theta[0] * coth - theta[1] * cosech)
    q2 = root * (theta[1] * coth - theta[0] * cosech)
    return np.array([current, -current, q1, q2])


@wires
@states
# of those between, the film has a slope by its series and one in closed form
@pytest.mark.parametrize("length", [1e-4, 7.2e-4, 7.6e-4, 0.01, 0.3])
class TestConductor:
    def test_residual_and_tangent_by_a_complex_step(self, wire, v, t, length):
        found = conductor_heat(v, t, length, **wire)
        q = np.array([*v, *t], dtype=complex)
        expected = residual(q, length, **wire).real
        # the hyperbolic form cancels where little passes the film
        film = 1.0
        if "film" in wire:
            film += 390 * wire["area"] / (wire["film"] * wire["perimeter"] * length**2)
        scale = [abs(expected[:2]).max() + 1e-30] * 2 + [abs(expected[2:]).max() + abs(found.heat) + 1e-30] * 2
        assert (abs(found.R - expected) <= 1e-11 * film * np.array(scale) + 1e-13 * abs(found.K) @ abs(q)).all()
        for column in range(4):
            step = q.copy()
            step[column] += 1e-30j
            derivative = residual(step, length, **wire).imag / 1e-30
            np.testing.assert_allclose(
                found.K[:, column], derivative, rtol=1e-9 * film, atol=1e-11 * film * abs(found.K[:, column]).max()
            )

    def test_all_electric_power_is_heat_and_all_heat_arrives(self, wire, v, t, length):
        found = conductor_heat(v, t, length, **wire)
        power = found.R[:2] @ v
        assert found.heat == pytest.approx(wire.get("heat_fraction", 1) * power, rel=1e-14)
        assert found.film_heat == pytest.approx(
            found.heat + found.R[2:].sum(), rel=1e-13, abs=1e-13 * (abs(found.R[2:]).max() + abs(found.heat))
        )
        assert found.R[0] == found.current == -found.R[1]


class TestClosedForms:
    def test_without_heat_it_is_the_conductor(self):
        wire = conductor_heat([1e-3, 0], [300, 300], 1.0, **COPPER)
        plain = conductor(np.eye(3)[:2], [1e-3, 0], 1.0, area=1e-6, resistivity=1.7e-8)
        assert (wire.current, wire.heat) == pytest.approx((plain.current, plain.heat), rel=1e-15)

    @pytest.mark.parametrize("elements", [2, 4, 7])
    def test_joule_heat_between_cold_ends_is_a_parabola_at_the_nodes(self, elements):
        """T - T0 = V^2/(2 lambda rho) s (1 - s), exact on every mesh."""
        s = np.linspace(0, 1, elements + 1)
        volt = 0.05
        rise = volt**2 / (2 * 390 * 1.7e-8) * s * (1 - s)
        total = chain(volt * s, 300 + rise, 0.1 / elements, **COPPER)
        assert np.abs(total[1, 1:-1]).max() < 1e-12 * 390e-6 / (0.1 / elements) * 300
        # half of the power leaves through either end
        assert total[1, [0, -1]] == pytest.approx([-(volt**2) / (1.7e-8 * 0.1 / 1e-6) / 2] * 2, rel=1e-10)

    @pytest.mark.parametrize("elements", [1, 4])
    @pytest.mark.parametrize("volt", [0.0, 0.05])
    def test_a_fin_with_joule_heat(self, elements, volt):
        """Temperature of a fin with one end at 400 K, the other insulated, by its differential equation."""
        length, around = 0.1, 290.0
        wire = COPPER | FILM | dict(film=40.0)
        m = np.sqrt(40.0 * 3e-3 / 390e-6)
        x = np.linspace(0, length, elements + 1)
        rise = (volt / length) ** 2 / 1.7e-8 * 1e-6 / (40.0 * 3e-3)
        t = around + rise + (400 - around - rise) * np.cosh(m * (length - x)) / np.cosh(m * length)
        total = chain(volt * x / length, t, length / elements, **wire)
        expected = 390e-6 * m * (400 - around - rise) * np.tanh(m * length)
        assert total[1, 0] == pytest.approx(expected, rel=1e-11)
        assert np.abs(total[1, 1:]).max() < 1e-12 * 390e-6 / (length / elements) * 400

    def test_conductivity_linear_in_temperature_by_kirchhoffs_variable(self):
        """int lambda dT is linear between ends without a source."""
        conductivity = np.array([[200.0, 600.0], [100.0, 500.0]])
        # lambda = T - 100
        kirchhoff = np.linspace(300**2 / 2 - 100 * 300, 500**2 / 2 - 100 * 500, 5)
        t = 100 + np.sqrt(100**2 + 2 * kirchhoff)
        total = chain(np.zeros(5), t, 0.025, area=1e-6, conductivity=conductivity)
        assert np.abs(total[1, 1:-1]).max() < 1e-13
        assert total[1, 4] == pytest.approx((kirchhoff[-1] - kirchhoff[0]) * 1e-6 / 0.1, rel=1e-13)


def chain(v, t, length, **wire):
    """Sums of currents and heat that leave the nodes of a wire (2, nodes)."""
    total = np.zeros((2, len(t)))
    for i in range(len(t) - 1):
        total[:, i : i + 2] += conductor_heat(v[i : i + 2], t[i : i + 2], length, **wire).R.reshape(2, 2)
    return total


class TestFilmOnAnyMesh:
    @pytest.mark.parametrize("length", [1e-6, 1e-2, 1.0, 1e3])
    def test_no_temperature_leaves_the_range_of_those_around_it(self, length):
        """The entries beside the diagonal are not positive, however coarse the mesh."""
        k = conductor_heat([0, 0], [300, 400], length, **COPPER, **FILM).K[2:, 2:]
        # to round-off where an element is so long that its nodes do not feel each other
        assert (k[[0, 1], [1, 0]] <= 1e-15 * k[0, 0]).all()
        assert k.sum() > 0

    def test_a_long_element_loses_all_that_it_makes_to_its_surroundings(self):
        wire = conductor_heat([1.0, 0], [290, 290], 1e4, **COPPER, **FILM)
        assert wire.film_heat == pytest.approx(wire.heat, rel=1e-5)


PIPE = dict(perimeter=3e-3, emissivity=0.8, surroundings=293.0)


class TestRadiation:
    def test_stefan_boltzmann(self):
        heat = wire_radiation([800, 800], 0.2, **PIPE).R
        assert heat.sum() == pytest.approx(0.8 * 5.670374419e-8 * 3e-3 * 0.2 * (800**4 - 293**4), rel=1e-14)

    def test_each_node_has_half(self):
        hot, cold = wire_radiation([800, 293], 0.2, **PIPE).R
        assert cold == 0
        assert hot == pytest.approx(wire_radiation([800, 800], 0.1, **PIPE).R.sum(), rel=1e-14)

    def test_tangent_by_a_complex_step(self):
        t = np.array([450.0, 1200.0])
        factor = 0.8 * 5.670374419e-8 * 3e-3 * 0.2 / 2
        derivative = (factor * ((t + 1e-30j) ** 4 - 293**4)).imag / 1e-30
        assert pytest.approx(np.diag(derivative), rel=1e-14) == wire_radiation(t, 0.2, **PIPE).K

    def test_temperatures_in_degrees_celsius(self):
        celsius = wire_radiation([526.85, 20], 0.2, perimeter=3e-3, emissivity=0.8, surroundings=19.85,
                                 absolute_zero=-273.15)  # fmt: skip
        kelvin = wire_radiation([800, 293.15], 0.2, **PIPE)
        assert pytest.approx(kelvin.R, rel=1e-12) == celsius.R
        assert pytest.approx(kelvin.K, rel=1e-12) == celsius.K


SOLID = dict(area=1e-6, density=8000.0, time=0.5)
TABLE = np.array([[200.0, 300.0, 500.0], [300.0, 400.0, 350.0]])
MELTING = ((2e5, 400.0, 420.0), (5e4, 450.0, 451.0))


class TestCapacity:
    def test_constant_specific_heat(self):
        taken = heat_capacity([350, 300], [300, 310], 0.2, **SOLID, specific_heat=400.0).R
        assert taken == pytest.approx(8000 * 1e-6 * 0.2 / 0.5 * 400 * np.array([25, -5]), rel=1e-14)

    @pytest.mark.parametrize(("before", "after"), [(100.0, 700.0), (250.0, 260.0), (410.0, 250.0), (415.0, 460.0)])
    def test_energy_does_not_depend_on_the_increments(self, before, after):
        def taken(start, end):
            return heat_capacity([end, start], [start, start], 0.2, **SOLID, specific_heat=TABLE,
                                 latent_heat=MELTING).R[0]  # fmt: skip

        steps = np.linspace(before, after, 18)
        assert sum(map(taken, steps[:-1], steps[1:])) == pytest.approx(taken(before, after), rel=1e-13)

    def test_integral_of_the_table(self):
        # trapezoids: 100 K at 300, 350 and 375 J/(kg K) on the mean, 100 K at 350 behind its end, the latent heats
        expected = 100 * 300 + 100 * 350 + 200 * 375 + 100 * 350 + 2.5e5
        taken = heat_capacity([600, 0], [100, 0], 0.2, **SOLID, specific_heat=TABLE, latent_heat=MELTING)
        assert taken.R[0] == pytest.approx(expected * 8000 * 1e-6 * 0.1 / 0.5, rel=1e-14)
        assert taken.R[1] == 0

    @pytest.mark.parametrize("t", [150.0, 230.0, 310.0, 405.0, 450.5, 800.0])
    def test_slope(self, t):
        """The enthalpy is quadratic between the kinks: central differences are exact."""

        def at(t):
            return heat_capacity([t, t], [200, 600], 0.2, **SOLID, specific_heat=TABLE, latent_heat=MELTING)

        numeric = (at(t + 0.1).R - at(t - 0.1).R) / 0.2
        assert np.diag(at(t).K) == pytest.approx(numeric, rel=1e-9)
        assert np.count_nonzero(at(t).K) == 2

    def test_a_small_change_is_seen_to_its_last_digit(self):
        taken = heat_capacity([300 + 1e-10, 300], [300, 300], 0.2, **SOLID, specific_heat=TABLE).R[0]
        assert taken == pytest.approx((300 + 1e-10 - 300) * 400 * 8000 * 1e-6 * 0.1 / 0.5, rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (dict(temperature=[1]), r"temperature must have shape \(2,\)"),
        (dict(length=0), "length must be greater than 0"),
        (dict(area=-1), "area must be greater than 0"),
        (dict(conductivity=0), "conductivity must be greater than 0"),
        (dict(conductivity=[[1, 2], [1, 0]]), "the values of conductivity must be greater than 0"),
        (dict(resistivity=[[2, 1], [1, 1]]), "the temperatures of resistivity must ascend"),
        (dict(resistivity=[[1, 2]]), r"resistivity must be a number or have shape \(2, n\)"),
        (dict(heat_fraction=1.1), "heat_fraction must be from 0 to 1"),
        (dict(film=-1), "film must not be negative"),
        (dict(sink=np.nan), "sink must be finite"),
    ],
)
def test_conductor_refuses(changes, words):
    with pytest.raises(ValueError, match=words):
        conductor_heat(**(dict(v=[0, 0], temperature=[300, 300], length=1) | COPPER | changes))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (dict(temperature=[300, -1]), "temperature must not be below absolute zero"),
        (dict(surroundings=-1), "surroundings must not be below absolute zero"),
        (dict(emissivity=2), "emissivity must be from 0 to 1"),
        (dict(perimeter=0), "perimeter must be greater than 0"),
    ],
)
def test_radiation_refuses(changes, words):
    with pytest.raises(ValueError, match=words):
        wire_radiation(
            **(dict(temperature=[300, 300], length=1, perimeter=1, emissivity=1, surroundings=300) | changes)
        )


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (dict(time=0), "time must be greater than 0"),
        (dict(density=0), "density must be greater than 0"),
        (dict(latent_heat=[[1, 2]]), r"latent_heat must have shape"),
        (dict(latent_heat=[[1, 3, 2]]), "the liquidus must be above the solidus"),
    ],
)
def test_capacity_refuses(changes, words):
    good = dict(temperature=[300, 300], before=[300, 300], length=1, area=1, density=1, specific_heat=1, time=1)
    with pytest.raises(ValueError, match=words):
        heat_capacity(**(good | changes))
