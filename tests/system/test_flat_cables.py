"""A Rutherford cable between two plates: strands of both layers cross, and carry the force of the plates."""

import math

import numpy as np
import pytest

import litz
from litz import build
from litz.pictures.plots import plot

STRANDS, RADIUS, PITCH, LENGTH = 10, 0.4e-3, 40e-3, 12e-3


@pytest.fixture(scope="module")
def pressed(tmp_path_factory):
    """Results of a cable that is pressed by 1.5 % of its thickness, a voltage between its ends."""
    film = litz.Interaction(conductance=litz.FilmSpot(1e-11))
    model = build.rutherford(STRANDS, radius=RADIUS, pitch=PITCH, length=LENGTH, ends="sliding", interaction=film)
    height = np.abs(model.x[:, 1]).max() + RADIUS
    plates = []
    for name, side in (("LOWER", 1), ("UPPER", -1)):
        place = (0, -side * height, 0)
        plates.append(model.plane(name, place, (0, side, 0), reference=place))
        model.contact(list(model.groups.values()), plates[-1])
    lower, upper = plates
    model.fix(lower)
    model.fix(upper, "x", "z", "rotations")
    step = model.step("PRESS", increment=0.1)
    step.controls("STABILIZE", factor=1e-4)
    step.move(upper, "y", -12e-6)
    step.potential("PLUS", 1e-3)
    step.potential("MINUS", 0)
    # nothing moves but what still slides into its place, until nothing does
    for name in ("SETTLE", "REST"):
        model.step(name).controls("STABILIZE", factor=1e-4)
    model.ground = "MINUS"
    return model.run(tmp_path_factory.mktemp("flat"))


@pytest.mark.slow
def test_strands_of_the_layers_cross_at_twice_their_slope(pressed):
    # as they are laid, once most of them touch: those near the edges, which do so first, cross at another angle; pressed to
    # the end strands turn towards each other by 2 %
    ledger = next(
        rows
        for rows in map(pressed.contacts_at, range(1, len(pressed.times)))
        if (rows["spacing"] == 0).sum() > 2 * STRANDS
    )
    crossings = ledger["spacing"] == 0
    distance = 2 * RADIUS
    slope = STRANDS * distance / PITCH / math.sqrt(1 - (STRANDS * distance / PITCH) ** 2)
    expected = 2 * math.atan(slope)
    assert np.median(ledger["angle"][crossings]) == pytest.approx(expected, rel=0.01)
    # each strand crosses one of the other layer on every 20th part of the pitch that it is on a face
    assert (pressed.contacts_at(-1)["spacing"] == 0).sum() > 2 * STRANDS


@pytest.mark.slow
def test_the_plates_press_alike(pressed):
    forces = pressed.surface_forces
    lower, upper = forces["surface_force_y"][-2:]
    assert lower < 0 < upper
    assert upper == pytest.approx(-lower, rel=1e-6)
    # the strands of one layer pass it on to those of the other one; side by side they hardly press
    ledger = pressed.contacts_at(-1)
    across = ledger["force"] * np.abs(ledger["normal_y"])
    assert across.sum() == pytest.approx(upper, rel=0.02)


@pytest.mark.slow
def test_all_strands_share_alike_and_are_joined(pressed):
    shares = pressed.current_shares()
    np.testing.assert_allclose(shares.share, 1 / STRANDS, atol=0.02)
    found = pressed.interstrand_resistance(superconducting=True)
    assert np.isfinite(found.matrix).all()
    assert found.stages()["largest"][0] < 3 * found.stages()["smallest"][0]


@pytest.mark.slow
def test_its_section_is_drawn(pressed, tmp_path):
    assert plot(pressed, "section", tmp_path / "section.png", place=0.4).stat().st_size > 10_000
