"""`litz view` in a real browser, and what its server answers."""

import gzip
import io
import json
import subprocess
import threading
import urllib.error
import urllib.request

import numpy as np
import pytest
from matplotlib.image import imread

import litz
from browser import open_browser
from litz.base.quantities import engineering
from litz.viewer.data import WebData
from litz.viewer.page import fitting_viewer, viewer_style
from litz.viewer.page import page as html_page
from litz.viewer.page import viewer as html_viewer
from litz.viewer.server import ViewServer
from test_cli import ENTRY
from test_outlines import ANGLE, OUTLINES, cantilever

LONGEST_WAIT = 60


@pytest.fixture(scope="module")
def server(run_of_input):
    """The viewer of a grid with 16 contacts at five increments."""
    with ViewServer(run_of_input("04_wire_grid")) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


@pytest.fixture(scope="module")
def strand(run_of_input):
    """The viewer of a strand, whose wires touch along lines."""
    with ViewServer(run_of_input("14_strand")) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


@pytest.fixture(scope="module")
def browser():
    with open_browser() as browser:
        yield browser


@pytest.fixture
def page(browser, server):
    load(browser, server.url)
    return browser


def load(browser, url):
    """Load a page with the viewer, and wait for its first picture."""
    browser.get_log("browser")
    browser.get(url)
    wait(
        browser, lambda: browser.find_elements("css selector", ".litz-viewer[data-ready=yes]"), "the page is not ready"
    )


def wait(browser, condition, message):
    from selenium.webdriver.support.ui import WebDriverWait

    return WebDriverWait(browser, LONGEST_WAIT).until(lambda _: condition(), message)


def errors(browser):
    return [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]


def viewer(browser):
    return browser.find_element("css selector", ".litz-viewer")


def ask(browser, expression):
    """Value of an expression of JavaScript in which `viewer` is that of the page."""
    return browser.execute_script(f"const viewer = document.querySelector('.litz-viewer').viewer; return {expression}")


def click_at(browser, x, y):
    """Click a place of the picture, counted from its upper left corner."""
    from selenium.webdriver import ActionChains

    canvas = browser.find_element("css selector", ".litz-canvas canvas")
    box = canvas.rect
    actions = ActionChains(browser)
    actions.move_to_element_with_offset(
        canvas, round(x - box["width"] / 2), round(y - box["height"] / 2)
    ).click().perform()


def ledger_row(browser):
    """Name and text of each entry of the row that is shown."""
    return {
        entry.get_attribute("data-name"): entry.text
        for entry in browser.find_elements("css selector", ".litz-ledger dd")
    }


def picture_of(browser):
    """What is on the canvas, (height, width, 3)."""
    canvas = browser.find_element("css selector", ".litz-canvas")
    return imread(io.BytesIO(canvas.screenshot_as_png))[..., :3]


def in_words(value, unit):
    factor, symbol = engineering(np.array([value]), unit)
    return f"{factor * value:.6g} {symbol}".strip()


class TestZones:
    """Six wires that touch a core along lines."""

    @pytest.mark.slow
    def test_a_line_is_picked_in_the_picture_and_its_zone_is_read(self, browser, strand):
        load(browser, strand.url)
        assert errors(browser) == []
        zones = strand.results.contact_zones()
        assert ask(browser, "viewer.data.zones.id.length") == zones.n_rows
        place = ask(browser, "viewer.stage.project(viewer.zones.middles[40])")
        click_at(browser, *place)
        found = ledger_row(browser)
        # lines lie above each other in the picture, and a mouse is where there are pixels
        picked = zones["id"].tolist().index(int(found["id"]))
        assert ask(browser, "viewer.zones.selected") == picked
        assert found["force_per_length"] == in_words(zones["force_per_length"][picked], "N/m")
        assert (found["wire_1"], found["wire_2"]) == tuple(str(zones[f"wire_{k}"][picked] + 1) for k in (1, 2))

    @pytest.mark.parametrize("width", [1300, 900])
    def test_both_bars_stand_beside_each_other_in_the_room_below_the_model(self, browser, strand, width):
        browser.set_window_size(width, 800)
        load(browser, strand.url)
        bars = browser.execute_script(
            "return [...document.querySelectorAll('.litz-colours .bar')].map((bar) => bar.getBoundingClientRect().toJSON())"
        )
        picture = browser.execute_script(
            "return document.querySelector('.litz-picture').getBoundingClientRect().toJSON()"
        )
        assert bars[0]["top"] == bars[1]["top"] > picture["bottom"] - 100
        assert bars[0]["right"] < bars[1]["left"]
        assert bars[1]["right"] < picture["right"] - 190

    @pytest.mark.slow
    def test_the_colours_of_the_lines_have_a_bar_of_their_own(self, browser, strand):
        load(browser, strand.url)
        bar = browser.find_element("css selector", ".litz-zone-colours")
        assert bar.is_displayed()
        assert "force per length [kN/m]" in bar.text
        picture = picture_of(browser)
        red = (picture[..., 0] > 0.5) & (picture[..., 1] < 0.35) & (picture[..., 2] < 0.3)
        assert np.count_nonzero(red) > 1000
        browser.execute_script(
            "const select = document.querySelector('.litz-spot-size'); select.value = 'none';"
            "select.dispatchEvent(new Event('change'))"
        )
        wait(browser, lambda: not bar.is_displayed(), "the bar stays")

    def test_wires_that_only_cross_have_no_such_bar(self, page):
        assert not page.find_element("css selector", ".litz-zone-colours").is_displayed()


