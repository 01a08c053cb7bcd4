"""The monolithic step of the paper: the three solvers give the same iterates on every deck of inputs/."""

import re
from pathlib import Path

import numpy as np
import pytest

from litz import Results

INPUTS = sorted((Path(__file__).parents[2] / "inputs").glob("*.inp"))


def with_solver(text, solver):
    """The deck with one solver and the monolithic step in every step."""
    text = re.sub(r"^\*SOLVER.*\n", "", text, flags=re.MULTILINE | re.IGNORECASE)
    return text.replace("*END STEP", f"*SOLVER, NAME={solver}, COUPLING=MONOLITHIC\n*END STEP")


@pytest.mark.parametrize("deck", INPUTS, ids=lambda path: path.stem)
def test_same_iterates(deck, litz, tmp_path):
    """As many iterations everywhere, and fields that differ by what round-off makes of a 16-digit solve.

    A system with condition number 1e8 to 1e10 (axial against bending stiffness) solves to 1e-8 to 1e-6; the Newton
    iteration contracts that again, so that converged fields agree much better.
    """
    results = {}
    for solver in ("BLOCK", "UMFPACK", "SKYLINE"):
        path = tmp_path / f"{solver}.inp"
        path.write_text(with_solver(deck.read_text(), solver))
        process = litz("run", path, "--quiet", "-o", tmp_path)
        assert process.returncode == 0, process.stderr
        results[solver] = Results(tmp_path / f"{solver}.vtkhdf")
    block = results["BLOCK"]
    for solver in ("UMFPACK", "SKYLINE"):
        other = results[solver]
        for column in ("step", "increment", "attempt", "iteration", "active"):
            assert np.array_equal(block.convergence[column], other.convergence[column]), (solver, column)
        for name in ("displacement", "rotation", "potential"):
            expected = block.field(name, None)
            np.testing.assert_allclose(
                other.field(name, None), expected, rtol=0, atol=1e-8 * np.abs(expected).max() + 1e-300, err_msg=name
            )
        for column in ("displacement", "rotation", "potential"):
            expected = block.convergence[column]
            np.testing.assert_allclose(
                other.convergence[column], expected, rtol=1e-5, atol=1e-7 * expected.max(), err_msg=column
            )
