"""Wires with superconducting filaments: *SUPERCONDUCTOR against the law solved by other means."""

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve

from decks import straight, wire
from litz.kernels import nb3sn, nbti
from run_of_deck import refusal_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

RADIUS, LENGTH, SIGMA, N, EC = 0.4e-3, 0.03, 5e9, 30, 1e-4
AREA = np.pi * RADIUS**2
#: Copper to non-copper, and the part of the latter
RATIO = 1.5
PART = 1 / (1 + RATIO)
TABLE = f"*SUPERCONDUCTOR, N={N}, RATIO={RATIO}\n 2e9\n"
NB3SN = dict(C=7.5e10, Bc20=32.97, Tc0=16.06, p=0.63, q=2.1, Ca1=44.48, Ca2=4.0, e0=2.56e-3, em=0.5e-3)
NBTI = dict(jref=3e9, C0=27.04, Bc20=14.5, Tc0=9.2, alpha=0.57, beta=0.9, gamma=2.32)


def fit(law, parameters, options=""):
    return f"*SUPERCONDUCTOR, LAW={law}, N={N}, RATIO={RATIO}{options}\n {', '.join(map(str, parameters.values()))}\n"


def deck(superconductor=TABLE, cards="", static="1, 1, 1e-3, 1", elements=3, model="", conductivity=f"{SIGMA}", material="",
         procedure="*STATIC", outputs="*EL PRINT, ELSET=WIRE\n SC\n", held="1, ENCASTRE\n 1, 9"):  # fmt: skip
    """A wire along x, clamped and earthed at its first node."""
    return (
        "*UNITS, SYSTEM=SI\n"
        + wire("WIRE", straight((0, 0, 0), (LENGTH, 0, 0), elements), element="B33")
        + f"*MATERIAL, NAME=STRAND\n*ELASTIC\n 100e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n {conductivity}\n{superconductor}{material}"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=STRAND, SECTION=CIRC\n {RADIUS}\n*BOUNDARY\n {held}\n{model}"
        f"*STEP, INC=200\n{procedure}\n {static}\n{cards}\n{outputs}*END STEP\n"
    )


def finished(run, text, *arguments, name="deck"):
    process, results = run(text, *arguments, name=name)
    assert process.returncode == 0, process.stderr
    return results


def fed(current, node=4):
    """A current that flows along x."""
    return f"*CECURRENT\n {node}, , {-current}\n"


def field_of(current, critical, resistivity=1 / SIGMA):
    """E of the parallel law, by bisection of its logarithm."""
    j, s = current / AREA, (1 - PART) / resistivity
    excess = lambda x: np.logaddexp(np.log(s) + x, np.log(PART * critical) + (x - np.log(EC)) / N) - np.log(j)  # noqa: E731
    return np.exp(brentq(excess, -700, 50, xtol=1e-14, rtol=1e-14))


@pytest.mark.parametrize("solver", ["", "*SOLVER, NAME=UMFPACK\n", "*SOLVER, NAME=SKYLINE\n"])
def test_the_i_v_curve_is_that_of_the_parallel_law_over_twelve_decades(run, solver):
    """From deep in the superconducting state to where the metal carries most; the current is imposed."""
    results = finished(run, deck(cards=fed(760.0) + solver, static="0.02, 1, 1e-5, 0.02"))
    currents = results.field("element_current", None)[1:, 1]
    np.testing.assert_allclose(currents, 760 * results.times[1:], rtol=1e-7)
    exact = np.array([field_of(i, 2e9) for i in currents])
    field = results.field("electric_field", None)[1:, 1]
    assert exact.max() / exact.min() > 1e30
    # n times the tolerance of the current, 1e-8
    np.testing.assert_allclose(field, exact, rtol=1e-6)
    # the voltage has a resistance of 1e-9 of the metal in series
    whole = exact + 1e-9 / SIGMA * currents / AREA
    voltage = -results.field("potential", None)[1:, 3]
    top = exact > 1e-12 * exact.max()
    assert top.sum() >= 25
    np.testing.assert_allclose(voltage[top] / LENGTH, whole[top], rtol=1e-6)
    np.testing.assert_allclose(results.field("critical_current")[0], PART * 2e9 * AREA, rtol=1e-12)
    np.testing.assert_allclose(
        results.field("critical_fraction", None)[1:, 0], currents / (PART * 2e9 * AREA), rtol=1e-6
    )
    np.testing.assert_allclose(results.field("joule_heat_per_length", None)[1:, 2], currents * field, rtol=1e-7)


