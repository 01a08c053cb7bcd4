"""Rutherford cables: strands that are all the same curve, side by side on the faces, and do not overlap anywhere."""

import itertools
import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

import litz
from litz import build
from litz.build.geometry import smooth_axis
from litz.build.rutherford import OVERLAP

RADIUS = 0.4e-3
CABLES = {
    6: lambda **more: build.rutherford(6, radius=RADIUS, pitch=25e-3, length=25e-3, **more),
    8: lambda **more: build.rutherford(8, radius=RADIUS, pitch=-40e-3, length=40e-3, **more),
    11: lambda **more: build.rutherford(11, radius=RADIUS, pitch=50e-3, length=50e-3, **more),
    28: lambda **more: build.rutherford(28, radius=RADIUS, pitch=100e-3, length=30e-3, **more),
}
NICKEL = litz.Material("NICKEL", young=200e9, poisson=0.31, conductivity=1.4e7)


@pytest.fixture(scope="module", params=CABLES)
def cable(request):
    """Number of strands, and the model."""
    return request.param, CABLES[request.param]()


def strands_of(model):
    return [model.x[np.array(wire.nodes) - 1] for group in model.groups.values() for wire in group.wires]


def smooth_strands(model, parts):
    """Points of the axes between which the program interpolates, of each strand."""
    points = smooth_axis(model.x, model.connectivity, parts)
    wires = [wire for group in model.groups.values() for wire in group.wires]
    return [points[np.array(wire.elements) - 1].reshape(-1, 3) for wire in wires]


def test_strands_are_the_same_curve_one_after_the_other(cable):
    n, model = cable
    pitch = {6: 25e-3, 8: 40e-3, 11: 50e-3, 28: 100e-3}[n]
    first, second = smooth_strands(model, 20)[:2]
    # the second strand is where the first one is 1/n of the pitch further on
    z = np.linspace(0.1, 0.6, 400) * (first[-1, 2] - pitch / n)
    for axis in (0, 1):
        ahead = np.interp(z + pitch / n, first[:, 2], first[:, axis])
        # smooth axes between different nodes, to 1 % of the radius
        np.testing.assert_allclose(np.interp(z, second[:, 2], second[:, axis]), ahead, atol=0.015 * RADIUS)


def test_in_section_they_lie_on_two_lines_and_two_half_circles(cable):
    _, model = cable
    x, y = np.abs(model.x[:, 0]), np.abs(model.x[:, 1])
    layer = y.max()
    face = x.max() - layer
    assert 2 * RADIUS <= 2 * layer < 2.02 * RADIUS
    on_face = x <= face
    np.testing.assert_allclose(y[on_face], layer, rtol=1e-6)
    np.testing.assert_allclose(np.hypot(x[~on_face] - face, y[~on_face]), layer, rtol=1e-6)
    assert on_face.any()
    assert (~on_face).any()


def test_on_a_face_they_touch_side_by_side(cable):
    """At the distance d and the slope n d/pitch across the cable they are d/sqrt(1 + slope^2) apart."""
    n, model = cable
    pitch = {6: 25e-3, 8: 40e-3, 11: 50e-3, 28: 100e-3}[n]
    half = model.x[:, 2].max() / 2
    places = np.array([[np.interp(half, one[:, 2], one[:, axis]) for axis in (0, 1)] for one in strands_of(model)])
    layer = np.abs(model.x[:, 1]).max()
    # away from the edges by a strand
    upper = np.sort(
        places[(places[:, 1] > 0.999 * layer) & (np.abs(places[:, 0]) < np.abs(model.x[:, 0]).max() - 3 * RADIUS), 0]
    )
    distance = 2 * layer
    across = distance / math.sqrt(1 - (n * distance / pitch) ** 2)
    if len(upper) > 1:
        np.testing.assert_allclose(np.diff(upper), across, rtol=1e-3)
    assert np.abs(model.x[:, 0]).max() == pytest.approx(across * (n / 2 - 0.8) / 2 + layer, rel=1e-3)


@pytest.mark.slow
def test_no_strands_overlap(cable):
    """By points on the smooth axes, all against all."""
    _, model = cable
    strands = smooth_strands(model, 60)
    trees = [cKDTree(one) for one in strands]
    smallest = min(trees[i].query(strands[j])[0].min() for i, j in itertools.combinations(range(len(strands)), 2))
    # points that are 1.2 mm/60 apart do not lie opposite each other: s^2/(2 d) of 2 r
    assert smallest >= 2 * RADIUS * (1 - OVERLAP)
    assert smallest == pytest.approx(2 * RADIUS, rel=3e-3)


