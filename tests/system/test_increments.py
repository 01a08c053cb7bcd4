"""Increments through snaps, touches and separations; what a run leaves and says that has to give up."""

import numpy as np
import pytest

from decks import MATERIAL, cantilever, crossed, grid, wire
from litz import Results

RISE, SPAN = 0.0012, 0.2


def arch(card, static, extra=""):
    """A shallow arch of steel, a half sine wave of 1.2 mm rise over 200 mm, both ends pinned; node 11 is its crown."""
    x = np.linspace(0, SPAN, 21)
    points = np.c_[x, 0 * x, RISE * np.sin(np.pi * x / SPAN)]
    return f"""{wire("WIRE", points, element="B31")}{MATERIAL}\
*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC
 0.5e-3
*NSET, NSET=ENDS
 1, 21
*BOUNDARY
 ENDS, PINNED
 ENDS, 4
 ENDS, 6
*STEP, INC=500
*STATIC
 {static}
{card}
*NODE PRINT, NSET=ENDS, TOTALS=ONLY
 RF
{extra}
*END STEP
"""


def snap_load():
    """Limit load of the first symmetric mode: `w = a sin(pi x/l)` from `h sin(pi x/l)` to `q sin(pi x/l)` under a load `P`.

    With `N = EA (h^2 - q^2) pi^2/(4 l^2)` the balance of work is `P = (l/2) (EI (pi/l)^4 (h - q) - N (pi/l)^2 q)`.
    """
    young, radius = 200e9, 0.5e-3
    area, inertia = np.pi * radius**2, np.pi * radius**4 / 4
    q = np.linspace(-RISE, RISE, 20001)
    thrust = young * area * (RISE**2 - q**2) * np.pi**2 / (4 * SPAN**2)
    wave = np.pi / SPAN
    return (SPAN / 2 * (young * inertia * wave**4 * (RISE - q) + thrust * wave**2 * q)).max()


def test_a_snap_through_is_followed_by_its_displacement(run):
    down = "*BOUNDARY\n 11, 1\n 11, 3, 3, -0.003\n 11, 4, 6"
    process, results = run(arch(down, "0.05, 1, 1e-4, 0.05"))
    assert process.returncode == 0, process.stderr
    # symmetric by the supports of the crown: the load rises, falls below zero, and rises again
    load = results.history["RF3 sum ENDS"]
    crown = results.field("displacement", None)[:, 10, 2]
    peak = load[crown > -RISE].argmax()
    valley = load[crown < -RISE].argmin() + (crown >= -RISE).sum()
    assert load[valley] < 0 < load[-1]
    # one sine wave is a little too stiff, and the increments pass near the peak
    assert 0.95 * snap_load() < load[peak] < snap_load()


def test_a_load_beyond_the_limit_jumps_or_says_what_to_do(run):
    load = f"*BOUNDARY\n 11, 1\n 11, 4, 6\n*CLOAD\n 11, 3, {-1.5 * snap_load():.6g}"
    process, results = run(arch(load, "0.1, 1, 1e-3, 0.1"))
    if process.returncode == 0:
        # on the other side of the snap
        assert results.field("displacement")[10, 2] < -2 * RISE
    else:
        assert process.returncode == 2
        assert "beyond a critical load: prescribe a displacement" in process.stderr
    # up to the limit every increment is there, and none beyond it has its crown in between
    assert results.times[-1] > 0.95 / 1.5
    crown = results.field("displacement", None)[:, 10, 2]
    assert len(crown) > 5
    assert not ((crown < -0.7 * RISE) & (crown > -1.7 * RISE)).any()


@pytest.mark.parametrize("height", [2.00001e-3, 2.1e-3, 3e-3])
def test_first_touch_within_an_increment(run, height):
    process, results = run(crossed(height=height, push="-1.5e-3", static="0.25, 1"))
    assert process.returncode == 0, process.stderr
    touched = np.flatnonzero(np.isin(results.increments, results.contacts["increment"]))
    assert touched[0] >= 1
    assert touched[-1] == len(results.times) - 1
    assert (results.contacts["force"] > 0).all()


def test_a_hundred_contacts_close_and_open_at_once(run):
    opened = "*STEP\n*STATIC\n 1., 1.\n*BOUNDARY\n UPPER, 3, 3, 1e-4\n*END STEP\n"
    process, results = run(grid(10) + opened)
    assert process.returncode == 0, process.stderr
    assert [len(results.contacts_at(k)["id"]) for k in range(3)] == [0, 100, 0]
    assert results.status["attempts"].tolist() == [1, 1]
    # 0.1 A flowed before
    assert np.abs(results.field("reaction_current")).max() < 1e-12


def test_wires_that_separate_carry_no_force_and_no_current(run):
    apart = "*STEP, INC=200\n*STATIC\n 0.3, 1\n*BOUNDARY\n UPPER_ENDS, 3, 3, 1e-3\n*END STEP\n"
    process, results = run(crossed(push="-5e-4", static="0.5, 1") + apart)
    assert process.returncode == 0, process.stderr
    assert len(results.contacts_at(-1)["id"]) == 0
    assert np.abs(results.field("reaction_force")).max() < 1e-6
    assert np.abs(results.field("reaction_current")).max() < 1e-12


