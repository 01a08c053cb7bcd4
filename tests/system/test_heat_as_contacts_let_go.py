"""Contacts that touch without a force pass no heat, and iterates that are given up end a run in words."""

import pytest

from decks import straight, wire
from run_of_deck import refusal_of_deck, run_of_deck

RADIUS, OVERLAP, ALPHA, ROOM = 0.5e-3, 0.4e-6, 1.7e-5, 300.0


def deck(*, steps, touch="*GAP CONDUCTANCE, LAW=CONDUCTIVITY\n", behavior="", metal="", model=""):
    """Two wires side by side, held all over, which press on each other as they swell; `steps` are their cards."""
    wires = "".join(
        wire(name, straight((-2e-3, 0, z), (2e-3, 0, z), 5), first=first, element="B33")
        for name, first, z in (("A", 1, 0.0), ("B", 101, 2 * RADIUS))
    )
    sections = "".join(f"*BEAM SECTION, ELSET={name}, MATERIAL=M, SECTION=CIRC\n{RADIUS}\n" for name in "AB")
    return (
        f"{wires}*NSET, NSET=ALL\nA, B\n*MATERIAL, NAME=M\n*ELASTIC\n120e9, 0.34\n*EXPANSION\n{ALPHA}\n*CONDUCTIVITY\n390\n"
        f"{metal}{sections}*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ{behavior}\n"
        f"{touch}*CONTACT PAIR, INTERACTION=TOUCH\nA, B\n{model}"
        f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {ROOM}\n*BOUNDARY\nALL, ENCASTRE\n"
        f"*STEP\n*STATIC\n*BOUNDARY\nB, 3, 3, {-OVERLAP}\n*END STEP\n"
        + "".join(f"*STEP\n{cards}*END STEP\n" for cards in steps)
    )


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def forces(results):
    return [results.contacts_at(increment)["force"].sum() for increment in range(len(results.times))]


def test_metal_that_has_yielded_lets_go_as_at_given_temperatures(run):
    """The dent that 450 K make is open at 320 K: the forces are those of steps to which the temperatures are given."""
    solved = "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE\n0.25, 1\n*BOUNDARY\nALL, 11, 11, {}\n"
    given = "*STATIC\n0.25, 1\n*TEMPERATURE\nALL, {}\n"
    expected = forces(run(steps=[given.format(t) for t in (450, 320)], behavior=", YIELD=3e8"))
    assert max(expected) > 100
    assert expected[-1] == 0
    assert forces(run(steps=[solved.format(t) for t in (450, 320)], behavior=", YIELD=3e8")) == pytest.approx(
        expected, rel=1e-9
    )


def test_an_iterate_without_a_solution_is_left_as_the_run_ends(refused, tmp_path):
    """Heat that is taken from a node until it is far below absolute zero, where a Wiedemann-Franz metal has no heat."""
    message = refused(
        2,
        steps=[
            "*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL\n0.01, 0.01\n*CECURRENT\n106, , 1\n*CFLUX\n104, , -3e3\n"
        ],
        touch="*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n*GAP CONDUCTANCE, LAW=METAL, LORENZ=2.44e-8\n",
        metal="*ELECTRICAL CONDUCTIVITY\n5.8e7\n*DENSITY\n8960\n*SPECIFIC HEAT\n385\n",
        model="*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0\n*BOUNDARY\n1, 9\n",
    )
    assert "below absolute zero" in message
    assert "The iterate that was given up" in message
    assert (tmp_path / "wire" / "wire_unconverged.vtkhdf").exists()
