"""Result files whose texts are markup: pages show them as text, and run nothing of them."""

import base64
import gzip
import html
import re
import shutil
import warnings
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest

import litz
from browser import open_browser
from litz.viewer.server import ViewServer

WEB = Path(litz.__file__).parent / "viewer" / "web"
#: Would run in an element, in an attribute, in a script, in SVG; and a formula that matplotlib cannot set
HOSTILE = (
    "</title></script></style></textarea><img src=x onerror=window.hacked=1>"
    "<svg onload=window.hacked=1><script>window.hacked=1</script>"
    "\"'><b id=injected onmouseover='window.hacked=1'>&lt;i&gt;\u2028\u2029${hacked}`$\\frac{"
)


@pytest.fixture(scope="module")
def hostile(run_of_input, tmp_path_factory):
    """Results of the grid in which every text of the file and every unit of the tables is hostile."""
    directory = tmp_path_factory.mktemp("hostile") / "results"
    shutil.copytree(run_of_input("04_wire_grid"), directory)
    deck = "04_wire_grid"
    with h5py.File(directory / f"{deck}.vtkhdf", "r+") as file:
        objects = [file["litz"]]
        file["VTKHDF"].visititems(lambda _, found: objects.append(found))
        changed = 0
        for found in objects:
            for name, value in found.attrs.items():
                if isinstance(value, bytes | str) or (
                    getattr(value, "dtype", None) is not None and value.dtype.kind in "SO"
                ):
                    found.attrs[name] = HOSTILE
                    changed += 1
        for kind in ("node_sets", "element_sets"):
            for name in list(file["litz"][kind]):
                file["litz"][kind].move(name, f"{name}{HOSTILE.replace('/', '|')}")
                changed += 1
        del file["litz/deck"]
        file["litz/deck"] = HOSTILE
        file["litz"].attrs["finished"] = 0
    assert changed > 60
    for ending in ("_contacts.csv", "_history.csv", ".sta", ".cvg"):
        path = directory / f"{deck}{ending}"
        head, _, rest = path.read_text().partition("\n")
        mark = re.sub(r"[,\s\[\]]", "", HOSTILE) if path.suffix == ".csv" else re.sub(r"[\s\[\]]", "", HOSTILE)
        head = re.sub(r"\[[^\]]*\]", lambda _, mark=mark: f"[{mark}]", head)
        if path.suffix == ".sta":
            lines = rest.splitlines()
            rest = (
                "\n".join([*lines[:-1], f"{lines[-1]}  {HOSTILE}".replace("\u2028", "").replace("\u2029", "")]) + "\n"
            )
        path.write_text(f"{head}\n{rest}", encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return litz.Results(directory)


@pytest.fixture(scope="module")
def report(hostile, tmp_path_factory):
    """The page of a report about them."""
    return litz.report(hostile, tmp_path_factory.mktemp("hostile_report") / "page.html")


class Page(HTMLParser):
    """The elements of a page, with their attributes, as a browser finds them."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.text = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_data(self, data):
        self.text.append(data)


def assert_harmless(text):
    page = Page(text)
    for tag, attributes in page.elements:
        assert not [name for name in attributes if name.startswith("on")], (tag, attributes)
        assert attributes.get("id") != "injected"
        assert tag != "b"
        if tag == "img":
            assert attributes["src"].startswith("data:image/webp;base64,")
    scripts = [attributes for tag, attributes in page.elements if tag == "script"]
    assert {attributes["type"] for attributes in scripts} <= {"text/plain", "text/javascript"}
    # what stands in scripts is ours, or base64
    for kind, content in re.findall(r'<script type="([^"]*)"[^>]*>(.*?)</script>', text, re.DOTALL):
        if kind == "text/plain":
            gzip.decompress(base64.b64decode(content.strip()))
        assert "hacked" not in content
    assert len(scripts) == text.count("</script>")
    return page


@pytest.mark.slow
def test_the_report_shows_hostile_texts_as_texts(report):
    text = report.read_text(encoding="utf-8")
    page = assert_harmless(text)
    # heading, version, remark, names of sets and deck are there, word by word
    assert sum("onerror=window.hacked=1" in data for data in page.text) > 5
    assert html.escape(HOSTILE.splitlines()[0]) in text


def test_the_page_of_the_viewer_is_harmless(hostile):
    with ViewServer(hostile) as server:
        assert_harmless(server.page().decode())


def test_tables_in_notebooks_are_harmless(hostile):
    for table in (hostile.contacts, hostile.history, hostile.status, hostile.convergence):
        assert_harmless(table._repr_html_())


@pytest.mark.parametrize("kind", ["overview", "contacts", "residuals", "history", "network"])
def test_svg_pictures_are_harmless(hostile, kind, tmp_path):
    text = litz.plot(hostile, kind, tmp_path / "picture.svg").read_text(encoding="utf-8")
    assert not re.search(r"<(script|img|svg on|b )", text)


def test_the_scripts_of_the_pages_make_elements_only_by_the_dom():
    """`textContent` and attributes cannot become markup, whatever results hold: no script uses anything that can."""
    sinks = r"innerHTML|outerHTML|insertAdjacentHTML|document\s*\.\s*write|createContextualFragment|DOMParser|srcdoc"
    sinks += r"|\beval\b|new Function|setTimeout\(\s*[\"'`]|javascript:|setHTMLUnsafe"
    scripts = sorted(WEB.glob("*.js"))
    own = [path for path in scripts if path.name != "three.min.js"]
    assert len(own) >= 7
    for path in own:
        assert not re.findall(sinks, path.read_text(encoding="utf-8")), path.name
    # the handlers that an attribute would hold are added as functions
    for path in [*own, WEB / "viewer.html"]:
        assert not re.search(r"""(setAttribute\(\s*["'`]on|\son[a-z]+=["'])""", path.read_text(encoding="utf-8")), (
            path.name
        )


@pytest.mark.slow
def test_nothing_of_hostile_results_runs_in_a_browser(hostile, report):
    with open_browser() as browser, ViewServer(hostile) as server:
        import threading

        threading.Thread(target=server.serve_forever, daemon=True).start()
        for address in (server.url, report.as_uri()):
            browser.get(address)
            browser.implicitly_wait(30)
            assert browser.find_element("css selector", ".litz-viewer[data-ready=yes]")
            browser.execute_script("document.querySelector('.litz-viewer').viewer.select(3)")
            assert browser.execute_script("return window.hacked") is None
            assert not browser.find_elements("css selector", "#injected, .litz-viewer img, .litz-viewer b")
            assert "onerror" in browser.find_element("css selector", ".litz-compass").get_attribute("textContent")
        server.shutdown()
