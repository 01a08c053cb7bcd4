"""Zones of line contact from rows of a ledger that are written down here: which rows belong together, and where zones end."""

from types import SimpleNamespace

import numpy as np
import pytest

from litz.base.table import Table
from litz.results.contact_places import contact_places
from litz.results.contact_zones import contact_zones, wire_pairs
from litz.wires import find_wires, wire_arcs

#: Elements of 1 m with places 0.25 m apart
PARTS, SPACING = 4, 0.25
UNITS = {"m": "m", "N": "N", "A": "A", "W": "W", "ohm": "ohm"}
PER_METRE, CURRENT_PER_METRE = 3.0, 0.5


def model(*wires):
    """Results of wires along x: (number of elements, is a ring); only what is on the wires matters."""
    nodes, elements = [], []
    for n, ring in wires:
        first = len(nodes)
        # a ring of n elements is a polygon with sides of 1 m
        angle = 2 * np.pi * np.arange(n) / n
        corners = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle]) / (2 * np.sin(np.pi / n))
        line = np.column_stack([np.arange(n + 1.0), np.zeros(n + 1), np.full(n + 1, 1.0 * first)])
        nodes += list(corners if ring else line)
        elements += [(first + i, first + (i + 1) % n if ring else first + i + 1) for i in range(n)]
    nodes, elements = np.array(nodes), np.array(elements)
    found = find_wires(elements)
    return SimpleNamespace(
        wires=found, wire_arcs=wire_arcs(nodes, elements, found), element_ids=np.arange(len(elements)) + 11,
        radius=np.full(len(elements), 0.5), firsts=np.cumsum([0, *(n for n, _ in wires)])[:-1], wire_sizes=wires,
    )  # fmt: skip


def row(of, foot, place, length=SPACING / 2):
    """A row of the ledger: foot (wire, arc) and place (wire, arc); `length` 0: they cross there."""
    columns = {}
    for side, (wire, along) in (("1", foot), ("2", place)):
        n, ring = of.wire_sizes[wire]
        arc = along % n if ring else along
        # a place at a node belongs to the element before it
        element = min(max(int(np.ceil(arc - 1e-9)) - 1, 0), n - 1) if arc > 1e-9 or not ring else n - 1
        xi = 2 * (arc - element) - 1 if arc > 1e-9 or not ring else 1.0
        columns |= {f"element_{side}": of.firsts[wire] + element + 11, f"xi_{side}": xi}
    size = length or SPACING
    columns |= {
        "force": PER_METRE * size, "current": CURRENT_PER_METRE * size, "joule_heat": 2.0 * size, "resistance": 4.0, "gap": -1e-6,
        "length": length, "spacing": SPACING if length else 0.0, "x": place[1],
    }  # fmt: skip
    return columns


def ledger(rows, shuffled=True):
    """The rows as a ledger, in an order that says nothing."""
    order = np.random.default_rng(1).permutation(len(rows)) if shuffled else range(len(rows))
    rows = [rows[i] for i in order]
    columns = {name: np.array([each[name] for each in rows]) for name in rows[0]}
    columns["id"] = np.arange(len(rows)) + 1
    for name in ("point_1", "point_2", "normal"):
        columns |= {f"{name}_{axis}": columns["x"] * (axis == "x" and name != "normal") for axis in "xyz"}
    return Table(columns, {})


def places_at(begin, end):
    """Arcs of places."""
    return np.arange(begin, end + SPACING / 2, SPACING)


def side_by_side(of, first, second, begin, end, shift=0.0, sign=1):
    """Both passes of two wires that touch from `begin` to `end` of the first one, at `shift` + `sign` arc of the second."""
    rows = [row(of, (second, shift + sign * arc), (first, arc)) for arc in places_at(begin, end)]
    there = sorted([shift + sign * begin, shift + sign * end])
    low, high = np.ceil(there[0] / SPACING - 1e-9) * SPACING, np.floor(there[1] / SPACING + 1e-9) * SPACING
    return rows + [row(of, (first, (arc - shift) / sign), (second, arc)) for arc in places_at(low, high)]


def zones_of(of, rows, **options):
    places = contact_places(of, ledger(rows, **options))
    return contact_zones(places, UNITS), places


def ends(zones, wire):
    return list(zip(zones[f"arc_{wire}_begin"], zones[f"arc_{wire}_end"], strict=True))


