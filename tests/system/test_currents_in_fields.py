"""Forces of a given magnetic field on the currents that are computed: *LORENTZ against closed forms."""

import numpy as np
import pytest

import litz
from decks import crossed, straight, wire
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH, SIGMA = 120e9, 0.5e-3, 0.1, 5e7
AREA = np.pi * RADIUS**2
EI = YOUNG * np.pi * RADIUS**4 / 4
CURRENT, FIELD = 2.0, 0.05


def bar(
    cards, held="1, ENCASTRE\n 9, 2, 3", points=None, element="B33", closed=False, static="1, 1, 1e-3, 1", material=""
):
    """A copper wire along x, or through points, in one step with these cards."""
    points = straight((0, 0, 0), (LENGTH, 0, 0), 8) if points is None else points
    return (
        wire("WIRE", points, element=element, closed=closed)
        + f"*MATERIAL, NAME=COPPER\n*ELASTIC\n {YOUNG}, 0\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n{material}"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n*BOUNDARY\n {held}\n"
        f"*STEP, INC=100\n*STATIC\n {static}\n{cards}\n*NODE PRINT, NSET=WIRE, TOTALS=ONLY\n RF\n*ENERGY PRINT\n*END STEP\n"
    )


def finished(run, deck, *arguments):
    process, results = run(deck, *arguments)
    assert process.returncode == 0, process.stderr
    return results


def fed(node, current=CURRENT):
    return f"*BOUNDARY\n 1, 9\n*CECURRENT\n {node}, , {-current}\n"


COUPLINGS = pytest.mark.parametrize(
    "solver",
    ["*SOLVER, NAME=BLOCK, COUPLING=UPDATED\n", "", "*SOLVER, NAME=UMFPACK\n"],
    ids=["turns", "full", "UMFPACK"],
)


@COUPLINGS
@pytest.mark.parametrize("element", ["B31", "B33"])
def test_a_straight_wire_is_a_beam_under_i_b(run, element, solver):
    """I t x B: a current along x in a field along z pulls along -y; both supports carry I B L together."""
    held = "1, 1, 5\n 9, 2, 3"
    results = finished(run, bar(fed(9) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}\n{solver}", held=held, element=element))
    load = CURRENT * FIELD
    np.testing.assert_allclose(results.field("line_load"), [[0, -load, 0]] * 8, atol=1e-3 * load)
    np.testing.assert_allclose(results.field("reaction_force")[[0, 8], 1], load * LENGTH / 2, rtol=1e-6)
    sag = -5 * load * LENGTH**4 / (384 * EI)
    # eight elements with one point each bend a little too easily
    assert results.field("displacement")[4, 1] == pytest.approx(sag, rel=1e-4 if element == "B33" else 0.03)


def test_the_work_of_the_field_is_in_the_balance_of_energy(run):
    """The current and the field grow together, so that the load goes with the square of time."""
    cards = fed(9) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}"
    results = finished(run, bar(cards, held="1, 1, 5\n 9, 2, 3", static="0.25, 1, 1e-3, 0.25"))
    assert results.field("line_load", None)[1:, 0, 1] == pytest.approx(
        -CURRENT * FIELD * np.array([1, 4, 9, 16]) / 16, rel=1e-3
    )
    # q u/2, with u the mean deflection q L^4/(120 EI)
    work = (CURRENT * FIELD) ** 2 * LENGTH**5 / (240 * EI)
    assert results.history["ALLWK"][-1] == pytest.approx(work, rel=1e-3)
    assert np.abs(results.history["ETOTAL"]).max() < 1e-6 * work


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_a_loop_in_a_uniform_field_is_pulled_along_itself_and_nowhere_else(run, element):
    """No net force whatever its shape; N = I B r in a circle across the field."""
    n, radius = 48, 0.02
    angles = 2 * np.pi * np.arange(n + 1) / n
    points = radius * np.c_[np.cos(angles), np.sin(angles), 0 * angles]
    # its ends meet, where the current enters and leaves
    held = "1, 1, 6\n 49, 1, 6"
    cards = fed(49) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}"
    results = finished(run, bar(cards, held=held, points=points, element=element))
    np.testing.assert_allclose(results.field("axial_force"), CURRENT * FIELD * radius, rtol=0.02)
    assert np.abs(results.field("reaction_force").sum(axis=0)).max() < 1e-7 * CURRENT * FIELD * radius


