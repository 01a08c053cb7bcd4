"""`litz report`: one HTML page about a run, with pictures and the interactive model."""

import html
import json
import tempfile
import warnings
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path

from ..base.output import writing
from ..errors import FileError
from ..results import Results
from ..viewer.packed import zipped
from ..viewer.page import evenly_chosen, fitting_viewer, page, viewer_style
from . import report_tables as tables
from . import side_by_side
from .surface_tables import surface_contacts_of_iterate, surfaces

# Letters of a page, and at most of the data of its three-dimensional view; pictures have what is left, but not less than this
_MAX_PAGE, _MAX_DATA, _MIN_PICTURES = 980_000, 480_000, 100_000
# Increments that are looked at for that
_MAX_INCREMENTS = 200
_MAX_DECK_LENGTH = 200_000
# Results that several processes read at a time: larger ones take much memory in each [bytes]
_MAX_FORKED = 50e6
# Decks of more letters are compressed in the page, and read when they are looked at
_SHORT_DECK = 20_000
_OPEN_DECK = """\
document.getElementById("litz-deck").addEventListener("toggle", async ({ target }) => {
   const zipped = Uint8Array.from(atob(target.dataset.deck), (letter) => letter.charCodeAt(0));
   const text = new Blob([zipped]).stream().pipeThrough(new DecompressionStream("gzip"));
   target.querySelector("pre").textContent = await new Response(text).text();
}, { once: true });
"""

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #1b1b1b; margin: 0 auto; max-width: 78rem; padding: 1.5rem; }
h1 { font-size: 1.5rem; margin: 0 0 .3rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; }
h1 + p { color: #444; margin-top: 0; }
.verdict { padding: .7rem 1rem; border-left: 5px solid #3b7d3a; background: #eef5ee; }
.verdict.bad { border-color: #b00020; background: #fbeef0; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(22rem, 1fr)); gap: 0 2.5rem; align-items: start; }
table.data { border-collapse: collapse; font-size: 13.5px; margin: .4rem 0 1rem; }
table.data th, table.data td { border-bottom: 1px solid #ddd; padding: .25rem .7rem; text-align: right; vertical-align: top; }
table.data th { background: #f3f3f3; font-weight: 600; }
table.data th:first-child, table.data td:first-child, table.data .text { text-align: left; }
table.data td { font-variant-numeric: tabular-nums; white-space: nowrap; }
table.data td:first-child, table.data .text { white-space: normal; }
.wide { overflow-x: auto; }
figure { margin: 0 0 1.4rem; } figure img { max-width: 100%; height: auto; } figcaption { color: #444; font-size: 13.5px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(30rem, 1fr)); gap: 1rem 2rem; }
.note { color: #444; font-size: 13.5px; }
.stage { height: 42rem; border: 1px solid #ccc; }
pre { font: 12.5px/1.4 ui-monospace, monospace; background: #f6f6f6; padding: 1rem; overflow: auto; max-height: 40rem; }
summary { cursor: pointer; }
@media (max-width: 800px) { .stage { height: auto; } .pictures { grid-template-columns: 1fr; } }
@media print { .stage, details { display: none; } }
"""


def report(results: Results | str | Path, filename: str | Path | None = None, *, processes: int = 0) -> Path:
    """Write a page about a run: model, convergence, balances, worst contacts, pictures, and the interactive model.

    The page is self-contained and needs no network. For a run that did not converge it reports what failed and where,
    and shows the last iterate.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    filename : path, optional
        The page. Default: `STEM_report.html` beside the results.
    processes : int
        Processes that write texts and draw charts beside this one, from which they are forked: only for programs with a
        single thread.

    Returns
    -------
    Path
        The page.
    """
    return write_report(results, filename, processes, lambda: None)


def write_report(
    results: Results | str | Path, filename: str | Path | None, processes: int, load: Callable[[], None]
) -> Path:
    """As `report`; `load` loads matplotlib beside the processes that write texts."""
    results = results if isinstance(results, Results) else Results(results)
    if results.path.stem.endswith("_unconverged"):
        results = Results(results.path.with_name(results.path.name.replace("_unconverged", "")))
    path = Path(filename) if filename else results.path.with_name(f"{results.path.stem}_report.html")
    if results.path.stat().st_size > _MAX_FORKED:
        processes = 0
    with results.kept_open(), writing(path):
        path.write_text(_page(results, processes, load), encoding="utf-8")
    return path


def _page(results: Results, processes: int, load: Callable[[], None]) -> str:
    """The page as text."""
    # after an error processes may still write into it
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        texts = Path(folder, "texts.json")
        if len(results.times):
            # once, not in each process
            _ = results.contacts
        finish_texts = side_by_side.begin([(texts, partial(_write_texts, results, texts))], min(processes, 1))
        # matplotlib takes as long to load as all texts to write
        load()
        pictures = import_module(".report_pictures", __package__)
        drawn = pictures.Pictures(results, Path(folder), processes) if len(results.times) else None
        failure = _failure(results)
        if drawn:
            drawn.finish()
        finish_texts()
        title, head, tail = json.loads(texts.read_text(encoding="utf-8"))
        sections = [*head, *failure, *tail]
        deck = ["<h2>Deck</h2>", _deck(results)]
        if drawn:
            room = _MAX_PAGE - sum(map(len, [*sections, *deck]))
            sections += drawn.figures(max(_MIN_PICTURES, room))
    return page(f"{title} - litz", "\n".join([*sections, *deck]), _STYLE + viewer_style())


def _write_texts(results: Results, path: Path) -> None:
    """Write the title, and the sections without pictures before and behind those about a failure."""
    title = (results.heading.strip() or results.path.stem).splitlines()[0]
    head = [
        f"<h1>{html.escape(title)}</h1>\n<p>{html.escape(results.path.name)}, made by litz {html.escape(results.version)}</p>",
        tables.verdict(results),
        _later_run(results),
    ]
    tail = [
        *tables.run_warnings(results),
        '<div class="columns"><div><h2>Model</h2>',
        tables.model(results),
        "</div><div><h2>Balance</h2>",
        tables.balance(results),
        "</div></div>",
        "<h2>Convergence</h2>",
        tables.convergence(results),
    ]
    if len(results.times):
        tail += [*_stage(results), *tables.line_contact(results)]
        tail += ["<h2>Worst contacts</h2>", tables.worst_contacts(results)]
        tail += surfaces(results)
    path.write_text(json.dumps([title, head, tail]), encoding="utf-8")


def _later_run(results: Results) -> str:
    """What there is of a later run that ended before its first increment."""
    later = results.path.with_name(f"{results.path.stem}_unconverged.sta")
    if not later.is_file():
        return ""
    text = f"A later run ended before its first increment: {later.name}. This page is about the run before it."
    return f'<p class="verdict bad">{html.escape(text)}</p>'


def _failure(results: Results) -> list[str]:
    """What is known of the increment that was given up."""
    found = tables.failure(results)
    iterate = results.path.with_name(f"{results.path.stem}_unconverged.vtkhdf")
    if not found or not iterate.is_file():
        return found
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*did not finish")
        last = Results(iterate)
    found += ["<h3>The iterate that was given up</h3>", tables.contacts_of_iterate(last)]
    found.append(surface_contacts_of_iterate(last))
    found.append(import_module(".report_pictures", __package__).last_iterate(last))
    return found


def _stage(results: Results) -> list[str]:
    """The interactive model, with as many increments as the page can hold."""
    n = len(results.times)
    stage, picked, reduced = fitting_viewer(results, evenly_chosen(n, _MAX_INCREMENTS), _MAX_DATA)
    note = "Drag to turn, wheel to enlarge, right button to move; click a spot for its row of the contact ledger."
    if len(picked) < n or reduced:
        command = f"<code>litz view {html.escape(results.path.name)}</code>"
        note = f"{len(picked)} of {n} increments are in this page{', with fewer digits' if reduced else ''}; {command} shows all."
    return [
        f'<h2>To turn and look at</h2>\n<p class="note">{note}</p>\n<div class="stage">',
        stage,
        "</div>",
    ]


def _deck(results: Results) -> str:
    try:
        deck = results.deck
    except (KeyError, OSError) as error:
        raise FileError(f"{results.path} does not contain its deck: {error}") from None
    if len(deck) > _MAX_DECK_LENGTH:
        return f'<p class="note">The deck has {len(deck) / 1e6:.1f} MB: it is in {html.escape(results.path.name)}.</p>'
    n_lines = deck.count("\n") + 1
    if len(deck) < _SHORT_DECK:
        return f"<details><summary>{n_lines} lines</summary><pre>{html.escape(deck)}</pre></details>"
    return (
        f'<details id="litz-deck" data-deck="{zipped(deck.encode())}"><summary>{n_lines} lines</summary><pre></pre></details>\n'
        f'<script type="text/javascript">\n{_OPEN_DECK}</script>'
    )
