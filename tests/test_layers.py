"""The floors of the Fortran sources: who may use whom."""

import functools
import re
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

SOURCES = sorted((Path(__file__).parents[1] / "fortran").rglob("*.f90"))
FORTRAN = Path(__file__).parents[1] / "fortran"

# What each folder may use besides itself
MAY_USE = {
    "base": set(),
    "laws": {"base"},
    "kernels": {"base", "laws"},
    "model": {"base", "laws"},
    "deck": {"base", "laws", "model"},
    "solvers": {"base"},
    "terms": {"base", "kernels", "model", "solvers"},
    "contact": {"base", "laws", "kernels", "model", "solvers", "terms"},
    "solution": {"base", "laws", "kernels", "model", "solvers", "terms", "contact"},
    "output": {"base", "model", "solvers", "solution"},
    "restart": {"base", "laws", "model", "terms", "contact", "solution"},
    "interfaces": {"base", "laws", "kernels"},
    "main": {"base", "model", "deck", "solvers", "solution", "output", "restart"},
}


def floor(path):
    """The folder of a source file; the program itself, outside all folders, is the top floor."""
    relative = path.relative_to(FORTRAN)
    return relative.parts[0] if len(relative.parts) > 1 else "main"


@functools.cache
def used_modules(path):
    """Modules of litz that a source file uses."""
    statement = re.compile(r"^\s*use\b(?:\s*,\s*\w+\s*)?(?:\s*::)?\s*(litz_\w+)", re.IGNORECASE | re.MULTILINE)
    return {name.lower() for name in statement.findall(path.read_text(encoding="utf-8"))}


@functools.cache
def defined_modules(path):
    """Modules that a source file defines."""
    statement = re.compile(
        r"^\s*module\s+(?!procedure\b|function\b|subroutine\b)(\w+)\s*$", re.IGNORECASE | re.MULTILINE
    )
    return {name.lower() for name in statement.findall(path.read_text(encoding="utf-8"))}


@functools.cache
def home_of_modules():
    """The floor of each module; the version module is made from a template."""
    homes = {name: floor(path) for path in SOURCES for name in defined_modules(path)}
    return homes | {"litz_version": "base"}


def test_the_statements_are_recognised():
    # the tests below would pass on empty sets
    assert "litz_kinds" in used_modules(FORTRAN / "base" / "rotations.f90")
    assert defined_modules(FORTRAN / "base" / "rotations.f90") == {"litz_rotations"}
    assert set(MAY_USE) == {floor(path) for path in SOURCES}


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(FORTRAN)))
def test_a_file_uses_its_own_floor_and_those_below_only(path):
    homes = home_of_modules()
    allowed = MAY_USE[floor(path)] | {floor(path)}
    wrong = {name: homes[name] for name in used_modules(path) if homes[name] not in allowed}
    assert not wrong, f"{path.name} on the floor {floor(path)!r} uses {wrong}; allowed floors: {sorted(allowed)}"


def test_no_modules_use_each_other_in_a_circle():
    graph = {name: used_modules(path) for path in SOURCES for name in defined_modules(path)}
    order = list(TopologicalSorter(graph).static_order())
    assert len(order) >= len(graph)


@pytest.mark.parametrize(
    "path",
    [path for path in SOURCES if floor(path) != "interfaces" and path.name != "main.f90"],
    ids=lambda path: str(path.relative_to(FORTRAN)),
)
def test_a_file_holds_the_one_module_of_its_name(path):
    assert defined_modules(path) == {f"litz_{path.stem}"}


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(FORTRAN)))
def test_every_source_is_built(path):
    # a file that no meson.build names is dead
    folders = {"main": [FORTRAN], "interfaces": [FORTRAN, FORTRAN.parent / "python", FORTRAN.parent / "tests"]}
    recipes = folders.get(floor(path), [FORTRAN / path.relative_to(FORTRAN).parts[0]])
    text = "".join((folder / "meson.build").read_text(encoding="utf-8") for folder in recipes)
    assert re.search(rf"\b{path.name}'", text)


def test_names_of_results_are_said_once():
    # files, ledger, history and restart follow the lists of one module
    home = FORTRAN / "model" / "result_quantities.f90"
    words = {path: set(re.findall(r"'([a-z_0-9]+)'", path.read_text(encoding="utf-8"))) for path in SOURCES}
    names = {name for name in words[home] if "_" in name}
    assert {"current_density", "semi_major", "slip_path"} <= names
    # the memory of a contact point has values of the same names
    others = [path for path in SOURCES if floor(path) in {"solution", "output", "restart", "main"}]
    repeated = {path.name: names & words[path] for path in others if path.name != "restart_points.f90"}
    assert not any(repeated.values()), repeated
