"""Currents, forces and heat along cables: against the ladder of two wires, and sums over all contacts and wires."""

import math
import re

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from verification.line_decks import pressed_pair, uniform_spot
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires, PressedWire

import litz
from in_process import command
from litz import build
from litz.pictures import cable_charts

THICK, THIN = PressedWire(0.5e-3, 120e9, 0.34, 1.7e-8), PressedWire(0.3e-3, 120e9, 0.34, 1.5e-7)
LENGTH, CONDUCTANCE, OVERLAP = 20e-3, 1e4, 1e-7
PAIR = ParallelWires(THICK, THIN)
JOINT = LineJoint(LENGTH, CONDUCTANCE, *(wire.resistivity / (np.pi * wire.radius**2) for wire in (THICK, THIN)))


@pytest.fixture
def joint(run):
    """Results of a lap joint: 1 V from the start of the first wire to the end of the second one."""
    text = pressed_pair(PAIR, [OVERLAP], LENGTH, 100, spot=uniform_spot(CONDUCTANCE), potentials="lap")
    process, results = run("*UNITS, SYSTEM=SI\n" + text)
    assert process.returncode == 0, process.stderr
    return results


class TestLapJoint:
    def test_currents_are_those_of_the_ladder(self, joint):
        found = joint.current_shares(count=101)
        np.testing.assert_allclose(found.place, np.linspace(0, LENGTH, 101), rtol=1e-12)
        total = joint.history["current PLUS to MINUS"][-1]
        np.testing.assert_allclose(found.total, total, rtol=1e-9)
        # places are h = 0.1 mm apart, and the currents go with exp(74 x/m): second order, (h m)^2/8 = 7e-6
        np.testing.assert_allclose(found.share[0], JOINT.lap_current(found.place), atol=2e-5)
        np.testing.assert_allclose(found.share.sum(axis=0), 1, rtol=1e-12)

    def test_turned_wires_carry_the_same_current(self, joint, run):
        """The second wire runs against the first one."""
        text = pressed_pair(PAIR, [OVERLAP], LENGTH, 100, spot=uniform_spot(CONDUCTANCE), potentials="lap")
        text, count = re.subn(r"^ (1\d{4}), (\d+), (\d+)$", r" \1, \3, \2", text, flags=re.MULTILINE)
        assert count == 100
        process, results = run(text, name="turned")
        assert process.returncode == 0, process.stderr
        found, expected = (one.current_shares(count=51).current for one in (results, joint))
        np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-9 * expected.max())

    def test_heat_is_the_power_of_the_source(self, joint):
        table = joint.wire_heat()
        power = joint.history["current PLUS to MINUS"][-1] * 1.0
        assert table["total"].sum() == pytest.approx(power, rel=1e-9)
        x = np.linspace(0, LENGTH, 20001)
        share = JOINT.lap_current(x)
        current = power
        resistances = (JOINT.resistance, JOINT.resistance_2)
        for wire, (r, part) in enumerate(zip(resistances, (share, 1 - share), strict=True)):
            expected = r * current**2 * np.trapezoid(part**2, x)
            assert table["along"][wire] == pytest.approx(expected, rel=2e-3)
        assert table["contacts"][0] == table["contacts"][1]
        np.testing.assert_allclose(table["per_length"], table["total"] / LENGTH, rtol=1e-12)

    def test_slices_have_the_same_force_and_conductance_everywhere(self, joint):
        table = joint.along_cable(count=7)
        np.testing.assert_allclose(table["force_per_length"], PAIR.force(OVERLAP), rtol=1e-6)
        np.testing.assert_allclose(table["conductance_per_length"], CONDUCTANCE, rtol=1e-9)
        width = LENGTH / 7
        heat = (table["contact_heat_per_length"] + table["wire_heat_per_length"]).sum() * width
        assert heat == pytest.approx(joint.wire_heat()["total"].sum(), rel=1e-9)
        assert table.units["conductance_per_length"] == "S/m"

    def test_currents_as_a_file(self, joint, tmp_path):
        found = joint.current_shares(count=5)
        rows = np.genfromtxt(found.to_csv(tmp_path / "shares.csv"), delimiter=",", names=True, deletechars="")
        assert rows.dtype.names == ("place_[m]", "wire_1_[A]", "wire_2_[A]", "total_[A]")
        np.testing.assert_array_equal(rows["wire_2_[A]"], found.current[1])
        assert repr(found) == "<CurrentShares: 2 wires at 5 places over 0.02 m>"


