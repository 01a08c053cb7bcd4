"""What a notebook shows: tables with their numbers, pictures instead of paths."""

import base64
import re

import numpy as np
import pytest

from litz.base.names import unknown_name
from litz.base.notebook import Picture, in_notebook
from litz.base.table import Table

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture
def table():
    columns = {
        "id": np.arange(30),
        "force": np.linspace(0.0, 2.9, 30),
        "status": np.array(["<stick>"] * 30),
    }
    return Table(columns, {"id": "", "force": "N", "status": ""})


def cells(html, row):
    return re.findall(r"<t[hd]>(.*?)</t[hd]>", re.findall(r"<tr>(.*?)</tr>", html)[row])


def test_a_printed_table_has_names_units_and_rows(table):
    lines = repr(table.where(slice(3))).splitlines()
    assert lines[0].split() == ["id", "force", "status"]
    assert lines[1].split() == ["[N]"]
    assert [line.split() for line in lines[2:5]] == [
        ["0", "0", "<stick>"],
        ["1", "0.1", "<stick>"],
        ["2", "0.2", "<stick>"],
    ]
    assert lines[5:] == ["3 rows, 3 columns"]


def test_of_a_long_table_the_ends_are_shown(table):
    first = [line.split()[0] for line in repr(table).splitlines()[2:]]
    assert first == ["0", "1", "2", "3", "4", "...", "25", "26", "27", "28", "29", "30"]
    assert repr(table).endswith("30 rows, 3 columns")


def test_columns_that_do_not_fit_on_a_line_are_named():
    wide = Table({f"column_{i}": np.zeros(2) for i in range(20)}, {})
    lines = repr(wide).splitlines()
    assert max(map(len, lines[:-1])) <= 120
    shown = re.findall(r"column_\d+", lines[0])
    hidden = re.findall(r"column_\d+", lines[-1])
    assert shown + hidden == list(wide)
    assert lines[0].endswith("...")


def test_an_empty_table_is_printed_too():
    assert repr(Table({}, {})) == "0 rows, 0 columns"
    assert repr(Table({"time": np.empty(0)}, {"time": "s"})).splitlines() == ["time", " [s]", "0 rows, 1 columns"]


def test_a_notebook_gets_all_columns_with_names_escaped(table):
    html = table._repr_html_()
    assert cells(html, 0) == ["id", "force", "status"]
    assert cells(html, 1) == ["", "[N]", ""]
    assert cells(html, 2) == ["0", "0", "&lt;stick&gt;"]
    assert cells(html, -1) == ["29", "2.9", "&lt;stick&gt;"]
    assert "30 rows, 3 columns" in html
    # 1e-09 would be broken at its hyphen
    assert "white-space: nowrap" in html


def test_a_misspelt_column_is_answered_by_its_first_word():
    known = ["time", "voltage PLUS to MINUS", "resistance PLUS to MINUS"]
    assert "'resistanse'; did you mean 'resistance PLUS to MINUS'? There are" in unknown_name(
        "column", "resistanse", known
    )
    assert "there is no column 'xyz'. There are: time" in unknown_name("column", "xyz", known)


@pytest.mark.parametrize(("name", "kind"), [("a.png", "image/png"), ("b.gif", "image/gif")])
def test_a_picture_is_a_path_that_a_notebook_shows(tmp_path, name, kind):
    path = Picture(tmp_path / name)
    path.write_bytes(PNG)
    assert path == tmp_path / name
    assert base64.b64decode(path._repr_mimebundle_()[kind]) == PNG
    assert set(path._repr_mimebundle_()) == {"text/plain", kind}


def test_a_picture_that_cannot_be_shown_is_its_path(tmp_path):
    missing = Picture(tmp_path / "missing.png")
    assert missing._repr_mimebundle_() == {"text/plain": repr(missing)}
    document = Picture(tmp_path / "a.pdf")
    document.write_bytes(b"%PDF")
    assert set(document._repr_mimebundle_()) == {"text/plain"}
    drawing = Picture(tmp_path / "a.svg")
    drawing.write_text("<svg/>")
    assert drawing._repr_mimebundle_()["image/svg+xml"] == "<svg/>"


def test_no_notebook_runs_the_tests():
    assert not in_notebook()
