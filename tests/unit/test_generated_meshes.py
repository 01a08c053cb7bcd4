"""Cards of Abaqus that generate or copy nodes and elements, and coordinates that are not Cartesian: where everything stands."""

import re

import numpy as np
import pytest

import litz
from litz.deck.instances import flat_cards
from litz.errors import InputError
from litz.model.mesh_of_cards import MeshOfCards

H = np.sqrt(0.5)


@pytest.fixture
def mesh(tmp_path):
    """The mesh of a text."""

    def of(text):
        path = tmp_path / "deck.inp"
        path.write_text(text)
        return MeshOfCards(flat_cards(path))

    return of


def assert_places(mesh, expected):
    for number, place in expected.items():
        np.testing.assert_allclose(mesh.places[number], place, atol=1e-12, err_msg=str(number))
    assert set(mesh.places) == set(expected)


class TestCoordinates:
    def test_cylindrical_ones(self, mesh):
        found = mesh("*NODE, SYSTEM=C\n1, 2., 90., 5.\n2, 2., 45.\n*NODE\n3, 2., 90., 5.\n")
        assert_places(found, {1: [0, 2, 5], 2: [2 * H, 2 * H, 0], 3: [2, 90, 5]})

    def test_axes_of_a_system_are_those_of_the_nodes_that_follow_in_its_part(self, mesh):
        text = (
            "*PART, NAME=P\n*SYSTEM\n1., 0., 0., 1., 1., 0.\n1., 0., 1.\n*NODE\n1, 2., 0., 0.\n2, 0., 2., 0.\n"
            "*NODE, SYSTEM=C\n3, 2., 90., 1.\n*SYSTEM\n*NODE\n4, 2., 0., 0.\n*END PART\n"
            "*INSTANCE, NAME=I, PART=P\n0., 0., 10.\n*END INSTANCE\n"
        )
        assert_places(mesh(text), {1: [1, 2, 10], 2: [1, 0, 12], 3: [2, 0, 12], 4: [2, 0, 10]})

    def test_without_a_third_point_z_stays_and_the_first_axis_is_projected(self, mesh):
        found = mesh("*SYSTEM\n1., 0., 0., 1., 2., 7.\n*NODE\n1, 3., 0., 0.\n2, 0., 3., 0.\n3, 0., 0., 3.\n")
        assert_places(found, {1: [1, 3, 0], 2: [-2, 0, 0], 3: [1, 0, 3]})

    @pytest.mark.parametrize("origin", ["3., 4., 5.", "3., 4., 5., 13., 4., 5."])
    def test_an_origin_alone_moves_them(self, mesh, origin):
        assert_places(mesh(f"*SYSTEM\n{origin}\n*NODE\n1, 1., 0., 0.\n"), {1: [4, 4, 5]})


