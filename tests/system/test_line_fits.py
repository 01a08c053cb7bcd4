"""Wires side by side that overlap at the start: an interference fit along a line is resolved place by place."""

import numpy as np
import pytest
from verification.references.parallel_wires import ParallelWires

from decks import wire
from line_wires import (
    COPPER,
    HERTZ,
    LED,
    LOWER,
    UPPER,
    along,
    linear,
    lowered,
    material,
    step,
    two_wires,
)  # fmt: skip
from litz import Results
from same_results import KEEP_ALL, assert_same_end

NO_FIELD = "*BOUNDARY\n LOWER, 9, 9, 0.\n UPPER, 9, 9, 0.\n"
OVERLAP, LENGTH, PENALTY = 1e-5, 20e-3, 5e10
HELD = "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, ENCASTRE\n"
FIT = ", INTERFERENCE FIT"


def solved(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results


def pressed_in(n, *, overlap=OVERLAP, degrees=0.0, elements=(8, 11), cards=(), **model):
    """Two wires that overlap, all nodes held: nothing but the fit can happen in the n increments of the first step."""
    lower = along(LENGTH, elements[0], start=-LENGTH / 2)
    upper = along(LENGTH, elements[1], start=-LENGTH / 2, degrees=degrees, height=2 * COPPER.radius - overlap)
    steps = step(NO_FIELD, "*ENERGY PRINT\n", *cards, static=f"{1 / n:.17g}, 1., 1e-4, {1 / n:.17g}")
    return two_wires(lower, upper, HELD, steps, pair=FIT, **model)


@pytest.mark.parametrize(
    ("law", "exact"),
    [(linear("", PENALTY), lambda overlap: PENALTY * overlap), (HERTZ, ParallelWires(COPPER, COPPER).force)],
    ids=["penalty", "Hertz"],
)
def test_the_force_per_length_is_that_of_what_has_been_resolved(run, law, exact):
    n = 5
    results = solved(run(pressed_in(n, law=law)))
    for increment in range(1, n + 1):
        contacts = results.contacts_at(increment)
        per_length = exact(OVERLAP * increment / n)
        # the overlap is a difference of positions of 2 mm: 1e-16*2e-3/2e-6 of it
        assert contacts["force"] / contacts["length"] == pytest.approx(per_length, rel=1e-9)
        assert contacts["force"].sum() == pytest.approx(per_length * LENGTH, rel=1e-9)


@pytest.mark.parametrize("n", [1, 3])
def test_the_work_of_a_penalty_is_its_energy(run, n):
    """The force is linear in what has been resolved, for which the trapezoid rule is exact."""
    history = solved(run(pressed_in(n, law=linear("", PENALTY)))).history
    energy = PENALTY * (OVERLAP * np.arange(1, n + 1) / n) ** 2 / 2 * LENGTH
    assert history["ALLCCE"][-n:] == pytest.approx(energy, rel=1e-9)
    assert history["ALLWK"][-n:] == pytest.approx(energy, rel=1e-9)


@pytest.mark.parametrize("law", [linear("", PENALTY), HERTZ], ids=["penalty", "Hertz"])
@pytest.mark.parametrize("degrees", [0.0, 0.3, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0])
def test_a_fit_is_resolved_as_if_the_wires_came_down_from_their_touch(run, law, degrees):
    """From parallel to crossed: a crossing, places of a line, and both with their shares."""
    n = 4
    fit = solved(run(pressed_in(n, degrees=degrees, law=law), name="fit"))
    above = [along(LENGTH, 8, start=-LENGTH / 2), along(LENGTH, 11, start=-LENGTH / 2, degrees=degrees, height=2e-3)]
    down = solved(
        run(two_wires(*above, LED, lowered(OVERLAP, NO_FIELD, static=f"{1 / n}, 1., 1e-4, {1 / n}"), law=law))
    )
    for increment in range(1, n + 1):
        ours, theirs = (results.contacts_at(increment)["force"].sum() for results in (fit, down))
        # the axes are nearer by the overlap that is left, 5e-3 of their distance, of whose root a lens is as long
        assert ours == pytest.approx(theirs, rel=5e-3)


def test_each_place_has_its_own_fit(run):
    """A wire that rises by 5 um over its length: the fit of every place is resolved down to what is left at the time."""
    n, rise = 4, 5e-6
    s = np.linspace(-LENGTH / 2, LENGTH / 2, 9)
    upper = np.column_stack([s, 0 * s, 2e-3 - OVERLAP + rise * (s / LENGTH + 0.5)])
    deck = two_wires(
        along(LENGTH, 8, start=-LENGTH / 2), upper, HELD, step(NO_FIELD, static=f"{1 / n}, 1., 1e-4, {1 / n}"),
        pair=FIT, law=linear("", PENALTY),
    )  # fmt: skip
    results = solved(run(deck))
    for increment in range(1, n + 1):
        contacts = results.contacts_at(increment)
        place = contacts["point_1_x"]
        resolved = OVERLAP * increment / n - rise * (place / LENGTH + 0.5)
        assert resolved.min() > -1e-12
        # the feet lie beside the places by the slope of 2.5e-4 times the radius
        assert contacts["force"] / contacts["length"] == pytest.approx(PENALTY * resolved, abs=1e-3 * PENALTY * OVERLAP)
        assert contacts["length"].sum() == pytest.approx(min(1, OVERLAP * increment / n / rise) * LENGTH, abs=0.5e-3)


def test_a_run_that_goes_on_in_the_first_step_knows_how_much_was_resolved(litz, tmp_path):
    (tmp_path / "deck.inp").write_text(pressed_in(5, degrees=10.0, cards=(KEEP_ALL,), law=HERTZ))
    done = litz("run", "deck.inp", "-o", "whole", "--threads", 1, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    whole = Results(tmp_path / "whole")
    assert {0.0} < set(whole.contacts["length"])
    for increment in (1, 3):
        part = f"part_{increment}"
        place = f"whole/deck.restart.h5:1:{increment}"
        done = litz("run", "deck.inp", "-o", part, "--threads", 1, "--restart", place, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        assert_same_end(whole, Results(tmp_path / part), 1, increment)


def test_a_pair_that_only_touches_is_pressed_while_a_fit_of_its_contact_pair_is_resolved(run):
    press, n = 2e-6, 4
    chains = "".join(
        wire(name, along(LENGTH, 8, height=z) + np.array([0, y, 0]), 1000 * i + 1, element="B33")
        for i, (name, y, z) in enumerate(
            [("LOW_1", 0, 0), ("DEEP", 0, 2e-3 - OVERLAP), ("LOW_2", 0.01, 0), ("LED", 0.01, 2e-3)]
        )
    )
    sets = "*ELSET, ELSET=LOWER\n LOW_1, LOW_2\n*ELSET, ELSET=UPPER\n DEEP, LED\n"
    deck = (
        chains + sets + material("LOWER", COPPER) + material("UPPER", COPPER)
        + f"*SURFACE INTERACTION, NAME=TOUCH\n{linear('', PENALTY)}*CONTACT PAIR, INTERACTION=TOUCH{FIT}\n LOWER, UPPER\n"
        + "*BOUNDARY\n LOW_1, ENCASTRE\n LOW_2, ENCASTRE\n DEEP, ENCASTRE\n LED, 1, 2\n LED, 4, 6\n"
        + step("*BOUNDARY\n" + "".join(f" {name}, 9, 9, 0.\n" for name in ("LOW_1", "LOW_2", "DEEP", "LED")),
               boundary=f" LED, 3, 3, {-press}\n",
               static=f"{1 / n}, 1., 1e-4, {1 / n}")
    )  # fmt: skip
    results = solved(run(deck))
    for increment in range(1, n + 1):
        contacts = results.contacts_at(increment)
        is_led = np.maximum(contacts["element_1"], contacts["element_2"]) > 2 * UPPER
        for those, overlap in ((is_led, press), (~is_led, OVERLAP)):
            force = contacts["force"][those].sum()
            assert force == pytest.approx(PENALTY * overlap * increment / n * LENGTH, rel=1e-8)


def test_a_place_that_a_fit_closes_slips_from_where_it_has_closed(run):
    """Lifted off first, and lowered while half of the fit is resolved: it touches half-way, and slips the other half."""
    unit, slip = 2e-7, 1e-9
    wires = along(24e-3, 8, start=-12e-3), along(LENGTH, 8, start=-LENGTH / 2, height=2e-3 - 4 * unit)
    deck = two_wires(
        "*AMPLITUDE, NAME=LIFT\n 0, 0, 0.25, 1, 0.5, 0\n*AMPLITUDE, NAME=DRAG\n 0, 0, 0.25, 0, 0.5, 1\n"
        + wire("LOWER", wires[0], LOWER, element="B33"), wires[1], LED,
        "*STEP\n*STATIC, DIRECT\n 0.25, 1.\n", NO_FIELD,
        f"*BOUNDARY, AMPLITUDE=LIFT\n UPPER, 3, 3, {3 * unit}\n*BOUNDARY, AMPLITUDE=DRAG\n UPPER, 1, 1, {slip}\n*END STEP\n",
        law=linear("", PENALTY) + "*FRICTION\n 0.5\n", pair=FIT,
    )  # fmt: skip
    contacts = solved(run(deck)).contacts_at(2)
    # gap of the law: 2 units at the start of the second increment, minus 2 at its end
    assert contacts["force"] / contacts["length"] == pytest.approx(PENALTY * 2 * unit, rel=1e-8)
    mindlin = 2 * (1 - COPPER.poisson) / (2 - COPPER.poisson)
    traction = abs(contacts["traction_x"]) / contacts["length"]
    at_ends = contacts["length"] > 1.01 * np.median(contacts["length"])
    assert traction[~at_ends] == pytest.approx(mindlin * PENALTY * slip / 2, rel=1e-7)
    # next to the end of the other wire a place stands for a length that changes by the slip
    assert traction == pytest.approx(mindlin * PENALTY * slip / 2, rel=slip / contacts["length"].min())
