"""What a notebook shows of a model: what it has in words, and a picture that needs no other file."""

import base64
import io
import re

import matplotlib as mpl
import numpy as np
import pytest
from PIL import Image

import litz
from litz.model.description import COLOUR_MAP, COLOURS
from litz.pictures.model_picture import frame, marked_nodes, model_scene


@pytest.fixture
def model():
    """Two crossed wires <of copper> between plates: held, pressed, with a voltage between them, and heated."""
    model = litz.Model("wires < & plates")
    lower = model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), radius=1e-3, material=litz.COPPER, elements=9)
    upper = model.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), radius=1e-3, material=litz.COPPER, elements=9)
    model.contact(lower, upper, conductance=litz.HertzSpot(), friction=0.3)
    model.contact(lower, model.plane("TABLE", (0, 0, -1e-3), (0, 0, 2)))
    model.fix(lower.ends)
    model.fix(upper.ends, "x", "rotations")
    step = model.step(increment=0.1, procedure="COUPLED TEMPERATURE-DISPLACEMENT", electrical=True, steady_state=True)
    step.move(upper.ends, "z", -1e-4)
    step.potential(lower.start, 1e-3)
    step.current(upper.start, 2.0)
    step.heat(upper.middle, 0.1)
    return model


def picture_of(shown):
    [data] = re.findall(r'src="data:image/png;base64,([^"]+)"', shown)
    return np.array(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")).astype(int)


def test_a_model_says_what_it_has(model):
    shown = model._repr_html_()
    text = re.sub(r"<[^>]*>", "\n", shown)
    assert "wires &lt; &amp; plates" in text
    assert "20 nodes, 18 elements" in text
    assert "LOWER: 1 wire, 9 B33 elements, radius 1 mm, COPPER" in text
    assert "COPPER: young 120 GPa, poisson 0.34, conductivity 58.8 MS/m" in text
    assert "TABLE: plane" in text
    assert "LOWER with UPPER: Hertz(), HertzSpot(), friction 0.3" in text
    assert "LOWER with TABLE: Hertz(); no current" in text
    assert "LOWER_ENDS: x y z rx ry rz" in text
    assert "UPPER_ENDS: x rx ry rz" in text
    assert "STEP1" in text
    assert "UPPER_ENDS: z = -100 µm" in text
    assert "LOWER_START: potential = 1 mV" in text
    assert "UPPER_START: current = 2 A" in text
    assert "UPPER_MIDDLE: heat = 100 mW" in text


def test_numbers_have_the_units_of_the_model():
    def of(units, material):
        model = litz.Model("one wire", units=units)
        model.wire("W", (0, 0, 0), (0, 0, 10), elements=2, radius=0.5, material=material)
        return model._repr_html_()

    plain = litz.Material("M", 120e3, 0.34)
    assert "radius 0.5, M" in of(None, plain)
    assert "radius 0.5 mm, M" in of({"length": "mm"}, plain)
    assert "young 120000," in of({"length": "mm"}, plain)


def test_the_picture_is_inside_and_each_group_has_its_colour(model):
    shown = model._repr_html_()
    # a saved notebook shows it without litz and without a network
    assert "http" not in shown
    assert "<script" not in shown
    picture = picture_of(shown)
    for name, colour in zip(("LOWER", "UPPER"), COLOURS, strict=False):
        assert f'<span style="color: {colour}">&#9632;</span> {name}:' in shown
        rgb = 255 * np.array(mpl.colors.to_rgb(colour))
        # a stroke that is as bright as its colour
        assert (np.abs(picture - rgb).max(axis=2) < 12).sum() > 100
    assert tuple(mpl.colors.to_hex(one) for one in mpl.colormaps[COLOUR_MAP].colors) == COLOURS


def test_the_scene_has_the_wires_where_they_are(model):
    scene = model_scene(model)
    assert len(scene.starts) == 3
    lower, upper = scene.points[: scene.starts[1]], scene.points[scene.starts[1] :]
    # round-off of cubic curves
    np.testing.assert_allclose(lower[[0, -1]], [(-0.05, 0, 0), (0.05, 0, 0)], atol=1e-15)
    np.testing.assert_allclose(upper[[0, -1]], [(0, -0.05, 2e-3), (0, 0.05, 2e-3)], atol=1e-15)
    np.testing.assert_allclose(scene.radius, 1e-3)
    # the table lies below the wires and reaches beyond them
    np.testing.assert_allclose(scene.surface_points[:, 2], -1e-3)
    assert scene.surface_points[:, 0].min() < -0.05
    assert scene.surface_points[:, 1].max() > 0.05


def test_nodes_are_marked_by_what_is_done_to_them(model):
    lower, upper = model.groups.values()
    assert marked_nodes(model) == {
        "potential or current": [*lower.start, *upper.start],
        "temperature or heat": list(upper.middle),
        "moved or loaded": list(upper.ends),
        "held": [*lower.ends, *upper.ends],
    }


def test_a_model_is_shown_at_any_stage():
    model = litz.Model("empty")
    assert frame(model) is None
    assert "0 nodes, 0 elements" in model._repr_html_()
    model.nodes([(0, 0, 0)])
    assert "1 node, 0 elements" in model._repr_html_()
    assert "<img" not in model._repr_html_()
    model.wire("W", (0, 0, 0), (1, 0, 0), elements=1, radius=0.1, material=litz.COPPER)
    assert "<img" in model._repr_html_()


def test_a_model_that_contradicts_itself_is_shown_without_units():
    model = litz.Model("mixed", units={"length": "mm"})
    model.wire("W", (0, 0, 0), (1, 0, 0), elements=1, radius=0.1, material=litz.COPPER)
    with pytest.raises(ValueError, match="COPPER is in SI"):
        _ = model.units
    assert "radius 0.1, COPPER" in model._repr_html_()


def test_a_large_model_takes_little_of_a_notebook():
    mat = litz.build.wire_grid(40, 40, pitch=1e-3, radius=1e-4, material=litz.COPPER)
    assert len(mat._repr_html_()) < 300_000


def test_of_long_wires_some_points_are_drawn_and_the_ends():
    model = litz.Model("long")
    for number in range(2):
        start, end = (0.0, number, 0.0), (1.0, number, 0.0)
        model.wire(f"W{number}", start, end, elements=20_000, radius=1e-3, material=litz.COPPER)
    scene = model_scene(model)
    assert len(scene.points) == len(scene.value) == len(scene.radius) < 20_000
    np.testing.assert_array_equal(scene.points[scene.starts[:-1]], [(0, 0, 0), (0, 1, 0)])
    np.testing.assert_array_equal(scene.points[scene.starts[1:] - 1], [(1, 0, 0), (1, 1, 0)])
