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
    mesh = litz.read_mesh(file(BEAMME + SECTIONS, "beams.inp"), dialect="abaqus")
    model = litz.Model("from Abaqus")
    first, second = model.mesh(mesh)
    assert (first.name, first.radius, second.name, second.radius) == ("first", 1e-3, "second", 2e-3)
    assert first.material == litz.Material("Steel", young=200e9, poisson=0.3)
    deck = litz.Deck.parse(model.to_deck())
    assert deck.card("ELEMENT", elset="second").data == [[3, 4, 5], [4, 5, 6]]
    assert deck.card("ELSET", elset="copper").data == [[1, 2, 3, 4]]
    assert deck.card("NSET", nset="left").data == [[1]]


def test_a_round_section_has_a_radius_in_abaqus_and_a_diameter_in_calculix(file):
    deck = file(BEAMME + SECTIONS, "beams.inp")
    with pytest.raises(
        ValueError, match=r"ELSET=first, SECTION=CIRC is the radius in Abaqus, but the diameter in CalculiX"
    ):
        litz.read_mesh(deck)
    radii = {
        dialect: [section.radius for _, section, _ in litz.read_mesh(deck, dialect=dialect).sections]
        for dialect in ("abaqus", "ccx")
    }
    assert radii == {"abaqus": [1e-3, 2e-3], "ccx": [0.5e-3, 1e-3]}
    with pytest.raises(ValueError, match="'abaqus' or 'ccx', not 'nastran'"):
        litz.read_mesh(deck, dialect="nastran")


def test_two_diameters_of_calculix_are_those_of_an_ellipse(file):
    twice = file(BEAMME + SECTIONS.replace("CIRC\n 1e-3", "CIRC\n 1e-3, 1e-3"), "twice.inp")
    assert litz.read_mesh(twice, dialect="ccx").sections[0][1] == litz.Circular(0.5e-3)
    with pytest.raises(ValueError, match="2 values on its first line; in the dialect abaqus it is the radius"):
        litz.read_mesh(twice, dialect="abaqus")
    ellipse = file(BEAMME + SECTIONS.replace("CIRC\n 1e-3", "CIRC\n 2e-3, 6e-3"), "ellipse.inp")
    section = litz.read_mesh(ellipse, dialect="ccx").sections[0][1]
    assert section.area == pytest.approx(np.pi * 1e-3 * 3e-3)
    # stiff about the axis across its long diameter, which is the second thickness: bending about the first axis n1
    assert section.i11 == pytest.approx(np.pi / 4 * 1e-3 * (3e-3) ** 3)
    assert section.i22 == pytest.approx(np.pi / 4 * 3e-3 * (1e-3) ** 3)
    # what St Venant's bound 4 I1 I2/(I1 + I2) gives for an ellipse, exactly
    assert section.j == pytest.approx(4 * section.i11 * section.i22 / (section.i11 + section.i22))
    assert section.n1 == (0, 0, 1)
    # an ellipse that is nearly round has the shear factor of the circle, 6 (1 + nu)/(7 + 6 nu)
    nearly = file(BEAMME + SECTIONS.replace("CIRC\n 1e-3", "CIRC\n 2e-3, 2.0000002e-3"), "nearly.inp")
    section = litz.read_mesh(nearly, dialect="ccx").sections[0][1]
    ga = 200e9 / 2.6 * section.area
    assert section.shear == pytest.approx((6 * 1.3 / 8.8 * ga, 6 * 1.3 / 8.8 * ga), rel=1e-6)


def test_a_section_beside_its_nodes_is_refused(file):
    deck = file(BEAMME + SECTIONS.replace("section=CIRC\n 1e-3", "section=CIRC, offset1=0.5\n 1e-3"), "offset.inp")
    with pytest.raises(ValueError, match="OFFSET1: the axes of wires of a mesh pass through their nodes"):
        litz.read_mesh(deck, dialect="ccx")


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
    with pytest.warns(UserWarning, match="section of first is ignored"):
        litz.read_mesh(
            file(BEAMME + SECTIONS.replace("section=CIRC\n 1e-3", "section=RECT\n 1e-3, 2e-3"), "rect.inp"),
            dialect="abaqus",
        )


