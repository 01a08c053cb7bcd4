"""Jackets around cables: what they hold at first, and to what they shrink."""

import math

import numpy as np
import pytest

from litz import build

RADIUS = 0.41e-3


def triplet(**options):
    return build.cable([[3]], radius=RADIUS, lay_lengths=[80e-3], length=10e-3, ends="sliding", **options)


def metal_of(model):
    """Section of the wires, by the length of their elements [m^2]."""
    lengths = np.linalg.norm(np.diff(model.x[model.connectivity], axis=1)[:, 0], axis=1)
    return math.pi * RADIUS**2 * lengths.sum() / np.ptp(model.x[:, 2])


def test_a_round_jacket_touches_the_outermost_wires_and_shrinks_to_the_void_fraction():
    model = triplet()
    build.compact(model, 0.34)
    jacket, amplitude = model.surfaces["JACKET"], model.amplitudes["JACKET"]
    # on chords of helices the axes between the nodes lie a little further inside
    assert jacket.radius == pytest.approx(RADIUS * (1 + 2 / math.sqrt(3)), rel=1e-3)
    assert amplitude.time == "TOTAL TIME"
    final = jacket.radius * amplitude.a[-1]
    assert 1 - metal_of(model) / (math.pi * final**2) == pytest.approx(0.34, rel=1e-9)


def test_the_planes_of_a_square_jacket_come_to_the_same_void_fraction():
    model = triplet()
    step = build.compact(model, 0.4, shape="square")
    normals = [sum(surface.direction) for surface in model.surfaces.values()]
    ways = np.array([item.value for item in step.prescribed]) * normals
    sides = np.array([np.linalg.norm(surface.point) for surface in model.surfaces.values()]) - ways
    assert len(sides) == 4
    assert min(ways) > 0
    assert np.ptp(sides) < 1e-12
    assert 1 - metal_of(model) / (4 * sides[0] ** 2) == pytest.approx(0.4, rel=1e-9)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (dict(void_fraction=0.09), r"void_fraction must be between 0\.0931 \(round wires cannot be denser\)"),
        (dict(void_fraction=0.6), r"that of the jacket around the wires as they are laid\), not 0\.6"),
        (dict(void_fraction=0.34, shape="hexagonal"), 'shape must be "round" or "square"'),
    ],
)
def test_what_is_wrong_with_a_jacket_is_said(options, message):
    with pytest.raises(ValueError, match=message):
        build.compact(triplet(), **options)


def test_a_cable_is_compacted_before_anything_else():
    model = triplet()
    model.step()
    with pytest.raises(ValueError, match="has a step already"):
        build.compact(model, 0.34)


def test_other_ends_are_refused():
    with pytest.raises(ValueError, match='ends must be "clamped" or "sliding"'):
        build.strand([1, 6], radius=RADIUS, lay_length=45e-3, length=5e-3, enlarge=True, ends="free")


def test_a_compacted_triplet_lies_in_its_jacket_and_feels_it_evenly(tmp_path):
    model = triplet(element_length=2e-3)
    build.compact(model, 0.345, increments=5)
    results = model.run(tmp_path)
    assert results.times[-1] == 1
    # loose wires are damped, and that is no surprise
    assert not results.warnings
    inside = results.rigid_surfaces["JACKET"].radius_at(results)
    moved = results.nodes + results.field("displacement")
    outside = np.hypot(*moved[:, :2].T).max() + RADIUS
    # wires overlap the wall, by less than 5 % of their radius
    assert inside < outside < inside + 0.05 * RADIUS
    wall = results.surface_contacts_at(-1)
    forces = [wall["force"][np.isin(wall["element"], group)].sum() for group in np.split(np.arange(1, 16), 3)]
    assert forces == pytest.approx([np.mean(forces)] * 3, rel=1e-6)
