"""Cells of cables whose ends move alike: cells of any number of parts of a lay are one cable."""

import csv
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


def all_contacts(path):
    """Rows of the last increment in the table of contacts, with those of images, which `Results` leaves out."""
    with next(path.glob("*_contacts.csv")).open() as file:
        rows = list(csv.DictReader(file))
    last = rows[-1]["increment"]
    names = {name.split(" [")[0]: name for name in rows[0]}
    wanted = ["element_1", "element_2", "force", "gap", *(f"point_{k}_{axis}" for k in (1, 2) for axis in "xyz")]
    return {name: np.array([float(row[names[name]]) for row in rows if row["increment"] == last]) for name in wanted}


def beyond_the_cell(model, ledger):
    """Which contacts are images of others: of two elements beyond the upper end, or of one beyond the lower end."""
    upper, lower = (list(model.groups[f"BEYOND_{side}_LAYER1"].elements) for side in ("PLUS", "MINUS"))
    one, other = ledger["element_1"], ledger["element_2"]
    return np.isin(one, upper) & np.isin(other, upper) | np.isin(one, lower) | np.isin(other, lower)


def test_forces_next_to_an_end_are_those_within_a_cell(tmp_path):
    """Two stages, which cross where the cell begins, and begin anew in its middle.

    They differ by 3e-4 of the force there, as what is loose comes to rest; where wires end with the cell by 4 to 9 %.
    """
    model = build.cable(
        [[3], [3]], radius=0.41e-3, lay_lengths=[30e-3, 60e-3], length=40e-3, ends="periodic", elements_per_lay=25
    )
    build.compact(model, 0.57, increments=6)
    results = model.run(tmp_path)
    ledger = all_contacts(tmp_path)
    images = beyond_the_cell(model, ledger)
    assert ledger["force"][images].sum() < 1e-4 * ledger["force"].sum()
    place = (ledger["point_1_z"] + ledger["point_2_z"])[~images] / 2
    inside = np.histogram(place % 40e-3, bins=20, range=(0, 40e-3), weights=ledger["force"][~images])[0]
    assert inside[[0, -1]].sum() > 0.2 * inside.sum()
    assert inside[[0, -1]].sum() == pytest.approx(inside[[9, 10]].sum(), rel=5e-3)
    # results are of the cell alone, but for what presses across its upper end
    assert results.contacts_at(-1)["force"].sum() == pytest.approx(inside.sum(), rel=0.02)
    assert {len(wire.elements) for wire in results.wires} == {len(model.groups["LAYER1"].wires[0].elements)}
    assert results.interstrand_resistance(superconducting=True).stages()["not_joined"][0] == 0


@pytest.mark.slow
def test_a_jacket_compacts_a_cell_of_two_stages(tmp_path):
    """Crossings slide over its ends; what presses there has an image that overlaps as much and carries no force."""
    length = 40e-3 / 3
    model = build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[20e-3, 40e-3], length=length, ends="periodic")
    build.compact(model, 0.48)
    results = model.run(tmp_path)
    ledger = all_contacts(tmp_path)
    images = beyond_the_cell(model, ledger)
    assert ledger["force"][images].sum() < 1e-4 * ledger["force"].sum()
    length += results.field("displacement", -1)[model.node_sets["STRETCH"][0] - 1, 2]
    points = np.array([[ledger[f"point_{k}_{axis}"] for axis in "xyz"] for k in (1, 2)]).transpose(2, 0, 1)
    # those on the first elements beyond the lower end, 0.78 mm long; which of two wires comes first may differ
    checked = np.flatnonzero(images & (points[:, :, 2].max(axis=1) < -0.1e-3) & (points[:, :, 2].min(axis=1) > -0.7e-3))
    assert len(checked) > 5
    for row in checked:
        moved = points[row] + (0, 0, length)
        away = [np.linalg.norm(points - one, axis=(1, 2)) for one in (moved, moved[::-1])]
        same = np.minimum(*away).argmin()
        assert min(away[0][same], away[1][same]) < 1e-8
        assert ledger["gap"][same] == pytest.approx(ledger["gap"][row], abs=1e-10)
        if ledger["gap"][row] < -1e-8:
            assert ledger["force"][same] > 1e3 * ledger["force"][row]
    stages = results.interstrand_resistance(superconducting=True).stages()
    assert stages["not_joined"].sum() == 0
    assert np.isfinite(stages["mean"]).all()
