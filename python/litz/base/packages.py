"""Packages that litz does not depend on."""

from importlib import import_module
from types import ModuleType

from ..errors import FileError


def optional(package: str) -> ModuleType:
    """A package that litz does not depend on."""
    try:
        return import_module(package)
    except ImportError:
        raise FileError(f"this needs the Python package {package}: pip install {package}") from None