class TestPage:
    def test_it_loads_without_errors_at_the_last_increment(self, page, server):
        assert errors(page) == []
        assert viewer(page).get_attribute("data-increment") == str(len(server.results.times) - 1)
        assert "4 x 4 copper wires" in page.title

    def test_the_picture_shows_the_wires_in_the_colours_of_the_bar(self, page):
        picture = picture_of(page)
        assert np.mean(np.any(picture < 0.9, axis=2)) > 0.03
        greenish = (picture[..., 1] > picture[..., 0] + 0.1) & (picture[..., 1] > picture[..., 2])
        assert np.count_nonzero(greenish) > 1000

    def test_there_are_as_many_spots_as_contacts(self, page):
        from scipy.ndimage import label

        page.find_element("css selector", "[data-view=z]").click()
        picture = picture_of(page)
        orange = (picture[..., 0] > 0.8) & (picture[..., 1] > 0.2) & (picture[..., 1] < 0.5) & (picture[..., 2] < 0.35)
        assert label(orange)[1] == 16

    def test_increments_are_scrubbed_with_the_slider(self, page, server):
        from selenium.webdriver.common.keys import Keys

        slider = page.find_element("css selector", ".litz-increment")
        last = len(server.results.times) - 1
        before = picture_of(page)
        slider.send_keys(Keys.ARROW_LEFT)
        wait(page, lambda: viewer(page).get_attribute("data-increment") == str(last - 1), "no scrubbing back")
        slider.send_keys(Keys.HOME)
        wait(page, lambda: viewer(page).get_attribute("data-increment") == "0", "no scrubbing to the start")
        assert "time 0 s" in page.find_element("css selector", ".litz-time").text
        assert not np.array_equal(before, picture_of(page))
        assert errors(page) == []

    def test_a_contact_is_picked_in_the_picture_and_its_ledger_row_is_read(self, page, server):
        ledger = server.results.contacts_at(-1)
        for k in (0, 7):
            click_at(page, *ask(page, f"viewer.screenPosition({ledger['id'][k]})"))
            row = ledger_row(page)
            assert row["id"] == str(ledger["id"][k])
            for name in ("force", "current", "resistance", "gap"):
                assert row[name] == in_words(ledger[name][k], ledger.units[name])
        click_at(page, 5, 300)
        assert ledger_row(page) == {}

    def test_a_row_of_the_table_chooses_its_contact_and_it_stays_while_scrubbing(self, page, server):
        page.find_element("css selector", ".litz-contacts tr[data-id='5']").click()
        assert ledger_row(page)["id"] == "5"
        ask(page, "viewer.show(2)")
        wait(page, lambda: viewer(page).get_attribute("data-increment") == "2", "no scrubbing")
        ledger = server.results.contacts_at(2)
        assert ledger_row(page)["force"] == in_words(ledger["force"][list(ledger["id"]).index(5)], "N")

    @pytest.mark.slow
    def test_every_scalar_can_be_chosen_and_its_bar_has_the_range_of_the_run(self, page, server):
        from selenium.webdriver.support.ui import Select

        choice = Select(page.find_element("css selector", ".litz-field"))
        names = [option.get_attribute("value") for option in choice.options]
        assert {"potential", "joule_heat", "displacement", "displacement.z", "bending_moment"} <= set(names)
        for name in names:
            choice.select_by_value(name)
        choice.select_by_value("joule_heat")
        heat = server.results.field("joule_heat", None)
        shown = [float(number) for number in viewer(page).get_attribute("data-limits").split()]
        np.testing.assert_allclose(shown, [heat.min(), heat.max()])
        Select(page.find_element("css selector", ".litz-range")).select_by_value("increment")
        shown = [float(number) for number in viewer(page).get_attribute("data-limits").split()]
        np.testing.assert_allclose(shown, [heat[-1].min(), heat[-1].max()], rtol=1e-6)
        assert errors(page) == []

    def test_dragging_turns_the_model(self, page):
        from selenium.webdriver import ActionChains

        before = ask(page, "viewer.stage.camera.position.toArray()")
        canvas = page.find_element("css selector", ".litz-canvas canvas")
        ActionChains(page).move_to_element(canvas).click_and_hold().move_by_offset(120, 40).release().perform()
        wait(page, lambda: ask(page, "viewer.stage.camera.position.toArray()") != before, "it does not turn")
        # the home button brings it back
        page.find_element("css selector", "[data-view=home]").click()
        np.testing.assert_allclose(ask(page, "viewer.stage.camera.position.toArray()"), before, rtol=1e-6)

    def test_the_run_can_be_played(self, page):
        # an increment is shown for a moment only: the page itself takes down what it shows
        page.execute_script(
            "const viewer = arguments[0]; window.shown = [];"
            "new MutationObserver(() => window.shown.push(viewer.dataset.increment))"
            ".observe(viewer, {attributes: true, attributeFilter: ['data-increment']});",
            viewer(page),
        )
        button = page.find_element("css selector", ".litz-play")
        button.click()
        wait(page, lambda: page.execute_script("return window.shown.at(-1)") == "4", "it does not play to the end")
        wait(page, lambda: button.text == "▶", "it does not end")
        assert page.execute_script("return window.shown")[-4:] == ["1", "2", "3", "4"]
        assert viewer(page).get_attribute("data-increment") == "4"