HOPELESS = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n ,,,{},,,,{}\n"


@pytest.fixture
def gave_up(run):
    """A run with two good increments whose second step allows too few iterations, and its directory."""
    second = "*STEP\n*STATIC\n 1., 1.\n*BOUNDARY\n UPPER_ENDS, 3, 3, -4e-3\n" + HOPELESS.format(2, 1) + "*END STEP\n"
    process, results = run(crossed(push="-1e-4", static="0.5, 1") + second)
    return process, results, results.path.parent


def test_giving_up_keeps_the_converged_states_and_writes_the_iterate_beside_them(gave_up):
    process, results, directory = gave_up
    assert process.returncode == 2
    assert results.steps.tolist() == [0, 1, 1]
    with pytest.warns(UserWarning, match="did not finish"):
        iterate = Results(directory / "deck_unconverged.vtkhdf")
    assert (iterate.steps.tolist(), iterate.increments.tolist()) == ([2], [1])
    # the prescribed values are those of the increment that failed
    last_try = results.status["time_increment"][-1]
    lifted = iterate.field("displacement")[np.flatnonzero(iterate.node_ids == 11)[0], 2]
    assert lifted == pytest.approx(-1e-4 - last_try * (4e-3 - 1e-4), rel=1e-9)
    assert len(iterate.contacts["id"]) == 1
    assert (directory / "deck_unconverged_contacts.vtkhdf").exists()


def test_the_message_names_node_contact_and_setting(gave_up):
    process, _, _ = gave_up
    for words in (
        "step 2, increment 1 did not converge",
        "after 2 iterations, at node ",
        "contact that has converged least is that of elements 3 and 13",
        "The maximum number of cut-backs is reached (I_A of *CONTROLS, PARAMETERS=TIME INCREMENTATION, now 1)",
        "The results hold all increments before",
        "deck_unconverged",
    ):
        assert words in process.stderr, words


def test_a_later_run_that_converges_removes_the_iterate(litz, gave_up):
    _, _, directory = gave_up
    deck = directory.parent / "deck.inp"
    deck.write_text(deck.read_text().replace(HOPELESS.format(2, 1), ""))
    assert litz("run", deck, "-o", directory).returncode == 0
    assert not list(directory.glob("*unconverged*"))


def test_settings_that_would_help_are_named(run):
    direct = crossed(push="-4e-3", extra=HOPELESS.format(2, 1)).replace("*STATIC", "*STATIC, DIRECT")
    process, _ = run(direct, name="direct")
    assert process.returncode == 2
    assert "remove DIRECT" in process.stderr
    process, _ = run(crossed(push="-4e-3", static="1, 1, 0.5", extra=HOPELESS.format(2, 8)), name="smallest")
    assert process.returncode == 2
    assert "third value of *STATIC, now 0.5" in process.stderr
    process, _ = run(crossed(push="-4e-3", static="1, 1, 1e-3", extra=HOPELESS.format(4, 1)), name="slow")
    if process.returncode:
        assert "I_C of *CONTROLS" in process.stderr or "smaller increments" in process.stderr


def test_a_wire_thrown_onto_another_is_caught_in_its_first_step(run):
    """A load on a slender wire: the first linear step by itself would take it through the other one, by 5 mm. It is taken
    anew with the contact that it closes."""
    load = "*CLOAD\n 13, 3, -40\n 14, 3, -40\n"
    process, results = run(crossed(height="2.2e-3", push="0", static="1, 1", extra=load))
    assert process.returncode == 0, process.stderr
    table = results.convergence
    assert table["penetration"].max() < 0.05e-3
    assert table["active"][1] == 1
    assert table["iteration"].max() <= 5


@pytest.mark.parametrize(("c_n", "iterations"), [(0, 3), (1e-3, 3), (1e-9, 5)])
def test_corrections_are_small_at_the_end_where_that_is_asked_for(run, c_n, iterations):
    """C_n = 0 asks for nothing; quadratic convergence takes corrections of 7, 0.02 and 3e-7 % of the way."""
    load = f"*CONTROLS, PARAMETERS=FIELD\n 1e-3, {c_n}\n*CLOAD\n 11, 2, 5\n"
    process, results = run(cantilever(load))
    assert process.returncode == 0, process.stderr
    corrections = results.convergence["displacement"]
    assert len(corrections) == iterations + 1
    if c_n > 0:
        assert corrections[-1] <= c_n * np.abs(results.field("displacement")).max()


def test_no_iteration_turns_a_node_farther_than_allowed(run):
    """A cap of 0.1 rad: the first iterations turn the tip by just that, until less is left."""
    cap = "*CONTROLS, PARAMETERS=ROTATION\n 0.1\n*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , 40\n"
    process, results = run(cantilever(f"{cap}*CLOAD\n 11, 2, 20"))
    assert process.returncode == 0, process.stderr
    turned = results.convergence["rotation"][1:]
    assert results.field("rotation")[10, 2] > 0.4
    assert turned[:4] == pytest.approx(0.1, rel=1e-3)
    assert turned.max() < 0.1001
