"""Temperatures over time: what the equations give in closed form, how large the increments are, and what is refused."""

import numpy as np
import pytest

from litz import report
from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

LENGTH, RADIUS, ROOM = 0.1, 0.5e-3, 300.0
AREA = np.pi * RADIUS**2
LAMBDA, RHO, SLOPE, DENSITY, HEAT = 390.0, 1.72e-8, 4e-3, 8960.0, 385.0
DIFFUSIVITY = LAMBDA / (DENSITY * HEAT)
#: Resistivity linear in the temperature
SIGMA = "\n".join(f"{1 / (RHO * (1 + SLOPE * (t - ROOM))):.17g}, {t:.17g}" for t in (100.0, 1e7))
STORED = f"*DENSITY\n{DENSITY}\n*SPECIFIC HEAT\n{HEAT}\n"


def deck(increments, *, elements=10, length=LENGTH, heat="", amperes=0.0, loads="", material=STORED, sigma=f"{1 / RHO:.17g}",
         procedure="*COUPLED THERMAL-ELECTRICAL", step="", model="", later=""):  # fmt: skip
    """A wire along x, insulated unless `heat` says otherwise, with a current through it."""
    nodes = "\n".join(f"{i + 1}, {x:.17g}, 0, 0" for i, x in enumerate(np.linspace(0, length, elements + 1)))
    members = "\n".join(f"{i}, {i}, {i + 1}" for i in range(1, elements + 1))
    fed = f"*CECURRENT\n1, , {amperes:.17g}\n" if amperes else ""
    return f"""\
*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=B33, ELSET=WIRE
{members}
*MATERIAL, NAME=COPPER
*ELASTIC
1.2e11, 0.34
*EXPANSION
17e-6
*ELECTRICAL CONDUCTIVITY
{sigma}
*CONDUCTIVITY
{LAMBDA}
{material}*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC
{RADIUS}
*NSET, NSET=ENDS
1, {elements + 1}
*BOUNDARY
1, ENCASTRE
{elements + 1}, 9
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {ROOM}
{model}*STEP, INC=10000
{procedure}
{increments}
{step}{heat}{fed}{loads}*NODE PRINT, NSET=ALL
NT, RFL
*END STEP
{later}"""


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


