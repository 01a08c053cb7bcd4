"""Heat on the length of wires that follows amplitudes: sources, surroundings and films over time."""

import numpy as np
import pytest

from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_heat_over_time import DENSITY, HEAT, RADIUS, ROOM, deck
from test_restart import assert_goes_on_from_everywhere

STEADY = "*COUPLED THERMAL-ELECTRICAL, STEADY STATE"
#: A source, its surroundings and its film, each with a history of its own
WAVES = "*AMPLITUDE, NAME=A\n0, 0, 0.5, 2, 1, 1\n*AMPLITUDE, NAME=B\n0, 1, 1, 1.5\n*AMPLITUDE, NAME=C\n0, 1, 1, 3\n"
SOURCE, FILM, AROUND = 1e7, 40.0, 280.0
LOADS = f"*DFLUX, AMPLITUDE=A\nWIRE, BF, {SOURCE}\n*FILM, AMPLITUDE=B, FILM AMPLITUDE=C\nWIRE, F, {AROUND}, {FILM}\n"


def warmth(a, b, c):
    """Of a wire all of whose heat passes through its film, with the factors of source, surroundings, film."""
    return b * AROUND + a * SOURCE * RADIUS / (2 * c * FILM)


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def temperatures(results):
    """Of the wire, the same everywhere, at every increment after the start."""
    field = results.field("temperature", increment=None)[1:]
    np.testing.assert_allclose(field, field[:, :1] * np.ones(field.shape[1]), rtol=1e-9)
    return field[:, 0]


def test_source_surroundings_and_film_follow_their_amplitudes(run):
    results = run("0.25, 1., , 0.25", model=WAVES, loads=LOADS, procedure=STEADY)
    expected = [warmth(1, 1.125, 1.5), warmth(2, 1.25, 2), warmth(1.5, 1.375, 2.5), warmth(1, 1.5, 3)]
    np.testing.assert_allclose(temperatures(results), expected, rtol=1e-9)


def test_no_increment_passes_over_a_corner(run):
    results = run("0.7, 1.", model=WAVES, loads=LOADS, procedure=STEADY)
    np.testing.assert_allclose(results.times, [0, 0.5, 1], rtol=1e-12)
    np.testing.assert_allclose(temperatures(results), [warmth(2, 1.25, 2), warmth(1, 1.5, 3)], rtol=1e-9)


def test_what_a_later_step_does_not_name_stays_as_the_amplitude_has_left_it(run):
    """One in step time; one in total time goes on."""
    later = f"*STEP\n{STEADY}\n1., 1.\n{{}}*END STEP\n"
    results = run("1., 1.", model=WAVES, loads=LOADS, procedure=STEADY, later=later.format(""))
    np.testing.assert_allclose(temperatures(results)[-2:], warmth(1, 1.5, 3), rtol=1e-9)
    total = WAVES.replace("NAME=A\n0, 0, 0.5, 2, 1, 1", "NAME=A, TIME=TOTAL TIME\n0, 1, 2, 5")
    results = run("1., 1.", model=total, loads=LOADS, procedure=STEADY, later=later.format(""))
    np.testing.assert_allclose(temperatures(results), [warmth(3, 1.5, 3), warmth(5, 1.5, 3)], rtol=1e-9)
    # a new source without an amplitude ramps from what the old one has become
    results = run("1., 1.", model=total, loads=LOADS, procedure=STEADY,
                  later=f"*STEP\n{STEADY}\n0.5, 1., , 0.5\n*DFLUX\nWIRE, BF, {SOURCE}\n*END STEP\n")  # fmt: skip
    np.testing.assert_allclose(temperatures(results), [warmth(a, 1.5, 3) for a in (3, 2, 1)], rtol=1e-9)


def test_radiation_to_surroundings_that_warm_up(run):
    loads = "*RADIATE, AMPLITUDE=B\nWIRE, R, 280, 0.5\n"
    constants = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0, STEFAN BOLTZMANN=5.670374e-8\n"
    wave = "*AMPLITUDE, NAME=B\n0, 1, 1, 1.5\n"
    results = run("0.5, 1., , 0.5", model=wave + constants, loads=loads, procedure=STEADY)
    np.testing.assert_allclose(temperatures(results), [1.25 * 280, 1.5 * 280], rtol=1e-9)


def test_surroundings_that_warm_up_steadily(run):
    """T follows them by the time constant s = rho_m c r/(2 h): T0 + k (t - s (1 - exp(-t/s))); second order in the increments."""
    s = DENSITY * HEAT * RADIUS / (2 * FILM)
    model = f"*AMPLITUDE, NAME=B\n0, 1, {2 * s:.17g}, 2\n"
    errors = []
    for n in (40, 80):
        results = run(f"{2 * s / n:.17g}, {2 * s:.17g}", model=model, elements=2, length=1e-3,
                      loads=f"*FILM, AMPLITUDE=B\nWIRE, F, {ROOM}, {FILM}\n")  # fmt: skip
        t = results.times[1:] / s
        errors.append(abs(temperatures(results) - ROOM - ROOM / 2 * (t - 1 + np.exp(-t))).max())
    # the first increment, backward Euler, misses ROOM/4 (dt/s)^2 with dt = s/40; BDF2 a multiple of it that is less than one
    assert errors[1] < ROOM / 2 / 40**2
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)


def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    total = WAVES.replace("NAME=A", "NAME=A, TIME=TOTAL TIME")
    later = f"*STEP\n{STEADY}\n0.5, 1.\n*DFLUX\nWIRE, BF, 1e6\n*RESTART, WRITE\n*END STEP\n"
    assert_goes_on_from_everywhere(
        litz, tmp_path, deck("0.3, 1.", model=total, loads=LOADS + KEEP_ALL, procedure=STEADY, later=later)
    )


@pytest.mark.parametrize(
    ("loads", "words"),
    [
        ("*FILM, AMPLITUDE=X\nWIRE, F, 280, 40\n", 'there is no amplitude "X"'),
        ("*FILM, FILM AMPLITUDE=N\nWIRE, F, 280, 40\n", "is not negative; the amplitude N has a factor of -1"),
        ("*DFLUX, AMPLITUDE=A\nWIRE, BF, 1\n*DFLUX\n3, BF, 1\n", "element 3 has sources of different amplitudes"),
        ("*RADIATE, AMPLITUDE=N\nWIRE, R, 280, 0.5\n", "surroundings are not below absolute zero, 0"),
        ("*RADIATE, FILM AMPLITUDE=A\nWIRE, R, 280, 0.5\n", "FILM AMPLITUDE"),
    ],
)  # fmt: skip
def test_refused(refused, loads, words):
    model = WAVES + "*AMPLITUDE, NAME=N\n0, 1, 1, -1\n*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0, STEFAN BOLTZMANN=5.67e-8\n"
    assert words in refused(1, "1., 1.", model=model, loads=loads, procedure=STEADY)
