"""Resistances between strands: against runs that drive a current from one strand to another, and closed forms."""

import re

import networkx as nx
import numpy as np
import pytest
from verification.line_decks import pressed_pair, uniform_spot
from verification.numerics import extrapolate
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires, PressedWire

import litz
from in_process import command
from litz import build

THICK, THIN = PressedWire(0.5e-3, 120e9, 0.34, 1.7e-8), PressedWire(0.3e-3, 120e9, 0.34, 1.5e-7)
LENGTH, CONDUCTANCE = 20e-3, 1e5
PAIR = ParallelWires(THICK, THIN)
JOINT = LineJoint(LENGTH, CONDUCTANCE, *(wire.resistivity / (np.pi * wire.radius**2) for wire in (THICK, THIN)))


def driven(model, first, second, directory, pull=-15e-6, **more):
    """Results of a cable whose current enters one wire and leaves another at their first nodes."""
    ends = {"FIRST": first, "SECOND": second}
    for name, wire in ends.items():
        model.node_set(name, wire.nodes[0])
    step = model.press(pull, increment=0.5, **more)
    step.potential("FIRST", 1e-3)
    step.potential("SECOND", 0)
    step.electrode_print("FIRST", "SECOND")
    return model.run(directory)


def wire_numbers(results, *wires):
    """Numbers of wires of a model in its results, from 0."""
    rows = [int(np.flatnonzero(results.element_ids == wire.elements[0])[0]) for wire in wires]
    return [int(results.wire_arcs.wire[row]) for row in rows]


