"""Where a factorisation costs as much as many steps with a factor, the later iterations of an increment use that of its first."""

import subprocess

import numpy as np
import pytest
from verification.performance.lattice import lattice_deck

from litz import Results


@pytest.fixture(scope="module")
def both(litz_program, tmp_path_factory):
    """A lattice with factors that are kept, and with a solver that has a factor of its own in each iteration."""
    folder = tmp_path_factory.mktemp("lattice")
    # about the smallest network in space that is large enough
    text, _ = lattice_deck(8000, increments=2, strain=0.004)
    decks = {"kept": text, "own": text.replace("*STEP\n", "*STEP\n*SOLVER, NAME=UMFPACK\n", 1)}
    for name, deck in decks.items():
        (folder / f"{name}.inp").write_text(deck)
        subprocess.run([litz_program, "run", folder / f"{name}.inp", "-o", folder, "--quiet"], check=True, timeout=600)
    return tuple(Results(folder / f"{name}.vtkhdf") for name in decks)


def test_newton_takes_the_same_iterations_to_the_same_solution(both):
    kept, own = both
    assert np.array_equal(kept.convergence["iteration"], own.convergence["iteration"])
    # both residuals are below 1e-8 of the forces, and the lattice has no soft modes
    np.testing.assert_allclose(kept.field("displacement"), own.field("displacement"), atol=1e-9)


def test_every_increment_begins_with_a_factor_of_its_own(both):
    """Its pivots tell whether the equilibrium before it is stable, and a run that is continued goes the same way."""
    table = both[0].convergence
    first, later = table["iteration"] == 1, table["iteration"] > 1
    assert not table["factor_age"][first].any()
    assert np.array_equal(table["factor_age"][later], table["iteration"][later] - 1)


def test_each_iteration_leaves_little_more_than_newton_by_itself(both):
    """The residuals of the linear equations are a ten-thousandth: below what the next linear step leaves."""
    kept, own = (results.convergence for results in both)
    second = kept["iteration"] == 2
    assert kept["force"][second] == pytest.approx(own["force"][second], rel=1.0)
    last = kept["iteration"] == kept["iteration"].max()
    assert np.all(kept["force"][last] < 0.1 * kept["force_allowed"][last])
