"""No pair of wires passes through each other or overlaps without a contact, in the decks of inputs and in mats: the audit, done
once more by the judge of tests/property, which tries everything; random decks are there."""

import sys
from pathlib import Path

import pytest

from litz import build

sys.path.insert(0, str(Path(__file__).parents[1] / "property"))
from wire_judge import judge, read


def assert_no_passages(path):
    motion = read(path)
    assert len(motion.labels) > 1
    assert [str(finding) for finding in judge(motion) if not finding.doubt] == []


@pytest.mark.parametrize("seed", [1])
def test_no_fibres_of_a_pressed_mat_pass_through_each_other(litz, tmp_path, seed):
    mat = build.fibre_mat((10e-3, 10e-3), 5, radius=0.1e-3, seed=seed, n_layers=3, clearance=5e-6, n_elements=8)
    mat.press(40e-6, voltage=1e-3)
    deck = mat.write(tmp_path / "mat.inp")
    done = litz("run", deck, "-o", tmp_path / "out", "--quiet", timeout=300)
    assert done.returncode in (0, 2), done.stderr
    assert_no_passages(tmp_path / "out" / "mat.vtkhdf")


@pytest.mark.parametrize(
    "name",
    ["01_crossed_wires", "03_large_sliding", "04_wire_grid", "10_pushed_cantilever", "13_stick_slip", "17_knot"],
)
def test_no_wires_of_the_inputs_pass_through_each_other(run_of_input, name):
    assert_no_passages(run_of_input(name) / f"{name}.vtkhdf")
