"""Wires dropped on each other: where they may lie, how they bend, whether they touch and never overlap."""

import math

import numpy as np
import pytest

from litz import build
from litz.build.deposition import Rules, drop
from litz.build.draping import Below, Pile
from litz.build.geometry import smallest_gap
from litz.build.piled_axes import along, curve
from litz.build.planar import find_crossings, move_ends
from litz.wires.chains import Wire
from litz.wires.curves import end_tangents

RADIUS = 30e-9


def film(**options):
    given = {"size": (8e-6, 6e-6), "n_wires": 25, "length": 6e-6, "radius": RADIUS, "seed": 2, **options}
    return build.nanowire_film(**given)


def mat(seed=1, **options):
    given = {"size": (1e-3, 1e-3), "n_fibres": 25, "radius": 10e-6, "length": 1e-3, **options}
    return build.fibre_mat(seed=seed, orientation="deposited", **given)


def crossings_by_hand(ends):
    """Pairs that cross, each with each."""
    found = set()
    for j in range(len(ends)):
        for i in range(j):
            (a, b), (c, d) = ends[i], ends[j]
            matrix = np.column_stack([b - a, c - d])
            s, t = np.linalg.solve(matrix, c - a)
            if 0 < s < 1 and 0 < t < 1:
                found.add((i, j))
    return found


def test_crossings_are_those_of_all_pairs():
    ends = np.random.default_rng(1).uniform(size=(60, 2, 2))
    found = find_crossings(ends, 1e-6)
    found = found.where(found.crosses)
    assert set(map(tuple, found.wires.tolist())) == crossings_by_hand(ends)
    for (i, j), (s, t) in zip(found.wires, found.at, strict=True):
        np.testing.assert_allclose(
            ends[i, 0] + s * np.diff(ends[i], axis=0)[0], ends[j, 0] + t * np.diff(ends[j], axis=0)[0]
        )


def test_an_end_on_another_wire_moves_to_the_nearest_free_place():
    # the second wire ends 0.01 beyond the first one, which it crosses at a right angle: 0.04 is asked for
    ends = np.array([[[-1.0, 0.0], [1.0, 0.0]], [[0.2, -1.0], [0.2, 0.01]], [[0.6, 1.0], [0.6, 0.03]]])
    free = np.zeros((3, 2), dtype=bool)
    moved = move_ends(ends + 2, free, np.array([4.0, 4.0]), margin=0.04, reach=0.2, shortest=0.1) - 2
    np.testing.assert_allclose(moved[1], [[0.2, -1.0], [0.2, 0.04]], atol=1e-8)
    # the third does not reach the first one, and does not afterwards
    np.testing.assert_allclose(moved[2], [[0.6, 1.0], [0.6, 0.04]], atol=1e-8)
    np.testing.assert_array_equal(moved[0], ends[0])
    held = np.ones((3, 2), dtype=bool)
    np.testing.assert_array_equal(
        move_ends(ends + 2, held, np.array([4.0, 4.0]), margin=0.04, reach=0.2, shortest=0.1), ends + 2
    )


def test_dropped_wires_keep_the_rules():
    rules = Rules(np.array([8.0, 6.0]), 4.0, 0.02, math.radians(15), 0.08)
    layout = drop(np.random.default_rng(3), 80, rules)
    assert len(layout.ends) == 80
    found = find_crossings(layout.ends, rules.margin)
    assert found.end_distance.min() >= rules.margin * (1 - 1e-6)
    assert np.abs(found.sine[found.crosses]).min() >= math.sin(rules.smallest_angle)
    # only ends at the electrodes or moved ones differ from the length that was asked for
    assert np.linalg.norm(np.diff(layout.ends, axis=1), axis=2).max() < 1.2 * rules.length


def over_one_wire(reach, n_elements=80, length=4.0, distance=0.1):
    """Heights of a wire whose middle lies on a level one."""
    pile = Pile(distance, reach)
    nothing = Below(*(np.zeros(0, dtype=int if k == 0 else float) for k in range(5)))
    assert pile.lay(1.0, 4, nothing)
    assert pile.lay(
        length, n_elements, Below(np.array([0]), np.array([0.5]), np.array([0.5]), np.array([0.0]), np.array([1.0]))
    )
    return pile


