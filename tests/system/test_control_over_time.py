"""Increments of heat over time that follow their error, and steps that end as soon as nothing changes any more."""

import numpy as np
import pytest

from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_heat_over_time import DENSITY, DIFFUSIVITY, HEAT, LENGTH, RADIUS, ROOM, SIGMA, STORED, deck
from test_restart import assert_goes_on_from_everywhere

FILM, AROUND = 40.0, 250.0
#: Time constant of a wire that a film cools
S = DENSITY * HEAT * RADIUS / (2 * FILM)
COOLED = f"*FILM\nWIRE, F, {AROUND}, {FILM}\n"
ELECTRICAL = "*COUPLED THERMAL-ELECTRICAL"
ENDS = "*BOUNDARY\nENDS, 11, 11, 400\n"


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def cooled(run, error, first=1e-3):
    """Largest error of the temperature of a wire that cools down over six time constants, and the increments."""
    results = run(f"{first * S:.17g}, {6 * S:.17g}, {1e-6 * S:.17g}", elements=2, length=1e-3, heat=COOLED,
                  procedure=f"{ELECTRICAL}, ERROR={error}")  # fmt: skip
    exact = AROUND + (ROOM - AROUND) * np.exp(-results.times / S)
    errors = abs(results.field("temperature", increment=None)[:, 0] - exact)
    return errors.max(), np.diff(results.times) / S


