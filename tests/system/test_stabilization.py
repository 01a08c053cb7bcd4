"""*CONTROLS, PARAMETERS=STABILIZE: loose wires and snaps become solvable, and what it takes is shown."""

import numpy as np
import pytest

from decks import cantilever, crossed, pair_of_wires, straight, wire
from test_increments import RISE, arch, snap_load

STABILIZE = "*CONTROLS, PARAMETERS=STABILIZE\n {}\n"
LOOSE = "*ENERGY PRINT\n"


def loose(extra, height="2.1e-3", rest=""):
    """The upper wire is held by nothing: forces push it onto the lower one, 0.1 mm away at the start."""
    text = crossed(height=height, extra=extra + LOOSE + "*CLOAD\n 13, 3, -0.5\n 14, 3, -0.5\n" + rest, static="0.1, 1")
    for line in (" UPPER_ENDS, 1, 2\n", " UPPER_ENDS, 4, 6\n", " UPPER_ENDS, 3, 3, -1e-4\n"):
        assert line in text
        text = text.replace(line, "")
    return text


def test_a_wire_that_only_an_open_contact_could_hold_is_named_before_the_solve(run):
    process, _ = run(loose(""))
    assert process.returncode == 2
    warning, error = process.stderr.split("error: ")
    assert "nothing holds UPPER" in warning
    assert "PARAMETERS=STABILIZE" in warning
    assert "The equation is that of the" in error
    assert "PARAMETERS=STABILIZE" in error


def test_a_loose_wire_falls_onto_the_other_and_rests_there(run):
    """Forces of 0.5 N at 5 and 6 mm from the contact do not balance about it: a counter-force does."""
    process, results = run(loose(STABILIZE.format("1e-6"), rest=" 16, 3, -0.01\n"))
    assert process.returncode == 0, process.stderr
    assert len(results.contacts_at(-1)["id"]) == 1
    taken = results.history["ALLSD"]
    assert (np.diff(taken) >= 0).all()
    assert taken[-1] > 0
    assert "stabilization has taken" in results.status["remark"][-1]
    # the audit holds with the damping as a force
    assert max(figure.max() for name, figure in results.audit.items() if name.endswith("balance")) < 1e-6


def test_what_moves_no_more_is_not_resisted(run):
    """Held wires: a second step in which nothing changes ends in the equilibrium without stabilization."""
    hold = "*STEP\n*STATIC\n 1, 1\n*END STEP\n"
    _, free = run(crossed(push="-5e-4", static="0.25, 1") + hold, name="free")
    _, damped = run(crossed(push="-5e-4", static="0.25, 1", extra=STABILIZE.format("1e-5")) + 3 * hold, name="damped")
    end = {results: results.contacts["force"][results.contacts["step"] == 1][-1] for results in (free, damped)}
    assert abs(end[damped] / end[free] - 1) > 1e-6
    # the steps in which nothing else moves relax what the damping had held up
    assert damped.contacts["force"][-1] == pytest.approx(free.contacts["force"][-1], rel=1e-6)


def test_a_snap_is_damped_and_ends_on_the_other_side(run):
    load = f"*BOUNDARY\n 11, 1\n 11, 4, 6\n*CLOAD\n 11, 3, {-1.5 * snap_load():.6g}"
    process, results = run(arch(load, "0.05, 1, 1e-7, 0.05", STABILIZE.format("1e-7")))
    assert process.returncode == 0, process.stderr
    assert results.field("displacement")[10, 2] < -2 * RISE


@pytest.mark.parametrize("smallest", [6e-3, 3e-3, 1.5e-3, 7e-4, 4e-4])
def test_a_snap_without_pivots_to_tell_it_is_guessed_from_increments_that_fail_at_any_size(run, smallest):
    """A moment about an axis fixed in space makes the stiffness unsymmetric: no count of negative pivots.

    Nor does it matter whether the last increment was cut itself, or those before it were."""
    load = f"*BOUNDARY\n 11, 1\n 11, 4\n*CLOAD\n 11, 3, {-1.5 * snap_load():.6g}\n 11, 6, 1e-6"
    process, _ = run(arch(load, f"0.2, 1, {smallest}, 0.2"))
    assert process.returncode == 2
    assert "Smaller increments did not help" in process.stderr
    assert "PARAMETERS=STABILIZE" in process.stderr
    assert "*FRICTION" in process.stderr


def test_without_it_nothing_is_taken(run):
    process, results = run(crossed(extra=LOOSE))
    assert process.returncode == 0, process.stderr
    assert (results.history["ALLSD"] == 0).all()
    assert "stabilization" not in results.status["remark"][-1]


