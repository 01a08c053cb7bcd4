"""Wires that overlap at the start: resolving the overlap does the work that the contacts and the wires then hold."""

import numpy as np
import pytest

from decks import MATERIAL, crossed, straight, wire
from litz import Results
from same_results import KEEP_ALL

PENALTY, OVERLAP = 1e5, 4e-5
LINEAR = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {PENALTY:g}"
ENERGIES = "*ENERGY PRINT\n"
#: Riemann's zeta function at -3/2
ZETA = -0.02548520188983303


def fit(n, *, held=True, extra=ENERGIES, **changes):
    """Crossed wires of 1 mm radius that overlap by 0.04 mm, resolved in n increments; every node is held, or the ends."""
    deck = crossed(
        height=f"{2e-3 - OVERLAP:.17g}", pair=", INTERFERENCE FIT", push="0", extra=extra,
        **{"behavior": LINEAR, "static": f"{1 / n:.17g}, 1, 1e-4, {1 / n:.17g}", **changes},
    )  # fmt: skip
    return deck.replace(" LOWER_ENDS, 1, 6\n", " LOWER, 1, 6\n UPPER, 1, 6\n") if held else deck


@pytest.mark.parametrize("n", [1, 2, 10, 100])
def test_the_work_of_a_penalty_is_its_energy(run, n):
    """The force is linear in the overlap, for which the trapezoid rule is exact in any number of increments."""
    process, results = run(fit(n))
    assert process.returncode == 0, process.stderr
    energy = PENALTY * (OVERLAP * np.arange(1, n + 1) / n) ** 2 / 2
    # the overlap is a difference of positions of 2 mm: 1e-16*2e-3/4e-5 of it, smaller ones a hundred times that
    assert results.history["ALLCCE"][-n:] == pytest.approx(energy, rel=1e-11)
    assert results.history["ALLWK"][-n:] == pytest.approx(energy, rel=1e-11)
    assert np.abs(results.history["ETOTAL"]).max() < 1e-12 * energy[-1]


@pytest.mark.parametrize("n", [1, 2, 10, 100])
def test_the_work_of_hertz_has_the_error_of_the_trapezoid_rule(run, n):
    """`F ~ d^(3/2)`: by Euler and Maclaurin, with zeta(-3/2) for the root at 0, the rule with n intervals is
    `2/5 + 1/(8 n^2) + zeta(-3/2)/n^(5/2)` and terms of `1/n^4`."""
    process, results = run(fit(n, behavior="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"))
    assert process.returncode == 0, process.stderr
    history = results.history
    expected = 1 + (0.125 / n**2 + ZETA / n**2.5) / 0.4
    # the next term is f'''(1)/720 = 1/1920, over 2/5
    assert history["ALLWK"][-1] / history["ALLCCE"][-1] == pytest.approx(expected, abs=0.0014 / n**4 + 1e-11)


def error_of_balance(process, results):
    assert process.returncode == 0, process.stderr
    assert results.history["ALLSE"][-1] > 0.05 * results.history["ALLWK"][-1]
    return abs(results.history["ETOTAL"][-1]) / results.history["ALLWK"][-1]


def test_the_balance_of_wires_that_give_way_closes_with_the_square_of_the_increment(run):
    """Their ends are held along the axes too, so that they stiffen as they bend: the rule is no longer exact."""
    errors = [error_of_balance(*run(fit(n, held=False))) for n in (4, 8, 16)]
    assert errors[0] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.01)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.01)


def test_an_increment_that_is_cut_leaves_no_work_behind(run):
    """With turns of at most 8e-5 an iteration, four of them do not resolve the whole overlap."""
    controls = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , 4\n*CONTROLS, PARAMETERS=ROTATION\n 8e-5\n"
    process, results = run(fit(1, held=False, extra=ENERGIES + controls))
    assert results.status["attempts"].max() > 1
    # no increment is longer than a half: at most the error of two equal ones
    halves = error_of_balance(*run(fit(2, held=False)))
    assert error_of_balance(process, results) < 1.01 * halves


