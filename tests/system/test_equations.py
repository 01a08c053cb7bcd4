"""The check of the documentation site that MathJax could read its equations."""

import sys

import pytest

from browser import open_browser
from documents import ROOT

sys.path.insert(0, str(ROOT / "docs" / "site"))

from equations import mistakes

# What MathJax has to show after its work: here without it, and told what it has made of each equation.
PAGE = """<script>
const made = shown => {{ const box = document.createElement("div"); box.innerHTML = shown; return box; }};
window.MathJax = {{startup: {{promise: Promise.{promise}, document: {{math: [
  {{math: "a + b", typesetRoot: made('<svg fill="currentColor"></svg>')}}, {equation}]}}}}}};
</script><!-- tex-svg-full.js -->"""


@pytest.fixture(scope="module", autouse=True)
def browser():
    """Skips what needs a browser where there is none."""
    with open_browser():
        pass


@pytest.mark.parametrize(
    ("equation", "found"),
    [
        ("", []),
        (r"""{math: "\\frac{1", typesetRoot: made('<g data-mml-node="merror"></g>')}""", [("page.html", r"\frac{1")]),
        (r"""{math: "\\bodlsymbol x", typesetRoot: made('<g fill="red"></g>')}""", [("page.html", r"\bodlsymbol x")]),
        ("""{math: "never done", typesetRoot: null}""", [("page.html", "never done")]),
    ],
    ids=["whole", "syntax", "unknown command", "not typeset"],
)
def test_equations_that_mathjax_cannot_read_are_found(equation, found, tmp_path):
    (tmp_path / "page.html").write_text(PAGE.format(promise="resolve()", equation=equation))
    (tmp_path / "words.html").write_text("no equations, and no MathJax to ask")
    assert mistakes(tmp_path) == found


def test_mathjax_that_fails_altogether_is_found(tmp_path):
    (tmp_path / "page.html").write_text(PAGE.format(promise="reject(new Error('no extension'))", equation=""))
    assert mistakes(tmp_path) == [("page.html", "anything: no extension")]
