"""Pictures of wires whose sections are not round: the outline swept along the axis, turning with the nodes."""

import numpy as np
import pytest

import litz
from litz.pictures.prisms import Frames, prism, triangles_of
from litz.pictures.scene import SceneMaker

RECT = "RECT\n 4e-3, 2e-3"
BOX = "BOX\n 4e-3, 2e-3, 2e-4, 2e-4, 2e-4, 2e-4"
I_BEAM = "I\n 3e-3, 6e-3, 4e-3, 4e-3, 1e-3, 1e-3, 1e-3"
ANGLE = "L\n 6e-3, 4e-3, 1e-3, 1e-3"
HALF_I = [(2, -3), (2, -2), (0.5, -2), (0.5, 2), (2, 2), (2, 3)]
OUTLINES = {
    RECT: [(2, 1), (-2, 1), (-2, -1), (2, -1)],
    BOX: [(2, 1), (-2, 1), (-2, -1), (2, -1)],
    I_BEAM: [*HALF_I, *((-x, -y) for x, y in HALF_I)],
    # the mean lines of the legs meet at the node
    ANGLE: [(-0.5, -0.5), (5.5, -0.5), (5.5, 0.5), (0.5, 0.5), (0.5, 3.5), (-0.5, 3.5)],
}


def cantilever(section, load="2, 3, 1e-9", first_axis="\n 0, 1, 0", more=""):
    """A wire of two elements along x, whose first section axis is along y."""
    return (
        "*NODE, NSET=N\n 1, 0, 0, 0\n 2, 0.05, 0, 0\n 3, 0.1, 0, 0\n*ELEMENT, TYPE=B33, ELSET=WIRE\n 1, 1, 2\n 2, 2, 3\n"
        f"{more}*MATERIAL, NAME=M\n*ELASTIC\n 2e11, 0.3\n*BEAM SECTION, ELSET=WIRE, MATERIAL=M, SECTION={section}{first_axis}\n"
        f"*BOUNDARY\n 1, ENCASTRE\n*STEP\n*STATIC\n*CLOAD\n {load}\n*END STEP\n"
    )


@pytest.mark.parametrize("section", OUTLINES, ids=["rectangle", "box", "I", "L"])
def test_the_outline_is_that_of_the_deck_in_the_plane_of_the_section_axes(run, section):
    _, results = run(cantilever(section))
    (frames,) = SceneMaker(results, [-1]).scene(-1).frames.values()
    expected = 1e-3 * np.array(OUTLINES[section])
    shown = {tuple(corner) for corner in frames.outline.round(9)}
    assert shown == {tuple(corner) for corner in expected.round(9)}
    np.testing.assert_allclose(frames.first, np.tile([0, 1, 0], (len(frames.first), 1)), atol=1e-6)
    points = np.array([[0, 0, 0], [0.05, 0, 0], [0.1, 0, 0]])
    mesh = prism(points, Frames(frames.outline, np.tile([0.0, 1.0, 0.0], (3, 1)), 1), 0.0)
    # along x, the first axis along y: the second one is along z
    for x in (0.0, 0.05, 0.1):
        at = mesh.points[np.isclose(mesh.points[:, 0], x)]
        assert {tuple(corner) for corner in at[:, 1:].round(9)} == shown


def test_elements_against_the_wire_have_the_same_outline(run):
    _, results = run(cantilever(ANGLE))
    _, turned = run(cantilever(ANGLE).replace("2, 2, 3\n", "2, 3, 2\n"), name="turned")
    frames = SceneMaker(results, [-1]).scene(-1).frames
    assert len(frames) == 1
    there = SceneMaker(turned, [-1]).scene(-1)
    assert sorted(one.sign for one in there.frames.values()) == [-1, 1]
    (line,) = [number for number, one in there.frames.items() if one.sign < 0]
    points = there.points[there.starts[line] : there.starts[line + 1]]
    mesh = prism(points, there.frames[line], 0.0)
    # the element runs from x = 0.1 back: its second axis is against z
    expected = 1e-3 * np.array(OUTLINES[ANGLE]) * [1, -1]
    at_end = mesh.points[np.isclose(mesh.points[:, 0], 0.1, atol=1e-8)]
    assert {tuple(corner) for corner in at_end[:, 1:].round(6)} == {tuple(corner) for corner in expected.round(6)}