class TestPulledStrand:
    """1+6 wires with the current entering one wire of the layer and leaving all at the other end."""

    @pytest.fixture(scope="class")
    def strand(self, tmp_path_factory):
        film = litz.Interaction(conductance=litz.FilmSpot(1e-11))
        model = build.strand([1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=20e-3, interaction=film)
        model.node_set("FIRST", model.groups["LAYER1"].wires[0].nodes[0])
        step = model.press(-10e-6, increment=0.5)
        step.potential("FIRST", 1e-3)
        step.potential("PLUS", 0)
        step.electrode_print("FIRST", "PLUS")
        step.el_file("SE", "E11")
        return model.run(tmp_path_factory.mktemp("strand"))

    def test_the_whole_current_passes_every_section(self, strand):
        found = strand.current_shares()
        np.testing.assert_allclose(found.total, strand.history["current FIRST to PLUS"][-1], rtol=1e-8)
        assert found.share[1, 0] == pytest.approx(1, rel=1e-9)
        # the two neighbours of the first wire are alike
        np.testing.assert_allclose(found.share[2], found.share[6], rtol=0.02, atol=1e-4)

    def test_the_force_on_the_core_is_that_of_curved_wires_under_tension(self, strand):
        """Tension times curvature of six wires, away from the clamps."""
        angle = math.atan(2 * np.pi * 1.02e-3 / 45e-3)
        curvature = math.sin(angle) ** 2 / 1.02e-3
        table = strand.along_wires()
        middle = (table["wire"] > 0) & (np.abs(table["z"] - 10e-3) < 2e-3)
        tension = table["axial_force"][middle].mean()
        slices = strand.along_cable(count=20)
        inner = np.abs(slices["place"] - 10e-3) < 2.5e-3
        expected = 6 * tension * curvature / math.cos(angle)
        # the wires also carry some of the radial force by bending
        assert slices["force_per_length"][inner].mean() == pytest.approx(expected, rel=0.03)
        total = slices["force_per_length"].sum() * 20e-3 / 20
        assert total == pytest.approx(strand.contacts_at(-1)["force"].sum(), rel=1e-3)

    def test_results_along_the_wires(self, strand):
        table = strand.along_wires()
        assert np.all(np.diff(table["wire"]) >= 0)
        for wire in range(7):
            mine = table["wire"] == wire
            assert np.all(np.diff(table["arc"][mine]) > 0)
        strain = table["axial_strain"][(table["wire"] == 0) & (np.abs(table["z"] - 10e-3) < 3e-3)]
        # pulled by 10 um over 20 mm
        assert strain.mean() == pytest.approx(10e-6 / 20e-3, rel=0.01)
        assert (table["strain_max"] >= table["axial_strain"] - 1e-15).all()
        assert table.units["arc"] == "m"


def test_wires_of_a_mat_have_no_cross_section_in_common(run_of_input):
    results = litz.Results(run_of_input("04_wire_grid"))
    with pytest.raises(ValueError, match="wire 1 does not run along the others"):
        litz.Results(run_of_input("12_woven_fabric")).current_shares()
    with pytest.raises(ValueError, match="count must be 2 or more places, not 1"):
        results.current_shares(count=1)
    with pytest.raises(ValueError, match="count must be 1 or more slices, not 0"):
        results.along_cable(count=0)


def axes_of(kind, results, **options):
    """Axes of a picture, drawn without a file."""
    figure = Figure(figsize=(8, 7))
    draw = {"shares": cable_charts.shares, "section": cable_charts.section}[kind]
    draw(figure, results, -1, **options)
    return figure.axes


class TestPictures:
    def test_shares_are_lines_over_the_place(self, joint):
        upper, lower = axes_of("shares", joint)
        first, second, equal = upper.get_lines()
        place, share = first.get_data()
        # in millimetres
        np.testing.assert_allclose(share, JOINT.lap_current(place / 1000), atol=2e-5)
        np.testing.assert_allclose(share + second.get_ydata(), 1, rtol=1e-9)
        assert equal.get_ydata()[0] == 0.5
        assert upper.get_ylabel() == "share of the current"
        (heights, edges, _), *_ = (patch.get_data() for patch in lower.patches)
        assert lower.get_ylabel() == "force per length [kN/m]"
        assert (heights * np.diff(edges)).sum() == pytest.approx(PAIR.force(OVERLAP) * LENGTH, rel=1e-6)

    def test_a_hairpin_has_currents_and_no_shares(self, run):
        text = pressed_pair(PAIR, [OVERLAP], LENGTH, 40, spot=uniform_spot(CONDUCTANCE), potentials="hairpin")
        _, results = run("*UNITS, SYSTEM=SI\n" + text)
        assert np.isnan(results.current_shares().share).all()
        upper, _ = axes_of("shares", results)
        assert upper.get_title() == "Current of each wire"
        there, back = (line.get_ydata() for line in upper.get_lines())
        np.testing.assert_allclose(there, -back, rtol=1e-6, atol=1e-9 * there.max())

    def test_without_a_current_it_is_said(self, run):
        text = pressed_pair(PAIR, [OVERLAP], LENGTH, 8, spot=uniform_spot(CONDUCTANCE), potentials=None)
        _, results = run(re.sub(r"\*ELECTRICAL CONDUCTIVITY\n.*\n", "", text))
        upper, _ = axes_of("shares", results)
        assert [text.get_text() for text in upper.texts] == ["No current flows"]

    def test_a_section_has_the_wires_where_they_are(self, joint):
        axes, bar = axes_of("section", joint, field=None, place=0.25)
        discs, dots = axes.collections
        centres = [(path.vertices.min(axis=0) + path.vertices.max(axis=0)) / 2 for path in discs.get_paths()]
        # across x: y and z in millimetres; the upper wire is lowered by 1e-4 mm
        np.testing.assert_allclose(centres, [[0, 0], [0, 0.8]], atol=2e-4)
        shares = JOINT.lap_current(np.array([LENGTH / 4]))[0]
        currents = discs.get_array()
        assert currents[0] / currents.sum() == pytest.approx(shares, abs=2e-5)
        # the dot lies where both surfaces meet
        np.testing.assert_allclose(dots.get_offsets(), [[0, 0.5]], atol=1e-3)
        assert bar.get_ylabel() == "current along the cable [A]"
        assert [text.get_text() for text in axes.texts] == ["1", "2"]

    def test_inclined_wires_are_ellipses(self, tmp_path):
        """Crossed at 60 degrees to the plane: half-axes r and r/sin(60 degrees)."""
        model = litz.Model("two inclined wires", units="SI")
        steel = litz.Material("STEEL", young=200e9, poisson=0.3)
        lean = math.tan(math.radians(30))
        for k, sign in enumerate((1, -1)):
            y = sign * 5e-3 * lean
            model.wire(f"W{k}", (3e-3 * k, -y, 0), (3e-3 * k, y, 10e-3), radius=1e-3, material=steel, elements=4)
        for group in model.groups.values():
            model.fix(group.ends)
        model.step().move(model.groups["W0"].middle, "x", 1e-9)
        results = model.run(tmp_path)
        axes, _ = axes_of("section", results, field="displacement", place=0.5)
        for path in axes.collections[0].get_paths():
            size = np.ptp(path.vertices, axis=0) / 2
            np.testing.assert_allclose(size, [1.0, 1.0 / math.cos(math.radians(30))], rtol=1e-6)
        assert axes.get_title() == "no contact within a radius of it"

    def test_a_jacket_is_drawn_round_the_wires(self, tmp_path):
        film = litz.Interaction(conductance=litz.FilmSpot(1e-9))
        model = build.cable([[3]], radius=0.41e-3, lay_lengths=[80e-3], length=5e-3, interaction=film, ends="sliding")
        build.compact(model, void_fraction=0.35, increments=2)
        results = model.run(tmp_path)
        axes, bar = axes_of("section", results, field="axial_force", place=0.5)
        (jacket,) = axes.patches
        # micrometres
        assert jacket.radius == pytest.approx(1e6 * results.rigid_surfaces["JACKET"].radius_at(results), rel=1e-9)
        assert bar.get_ylabel().startswith("axial force [")

    def test_plates_are_lines(self, tmp_path):
        """Two plates above and below two wires along x."""
        model = litz.Model("between plates", units="SI")
        steel = litz.Material("STEEL", young=200e9, poisson=0.3)
        wire = model.wire("W", (0, 0, 0), (10e-3, 0, 0), radius=1e-3, material=steel, elements=4)
        model.wire("V", (0, 2.5e-3, 0), (10e-3, 2.5e-3, 0), radius=1e-3, material=steel, elements=4)
        for group in model.groups.values():
            model.fix(group.ends)
        model.contact(wire, model.plane("PLATE", (0, 0, -2e-3), (0, 0, 1)))
        model.step().move(wire.middle, "y", 1e-9)
        results = model.run(tmp_path)
        axes, _ = axes_of("section", results, field="displacement", place=0.5)
        (line,) = axes.get_lines()
        # y and z in millimetres
        assert line.get_xy1() == pytest.approx((0, -2))
        assert line.get_xy2()[1] == pytest.approx(-2)

    @pytest.mark.slow
    def test_from_the_command_line(self, joint, tmp_path):
        picture = tmp_path / "section.png"
        shown = command("plot", joint.path, "section", "--place", "0.2", "--field", "axial_force", "-o", picture)
        assert shown.returncode == 0, shown.stderr
        assert imread(picture).shape[0] > 500
        wrong = command("plot", joint.path, "section", "--place", "1.2")
        assert wrong.returncode == 1
        assert "place is from 0 to 1 along the cable, not 1.2" in wrong.stderr