class TestNodes:
    def test_between_two_nodes_at_equal_distances(self, mesh):
        found = mesh("*NODE\n1, 0., 0., 0.\n7, 3., 6., 0.\n*NGEN, NSET=LINE\n1, 7, 2\n")
        assert_places(found, {1: [0, 0, 0], 3: [1, 2, 0], 5: [2, 4, 0], 7: [3, 6, 0]})
        assert found.nodes("LINE") == [1, 3, 5, 7]

    def test_on_the_shorter_arc_about_a_node_or_a_place(self, mesh):
        ends = "*NODE\n1, 3., 1., 0.\n3, 1., 3., 0.\n9, 1., 1., 0.\n"
        for centre in ("9", ", 1., 1., 0."):
            found = mesh(f"{ends}*NGEN, LINE=C\n1, 3, 1, {centre}\n")
            np.testing.assert_allclose(found.places[2], [1 + 2 * H, 1 + 2 * H, 0])

    def test_on_the_longer_arc_about_a_normal(self, mesh):
        found = mesh("*NODE\n1, 1., 0., 0.\n4, 0., 1., 0.\n*NGEN, LINE=C\n1, 4, 1, , 0., 0., 0., 0., 0., -1.\n")
        assert_places(found, {1: [1, 0, 0], 2: [0, -1, 0], 3: [-1, 0, 0], 4: [0, 1, 0]})

    def test_on_a_parabola(self, mesh):
        found = mesh("*NODE\n1, 0., 0., 0.\n5, 4., 0., 0.\n9, 2., 4., 0.\n*NGEN, LINE=P\n1, 5, 1, 9\n")
        assert_places(found, {1: [0, 0, 0], 2: [1, 3, 0], 3: [2, 4, 0], 4: [3, 3, 0], 5: [4, 0, 0], 9: [2, 4, 0]})

    def test_between_the_nodes_of_two_sets(self, mesh):
        text = (
            "*NODE, NSET=A\n1, 0., 0., 0.\n2, 1., 0., 0.\n*NODE, NSET=B\n21, 0., 2., 0.\n22, 1., 2., 0.\n"
            "*NFILL, NSET=ALL\nA, B, 2, 10\n"
        )
        found = mesh(text)
        np.testing.assert_allclose([found.places[11], found.places[12]], [[0, 1, 0], [1, 1, 0]])
        assert found.nodes("ALL") == [1, 2, 11, 12, 21, 22]

    def test_sets_that_are_not_sorted_keep_their_order(self, mesh):
        text = (
            "*NODE, NSET=A\n1, 0., 0., 0.\n2, 1., 0., 0.\n*NODE\n21, 0., 2., 0.\n22, 1., 2., 0.\n"
            "*NSET, NSET=B, UNSORTED\n22, 21\n*NFILL\nA, B, 2, 10\n"
        )
        np.testing.assert_allclose(mesh(text).places[11], [0.5, 1, 0])

    def test_nodes_of_an_element_set_are_a_set_to_copy(self, mesh):
        text = (
            "*NODE\n1, 1., 0., 0.\n2, 2., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n*NSET, NSET=A, ELSET=E\n"
            "*NCOPY, OLD SET=A, CHANGE NUMBER=10, SHIFT\n0., 0., 5.\n"
        )
        found = mesh(text).places
        np.testing.assert_allclose([found[11], found[12]], [[1, 0, 5], [2, 0, 5]])

    def test_copies_are_moved_and_turned_again_and_again(self, mesh):
        text = (
            "*NODE, NSET=A\n1, 1., 0., 0.\n"
            "*NCOPY, OLD SET=A, CHANGE NUMBER=10, SHIFT, MULTIPLE=2, NEW SET=B\n0., 0., 5.\n0., 0., 0., 0., 0., 1., 90.\n"
        )
        found = mesh(text)
        assert_places(found, {1: [1, 0, 0], 11: [0, 1, 5], 21: [-1, 0, 10]})
        assert found.nodes("B") == [11, 21]


class TestElements:
    NODES = "*NODE\n1, 0., 0., 0.\n3, 2., 0., 0.\n*NGEN, NSET=A\n1, 3\n*NCOPY, OLD SET=A, CHANGE NUMBER=10, SHIFT\n0., 1., 0.\n"

    def test_rows_and_layers(self, mesh):
        found = mesh(f"{self.NODES}*ELEMENT, TYPE=B33\n1, 1, 2\n*ELGEN, ELSET=E\n1, 2, 1, 1, 2, 10, 100\n")
        assert found.connectivity == {1: [1, 2], 2: [2, 3], 101: [11, 12], 102: [12, 13]}
        assert found.elements("E") == {1, 2, 101, 102}

    def test_copies(self, mesh):
        text = "*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n2, 2, 3\n*ELCOPY, OLD SET=E, ELEMENT SHIFT=20, SHIFT NODES=10, NEW SET=F\n"
        found = mesh(self.NODES + text)
        assert found.connectivity == {1: [1, 2], 2: [2, 3], 21: [11, 12], 22: [12, 13]}
        assert found.elements("F") == {21, 22}