#: As Abaqus/CAE writes: a part, instances of it at their places, sets of the assembly
CAE = """\
*Heading
*Preprint, echo=NO
*Part, name=Wire
*Node
 1, 0., 0., 0.
 2, 1., 0., 0.
 3, 2., 0., 0.
*Element, type=B32
 1, 1, 2, 3
*Nset, nset=Set-1, generate
 1, 3, 1
*Elset, elset=Set-1
 1,
*Beam Section, elset=set-1, material=Steel, temperature=GRADIENTS, section=CIRC
0.1
0.,0.,-1.
*End Part
*Part, name=Pin
*Node
 1, 0., 0., 0.
 2, 0., 5., 0.
*Element, type=B31, elset=all
 1, 1, 2
*End Part
*Assembly, name=Assembly
*Instance, name=Wire-1, part=wire
*End Instance
*Instance, name=Wire-2, part=Wire
 0., 0., 1.
 0., 0., 1., 0., 0., 2., 90.
*End Instance
*Instance, name=Pin-1, part=Pin
*End Instance
*Nset, nset=ends, instance=Wire-1
 1, 3
*Nset, nset=ends, instance=Wire-2
 3
*Elset, elset=both
 Wire-1.Set-1, Pin-1.all
*End Assembly
*Material, name=Steel
*Elastic
 210000., 0.3
*Step
*Static
"""


def test_instances_of_parts_stand_at_their_places(file):
    mesh = litz.read_mesh(file(CAE, "cae.inp"), dialect="abaqus")
    # the first as it is, the second shifted by 1 along z, then turned by 90 degrees about the axis through (0, 0, 1) along z
    wires = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 0, 1], [0, 1, 1], [0, 2, 1]]
    np.testing.assert_allclose(mesh.x, [*wires, [0, 0, 0], [0, 5, 0]], atol=1e-15)
    assert mesh.connectivity.tolist() == [[0, 1], [1, 2], [3, 4], [4, 5], [6, 7]]
    assert {name: rows.tolist() for name, rows in mesh.element_sets.items()} == {
        "Wire-1.Set-1": [0, 1],
        "Wire-2.Set-1": [2, 3],
        "Pin-1.all": [4],
        "both": [0, 1, 4],
    }
    # nodes of the same number belong to their instances
    assert mesh.node_sets["ends"].tolist() == [0, 2, 5]
    assert mesh.node_sets["Wire-2.Set-1"].tolist() == [3, 4, 5]


def test_a_conductivity_over_temperature_is_a_table(file):
    text = CAE.replace("*Elastic\n", "*Electrical Conductivity\n 5e7, 20.\n 2e7, 500.\n*Elastic\n", 1)
    assert text != CAE
    materials = [material for _, _, material in litz.read_mesh(file(text, "cae.inp"), dialect="abaqus").sections]
    assert ((5e7, 20.0), (2e7, 500.0)) in [material.conductivity for material in materials]


def test_sections_of_a_part_hold_for_each_of_its_instances(file):
    model = litz.Model("wires of a part")
    pin = CAE.index("*Part, name=Pin"), CAE.index("*Assembly")
    text = CAE[: pin[0]] + CAE[pin[1] :].replace(", Pin-1.all", "")
    text = text.replace("*Instance, name=Pin-1, part=Pin\n*End Instance\n", "")
    first, second = model.mesh(litz.read_mesh(file(text, "cae.inp"), dialect="abaqus"))
    assert (first.section.radius, second.section.radius) == (0.1, 0.1)
    assert list(first.elements) == [1, 2]
    assert list(second.elements) == [3, 4]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("part=Pin\n*End", "part=Needle\n*End", "refers to the part Needle, which does not exist"),
        ("0., 0., 1., 0., 0., 2., 90.", "0., 0., 1., 0., 0., 2.", "second line of .*Wire-2 needs seven numbers"),
        ("0., 0., 1., 0., 0., 2., 90.", "0., 0., 1., 0., 0., 2.,", "second line of .*Wire-2 needs seven numbers"),
        (
            "0., 0., 1., 0., 0., 2., 90.",
            "0., 0., 1., 0., 0., 2., 90.\n90.",
            "INSTANCE Wire-2 has two data lines, .*not 3",
        ),
        (
            "0., 0., 1., 0., 0., 2., 90.",
            "0., 0., 1., 0., 0., 1., 90.",
            "the axis of the rotation of .INSTANCE Wire-2 has no length",
        ),
        ("Pin-1.all", "Pin-1.everything", "there is no set Pin-1.everything"),
        (CAE[CAE.index("*Assembly") : CAE.index("*Material")], "", "has parts, but no .INSTANCE"),
    ],
)
def test_instances_that_cannot_be_made(file, old, new, message):
    assert old in CAE
    with pytest.raises(litz.FileError, match=message):
        litz.read_mesh(file(CAE.replace(old, new), "cae.inp"), dialect="abaqus")


