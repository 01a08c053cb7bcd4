"""What the system tests share: the decks in inputs/, each run once."""

import html
import importlib
import subprocess
import warnings
from pathlib import Path

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
def run_of_input(litz_program, tmp_path_factory):
    """`run_of_input("01_crossed_wires")` is the directory with the results of a deck, which is run only once."""
    directories = {}

    def run(name):
        if name not in directories:
            directory = tmp_path_factory.mktemp(name)
            done = subprocess.run(
                [litz_program, "run", INPUTS / f"{name}.inp", "-o", directory],
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
            )
            assert done.returncode == 0, done.stdout + done.stderr
            directories[name] = directory
        return directories[name]

    return run


@pytest.fixture(scope="session")
def report_of_grid(run_of_input, tmp_path_factory):
    """The page of a report about the grid, with nothing beside it."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*drawn with matplotlib only")
        return litz_package.report(run_of_input("04_wire_grid"), tmp_path_factory.mktemp("report") / "grid.html")


@pytest.fixture
def reports_without_pictures(monkeypatch):
    """In place of its pictures, which take most of its time, a report has the texts below them."""

    def figure(results, kind, folder, text, **options):
        return f"<figure>{html.escape(text)}</figure>"

    monkeypatch.setattr(importlib.import_module("litz.reports.report"), "_figure", figure)


@pytest.fixture(scope="session")
def changed_sources(tmp_path_factory):
    """A copy of the sources with what newcomers add by the documents."""
    return make_changed_sources(tmp_path_factory.mktemp("changed_sources"))


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