@pytest.mark.parametrize(("n", "hand"), [(6, 1), (8, -1)])
def test_a_positive_pitch_runs_to_positive_x_on_the_upper_face(n, hand):
    for one in strands_of(CABLES[n]()):
        middle = (one[:-1] + one[1:]) / 2
        slope = np.diff(one[:, 0]) / np.diff(one[:, 2])
        flat = np.abs(middle[:, 1]) > 0.999 * np.abs(one[:, 1]).max()
        assert (np.sign(slope[flat]) == hand * np.sign(middle[flat, 1])).all()


def test_strands_come_back_after_a_pitch():
    for one in strands_of(CABLES[6]()):
        np.testing.assert_allclose(one[-1, :2], one[0, :2], atol=1e-9)


def test_a_clearance_is_kept():
    model = CABLES[8](clearance=20e-6)
    assert build.smallest_gap(model, within=60e-6, parts=8) == pytest.approx(20e-6, abs=1.2 * OVERLAP * RADIUS)


def test_strands_of_copper_among_others():
    materials = [NICKEL, NICKEL, build.COPPER] * 2
    model = CABLES[6](material=materials)
    assert {name: len(group.wires) for name, group in model.groups.items()} == {
        "STRANDS_NICKEL": 4,
        "STRANDS_COPPER": 2,
    }
    plain = strands_of(CABLES[6]())
    order = [0, 1, 3, 4, 2, 5]
    for place, one in zip(order, strands_of(model), strict=True):
        np.testing.assert_array_equal(one, plain[place])
    assert sorted(model.element_sets["STRANDS"]) == sorted(model.element_sets["WIRES"])
    assert len(model.node_sets["MINUS"]) == 6


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"strands": 5}, "6 strands or more, not 5"),
        ({"pitch": 0.0}, "the pitch must not be 0"),
        ({"pitch": 4e-3}, "do not fit into the pitch of 0.004 m: it must be longer than 0.00"),
        ({"radius": -1.0}, "a positive radius"),
        ({"element_length": 0.0}, "element_length must be greater than 0"),
        ({"ends": "open"}, 'ends must be "clamped" or "sliding"'),
        ({"material": [NICKEL]}, "STRANDS has 8 strands that are laid together, and 1 materials"),
    ],
)
def test_wrong_arguments_are_answered_in_words(arguments, message):
    with pytest.raises(ValueError, match=message):
        build.rutherford(**{"strands": 8, "radius": RADIUS, "pitch": 40e-3, "length": 10e-3, **arguments})


class TestMaterialsOfACable:
    def test_a_copper_strand_in_each_triplet(self):
        model = build.cable(
            [[3], [3]],
            radius=RADIUS,
            lay_lengths=[20e-3, 40e-3],
            length=5e-3,
            material=[[NICKEL, NICKEL, build.COPPER]],
        )
        plain = build.cable([[3], [3]], radius=RADIUS, lay_lengths=[20e-3, 40e-3], length=5e-3)
        assert {name: len(group.wires) for name, group in model.groups.items()} == {
            "LAYER1_NICKEL": 6,
            "LAYER1_COPPER": 3,
        }
        of_strand = strands_of(plain)
        order = [0, 1, 3, 4, 6, 7, 2, 5, 8]
        for place, one in zip(order, strands_of(model), strict=True):
            np.testing.assert_array_equal(one, of_strand[place])
        copper = set(model.groups["LAYER1_COPPER"].elements)
        for number in (1, 2, 3):
            members = set(model.element_sets[f"BUNDLE{number}"])
            assert len(members & copper) * 3 == len(members)
        assert sorted(model.element_sets["LAYER1"]) == sorted(model.element_sets["WIRES"]) == sorted(model.groups)

    def test_layers_of_different_patterns(self):
        model = build.strand(
            [1, 6],
            radius=[0.42e-3, RADIUS],
            lay_length=30e-3,
            length=3e-3,
            material=[build.COPPER, [NICKEL, build.COPPER] * 3],
        )
        assert {name: len(group.wires) for name, group in model.groups.items()} == {
            "CORE": 1, "LAYER1_NICKEL": 3, "LAYER1_COPPER": 3,
        }  # fmt: skip

    def test_a_pattern_of_one_material_is_that_material(self):
        model = build.cable([[3]], radius=RADIUS, lay_lengths=[30e-3], length=3e-3, material=[[NICKEL] * 3])
        assert list(model.groups) == ["LAYER1"]

    def test_different_materials_need_different_names(self):
        other = litz.Material("NICKEL", young=190e9, poisson=0.31, conductivity=1.4e7)
        with pytest.raises(ValueError, match="LAYER1 has different materials of the same name"):
            build.cable(
                [[3]], radius=RADIUS, lay_lengths=[30e-3], length=3e-3, material=[[NICKEL, other, build.COPPER]]
            )
