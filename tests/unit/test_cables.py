"""Strands and cables: exact centre lines, layers that touch and do not overlap, and what is said where they do not fit."""

import itertools
import math
import re

import numpy as np
import pytest

from litz import build
from litz.build.cables import OVERLAP
from litz.build.geometry import segment_distance
from litz.build.helices import Lay, neighbour_distance, touching_radius, widest_angle
from litz.build.winding import StraightAxis, WoundAxis, points, tangents

#: The strand of W. S. Utting, N. Jones, Int. J. Mech. Sci. 29 (1987) 605-619: radii of core and outer wires
CORE, OUTER = 3.94e-3 / 2, 3.73e-3 / 2
MODELS = {
    "1+6": lambda: build.strand([1, 6], radius=[CORE, OUTER], lay_length=0.115, length=0.06),
    "1+6 at 17 degrees, enlarged": lambda: build.strand(
        [1, 6], radius=[CORE, OUTER], lay_angle=math.radians(17), length=0.06, enlarge=True
    ),
    "1+6+12 S Z": lambda: build.strand(
        [1, 6, 12], radius=[0.11e-3, 0.1e-3, 0.1e-3], lay_length=[6e-3, 9e-3], direction="SZ", length=5e-3, enlarge=True
    ),
    "1+6 with clearance": lambda: build.strand([1, 6], radius=[0.11e-3, 0.1e-3], lay_length=7e-3, length=5e-3, clearance=1e-5),
    "two twisted": lambda: build.strand([2], radius=0.5e-3, lay_length=20e-3, length=20e-3),
    "7 x 7": lambda: build.cable([[1, 6], [1, 6]], radius=0.1e-3, lay_lengths=[5e-3, -15e-3], length=5e-3),
    "3 x 3 x 3": lambda: build.cable([[3], [3], [3]], radius=0.41e-3, lay_lengths=[40e-3, 70e-3, 95e-3], length=30e-3),
}  # fmt: skip
KEPT_APART = {
    "1+6": lambda: build.strand([1, 6], radius=[CORE, OUTER], lay_length=0.115, length=0.06, clearance=OUTER / 50),
    "7 x 7": lambda: build.cable(
        [[1, 6], [1, 6]], radius=0.1e-3, lay_lengths=[5e-3, -15e-3], length=5e-3, clearance=2e-6
    ),
    "3 x 3": lambda: build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[40e-3, 70e-3], length=30e-3, clearance=8e-6),
}


def wires_of(model):
    """Nodal positions of each wire, and its radius."""
    return [
        (model.x[np.array(wire.nodes) - 1], group.radius) for group in model.groups.values() for wire in group.wires
    ]


def helix(radius, lay, phase, turns):
    """Points of a helix, written down anew."""
    angle = 2 * math.pi * turns
    return np.column_stack([radius * np.cos(angle + phase), radius * np.sin(angle + phase), lay * turns])


