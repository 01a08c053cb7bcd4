"""Models of decks for programs that have the contact element as a user element."""

import re
import shutil
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest

import litz
from in_process import command
from litz import kernels, read_mesh
from litz.errors import FileError, InputError
from litz.hosts import abaqus_input, ccx_input, feap_input, read_host_model

INPUTS = Path(__file__).parents[2] / "inputs"
CROSSED = INPUTS / "01_crossed_wires.inp"


@pytest.fixture(scope="module")
def crossed():
    return read_host_model(CROSSED)


def changed(tmp_path, *changes):
    """The deck of two crossed wires with other texts."""
    text = CROSSED.read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    deck = tmp_path / "changed.inp"
    deck.write_text(text)
    return deck


def feap_block(text, name):
    """Lines of numbers of a block of FEAP's input."""
    lines = text.split(f"\n{name}\n")[1].split("\n\n")[0].splitlines()
    return [[float(value) for value in line.split(",")] for line in lines]


class TestReading:
    def test_the_deck_is_all_there(self, crossed):
        assert crossed.node_numbers.tolist() == [*range(101, 113), *range(201, 213)]
        assert crossed.element_numbers.tolist() == [*range(101, 112), *range(201, 212)]
        assert len(crossed.sections) == 1
        assert crossed.sections[0][0].radius == 1e-3
        assert crossed.prescribed == {(0, 9): 1e-3, (12, 3): -0.11e-3, (23, 3): -0.11e-3}
        assert {dof for row, dof in crossed.supports if row == 0} == {1, 2, 3, 4, 5, 6}
        assert {dof for row, dof in crossed.supports if row == 12} == {1, 2, 4, 5, 6, 9}

    def test_the_pair_that_crosses_is_a_candidate_and_no_wire_touches_itself(self, crossed):
        numbers = crossed.element_numbers[crossed.pairs]
        assert numbers.tolist() == [[106, 206]]
        # the elements of a straight wire go on in each other, however far the reach
        far = read_host_model(CROSSED, reach=0.03)
        numbers = far.element_numbers[far.pairs]
        assert len(numbers) > 9
        assert (numbers[:, 0] < 200).all()
        assert (numbers[:, 1] > 200).all()

    def test_the_laws_are_numbers_of_the_element(self, tmp_path):
        deck = changed(
            tmp_path,
            ("OVERCLOSURE=HERTZ", "OVERCLOSURE=LINEAR\n 2.e6"),
            ("LAW=HERTZ", "LAW=TABLE, VOLTAGE=LINEAR\n 1., 2.e-3\n 10., 1.e-3"),
        )
        (laws,) = read_host_model(deck).laws
        assert (laws.normal, laws.spot, laws.penalty, laws.data, laws.voltage) == (
            1,
            6,
            2e6,
            (1.0, 2e-3, 10.0, 1e-3),
            0,
        )

    def test_what_is_left_out_is_told(self, tmp_path):
        deck = changed(
            tmp_path,
            ("*CONTACT PAIR", "*FRICTION\n 0.3\n*CONTACT PAIR"),
            ("OVERCLOSURE=HERTZ", "OVERCLOSURE=HERTZ, YIELD=3.e8"),
        )
        with pytest.warns(UserWarning, match=r"not exported: \*FRICTION, YIELD of \*SURFACE BEHAVIOR"):
            read_host_model(deck)

    def test_crossings_at_nodes_are_told(self):
        with pytest.warns(UserWarning, match=r"elements 102 and 502 cross at a node \(64 pairs of elements do\)"):
            read_host_model(INPUTS / "04_wire_grid.inp")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            read_host_model(CROSSED)

    def test_a_deck_with_an_error_is_refused_with_the_message_of_the_program(self, tmp_path):
        with pytest.raises(InputError, match="Poisson's ratio"):
            read_host_model(changed(tmp_path, ("120.e9, 0.34", "120.e9, 0.64")))

    def test_a_penalty_per_length_alone_is_refused(self, tmp_path):
        deck = changed(
            tmp_path,
            ("OVERCLOSURE=HERTZ", "OVERCLOSURE=LINEAR\n , 2.e9"),
            ("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n", ""),
        )
        with pytest.raises(FileError, match="penalty per length only"):
            read_host_model(deck)


