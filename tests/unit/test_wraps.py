"""Tapes around the bundles of a cable: what current passes through them, and between which strands they lie."""

import math

import numpy as np
import pytest

from litz import build
from litz.model import COPPER, ConstantSpot, FilmSpot, Hertz, HertzSpot, Interaction, TableSpot

STEEL = {"thickness": 0.1e-3, "resistivity": 5.3e-7}
OXIDE = Interaction(conductance=FilmSpot(1e-11))
ROPE = {"radius": 0.41e-3, "lay_lengths": [20e-3, 40e-3], "length": 5e-3}


def plate_between_strips(half_width, thickness, cells):
    """Conductance per length and resistivity of a plate between two opposite strips: Laplace's equation on a square grid.

    Half of the plate beside the middle of the strips, down to its middle plane, which has the mean potential; far beside the
    strips nothing flows. The edges of the strips make the error of first order in the distance of nodes.
    """
    sparse, linalg = pytest.importorskip("scipy.sparse"), pytest.importorskip("scipy.sparse.linalg")
    deep = cells
    wide = round((half_width + 1.5 * thickness) / (thickness / 2) * cells)
    covered = half_width / (thickness / 2) * cells
    assert abs(covered - round(covered)) < 1e-9, "the edge of the strip is a node"
    number = np.arange((deep + 1) * (wide + 1)).reshape(deep + 1, wide + 1)
    along = np.ones((deep + 1, wide))
    along[[0, -1]] = 0.5
    down = np.ones((deep, wide + 1))
    down[:, [0, -1]] = 0.5
    first = np.concatenate([number[:, :-1].ravel(), number[:-1].ravel()])
    second = np.concatenate([number[:, 1:].ravel(), number[1:].ravel()])
    weight = np.concatenate([along.ravel(), down.ravel()])
    n = number.size
    k = sparse.coo_matrix((weight, (first, second)), shape=(n, n))
    k = (k + k.T).tocsr()
    k = sparse.diags(np.asarray(k.sum(axis=1)).ravel()) - k
    potential = np.zeros(n)
    strip = number[0, : round(covered) + 1]
    potential[strip] = 1.0
    free = np.setdiff1d(np.arange(n), np.concatenate([strip, number[-1]]))
    potential[free] = linalg.spsolve(k[free][:, free].tocsc(), -(k @ potential)[free])
    return (potential @ (k @ potential)) * 2 / 2  # both halves beside the middle, both above each other


@pytest.mark.parametrize("part", [0.125, 0.5, 2.0])
def test_a_tape_conducts_as_a_plate_between_strips(part):
    """Against finite differences of Laplace's equation; extrapolated to fine grids they are exact to 1e-3."""
    thickness = STEEL["thickness"]
    half_width = part * thickness / 2
    coarse, fine = (plate_between_strips(half_width, thickness, cells) for cells in (32, 64))
    expected = (2 * fine - coarse) / STEEL["resistivity"]
    assert build.Wrap(**STEEL).through(half_width, 1) == pytest.approx(expected, rel=2e-3)
    twice = build.Wrap(STEEL["thickness"] / 2, STEEL["resistivity"])
    assert twice.through(half_width, 2) == pytest.approx(build.Wrap(**STEEL).through(half_width, 1), rel=1e-14)


def test_wide_and_narrow_strips_have_their_limits():
    wrap = build.Wrap(**STEEL)
    wide, narrow = 1000 * wrap.thickness, 1e-4 * wrap.thickness
    # a wide strip conducts as a plate does, and by 2 ln(2)/pi of the conductivity more at its two edges
    straight = 2 * wide / wrap.thickness + 2 * math.log(2) / math.pi
    assert wrap.through(wide, 1) * wrap.resistivity == pytest.approx(straight, rel=1e-12)
    # a narrow strip resists as a wire of half of its half width in the middle of a plate, by images; twice
    assert 1 / wrap.through(narrow, 1) / wrap.resistivity == pytest.approx(
        2 / math.pi * math.log(4 * wrap.thickness / (math.pi * narrow)), rel=1e-6
    )
    below, above = (wrap.through(factor * 36 / math.pi * wrap.thickness, 1) for factor in (1 - 1e-9, 1 + 1e-9))
    assert below == pytest.approx(above, rel=1e-8)