class TestClosedForms:
    @pytest.mark.slow
    def test_a_bar_whose_ends_are_heated_at_once(self, run):
        """The Fourier series, at a time when three of its terms count; second order in increments and elements."""
        time = 0.1 * LENGTH**2 / DIFFUSIVITY
        errors = []
        for n in (16, 32):
            results = run(f"{time / n**2:.17g}, {time:.17g}", elements=n, heat="*BOUNDARY\nENDS, 11, 11, 400\n")
            x = np.linspace(0, 1, n + 1)
            odd = np.arange(1, 30, 2)[:, None]
            rest = (4 / (np.pi * odd) * np.sin(np.pi * odd * x) * np.exp(-((np.pi * odd) ** 2) * 0.1)).sum(0)
            errors.append(abs(results.field("temperature") - (400 - 100 * rest)).max())
        assert errors[0] < 0.5
        # the first increment follows the jump by backward Euler: its part falls faster
        assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)

    def test_a_wire_that_heats_up_without_losses(self, run):
        """T - T0 = (exp(a k t) - 1)/a with k = I^2 rho0/(A^2 rho_m c): the formula of Onderdonk for the time of melting."""
        amperes, melting = 200.0, 1358.0
        rate = amperes**2 * RHO / (AREA**2 * DENSITY * HEAT)
        time = np.log(1 + SLOPE * (melting - ROOM)) / (SLOPE * rate)
        errors = []
        for n in (50, 100):
            results = run(f"{time / n:.17g}, {time:.17g}", elements=2, amperes=amperes, sigma=SIGMA)
            temperature = results.field("temperature")
            assert np.ptp(temperature) < 1e-6
            errors.append(abs(temperature[0] - melting))
        # (a k dt)^2/3 of the slope at the end, with a k dt = 0.017, over one rise of e
        assert errors[1] < 1e-3 * (melting - ROOM)
        assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)

    def test_a_wire_that_a_film_cools(self, run):
        """exp(-h P t/(rho_m c A)), with increments of the same size."""
        film, around = 40.0, 250.0
        decay = film * 2 / (RADIUS * DENSITY * HEAT)
        errors = []
        for n in (10, 20, 40):
            results = run(f"{1 / (decay * n):.17g}, {1 / decay:.17g}", elements=20, length=1e-3,
                          loads=f"*FILM\nWIRE, F, {around}, {film}\n")  # fmt: skip
            errors.append(abs(results.field("temperature").mean() - around - (ROOM - around) * np.exp(-1)))
        assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
        assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)
        assert errors[2] < 1e-4 * (ROOM - around)

    @pytest.mark.parametrize("elements", [1, 2, 50])
    def test_a_film_cools_on_any_mesh(self, run, elements):
        """Also where its heat would have to flow far along an element: all of the wire has the same temperature."""
        film, around, steps = 5000.0, 250.0, 40
        decay = film * 2 / (RADIUS * DENSITY * HEAT)
        power = 60.0**2 * RHO / AREA / (film * 2 * np.pi * RADIUS)
        results = run(f"{1 / (decay * steps):.17g}, {1 / decay:.17g}", elements=elements, amperes=60.0,
                      loads=f"*FILM\nWIRE, F, {around}, {film}\n")  # fmt: skip
        temperature = results.field("temperature")
        exact = around + power + (ROOM - around - power) * np.exp(-1)
        # of the increments alone: less than 1/2 (1/40)^2
        np.testing.assert_allclose(temperature, exact, atol=(ROOM - around) / 2 / steps**2)
        np.testing.assert_allclose(temperature, temperature[0], rtol=1e-9)

    @pytest.mark.parametrize("share", [0.3, 0.9, 1.4])
    @pytest.mark.parametrize("n", [3, 20])
    def test_a_wire_that_melts_under_an_even_power(self, run, share, n):
        """The enthalpy is that of the heat, however few increments: before, within and after the change of phase."""
        latent, solidus, liquidus, amperes = 2.05e5, 350.0, 351.0, 200.0
        rate = amperes**2 * RHO / (AREA**2 * DENSITY)
        start, end = HEAT * (solidus - ROOM), HEAT * (liquidus - ROOM) + latent
        wanted = share * start if share < 0.5 else (share * (start + end) / 2 if share < 1 else share * end)
        expected = np.interp(wanted, [0, start, end, end + HEAT * 1e4], [ROOM, solidus, liquidus, liquidus + 1e4])
        results = run(f"{wanted / rate / n:.17g}, {wanted / rate:.17g}", elements=3, amperes=amperes,
                      material=STORED + f"*LATENT HEAT\n{latent}, {solidus}, {liquidus}\n")  # fmt: skip
        np.testing.assert_allclose(results.field("temperature"), expected, rtol=1e-8)

    @pytest.mark.slow
    def test_it_ends_where_a_steady_step_does(self, run):
        heat = "*BOUNDARY\nENDS, 11, 11, 300\n"
        long = run(f"0.5, {5 * LENGTH**2 / DIFFUSIVITY:.17g}", heat=heat, amperes=30.0, sigma=SIGMA).field(
            "temperature"
        )
        steady = run("1., 1.", heat=heat, amperes=30.0, sigma=SIGMA,
                     procedure="*COUPLED THERMAL-ELECTRICAL, STEADY STATE").field("temperature")  # fmt: skip
        np.testing.assert_allclose(long, steady, atol=1e-9 * (steady.max() - ROOM))

    @pytest.mark.slow
    def test_what_is_made_leaves_or_is_stored(self, run, tmp_path):
        """At every increment; and all that has been stored is the enthalpy, but for what BDF2 takes for the last rates."""
        end = 0.05
        results = run(f"{end / 50:.17g}, {end:.17g}", heat="*BOUNDARY\nENDS, 11, 11, 300\n", amperes=200.0,
                      loads="*FILM\nWIRE, F, 290, 40\n*EL PRINT, ELSET=WIRE, TOTALS=ONLY\nQSTORE\n")  # fmt: skip
        made, sides, stored = (
            results.field(name, increment=None)[1:].sum(1) for name in ("joule_heat", "surface_heat", "stored_heat")
        )
        ends = -results.field("reaction_heat", increment=None)[1:].sum(1)
        np.testing.assert_allclose(stored, made - sides - ends, rtol=1e-7)
        np.testing.assert_allclose(results.history["QSTORE sum WIRE"][1:], stored, rtol=1e-9)
        temperature = results.field("temperature")
        mean = (temperature[1:] + temperature[:-1]).mean() / 2
        enthalpy = DENSITY * HEAT * AREA * LENGTH * (mean - ROOM)
        assert np.trapezoid(np.r_[made[0], stored], results.times) == pytest.approx(enthalpy, rel=2e-3)
        assert f"heat stored            {stored[-1]:12.5g}" in results.summary()
        page = report(results, tmp_path / "report.html").read_text(encoding="utf-8")
        assert "heat stored in the wires" in page

    def test_motions_follow(self, run):
        """A wire that is free to lengthen, over time."""
        results = run("0.1, 1.", amperes=100.0, procedure="*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL")
        rise = 100.0**2 * RHO / (AREA**2 * DENSITY * HEAT)
        np.testing.assert_allclose(results.field("temperature") - ROOM, rise, rtol=1e-9)
        assert results.field("displacement")[-1, 0] == pytest.approx(17e-6 * rise * LENGTH, rel=1e-9)


