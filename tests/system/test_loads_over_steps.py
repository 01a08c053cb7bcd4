"""Loads, amplitudes and currents over several steps, and the reactions and the work that belong to them."""

import numpy as np
import pytest

from decks import cantilever

#: E I of the wire of `cantilever` [N m^2], and its length [m]
BENDING_STIFFNESS, LENGTH = 200e9 * np.pi * 1e-3**4 / 4, 0.1
QUARTERS = "0.25, 1, 1e-3, 0.25"
CONDUCTING = " 200e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n 5e6\n"


def conducting(deck):
    return deck.replace(" 200e9, 0.3\n", CONDUCTING)


def applied(results, node, component=1):
    """Load in a direction at a node over the increments."""
    return results.field("applied_force", None)[:, node, component]


@pytest.mark.parametrize(("time", "begin"), [("TOTAL TIME", 1.0), ("STEP TIME", 0.0)], ids=["total time", "step time"])
def test_an_amplitude_follows_the_time_it_names(run, time, begin):
    """In a second step the one goes on from 1 s, the other begins anew."""
    wave = f"*AMPLITUDE, NAME=WAVE, TIME={time}\n 0, 0, 0.75, 1, 1.25, -1, 2, 0.5\n"
    deck = wave + cantilever("*CLOAD\n 6, 3, 1", "*CLOAD, AMPLITUDE=WAVE\n 11, 2, 4", static="0.125, 1, 1e-3, 0.125")
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    second = results.steps == 2
    assert second.sum() == 8
    factor = np.interp(begin + results.times[second] - 1, [0, 0.75, 1.25, 2], [0, 1, -1, 0.5])
    np.testing.assert_allclose(applied(results, 10)[second], 4 * factor, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("card", "time", "corner"),
    [("CLOAD", "TOTAL TIME", 1.3), ("CECURRENT", "STEP TIME", 0.3), ("BOUNDARY", "TOTAL TIME", 1.3)],
)
def test_no_increment_passes_over_a_corner_of_an_amplitude(run, card, time, corner):
    """Increments of a quarter, and a peak 0.3 s after the second step has begun."""
    peak = f"*AMPLITUDE, NAME=PEAK, TIME={time}\n 0, 0, {corner}, 1, {corner + 0.4:g}, 0.5\n"
    line = {"CLOAD": "11, 2, 4", "CECURRENT": "11, 9, 4", "BOUNDARY": "11, 2, 2, 1e-3"}[card]
    second = f"*{card}, AMPLITUDE=PEAK\n {line}"
    process, results = run(conducting(peak + cantilever("*BOUNDARY\n 1, 9", second, static=QUARTERS)))
    assert process.returncode == 0, process.stderr
    assert np.abs(results.times - 1.3).min() < 1e-12
    assert np.abs(results.times - 1.7).min() < 1e-12


def test_what_followed_an_amplitude_stays_at_its_last_value(run):
    """A step that does not name it again keeps what it was at the end of the step before."""
    rise = "*AMPLITUDE, NAME=RISE\n 0, 0, 2, 1\n"
    load = "*CLOAD, AMPLITUDE=RISE\n 11, 2, 4"
    process, results = run(rise + cantilever(load, "*CLOAD\n 6, 3, 1", static=QUARTERS))
    assert process.returncode == 0, process.stderr
    # the step ends half-way up
    assert applied(results, 10)[results.steps == 2] == pytest.approx([2] * 4, rel=1e-12)


def test_a_load_goes_on_from_what_it_was(run):
    """It ramps from its value in the step before to that of this one."""
    process, results = run(cantilever("*CLOAD\n 11, 2, 2", "*CLOAD\n 11, 2, 6", static=QUARTERS))
    assert process.returncode == 0, process.stderr
    assert applied(results, 10)[1:] == pytest.approx([0.5, 1, 1.5, 2, 3, 4, 5, 6], rel=1e-12)


def test_a_load_that_a_step_no_longer_names_ramps_out_while_another_goes_on(run):
    process, results = run(cantilever("*CLOAD\n 11, 2, 2\n 6, 2, 1", "*CLOAD, OP=NEW\n 6, 2, 4", static=QUARTERS))
    assert process.returncode == 0, process.stderr
    second = results.steps == 2
    assert applied(results, 10)[second] == pytest.approx([1.5, 1, 0.5, 0], abs=1e-12)
    assert applied(results, 5)[second] == pytest.approx([1.75, 2.5, 3.25, 4], rel=1e-12)


def test_a_support_carries_the_load_that_acts_on_it(run):
    """A clamped node is loaded itself, and by the tip: its reaction holds both, and no tip load is a reaction."""
    process, results = run(
        cantilever("*CLOAD\n 1, 2, 5\n 1, 4, 0.2\n 11, 2, 0.01\n*NODE PRINT, NSET=WIRE, TOTALS=ONLY\n RF, CF")
    )
    assert process.returncode == 0, process.stderr
    # shortened by the bend by less than 1e-7 of its length
    assert results.field("reaction_force")[0] == pytest.approx([0, -5.01, 0], abs=1e-9)
    assert results.field("reaction_moment")[0] == pytest.approx([-0.2, 0, -0.01 * LENGTH], abs=1e-9)
    assert not results.field("reaction_force")[1:].any()
    assert results.history["RF2 sum WIRE"][-1] == pytest.approx(-results.history["CF2 sum WIRE"][-1], rel=1e-9)


