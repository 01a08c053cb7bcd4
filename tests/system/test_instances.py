"""Decks with parts and instances: they run as the flat deck, and messages name their own lines."""

import os
import subprocess
import sys

import numpy as np
import pytest

import litz
from litz import Results
from litz.errors import InputError
from test_cli import command
from test_converted_decks import CAE

MODES = CAE[CAE.index("*Step, name=Modes") : CAE.index("*Step, name=Load")]
DECK = CAE.replace(MODES, "")
#: 1 mN at the tip of a bar of 2 x 6 that is 100 long
SAG = 1e-3 * 100**3 / (3 * 210000 * 2 * 6**3 / 12)


@pytest.fixture
def deck(tmp_path):
    path = tmp_path / "frame.inp"
    path.write_text(DECK)
    return path


def test_instances_are_placed_and_run(deck, tmp_path):
    done = command("run", deck, "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    results = Results(tmp_path / "out")
    np.testing.assert_allclose(
        results.field("reference_position")[3:], [[0, 0, 40], [0, 50, 40], [0, 100, 40]], atol=1e-12
    )
    # a deflection of 4e-5 of the length
    np.testing.assert_allclose(results.field("displacement")[[2, 5], 2], [SAG, 2 * SAG], rtol=1e-7)


@pytest.mark.filterwarnings("ignore:.*ignored")
def test_from_python_it_is_the_same(deck, tmp_path):
    assert "6 nodes, 4 elements" in litz.check(deck)
    results = litz.run(deck, output_directory=tmp_path / "out")
    np.testing.assert_allclose(results.field("displacement")[[2, 5], 2], [SAG, 2 * SAG], rtol=1e-7)


@pytest.mark.slow
def test_it_is_the_deck_that_convert_writes(deck, tmp_path):
    assert command("run", deck, "-o", "direct", cwd=tmp_path).returncode == 0
    assert command("convert", deck, "flat.inp", cwd=tmp_path).returncode == 0
    assert command("run", "flat.inp", "-o", "flat", cwd=tmp_path).returncode == 0
    one, other = Results(tmp_path / "direct"), Results(tmp_path / "flat")
    for name in ("node_id", "element_id", "displacement", "reaction_force", "bending_moment_2"):
        np.testing.assert_array_equal(one.field(name), other.field(name), err_msg=name)


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("Tip-2, 3, 2e-3", "Tip-2, 3, 2e-3\nTip-7, 3, 1", "Tip-7, 3, 1", 'no node set "Tip-7"'),
        (" 3, 100., 0., 0.", "** the tip\n 3, 100., 0., 0., 7.", "3, 100., 0., 0., 7.", "too many values"),
        (" 3, 100., 0., 0.", " 3, 100., 0., abc", "*Node", "could not convert string to float: 'abc'"),
        ("2, 2, 3\n", "2, 2, 9\n", "*Element", "there is no number 9 in the instance Bar-1"),
        ("part=Bar\n 0., 0., 40.", "part=Beam\n 0., 0., 40.", "*Instance, name=Bar-2", "refers to the part Beam"),
        ("*End Assembly", "*Nset, nset=Middle, instance=Bra-1\n 2\n*End Assembly", "*Nset, nset=Middle",
         "*NSET: there is no instance 'Bra-1'; did you mean 'Bar-1'?"),
        (" 1, 3, 1\n", " 1, 3, 1\n 4, 2000000000\n", "*Nset, nset=Set-1, generate",
         "the instance Bar-1 has no number from 4 to 2000000000"),
        (" 1, 2, 1\n", " 1\n", "*Elset, elset=Set-1, generate", "a range has a first and a last number"),
        ("Roots, ENCASTRE", "3, ENCASTRE", "*Boundary", "one of an instance is INSTANCE.3"),
        ("2., 6.\n", "2., -6.\n", "2., -6.", "must be"),
        ("*End Part", "*Rigid Surface, name=Floor, type=PLANE\n 0, 0, 0, 0, 0, 1\n*End Part", "*Rigid Surface",
         "write it outside of parts and instances"),
    ],
)  # fmt: skip
def test_messages_name_the_lines_of_the_deck(tmp_path, old, new, line, message):
    text = DECK.replace(old, new, 1)
    assert text != DECK
    (tmp_path / "frame.inp").write_text(text)
    number = next(i for i, one in enumerate(text.splitlines(), 1) if one.strip().startswith(line))
    done = command("check", "frame.inp", cwd=tmp_path)
    assert done.returncode == 1
    # of a part that is there twice, both instances are wrong
    assert message in done.stderr
    assert f"--> frame.inp:{number}" in done.stderr
    with pytest.raises(InputError, match=r"frame\.inp"):
        litz.check(tmp_path / "frame.inp")