@pytest.mark.parametrize("voltage", [1e-9, 3e-6, 1e-2])
def test_a_voltage_drives_the_current_of_the_law(run, voltage):
    """Far below and far above the critical current, from a state without current; one element has no free potential."""
    exact = AREA * ((1 - PART) * SIGMA * voltage / LENGTH + PART * 2e9 * (voltage / LENGTH / EC) ** (1 / N))
    for elements in (1, 3):
        results = finished(run, deck(cards=f"*BOUNDARY\n {elements + 1}, 9, 9, {-voltage}", elements=elements))
        # a voltage of 3e-8 V/m over that of the series resistance, 4e-10 V/m, by 1/n
        np.testing.assert_allclose(results.field("element_current"), exact, rtol=1e-3)
        np.testing.assert_allclose(results.field("reaction_current")[0], exact, rtol=1e-3)


def test_newton_needs_few_iterations_and_converges_quadratically(run, tmp_path):
    """Two unlike strands that are soldered at both ends: what each carries is found together with the voltage."""
    other = wire("OTHER", straight((0, 0.01, 0), (LENGTH, 0.01, 0), 3), first=11, element="B33")
    better = (
        f"*MATERIAL, NAME=BETTER\n*ELASTIC\n 100e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n{TABLE.replace('2e9', '3e9')}"
        f"*BEAM SECTION, ELSET=OTHER, MATERIAL=BETTER, SECTION=CIRC\n {RADIUS}\n*EQUATION\n 2\n 14, 9, 1., 4, 9, -1.\n"
    )
    held = "1, ENCASTRE\n 1, 9\n 11, ENCASTRE\n 11, 9"
    text = deck(cards=fed(900.0), static="1, 1", held=held).replace("*MATERIAL", other + "*MATERIAL", 1)
    text = text.replace("*BOUNDARY", better + "*BOUNDARY", 1)
    results = finished(run, text)
    shares = results.field("element_current")[[0, 3]]
    exact = fsolve(
        lambda x: [field_of(x[0], 2e9) / field_of(x[1], 3e9) - 1, x.sum() - 900], np.array([350.0, 550.0]), xtol=1e-13
    )
    # the resistance in series, 1e-9 of the metal
    np.testing.assert_allclose(shares, exact, rtol=1e-6)
    lines = [line.split() for line in (tmp_path / "deck" / "deck.cvg").read_text().splitlines()]
    residual = np.array([float(line[lines[0].index("current[A]")]) for line in lines[1:]]) / 900
    assert len(residual) <= 12
    near = [k for k in range(len(residual) - 1) if 1e-6 < residual[k] < 1e-2]
    assert near
    assert all(residual[k + 1] < N * residual[k] ** 2 for k in near)


@pytest.mark.parametrize("strain", [-6e-3, -2e-3, 3e-3])
def test_the_critical_current_follows_the_strain_of_the_beam(run, strain):
    """Strain of cool-down (STRAIN) and of the beam (a prescribed length) add up."""
    results = finished(
        run,
        deck(
            fit("NB3SN", NB3SN, ", FIELD=12, STRAIN=-1e-3"),
            cards=fed(20.0) + f"*BOUNDARY\n 4, 1, 1, {(strain + 1e-3) * LENGTH}",
            model="*INITIAL CONDITIONS, TYPE=TEMPERATURE\n WIRE, 4.2\n",
        ),
    )
    # strains of 0.5 % by the element's own measure, exact for a straight stretch
    exact = PART * AREA * nb3sn(4.2, 12.0, strain, **NB3SN).value
    np.testing.assert_allclose(results.field("critical_current"), exact, rtol=1e-6)


