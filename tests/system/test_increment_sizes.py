"""How increments grow, shrink and are cut, by the settings of *CONTROLS."""

import numpy as np
import pytest

from decks import cantilever

#: Bends the wire by a third of its length
LOAD = "*CLOAD\n 11, 2, 10"


def times(*limits, first=0.05, largest=1.0, smallest=1e-3, factors=" 0.25, , 0.75, , , , 1.5", most=""):
    """A deck of one step with limits of iterations I_C, I_L, I_G and of cut-backs I_A."""
    i_c, i_l, i_g, i_a = limits
    controls = f"*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , {i_c}, {i_l}, {i_g}, , {i_a}\n{factors}\n"
    return cantilever(controls + LOAD, static=f"{first}, 1, {smallest}, {largest}")


def increments(results):
    return np.diff(results.times)


def test_after_two_quick_increments_each_one_is_longer(run):
    """All are quick: the third is the first to grow, by D_D, up to the largest."""
    process, results = run(times(50, 49, 48, 8, first=0.02, largest=0.1))
    assert process.returncode == 0, process.stderr
    expected = 0.02 * np.array([1, 1, 1.5, 1.5**2, 1.5**3])
    assert increments(results)[:5] == pytest.approx(expected, rel=1e-9)
    assert increments(results).max() == pytest.approx(0.1, rel=1e-9)


def test_a_slow_increment_is_followed_by_a_shorter_one(run):
    """All are slow, since one iteration never is enough: each is D_B of the one before, down to the smallest."""
    process, results = run(times(50, 1, 1, 8, first=0.2, smallest=0.08))
    assert process.returncode == 0, process.stderr
    assert increments(results)[:5] == pytest.approx([0.2, 0.15, 0.1125, 0.084375, 0.08], rel=1e-9)


def test_increments_that_are_neither_quick_nor_slow_stay_as_they_are(run):
    process, results = run(times(50, 49, 1, 8, first=0.1))
    assert process.returncode == 0, process.stderr
    assert increments(results) == pytest.approx(np.full(10, 0.1), rel=1e-9)


def test_direct_increments_stay_as_they_are(run):
    deck = times(50, 49, 48, 8, first=0.1).replace("*STATIC\n", "*STATIC, DIRECT\n")
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert increments(results) == pytest.approx(np.full(10, 0.1), rel=1e-9)


@pytest.mark.parametrize("cuts", [1, 3])
def test_a_failed_increment_is_cut_as_often_as_allowed(run, cuts):
    """With a single iteration all fail: D_F of the increment each time, and I_A cut-backs."""
    process, results = run(times(1, 1, 1, cuts, first=0.5, smallest=1e-6), name="cut")
    assert process.returncode == 2
    assert results is None or len(results.times) == 1
    tried = [line.split() for line in process.stdout.splitlines() if "cut:" in line]
    assert [float(words[5]) for words in tried] == pytest.approx([0.5 * 0.25**k for k in range(cuts + 1)], rel=1e-5)


def test_an_increment_that_is_nearly_in_balance_is_not_cut(run):
    """Newton's method has no more than its last, quadratic iterations left after I_C."""
    # bends the wire into a hook
    strong = LOAD.replace(", 10", ", 60")
    _, free = run(times(50, 49, 1, 8, first=1.0).replace(LOAD, strong), name="free")
    needed = int(free.status["iterations"][0])
    assert needed > 4
    process, results = run(times(needed - 2, 1, 1, 8, first=1.0).replace(LOAD, strong), name="short")
    assert process.returncode == 0, process.stderr
    assert results.status["attempts"][0] == 1
    assert results.status["iterations"][0] == needed


def test_an_increment_is_not_cut_below_the_smallest(run):
    process, _ = run(times(1, 1, 1, 8, first=0.5, smallest=0.1))
    assert process.returncode == 2
    tried = [line.split() for line in process.stdout.splitlines() if "cut:" in line]
    assert [float(words[5]) for words in tried] == pytest.approx([0.5, 0.125], rel=1e-5)


def test_no_crumb_is_left_before_the_end_of_a_step(run):
    """What is left and is longer than one increment but shorter than two is halved."""
    process, results = run(times(50, 49, 1, 8, first=0.3))
    assert process.returncode == 0, process.stderr
    assert increments(results) == pytest.approx([0.3, 0.3, 0.2, 0.2], rel=1e-9)


def test_a_step_keeps_the_settings_of_the_one_before(run):
    """Settings are given in the first step alone: in the second, too, every increment is slow."""
    deck = times(50, 1, 1, 8, first=0.2, smallest=0.08)
    again = f"*STEP, INC=500\n*STATIC\n 0.2, 1, 0.08, 1\n{LOAD.replace('10', '20')}\n*END STEP\n"
    process, results = run(deck + again)
    assert process.returncode == 0, process.stderr
    second = increments(results)[results.steps[1:] == 2]
    assert second[:5] == pytest.approx([0.2, 0.15, 0.1125, 0.084375, 0.08], rel=1e-9)


def test_more_fixed_increments_than_allowed_are_refused_before_the_run(run):
    deck = times(50, 49, 48, 8, first=0.001).replace("*STATIC\n", "*STATIC, DIRECT\n")
    process, _ = run(deck)
    assert process.returncode == 1
    assert "the step needs 1000 increments at least, but INC allows 500" in process.stderr
