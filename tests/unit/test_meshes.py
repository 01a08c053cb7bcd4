"""litz.read_mesh, `litz convert`: wires and sets of other programs' files."""

import sys

import numpy as np
import pytest

import litz

#: As BeamMe 0.3 writes: beams with a node for the orientation of the section, normals, sets of materials and lines
BEAMME = """\
** This input file was created with BeamMe.
*Node
     1,  0.00000000000000e+00,  0.00000000000000e+00,  0.00000000000000e+00
     2,  5.00000000000000e-01,  0.00000000000000e+00,  0.00000000000000e+00
     3,  1.00000000000000e+00,  0.00000000000000e+00,  0.00000000000000e+00
     4,  0.00000000000000e+00,  0.00000000000000e+00,  1.00000000000000e+00
     5,  2.50000000000000e-01,  2.50000000000000e-01,  1.00000000000000e+00
     6,  5.00000000000000e-01,  5.00000000000000e-01,  1.00000000000000e+00
     7,  0.00000000000000e+00,  1.00000000000000e+00,  0.00000000000000e+00
     8,  5.00000000000000e-01,  1.00000000000000e+00,  0.00000000000000e+00
     9,  5.55111512312578e-17, -1.38777878078145e-16,  2.00000000000000e+00
*Element, type=B31
     1,      1,      2,      7
     2,      2,      3,      8
*Element, type=B32H
     3,      4,      5,      6,      9
*Normal, type=element
     1,      1,  0.00000000000000e+00,  0.00000000000000e+00,  1.00000000000000e+00
*Elset, elset=copper
     1,      2,      3
*Nset, nset=left
     1
*Elset, elset=first
     1,      2
"""

SECTIONS = """\
*Material, name=Steel
*Elastic
 200e9, 0.3
*Beam Section, elset=first, material=Steel, section=CIRC
 1e-3
 0., 0., 1.
*Beam Section, elset=second, material=Steel, section=CIRC
 2e-3
*Elset, elset=second
 3
*Step
*Static
"""

GMSH_2 = """\
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
0 1 "clamp"
1 2 "long wire"
2 3 "plate"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 2 0 0
4 2 1 0
5 9 9 9
$EndNodes
$Elements
5
1 15 2 1 1 1
2 1 2 2 1 1 2
3 1 2 2 1 2 3
4 1 2 0 2 3 4
5 2 2 3 1 1 2 3
$EndElements
"""


@pytest.fixture
def file(tmp_path):
    def write(text, name):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write


def test_a_deck_of_beamme_gives_its_wires_and_sets(file):
    mesh = litz.read_mesh(file(BEAMME, "beams.inp"))
    # the nodes for the orientation are none of the wires; a quadratic beam becomes two elements
    np.testing.assert_allclose(mesh.x[:, 0], [0, 0.5, 1, 0, 0.25, 0.5])
    assert mesh.connectivity.tolist() == [[0, 1], [1, 2], [3, 4], [4, 5]]
    assert mesh.kinds.tolist() == ["B31"] * 4
    assert {name: rows.tolist() for name, rows in mesh.element_sets.items()} == {
        "copper": [0, 1, 2, 3],
        "first": [0, 1],
    }
    assert {name: rows.tolist() for name, rows in mesh.node_sets.items()} == {"left": [0]}


def test_a_real_deck_of_beamme_is_read(tmp_path):
    pytest.importorskip("beamme")
    from beamme.abaqus.beam import generate_abaqus_beam
    from beamme.abaqus.input_file import AbaqusInputFile
    from beamme.abaqus.material import AbaqusBeamMaterial
    from beamme.core.mesh import Mesh
    from beamme.mesh_creation_functions.beam_line import create_beam_mesh_line

    written = Mesh()
    beam, material = generate_abaqus_beam("B31H"), AbaqusBeamMaterial("copper")
    sets = create_beam_mesh_line(written, beam, material, [0, 0, 0], [1, 2, 3], n_el=7)
    sets["start"].name = "begin"
    written.add(sets["start"])
    AbaqusInputFile(written).write_input_file(tmp_path / "line.inp")
    mesh = litz.read_mesh(tmp_path / "line.inp")
    assert len(mesh.connectivity) == 7
    np.testing.assert_allclose(mesh.x[mesh.node_sets["begin"]], [[0, 0, 0]])
    np.testing.assert_allclose(mesh.x[-1], [1, 2, 3])


def test_sections_and_materials_of_a_deck_make_a_model(file):
    mesh = litz.read_mesh(file(BEAMME + SECTIONS, "beams.inp"))
    model = litz.Model("from Abaqus")
    first, second = model.mesh(mesh)
    assert (first.name, first.radius, second.name, second.radius) == ("first", 1e-3, "second", 2e-3)
    assert first.material == litz.Material("Steel", young=200e9, poisson=0.3)
    deck = litz.Deck.parse(model.to_deck())
    assert deck.card("ELEMENT", elset="second").data == [[3, 4, 5], [4, 5, 6]]
    assert deck.card("ELSET", elset="copper").data == [[1, 2, 3, 4]]
    assert deck.card("NSET", nset="left").data == [[1]]


