"""Zones of contact along lines in results of runs: against closed forms, and in all that shows them."""

import base64
import csv
import json
import math

import numpy as np
import pytest
import pyvista
from matplotlib.image import imread
from verification.references.hertz import effective_modulus, end_on_wire
from verification.references.parallel_wires import ParallelWires
from verification.references.touching_beams import Cantilevers
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

import litz
from line_wires import COPPER, HERTZ, LED, STEEL, along, linear, lowered, pressed, spot, two_wires
from litz import Results
from litz.results.contact_history import crossings_by_themselves
from litz.results.history_table import history_table
from litz.viewer.data import WebData
from test_line_contact import NO_FIELD, VOLT, cantilevers, solved

OVERLAP, LENGTH = 2e-7, 20e-3
#: Places are at most 0.4 radii apart; a zone ends halfway between two of them
HALF = 0.2 * COPPER.radius


@pytest.fixture
def strand(run_of_input):
    """Six wires on a core, pulled, twisted and bent."""
    return Results(run_of_input("14_strand"))


class TestClosedForms:
    @pytest.mark.parametrize("elements", [(8, 8), (8, 11)], ids=["nodes match", "nodes do not match"])
    def test_parallel_wires_are_one_zone_from_end_to_end(self, run, elements):
        law = HERTZ + spot("HERTZ, VOLTAGE=LINEAR")
        zones = solved(run(pressed(OVERLAP, elements=elements, cards=(VOLT,), law=law))).contact_zones()
        assert zones.n_rows == 1
        zone = {name: values[0] for name, values in zones.items()}
        for name, value in (("arc_1_begin", 0.0), ("arc_1_end", LENGTH), ("arc_2_begin", 0.0), ("arc_2_end", LENGTH)):
            assert zone[name] == pytest.approx(value, abs=1e-12 * LENGTH)
        assert (zone["begin_x"], zone["end_x"]) == pytest.approx((-LENGTH / 2, LENGTH / 2), rel=1e-9)
        assert zone["begin_z"] == pytest.approx(COPPER.radius, rel=1e-3)
        exact = ParallelWires(COPPER, COPPER)
        force = exact.force(OVERLAP)
        # the overlap is known to 1e-16/2e-7
        assert zone["length"] == pytest.approx(LENGTH, rel=1e-12)
        assert [zone[name] for name in ("force_per_length", "max_force_per_length")] == pytest.approx(
            [force] * 2, rel=1e-8
        )
        assert zone["force"] == pytest.approx(force * LENGTH, rel=1e-8)
        # a volt drives the current through the contact alone, from the lower wire to the upper one
        conductance = exact.conductance(force) * LENGTH
        assert [zone["conductance"], zone["current"], zone["joule_heat"]] == pytest.approx([conductance] * 3, rel=1e-8)

    @pytest.mark.parametrize("elements", [20, 37, 130])
    def test_a_lap_has_force_current_and_heat_per_length_of_a_line_up_to_its_ends(self, run, elements):
        """The round ends of both wires are told by themselves: over the length of a place they would be any value."""
        law = HERTZ + spot("HERTZ, VOLTAGE=LINEAR")
        results = solved(run(pressed(OVERLAP, elements=(20, elements), shift=LENGTH / 2, cards=(VOLT,), law=law)))
        exact = ParallelWires(COPPER, COPPER)
        force = exact.force(OVERLAP)
        conductance = exact.conductance(force)
        zones = results.contact_zones()
        largest = [zones[f"max_{name}_per_length"][0] for name in ("force", "current", "heat")]
        assert largest == pytest.approx([force, conductance, conductance], rel=1e-8)

        contacts, modulus = results.contacts_at(-1), effective_modulus([COPPER.young] * 2, [COPPER.poisson] * 2)
        of_metal = dict(radius=[COPPER.radius] * 2, modulus=modulus, resistivity=[COPPER.resistivity] * 2)
        of_end = (OVERLAP / end_on_wire(1.0, **of_metal).approach) ** 1.5
        assert contacts["end_force"][contacts["end_force"] > 0] == pytest.approx([of_end / 2] * 2, rel=1e-8)
        assert zones["force"][0] == pytest.approx(force * LENGTH / 2 + of_end, rel=1e-8)
        of_end = 1 / end_on_wire(of_end, **of_metal).resistance
        assert np.abs(contacts["end_current"]).sum() == pytest.approx(of_end, rel=1e-8)
        assert zones["current"][0] == pytest.approx(conductance * LENGTH / 2 + of_end, rel=1e-8)

    def test_wires_that_cross_have_no_zone(self, run):
        results = solved(run(pressed(OVERLAP, degrees=60, cards=(NO_FIELD,))))
        assert results.contact_zones().n_rows == 0
        pairs = results.wire_pairs()
        assert [pairs[name].tolist() for name in ("zones", "crossings", "length")] == [[0], [1], [0.0]]
        assert pairs["force"][0] == results.contacts_at(-1)["force"][0]

    @pytest.mark.parametrize("deep", [2e-6, 1e-5])
    def test_a_bent_wire_lifts_off_where_its_parabola_does(self, run, deep):
        """Overlap deep - k x^2/2 for |x| < sqrt(2 deep/k); with a penalty the force is its integral."""
        curvature, stiffness, length = 0.2, 5e10, 40e-3
        lower = along(length, 20, start=-length / 2)
        upper = along(length, 23, start=-length / 2, height=2e-3)
        upper[:, 2] += curvature * upper[:, 0] ** 2 / 2
        results = solved(run(two_wires(lower, upper, LED, lowered(deep, NO_FIELD), law=linear("", stiffness))))
        zones = results.contact_zones()
        assert zones.n_rows == 1
        off = math.sqrt(2 * deep / curvature)
        for side in (1, 2):
            found = [zones[f"arc_{side}_{end}"][0] for end in ("begin", "end")]
            assert found == pytest.approx([length / 2 - off, length / 2 + off], abs=HALF + 1e-5)
        # the trapezoidal rule over places, and slopes of 2e-3
        assert zones["force"][0] == pytest.approx(4 / 3 * stiffness * deep * off, rel=1e-2)
        assert zones["max_force_per_length"][0] == pytest.approx(stiffness * deep, rel=2e-3)

    def test_cantilevers_touch_at_the_tip_of_the_shorter_one_and_not_along_a_zone(self, run):
        load, ei = 0.2, STEEL.young * math.pi * STEEL.radius**4 / 4
        results = solved(run(cantilevers(load, 2e-4, (20, 31))))
        beams = Cantilevers(0.075, 0.05, ei, ei, load)
        force = beams.contact_force - 2e-4 / (2 * beams.support**3 / (3 * ei))
        assert results.contact_zones().n_rows == 0
        pairs = results.wire_pairs()
        assert [pairs[name].tolist() for name in ("zones", "crossings", "length")] == [[0], [1], [0.0]]
        assert pairs["force"][0] == pytest.approx(force, rel=5e-3)