def test_it_turns_with_the_nodes(run):
    """Twisted by a moment about its axis, the section at the end has turned by the rotation of the node."""
    _, results = run(cantilever(RECT, load="3, 4, 1.0"))
    angle = results.field("rotation")[2, 0]
    assert angle > 0.05
    (frames,) = SceneMaker(results, [-1]).scene(-1).frames.values()
    np.testing.assert_allclose(frames.first[-1], [0, np.cos(angle), np.sin(angle)], atol=1e-9)
    np.testing.assert_allclose(frames.first[0], [0, 1, 0], atol=1e-9)


@pytest.mark.parametrize("section", OUTLINES, ids=["rectangle", "box", "I", "L"])
def test_ends_are_filled_and_nothing_beside_them(section):
    outline = np.array(OUTLINES[section], dtype=float)
    corners = outline[triangles_of(outline)]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    x, y = outline.T
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


def test_normals_point_away_from_the_axis_and_have_length_one():
    points = np.stack([np.linspace(0, 1, 5), np.zeros(5), np.zeros(5)], axis=1)
    outline = np.array(OUTLINES[RECT], dtype=float)
    mesh = prism(points, Frames(outline, np.tile([0.0, 1.0, 0.0], (5, 1)), 1), 0.0)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0)
    assert (np.sum(mesh.normals * (mesh.points - [0.5, 0, 0]), axis=1) > 0).all()
    # closed: each edge belongs to two triangles, corners at the same place being one
    _, same = np.unique(mesh.points.round(9), axis=0, return_inverse=True)
    rows = same.ravel()[mesh.triangles]
    edges = np.sort(np.concatenate([rows[:, [0, 1]], rows[:, [1, 2]], rows[:, [2, 0]]]), axis=1)
    assert set(np.unique(edges, axis=0, return_counts=True)[1]) == {2}


def test_round_wires_stay_tubes(run_of_input, run):
    assert SceneMaker(litz.Results(run_of_input("01_crossed_wires")), [-1]).scene(-1).frames == {}
    _, results = run(cantilever("PIPE\n 1e-3, 2e-4"))
    assert SceneMaker(results, [-1]).scene(-1).frames == {}


def test_a_wire_of_several_sections_is_divided_where_they_change(run):
    deck = cantilever(RECT).replace("*MATERIAL", "*ELSET, ELSET=FIRST\n 1\n*ELSET, ELSET=SECOND\n 2\n*MATERIAL", 1)
    deck = deck.replace("ELSET=WIRE, MATERIAL=M", "ELSET=FIRST, MATERIAL=M")
    deck = deck.replace("*BOUNDARY", "*BEAM SECTION, ELSET=SECOND, MATERIAL=M, SECTION=CIRC\n 1e-3\n*BOUNDARY")
    _, results = run(deck)
    scene = SceneMaker(results, [-1]).scene(-1)
    assert list(scene.frames) == [0]
    assert len(scene.starts) == 3
    np.testing.assert_allclose(scene.points[scene.starts[1]], [0.05, 0, 0], atol=1e-6)


def test_a_picture_says_that_sections_that_are_not_round_touch_as_round_ones(run):
    more = (
        "*NODE\n 11, 0.075, -0.05, 1.999e-3\n 12, 0.075, 0.05, 1.999e-3\n*ELEMENT, TYPE=B33, ELSET=OTHER\n 11, 11, 12\n"
        "*SURFACE INTERACTION, NAME=C\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 1e4\n"
        "*CONTACT PAIR, INTERACTION=C\n WIRE, OTHER\n"
    )
    deck = cantilever("RECT, CONTACT RADIUS=1e-3\n 4e-3, 2e-3", more=more)
    section = "*BEAM SECTION, ELSET=OTHER, MATERIAL=M, SECTION=CIRC\n 1e-3\n*BOUNDARY\n 11, ENCASTRE\n 12, ENCASTRE\n"
    deck = deck.replace("*BOUNDARY\n", section, 1)
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert results.contacts.n_rows
    assert SceneMaker(results, [-1]).scene(-1).shape_text == "wires touch as round ones"
