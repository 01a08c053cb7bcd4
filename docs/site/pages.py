"""What pages of the site are made of besides their text: the version, the claims, the lexer of decks, MathJax."""

import re
import shutil
import sys
from pathlib import Path
from typing import ClassVar

from pygments.lexer import RegexLexer
from pygments.token import Comment, Keyword, Name, Number, Operator, Text
from sphinx.util.docutils import SphinxDirective

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "python")]


def declared_version():
    """The version that meson.build states."""
    return re.search(r"version: '([^']+)'", (ROOT / "meson.build").read_text(encoding="utf-8"))[1]


class DeckLexer(RegexLexer):
    """Decks in the language of Abaqus."""

    name = "Abaqus deck"
    aliases = ("inp",)
    tokens: ClassVar = {
        "root": [
            (r"^\*\*.*$", Comment),
            (r"^\*[A-Za-z][^,\n]*", Keyword),
            (r"(?<=,)\s*[A-Za-z][\w \-]*(?==)", Name.Attribute),
            (r"[-+]?(\d+\.?\d*|\.\d+)([eEdD][-+]?\d+)?", Number),
            (r"[=,]", Operator),
            (r"[^\S\n]+|\n", Text),
            (r"[^\s,=]+", Name),
        ]
    }


def claims_table():
    """The claims of verification/claims.toml as Markdown: one section for each case."""
    from verification.claims import read_claims

    lines, case = [], None
    for claim in read_claims():
        if claim.script != case:
            case = claim.script
            lines += ["", f"### {case}", "", f"Source: {plain(claim.source)}.", ""]
            lines += ["| quantity | reference | tolerance | why this tolerance |", "|---|---|---|---|"]
        what = f"{plain(claim.title)}: {plain(claim.quantity)}" + (f" [{claim.unit}]" if claim.unit.strip("-") else "")
        what += "" if claim.verifies else " (two runs are compared with each other)"
        lines.append(
            f"| {what} | {reference(claim)} | {claim.tolerance:g} ({claim.comparison}) | {plain(claim.reason)} |"
        )
    return "\n".join(lines)


def plain(words):
    """Words that Markdown leaves as they are."""
    return re.sub(r"([\\*_|<>\[\]`$])", r"\\\1", str(words)).rstrip(".")


def reference(claim):
    """The reference value; of a long list its ends."""
    if not isinstance(claim.reference, list):
        return plain(claim.reference)
    shown = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in claim.reference]
    return ", ".join(shown if len(shown) <= 4 else [*shown[:2], "...", shown[-1]])


class Claims(SphinxDirective):
    """`{claims}`: the list of claims."""

    def run(self):
        self.env.note_dependency(str(ROOT / "verification" / "claims.toml"))
        return self.parse_text_to_nodes(claims_table(), allow_section_headings=True)


class LatestReport(SphinxDirective):
    """`{latest-report}`: where the measured values are, when this machine has measured them."""

    def run(self):
        report = ROOT / "results" / "verification" / "report.html"
        if not report.is_file():
            text = "No results were there when this page was made: run `./setup verify`, then `./setup docs` again."
        else:
            target = Path(self.env.app.outdir) / "verification_report.html"
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(report, target)
            link = '<a href="verification_report.html">The latest report</a>'
            text = f"```{{raw}} html\n<p>{link}: measured values beside the claims, with pictures.</p>\n```"
        return self.parse_text_to_nodes(text)


def copy_mathjax(app, error):
    if error is None:
        for file in app.config.mathjax_files:
            shutil.copyfile(file, Path(app.outdir) / "_static" / file.name)


def setup(app):
    app.add_config_value("mathjax_files", [], "")
    app.add_lexer("inp", DeckLexer)
    app.add_directive("claims", Claims)
    app.add_directive("latest-report", LatestReport)
    app.connect("build-finished", copy_mathjax)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
