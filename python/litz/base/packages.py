"""Optional dependencies."""

from importlib import import_module
from types import ModuleType

from ..errors import FileError


def optional(package: str) -> ModuleType:
    """Import an optional dependency, or a module of it."""
    try:
        return import_module(package)
    except ImportError:
        name = package.partition(".")[0]
        raise FileError(f"this needs the Python package {name}: pip install {name}") from None
