"""The floors of the Python package: who may import whom, and that nothing is imported in a circle."""

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "python" / "litz"
SOURCES = sorted(PACKAGE.rglob("*.py"))
LONGEST = 500

# What each folder may import besides itself, in the order of the data flow; modules outside of the folders stand by themselves
MAY_IMPORT = {
    "errors": set(),
    "moved": set(),
    "closed_forms": set(),
    "base": {"errors"},
    "kernels": set(),
    "wires": set(),
    "deck": {"errors", "base"},
    "results": {"errors", "base", "wires"},
    "runs": {"errors", "base", "deck", "results"},
    "model": {"errors", "base", "wires", "deck", "results", "runs"},
    "build": {"errors", "base", "kernels", "wires", "deck", "model"},
    "sweeps": {"errors", "base", "deck", "results", "runs", "model"},
    "percolation": {"build", "results"},
    "pictures": {"errors", "base", "wires", "results", "model"},
    "viewer": {"errors", "base", "wires", "results", "pictures"},
    "reports": {"errors", "base", "wires", "results", "pictures", "viewer"},
    "hosts": {"errors", "deck", "model", "runs", "kernels"},
    "commands": {"errors", "base", "results", "model", "build", "pictures", "viewer", "reports", "hosts"},
    "cli": {"errors", "base"},
    # names that are known to those who check types before they are loaded
    "__init__": {"errors", "moved", "base", "runs"},
    "__main__": {"cli"},
}
# Packages that take long to load, or that litz runs without
LOADED_WHEN_NEEDED = {
    "matplotlib",
    "mpl_toolkits",
    "pyvista",
    "vtkmodules",
    "PIL",
    "IPython",
    "networkx",
    "pandas",
    "scipy",
}


def name_of(path, package=PACKAGE):
    """The name of a module within the package: `results.network`, `results` for the file of the folder, "" for the top."""
    return ".".join(path.relative_to(package).with_suffix("").parts).removesuffix("__init__").rstrip(".")


def floor(path, package=PACKAGE):
    """The folder of a module, or the module itself where it stands outside of all folders."""
    return path.relative_to(package).with_suffix("").parts[0]


def imported(path, package=PACKAGE):
    """Modules of the package that a file imports, wherever the statement stands: at the top, in a function, for types."""
    parts = [package.name, *path.relative_to(package).parent.parts]
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = parts[: len(parts) - node.level + 1] if node.level else []
            module = ".".join([*above, *(node.module or "").split(".")]).rstrip(".")
            found |= {_module_of(module, alias.name, package) for alias in node.names}
    return {name.partition(".")[2] for name in found if name.split(".")[0] == package.name} - {"_core"}


def _module_of(module, name, package):
    """The module that `from module import name` reads: `name` itself where it is one."""
    place = package.parent.joinpath(*module.split("."), name)
    is_module = place.with_suffix(".py").exists() or (place / "__init__.py").exists() or name == "_core"
    return f"{module}.{name}" if is_module else module


def wrong_floors(path, package=PACKAGE, may_import=None):
    """What a file imports from floors that it may not."""
    allowed = (MAY_IMPORT if may_import is None else may_import)[floor(path, package)] | {floor(path, package)}
    return {name for name in imported(path, package) if (name.split(".")[0] or "__init__") not in allowed}


def circle(package=PACKAGE):
    """Modules that import each other in a circle, the first again at the end; None: there is no circle."""
    graph = {name_of(path, package): imported(path, package) for path in package.rglob("*.py")}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return error.args[1]
    return None


def hidden_imports(path):
    """Packages that are imported inside of functions, litz itself among them."""
    functions = [
        node
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef | ast.Lambda)
    ]
    statements = [node for function in functions for node in ast.walk(function)]
    found = {alias.name for node in statements if isinstance(node, ast.Import) for alias in node.names}
    found |= {"litz" if node.level else node.module or "" for node in statements if isinstance(node, ast.ImportFrom)}
    return {name.split(".")[0] for name in found}


def test_every_folder_has_a_floor():
    assert set(MAY_IMPORT) == {floor(path) for path in SOURCES}


def test_the_floors_stand_on_each_other():
    assert len(list(TopologicalSorter(MAY_IMPORT).static_order())) == len(MAY_IMPORT)


@pytest.mark.parametrize("path", SOURCES, ids=name_of)
def test_a_module_imports_its_own_floor_and_those_below_only(path):
    assert not wrong_floors(path), f"{name_of(path)} may import {sorted(MAY_IMPORT[floor(path)])}"


@pytest.mark.slow
def test_no_modules_import_each_other_in_a_circle():
    assert circle() is None


@pytest.mark.parametrize("path", SOURCES, ids=name_of)
def test_only_packages_that_are_slow_or_optional_are_imported_in_functions(path):
    assert hidden_imports(path) <= LOADED_WHEN_NEEDED


@pytest.mark.parametrize("path", SOURCES, ids=name_of)
def test_no_file_is_long(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST


class TestTheChecksFindWhatTheyLookFor:
    @pytest.fixture
    def package(self, tmp_path):
        """A package of two floors: `upper` imports `lower`."""
        package = tmp_path / "litz"
        for folder in ("lower", "upper"):
            (package / folder).mkdir(parents=True)
            (package / folder / "__init__.py").touch()
        (package / "__init__.py").touch()
        (package / "lower" / "a.py").write_text("from . import b\n")
        (package / "lower" / "b.py").write_text("import math\nfrom .. import _core\n")
        (package / "upper" / "c.py").write_text("from ..lower.a import x\nimport litz.lower.b\n")
        return package

    def test_imports_of_all_forms(self, package):
        assert imported(package / "lower" / "a.py", package) == {"lower.b"}
        assert imported(package / "lower" / "b.py", package) == set()
        assert imported(package / "upper" / "c.py", package) == {"lower.a", "lower.b"}
        assert circle(package) is None

    @pytest.mark.parametrize(
        "statement",
        [
            "from .a import y\n",
            "from litz.lower.a import y\n",
            "def late():\n    from .a import y\n",
            "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .a import y\n",
        ],
    )
    def test_a_circle(self, package, statement):
        (package / "lower" / "b.py").write_text(statement)
        assert set(circle(package)) == {"lower.a", "lower.b"}

    def test_an_import_from_the_floor_above(self, package):
        (package / "lower" / "b.py").write_text("from ..upper import c\n")
        may_import = {"lower": set(), "upper": {"lower"}}
        assert wrong_floors(package / "lower" / "b.py", package, may_import) == {"upper.c"}
        assert not wrong_floors(package / "upper" / "c.py", package, may_import)

    def test_an_import_of_the_whole_package(self, package):
        (package / "lower" / "b.py").write_text("import litz\n")
        assert wrong_floors(package / "lower" / "b.py", package, {"lower": set()}) == {""}

    def test_an_import_in_a_function(self, package):
        (package / "lower" / "b.py").write_text("def late():\n    import numpy.linalg\n    from ..upper import c\n")
        assert hidden_imports(package / "lower" / "b.py") == {"numpy", "litz"}
