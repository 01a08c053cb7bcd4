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
    """Rows of the last increment in the table of contacts, with those that `Results` does not count."""
    with next(path.glob("*_contacts.csv")).open() as file:
        rows = list(csv.DictReader(file))
    last = rows[-1]["increment"]
    names = {name.split(" [")[0]: name for name in rows[0]}
    wanted = [
        "element_1",
        "element_2",
        "force",
        "gap",
        "length",
        *(f"point_{k}_{axis}" for k in (1, 2) for axis in "xyz"),
    ]
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


#: Layers of opposite lay, which all begin at the same angle: six of the 18 crossings of 6 mm lie in the end plane
CROSSED = {
    "radius": [CORE, OUTER, OUTER], "lay_length": [36e-3, 72e-3], "direction": "SZ", "length": 6e-3, "enlarge": True,
    "element_length": 0.75e-3,
}  # fmt: skip
#: Layers of the same hand, which touch along short lines; all of these begin or end in the end plane
SLANTED = CROSSED | {"lay_length": [36e-3, 48e-3], "direction": "Z", "length": 12e-3, "element_length": 1e-3}
#: A strand of the length of the cell resists a millionth of what a contact does
NEARLY_SUPERCONDUCTING = litz.Material("WIRE", 120e9, 0.34, 5.88e13)


def fed_cell(directory, wires, metal, periods=1, cell=CROSSED):
    """Results of a cell that is pulled, settles, and is fed with 1 A into each of some wires of the layer inside.

    The current leaves from wires of the other layer: its voltage, and the wires where it enters and leaves.
    """
    cell = cell | {"length": periods * cell["length"]}
    model = build.strand(
        [1, 6, 12], material=metal, ends="periodic",
        interaction=litz.Interaction(conductance=litz.FilmSpot(1e-11), friction=0.3), **cell,
    )  # fmt: skip
    for name, layer in (("FROM", "LAYER1"), ("TO", "LAYER2")):
        model.node_set(name, [wire.nodes[0] for wire in model.groups[layer].wires[wires]])
    pull = model.press(-STRAIN * cell["length"], increment=0.25)
    pull.controls("STABILIZE", factor=10)
    pull.potential("TO", 0)
    settle = model.step("SETTLE", increment=1.0)
    settle.controls("STABILIZE", factor=0)
    settle.current("FROM", 1.0)
    results = model.run(directory)
    ends = [
        [k for k, wire in enumerate(results.wires) if wire.nodes[0] in results.node_sets[name]]
        for name in ("FROM", "TO")
    ]
    return results, float(results.field("potential")[results.node_sets["FROM"]].mean()), ends


def between_the_layers(results):
    """Contacts between both layers, and which way their current counts."""
    ledger = results.contacts_at()
    rows = [np.searchsorted(results.element_ids, ledger[f"element_{side}"]) for side in (1, 2)]
    own = {int(row): number for number, wire in enumerate(results.wires) for row in wire.elements}
    # all are contacts of wires of the cell
    layers = [np.array([(own[int(row)] > 0) + (own[int(row)] > 6) for row in some]) for some in rows]
    kept = layers[0] + layers[1] == 3
    return ledger.where(kept), np.where(layers[0] < layers[1], 1, -1)[kept]


def test_crossings_in_the_end_plane_conduct(tmp_path):
    """A cell of one period and one of two are the same cable; a third of the crossings of the first lies in its end plane.

    Forces are equal to 3e-6, and the resistance of a film goes with less than a force.
    """
    found, slices = [], []
    for periods in (1, 2):
        results, voltage, ends = fed_cell(tmp_path / str(periods), slice(None), NEARLY_SUPERCONDUCTING, periods)
        contacts, sense = between_the_layers(results)
        assert contacts.n_rows == 18 * periods
        # all of the current passes from one layer to the other, and each contact counts once
        assert (sense * contacts["current"]).sum() == pytest.approx(6.0, rel=1e-9)
        cold = results.interstrand_resistance(superconducting=True).between(*ends)
        assert cold == pytest.approx(1 / (1 / contacts["resistance"]).sum(), rel=1e-9)
        # wires resist a millionth of that
        assert voltage / 6 == pytest.approx(cold, rel=5e-6)
        found.append([cold * periods, voltage * periods, contacts["force"].sum() / periods])
        # with the contacts on the core, whose lines have axes with ends
        slices.append(results.along_cable(count=1)["conductance_per_length"][0])
    assert found[0] == pytest.approx(found[1], rel=5e-6)
    assert slices[0] == pytest.approx(slices[1], rel=1e-4)


