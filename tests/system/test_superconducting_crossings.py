"""Superconducting strands that cross, over time: motions, potentials and temperatures in one Newton step and in turns."""

import numpy as np
import pytest

from decks import straight, wire
from run_of_deck import run_of_deck

RADIUS, COLD = 0.4e-3, 4.2
MATERIAL = """\
*MATERIAL, NAME=STRAND
*ELASTIC
1e11, 0.3
*EXPANSION
1e-5
*ELECTRICAL CONDUCTIVITY
5e9, 4
1e9, 40
*SUPERCONDUCTOR, LAW=NBTI, N=20, RATIO=1.5, FIELD=5, EC=1e-4
3e9, 31.4, 14.5, 9.2, 0.63, 1, 2.3
*CONDUCTIVITY
300, 4
900, 30
*DENSITY
8000
*SPECIFIC HEAT
0.2, 4
7, 20
"""


def deck(coupling):
    """Half the way between nodes; heat at one of them until the strand is no superconductor there any more."""
    first = wire("A", straight((-0.01, 0, 0), (0.01, 0, 0), 10), element="B33")
    second = wire("B", straight((4e-4, -0.01, 2 * RADIUS), (4e-4, 0.01, 2 * RADIUS), 10), 101, element="B33")
    sections = "".join(f"*BEAM SECTION, ELSET={name}, MATERIAL=STRAND, SECTION=CIRC\n{RADIUS}\n" for name in "AB")
    return (
        f"*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0\n{first}{second}*NSET, NSET=ALL\nA, B\n{MATERIAL}{sections}"
        "*ELSET, ELSET=BOTH\nA, B\n*NSET, NSET=ENDS\n1, 11, 101, 111\n"
        "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
        "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n*GAP CONDUCTANCE, LAW=METAL, LORENZ=2.44e-8\n"
        f"*CONTACT PAIR, INTERACTION=TOUCH\nA, B\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {COLD}\n"
        "*BOUNDARY\nENDS, ENCASTRE\n1, 9\n"
        f"*STEP\n*STATIC\n0.5, 1\n*SOLVER, NAME=BLOCK, COUPLING={coupling}\n*BOUNDARY\n101, 3, 3, -2e-6\n111, 3, 3, -2e-6\n"
        "*CECURRENT\n101, , 60\n*END STEP\n"
        f"*STEP, INC=1000\n*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL\n5e-4, 0.01\n*SOLVER, NAME=BLOCK, COUPLING={coupling}\n"
        f"*FILM\nBOTH, F, {COLD}, 300\n*CFLUX\n105, , 0.05\n*END STEP\n"
    )


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


def test_one_step_is_that_of_turns(run):
    """To a thousandth of the rise, what the allowed residuals of the steep law leave. The current of the filaments follows
    a correction that is none, too."""
    full, updated = (run(coupling).field("temperature", increment=None) for coupling in ("FULL", "UPDATED"))
    assert updated.max() > COLD + 1
    np.testing.assert_allclose(full, updated, atol=1e-3 * (updated.max() - COLD))
