"""Modules under the names that they had before version 0.2."""

import sys
import warnings
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

_NEW_NAMES = {
    "litz.meshes": "litz.model.read_mesh",
    "litz.network": "litz.results.network",
    "litz.plots": "litz.pictures.plots",
    "litz.run_warnings": "litz.errors",
    "litz.scalars": "litz.results.scalars",
    "litz.tables": "litz.base.table",
}


class _Forwarder(Loader):
    """Fills a module of an old name: it looks everything up in the one of the new name."""

    def exec_module(self, module: ModuleType) -> None:
        new = import_module(_NEW_NAMES[module.__name__])

        def __getattr__(name: str) -> Any:
            return getattr(new, name)

        module.__dict__["__getattr__"] = __getattr__


class _Finder(MetaPathFinder):
    """Finds the old names."""

    def find_spec(self, name: str, *_: object) -> ModuleSpec | None:
        if name not in _NEW_NAMES:
            return None
        message = f"{name} is {_NEW_NAMES[name]} now; the old name will be removed in the next version"
        warnings.warn(message, DeprecationWarning, stacklevel=2)
        return ModuleSpec(name, _Forwarder())


def accept_old_names() -> None:
    """Let old names of modules be imported, with a warning."""
    sys.meta_path.append(_Finder())