def stored_by_nodes(results, length):
    """In each increment; those at the ends have half of an element (increments, nodes) [J]."""
    changes = np.diff(results.field("temperature", increment=None), axis=0)
    elements = np.r_[0.5, np.ones(changes.shape[1] - 2), 0.5]
    return DENSITY * HEAT * AREA * length / elements.sum() * elements * changes


class TestHeatThatEntersAtPrescribedTemperatures:
    """Its sum over the increments is what is stored, but for half of what BDF2 takes of free nodes for their last rate."""

    @pytest.mark.parametrize("increment", [0.002, 0.01])
    def test_that_of_a_jump(self, run, increment):
        results = run(f"{increment}, 0.1", length=0.02, heat="*BOUNDARY\n1, 11, 11, 400\n")
        entering, stored = results.history["RFL node 1"][1:], stored_by_nodes(results, 0.02)
        free = stored[:, 1:].sum(1)
        assert entering.sum() * increment == pytest.approx(stored.sum() + (free[-1] - free[0]) / 2, rel=1e-9)
        # the first one has the jump of the node itself; from then on heat flows in, ever less of it
        assert entering[0] * increment > stored[0, 0] == stored[:, 0].sum()
        assert np.diff(entering[1:])[1:].max() < 0 < entering.min()

    def test_of_an_amplitude_with_corners(self, run):
        """Insulated and of one temperature: heat enters as long as it rises, and none from then on."""
        model = "*AMPLITUDE, NAME=RISE\n0, 0.75, 0.1, 1, 1, 1\n"
        results = run("0.02, 0.2", elements=1, model=model, heat="*BOUNDARY, AMPLITUDE=RISE\nENDS, 11, 11, 400\n")
        entering = results.field("reaction_heat", increment=None)[1:].sum(1)
        power = DENSITY * HEAT * AREA * LENGTH * 100 / 0.1
        np.testing.assert_allclose(entering, np.repeat([power, 0], 5), rtol=1e-9, atol=1e-9 * power)

    def test_of_a_node_that_an_equation_makes_follow(self, run):
        model = "*EQUATION\n2\n2, 11, 1., 1, 11, -1.\n"
        results = run("0.01, 0.05", elements=1, model=model, heat="*BOUNDARY\n1, 11, 11, 400\n")
        heat = DENSITY * HEAT * AREA * LENGTH * 100
        np.testing.assert_allclose(results.history["RFL node 1"][1:] * 0.01, [heat, 0, 0, 0, 0], atol=1e-9 * heat)

    def test_an_equation_between_one_that_jumps_and_a_free_one(self, run):
        """T2 = (T1 + T3)/2: what the jump stores in the middle comes from either end, and nothing flows so soon."""
        model = "*EQUATION\n3\n2, 11, 2., 1, 11, -1., 3, 11, -1.\n"
        results = run("1e-6, 1e-5", elements=2, model=model, heat="*BOUNDARY\n1, 11, 11, 400\n")
        np.testing.assert_allclose(results.history["NT node 3"][1:], ROOM - 100 / 3, atol=1e-3)


