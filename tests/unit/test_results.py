"""Result files: what the Fortran writer wrote, read back by VTK, pyvista, h5py and litz.Results.

`test_results.f90` writes the files of a made-up run: two crossed wires of six nodes (10, 20, ... 60) and four elements
(101 ... 104), three increments with 0, 2 and 1 contacts. Most values are `increment * (component + 10 * node)`.
"""

import os
import resource
import shutil
import subprocess
import sys
import time

import h5py
import numpy as np
import pytest
import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

import litz
from litz.results.text_tables import read_aligned

N_NODES, N_ELEMENTS, N_INCREMENTS = 6, 4, 3
ENDINGS = (".vtkhdf", "_contacts.vtkhdf", "_contacts.csv", "_history.csv", ".sta", ".cvg")
NODE = np.arange(1, N_NODES + 1)
ELEMENT = np.arange(1, N_ELEMENTS + 1)


def vector(increment, offset=0):
    """The made-up vector field over nodes."""
    return increment * (np.arange(1, 4) + offset + 10.0 * NODE[:, None])


def read_step(path, step):
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.SetStep(step)
    reader.Update()
    return reader, reader.GetOutput()


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


class TestWhatVtkReads:
    def test_all_files_are_there_and_no_others(self, written):
        assert sorted(path.name for path in written.iterdir()) == sorted("crossed" + ending for ending in ENDINGS)

    def test_steps_and_times(self, written):
        for name in ("crossed.vtkhdf", "crossed_contacts.vtkhdf"):
            reader, _ = read_step(written / name, 0)
            assert reader.GetNumberOfSteps() == N_INCREMENTS
            times = [
                reader.GetOutputInformation(0).Get(reader.GetExecutive().TIME_STEPS(), i) for i in range(N_INCREMENTS)
            ]
            assert times == [0.25, 0.5, 0.75]

    @pytest.mark.parametrize("step", [0, 1, 2])
    def test_fields_of_the_wires_at_each_step(self, written, step):
        _, grid = read_step(written / "crossed.vtkhdf", step)
        increment = step + 1
        points, cells = grid.GetPointData(), grid.GetCellData()
        assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (N_NODES, N_ELEMENTS)
        np.testing.assert_allclose(array(points, "displacement"), 1e-3 * vector(increment), rtol=1e-14)
        np.testing.assert_allclose(array(points, "rotation"), 1e-2 * vector(increment), rtol=1e-14)
        np.testing.assert_array_equal(array(points, "potential"), increment * NODE)
        np.testing.assert_array_equal(array(points, "reaction_force"), vector(increment))
        np.testing.assert_array_equal(array(points, "reaction_moment"), vector(increment, offset=3))
        np.testing.assert_array_equal(array(points, "applied_force"), -vector(increment))
        np.testing.assert_array_equal(array(points, "applied_moment"), -vector(increment, offset=3))
        np.testing.assert_array_equal(array(points, "reaction_current"), 2 * increment * NODE)
        np.testing.assert_array_equal(array(points, "node_id"), 10 * NODE)
        names = (
            "axial_force",
            "shear_force_2",
            "shear_force_3",
            "torsion_moment",
            "bending_moment_2",
            "bending_moment_3",
        )
        for i, name in enumerate(names):
            np.testing.assert_array_equal(array(cells, name), increment * (i + 1 + 10.0 * ELEMENT))
        np.testing.assert_array_equal(array(cells, "element_current"), 3 * increment * ELEMENT)
        np.testing.assert_allclose(array(cells, "current_density"), 3 * increment * ELEMENT / 4e-4, rtol=1e-14)
        np.testing.assert_array_equal(array(cells, "joule_heat"), 4 * increment * ELEMENT)
        np.testing.assert_array_equal(array(cells, "resistivity"), 2e-8)
        np.testing.assert_array_equal(array(cells, "element_resistance"), 1e-3 * increment)
        np.testing.assert_array_equal(array(cells, "element_id"), 100 + ELEMENT)
        np.testing.assert_array_equal(array(cells, "section"), [1, 1, 2, 2])
        np.testing.assert_array_equal(array(cells, "wire"), [1, 1, 2, 2])
        np.testing.assert_array_equal(array(cells, "place_in_wire"), [1, 2, 1, 2])
        np.testing.assert_array_equal(array(cells, "direction_in_wire"), [1, 1, 1, 1])

    def test_points_are_the_current_positions(self, written):
        for step in range(N_INCREMENTS):
            _, grid = read_step(written / "crossed.vtkhdf", step)
            points = grid.GetPointData()
            current = array(points, "reference_position") + array(points, "displacement")
            np.testing.assert_allclose(vtk_to_numpy(grid.GetPoints().GetData()), current, rtol=1e-14)

    def test_cells_are_lines_between_the_nodes_of_the_elements(self, written):
        _, grid = read_step(written / "crossed.vtkhdf", 2)
        connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 2)
        np.testing.assert_array_equal(connectivity, [[0, 1], [1, 2], [3, 4], [4, 5]])
        assert {grid.GetCellType(i) for i in range(N_ELEMENTS)} == {pyvista.CellType.LINE}

    def test_a_section_without_contact_radius_is_drawn_by_its_area(self, written):
        _, grid = read_step(written / "crossed.vtkhdf", 0)
        area = 4e-4
        np.testing.assert_allclose(array(grid.GetCellData(), "radius"), [0.01, 0.01, *[np.sqrt(area / np.pi)] * 2])

    @pytest.mark.parametrize(("step", "ids"), [(0, []), (1, [1, 2]), (2, [2])])
    def test_the_number_of_contacts_changes(self, written, step, ids):
        _, grid = read_step(written / "crossed_contacts.vtkhdf", step)
        assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (len(ids), len(ids))
        points = grid.GetPointData()
        np.testing.assert_array_equal(array(points, "id"), ids)
        np.testing.assert_array_equal(array(points, "force"), [10.0 * (step + 1)] * len(ids))
        np.testing.assert_array_equal(array(points, "element_2"), [104 if step == 2 else 103] * len(ids))
        for i in range(len(ids)):
            # midway between the surfaces at z = 0.01 (barred) and 0.02 (unbarred, without a radius)
            np.testing.assert_allclose(grid.GetPoint(i), [0, 0, 0.015])

    def test_pyvista_reads_the_file(self, written):
        grid = pyvista.read(written / "crossed.vtkhdf")
        np.testing.assert_array_equal(grid.point_data["potential"], NODE)


