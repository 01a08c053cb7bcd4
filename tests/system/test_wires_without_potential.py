"""Wires from which no conducting path leads to a prescribed potential: result files say so, and pictures show them grey."""

import re
import subprocess
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure

from browser import open_browser
from litz import Results, build, plot
from litz.percolation import spans
from litz.pictures import drawing_process, network_chart
from litz.pictures.colours import NO_VALUE
from litz.pictures.scene import SceneMaker
from litz.viewer.data import WebData
from litz.viewer.page import page as html_page
from litz.viewer.page import viewer as html_viewer
from litz.viewer.page import viewer_style
from test_floating_conductors import crossed_wires, step
from test_view import ask, errors, load, viewer


@pytest.fixture(scope="module")
def results(litz_program, tmp_path_factory):
    """The lower wire is at 0 to 1 V; the upper one is 10 um away, touches in the second step, and is away again in the third."""
    folder = tmp_path_factory.mktemp("floating")
    voltage = "*BOUNDARY\n 4, 9, 9, 1\n"
    (folder / "deck.inp").write_text(crossed_wires(step(5e-6, voltage), step(1e-4, ""), step(0.0, "")))
    subprocess.run([litz_program, "run", "deck.inp"], cwd=folder, check=True, capture_output=True)
    return Results(folder / "deck.vtkhdf")


def index_of(results, step):
    return int(np.flatnonzero(results.steps == step)[-1])


@pytest.fixture(scope="module")
def upper(results):
    return np.isin(results.node_ids, results.node_ids[results.node_sets["UPPER"]])


def test_a_wire_has_a_potential_as_long_as_it_touches_one_that_has(results, upper):
    for number, touches in ((1, 0), (2, 1), (3, 0)):
        has = results.field("has_potential", index_of(results, number))
        assert set(has[upper]) == {touches}
        assert set(has[~upper]) == {1}


def test_before_anything_is_prescribed_no_wire_is_told_apart(results):
    assert not results.field("has_potential", 0).any()
    assert not SceneMaker(results, [0], "potential").scene(0).grey_text


def test_pictures_say_what_grey_means_where_it_is_seen(results, tmp_path):
    scenes = {
        number: SceneMaker(results, [index_of(results, number)]).scene(index_of(results, number)) for number in (1, 2)
    }
    assert scenes[1].grey_text == "grey wires: no potential"
    assert scenes[2].grey_text == ""
    assert np.isnan(scenes[1].value).sum() == scenes[1].starts[1]
    assert scenes[1].limits == pytest.approx((0, 1))
    pictures = [
        plot(results, "wires", tmp_path / f"{number}.png", increment=index_of(results, number)) for number in (1, 2)
    ]
    one_is_grey, none_is = map(grey_pixels, pictures)
    assert one_is_grey > 10 * none_is
    assert one_is_grey > 3000


def grey_pixels(path):
    """Pixels that are lit as a grey wire is, and no letters or axes."""
    from matplotlib.image import imread

    picture = imread(path)[60:800, :, :3]
    return int(((np.ptp(picture, axis=2) < 0.01) & (np.abs(picture.mean(axis=2) - 0.8) < 0.1)).sum())


def test_without_opengl_they_are_grey_too(results, tmp_path, monkeypatch):
    program = tmp_path / "crash"
    program.write_text("#!/bin/sh\nkill -SEGV $$\n")
    program.chmod(0o755)
    monkeypatch.setattr(drawing_process.sys, "executable", str(program))
    with pytest.warns(UserWarning, match="without OpenGL"):
        picture = plot(results, "wires", tmp_path / "flat.png", increment=index_of(results, 1))
    assert grey_pixels(picture) > 100


def test_the_network_has_a_grey_dot_and_says_so(results, tmp_path):
    graph = results.contact_network(index_of(results, 1))
    assert np.isnan(graph.wire_potential).tolist() == [False, True]
    figure = Figure()
    network_chart.network(figure, results, index_of(results, 1))
    assert "grey wires: no potential" in figure.axes[0].get_title(loc="left") + figure.axes[0].get_title()
    tree = ElementTree.parse(graph.to_graphml(tmp_path / "network.graphml"))
    texts = [float(one.text) for one in tree.iter() if str(one.get("key")).startswith("node_potential")]
    assert np.isnan(texts).tolist() == [False, True]


def test_the_summary_has_the_range_of_what_has_a_potential(results):
    assert re.search(r"potential +0 +to 1\n", results.summary())


@pytest.mark.slow
def test_the_viewer_shows_them_grey_and_says_so(results, tmp_path):
    saved = tmp_path / "page.html"
    saved.write_text(html_page("floating", html_viewer(WebData(results)), viewer_style()), encoding="utf-8")
    with open_browser() as browser:
        load(browser, saved.as_uri())
        assert errors(browser) == []
        assert "grey wires: no potential" in viewer(browser).find_element("css selector", ".litz-spot-note").text
        values = np.array(ask(browser, "Array.from(viewer.tubes.ends.array)"))
        assert (values > 1e20).tolist() == 6 * [False] + 6 * [True]
        # the range of what is known
        of_increment = (
            "(viewer.find('range').value = 'increment', viewer.range("
            "viewer.model.scalars.find((one) => one.name === 'potential'), new Float32Array([0, NaN, 1e-3])).limits)"
        )
        assert ask(browser, of_increment) == pytest.approx([0, 1e-3])


@pytest.mark.parametrize("seed", [0, 1])
def test_a_film_through_which_nothing_passes_has_no_current_and_no_warning(tmp_path, seed):
    film = build.nanowire_film((40e-6, 30e-6), 25, length=20e-6, radius=50e-9, seed=seed)
    film.press(50e-9, voltage=1e-3)
    results = film.run(tmp_path)
    assert not spans(results)
    assert not results.history["current PLUS to MINUS"].any()
    assert np.isinf(results.history["resistance PLUS to MINUS"][1:]).all()
    assert results.warnings == []


def test_the_colour_is_grey():
    red, green, blue = (int(NO_VALUE[k : k + 2], 16) for k in (1, 3, 5))
    assert red == green == blue