def test_a_later_step_adds_no_work_of_the_fit(run):
    step = "*STEP\n*STATIC\n 0.5, 1\n*END STEP\n"
    process, results = run(fit(4) + step)
    assert process.returncode == 0, process.stderr
    assert results.history["ALLWK"][-2:] == pytest.approx(PENALTY * OVERLAP**2 / 2, rel=1e-11)


def test_each_crossing_of_a_pair_has_its_own_fit(run):
    """Overlaps of 40 and 10 um are resolved down to what is left at the time; a third wire only touches, and is pressed."""
    overlaps = {"DEEP": 4e-5, "SHALLOW": 1e-5, "NONE": 0.0}
    press, n = 2e-6, 7
    wires = wire("LOWER", straight((-0.03, 0, 0), (0.03, 0, 0), 7), 1, element="B33")
    for i, (name, overlap) in enumerate(overlaps.items()):
        x, z = 0.015 * (i - 1), 2e-3 - overlap
        wires += wire(name, straight((x, -0.02, z), (x, 0.02, z), 5), 101 + 100 * i, element="B33")
    names = ", ".join(overlaps)
    process, results = run(f"""{wires}{MATERIAL}*ELSET, ELSET=UPPER
 {names}
*BEAM SECTION, ELSET=LOWER, MATERIAL=STEEL, SECTION=CIRC
 1e-3
*BEAM SECTION, ELSET=UPPER, MATERIAL=STEEL, SECTION=CIRC
 1e-3
*SURFACE INTERACTION, NAME=TOUCH
{LINEAR}
*CONTACT PAIR, INTERACTION=TOUCH, INTERFERENCE FIT
 LOWER, UPPER
*BOUNDARY
 LOWER, ENCASTRE
 DEEP, ENCASTRE
 SHALLOW, ENCASTRE
 NONE, 1, 2
 NONE, 4, 6
*STEP
*STATIC, DIRECT
 {1 / n}, 1
*BOUNDARY
 NONE, 3, 3, {-press}
*END STEP
""")
    assert process.returncode == 0, process.stderr
    for increment in range(1, n + 1):
        time = increment / n
        left = overlaps["DEEP"] * (1 - time)
        expected = [overlap - min(overlap, left) for overlap in overlaps.values()]
        expected[2] = press * time
        contacts = results.contacts_at(increment)
        # where less is resolved than would close it, a crossing is no contact
        assert len(contacts["id"]) == np.count_nonzero(expected)
        force = [contacts["force"][contacts["element_2"] // 100 == 1 + i].sum() for i in range(3)]
        np.testing.assert_allclose(force, PENALTY * np.array(expected), rtol=1e-8, atol=1e-8)


def test_a_run_that_goes_on_knows_how_much_was_resolved(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(fit(5, extra=ENERGIES + KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "whole").returncode == 0
    for increment in (1, 4):
        place = f"{tmp_path / 'whole' / 'deck.restart.h5'}:1:{increment}"
        done = litz("run", deck, "-o", tmp_path / f"part_{increment}", "--restart", place)
        assert done.returncode == 0, done.stderr
        history = Results(tmp_path / f"part_{increment}").history
        assert history["ALLWK"][-1] == pytest.approx(PENALTY * OVERLAP**2 / 2, rel=1e-11)


def test_a_run_that_goes_on_in_a_later_step_has_no_interference_left(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(fit(2, extra=ENERGIES + KEEP_ALL) + "*STEP\n*STATIC, DIRECT\n 0.25, 1\n*END STEP\n")
    assert litz("run", deck, "-o", tmp_path / "whole").returncode == 0
    place = f"{tmp_path / 'whole' / 'deck.restart.h5'}:2:1"
    done = litz("run", deck, "-o", tmp_path / "part", "--restart", place)
    assert done.returncode == 0, done.stderr
    part = Results(tmp_path / "part")
    assert part.contacts["force"] == pytest.approx([PENALTY * OVERLAP] * 4, rel=1e-11)
    assert part.history["ALLWK"][-1] == pytest.approx(PENALTY * OVERLAP**2 / 2, rel=1e-11)