class TestWhatStandsInTheFile:
    def test_every_field_has_unit_description_and_components(self, written):
        for name in ("crossed.vtkhdf", "crossed_contacts.vtkhdf"):
            with h5py.File(written / name) as file:
                fields = [*file["VTKHDF/PointData"].values(), *file["VTKHDF/CellData"].values()]
                assert fields
                for field in fields:
                    assert field.attrs["unit"]
                    assert field.attrs["description"]
                    assert field.attrs["components"] == (b"x, y, z" if field.ndim == 2 else b"scalar")

    def test_the_deck_is_inside(self, results):
        assert results.deck == "*HEADING\nTwo crossed wires, ⌀ 2 mm\n"
        assert results.heading == "Two crossed wires"

    def test_each_increment_has_offsets_in_every_field(self, written):
        with h5py.File(written / "crossed.vtkhdf") as file:
            steps = file["VTKHDF/Steps"]
            for group in ("PointData", "CellData"):
                assert set(steps[group + "Offsets"]) == set(file["VTKHDF"][group])
                for offsets in steps[group + "Offsets"].values():
                    assert len(offsets) == N_INCREMENTS


class TestResults:
    @pytest.mark.parametrize("path", ["", "crossed", "crossed.vtkhdf", "crossed.inp"])
    def test_is_found_by_directory_stem_file_and_deck(self, written, path):
        assert litz.Results(written / path).path == written / "crossed.vtkhdf"

    def test_mesh(self, results):
        np.testing.assert_array_equal(results.node_ids, 10 * NODE)
        np.testing.assert_array_equal(results.element_ids, 100 + ELEMENT)
        np.testing.assert_array_equal(results.elements, [[0, 1], [1, 2], [3, 4], [4, 5]])
        np.testing.assert_array_equal(results.nodes[0], [-1, 0, 0])
        np.testing.assert_array_equal(results.nodes[5], [0, 1, 0.02])
        assert {name: list(results.node_ids[rows]) for name, rows in results.node_sets.items()} == {
            "LEFT": [10],
            "BACK": [60],
            "ENDS": [10, 30],
            "LOOSE": [50],
        }
        assert {name: list(results.element_ids[rows]) for name, rows in results.element_sets.items()} == {
            "LOWER": [101, 102]
        }

    def test_time(self, results):
        np.testing.assert_array_equal(results.times, [0.25, 0.5, 0.75])
        np.testing.assert_array_equal(results.steps, [1, 1, 1])
        np.testing.assert_array_equal(results.increments, [1, 2, 3])
        assert results.index(step=1, increment=2) == 1
        assert results.finished

    def test_field_at_one_and_at_all_increments(self, results):
        np.testing.assert_array_equal(results.field("reaction_force"), vector(3))
        np.testing.assert_array_equal(results.field("reaction_force", increment=0), vector(1))
        np.testing.assert_array_equal(results.field("reaction_force", increment=-2), vector(2))
        np.testing.assert_array_equal(
            results.field("reaction_force", increment=None), [vector(1), vector(2), vector(3)]
        )
        np.testing.assert_array_equal(results.field("joule_heat", increment=1), 8 * ELEMENT)
        np.testing.assert_array_equal(results.field("radius", increment=None), [results.radius] * 3)
        assert results.units["reaction_force"] == "N"
        assert results.units["current_density"] == "A/m^2"

    def test_an_unknown_field_is_answered_by_the_nearest(self, results):
        with pytest.raises(KeyError, match="did you mean 'displacement'"):
            results.field("displacemnt")

    def test_an_increment_that_is_not_there(self, results):
        with pytest.raises(IndexError, match="has 3 increments"):
            results.field("displacement", increment=3)
        with pytest.raises(KeyError, match="increment 9 of step 1"):
            results.index(1, 9)

    def test_the_history_has_the_columns_of_all_steps_once(self, results):
        history = results.history
        assert history.n_rows == N_INCREMENTS
        section_forces = ["N", "Q2", "Q3", "T", "M2", "M3"]
        assert list(history) == [
            "step", "increment", "time",
            *[f"U{i} node {node}" for node in (10, 30) for i in (1, 2, 3)],
            *[f"RF{i} node {node}" for node in (10, 30) for i in (1, 2, 3)],
            *[f"RF{i} sum ENDS" for i in (1, 2, 3)],
            *[f"U{i} mean ENDS" for i in (1, 2, 3)],
            *[f"{name} element {element}" for element in (101, 102) for name in section_forces],
            "current element 101", "current element 102",
            "voltage LEFT to BACK", "current LEFT to BACK", "resistance LEFT to BACK",
            "voltage LOOSE to BACK", "current LOOSE to BACK", "resistance LOOSE to BACK",
        ]  # fmt: skip
        increment = np.arange(1, 4)
        np.testing.assert_array_equal(history["RF2 node 30"], 32 * increment)
        np.testing.assert_array_equal(history["RF2 sum ENDS"], (12 + 32) * increment)
        np.testing.assert_allclose(history["U3 mean ENDS"], 1e-3 * (13 + 33) / 2 * increment, rtol=1e-14)
        np.testing.assert_array_equal(history["M3 element 102"], 26 * increment)
        np.testing.assert_array_equal(history["current element 102"], 6 * increment)
        assert (history.units["M3 element 102"], history.units["Q3 element 102"]) == ("N m", "N")

    def test_the_resistance_is_voltage_over_the_current_that_enters_at_the_first_electrode(self, results):
        history, increment = results.history, np.arange(1, 4)
        np.testing.assert_array_equal(history["voltage LEFT to BACK"], (1 - 6) * increment)
        np.testing.assert_array_equal(history["current LEFT to BACK"], 2 * increment)
        np.testing.assert_array_equal(history["resistance LEFT to BACK"], [-2.5] * 3)
        assert history.units["resistance LEFT to BACK"] == "ohm"

    def test_an_open_circuit_has_no_current_and_an_infinite_resistance_and_not_those_of_round_off(self, results):
        history = results.history
        assert np.all((results.field("reaction_current", None) + results.field("applied_current", None))[:, 4] != 0)
        np.testing.assert_array_equal(history["current LOOSE to BACK"], [0.0] * 3)
        np.testing.assert_array_equal(history["resistance LOOSE to BACK"], [np.inf] * 3)

    def test_the_ledger_by_increment_and_by_contact(self, results):
        assert list(results.contacts["id"]) == [1, 2, 2]
        assert list(results.contacts["status"]) == ["new", "new", "moved"]
        assert list(results.contacts["friction"]) == ["slip"] * 3
        np.testing.assert_array_equal(results.contacts["traction_x"], [3.0] * 3)
        np.testing.assert_allclose(results.contacts["slip_path"], [2e-4, 2e-4, 3e-4], rtol=1e-15)
        assert [results.contacts_at(i).n_rows for i in range(N_INCREMENTS)] == [0, 2, 1]
        life = results.contact(2)
        np.testing.assert_array_equal(life["time"], [0.5, 0.75])
        np.testing.assert_array_equal(life["element_2"], [103, 104])
        np.testing.assert_array_equal(life["force"], [20.0, 30.0])
        np.testing.assert_array_equal(life["gap"], [-1e-6, -1e-6])
        np.testing.assert_array_equal(life["normal_z"], [-1, -1])
        assert life.units["resistance"] == "ohm"
        with pytest.raises(KeyError, match="no contact 7"):
            results.contact(7)

    def test_iterations(self, results):
        table = results.convergence
        assert table.n_rows == 9
        first = table.where(table["increment"] == 2)
        np.testing.assert_array_equal(first["iteration"], [1, 2, 3])
        np.testing.assert_array_equal(first["force"], [1e-2, 1e-4, 1e-8])
        np.testing.assert_array_equal(first["moment"], [1e-3, 1e-5, 1e-9])
        np.testing.assert_array_equal(first["current_allowed"], [1e-9] * 3)
        np.testing.assert_array_equal(first["node_u"], [10, 20, 30])
        np.testing.assert_array_equal(first["node_phi"], [20, 30, 40])
        np.testing.assert_array_equal(first["node_V"], [0, 0, 0])
        np.testing.assert_array_equal(first["active"], [1, 1, 1])

    def test_increments(self, results):
        table = results.status
        np.testing.assert_array_equal(table["attempts"], [1, 2, 1])
        np.testing.assert_array_equal(table["contacts"], [0, 2, 1])
        np.testing.assert_array_equal(table["time"], [0.25, 0.5, 0.75])
        assert list(table["remark"]) == ["", "cut back: residual grew", ""]

    def test_the_tables_are_read_without_litz(self, written):
        ledger = np.genfromtxt(
            written / "crossed_contacts.csv", delimiter=",", names=True, dtype=None, encoding="utf-8"
        )
        np.testing.assert_array_equal(ledger["force_N"], [20, 20, 30])
        history = np.genfromtxt(written / "crossed_history.csv", delimiter=",", names=True)
        np.testing.assert_array_equal(history["RF1_sum_ENDS_N"], [42, 84, 126])

    def test_the_summary_names_what_matters(self, results):
        text = results.summary()
        for part in (
            "Two crossed wires",
            "finished",
            "cut back: residual grew",
            "at node 60",
            "resistance LEFT to BACK",
        ):
            assert part in text
        # electric power in: sum of potential times entering current, 3 j * 6 j, at all nodes but the fifth
        assert f"{18 * ((NODE**2).sum() - 25):.5g} W" in text

    def test_a_missing_file_and_an_ambiguous_directory(self, written, tmp_path):
        with pytest.raises(litz.FileError, match="has the deck been run"):
            litz.Results(tmp_path / "nothing.inp")
        with pytest.raises(litz.FileError, match="none"):
            litz.Results(tmp_path)
        shutil.copy(written / "crossed.vtkhdf", tmp_path / "a.vtkhdf")
        shutil.copy(written / "crossed.vtkhdf", tmp_path / "b.vtkhdf")
        with pytest.raises(litz.FileError, match=r"several: a\.vtkhdf, b\.vtkhdf"):
            litz.Results(tmp_path)
        with pytest.raises(litz.FileError, match=r"a_contacts\.csv"):
            _ = litz.Results(tmp_path / "a").contacts

    def test_a_file_that_is_no_result_file(self, tmp_path):
        (tmp_path / "deck.vtkhdf").write_text("not HDF5")
        with pytest.raises(litz.FileError, match="cannot read"):
            litz.Results(tmp_path / "deck")

    def test_a_line_that_is_not_complete_is_left_out(self, written, tmp_path):
        whole = (written / "crossed.cvg").read_text()
        (tmp_path / "cut.cvg").write_text(whole[:-5])
        assert read_aligned(tmp_path / "cut.cvg").n_rows == 8

    def test_a_table_that_has_grown_is_read_again(self, written, tmp_path):
        shutil.copytree(written, tmp_path, dirs_exist_ok=True)
        lines = (tmp_path / "crossed_history.csv").read_text().splitlines(keepends=True)
        (tmp_path / "crossed_history.csv").write_text("".join(lines[:3]))
        results = litz.Results(tmp_path)
        assert results.history.n_rows == 2
        (tmp_path / "crossed_history.csv").write_text("".join(lines))
        assert results.history.n_rows == 3

    def test_fields_at_every_second_increment(self, writer, tmp_path):
        subprocess.run([writer, tmp_path, "seldom"], check=True)
        results = litz.Results(tmp_path)
        # the step ends at 0.75, so that its third increment is its last
        np.testing.assert_array_equal(results.increments, [2, 3])
        np.testing.assert_array_equal(results.times, [0.5, 0.75])
        np.testing.assert_array_equal(results.field("reaction_force", increment=None), [vector(2), vector(3)])
        assert results.history.n_rows == results.status.n_rows == N_INCREMENTS
        assert [results.contacts_at(i).n_rows for i in range(2)] == [2, 1]
        _, grid = read_step(tmp_path / "crossed_contacts.vtkhdf", 1)
        np.testing.assert_array_equal(array(grid.GetPointData(), "id"), [2])

    def test_a_ledger_of_litz_0_1_is_read_with_the_new_names(self, written, tmp_path):
        for path in written.glob("crossed*"):
            shutil.copy(path, tmp_path)
        ledger = tmp_path / "crossed_contacts.csv"
        new, old = ["element_1", "element_2", "xi_1", "xi_2"], ["element_bar", "element", "xi_bar", "xi"]
        new += [f"point_{k}_{axis} [m]" for k in (1, 2) for axis in "xyz"]
        old += [f"point_{bar}{axis} [m]" for bar in ("bar_", "") for axis in "xyz"]
        was = dict(zip(new, old, strict=True))
        head, *rows = ledger.read_text().splitlines(keepends=True)
        assert set(new) < set(head.split(","))
        ledger.write_text("".join([",".join(was.get(n, n) for n in head.split(",")), *rows]))
        before, now = (litz.Results(folder / "crossed.vtkhdf").contacts for folder in (written, tmp_path))
        assert list(now) == list(before)
        assert now.units == before.units
        np.testing.assert_array_equal(now["element_2"], before["element_2"])

    def test_columns_of_the_ledger_are_found_by_their_names_in_litz_0_1(self, results):
        with pytest.warns(DeprecationWarning, match="'point_bar_x' is now 'point_1_x'"):
            np.testing.assert_array_equal(results.contact(2)["point_bar_x"], results.contact(2)["point_1_x"])