def test_an_electrode_takes_the_current_that_is_fed_in_at_it(run):
    deck = cantilever("*BOUNDARY\n 1, 9\n*CECURRENT\n 1, , 3\n 11, , 2")
    process, results = run(conducting(deck))
    assert process.returncode == 0, process.stderr
    assert results.field("reaction_current")[0] == pytest.approx(-5, rel=1e-12)
    assert results.field("element_current") == pytest.approx([-2] * 10, rel=1e-12)


def test_the_work_of_a_load_that_stays_is_force_times_way(run):
    """P ramps in first, then stays while Q doubles the deflection: P u/2, then P u + Q u/2."""
    small = 1e-3
    process, results = run(
        cantilever(f"*CLOAD\n 11, 2, {small}\n*ENERGY PRINT", f"*CLOAD\n 11, 2, {2 * small}", static=QUARTERS)
    )
    assert process.returncode == 0, process.stderr
    deflection = small * LENGTH**3 / (3 * BENDING_STIFFNESS)
    work = results.history["ALLWK"]
    # ten elements with one point each miss 1/400 of the deflection; shear adds less
    assert work[4] == pytest.approx(small * deflection / 2, rel=3e-3)
    assert work[8] == pytest.approx(4 * work[4], rel=1e-6)
    assert np.abs(results.history["ETOTAL"]).max() < 1e-6 * work[-1]


def test_a_turn_by_moments_goes_beyond_half_a_turn(run):
    """A wire rolled up by M = phi E I/L to a turn and a quarter, and back again."""
    angle = 2.5 * np.pi
    roll = f"*CLOAD\n 11, 6, {angle * BENDING_STIFFNESS / LENGTH}"
    process, results = run(cantilever(roll, "*CLOAD, OP=NEW", static="0.1, 1, 1e-3, 0.1"))
    assert process.returncode == 0, process.stderr
    turned = results.field("rotation", None)[:, 10, 2]
    steps = np.arange(1, 11) / 10 * angle
    # a chain of straight elements follows a moment exactly
    np.testing.assert_allclose(turned[1:], np.r_[steps, steps[-2::-1], 0], rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize(
    ("on", "off"),
    [("*BOUNDARY\n 11, 9, 9, 1e-3", "*BOUNDARY\n 11, 9, 9, 0"), ("*CECURRENT\n 11, , 4", "*CECURRENT, OP=NEW")],
    ids=["voltage", "current"],
)
def test_a_voltage_or_a_current_can_be_switched_off(run, on, off):
    """What is left of the potentials is the round-off of those before."""
    process, results = run(conducting(cantilever(f"*BOUNDARY\n 1, 9\n{on}", off, static=QUARTERS)))
    assert process.returncode == 0, process.stderr
    assert process.stderr == ""
    assert len(results.times) == 9
    potential = results.field("potential", None)
    before = np.abs(potential[results.index(1, 4)]).max()
    assert before > 1e-4
    assert np.abs(potential[-1]).max() < 1e-14 * before


def test_what_is_fixed_stays_where_it_is_when_the_step_begins(run):
    """A bent and twisted wire is held at its end, and let go two steps later. Supports take over what the loads held."""
    loads = "*CLOAD\n 11, 2, 2\n 11, 4, 0.02\n 11, 6, 0.05"
    none = "*CLOAD, OP=NEW"
    process, results = run(
        cantilever(
            loads,
            f"*BOUNDARY, FIXED\n 11, 1, 6\n{none}",
            "*BOUNDARY\n 6, 3, 3, 1e-3",
            "*BOUNDARY, OP=NEW\n 1, ENCASTRE",
            static=QUARTERS,
        )
    )
    assert process.returncode == 0, process.stderr
    end = {step: np.flatnonzero(results.steps == step)[-1] for step in (1, 2, 3, 4)}
    for name in ("displacement", "rotation"):
        values = results.field(name, None)[:, 10]
        held = values[(results.steps == 2) | (results.steps == 3)]
        np.testing.assert_allclose(held, np.tile(values[end[1]], (len(held), 1)), rtol=0, atol=1e-15)
        np.testing.assert_allclose(values[end[4]], 0, atol=1e-10)
    np.testing.assert_allclose(results.field("reaction_force", end[2])[10], [0, 2, 0], atol=1e-6)
    np.testing.assert_allclose(results.field("displacement", end[3])[5, 2], 1e-3, rtol=1e-12)


def test_a_single_rotation_that_is_fixed_does_not_turn_on(run):
    """The end is turned about z; held there, a force that would turn it does not."""
    turned = "*BOUNDARY\n 11, 6, 6, 0.3"
    process, results = run(cantilever(turned, "*BOUNDARY, FIXED\n 11, 6\n*CLOAD\n 11, 2, 1", static=QUARTERS))
    assert process.returncode == 0, process.stderr
    np.testing.assert_allclose(results.field("rotation", None)[4:, 10], np.tile([0, 0, 0.3], (5, 1)), atol=1e-12)


def test_a_fixed_potential_is_that_of_the_conductor(run):
    """What a current has brought about is held without it."""
    deck = conducting(
        cantilever(
            "*BOUNDARY\n 1, 9\n*CECURRENT\n 11, 9, 1e-3", "*BOUNDARY, FIXED\n 11, 9\n*CECURRENT, OP=NEW", static=QUARTERS
        )
    )  # fmt: skip
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    potential = results.field("potential", None)[:, 10]
    np.testing.assert_allclose(potential[5:], potential[4], rtol=1e-14)
    np.testing.assert_allclose(results.field("reaction_current", -1)[10], 1e-3, rtol=1e-9)