@pytest.mark.parametrize(("cell", "exact"), [(CROSSED, 1e-6), (SLANTED, 1e-4)], ids=["points", "lines"])
def test_a_fed_cell_is_the_circuit_of_its_contacts(tmp_path, cell, exact):
    """Between two wires, whose copper resists too, and with all that lies across the end."""
    results, voltage, ((first,), (second,)) = fed_cell(tmp_path, slice(0, 1), litz.COPPER, cell=cell)
    resistance = results.interstrand_resistance().matrix[first, second]
    # what strips of one section add to each other is shared among places as those of the program lie, but for round-off
    assert voltage == pytest.approx(resistance, rel=exact)
    # all power is heat of wires and contacts, each once
    assert results.wire_heat()["total"].sum() == pytest.approx(voltage, rel=1e-9)
    shares = results.current_shares(count=20)
    assert np.abs(shares.total).max() < 1e-9


def test_the_weight_of_a_cell_is_that_of_its_wires(tmp_path):
    """GRAV without a set: images weigh nothing, and have a density, so that it is not refused."""
    metal = litz.Material("WIRE", 120e9, 0.34, density=8900.0)
    model = build.strand(
        [1, 6, 12], material=metal, ends="periodic", interaction=litz.Interaction(friction=0.3), **CROSSED,
    )  # fmt: skip
    pull = model.press(-STRAIN * 6e-3, increment=0.5)
    pull.gravity((0, 0, -1e3))
    pull.controls("STABILIZE", factor=10)
    settle = model.step("SETTLE", increment=1.0)
    settle.controls("STABILIZE", factor=0)
    settle.node_print("MINUS", "RF", totals="ONLY")
    results = model.run(tmp_path)
    volume = sum(
        np.pi
        * results.radius[wire.elements[0]] ** 2
        * np.linalg.norm(np.diff(results.nodes[wire.nodes], axis=0), axis=1).sum()
        for wire in results.wires
    )
    # axes are 1e-5 longer than their chords
    assert results.history["RF3 sum MINUS"][-1] == pytest.approx(1e3 * 8900 * volume, rel=3e-5)


@pytest.mark.slow
def test_wrapped_bundles_touch_across_the_ends_as_they_do_within(tmp_path):
    """By a law of line contact of their own: force over length and overlap is its penalty, at every place."""
    tape = litz.Interaction("TAPE", litz.Linear(2e6, line_penalty=2e9), litz.FilmSpot(1e-10), friction=0.05)
    model = build.cable(
        [[3], [3]], radius=0.41e-3, lay_lengths=[20e-3, 40e-3], length=40e-3 / 3, ends="periodic", interaction=RUBBED, wrap=tape
    )  # fmt: skip
    build.compact(model, 0.545, increments=10)
    model.run(tmp_path)
    ledger = all_contacts(tmp_path)
    upper = list(model.groups["BEYOND_PLUS_LAYER1"].elements)
    number_of = {element: number for number in (1, 2, 3) for element in model.elements_of(f"BUNDLE{number}")}
    number_of |= {element: k for k in (1, 2, 3) for element in model.elements_of(f"BEYOND_PLUS_BUNDLE{k}")}
    across, between = (np.zeros(len(ledger["force"]), dtype=bool) for _ in range(2))
    for row, pair in enumerate(zip(ledger["element_1"], ledger["element_2"], strict=True)):
        across[row] = (pair[0] in upper) != (pair[1] in upper) and all(one in number_of for one in pair)
        bundles = [number_of.get(one, 0) for one in pair]
        between[row] = bundles[0] != bundles[1] and 0 not in bundles and not (pair[0] in upper and pair[1] in upper)
    on_lines = between & (ledger["length"] > 0) & (ledger["gap"] < -1e-7)
    force = 2e9 * ledger["length"] * -ledger["gap"]
    assert (on_lines & across).sum() >= 3
    assert (on_lines & ~across).sum() >= 3
    np.testing.assert_allclose(ledger["force"][on_lines], force[on_lines], rtol=1e-6)


@pytest.mark.parametrize(("element_length", "n_images"), [(0.75e-3, 2), (0.25e-3, 5)])
def test_images_reach_beyond_what_presses_in_the_plane_of_an_end(element_length, n_images):
    """By 2.5 radii: where elements are short, two of them would end within a crossing there."""
    model = build.strand(
        [1, 6, 12],
        radius=[0.52e-3, 0.5e-3, 0.5e-3],
        lay_length=[36e-3, 72e-3],
        direction="SZ",
        length=6e-3,
        ends="periodic",
        element_length=element_length,
        enlarge=True,
    )
    images = [np.array(model.groups[f"BEYOND_{side}_LAYER1"].elements) for side in ("PLUS", "MINUS")]
    assert [len(some) for some in images] == [6 * n_images] * 2