def test_films_on_the_tape_are_in_series_on_both_sides():
    bare, filmed = build.Wrap(**STEEL), build.Wrap(**STEEL, film=2e-11)
    assert 1 / filmed.through(1e-5, 2) == pytest.approx(1 / bare.through(1e-5, 2) + 2 * 2e-11 / 2e-5, rel=1e-14)


def test_what_is_covered_is_a_mean_of_places():
    """Half of each bundle covered: a quarter of the places without a tape, half with one, a quarter with two."""
    force, radius, compliance = 3e3, 0.41e-3, (1 - 0.34**2) / 120e9
    wrap = build.Wrap(**STEEL, cover=0.5)
    bare = math.sqrt(4 * force * radius / 2 * 2 * compliance / math.pi)  # K. L. Johnson, (4.43)
    strip = math.sqrt(4 * force * radius * (compliance + (1 - 0.3**2) / 200e9) / math.pi)
    expected = 0.25 * 2 * bare / 1e-11 + 0.5 * wrap.through(strip, 1) + 0.25 * wrap.through(strip, 2)
    assert wrap.between(force, radius, compliance, 1e-11) == pytest.approx(expected, rel=1e-14)
    whole = build.Wrap(**STEEL).between(force, radius, compliance, 0.0)
    assert whole == pytest.approx(wrap.through(strip, 2), rel=1e-14)


def test_bundles_of_a_cable_touch_through_a_table():
    wrap = build.Wrap(**STEEL, cover=0.5)
    model = build.cable([[3], [3]], **ROPE, interaction=OXIDE, wrap=wrap)
    deck = model.to_deck()
    assert deck.count("*CONTACT PAIR") == 4
    assert deck.index("INTERACTION=TOUCH") < deck.index("INTERACTION=WRAP"), "the last pair of the same wires holds"
    for pair in ("BUNDLE1, BUNDLE2", "BUNDLE1, BUNDLE3", "BUNDLE2, BUNDLE3"):
        assert pair in deck
    table = next(pair.interaction for pair in model.contacts if pair.interaction.name == "WRAP").conductance
    assert isinstance(table, TableSpot)
    assert table.per_length
    # between its rows, three a decade, a table is a power law
    forces = np.sqrt(np.multiply(table.force[1:], table.force[:-1]))
    between = np.sqrt(np.multiply(table.resistance[1:], table.resistance[:-1]))
    compliance = (1 - COPPER.poisson**2) / COPPER.young
    exact = [1 / wrap.between(force, ROPE["radius"], compliance, 1e-11) for force in forces]
    np.testing.assert_allclose(between, exact, rtol=5e-3)


def test_laws_between_bundles_may_be_given():
    measured = Interaction(conductance=ConstantSpot(1e-6, per_length=True))
    model = build.cable([[3], [2]], **ROPE, interaction=OXIDE, wrap=measured)
    assert [pair.interaction.name for pair in model.contacts] == ["TOUCH", "WRAP"]
    assert model.contacts[-1].interaction.conductance == measured.conductance


@pytest.mark.parametrize(
    ("stages", "options", "message"),
    [
        ([[3]], {"lay_lengths": [20e-3]}, "two or more"),
        ([[3], [2]], {"interaction": Interaction(conductance=HertzSpot())}, "cover of 1"),
        ([[3], [2]], {"interaction": Interaction(behaviour=Hertz(yield_stress=1e8))}, "elastic strands"),
    ],
)
def test_what_a_wrap_needs_is_said(stages, options, message):
    plan = {**ROPE, "interaction": OXIDE, **options}
    with pytest.raises(ValueError, match=message):
        build.cable(stages, **plan, wrap=build.Wrap(**STEEL, cover=0.5))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"thickness": 0.0}, "thickness of a wrap must be greater than 0, not 0"),
        ({"resistivity": -1.0}, "resistivity"),
        ({"resistivity": math.nan}, "resistivity"),
        ({"cover": 0.0}, "at most 1, not 0"),
        ({"cover": 1.2}, "at most 1, not 1.2"),
        ({"film": -1e-12}, "film"),
        ({"young": 0.0}, "young"),
        ({"poisson": 0.6}, "poisson"),
    ],
)
def test_a_wrap_out_of_range_is_an_error(given, message):
    with pytest.raises(ValueError, match=message):
        build.Wrap(**{**STEEL, **given})