#: A quarter of a ring of radius 100, clamped at one end, with a radial force at the other
RING = """\
*HEADING
A quarter of a ring
*PART, NAME=RING
*NODE, SYSTEM=C, NSET=ENDS
1, 100., 0., 0.
49, 100., 90., 0.
*NGEN, LINE=C
1, 49, 1, , 0., 0., 0.
*ELEMENT, TYPE=B33
1, 1, 2
*ELGEN, ELSET=RING
1, 48
*BEAM SECTION, ELSET=RING, MATERIAL=M, SECTION=RECT
1., 1.
0., 0., 1.
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=R, PART=RING
0., 0., 7.
*END INSTANCE
*END ASSEMBLY
*MATERIAL, NAME=M
*ELASTIC
210000., 0.3
*BOUNDARY
R.1, ENCASTRE
*STEP, NLGEOM=YES
*STATIC
*CLOAD
R.49, 2, 1e-3
*END STEP
"""


def test_a_ring_of_generated_nodes_bends_as_castigliano_says(tmp_path):
    """F R^3 pi/(4 EI) radially at its end, of which a polygon of 48 sides misses 0.05 %."""
    (tmp_path / "ring.inp").write_text(RING)
    results = litz.run(tmp_path / "ring.inp", output_directory=tmp_path / "out")
    sag = 1e-3 * 100**3 * np.pi / 4 / (210000 / 12)
    row = int(np.flatnonzero(results.field("node_id") == 49)[0])
    assert results.field("displacement")[row, 1] == pytest.approx(sag, rel=2e-3)


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("1, 49, 1, ,", "1, 49, 5, ,", "*NGEN", "from 1 to 49 there are no whole steps of 5"),
        ("1, 49, 1, ,", "1, 50, 1, ,", "*NGEN", "there is no number 50"),
        ("49, 100., 90.", "49, 90., 90.", "*NGEN", "have distances of 100 and 90 from the centre"),
        ("49, 100., 90.", "49, 100., 180.", "*NGEN", "half a turn or a whole one needs a normal"),
        ("*ELGEN, ELSET=RING\n1,", "*ELGEN, ELSET=RING\n2,", "*ELGEN", "there is no number 2"),
        ("LINE=C", "LINE=C, SYSTEM=C", "*NGEN", "*NGEN cannot be read: its parameters may be NSET, LINE"),
        ("SYSTEM=C", "SYSTEM=S", "*NODE", "its parameters may be NSET, SYSTEM=R, SYSTEM=C"),
        ("1, 100., 0., 0.", "1, 100., zero, 0.", "*NODE", "could not convert string to float: 'zero'"),
    ],
)
def test_what_cannot_be_generated_is_told_with_its_place(tmp_path, old, new, line, message):
    text = RING.replace(old, new)
    assert text != RING
    (tmp_path / "ring.inp").write_text(text)
    number = next(i for i, one in enumerate(text.splitlines(), 1) if one.startswith(line))
    with pytest.raises(InputError, match=re.escape(message)) as error:
        litz.check(tmp_path / "ring.inp")
    assert f"ring.inp:{number}" in str(error.value)


def test_spherical_coordinates_are_refused(tmp_path):
    (tmp_path / "deck.inp").write_text("*NODE, SYSTEM=S\n1, 2., 90., 0.\n")
    with pytest.raises(
        InputError,
        match=r'unknown parameter "SYSTEM" of \*NODE: .*cylindrical coordinates \(C\), too, but no spherical ones',
    ):
        litz.check(tmp_path / "deck.inp")


def test_one_that_is_not_known_is_the_only_error_and_its_followers_are_none(tmp_path):
    text = TestElements.NODES.replace("*NGEN", "*NGEN, SYSTEM=C")
    (tmp_path / "deck.inp").write_text(text)
    with pytest.raises(InputError, match=r"litz has no \*NGEN: .*docs/tutorials/deck.md names"):
        litz.check(tmp_path / "deck.inp")


@pytest.mark.parametrize(
    ("text", "message", "line"),
    [
        (RING.replace("1, 48\n", "1, 49\n"), "there is no number 50 in the instance R", 11),
        (TestElements.NODES + "*ELEMENT, TYPE=B33\n1, 1, 2\n*ELGEN\n1, 3\n", "element 3 has node 4", 11),
    ],
)
def test_messages_about_generated_elements_name_the_lines_that_make_them(tmp_path, text, message, line):
    (tmp_path / "deck.inp").write_text(text)
    with pytest.raises(InputError, match=message) as error:
        litz.check(tmp_path / "deck.inp")
    assert f"deck.inp:{line}" in str(error.value)
