"""Sticks that lead across a square, wires that lead across a film."""

import math

import numpy as np
import pytest

import litz
from litz import percolation
from litz.build.planar import find_crossings


def test_a_path_of_three_sticks():
    # the first reaches the left side, the second the right one, the third crosses both
    ends = np.array([[[0.0, 1.0], [0.9, 1.0]], [[1.1, 1.2], [2.0, 1.2]], [[0.5, 0.9], [1.5, 1.3]]])
    found = find_crossings(ends, 1e-9)
    found = found.where(found.crosses)
    assert percolation._path(ends, found, 2.0, 0.0, stacked=False) == 3
    assert percolation._path(ends[:2], find_crossings(ends[:2], 1e-9), 2.0, 0.0, stacked=False) == 0
    # they cross at 22 degrees: the third would have been drawn anew
    assert percolation._path(ends, found, 2.0, math.sin(math.radians(25)), stacked=False) == 0


def test_a_stacked_stick_touches_the_highest_it_crosses_only():
    # the second lies on the first, the third on the second, above the first
    ends = np.array([[[0.0, 1.0], [1.2, 1.0]], [[0.4, 0.5], [0.4, 1.5]], [[0.2, 0.8], [2.0, 1.2]]])
    found = find_crossings(ends, 1e-9)
    found = found.where(found.crosses)
    assert len(found.wires) == 3
    assert percolation._path(ends, found, 2.0, 0.0, stacked=True) == 3
    without_second = found.where(~(found.wires == 1).any(axis=1))
    assert percolation._path(ends, without_second, 2.0, 0.0, stacked=False) == 3


def test_threshold_of_sticks():
    found = percolation.threshold(30, ratio=6.0)
    # small squares: 30 of them scatter by 3 %, and their size shifts the median by less
    assert found.density == pytest.approx(percolation.STICKS, abs=4 * found.error)
    assert len(found.densities) == 30
    again = percolation.threshold(range(30), ratio=6.0)
    np.testing.assert_array_equal(found.densities, again.densities)
    # more sticks are needed where each touches only the highest of those it crosses
    assert percolation.threshold(4, ratio=4.0, stacked=True).density > 1.3 * percolation.STICKS


def test_whether_a_run_conducts(tmp_path):
    def model(conductance):
        made = litz.Model("crossed")
        wire = {"radius": 1e-3, "material": litz.COPPER, "elements": 5}
        lower = made.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), **wire)
        upper = made.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), **wire)
        made.contact(lower, upper, conductance=conductance)
        made.fix(lower)
        made.fix(upper, "x", "y", "rotations")
        made.node_set("MINUS", lower.start)
        made.node_set("PLUS", upper.start)
        step = made.step()
        step.move(upper, "z", -1e-6)
        step.potential("PLUS", 1e-3)
        step.potential("MINUS", 0)
        return made

    assert percolation.spans(model(litz.HertzSpot()).run(tmp_path / "spot"))
    assert not percolation.spans(model(None).run(tmp_path / "none"))
    with pytest.raises(KeyError, match="no node set 'TOP'"):
        percolation.spans(tmp_path / "spot", plus="TOP")


@pytest.mark.parametrize(
    ("seeds", "options", "message"),
    [
        (1, {}, "two squares"),
        (4, {"ratio": 0.5}, "ratio must be 1 or more"),
        (4, {"smallest_angle": 1.6}, "less than a right angle"),
        (4, {"smallest_angle": -0.1}, "at least 0"),
    ],
)
def test_arguments_that_make_no_sense(seeds, options, message):
    with pytest.raises(ValueError, match=message):
        percolation.threshold(seeds, **options)
