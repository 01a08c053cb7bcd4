"""*MESH: meshes in HDF5 files, and what is wrong with them."""

import h5py
import numpy as np
import pytest

DECK = """\
*HEADING
A cantilever whose mesh is in a file
*MESH, INPUT=mesh.h5
*MATERIAL, NAME=CU
*ELASTIC
1.2e11, 0.35
*BEAM SECTION, ELSET=BEAM, MATERIAL=CU, SECTION=CIRC
0.0005
*BOUNDARY
ROOT, ENCASTRE
*STEP
*STATIC
*CLOAD
7, 2, 1e-3
*END STEP
"""
GOOD = {
    "nodes/id": [3, 5, 7],
    "nodes/position": [[0, 0, 0], [0.01, 0, 0], [0.02, 0, 0.0]],
    "elements/B33/id": [11],
    "elements/B33/nodes": [[3, 5]],
    "elements/B31/id": [12],
    "elements/B31/nodes": [[5, 7]],
    "node_sets/root": [3],
    "element_sets/Beam": [11, 12],
}


@pytest.fixture
def check(litz, tmp_path):
    """Check a deck with a mesh file of the datasets given; None leaves one out."""

    def run(changes=(), deck=DECK):
        with h5py.File(tmp_path / "mesh.h5", "w") as file:
            for name, data in (GOOD | dict(changes)).items():
                if data is not None:
                    file[name] = data
        path = tmp_path / "deck.inp"
        path.write_text(deck)
        return litz("check", path)

    return run


def test_a_mesh_file_stands_for_the_cards(check, litz, tmp_path):
    done = check()
    assert done.returncode == 0, done.stderr
    for line in (
        "3 nodes, 2 elements (1 B31, 1 B33), 1 connected part",
        "node set ROOT: 1 member",
        "element set BEAM: 2 members",
    ):
        assert line in done.stdout
    text = """\
*NODE
3, 0, 0, 0
5, 0.01, 0, 0
7, 0.02, 0, 0
*ELEMENT, TYPE=B31, ELSET=BEAM
12, 5, 7
*ELEMENT, TYPE=B33, ELSET=BEAM
11, 3, 5
*NSET, NSET=ROOT
3
"""
    (tmp_path / "text.inp").write_text(DECK.replace("*MESH, INPUT=mesh.h5\n", text))
    assert litz("check", tmp_path / "text.inp").stdout == done.stdout


def test_mesh_file_and_cards_together(check):
    more = "*NODE, NSET=ROOT\n9, 0.03, 0, 0\n*ELEMENT, TYPE=B33, ELSET=BEAM\n13, 7, 9\n"
    done = check(deck=DECK.replace("*MESH", more + "*MESH"))
    assert done.returncode == 0, done.stderr
    assert "4 nodes, 3 elements" in done.stdout
    assert "node set ROOT: 2 members" in done.stdout


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"nodes/id": None}, 'the mesh file "mesh.h5": has no dataset nodes/id'),
        ({"nodes/position": None}, "has no dataset nodes/position"),
        ({"elements/B33/nodes": None}, "has no dataset elements/B33/nodes"),
        ({"nodes/position": [[0, 0], [0.01, 0], [0.02, 0]]}, "nodes/position has the shape (3, 2); it must be (n, 3)"),
        ({"nodes/id": [[3, 5, 7]]}, "nodes/id has the shape (1, 3); it must be (n)"),
        ({"nodes/id": [3.0, 5.0, 7.0]}, "nodes/id must hold whole numbers"),
        ({"nodes/position": np.array([[b"x"] * 3] * 3)}, "nodes/position must hold numbers"),
        ({"nodes/id": [3, 5]}, "has 2 rows in nodes/id and 3 in nodes/position; there must be as many"),
        ({"elements/B33/id": [11, 14]}, "has 2 rows in elements/B33/id and 1 in elements/B33/nodes"),
        ({"nodes/id": [3, 5, 2**40]}, "nodes/id has a number above 2147483647"),
        ({"nodes/id": [0, 5, 7]}, "node with the number 0; numbers must be greater than 0"),
        ({"nodes/id": [3, 5, 5]}, "node 5 is defined twice"),
        ({"elements/B31/id": [11]}, "element 11 is defined twice"),
        (
            {"nodes/position": [[0, 0, 0], [np.nan, 0, 0], [1, 0, 0]]},
            "the position of node 5 in the mesh file is not finite",
        ),
        ({"elements/B33/nodes": [[3, 4]]}, "element 11 has node 4, which is not defined"),
        ({"elements/B33/nodes": [[3, 3]]}, "element 11 has no length"),
        ({"node_sets/root": [3, 8]}, 'the node set "root" of the mesh file has node 8, which is not defined'),
        ({"element_sets/Beam": [1]}, "has element 1, which is not defined"),
        ({"elements/B32/id": [1]}, 'has elements of a type "B32"; allowed are B31 and B33'),
        ({"knots/id": [1]}, 'has a member "knots"; allowed are nodes, elements, node_sets and element_sets'),
        ({"node_sets/root": None}, 'there is no node set "ROOT"'),
    ],
)
def test_what_is_wrong_with_a_mesh_file(check, changes, message):
    done = check(changes)
    assert done.returncode == 1
    # what follows from the first error may be told as well
    assert message in done.stderr.split("error:")[1]


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("*MESH, INPUT=other.h5", 'the mesh file "other.h5": does not exist'),
        ("*MESH, INPUT=deck.inp", 'the mesh file "deck.inp": is not an HDF5 file'),
        ("*MESH", "*MESH needs the parameter INPUT="),
        ("*MESH, FILE=mesh.h5", "unknown parameter"),
    ],
)
def test_the_error_points_at_the_card(check, card, message):
    done = check(deck=DECK.replace("*MESH, INPUT=mesh.h5", card))
    assert done.returncode in (1, 4)
    assert message in done.stderr
    assert "deck.inp:3:" in done.stderr
    assert card in done.stderr