def test_the_flux_density_is_that_of_lorentz_in_the_middle_of_each_element(run):
    """In a step with *LORENTZ; its norm, of a field that changes along the wire."""
    text = deck(
        fit("NB3SN", NB3SN, ", FIELD=2"), cards=fed(1.0) + "*LORENTZ\n WIRE, 0, 3, 4, 0, 0, 100, 0, 0, 0, 0, 0, 0"
    )
    results = finished(run, text.replace("100e9, 0.3", "1e15, 0.3"))
    x = results.positions(-1)[:, 0]
    field = np.hypot(3, 4 + 100 * (x[1:] + x[:-1]) / 2)
    exact = [PART * AREA * nb3sn(0.0, b, 0.0, **NB3SN).value for b in field]
    np.testing.assert_allclose(results.field("critical_current"), exact, rtol=1e-6)


def test_the_current_sharing_temperature_is_where_the_current_is_the_critical_one(run):
    """A slow rise of the temperature at a constant current: E passes Ec where the filaments carry Ic(T)."""
    current, steps = 120.0, 40
    cards = fed(current) + "*TEMPERATURE\n WIRE, 8.0"
    text = deck(fit("NB3SN", NB3SN, ", FIELD=12"), cards=cards, static=f"{1 / steps}, 1, 1e-5, {1 / steps}",
                model="*INITIAL CONDITIONS, TYPE=TEMPERATURE\n WIRE, 4.2\n")  # fmt: skip
    text = text.replace("*STEP, INC=200\n", "*AMPLITUDE, NAME=SOON\n 0, 0, 0.025, 1, 1, 1\n*STEP, INC=200\n", 1)
    text = text.replace("*CECURRENT\n", "*CECURRENT, AMPLITUDE=SOON\n")
    results = finished(run, text)
    temperature = 4.2 + 3.8 * results.times[1:]
    field = results.field("electric_field", None)[1:, 1]
    exact = [field_of(current, nb3sn(t, 12.0, 0.0, **NB3SN).value) for t in temperature]
    np.testing.assert_allclose(field, exact, rtol=1e-5)
    # where the filaments alone would carry the current at Ec, less what the metal takes
    carried = current - AREA * (1 - PART) * SIGMA * EC
    sharing = brentq(lambda t: PART * AREA * nb3sn(t, 12.0, 0.0, **NB3SN).value - carried, 4.2, 8.0)
    measured = np.interp(np.log(EC), np.log(field), temperature)
    # linear in ln E between two points 0.095 K apart
    assert measured == pytest.approx(sharing, abs=2e-3)


def test_heat_and_current_are_found_together(run):
    """A wire cooled by a film along its length has one temperature: E(I, T) I = h P (T - Ts)."""
    film, sink = 600.0, 4.5
    current = 0.98 * PART * AREA * nbti(sink, 5.0, **NBTI).value
    text = deck(
        fit("NBTI", NBTI, ", FIELD=5"),
        material="*CONDUCTIVITY\n 300\n",
        static="0.1, 1, 1e-4, 0.1",
        procedure="*COUPLED THERMAL-ELECTRICAL, STEADY STATE",
        cards=fed(current) + f"*FILM\n WIRE, F, {sink}, {film}",
        model=f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n WIRE, {sink}\n",
    )
    results = finished(run, text)
    balance = lambda t: field_of(current, nbti(t, 5.0, **NBTI).value) * current - film * 2 * np.pi * RADIUS * (t - sink)  # noqa: E731
    exact = brentq(balance, sink, sink + 0.1)
    assert exact - sink > 0.01
    np.testing.assert_allclose(results.field("temperature"), exact, atol=1e-6)
    heat = results.field("joule_heat").sum()
    assert heat == pytest.approx(film * 2 * np.pi * RADIUS * LENGTH * (exact - sink), rel=1e-4)


