"""Charts of the contact with rigid surfaces."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..base.quantities import engineering, label
from ..results import Results
from .chart_tools import from_zero, legend_beside
from .charts import colour_of, nothing_to_draw, time_label


def surfaces(figure: Figure, results: Results, increment: int) -> None:
    """Force on each rigid surface over time, and along the wires at the increment that is shown."""
    upper, lower = figure.subplots(2, 1)
    surface_forces_over_time(upper, results, increment)
    _force_by_element(lower, results, increment)


def surface_forces_over_time(axes: Axes, results: Results, increment: int) -> None:
    """Resultant force on each rigid surface over time."""
    axes.set_title("Force on rigid surfaces")
    axes.set_xlabel(time_label(results))
    names = list(results.rigid_surfaces)
    if not names:
        nothing_to_draw(axes, "There are no rigid surfaces")
        return
    table = results.surface_forces
    size = np.linalg.norm([table[f"surface_force_{axis}"] for axis in "xyz"], axis=0)
    factor, unit = engineering(size, results.unit_labels["N"])
    for i, name in enumerate(names):
        rows = table["surface"] == name
        style = {"marker": "o", "markersize": 4} if rows.sum() <= 60 else {}
        axes.plot(table["time"][rows], factor * size[rows], **style, color=colour_of(i, len(names)), label=name)
    axes.set_ylabel(label("force", unit))
    from_zero(axes)
    legend_beside(axes)


def _force_by_element(axes: Axes, results: Results, increment: int) -> None:
    """Force of each element that touches, by its number."""
    axes.set_title("Force of each element on them, at this increment")
    axes.set_xlabel("element")
    now = results.surface_contacts_at(increment)
    if not now.n_rows:
        nothing_to_draw(axes, "No wire touches a rigid surface")
        return
    factor, unit = engineering(now["force"], results.unit_labels["N"])
    names = list(results.rigid_surfaces)
    for i, name in enumerate(names):
        rows = now["surface"] == name
        axes.plot(now["element"][rows], factor * now["force"][rows], "o", markersize=4,
                  color=colour_of(i, len(names)), label=name)  # fmt: skip
    axes.xaxis.set_major_locator(mpl.ticker.MaxNLocator(integer=True))
    axes.set_ylabel(label("force", unit))
    from_zero(axes)