def test_two_passes_are_one_zone_that_reaches_halfway_to_the_next_places():
    of = model((8, False), (8, False))
    zones, places = zones_of(of, side_by_side(of, 0, 1, 2.0, 5.0))
    assert zones.n_rows == 1
    assert set(places.zone) == {0}
    assert ends(zones, 1) == ends(zones, 2) == [(2.0 - SPACING / 2, 5.0 + SPACING / 2)]
    assert zones["length"] == pytest.approx([3.25], rel=1e-12)
    assert zones["places"] == [26]
    assert zones["force_per_length"] == pytest.approx([PER_METRE], rel=1e-12)
    assert zones["max_force_per_length"] == pytest.approx([PER_METRE], rel=1e-12)
    assert zones["conductance"] == pytest.approx([26 / 4.0], rel=1e-12)
    assert (zones["begin_x"], zones["end_x"]) == (2.0, 5.0)


def test_a_zone_ends_where_a_wire_ends():
    of = model((8, False), (4, False))
    zones, _ = zones_of(of, side_by_side(of, 0, 1, 2.0, 6.0, shift=-2.0))
    assert ends(zones, 2) == [(0.0, 4.0)]
    assert ends(zones, 1) == [(2.0 - SPACING / 2, 6.0 + SPACING / 2)]


def test_wires_that_run_against_each_other():
    of = model((8, False), (8, False))
    zones, _ = zones_of(of, side_by_side(of, 0, 1, 2.0, 5.0, shift=8.0, sign=-1))
    assert ends(zones, 1) == [(2.0 - SPACING / 2, 5.0 + SPACING / 2)]
    assert ends(zones, 2) == [(6.0 + SPACING / 2, 3.0 - SPACING / 2)]


def test_one_open_place_parts_two_zones():
    of = model((8, False), (8, False))
    rows = side_by_side(of, 0, 1, 1.0, 3.0) + side_by_side(of, 0, 1, 3.5, 5.0)
    zones, _ = zones_of(of, rows)
    assert ends(zones, 1) == [(1 - SPACING / 2, 3 + SPACING / 2), (3.5 - SPACING / 2, 5 + SPACING / 2)]


def test_one_pass_with_places_between_those_of_the_other_joins_them():
    of = model((8, False), (8, False))
    first = [row(of, (1, arc + 0.1), (0, arc)) for arc in (2.0, 2.25, 2.75, 3.0)]
    second = [row(of, (0, arc - 0.1), (1, arc)) for arc in (2.0, 2.25, 2.5, 2.75, 3.0)]
    assert zones_of(of, first)[0].n_rows == 2
    assert zones_of(of, first + second)[0].n_rows == 1


def test_the_second_leg_of_a_hairpin_is_a_zone_of_its_own():
    # both legs lie on the same places of the straight wire
    of = model((6, False), (20, False))
    rows = side_by_side(of, 0, 1, 1.0, 4.0) + side_by_side(of, 0, 1, 1.0, 4.0, shift=18.0, sign=-1)
    zones, _ = zones_of(of, rows)
    assert zones.n_rows == 2
    assert {tuple(np.sign(np.diff(each))) for each in ends(zones, 2)} == {(1.0,), (-1.0,)}


def test_a_crossing_alone_is_no_zone_and_one_on_the_line_belongs_to_it():
    of = model((8, False), (8, False))
    line, cross = side_by_side(of, 0, 1, 2.0, 3.0), row(of, (0, 2.6), (1, 2.6), length=0.0)
    alone = row(of, (0, 6.6), (1, 6.6), length=0.0)
    assert zones_of(of, [alone])[0].n_rows == 0
    zones, places = zones_of(of, [*line, cross, alone], shuffled=False)
    assert places.zone.tolist() == [0] * (len(line) + 1) + [-1]
    assert zones["crossings"].tolist() == [1]
    assert zones["force"] == pytest.approx([PER_METRE * (1.25 + SPACING)], rel=1e-12)


@pytest.mark.parametrize("shift", [0.0, 3.0], ids=["seams together", "seams apart"])
def test_a_zone_across_the_seam_of_rings_is_one(shift):
    of = model((8, True), (8, True))
    zones, _ = zones_of(of, side_by_side(of, 0, 1, 7.0, 9.0, shift=shift))
    assert zones.n_rows == 1
    assert ends(zones, 1)[0] == pytest.approx((7.0 - SPACING / 2, 9.0 + SPACING / 2), rel=1e-12)
    begin, end = ends(zones, 2)[0]
    assert end - begin == pytest.approx(2.25, rel=1e-12)
    assert (begin - 7.0 - shift + SPACING / 2) % 8 == pytest.approx(0.0, abs=1e-9)


