"""Colours that pictures and the viewer share, without what draws charts, which takes long to load."""

import matplotlib as mpl
import numpy as np

#: Of wires that have no value: no conducting path leads from them to a prescribed potential
NO_VALUE = "#c4c4c4"


def scalar_colours(name: str) -> mpl.colors.Colormap:
    """A colour map of matplotlib, with grey where there is no value."""
    return mpl.colormaps[name].with_extremes(bad=NO_VALUE)


def without_value(text: str) -> str:
    """What a picture says of grey wires, given the quantity that colours the others."""
    return f"grey wires: no {text.replace('_', ' ')}"


def line_colours() -> mpl.colors.Colormap:
    """Colours of the force per length: without the palest part of the map, which is hard to see."""
    return mpl.colors.ListedColormap(mpl.colormaps["YlOrRd"](np.linspace(0.25, 1.0, 256)))
