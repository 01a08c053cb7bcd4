"""The link checker of the documentation site."""

import sys

import pytest

from documents import ROOT

sys.path.insert(0, str(ROOT / "docs" / "site"))

from links import broken_links, loaded_from_elsewhere


@pytest.fixture
def site(tmp_path):
    (tmp_path / "index.html").write_text('<h1 id="top">x</h1><a href="sub/page.html#there">y</a><img src="p.png">')
    (tmp_path / "p.png").touch()
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "page.html").write_text('<a name="there"></a><a href="../index.html#top">x</a>')
    return tmp_path


def test_a_whole_site_has_no_broken_link(site):
    assert broken_links(site) == []


def test_missing_files_places_and_pictures_are_found(site):
    (site / "sub" / "page.html").write_text('<a href="../gone.html">x</a><a href="../index.html#gone">x</a>')
    (site / "p.png").unlink()
    assert broken_links(site) == [
        ("index.html", "p.png"),
        ("index.html", "sub/page.html#there"),
        ("sub/page.html", "../gone.html"),
        ("sub/page.html", "../index.html#gone"),
    ]


def test_external_links_are_not_followed(site):
    (site / "sub" / "page.html").write_text(
        '<a name="there" href="https://example.org/gone">x</a><a href="mailto:a@b">y</a>'
    )
    assert broken_links(site) == []


def test_of_ford_s_pages_the_files_are_checked_not_the_places_in_them(site):
    (site / "fortran").mkdir()
    (site / "fortran" / "index.html").write_text('<a href="#gone">x</a><a href="gone.html">x</a>')
    assert broken_links(site) == [("fortran/index.html", "gone.html")]


def test_scripts_styles_and_pictures_from_elsewhere_are_found(site):
    (site / "sub" / "page.html").write_text(
        '<link href="https://example.org/a.css" rel="stylesheet"><script src="//example.org/b.js"></script>'
        '<img src="../p.png"><a href="https://example.org/only-a-link">x</a>'
    )
    assert loaded_from_elsewhere(site) == [
        ("sub/page.html", "//example.org/b.js"),
        ("sub/page.html", "https://example.org/a.css"),
    ]
