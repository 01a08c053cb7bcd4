"""`litz new`: decks to begin with run as they stand, and never replace a file."""

import numpy as np
import pytest

import litz
from in_process import command
from litz import build
from litz.build.starters import STARTERS

#: Those with wires that touch
TOUCHING = [task for task in STARTERS if task != "fuse"]
#: Those that run for seconds
LONG = {"strand", "triplet", "cable"}


@pytest.mark.parametrize(
    "task", [pytest.param(task, marks=pytest.mark.slow) if task in LONG else task for task in TOUCHING]
)
def test_a_starter_runs_as_it_stands_and_conducts(task, tmp_path):
    done = command("new", task, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    results = litz.run(tmp_path / f"{task}.inp", output_directory=tmp_path / task)
    assert results.finished
    assert not results.warnings
    assert results.contacts_at(-1).n_rows >= 1
    (resistance,) = [name for name in results.history if name.startswith("resistance ")]
    assert results.history[resistance][-1] > 0


@pytest.mark.parametrize("task", STARTERS)
def test_a_starter_says_what_each_kind_of_card_is_for(task, tmp_path):
    deck = litz.Deck.read(litz.new(task, tmp_path / "deck.inp"))
    kinds = ["CONTACT PAIR", "STATIC"] if task in TOUCHING else ["INITIAL CONDITIONS", "COUPLED THERMAL-ELECTRICAL"]
    for keyword in ("ELEMENT", "MATERIAL", "BEAM SECTION", "STEP", *kinds):
        assert deck.find(keyword)[0].comments, keyword
    assert "litz run deck.inp -o deck" in deck.text


def test_yarns_of_the_fabric_touch_each_other_at_all_crossings(tmp_path):
    results = litz.run(litz.new("fabric", tmp_path / "deck.inp"), output_directory=tmp_path)
    wires = results.contact_network(-1).wires
    # the yarns come before the wires of the plates
    yarns = np.sort(wires[(wires < 8).all(axis=1)], axis=1)
    assert sorted(map(tuple, yarns.tolist())) == [(warp, weft) for warp in range(4) for weft in range(4, 8)]


@pytest.mark.slow
def test_the_mesh_of_the_cable_does_not_press(tmp_path):
    results = litz.run(litz.new("cable", tmp_path / "deck.inp"), output_directory=tmp_path)
    finer = build.cable([[3], [2]], radius=0.1e-3, lay_lengths=[8e-3, 16e-3], length=4e-3, elements_per_lay=80)
    finer.press(-4e-6, voltage=1e-3, increment=0.25)
    expected = finer.run(tmp_path / "finer").contacts_at(-1)["force"].sum()
    assert results.contacts_at(-1)["force"].sum() == pytest.approx(expected, rel=0.01)


def test_friction_of_the_starter_is_coulombs(tmp_path):
    results = litz.run(litz.new("friction", tmp_path / "deck.inp"), output_directory=tmp_path)
    history = results.history
    sliding, pressing = history["RF1 sum UPPER_ENDS"], -history["RF3 sum UPPER_ENDS"]
    # at the end of each drag the wire slips, at the limit: mu = 0.3 of the force, which presses nearly along z
    assert sliding[-1] / pressing[-1] == pytest.approx(-0.3, rel=1e-3)
    assert history["ALLFD"][-1] > 0


@pytest.mark.slow
def test_resistances_between_all_strands_of_the_triplet_follow_from_one_run(tmp_path):
    results = litz.run(litz.new("triplet", tmp_path / "deck.inp"), output_directory=tmp_path)
    found = results.interstrand_resistance()
    assert found.matrix[0, 1] == pytest.approx(results.history["resistance FIRST to SECOND"][-1], rel=1e-7)
    # the triplet is pressed alike on all sides
    np.testing.assert_allclose(found.table()["resistance"], found.matrix[0, 1], rtol=1e-3)
    jacket = results.rigid_surfaces["JACKET"].radius_at(results)
    length = results.wire_arcs.wire_length / 20e-3
    assert (length * 0.41e-3**2).sum() / jacket**2 == pytest.approx(0.65, rel=1e-6)


@pytest.mark.slow
def test_the_fuse_of_the_starter_melts_as_that_of_the_deck(inputs, tmp_path):
    assert command("new", "fuse", cwd=tmp_path).returncode == 0
    mine = litz.run(tmp_path / "fuse.inp", output_directory=tmp_path / "mine")
    deck = litz.run(inputs / "19_fuse.inp", output_directory=tmp_path / "deck")
    assert mine.history["NT node 11"] == pytest.approx(deck.history["NT node 11"], rel=1e-9)
    assert mine.history["NT node 11"][-1] > 1358


def test_a_file_is_never_replaced(tmp_path):
    (tmp_path / "grid.inp").write_text("mine")
    done = command("new", "grid", cwd=tmp_path)
    assert done.returncode == 4
    assert "exists already and is not overwritten" in done.stderr
    assert (tmp_path / "grid.inp").read_text() == "mine"


@pytest.mark.slow
def test_the_list_and_wrong_names(tmp_path):
    listed = command("new", "--list", cwd=tmp_path)
    assert [line.split()[0] for line in listed.stdout.splitlines()] == list(STARTERS)
    wrong = command("new", "crosed-wires", cwd=tmp_path)
    assert wrong.returncode == 1
    assert "did you mean 'crossed-wires'" in wrong.stderr
    assert command("new", cwd=tmp_path).returncode == 1
    assert not list(tmp_path.iterdir())
