"""Lines that the tests run, of Fortran and of Python: two percentages, the worst files, and a page to look at.

`./setup coverage` calls it after the tests.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
#: Share of the lines that the tests have to run [%]
LEAST = 90.0
#: Files of each language that are shown, those with most lines left out first
WORST = 12

PAGE = """<!DOCTYPE html>
<meta charset="utf-8">
<title>litz: lines that the tests run</title>
<h1>Lines that the tests run</h1>
<p><a href="fortran/index.html">Fortran: {Fortran:.1f} %</a>
<p><a href="python/index.html">Python: {Python:.1f} %</a>
"""


class File(NamedTuple):
    """A source file: its lines, and how many of them were run."""

    name: str
    lines: int
    run: int


def percentage(files):
    """Share of the lines that were run [%]; nothing measured counts as nothing run."""
    lines = sum(file.lines for file in files)
    return 100 * sum(file.run for file in files) / lines if lines else 0.0


def measure_fortran(build, directory):
    """Lines of the sources in `fortran`, from the counters that the programs have left in the build folder."""
    directory.mkdir(parents=True, exist_ok=True)
    summary = directory / "summary.json"
    command = [sys.executable, "-m", "gcovr", "--root", str(ROOT), "--object-directory", str(build)]
    command += ["--filter", str(ROOT / "fortran") + "/", "--gcov-ignore-parse-errors=suspicious_hits.warn"]
    command += ["--html-details", str(directory / "index.html"), "--json-summary", str(summary), str(build)]
    subprocess.run(command, check=True, cwd=ROOT)
    files = json.loads(summary.read_text(encoding="utf-8"))["files"]
    return [File(file["filename"], file["line_total"], file["line_covered"]) for file in files]


def measure_python(directory):
    """Lines of the package, from the data of all processes of the tests."""
    summary = directory / "summary.json"
    for task in (["combine", "-q"], ["html", "-q", "-d", str(directory)], ["json", "-q", "-o", str(summary)]):
        subprocess.run([sys.executable, "-m", "coverage", *task], check=True, cwd=ROOT)
    files = json.loads(summary.read_text(encoding="utf-8"))["files"]
    totals = {name: file["summary"] for name, file in files.items()}
    return [File(name, total["num_statements"], total["covered_lines"]) for name, total in totals.items()]


def report(languages):
    """Text of the report and the languages whose share is too small; `languages` has the files of each."""
    text, missed = [], []
    for language, files in languages.items():
        share = percentage(files)
        text.append(f"{language}: {share:.1f} % of {sum(file.lines for file in files)} lines")
        left_out = sorted(files, key=lambda file: file.run - file.lines)[:WORST]
        text += [f"   {file.lines - file.run:5d} of {file.lines:4d} not run   {file.name}" for file in left_out]
        if share < LEAST:
            missed.append(language)
            text.append(f"   {language} is below {LEAST:g} %")
    return "\n".join(text), missed


def main():
    """Measure, write the pages, print the report; exit code 1 when a share is too small."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path, help="build folder with the counters of the Fortran sources")
    parser.add_argument("directory", type=Path, help="where the pages go")
    arguments = parser.parse_args()
    languages = {
        "Fortran": measure_fortran(arguments.build, arguments.directory / "fortran"),
        "Python": measure_python(arguments.directory / "python"),
    }
    shares = {language: percentage(files) for language, files in languages.items()}
    (arguments.directory / "index.html").write_text(PAGE.format(**shares), encoding="utf-8")
    text, missed = report(languages)
    print(text)
    print(f"page: {arguments.directory / 'index.html'}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
