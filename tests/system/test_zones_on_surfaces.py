"""A run that has all kinds of contact: a crossing, a zone along a line, and rigid surfaces, in all that shows them."""

import csv
import json
import threading
import warnings

import numpy as np
import pytest

import litz
from browser import open_browser
from litz.pictures.scene import SceneMaker
from litz.results.history_table import history_table
from litz.viewer.data import WebData
from litz.viewer.server import ViewServer
from test_view import errors, ledger_row, load

RADIUS, OVERLAP = 1e-3, 1e-7


def stack_on_a_table():
    """A wire on a table, a wire along it, and one across, pressed by a plate."""
    model = litz.Model("stack of wires between plates")
    steel = model.material("STEEL", young=200e9, poisson=0.3)

    def height(layer):
        return layer * (2 * RADIUS - OVERLAP)

    wires = [
        model.wire(name, begin, end, elements=n, radius=RADIUS, material=steel)
        for name, begin, end, n in (
            ("LOWER", (-0.011, 0, 0), (0.009, 0, 0), 7),
            ("ALONG", (-0.01, 0, height(1)), (0.01, 0, height(1)), 8),
            ("ACROSS", (0, -0.009, height(2)), (0, 0.011, height(2)), 7),
        )
    ]
    table = model.plane("TABLE", (0, 0, -RADIUS + OVERLAP), (0, 0, 1))
    plate = model.plane("PLATE", (0, 0, height(2) + RADIUS - OVERLAP), (0, 0, -1), reference=(0.01, -0.004, 0.006))
    for pair in (wires[:2], wires[1:], (wires[0], table), (wires[2], plate)):
        model.contact(*pair)
    for wire in wires:
        model.fix(wire, "x", "y", "rotations")
    model.fix(plate, "x", "y", "rotations")
    model.step("PRESS", increment=0.5).move(plate, "z", -1e-6)
    return model


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", litz.RunWarning)
        return stack_on_a_table().run(tmp_path_factory.mktemp("stack") / "stack")


def n_on_surfaces(results):
    return results.surface_contacts_at(-1).n_rows


def test_it_has_one_crossing_one_zone_and_contacts_with_both_surfaces(results):
    pairs = results.wire_pairs()
    assert [pairs[name].tolist() for name in ("wire_1", "wire_2", "zones", "crossings")] == [
        [0, 1], [1, 2], [1, 0], [0, 1],
    ]  # fmt: skip
    assert set(results.surface_contacts_at(-1)["surface"]) == {"PLATE", "TABLE"}
    # what presses the stack passes through all of it
    forces = results.surface_forces["force"][-2:]
    assert [*pairs["force"], *forces] == pytest.approx([forces[0]] * 4, rel=1e-6)


class TestPictures:
    def test_crossings_and_surface_contacts_are_discs_and_the_zone_is_a_line(self, results):
        scene = SceneMaker(results, [-1]).scene(-1)
        assert len(scene.spot_radius) == 1 + n_on_surfaces(results)
        at_heights = np.round(scene.spots.places[:, 2] / RADIUS)
        assert sorted(set(at_heights)) == [-1, 3, 5]
        assert set(np.round(scene.lines.places[:, 2] / RADIUS)) == {1}
        assert len(scene.line_ends) == 2
        assert len(scene.surface_quads) > 0
        assert f"{1 + n_on_surfaces(results)} contacts: disc area proportional to force" in scene.spot_text
        assert "1 zone of line contact" in scene.spot_text

    def test_the_crossing_that_bears_all_has_the_largest_disc(self, results):
        scene = SceneMaker(results, [-1]).scene(-1)
        forces = np.append(results.wire_pairs()["force"][1], results.surface_contacts_at(-1)["force"])
        drawn = scene.spot_radius / scene.spot_radius.max()
        assert drawn[0] == 1
        assert drawn == pytest.approx(np.maximum(np.sqrt(forces / forces[0]), 0.15 / 0.85), rel=1e-6)


