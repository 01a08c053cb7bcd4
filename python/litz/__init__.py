"""litz: finite elements for wires that touch and pass current through their contacts.

    model = litz.Model("title")              build a model of wires, run it
    deck = litz.Deck.read("deck.inp")        read a deck, change it, write it
    results = litz.run("deck.inp")           run a deck, read its results
    table = litz.sweep(model, parameters)    run a grid of parameters
    found = litz.bisect(model, "name", (low, high), reached)    find where the outcome of a run changes
    results = litz.Results("deck.vtkhdf")    read the results of an earlier run
    litz.plot(results)                       make a picture of them
    litz.report(results)                     write a page about the run
    litz.view(results)                       look at them in the browser

`litz.kernels` has the elements and contact laws one by one, `litz.closed_forms` exact solutions to compare with.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import (
    FileError,
    InputError,
    InternalError,
    LitzError,
    NotConvergedError,
    OutOfMemoryError,
    RunWarning,
    SolverError,
)
from .moved import accept_old_names

if TYPE_CHECKING:
    from .base.program import program_path
    from .runs import check, run

accept_old_names()

# Loaded on first use, so that starting the program does not wait for HDF5, VTK and numpy.
_LAZY_MODULES = ("build", "closed_forms", "hosts", "kernels", "model", "percolation", "plots", "results")
_MODEL_NAMES = (
    "COPPER",
    "Circular",
    "ClusterSpot",
    "ConstantSpot",
    "FilmSpot",
    "Friction",
    "GapConductance",
    "General",
    "Hertz",
    "HertzSpot",
    "Interaction",
    "Linear",
    "Material",
    "Model",
    "NamedBehaviour",
    "NamedSpot",
    "PaperSpot",
    "PlasticSpot",
    "SharvinSpot",
    "SILVER",
    "STEEL",
    "Superconductor",
    "TableSpot",
)
_LAZY_NAMES = {
    "Card": "deck",
    "Deck": "deck",
    "Results": "results",
    "animate": "pictures.animation",
    "bisect": "sweeps",
    "check": "runs",
    "export": "results.exports",
    "keywords": "deck.keyword_table",
    "new": "build.starters",
    "plot": "pictures.plots",
    "program_path": "base.program",
    "read_mesh": "model.read_mesh",
    "report": "reports.report",
    "run": "runs",
    "sweep": "sweeps",
    "view": "viewer.server",
    **dict.fromkeys(_MODEL_NAMES, "model"),
}

__all__ = [
    "COPPER",
    "SILVER",
    "STEEL",
    "Card",
    "Circular",
    "ClusterSpot",
    "ConstantSpot",
    "Deck",
    "FileError",
    "FilmSpot",
    "Friction",
    "GapConductance",
    "General",
    "Hertz",
    "HertzSpot",
    "InputError",
    "Interaction",
    "InternalError",
    "Linear",
    "LitzError",
    "Material",
    "Model",
    "NamedBehaviour",
    "NamedSpot",
    "NotConvergedError",
    "OutOfMemoryError",
    "PaperSpot",
    "PlasticSpot",
    "Results",
    "RunWarning",
    "SharvinSpot",
    "SolverError",
    "Superconductor",
    "TableSpot",
    "animate",
    "bisect",
    "build",
    "check",
    "closed_forms",
    "export",
    "kernels",
    "keywords",
    "model",
    "new",
    "percolation",
    "plot",
    "program_path",
    "read_mesh",
    "report",
    "run",
    "sweep",
    "view",
]


def __getattr__(name: str) -> Any:
    if name in _LAZY_MODULES:
        return import_module(f".{name}", __name__)
    if name in _LAZY_NAMES:
        return getattr(import_module(f".{_LAZY_NAMES[name]}", __name__), name)
    if name == "__version__":
        return import_module("importlib.metadata").version("litz")
    # classes for classes, functions and modules for these
    known = [one for one in __all__ if one[0].isupper() == name[0].isupper() and name[0] != "_"]
    hint = import_module(".base.names", __name__).nearest_name(name, known)
    raise AttributeError(f"module 'litz' has no attribute {name!r}{hint}")


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
