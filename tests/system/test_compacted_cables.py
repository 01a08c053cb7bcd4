"""Cables that a shrinking jacket presses together: strands that come to lie side by side, and ends of strands in one plane, ask
for no smaller increments than the motion does."""

import numpy as np
import pytest

import litz

STRAND = litz.Material("STRAND", 110e9, 0.3, 5e9, units="SI")


def compacted(tmp_path, stages, lay_lengths, void_fraction, increments):
    """Results, and the attempts and iterations of each increment."""
    interaction = litz.Interaction(conductance=litz.FilmSpot(1e-11), friction=0.3)
    model = litz.build.cable(
        stages, radius=0.41e-3, lay_lengths=lay_lengths, length=8e-3, material=STRAND, interaction=interaction, ends="sliding"
    )  # fmt: skip
    litz.build.compact(model, void_fraction, friction=0.1, increments=increments)
    results = model.run(tmp_path / "cable")
    status = next(tmp_path.rglob("*.sta")).read_text().splitlines()[1:]
    return results, np.array([line.split()[2:4] for line in status if not line.startswith("#")], dtype=int).T


@pytest.mark.filterwarnings("ignore::litz.RunWarning")
def test_three_strands_come_to_lie_side_by_side_within_an_increment(tmp_path):
    """They touch at points to begin with, and along all of their length from the first increment on."""
    results, (attempts, iterations) = compacted(tmp_path, [[3]], [80e-3], 0.33, 5)
    assert list(attempts) == [1] * 5
    assert sum(iterations) < 40
    ledger = results.contacts_at(-1)
    assert ledger.n_rows > 60
    # three lines of equal force
    per_wire = len(results.elements) // 3
    pair = (ledger["element_1"] - 1) // per_wire + (ledger["element_2"] - 1) // per_wire
    forces = [ledger["force"][pair == each].sum() for each in (1, 2, 3)]
    assert forces == pytest.approx([np.mean(forces)] * 3, rel=1e-3)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::litz.RunWarning")
@pytest.mark.parametrize(("lay_lengths", "void_fraction"), [((45e-3, 85e-3), 0.5664), ((80e-3, 140e-3), 0.57)])
def test_nine_strands_are_compacted_without_a_cut(tmp_path, lay_lengths, void_fraction):
    _, (attempts, iterations) = compacted(tmp_path, [[3], [3]], lay_lengths, void_fraction, 8)
    assert all(attempts == 1)
    assert max(iterations) < 30
