"""Results do not depend on how the elements of a deck are numbered, in which order they stand, and which way they point.

A deck runs twice: with elements in the order and direction of their wires, and with numbers, order and directions at random.
"""

import numpy as np
import pytest
from matplotlib.figure import Figure

import litz
from litz.pictures import charts
from litz.pictures.contact_marks import spot_places
from litz.pictures.friction_charts import friction_loops
from litz.pictures.scene import SceneMaker
from litz.wires import element_curves

pytestmark = pytest.mark.filterwarnings("ignore:.*drawn with matplotlib only")

#: Both runs converge to these parts of the largest value; the tolerance of the residual is 1e-5 of the mean force
CLOSE = {"rtol": 1e-4, "atol": 1e-9}
N_LOWER, N_UPPER = 7, 6


def model_of_two_wires():
    """Two wires that cross at 70 degrees, pressed together, then rubbed, with current from one to the other."""
    model = litz.Model("two wires that rub")
    material = litz.Material("COPPER", 120e9, 0.34, 58.8e6)
    bend = np.linspace(-1, 1, N_LOWER + 1)
    lower = model.wires(
        "LOWER", [np.stack([20e-3 * bend, 2e-3 * bend**2, 0 * bend], axis=1)], radius=1e-3, material=material
    )
    across = 15e-3 * np.array([np.cos(np.radians(70)), np.sin(np.radians(70)), 0.0])
    shift = np.array([1e-3, 0, 1.8e-3 + 1e-6])
    place = np.linspace(-1, 1, N_UPPER + 1)[:, None]
    upper = model.wires("UPPER", [shift + place * across], radius=0.8e-3, material=material)
    model.contact(lower, upper, conductance=litz.HertzSpot(), friction=0.2)
    model.fix(lower.ends)
    model.fix(upper.ends, "rotations", "y")
    model.fix(lower.start, "potential")
    press = model.step(increment=0.5)
    press.move(upper.ends, "z", -20e-6)
    press.move(upper.ends, "x", 0.0)
    press.potential(upper.end, 1e-3)
    rub = model.step(increment=0.25)
    rub.move(upper.ends, "x", 60e-6)
    return model