def brute_force_distance(first, second):
    """Smallest distance of two polygons, all pairs of their segments."""
    smallest = math.inf
    for rows in np.array_split(np.arange(len(first) - 1), max(1, len(first) * len(second) // 10**6)):
        a, c = (index.ravel() for index in np.meshgrid(rows, np.arange(len(second) - 1)))
        smallest = min(smallest, segment_distance(first[a], first[a + 1], second[c], second[c + 1]).min())
    return smallest


@pytest.mark.parametrize(
    ("count", "radius", "lay"), [(6, 3.8, 60.0), (6, 3.8, 9.0), (2, 1.0, 30.0), (2, 1.0, 2.0), (3, 1.2, 8.0)]
)
def test_neighbours_are_as_near_as_a_fine_polygon_says(count, radius, lay):
    turns = np.linspace(0, 1, 6001)
    one = helix(radius, lay, 0.0, np.linspace(0, 0.01, 61))
    others = [helix(radius, lay, 2 * math.pi * k / count, turns - 0.5) for k in range(1, count)]
    # another turn of the same helix
    others.append(helix(radius, lay, 0.0, np.linspace(0.6, 1.4, 4801)))
    found = min(brute_force_distance(one, other) for other in others)
    # chords of 6000 a turn: (2 pi/6000)^2/8 = 1.4e-7 of the radius
    assert neighbour_distance(count, radius, lay) == pytest.approx(found, rel=1e-6)


def test_straight_neighbours_have_the_distance_of_a_polygon():
    # as the lay grows the distance goes to 2 R sin(pi/n), with the square of the lay angle
    assert neighbour_distance(6, 1.0, 1e6) == pytest.approx(1.0, rel=1e-9)
    assert neighbour_distance(2, 1.0, 1e6) == 2.0
    assert neighbour_distance(1, 1.0, 1e6) == math.inf


@pytest.mark.parametrize("lay", [Lay(length=0.1), Lay(angle=math.radians(17))])
def test_a_layer_of_the_touching_radius_just_touches(lay):
    radius = touching_radius(6, OUTER, lay, 0.0)
    assert neighbour_distance(6, radius, lay.length_at(radius)) == pytest.approx(2 * OUTER, rel=1e-12)


def test_wires_at_17_degrees_overlap_and_the_message_says_what_fits():
    with pytest.raises(ValueError, match="would overlap each other") as refused:
        build.strand([1, 6], radius=[CORE, OUTER], lay_angle=math.radians(17), length=0.1)
    message = str(refused.value)
    overlap, percent, angle, length, core, off = (
        float(re.search(pattern, message).group(1))
        for pattern in (
            r"by ([-\d.e]+) m", r"is ([\d.]+) %", r"at ([\d.]+) degrees or less", r"lay length ([-\d.e]+) m or more",
            r"radius ([-\d.e]+) m or more", r"it ([-\d.e]+) m off",
        )
    )  # fmt: skip
    at = CORE + OUTER

    def nearest(radius, lay):
        turns = np.linspace(-0.1, 0.1, 4001)
        return brute_force_distance(
            helix(radius, lay, 0.0, np.linspace(0, 0.001, 21)), helix(radius, lay, math.pi / 3, turns)
        )

    def lay_of(radius, degrees):
        return 2 * math.pi * radius / math.tan(math.radians(degrees))

    # three to five digits are printed
    assert overlap == pytest.approx(2 * OUTER - nearest(at, lay_of(at, 17)), rel=5e-3)
    assert percent == pytest.approx(100 * overlap / OUTER, abs=0.05)
    assert nearest(at, lay_of(at, angle)) == pytest.approx(2 * OUTER, rel=1e-4)
    assert length == pytest.approx(lay_of(at, angle), rel=1e-3)
    assert nearest(core + OUTER, lay_of(core + OUTER, 17)) == pytest.approx(2 * OUTER, rel=1e-4)
    assert off == pytest.approx(core - CORE, rel=5e-3)
    # sections taken as ellipses of the axes r and r/cos(beta), G. A. Costello, Theory of Wire Rope (1990): wires touch at
    # the layer radius r sqrt(1 + 3/cos(beta)^2), nearly
    ellipses = OUTER * math.sqrt(1 + 3 / math.cos(math.radians(17)) ** 2)
    assert off == pytest.approx(ellipses - at, rel=0.15)


def test_what_the_message_proposes_is_accepted():
    angle = widest_angle(6, CORE + OUTER, 2 * OUTER)
    build.strand([1, 6], radius=[CORE, OUTER], lay_angle=0.9999 * angle, length=0.02)
    with pytest.raises(ValueError, match="would overlap"):
        build.strand([1, 6], radius=[CORE, OUTER], lay_angle=1.0001 * angle, length=0.02)
    free = touching_radius(6, OUTER, Lay(angle=math.radians(17)), 0.0)
    build.strand([1, 6], radius=[1.0001 * free - OUTER, OUTER], lay_angle=math.radians(17), length=0.02)


def test_no_angle_fits_wires_that_overlap_even_when_straight():
    assert widest_angle(6, 1.0, 1.01) is None
    with pytest.raises(ValueError, match="Either make what is inside larger"):
        build.strand([1, 6], radius=[0.9e-3, 1e-3], lay_length=0.1, length=0.1)


def test_an_enlarged_layer_is_told():
    model = MODELS["1+6 at 17 degrees, enlarged"]()
    assert any("layer 1: its members touch each other" in line for line in model.comments)
    assert not MODELS["1+6"]().comments


@pytest.mark.parametrize("hand", ["S", "Z"])
def test_the_nodes_of_a_strand_lie_on_helices(hand):
    model = build.strand([1, 6], radius=[CORE, OUTER], lay_length=0.115, direction=hand, length=0.115)
    (core, _), *outer = wires_of(model)
    assert np.abs(core[:, :2]).max() == 0
    turn = 2 * math.pi * core[:, 2] / 0.115 * (1 if hand == "Z" else -1)
    for number, (x, _) in enumerate(outer):
        angle = turn + number * math.pi / 3
        exact = np.column_stack([np.cos(angle), np.sin(angle)]) * (CORE + OUTER)
        # seven digits of the wire radius
        np.testing.assert_allclose(x[:, :2], exact, atol=1e-6 * OUTER)


def test_a_lay_angle_is_that_of_the_centre_lines():
    model = build.strand([1, 6], radius=[CORE, OUTER], lay_angle=math.radians(11), length=0.1, elements_per_lay=400)
    for x, _ in wires_of(model)[1:]:
        along = (x[2:] - x[:-2]) / np.linalg.norm(x[2:] - x[:-2], axis=1)[:, None]
        # differences of second order over a turn of 2 pi/400: (2 pi/400)^2/6 = 4e-5
        assert np.arccos(along[:, 2]) == pytest.approx(math.radians(11), rel=1e-4)


def test_letters_give_the_hand_of_each_layer_and_are_repeated():
    model = build.strand(
        [1, 6, 12, 18], radius=[0.12e-3] + 3 * [0.1e-3], lay_length=9e-3, direction="sz", length=2e-3, enlarge=True
    )
    turns = []
    for name in ("LAYER1", "LAYER2", "LAYER3"):
        x = model.x[np.array(model.groups[name].wires[0].nodes) - 1]
        turns.append(np.unwrap(np.arctan2(x[:, 1], x[:, 0]))[-1])
    assert turns == pytest.approx([-4 * math.pi / 9, 4 * math.pi / 9, -4 * math.pi / 9])


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_wires_of_strands_and_cables_do_not_overlap_and_some_touch(name):
    """Brute force over all pairs of neighbouring wires, as fine polygons."""
    wires = wires_of(MODELS[name]())
    gaps = []
    for (x, r), (y, s) in itertools.combinations(wires, 2):
        if np.linalg.norm(x - y, axis=1).min() < 1.5 * (r + s):
            gaps.append(brute_force_distance(fine(x), fine(y)) - r - s)
    clearance = 1e-5 if "clearance" in name else 0.0
    radius = min(r for _, r in wires)
    # what the generator allows, and the sagitta of the polygons, below 1e-4
    assert min(gaps) > clearance - (OVERLAP + 1e-4) * radius
    assert min(gaps) < clearance + 1e-2 * radius


def fine(x, count=10):
    """A curve through the nodes, with `count` points to each element: a polynomial through the six nearest nodes."""
    parts = np.arange(count * (len(x) - 1) + 1) / count
    first = np.clip(parts.astype(int) - 2, 0, len(x) - 6)
    curve = np.zeros((len(parts), 3))
    for i in range(6):
        weight = np.ones(len(parts))
        for j in set(range(6)) - {i}:
            weight *= (parts - first - j) / (i - j)
        curve += weight[:, None] * x[first + i]
    return curve


def test_the_outer_wires_of_a_strand_lie_on_the_core_and_not_on_each_other():
    (core, r), *outer = wires_of(MODELS["1+6"]())
    for x, s in outer:
        # sagitta of 30 chords to an element of 4 mm: 1e-5 of the radius
        assert brute_force_distance(fine(core), fine(x, 30)) - r - s == pytest.approx(0, abs=2e-5 * OUTER)
    assert brute_force_distance(fine(outer[0][0]), fine(outer[1][0])) > 2 * OUTER * 1.005


def test_a_wound_axis_keeps_its_distance_in_the_planes_normal_to_its_core():
    core = WoundAxis(WoundAxis(StraightAxis(3.0), 0.3, 2.5, 0.4), 0.12, -1.1, 1.0)
    wire = WoundAxis(core, 0.05, 0.6, 2.0)
    z = np.linspace(0, 3, 40)
    offset = points(wire, z) - points(core, z)
    assert np.linalg.norm(offset, axis=1) == pytest.approx(0.05, rel=1e-12)
    assert np.abs(np.sum(offset * tangents(core, z), axis=1)).max() < 1e-13
    # one turn on each lay length along the core, against the direction of x in the normal plane
    across = np.array([1.0, 0, 0]) - tangents(core, z)[:, :1] * tangents(core, z)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    ahead = np.cross(tangents(core, z), across)
    angle = np.unwrap(np.arctan2(np.sum(offset * ahead, axis=1), np.sum(offset * across, axis=1)))
    assert angle - angle[0] == pytest.approx(2 * math.pi * arc_by_chords(core, z) / 0.6, abs=1e-5)


def arc_by_chords(curve, z):
    """Arc lengths from z[0], by chords extrapolated to none."""

    def chords(parts):
        fine_z = np.linspace(z[0], z[-1], parts * (len(z) - 1) + 1)
        steps = np.linalg.norm(np.diff(points(curve, fine_z), axis=0), axis=1)
        return np.concatenate([[0], np.cumsum(steps)])[::parts]

    return (4 * chords(80) - chords(40)) / 3


def test_tangents_are_the_derivatives_of_the_points():
    curve = WoundAxis(WoundAxis(WoundAxis(StraightAxis(2.0), 0.1, 2.5, 0.4), 0.05, -1.5, 1.0), 0.02, 0.8, 2.0)
    z, h = np.linspace(0.1, 1.9, 30), 1e-3
    ahead = [points(curve, z + k * h) for k in (-2, -1, 1, 2)]
    rate = (ahead[0] - 8 * ahead[1] + 8 * ahead[2] - ahead[3]) / (12 * h)
    rate /= np.linalg.norm(rate, axis=1, keepdims=True)
    # differences of fourth order: (2 pi/0.8 * 1e-3)^4/30 = 1e-10
    np.testing.assert_allclose(tangents(curve, z), rate, atol=1e-9)


def test_a_cable_has_its_bundles_and_their_ends():
    model = MODELS["3 x 3 x 3"]()
    assert len(model.groups["LAYER1"].wires) == 27
    wires = {wire.nodes[0]: wire for wire in model.groups["LAYER1"].wires}
    for number in (1, 2, 3):
        starts, ends = (model.node_sets[f"BUNDLE{number}_{side}"] for side in ("MINUS", "PLUS"))
        assert [wires[start].nodes[-1] for start in starts] == list(ends)
        assert sorted(model.element_sets[f"BUNDLE{number}"]) == sorted(
            element for start in starts for element in wires[start].elements
        )
        middle = model.x[np.array(starts) - 1].mean(axis=0)
        # nine wires about the axis of a bundle, at 0, 120 and 240 degrees
        turned = math.degrees(math.atan2(middle[1], middle[0])) - 120 * (number - 1)
        assert (turned + 180) % 360 - 180 == pytest.approx(0, abs=0.1)
    assert set(model.node_sets["MINUS"]) == {wire.nodes[0] for wire in wires.values()}


def test_bundles_within_bundles_have_names():
    """2 x (1+2) x (1+2): wires of the core and of the layer, bundles in the middle and about it."""
    model = build.cable([[1, 2], [1, 2], [2]], radius=0.1e-3, lay_lengths=[8e-3, 15e-3, 40e-3], length=1e-3)
    x = {node: model.x[node - 1, :2] for node in model.node_sets["MINUS"]}
    for outer in (1, 2):
        ends = [model.node_sets[f"BUNDLE{outer}_{inner}_MINUS"] for inner in (1, 2, 3)]
        assert sorted(np.concatenate(ends)) == sorted(model.node_sets[f"BUNDLE{outer}_MINUS"])
        assert len(model.element_sets[f"BUNDLE{outer}_1"]) * 3 == len(model.element_sets[f"BUNDLE{outer}"])
        for members in ends:
            # a core and two wires on either side of it
            place = np.array([x[node] for node in members])
            assert np.linalg.norm(place[1:].mean(axis=0) - place[0]) < 0.01e-3
            assert np.linalg.norm(place[1:] - place[0], axis=1) == pytest.approx([0.2e-3] * 2, rel=0.05)
    assert not any(name.count("_") > 1 for name in model.element_sets)


def test_a_rope_of_unlike_wires_has_a_group_for_each():
    model = build.cable(
        [[1, 6], [1, 6]], radius=[0.12e-3, 0.1e-3], lay_lengths=[5e-3, 15e-3], length=2e-3, material=[build.STEEL, build.COPPER]
    )  # fmt: skip
    core, outer = model.groups["CORE"], model.groups["LAYER1"]
    assert (len(core.wires), core.radius, core.material) == (7, 0.12e-3, build.STEEL)
    assert (len(outer.wires), outer.radius, outer.material) == (42, 0.1e-3, build.COPPER)


@pytest.mark.slow
def test_wires_of_a_coarse_rope_have_room_where_the_program_sees_corners(litz, tmp_path):
    """Elements that bend by more than 20 degrees: their axes have corners, and the wires more room."""
    model = build.cable(
        [[1, 6], [1, 6]], radius=0.1e-3, lay_lengths=[-4e-3, 10e-3], length=5e-3, elements_per_lay=8, clearance=2e-6
    )
    model.press(1e-9, voltage=1e-3)
    done = litz("check", model.write(tmp_path / "rope.inp"))
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", KEPT_APART)
def test_the_program_accepts_strands_and_cables(name, litz, tmp_path):
    model = KEPT_APART[name]()
    model.press(1e-9, voltage=1e-3)
    done = litz("check", model.write(tmp_path / "model.inp"))
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"lay_length": [1e-2, 1e-2]}, "1 layer needs one lay length; given are 2"),
        ({"lay_length": 0.0}, "lay length other than 0"),
        ({"lay_length": None}, "either lay_length or lay_angle"),
        ({"lay_length": None, "lay_angle": 2.0}, "below pi/2"),
        ({"lay_length": -1e-2, "direction": "S"}, "letters S"),
        ({"direction": "R"}, "letters S"),
        ({"radius": [1e-4, 1e-4, 1e-4]}, "2 layers need one radius for all or 2"),
        ({"radius": [1e-4, 0.0]}, "positive radius"),
        ({"clearance": -1e-6}, "clearance"),
        ({"element_length": 1e-4, "elements_per_lay": 16}, "either element_length or elements_per_lay"),
        ({"element_length": 0.0}, "element_length must be greater"),
        ({"elements_per_lay": 3}, "elements_per_lay must be 4"),
        ({"layers": [1]}, "at least one layer around a core"),
        ({"layers": [1, 0]}, "at least one member"),
        ({"layers": [1, 1], "lay_length": 1e-4}, "the turns of layer 1 would overlap"),
        ({"layers": [12], "lay_length": 1e-4}, "do not fit side by side"),
    ],
)
def test_a_strand_that_cannot_be_built_is_refused(changed, message):
    arguments = {"layers": [1, 6], "radius": [1.1e-4, 1e-4], "lay_length": 1e-2, "length": 1e-2} | changed
    if changed.get("layers", [1, 6]) != [1, 6]:
        arguments["radius"] = 1e-4
    if changed.get("layers") == [1]:
        arguments["lay_length"] = []
    with pytest.raises(ValueError, match=message):
        build.strand(**arguments)


def test_a_cable_needs_a_lay_length_for_each_stage():
    with pytest.raises(ValueError, match="for each of the 2 stages"):
        build.cable([[3], [3]], radius=1e-4, lay_lengths=[1e-2], length=1e-2)