class TestError:
    def test_increments_have_the_size_that_their_error_allows(self, run):
        """h^3 T'''/6 (h + h1) h/(a h) of BDF2 with even increments is 2/9 h^3 T''': h = (4.5 E/T''')^(1/3)."""
        error = 1e-3
        _, increments = cooled(run, error)
        # a part that grows as exp(t/(3 s)): most of the time it follows that, by 0.85 of the largest one
        t = np.cumsum(increments)
        largest = (4.5 * error / (ROOM - AROUND) * np.exp(t)) ** (1 / 3)
        chosen = increments / largest
        settled = (t > 1) & (t < 4)
        assert np.all(chosen[settled] > 0.5)
        assert np.all(chosen[settled] < 1.1)

    def test_a_smaller_error_gives_better_temperatures_by_more_increments(self, run):
        """Errors of n increments add up to n E at most, and fall as E^(2/3) with n as E^(-1/3)."""
        found = [cooled(run, error) for error in (1e-2, 1e-3, 1e-4)]
        for error, (worst, increments) in zip((1e-2, 1e-3, 1e-4), found, strict=True):
            assert worst < error * len(increments)
        assert len(found[2][1]) / len(found[1][1]) == pytest.approx(10 ** (1 / 3), rel=0.25)
        assert found[1][0] / found[2][0] == pytest.approx(10 ** (2 / 3), rel=0.5)

    def test_increments_that_are_too_large_are_cut(self, run):
        """The second one, whose error is the first that is known."""
        _, increments = cooled(run, 1e-3, first=0.5)
        assert increments[1] < 0.1 * increments[0]

    def test_it_goes_with_a_limit_of_changes(self, run):
        results = run("0.001, 10., 1e-6", heat=ENDS, procedure=f"{ELECTRICAL}, DELTMX=5., ERROR=0.01")
        history = results.field("temperature", increment=None)
        assert np.abs(np.diff(history[:, 1:-1], axis=0)).max() <= 5.0
        n = len(results.times)
        alone = run("0.001, 10., 1e-6", heat=ENDS, procedure=f"{ELECTRICAL}, DELTMX=5.")
        assert n > len(alone.times)

    def test_a_wire_that_melts(self, run):
        """The end of the formula with a latent heat, to a tenth of a kelvin for each of its corners."""
        latent, solidus, liquidus, amperes = 2.05e5, 350.0, 351.0, 200.0
        rate = amperes**2 * 1.72e-8 / (np.pi * RADIUS**2) ** 2 / DENSITY
        wanted = HEAT * (liquidus - ROOM) + latent + HEAT * 30
        results = run(f"{wanted / rate / 100:.17g}, {wanted / rate:.17g}, 1e-9", elements=3, amperes=amperes,
                      material=STORED + f"*LATENT HEAT\n{latent}, {solidus}, {liquidus}\n",
                      procedure=f"{ELECTRICAL}, ERROR=0.1")  # fmt: skip
        np.testing.assert_allclose(results.field("temperature"), liquidus + 30, atol=0.2)

    def test_a_wire_that_melts_under_a_current_that_rises_keeps_it(self, run):
        """Its temperature stands still and says nothing; the heat is the integral of a power that goes with t^2."""
        latent, melts, amperes = 2.05e5, ROOM + 30, 400.0
        power = amperes**2 * 1.72e-8 / (np.pi * RADIUS**2) ** 2 / DENSITY
        end = (3 * (60 * HEAT + latent) / power) ** (1 / 3)
        rising = "*AMPLITUDE, NAME=RISING\n0, 0, 10, 10\n"
        worst = []
        for error in (0.1, 0.01):
            results = run(f", {end:.17g}, {1e-7 * end:.17g}", elements=2, model=rising, material=STORED +
                          f"*LATENT HEAT\n{latent}, {melts}, {melts + 0.001}\n", procedure=f"{ELECTRICAL}, ERROR={error}",
                          loads=f"*CECURRENT, AMPLITUDE=RISING\n1, , {amperes}\n")  # fmt: skip
            worst.append(abs(results.field("temperature")[0] - ROOM - 60))
            assert worst[-1] < error * len(results.times)
        assert worst[1] < 0.4 * worst[0]

    def test_the_first_increment_is_small_where_none_is_given(self, run):
        """One of the whole step would be 3.8 K off."""
        results = run(f", {S:.17g}", elements=2, length=1e-3, heat=COOLED, procedure=f"{ELECTRICAL}, ERROR=0.01")
        assert results.times[1] == pytest.approx(1e-5 * S)
        exact = AROUND + (ROOM - AROUND) * np.exp(-results.times / S)
        errors = abs(results.field("temperature", increment=None)[:, 0] - exact)
        assert errors.max() < 0.01 * len(results.times)
        assert not results.warnings

    def test_a_first_increment_that_is_too_large_is_a_warning(self, run):
        """With the error of backward Euler over half of a time constant, z = 1/2: the second one shows T'' at its end, by which
        it is z^2/(2 (1 + z)) in place of 1/(1 + z) - exp(-z)."""
        results = run(f"{0.5 * S:.17g}, {6 * S:.17g}, {1e-6 * S:.17g}", elements=2, length=1e-3, heat=COOLED,
                      procedure=f"{ELECTRICAL}, ERROR=0.001")  # fmt: skip
        (warning,) = results.warnings
        assert warning.kind == "first_increment"
        error = (ROOM - AROUND) * (1 / 1.5 - np.exp(-0.5))
        assert error < warning.worst < 1.5 * error

    def test_a_step_of_a_single_increment_is_a_warning(self, run):
        results = run(f"{S:.17g}, {S:.17g}", elements=2, length=1e-3, heat=COOLED)
        (warning,) = results.warnings
        assert warning.kind == "first_increment"
        error = (ROOM - AROUND) * (1 / 2 - np.exp(-1))
        assert error < warning.worst < 1.2 * error
        assert "come to rest" in warning.message
        assert "change evenly are exact" in warning.message

    def test_a_single_increment_is_one_of_more_than_error(self, run):
        """Of a rise of half a kelvin: 0.15 K, where a thousandth of the temperature would be 0.3 K."""
        rate = 20.0**2 * 1.72e-8 / (np.pi * RADIUS**2) ** 2 / (DENSITY * HEAT)
        for error, n in ((0.1, 1), (0.2, 0)):
            results = run(
                f"{0.5 / rate:.17g}, {0.5 / rate:.17g}",
                elements=2,
                amperes=20.0,
                procedure=f"{ELECTRICAL}, ERROR={error}",
            )
            assert len(results.warnings) == n
            assert results.field("temperature")[0] - ROOM == pytest.approx(0.5, rel=1e-9)

    @pytest.mark.parametrize("error", [1.0, 0.1, 0.01])
    def test_what_sets_in_after_a_long_quiet_time_keeps_it(self, run, error):
        """A power that rises from nothing within 3 ms, after increments a hundred times as long: the integral of it. Within an
        increment it may set in at any time, half of what it makes."""
        rate, rise = 3000.0, 3e-3
        heat = f"*DFLUX, AMPLITUDE=SETS_IN\nWIRE, BF, {rate * DENSITY * HEAT:.17g}\n"
        results = run("1e-5, 1.02", elements=2, amperes=0.0, heat=heat, procedure=f"{ELECTRICAL}, ERROR={error}",
                      model=f"*AMPLITUDE, NAME=SETS_IN\n0, 0, 1, 0, {1 + rise}, 1, 2, 1\n")  # fmt: skip
        late = results.times - 1
        exact = rate * np.where(late < rise, np.maximum(late, 0) ** 2 / (2 * rise), late - rise / 2)
        errors = results.field("temperature", increment=None)[:, 0] - ROOM - exact
        assert np.diff(results.times)[results.times[1:] < 1].max() > 0.1
        assert np.abs(np.diff(errors)).max() < 2 * error
        assert not results.warnings

    def test_an_increment_that_may_not_be_smaller_is_taken_with_a_warning(self, run):
        rate = 1e6
        heat = f"*DFLUX, AMPLITUDE=SETS_IN\nWIRE, BF, {rate * DENSITY * HEAT:.17g}\n"
        results = run("1e-5, 1.0001, 1e-5", elements=2, amperes=0.0, heat=heat, procedure=f"{ELECTRICAL}, ERROR=0.01",
                      model="*AMPLITUDE, NAME=SETS_IN\n0, 0, 1, 0, 1.00005, 1, 2, 1\n")  # fmt: skip
        (warning,) = results.warnings
        assert warning.kind == "smallest_increment"
        assert warning.worst == pytest.approx(1e-5, rel=1e-6)
        assert "ERROR=0.01" in warning.message
        assert results.times[-1] == pytest.approx(1.0001)

    @pytest.mark.slow
    def test_a_run_that_melts_and_freezes_goes_on_from_every_increment(self, litz, tmp_path):
        freezes = f"{ELECTRICAL}, ERROR=0.2\n, 0.3, 1e-6\n*CECURRENT\n1, , 20\n*FILM\nWIRE, F, 250, 5000\n"
        moves = "*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, DELTMX=3\n0.01, 0.1, 1e-6\n"
        later = "".join(f"*STEP, INC=1000\n{procedure}*END STEP\n" for procedure in (freezes, moves))
        text = deck(", 0.3, 1e-6", amperes=300.0, elements=4, material=STORED + "*LATENT HEAT\n2e4, 310, 310.5\n",
                    procedure=f"{ELECTRICAL}, ERROR=0.5", heat="*BOUNDARY\n5, 11, 11, 305\n", step=KEEP_ALL,
                    later=later)  # fmt: skip
        assert_goes_on_from_everywhere(litz, tmp_path, text)