def in_disorder(text, seed):
    """The deck with its elements in another order, under other numbers, every second one turned; new numbers by the old."""
    rng = np.random.default_rng(seed)
    deck = litz.Deck.parse(text)
    cards = deck.find("ELEMENT")
    old = [row[0] for card in cards for row in card.data]
    number = dict(zip(old, (rng.permutation(len(old)) * 7 + 5).tolist(), strict=True))
    for card in cards:
        rows = [
            [number[element], *((second, first) if element % 2 else (first, second))]
            for element, first, second in card.data
        ]
        card.data = [rows[k] for k in rng.permutation(len(rows))]
    # the upper wire comes first
    first, last = (deck.cards.index(card) for card in cards)
    deck.cards[first], deck.cards[last] = deck.cards[last], deck.cards[first]
    return deck, number


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Results of the deck in order, of that in disorder, and the new number of each element."""
    home = tmp_path_factory.mktemp("order")
    text = model_of_two_wires().to_deck()
    (home / "order.inp").write_text(text)
    deck, number = in_disorder(text, seed=4)
    deck.write(home / "disorder.inp")
    return *(litz.run(home / f"{name}.inp", output_directory=home) for name in ("order", "disorder")), number


@pytest.fixture
def ordered(runs):
    return runs[0]


@pytest.fixture
def disordered(runs):
    return runs[1]


@pytest.fixture
def rows(runs):
    """Row in the disordered results of each element of the ordered ones."""
    ordered, disordered, number = runs
    found = {element: row for row, element in enumerate(disordered.element_ids.tolist())}
    return np.array([found[number[element]] for element in ordered.element_ids.tolist()])


@pytest.fixture
def turned(ordered, disordered, rows):
    """-1 where an element points the other way in the disordered results."""
    return np.where(ordered.elements[:, 0] == disordered.elements[rows, 0], 1, -1)


@pytest.fixture
def wires(ordered, disordered):
    """Number of the lower and of the upper wire in the disordered results, and whether it begins at the other end."""
    lower = [
        int(np.ptp(ordered.nodes[wire.nodes, 2]) == 0 and ordered.nodes[wire.nodes[0], 2] == 0)
        for wire in disordered.wires
    ]
    order = [lower.index(1), lower.index(0)]
    backward = [ordered.wires[k].nodes[0] != disordered.wires[number].nodes[0] for k, number in enumerate(order)]
    return order, np.array(backward)


def test_the_deck_is_in_disorder(disordered, turned, wires):
    # the tests below would pass on decks that are alike
    assert not (np.diff(disordered.element_ids) > 0).all()
    assert {-1, 1} == set(turned)
    assert {-1, 1} == {int(sign) for wire in disordered.wires for sign in wire.signs}
    order, backward = wires
    assert order == [1, 0]
    assert backward.any()


def test_the_wires_are_the_same(ordered, disordered, rows, wires):
    for k, (number, backward) in enumerate(zip(*wires, strict=True)):
        wire = disordered.wires[number]
        way = slice(None, None, -1 if backward else 1)
        assert wire.nodes[way].tolist() == ordered.wires[k].nodes.tolist()
        assert wire.elements[way].tolist() == rows[ordered.wires[k].elements].tolist()
        ends = disordered.elements[wire.elements]
        begins = np.where(wire.signs > 0, ends[:, 0], ends[:, 1])
        assert begins.tolist() == wire.nodes[:-1].tolist()


def test_fields_belong_to_their_elements(ordered, disordered, rows, turned):
    np.testing.assert_allclose(disordered.field("displacement"), ordered.field("displacement"), rtol=1e-4, atol=1e-10)
    np.testing.assert_allclose(disordered.field("radius")[rows], ordered.field("radius"))
    for name, sign in (("joule_heat", 1), ("axial_force", 1), ("element_current", turned)):
        expected = ordered.field(name)
        found = sign * disordered.field(name)[rows]
        np.testing.assert_allclose(found, expected, atol=1e-4 * np.abs(expected).max(), err_msg=name)


def test_sets_hold_the_same_elements_and_nodes(ordered, disordered, rows):
    for name, members in ordered.element_sets.items():
        assert sorted(disordered.element_sets[name]) == sorted(rows[members]), name
    for name, members in ordered.node_sets.items():
        assert sorted(disordered.node_sets[name]) == sorted(members), name


def test_places_of_the_network(ordered, disordered, wires):
    order, backward = wires
    expected, found = ordered.contact_network(), disordered.contact_network()
    assert len(found.id) == len(expected.id) == 1
    column = [found.wires[0].tolist().index(number) for number in order]
    assert expected.wires.tolist() == [[0, 1]]
    np.testing.assert_allclose(found.wire_length[order], expected.wire_length)
    arc = np.where(backward, found.wire_length[order] - found.arc[0, column], found.arc[0, column])
    np.testing.assert_allclose(arc, expected.arc[0], rtol=1e-4)
    np.testing.assert_allclose(found.point, expected.point, atol=1e-8)
    np.testing.assert_allclose(found.wire_potential[order], expected.wire_potential, rtol=1e-4)
    first = [int(disordered.element_ids[disordered.wires[number].elements[0]]) for number in order]
    assert found.first_element[order].tolist() == first
    for name, at in expected.wires_at.items():
        assert sorted(order.index(number) for number in found.wires_at[name]) == at.tolist(), name


def test_currents_along_the_wires(ordered, disordered, wires):
    order, backward = wires
    sign = np.where(backward, -1, 1)
    for increment in range(len(ordered.times)):
        np.testing.assert_allclose(
            sign * disordered.wire_currents(increment)[order], ordered.wire_currents(increment), rtol=1e-3, atol=1e-9
        )
    assert (np.abs(ordered.wire_currents()) > 0.1).all()


def test_the_chart_of_currents(ordered, disordered, wires):
    order, backward = wires

    def heights(results):
        axes = Figure().add_subplot()
        charts.current_per_wire(axes, results, -1)
        return np.array([bar.get_height() for bar in axes.patches])

    np.testing.assert_allclose(np.where(backward, -1, 1) * heights(disordered)[order], heights(ordered), rtol=1e-3)


def test_the_current_over_the_arc_length(ordered, disordered, wires):
    def steps(results):
        axes = Figure().add_subplot()
        charts.current_along_wires(axes, results, -1)
        return [(one.get_data().values, one.get_data().edges) for one in axes.patches]

    expected, found = steps(ordered), steps(disordered)
    for k, (number, backward) in enumerate(zip(*wires, strict=True)):
        values, edges = found[number]
        if backward:
            values, edges = -values[::-1], edges[-1] - edges[::-1]
        np.testing.assert_allclose(values, expected[k][0], rtol=1e-3)
        np.testing.assert_allclose(edges, expected[k][1], rtol=1e-9, atol=1e-12)


def test_sliding_and_friction(ordered, disordered):
    (expected,), (found,) = friction_loops(ordered, [1]), friction_loops(disordered, [1])
    assert np.ptp(expected.sliding) > 10e-6
    np.testing.assert_allclose(found.sliding, expected.sliding, atol=1e-3 * np.ptp(expected.sliding))
    np.testing.assert_allclose(found.force, expected.force, atol=1e-3 * np.abs(expected.force).max())


def curves_of(results):
    displacement, rotation = results.field("displacement"), results.field("rotation")
    return element_curves(results.nodes, displacement, rotation, results.wires, len(results.elements))


def test_the_axes_of_the_elements(ordered, disordered, rows, turned):
    expected, found = curves_of(ordered), curves_of(disordered)
    for sign, one, other in ((1, expected[0], found[0][rows]), (-1, expected[1], found[1][rows])):
        same = np.where(turned[:, None, None] > 0, other, sign * other[:, ::-1])
        np.testing.assert_allclose(same, one, atol=1e-8)


def test_the_places_of_the_spots(ordered, disordered):
    expected, found = (spot_places(one, one.contacts_at(-1), curves_of(one)) for one in (ordered, disordered))
    assert len(expected.places) == 1
    np.testing.assert_allclose(found.places, expected.places, atol=1e-8)
    # which of the wires is the barred one decides the sign of the normal
    np.testing.assert_allclose(np.abs(found.normals), np.abs(expected.normals), atol=1e-4)
    np.testing.assert_allclose(found.thinner, expected.thinner)


@pytest.mark.parametrize("field", ["potential", "joule_heat"])
def test_the_scene_of_a_picture(ordered, disordered, wires, field):
    expected, found = (SceneMaker(one, [-1], field=field).scene(-1) for one in (ordered, disordered))
    for k, (number, backward) in enumerate(zip(*wires, strict=True)):
        way = slice(None, None, -1 if backward else 1)
        here = slice(found.starts[number], found.starts[number + 1])
        there = slice(expected.starts[k], expected.starts[k + 1])
        np.testing.assert_allclose(found.points[here][way], expected.points[there], atol=1e-8)
        if field == "potential":
            # a value of elements jumps at the nodes, where either side counts
            np.testing.assert_allclose(found.value[here][way], expected.value[there], rtol=1e-4, atol=1e-7)
        else:
            assert found.value[here].max() == pytest.approx(expected.value[there].max(), rel=1e-3)
        np.testing.assert_allclose(found.radius[here], expected.radius[there][0])
