"""litz: finite elements for wires that touch and pass current through their contacts.

    results = litz.run("deck.inp")           run a deck, read its results
    results = litz.Results("deck.vtkhdf")    read the results of an earlier run
    litz.plot(results)                       make a picture of them

`litz.kernels` has the elements and contact laws one by one, `litz.closed_forms` exact solutions to compare with.
"""

from importlib import import_module

from .run import (
    FileError,
    InputError,
    InternalError,
    LitzError,
    NotConvergedError,
    OutOfMemoryError,
    SolverError,
    program_path,
    run,
)

# Loaded when first asked for, so that starting the program does not wait for HDF5, VTK and numpy.
_LAZY_MODULES = ("build", "closed_forms", "kernels", "plots", "results")
_LAZY_NAMES = {"Card": "deck", "Deck": "deck", "Results": "results", "keywords": "keyword_table", "plot": "plots"}

__all__ = [
    "Card",
    "Deck",
    "FileError",
    "InputError",
    "InternalError",
    "LitzError",
    "NotConvergedError",
    "OutOfMemoryError",
    "Results",
    "SolverError",
    "build",
    "closed_forms",
    "kernels",
    "keywords",
    "plot",
    "program_path",
    "run",
]


def __getattr__(name):
    if name in _LAZY_MODULES:
        return import_module(f".{name}", __name__)
    if name in _LAZY_NAMES:
        return getattr(import_module(f".{_LAZY_NAMES[name]}", __name__), name)
    if name == "__version__":
        return import_module("importlib.metadata").version("litz")
    raise AttributeError(f"module 'litz' has no attribute {name!r}")


def __dir__():
    return sorted([*__all__, "__version__"])