class TestIncrements:
    def test_no_temperature_changes_by_more_than_deltmx(self, run):
        results = run("0.001, 10., 1e-6", heat="*BOUNDARY\nENDS, 11, 11, 400\n",
                      procedure="*COUPLED THERMAL-ELECTRICAL, DELTMX=5.")  # fmt: skip
        history = results.field("temperature", increment=None)
        assert np.abs(np.diff(history[:, 1:-1], axis=0)).max() <= 5.0
        # they grow as the temperatures even out
        assert results.status["time_increment"][-3] > 20 * results.status["time_increment"][0]

    def test_without_it_they_are_all_of_the_same_size(self, run):
        results = run("0.1, 1.", amperes=10.0)
        np.testing.assert_allclose(results.status["time_increment"], 0.1, rtol=1e-12)

    @pytest.mark.slow
    def test_a_run_goes_on_from_every_increment(self, litz, tmp_path):
        text = deck("0.3, 2., 1e-4", heat="*BOUNDARY\nENDS, 11, 11, 320\n", amperes=60.0, sigma=SIGMA, step=KEEP_ALL,
                    procedure="*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, DELTMX=9.")  # fmt: skip
        assert_goes_on_from_everywhere(litz, tmp_path, text)


class TestWhatIsRefused:
    def test_materials_that_store_no_heat(self, refused):
        for material in ("", f"*DENSITY\n{DENSITY}\n", f"*SPECIFIC HEAT\n{HEAT}\n"):
            assert (
                "the material COPPER conducts heat; in a step without STEADY STATE it needs *DENSITY and *SPECIFIC HEAT"
                in refused(1, "0.1, 1.", material=material)
            )

    def test_a_limit_of_changes_that_nothing_asks_for(self, refused):
        for flags in ("STEADY STATE, DELTMX=5.", "DIRECT, DELTMX=5."):
            assert "DELTMX chooses the increments of steps over time" in refused(
                1, "0.1, 1.", procedure=f"*COUPLED THERMAL-ELECTRICAL, {flags}"
            )

    def test_changes_of_phase_that_do_not_ascend(self, refused):
        message = refused(1, "0.1, 1.", material=STORED + "*LATENT HEAT\n1e5, 400, 399\n1e5, 500, 501\n1e5, 450, 460\n")
        assert "the liquidus must be above the solidus; 399 follows 400" in message
        assert "450 is below the liquidus of the one before, 501" in message

    def test_two_of_a_kind(self, refused):
        message = refused(1, "0.1, 1.", material=2 * (STORED + "*LATENT HEAT\n1e5, 400, 401\n"))
        for keyword in ("DENSITY", "SPECIFIC HEAT", "LATENT HEAT"):
            assert f"the material COPPER has two *{keyword}" in message


def test_a_current_that_is_switched_off_ends_at_zero(run):
    """Its last digits fall by a factor of round-off in each increment, down to where numbers end."""
    switched = "*CECURRENT, AMPLITUDE=OFF\n1, , 350.\n"
    amplitude = "*AMPLITUDE, NAME=OFF\n0, 1, 0.1, 1, 0.100001, 0, 2, 0\n"
    results = run("0.01, 0.8", loads=switched, model=amplitude)
    assert not results.warnings
    assert np.abs(results.field("element_current")).max() < 1e-100
    hot = results.history["NT node 1"]
    assert hot[-1] == pytest.approx(hot[results.times > 0.1001][0], rel=1e-12)
    assert hot[-1] == pytest.approx(ROOM + 0.1 * 350.0**2 * RHO / AREA**2 / (DENSITY * HEAT), rel=2e-3)