@pytest.mark.parametrize("last", [8, 2000000000])
def test_numbers_of_a_range_that_no_node_has_are_skipped_as_in_flat_decks(tmp_path, last):
    text = DECK.replace(
        "*Nset, nset=Tip-2, instance=Bar-2\n 3,", f"*Nset, nset=Tip-2, instance=Bar-2, generate\n 3, {last}, 1"
    )
    (tmp_path / "frame.inp").write_text(text.replace("*Output", "*Node Print, nset=Tip-2\nU\n*Output"))
    done = command("run", "frame.inp", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    np.testing.assert_allclose(Results(tmp_path / "out").field("displacement")[5, 2], 2 * SAG, rtol=1e-7)


def test_nodes_of_element_sets_of_parts_and_instances(tmp_path):
    """In the part, and of one instance in the assembly: the element at the tip of the second bar has nodes 2 and 3."""
    text = DECK.replace("** Section", "*Elset, elset=Last\n 2\n*Nset, nset=Both, elset=Last\n** Section")
    text = text.replace("*End Assembly", "*Nset, nset=Of, elset=Last, instance=Bar-2\n*End Assembly")
    text = text.replace("*Output", "*Node Print, nset=Of\nU\n*Node Print, nset=Bar-2.Both\nU\n*Output")
    (tmp_path / "frame.inp").write_text(text)
    told = command("check", "frame.inp", cwd=tmp_path)
    assert told.returncode == 0, told.stderr
    for name in ("OF", "BAR-1.BOTH", "BAR-2.BOTH"):
        assert f"node set {name}: 2 members" in told.stdout
    mesh = litz.read_mesh(tmp_path / "frame.inp", dialect="abaqus")
    np.testing.assert_allclose(mesh.x[mesh.node_sets["Of"], 1], [50, 100])
    np.testing.assert_allclose(mesh.x[mesh.node_sets["Bar-1.Both"], 0], [50, 100])


def test_sets_of_an_instance_are_members_of_sets_of_the_assembly(tmp_path):
    text = DECK.replace("** Section", "*Nset, nset=Last\n 3\n** Section")
    text = text.replace("*End Assembly", "*Nset, nset=Of, instance=Bar-2\n Last, 2\n*End Assembly")
    (tmp_path / "frame.inp").write_text(text.replace("*Output", "*Node Print, nset=Of\nU\n*Output"))
    told = command("check", "frame.inp", cwd=tmp_path)
    assert told.returncode == 0, told.stderr
    assert "node set OF: 2 members" in told.stdout


def test_parts_may_be_in_included_files(tmp_path):
    first, last = DECK.index("*Part"), DECK.index("*Assembly")
    (tmp_path / "mesh").mkdir()
    (tmp_path / "mesh" / "bar.inp").write_text(DECK[first:last])
    (tmp_path / "frame.inp").write_text(DECK[:first] + "*Include, input=mesh/bar.inp\n" + DECK[last:])
    done = command("run", "frame.inp", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    np.testing.assert_allclose(Results(tmp_path / "out").field("displacement")[5, 2], 2 * SAG, rtol=1e-7)


@pytest.mark.filterwarnings("ignore:.*ignored")
@pytest.mark.parametrize("axis", ["", " 0., 0., -1."])
def test_axes_that_are_left_out_turn_with_their_instance(tmp_path, axis):
    """A blank line before the moduli stands for (0, 0, -1) in the axes of the part."""
    section = DECK[DECK.index("*Beam Section") : DECK.index("*End Part")]
    general = "*Beam General Section, elset=Set-1, section=GENERAL\n 12., 36., 0., 4., 12.5\n{}\n 210000., 80769.23\n"
    turned = DECK.replace(section, general.format(axis)).replace(
        "0., 0., 40., 0., 0., 41., 90.", "0., 0., 40., 1., 0., 40., 90."
    )
    path = tmp_path / "frame.inp"
    path.write_text(turned.replace("*Material, name=Steel\n*Elastic\n210000., 0.3\n", ""))
    results = litz.run(path, output_directory=tmp_path / "out")
    # forces along z bend the first bar about y with I22, and the other one, turned about x, with I11
    weak, strong = (1e-3 * 100**3 / (3 * 210000 * second) for second in (4, 36))
    np.testing.assert_allclose(results.field("displacement")[[2, 5], 2], [weak, 2 * strong], rtol=1e-6)


def test_round_wires_of_turned_instances_need_no_axis(tmp_path):
    """Along z in the part, where the default axis of Abaqus is along them."""
    text = DECK.replace(" 2, 50., 0., 0.\n 3, 100., 0., 0.", " 2, 0., 0., 50.\n 3, 0., 0., 100.")
    text = text.replace("section=RECT\n2., 6.\n0.,1.,0.", "section=CIRC\n 2.").replace(", 3, 1e-3", ", 1, 1e-3")
    text = text.replace("0., 0., 41., 90.", "1., 0., 40., 90.").replace("Tip-2, 3", "Tip-2, 1")
    (tmp_path / "frame.inp").write_text(text)
    done = command("run", "frame.inp", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    sag = 1e-3 * 100**3 / (3 * 210000 * np.pi * 2**4 / 4)
    np.testing.assert_allclose(Results(tmp_path / "out").field("displacement")[[2, 5], 0], [sag, 2 * sag], rtol=1e-7)


def test_reference_nodes_and_equations_of_instances(tmp_path):
    """The tips of two bars are moved by one node of the assembly: by a rigid body in one, by an equation in the other."""
    text = DECK.replace("*End Assembly", "*Node\n 1, 0., 0., 0.\n*Nset, nset=Lead\n 1\n*End Assembly")
    text = text.replace("*Amplitude, name",
        "*Rigid Body, ref node=Bar-1.3, pin nset=Middle\n"
        "*Equation\n2\nBar-2.3, 3, 1., 1, 3, -1.\n2\nBar-1.3, 3, 1., Lead, 3, -2.\n*Amplitude, name")  # fmt: skip
    text = text.replace("*End Assembly", "*Nset, nset=Middle, instance=Bar-1\n 2\n*End Assembly")
    text = text.replace("Bar-1.3, 3, 1e-3\nTip-2, 3, 2e-3\n", "Lead, 3, 1e-3\n")
    (tmp_path / "frame.inp").write_text(text)
    done = command("run", "frame.inp", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    results = Results(tmp_path / "out")
    moved = results.field("displacement")[:, 2]
    assert moved[5] == pytest.approx(moved[6], rel=1e-9)
    assert moved[2] == pytest.approx(2 * moved[6], rel=1e-9)


def test_the_program_alone_says_what_places_them(deck, litz):
    done = litz("check", deck)
    assert done.returncode == 1
    assert "`litz run` and `litz check` of the Python package place the instances" in done.stderr


def test_a_run_that_is_ended_leaves_nothing_behind(deck, tmp_path):
    """SIGTERM reaches the program, and the flat deck is removed."""
    (tmp_path / "tmp").mkdir()
    slow = (
        deck.read_text()
        .replace("1., 1., 1e-05, 1.", "1e-5, 1., 1e-05, 1e-5")
        .replace("nlgeom=YES", "nlgeom=YES, inc=100000")
    )
    deck.write_text(slow)
    process = subprocess.Popen(
        [sys.executable, "-m", "litz", "run", deck, "-o", "out"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        env={**os.environ, "TMPDIR": str(tmp_path / "tmp")}, text=True,
    )  # fmt: skip
    for line in process.stdout:
        if line.strip().startswith("1 "):
            break
    process.terminate()
    process.communicate(timeout=60)
    assert process.returncode == 143
    assert not list((tmp_path / "tmp").iterdir())
    assert not [path for path in (tmp_path / "out").iterdir() if "lock" in path.name]


def test_supports_and_numbers_of_a_part_are_those_of_its_instances(tmp_path):
    """As in decks that are written by hand: supports within the part, by number and by set."""
    text = DECK.replace("*End Part", "*Nset, nset=Root\n 1\n*Boundary\n Root, 1, 3\n 1, 4, 6\n*End Part")
    text = text.replace("*Boundary\nRoots, ENCASTRE\n", "")
    (tmp_path / "frame").write_text(text)
    done = command("run", "frame", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    np.testing.assert_allclose(Results(tmp_path / "out").field("displacement")[[2, 5], 2], [SAG, 2 * SAG], rtol=1e-7)