class TestWords:
    def test_the_summary_has_the_crossing_the_zone_and_the_surfaces(self, results):
        text = " ".join(results.summary().split())
        for words in ("crossings 1 ", "zones of line contact 1 ", "force on PLATE", "force on TABLE"):
            assert words in text

    def test_the_table_of_the_history_counts_all_kinds_and_adds_all_forces(self, results):
        last = history_table(results).splitlines()[-1].split()
        assert int(last[1]) == 2 + n_on_surfaces(results)
        force = results.wire_pairs()["force"].sum() + results.surface_contacts_at(-1)["force"].sum()
        assert float(last[2]) == pytest.approx(force, rel=1e-6)

    @pytest.mark.usefixtures("reports_without_pictures")
    def test_the_report_has_sections_of_both(self, results, tmp_path):
        text = litz.report(results, tmp_path / "page.html").read_text(encoding="utf-8")
        for words in (
            "Contact along lines at the last increment", "<h2>Rigid surfaces</h2>",
            "what passes per length, along the wires", "Forces on the rigid surfaces.",
        ):  # fmt: skip
            assert words in text


class TestOtherPrograms:
    @pytest.mark.parametrize("to", ["vtu", "vtkhdf"])
    def test_each_kind_has_a_file_of_its_own_which_does_not_hide_the_results(self, results, tmp_path, to):
        results.export("vtkhdf", tmp_path)
        results.export(to, tmp_path)
        ending = {"vtu": "pvd", "vtkhdf": "vtkhdf"}[to]
        for kind in ("_contacts", "_zones", "_rigid", "_surfaces"):
            assert (tmp_path / f"stack{kind}.{ending}").is_file()
        assert litz.Results(tmp_path).path == tmp_path / "stack.vtkhdf"

    def test_csv_has_zones_and_pairs(self, results, tmp_path):
        results.export("csv", tmp_path)
        for kind, n in (("zones", 1), ("pairs", 2)):
            with (tmp_path / f"stack_{kind}.csv").open(newline="") as file:
                last = [row for row in csv.DictReader(file) if row["increment"] == str(results.increments[-1])]
            assert len(last) == n

    def test_results_of_a_deck_that_is_called_as_such_a_file_are_found(self, results, tmp_path):
        for ending in ("zones", "rigid", "surfaces"):
            alone = tmp_path / ending / f"wires_{ending}.vtkhdf"
            alone.parent.mkdir()
            alone.symlink_to(results.path)
            assert litz.Results(alone.parent).path == alone


class TestViewer:
    def test_it_gets_each_kind_by_itself(self, results):
        data = WebData(results)
        model, now = json.loads(data.model()), json.loads(data.increment(len(results.times) - 1))
        pairs, zones = results.wire_pairs(), results.contact_zones()
        assert [kind for kind in now["contacts"]["surface"] if kind is None] == [None]
        assert len(now["contacts"]["id"]) == 1 + n_on_surfaces(results)
        assert now["zones"]["id"] == zones["id"].tolist()
        assert len(now["surfaces"]) == 2
        assert model["largest"]["force"] == pytest.approx(pairs["force"][1], rel=1e-7)

    @pytest.mark.slow
    def test_a_row_of_each_kind_shows_its_numbers(self, results):
        with open_browser() as browser, ViewServer(results.path) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            load(browser, server.url)

            def entries(words):
                rows = browser.find_elements("css selector", ".litz-contacts tr")
                next(row for row in rows if words in row.text).click()
                return ledger_row(browser)

            crossing = results.contacts_at(-1).where(results.contacts_at(-1)["length"] == 0)
            first, second = (int(crossing[f"element_{k}"][0]) for k in (1, 2))
            assert entries(f"{first}, {second}")["element_2"] == str(second)
            zone = entries("wires 1, 2")
            assert (zone["wire_1"], zone["wire_2"]) == ("1", "2")
            assert "surface" not in zone
            on_plate = entries("PLATE")
            assert (on_plate["surface"], on_plate["wires"]) == ("PLATE", "ACROSS")
            assert "wire_1" not in on_plate
            assert len(browser.find_elements("css selector", ".litz-contacts tr")) == 1 + 2 + n_on_surfaces(results)
            assert errors(browser) == []
            server.shutdown()
