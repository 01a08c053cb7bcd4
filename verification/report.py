"""The report: one table of claims as HTML with the pictures inside, and the same as Markdown."""

import base64
import html
import platform
import subprocess
from datetime import datetime, timezone

import numpy as np

import litz
from verification.claims import PROVENANCE

_COLUMNS = (
    "claim",
    "quantity",
    "source",
    "deck",
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
    program = subprocess.run([litz.program_path(), "--version"], capture_output=True, text=True, check=False)
    missed = sum(not verdict.passed for verdict in verdicts)
    return [
        f"{len(verdicts)} claims in {len(reports)} cases: {len(verdicts) - missed} hold, {missed} missed.",
        f"{datetime.now(timezone.utc):%Y-%m-%d %H:%M} UTC, {platform.platform()}, Python {platform.python_version()}.",
        " ".join(program.stdout.split()),
        "Provenance of the reference values: "
        + "; ".join(f"{word}: {meaning}" for word, meaning in PROVENANCE.items())
        + ".",
    ]


def _cells(report, verdict):
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
        ", ".join(report.decks) or "kernels",
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
    lines = ["# Verification of litz", "", *(f"- {line}" for line in head)]
    for report in reports:
        title, _, text = report.title.partition("\n")
        lines += ["", f"## {title}", "", text.strip(), "", f"Script: `cases/{report.name}.py`, {report.seconds:.1f} s"]
        lines += ["", "| " + " | ".join(_COLUMNS) + " |", "|" + "---|" * len(_COLUMNS)]
        for verdict in report.verdicts:
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in _cells(report, verdict)) + " |")
        if report.picture:
            lines += ["", f"![{report.name}]({report.name}/{report.picture.name})"]
    return "\n".join(lines) + "\n"


def _page(head, reports):
    parts = [
        "<!doctype html><html lang=en><meta charset=utf-8><title>Verification of litz</title>",
        f"<style>{STYLE}</style><h1>Verification of litz</h1><ul>",
        *(f"<li>{html.escape(line)}" for line in head),
        "</ul>",
    ]
    for report in reports:
        title, _, text = report.title.partition("\n")
        parts.append(f'<h2 id="{report.name}">{html.escape(title)}</h2><pre>{html.escape(text.strip())}</pre>')
        parts.append(f"<p>Script <code>cases/{report.name}.py</code>, {report.seconds:.1f} s</p><table><tr>")
        parts += [f"<th>{column}" for column in _COLUMNS]
        for verdict in report.verdicts:
            parts.append("<tr>" + _row(_cells(report, verdict), verdict.passed))
        parts.append("</table>")
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