class TestFeap:
    def test_control_data_and_blocks_agree(self, crossed):
        text = feap_input(crossed)
        n_nodes, n_elements, n_materials, ndm, ndf, nen = map(int, text.splitlines()[1].split())
        assert (ndm, ndf, nen) == (3, 7, 4)
        assert len(feap_block(text, "COORdinates")) == n_nodes == 24
        # beams, conductors, contacts
        elements = feap_block(text, "ELEMents")
        assert len(elements) == n_elements == 22 + 22 + 1
        assert [row[0] for row in elements] == [*range(1, n_elements + 1)]
        assert len(re.findall(r"^MATErial,", text, re.MULTILINE)) == n_materials == 3
        assert elements[-1] == [45, 0, 3, 6, 7, 18, 19]

    def test_lengths_are_in_a_unit_in_which_the_sections_are_not_degenerate(self, crossed):
        text = feap_input(crossed)
        assert "! unit of length: 0.001 of the deck's" in text
        x = np.array(feap_block(text, "COORdinates"))[:, 2:]
        assert x == pytest.approx(1e3 * crossed.x)
        # the smallest inertia that FEAPpv takes is 1e-8
        area, inertia = map(float, re.search(r"CROSs SECTion, ([^,]*), ([^,]*)", text).groups())
        assert area == pytest.approx(np.pi, rel=1e-8)
        assert inertia == pytest.approx(np.pi / 4, rel=1e-8)
        assert [row[4] for row in feap_block(text, "DISPlacements")] == pytest.approx([0, -0.11, -0.11])

    def test_numbers_fit_the_columns(self, crossed):
        numbers = re.findall(r"[-+.e\d]*\d[-+.e\d]*", feap_input(crossed))
        assert len(numbers) > 300
        assert max(map(len, numbers)) <= 15

    @pytest.mark.parametrize("law", [dict(spot_law="hertz"), dict(spot_law="film", film_resistivity=2e-12)])
    def test_the_same_contact_in_another_unit_of_length(self, law):
        """Forces and currents do not depend on it."""
        x = np.array([[-0.01, 0, 1.998e-3], [0.01, 0, 1.998e-3], [0, -0.01, 0], [0, 0.01, 0]])
        t = np.array([[1.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]])
        wires = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8, normal_law="hertz")
        metre = kernels.contact_em(x, t, [0.02, 0.02], [1e-3, 1e-3, 0, 0], **wires, **law)
        wires |= dict(radius=1.0, young=120e9 / 1e6, resistivity=1.7e-5)
        law = law | ({"film_resistivity": 2e-6} if "film_resistivity" in law else {})
        millimetre = kernels.contact_em(1e3 * x, t, [20, 20], [1e-3, 1e-3, 0, 0], **wires, **law)
        assert millimetre.force == pytest.approx(metre.force, rel=1e-12)
        assert millimetre.current == pytest.approx(metre.current, rel=1e-12)

    @pytest.mark.parametrize(
        ("law", "expected"),
        [
            ("LAW=PLASTIC\n 1.e9", [1e9 / 1e6]),
            ("LAW=FILM\n 2.e-12", [2e-12 * 1e6]),
            ("LAW=CONSTANT\n 0.5", [0.5]),
            ("LAW=SHARVIN\n 6.6e-16, 1.e-12", [6.6e-10, 1e-6]),
            ("LAW=CLUSTER\n 1.e9, 5.", [1e3, 5]),
            ("LAW=CLUSTER\n 1.e9, 5., 1.e-12", [1e3, 5, 1e-6]),
        ],
    )
    def test_numbers_of_spot_laws_are_in_that_unit(self, tmp_path, law, expected):
        text = feap_input(read_host_model(changed(tmp_path, ("LAW=HERTZ", law))))
        wires, laws, _ = text.split("USER, 1\n")[1].split("\n\n")[0].splitlines()
        assert [float(value) for value in wires.split(",")] == pytest.approx(
            [1, 1, 120e3, 120e3, 0.34, 0.34, 1.7e-5, 1.7e-5], rel=1e-7
        )
        assert [float(value) for value in laws.split(",")] == pytest.approx([0, *expected])

    def test_a_table_has_its_lines(self, tmp_path):
        deck = changed(tmp_path, ("LAW=HERTZ", "LAW=TABLE\n 1., 2.e-3\n 10., 1.e-3"))
        lines = feap_input(read_host_model(deck)).split("USER, 1\n")[1].split("\n\n")[0].splitlines()
        assert [float(value) for value in lines[2].split(",")] == [2, 6, 2, 1, 2]
        assert [[float(value) for value in line.split(",")] for line in lines[3:]] == [[1, 2e-3], [10, 1e-3]]

    def test_a_table_that_is_too_long_is_refused(self, tmp_path):
        table = "".join(f"\n {i}., {1 / i}" for i in range(1, 22))
        with pytest.raises(FileError, match="at most 20 pairs in FEAP, not 21"):
            feap_input(read_host_model(changed(tmp_path, ("LAW=HERTZ", f"LAW=TABLE{table}"))))