def test_rings_that_touch_all_around_are_one_zone_from_zero_to_their_length():
    of = model((8, True), (8, True))
    zones, _ = zones_of(of, side_by_side(of, 0, 1, 0.25, 8.0))
    assert [ends(zones, wire)[0] for wire in (1, 2)] == [pytest.approx((0.0, 8.0), rel=1e-12)] * 2


def test_turns_of_a_coil_touch_along_one_zone_of_the_wire_with_itself():
    of = model((24, False))
    # three turns of 8 m: each place touches the turns before and after
    zones, _ = zones_of(of, side_by_side(of, 0, 0, 0.0, 16.0, shift=8.0))
    assert zones.n_rows == 1
    assert (zones["wire_1"][0], zones["wire_2"][0]) == (0, 0)
    assert ends(zones, 1) == [(0.0, 16.0 + SPACING / 2)]
    assert ends(zones, 2) == [(8.0 - SPACING / 2, 24.0)]
    assert zones["length"] == pytest.approx([16.125], rel=1e-12)


def test_a_ring_that_is_pressed_flat_touches_itself_along_one_zone():
    # arcs s and 20 - s touch: the seam lies in one fold
    of = model((20, True))
    zones, _ = zones_of(of, side_by_side(of, 0, 0, 2.0, 8.0, shift=20.0, sign=-1))
    assert zones.n_rows == 1
    assert zones["length"] == pytest.approx([6.25], rel=1e-12)
    # and where the seam lies in the middle of the zone, the order of the arcs turns there
    moved, _ = zones_of(of, side_by_side(of, 0, 0, 17.0, 23.0, shift=30.0, sign=-1))
    assert moved.n_rows == 1
    assert moved["length"] == pytest.approx([6.25], rel=1e-12)


def test_current_goes_from_the_first_to_the_second_wire():
    of = model((8, False), (8, False))
    # foot on the wire 0, then on the wire 1
    for rows, sign in (
        ([row(of, (0, arc), (1, arc)) for arc in (1.0, 1.25)], 1),
        ([row(of, (1, arc), (0, arc)) for arc in (1.0, 1.25)], -1),
    ):
        zones, _ = zones_of(of, rows)
        assert zones["current"] == pytest.approx([sign * CURRENT_PER_METRE * SPACING], rel=1e-12)
        assert zones["max_current_per_length"] == pytest.approx([CURRENT_PER_METRE], rel=1e-12)


def test_pairs_have_the_sums_of_all_rows():
    of = model((8, False), (8, False), (8, False))
    rows = [
        *side_by_side(of, 0, 1, 1.0, 2.0),
        *side_by_side(of, 0, 1, 4.0, 6.0),
        *side_by_side(of, 2, 1, 4.0, 6.0),
        row(of, (0, 7.5), (1, 7.5), length=0.0),
        row(of, (2, 7.5), (0, 7.5), length=0.0),
    ]
    table = ledger(rows)
    pairs = wire_pairs(contact_places(of, table), UNITS)
    assert list(zip(pairs["wire_1"], pairs["wire_2"], strict=True)) == [(0, 1), (0, 2), (1, 2)]
    assert pairs["zones"].tolist() == [2, 0, 1]
    assert pairs["crossings"].tolist() == [1, 1, 0]
    assert pairs["length"] == pytest.approx([1.25 + 2.25, 0.0, 2.25], rel=1e-12)
    for name in ("force", "joule_heat"):
        assert pairs[name].sum() == pytest.approx(table[name].sum(), rel=1e-12)
    assert pairs["conductance"].sum() == pytest.approx((1 / table["resistance"]).sum(), rel=1e-12)


def test_ledgers_without_line_contact_have_no_zones():
    of = model((8, False), (8, False))
    table = ledger([row(of, (0, 1.5), (1, 1.5), length=0.0)])
    older = Table({name: values for name, values in table.items() if name not in ("length", "spacing")}, {})
    for each in (table, older, table.where(np.zeros(1, dtype=bool))):
        zones = contact_zones(contact_places(of, each), UNITS)
        assert zones.n_rows == 0
        assert set(zones) >= {"arc_1_begin", "force_per_length"}
    assert wire_pairs(contact_places(of, table), UNITS)["crossings"].tolist() == [1]