def test_a_loop_in_a_field_that_changes_feels_its_moment_times_the_gradient(run):
    """F = grad(m . B), and the torque m x B: of a stiff circle, m = I A n, A that of its polygon."""
    n, radius = 24, 0.02
    angles = 2 * np.pi * np.arange(n + 1) / n
    points = radius * np.c_[np.cos(angles), np.sin(angles), 0 * angles] + [0.1, -0.2, 0.3]
    gradient = np.array([[3.0, -1.0, 2.0], [4.0, 1.0, -2.0], [5.0, 0.5, -4.0]])
    row = ", ".join(f"{x}" for x in gradient.T.ravel())
    cards = fed(n + 1) + f"*LORENTZ\n WIRE, 0.1, 0.2, {FIELD}, {row}"
    deck = bar(cards, held=f"1, 1, 6\n {n + 1}, 1, 6", points=points, element="B31").replace(str(YOUNG), "1e13")
    results = finished(run, deck)
    moment = CURRENT * n / 2 * radius**2 * np.sin(2 * np.pi / n) * np.array([0, 0, 1])
    np.testing.assert_allclose(-results.field("reaction_force").sum(axis=0), gradient.T @ moment, rtol=1e-4, atol=1e-6)
    reaction, torque = results.field("reaction_force"), results.field("reaction_moment").sum(axis=0)
    centre = np.array([0.1, -0.2, 0.3])
    torque = torque + np.cross(results.positions(-1) - centre, reaction).sum(axis=0)
    field = np.array([0.1, 0.2, FIELD]) + gradient @ centre
    np.testing.assert_allclose(-torque, np.cross(moment, field), rtol=1e-4, atol=1e-7)


def test_contacts_pass_the_current_that_the_field_pulls(run):
    """Two crossing wires: the reaction is that of the currents found, whose contact the field itself changes."""
    cards = "*LORENTZ\n WIRES, 0.02, 0.03, 0.01"
    both = [finished(run, crossed(extra=cards + solver)) for solver in ("", "\n*SOLVER, NAME=BLOCK, COUPLING=UPDATED")]
    current, total = both[0].field("element_current"), np.zeros(3)
    points, b = both[0].positions(-1), np.array([0.02, 0.03, 0.01])
    # of each wire, elements between neighbours
    for first, i in zip([*range(5), *range(6, 11)], current, strict=True):
        total += np.cross(i * (points[first + 1] - points[first]), b)
    np.testing.assert_allclose(both[0].field("reaction_force").sum(axis=0), -total, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(both[0].field("displacement"), both[1].field("displacement"), atol=1e-12)


def test_a_run_in_a_field_goes_on_from_everywhere(litz, tmp_path):
    cards = fed(9) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}, 0, 1, 0, 1, 0, 0, 0, 0, 0\n{KEEP_ALL}"
    assert_goes_on_from_everywhere(litz, tmp_path, bar(cards, held="1, 1, 5\n 9, 2, 3", static="0.25, 1, 1e-3, 0.25"))


