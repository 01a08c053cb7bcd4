"""Conductors that float for a while: where wires touch only within an increment, or no longer at its end."""

import numpy as np
import pytest

from decks import MATERIAL, cantilever, straight, wire

SOLVERS = [
    "BLOCK",
    "BLOCK, COUPLING=MONOLITHIC",
    "UMFPACK",
    "UMFPACK, COUPLING=UPDATED",
    "SKYLINE",
    pytest.param("MUMPS", marks=pytest.mark.mumps),
]
CONDUCTS = MATERIAL.replace("*ELASTIC", "*ELECTRICAL CONDUCTIVITY\n 5.88e7\n*ELASTIC")


def crossed_wires(*steps):
    """Slender wires, 10 um apart; the ends of the upper one are led, its middle is free."""
    lower = wire("LOWER", straight((-0.05, 0, 0), (0.05, 0, 0), 3), 1, element="B33")
    upper = wire("UPPER", straight((0, -0.05, 0.00201), (0, 0.05, 0.00201), 3), 11, element="B33")
    sections = "".join(
        f"*BEAM SECTION, ELSET={name}, MATERIAL=STEEL, SECTION=CIRC\n 1e-3\n" for name in ("LOWER", "UPPER")
    )
    return (
        f"{lower}{upper}{CONDUCTS}{sections}"
        "*SURFACE INTERACTION, NAME=TOUCH\n*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n"
        "*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER\n*NSET, NSET=ENDS\n 11, 14\n"
        "*BOUNDARY\n 1, ENCASTRE\n 4, 2, 6\n ENDS, 1, 2\n ENDS, 4, 6\n 1, 9\n" + "".join(steps)
    )


def step(lower_by, cards, solver="BLOCK", static="0.5, 1"):
    return f"*STEP\n*STATIC\n {static}\n*SOLVER, NAME={solver}\n*BOUNDARY\n ENDS, 3, 3, {-lower_by}\n{cards}*END STEP\n"


def potential_of(results, node, index=-1):
    return results.field("potential", index)[results.node_ids == node][0]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_current_may_be_fed_into_a_wire_that_touches_within_the_increment(run, solver):
    process, results = run(crossed_wires(step(1e-4, "*CECURRENT\n 11, 9, 2\n", solver)))
    assert process.returncode == 0, process.stderr
    assert results.contacts_at(-1)["current"] == pytest.approx([-2], rel=1e-7)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_fed_wire_that_no_increment_brings_to_touch_ends_the_run_at_once_and_with_advice(run, solver):
    process, results = run(crossed_wires(step(5e-6, "*CECURRENT\n 11, 9, 2\n", solver)))
    assert process.returncode == 2
    assert "Let the wires touch before it is fed" in process.stderr
    assert "Smaller increments would not help." in process.stderr
    # one attempt, not a row of smaller ones
    assert len(results.status["attempts"]) == 1


@pytest.mark.parametrize("solver", ["BLOCK", "UMFPACK"])
def test_a_fed_wire_that_loses_its_contact_ends_the_run_and_says_when(run, solver):
    lost = step(-1e-4, "", solver, static="0.5, 1, 1e-2")
    process, results = run(crossed_wires(step(1e-4, "*CECURRENT\n 11, 9, 2\n", solver), lost))
    assert process.returncode == 2
    assert "step 2, increment" in process.stderr
    assert (
        "a current is fed into the conductor at node 11, which has no path to a prescribed potential" in process.stderr
    )
    assert results.steps[-1] == 2


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_wire_that_has_lost_its_contact_keeps_the_potential_of_the_last_state(run, solver):
    """In the iterations before it is lost the other wire has its new potential already."""
    process, results = run(
        crossed_wires(step(1e-4, " 4, 9, 9, 2e-3\n", solver), step(-1e-4, " 4, 9, 9, 4e-3\n", solver, static="0.25, 1"))
    )
    assert process.returncode == 0, process.stderr
    last_touch = max(i for i in range(len(results.times)) if len(results.contacts_at(i)["force"]))
    assert last_touch < len(results.times) - 1
    # the increment in which the contact is lost has kept it, but for the round-off of its equations
    assert potential_of(results, 13) == pytest.approx(potential_of(results, 13, last_touch), rel=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_what_is_prescribed_is_reached_where_only_a_part_of_the_step_can_be_taken(run, solver):
    """The load turns the tip by more in the first iteration than one may."""
    deck = cantilever(
        f"*SOLVER, NAME={solver}\n*CLOAD\n 11, 3, 120\n*BOUNDARY\n 11, 9, 9, 1e-3", static="1, 1"
    ).replace("*ELASTIC", "*ELECTRICAL CONDUCTIVITY\n 5.88e7\n*ELASTIC", 1)
    process, results = run(deck.replace(" 1, ENCASTRE\n", " 1, ENCASTRE\n 1, 9\n"))
    assert process.returncode == 0, process.stderr
    assert potential_of(results, 11) == 1e-3
    np.testing.assert_allclose(results.field("potential"), np.linspace(0, 1e-3, 11), rtol=1e-9, atol=1e-15)


def test_currents_that_add_up_to_nothing_may_be_fed_into_a_wire_that_floats(run):
    """Thirty times 0.1 A, and 3 A out: their sum is round-off."""
    n = 40
    upper = wire("UPPER", straight((0, -0.05, 0.003), (0, 0.05, 0.003), n), 11, element="B33")
    deck = crossed_wires(
        step(0, "*CECURRENT\n" + "".join(f" {11 + i}, 9, 0.1\n" for i in range(30)) + f" {11 + n}, 9, -3\n")
    )
    head, tail = deck.split("*NODE", 2)[0], deck.split("*NODE", 2)[1:]
    first_wire = "*NODE" + tail[0]
    rest = tail[1][tail[1].index(CONDUCTS) :]
    process, results = run((head + first_wire + upper + rest).replace(" 11, 14\n", f" 11, {11 + n}\n"))
    assert process.returncode == 0, process.stderr
    assert results.field("element_current")[results.element_sets["UPPER"]][0] == pytest.approx(0.1, rel=1e-9)
