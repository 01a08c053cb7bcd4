"""Loading of matplotlib for commands, which ask it for no help and draw in two dimensions."""

import sys
from importlib import import_module
from types import ModuleType
from typing import Any

_SPATIAL = "mpl_toolkits.mplot3d"


def load_matplotlib() -> None:
    """Load what draws figures, without texts for `help()` and axes of three dimensions, in half of the time.

    For programs of their own: a user's process has matplotlib as it is.
    """
    artist: Any = import_module("matplotlib.artist")
    describe = artist.kwdoc
    # matplotlib has names for axes of three dimensions only if they can be loaded
    spatial = ModuleType(_SPATIAL)
    spatial.__dict__["Axes3D"] = None
    kept = sys.modules.setdefault(_SPATIAL, spatial)
    artist.kwdoc = lambda _: ""
    try:
        import_module("matplotlib.figure")
        import_module("matplotlib.backends.backend_agg")
    finally:
        artist.kwdoc = describe
        if kept is spatial:
            del sys.modules[_SPATIAL]
