"""The wires of a result file: which elements follow one another, as the program has written it."""

import shutil

import h5py
import numpy as np
import pytest

import litz
from litz.wires import find_wires

#: Three wires that end at one node, a wire with right angles, a ring; some elements run against their wire
NODES = [
    (0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (2, -1, 0),
    (0, 0, 5), (1, 0, 5), (1, 1, 5), (1, 2, 5),
    (0, 0, 9), (1, 0, 9), (0, 1, 9),
]  # fmt: skip
ELEMENTS = [
    (5, 3), (3, 2), (1, 2), (4, 3),
    (8, 7), (6, 7), (8, 9),
    (11, 12), (10, 11), (10, 12),
]  # fmt: skip
WIRES = [
    ([5, 3], [0], [1]),
    ([3, 2, 1], [1, 2], [1, -1]),
    ([4, 3], [3], [1]),
    ([9, 8, 7, 6], [6, 4, 5], [-1, 1, -1]),
    ([11, 12, 10, 11], [7, 9, 8], [1, -1, 1]),
]
FIELDS = ("wire", "place_in_wire", "direction_in_wire")


def run_of(nodes, elements, directory):
    """Results of elements that are held everywhere."""
    model = litz.Model("elements in any order and direction")
    model.nodes(nodes)
    model.elements("WIRES", elements, radius=1e-3, material=litz.Material("GLASS", 70e9, 0.2))
    model.fix("WIRES")
    model.step()
    return model.run(directory)


def as_lists(wire):
    return list(wire.nodes), list(wire.elements), list(wire.signs)


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return run_of(NODES, ELEMENTS, tmp_path_factory.mktemp("wires"))


def without_wires(results, directory):
    """The results as a litz before 0.2 has written them."""
    shutil.copytree(results.path.parent, directory, dirs_exist_ok=True)
    path = directory / results.path.name
    with h5py.File(path, "r+") as file:
        for name in FIELDS:
            del file[f"VTKHDF/CellData/{name}"], file[f"VTKHDF/Steps/CellDataOffsets/{name}"]
    return litz.Results(path)


def test_wires_end_at_branches_and_go_on_over_kinks(results):
    expected = [([node - 1 for node in nodes], elements, signs) for nodes, elements, signs in WIRES]
    assert [as_lists(wire) for wire in results.wires] == expected


def test_the_program_counts_wires_and_places_from_one(results):
    assert results.field("wire").tolist() == [1, 2, 2, 3, 4, 4, 4, 5, 5, 5]
    assert results.field("place_in_wire").tolist() == [1, 1, 2, 1, 2, 3, 1, 1, 3, 2]
    assert results.field("direction_in_wire").tolist() == [1, 1, -1, 1, 1, -1, -1, 1, 1, -1]


def test_results_of_older_versions_have_the_same_wires(results, tmp_path):
    older = without_wires(results, tmp_path)
    assert "wire" not in older.fields
    assert [as_lists(wire) for wire in older.wires] == [as_lists(wire) for wire in results.wires]


def test_the_wires_are_those_that_the_program_has_written(results, tmp_path):
    shutil.copytree(results.path.parent, tmp_path, dirs_exist_ok=True)
    with h5py.File(tmp_path / results.path.name, "r+") as file:
        # the ring as three wires, two of which point the other way
        file["VTKHDF/CellData/wire"][7:] = [5, 7, 6]
        file["VTKHDF/CellData/place_in_wire"][7:] = 1
        file["VTKHDF/CellData/direction_in_wire"][7:] = [1, -1, -1]
    wires = litz.Results(tmp_path / results.path.name).wires
    assert [as_lists(wire) for wire in wires[4:]] == [
        ([10, 11], [7], [1]),
        ([11, 9], [9], [-1]),
        ([10, 9], [8], [-1]),
    ]


@pytest.mark.parametrize("seed", range(3))
def test_random_networks_have_the_wires_that_are_found_from_the_elements(tmp_path, seed):
    rng = np.random.default_rng(seed)
    # a random half of the edges of a grid: branches, free ends, rings, single elements
    places = np.array([(x, y, 0.0) for x in range(5) for y in range(5)])
    row = np.arange(25).reshape(5, 5)
    edges = np.concatenate(
        [np.stack([row[1:], row[:-1]], -1).reshape(-1, 2), np.stack([row[:, 1:], row[:, :-1]], -1).reshape(-1, 2)]
    )
    edges = rng.permuted(edges[rng.permutation(len(edges))[: len(edges) // 2]], axis=1)
    used = np.unique(edges)
    results = run_of(places[used], np.searchsorted(used, edges) + 1, tmp_path)
    assert [as_lists(wire) for wire in results.wires] == [as_lists(wire) for wire in find_wires(results.elements)]