class TestSteadyEnd:
    def test_a_wire_that_melts_is_not_steady(self, run):
        """It takes up heat at 1 K/s of its specific heat, over 0.001 K."""
        results = run("1., 700., , , 0.1", elements=2, length=1e-3, heat=f"*DFLUX\nWIRE, BF, {DENSITY * HEAT}\n",
                      material=STORED + f"*LATENT HEAT\n{500 * HEAT}, {ROOM + 10.5}, {ROOM + 10.501}\n",
                      procedure=f"{ELECTRICAL}, END=SS")  # fmt: skip
        assert results.times[-1] == pytest.approx(700)
        np.testing.assert_allclose(results.field("temperature"), ROOM + 200, rtol=1e-6)

    def test_a_step_ends_when_no_temperature_changes_faster(self, run):
        """(T0 - Ts)/s exp(-t/s) falls below the rate at s ln((T0 - Ts)/(s rate))."""
        rate = (ROOM - AROUND) / S * np.exp(-3)
        results = run(f"{S / 50:.17g}, {20 * S:.17g}, , , {rate:.17g}", elements=2, length=1e-3, heat=COOLED,
                      procedure=f"{ELECTRICAL}, END=SS")  # fmt: skip
        # the mean over an increment is that of its middle
        assert results.times[-1] / S == pytest.approx(3.01, abs=0.02)
        assert not results.warnings
        # the fields of the last increment are there, and are where they belong
        assert results.field("temperature")[0] == pytest.approx(AROUND + 50 * np.exp(-results.times[-1] / S), abs=0.01)

    def test_it_ends_at_its_time_with_a_warning_otherwise(self, run):
        results = run(f"{S / 10:.17g}, {S:.17g}, , , 1e-6", elements=2, length=1e-3, heat=COOLED,
                      procedure=f"{ELECTRICAL}, END=SS")  # fmt: skip
        assert results.times[-1] == pytest.approx(S)
        (warning,) = results.warnings
        assert warning.kind == "not_steady"
        assert "where END=SS asks for less than 1e-06" in warning.message
        assert warning.worst == pytest.approx(50 / S * np.exp(-0.95), rel=0.01)

    def test_what_amplitudes_still_have_to_bring_is_waited_for(self, run):
        """A current that comes after a time in which nothing happens."""
        late = f"*AMPLITUDE, NAME=LATE\n0, 0, {S:.17g}, 0, {1.1 * S:.17g}, 1\n"
        loads = f"*FILM\nWIRE, F, {ROOM}, {FILM}\n*DFLUX, AMPLITUDE=LATE\nWIRE, BF, 1e7\n"
        results = run(f"{S / 20:.17g}, {50 * S:.17g}, , , 1e-4", elements=2, length=1e-3, loads=loads, model=late,
                      procedure=f"{ELECTRICAL}, END=SS")  # fmt: skip
        rise = 1e7 * RADIUS / (2 * FILM)
        assert 5 * S < results.times[-1] < 20 * S
        assert results.field("temperature")[0] == pytest.approx(ROOM + rise, rel=1e-4)

    def test_the_next_step_begins_there(self, run):
        later = f"*STEP\n{ELECTRICAL}, STEADY STATE\n1., 1.\n*END STEP\n"
        results = run(f"0.05, {20 * LENGTH**2 / DIFFUSIVITY:.17g}, 1e-4, , 0.1", heat="*BOUNDARY\nENDS, 11, 11, 300\n",
                      amperes=30.0, sigma=SIGMA, later=later,
                      procedure="*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, ERROR=0.05, END=SS")  # fmt: skip
        fields = results.field("temperature", increment=None)
        # what is left is the rate times the time constant L^2/(pi^2 kappa), which rho(T) makes a little longer
        left = abs(fields[-2] - fields[-1]).max() / (0.1 * LENGTH**2 / (np.pi**2 * DIFFUSIVITY))
        assert 0.5 < left < 1.2
        assert results.times[-1] == pytest.approx(results.times[-2] + 1)

    @pytest.mark.slow
    def test_a_run_goes_on_from_every_increment(self, litz, tmp_path):
        later = f"*STEP\n{ELECTRICAL}\n0.5, 1.\n*END STEP\n"
        text = deck("0.2, 100., 1e-4, , 1.0", heat="*BOUNDARY\nENDS, 11, 11, 320\n", amperes=60.0, sigma=SIGMA, step=KEEP_ALL,
                    later=later, procedure=f"{ELECTRICAL}, ERROR=0.5, END=SS")  # fmt: skip
        assert_goes_on_from_everywhere(litz, tmp_path, text)


@pytest.mark.parametrize(
    ("flags", "data", "words"),
    [
        ("STEADY STATE, ERROR=1.", "0.1, 1.", "ERROR chooses the increments of steps over time"),
        ("DIRECT, ERROR=1.", "0.1, 1.", "ERROR chooses the increments of steps over time"),
        ("STEADY STATE, END=SS", "0.1, 1., , , 1e-3", "END=SS ends a step over time"),
        ("END=SS", "0.1, 1.", "END=SS needs the rate below which temperatures are steady"),
        ("DELTMX=1.", "0.1, 1., , , 1e-3", "a rate below which temperatures are steady needs END=SS"),
        ("END=SS", "0.1, 1., , , -1e-3", "rate"),
    ],
)
def test_refused(refused, flags, data, words):
    assert words in refused(1, data, heat=COOLED, procedure=f"{ELECTRICAL}, {flags}")