def test_a_loose_wire_moves_by_its_load_over_the_damping(run):
    """Pushed along itself alike at all nodes: `F_k/(s n)` in each of n increments, with s of the factor and E A/l."""
    n, factor, force = 4, 1e-4, 0.5
    first = wire("A", straight((0, 0, 0), (0.1, 0, 0), 5))
    far = wire("B", straight((0, -0.01, 1), (0, 0.01, 1), 1), 101)
    deck = pair_of_wires(first, far, " A, 2, 6\n B, ENCASTRE\n", static=f"{1 / n}, 1, 1e-4, {1 / n}")
    cards = f"{STABILIZE.format(factor)}{LOOSE}*CLOAD\n A, 1, {force}\n"
    process, results = run(deck.replace("*END STEP", cards + "*END STEP"))
    assert process.returncode == 0, process.stderr
    damping = factor * 200e9 * np.pi * 1e-3**2 / (0.1 / 5) * n
    forces = force * np.arange(1, n + 1) / n
    moved = results.field("displacement", None)[1:, :6, 0]
    np.testing.assert_allclose(moved, np.cumsum(forces / damping)[:, None] * np.ones(6), rtol=1e-6)
    # at each node mean force times way, all of it taken by the damping
    mean = (forces + np.append(0, forces[:-1])) / 2
    assert results.history["ALLSD"][1:] == pytest.approx(6 * np.cumsum(mean * forces / damping), rel=1e-6)
    assert results.history["ALLWK"] == pytest.approx(results.history["ALLSD"], rel=1e-6)


def damped_steps(card, *values, factors, **changes):
    """A cantilever with a value of the card in each step, and the factor of the damping in each."""
    steps = [
        f"{STABILIZE.format(factor)}{LOOSE}{card.format(value)}" for factor, value in zip(factors, values, strict=True)
    ]
    return cantilever(*steps, element="B33", n=2, **changes)


@pytest.mark.parametrize(
    ("card", "values"),
    [("*CLOAD\n 3, 3, {}", (1e-3, 2e-3, 0)), ("*BOUNDARY\n 3, 3, 3, {}", (1e-6, 2e-6, 0))],
    ids=["load", "prescribed displacement"],
)
@pytest.mark.parametrize("increments", [1, 5])
@pytest.mark.parametrize("factors", [(1e-3, 0, 1e-3), (0, 1e-3, 0), (1e-3, 1e-5, 1e-2)], ids=str)
def test_the_energies_balance_where_the_damping_begins_and_ends(run, card, values, increments, factors):
    """Deflections far below the length: forces are linear, and the work of their means is exact."""
    size = 1 / increments
    process, results = run(damped_steps(card, *values, factors=factors, static=f"{size}, 1, 1e-3, {size}"))
    assert process.returncode == 0, process.stderr
    taken = results.history["ALLSD"]
    assert taken.max() > 1e-3 * results.history["ALLWK"].max()
    assert np.abs(results.history["ETOTAL"]).max() < 1e-6 * results.history["ALLWK"].max()


@pytest.mark.parametrize("factor", [1e-3, 0])
def test_the_energies_balance_at_a_jump_and_while_it_is_held(run, factor):
    """The displacement is there in the first increment, and stays: what the damping held up relaxes."""
    jump = "*AMPLITUDE, NAME=JUMP\n 0, 1, 1, 1\n"
    deck = damped_steps("*BOUNDARY, AMPLITUDE=JUMP\n 3, 3, 3, {}", 1e-5, 1e-5, factors=(1e-3, factor), static="0.25, 1")
    process, results = run(jump + deck)
    assert process.returncode == 0, process.stderr
    taken = results.history["ALLSD"]
    assert taken[1] > 0.1 * results.history["ALLWK"][1]
    assert taken[-1] > taken[1]
    assert np.abs(results.history["ETOTAL"]).max() < 1e-6 * results.history["ALLWK"].max()


def test_the_balance_of_large_motions_converges_with_the_square_of_the_increment(run):
    left = []
    for n in (10, 20, 40):
        static = f"{1 / n}, 1, 1e-3, {1 / n}"
        process, results = run(damped_steps("*CLOAD\n 3, 3, {}", 30, factors=(1e-4,), static=static), name=f"in_{n}")
        assert process.returncode == 0, process.stderr
        left.append(abs(results.history["ETOTAL"][-1]) / results.history["ALLWK"][-1])
        assert results.history["ALLSD"][-1] > 0.1 * results.history["ALLWK"][-1]
    assert left[0] < 1e-2
    assert left[0] / left[1] == pytest.approx(4, rel=0.1)
    assert left[1] / left[2] == pytest.approx(4, rel=0.1)