def test_a_normal_zone_recovers_where_a_film_takes_more_than_half_of_its_heat(run):
    """As the front passes an element, its voltage falls by decades within an iteration: temperatures and currents converge."""
    current, begins, ends, cold, size = 400.0, 6.8, 7.2, 4.2, 0.25e-3
    full = (current / AREA) ** 2 / (SIGMA * (1 - PART))
    slope = current / (AREA * PART) / (ends - begins)
    film = 0.7 * full / (7.0 - cold) * RADIUS / 2
    n = round(LENGTH / size) + 1
    initial = [cold + full / (2 * film / RADIUS)] * 10 + [cold] * (n - 10)
    text = deck(
        f"*SUPERCONDUCTOR, N=1000, RATIO={RATIO}\n {slope * ends}, 0, 0\n 0, {ends}, 0\n",
        material="*CONDUCTIVITY\n 300\n*DENSITY\n 8900\n*SPECIFIC HEAT\n 1\n",
        procedure="*COUPLED THERMAL-ELECTRICAL",
        static="5e-6, 4e-4",
        elements=n - 1,
        cards=fed(current, node=n) + f"*FILM\n WIRE, F, {cold}, {film}",
        model="*INITIAL CONDITIONS, TYPE=TEMPERATURE\n" + "".join(f" {i}, {t}\n" for i, t in enumerate(initial, 1)),
    )
    results = finished(run, text)
    critical = results.field("critical_current", None)
    assert (critical[1] == 0).sum() > 6
    # 2.25 mm at 12 m/s, the velocity of the front (verification, normal_zones.cooled): 0.19 ms
    assert np.all(critical[-1] > current)
    assert results.convergence["iteration"].max() < 12


def test_a_run_goes_on_from_everywhere(litz, tmp_path):
    assert_goes_on_from_everywhere(
        litz, tmp_path, deck(cards=fed(420.0) + KEEP_ALL, static="0.25, 1, 1e-3, 0.25", outputs="")
    )


@pytest.mark.parametrize(
    ("superconductor", "message"),
    [
        ("*SUPERCONDUCTOR, N=30\n 2e9\n", "*SUPERCONDUCTOR needs either FRACTION"),
        ("*SUPERCONDUCTOR, N=30, FRACTION=0.4, RATIO=1.5\n 2e9\n", "*SUPERCONDUCTOR needs either FRACTION"),
        ("*SUPERCONDUCTOR, N=30, FRACTION=1.5\n 2e9\n", "FRACTION must be less than 1"),
        ("*SUPERCONDUCTOR, FRACTION=0.4\n 2e9\n", "N"),
        ("*SUPERCONDUCTOR, N=0.5, FRACTION=0.4\n 2e9\n", "must be 1 or greater"),
        ("*SUPERCONDUCTOR, N=30, FRACTION=0.4\n 2e9, 4.2\n 1e9, 5\n", "three values: jc, T, B"),
        ("*SUPERCONDUCTOR, N=30, FRACTION=0.4\n 2e9, 4.2, 5\n 1e9, 5, 6\n", "no critical current density at T = 4.2 and B = 6"),
        ("*SUPERCONDUCTOR, N=30, FRACTION=0.4\n 2e9, 4.2, 5\n 1e9, 4.2, 5\n", "another critical current density at T = 4.2"),
        ("*SUPERCONDUCTOR, N=30, FRACTION=0.4, LAW=NBTI\n 3e9, 27.04, 14.5\n", "Tc0"),
        (fit("NB3SN", NB3SN | dict(Ca2=50.0)), "Ca2 must be less than Ca1"),
        (fit("NB3SN", NB3SN | dict(e0=0.256)), "e0 is a strain, not in percent"),
        (TABLE + TABLE, "has two *SUPERCONDUCTOR"),
        ("", "SC cannot be printed: no element is of a material with *SUPERCONDUCTOR"),
    ],
)  # fmt: skip
def test_bad_data_are_refused(litz, tmp_path, superconductor, message):
    assert message in refusal_of_deck(litz, tmp_path, deck)(1, superconductor)


def test_filaments_need_a_metal_around_them(litz, tmp_path):
    text = deck().replace(f"*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n", "").replace("\n 1, 9", "")
    assert "no *ELECTRICAL CONDUCTIVITY of the metal around it" in refusal_of_deck(litz, tmp_path, lambda: text)(1)