def test_ranges_sets_of_sets_and_includes_are_followed(file):
    file(" 1, 0, 0\n 2, 1\n 3, 2\n", "nodes.txt")
    deck = file(
        "*Node, nset=ALL\n 1, 0, 0\n 2, 1\n*Include, input=more.inp\n*Element, type=B33, elset=A\n 7, 1, 2\n 9, 2, 3\n"
        "*Elset, elset=B, generate\n 7, 9, 2\n*Elset, elset=C\n B\n*Nset, nset=N\n ALL, 3\n",
        "deck.inp",
    )
    file("*Node\n 3, 2\n", "more.inp")
    mesh = litz.read_mesh(deck)
    assert mesh.kinds.tolist() == ["B33", "B33"]
    assert mesh.element_sets["C"].tolist() == [0, 1]
    assert mesh.node_sets["N"].tolist() == [0, 1, 2]


def test_what_is_left_out_is_told(file):
    with pytest.warns(UserWarning, match="1 of type S4R"):
        litz.read_mesh(file(BEAMME + "*Element, type=S4R\n 10, 1, 2, 3, 4\n", "beams.inp"))
    with pytest.warns(UserWarning, match="section of first is left out"):
        litz.read_mesh(file(BEAMME + SECTIONS.replace("section=CIRC\n 1e-3", "section=RECT\n 1e-3, 2e-3"), "rect.inp"))


def test_physical_groups_of_gmsh_are_sets(file):
    pytest.importorskip("meshio")
    with pytest.warns(UserWarning, match="1 elements that are no lines are left out"):
        mesh = litz.read_mesh(file(GMSH_2, "mesh.msh"))
    assert mesh.connectivity.tolist() == [[0, 1], [1, 2], [2, 3]]
    assert len(mesh.x) == 4
    assert {name: rows.tolist() for name, rows in mesh.element_sets.items()} == {"long_wire": [0, 1]}
    assert {name: rows.tolist() for name, rows in mesh.node_sets.items()} == {"clamp": [0]}


@pytest.mark.parametrize("name", ["mesh.vtu", "mesh.xdmf", "mesh.msh"])
def test_quadratic_lines_become_two_elements_each(name, tmp_path):
    meshio = pytest.importorskip("meshio")
    points = np.array([(0.0, 0, 0), (2, 0, 0), (1, 0.1, 0), (4, 0, 0), (3, 0.1, 0)])
    meshio.Mesh(points, [("line3", np.array([(0, 1, 2), (1, 3, 4)]))]).write(
        tmp_path / name, file_format="gmsh22" if name.endswith(".msh") else None
    )
    mesh = litz.read_mesh(tmp_path / name)
    ends = mesh.x[mesh.connectivity][:, :, 0]
    np.testing.assert_allclose(ends, [[0, 1], [1, 2], [2, 3], [3, 4]])


def test_without_meshio_the_message_says_what_to_install(file, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(litz.FileError, match="pip install meshio"):
        litz.read_mesh(file(GMSH_2, "mesh.msh"))


def test_radii_by_element_set(file):
    mesh = litz.read_mesh(file(BEAMME + "*Elset, elset=second\n 3\n", "beams.inp"))
    model = litz.Model("two radii")
    model.mesh(mesh, radius={"first": 1e-3, "second": 5e-4}, material=litz.COPPER)
    assert model.radius.tolist() == [1e-3, 1e-3, 5e-4, 5e-4]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "no sections: radius and material are needed"),
        ({"radius": 1e-3}, "material is needed"),
        ({"radius": {"frist": 1e-3}, "material": "C"}, "did you mean 'first'"),
        ({"radius": {"first": 1e-3}, "material": "C"}, "2 elements of .* have no section"),
        ({"radius": {"first": 1e-3, "copper": 1e-3}, "material": "C"}, "several sections"),
    ],
)
def test_each_element_needs_one_section(file, arguments, message):
    model = litz.Model("wrong")
    model.material("C", young=1.0, poisson=0.0)
    with pytest.raises(ValueError, match=message):
        model.mesh(litz.read_mesh(file(BEAMME, "beams.inp")), **arguments)
    assert not model.groups


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("*Node\n 1, 0, 0, 0\n", "no line elements"),
        ("*Node\n 1, 0, 0, 0\n*Element, type=B31\n 1, 1, 2\n", "node 2, which is not there"),
        ("*Node\n a, 0, 0, 0\n", "whole number, not 'a'"),
    ],
)
def test_a_broken_file_is_told(file, text, message):
    with pytest.raises(litz.FileError, match=message):
        litz.read_mesh(file(text, "mesh.inp"))


def test_a_file_that_is_not_there_or_no_mesh(file):
    with pytest.raises(litz.FileError, match="there is no file"):
        litz.read_mesh("missing.msh")
    pytest.importorskip("meshio")
    with pytest.raises(litz.FileError, match="meshio cannot read"):
        litz.read_mesh(file("no mesh", "mesh.abc"))
