"""Colours that pictures and the viewer share, without what draws charts, which takes long to load."""

import matplotlib as mpl
import numpy as np


def line_colours() -> mpl.colors.Colormap:
    """Colours of the force per length: without the palest part of the map, which is hard to see."""
    return mpl.colors.ListedColormap(mpl.colormaps["YlOrRd"](np.linspace(0.25, 1.0, 256)))
