"""Optional dependencies."""

from importlib import import_module
from types import ModuleType

from ..errors import FileError


def optional(package: str) -> ModuleType:
    """Import an optional dependency."""
    try:
        return import_module(package)
    except ImportError:
        raise FileError(f"this needs the Python package {package}: pip install {package}") from None