def test_trusses_are_wires_where_there_are_no_beams(file):
    trusses = "*Node\n 1, 0\n 2, 1\n 3, 2\n 4, 3\n*Element, type=T3D2, elset=A\n 7, 1, 2\n"
    quadratic = "*Element, type=T3D3, elset=B\n 8, 2, 3, 4\n"
    mesh = litz.read_mesh(file(trusses + quadratic, "lines.inp"))
    assert mesh.connectivity.tolist() == [[0, 1], [1, 2], [2, 3]]
    assert mesh.element_sets["B"].tolist() == [1, 2]
    beam = "*Element, type=B31, elset=C\n 9, 3, 4\n"
    with pytest.warns(UserWarning, match="2 of type T3D2 or T3D3"):
        mesh = litz.read_mesh(file(trusses + quadratic + beam, "mixed.inp"))
    assert mesh.x[mesh.connectivity].tolist() == [[[2, 0, 0], [3, 0, 0]]]
    assert {name: rows.tolist() for name, rows in mesh.element_sets.items()} == {"C": [0]}


@pytest.fixture(scope="module")
def gmsh():
    """The package gmsh, with two wires of curved and straight lines, meshed."""
    gmsh = pytest.importorskip("gmsh", reason="the package gmsh is not installed: pip install gmsh")
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    kernel = gmsh.model.occ
    arc = kernel.addCircle(0, 0, 0, 1, angle1=0, angle2=np.pi)
    line = kernel.addLine(kernel.addPoint(0, -1, 0.2), kernel.addPoint(0, 3, 0.2))
    kernel.synchronize()
    for name, curve in (("half ring", arc), ("straight", line)):
        gmsh.model.addPhysicalGroup(1, [curve], name=name)
        ends = [tag for _, tag in gmsh.model.getBoundary([(1, curve)], oriented=False)]
        gmsh.model.addPhysicalGroup(0, ends, name=f"ends of {name}")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    gmsh.model.mesh.generate(1)
    yield gmsh
    gmsh.finalize()


@pytest.mark.parametrize("binary", [0, 1], ids=["text", "binary"])
@pytest.mark.parametrize("version", [2.2, 4.1])
def test_meshes_that_gmsh_writes(gmsh, tmp_path, capfd, version, binary):
    pytest.importorskip("meshio")
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.write(str(tmp_path / "mesh.msh"))
    mesh = litz.read_mesh(tmp_path / "mesh.msh")
    check_wires_of_gmsh(mesh)
    assert set(mesh.element_sets) == {"half_ring", "straight"}
    for name, ends in (("half_ring", [[1, 0, 0], [-1, 0, 0]]), ("straight", [[0, -1, 0.2], [0, 3, 0.2]])):
        np.testing.assert_allclose(mesh.x[mesh.node_sets[f"ends_of_{name}"]], ends, atol=1e-12)
    assert capfd.readouterr().out == ""


def test_decks_that_gmsh_writes(gmsh, tmp_path):
    gmsh.write(str(tmp_path / "mesh.inp"))
    check_wires_of_gmsh(litz.read_mesh(tmp_path / "mesh.inp"))


def check_wires_of_gmsh(mesh):
    """The wires have the lengths of half a ring of radius 1, as polygon, and of a line of length 4."""
    lengths = {
        name: np.linalg.norm(np.diff(mesh.x[mesh.connectivity[rows]], axis=1), axis=2).sum()
        for name, rows in mesh.element_sets.items()
    }
    n = len(mesh.element_sets["half_ring" if "half_ring" in lengths else "half ring"])
    ring = lengths.get("half_ring", lengths.get("half ring"))
    assert ring == pytest.approx(2 * n * np.sin(np.pi / (2 * n)), rel=1e-6)
    assert lengths["straight"] == pytest.approx(4, rel=1e-12)


def test_a_version_of_gmsh_that_meshio_cannot_read_is_told(gmsh, tmp_path):
    pytest.importorskip("meshio")
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.0)
    gmsh.option.setNumber("Mesh.Binary", 0)
    gmsh.write(str(tmp_path / "mesh.msh"))
    with pytest.raises(litz.FileError, match=r"version 4 of gmsh's format: save it as version 4\.1 or 2\.2"):
        litz.read_mesh(tmp_path / "mesh.msh")


@pytest.mark.parametrize("name", ["mesh.bdf", "mesh.unknown", "mesh.msh", "mesh.vtu"])
def test_files_that_meshio_cannot_read_are_told_without_a_traceback(file, name):
    pytest.importorskip("meshio")
    with pytest.raises(litz.FileError, match=f"meshio cannot read .*{name}: "):
        litz.read_mesh(file("nothing that is a mesh\n", name))


def test_physical_groups_of_gmsh_are_sets(file):
    pytest.importorskip("meshio")
    with pytest.warns(UserWarning, match="1 elements that are not lines are ignored"):
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
        ({}, "no sections of round wires: radius and material are needed"),
        ({"radius": 1e-3}, "material is required"),
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
        ("*Node\n 1, 0, 0, 0\n*Element, type=B31\n 1, 1, 2\n", "node 2, which does not exist"),
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
