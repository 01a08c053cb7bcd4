"""Results in a notebook: the viewer with its data inside the cell, so that a saved notebook shows them too."""

import html

from ..results import Results
from .data import WebData
from .page import evenly_chosen, page, viewer, viewer_style

#: Data of the increments in a cell, and of the largest single one, as text before compression [bytes]
_MAX_DATA, _MAX_INCREMENT = 4_000_000, 20_000_000
_HEIGHT = "36em"


def frame(results: Results) -> str | None:
    """A frame with the viewer and as many increments as a cell should hold; None where there is nothing to show, or too much."""
    n = len(results.times)
    if n == 0:
        return None
    size = len(WebData(results, [n - 1]).increment(0))
    if size > _MAX_INCREMENT:
        return None
    picked = evenly_chosen(n, max(1, int(_MAX_DATA / size)))
    title = (results.heading.strip() or results.path.stem).splitlines()[0]
    whole = page(title, viewer(WebData(results, picked)), viewer_style())
    note = f"{results!r}" + (f", {len(picked)} of them here" if len(picked) < n else "")
    # a page of its own: neither its style nor its scripts meet those of the notebook
    return (
        f'<div>{html.escape(note)}</div><iframe srcdoc="{html.escape(whole)}" title="{html.escape(title)}" '
        f'style="width: 100%; height: {_HEIGHT}; border: 0"></iframe>'
    )
