"""Every accepted increment is audited: figures in the .sta file and the results, a failed audit is a failed run."""

import re

import numpy as np
import pytest

from decks import crossed

FIGURES = ("force_balance", "moment_balance", "current_balance", "power_balance", "penetration_ratio")
SOFT = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {}"


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_the_worst_figures_stand_in_the_sta_file_and_in_the_results(run, element):
    process, results = run(crossed(element=element, static="0.25, 1", push="-5e-4"))
    assert process.returncode == 0, process.stderr
    assert set(results.audit) == set(FIGURES)
    for name in FIGURES:
        # three digits in the table; the results begin with the start
        np.testing.assert_allclose(results.audit[name][1:], results.status[name], rtol=6e-3, atol=1e-99)
    for name in FIGURES[:4]:
        # equilibrium is found to R_n = 1e-8
        assert results.audit[name].max() < 1e-7
    gap = [results.contacts_at(k)["gap"].min() for k in range(1, len(results.times))]
    np.testing.assert_allclose(results.audit["penetration_ratio"][1:], -np.array(gap) / 1e-3, rtol=1e-12)


def test_a_tolerance_that_lets_a_wrong_answer_pass_is_caught(run):
    """With R_n = 5 the iteration calls converged what it has after the first iteration."""
    loose = "*CONTROLS, PARAMETERS=FIELD\n 5\n"
    process, results = run(crossed(push="-2e-3", extra=loose))
    assert process.returncode == 2
    assert "fails its audit" in process.stderr
    assert "do not balance" in process.stderr
    assert "audit failed" in results.status["remark"][-1]
    # the start is there, the wrong increment is not
    assert results.times.tolist() == [0]


@pytest.mark.parametrize("coupling", ["MONOLITHIC", "UPDATED"])
def test_the_noise_of_currents_that_have_ended_passes(run, coupling):
    """One current ramps to zero; another enters where the potential is prescribed, and leaves there at once."""
    deck = crossed(static="0.5, 1", extra=f"*SOLVER, NAME=UMFPACK, COUPLING={coupling}")
    feed = "*STEP\n*STATIC\n*CECURRENT\n 11, 9, 2.5\n*END STEP\n"
    end = "*STEP\n*STATIC, DIRECT\n 0.25, 1\n*CECURRENT, OP=NEW\n 1, 9, -2.5\n*BOUNDARY\n UPPER_ENDS, 1, 1, 1e-4\n*END STEP\n"
    for line, changed in ((" 1, 9, 9, 1e-3\n", " 1, 9\n"), (" 11, 9, 9, 0\n", "")):
        assert line in deck
        deck = deck.replace(line, changed)
    process, results = run(deck + feed + end)
    assert process.returncode == 0, process.stderr
    assert np.abs(results.field("reaction_current", -1)[0]) == pytest.approx(2.5, rel=1e-12)
    assert np.abs(results.field("element_current", -1)).max() < 1e-8
    # a part of the noise that there is
    assert results.audit["power_balance"][-1] <= 1e-4
    assert results.audit["power_balance"][:-1].max() < 1e-7


def test_a_deep_overlap_ends_the_run_and_names_the_wires_and_the_penalty_that_cures_it(run):
    penalty, refusals = 1e3, 0
    for attempt in range(8):
        process, results = run(crossed(behavior=SOFT.format(penalty), push="-5e-4"), name=f"attempt{attempt}")
        assert (results.audit["penetration_ratio"] <= 0.05).all()
        if process.returncode == 0:
            break
        assert process.returncode == 2
        found = re.search(
            r"the wires of elements 3 and 13 overlap by (\S+) % of the smaller radius, 5 % are allowed\. "
            r"The contact force there requires a penalty of at least (\S+) N/m",
            process.stderr,
        )
        assert found, process.stderr
        assert float(found[1]) > 5
        refusals += 1
        # stiffer contacts carry more force, and so do later times: the advice is followed with a margin
        penalty = 2 * float(found[2])
    assert process.returncode == 0, process.stderr
    assert refusals > 0
    assert results.finished


def test_an_overlap_that_is_meant_needs_no_warning(run):
    soft = SOFT.format("1e3").replace("=LINEAR", "=LINEAR, PENETRATION=UNLIMITED")
    process, results = run(crossed(behavior=soft, push="-5e-4"))
    assert process.returncode == 0, process.stderr
    assert "overlaps" not in results.status["remark"][-1]