class TestAbaqus:
    def test_the_mesh_is_read_back(self, crossed, tmp_path):
        path = tmp_path / "abaqus.inp"
        path.write_text(abaqus_input(crossed))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # user elements are no beams
            mesh = read_mesh(path, dialect="abaqus")
        assert mesh.x == pytest.approx(crossed.x)
        assert np.array_equal(mesh.connectivity, crossed.connectivity)
        assert set(mesh.kinds) == {"B33"}

    def test_user_elements_have_the_properties_that_they_declare(self, crossed):
        text = abaqus_input(crossed)
        assert (
            "*USER ELEMENT, TYPE=U1, NODES=4, COORDINATES=3, PROPERTIES=10, I PROPERTIES=5, VARIABLES=6, UNSYMM" in text
        )
        data = text.split("*UEL PROPERTY, ELSET=CONTACTS_1\n")[1].split("*")[0].replace("\n", ",")
        values = [float(value) for value in data.split(",") if value.strip()]
        assert values == pytest.approx(
            [1e-3, 1e-3, 120e9, 120e9, 0.34, 0.34, 1.7e-8, 1.7e-8, 0, 0, 2, 2, 2, 1, 0], rel=1e-9
        )
        assert "\n 423, 106, 107, 206, 207\n" in text
        assert text.count("\n 312, 101, 102\n") == 1

    def test_the_potential_is_degree_of_freedom_11(self, crossed):
        text = abaqus_input(crossed)
        assert " 101, 11, 11, 0.001\n" in text
        assert " 201, 11, 11, 0\n" in text
        assert not re.search(r"^ \d+, 9,", text, re.MULTILINE)

    @pytest.mark.filterwarnings("ignore:.*cross at a node")
    def test_all_numbers_of_elements_differ(self):
        model = read_host_model(INPUTS / "04_wire_grid.inp")
        text = abaqus_input(model)
        blocks = re.findall(r"\*ELEMENT, [^\n]*\n([^*]*)", text)
        numbers = [line.split(",")[0] for block in blocks for line in block.splitlines()]
        assert len(numbers) == 2 * len(model.connectivity) + len(model.pairs)
        assert len(set(numbers)) == len(numbers)

    @pytest.mark.filterwarnings("ignore:.*cross at a node")
    def test_the_direction_of_the_sections_is_not_along_the_wires(self):
        model = read_host_model(INPUTS / "04_wire_grid.inp")
        for place in range(len(model.sections)):
            members = np.flatnonzero(model.section_of == place)
            ends = model.x[model.connectivity[members]]
            along = (ends[:, 1] - ends[:, 0]) / np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)[:, None]
            assert (abs(along @ model.cross_direction(members)) < 0.9).all()


