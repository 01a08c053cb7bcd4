"""Very many contacts that close at one instant: a layered mat whose gaps are equal, pressed on by a tenth of them.

Which contacts stay closed is a linear complementarity problem, which no smaller increment makes smaller: the iteration has to
solve it.
"""

import math

import numpy as np
import pytest

import litz
from litz import build

#: Gaps of the mat, and of its five planes of contact together [m]
CLEARANCE = 5e-6
GAPS = 5 * CLEARANCE
STEEL = build.Material("STEEL", young=200e9, poisson=0.3)


def mat(friction, increment=1.0, smallest=1.0):
    """4 x 24 fibres between plates of 14 bars, 2400 crossings."""
    model = build.fibre_mat(
        (24e-3, 24e-3),
        24,
        radius=0.1e-3,
        seed=11,
        n_layers=4,
        spread=math.radians(3),
        n_elements=24,
        n_bars=14,
        clearance=CLEARANCE,
        material=STEEL,
        interaction=build.Interaction(friction=friction),
    )
    model.press(1.1 * GAPS, increment=increment, smallest=smallest)
    return model


def run(model, folder):
    return litz.run(model.write(folder / "mat.inp"), output_directory=folder / "results")


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_contacts_that_close_at_one_instant_settle_in_one_increment(tmp_path, friction):
    """In about twenty iterations, with friction as without. Each force is in balance (audit of the run)."""
    results = run(mat(friction), tmp_path)
    (iterations,) = results.status["iterations"]
    assert iterations <= 24
    force = results.contacts_at(-1)["force"]
    # most of the 2400 crossings press; those that levering lifts do not
    assert 1700 < np.count_nonzero(force > 0) < 2000


@pytest.mark.slow
def test_increments_do_not_matter_to_what_closes(tmp_path):
    """Without friction nothing remembers the way: quarters of the increment lead to the same forces."""
    one = run(mat(0.0), tmp_path)
    four = run(mat(0.0, increment=0.25, smallest=0.25), tmp_path)
    assert len(four.status["iterations"]) == 4
    total = [results.contacts_at(-1)["force"].sum() for results in (one, four)]
    assert total[1] == pytest.approx(total[0], rel=1e-7)