class TestReport:
    @pytest.mark.slow
    def test_a_report_works_from_a_file_with_nothing_beside_it(self, browser, report_of_grid):
        browser.execute_cdp_cmd("Network.enable", {})
        browser.execute_cdp_cmd("Network.emulateNetworkConditions",
                                {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})  # fmt: skip
        load(browser, report_of_grid.as_uri())
        assert errors(browser) == []
        ask(browser, "viewer.select(3)")
        assert ledger_row(browser)["id"] == "3"
        ask(browser, "viewer.show(1)")
        wait(browser, lambda: viewer(browser).get_attribute("data-increment") == "1", "no scrubbing")

    @pytest.mark.slow
    def test_increments_with_less_detail_are_shown_too(self, browser, run_of_input, tmp_path):
        results = litz.Results(run_of_input("04_wire_grid"))
        data, increments = WebData(results), list(range(len(results.times)))
        full = len(data.packed_model()) + sum(len(data.packed_increment(place)) for place in increments)
        stage, picked, reduced = fitting_viewer(results, increments, full - 1)
        assert reduced
        assert picked == increments
        saved = tmp_path / "small.html"
        saved.write_text(html_page("small", stage, viewer_style()), encoding="utf-8")
        load(browser, saved.as_uri())
        ask(browser, "viewer.show(1)")
        wait(browser, lambda: viewer(browser).get_attribute("data-increment") == "1", "no scrubbing")
        ask(browser, "viewer.select(3)")
        row = ledger_row(browser)
        contacts = results.contacts_at(1)
        force = contacts["force"][contacts["id"] == 3][0]
        assert row["force"] == in_words(float(f"{force:.3g}"), "N")
        assert "gap" in row
        assert "resistance" not in row
        assert errors(browser) == []

    @pytest.mark.slow
    def test_sections_that_are_not_round_have_their_outline(self, browser, run, tmp_path):
        """An L along x, twisted at its end; its first axis was along y."""
        _, results = run(cantilever(ANGLE, load="3, 4, 0.1"))
        saved = tmp_path / "angle.html"
        saved.write_text(html_page("angle", html_viewer(WebData(results)), viewer_style()), encoding="utf-8")
        load(browser, saved.as_uri())
        assert errors(browser) == []
        places = ask(browser, "Array.from(viewer.prisms.mesh.geometry.attributes.position.array)")
        # from the middle of the model, as the first 13 sections of the second element, and its ends
        corners = np.array(places).reshape(2, -1, 3)[1, :-12].reshape(13, 12, 3)[-1]
        angle = results.field("rotation")[2, 0]
        assert angle > 0.01
        first, second = 1e-3 * np.array(OUTLINES[ANGLE]).T[:, :, None]
        end = results.positions()[2] - [0.05, 0, 0]
        along_first, along_second = np.array([[0, np.cos(angle), np.sin(angle)], [0, -np.sin(angle), np.cos(angle)]])
        expected = end + first * along_first + second * along_second
        np.testing.assert_allclose(corners[::2], expected, atol=2e-5)
        # the tube is not drawn
        assert ask(browser, "Array.from(viewer.tubes.radii.array)") == [-1, -1]