class TestCommand:
    def call(self, *arguments):
        return command("export", *arguments)

    @pytest.mark.parametrize(("program", "first"), [("feap", "FEAP * * Two copper wires"), ("abaqus", "*HEADING")])
    def test_it_writes_the_input(self, tmp_path, program, first):
        path = tmp_path / "model"
        done = self.call(program, CROSSED, "-o", path)
        assert done.returncode == 0
        assert "24 nodes, 22 beams, 1 pair that may touch" in done.stdout
        assert path.read_text().startswith(first)
        again = self.call(program, CROSSED, "-o", path)
        assert again.returncode == FileError.exit_code
        assert "is not overwritten" in again.stderr

    def test_input_of_feap_begins_with_the_letter_that_feappv_asks_for(self, tmp_path):
        deck = tmp_path / "wires.inp"
        deck.write_text(CROSSED.read_text())
        done = self.call("feap", deck)
        assert f"wrote {tmp_path}/Iwires" in done.stdout
        assert "NONE" not in done.stdout
        assert "to a file NONE" in self.call("feap", deck, "-o", tmp_path / "wires.txt").stdout

    @pytest.mark.slow
    def test_it_says_what_there_is(self, tmp_path):
        assert self.call("nastran", CROSSED).returncode == 1
        assert self.call("feap", CROSSED, "--reach", "-1").returncode == 1
        assert self.call("feap", tmp_path / "missing.inp").returncode == FileError.exit_code

    def test_it_says_what_calculix_lacks(self, tmp_path):
        path = tmp_path / "crossed_ccx.inp"
        done = self.call("ccx", CROSSED, "-o", path)
        assert done.returncode == 0
        assert f"24 nodes, 22 beams; run it: ccx -i {tmp_path}/crossed_ccx" in done.stdout
        assert "left out: contact of 1 pair of elements" in done.stdout
        assert "left out: potentials and currents" in done.stdout
        assert "** left out: contact of 1 pair of elements" in path.read_text()


#: A cantilever of steel, 100 mm long and 2 mm thick
CANTILEVER = """\
*NODE
{nodes}*ELEMENT, TYPE=B33, ELSET=WIRE
{elements}*NSET, NSET=TIP
 {last}
*MATERIAL, NAME=STEEL
*ELASTIC
 200e9, 0.3
*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC
 1e-3
{cards}*BOUNDARY
 1, ENCASTRE
*STEP
*STATIC
 0.1, 1.
{loads}
*END STEP
"""


def cantilever(path, n, loads, cards="", direction=(1.0, 0.0, 0.0)):
    places = np.outer(np.linspace(0, 0.1, n + 1), direction)
    path.write_text(
        CANTILEVER.format(
            nodes="".join(f" {i}, {x:.17g}, {y:.17g}, {z:.17g}\n" for i, (x, y, z) in enumerate(places, 1)),
            elements="".join(f" {i}, {i}, {i + 1}\n" for i in range(1, n + 1)),
            last=n + 1, cards=cards, loads=loads,
        )
    )  # fmt: skip
    return path