def test_a_wire_over_another_is_the_beam_on_springs():
    # Winkler (1867): under a force, w = d exp(-s/a) (cos(s/a) + sin(s/a)) on a long beam; differences of second order
    reach = 0.25
    heights = over_one_wire(reach).heights[1]
    s = np.abs(np.linspace(-2, 2, 81)) / reach
    np.testing.assert_allclose(heights, 0.1 * np.exp(-s) * (np.cos(s) + np.sin(s)), atol=0.1 * 0.02)
    assert heights[40] == pytest.approx(0.1, rel=1e-4)


def test_level_wires_lie_on_the_highest_they_cross():
    pile = over_one_wire(None)
    assert np.ptp(pile.heights[1]) == 0
    assert pile.heights[1][0] == pytest.approx(0.1)
    assert (pile.n_crossings, pile.n_touching) == (1, 1)


def test_shorter_reach_lets_more_crossings_touch():
    def share(**options):
        touching, _, number, *_ = film(**options).comments[-1].split()
        return int(touching) / int(number)

    level, stiff, soft = share(), share(reach=40 * RADIUS), share(reach=12 * RADIUS)
    assert level < stiff < soft
    assert soft > 0.8


def test_fibres_that_fall_on_each_other_fill_densely():
    # fibres cover a third of the mat and more, one above the other
    model = mat(n_fibres=16, size=(0.7e-3, 0.7e-3))
    assert len(model.groups["FIBRES"].wires) == 16
    lengths = [np.linalg.norm(model.x[w.nodes[-1] - 1] - model.x[w.nodes[0] - 1]) for w in model.groups["FIBRES"].wires]
    assert sum(lengths) * 20e-6 > 0.3 * 0.7e-3**2
    assert model.height > 3 * 20e-6


@pytest.mark.parametrize("n_elements", [1, 2, 9])
def test_axes_of_a_pile_are_those_of_the_model(n_elements):
    # uneven heights, with kinks between elements
    heights = np.random.default_rng(4).uniform(0, 0.4, n_elements + 1)
    x = np.column_stack([np.arange(n_elements + 1.0), 0 * heights, heights])
    number = np.arange(n_elements)
    tangents = end_tangents(x, [Wire(np.arange(n_elements + 1), number, np.ones(n_elements))])
    slopes = tangents * np.linalg.norm(np.diff(x, axis=0), axis=1)[:, None, None] / 2
    elements = curve(float(n_elements), heights)
    np.testing.assert_allclose(
        elements[[2, 3, 6, 7]], slopes[:, :, [0, 2]].transpose(2, 1, 0).reshape(4, -1), atol=1e-14
    )
    # derivatives by central differences: a step of 1e-6 leaves 1e-10 by round-off
    part, step = np.full(n_elements, 0.3), 1e-6
    differences = (along(elements, part + step)[:2] - along(elements, part - step)[:2]) / (2 * step)
    np.testing.assert_allclose(along(elements, part)[2:], differences, atol=1e-9)


def test_dense_mats_keep_their_clearance_where_they_are_laid(monkeypatch):
    # twice as dense as the mat above, with kinks; a quarter of the clearance may be missed, an eighth is round-off of coordinates
    gaps = []

    def measured(model, **options):
        gaps.append(smallest_gap(model, **options))
        return gaps[-1]

    monkeypatch.setattr("litz.build.deposition.smallest_gap", measured)
    model = mat(n_fibres=60, size=(1e-3, 1e-3), length=0.5e-3, radius=5e-6)
    assert len(model.groups["FIBRES"].wires) == 60
    assert len(gaps) == 1
    assert gaps[0] > 0.6 * 0.5e-6


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: film(reach=RADIUS), "reach must be at least 10 radii"),
        (lambda: film(reach=1.0), "at most 1000 lengths"),
        (lambda: film(smallest_angle=1.6), "less than a right angle"),
        (lambda: mat(length=None), "a deposited mat needs a length"),
        (lambda: build.fibre_mat((1, 1), 3, radius=1e-3, seed=1, length=1.0), "for deposited mats"),
    ],
)
def test_what_makes_no_sense_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
