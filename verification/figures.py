"""The look of the pictures: size, fonts and colours of a column in a journal."""

from contextlib import contextmanager

import matplotlib.pyplot as plt

#: One colour and marker for each element type
STYLES = {"B31": {"color": "#0b62a4", "marker": "o"}, "B33": {"color": "#c4451c", "marker": "s"}}
REFERENCE = {"color": "#222222", "linewidth": 1.0}

_SETTINGS = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.linewidth": 0.4,
    "grid.alpha": 0.5,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "legend.frameon": False,
    "svg.hashsalt": "litz",
}


@contextmanager
def panels(path, columns=2, rows=1, height=2.8):
    """Axes to draw on; the picture is written to `path` at the end."""
    with plt.rc_context(_SETTINGS):
        figure, axes = plt.subplots(rows, columns, figsize=(3.6 * columns, height * rows), layout="constrained")
        try:
            yield axes
            figure.savefig(path, metadata={"Date": None} if str(path).endswith(".svg") else None)
        finally:
            plt.close(figure)


def convergence(axes, numbers, errors, orders, quantity):
    """Errors over numbers of elements for each element type, with lines of the orders that are expected."""
    for element, values in errors.items():
        axes.loglog(numbers, values, label=element, **STYLES[element])
        order_line(axes, numbers, orders[element], values[0])
    axes.set(xlabel="elements", ylabel=quantity)
    axes.legend()


def order_line(axes, numbers, order, top):
    """A dashed line above the errors that falls with a power of the number of elements; plain numbers on the axis."""
    bottom, _ = axes.get_ylim()
    line = [(n, value) for n in numbers if (value := 2 * top * (numbers[0] / n) ** order) > bottom]
    axes.loglog(*zip(*line, strict=True), "--", label=f"order {order}", **REFERENCE)
    axes.set_xticks(numbers, [str(n) for n in numbers])
    axes.minorticks_off()
