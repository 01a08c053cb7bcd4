"""The report: one table of claims as HTML with the pictures inside, and the same as Markdown."""

import base64
import html
import platform
import subprocess
from datetime import datetime, timezone

import numpy as np

import litz
from verification.claims import PROVENANCE, read_claims

_COLUMNS = (
    "claim",
    "quantity",
    "source",
    "reference",
    "litz",
    "difference",
    "tolerance",
    "why this tolerance",
    "verdict",
)

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 95em; padding: 0 1em; color: #222; }
table { border-collapse: collapse; font-size: 13px; margin: 1em 0; }
th, td { border-bottom: 1px solid #ddd; padding: .35em .6em; text-align: left; vertical-align: top; }
th { background: #f3f3f3; }
td.number { font-family: ui-monospace, monospace; white-space: pre-line; }
.pass { color: #176b2c; } .miss { color: #b00020; font-weight: bold; }
.wide { overflow-x: auto; } code { overflow-wrap: anywhere; }
img { max-width: 100%; } pre { white-space: pre-wrap; font: inherit; }
"""


def write_reports(reports, directory):
    """report.html (self-contained) and report.md."""
    head = _head(reports)
    (directory / "report.md").write_text(_markdown(head, reports), encoding="utf-8")
    (directory / "report.html").write_text(_page(head, reports), encoding="utf-8")


def _head(reports):
    """Lines that say what was run, where, and how it went."""
    verdicts = [verdict for report in reports for verdict in report.verdicts]
    all_claims = len(read_claims())
    rest = f" The other {all_claims - len(verdicts)} of {all_claims} claims were not asked for."
    program = subprocess.run([litz.program_path(), "--version"], capture_output=True, text=True, check=False)
    missed = sum(not verdict.passed for verdict in verdicts)
    with_itself = sum(not verdict.claim.verifies for verdict in verdicts)
    return [
        f"{len(verdicts)} claims in {len(reports)} cases: {len(verdicts) - missed} hold, {missed} missed."
        + (rest if len(verdicts) < all_claims else ""),
        f"{len(verdicts) - with_itself} compare litz with other sources, {with_itself} with itself (CONSISTENCY).",
        f"{datetime.now(timezone.utc):%Y-%m-%d %H:%M} UTC, {platform.platform()}, Python {platform.python_version()}.",
        " ".join(program.stdout.split()),
        "Provenance of the reference values: "
        + "; ".join(f"{word}: {meaning}" for word, meaning in PROVENANCE.items())
        + ".",
    ]


def _summary(report):
    """A line about a case: title, claims that hold, and how much of its tolerance the closest call has used."""
    title = report.title.partition("\n")[0]
    held = sum(verdict.passed for verdict in report.verdicts)
    used = [
        verdict.difference / verdict.claim.tolerance
        for verdict in report.verdicts
        if verdict.value is not None and verdict.claim.tolerance > 0 and verdict.claim.comparison != "at_most"
    ]
    return report.name, title, f"{held} of {len(report.verdicts)}", f"{max(used):.0%}" if used else "-"


_SUMMARY = ("case", "what", "claims that hold", "largest part of a tolerance that is used")


def _measured_by(report):
    """Script and decks of a case."""
    decks = f"; decks {', '.join(report.decks)}" if report.decks else "; kernels alone"
    return f"cases/{report.name}.py{decks}; {report.seconds:.1f} s"


def _cells(verdict):
    claim = verdict.claim
    # what others need is a remark beside a bound, not a number that is compared
    is_bound = claim.comparison == "at_most"
    tolerance = {
        "relative": f"{claim.tolerance:.3g} relative",
        "absolute": f"{claim.tolerance:.3g} {claim.unit.strip('-')}".strip(),
        "at_most": f"at most {claim.tolerance:g}",
    }[claim.comparison]
    return (
        f"{claim.title} ({claim.id})",
        f"{claim.quantity} [{claim.unit}]" if claim.unit else claim.quantity,
        f"{claim.source} [{claim.provenance}]",
        number(claim.reference),
        verdict.remark or number(verdict.value),
        "-" if is_bound or verdict.value is None else f"{verdict.difference:.2e}",
        tolerance,
        claim.reason,
        "pass" if verdict.passed else "MISS",
    )


def number(value):
    """A number, or a list of them, with as many digits as matter."""
    if isinstance(value, str):
        return value
    if np.ndim(value) > 0:
        return ", ".join(number(item) for item in value)
    return f"{value:d}" if isinstance(value, (int, np.integer)) else f"{value:.9g}"


def _markdown(head, reports):
    lines = ["# Verification of litz", "", *(f"- {line}" for line in head), ""]
    lines += [_markdown_row(_SUMMARY), "|" + "---|" * len(_SUMMARY)]
    lines += [_markdown_row(_summary(report)) for report in reports]
    for report in reports:
        title, _, text = report.title.partition("\n")
        lines += ["", f"## {title}", "", text.strip(), "", f"Measured by {_measured_by(report)}."]
        lines += ["", _markdown_row(_COLUMNS), "|" + "---|" * len(_COLUMNS)]
        lines += [_markdown_row(_cells(verdict)) for verdict in report.verdicts]
        if report.picture:
            lines += ["", f"![{report.name}]({report.name}/{report.picture.name})"]
    return "\n".join(lines) + "\n"


def _markdown_row(cells):
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _page(head, reports):
    parts = [
        "<!doctype html><html lang=en><meta charset=utf-8><title>Verification of litz</title>",
        f"<style>{STYLE}</style><h1>Verification of litz</h1><ul>",
        *(f"<li>{html.escape(line)}" for line in head),
        "</ul><div class=wide><table><tr>",
        *(f"<th>{column}" for column in _SUMMARY),
    ]
    for name, title, held, used in map(_summary, reports):
        parts.append(f'<tr><td><a href="#{name}">{name}</a><td>{html.escape(title)}<td>{held}<td>{used}')
    parts.append("</table></div>")
    for report in reports:
        title, _, text = report.title.partition("\n")
        parts.append(f'<h2 id="{report.name}">{html.escape(title)}</h2><pre>{html.escape(text.strip())}</pre>')
        parts.append(f"<p>Measured by <code>{_measured_by(report)}</code></p><div class=wide><table><tr>")
        parts += [f"<th>{column}" for column in _COLUMNS]
        for verdict in report.verdicts:
            parts.append("<tr>" + _row(_cells(verdict), verdict.passed))
        parts.append("</table></div>")
        if report.picture:
            parts.append(f'<img alt="{report.name}" src="{embedded(report.picture)}">')
    return "\n".join(parts) + "\n"


def _row(cells, passed):
    row = []
    for column, cell in zip(_COLUMNS, cells, strict=True):
        style, text = "", cell
        if column in ("reference", "litz", "difference", "tolerance"):
            style, text = ' class="number"', cell.replace(", ", "\n")
        elif column == "verdict":
            style = f' class="{"pass" if passed else "miss"}"'
        row.append(f"<td{style}>{html.escape(text)}")
    return "".join(row)


def embedded(picture):
    """A picture as a data URL."""
    kind = {".svg": "image/svg+xml", ".png": "image/png"}[picture.suffix]
    return f"data:{kind};base64,{base64.b64encode(picture.read_bytes()).decode('ascii')}"