class TestCalculix:
    """CalculiX takes beams for bricks, and a circle for an octagon of curved sides: of 2 % too small an area."""

    def displacements(self, deck):
        """Of all nodes at the end, as CalculiX prints them."""
        path = deck.with_name(deck.stem + "_ccx.inp")
        path.write_text(ccx_input(read_host_model(deck)))
        subprocess.run(["ccx", "-i", path.stem], cwd=path.parent, check=True, capture_output=True)
        blocks = path.with_suffix(".dat").read_text().split("displacements (vx,vy,vz)")
        last = blocks[-1].split("forces")[0].splitlines()[1:]
        rows = [[float(value) for value in line.split()[1:4]] for line in last if len(line.split()) == 4]
        return np.array(rows)

    def test_the_input_is_that_of_quadratic_beams_with_diameters(self, tmp_path):
        text = ccx_input(read_host_model(cantilever(tmp_path / "beam.inp", 2, "*CLOAD\n 3, 2, 1.0")))
        assert "*ELEMENT, TYPE=B32R, ELSET=WIRES_1\n1, 1, 4, 2\n2, 2, 5, 3\n" in text
        assert "4, 0.025, 0, 0\n5, 0.075, 0, 0\n" in text
        assert "SECTION=CIRC\n0.002, 0.002\n" in text
        assert "*CLOAD\n3, 2, 1\n" in text

    @pytest.mark.skipif(shutil.which("ccx") is None, reason="apt-get install calculix-ccx")
    @pytest.mark.parametrize(
        ("loads", "n", "tolerance"),
        [
            # elements of five diameters, and of one and a quarter
            ("*CLOAD\n {tip}, 2, 0.01", 10, 0.02), ("*CLOAD\n {tip}, 2, 0.01", 40, 0.01),
            # a deflection of more than half the length
            ("*CLOAD\n {tip}, 2, 40.0", 10, 0.02), ("*CLOAD\n {tip}, 2, 40.0", 40, 0.01),
            ("*BOUNDARY\n {tip}, 2, 2, 0.03", 10, 0.03),
            # the area is 2.5 % smaller
            ("*CLOAD\n {tip}, 1, 100.", 40, 0.03),
        ],
    )  # fmt: skip
    def test_a_cantilever_is_that_of_litz(self, tmp_path, loads, n, tolerance):
        deck = cantilever(tmp_path / "beam.inp", n, loads.format(tip=n + 1))
        own = litz.run(deck, output_directory=tmp_path / "own").field("displacement")[-1]
        other = self.displacements(deck)[n]
        assert np.linalg.norm(other - own) < tolerance * np.linalg.norm(own)
        assert np.linalg.norm(own) > 1e-5

    @pytest.mark.skipif(shutil.which("ccx") is None, reason="apt-get install calculix-ccx")
    @pytest.mark.parametrize(
        "system", [" 0., 0., 1., 1., 0., 0.", ", TYPE=C\n 0., 0., -1., 0., 0., 1."], ids=["rectangular", "cylindrical"]
    )
    def test_local_axes_are_passed_on(self, tmp_path, system):
        """A wire along y and z, loaded along the first of its local axes, which is z, or radial from z: y."""
        card = f"*TRANSFORM, NSET=TIP{system}\n" if system.startswith(",") else f"*TRANSFORM, NSET=TIP\n{system}\n"
        deck = cantilever(tmp_path / "beam.inp", 20, "*CLOAD\n TIP, 1, 0.01", card, (0.0, 0.6, 0.8)).resolve()
        text = deck.read_text().replace("*CLOAD\n TIP", "*CLOAD\n 21")
        deck.write_text(text)
        own = litz.run(deck, output_directory=tmp_path / "own").field("displacement")[-1]
        other = self.displacements(deck)[20]
        assert np.linalg.norm(other - own) < 0.015 * np.linalg.norm(own)
        assert np.linalg.norm(own) > 1e-5

    def test_axes_that_a_program_lacks_are_refused(self, tmp_path):
        card = "*TRANSFORM, NSET=TIP, TYPE=S\n 0., 0., -1., 0., 0., 1.\n"
        model = read_host_model(cantilever(tmp_path / "beam.inp", 2, "*CLOAD\n 3, 2, 1.0", card))
        assert "*TRANSFORM, NSET=LOCAL_AXES_1, TYPE=S\n 0, 0, -1, 0, 0, 1\n" in abaqus_input(model)
        with pytest.raises(FileError, match="CalculiX has no \\*TRANSFORM, TYPE=S"):
            ccx_input(model)
        with pytest.raises(FileError, match="cannot be exported to FEAP"):
            feap_input(model)
