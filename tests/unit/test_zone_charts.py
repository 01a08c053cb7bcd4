"""Charts of contact along lines: which curves there are, and that all of them are seen."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from litz.pictures import zone_charts
from litz.results.contact_places import ContactPlaces

ARC = np.linspace(0.0, 0.02, 41)


def chart(monkeypatch, *zones):
    """Axes with zones: pair of wires, arcs, forces per length."""
    n = [len(arc) for _, arc, _ in zones]
    places = SimpleNamespace(
        zone=np.repeat(np.arange(len(zones)), n),
        wires=np.repeat([pair for pair, _, _ in zones], n, axis=0),
        spacing=np.full(sum(n), 5e-4),
        arc=np.concatenate([arc for _, arc, _ in zones]),
        value=np.concatenate([value for _, _, value in zones]),
    )
    places.where = lambda wanted: SimpleNamespace(**{
        name: one[wanted] for name, one in vars(places).items() if isinstance(one, np.ndarray)
    })  # fmt: skip
    monkeypatch.setattr(zone_charts, "stretch_along", lambda picked, side: SimpleNamespace(arc=picked.arc))
    monkeypatch.setattr(zone_charts, "per_length", lambda picked: {"force_per_length": picked.value})
    axes = Figure().add_subplot()
    results = SimpleNamespace(unit_labels={"N": "N", "m": "m", "A": "A", "W": "W"})
    zone_charts.along_wires(axes, results, places, "force_per_length", None)
    return axes


def curves(axes):
    """Curves by their name in the legend."""
    return {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}


def test_curves_that_coincide_are_dashed_in_the_chart_and_in_its_legend(monkeypatch):
    force = 1e3 + 1e5 * ARC
    axes = chart(monkeypatch, ((0, 1), ARC, force), ((0, 2), ARC, 1.001 * force), ((1, 2), ARC, 2 * force))
    styles = {name: line.get_linestyle() for name, line in curves(axes).items()}
    assert styles == {"1-2": "-", "1-3": "--", "2-3": "-"}
    legend = axes.get_legend()
    shown = dict(zip([text.get_text() for text in legend.get_texts()], legend.get_lines(), strict=True))
    assert {name: line.get_linestyle() for name, line in shown.items()} == styles


def test_equal_pairs_are_one_curve(monkeypatch):
    force = 1e3 + 1e5 * ARC
    zones = [((0, k), ARC, force) for k in range(1, 5)] + [((0, 5), ARC + 0.01, force)]
    assert set(curves(chart(monkeypatch, *zones))) == {"4 equal pairs: 1-2, 1-3, ... 1-5", "1-6"}


def test_zones_of_a_pair_are_one_curve_with_gaps(monkeypatch):
    first, second = ARC[:10], ARC[20:30]
    axes = chart(monkeypatch, ((0, 1), second, 2e3 + 0 * second), ((0, 1), first, 1e3 + 0 * first))
    (line,) = curves(axes).values()
    x, y = line.get_data()
    assert (np.diff(x) >= 0).all()
    assert np.isnan(y).nonzero()[0].tolist() == [10]
    # dots at both ends of both
    (dots,) = axes.collections
    ends = [1e3 * one for one in (first[0], first[-1], second[0], second[-1])]
    assert sorted(dots.get_offsets()[:, 0].tolist()) == pytest.approx(ends)


def test_the_attributes_are_those_of_places():
    assert {"zone", "wires", "spacing"} <= set(ContactPlaces.__dataclass_fields__)
