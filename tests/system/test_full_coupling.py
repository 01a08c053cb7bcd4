"""Motions, potentials and temperatures in one Newton step, against steps in which they take turns."""

import numpy as np
import pytest

from litz import Results
from run_of_deck import run_of_deck
from test_coupled_temperatures import CRITICAL, RADIUS, motion_solves, voltage_for
from test_coupled_temperatures import deck as wire

TURNS, FULL = "*SOLVER, NAME=BLOCK, COUPLING=UPDATED\n", "*SOLVER, NAME=BLOCK, COUPLING=FULL\n"
COUPLED = "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, ELECTRICAL"


def loop(*, solver=FULL, procedure=COUPLED, volts=0.1, increments=4):
    """A current heats two clamped wires through their contact: they swell, expand and press it together, which lowers its
    resistance, and get softer and resist more."""
    nodes, members = [], []
    for first, axis, height in ((1, 0, 0.0), (101, 1, 4e-3)):
        for i in range(9):
            place = [0.0, 0.0, height + (-1e-3 if axis else 1e-3) * (1 - np.cos(np.pi * i / 4)) / 2]
            place[axis] = 0.01 * (i - 4) + 0.001
            nodes.append(f"{first + i}, " + ", ".join(f"{value:.17g}" for value in place))
        members += [
            f"*ELEMENT, TYPE=B33, ELSET={'AB'[axis]}",
            *(f"{first + i}, {first + i}, {first + i + 1}" for i in range(8)),
        ]
    heat = "*BOUNDARY\nENDS, 11, 11, 300\n" if procedure == COUPLED else ""
    return (
        "\n".join(["*NODE, NSET=ALL", *nodes, *members])
        + f"""
*NSET, NSET=ENDS
1, 9, 101, 109
*NSET, NSET=PLUS
1
*NSET, NSET=MINUS
101
*MATERIAL, NAME=COPPER
*ELASTIC
1.2e11, 0.34, 300
0.9e11, 0.34, 700
*EXPANSION
1.7e-5
*ELECTRICAL CONDUCTIVITY
5.8e7, 300
2.5e7, 700
*CONDUCTIVITY
400, 300
370, 700
*BEAM SECTION, ELSET=A, MATERIAL=COPPER, SECTION=CIRC
1e-3
*BEAM SECTION, ELSET=B, MATERIAL=COPPER, SECTION=CIRC
1e-3
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ
*CONTACT PAIR, INTERACTION=TOUCH
A, B
*BOUNDARY
1, ENCASTRE
9, ENCASTRE
101, 1, 2
101, 4, 6
109, 1, 2
109, 4, 6
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 300
*STEP
*STATIC
0.5, 1
*BOUNDARY
101, 3, 3, -0.05e-3
109, 3, 3, -0.05e-3
1, 9, 9, 1e-3
101, 9
*END STEP
*STEP
{procedure}
{1 / increments}, 1, , {1 / increments}
{solver}*BOUNDARY
101, 3, 3, -0.1e-3
109, 3, 3, -0.1e-3
1, 9, 9, {volts}
{heat}*ELECTRODE PRINT
PLUS, MINUS
*END STEP
"""
    )


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, loop)


def assert_same(one, other, rel=2e-6):
    for name in ("force", "resistance", "temperature_1", "temperature_max"):
        np.testing.assert_allclose(one.contacts_at(-1)[name], other.contacts_at(-1)[name], rtol=rel, err_msg=name)
    motion = other.field("displacement")
    np.testing.assert_allclose(one.field("displacement"), motion, atol=rel / 2 * abs(motion).max())


def test_it_converges_quadratically_in_the_factorisations_of_the_motions_alone(run, tmp_path):
    full = run()
    solves, increments = motion_solves(tmp_path), len(full.times)
    log = full.convergence
    last = (log["step"] == 2) & (log["increment"] == log["increment"][-1])
    assert (log["temperature"] > 1).any()
    for field in ("force", "current", "heat"):
        part = log[field][last] / log[f"{field}_allowed"][last]
        rates = [
            np.log(c / b) / np.log(b / a)
            for a, b, c in zip(part, part[1:], part[2:], strict=False)
            if b > 10 and c < b < a
        ]
        assert max(rates) > 1.7, (field, part)
    assert full.contacts_at(-1)["temperature_max"][0] > 350
    turns = run(solver=TURNS)
    # shares and torques of contacts are those of an earlier state of each increment
    assert_same(full, turns, rel=5e-5)
    assert solves < motion_solves(tmp_path)
    run(solver="", procedure="*STATIC")
    assert solves <= motion_solves(tmp_path) + 3 * increments


def test_it_is_the_default(run):
    full, default = run(), run(solver="")
    np.testing.assert_array_equal(default.status["iterations"], full.status["iterations"])
    np.testing.assert_array_equal(default.field("temperature"), full.field("temperature"))


def test_a_mat_is_that_of_turns(litz, tmp_path, results_of):
    full = results_of("21_heated_mat")
    text = full.deck
    place = text.index("*BOUNDARY", text.index("*COUPLED"))
    (tmp_path / "turns.inp").write_text(text[:place] + TURNS + text[place:])
    done = litz("run", tmp_path / "turns.inp", "-o", tmp_path / "turns", "--quiet")
    assert done.returncode == 0, done.stderr
    turns = Results(tmp_path / "turns")
    # shares and torques of contacts are those of an earlier state of each increment
    assert_same(full, turns, rel=5e-5)
    assert full.status["iterations"].sum() < 0.75 * turns.status["iterations"].sum()


def test_an_increment_with_heat_of_friction_takes_few_iterations(results_of):
    """The tangent knows how the heat of a wiper at its contact changes as that slides and presses: without this the heat falls
    to a hundredth in an iteration at best, of which two increments of three take five or more."""
    status = results_of("22_wiper").status
    sliding = status["iterations"][status["step"] == 2]
    assert np.mean(sliding <= 4) > 0.9


def test_a_heated_wire_buckles_and_bows(litz, tmp_path):
    """A bow w from one of e, between clamps: r^2 (1 - e/w) + (w^2 - e^2)/4 = share r^2."""
    bow, share = RADIUS / 20, 4.0
    results = run_of_deck(litz, tmp_path, wire)(voltage_for(share * CRITICAL), elements=40, bow=bow, step=FULL,
                                                increments="0.05, 1, , 0.05\n")  # fmt: skip
    w = max(np.roots([0.25 / RADIUS**2, 0, 1 - share - 0.25 * (bow / RADIUS) ** 2, -bow]).real)
    assert results.field("displacement")[20, 1] + bow == pytest.approx(w, rel=3e-3)
