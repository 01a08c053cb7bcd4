"""Charts of the residuals over the iterations."""

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..base.quantities import engineering, label
from ..base.table import Table
from ..results import Results
from .chart_tools import legend_beside
from .charts import MAX_LINES, Colour, colour_of, gradient, nothing_to_draw, number_log_axis
from .margins import bar_beside

# Sizes of the marks of iterations, and of an allowed value that is alone [points]
_MARK, _DASH = 4.0, 14.0


def residuals(figure: Figure, results: Results, increment: int) -> None:
    """A chart for each field of the equilibrium that has a residual."""
    table = results.convergence
    names = [name for name in residual_names(table) if table[name].any()] or ["force"]
    all_axes = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(all_axes, names, strict=True):
        residual_lines(axes, table, name)
    all_axes[-1].set_xlabel("iteration")
    _name_increments(all_axes, table)


def residual_of_last_increment(axes: Axes, results: Results, increment: int) -> None:
    """All fields over their allowed values, for the increment that is shown."""
    table = results.convergence
    one = table.where(
        (table["step"] == results.steps[increment]) & (table["increment"] == results.increments[increment])
    )
    axes.set_title("Convergence of this increment")
    if not one.n_rows:
        nothing_to_draw(axes, "No iterations are recorded")
        return
    one = one.where(one["attempt"] == one["attempt"].max())
    names = residual_names(one)
    if not any(one[name].any() for name in names):
        nothing_to_draw(axes, "No residual was above zero")
        return
    for i, name in enumerate(names):
        allowed = one[f"{name}_allowed"]
        ratio = np.divide(one[name], allowed, out=np.zeros(one.n_rows), where=allowed > 0)
        if ratio.any():
            axes.semilogy(
                one["iteration"],
                np.where(ratio > 0, ratio, np.nan),
                "o-",
                markersize=4,
                color=colour_of(i, len(names)),
                label=name,
            )
    axes.axhline(1.0, color="#888888", linestyle="--", linewidth=1.0)
    axes.annotate(
        "allowed",
        (1.0, 1.0),
        xycoords=("axes fraction", "data"),
        ha="right",
        va="bottom",
        color="#666666",
        fontsize="small",
    )
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    number_log_axis(axes.yaxis)
    axes.set_xlabel("iteration")
    axes.set_ylabel("residual / allowed")
    legend_beside(axes)


def residual_names(table: Table) -> list[str]:
    """Residuals of the fields in a table of iterations: the columns that have an allowed value."""
    return [name.removesuffix("_allowed") for name in table if name.endswith("_allowed")]


def residual_lines(axes: Axes, table: Table, name: str) -> None:
    """Residual norm of one field: a line for each try of each increment, its allowed value dashed in its colour."""
    tries = np.stack([table["step"], table["increment"], table["attempt"]], axis=1)
    distinct = np.unique(tries, axis=0)
    colours = gradient()(np.linspace(0.0, 1.0, len(distinct)))
    last_attempt = {(step, increment): attempt for step, increment, attempt in distinct}
    columns = np.stack([table["iteration"], table[name], table[f"{name}_allowed"]], axis=1).astype(float)
    columns[columns[:, 1] <= 0, 1] = np.nan
    columns[columns[:, 2] <= 0, 2] = np.nan
    drawn = [
        _Try(
            columns[np.all(tries == one, axis=1)],
            colour,
            failed=one[2] < last_attempt[one[0], one[1]],
            text=f"{one[0]}.{one[1]}" + (f", try {one[2]}" if last_attempt[one[0], one[1]] > 1 else ""),
        )
        for one, colour in zip(distinct, colours, strict=True)
    ]
    axes.set_yscale("log")
    (_draw_few if len(drawn) <= MAX_LINES else _draw_many)(axes, drawn)
    axes.set_title(f"{name.capitalize()} residual, dashed: allowed")
    axes.set_ylabel(label("norm", engineering(np.zeros(1), table.units[name])[1]))
    number_log_axis(axes.yaxis)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))


@dataclass(frozen=True)
class _Try:
    """Iterations of a try of an increment: number, norm, allowed value (n, 3)."""

    rows: np.ndarray
    colour: Colour
    failed: bool
    text: str

    @property
    def allowed_alone(self) -> bool:
        """A single value makes no line."""
        return bool(np.isfinite(self.rows[:, 2]).sum() == 1)


def _draw_few(axes: Axes, tries: list[_Try]) -> None:
    for one in tries:
        iteration, size, allowed = one.rows.T
        style = {"linestyle": ":", "marker": "x"} if one.failed else {"linestyle": "-", "marker": "o"}
        axes.plot(iteration, size, markersize=_MARK, linewidth=1.3, color=one.colour, label=one.text, **style)
        dash = "_" if one.allowed_alone else None
        axes.plot(iteration, allowed, "--", color=one.colour, linewidth=0.9, alpha=0.8, marker=dash, markersize=_DASH)


def _draw_many(axes: Axes, tries: list[_Try]) -> None:
    """As of few, in collections: each line by itself takes matplotlib a millisecond."""
    colours = np.array([one.colour for one in tries])
    styles = [":" if one.failed else "-" for one in tries]
    norms, allowed = ([one.rows[:, [0, column]] for one in tries] for column in (1, 2))
    axes.add_collection(LineCollection(norms, colors=colours, linewidths=1.3, linestyles=styles), autolim=False)
    axes.add_collection(
        LineCollection(allowed, colors=colours, linewidths=0.9, linestyles="--", alpha=0.8), autolim=False
    )
    for marker, points, size, wanted in (
        ("o", norms, _MARK, [not one.failed for one in tries]),
        ("x", norms, _MARK, [one.failed for one in tries]),
        ("_", allowed, _DASH, [one.allowed_alone for one in tries]),
    ):
        shown = [row for row, want in enumerate(wanted) if want]
        if shown:
            places = np.concatenate([points[row] for row in shown])
            of_points = np.repeat(colours[shown], [len(points[row]) for row in shown], axis=0)
            kept = np.isfinite(places[:, 1])
            axes.scatter(*places[kept].T, s=size**2, c=of_points[kept], marker=marker, linewidths=1.0, zorder=2)
    places = np.concatenate([*norms, *allowed])
    axes.update_datalim(places[np.isfinite(places[:, 1])])
    axes.autoscale_view()


def _name_increments(all_axes: np.ndarray, table: Table) -> None:
    """One legend for all charts of residuals, or a colour bar where the lines are many."""
    handles, _ = all_axes[0].get_legend_handles_labels()
    if handles:
        all_axes[0].legend(title="step.increment", loc="upper left", bbox_to_anchor=(1.0, 1.0))
        return
    n = len(np.unique(np.stack([table["step"], table["increment"], table["attempt"]], axis=1), axis=0))
    bar = bar_beside(all_axes, mpl.cm.ScalarMappable(mpl.colors.Normalize(1, n), gradient()))
    bar.locator = MaxNLocator(integer=True)
    bar.set_label("tries of increments, in the order of the run")