class TestNotebook:
    @pytest.mark.slow
    def test_a_saved_notebook_shows_the_results_with_nothing_beside_it(self, browser, run_of_input, tmp_path):
        results = litz.Results(run_of_input("04_wire_grid"))
        saved = tmp_path / "notebook.html"
        saved.write_text(f"<!DOCTYPE html><html><body>{results._repr_html_()}</body></html>", encoding="utf-8")
        browser.get_log("browser")
        browser.get(saved.as_uri())
        browser.switch_to.frame(browser.find_element("css selector", "iframe"))
        wait(browser, lambda: browser.find_elements("css selector", ".litz-viewer[data-ready=yes]"), "it is not ready")
        assert errors(browser) == []
        ask(browser, "viewer.select(3)")
        assert ledger_row(browser)["id"] == "3"
        browser.switch_to.default_content()

    def test_results_without_an_increment_are_their_text(self, run_of_input, monkeypatch):
        results = litz.Results(run_of_input("04_wire_grid"))
        monkeypatch.setattr(type(results), "times", np.zeros(0))
        assert results._repr_html_() is None


class TestServer:
    def get(self, server, path, **headers):
        with urllib.request.urlopen(urllib.request.Request(server.url + path, headers=headers), timeout=30) as answer:
            return answer

    def read(self, server, path, **headers):
        with urllib.request.urlopen(urllib.request.Request(server.url + path, headers=headers), timeout=30) as answer:
            return answer.read()

    def test_it_listens_to_this_machine_only(self, server):
        assert server.server_address[0] == "127.0.0.1"

    def test_pages_of_other_names_get_nothing(self, server):
        """A name that leads to this machine would let another site read the results."""
        with pytest.raises(urllib.error.HTTPError, match="403"):
            self.read(server, "data/model", Host="example.org")

    def test_it_serves_no_files(self, server):
        for path in ("../../etc/passwd", "data/increment-99", "data/increment--1", "web/viewer.js"):
            with pytest.raises(urllib.error.HTTPError, match="404"):
                self.read(server, path)

    def test_data_is_sent_in_short_to_those_who_can_read_it(self, server):
        plain = self.read(server, "data/increment-4")
        short = self.read(server, "data/increment-4", **{"Accept-Encoding": "gzip"})
        assert gzip.decompress(short) == plain
        assert len(json.loads(plain)["contacts"]["id"]) == 16

    def test_a_port_that_is_taken_is_told(self, server):
        with pytest.raises(litz.FileError, match=f"port {server.server_address[1]} cannot be used"):
            ViewServer(server.results, server.server_address[1])

    @pytest.mark.slow
    def test_the_command_prints_the_address_and_ends_with_ctrl_c(self, run_of_input):
        # a shell that runs the tests in the background has them ignore Ctrl-C
        arguments = ["env", "--default-signal=INT", *ENTRY, "view", str(run_of_input("04_wire_grid")), "--no-browser"]
        with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as process:
            try:
                address = process.stdout.readline().split(" at ")[1].split()[0]
                with urllib.request.urlopen(address, timeout=30) as answer:
                    assert b"litz-viewer" in answer.read()
                process.send_signal(2)
                assert process.wait(timeout=30) == 0
            finally:
                process.kill()


class TestData:
    def test_curves_and_fields_are_those_of_the_results(self, server):
        import base64

        results = server.results
        data = WebData(results)
        model, last = json.loads(data.model()), json.loads(data.increment(4))
        curves = np.frombuffer(base64.b64decode(last["curves"]), np.float32).reshape(-1, 4, 3)
        middle = (results.nodes.min(axis=0) + results.nodes.max(axis=0)) / 2
        np.testing.assert_allclose(curves[:, :2] + middle, results.positions()[results.elements], atol=1e-8)
        potential = np.frombuffer(base64.b64decode(last["fields"]["potential"]), np.float32)
        np.testing.assert_allclose(potential, results.field("potential"), rtol=1e-6)
        assert last["contacts"]["force"] == pytest.approx(results.contacts_at(-1)["force"], rel=1e-7)
        known = {scalar["name"]: scalar for scalar in model["scalars"]}
        assert known["potential"]["limits"] == [0, pytest.approx(results.field("potential", None).max())]

    def test_what_is_zero_all_the_time_is_left_out(self, server):
        names = {scalar["name"] for scalar in json.loads(WebData(server.results).model())["scalars"]}
        assert "applied_moment" not in names


def test_the_library_of_the_viewer_is_the_release_that_its_recipe_names():
    from pathlib import Path

    root = Path(__file__).parents[2]
    recipe = json.loads((root / "web" / "package.json").read_text())
    bundle = Path(litz.__file__).parent / "viewer" / "web" / "three.min.js"
    head = bundle.read_text(encoding="utf-8")[:200]
    assert f"three.js {recipe['devDependencies']['three']}," in head
    assert bundle.with_name("three.LICENSE").read_text().startswith("The MIT License")
