"""Wires drawn by VTK: it draws wherever there is an OpenGL, and what is behind a wire is hidden."""

from ctypes.util import find_library
from dataclasses import replace

import numpy as np
import pytest

import litz
from litz.pictures.scene import SceneMaker, aim
from litz.pictures.wire_picture import SPOT_COLOUR, render

# unlike elsewhere, the warning that VTK has not drawn is an error here
pytestmark = [
    pytest.mark.skipif(
        not (find_library("OSMesa") or find_library("EGL_mesa")), reason="there is no OpenGL without a screen"
    ),
    pytest.mark.filterwarnings("error:.*drawn with matplotlib only"),
]
PIXELS = np.array([400, 400])


@pytest.fixture
def scene(run_of_input):
    return SceneMaker(litz.Results(run_of_input("04_wire_grid")), [-1], spots="force").scene(-1)


def from_above(scene):
    return aim(scene.outline, scene.radius.max(), 1.0, (0.0, 0.0, 1.0))


def n_orange(scene, camera):
    """Pixels of the colour of the discs, as it is: without light and shade."""
    (drawn,) = render([scene], camera, PIXELS)
    orange = np.array([int(SPOT_COLOUR[k : k + 2], 16) for k in (1, 3, 5)])
    return np.all(np.abs(drawn.picture.astype(int) - orange) <= 2, axis=2).sum()


def test_the_discs_of_the_contacts_have_their_full_colour(scene):
    assert n_orange(scene, from_above(scene)) > 50


def test_contacts_are_seen_from_above_and_below(scene):
    below = aim(scene.outline, scene.radius.max(), 1.0, (0.0, 0.0, -1.0))
    assert n_orange(scene, below) > 50


def test_contacts_behind_another_wire_are_hidden(scene):
    """Under a thick wire over each of the four wires along x nothing is seen of any contact; beside them everything is."""
    camera = from_above(scene)
    x, top = scene.points[:, 0], scene.points[:, 2].max()

    def with_roof(y_of_roofs):
        lines = [np.array([[x.min(), y, top + 0.02], [x.max(), y, top + 0.02]]) for y in y_of_roofs]
        n = 2 * len(lines)
        return replace(
            scene,
            points=np.concatenate([scene.points, *lines]),
            starts=np.concatenate([scene.starts, scene.starts[-1] + 2 * np.arange(1, len(lines) + 1)]),
            radius=np.concatenate([scene.radius, np.full(n, 4 * scene.radius.max())]),
            value=np.concatenate([scene.value, np.zeros(n)]),
        )

    rows = np.unique(scene.spots.places[:, 1].round(3))
    assert n_orange(with_roof(rows), camera) == 0
    assert n_orange(with_roof([rows.min() - 0.02]), camera) == n_orange(scene, camera)


def test_a_run_is_drawn_without_a_warning(run_of_input, tmp_path):
    assert litz.plot(run_of_input("04_wire_grid"), "overview", tmp_path / "overview.png").is_file()
