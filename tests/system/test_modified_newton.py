"""*SOLUTION TECHNIQUE, TYPE=MODIFIED NEWTON: fewer factorisations, the same solution, and the tables show which was kept."""

import numpy as np
import pytest
from verification.performance.lattice import lattice_deck

import litz
from decks import crossed

MODIFIED = "*SOLUTION TECHNIQUE, TYPE=MODIFIED NEWTON{}\n"


@pytest.fixture
def compressed():
    """A lattice of struts, compressed by 2 % in five increments of fixed size."""
    text, _ = lattice_deck(500)

    def deck(technique="", restart=""):
        return text.replace("*NODE PRINT", technique + restart + "*NODE PRINT", 1)

    return deck


def test_full_newton_is_the_default_and_factors_in_every_iteration(run, compressed):
    _, silent = run(compressed(), name="silent")
    _, named = run(compressed("*SOLUTION TECHNIQUE, TYPE=NEWTON\n"), name="named")
    assert not silent.convergence["factor_age"].any()
    assert np.array_equal(silent.convergence["force"], named.convergence["force"])


def test_kept_factors_lead_to_the_same_solution_with_fewer_factorisations(run, compressed):
    _, full = run(compressed(), name="full")
    process, modified = run(compressed(MODIFIED.format("")), name="modified")
    assert process.returncode == 0, process.stderr
    # both residuals are below 1e-8 of the forces, and the lattice has no soft modes
    np.testing.assert_allclose(modified.field("displacement"), full.field("displacement"), atol=1e-8)
    kept = modified.convergence["factor_age"][modified.convergence["iteration"] > 0] > 0
    assert 2 * np.sum(~kept) <= np.sum(full.convergence["iteration"] > 0)
    # a factor that is kept goes with a residual that it does not make quadratically smaller, so more iterations
    assert len(kept) >= np.sum(full.convergence["iteration"] > 0)


def test_no_factor_is_kept_longer_than_asked(run, compressed):
    _, results = run(compressed(MODIFIED.format(", REFORM KERNEL=1")))
    assert results.convergence["factor_age"].max() == 1


def test_a_contact_that_closes_gets_a_new_factor(run):
    """Two crossed wires that come into touch: in the iteration after that the tangent is factored."""
    _, full = run(crossed(push="-5e-4", static="0.25, 1"), name="full")
    process, results = run(crossed(push="-5e-4", static="0.25, 1", extra=MODIFIED.format("")), name="modified")
    assert process.returncode == 0, process.stderr
    table = results.convergence
    changed = np.flatnonzero(np.diff(table["active"]) != 0) + 1
    assert len(changed) > 0
    followed = changed[changed + 1 < len(table["active"])] + 1
    assert not table["factor_age"][followed].any()
    # the tolerance of the residual over the stiffness of the contact
    assert results.contacts["force"][-1] == pytest.approx(full.contacts["force"][-1], rel=1e-7)


def test_a_run_that_goes_on_keeps_the_bits(run, tmp_path, compressed):
    """No factor is kept beyond an increment that a run can go on from. One thread, as for every run that goes on."""
    deck = compressed(MODIFIED.format(""), "*RESTART, WRITE, FREQUENCY=2\n")
    _, whole = run(deck, "--threads", "1", name="whole")
    restart = tmp_path / "whole" / "whole.restart.h5"
    rest = litz.run(tmp_path / "whole.inp", output_directory=tmp_path / "rest", restart=f"{restart}:1:2", threads=1)
    assert np.array_equal(rest.field("displacement"), whole.field("displacement"))


def test_the_number_of_iterations_needs_the_technique(run, compressed):
    process, _ = run(compressed("*SOLUTION TECHNIQUE, TYPE=NEWTON, REFORM KERNEL=3\n"))
    assert process.returncode == 1
    assert "REFORM KERNEL goes with TYPE=MODIFIED NEWTON" in process.stderr
