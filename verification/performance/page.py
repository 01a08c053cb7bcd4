"""The page of the benchmarks: tables and pictures as HTML, and the same as Markdown."""

import html
import importlib

from verification.report import STYLE, embedded


def sections(document):
    """Title, text, tables (title, columns, lines) and name of the picture of each benchmark."""
    for name, record in document["benchmarks"].items():
        module = importlib.import_module(f"verification.performance.{name}")
        title, _, text = module.__doc__.strip().partition("\n")
        loads = " and ".join(f"{load:.2f}" for load in record["load_average"])
        text = (
            f"{text.strip()}\n\n{record['machine']['time']}, {record['machine']['processor']}, {record['machine']['cores']} "
            f"cores; load of the machine before and after: {loads}; {record['seconds']:.0f} s"
            + ("; small sizes (--quick)" if record["quick"] else "")
        )
        if "failure" in record:
            yield title, f"{text}\n\nFailed: {record['failure']}", [], None
            continue
        found = [
            [wanted, value, bound, "met" if value <= bound else "MISSED"] for wanted, value, bound in record["aims"]
        ]
        aims = [("Aims", ["what", "measured", "at most", ""], found)] if found else []
        yield title, text, [*module.tables(record["values"]), *aims], f"{name}.svg"


def cell(value):
    """A value of a table: three digits of what was measured, all of a count."""
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def write_page(document, directory):
    """bench.html (self-contained) and bench.md."""
    lines = ["# Benchmarks of litz", "", document["program"]]
    parts = [
        "<!doctype html><html lang=en><meta charset=utf-8><title>Benchmarks of litz</title>",
        f"<style>{STYLE}</style><h1>Benchmarks of litz</h1><p>{html.escape(document['program'])}",
    ]
    for title, text, tables, picture in sections(document):
        lines += ["", f"## {title}", "", text]
        parts.append(f"<h2>{html.escape(title)}</h2><pre>{html.escape(text)}</pre>")
        for table, columns, rows in tables:
            lines += ["", f"{table}:", "", "| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
            lines += ["| " + " | ".join(map(cell, row)) + " |" for row in rows]
            parts.append(
                f"<h3>{html.escape(table)}</h3><table><tr>" + "".join(f"<th>{html.escape(c)}" for c in columns)
            )
            parts += ["<tr>" + "".join(f"<td>{html.escape(cell(value))}" for value in row) for row in rows]
            parts.append("</table>")
        if picture and (directory / picture).exists():
            lines += ["", f"![{title}]({picture})"]
            parts.append(f'<img alt="{html.escape(title)}" src="{embedded(directory / picture)}">')
    (directory / "bench.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (directory / "bench.html").write_text("\n".join(parts) + "\n", encoding="utf-8")