#: End of the first step, in which the strand is pulled
PULLED = 4


class TestStrand:
    @pytest.mark.parametrize("increment", [2, PULLED, 8])
    def test_pulled_and_twisted_each_wire_of_the_layer_touches_the_core_along_one_zone(self, strand, increment):
        zones = strand.contact_zones(increment)
        assert zones["wire_1"].tolist() == [0] * 6
        assert zones["wire_2"].tolist() == [1, 2, 3, 4, 5, 6]
        # from end to end, along the helix and along the core, to half a distance of places
        helix = 30e-3 * math.hypot(1.0, 2 * math.pi * 1.02e-3 / 45e-3)
        for side, length in ((1, 30e-3), (2, helix)):
            assert zones[f"arc_{side}_begin"] == pytest.approx(0.0, abs=1e-4)
            # nodes on a helix: chords of 12 degrees
            assert zones[f"arc_{side}_end"] == pytest.approx(length, abs=1e-4)
        assert zones["length"] == pytest.approx((30e-3 + helix) / 2, abs=1e-4)

    def test_zones_pairs_and_crossings_have_the_sums_of_the_ledger(self, strand):
        # bent at the end, the layer has left the core in places, and its wires touch each other
        for increment in (1, PULLED, -1):
            ledger, zones, pairs = (
                strand.contacts_at(increment),
                strand.contact_zones(increment),
                strand.wire_pairs(increment),
            )
            alone = crossings_by_themselves(strand)[
                (strand.contacts["step"] == strand.steps[increment])
                & (strand.contacts["increment"] == strand.increments[increment])
            ]
            for name, values in (
                ("force", ledger["force"]),
                ("joule_heat", ledger["joule_heat"]),
                ("conductance", 1 / ledger["resistance"]),
            ):
                assert zones[name].sum() + values[alone].sum() == pytest.approx(values.sum(), rel=1e-12)
                assert pairs[name].sum() == pytest.approx(values.sum(), rel=1e-12)
            assert zones["places"].sum() + zones["crossings"].sum() + alone.sum() == ledger.n_rows
            assert pairs["zones"].sum() == zones.n_rows
            assert pairs["length"].sum() == pytest.approx(zones["length"].sum(), rel=1e-12)

    def test_in_the_network_a_zone_is_one_contact(self, strand):
        network, zones = strand.contact_network(PULLED), strand.contact_zones(PULLED)
        assert network.wires.tolist() == [[0, k] for k in range(1, 7)]
        assert np.array_equal(network.length, zones["length"])
        assert network.current * network.resistance == pytest.approx(network.voltage_gap, rel=1e-12)
        assert network.force == pytest.approx(zones["force"], rel=1e-13)
        # the middle, to a distance of places
        assert network.arc[:, 0] == pytest.approx((zones["arc_1_begin"] + zones["arc_1_end"]) / 2, abs=0.2e-3)
        every = strand.contact_network(PULLED, every_place=True)
        assert len(every.id) == strand.contacts_at(PULLED).n_rows
        assert every.force.sum() == pytest.approx(network.force.sum(), rel=1e-13)

    def test_summary_and_table_count_zones(self, strand):
        zones, alone = strand.contact_zones(), crossings_by_themselves(strand)
        last = strand.contacts["increment"] == strand.increments[-1]
        n_crossings = (alone & last & (strand.contacts["step"] == strand.steps[-1])).sum()
        text = " ".join(strand.summary().split())
        # they have a line where there are any
        assert (f"crossings {n_crossings} contact forces" in text) == (n_crossings > 0)
        assert f"zones of line contact {zones.n_rows} " in text
        assert "line contact by pairs of wires" in text
        kinds, *lines = history_table(strand).splitlines()
        crossings = "crossings and " if alone.any() else ""
        assert kinds == f"contacts: {crossings}zones of contact along lines; contact force: the sum of all their forces"
        rows = [line.split() for line in lines]
        assert rows[0][:2] == ["time", "contacts"]
        assert int(rows[2 + PULLED][1]) == 6
        assert int(rows[2 + len(strand.times) - 1][1]) == zones.n_rows + n_crossings

    def test_csv_has_zones_and_pairs_at_all_increments(self, strand, tmp_path):
        strand.export("csv", tmp_path)
        for name, method in (("zones", strand.contact_zones), ("pairs", strand.wire_pairs)):
            with (tmp_path / f"14_strand_{name}.csv").open(newline="") as file:
                rows = list(csv.reader(file))
            assert len(rows) == 1 + sum(method(k).n_rows for k in range(len(strand.times)))
            last, table = dict(zip(rows[0], rows[-1], strict=True)), method()
            assert (last["wire_1"], last["wire_2"]) == tuple(str(table[f"wire_{k}"][-1] + 1) for k in (1, 2))
            assert float(last["force [N]"]) == table["force"][-1]

    def test_paraview_has_a_line_for_each_zone(self, strand, tmp_path):
        strand.export("vtkhdf", tmp_path)
        for path in strand.path.parent.glob("14_strand*"):
            if not (tmp_path / path.name).exists():
                (tmp_path / path.name).symlink_to(path)
        # it is no result file of its own
        assert Results(tmp_path).path.name == "14_strand.vtkhdf"
        reader = vtkHDFReader()
        reader.SetFileName(str(tmp_path / "14_strand_zones.vtkhdf"))
        reader.UpdateInformation()
        assert reader.GetNumberOfSteps() == len(strand.times)
        for increment in (0, PULLED, len(strand.times) - 1):
            reader.SetStep(increment)
            reader.Update()
            grid, zones = reader.GetOutput(), strand.contact_zones(increment)
            assert grid.GetNumberOfCells() == zones.n_rows
            if zones.n_rows:
                assert np.array_equal(vtk_to_numpy(grid.GetCellData().GetArray("force")), zones["force"])
                largest = vtk_to_numpy(grid.GetPointData().GetArray("force_per_length")).max()
                # the line passes through the places of one of the wires
                assert 0.9 < largest / zones["max_force_per_length"].max() <= 1

    def test_vtu_has_a_series_of_zones(self, strand, tmp_path):
        strand.export("vtu", tmp_path)
        files = sorted(tmp_path.glob("14_strand_zones_*.vtu"))
        for increment in (0, PULLED):
            grid, zones = pyvista.read(files[increment]), strand.contact_zones(increment)
            assert grid.n_cells == zones.n_rows
        assert np.array_equal(grid.cell_data["force"], zones["force"])

    def test_the_viewer_gets_zones_in_place_of_their_places(self, strand):
        data = WebData(strand)
        model, pulled = json.loads(data.model()), json.loads(data.increment(PULLED))
        zones = strand.contact_zones(PULLED)
        assert pulled["contacts"]["id"] == []
        assert pulled["zones"]["id"] == zones["id"].tolist()
        assert pulled["zones"]["wire_2"] == [2, 3, 4, 5, 6, 7]
        assert {column["name"] for column in model["zones"]["columns"]} == set(zones)
        every = [strand.contact_zones(k)["max_force_per_length"].max(initial=0) for k in range(len(strand.times))]
        assert model["zones"]["limits"] == [0.0, pytest.approx(max(every), rel=1e-12)]
        pieces = np.frombuffer(base64.b64decode(pulled["lines"]["zones"]), np.int32)
        # a piece between any two neighbouring places of one of the wires, and one for the mark at each end
        assert np.bincount(pieces).tolist() == [160 + 2] * 6

    def test_pictures_of_what_passes_per_length(self, strand, tmp_path):
        for wire in (None, 3):
            picture = imread(litz.plot(strand, "lines", tmp_path / f"lines{wire}.png", wire=wire))[..., :3]
            coloured = np.ptp(picture.reshape(-1, 3), axis=1) > 0.15
            assert coloured.mean() > 1e-3
        with pytest.raises(ValueError, match="there is no wire 7: there are 7, counted from 0"):
            litz.plot(strand, "lines", tmp_path / "none.png", wire=7)

    @pytest.mark.slow
    def test_legends_and_second_scales_of_the_overview_are_whole(self, strand, tmp_path):
        picture = imread(litz.plot(strand, "overview", tmp_path / "overview.png"))[..., :3]
        edge = picture[:, -int(0.005 * picture.shape[1]) :]
        assert edge.min() == 1

    def test_the_report_has_zones_and_pairs(self, strand, tmp_path, reports_without_pictures):
        text = litz.report(strand, tmp_path / "report.html").read_text()
        assert "Contact along lines at the last increment" in text
        assert f"The 8 zones with the largest forces, of {strand.contact_zones().n_rows}." in text
        assert "what passes per length, along the wires" in text


def test_a_result_without_contact_along_lines_has_no_such_passages(run_of_input, tmp_path, reports_without_pictures):
    results = Results(run_of_input("04_wire_grid"))
    assert results.contact_zones().n_rows == 0
    assert "line contact" not in results.summary()
    text = litz.report(results, tmp_path / "report.html").read_text()
    assert "along lines" not in text
    picture = litz.plot(results, "lines", tmp_path / "lines.png")
    assert picture.exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [(("lines", "--wire", "9"), "a number from 1 to 7"), (("wires", "--wire", "1"), "--wire is for lines")],
)
def test_the_command_says_which_wires_there_are(strand, tmp_path, arguments, words, capsys):
    from litz.cli import main

    assert main(["plot", str(strand.path), *arguments, "-o", str(tmp_path / "picture.png")]) == 1
    assert words in capsys.readouterr().err
