"""litz.bisect: the value of a parameter at which the outcome of a run changes."""

import numpy as np
import pytest

import litz

RADIUS, LENGTH, SIGMA, PART, COLD = 0.41e-3, 2e-3, 5e9, 0.4, 4.2
AREA, CURRENT, DENSITY, HEAT = np.pi * RADIUS**2, 400.0, 8900.0, 1.0
#: The heat of the current sets in between these temperatures [K]
BEGINS, ENDS = 6.9, 7.1
FULL = (CURRENT / AREA) ** 2 / (SIGMA * (1 - PART))
#: Film that takes a fifth of the heat of the current at 7 K [W/(m^2 K)]
FILM = 0.2 * FULL / (7.0 - COLD) * RADIUS / 2


def strand(energy):
    """A short wire with the same temperature everywhere, after a pulse that has been faster than any exchange of heat."""
    critical = CURRENT / (AREA * PART) / (ENDS - BEGINS)
    jc = [(critical * ENDS, 0.0, 0.0), (0.0, ENDS, 0.0)]
    metal = litz.Material(
        "STRAND", 100e9, 0.3, SIGMA, thermal_conductivity=300.0, density=DENSITY, specific_heat=HEAT,
        superconductor=litz.Superconductor(n=1000, jc=jc, fraction=PART), units="SI",
    )  # fmt: skip
    made = litz.Model("A pulse of heat")
    wire = made.wire("WIRE", (0, 0, 0), (LENGTH, 0, 0), radius=RADIUS, material=metal, elements=2)
    made.fix(wire)
    made.fix(wire.start, "potential")
    made.initial_temperature(COLD + energy / (DENSITY * HEAT * AREA * LENGTH))
    step = made.step(procedure="COUPLED THERMAL-ELECTRICAL", increment=4e-6, total=0.3e-3)
    step.current(wire.end, -CURRENT)
    step.film(wire, COLD, FILM)
    return made


def is_normal(results):
    return results.field("critical_current").max() == 0.0


def test_the_quench_energy_of_a_wire_of_one_temperature_is_that_up_to_its_unstable_equilibrium(tmp_path):
    """The heat of the current, linear between BEGINS and ENDS, and the cooling h P/A (T - T0) are equal there."""
    found = litz.bisect(strand, "energy", (1e-6, 1e-3), is_normal, directory=tmp_path, tolerance=1e-3)
    cooling = 2 * FILM / RADIUS
    unstable = (FULL * BEGINS / (ENDS - BEGINS) - cooling * COLD) / (FULL / (ENDS - BEGINS) - cooling)
    exact = DENSITY * HEAT * AREA * LENGTH * (unstable - COLD)
    # the tolerance, 1e-3, and the power law: filaments carry (E/Ec)^(1/n) = 1.008 of jc in 0.25 V/m, 0.002 K of 2.7 K
    assert found.value == pytest.approx(exact, rel=2e-3)
    assert found.below < found.value < found.above
    assert (found.above - found.below) / found.value <= 2.1e-3


def test_runs_that_are_there_are_not_repeated(tmp_path):
    options = dict(directory=tmp_path, tolerance=0.3)
    litz.bisect(strand, "energy", (1e-6, 1e-3), is_normal, **options)
    times = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.vtkhdf")}
    litz.bisect(strand, "energy", (1e-6, 1e-3), is_normal, **options)
    assert times == {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.vtkhdf")}


def test_what_falls_with_the_parameter_and_negative_numbers_are_found_too():
    falls = litz.bisect(lambda x: -x, "x", (8.0, 1.0), lambda y: y > -3.0, directory=None, tolerance=1e-6)
    assert falls.value == pytest.approx(3.0, rel=1e-6)
    negative = litz.bisect(lambda x: {"y": x}, "x", (-1e-3, -1e3), lambda y: y["y"] < -2.0, directory=None)
    assert negative.value == pytest.approx(-2.0, rel=0.01)
    # 20 halvings in logarithms and a few of the last factor of two
    assert negative.runs < 15


@pytest.mark.parametrize(
    ("between", "message"),
    [
        ((1.0, 2.0), "is not reached at x = 1 and at 2"),
        ((4.0, 5.0), "is reached at x = 4 and at 5"),
        ((1.0, 1.0), "two different numbers"),
        ((1.0, float("nan")), "two different numbers"),
    ],
)
def test_ends_that_do_not_differ_are_refused(between, message):
    with pytest.raises(ValueError, match=message):
        litz.bisect(lambda x: x, "x", between, lambda y: y > 3.0, directory=None)


@pytest.mark.parametrize("between", [(1.0, 8.0), (8.0, 1.0)])
def test_the_ends_may_be_given_in_any_order(between):
    found = litz.bisect(lambda x: x, "x", between, lambda y: y > 3.0, directory=None, tolerance=1e-6)
    assert found.below < found.above
    assert found.value == pytest.approx(3.0, rel=1e-6)


def test_a_change_at_zero_is_found_to_a_millionth_of_the_range():
    found = litz.bisect(lambda x: x, "x", (-1e-4, 1e-4), lambda y: y > 0, directory=None)
    assert abs(found.value) < 1e-10
    assert found.runs < 25


def test_a_function_that_has_no_such_parameter_is_told_before_any_run():
    with pytest.raises(TypeError, match=r"cannot be called with the parameters y: missing a required argument: 'x'"):
        litz.bisect(lambda x: x, "y", (1.0, 4.0), lambda y: y > 3.0, directory=None)


def test_a_tolerance_of_nothing_is_refused():
    with pytest.raises(ValueError, match="tolerance must be greater than 0, not 0"):
        litz.bisect(lambda x: x, "x", (1.0, 4.0), lambda y: y > 3.0, directory=None, tolerance=0)


@pytest.mark.filterwarnings("ignore:1 of 1 runs failed")
def test_a_run_that_fails_ends_the_search_and_is_named():
    with pytest.raises(litz.LitzError, match=r"the run at x = 0 failed.*ZeroDivisionError"):
        litz.bisect(lambda x: 1 / x, "x", (0.0, 4.0), lambda y: y < 0.5, directory=None)
