"""The HTML pages of the viewer and the report: self-contained."""

import html
import json
from pathlib import Path

import numpy as np

from ..results import Results
from .data import PLAIN, SHORT, Detail, WebData
from .packed import zipped

# Modules that import each other by these names
_MODULES = {
    "three": "three.min.js",
    **{
        f"litz/{name}.js": f"{name}.js"
        for name in ("data", "frame", "ledger", "prisms", "spots", "stage", "surfaces", "tubes", "viewer", "zones")
    },
}
_ICON = "data:,"
# Letters that a contact takes with all its digits, at least
_LEAST_PER_CONTACT = 10
# The same with few digits: where there is no room for these, of a contact there is what the table shows
_LEAST_OF_COLUMNS = 5


def page(title: str, body: str, style: str = "") -> str:
    """A whole page."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<link rel="icon" href="{_ICON}">
<style>
{style}</style>
</head>
<body>
{body}
</body>
</html>
"""


def viewer(data: WebData | None = None) -> str:
    """The viewer as a part of a page; with its data inside, or else fetched from `data/` beside the page."""
    embedded = "" if data is None else _embedded(data)
    return f"{_text('viewer.html')}{embedded}{_scripts()}"


def viewer_style() -> str:
    """The style sheet of the viewer."""
    return _text("viewer.css")


def evenly_chosen(n: int, max_count: int) -> list[int]:
    """At most `max_count` of the numbers from 0 to n - 1, evenly spaced, with the last and, if there are more, the first."""
    return np.unique(np.linspace(n - 1, 0, max(1, min(n, max_count))).round().astype(int)).tolist()


def fitting_viewer(results: Results, increments: list[int], max_size: int) -> tuple[str, list[int], bool]:
    """The viewer with as many of the increments as fit into a size in letters, evenly chosen, at least the last one.

    Where not all of them fit they have less detail, those before the last one the least.

    Returns
    -------
    str
        The viewer.
    list of int
        The increments.
    bool
        They have less detail.
    """
    n_contacts = results.written_contacts_at(increments[-1]).n_rows
    reduced = _LEAST_PER_CONTACT * n_contacts > max_size
    if reduced:
        # the last increment alone may be too large, and takes long
        of_last = SHORT if _LEAST_OF_COLUMNS * n_contacts > max_size else PLAIN
        only = _parts(WebData(results, increments[-1:]), None, of_last)
        if _size(only) > max_size:
            return f"{_text('viewer.html')}{_inside(only)}{_scripts()}", increments[-1:], True
    data = WebData(results, increments)
    # of many contacts the others need not be looked at
    reduced = reduced or len(data.packed_increment(len(increments) - 1)) > max_size
    parts = {} if reduced else _parts(data)
    reduced |= _size(parts) > max_size
    if reduced:
        parts = _parts(data, SHORT, PLAIN)
    while _size(parts) > max_size and len(increments) > 1:
        others = sum(len(parts[f"increment-{place}"]) for place in range(len(increments) - 1))
        share = (max_size - _size(parts) + others) / others
        fewer = max(1, min(len(increments) - 1, 1 + int((len(increments) - 1) * share)))
        increments = [increments[place] for place in evenly_chosen(len(increments), fewer)]
        parts = _parts(WebData(results, increments), SHORT, PLAIN)
    return f"{_text('viewer.html')}{_inside(parts)}{_scripts()}", increments, reduced


def _size(parts: dict[str, str]) -> int:
    return sum(map(len, parts.values()))


def _embedded(data: WebData) -> str:
    return _inside(_parts(data))


def _parts(data: WebData, detail: Detail | None = None, of_last: Detail | None = None) -> dict[str, str]:
    """The model, and the increments with the detail of those before the last one and of the last one."""
    last = len(data.increments) - 1
    parts = {"model": data.packed_model()}
    for place in range(last + 1):
        parts[f"increment-{place}"] = data.packed_increment(place, detail if place < last else of_last)
    return parts


def _inside(parts: dict[str, str]) -> str:
    return "".join(f'<script type="text/plain" id="litz-{name}">{text}</script>\n' for name, text in parts.items())


def _scripts() -> str:
    """All modules, compressed, and what turns them into addresses that hold their own text, which also a local page can load."""
    modules = zipped(json.dumps({name: _text(file) for name, file in _MODULES.items()}).encode())
    loader = _text("loader.js")
    return (
        f'<script type="text/plain" id="litz-modules">{modules}</script>\n'
        f'<script type="text/javascript">\n{loader}</script>\n'
    )


def _text(name: str) -> str:
    return Path(__file__).with_name("web").joinpath(name).read_text(encoding="utf-8")
