"""What the system tests share: the decks in inputs/, each run once."""

import html
import importlib
import re
import shutil
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest

import litz as litz_package
from litz import Results
from new_things import make_changed_sources

INPUTS = Path(__file__).parents[2] / "inputs"


@pytest.fixture(scope="session")
def inputs():
    """The directory of the decks."""
    return INPUTS


@pytest.fixture(scope="session")
def run_of_input(litz_program, made_once, tmp_path_factory):
    """`run_of_input("01_crossed_wires")` is a directory with the results of a deck, which is run only once.

    Each process of the tests has a copy of its own, in which it may write.
    """
    directories = {}

    def run(name):
        def make(directory):
            done = subprocess.run(
                [litz_program, "run", INPUTS / f"{name}.inp", "-o", directory],
                capture_output=True,
                text=True,
                timeout=1800,
                check=False,
            )
            assert done.returncode == 0, done.stdout + done.stderr

        if name not in directories:
            directories[name] = shutil.copytree(
                made_once(name, make), tmp_path_factory.mktemp(name), dirs_exist_ok=True
            )
        return directories[name]

    return run


@pytest.fixture
def results_of(run_of_input):
    """`results_of("01_crossed_wires")` are the results of a deck."""
    return lambda name: Results(run_of_input(name))


@pytest.fixture
def header(inputs):
    """`header("01_crossed_wires")` has the rows of numbers under Expect in the head of a deck."""

    def rows(name):
        comments = re.findall(r"^\*\*(.*)$", (inputs / f"{name}.inp").read_text(encoding="utf-8"), re.MULTILINE)
        start = next(i for i, line in enumerate(comments) if line.startswith(" Expect"))
        numbers = []
        for line in comments[start + 1 :]:
            words = line.replace(" x ", " ").split()
            if words and all(re.fullmatch(r"[-+.\deE]+", word) for word in words):
                numbers.append([float(word) for word in words])
        return np.array(numbers)

    return rows


@pytest.fixture(scope="session")
def report_of_grid(run_of_input, made_once):
    """The page of a report about the grid, with nothing beside it."""

    def make(folder):
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message=".*drawn with matplotlib only")
            litz_package.report(run_of_input("04_wire_grid"), folder / "grid.html")

    return made_once("report", make) / "grid.html"


@pytest.fixture
def reports_without_pictures(monkeypatch):
    """In place of its pictures, which take most of its time, a report has the texts below them."""

    report = importlib.import_module("litz.reports.report_pictures")
    monkeypatch.setattr(report, "plot", lambda results, kind, filename, **options: filename)
    monkeypatch.setattr(report, "begin_wires", lambda results, fields, paths, size: lambda: None)
    monkeypatch.setattr(report, "_make_smaller", lambda pictures, room: None)
    monkeypatch.setattr(report, "_figure", lambda picture, text: f"<figure>{html.escape(text)}</figure>")


@pytest.fixture(scope="module")
def changed_sources(made_once, alone):
    """A copy of the sources with what newcomers add by the documents, for the tests of one file at a time."""
    folder = made_once("changed_sources", make_changed_sources)
    with alone("build of changed sources"):
        yield folder / "litz"


@pytest.fixture
def run(litz, tmp_path):
    """Run a deck given as text; return the finished process and, where there are files, the results."""

    def run_text(text, *arguments, name="deck", env=None):
        deck = tmp_path / f"{name}.inp"
        deck.write_text(text)
        process = litz("run", deck, "-o", tmp_path / name, *arguments, env=env)
        path = tmp_path / name / f"{name}.vtkhdf"
        return process, Results(path) if path.exists() else None

    return run_text