def test_a_field_has_no_divergence(litz, tmp_path):
    (tmp_path / "bad.inp").write_text(bar(fed(9) + "*LORENTZ\n WIRE, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1"))
    done = litz("check", "bad.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert "dBx/dx + dBy/dy + dBz/dz must be zero; found 3" in done.stderr


PLACES = np.array([0.0, 0.03, 0.05, 0.2])
FIELDS = np.array([[0, 0.1, 0.2], [0, 0.1, 0.5], [0, -0.3, 0.1], [0, 0.0, 0.7]])


def table(places=PLACES, fields=FIELDS, along="X", name="WIRE"):
    rows = [f" {name}, {', '.join(map(str, field))}, {place}" for place, field in zip(places, fields, strict=True)]
    return "\n".join([f"*LORENTZ, ALONG={along}", *rows]) + "\n"


def wire_with_current():
    """The model and its step."""
    model = litz.Model("a wire in a field")
    wire = model.wire("WIRE", (0, 0, 0), (LENGTH, 0, 0), radius=RADIUS, material=litz.COPPER, elements=8)
    model.fix(wire)
    model.fix(wire.start, "potential")
    step = model.step()
    step.current(wire.end, -CURRENT)
    return model, step


class TestFieldAtPlaces:
    """A wire along x, 8 elements of 12.5 mm."""

    MIDDLES = (np.arange(8) + 0.5) * LENGTH / 8

    def test_the_field_is_linear_from_place_to_place(self, run):
        """The load of an element is I t x B in its middle."""
        results = finished(run, bar(fed(9) + table(), held="WIRE, 1, 6"))
        there = np.array([np.interp(self.MIDDLES, PLACES, FIELDS[:, i]) for i in range(3)])
        expected = CURRENT * np.array([0 * there[0], -there[2], there[1]]).T
        np.testing.assert_allclose(results.field("line_load"), expected, rtol=1e-9, atol=1e-12)

    def test_a_table_is_lines_with_derivatives_by_hand(self, run):
        """Each element has the field of the two places about its middle."""
        lines = []
        for number, middle in enumerate(self.MIDDLES, start=1):
            k = np.searchsorted(PLACES, middle) - 1
            slope = (FIELDS[k + 1] - FIELDS[k]) / (PLACES[k + 1] - PLACES[k])
            lines.append(f" {number}, " + ", ".join(map(str, [*(FIELDS[k] - slope * PLACES[k]), *slope])))
        by_hand = finished(run, bar(fed(9) + "*LORENTZ\n" + "\n".join(lines)))
        at_places = finished(run, bar(fed(9) + table()))
        for name in ("line_load", "displacement", "reaction_force"):
            assert np.allclose(at_places.field(name), by_hand.field(name), rtol=1e-9, atol=1e-15), name

    def test_a_middle_at_a_place_belongs_to_one_stretch_alone(self, run):
        places = [self.MIDDLES[0], self.MIDDLES[3], self.MIDDLES[7]]
        results = finished(run, bar(fed(9) + table(places, FIELDS[:3]), held="WIRE, 1, 6"))
        expected = -CURRENT * np.interp(self.MIDDLES, places, FIELDS[:3, 2])
        np.testing.assert_allclose(results.field("line_load")[:, 1], expected, rtol=1e-9)

    def test_tables_and_fields_add_up(self, run):
        cards = fed(9) + table() + "*LORENTZ\n WIRE, 0, 0, 1\n" + table(PLACES, -FIELDS)
        results = finished(run, bar(cards, held="WIRE, 1, 6"))
        np.testing.assert_allclose(results.field("line_load"), [[0, -CURRENT, 0]] * 8, rtol=1e-9, atol=1e-12)

    def test_it_follows_an_amplitude(self, run):
        amplitude = "*AMPLITUDE, NAME=UPDOWN\n 0, 0, 0.5, 2, 1, 0.5\n"
        deck = bar(fed(9) + table().replace("ALONG=X", "ALONG=X, AMPLITUDE=UPDOWN"), held="WIRE, 1, 6")
        deck = deck.replace("*MATERIAL", amplitude + "*MATERIAL", 1)
        loads = finished(run, deck).field("line_load")[:, 1]
        whole = np.interp(self.MIDDLES, PLACES, FIELDS[:, 2])
        np.testing.assert_allclose(loads, -CURRENT * 0.5 * whole, rtol=1e-9)

    def test_tables_from_python_add_up(self, tmp_path):
        model, step = wire_with_current()
        for factor in (1, 0.5):
            step.lorentz("WIRE", factor * FIELDS, along="x", places=PLACES)
        loads = model.run(tmp_path).field("line_load")[:, 1]
        np.testing.assert_allclose(loads, -1.5 * CURRENT * np.interp(self.MIDDLES, PLACES, FIELDS[:, 2]), rtol=1e-9)

    def test_from_python(self, tmp_path):
        model, step = wire_with_current()
        step.lorentz("WIRE", FIELDS, along="x", places=PLACES)
        loads = model.run(tmp_path).field("line_load")[:, 1]
        np.testing.assert_allclose(loads, -CURRENT * np.interp(self.MIDDLES, PLACES, FIELDS[:, 2]), rtol=1e-9)
        for options, message in (
            ({"along": "x"}, "needs both"),
            ({"along": "x", "places": PLACES[:3]}, "need a field of shape"),
            ({"along": "x", "places": PLACES, "gradient": np.zeros((3, 3))}, "no gradient"),
        ):
            with pytest.raises(ValueError, match=message):
                step.lorentz("WIRE", FIELDS, **options)
        with pytest.raises(ValueError, match="ALONG"):
            step.lorentz("WIRE", FIELDS, along="r", places=PLACES)

    @pytest.mark.parametrize(
        ("cards", "line", "message"),
        [
            (table(PLACES[1:], FIELDS[1:]), 1, "element 1 has its middle at X = 0.00625, before the first place"),
            (table(PLACES[:3], FIELDS[:3]), 3, "element 8 has its middle at X = 0.09375, behind the last place"),
            (table(PLACES[:1], FIELDS[:1]), 1, "needs two places or more"),
            (table(PLACES[[0, 2, 1, 3]]), 3, "have to rise from line to line; found 0.03 behind 0.05"),
            (table(PLACES, FIELDS + np.outer([0, 1, 0, 0], [1, 0, 0])), 2, "component Bx stays as it is"),
            (table().replace(", 0.03\n", "\n"), 2, "place"),
            (table().replace(", 0.03\n", ", 0.03, 7\n"), 2, "too many values"),
            (table(along="R"), 0, "ALONG"),
            (table(name="NOTHING"), 1, "NOTHING"),
        ],
        ids=["before", "behind", "one", "falls", "divergence", "no place", "derivative", "axis", "set"],
    )
    def test_errors(self, litz, tmp_path, cards, line, message):
        deck = bar(fed(9) + cards)
        (tmp_path / "deck.inp").write_text(deck)
        done = litz("check", "deck.inp", cwd=tmp_path)
        assert done.returncode == 1
        assert message.lower() in done.stderr.lower(), done.stderr
        number = deck[: deck.index("*LORENTZ")].count("\n") + 1 + line
        assert f"deck.inp:{number}:" in done.stderr, done.stderr


X, Y = np.array([-0.01, 0.02, 0.05, 0.12]), np.array([-0.02, 0.03, 0.09])
SLANTED = {"from": (0.0, 0.01, 0.03), "to": (0.08, 0.07, -0.02)}


def around_a_current(x, y):
    """Field of a current along z at (0.05, -0.3), beside a quadrupole: strong enough that a map of it is no plane."""
    dx, dy = x - 0.05, y + 0.3
    return np.stack(
        [0.3 + 2 * y - 0.1 * dy / (dx**2 + dy**2), 2 * x + 0.1 * dx / (dx**2 + dy**2), 0.2 + x * y], axis=-1
    )


def bilinear(map_of_field, first, second, at):
    """The field of a map at places (n, 2), one axis after the other."""
    along = np.array([[np.interp(at[:, 1], second, row[:, k]) for row in map_of_field] for k in range(3)])
    return np.array([[np.interp(u, first, column) for u, column in zip(at[:, 0], of.T, strict=True)] for of in along]).T


def plane_table(along, first, second, field, name="WIRE"):
    rows = [
        f" {name}, {', '.join(map(repr, field[i, j].tolist()))}, {first[i]!r}, {second[j]!r}"
        for j in range(len(second))
        for i in range(len(first))
    ]
    return f"*LORENTZ, ALONG={along}\n" + "\n".join(rows).replace("np.float64(", "").replace(")", "") + "\n"


def slanted(cards, held="WIRE, 1, 6"):
    return bar(fed(9) + cards, held=held, points=np.linspace(SLANTED["from"], SLANTED["to"], 9))


class TestFieldOverAPlane:
    """A slanted wire of 8 elements, in a field that is given over x and y."""

    NODES = np.linspace(SLANTED["from"], SLANTED["to"], 9)
    MIDDLES = (NODES[1:] + NODES[:-1]) / 2
    TANGENT = (NODES[-1] - NODES[0]) / np.linalg.norm(NODES[-1] - NODES[0])
    FIELD = around_a_current(*np.meshgrid(X, Y, indexing="ij"))

    def expected(self, field):
        return CURRENT * np.cross(self.TANGENT, field)

    def test_the_field_in_the_middle_of_an_element_is_bilinear(self, run):
        results = finished(run, slanted(plane_table("XY", X, Y, self.FIELD)))
        there = bilinear(self.FIELD, X, Y, self.MIDDLES[:, :2])
        np.testing.assert_allclose(results.field("line_load"), self.expected(there), rtol=1e-8, atol=1e-10)

    def test_a_map_of_a_linear_field_is_that_field(self, run):
        """Forces along the elements and the motion, which depend on the derivatives."""
        linear = np.stack(
            np.broadcast_arrays(0.3 + 2 * Y[None], 2 * X[:, None], 0.1 + X[:, None] - 3 * Y[None]), axis=-1
        )
        as_map = finished(run, slanted(plane_table("XY", X, Y, linear), held="1, 1, 6\n 9, 1, 3"))
        by_hand = "*LORENTZ\n WIRE, 0.3, 0, 0.1, 0, 2, 1, 2, 0, -3\n"
        exact = finished(run, slanted(by_hand, held="1, 1, 6\n 9, 1, 3"))
        for name in ("line_load", "displacement", "reaction_force"):
            scale = np.abs(exact.field(name)).max()
            np.testing.assert_allclose(as_map.field(name), exact.field(name), rtol=1e-9, atol=1e-9 * scale)

    @pytest.mark.parametrize("plane", ["XZ", "YZ"])
    def test_other_planes(self, run, plane):
        """The same field, with the axes of the map in other places."""
        k = ["XYZ".index(axis) for axis in plane]
        places = [np.array([-0.03, 0.03, 0.1]), np.array([-0.05, 0.0, 0.04])]
        field = np.zeros((3, 3, 3))
        field[..., k[0]], field[..., k[1]] = places[1][None] ** 2, places[0][:, None] ** 2
        results = finished(run, slanted(plane_table(plane, *places, field)))
        there = bilinear(field, *places, self.MIDDLES[:, k])
        np.testing.assert_allclose(results.field("line_load"), self.expected(there), rtol=1e-8, atol=1e-10)

    def test_lines_in_any_order_and_tables_that_add_up(self, run):
        head, *lines = plane_table("XY", X, Y, self.FIELD).splitlines()
        twice = "\n".join([head, *lines[::-1], "*LORENTZ", " WIRE, 0, 0, 1", head, *lines])
        results = finished(run, slanted(twice + "\n"))
        there = 2 * bilinear(self.FIELD, X, Y, self.MIDDLES[:, :2]) + [0, 0, 1]
        np.testing.assert_allclose(results.field("line_load"), self.expected(there), rtol=1e-8, atol=1e-10)

    def test_a_table_for_each_set_on_one_card(self, run):
        head, *lines = plane_table("XY", X, Y, self.FIELD, name="1").splitlines()
        others = [line.replace(" 1,", " 8,", 1) for line in lines]
        results = finished(run, slanted("\n".join([head, *lines, *others]) + "\n"))
        there = bilinear(self.FIELD, X, Y, self.MIDDLES[:, :2])
        there[1:7] = 0
        np.testing.assert_allclose(results.field("line_load"), self.expected(there), rtol=1e-8, atol=1e-10)

    def test_from_python(self, tmp_path):
        model, step = wire_with_current()
        y, z = np.array([-0.01, 0.02]), np.array([-0.01, 0.03])
        field = np.zeros((2, 2, 3))
        field[..., 2] = y[:, None]
        step.lorentz("WIRE", 1 + field, along="yz", places=(y, z))
        np.testing.assert_allclose(model.run(tmp_path).field("line_load"), [[0, -CURRENT, CURRENT]] * 8, atol=1e-9)
        for options, message in (
            ({"along": "yz", "places": y}, "the places along each of both axes"),
            ({"along": "yz", "places": (y, PLACES)}, r"need a field of shape \(2, 4, 3\), not \(2, 2, 3\)"),
        ):
            with pytest.raises(ValueError, match=message):
                step.lorentz("WIRE", field, **options)

    @pytest.mark.parametrize(
        ("cards", "line", "message"),
        [
            (plane_table("XY", X[1:], Y, FIELD[1:]), 1, "element 1 has its middle at X = 0.005, Y = 0.01375, outside of"),
            (plane_table("XY", X[:2], Y, FIELD[:2]), 1, "element 3 has its middle at X = 0.025"),
            (plane_table("XY", X, Y[:1], FIELD[:, :1]), 1, "two places or more along each axis; along Y there is one"),
            (plane_table("XY", X, Y, FIELD).rstrip().rpartition("\n")[0] + "\n", 4,
             "4 times 3 places; 11 lines follow, at X = 0.12 there are 2"),
            (plane_table("XY", X, Y, FIELD) + plane_table("XY", X, Y, FIELD).splitlines()[3] + "\n", 13, "is given twice"),
            (plane_table("XY", X, Y, FIELD[..., [1, 0, 2]]), 2, "no divergence"),
            ("*LORENTZ, ALONG=XY\n WIRE, 0, 0, 1, 0\n", 1, "second place"),
            (plane_table("YX", X, Y, FIELD), 0, "ALONG"),
        ],
        ids=["before", "behind", "one", "missing", "twice", "divergence", "no place", "axes"],
    )  # fmt: skip
    def test_errors(self, litz, tmp_path, cards, line, message):
        deck = slanted(cards)
        (tmp_path / "deck.inp").write_text(deck)
        done = litz("check", "deck.inp", cwd=tmp_path)
        assert done.returncode == 1
        assert message.lower() in done.stderr.lower(), done.stderr
        assert done.stderr.count("error:") == 1
        if line:
            number = deck[: deck.index("*LORENTZ")].count("\n") + 1 + line
            assert f"deck.inp:{number}:" in done.stderr, done.stderr

    def test_wires_that_carry_no_current_are_named_once(self, litz, tmp_path):
        deck = slanted(plane_table("XY", X, Y, self.FIELD)).replace("*ELECTRICAL CONDUCTIVITY\n", "**", 1)
        (tmp_path / "deck.inp").write_text(deck)
        done = litz("check", "deck.inp", cwd=tmp_path)
        assert done.returncode == 1
        assert done.stderr.count("carries no current") == 1, done.stderr
