"""The HTML pages of the viewer and the report: self-contained."""

import base64
import gzip
import html
import json
from pathlib import Path

import numpy as np

from .data import WebData

# Modules that import each other by these names
_MODULES = {
    "three": "three.min.js",
    **{
        f"litz/{name}.js": f"{name}.js"
        for name in ("data", "frame", "ledger", "spots", "stage", "surfaces", "tubes", "viewer", "zones")
    },
}
_ICON = "data:,"
# Of gzip: more takes longer and gains nothing
_COMPRESSION = 6


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
    """At most `max_count` of the numbers from 0 to n - 1, evenly spaced, with the first and the last."""
    return np.unique(np.linspace(0, n - 1, max(1, min(n, max_count)))[::-1].round().astype(int)).tolist()


def _embedded(data: WebData) -> str:
    parts = {"model": data.model()}
    parts |= {f"increment-{place}": data.increment(place) for place in range(len(data.increments))}
    return "".join(
        f'<script type="text/plain" id="litz-{name}">{_zipped(text)}</script>\n' for name, text in parts.items()
    )


def _zipped(text: str) -> str:
    return base64.b64encode(gzip.compress(text.encode(), _COMPRESSION, mtime=0)).decode()


def _scripts() -> str:
    """All modules, compressed, and what turns them into addresses that hold their own text, which also a local page can load."""
    modules = _zipped(json.dumps({name: _text(file) for name, file in _MODULES.items()}))
    loader = _text("loader.js")
    return (
        f'<script type="text/plain" id="litz-modules">{modules}</script>\n'
        f'<script type="text/javascript">\n{loader}</script>\n'
    )


def _text(name: str) -> str:
    return Path(__file__).with_name("web").joinpath(name).read_text(encoding="utf-8")