class TestRunsThatDriveACurrent:
    """The run solves for all potentials on its own mesh. Its iteration leaves 1e-8 of them at most."""

    @pytest.mark.parametrize("law", [litz.FilmSpot(1e-12), litz.HertzSpot(), litz.PlasticSpot(1e9)])
    def test_triplet(self, law, tmp_path):
        """Strips on clean metal see each other in the wire between them: 0.4 % here, 1 % in the strand below."""
        model = build.cable(
            [[3]], radius=0.41e-3, lay_lengths=[80e-3], length=10e-3, interaction=litz.Interaction(conductance=law)
        )
        wires = model.groups["LAYER1"].wires
        results = driven(model, wires[0], wires[1], tmp_path)
        resistance = results.history["resistance FIRST to SECOND"][-1]
        found = results.interstrand_resistance()
        assert found.matrix[0, 1] == pytest.approx(resistance, rel=1e-7)
        np.testing.assert_allclose(found.matrix, found.matrix.T, rtol=1e-12)

    def test_across_the_core_of_a_strand_of_two_metals(self, tmp_path):
        model = build.strand(
            [1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=15e-3, element_length=1.1e-3,
            material=[litz.Material("BRONZE", young=110e9, poisson=0.34, conductivity=9e6), litz.COPPER],
            interaction=litz.Interaction(conductance=litz.HertzSpot()),
        )  # fmt: skip
        wires = model.groups["LAYER1"].wires
        results = driven(model, wires[1], wires[4], tmp_path)
        first, second = wire_numbers(results, wires[1], wires[4])
        found = results.interstrand_resistance()
        resistance = results.history["resistance FIRST to SECOND"][-1]
        assert found.matrix[first, second] == pytest.approx(resistance, rel=1e-7)
        # neighbours are nearer by nothing: both pass through the core
        assert found.matrix[first, second] == pytest.approx(found.matrix[first, first + 1], rel=0.05)

    @pytest.mark.parametrize("times_length", [5e-8, 2e-9])
    def test_given_resistances_that_are_less_than_those_of_strips(self, times_length, tmp_path):
        """What strips of the core add to each other is limited in each section, as in the run (10.13a): of the smaller one."""
        law = litz.ConstantSpot(times_length, per_length=True)
        model = build.strand(
            [1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=15e-3, element_length=1.1e-3,
            interaction=litz.Interaction(conductance=law),
        )  # fmt: skip
        wires = model.groups["LAYER1"].wires
        results = driven(model, wires[1], wires[4], tmp_path)
        first, second = wire_numbers(results, wires[1], wires[4])
        resistance = results.history["resistance FIRST to SECOND"][-1]
        assert results.interstrand_resistance().matrix[first, second] == pytest.approx(resistance, rel=1e-6)

    def test_crossings_and_lines_of_a_rope(self, tmp_path):
        """Three bundles: lines within them, crossings between them."""
        model = build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[20e-3, 40e-3], length=10e-3)
        wires = model.groups["LAYER1"].wires
        results = driven(model, wires[0], wires[5], tmp_path, pull=-10e-6)
        found = results.interstrand_resistance()
        assert found.matrix[0, 5] == pytest.approx(results.history["resistance FIRST to SECOND"][-1], rel=1e-7)
        assert found.stage[0].tolist() == [0, 1, 1, 2, 2, 2, 2, 2, 2]
        stages = found.stages()
        assert stages["pairs"].tolist() == [9, 27]
        assert (results.contacts_at(-1)["spacing"] == 0).any()
        assert (results.contacts_at(-1)["spacing"] > 0).any()

    def test_bundles_of_a_rope_soldered_at_one_end(self, tmp_path):
        model = build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[20e-3, 40e-3], length=10e-3)
        step = model.press(-20e-6, increment=0.5)
        step.potential("BUNDLE1_MINUS", 1e-3)
        step.potential("BUNDLE3_MINUS", 0)
        step.electrode_print("BUNDLE1_MINUS", "BUNDLE3_MINUS")
        results = model.run(tmp_path)
        expected = results.history["resistance BUNDLE1_MINUS to BUNDLE3_MINUS"][-1]
        found = results.interstrand_resistance()
        assert found.between("BUNDLE1", "BUNDLE3") == pytest.approx(expected, rel=1e-7)
        assert found.between([0, 1, 2], [6, 7, 8]) == pytest.approx(expected, rel=1e-7)
        assert found.between(0, 8) == pytest.approx(found.matrix[0, 8], rel=1e-10)

    def test_a_crossing_within_an_element(self, run_of_input):
        """All lower wires to all upper ones of a grid: as between its electrodes."""
        results = litz.Results(run_of_input("04_wire_grid"))
        plus, minus = (results.node_sets[name] for name in ("PLUS", "MINUS"))
        found = results.interstrand_resistance()
        ends = [found.circuit.node.tolist().index(results.node_ids[row]) for row in (*plus, *minus)]
        groups = [np.array(ends[: len(plus)]), np.array(ends[len(plus) :])]
        solver = found.circuit.solver(groups)
        resistance = solver.resistances(np.array([groups[0][0], groups[1][0]]))[0, 1]
        assert resistance == pytest.approx(results.history["resistance PLUS to MINUS"][-1], rel=1e-7)

    def test_warm_wires(self, run):
        """The resistivity is that at the temperature of each element."""
        text = pressed_pair(PAIR, [1e-7], LENGTH, 20, spot=uniform_spot(CONDUCTANCE), potentials="hairpin")
        text = text.replace(
            "*ELECTRICAL CONDUCTIVITY\n 58823529.411764704", "*ELECTRICAL CONDUCTIVITY\n 6e7, 300.\n 3e7, 400.", 1
        )
        assert "6e7, 300." in text
        text = text.replace("*STEP", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n LOWER, 350.\n UPPER, 350.\n*STEP", 1)
        process, results = run(text)
        assert process.returncode == 0, process.stderr
        for increment in range(1, len(results.times)):
            resistance = results.history["resistance PLUS to MINUS"][increment]
            assert results.interstrand_resistance(increment).matrix[0, 1] == pytest.approx(resistance, rel=1e-8)
        resistivity = results.field("resistivity")[results.element_sets["LOWER"]]
        # half-way between 300 and 400 K; resistivities are interpolated
        np.testing.assert_allclose(resistivity, (1 / 6e7 + 1 / 3e7) / 2, rtol=1e-12)


class TestTwoWiresThatTouchAllAlong:
    """Two unequal wires; places are 0.1 and 0.05 mm apart, and exact to the second order."""

    @pytest.fixture
    def results(self, run):
        found = []
        for elements in (40, 200):
            text = pressed_pair(PAIR, [1e-7], LENGTH, elements, spot=uniform_spot(CONDUCTANCE))
            process, one = run(text, name=f"ladder{elements}")
            assert process.returncode == 0, process.stderr
            found.append(one)
        return found

    def limit(self, results, value):
        return extrapolate(*(value(one) for one in results), 2)

    # what the extrapolation leaves is of the fourth order in places of h = 0.03 transfer lengths
    def test_at_the_end_it_is_a_hairpin(self, results):
        for at in (0.0, 1.0):
            found = self.limit(results, lambda one, at=at: one.interstrand_resistance(at=at).matrix[0, 1])
            assert found == pytest.approx(JOINT.hairpin(), rel=1e-5)

    def test_in_the_middle_the_current_spreads_both_ways(self, results):
        half = LineJoint(LENGTH / 2, CONDUCTANCE, JOINT.resistance, JOINT.resistance_2)
        found = self.limit(results, lambda one: one.interstrand_resistance(at=0.5).matrix[0, 1])
        assert found == pytest.approx(half.hairpin() / 2, rel=1e-5)

    def test_superconducting_wires_have_the_resistance_of_their_contact_alone(self, results):
        for one in results:
            found = one.interstrand_resistance(superconducting=True)
            assert found.matrix[0, 1] == pytest.approx(1 / (CONDUCTANCE * LENGTH), rel=1e-9)
            assert found.table()["times_length"][0] == pytest.approx(1 / CONDUCTANCE, rel=1e-9)
            assert np.isinf(one.redistribution_lengths(superconducting=True)).all()

    def test_the_redistribution_length_is_that_of_the_ladder(self, results):
        for one in results:
            assert one.redistribution_lengths() == pytest.approx([1 / JOINT.rate], rel=1e-9)


@pytest.mark.slow
def test_redistribution_in_a_triplet_is_twice_the_same(tmp_path):
    """Three equal wires: both modes have 1/l^2 = 3 r g."""
    film = litz.Interaction(conductance=litz.FilmSpot(1e-9))
    model = build.cable([[3]], radius=0.41e-3, lay_lengths=[80e-3], length=10e-3, interaction=film, ends="sliding")
    build.compact(model, void_fraction=0.35, increments=2)
    results = model.run(tmp_path)
    g = results.wire_pairs()["conductance"].mean() / results.wire_arcs.wire_length.mean()
    r = 1 / (litz.COPPER.conductivity * np.pi * 0.41e-3**2)
    # the three pairs are not pressed quite alike, which splits the modes
    assert results.redistribution_lengths() == pytest.approx(2 * [1 / np.sqrt(3 * r * g)], rel=1e-3)


class TestSuperconductingWires:
    def results(self, directory, superconducting):
        metal = litz.COPPER
        if superconducting:
            law = litz.Superconductor(n=30, jc=1e9, fraction=0.4, field=5.0)
            metal = litz.Material("STRAND", young=120e9, poisson=0.34, conductivity=5.88e7, superconductor=law)
        film = litz.Interaction(conductance=litz.FilmSpot(1e-12))
        model = build.cable([[3]], radius=0.41e-3, lay_lengths=[80e-3], length=10e-3, material=metal, interaction=film)
        model.press(-15e-6, increment=0.5)
        return model.run(directory)

    def test_conduct_without_resistance_unless_they_are_normal(self, tmp_path):
        results, plain = self.results(tmp_path / "super", True), self.results(tmp_path / "plain", False)
        found = results.interstrand_resistance().matrix
        np.testing.assert_allclose(found, plain.interstrand_resistance(superconducting=True).matrix, rtol=1e-7)
        # 0.6 of the section is metal
        resistance = results.field("element_resistance")
        np.testing.assert_allclose(resistance, plain.field("element_resistance") / 0.6, rtol=1e-12)
        normal = results.interstrand_resistance(superconducting=False)
        assert (normal.matrix[0, 1:] > 2 * found[0, 1:]).all()
        pieces = normal.circuit.contact == 0
        assert normal.circuit.resistance[pieces].sum() == pytest.approx(resistance.sum(), rel=1e-12)


@pytest.fixture
def grid(run_of_input):
    return litz.Results(run_of_input("04_wire_grid"))


class TestCircuitFiles:
    def test_networkx_finds_the_same_resistance(self, grid, tmp_path):
        found = grid.interstrand_resistance()
        graph = found.circuit.to_networkx()
        first, second = (int(found.terminal[wire]) for wire in (0, 5))
        # as conductances of parallel edges
        expected = nx.resistance_distance(graph, first, second, weight="resistance")
        assert found.matrix[0, 5] == pytest.approx(expected, rel=1e-9)
        read = nx.read_graphml(found.circuit.to_graphml(tmp_path / "circuit.graphml"))
        assert (read.number_of_nodes(), read.number_of_edges()) == (graph.number_of_nodes(), graph.number_of_edges())
        expected = nx.resistance_distance(read, f"point{first + 1}", f"point{second + 1}", weight="resistance_ohm")
        assert found.matrix[0, 5] == pytest.approx(expected, rel=1e-9)

    def test_csv_has_all_places_of_contacts_and_all_pieces_of_wire(self, grid, tmp_path):
        circuit = grid.circuit()
        rows = np.genfromtxt(circuit.to_csv(tmp_path / "circuit.csv"), delimiter=",", names=True, deletechars="")
        assert len(rows) == len(circuit.points)
        assert (rows["contact"] > 0).sum() == grid.contacts_at(-1).n_rows
        np.testing.assert_array_equal(rows["resistance_[ohm]"], circuit.resistance)
        np.testing.assert_array_equal(rows["point_1"], circuit.points[:, 0] + 1)
        assert rows["wire_2"].max() == len(grid.wires)
        # pieces of wire add up to the wires
        pieces = rows[rows["contact"] == 0]
        assert pieces["length_[m]"].sum() == pytest.approx(grid.wire_arcs.wire_length.sum(), rel=1e-12)
        assert pieces["resistance_[ohm]"].sum() == pytest.approx(grid.field("element_resistance").sum(), rel=1e-12)

    def test_points_lie_on_the_wires(self, grid):
        circuit = grid.circuit()
        ledger = grid.contacts_at(-1)
        contacts = circuit.points[circuit.contact > 0]
        for side in (0, 1):
            axis = np.stack([ledger[f"point_{side + 1}_{name}"] for name in "xyz"], axis=1)
            np.testing.assert_allclose(circuit.position[contacts[:, side]], axis, rtol=0, atol=1e-15)
        network = grid.contact_network()
        np.testing.assert_allclose(circuit.arc[contacts], network.arc, rtol=1e-12)
        assert re.fullmatch(r"<Circuit: \d+ points, \d+ pieces of wire, 16 places of contacts>", repr(circuit))


class TestCommand:
    def test_prints_means_of_the_stages_and_writes_the_circuit(self, grid, tmp_path):
        csv, graphml = tmp_path / "new" / "circuit.csv", tmp_path / "circuit.graphml"
        shown = command("network", grid.path, "--at", "0.5", "--csv", csv, "--graphml", graphml)
        assert shown.returncode == 0, shown.stderr
        head, what, columns, row, lengths, *written = shown.stdout.splitlines()
        assert head.endswith(": 8 wires")
        assert "current enters at 0.5 of their length" in what
        assert columns.split()[:3] == ["stage", "pairs", "mean"]
        stages = grid.interstrand_resistance(at=0.5).stages()
        assert row.split()[:2] == ["1", "28"]
        assert float(row.split()[2]) == pytest.approx(stages["mean"][0], rel=1e-4)
        assert "even out [mm]" in lengths
        assert [line.split()[1].rstrip(":") for line in written] == [str(csv), str(graphml)]
        assert csv.read_text() == grid.circuit().to_csv(tmp_path / "again.csv").read_text()

    def test_of_an_increment_and_without_resistance_along_the_wires(self, grid):
        shown = command("network", grid.path, "--increment", "1", "--superconducting")
        expected = grid.interstrand_resistance(1, superconducting=True).stages()
        assert float(shown.stdout.splitlines()[3].split()[2]) == pytest.approx(expected["mean"][0], rel=1e-4)

    @pytest.mark.parametrize(
        ("arguments", "message"),
        [(["--at", "2"], "from 0 to 1, not 2"), (["--increment", "77"], "is not in"), (["--at", "x"], "invalid float")],
    )
    def test_wrong_arguments_are_errors(self, grid, arguments, message):
        shown = command("network", grid.path, *arguments)
        assert shown.returncode == 1
        assert message in shown.stderr

    def test_a_file_that_cannot_be_written(self, grid, tmp_path):
        shown = command("network", grid.path, "--csv", tmp_path)
        assert shown.returncode == 4
        assert "cannot write" in shown.stderr


class TestWhatIsRefused:
    def test_wires_that_do_not_conduct(self, run):
        text = pressed_pair(PAIR, [1e-7], LENGTH, 8, spot=uniform_spot(CONDUCTANCE), potentials=None)
        text = re.sub(r"\*ELECTRICAL CONDUCTIVITY\n.*\n", "", text)
        text = re.sub(r"\*GAP ELECTRICAL CONDUCTANCE.*\n.*\n", "", text)
        process, results = run(text)
        assert process.returncode == 0, process.stderr
        with pytest.raises(ValueError, match="no wire conducts"):
            results.interstrand_resistance()

    def test_arguments(self, grid):
        with pytest.raises(ValueError, match="at is a place along the wires from 0 to 1, not 2"):
            grid.interstrand_resistance(at=2)
        with pytest.raises(KeyError, match="there is no element set 'LOWR'; did you mean 'LOWER'"):
            grid.interstrand_resistance(bundles=["LOWR"])
        found = grid.interstrand_resistance(bundles={"LEFT": [0, 1], "RIGHT": [2, 3]})
        with pytest.raises(KeyError, match="there is no bundle 'LEF'; did you mean 'LEFT'"):
            found.between("LEF", "RIGHT")
        with pytest.raises(IndexError, match="wires are counted from 0 to 7"):
            found.between(0, 8)
        with pytest.raises(ValueError, match="share a wire"):
            found.between("LEFT", [1, 2])

    def test_what_is_left_out_is_said(self, run):
        text = pressed_pair(
            PAIR,
            [1e-7],
            LENGTH,
            8,
            spot=uniform_spot(CONDUCTANCE).replace("CONSTANT", "CONSTANT, MUTUAL RESISTANCE=YES"),
        )
        process, results = run(text)
        assert process.returncode == 0, process.stderr
        with pytest.warns(UserWarning, match="MUTUAL RESISTANCE=YES: what spots near each other"):
            results.interstrand_resistance()


class TestBundlesWithTapes:
    """A tape around each bundle changes what bundles conduct into each other, and nothing else."""

    @staticmethod
    def pressed(directory, wrap=None):
        film = litz.Interaction(conductance=litz.FilmSpot(1e-11))
        model = build.cable(
            [[2], [2]], radius=0.41e-3, lay_lengths=[15e-3, 30e-3], length=6e-3, interaction=film, wrap=wrap,
            ends="sliding",
        )  # fmt: skip
        build.compact(model, 0.68, increments=3)
        return model.run(directory)

    @staticmethod
    def contacts(results):
        """The ledger, and which of its rows are between the bundles."""
        ledger = results.contacts_at(-1)
        bundle = results.wire_arcs.wire // 2
        row = {number: k for k, number in enumerate(results.element_ids.tolist())}
        first, second = (bundle[[row[number] for number in ledger[name]]] for name in ("element_1", "element_2"))
        return ledger, first != second

    def test_resistances_between_bundles_are_those_given_and_others_stay(self, tmp_path):
        bare, between = self.contacts(self.pressed(tmp_path / "bare"))
        assert between.any()
        assert not between.all()
        taped = {}
        for value in (1e-6, 2e-6):
            given = litz.Interaction(conductance=litz.ConstantSpot(value, per_length=True))
            taped[value], _ = self.contacts(self.pressed(tmp_path / str(value), given))
        one, two = (taped[value]["resistance"][between] for value in (1e-6, 2e-6))
        # twice the resistance times length over the same lens
        np.testing.assert_allclose(two, 2 * one, rtol=1e-9)
        for ledger in taped.values():
            np.testing.assert_allclose(ledger["force"], bare["force"], rtol=1e-6)
            np.testing.assert_allclose(ledger["resistance"][~between], bare["resistance"][~between], rtol=1e-6)

    def test_a_cover_is_between_bare_bundles_and_covered_ones(self, tmp_path):
        """With a film on the tape as on the strands, more of it is a larger resistance."""
        found = [
            self.pressed(tmp_path / name, wrap)
            .interstrand_resistance(superconducting=True)
            .between("BUNDLE1", "BUNDLE2")
            for name, wrap in (
                ("bare", None),
                ("half", build.Wrap(0.1e-3, 5.3e-7, cover=0.5, film=1e-11)),
                ("whole", build.Wrap(0.1e-3, 5.3e-7, film=1e-11)),
            )
        ]
        assert found[0] < found[1] < found[2]
