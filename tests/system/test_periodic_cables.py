"""Cells of cables whose ends move alike: cells of any number of parts of a lay are one cable."""

import re

import numpy as np
import pytest
from verification.cases.twisted_pair import approach_of
from verification.references.helical_rods import Rod, Strand

import litz
from litz import build

CORE, OUTER, LAY, STRAIN = 0.52e-3, 0.5e-3, 45e-3, 1e-3
RUBBED = litz.Interaction(conductance=litz.FilmSpot(1e-11), friction=0.2)


def cell_of_a_strand(sixths, elements_per_lay=30):
    return build.strand(
        [1, 6], radius=[CORE, OUTER], lay_length=LAY, length=sixths * LAY / 6, interaction=RUBBED, ends="periodic",
        elements_per_lay=elements_per_lay,
    )  # fmt: skip


def pulled_force(model, length, directory):
    step = model.press(-STRAIN * length, increment=0.25)
    step.node_print("STRETCH", "RF")
    step.node_print("MINUS", "RF", totals="ONLY")
    results = model.run(directory)
    history = {name: values[-1] for name, values in results.history.items()}
    assert abs(history["RF3 sum MINUS"]) < 1e-6, "the held node holds nothing"
    return next(value for name, value in history.items() if re.match(r"RF3 node", name)), results


def test_a_sixth_of_a_lay_is_a_strand(tmp_path):
    """Costello's strand, of which no end can turn: of second order in the elements, 5e-4 of the force at 30 to a lay."""
    strand = Strand(Rod(CORE, 120e9, 0.34), Rod(OUTER, 120e9, 0.34), 6, LAY)
    approach, share = approach_of(strand.core, strand.wire), (1 + strand.free.height) / 2
    exact = strand.state(STRAIN, approach=lambda force: approach(force / share)).force
    sixth, results = pulled_force(cell_of_a_strand(1), LAY / 6, tmp_path / "sixth")
    third, _ = pulled_force(cell_of_a_strand(2), LAY / 3, tmp_path / "third")
    assert sixth == pytest.approx(exact, rel=1e-3)
    # friction takes wires that slip to rest where they were: 5e-5 of the force
    assert third == pytest.approx(sixth, rel=2e-4)
    # each wire goes on where the next one begins
    moved = results.positions(-1)
    ends = np.array([moved[wire.nodes[-1]] - moved[wire.nodes[0]] for wire in results.wires[:1]])
    np.testing.assert_allclose(ends[0], (0, 0, LAY / 6 * (1 + STRAIN)), atol=1e-9)


def test_a_jacket_holds_a_cell_across(tmp_path):
    """A third of a lay of a triplet in a jacket: three equal strands, all with the same resistance."""
    model = build.cable(
        [[3]], radius=0.41e-3, lay_lengths=[40e-3], length=40e-3 / 3, interaction=RUBBED, ends="periodic"
    )
    build.compact(model, 0.35, increments=4, friction=0.1)
    results = model.run(tmp_path)
    resistance = results.interstrand_resistance(superconducting=True).table()["resistance"]
    assert np.ptp(resistance) < 1e-3 * resistance.mean()