class TestWhenThingsGoWrong:
    def test_a_killed_run_that_kept_increments_tells_how_to_go_on(self, writer, tmp_path):
        subprocess.run([writer, tmp_path, "killed"], check=True)
        (tmp_path / "crossed.restart.h5").touch()
        with pytest.warns(UserWarning, match=r"continue with litz run DECK --restart .*crossed\.restart\.h5 -o DIR"):
            litz.Results(tmp_path / "crossed")

    def test_a_killed_run_leaves_readable_files(self, writer, tmp_path):
        subprocess.run([writer, tmp_path, "killed"], check=True)
        with pytest.warns(UserWarning, match="did not finish.*ends at time 0.75"):
            results = litz.Results(tmp_path / "crossed")
        assert not results.finished
        assert results.history.n_rows == results.status.n_rows == N_INCREMENTS
        np.testing.assert_array_equal(
            results.field("reaction_force", increment=None), [vector(1), vector(2), vector(3)]
        )
        _, grid = read_step(tmp_path / "crossed_contacts.vtkhdf", 1)
        assert grid.GetNumberOfPoints() == 2

    def test_the_files_of_a_run_that_goes_on_can_be_read(self, writer, tmp_path):
        process = subprocess.Popen([writer, tmp_path, "waiting"], stdin=subprocess.PIPE)
        try:
            deadline = time.monotonic() + 30
            while (
                not (tmp_path / "crossed.sta").is_file() or len((tmp_path / "crossed.sta").read_text().splitlines()) < 4
            ):
                assert time.monotonic() < deadline
                time.sleep(0.02)
            with pytest.warns(UserWarning, match="still runs"):
                results = litz.Results(tmp_path / "crossed")
            np.testing.assert_array_equal(results.field("potential"), 3 * NODE)
            _, grid = read_step(tmp_path / "crossed.vtkhdf", 2)
            np.testing.assert_array_equal(array(grid.GetPointData(), "potential"), 3 * NODE)
        finally:
            process.communicate(b"\n", timeout=30)
        assert process.returncode == 0
        assert litz.Results(tmp_path / "crossed").finished

    @pytest.mark.parametrize("ending", ENDINGS)
    def test_nothing_is_overwritten_when_one_file_cannot_be(self, writer, written, tmp_path, ending):
        for path in written.iterdir():
            shutil.copy(path, tmp_path)
        blocked = tmp_path / ("crossed" + ending)
        blocked.unlink()
        blocked.mkdir()
        before = {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
        done = subprocess.run([writer, tmp_path], capture_output=True, text=True, check=False)
        assert done.returncode != 0
        assert str(blocked) in done.stdout
        assert "directory" in done.stdout
        assert {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()} == before

    @pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
    def test_a_directory_without_permission(self, writer, tmp_path):
        tmp_path.chmod(0o500)
        done = subprocess.run([writer, tmp_path], capture_output=True, text=True, check=False)
        assert done.returncode != 0
        assert "Permission denied" in done.stdout

    def test_a_directory_that_cannot_be_made(self, writer, tmp_path):
        (tmp_path / "file").write_text("in the way")
        done = subprocess.run([writer, tmp_path / "file" / "below"], capture_output=True, text=True, check=False)
        assert done.returncode != 0
        assert "cannot be made" in done.stdout

    @pytest.mark.parametrize("kilobytes", [1, 20, 60, 150, 250])
    def test_a_full_disk_is_an_error_in_words(self, writer, tmp_path, kilobytes):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes * 1024,) * 2)

        done = subprocess.run(
            [writer, tmp_path, "limited"], capture_output=True, text=True, check=False, preexec_fn=limit
        )
        assert done.returncode > 0
        assert done.stdout.startswith("error: ")
        assert str(tmp_path) in done.stdout
        # HDF5 would tell its own story in a dozen lines
        assert "HDF5-DIAG" not in done.stderr

    @pytest.mark.parametrize("ending", ["_contacts.csv", "_history.csv", ".sta", ".cvg"])
    def test_a_text_file_on_a_full_disk(self, writer, tmp_path, ending):
        # an older file, for the check before the run not to touch what stands for the disk
        (tmp_path / ("crossed" + ending)).write_text("older")
        (tmp_path / ("crossed" + ending + ".part")).symlink_to("/dev/full")
        done = subprocess.run([writer, tmp_path], capture_output=True, text=True, check=False)
        assert done.returncode > 0
        assert f'crossed{ending}": the operating system refused; is the disk full?' in done.stdout


class TestImport:
    def test_importing_litz_loads_nothing_heavy(self):
        heavy = "[name for name in ('numpy', 'h5py', 'vtkmodules', 'pyvista', 'matplotlib') if name in sys.modules]"
        done = subprocess.run(
            [sys.executable, "-c", f"import sys, litz; print({heavy})"], capture_output=True, text=True, check=True
        )
        assert done.stdout.strip() == "[]"

    @pytest.mark.parametrize("module", ["litz.results", "litz.commands.pictures"])
    def test_results_and_their_pictures_load_no_server_and_no_client(self, module):
        code = (
            f"import sys, {module}; print([name for name in ('http', 'urllib.request', 'ssl') if name in sys.modules])"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        assert done.stdout.strip() == "[]"
