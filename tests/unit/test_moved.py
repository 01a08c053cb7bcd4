"""Names of modules that litz 0.1 had, which this version still accepts."""

import sys
from importlib import import_module

import pytest

import litz

OLD_AND_NEW = [
    ("litz.meshes", "Mesh", "litz.model.mesh"),
    ("litz.meshes", "read_mesh", "litz.model.read_mesh"),
    ("litz.network", "ContactNetwork", "litz.results.network"),
    ("litz.plots", "plot", "litz.pictures.plots"),
    ("litz.run_warnings", "WarningEntry", "litz.errors"),
    ("litz.scalars", "scalars", "litz.results.scalars"),
    ("litz.tables", "Table", "litz.base.table"),
]


@pytest.mark.parametrize(("old", "name", "new"), OLD_AND_NEW)
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_an_old_name_means_what_is_now_elsewhere(old, name, new):
    assert getattr(import_module(old), name) is getattr(import_module(new), name)


def test_an_old_name_warns_and_says_the_new_one(monkeypatch):
    monkeypatch.delitem(sys.modules, "litz.scalars", raising=False)
    with pytest.warns(DeprecationWarning, match=r"litz\.scalars is litz\.results\.scalars now"):
        import_module("litz.scalars")


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_an_old_module_has_no_more_than_the_new_one():
    assert not hasattr(import_module("litz.tables"), "no_such_name")


def test_a_module_that_never_was_is_not_found():
    with pytest.raises(ModuleNotFoundError, match=r"litz\.no_such_module"):
        import_module("litz.no_such_module")


def test_folders_do_not_take_the_names_of_functions():
    for name in ("check", "export", "new", "plot", "report", "run", "sweep", "view"):
        assert callable(getattr(litz, name)), name
        import_module(getattr(litz, name).__module__)
        assert callable(getattr(litz, name)), name


@pytest.mark.parametrize(
    ("name", "meant"), [("Modelle", "Model"), ("modelle", "model"), ("closed_form", "closed_forms")]
)
def test_a_misspelt_name_of_the_package_is_answered_by_a_similar_one(name, meant):
    with pytest.raises(AttributeError, match=rf"module 'litz' has no attribute '{name}'; did you mean '{meant}'\?"):
        getattr(litz, name)
